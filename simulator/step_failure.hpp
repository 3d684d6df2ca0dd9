#pragma once

#include <stdexcept>

namespace brisance::simulator {

/// No step leads on from the state, which is as good as it was before the attempt; what() says why.
struct StepFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace brisance::simulator
