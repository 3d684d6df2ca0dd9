#pragma once
// The Lagrangian phase: the cells move with the gas. Velocity and pressure of each face come from the acoustic waves that the
// states on its two sides send each other.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Pressure and velocity at the middle of the step, from the slopes in each cell.
void advance_half_step(Gas& gas, double dt);
/// Volume, momentum and energy of the moved cells, and what the faces sweep. False if some cell would be left without volume
/// or energy: the step is too large.
bool lagrangian_phase(Gas& gas, double dt);

}  // namespace brisance::simulator::gas
