#pragma once
// Ghost cells: what the kernels see beyond the box.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Part of the state beyond an open side that the gas next to it feels, which leaves through it at some Mach number (negative:
/// comes in); of the rest it is as inside. Nothing runs up a flow that leaves faster than its sound. The way there is as smooth
/// as in the relaxation of outgoing waves (Poinsot & Lele, J. Comput. Phys. 101 (1992) 104), so that no flow that is choked at
/// the side falls from one state to the other. What is said to flow in is felt whole.
double share_of_beyond(EdgeKind kind, double outward_mach);
/// Part of the velocity beyond that is felt where of the state there is a part, from the density beyond and the mixed one
/// (kg/m^3): momentum is mixed, so thin gas at rest beyond does not hold up what flows into it.
double part_of_velocity(double part, double density, double mixed_density);

/// Asks what lies beyond the box at a time (s); throws StepFailure where a formula fails then.
void ask_beyond(const Gas& gas, double time);
/// After the equilibrium: primitives of halo and ghosts at a time (s).
void share_primitives(Gas& gas, double time, Domain& domain);
/// What the first half of a step of dt (s) changes there.
void share_half_step(Gas& gas, double dt, Domain& domain);
/// Contents of the halo, and of the ghosts that a sweep of the remap along an axis reads, at the end of the step; `moved` (s)
/// tells for each axis how long the cells have moved along it.
void share_moved(Gas& gas, int axis, double time, const Vector& moved, Domain& domain);

/// Halo and ghosts of quantities without a direction, such as a fluid's part of the volume; beyond an edge they are as next to
/// it, or nothing beyond any side.
enum class Beyond { continued, nothing };
void share_scalars(const Gas& gas, CellSet& set, Beyond beyond, Domain& domain);

}  // namespace brisance::simulator::gas
