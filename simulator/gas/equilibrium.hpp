#pragma once
// Equilibrium of all cells: from what a cell holds to density, pressure, sound speed and the shares of its fluids in a change
// of volume. One fluid: its equation of state. Several: pressure_equilibrium.hpp.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Whether the energy of each own cell exceeds its motion and what its fluids have at T = 0; cells that fail are marked.
bool all_cells_hold_heat(Gas& gas, const CellSet& content);

/// Primitives of all own blocks, with the largest rates of waves and motion of all ranks: what traces may hold depends on them.
void find_equilibrium(Gas& gas, Domain& domain);

}  // namespace brisance::simulator::gas
