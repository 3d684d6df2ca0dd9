#include "models/specific_heat/specific_heat.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/models/exact_derivatives.hpp"

namespace brisance::specific_heat {
namespace {

// The references were computed from the published formulas by a separate program, in double precision.
constexpr double round_off = 1e-12;
void expect_close(double value, double reference, double tolerance = round_off) {
  EXPECT_LE(std::abs(value - reference), tolerance * std::abs(reference)) << value << " is not " << reference;
}

const Polynomial polynomial{
    .coefficients = {300.0, 0.4, -2e-4, 1e-7}, .lowest_temperature = 100.0, .highest_temperature = 1500.0};

template <class F>
void for_each(F&& f) {
  f(Constant{477.0}, "constant");
  f(polynomial, "polynomial");
  f(SteelLambda{}, "steel, with the lambda peak");
  f(SteelGoto{}, "steel of Goto");
  f(Copper{}, "copper");
}

TEST(SpecificHeat, IsFiniteAndPositiveWithItsSlopeForAnyFiniteTemperature) {
  using Number = Dual<double>;
  for_each([](const auto& law, const char* name) {
    for (double temperature : {-1e300, -1.0, 0.0, 1e-9, 10.0, 26.0, 200.0, 270.0, 1039.9, 1040.0, 1040.1, 5000.0, 1e300}) {
      const Number cp = law(Number::variable(temperature));
      ASSERT_TRUE(std::isfinite(cp.value) && cp.value > 0.0) << name << " at " << temperature;
      ASSERT_TRUE(std::isfinite(cp.derivative[0])) << name << " at " << temperature;
    }
  });
}

TEST(Polynomial, IsItsPolynomialWithinItsTemperaturesAndConstantOutside) {
  expect_close(polynomial(200.0), 300.0 + 80.0 - 8.0 + 0.8);
  EXPECT_EQ(polynomial(20.0), polynomial(100.0));
  EXPECT_EQ(polynomial(5000.0), polynomial(1500.0));
}

TEST(Polynomial, DoesNotTurnNegative) {
  const Polynomial falling{.coefficients = {100.0, -1.0, 0.0, 0.0}, .lowest_temperature = 0.0, .highest_temperature = 1e5};
  EXPECT_EQ(falling(500.0), 1.0);
}

TEST(SteelLambda, ReferenceValues) {
  const SteelLambda law;
  expect_close(law(298.0), 442.3512458658214);
  expect_close(law(700.0), 623.7617056523085);
  expect_close(law(1000.0), 982.1804375030197);
  expect_close(law(1100.0), 638.4896819191378);
  expect_close(law(1500.0), 660.9147463075624);
}

TEST(SteelLambda, PeakAtTheCuriePointIsBounded) {
  const SteelLambda law;
  double highest = 0.0;
  for (double temperature = 1030.0; temperature < 1050.0; temperature += 0.01) highest = std::max(highest, law(temperature));
  EXPECT_GT(highest, 1800.0);
  EXPECT_LT(highest, 1860.0);
  EXPECT_LT(law(1041.0), law(1039.0));
}

TEST(SteelGoto, ReferenceValues) {
  const SteelGoto law;
  expect_close(law(298.0), 454.58759286518625);
  expect_close(law(600.0), 574.4755555555556);
  expect_close(law(1000.0), 850.5840000000001);
}

TEST(SteelGoto, DoesNotDivergeInTheCold) {
  const SteelGoto law;
  EXPECT_EQ(law(10.0), law(200.0));
  EXPECT_LT(law(10.0), 600.0);
}

TEST(SteelGoto, AgreesWithTheOtherSteelAtRoomTemperatureToThreePercent) {
  EXPECT_NEAR(SteelGoto{}(298.0) / SteelLambda{}(298.0), 1.0, 0.03);
}

TEST(Copper, ReferenceValues) {
  const Copper law;
  expect_close(law(100.0), 250.0);
  expect_close(law(200.0), 352.2);
  expect_close(law(300.0), 388.67);
  expect_close(law(1000.0), 459.3);
}

TEST(Copper, PartsMeetToOneJoule) {
  const Copper law;
  EXPECT_NEAR(law(std::nextafter(270.0, 0.0)), 384.6128, 1e-4);
  EXPECT_NEAR(law(270.0), 385.643, 1e-4);
}

TEST(Copper, HasItsFloorWhereTheCubicIsNegative) {
  EXPECT_EQ(Copper{}(4.0), 20.0);
  EXPECT_EQ(Copper{}(26.0), 20.0);
  EXPECT_GT(Copper{}(40.0), 20.0);
}

TEST(SpecificHeat, DualNumbersGiveTheDerivativesOfEveryLaw) {
  for_each([](const auto& law, const char* name) {
    SCOPED_TRACE(name);
    test::expect_exact_derivatives<1>([&]<class Real>(const std::array<Real, 1>& x) { return law(x[0]); },
                                      {test::Range{10.0, 3000.0}});
  });
}

}  // namespace
}  // namespace brisance::specific_heat
