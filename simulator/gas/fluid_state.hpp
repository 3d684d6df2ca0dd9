#pragma once
// States of a fluid by its equation of state, and cells that are given them.

#include <algorithm>
#include <span>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

template <class Real>
equation_of_state::PressureSlopes<Real> slopes_of(const EquationOfState& law, const Real& density, const Real& energy) {
  return std::visit([&](const auto& l) { return equation_of_state::pressure_slopes(l, density, energy); }, law);
}
/// Pa, instead of that of a state without sound, as a gas without heat.
inline double least_bulk_modulus(const EquationOfState& law, double density) {
  const double c = std::visit([](const auto& l) { return l.lowest_sound_speed(); }, law);
  return density * std::max(c * c, 1e-12);
}

/// Energy of a fluid at T = 0, J/kg: with less it has no state. Where a law's energy counts from anywhere there is no limit.
Lanes coldest_energy(const Fluid& fluid, const Lanes& density);

/// e(rho, p), J/kg, to the last digits: pressures are linear in the energy, or nearly.
double energy_of(const EquationOfState& law, double density, double pressure);
/// J/kg, of what a cell is filled with.
double internal_energy_of(const EquationOfState& law, const Filling& filling);

/// A state that the fluid can have, for lanes without it.
void give_usual_state(Fluid& fluid);

/// Content of a cell by its portions; content and primitives of a cell of one fluid.
void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, std::span<const Portion> portions);
void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, const Filling& filling);
void write_primitive(Gas& gas, std::size_t block, int cell, const Filling& filling);

}  // namespace brisance::simulator::gas
