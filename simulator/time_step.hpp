#pragma once
// One time step.

#include "simulator/simulation.hpp"

namespace brisance::simulator {

enum class StepOutcome {
  done,
  // Some particle would be deformed too much, or beyond where its equation of state holds: nothing of the state has changed;
  // take a smaller step.
  rejected
};

/// Makes a simulation ready for its first step: order, blocks, extremes, opening entries of the books.
void begin(Simulation& s);

/// Advances the simulation by dt (s). Velocities lag half a step behind positions.
/// Throws std::runtime_error when a material cannot be advanced however small the step.
StepOutcome advance(Simulation& s, double dt);

}  // namespace brisance::simulator
