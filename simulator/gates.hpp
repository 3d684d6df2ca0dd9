#pragma once
// Limits on what may go wrong in a run, checked with every row of the history.

#include <stdexcept>
#include <string>

#include "simulator/output/history.hpp"

namespace brisance::simulator {

/// A limit is exceeded; what() says which, by how much, and when.
struct GateExceeded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What no gate watches though it might be wrong, and what to do; empty if there is nothing.
std::string not_gated(const GateConfig& limits, const Simulation& s);
/// Throws GateExceeded if the books do not close, if too much is in the numerical ones, or if a particle is too fast.
void check_gates(const GateConfig& limits, const Simulation& s, const Books& books);

}  // namespace brisance::simulator
