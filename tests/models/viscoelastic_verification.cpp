// ViscoScram against closed forms and against a fine integration of its equations, written out here for pure shear.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "models/viscoelastic/viscoelastic.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance::viscoelastic {
namespace {

using History = ScramHistory<double>;
using Deviator = SymmetricTensor<double>;

// PBX 9501: Bennett et al. (1998), Hackett & Bennett (2000).
const ViscoScram pbx9501 = std::get<ViscoScram>(samples::viscoelastics().front());

ViscoScram with(double ViscoScram::*member, double value, ViscoScram law = pbx9501) {
  law.*member = value;
  return law;
}
ViscoScram without_cracks() {
  return with(&ViscoScram::initial_crack_radius, 0.0);
}
ViscoScram with_frozen_cracks(double radius) {
  return with(&ViscoScram::max_crack_speed, 0.0, with(&ViscoScram::initial_crack_radius, radius));
}

Deviator shear(double rate) {
  Deviator D;
  D.xy = rate;
  return D;
}
const Deviator stretch{2000.0, -1500.0, -500.0, 300.0, -200.0, 700.0};  // 1/s

History advance(const ViscoScram& law, const Deviator& D, double mean_stress, double time, int steps) {
  History h = law.initial_history();
  for (int i = 0; i < steps; ++i) h = law.advance(h, D, mean_stress, time / steps);
  return h;
}

// The equations once more, for pure shear: s_i and c under a constant shear rate, by the classical Runge-Kutta method --------

using Shear = std::array<double, 6>;  // five shear stresses and the crack radius

Shear shear_rate(const ViscoScram& law, double D, double mean_stress, const Shear& y) {
  constexpr double pi = std::numbers::pi;
  const double c = y[5], a = law.crack_scale, m = law.crack_exponent, K0 = law.toughness, mu = law.friction;
  double s = 0.0, G = 0.0, relaxing = 0.0;
  for (int i = 0; i < 5; ++i) s += y[i], G += law.shear_moduli[i], relaxing += y[i] * law.relaxation_rates[i];

  const double norm_squared = 2.0 * s * s + (mean_stress > 0.0 ? 3.0 * mean_stress * mean_stress : 0.0);
  const double K = std::sqrt(1.5 * pi * c * norm_squared);
  const double slip =
      mean_stress < 0.0 ? -std::sqrt(45.0 / (2.0 * (3.0 - 2.0 * mu * mu))) * mu * mean_stress * std::sqrt(c) : 0.0;
  const double K0m = K0 * std::sqrt(1.0 + pi * slip / K0 * (1.0 + slip / K0));
  const double Kp = K0m * std::sqrt(1.0 + 2.0 / m), K1 = Kp * std::pow(1.0 + m / 2.0, 1.0 / m);
  double v =
      std::exp(law.speed_exponent * std::log(std::sqrt(1.5) * std::numbers::sqrt2 * std::abs(D)) + law.speed_coefficient);
  if (mean_stress > 0.0) v *= law.tension_speed_factor;
  v = std::min(v, law.max_crack_speed);
  const double c_rate = K < Kp ? v * std::pow(K / K1, m) : v * (1.0 - K0m * K0m / (K * K));

  const double g = std::pow(c / a, 3), B = 3.0 * (c / a) * (c / a) * c_rate / a * s;
  Shear rate;
  for (int i = 0; i < 5; ++i)
    rate[i] = 2.0 * law.shear_moduli[i] * D - y[i] * law.relaxation_rates[i] -
              law.shear_moduli[i] / G * (B + g * (2.0 * G * D - relaxing - B) / (1.0 + g));
  rate[5] = c_rate;
  return rate;
}

Shear integrate(const ViscoScram& law, double D, double mean_stress, double time, int steps) {
  Shear y{0.0, 0.0, 0.0, 0.0, 0.0, law.initial_crack_radius};
  const double h = time / steps;
  const auto plus = [](Shear u, double f, const Shear& v) {
    for (int i = 0; i < 6; ++i) u[i] += f * v[i];
    return u;
  };
  for (int n = 0; n < steps; ++n) {
    const Shear k1 = shear_rate(law, D, mean_stress, y), k2 = shear_rate(law, D, mean_stress, plus(y, 0.5 * h, k1)),
                k3 = shear_rate(law, D, mean_stress, plus(y, 0.5 * h, k2)),
                k4 = shear_rate(law, D, mean_stress, plus(y, h, k3));
    y = plus(plus(plus(plus(y, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
  }
  return y;
}
double total_shear(const Shear& y) {
  return y[0] + y[1] + y[2] + y[3] + y[4];
}

// Closed forms --------------------------------------------------------------------------------------------------------------

constexpr double round_off = 1e-13;  // relative, accumulated over a hundred steps

TEST(ViscoScram, WithoutCracksIsFiveMaxwellElements) {
  const ViscoScram law = without_cracks();
  for (const int steps : {1, 7, 100}) {
    const double time = 3e-6;
    const History h = advance(law, stretch, 5e7, time, steps);
    EXPECT_EQ(h.crack_radius, 0.0);
    for (int i = 0; i < 5; ++i) {
      const double G = law.shear_moduli[i], rate = law.relaxation_rates[i];
      const double factor = rate == 0.0 ? 2.0 * G * time : -2.0 * G / rate * std::expm1(-rate * time);
      EXPECT_NEAR(h.partial_stress[i].xx, factor * stretch.xx, round_off * std::abs(factor * stretch.xx));
      EXPECT_NEAR(h.partial_stress[i].xz, factor * stretch.xz, round_off * std::abs(factor * stretch.xz));
    }
  }
}

TEST(ViscoScram, TendsToTheSteadyFlowOfItsDashpots) {
  ViscoScram law = without_cracks();
  law.relaxation_rates[0] = 1e5;  // no spring left
  const History h = advance(law, stretch, 0.0, 0.1, 10);
  double viscosity = 0.0;
  for (int i = 0; i < 5; ++i) viscosity += law.shear_moduli[i] / law.relaxation_rates[i];
  EXPECT_NEAR(total(h).yy, 2.0 * viscosity * stretch.yy, round_off * std::abs(2.0 * viscosity * stretch.yy));
}

TEST(ViscoScram, StressIsTheSumOfItsElements) {
  const History h = advance(pbx9501, stretch, -1e7, 5e-6, 20);
  double sum = 0.0;
  for (const Deviator& s : h.partial_stress) sum += s.yz;
  EXPECT_EQ(total(h).yz, sum);
  EXPECT_NEAR(trace(total(h)) / norm(total(h)), 0.0, round_off);
}

TEST(ViscoScram, AFrozenCrackReducesTheStressAtOnce) {
  for (const double radius : {3e-5, 1e-3, 2e-3}) {
    // So fast that nothing relaxes: 1e-13 s against 0.5e-6 s.
    const double g = std::pow(radius / 1e-3, 3), time = 1e-13;
    const History h = advance(with_frozen_cracks(radius), stretch, 0.0, time, 1);
    const double expected = 2.0 * pbx9501.shear_modulus() * time * stretch.xx / (1.0 + g);
    EXPECT_NEAR(total(h).xx / expected, 1.0, 1e-6);
    EXPECT_EQ(h.crack_radius, radius);
  }
}

TEST(ViscoScram, AFrozenCrackInAnElasticSolidIsExactForAnyStep) {
  ViscoScram law = with_frozen_cracks(1.5e-3);
  law.relaxation_rates = {};
  const double time = 1e-3, g = std::pow(1.5, 3);
  for (const int steps : {1, 10}) {
    const double expected = 2.0 * law.shear_modulus() * time * stretch.xy / (1.0 + g);
    EXPECT_NEAR(total(advance(law, stretch, 0.0, time, steps)).xy / expected, 1.0, round_off);
  }
}

// Crack growth --------------------------------------------------------------------------------------------------------------

/// The speed of a crack under a shear stress that is carried by the first element.
double crack_speed(const ViscoScram& law, double shear_stress, double mean_stress, double rate, double radius = 3e-5) {
  History h = law.initial_history();
  h.crack_radius = radius;
  h.partial_stress[0].xy = shear_stress;
  return law.rate(shear(rate), mean_stress, h).crack_radius;
}
/// The shear stress at which the stress intensity is `intensity` times K0 (no mean stress).
double stress_at(double intensity, double radius = 3e-5) {
  return intensity * pbx9501.toughness / std::sqrt(3.0 * std::numbers::pi * radius);
}

TEST(ViscoScram, CrackSpeedIsContinuousWhereSlowGrowthBecomesFast) {
  const double transition = std::sqrt(1.0 + 2.0 / 10.0),
               v = std::exp(0.90564746 * std::log(std::sqrt(3.0) * 100.0) - 2.90178468);
  EXPECT_NEAR(crack_speed(pbx9501, stress_at(transition * (1.0 - 1e-10)), 0.0, 100.0) / v, 2.0 / 12.0, 1e-8);
  EXPECT_NEAR(crack_speed(pbx9501, stress_at(transition * (1.0 + 1e-10)), 0.0, 100.0) / v, 2.0 / 12.0, 1e-8);
  // And smooth: K^10 and 1 - 1/K^2 have the same slope there, (2/K') (K0/K')^2.
  const double h = 1e-5;
  const double slow =
      (crack_speed(pbx9501, stress_at(transition), 0.0, 100.0) - crack_speed(pbx9501, stress_at(transition - h), 0.0, 100.0)) /
      (h * v);
  const double fast =
      (crack_speed(pbx9501, stress_at(transition + h), 0.0, 100.0) - crack_speed(pbx9501, stress_at(transition), 0.0, 100.0)) /
      (h * v);
  EXPECT_NEAR(slow, 2.0 / std::pow(transition, 3), 1e-4);
  EXPECT_NEAR(fast, 2.0 / std::pow(transition, 3), 1e-4);
}

TEST(ViscoScram, SlowGrowthGoesWithTheTenthPowerOfTheStress) {
  const double one = crack_speed(pbx9501, stress_at(0.4), 0.0, 100.0), two = crack_speed(pbx9501, stress_at(0.8), 0.0, 100.0);
  EXPECT_NEAR(two / one, 1024.0, 1024.0 * round_off);
}

TEST(ViscoScram, GrowthTendsToItsLimitingSpeed) {
  EXPECT_NEAR(crack_speed(pbx9501, stress_at(1e4), 0.0, 1e6), 300.0, 1e-5);
  EXPECT_NEAR(crack_speed(pbx9501, stress_at(1e4), 0.0, 100.0),
              std::exp(0.90564746 * std::log(std::sqrt(3.0) * 100.0) - 2.90178468), 1e-6);
}

TEST(ViscoScram, FrictionHoldsCracksUnderPressureAndTensionOpensThem) {
  const double s = stress_at(1.3);
  const double sliding = crack_speed(pbx9501, s, 0.0, 100.0);
  EXPECT_LT(crack_speed(pbx9501, s, -1e7, 100.0), sliding);
  EXPECT_LT(crack_speed(pbx9501, s, -1e8, 100.0), 0.01 * sliding);
  EXPECT_GT(crack_speed(pbx9501, s, 1e7, 100.0), 11.0 * sliding);
  // Without friction pressure makes no difference.
  EXPECT_EQ(crack_speed(with(&ViscoScram::friction, 0.0), s, -1e8, 100.0),
            crack_speed(with(&ViscoScram::friction, 0.0), s, 0.0, 100.0));
  // Threshold by hand: slip 0.35 sqrt(45/5.51), x = slip p sqrt(c)/K0; the fast branch is v (1 - threshold/K^2).
  const double x = 0.35 * std::sqrt(45.0 / 5.51) * 1e7 * std::sqrt(3e-5) / 5e5, K = 3.0;
  const double v = std::exp(0.90564746 * std::log(std::sqrt(3.0) * 100.0) - 2.90178468);
  EXPECT_NEAR(crack_speed(pbx9501, stress_at(K), -1e7, 100.0) / v, 1.0 - (1.0 + std::numbers::pi * x * (1.0 + x)) / (K * K),
              round_off);
}

TEST(ViscoScram, NothingGrowsWithoutStrainRateOrWithoutACrack) {
  EXPECT_EQ(crack_speed(pbx9501, stress_at(3.0), 0.0, 0.0), 0.0);
  EXPECT_EQ(crack_speed(pbx9501, 1e8, 0.0, 100.0, 0.0), 0.0);
}

// The step ------------------------------------------------------------------------------------------------------------------

struct Loading {
  const char* name;
  double rate, mean_stress, time;
};
constexpr std::array loadings = {Loading{"compression", 3000.0, -1e7, 2e-5}, Loading{"tension", 1000.0, 1e6, 3e-5},
                                 Loading{"slow", 1.0, -1e5, 8e-2}, Loading{"fast", 1e5, -3e7, 1e-6}};

TEST(ViscoScram, IsSecondOrderInTheStep) {
  for (const Loading& at : loadings) {
    const Shear reference = integrate(pbx9501, at.rate, at.mean_stress, at.time, 1 << 17);
    EXPECT_GT(reference[5], 2.0 * pbx9501.initial_crack_radius) << at.name;  // cracks grow in all four
    std::array<double, 3> stress_error, radius_error;
    const int coarsest = 4096;
    for (int k = 0; k < 3; ++k) {
      const History h = advance(pbx9501, shear(at.rate), at.mean_stress, at.time, coarsest << k);
      stress_error[k] = std::abs(total(h).xy / total_shear(reference) - 1.0);
      radius_error[k] = std::abs(h.crack_radius / reference[5] - 1.0);
    }
    for (int k = 0; k < 2; ++k) {
      EXPECT_GT(std::log2(stress_error[k] / stress_error[k + 1]), 1.9) << at.name << ' ' << stress_error[k];
      EXPECT_GT(std::log2(radius_error[k] / radius_error[k + 1]), 1.9) << at.name << ' ' << radius_error[k];
    }
    constexpr double converged = 1e-5;  // at the coarsest step: the order is that of an error already small
    EXPECT_LT(stress_error[0], converged) << at.name;
    EXPECT_LT(radius_error[0], converged) << at.name;
  }
}

TEST(ViscoScram, StepsOfTheSizeOfACodeAreWithinAPerMille) {
  // 100 steps for all of the history; no smaller step than a cell of half a millimetre would ask for.
  for (const Loading& at : loadings) {
    const Shear reference = integrate(pbx9501, at.rate, at.mean_stress, at.time, 1 << 17);
    const History h = advance(pbx9501, shear(at.rate), at.mean_stress, at.time, 100);
    EXPECT_NEAR(total(h).xy / total_shear(reference), 1.0, 1e-3) << at.name;
    EXPECT_NEAR(h.crack_radius / reference[5], 1.0, 1e-3) << at.name;
  }
}

TEST(ViscoScram, AnEnormousStepNeitherOverflowsNorHeals) {
  for (const double dt : {1e-6, 1e-3, 1.0, 1e6}) {
    for (const double mean_stress : {-1e9, 0.0, 1e9}) {
      const History h = advance(pbx9501, stretch, mean_stress, 3.0 * dt, 3);
      EXPECT_GE(h.crack_radius, 3e-5);
      for (const Deviator& s : h.partial_stress) EXPECT_TRUE(std::isfinite(norm(s))) << dt;
      // The stress never exceeds that of the solid without relaxation and without cracks.
      EXPECT_LE(norm(total(h)), 2.0 * pbx9501.shear_modulus() * norm(stretch) * 3.0 * dt * (1.0 + round_off));
    }
  }
}

TEST(ViscoScram, RateIsTheLimitOfTheStep) {
  const History h = advance(pbx9501, stretch, -1e7, 1e-5, 100);
  const History rate = pbx9501.rate(stretch, -1e7, h);
  const double dt = 1e-11;  // truncation and round-off are both 1e-5 or less
  const History next = pbx9501.advance(h, stretch, -1e7, dt);
  EXPECT_NEAR((next.crack_radius - h.crack_radius) / dt / rate.crack_radius, 1.0, 1e-4);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR((next.partial_stress[i].xx - h.partial_stress[i].xx) / dt / rate.partial_stress[i].xx, 1.0, 1e-4) << i;
}

TEST(ViscoScram, RateObeysTheEquationsWrittenOutForShear) {
  const Shear y{2e6, -1e6, 3e6, 5e6, 1e6, 4e-4};
  History h = pbx9501.initial_history();
  h.crack_radius = y[5];
  for (int i = 0; i < 5; ++i) h.partial_stress[i].xy = y[i];
  for (const double mean_stress : {-2e7, 0.0, 3e6}) {
    const Shear expected = shear_rate(pbx9501, 700.0, mean_stress, y);
    const History rate = pbx9501.rate(shear(700.0), mean_stress, h);
    EXPECT_NEAR(rate.crack_radius / expected[5], 1.0, round_off);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(rate.partial_stress[i].xy / expected[i], 1.0, 1e-11);  // differences of large terms
  }
}

TEST(ViscoScram, ElasticCracksGiveBackAllTheirEnergy) {
  ViscoScram law = with_frozen_cracks(1e-3);
  law.relaxation_rates = {};
  const double time = 1e-5;
  const History h = advance(law, stretch, 0.0, time, 1);
  const double work = 0.5 * double_dot(total(h), stretch) * time;  // the stress grows in proportion
  EXPECT_NEAR(law.stored_energy(h) / work, 1.0, round_off);
}

TEST(ViscoScram, NeverStoresMoreThanTheWorkDone) {
  // Random zigzag of the strain rate; the work by the trapezoidal rule is good to the 1e-3 allowed.
  std::mt19937 random(11);
  std::normal_distribution<double> z;
  History h = pbx9501.initial_history();
  double work = 0.0;
  constexpr double dt = 2e-9;
  for (int leg = 0; leg < 20; ++leg) {
    Deviator D{z(random), z(random), 0.0, z(random), z(random), z(random)};
    D.zz = -D.xx - D.yy;
    D = 2000.0 * D;
    const double before = pbx9501.stored_energy(h), work_before = work;
    for (int i = 0; i < 1000; ++i) {
      const Deviator s = total(h);
      h = pbx9501.advance(h, D, -1e6, dt);
      work += 0.5 * dt * double_dot(s + total(h), D);
    }
    const double stored = pbx9501.stored_energy(h) - before, done = work - work_before;
    EXPECT_LE(stored, done + 1e-3 * std::abs(done)) << leg;
  }
  EXPECT_GT(h.crack_radius, 3e-5);
  EXPECT_GT(work, 2.0 * pbx9501.stored_energy(h));  // most of it has become heat
}

TEST(ViscoScram, DoesNotSeeTheFrame) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Tensor<double> R =
      Tensor<double>{c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0} * Tensor<double>{1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c};
  const History turned_after = rotate(R, advance(pbx9501, stretch, -1e7, 1e-5, 50));
  const History turned_before = advance(pbx9501, rotate(R, stretch), -1e7, 1e-5, 50);
  const double size = norm(total(turned_before));
  EXPECT_NEAR(turned_after.crack_radius / turned_before.crack_radius, 1.0, 1e-12);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(norm(turned_after.partial_stress[i] - turned_before.partial_stress[i]) / size, 0.0, 1e-12);
}

TEST(ViscoScram, ALaneIsAPointByItself) {
  // Eight points that need between one part of the step and all 64, at once and each among other neighbours.
  const auto eight = [](int first) {
    SymmetricTensor<Lanes> D;
    Lanes mean_stress;
    for (int i = 0; i < 8; ++i) {
      const int point = (first + i) % 8;
      D.xx.set(i, std::pow(10.0, point)), D.yy.set(i, -std::pow(10.0, point)), D.xy.set(i, 30.0 * point);
      mean_stress.set(i, point % 2 == 0 ? -1e7 : 2e7);
    }
    ScramHistory<Lanes> h = pbx9501.initial_history<Lanes>();
    for (int n = 0; n < 20; ++n) h = pbx9501.advance(h, D, mean_stress, 2e-7);
    return h;
  };
  const ScramHistory<Lanes> h = eight(0), moved = eight(3);
  for (int point = 0; point < 8; ++point) {
    EXPECT_EQ(h.crack_radius[point], moved.crack_radius[(point + 5) % 8]);
    EXPECT_EQ(total(h).xx[point], total(moved).xx[(point + 5) % 8]);

    Deviator D;
    D.xx = std::pow(10.0, point), D.yy = -D.xx, D.xy = 30.0 * point;
    History alone = pbx9501.initial_history();
    for (int n = 0; n < 20; ++n) alone = pbx9501.advance(alone, D, point % 2 == 0 ? -1e7 : 2e7, 2e-7);
    EXPECT_NEAR(h.crack_radius[point] / alone.crack_radius, 1.0, 1e-12);
    EXPECT_NEAR(total(h).xx[point] / total(alone).xx, 1.0, 1e-12);
  }
}

TEST(ViscoScram, ColumnsKeepEveryNumberOfTheHistory) {
  std::array<double, history_capacity> columns{}, copy{};
  for (int i = 0; i < 31; ++i) columns[i] = i + 1.0;
  const History h = History::from_columns(columns);
  EXPECT_EQ(h.crack_radius, 1.0);
  EXPECT_EQ(ViscoScram::history[2 + 6 * 4].name, "s5_yy");
  EXPECT_EQ(h.partial_stress[4].yy, columns[2 + 6 * 4]);
  EXPECT_EQ(ViscoScram::history[6].name, "s1_xy");
  EXPECT_EQ(h.partial_stress[0].xy, columns[6]);
  h.to_columns(copy);
  EXPECT_EQ(copy, columns);
}

}  // namespace
}  // namespace brisance::viscoelastic
