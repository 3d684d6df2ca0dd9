#include "models/shear_modulus/shear_modulus.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/models/exact_derivatives.hpp"

namespace brisance::shear_modulus {
namespace {

// The references were computed from the published formulas by a separate program, in double precision.
constexpr double round_off = 1e-12;
void expect_close(double value, double reference, double tolerance = round_off) {
  EXPECT_LE(std::abs(value - reference), tolerance * std::abs(reference)) << value << " is not " << reference;
}

const VarshniChenGray varshni_copper{.zero_temperature_value = 47.7e9, .D = 3e9, .T0 = 180.0};
const VarshniChenGray varshni_hy100{.zero_temperature_value = 71.46e9, .D = 2.9e9, .T0 = 204.0};
const VarshniChenGray varshni_al6061{.zero_temperature_value = 28e9, .D = 4.5e9, .T0 = 294.0};
const SteinbergCochranGuinan steinberg_copper{
    .ambient_value = 47.7e9, .A = 28.3e-12, .B = 3.77e-4, .reference_temperature = 300.0};
const NadalLePoac nadal_copper{.zero_temperature_value = 50.7e9, .A = 28e-12, .zeta = 0.04, .C = 0.057, .atomic_mass = 63.55};
const PrestonTonksWallace preston_tantalum{.zero_temperature_value = 72.2e9, .A = 14.5e-12, .alpha = 0.23};

Arguments<double> copper_at(double temperature, double pressure = 0.0, double compression = 1.0) {
  return {.temperature = temperature,
          .melting_temperature = 1356.0,
          .pressure = pressure,
          .density = 8930.0 * compression,
          .compression = compression};
}

template <class F>
void for_each(F&& f) {
  f(Constant{45e9}, "constant");
  f(varshni_copper, "Varshni-Chen-Gray");
  f(steinberg_copper, "Steinberg-Cochran-Guinan");
  f(nadal_copper, "Nadal-Le Poac");
  f(preston_tantalum, "Preston-Tonks-Wallace");
}

TEST(ShearModulus, IsFiniteAndNotNegativeWithItsSlopesForAnyFiniteState) {
  using Number = Dual<double, 3>;
  for_each([](const auto& law, const char* name) {
    for (double temperature : {-1e300, -1.0, 0.0, 1e-300, 0.1, 300.0, 1355.9, 1356.0, 1400.0, 1410.24, 2000.0, 1e300})
      for (double melting : {0.0, 1356.0, 1e300})
        for (double pressure : {-1e15, -1e10, 0.0, 1e11, 1e15})
          for (double compression : {0.0, 0.5, 1.0, 3.0, 1e10}) {
            const Number mu = law(Arguments<Number>{Number::variable(temperature, 0), melting, Number::variable(pressure, 1),
                                                    8930.0, Number::variable(compression, 2)});
            ASSERT_TRUE(std::isfinite(mu.value) && mu.value >= 0.0) << name << ' ' << temperature << ' ' << pressure;
            for (double slope : mu.derivative)
              ASSERT_TRUE(std::isfinite(slope)) << name << ' ' << temperature << ' ' << pressure;
          }
  });
}

TEST(ShearModulus, NeverRisesWithTemperatureNorFallsWithPressure) {
  for_each([](const auto& law, const char* name) {
    for (double pressure : {-5e9, 0.0, 20e9}) {
      double colder = 1e300;
      for (double temperature = 0.0; temperature < 1356.0; temperature += 6.0) {
        const double mu = law(copper_at(temperature, pressure));
        ASSERT_LE(mu, colder) << name << " at " << temperature << " K";
        ASSERT_LE(mu, law(copper_at(temperature, pressure + 1e9))) << name << " at " << temperature << " K";
        colder = mu;
      }
    }
  });
}

TEST(VarshniChenGray, ReferenceValues) {
  expect_close(varshni_copper(copper_at(300.0)), 44050892354.51739);
  expect_close(varshni_copper(copper_at(600.0)), 39125112259.46976);
  expect_close(varshni_copper(copper_at(40.0)), 47666298621.89254);
  expect_close(varshni_hy100(copper_at(300.0)), 68482213462.7124);
  expect_close(varshni_hy100(copper_at(600.0)), 64298579441.93749);
  expect_close(varshni_al6061(copper_at(300.0)), 25296414356.448532);
  expect_close(varshni_al6061(copper_at(600.0)), 20883307658.44097);
}

TEST(VarshniChenGray, HasItsFullModulusAtZeroTemperatureAndFallsAsALineWhenHot) {
  EXPECT_EQ(varshni_copper(copper_at(0.0)), 47.7e9);
  EXPECT_EQ(varshni_copper(copper_at(0.2)), 47.7e9);
  // D/(exp(x) - 1) = D (1/x - 1/2 + x/12 - ...): at T = 10 T0 the slope is -D/T0 to x^2/12.
  const double slope = (varshni_copper(copper_at(1801.0)) - varshni_copper(copper_at(1799.0))) / 2.0;
  EXPECT_NEAR(slope / (-3e9 / 180.0), 1.0, 1e-3);
}

TEST(SteinbergCochranGuinan, ReferenceValues) {
  EXPECT_EQ(steinberg_copper(copper_at(300.0)), 47.7e9);
  expect_close(steinberg_copper(copper_at(900.0, 20e9, 1.12)), 62907593333.87442);
}

TEST(SteinbergCochranGuinan, TensionTakesHalfTheModulusAtMost) {
  expect_close(steinberg_copper(copper_at(900.0, -30e9)), 13060260000.0);
  EXPECT_EQ(steinberg_copper(copper_at(900.0, -30e9)), steinberg_copper(copper_at(900.0, -60e9)));
  EXPECT_LT(steinberg_copper(copper_at(300.0, -5e9)), 47.7e9);
}

TEST(SteinbergCochranGuinan, ReferenceTemperatureIsThatOfTheSourceUnlessGiven) {
  for_each_parameter<SteinbergCochranGuinan>([](const auto& parameter) {
    if (parameter.name == "reference_temperature") {
      EXPECT_EQ(parameter.default_value, 300.0);
    } else {
      EXPECT_FALSE(parameter.default_value.has_value()) << parameter.name;
    }
  });
}

TEST(NadalLePoac, ReferenceValues) {
  expect_close(nadal_copper(copper_at(300.0)), 45632355677.61557);
  expect_close(nadal_copper(copper_at(1300.0)), 28740155153.263893);
  const Arguments<double> squeezed{
      .temperature = 900.0, .melting_temperature = 1800.0, .pressure = 20e9, .density = 10000.0, .compression = 1.12};
  expect_close(nadal_copper(squeezed), 59677636851.708664);
}

TEST(NadalLePoac, KeepsHalfItsVibrationalModulusAtMeltingAndLosesItAcrossTheWidth) {
  expect_close(nadal_copper(copper_at(1356.0)), 13897123833.28779);
  expect_close(nadal_copper(copper_at(1380.0)), 29.918609869797418, 1e-10);  // the exponent of 21 has fewer digits
  EXPECT_LT(nadal_copper(copper_at(1.04 * 1356.0)), 1.0);
  EXPECT_LT(nadal_copper(copper_at(3000.0)), 1.0);
}

TEST(PrestonTonksWallace, ReferenceValues) {
  const Arguments<double> at{
      .temperature = 1000.0, .melting_temperature = 4000.0, .pressure = 30e9, .density = 18000.0, .compression = 1.1};
  expect_close(preston_tantalum(at), 96723950642.49684);
}

TEST(PrestonTonksWallace, LosesTheFractionAlphaUpToMelting) {
  EXPECT_EQ(preston_tantalum(copper_at(0.0)), 72.2e9);
  expect_close(preston_tantalum(copper_at(1356.0)), 0.77 * 72.2e9);
}

TEST(ShearModulus, DualNumbersGiveTheDerivativesOfEveryLaw) {
  for_each([](const auto& law, const char* name) {
    SCOPED_TRACE(name);
    test::expect_exact_derivatives<5>(
        [&]<class Real>(const std::array<Real, 5>& x) {
          return law(Arguments<Real>{x[0] * x[1], x[1], x[2], x[3], x[4]});
        },
        {test::Range{0.02, 0.99}, test::Range{900.0, 3000.0}, test::Range{-10e9, 100e9}, test::Range{5000.0, 20000.0},
         test::Range{0.8, 1.6}});
  });
}

}  // namespace
}  // namespace brisance::shear_modulus
