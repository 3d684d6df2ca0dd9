#pragma once
// The constitutive update of all particles, eight side by side, from the velocity gradients of the step.

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Whether all densities stay where their equations of state hold over dt (s), with the velocity gradients of the step, the
/// largest of which is given (1/s).
bool densities_stay_in_range(const Simulation& s, double largest_gradient, double dt);
/// The facts of the particle for which a step of dt (s) with these velocity gradients would be too large. The same
/// on every rank; all have to ask.
std::string worst_point(const Simulation& s, double dt);

/// Advances stress, deformation gradient, density, energy, temperature and history by dt (s), and finds the extremes for the
/// next step, with the velocities of the given columns. Throws std::runtime_error with the facts of the first particle (by id)
/// that a material could not advance; if one rank has such a particle, all throw.
void update_stress(Simulation& s, double dt, ColumnSet Particles::*velocities);

/// The extremes of the state as it is, without advancing it.
Extremes extremes_of(const Simulation& s);

}  // namespace brisance::simulator
