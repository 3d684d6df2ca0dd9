#pragma once
// The pressure at which the volumes of several fluids fill a cell, each fluid doing work against that pressure, so that the
// energy of the cell stays what it is; where pressures are far apart, along its isentrope.

#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Fluids are absent below this part of a cell's volume.
inline constexpr double least_fraction = 1e-12;

/// Whether a cell (or each of eight) holds a fluid: what is next to without volume, or has no mass, is left alone.
template <class Real>
auto is_present(const Real& volume, const Real& mass, const Real& cell_volume) {
  return (volume > least_fraction * cell_volume) & (mass > 0.0);
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
void relax(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& cell_volume, int lane);
/// Moves volumes and energies until all fluids have one pressure (Pa), which it returns. What is left of jumps when those that
/// crush have been relaxed is work against that final pressure, so the sums of volumes and of energies do not change. Absent
/// fluids (no mass) are left alone.
Lanes equilibrate(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& cell_volume,
                  EquilibriumCount* count = nullptr);

}  // namespace brisance::simulator::gas
