// The steps that a run will take, foreseen from its start.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "simulator/gas/step_estimate.hpp"
#include "tests/simulator/gas/bodies_set_up.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr double courant = 0.5;

/// The shortest of the largest steps on the way to a time.
double shortest_step(Gas& gas, double end, Domain& domain) {
  double shortest = 1e300;
  for (set_up::Stepper stepper; gas.time < end; stepper.steps(gas, 1, domain))
    shortest = std::min(shortest, largest_step(gas, courant));
  return shortest;
}

/// Acoustic waves instead of the exact ones, and a formula that is exact for strong shocks: good to a quarter.
void expect_foreseen(Gas& gas, double end, Domain& domain, const std::string& what) {
  const double at_first = largest_step(gas, courant), foreseen = step_after_jumps(gas, courant);
  EXPECT_EQ(largest_step(gas, courant), at_first) << "the gas stays what it is";
  const double shortest = shortest_step(gas, end, domain);
  EXPECT_LT(shortest, 0.9 * at_first) << what << ": the first state alone says nothing of it";
  EXPECT_GT(foreseen, 0.75 * shortest) << what;
  EXPECT_LT(foreseen, 1.25 * shortest) << what;
}

TEST(StepAfterJumps, IsThatOfTheWavesThatAJumpSendsOut) {
  const auto domain = single_process();
  for (const double ratio : {10.0, 1e5}) {
    Gas gas = set_up::box(Geometry::planar_1d, 0.01, {0, 0, 0}, {100, 0, 0}, {set_up::ideal_gas()}, *domain);
    fill(
        gas,
        [ratio](const Vector& x, double) {
          return x[0] < 0.5 ? Filling{0, 1.0, 1.0, {}} : Filling{0, 0.125, 1.0 / ratio, {}};
        },
        *domain);
    expect_foreseen(gas, 0.12, *domain, "ratio " + std::to_string(ratio));
  }
}

TEST(StepAfterJumps, SeesAWallThatStopsTheGas) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 0.01, {0, 0, 0}, {100, 0, 0}, {set_up::ideal_gas(5.0 / 3.0)}, *domain);
  const Filling hot = {0, 1.0, 0.05, {-1.0, 0.0, 0.0}};
  gas.edges[1] = set_up::beyond(EdgeKind::inflow, hot);
  fill(
      gas, [hot](const Vector&, double) { return hot; }, *domain);
  const double behind = step_after_jumps(gas, courant);
  // At the wall u = 0; the exact speed of sound there, p2 from p2 - p = rho u (c + ...): Rankine and Hugoniot for gamma = 5/3.
  const double gamma = 5.0 / 3.0, c = std::sqrt(gamma * 0.05),
               M = (gamma + 1.0) / (4.0 * c) + std::sqrt(std::pow((gamma + 1.0) / (4.0 * c), 2) + 1.0);
  const double p2 = 0.05 * (1.0 + 2.0 * gamma / (gamma + 1.0) * (M * M - 1.0)),
               rho2 = (gamma + 1.0) * M * M / ((gamma - 1.0) * M * M + 2.0), c2 = std::sqrt(gamma * p2 / rho2);
  const double of_stream = courant * 0.01 / (1.0 + c), of_wall = courant * 0.01 / c2;
  EXPECT_NEAR(behind, std::min(of_stream, of_wall), 0.05 * behind);
}

TEST(StepAfterJumps, SeesAnInflowAndAPiston) {
  const auto domain = single_process();
  const Filling still = {0, 1.2, 1e5, {}};
  const auto at_rest = [&] {
    Gas gas = set_up::box(Geometry::plane, 0.01, {0, 0, 0}, {60, 6, 0}, {set_up::ideal_gas()}, *domain);
    return gas;
  };
  Gas blown = at_rest();
  blown.edges[0] = set_up::beyond(EdgeKind::inflow, {0, 1.2, 1e5, {1500.0, 0.0, 0.0}});
  fill(
      blown, [&](const Vector&, double) { return still; }, *domain);
  expect_foreseen(blown, 2e-4, *domain, "inflow");
  Gas pushed = at_rest();
  MovingBody piston = set_up::body_of(Geometry::plane, 0.01, {0.0, 0.03, 0.0}, 0.4,
                                      [](const Vector& x) { return x[0] > -0.3 && x[0] < 0.1 && std::abs(x[1]) < 0.1; });
  set_up::give_velocity(piston, {900.0, 0.0, 0.0});
  pushed.bodies.all = {piston};
  fill(
      pushed, [&](const Vector&, double) { return still; }, *domain);
  expect_foreseen(pushed, 2e-4, *domain, "piston");
}

TEST(StepAfterJumps, OfUniformGasIsTheLargestStep) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::plane, 0.01, {0, 0, 0}, {20, 20, 0}, {set_up::ideal_gas()}, *domain);
  gas.edges.assign(4, set_up::around());
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1.2, 1e5, {30.0, -40.0, 0.0}};
      },
      *domain);
  EXPECT_EQ(step_after_jumps(gas, courant), largest_step(gas, courant));
}

/// Wherever the cell lies: finite rates come before and after it.
TEST(LargestStep, IsNoneWhereACellHoldsNoState) {
  const auto domain = single_process();
  for (const int wrong : {0, 11, 19}) {
    Gas gas = set_up::box(Geometry::planar_1d, 0.05, {0, 0, 0}, {20, 0, 0}, {set_up::ideal_gas()}, *domain);
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.2, 1e5, {}};
        },
        *domain);
    EXPECT_GT(largest_step(gas, courant), 0.0);
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      if (c.index[0] == wrong) gas.content.cell(c.block, Content::energy, c.number) = std::numeric_limits<double>::quiet_NaN();
    });
    begin(gas, *domain);
    EXPECT_EQ(largest_step(gas, courant), 0.0) << "cell " << wrong;
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
