#pragma once
// A case run whole, and once more in parts.

#include <gtest/gtest.h>

#include <vector>

#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/command_line.hpp"

namespace brisance::simulator {

struct InterruptedRun {
  fs::path whole_directory, parts_directory;
  Simulation whole, parts;  // as they ended
  RunResult uninterrupted;
};

/// Runs a case to its end, and in another directory with an interruption after so many steps of each part. Expects the same
/// state and history, to the last bit.
inline InterruptedRun run_whole_and_in_parts(const Case& c, const std::vector<int>& steps) {
  const fs::path directory = scratch();
  InterruptedRun r{directory / "whole", directory / "parts", set_up(c), set_up(c), {}};
  prepare_directory(r.whole_directory, c, false), prepare_directory(r.parts_directory, c, false);
  r.uninterrupted = run(c, r.whole, {r.whole_directory, {}});
  EXPECT_EQ(r.uninterrupted.ending, Ending::done) << r.uninterrupted.message;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    Simulation part = set_up(c);
    const RunOptions options{r.parts_directory, {}, steps[n]};
    EXPECT_EQ((n == 0 ? run(c, part, options) : resume(c, part, options)).ending, Ending::interrupted);
  }
  const RunResult resumed = resume(c, r.parts, {r.parts_directory, {}});
  EXPECT_EQ(resumed.ending, Ending::done) << resumed.message;
  EXPECT_EQ(r.parts.step, r.whole.step);
  EXPECT_TRUE(gas::numbers_of(r.parts.gas) == gas::numbers_of(r.whole.gas));
  EXPECT_EQ(text_of(r.parts_directory / "history.csv"), text_of(r.whole_directory / "history.csv"));
  return r;
}

}  // namespace brisance::simulator
