#pragma once
// Ghost cells: what the kernels see beyond the box.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// After the equilibrium: primitives of halo and ghosts at a time (s).
void share_primitives(Gas& gas, double time, Domain& domain);
void share_half_step(Gas& gas, Domain& domain);
/// Contents of halo and ghosts between the sweeps of the remap.
void share_moved(Gas& gas, double time, Domain& domain);

}  // namespace brisance::simulator::gas
