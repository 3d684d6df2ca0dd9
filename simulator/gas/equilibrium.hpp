#pragma once
// Pressure equilibrium: from what a cell holds to density, pressure, sound speed and the shares of its fluids in a change of
// volume. One fluid: its equation of state. Several: the pressure at which their volumes fill the cell, each fluid doing work
// against that pressure, so that the energy of the cell stays what it is; where pressures are far apart, along its isentrope.

#include <span>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Fluids are absent below this part of a cell's volume.
inline constexpr double least_fraction = 1e-12;

/// Whether a cell (or each of eight) holds a fluid: what is next to without volume, or has no mass, is left alone.
template <class Real>
auto is_present(const Real& volume, const Real& mass, const Real& room) {
  return (volume > least_fraction * room) & (mass > 0.0);
}

/// A fluid of eight cells side by side, to be brought to one pressure with the others.
struct FluidShare {
  Lanes mass, volume, internal;   // kg, m^3, J; volume and internal are changed
  Lanes bulk_modulus, gruneisen;  // Pa, 1; set
};
struct EquilibriumCount {
  double iterations = 0.0, cells = 0.0, bisected = 0.0;
};
/// One of eight cells, in which a fluid stands beside a pressure that crushes it (more than half of its own bulk modulus above
/// its own), as air beside the products of a detonation: the fluid that is crushed most gives room to that of the highest
/// pressure, bit by bit, each along its isentrope, and what the one does more work than the other takes warms all by mass. Work
/// against the final pressure would leave all of it to the fluid that is pressed together: a little air in a cell full of
/// products would get hundreds of times the energy that a shock gives it. Ends when none is crushed, or after a hundred bits: a
/// gas without heat resists nothing. Changes volume (m^3) and internal energy (J) of that lane alone, not their sums. Pressure
/// relaxation along isentropes as by Saurel, Petitpas & Berry, J. Comput. Phys. 228 (2009) 1678, who deal what is dissipated
/// otherwise.
void relax(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& room, int lane);
/// Moves volumes and energies until all fluids have one pressure (Pa), which it returns. What is left of jumps when those that
/// crush have been relaxed is work against that final pressure, so the sums of volumes and of energies do not change. Absent
/// fluids (no mass) are left alone.
Lanes equilibrate(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& room,
                  EquilibriumCount* count = nullptr);

/// Energy of a fluid at T = 0, J/kg: with less it has no state. Where a law's energy counts from anywhere there is no limit.
Lanes coldest_energy(const Fluid& fluid, const Lanes& density);

/// e(rho, p), J/kg, to the last digits: pressures are linear in the energy, or nearly.
double energy_of(const EquationOfState& law, double density, double pressure);

/// A state that the fluid can have, for lanes without it.
void give_usual_state(Fluid& fluid);

/// Whether the energy of each own cell exceeds its motion and what its fluids have at T = 0; cells that fail are marked.
bool all_cells_hold_heat(Gas& gas, const CellSet& content);

/// Primitives of all own blocks, with the largest rates of waves and motion of all ranks: what traces may hold depends on them.
void find_equilibrium(Gas& gas, Domain& domain);

/// Content of a cell by its portions; content and primitives of a cell of one fluid.
void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, std::span<const Portion> portions);
void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, const Filling& filling);
void write_primitive(Gas& gas, std::size_t block, int cell, const Filling& filling);

}  // namespace brisance::simulator::gas
