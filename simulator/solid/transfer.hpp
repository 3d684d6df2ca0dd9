#pragma once
// Between particles and grid. Every function loops over the tiles of this rank; within a tile particles come in the order of
// their bins, so sums do not depend on where particles stand in memory or on who computes them.

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// What particles add to the grid.
enum class Carry { motion_and_force, motion };

/// Mass, momentum and forces of the particles to the tiles, ghosts folded, and which particles touch a wall in the coming step
/// of dt (s).
void particles_to_grid(Simulation& s, Carry carry, double dt);

/// What the grid gives back.
struct ParticleStep {
  double dt;           // s, of positions
  double dt_velocity;  // s, of velocities: the mean of this step and the one before
  bool remap;          // leave the momentum of the moved particles, at their old places, in the tiles (MUSL)
};

/// What grid_to_particles finds out besides the new motion.
struct ParticleResult {
  std::vector<ParticleTally> tallies;             // by tile of this rank
  std::vector<std::vector<std::uint32_t>> moved;  // by body: particles that have left their block
  std::vector<std::vector<std::uint32_t>> left;   // by body: particles beyond an outflow
};

/// Velocities, positions and affine fields at the end of the step into `next_motion`; nothing of the state is overwritten.
ParticleResult grid_to_particles(Simulation& s, const ParticleStep& step);

/// The velocity gradient at every particle from the velocities of the grid, with respect to the places that these velocities
/// lead to in a time `later` (s; negative: that they have come from); its volume change averaged over each cell for the bodies
/// that ask for it. Returns the largest |L| (1/s).
double velocity_gradients(Simulation& s, double later = 0.0);

/// Force on a particle per mass from gravity and body force (m/s^2).
Vector acceleration_field(const Simulation& s, const Vector& position);

}  // namespace brisance::simulator
