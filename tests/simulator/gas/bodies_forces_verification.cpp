// Bodies in gas that has weight, and in gas that burns: columns at rest, buoyancy, explosives in rigid casings.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/simulator/gas/charge.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

// Gravity --------------------------------------------------------------------------------------------------------------

constexpr int cells_across = 48;
constexpr double h = 1.0 / cells_across, gravity = 0.5;  // of a gas with p = rho = 1: a column as high as 2 scales of height

/// A column of gas of one temperature around a body, at rest as the scheme has it: each cell carries half of its weight, and of
/// that of the next.
Gas column_around(MovingBody body, Geometry geometry, Domain& domain) {
  const bool round = geometry == Geometry::axisymmetric;
  std::array<int, 3> upper{cells_across, cells_across, 0};
  if (round) upper[0] = cells_across / 2;
  if (geometry == Geometry::three_dimensional) upper[2] = cells_across;
  Gas gas = set_up::box(geometry, h, {0, 0, 0}, upper, {set_up::ideal_gas()}, domain);
  gas.gravity[1] = -gravity;
  gas.bodies.all = {std::move(body)};
  const double half = 0.5 * gravity * h, ratio = (1.0 - half) / (1.0 + half);
  fill(
      gas,
      [&](const Vector& x, double) {
        const double p = std::pow(ratio, std::floor(x[1] / h));
        return Filling{0, p, p, {}};
      },
      domain);
  return gas;
}

/// Weight of the gas that would be where the body is: of a disk of the plane, of a ball per radian.
double displaced_weight(Geometry geometry, const Vector& centre, double radius) {
  const double x = gravity * radius, density = std::exp(-gravity * (centre[1] - 0.5 * h));
  return geometry == Geometry::plane ? density * 2.0 * std::numbers::pi * radius * std::cyl_bessel_i(1.0, x)
                                     : density * 2.0 * (x * std::cosh(x) - std::sinh(x)) / (gravity * gravity);
}
/// The same of what the gas sees of the body.
double seen_weight(const Gas& gas) {
  double sum = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    sum += gravity * (1.0 - open_part(gas, c.block, c.number)) * c.volume * std::exp(-gravity * (c.centre[1] - 0.5 * h));
  });
  return sum;
}
double fastest_over_sound(const Gas& gas) {
  double fastest = 0.0;
  set_up::for_each_gas_cell(
      gas, [&](const set_up::Cell& c, double) { fastest = std::max(fastest, magnitude(c.velocity) / c.sound_speed); });
  return fastest;
}

TEST(GasWithWeight, StaysAtRestAroundABodyAndLiftsItByWhatItDisplaces) {
  constexpr double radius = 10.3 * h;
  for (const Geometry geometry : {Geometry::plane, Geometry::axisymmetric}) {
    const std::string where = geometry == Geometry::plane ? "plane" : "axisymmetric";
    const auto domain = single_process();
    const Vector centre{geometry == Geometry::plane ? 0.503 : 0.0, 0.487, 0.0};
    Gas gas = column_around(set_up::ball(geometry, h, centre, radius), geometry, *domain);
    const double seen = seen_weight(gas), displaced = displaced_weight(geometry, centre, radius);
    Stepper().to(gas, 2.0, *domain);  // sound passes the box twice
    const MovingBody& body = gas.bodies.all[0];
    // Neighbourhoods of small cells are laid as columns of one entropy, this one has one temperature.
    EXPECT_LT(fastest_over_sound(gas), 1e-3) << where;
    constexpr double of_the_contour = 0.01, of_the_column = 1e-4;
    EXPECT_NEAR(body.force[1] / displaced, 1.0, of_the_contour) << where;
    EXPECT_NEAR(body.force[1] / seen, 1.0, of_the_column) << where;
    set_up::expect_closed_books(gas, *domain, where);
    RecordProperty(where, std::to_string(fastest_over_sound(gas)) + ", lift over weight " +
                              std::to_string(body.force[1] / displaced) + ", as seen " + std::to_string(body.force[1] / seen));
  }
}

TEST(GasWithWeight, CarriesABodyOfItsOwnWeightAndLetsAHeavierOneSink) {
  const auto domain = single_process();
  const auto with_mass = [&](double over_displaced) {
    MovingBody disk = set_up::ball(Geometry::plane, h, {0.5, 0.5, 0.0}, 8.3 * h);
    disk.axis = 1, disk.mass = 1.0;
    Gas gas = column_around(disk, Geometry::plane, *domain);
    gas.bodies.all[0].mass = over_displaced * seen_weight(gas) / gravity;
    return gas;
  };
  Gas carried = with_mass(1.0);
  Stepper().to(carried, 1.0, *domain);
  EXPECT_LT(std::abs(carried.bodies.all[0].state.displacement[1]), 1e-4 * 0.5 * gravity) << "of a free fall";
  set_up::expect_closed_books(carried, *domain, "carried");
  Gas sinking = with_mass(2.0);
  Stepper().steps(sinking, 1, *domain);
  EXPECT_NEAR(sinking.bodies.all[0].state.acceleration[1] / (-0.5 * gravity), 1.0, 1e-4);
}

// Reaction -------------------------------------------------------------------------------------------------------------

/// Velocity of a detonation along a tube of explosive with walls of bodies (or of the box) at half a width from its middle,
/// given in cells.
double velocity_in_tube(double half_width, bool bodies, Domain& domain) {
  constexpr double cell = 0.25e-3;
  constexpr int length = 160, lit = 12;
  const int half = static_cast<int>(std::ceil(half_width)) + (bodies ? 2 : 0);
  Gas gas = set_up::box(Geometry::plane, cell, {0, -half, 0}, {length, half, 0},
                        {{"explosive", reactant}, {"products", products}}, domain);
  gas.burns.push_back({"detonation", 0, 1, jwl_plus_plus(0.2e-6), {}});
  gas.edges[0] = set_up::beyond(EdgeKind::inflow, {1, cj.density, cj.pressure, {cj.particle_velocity, 0.0, 0.0}});
  for (const double side : {-1.0, 1.0})
    if (bodies)
      gas.bodies.all.push_back(set_up::body_of(
          Geometry::plane, cell, {0.5 * length * cell, 0.0, 0.0}, 0.5 * (length + 8) * cell,
          [&](const Vector& x) { return side * x[1] > half_width * cell && std::abs(x[1]) < (half + 2) * cell; }));
  fill(
      gas,
      [&](const Vector& x, double) {
        return x[0] < lit * cell ? Filling{1, cj.density, cj.pressure, {cj.particle_velocity, 0.0, 0.0}}
                                 : Filling{0, products.reference_density, 1e5, {}};
      },
      domain);
  // Where the pressure falls through a level in the middle of the tube.
  const auto front = [&] {
    std::vector<double> p(length);
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      if (c.index[1] == 0) p[static_cast<std::size_t>(c.index[0])] = c.pressure;
    });
    std::size_t i = length - 1;
    while (i-- > 1 && p[i] < 0.5 * cj.pressure) continue;
    return (static_cast<double>(i) + 0.5 + (p[i] - 0.5 * cj.pressure) / (p[i] - p[i + 1])) * cell;
  };
  Stepper stepper;
  const auto reach = [&](double place) {
    while (front() < place * length * cell) stepper.steps(gas, 1, domain);
    return std::pair{front(), gas.time};
  };
  const auto [x0, t0] = reach(0.5);
  const auto [x1, t1] = reach(0.85);
  return (x1 - x0) / (t1 - t0);
}

TEST(Detonation, RunsThroughATubeOfBodiesAsBetweenWallsOfTheBox) {
  const auto domain = single_process();
  const double between_walls = velocity_in_tube(3.0, false, *domain), cut = velocity_in_tube(3.4, true, *domain);
  EXPECT_NEAR(cut / between_walls, 1.0, 1e-3);
  EXPECT_NEAR(cut / cj.velocity, 1.0, 0.01);
  RecordProperty("velocities", std::to_string(between_walls / cj.velocity) + " " + std::to_string(cut / cj.velocity));
}

TEST(Detonation, OfAChargeInAClosedCaseKeepsItsBooks) {
  const reaction::ProgramBurn program{8000.0, 0.0, 3.0, heat, {}};
  for (const Reaction& law : {Reaction(jwl_plus_plus(0.1e-6)), Reaction(program)}) {
    const auto domain = single_process();
    Gas gas = charge_in_case(20, law, *domain);
    Stepper().to(gas, 2e-6, *domain);
    const Totals all = totals(gas, *domain), burn = burned(gas, *domain)[0];
    EXPECT_GT(burn.mass[1], 0.99 * gas.initial.mass[0]);
    EXPECT_NEAR(burn.energy, heat * burn.mass[1], set_up::round_off * burn.energy);
    for (std::size_t r = 0; r < 3; ++r)
      EXPECT_NEAR(all.mass[r] - burn.mass[r], gas.initial.mass[r], set_up::round_off * gas.initial.mass[0]) << r;
    EXPECT_NEAR(all.energy - burn.energy, gas.initial.energy, set_up::round_off * all.energy);
    Vector rest = all.momentum - gas.initial.momentum;
    for (const Totals& through : passed(gas, *domain)) rest = rest - through.momentum;
    EXPECT_LT(magnitude(rest), set_up::round_off * std::sqrt(2.0 * all.energy * gas.initial.mass[0]));
    set_up::for_each_gas_cell(gas, [&](const set_up::Cell& c, double) {
      if (magnitude(c.centre) > 16.0 * gas.cells.cell_size) {
        EXPECT_NEAR(c.pressure / 1e5, 1.0, 1e-9) << "nothing leaks";
      }
    });
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
