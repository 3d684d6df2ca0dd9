#pragma once
// How long the steps of a run will be, from the state at its start: for `brisance check`.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// The largest step (s) for a Courant number once the jumps between neighbouring cells, at the sides of the box and at bodies
/// have sent out their waves. Between two states it takes the velocity of the acoustic solution, and behind a shock that
/// changes the velocity by du the speed of sound c2^2 = c^2 + (1 + Gamma) du (c + Gamma/2 du): exact for strong shocks in ideal
/// gas. What comes of waves that meet, of reactions and of bodies that are being driven is not in it. Looks at the cells of
/// this process.
double step_after_jumps(Gas& gas, double courant);

}  // namespace brisance::simulator::gas
