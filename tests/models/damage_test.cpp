#include "models/damage/damage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace brisance::damage {
namespace {

constexpr double round_off = 4e-15;  // relative, a dozen operations

// 4340 steel and 6061-T6 aluminium in the form of Johnson & Cook (1985).
constexpr JohnsonCook steel{.D1 = 0.05,
                            .D2 = 3.44,
                            .D3 = -2.12,
                            .D4 = 0.002,
                            .D5 = 0.61,
                            .reference_strain_rate = 1.0,
                            .reference_temperature = 294.0,
                            .min_fracture_strain = 0.01};
constexpr JohnsonCook aluminium{.D1 = -0.77,
                                .D2 = 1.45,
                                .D3 = -0.47,
                                .D4 = 0.0,
                                .D5 = 1.60,
                                .reference_strain_rate = 1.0,
                                .reference_temperature = 294.0,
                                .min_fracture_strain = 0.01};

Arguments<double> at(double triaxiality, double rate = 1.0, double temperature = 294.0) {
  return {.triaxiality = triaxiality, .plastic_strain_rate = rate, .temperature = temperature, .melting_temperature = 1794.0};
}

TEST(JohnsonCookDamage, FractureStrainOfATensileBarIsItsClosedForm) {
  EXPECT_NEAR(steel(at(1.0 / 3.0)), 1.7469029657120483, 1.75 * round_off);              // 0.05 + 3.44 exp(-2.12/3)
  EXPECT_NEAR(steel(at(1.0 / 3.0, 1e4, 1044.0)), 2.3217021503319923, 2.4 * round_off);  // x (1 + 0.002 ln 1e4) 1.305
}

TEST(JohnsonCookDamage, TensionIsLessDuctileThanShearAndShearThanCompression) {
  EXPECT_LT(steel(at(1.0)), steel(at(0.0)));
  EXPECT_LT(steel(at(0.0)), steel(at(-1.0)));
  EXPECT_NEAR(steel(at(0.0)), 3.49, 3.49 * round_off);
}

TEST(JohnsonCookDamage, TriaxialityCountsUpToOneAndAHalf) {
  EXPECT_EQ(steel(at(1.5)), steel(at(40.0)));
  EXPECT_EQ(steel(at(-1.5)), steel(at(-40.0)));
  EXPECT_LT(steel(at(1.5)), steel(at(1.49)));
}

TEST(JohnsonCookDamage, SlowAndColdMetalIsAsAtTheReference) {
  EXPECT_EQ(steel(at(0.5, 0.0)), steel(at(0.5, 1.0)));
  EXPECT_EQ(steel(at(0.5, 1.0, 77.0)), steel(at(0.5)));
  EXPECT_EQ(steel(at(0.5, 1.0, 5000.0)), steel(at(0.5, 1.0, 1794.0)));
  EXPECT_GT(steel(at(0.5, 1.0, 600.0)), steel(at(0.5)));
}

TEST(JohnsonCookDamage, NoSetOfConstantsMakesAFractureStrainBelowItsFloor) {
  // The published set falls to the floor at a triaxiality of ln(1.45/0.78)/0.47 = 1.319 and crosses zero at 1.347.
  EXPECT_GT(aluminium(at(1.31)), 0.01);
  EXPECT_EQ(aluminium(at(1.33)), 0.01);
  EXPECT_EQ(aluminium(at(1.5, 1e6, 1794.0)), 0.01);
}

TEST(JohnsonCookDamage, TwoNegativeFactorsDoNotMakeAToughMetal) {
  JohnsonCook law = aluminium;
  law.D4 = -0.2;  // negative beyond a rate of exp(5)
  EXPECT_EQ(law(at(1.5, 1e6)), 0.01);
}

TEST(JohnsonCookDamage, ADoublingOfTheFloorDoublesTheLeastFractureStrain) {
  JohnsonCook law = aluminium;
  law.min_fracture_strain = 0.02;
  EXPECT_EQ(law(at(1.5)), 0.02);
}

TEST(HancockMackenzie, FollowsRiceAndTracey) {
  const HancockMackenzie law{.tension_only = false};
  EXPECT_NEAR(law(at(1.0 / 3.0)), 1.0007755885258451, round_off);  // 1.65 exp(-1/2)
  EXPECT_NEAR(law(at(0.0)), 1.65, 1.65 * round_off);
  EXPECT_NEAR(law(at(1.2)) * law(at(-1.2)), 1.65 * 1.65, 2.8 * round_off);
  EXPECT_EQ(law(at(3.0)), law(at(50.0)));
  EXPECT_EQ(law(at(-3.0)), law(at(-50.0)));
}

TEST(HancockMackenzie, TensionOnlySparesShearAndCompression) {
  const HancockMackenzie law{.tension_only = true};
  EXPECT_EQ(law(at(0.7)), HancockMackenzie{.tension_only = false}(at(0.7)));
  EXPECT_EQ(1.0 + 10.0 / law(at(0.0)), 1.0);  // a strain of 10 leaves no damage that a double could see
  EXPECT_EQ(1.0 + 10.0 / law(at(-2.0)), 1.0);
}

TEST(Damage, IsTheSameInLanes) {
  Arguments<Lanes> lanes;
  lanes.melting_temperature = 1794.0;
  for (int i = 0; i < 8; ++i)
    lanes.triaxiality.set(i, 0.6 * i - 2.0), lanes.plastic_strain_rate.set(i, std::pow(10.0, i - 2)),
        lanes.temperature.set(i, 250.0 * i);
  for (int i = 0; i < 8; ++i) {
    const Arguments<double> point = at(lanes.triaxiality[i], lanes.plastic_strain_rate[i], lanes.temperature[i]);
    EXPECT_NEAR(steel(lanes)[i] / steel(point), 1.0, round_off);
    for (bool tension_only : {false, true})
      EXPECT_NEAR(HancockMackenzie{tension_only}(lanes)[i] / HancockMackenzie{tension_only}(point), 1.0, round_off);
  }
}

template <class Law>
void expect_positive_finite_and_differentiable(const Law& law) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> triaxiality(-3.5, 3.5), log_rate(-8.0, 8.0), temperature(1.0, 3000.0);
  for (int i = 0; i < 2000; ++i) {
    const Arguments<double> x = at(triaxiality(random), std::pow(10.0, log_rate(random)), temperature(random));
    const double value = law(x);
    ASSERT_TRUE(std::isfinite(value) && value > 0.0);

    using D = Dual<double, 1>;
    const D derivative =
        law(Arguments<D>{D::variable(x.triaxiality), x.plastic_strain_rate, x.temperature, x.melting_temperature});
    ASSERT_NEAR(derivative.value, value, round_off * value);
    // Central difference: truncation of h^2, round-off of eps/h.
    constexpr double h = 1e-5, tolerance = 1e-8;
    if (std::abs(std::abs(x.triaxiality) - 1.5) < 2 * h || std::abs(std::abs(x.triaxiality) - 3.0) < 2 * h) continue;
    Arguments<double> above = x, below = x;
    above.triaxiality += h, below.triaxiality -= h;
    const double difference = (law(above) - law(below)) / (2.0 * h);
    ASSERT_NEAR(derivative.derivative[0], difference, tolerance * (1.0 + 100.0 * std::abs(value)));
  }
}

TEST(JohnsonCookDamage, IsPositiveFiniteAndDifferentiableEverywhere) {
  expect_positive_finite_and_differentiable(steel);
}
TEST(HancockMackenzie, IsPositiveFiniteAndDifferentiableEverywhere) {
  expect_positive_finite_and_differentiable(HancockMackenzie{.tension_only = false});
}

}  // namespace
}  // namespace brisance::damage
