#pragma once
// Limits on what may go wrong in a run, checked with every row of the history.

#include <stdexcept>

#include "simulator/output/history.hpp"

namespace brisance::simulator {

/// A limit is exceeded; what() says which, by how much, and when.
struct GateExceeded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws GateExceeded if the books do not close, if too much is in the numerical ones, or if a particle is too fast.
void check_gates(const GateConfig& limits, const Simulation& s, const Books& books);

}  // namespace brisance::simulator
