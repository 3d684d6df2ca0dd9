#include "simulator/time_step.hpp"

#include "simulator/solid/motion.hpp"
#include "simulator/solid/nodes.hpp"
#include "simulator/solid/stress.hpp"
#include "simulator/solid/transfer.hpp"

namespace brisance::simulator {
namespace {

/// The constitutive update integrates up to this |dt L| accurately; far below what would turn a particle inside out.
constexpr double largest_increment = 0.14;

void share_momentum(Simulation& s) {
  const Timed timed(s.times, Phase::sum_tiles);
  gather_tiles(s.grid, *s.domain);
  sum_tiles(s.grid);
}

/// Stress from the velocities of the grid, unless the step is too large. The gradient that leads over a step is that in its
/// middle, which comes `later` than the places where the particles are: with the places of either end the strain would err in
/// the first order of the step, always to the same side, and vibration would make volume.
bool deform(Simulation& s, double dt, ColumnSet Particles::*velocities, double later) {
  broadcast_motion(s.grid, *s.domain);
  const double gradient = velocity_gradients(s, later);
  if (!(gradient * dt <= largest_increment) || !densities_stay_in_range(s, gradient, dt)) return false;
  update_stress(s, dt, velocities);
  return true;
}

/// What the particles give to the nodes, and the velocities that the forces give them.
NodeResult move_nodes(Simulation& s, double dt, double dt_velocity) {
  particles_to_grid(s, Carry::motion_and_force, dt);
  share_momentum(s);
  const NodeResult nodes = accelerate(s, dt_velocity);
  broadcast_motion(s.grid, *s.domain);
  return nodes;
}

StepOutcome advance_musl(Simulation& s, double dt, double dt_velocity) {
  const NodeResult nodes = move_nodes(s, dt, dt_velocity);
  const ParticleResult particles = grid_to_particles(s, {dt, dt_velocity, true});
  share_momentum(s);
  velocities_from_momentum(s, Touch::as_accelerated, s.time + 0.5 * dt);
  if (!deform(s, dt, &Particles::next_motion, 0.5 * dt)) return StepOutcome::rejected;
  accept_motion(s, particles, nodes, dt);
  return StepOutcome::done;
}

StepOutcome advance_usl(Simulation& s, double dt, double dt_velocity) {
  const NodeResult nodes = move_nodes(s, dt, dt_velocity);
  const ParticleResult particles = grid_to_particles(s, {dt, dt_velocity, false});
  if (!deform(s, dt, &Particles::next_motion, 0.5 * dt)) return StepOutcome::rejected;
  accept_motion(s, particles, nodes, dt);
  return StepOutcome::done;
}

StepOutcome advance_usf(Simulation& s, double dt, double dt_velocity) {
  particles_to_grid(s, Carry::motion, dt);
  share_momentum(s);
  velocities_from_momentum(s, Touch::in_sums, s.time - 0.5 * s.last_time_step);
  if (!deform(s, dt, &Particles::motion, -0.5 * dt)) return StepOutcome::rejected;
  const NodeResult nodes = move_nodes(s, dt, dt_velocity);
  accept_motion(s, grid_to_particles(s, {dt, dt_velocity, false}), nodes, dt);
  return StepOutcome::done;
}

StepOutcome advance_gas(Simulation& s, double dt) {
  if (gas::advance(s.gas, dt, *s.domain) == gas::Outcome::rejected) return StepOutcome::rejected;
  s.time += dt, s.last_time_step = dt, ++s.step;
  return StepOutcome::done;
}

}  // namespace

StepOutcome advance(Simulation& s, double dt) {
  if (s.bodies.empty()) return advance_gas(s, dt);
  const double dt_velocity = 0.5 * (dt + s.last_time_step);
  activate_blocks(s);
  switch (s.numerics.stress_timing) {
    case StressTiming::usl:
      return advance_usl(s, dt, dt_velocity);
    case StressTiming::usf:
      return advance_usf(s, dt, dt_velocity);
    default:
      return advance_musl(s, dt, dt_velocity);
  }
}

void begin(Simulation& s) {
  if (s.bodies.empty()) return;
  place_particles(s);
  activate_blocks(s);
  s.extremes = extremes_of(s);
  open_books(s);
}

}  // namespace brisance::simulator
