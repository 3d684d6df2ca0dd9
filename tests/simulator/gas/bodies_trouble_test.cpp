// Bodies in gas that goes to its limits: steps that some cells do not bear, and bodies that meet what they must not touch.

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <numbers>
#include <string>

#include "simulator/output/history.hpp"
#include "tests/simulator/gas/bodies_set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

constexpr double h = 0.01;

/// A disk in air that gas of a tenth of the temperature, at ten times the pressure, rushes towards: 30 times as dense.
Gas dense_gas_meets_a_disk(Domain& domain) {
  Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {40, 20, 0},
                        {{"air", equation_of_state::IdealGas{1.4, 718.0}}, {"dense", equation_of_state::IdealGas{1.4, 718.0}}},
                        domain);
  MovingBody disk = set_up::ball(Geometry::plane, h, {0.12, 0.1, 0.0}, 0.03);
  set_up::give_velocity(disk, {50.0, 0.0, 0.0});
  gas.bodies.all = {disk};
  fill(
      gas,
      [](const Vector& x, double) {
        return x[0] < 0.2 ? Filling{0, 1.18, 101325.0, {}} : Filling{1, 35.3, 1013250.0, {-100.0, 0.0, 0.0}};
      },
      domain);
  return gas;
}

struct Outcomes {
  std::int64_t first_order_cell_steps = 0, flattened = 0, rejected = 0;
  std::vector<double> mass;
  double energy = 0.0;
};
Outcomes after(const std::function<Gas(Domain&)>& filled, double end, int ranks) {
  Outcomes found;
  std::mutex one_at_a_time;
  VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
    Simulation s;
    s.geometry = Geometry::plane, s.domain = domain, s.gas = filled(*domain);
    Stepper stepper;
    stepper.to(s.gas, end, *domain);
    const Books books = books_of(s);
    const std::lock_guard lock(one_at_a_time);
    found = {books.gas->first_order_cell_steps, books.gas->flattened, stepper.rejected, books.gas->state.mass,
             books.gas->residual().energy};
    EXPECT_LT(std::abs(found.energy), 1e-12 * books.gas->state.energy);
    for (std::size_t r = 0; r < found.mass.size(); ++r)
      EXPECT_LT(std::abs(books.gas->residual().mass[r]), 1e-12 * found.mass[r]);
  });
  return found;
}

TEST(BodiesInAStepThatCellsDoNotBear, TheseDoWithoutSlopesAndTheStepIsTaken) {
  const Outcomes one = after(dense_gas_meets_a_disk, 0.5e-3, 1);
  EXPECT_GT(one.first_order_cell_steps, 0);
  EXPECT_EQ(one.rejected, 0) << "with slopes everywhere some steps would have to be shorter";
  for (const int ranks : {2, 5}) {
    const Outcomes other = after(dense_gas_meets_a_disk, 0.5e-3, ranks);
    EXPECT_EQ(other.first_order_cell_steps, one.first_order_cell_steps) << "the books tell of all ranks";
    EXPECT_EQ(other.mass, one.mass);
  }
}

/// Cold gas that widens: the motion within a cell holds more than its heat.
TEST(SlopesAroundBodies, AreCountedWhereTheyAreTakenBack) {
  const auto stream = [](Domain& domain) {
    const auto widening = [](const Vector& x, double) { return Filling{0, 1.0, 0.2, {500.0 * (x[0] - 0.2), 0.0, 0.0}}; };
    Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {40, 20, 0}, {set_up::ideal_gas()}, domain);
    gas.edges[0] = gas.edges[1] = set_up::beyond(EdgeKind::non_reflecting, widening);
    gas.bodies.all = {set_up::ball(Geometry::plane, h, {0.2, 0.1, 0.0}, 0.04)};
    fill(gas, widening, domain);
    return gas;
  };
  const Outcomes one = after(stream, 2e-4, 1), three = after(stream, 2e-4, 3);
  EXPECT_GT(one.flattened, 0);
  EXPECT_EQ(three.flattened, one.flattened);
}

/// A solid whose energy counts from its state at rest has none that could pay for a slope: the least shear loses its own.
TEST(SlopesWithoutHeat, AreCountedWhereTheirLossCouldBeNoticed) {
  const auto flattened = [](double shear_rate, bool with_body) {
    const auto domain = single_process();
    const equation_of_state::Murnaghan solid{1838.0, 1.0 / 2.78e-11, 7.4, 1e5, 1000.0, 300.0};
    Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {40, 20, 0}, {{"explosive", solid}}, *domain);
    const auto sheared = [&](const Vector& x, double) {
      return Filling{0, 1838.0, 1e5, {10.0, shear_rate * (x[0] - 0.2), 0.0}};
    };
    gas.edges[0] = gas.edges[1] = set_up::beyond(EdgeKind::non_reflecting, sheared);
    gas.edges[2] = gas.edges[3] = set_up::around();
    if (with_body) gas.bodies.all = {set_up::ball(Geometry::plane, h, {0.2, 0.1, 0.0}, 0.04)};
    fill(gas, sheared, *domain);
    Stepper().steps(gas, 3, *domain);
    return gas.flattened;
  };
  for (const bool with_body : {false, true}) {
    EXPECT_EQ(flattened(1.0, with_body), 0) << "1 cm/s from cell to cell, of 4400 m/s";
    EXPECT_GT(flattened(2000.0, with_body), 0) << "20 m/s";
  }
}

/// What the gas says when it cannot go on; empty if it can until the end.
std::string end_of(Gas& gas, double end, Domain& domain) {
  for (int n = 0; gas.time < end; ++n) {
    const std::vector<double> before = numbers_of(gas);
    try {
      Stepper().steps(gas, 1, domain);
    } catch (const BodiesMeet& meeting) {
      EXPECT_EQ(numbers_of(gas), before) << "nothing has changed";
      return meeting.what();
    }
  }
  return "";
}
Gas air_around(const std::vector<MovingBody>& bodies, Geometry geometry, Domain& domain) {
  Gas gas = set_up::box(geometry, h, {0, 0, 0}, {40, 20, 0}, {set_up::ideal_gas()}, domain);
  gas.bodies.all = bodies;
  constexpr std::array names = {"low_x", "high_x", "low_y", "high_y"};
  for (std::size_t side = 0; side < names.size(); ++side) gas.edges[side].name = names[side];
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1.2, 1e5, {}};
      },
      domain);
  return gas;
}
MovingBody moving_ball(const std::string& name, const Vector& centre, double radius, const Vector& velocity,
                       Geometry geometry = Geometry::plane) {
  MovingBody body = set_up::ball(geometry, h, centre, radius);
  body.name = name;
  set_up::give_velocity(body, velocity);
  return body;
}

TEST(ABodyThatRunsIntoAWall, EndsTheRunBeforehandAndIsNamed) {
  for (const int ranks : {1, 3})
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      Gas right = air_around({moving_ball("disk", {0.3, 0.1, 0.0}, 0.05, {100.0, 0.0, 0.0})}, Geometry::plane, *domain);
      const std::string message = end_of(right, 0.6e-3, *domain);
      EXPECT_NE(message.find("body disk: it runs into the wall high_x"), std::string::npos) << message;
      // Half a cell before it would touch.
      EXPECT_NEAR(right.time, (0.05 - 0.5 * h) / 100.0, 0.3 * h / 100.0);
      Gas down = air_around({moving_ball("disk", {0.2, 0.08, 0.0}, 0.05, {0.0, -100.0, 0.0})}, Geometry::plane, *domain);
      EXPECT_NE(end_of(down, 0.4e-3, *domain).find("into the wall low_y"), std::string::npos);
    });
}

/// Nothing passes the axis, so nothing is shared across it: the gas leaves along it.
/// Compressed air behind a free plug, both with their sides on faces of cells: the contour of the plug passes these nodes at
/// random, and cells that are open to a billionth get a whole face. Of so many fluids the gas is the first.
Gas plug_before_compressed_air(std::size_t fluids, Domain& domain) {
  constexpr double cell = 1e-3, radius = 0.01, face = 0.04, half_length = 0.003;
  Gas gas = set_up::box(Geometry::axisymmetric, cell, {0, 0, 0}, {20, 80, 0},
                        std::vector<Fluid>(fluids, {"air", equation_of_state::IdealGas{1.4, 718.0}}), domain);
  MovingBody plug = set_up::body_of(
      Geometry::axisymmetric, cell, {0.0, face + half_length, 0.0}, radius,
      [](const Vector& from_centre) { return from_centre[0] < radius && std::abs(from_centre[1]) < half_length; });
  plug.mass = 0.015 / (2.0 * std::numbers::pi), plug.axis = 1;
  gas.bodies.all = {plug};
  fill(
      gas,
      [](const Vector& x, double) {
        return x[0] < radius && x[1] < face ? Filling{0, 500.0, 5e8, {}} : Filling{0, 1.18, 101325.0, {}};
      },
      domain);
  return gas;
}

TEST(APlugWithItsSideOnFacesOfCells, GoesTheSameWayWithAFluidThatIsNowhere) {
  const auto velocity = [](std::size_t fluids) {
    const std::shared_ptr<Domain> domain = single_process();
    Simulation s;
    s.geometry = Geometry::axisymmetric, s.domain = domain, s.gas = plug_before_compressed_air(fluids, *domain);
    Stepper().to(s.gas, 5e-6, *domain);
    const Books books = books_of(s);
    constexpr double gate = 1e-10;  // of the energy, in no book: where a run would end
    EXPECT_LT(std::abs(books.gas->residual().energy), gate * books.gas->state.energy) << fluids << " fluids";
    RecordProperty("residual_" + std::to_string(fluids),
                   std::to_string(1e12 * books.gas->residual().energy / books.gas->state.energy));
    return s.gas.bodies.all[0].state.velocity[1];
  };
  const double of_one = velocity(1), of_two = velocity(2);
  EXPECT_GT(of_one, 30.0);
  // One fluid and several are limited at faces in ways that differ a little.
  EXPECT_NEAR(of_two / of_one, 1.0, 1e-4);
  RecordProperty("velocities", std::to_string(of_one) + " " + std::to_string(of_two));
}

TEST(ARingThatClosesOnTheAxis, PushesItsGasAlongIt) {
  Simulation s;
  s.geometry = Geometry::axisymmetric;
  MovingBody ring = set_up::body_of(Geometry::axisymmetric, h, {0.0, 0.1, 0.0}, 0.2,
                                    [](const Vector& x) { return x[0] > 0.06 && x[0] < 0.12 && std::abs(x[1]) < 0.04; });
  ring.name = "ring", ring.motion.radius = 0.06;
  ring.motion.radial_velocity = [](double) { return -200.0; };
  s.gas = air_around({ring}, Geometry::axisymmetric, *s.domain);
  EXPECT_EQ(end_of(s.gas, 0.29e-3, *s.domain), "");
  const GasBooks books = books_of(s).gas.value();
  EXPECT_LT(std::abs(books.residual().mass[0]), 1e-12 * books.state.mass[0]);
  EXPECT_LT(std::abs(books.residual().energy), 1e-12 * books.state.energy);
}

TEST(TwoBodiesThatMeet, EndTheRunAndAreNamed) {
  for (const int ranks : {1, 3})
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      Gas gas = air_around(
          {moving_ball("anvil", {0.25, 0.1, 0.0}, 0.05, {}), moving_ball("ball", {0.1, 0.1, 0.0}, 0.04, {100.0, 0.0, 0.0})},
          Geometry::plane, *domain);
      const std::string message = end_of(gas, 1e-3, *domain);
      EXPECT_NE(message.find("bodies anvil and ball: they meet"), std::string::npos) << message;
      EXPECT_NEAR(gas.time, 0.06 / 100.0, h / 100.0) << "their surfaces are 6 cells apart";
    });
}

/// Bodies that are built into each other are one for the gas. They take nothing from what others may.
TEST(TwoBodiesThatTouch, MayNotPushIntoEachOtherWhateverOthersAreBuiltInto) {
  for (const int ranks : {1, 3})
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      const auto block = [](const std::string& name, double centre, double u) {
        MovingBody body = set_up::body_of(Geometry::plane, h, {centre, 0.1, 0.0}, 0.05,
                                          [](const Vector& x) { return std::abs(x[0]) < 0.05 && std::abs(x[1]) < 0.05; });
        body.name = name;
        set_up::give_velocity(body, {u, 0.0, 0.0});
        return body;
      };
      const MovingBody core = moving_ball("core", {0.07, 0.1, 0.0}, 0.03, {});
      Gas gas = air_around({core, core, block("left", 0.22, 0.0), block("right", 0.32, -10.0)}, Geometry::plane, *domain);
      const std::string message = end_of(gas, h / 10.0, *domain);
      EXPECT_NE(message.find("bodies left and right: they meet"), std::string::npos) << message;
      EXPECT_LT(gas.time, 0.3 * h / 10.0) << "a third of a cell deep";
    });
}

/// A piston across the tube: with its back beyond the wall, and nearer to it than a body may come.
TEST(APistonThatLeavesAWall, DoesNotMeetIt) {
  const auto domain = single_process();
  for (const double back : {-0.06, 0.4 * h}) {
    MovingBody piston = set_up::body_of(Geometry::plane, h, {0.0, 0.1, 0.0}, 0.2,
                                        [=](const Vector& x) { return x[0] > back && x[0] < 0.1 && std::abs(x[1]) < 0.15; });
    set_up::give_velocity(piston, {100.0, 0.0, 0.0});
    Gas gas = air_around({piston}, Geometry::plane, *domain);
    EXPECT_EQ(end_of(gas, 0.5e-3, *domain), "") << "its back starts at " << back << " m";
  }
}

/// Along a wall, away from it, through it where the body reaches beyond the box, past another body.
TEST(BodiesThatPassBy, GoOn) {
  const auto domain = single_process();
  const auto piston = [](double from, double to, double u) {
    MovingBody body = set_up::body_of(Geometry::plane, h, {0.0, 0.1, 0.0}, 0.6,
                                      [=](const Vector& x) { return x[0] > from && x[0] < to && std::abs(x[1]) < 0.15; });
    set_up::give_velocity(body, {u, 0.0, 0.0});
    return body;
  };
  Gas forth = air_around({piston(-0.3, 0.1, 200.0)}, Geometry::plane, *domain);
  EXPECT_EQ(end_of(forth, 0.5e-3, *domain), "");
  Gas back = air_around({piston(-0.3, 0.15, -150.0)}, Geometry::plane, *domain);
  EXPECT_EQ(end_of(back, 0.5e-3, *domain), "");
  Gas past = air_around({moving_ball("low", {0.1, 0.05, 0.0}, 0.03, {100.0, 0.0, 0.0}),
                         moving_ball("high", {0.3, 0.15, 0.0}, 0.03, {-100.0, 0.0, 0.0})},
                        Geometry::plane, *domain);
  EXPECT_EQ(end_of(past, 1.5e-3, *domain), "");
}

TEST(MemoryOfTheGas, CountsBodiesAndTheClassicState) {
  const auto domain = single_process();
  const std::size_t cells = 40 * 20;
  const Gas alone = air_around({}, Geometry::plane, *domain);
  const Gas with_body = air_around({moving_ball("disk", {0.2, 0.1, 0.0}, 0.05, {})}, Geometry::plane, *domain);
  EXPECT_GT(with_body.bytes(), alone.bytes() + cells * sizeof(double)) << "the open part of each cell";
  Gas classic = set_up::box(Geometry::plane, h, {0, 0, 0}, {40, 20, 0}, {set_up::ideal_gas()}, *domain);
  classic.classic.emplace();
  fill(
      classic,
      [](const Vector&, double) {
        return Filling{0, 1.2, 1e5, {}};
      },
      *domain);
  EXPECT_GE(classic.bytes(), alone.bytes() + cells * 5 * sizeof(double)) << "mass, volume, energy, two of momentum";
}

}  // namespace
}  // namespace brisance::simulator::gas
