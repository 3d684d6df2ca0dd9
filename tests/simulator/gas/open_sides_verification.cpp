// What flows out of the box through sides that are open.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/simulator/gas/bodies_set_up.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

constexpr EdgeKind outlets[] = {EdgeKind::pressure, EdgeKind::non_reflecting};
std::string name_of(EdgeKind kind) {
  return std::string(choices<EdgeKind>[static_cast<std::size_t>(kind)]);
}

/// Largest change of a uniform stream that leaves through the high sides of a box into other states.
struct Way {
  int dimensions = 1;
  bool implicit = false, with_body = false;  // the body: a plate that the stream glides along
};
double change_of_stream(const Way& way, EdgeKind kind, double outside) {
  constexpr int steps = 100, cells = 20;
  constexpr double h = 1.0 / cells, c = 1.1832159566199232;  // sound
  const auto domain = single_process();
  Gas gas = set_up::box(way.dimensions == 1 ? Geometry::planar_1d : Geometry::plane, h, {}, {cells, cells, 0},
                        {set_up::ideal_gas()}, *domain);
  gas.implicit = way.implicit, gas.acoustic_courant = 2.0;
  const Filling stream{0, 1.0, 1.0, {1.5 * c, way.dimensions == 1 || way.with_body ? 0.0 : 1.3 * c, 0.0}};
  for (std::size_t s = 0; s < gas.edges.size(); ++s)
    gas.edges[s] = s % 2 == 0 ? set_up::beyond(EdgeKind::inflow, stream)
                              : set_up::beyond(kind, Filling{0, outside, outside, {-1.0, 2.0, 0.0}});
  if (way.with_body) {
    gas.edges[2] = gas.edges[3] = set_up::wall();
    gas.bodies.all = {set_up::body_of(Geometry::plane, h, {0.5, 0.0, 0.0}, 1.0, [](const Vector& x) { return x[1] < 0.23; })};
  }
  fill(
      gas, [&](const Vector&, double) { return stream; }, *domain);
  Stepper().steps(gas, steps, *domain);
  double worst = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& at) {
    if (open_part(gas, at.block, at.number) == 0.0) return;
    worst =
        std::max({worst, std::abs(at.density - 1.0), std::abs(at.pressure - 1.0), magnitude(at.velocity - stream.velocity)});
  });
  return worst;
}

TEST(OutflowFasterThanSound, StaysWhatItIsWhateverLiesBeyond) {
  constexpr double round_off = 1e-12;
  for (const Way& way : {Way{1}, Way{2}, Way{1, true}, Way{2, true}, Way{2, false, true}})
    for (const EdgeKind kind : outlets)
      for (const double outside : {0.01, 5.0, 100.0})
        EXPECT_LT(change_of_stream(way, kind, outside), round_off)
            << way.dimensions << "-D, " << name_of(kind) << ", " << outside << " Pa beyond"
            << (way.implicit ? ", implicit" : "") << (way.with_body ? ", with a body" : "");
}

/// Pressure next to the end of a tube that opens into a thin gas, from half time on.
struct AtTheEnd {
  double mean = 0.0, roughest = 0.0;  // Pa; roughest: change from step to step
};
AtTheEnd opened_tube(EdgeKind kind, double mach, const Filling& outside) {
  constexpr int cells = 100;
  constexpr double end = 0.8;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0}, {set_up::ideal_gas()}, *domain);
  const Filling inside{0, 1.4, 1.0, {mach, 0.0, 0.0}};  // the speed of sound is 1
  gas.edges = {set_up::beyond(EdgeKind::inflow, inside), set_up::beyond(kind, outside)};
  fill(
      gas, [&](const Vector&, double) { return inside; }, *domain);
  AtTheEnd result;
  Stepper stepper;
  double before = 0.0, sum = 0.0;
  int count = 0;
  for (; gas.time < end; stepper.steps(gas, 1, *domain)) {
    if (gas.time < 0.5 * end) continue;
    const double pressure = set_up::profile(gas).back().pressure;
    if (count > 0) result.roughest = std::max(result.roughest, std::abs(pressure - before));
    before = pressure, sum += pressure, ++count;
  }
  result.mean = sum / count;
  return result;
}

TEST(OpenEnd, IsChokedByThinGasBeyond) {
  // A wave runs back into the tube behind which the gas leaves at the speed of its sound: x/t = 0 of the Riemann problem.
  constexpr double close = 0.01, steady = 1e-4;
  for (const EdgeKind kind : outlets)
    for (const double mach : {0.0, 0.5, 0.9, 0.99, 1.01}) {
      const Filling outside{0, 0.05, 0.01, {}};
      const double exact = ExactRiemann({1.4, mach, 1.0}, {0.05, 0.0, 0.01}).at(0.0).pressure;
      const AtTheEnd found = opened_tube(kind, mach, outside);
      const std::string where = name_of(kind) + ", Mach " + std::to_string(mach);
      EXPECT_NEAR(found.mean / exact, 1.0, close) << where;
      EXPECT_LT(found.roughest, steady) << where;
      RecordProperty(where, std::to_string(found.mean / exact));
    }
}

TEST(OpenEnd, HasThePressureBeyondWhereTheGasLeavesSlowerThanSound) {
  constexpr double close = 1e-3;
  for (const double mach : {0.0, 0.5})
    for (const double pressure : {0.9, 1.1}) {
      const AtTheEnd found = opened_tube(EdgeKind::pressure, mach, Filling{0, 1.4, pressure, {}});
      EXPECT_NEAR(found.mean / pressure, 1.0, close) << "Mach " << mach << ", " << pressure << " Pa";
    }
}

TEST(PressureBeyond, DrivesTheShockOfAPistonIntoGasAtRest) {
  // What enters has the density of the cell that it enters, which the start leaves a little thin.
  constexpr int cells = 200;
  constexpr double close = 0.04, h = 1.0 / cells, gamma = 1.4;
  for (const double pressure : {2.0, 5.0, 10.0}) {
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::planar_1d, h, {}, {cells, 0, 0}, {set_up::ideal_gas()}, *domain);
    gas.edges[0] = set_up::beyond(EdgeKind::pressure, Filling{0, 1.0, pressure, {}});
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.0, 1.0, {}};
        },
        *domain);
    // Of the shock (Toro, ch. 3.1); it ends half-way.
    const double density = ((gamma + 1.0) * pressure + gamma - 1.0) / ((gamma - 1.0) * pressure + gamma + 1.0);
    const double velocity = (pressure - 1.0) * std::sqrt(2.0 / ((gamma + 1.0) * pressure + gamma - 1.0));
    const double end = 0.5 * (density - 1.0) / (density * velocity);
    Stepper().to(gas, end, *domain);
    const double entered = totals(gas, *domain).mass[0] - 1.0;
    EXPECT_NEAR(entered / (density * velocity * end), 1.0, close) << pressure << " Pa";
    RecordProperty("entered_" + std::to_string(static_cast<int>(pressure)),
                   std::to_string(entered / (density * velocity * end)));
  }
}

/// Where the pressure beyond an inflow rises and falls and its velocity does not, half of it runs in as a wave of sound and
/// half of it stands at the side.
TEST(Inflow, SendsHalfOfAPressureThatPulsesAloneIn) {
  constexpr double c = 1.1832159566199232, speed = 0.03, height = 1e-3, wave_length = 0.5, end = 0.75;
  constexpr double frequency = (c + speed) / wave_length;
  for (const std::string way : {"of waves", "of waves, with a body", "implicit"}) {
    const bool with_body = way == "of waves, with a body", implicit = way == "implicit";
    double before = 0.0;
    for (const int cells : {100, 200}) {
      const double h = 1.0 / cells;
      const auto domain = single_process();
      Gas gas =
          set_up::box(with_body ? Geometry::plane : Geometry::planar_1d, h, {}, {cells, 4, 0}, {set_up::ideal_gas()}, *domain);
      const Filling stream{0, 1.0, 1.0, {speed, 0.0, 0.0}};
      gas.edges[1] = set_up::beyond(EdgeKind::non_reflecting, stream);
      gas.edges[0] = gas.edges[1];
      gas.edges[0].kind = EdgeKind::inflow;
      gas.edges[0].beyond = [=](const Vector&, double t) {
        return Filling{0, 1.0, 1.0 + 2.0 * height * std::sin(2.0 * std::numbers::pi * frequency * t), {speed, 0.0, 0.0}};
      };
      gas.implicit = implicit, gas.acoustic_courant = 0.5;
      // It has to do with nothing, but makes the step that with bodies.
      if (with_body) gas.bodies.all = {set_up::ball(Geometry::plane, h, {0.5, 10.0, 0.0}, 3.0 * h, 0.0)};
      fill(
          gas, [&](const Vector&, double) { return stream; }, *domain);
      Stepper().to(gas, end, *domain);
      double squares = 0.0;
      int count = 0;
      set_up::for_each_cell(gas, [&](const set_up::Cell& at) {
        const double behind = end - at.centre[0] / (c + speed);
        if (behind < 0.1 / frequency) return;  // the start of the wave is a kink
        const double exact = height * std::sin(2.0 * std::numbers::pi * frequency * behind);
        squares += (at.pressure - 1.0 - exact) * (at.pressure - 1.0 - exact), ++count;
      });
      const double error = std::sqrt(squares / count) / height;
      // Of the height of the wave; of second order, but for the steepening of the wave itself, 0.2 %.
      constexpr double of_the_scheme = 0.02;
      EXPECT_LT(error, of_the_scheme) << cells << " cells, steps " << way;
      RecordProperty(way + ", " + std::to_string(cells), std::to_string(error));
      // The solve knows the pressure in the middle of the last cell, not at its side: first order.
      if (cells > 100) {
        EXPECT_LT(error, (implicit ? 0.7 : 0.5) * before);
      }
      before = error;
    }
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
