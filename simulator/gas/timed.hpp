#pragma once
// How long the parts of a step take.

#include <chrono>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Does a part of the step and notes how long it takes.
template <class F>
auto timed(Gas& gas, Phase phase, F&& f) {
  const struct Watch {
    double& seconds;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ~Watch() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  } watch{gas.seconds[static_cast<std::size_t>(phase)]};
  return f();
}

}  // namespace brisance::simulator::gas
