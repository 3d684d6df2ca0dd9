#pragma once
// The size of the next step.

#include <string_view>

#include "simulator/simulation.hpp"

namespace brisance::simulator {

struct StepSize {
  double dt;               // s
  std::string_view limit;  // what it is limited by
};

/// What limits the steps that end a run: they may be as small as they have to be.
inline constexpr std::string_view last_steps = "the end of the run";

/// The Courant number of a gas, given or not.
double gas_courant(const gas::Gas& gas);

/// It follows from the state alone, so that a run that was interrupted takes the same steps as one that was not.
StepSize next_step(const Simulation& s, const NumericsConfig& numerics, double end_time);

}  // namespace brisance::simulator
