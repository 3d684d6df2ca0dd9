// Bodies in the gas: what moves with the gas does not disturb it, what is closed keeps its gas, walls do the work of the
// pressure. References are exact solutions.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/simulator/gas/bodies_set_up.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

constexpr double round_off = 1e-12;  // of sums that have passed hundreds of steps

/// f(cell, open part) for the cells that hold gas.
template <class F>
void for_each_gas_cell(const Gas& gas, F&& f) {
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const double open = open_part(gas, c.block, c.number);
    if (open > 0.0) f(c, open);
  });
}

/// The books of a step: what the gas holds now that it neither held at the start nor received.
void expect_closed_books(const Gas& gas, Domain& domain, const std::string& what) {
  Totals rest = totals(gas, domain);
  double gross = 0.0;
  for (const Totals& through : passed(gas, domain)) {
    for (std::size_t r = 0; r < rest.mass.size(); ++r) rest.mass[r] -= through.mass[r];
    rest.momentum = rest.momentum - through.momentum, rest.energy -= through.energy;
    gross += magnitude(through.momentum);
  }
  for (std::size_t r = 0; r < rest.mass.size(); ++r)
    EXPECT_NEAR(rest.mass[r], gas.initial.mass[r], round_off * gas.initial.mass[r]) << what;
  EXPECT_NEAR(rest.energy, gas.initial.energy, round_off * gas.initial.energy) << what;
  if (is_round(gas.cells.geometry)) rest.momentum[0] = gas.initial.momentum[0];  // walls push along the radius
  const double motion = std::sqrt(2.0 * gas.initial.mass[0] * gas.initial.energy);
  EXPECT_LT(magnitude(rest.momentum - gas.initial.momentum), round_off * (motion + gross)) << what;
}

// At rest --------------------------------------------------------------------------------------------------------------

TEST(GasAtRest, AroundParticlesAtRandomStaysAtRest) {
  for (const Geometry geometry : {Geometry::plane, Geometry::three_dimensional}) {
    const auto domain = single_process();
    constexpr double h = 0.05;
    Gas gas = set_up::box(geometry, h, {0, 0, 0}, {20, 20, 20}, {set_up::ideal_gas()}, *domain);
    MovingBody body = set_up::ball(geometry, h, {0.5, 0.5, 0.5}, 0.25);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> shift(-0.3 * h, 0.3 * h);
    for (Vector& x : body.places)
      for (int a = 0; a < gas.dimensions(); ++a) x[static_cast<std::size_t>(a)] += shift(random);
    gas.bodies.all = {body};
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.2, 1e5, {}};
        },
        *domain);
    Stepper().steps(gas, 20, *domain);
    for_each_gas_cell(gas, [&](const set_up::Cell& c, double) {
      EXPECT_EQ(c.velocity, Vector{});
      EXPECT_EQ(c.pressure, gas.primitive.cell(static_cast<std::size_t>(gas.cells.mine[0]), Primitive::pressure, 0));
    });
  }
}

TEST(GasAtRest, AroundASphereAboutTheAxisStaysAtRest) {
  constexpr double h = 0.05, still = 1e-12;  // of the speed of sound; volumes about an axis round
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::axisymmetric, h, {0, 0, 0}, {20, 20, 0}, {set_up::ideal_gas()}, *domain);
  gas.bodies.all = {set_up::ball(Geometry::axisymmetric, h, {0.0, 0.52, 0.0}, 0.25)};
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1.2, 1e5, {}};
      },
      *domain);
  Stepper().steps(gas, 50, *domain);
  for_each_gas_cell(gas, [&](const set_up::Cell& c, double) { EXPECT_LT(magnitude(c.velocity), still * c.sound_speed); });
}

// Moving with the gas --------------------------------------------------------------------------------------------------

struct Noise {
  double worst = 0.0, mean = 0.0;  // of the pressure: largest at any time, mean at the end
};
/// A body that moves with the gas at a Mach number, through a box that gas flows into and out of.
Noise noise_of(Geometry geometry, double cell_size, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
               MovingBody body, const Vector& velocity, double way) {
  const auto domain = single_process();
  Gas gas = set_up::box(geometry, cell_size, lower, upper, {set_up::ideal_gas()}, *domain);
  set_up::give_velocity(body, velocity);
  gas.bodies.all = {body};
  const Filling state = {0, 1.0, 1.0, velocity};
  const std::size_t first = is_round(geometry) ? 1 : 0;  // the axis and the wall around
  for (std::size_t a = first; a < static_cast<std::size_t>(gas.dimensions()); ++a)
    gas.edges[2 * a] = gas.edges[2 * a + 1] = set_up::beyond(EdgeKind::non_reflecting, state);
  fill(
      gas, [&](const Vector&, double) { return state; }, *domain);
  Noise noise;
  Stepper stepper;
  const double end = way / magnitude(velocity);
  while (gas.time < end * (1.0 - 1e-9)) {
    stepper.to(gas, std::min(end, gas.time + 0.02 * end), *domain);
    double largest = 0.0, sum = 0.0, volume = 0.0;
    for_each_gas_cell(gas, [&](const set_up::Cell& c, double open) {
      largest = std::max(largest, std::abs(c.pressure - 1.0));
      sum += open * c.volume * std::abs(c.pressure - 1.0), volume += open * c.volume;
    });
    noise.worst = std::max(noise.worst, largest), noise.mean = sum / volume;
  }
  EXPECT_EQ(stepper.rejected, 0);
  expect_closed_books(gas, *domain, "with the gas");
  return noise;
}
void expect_quiet(const Noise& noise, const std::string& what) {
  constexpr double worst = 2e-2, mean = 5e-4;
  EXPECT_LT(noise.worst, worst) << what;
  EXPECT_LT(noise.mean, mean) << what;
  ::testing::Test::RecordProperty(what, "worst " + std::to_string(noise.worst) + ", mean " + std::to_string(noise.mean));
}
const double speed = 0.1 * std::sqrt(1.4);  // Mach 0.1

TEST(BodyThatMovesWithTheGas, DisturbsItLittle) {
  for (const double angle : {0.0, 30.0})
    for (const int cells : {50, 100}) {
      const double h = 1.0 / cells;
      const MovingBody disk = set_up::ball(Geometry::plane, h, {0.4, 0.45, 0.0}, 0.2, angle * std::numbers::pi / 180.0);
      expect_quiet(
          noise_of(Geometry::plane, h, {0, 0, 0}, {cells, cells, 0}, disk, {speed, 0.0, 0.0}, cells == 50 ? 0.2 : 0.05),
          "disk_" + std::to_string(cells) + "_" + std::to_string(static_cast<int>(angle)));
    }
}
TEST(BodyThatMovesWithTheGas, DisturbsItLittleAboutTheAxis) {
  constexpr int cells = 50;
  constexpr double h = 1.0 / cells;
  const MovingBody sphere = set_up::ball(Geometry::axisymmetric, h, {0.0, 0.4, 0.0}, 0.2);
  expect_quiet(noise_of(Geometry::axisymmetric, h, {0, 0, 0}, {cells / 2, cells, 0}, sphere, {0.0, speed, 0.0}, 0.2), "axis");
}
TEST(BodyThatMovesWithTheGas, DisturbsItLittleInSpace) {
  constexpr int cells = 24;
  constexpr double h = 1.0 / cells;
  const MovingBody sphere = set_up::ball(Geometry::three_dimensional, h, {0.45, 0.5, 0.48}, 0.2);
  expect_quiet(noise_of(Geometry::three_dimensional, h, {0, 0, 0}, {cells, cells, cells}, sphere, {speed, 0.0, 0.0}, 0.1),
               "space");
}

}  // namespace
}  // namespace brisance::simulator::gas
