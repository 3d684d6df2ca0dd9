// Calibration: parameters that made the data are found again, and the intervals mean what they say.

#include "driver/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "driver/follow.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance::driver {
namespace {

Material copper_with(const FlowStress& flow_stress) {
  Material m = samples::copper_johnson_cook();
  m.shear_modulus = shear_modulus::VarshniChenGray{.zero_temperature_value = 47.7e9, .D = 3e9, .T0 = 180.0};
  m.flow_stress = flow_stress;
  return m;
}
Material johnson_cook() {
  return copper_with(flow_stress::sets::johnson_cook_copper);
}
Material threshold_stress() {
  return copper_with(flow_stress::sets::threshold_copper);
}

struct Conditions {
  double temperature, strain_rate;
};
constexpr Conditions matrix_of_tests[] = {{298.0, 1e-3}, {298.0, 1.0},  {298.0, 3e3}, {450.0, 0.1},
                                          {450.0, 2e3},  {600.0, 1e-3}, {700.0, 1e3}, {800.0, 0.1}};

/// A normal deviate by Box and Muller's transformation: the same on every machine, unlike std::normal_distribution.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : random_(seed) {}
  double operator()() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53, v = static_cast<double>(random_() >> 11) * 0x1p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  std::mt19937_64 random_;
};

/// Eight curves of twelve points, with normal errors of a standard deviation relative to the stress.
Calibration synthetic(const Material& truth, double deviation, std::uint64_t seed, std::vector<FitParameter> parameters) {
  Calibration c;
  c.file.material = truth;
  c.parameters = std::move(parameters);
  c.data = "synthetic";
  c.residual = Residual::relative;
  Noise noise(seed);
  for (const Conditions& at : matrix_of_tests) {
    Test test{"", "", at.temperature, at.strain_rate, 0.0, {}, {}};
    for (int i = 1; i <= 12; ++i) test.plastic_strain.push_back(0.004 * i * i);
    test.stress = flow_curve(truth, test, c.protocol, test.plastic_strain);
    for (double& stress : test.stress) stress *= 1.0 + deviation * noise();
    c.tests.push_back(test);
  }
  return c;
}

std::vector<FitParameter> johnson_cook_parameters() {
  return {{"flow_stress.A", 20e6, 300e6, 150e6},
          {"flow_stress.B", 50e6, 800e6, 500e6},
          {"flow_stress.n", 0.05, 1.0, 0.6},
          {"flow_stress.C", 0.0, 0.1, 0.01},
          {"flow_stress.m", 0.3, 3.0, 0.8}};
}
std::vector<FitParameter> threshold_stress_parameters() {
  return {{"flow_stress.athermal_stress", 0.0, 150e6, 20e6},
          {"flow_stress.a0", 500e6, 6e9, 3.5e9, true},
          {"flow_stress.saturation_stress", 300e6, 2e9, 1.2e9},
          {"flow_stress.saturation_barrier", 0.05, 1.0, 0.5, true},
          {"flow_stress.evolving_barrier", 0.5, 5.0, 2.5, true}};
}
std::vector<double> values(Material material, const std::vector<FitParameter>& parameters) {
  std::vector<double> result;
  for (const FitParameter& p : parameters) result.push_back(*find_parameter(material, p.key));
  return result;
}

// Data without errors leave only the tolerance of the search, 1e-9 of a parameter's range, and its propagation.
constexpr double search_tolerance = 1e-5;

TEST(Calibration, FindsJohnsonCookParametersFromExactData) {
  const Material truth = johnson_cook();
  const auto expected = values(truth, johnson_cook_parameters());
  const Fit fit = calibrate(synthetic(truth, 0.0, 1, johnson_cook_parameters()));
  EXPECT_TRUE(fit.converged);
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(fit.estimates[k].value / expected[k], 1.0, search_tolerance);
}

TEST(Calibration, FindsThresholdStressParametersFromExactData) {
  const Material truth = threshold_stress();
  const auto expected = values(truth, threshold_stress_parameters());
  const Fit fit = calibrate(synthetic(truth, 0.0, 1, threshold_stress_parameters()));
  EXPECT_TRUE(fit.converged);
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(fit.estimates[k].value / expected[k], 1.0, search_tolerance);
}

/// A 95 % interval that is right misses the truth in 5 of 100 samples on average. Of each parameter's intervals 90 to 98 % must
/// cover it. In 100 samples that share has a standard deviation of 2.2 %, so that some parameter of ten falls outside by chance
/// alone; 300 samples have 1.3 %, which leaves more than two on either side. (In 4000 samples 94.5 to 95.1 % of the intervals
/// of the threshold stress parameters cover the truth, in 2000 samples 94.6 to 95.8 % of those of Johnson and Cook's.)
void expect_coverage(const Material& truth, const std::vector<FitParameter>& parameters) {
  constexpr int samples = 300;
  constexpr double least = 90.0, most = 98.0, deviation = 0.02;
  const auto expected = values(truth, parameters);
  std::vector<int> covered(parameters.size(), 0);
  double deviation_found = 0.0;
  for (int sample = 0; sample < samples; ++sample) {
    const Fit fit = calibrate(synthetic(truth, deviation, static_cast<std::uint64_t>(sample) + 1, parameters));
    deviation_found += fit.residual_deviation / samples;
    for (std::size_t k = 0; k < expected.size(); ++k)
      covered[k] += fit.estimates[k].lower_95 <= expected[k] && expected[k] <= fit.estimates[k].upper_95;
  }
  EXPECT_NEAR(deviation_found / deviation, 1.0, 0.02);  // its own deviation is 1/sqrt(2 91 300) = 0.4 %
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double share = 100.0 * covered[k] / samples;
    std::printf("%s: %.1f %% of the intervals cover the truth\n", parameters[k].key.c_str(), share);
    EXPECT_GE(share, least) << parameters[k].key;
    EXPECT_LE(share, most) << parameters[k].key;
  }
}

TEST(Calibration, IntervalsOfJohnsonCookParametersCoverTheTruth) {
  expect_coverage(johnson_cook(), johnson_cook_parameters());
}
TEST(Calibration, IntervalsOfThresholdStressParametersCoverTheTruth) {
  expect_coverage(threshold_stress(), threshold_stress_parameters());
}

TEST(Calibration, SaysWhichParametersTheTestsDoNotTell) {
  // One rate, one temperature: the rate factor and the strengths are one product.
  Calibration c = synthetic(johnson_cook(), 0.01, 5, johnson_cook_parameters());
  c.tests = {c.tests[1], c.tests[1]};
  c.tests[0].strain_rate = c.tests[1].strain_rate = 0.5;  // isothermal at the reference temperature, below the reference rate
  const Fit fit = calibrate(c);
  EXPECT_TRUE(fit.estimates[0].identifiable);
  EXPECT_TRUE(fit.estimates[1].identifiable);
  EXPECT_FALSE(fit.estimates[3].identifiable);  // C
  EXPECT_FALSE(fit.estimates[4].identifiable);  // m
  EXPECT_TRUE(std::isinf(fit.estimates[3].standard_error));
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_NE(fit.warnings.front().find("flow_stress.C, flow_stress.m"), std::string::npos) << fit.warnings.front();
}

TEST(Calibration, SaysWhichParametersAreAtABound) {
  auto parameters = johnson_cook_parameters();
  parameters[3].upper = 0.015;  // the truth is 0.025
  const Fit fit = calibrate(synthetic(johnson_cook(), 0.01, 6, parameters));
  EXPECT_TRUE(fit.estimates[3].at_bound);
  EXPECT_EQ(fit.estimates[3].value, 0.015);
  EXPECT_FALSE(fit.estimates[0].at_bound);
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_NE(fit.warnings.front().find("flow_stress.C is at its upper bound"), std::string::npos) << fit.warnings.front();
}

TEST(Calibration, FewerPointsThanParametersAreRefused) {
  Calibration c = synthetic(johnson_cook(), 0.0, 1, johnson_cook_parameters());
  c.tests.resize(1);
  c.tests[0].plastic_strain.resize(5), c.tests[0].stress.resize(5);
  EXPECT_THROW(calibrate(c), std::invalid_argument);
}

TEST(FlowCurve, AgreesWithTheUpdateInUniaxialStress) {
  // The curve leaves out the elastic part of the strain rate: for copper, hardening over Young's modulus is up to 2 % once
  // yield is past, and the stress depends on the logarithm of the rate; steps of the update add an error of first order.
  constexpr double neglected = 1e-3;
  for (const Material& material : {johnson_cook(), threshold_stress()}) {
    for (const Conditions& at : {Conditions{298.0, 3e3}, Conditions{298.0, 1e-3}}) {
      const driver::Test test{"", "", at.temperature, at.strain_rate, 0.0, {}, {}};
      const Protocol protocol;
      LoadingPath path;
      path.temperature = at.temperature;
      path.heat = at.strain_rate >= protocol.adiabatic_from ? Heat::adiabatic : Heat::isothermal;
      path.strain_increment = 1e-4;
      path.output.every = 1;
      PathSegment load;
      load.velocity_gradient.xx = -at.strain_rate;
      SymmetricTensor<double> yy, zz;
      yy.yy = 1.0, zz.zz = 1.0;
      load.free = {{to_tensor(yy), yy, {}, 0.0}, {to_tensor(zz), zz, {}, 0.0}};
      load.until = Until{"plastic_strain", 0.3};
      path.segments.push_back(load);
      History history(material, path.output);
      follow(material, path, history);
      const auto &strain = history.record().find("plastic_strain")->values,
                 &stress = history.record().find("stress_xx")->values;
      std::vector<double> wanted, expected;
      for (std::size_t i = 0; i < strain.size(); i += 100)
        if (strain[i] > 0.01) wanted.push_back(strain[i]), expected.push_back(std::fabs(stress[i]));
      ASSERT_GT(wanted.size(), 10u);
      const auto curve = flow_curve(material, test, protocol, wanted);
      for (std::size_t i = 0; i < curve.size(); ++i) EXPECT_NEAR(curve[i] / expected[i], 1.0, neglected) << wanted[i];
    }
  }
}

TEST(Calibration, ReadsACaseAndWritesAMaterialThatReadsBack) {
  const Calibration c = read_calibration(BRISANCE_SOURCE_DIR "/data/cases/calibrate_6061_t6_johnson_cook.toml", {"starts=1"});
  EXPECT_GT(c.tests.size(), 50u);
  const Fit fit = calibrate(c);
  EXPECT_TRUE(fit.converged);
  const std::string text = write_material(fit.file);
  EXPECT_NE(text.find("calibrated: "), std::string::npos);
  InputFile written = InputFile::from_text(text, "calibrated.toml");
  TableReader top = written.top();
  Material back = read_material(top).material;
  written.finish();
  for (std::size_t k = 0; k < c.parameters.size(); ++k)
    EXPECT_EQ(*find_parameter(back, c.parameters[k].key), fit.estimates[k].value);
}

}  // namespace
}  // namespace brisance::driver
