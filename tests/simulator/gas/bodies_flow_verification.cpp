// Flow about and through bodies: a piston, a wedge in supersonic flow, a chamber with a slot.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/simulator/gas/bodies_set_up.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

/// A body of the lattice points in a box that `inside` holds, whole ones.
MovingBody body_in(double cell_size, const Vector& lower, const Vector& upper,
                   const std::function<bool(const Vector&)>& inside = {}) {
  MovingBody body;
  body.name = "body";
  const double spacing = 0.5 * cell_size;
  constexpr int samples = 4;
  const auto first = [&](std::size_t a) { return static_cast<int>(std::floor(lower[a] / spacing)); };
  const auto last = [&](std::size_t a) { return static_cast<int>(std::ceil(upper[a] / spacing)); };
  for (int j = first(1); j < last(1); ++j)
    for (int i = first(0); i < last(0); ++i) {
      int filled = 0;
      for (int n = 0; n < samples * samples; ++n) {
        const Vector x = {(i + (n % samples + 0.5) / samples) * spacing, (j + (n / samples + 0.5) / samples) * spacing, 0.0};
        filled += x[0] > lower[0] && x[0] < upper[0] && x[1] > lower[1] && x[1] < upper[1] && (!inside || inside(x));
      }
      if (filled == 0) continue;
      body.places.push_back({(i + 0.5) * spacing, (j + 0.5) * spacing, 0.0});
      body.volumes.push_back(filled * spacing * spacing / (samples * samples));
    }
  return body;
}

TEST(Piston, CompressesAdiabatically) {
  // From 1 to 0.5, at a Mach number of 0.04; it fills the tube behind it.
  constexpr int cells = 40, width = 4;
  constexpr double h = 1.0 / cells, velocity = 0.05, near = 0.01, round_off = 1e-12;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {cells + 10, width, 0}, {set_up::ideal_gas()}, *domain);
  const double drawn = 1.0 + 0.3 * h;
  MovingBody piston = body_in(h, {drawn, 0.0, 0.0}, {drawn + 5.0 * h, width * h, 0.0});
  set_up::give_velocity(piston, {-velocity, 0.0, 0.0});
  gas.bodies.all = {piston};
  gas.edges[1] = set_up::beyond(EdgeKind::non_reflecting, Filling{0, 1.0, 1.0, {}});
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1.0, 1.0, {}};
      },
      *domain);
  struct Held {
    double mass = 0.0, energy = 0.0, pressure = 0.0, volume = 0.0;
  };
  const auto held = [&](double to) {
    Held in;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      const double V = open_part(gas, c.block, c.number) * c.volume;
      if (c.centre[0] > to || V == 0.0) return;
      in.mass += V * c.density, in.pressure += V * c.pressure, in.volume += V;
    });
    in.pressure /= in.volume;
    return in;
  };
  const Held before = held(drawn + 2.0 * h);
  const double start = before.volume / (width * h);  // its particles show it to a part of their width
  EXPECT_NEAR(start, drawn, 0.1 * h);
  Stepper().to(gas, 0.5 / velocity, *domain);
  const Held after = held(drawn + 2.0 * h - 0.5);
  EXPECT_NEAR(after.mass, before.mass, round_off);
  EXPECT_NEAR(after.volume / (width * h), start - 0.5, 0.01 * h);
  const double exact = std::pow(start / (start - 0.5), 1.4);
  EXPECT_NEAR(after.pressure / exact, 1.0, near);
  // The work of the piston; the gas behind follows it, with less pressure by rho c u.
  const double work = width * h / 0.4 * (exact * (start - 0.5) - start), behind = 1.0 - std::sqrt(1.4) * velocity;
  EXPECT_NEAR(-gas.bodies.all[0].work.value() / (work - 0.5 * width * h * behind), 1.0, near);
  RecordProperty("pressure", std::to_string(after.pressure / exact - 1.0));
}

TEST(Wedge, TurnsASupersonicFlowByAnObliqueShock) {
  // Mach 2, 10 degrees: the shock stands at 39.31 degrees and raises the pressure by 1.7066.
  constexpr int cells = 80;
  constexpr double h = 1.0 / cells, turn = 10.0 * std::numbers::pi / 180.0, apex = 0.2;
  constexpr double exact_angle = 39.31, near = 0.5, exact_ratio = 1.7066, near_ratio = 0.02;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {cells, 60, 0}, {set_up::ideal_gas()}, *domain);
  gas.bodies.all = {
      body_in(h, {apex, 0.0, 0.0}, {1.2, 1.0, 0.0}, [&](const Vector& x) { return x[1] < (x[0] - apex) * std::tan(turn); })};
  const Filling stream = {0, 1.4, 1.0, {2.0, 0.0, 0.0}};
  gas.edges = {set_up::beyond(EdgeKind::inflow, stream), set_up::beyond(EdgeKind::non_reflecting, stream), set_up::wall(),
               set_up::beyond(EdgeKind::non_reflecting, stream)};
  fill(
      gas, [&](const Vector&, double) { return stream; }, *domain);
  Stepper().to(gas, 1.5, *domain);
  std::vector<std::vector<double>> pressure(cells, std::vector<double>(60, 0.0));
  double behind = 0.0, count = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    if (open_part(gas, c.block, c.number) == 0.0) return;
    pressure[static_cast<std::size_t>(c.index[0])][static_cast<std::size_t>(c.index[1])] = c.pressure;
    const double along = c.centre[0] - apex, up = c.centre[1] / along;
    if (along > 0.5 && up > 0.3 && up < 0.6) behind += c.pressure, count += 1.0;
  });
  // Heights where the pressure is half-way, and the line through them.
  const double middle = 0.5 * (1.0 + exact_ratio);
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < cells; ++i) {
    const double x = (static_cast<double>(i) + 0.5) * h;
    if (x < apex + 0.3 || x > 0.9) continue;
    for (std::size_t j = 59; j > 0; --j)
      if (pressure[i][j - 1] >= middle && pressure[i][j] < middle) {
        const double y =
            (static_cast<double>(j) - 0.5 + (pressure[i][j - 1] - middle) / (pressure[i][j - 1] - pressure[i][j])) * h;
        n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
        break;
      }
  }
  const double angle = std::atan((n * sxy - sx * sy) / (n * sxx - sx * sx)) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(angle, exact_angle, near);
  EXPECT_NEAR(behind / count, exact_ratio, near_ratio);
  // Force on the wedge: the pressure behind the shock on the part of its slope that is in the box.
  const double rise = (1.0 - apex) * std::tan(turn);
  RecordProperty("angle", std::to_string(angle) + ", pressure " + std::to_string(behind / count) + ", force over exact " +
                              std::to_string(gas.bodies.all[0].force[0] / (exact_ratio * rise)));
}

/// Flow through a slot between two rounded plates over the choked flow of one dimension.
double flow_through_slot(double slot_in_cells) {
  constexpr int half_height = 18, length = 50;
  constexpr double h = 1.0 / 36, round = 8.0 * h, offset = 0.23 * h;
  const double slot = slot_in_cells * h, wall = 1.0;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::plane, h, {0, -half_height, 0}, {length, half_height, 0}, {set_up::ideal_gas()}, *domain);
  // Each plate ends in a half disk, so that the flow follows it to the throat.
  gas.bodies.all = {body_in(h, {wall - round, -1.0, 0.0}, {wall + round, 1.0, 0.0}, [&](const Vector& x) {
    const double up = std::abs(x[1] - offset) - 0.5 * slot;
    return up > round || std::hypot(x[0] - wall, up - round) < round;
  })};
  const Filling outside = {0, 1.0, 1.0, {}}, inside = {0, 10.0, 10.0, {}};
  gas.edges[1] = set_up::beyond(EdgeKind::non_reflecting, outside);
  fill(
      gas, [&](const Vector& x, double) { return x[0] < wall ? inside : outside; }, *domain);
  struct Held {
    double mass = 0.0, energy = 0.0, volume = 0.0;
  };
  const auto held = [&] {
    Held in;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      const double open = open_part(gas, c.block, c.number), V = open * c.volume;
      if (c.centre[0] > wall || V == 0.0) return;
      in.mass += V * c.density, in.energy += open * gas.content.cell(c.block, Content::energy, c.number), in.volume += V;
    });
    return in;
  };
  Stepper stepper;
  const double gamma = 1.4, choked = std::pow(2.0 / (gamma + 1.0), (gamma + 1.0) / (2.0 * (gamma - 1.0)));
  const double start = 0.8, end = 1.6;  // some waves' ways through the chamber
  stepper.to(gas, start, *domain);
  const double before = held().mass;
  double expected = 0.0;
  while (gas.time < end) {
    const Held in = held();
    const double then = gas.time, density = in.mass / in.volume, pressure = (gamma - 1.0) * in.energy / in.volume;
    stepper.to(gas, std::min(end, gas.time + 0.05), *domain);
    expected += (gas.time - then) * slot * choked * density * std::sqrt(gamma * pressure / density);
  }
  return (before - held().mass) / expected;
}

TEST(Slot, OfAFewCellsPassesTheChokedFlow) {
  constexpr double near = 0.05;
  for (const double cells : {4.0, 2.0}) {
    const double flow = flow_through_slot(cells);
    EXPECT_NEAR(flow, 1.0, near) << cells << " cells";
    RecordProperty("slot_" + std::to_string(static_cast<int>(cells)), std::to_string(flow));
  }
  if (std::getenv("BRISANCE_LONG_TESTS"))  // slots that the smeared volume hardly sees: on record, no claim
    for (const double cells : {1.0, 0.5})
      RecordProperty("slot_of_tenths_" + std::to_string(static_cast<int>(10 * cells)),
                     std::to_string(flow_through_slot(cells)));
}

}  // namespace
}  // namespace brisance::simulator::gas
