// Bodies that move through the sides of the box: out of it, into it, round it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "tests/simulator/gas/bodies_set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Noise;
using set_up::Stepper;

/// Gas that flows with a disk at Mach 0.1: exactly, nothing happens to it. Its largest noise, and the largest mean, at any
/// time.
const double speed = 0.1 * std::sqrt(1.4);
const Filling stream = {0, 1.0, 1.0, {speed, 0.0, 0.0}};
Noise noise_of(int cells, const Edge& low, const Edge& high, double from, double to) {
  const double h = 1.0 / cells, radius = 0.2, lattice_angle = 0.3;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {cells, cells, 0}, {set_up::ideal_gas()}, *domain);
  gas.edges[0] = low, gas.edges[1] = high;
  MovingBody disk = set_up::ball(Geometry::plane, h, {from, 0.5 + 0.2 * h, 0.0}, radius, lattice_angle);
  set_up::give_velocity(disk, stream.velocity);
  gas.bodies.all = {disk};
  fill(
      gas, [&](const Vector&, double) { return stream; }, *domain);
  Noise noise;
  while (gas.time < (to - from) / speed) {
    Stepper().steps(gas, 1, *domain);
    const Noise now = set_up::noise_in(gas);
    noise = {std::max(noise.worst, now.worst), std::max(noise.mean, now.mean)};
  }
  set_up::expect_closed_books(gas, *domain, low.name + " " + high.name);
  return noise;
}

TEST(BodyThatMovesWithTheGas, LeavesTheBoxWithLittleNoise) {
  constexpr double worst = 2e-2, mean = 5e-4;  // as inside
  for (const EdgeKind kind : {EdgeKind::non_reflecting, EdgeKind::pressure}) {
    const Noise noise = noise_of(50, set_up::beyond(EdgeKind::inflow, stream), set_up::beyond(kind, stream), 0.77, 1.24);
    EXPECT_LT(noise.worst, worst) << static_cast<int>(kind);
    EXPECT_LT(noise.mean, mean) << static_cast<int>(kind);
    RecordProperty("noise_" + std::to_string(static_cast<int>(kind)),
                   std::to_string(noise.worst) + ", " + std::to_string(noise.mean));
  }
}

TEST(BodyThatMovesWithTheGas, EntersAndLeavesTheBoxAsQuietlyAsItGoesRoundAPeriod) {
  constexpr int coarse = 24;
  constexpr double worst = 2e-2;
  const Noise around = noise_of(coarse, set_up::around(), set_up::around(), 0.6, 1.6);
  const Noise through =
      noise_of(coarse, set_up::beyond(EdgeKind::inflow, stream), set_up::beyond(EdgeKind::non_reflecting, stream), -0.25, 1.25);
  EXPECT_LT(around.worst, worst);
  EXPECT_LT(through.worst, worst);
  EXPECT_LT(through.mean, around.mean);
  RecordProperty("around", std::to_string(around.worst) + ", " + std::to_string(around.mean));
  RecordProperty("through", std::to_string(through.worst) + ", " + std::to_string(through.mean));
}

/// What comes through a side along the radius, where cells beyond are wider than those inside, is as dense as without a body
/// that has nothing to do with it.
TEST(SideAlongTheRadius, LetsInWhatItDoesWithoutBodies) {
  const auto mass = [](bool with_body) {
    constexpr double h = 0.01, inside = 1e5, outside = 1.2e5, air = 1e-3;
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::axisymmetric, h, {0, 0, 0}, {10, 8, 0}, {set_up::ideal_gas()}, *domain);
    gas.edges[1] = set_up::beyond(EdgeKind::pressure, {0, 1.0, outside, {}});
    if (with_body) gas.bodies.all = {set_up::ball(Geometry::axisymmetric, h, {0.0, 0.5, 0.0}, 3.0 * h, 0.0)};
    fill(
        gas,
        [&](const Vector&, double) {
          return Filling{0, 1.0, inside, {}};
        },
        *domain);
    Stepper().to(gas, air, *domain);
    set_up::expect_closed_books(gas, *domain, "radius");
    return totals(gas, *domain).mass[0];
  };
  constexpr double of_the_scheme = 5e-3;  // one sweeps axis by axis, the other at once
  const double without = mass(false);
  EXPECT_NEAR(mass(true), without, of_the_scheme * without);
}

/// A projectile in a tube of 0.25 m: the gas of 10 MPa drives it as simple waves do until its back leaves the muzzle.
TEST(Projectile, LeavesTheMuzzle) {
  constexpr double p0 = 1e7, rho0 = 10.0, gamma = 1.4, mass_per_area = 50.0, ahead = 100.0, h = 0.01, near = 1e-3;
  constexpr int width = 4, muzzle = 25, behind = 260;
  const double c0 = std::sqrt(gamma * p0 / rho0), start = 0.37 * h;
  const auto velocity = [&](double t) {
    return 2.0 * c0 / (gamma - 1.0) *
           (1.0 - std::pow(1.0 + (gamma + 1.0) * p0 * t / (2.0 * c0 * mass_per_area), -(gamma - 1.0) / (gamma + 1.0)));
  };
  const auto run = [&](int ranks) {
    std::vector<double> found;
    std::mutex one_at_a_time;
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      Gas gas = set_up::box(Geometry::plane, h, {-behind, 0, 0}, {muzzle, width, 0}, {set_up::ideal_gas()}, *domain);
      MovingBody body = set_up::body_of(Geometry::plane, h, {}, 0.1, [&](const Vector& x) {
        return x[0] > start && x[0] < start + 6.0 * h && x[1] > 0.0 && x[1] < width * h;
      });
      body.mass = mass_per_area * width * h;
      gas.bodies.all = {body};
      const Filling open = {0, rho0 * ahead / p0, ahead, {}};
      gas.edges[1] = set_up::beyond(EdgeKind::non_reflecting, open);
      fill(
          gas,
          [&](const Vector& x, double) {
            return x[0] < start + 3.0 * h ? Filling{0, rho0, p0, {}} : open;
          },
          *domain);
      const MovingBody& now = gas.bodies.all[0];
      Stepper stepper;
      while (now.state.displacement[0] < muzzle * h - start) stepper.steps(gas, 1, *domain);
      const double at_muzzle = now.state.velocity[0], then = gas.time;
      EXPECT_NEAR(at_muzzle / velocity(then), 1.0, near);
      stepper.to(gas, then + 2.0 * h / at_muzzle, *domain);
      const double free = now.state.velocity[0];
      EXPECT_NEAR(free / at_muzzle, 1.0, near);
      stepper.to(gas, then + 12.0 * h / at_muzzle, *domain);
      EXPECT_EQ(now.state.velocity[0], free) << "nothing drives it any more";
      EXPECT_EQ(now.force, Vector{});
      set_up::expect_closed_books(gas, *domain, "projectile");
      const std::lock_guard lock(one_at_a_time);
      found = numbers_of(gas.bodies);
      if (ranks == 1)
        RecordProperty("velocity",
                       std::to_string(at_muzzle) + " of " + std::to_string(velocity(then)) + ", free " + std::to_string(free));
    });
    return found;
  };
  EXPECT_EQ(run(1), run(3));
}

}  // namespace
}  // namespace brisance::simulator::gas
