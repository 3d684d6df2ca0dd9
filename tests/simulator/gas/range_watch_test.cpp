// The watch on the densities that equations of state declare.

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/range_watch.hpp"
#include "tests/simulator/gas/set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

/// Products of PBX 9501; the law is declared up to three times the density of the explosive.
constexpr equation_of_state::JonesWilkinsLee products = {1840.0, 852.4e9, 18.02e9, 4.55, 1.3, 0.38, 1000.0, 10.2e9};
constexpr double highest = 3.0 * 1840.0;

/// Two streams of products that meet in the middle of a line, or of a plane; an ideal gas, whose law knows no bounds, beside
/// them.
struct Streams {
  double speed;  // m/s
  Geometry geometry = Geometry::planar_1d;

  Gas filled(Domain& domain) const {
    const int across = geometry == Geometry::plane ? 12 : 0;
    Gas gas = set_up::box(geometry, 1e-3, {-150, 0, 0}, {150, across, 0},
                          {{"products", products}, {"gas", equation_of_state::IdealGas{1.4, 718.0}}}, domain);
    fill(
        gas,
        [this](const Vector& x, double) {
          if (std::abs(x[0]) > 0.1) return Filling{1, 10.0, 20e9, {}};
          return Filling{0, 2500.0, 40e9, {x[0] < 0.0 ? speed : -speed, 0.0, 0.0}};
        },
        domain);
    return gas;
  }
};

/// The same watch, cell by cell.
void look(const Gas& gas, std::int64_t& count, double& densest) {
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    if (set_up::fraction(gas, c, 0) < 1e-3) return;
    const auto at = [&](int quantity) {
      return gas.content.cell(c.block, Content::of(gas.dimensions(), 0, quantity), c.number);
    };
    const double density = at(Content::mass) / at(Content::volume);
    count += density > highest ? 1 : 0, densest = std::max(densest, density);
  });
}

/// Behind the shocks of two equal streams the gas is at rest: what they must have compressed it to.
double density_of_collision(double speed) {
  const double rho = 2500.0, p = 40e9;
  const double e = equation_of_state::energy_at_pressure(EquationOfState(products), rho, p);
  double low = rho * 1.001, high = rho * 5.0;
  for (int n = 0; n < 200; ++n) {
    // Rankine and Hugoniot: e2 - e = (p2 + p)/2 (1/rho - 1/rho2), speed^2 = (p2 - p)(1/rho - 1/rho2).
    const double rho2 = 0.5 * (low + high), dv = 1.0 / rho - 1.0 / rho2, p2 = p + speed * speed / dv;
    const double e2 = e + 0.5 * (p2 + p) * dv;
    (products.pressure(rho2, e2) < p2 ? low : high) = rho2;
  }
  return 0.5 * (low + high);
}

TEST(RangeWatch, CountsEveryCellAndStepOutsideAndKeepsTheWorst) {
  const auto domain = single_process();
  constexpr double fast = 9000.0;
  ASSERT_GT(density_of_collision(fast), 1.05 * highest);
  for (const Geometry geometry : {Geometry::planar_1d, Geometry::plane}) {
    Gas gas = Streams{fast, geometry}.filled(*domain);
    std::int64_t count = 0;
    double densest = 0.0;
    for (int n = 0; n < 180; ++n) Stepper().steps(gas, 1, *domain), look(gas, count, densest);
    ASSERT_GT(count, 20);
    const std::vector<RangeReport> reports = range_reports(gas, *domain);
    ASSERT_EQ(reports.size(), 1u) << "an ideal gas is declared everywhere";
    const OutsideRange& worst = reports[0].outside;
    EXPECT_EQ(reports[0].fluid, "products");
    EXPECT_EQ(reports[0].range.highest, highest);
    EXPECT_EQ(worst.cell_steps, count);
    EXPECT_NEAR(worst.density, densest, 1e-12 * densest) << "one is a quotient of eight at once";
    EXPECT_NEAR(worst.density, density_of_collision(fast), 0.1 * worst.density) << "overshoot at most";
    EXPECT_LT(std::abs(worst.place[0]), 0.03) << "between the shocks";
    EXPECT_GT(worst.time, 0.0);
    EXPECT_LE(worst.time, gas.time);
    const std::string words = in_words(reports[0], gas.dimensions());
    EXPECT_NE(words.find("products was outside of the densities"), std::string::npos) << words;
    EXPECT_NE(words.find("above 5520"), std::string::npos) << words;
  }
}

TEST(RangeWatch, IsSilentWhereALawHolds) {
  const auto domain = single_process();
  constexpr double slow = 1000.0;
  ASSERT_LT(density_of_collision(slow), 0.8 * highest);
  Gas gas = Streams{slow}.filled(*domain);
  Stepper().steps(gas, 100, *domain);
  EXPECT_TRUE(range_reports(gas, *domain).empty());
}

TEST(RangeWatch, SeesWhatTheGasIsFilledWith) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 1e-3, {0, 0, 0}, {40, 0, 0}, {{"products", products}}, *domain);
  fill(
      gas,
      [](const Vector& x, double) {
        return Filling{0, x[0] < 0.01 ? 1.1 * highest : highest, 500e9, {}};
      },
      *domain);
  const std::vector<RangeReport> reports = range_reports(gas, *domain);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].outside.cell_steps, 10);
  EXPECT_EQ(reports[0].outside.time, 0.0);
  EXPECT_EQ(reports[0].outside.place[0], 0.5e-3) << "of equals the first";
}

TEST(RangeWatch, SeesTheSameForAnyNumberOfRanksAndAfterARestart) {
  const auto report_of = [](int ranks, int restart_after) {
    OutsideRange found;
    std::mutex one_at_a_time;
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      Gas gas = Streams{9000.0, Geometry::plane}.filled(*domain);
      Stepper().steps(gas, restart_after, *domain);
      Gas other = Streams{9000.0, Geometry::plane}.filled(*domain);
      restore(other, numbers_of(gas), *domain);
      Stepper().steps(other, 50 - restart_after, *domain);
      const std::vector<RangeReport> reports = range_reports(other, *domain);
      const std::lock_guard lock(one_at_a_time);
      found = reports.at(0).outside;
    });
    return found;
  };
  const OutsideRange one = report_of(1, 0);
  for (const auto& [ranks, restart] : {std::pair{1, 30}, {2, 0}, {3, 40}, {5, 20}}) {
    const OutsideRange other = report_of(ranks, restart);
    EXPECT_EQ(other.cell_steps, one.cell_steps) << ranks;
    EXPECT_EQ(other.density, one.density) << ranks;
    EXPECT_EQ(other.time, one.time) << ranks;
    EXPECT_EQ(other.place, one.place) << ranks;
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
