#pragma once
// What the verifications of the simulator share: stepping to a time, particles by column, the closure of the books.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "simulator/case_reader.hpp"
#include "simulator/setup.hpp"
#include "simulator/solid/internal_energy.hpp"
#include "simulator/time_step.hpp"
#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {

using Columns = Layout<2>;

/// A case of data/cases with some of its values changed.
inline Case shipped_case(const std::string& name, const std::vector<std::string>& changes = {}) {
  return read_case(std::filesystem::path(BRISANCE_SOURCE_DIR) / "data/cases" / (name + ".toml"), changes);
}

/// Steps until `end`, after each of which `after_step()` is called.
template <class F>
void run_until(Simulation& s, double end, F&& after_step) {
  while (s.time < end * (1.0 - 1e-12)) {
    double dt = by_hand::stable_step(s, end);
    while (advance(s, dt) != StepOutcome::done) dt *= 0.5;
    after_step();
  }
}
inline void run_until(Simulation& s, double end) {
  run_until(s, end, [] {});
}

/// Round-off of sums over particles and steps: what may be in no bin of the books, in parts of the peak of kinetic energy or of
/// the momentum of a body that has it.
inline constexpr double closure = 1e-10;

inline void expect_closed_books(const Simulation& s) {
  const Balance b = balance(s.ledger, internal_energy(s));
  const InternalEnergy internal = internal_energy(s);
  const double peak = s.ledger.peak_kinetic, momentum = std::sqrt(2.0 * peak * std::max(internal.mass, s.ledger.outflow_mass));
  EXPECT_LT(b.residual, closure * peak) << "of energy, after " << s.step << " steps";
  for (const double p : b.momentum_residual) EXPECT_LT(std::abs(p), closure * momentum);
  testing::Test::RecordProperty("energy_residual", std::to_string(b.residual / peak));
}

}  // namespace brisance::simulator
