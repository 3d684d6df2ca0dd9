#pragma once
// What happens on the nodes: velocities from momentum, forces, boundaries.

#include "simulator/simulation.hpp"

namespace brisance::simulator {

struct NodeResult {
  std::vector<NodeTally> tallies;                      // by block of this rank
  std::vector<std::vector<BoundaryTally>> boundaries;  // by block, by boundary
};

/// Velocities before and after the forces of a step of dt seconds act, boundaries applied to both, into the grid's motion.
NodeResult accelerate(Simulation& s, double dt);

/// Where it is known which nodes touch a wall: in the sums, or in the motion that accelerate() has left.
enum class Touch { in_sums, as_accelerated };

/// Velocities from the momentum in the sums, boundaries as at a time (s) applied, into the grid's motion.
void velocities_from_momentum(Simulation& s, Touch touch, double time);

}  // namespace brisance::simulator
