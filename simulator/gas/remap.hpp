#pragma once
// The remap: what the faces have swept goes to the cell on their other side.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Moves contents across the faces of one axis, from `gas.moved` to `gas.next`. False if more would leave some cell than it
/// has: the step is too large.
bool sweep(Gas& gas, int axis);

}  // namespace brisance::simulator::gas
