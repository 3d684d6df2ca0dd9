// The comparison with measured curves, on curves whose answer is known.

#include "driver/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/scratch.hpp"

namespace brisance::driver {
namespace {

// Johnson-Cook's flow stress of the material file below, written out once more.
constexpr double A = 324e6, B = 114e6, n = 0.42, C = 0.002, m = 1.34, room = 298, melting = 925;
double johnson_cook(double strain, double rate, double temperature) {
  const double theta = std::max((temperature - room) / (melting - room), 0.0);
  return (A + B * std::pow(strain, n)) * (1 + C * std::log(std::max(rate, 1.0))) * (1 - std::pow(theta, m));
}

/// A comparison of made-up tests, `factor` times what the law gives, with that law.
Comparison comparison_of(double factor, const std::string& protocol) {
  const fs::path folder = scratch();
  std::ofstream csv(folder / "tests.csv");
  csv << "test,who,temperature [K],strain_rate [1/s],pressure [MPa],plastic_strain,stress [MPa]\n";
  const auto add = [&](const char* name, const char* who, double temperature, double rate, double pressure) {
    for (const double strain : {0.0001, 0.005, 0.05, 0.2})
      csv << name << ',' << who << ',' << temperature << ',' << rate << ',' << pressure << ',' << strain << ','
          << factor * johnson_cook(strain, rate, temperature) * 1e-6 << '\n';
  };
  add("cold", "one", 200, 0.01, 0);
  add("warm", "one", 500, 0.01, 0);
  add("fast", "two", 298, 1000, 0);
  add("pressed", "two", 298, 0.01, 300);
  csv.close();
  std::ofstream(folder / "case.toml")
      << "title = \"made up\"\n[experiment]\nfile = \"tests.csv\"\ntest = \"test\"\nauthor = \"who\"\ntemperature = "
         "\"temperature\"\n"
         "strain_rate = \"strain_rate\"\npressure = \"pressure\"\nplastic_strain = \"plastic_strain\"\nstress = \"stress\"\n"
         "[protocol]\n"
      << protocol
      << "[[model]]\nname = \"law\"\nmaterial = \"" BRISANCE_SOURCE_DIR
         "/data/materials/aluminium_6061_t6_johnson_cook.toml\"\n";
  return read_comparison(folder / "case.toml");
}

// The plastic strain rate is that of the test less the elastic part, one or two percent, which the logarithm makes 2e-5 of the
// stress; steps of 2e-4 interpolate the steep start of the curve to 1e-4.
constexpr double curve_tolerance = 3e-4;

TEST(Comparison, FindsNoErrorInCurvesOfItsOwnLaw) {
  const Comparison comparison = comparison_of(1.0, "adiabatic_from = \"1e9 1/s\"\n");
  ASSERT_EQ(comparison.tests.size(), 4u);
  const Results results = compare(comparison);
  for (std::size_t t = 0; t < 4; ++t) {
    const Errors e = errors_of(results[0][t].points);
    EXPECT_EQ(e.points, 3) << "the point below 0.2 % does not count";
    EXPECT_LT(e.relative_rms, curve_tolerance) << comparison.tests[t].name << results[0][t].note;
  }
}

TEST(Comparison, OrdersTestsByTemperatureThenRate) {
  std::vector<std::string> names;
  for (const driver::Test& test : comparison_of(1.0, "").tests) names.push_back(test.name);
  EXPECT_EQ(names, (std::vector<std::string>{"cold", "pressed", "fast", "warm"}));
}

TEST(Comparison, MeasuresAKnownError) {
  const Comparison comparison = comparison_of(0.8, "adiabatic_from = \"1e9 1/s\"\nsmallest_plastic_strain = 0\n");
  const Results results = compare(comparison);
  const GroupErrors all = errors_of_group(
      comparison.tests, results[0], [](const driver::Test&) { return true; }, 0.01);
  EXPECT_EQ(all.tests, 4);
  EXPECT_EQ(all.all_points.points, 8);
  EXPECT_NEAR(all.all_points.relative_mean, 0.25, 2 * curve_tolerance);
  EXPECT_NEAR(all.all_points.relative_rms, 0.25, 2 * curve_tolerance);
  EXPECT_EQ(all.within_10_percent, 0);
  const GroupErrors two = errors_of_group(
      comparison.tests, results[0], [](const driver::Test& t) { return t.author == "two"; }, 0.1);
  EXPECT_EQ(two.tests, 2);
  EXPECT_EQ(two.all_points.points, 2);
}

TEST(Comparison, HeatsFastTestsOnly) {
  const Comparison comparison = comparison_of(1.0, "adiabatic_from = \"1 1/s\"\n");
  const Results results = compare(comparison);
  EXPECT_LT(errors_of(results[0][0].points).relative_rms, curve_tolerance);
  EXPECT_LT(errors_of(results[0][2].points).relative_mean, -5e-3);  // "fast" softens by its own heat
}

TEST(Comparison, KeepsOnlyTheRowsAskedFor) {
  EXPECT_EQ(read_comparison(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/point_6061_t6.toml").tests.size(), 95u);
  EXPECT_LT(read_comparison(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/point_6061_t6.toml", {"experiment.where.author=Lee"})
                .tests.size(),
            10u);
  EXPECT_THROW(
      read_comparison(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/point_6061_t6.toml", {"experiment.where.author=nobody"}),
      InputError);
}

}  // namespace
}  // namespace brisance::driver
