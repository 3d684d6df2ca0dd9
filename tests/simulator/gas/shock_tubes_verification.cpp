// One gas on a line: shock tubes against exact solutions, waves of entropy, contacts, and flows too rich for a closed form
// against a fine grid of the comparison solver.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "simulator/gas/fan.hpp"
#include "simulator/gas/muscl_hllc.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/exact_solutions.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

/// Sums of a few hundred rounded numbers.
constexpr double round_off = 1e-13;

Filling filling(const GasState& w) {
  return {0, w.density, w.pressure, {w.velocity, 0.0, 0.0}};
}

struct Tube {
  GasState left, right;
  double diaphragm, time;
  bool closed = true;  // otherwise the gas at the ends flows on

  Gas filled(int cells, Domain& domain) const {
    Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0}, {set_up::ideal_gas()}, domain);
    if (!closed)
      gas.edges = {set_up::beyond(EdgeKind::inflow, filling(left)), set_up::beyond(EdgeKind::inflow, filling(right))};
    fill(
        gas, [&](const Vector& x, double) { return filling(x[0] < diaphragm ? left : right); }, domain);
    return gas;
  }
};

/// Errors of density, velocity and pressure at the end of a tube's run, which keeps mass and energy if the tube is closed.
GasState errors(const Tube& tube, int cells) {
  const auto domain = single_process();
  Gas gas = tube.filled(cells, *domain);
  const Totals before = totals(gas, *domain);
  Stepper().to(gas, tube.time, *domain);
  const Totals after = totals(gas, *domain);
  if (tube.closed) {
    EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off) << cells << " cells";
    EXPECT_LT(set_up::relative_change(before.mass[0], after.mass[0]), round_off) << cells << " cells";
  }
  const ExactRiemann exact(tube.left, tube.right);
  const GasState e =
      set_up::mean_errors(gas, [&](double from, double to) { return exact.average(from, to, tube.time, tube.diaphragm); });
  testing::Test::RecordProperty("density_" + std::to_string(cells), std::to_string(e.density));
  return e;
}

void expect_errors(const Tube& tube, const std::vector<std::pair<int, double>>& most) {
  for (const auto& [cells, error] : most) EXPECT_LE(errors(tube, cells).density, error) << cells << " cells";
}

// Tubes ----------------------------------------------------------------------------------------------------------------

const Tube sod = {{1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 0.5, 0.2};

TEST(ShockTube, OfSodConvergesWithFirstOrder) {
  // What conservative ICE with the MC limiter reaches.
  const std::vector<std::pair<int, double>> most = {{100, 5.5e-3}, {200, 3.0e-3}, {400, 1.6e-3}, {800, 8.0e-4}};
  std::vector<double> found;
  for (const auto& [cells, error] : most) {
    found.push_back(errors(sod, cells).density);
    EXPECT_LE(found.back(), error) << cells << " cells";
  }
  // Shocks converge with order 1, contacts with 2/3 if nothing steepens them.
  EXPECT_GT(std::log2(found.front() / found.back()) / 3.0, 0.85);
}

TEST(ShockTube, OfStrongShocksConverges) {
  expect_errors({{1.0, 0.0, 1000.0}, {1.0, 0.0, 0.01}, 0.5, 0.012}, {{100, 0.10}, {200, 0.06}, {400, 0.03}, {800, 0.015}});
}

TEST(ShockTube, OfPressureRatio100000Converges) {
  expect_errors({{10.0, 0.0, 1e5}, {1.0, 0.0, 1.0}, 0.3, 0.0024}, {{100, 0.10}, {200, 0.06}, {400, 0.03}, {800, 0.015}});
}

TEST(ShockTube, LeavesAlmostNothingBetweenPartingGases) {
  const Tube parting = {{1.0, -2.0, 0.4}, {1.0, 2.0, 0.4}, 0.5, 0.15, false};
  expect_errors(parting, {{100, 0.010}});
  const auto domain = single_process();
  Gas gas = parting.filled(400, *domain);
  Stepper().to(gas, parting.time, *domain);
  for (const GasState& w : set_up::profile(gas)) {
    EXPECT_GT(w.density, 0.0);
    EXPECT_GT(w.pressure, 0.0);
  }
}

TEST(ShockTube, CollisionAndSlowContactConverge) {
  const double least_ratio = std::pow(4.0, 2.0 / 3.0);  // the order of a contact that nothing steepens
  for (const Tube& tube : {Tube{{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 0.4, 0.035, false},
                           Tube{{1.0, -19.59745, 1000.0}, {1.0, -19.59745, 0.01}, 0.8, 0.012, false},
                           Tube{{1.0, 0.75, 1.0}, {0.125, 0.0, 0.1}, 0.3, 0.2, false}})
    EXPECT_GT(errors(tube, 100).density / errors(tube, 400).density, least_ratio);
}

// Waves of entropy and contacts ----------------------------------------------------------------------------------------

TEST(EntropyWave, ArrivesWithSecondOrder) {
  // Of the MC limiter at these grids, with a fifth for what schemes differ by.
  const std::vector<std::pair<int, double>> known = {{25, 4.69e-3}, {50, 1.22e-3}, {100, 3.05e-4}, {200, 7.3e-5}};
  constexpr double scheme = 1.2;
  const EntropyWave wave;
  std::vector<double> found;
  for (const auto& [cells, error] : known) {
    const auto domain = single_process();
    const double h = 1.0 / cells;
    Gas gas = set_up::box(Geometry::planar_1d, h, {}, {cells, 0, 0}, {set_up::ideal_gas()}, *domain);
    gas.edges = {set_up::around(), set_up::around()};
    fill(
        gas, [&](const Vector& x, double) { return filling(wave.average(x[0] - 0.5 * h, x[0] + 0.5 * h, 0.0)); }, *domain);
    const Totals before = totals(gas, *domain);
    Stepper().to(gas, 1.0, *domain);
    const Totals after = totals(gas, *domain);
    EXPECT_LT(set_up::relative_change(before.momentum[0], after.momentum[0]), round_off);
    EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off);
    found.push_back(set_up::mean_errors(gas, [&](double from, double to) { return wave.average(from, to, 1.0); }).density);
    EXPECT_LE(found.back(), scheme * error) << cells << " cells";
    RecordProperty("density_" + std::to_string(cells), std::to_string(found.back()));
  }
  for (std::size_t n = 1; n < found.size(); ++n) EXPECT_GE(std::log2(found[n - 1] / found[n]), 1.9) << "refinement " << n;
}

TEST(Contact, MovesWithoutAPressureWave) {
  constexpr double no_wave = 1e-12;
  for (const double u : {0.0, 1.0, -1.0}) {
    const Tube tube = {{1.0, u, 1.0}, {10.0, u, 1.0}, 0.5, 0.3, false};
    const auto domain = single_process();
    Gas gas = tube.filled(100, *domain);
    Stepper().to(gas, tube.time, *domain);
    for (const GasState& w : set_up::profile(gas)) {
      ASSERT_NEAR(w.velocity, u, no_wave);
      ASSERT_NEAR(w.pressure, 1.0, no_wave);
    }
  }
}

TEST(Contact, AtRestStaysAsSharpAsItWas) {
  const Tube tube = {{1.0, 0.0, 1.0}, {10.0, 0.0, 1.0}, 0.5, 0.3};
  const auto domain = single_process();
  Gas gas = tube.filled(100, *domain);
  Stepper().to(gas, tube.time, *domain);
  const std::vector<GasState> cells = set_up::profile(gas);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_DOUBLE_EQ(cells[i].density, i < 50 ? 1.0 : 10.0) << "cell " << i;
  }
}

// Fans -----------------------------------------------------------------------------------------------------------------

TEST(Fan, HasAtTheOldPlaceOfItsFaceTheStateOfTheExactSolution) {
  constexpr StiffenedGas air{1.4, 0.0}, water{4.4, 6e8};
  // Slower at its tail than its sound; faster; a liquid; one that is gone from the face, and a shallow one, which have none.
  for (const auto& [gas, head, pressure, there] : {std::tuple{air, GasState{1.0, 0.0, 1e5}, 4e4, true},
                                                   {air, {1.0, 0.0, 1e5}, 1e3, true},
                                                   {air, {1.0, 200.0, 1e5}, 2e4, true},
                                                   {water, {1200.0, 100.0, 9e8}, 1e5, true},
                                                   {air, {1.0, 380.0, 1e5}, 1e3, false},
                                                   {air, {1.0, 0.0, 1e5}, 6e4, false}}) {
    const GasState beyond{1e-3, 0.0, pressure};
    const std::optional<GasState> found = state_at_old_place(head, gas.gamma, gas.p_infinity, pressure);
    ASSERT_EQ(found.has_value(), there) << head.velocity << " m/s, " << pressure << " Pa";
    if (!there) continue;
    // The fan alone: the other side moves with its tail, at its pressure.
    const double sound = gas.sound_speed(head), half = 0.5 * (gas.gamma - 1.0);
    const double left = std::pow((pressure + gas.p_infinity) / (head.pressure + gas.p_infinity), half / gas.gamma);
    const GasState with_the_tail{beyond.density, head.velocity + sound / half * (1.0 - left), pressure};
    const GasState exact = ExactRiemann(head, gas, with_the_tail, gas).at(0.0);
    EXPECT_NEAR(found->density, exact.density, 1e-9 * exact.density);
    EXPECT_NEAR(found->velocity, exact.velocity, 1e-9 * sound);
    EXPECT_NEAR(found->pressure, exact.pressure, 1e-9 * (head.pressure + gas.p_infinity));
  }
}

// Against a fine grid of the comparison solver ---------------------------------------------------------------------------

/// Mean absolute difference of the density, over the cells.
double difference(const Gas& coarse, const Euler1D& fine) {
  const std::vector<GasState> cells = set_up::profile(coarse);
  const std::size_t parts = fine.cells.size() / cells.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double mean = 0.0;
    for (std::size_t k = 0; k < parts; ++k) mean += fine.cells[i * parts + k].density / static_cast<double>(parts);
    sum += std::abs(cells[i].density - mean) / static_cast<double>(cells.size());
  }
  return sum;
}

constexpr int fine_grid = 3200;

TEST(ShuOsher, WavesBehindTheShockConverge) {
  constexpr double time = 1.8;
  Euler1D fine;
  fine.lower = -5.0, fine.upper = 5.0, fine.at_lower = fine.at_upper = {EndKind::transmissive};
  fine.cells.resize(fine_grid);
  for (int i = 0; i < fine_grid; ++i)
    fine.cells[static_cast<std::size_t>(i)] = cell_average(shu_osher_start, fine.face(i), fine.face(i + 1));
  advance_to(fine, time);
  // Of conservative ICE with the MC limiter.
  constexpr double scheme = 1.2;
  for (const auto& [cells, known] : {std::pair{200, 0.077}, {400, 0.043}, {800, 0.015}}) {
    const auto domain = single_process();
    const double h = 10.0 / cells;
    Gas gas = set_up::box(Geometry::planar_1d, h, {-cells / 2, 0, 0}, {cells / 2, 0, 0}, {set_up::ideal_gas()}, *domain);
    const FillingFunction start = [&](const Vector& x, double) {
      return filling(cell_average(shu_osher_start, x[0] - 0.5 * h, x[0] + 0.5 * h));
    };
    gas.edges = {set_up::beyond(EdgeKind::inflow, filling(shu_osher_start(-5.0))), set_up::beyond(EdgeKind::inflow, start)};
    fill(gas, start, *domain);
    Stepper().to(gas, time, *domain);
    const double found = difference(gas, fine);
    EXPECT_LE(found, scheme * known) << cells << " cells";
    RecordProperty("density_" + std::to_string(cells), std::to_string(found));
    if (cells == 400) {
      // Peaks of the short waves behind the shock.
      const auto rise = [](auto&& density, double from, double to, int n, double lower, double width) {
        double low = 1e300, high = 0.0;
        for (int i = 0; i < n; ++i) {
          const double x = lower + (i + 0.5) * width;
          if (x > from && x < to) low = std::min(low, density(i)), high = std::max(high, density(i));
        }
        return high - low;
      };
      const std::vector<GasState> p = set_up::profile(gas);
      const double waves = rise([&](int i) { return p[static_cast<std::size_t>(i)].density; }, 0.6, 2.2, cells, -5.0, h);
      const double reference =
          rise([&](int i) { return fine.cells[static_cast<std::size_t>(i)].density; }, 0.6, 2.2, fine_grid, -5.0, fine.width());
      EXPECT_GT(waves / reference, 0.8);
      RecordProperty("amplitude", std::to_string(waves / reference));
    }
  }
}

TEST(WoodwardColella, BlastsCollideAsOnAFineGrid) {
  constexpr double time = 0.038;
  Euler1D fine;
  fine.cells.resize(fine_grid);
  for (int i = 0; i < fine_grid; ++i) fine.cells[static_cast<std::size_t>(i)] = woodward_colella_start(fine.centre(i));
  advance_to(fine, time);
  double reference_peak = 0.0;
  for (const GasState& w : fine.cells) reference_peak = std::max(reference_peak, w.density);
  std::vector<double> found;
  for (const int cells : {200, 400, 800}) {
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0}, {set_up::ideal_gas()}, *domain);
    fill(
        gas, [](const Vector& x, double) { return filling(woodward_colella_start(x[0])); }, *domain);
    const Totals before = totals(gas, *domain);
    Stepper().to(gas, time, *domain);
    const Totals after = totals(gas, *domain);
    EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off);
    EXPECT_LT(set_up::relative_change(before.mass[0], after.mass[0]), round_off);
    found.push_back(difference(gas, fine));
    double peak = 0.0;
    for (const GasState& w : set_up::profile(gas)) peak = std::max(peak, w.density);
    if (cells == 800) {
      EXPECT_NEAR(peak / reference_peak, 1.0, 0.05);
    }
    RecordProperty("peak_" + std::to_string(cells), std::to_string(peak) + " of " + std::to_string(reference_peak));
    RecordProperty("density_" + std::to_string(cells), std::to_string(found.back()));
  }
  // Contacts, which converge with order 2/3, make up most of this flow.
  EXPECT_GT(found[0] / found[1], std::pow(2.0, 2.0 / 3.0));
  EXPECT_GT(found[1] / found[2], std::pow(2.0, 2.0 / 3.0));
}

}  // namespace
}  // namespace brisance::simulator::gas
