// Flow stress laws against the closed forms and limits that follow from their equations.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/models/exact_derivatives.hpp"
#include "tests/models/flow_stress_sets.hpp"

namespace brisance::flow_stress {
namespace {

using test::halton;
using test::Range;

constexpr double round_off = 1e-12;
void expect_close(double value, double reference, double tolerance = round_off) {
  EXPECT_LE(std::abs(value - reference), tolerance * std::abs(reference)) << value << " is not " << reference;
}

Arguments<double> copper_at(double strain, double rate, double temperature) {
  return {.plastic_strain = strain,
          .plastic_strain_rate = rate,
          .temperature = temperature,
          .melting_temperature = 1356.0,
          .shear_modulus = 47.7e9 - 3e9 / std::expm1(180.0 / temperature),
          .pressure = 0.0,
          .density = 8930.0};
}
Arguments<double> hy100_at(double strain, double rate, double temperature) {
  return {.plastic_strain = strain,
          .plastic_strain_rate = rate,
          .temperature = temperature,
          .melting_temperature = 2000.0,
          .shear_modulus = 71.46e9 - 2.9e9 / std::expm1(204.0 / temperature),
          .pressure = 0.0,
          .density = 7860.0};
}

/// The threshold stress after straining at one rate and temperature in equal increments.
double strained(const MechanicalThresholdStress& law, const Arguments<double>& at, double from, double strain, int steps) {
  double history = from;
  for (int i = 0; i < steps; ++i) history = advance_history(law, at, history, strain / steps);
  return history;
}

/// Saturation stress and initial hardening, written out again.
double saturation_of(const MechanicalThresholdStress& law, const Arguments<double>& at) {
  return law.saturation_stress * std::exp(law.k_over_b3 * at.temperature / (law.saturation_barrier * at.shear_modulus) *
                                          std::log(at.plastic_strain_rate / law.saturation_rate));
}
double initial_hardening_of(const MechanicalThresholdStress& law, const Arguments<double>& at) {
  return law.a0 + law.a1 * std::log(at.plastic_strain_rate) + law.a2 * std::sqrt(at.plastic_strain_rate) -
         law.a3 * at.temperature;
}
/// Resistance of a barrier, written out again.
double fraction_of(const MechanicalThresholdStress& law, const Arguments<double>& at, double barrier, double rate, double p,
                   double q) {
  const double x = law.k_over_b3 * at.temperature / (barrier * at.shear_modulus) * std::log(rate / at.plastic_strain_rate);
  return std::pow(1.0 - std::pow(x, 1.0 / q), 1.0 / p);
}

// Johnson-Cook -------------------------------------------------------------------------------------------------------

TEST(JohnsonCook, AdiabaticTemperatureWithLinearSofteningIsTheClosedForm) {
  auto law = sets::steel_4340;
  law.m = 1.0;
  constexpr double chi = 0.9, density = 7830.0, specific_heat = 477.0, room = 298.0, melting = 1793.0, rate = 2e3,
                   start = 350.0;
  const auto slope = [&](double strain, double temperature) {
    const Arguments<double> at{.plastic_strain = strain,
                               .plastic_strain_rate = rate,
                               .temperature = temperature,
                               .melting_temperature = melting,
                               .shear_modulus = 80e9,
                               .pressure = 0.0,
                               .density = density};
    return chi * law(at) / (density * specific_heat);
  };
  // Fourth-order Runge-Kutta in s = strain^(1/4), in which strain^n has no infinite slope at 0.
  constexpr double end = 0.8;
  constexpr int steps = 2000;
  const double s_end = std::pow(end, 0.25), h = s_end / steps;
  const auto slope_in_s = [&](double s, double T) { return slope(s * s * s * s, T) * 4.0 * s * s * s; };
  double T = start;
  for (int i = 0; i < steps; ++i) {
    const double s = i * h;
    const double k1 = slope_in_s(s, T), k2 = slope_in_s(s + h / 2, T + h / 2 * k1), k3 = slope_in_s(s + h / 2, T + h / 2 * k2);
    T += h / 6 * (k1 + 2 * k2 + 2 * k3 + slope_in_s(s + h, T + h * k3));
  }
  const double k = chi * (1.0 + law.C * std::log(rate)) / (density * specific_heat * (melting - room));
  const double theta = 1.0 - (1.0 - (start - room) / (melting - room)) *
                                 std::exp(-k * (law.A * end + law.B * std::pow(end, law.n + 1.0) / (law.n + 1.0)));
  expect_close(T, room + theta * (melting - room), 1e-9);  // integration error of the Runge-Kutta method
}

// Mechanical threshold stress -----------------------------------------------------------------------------------------

TEST(MechanicalThresholdStress, VoceHardeningIsTheExponential) {
  const auto law = sets::with_voce_hardening(sets::threshold_copper);
  const auto at = copper_at(0.0, 1e3, 300.0);
  const double saturation = saturation_of(law, at), initial = initial_hardening_of(law, at);
  for (double strain : {0.02, 0.1, 0.4, 1.0}) {
    const double exact = saturation * (1.0 - std::exp(-initial * strain / saturation));
    expect_close(strained(law, at, 0.0, strain, 4000), exact, 1e-6);  // midpoint rule: error (strain/4000)^2
  }
}

TEST(MechanicalThresholdStress, VoceHardeningWithExponentTwoIsTheHyperbolicTangent) {
  const auto law = sets::with_voce_exponent(2.0, sets::threshold_copper);  // dX/de = (theta0/sigma_es)(1 - X^2)
  const auto at = copper_at(0.0, 1e3, 300.0);
  const double saturation = saturation_of(law, at), initial = initial_hardening_of(law, at);
  for (double strain : {0.02, 0.1, 0.4, 1.0})
    expect_close(strained(law, at, 0.0, strain, 4000), saturation * std::tanh(initial * strain / saturation), 1e-6);
}

TEST(MechanicalThresholdStress, VoceHardeningWithAnExponentFollowsItsSeries) {
  // The strain to reach X is (sigma_es/theta0) times the integral of 1/(1 - X^kappa), the sum of X^(k kappa + 1)/(k kappa + 1).
  const auto at = copper_at(0.0, 1e3, 300.0);
  for (double kappa : {1.0, 1.5, 3.0}) {
    const auto law = sets::with_voce_exponent(kappa, sets::threshold_copper);
    const double saturation = saturation_of(law, at), initial = initial_hardening_of(law, at);
    for (double strain : {0.02, 0.1, 0.3}) {
      const double X = strained(law, at, 0.0, strain, 4000) / saturation;
      ASSERT_LT(X, 0.95);  // where the series converges within the terms below
      double sum = 0.0;
      for (int k = 0; k < 2000; ++k) sum += std::pow(X, k * kappa + 1.0) / (k * kappa + 1.0);
      expect_close(strain, saturation / initial * sum, 1e-5);
    }
  }
}

TEST(MechanicalThresholdStress, TanhHardeningFollowsItsQuadrature) {
  for (const auto* law : {&sets::threshold_copper, &sets::threshold_al6061}) {
    const auto at = copper_at(0.0, 1e3, 400.0);
    const double saturation = saturation_of(*law, at), initial = initial_hardening_of(*law, at), alpha = law->alpha;
    for (double strain : {0.05, 0.3, 1.0}) {
      const double u = alpha * strained(*law, at, 0.0, strain, 4000) / saturation;
      const double exact_strain = saturation / initial * (std::sinh(alpha) / alpha) *
                                  (std::cosh(alpha) * std::log(std::sinh(alpha) / std::sinh(alpha - u)) - u * std::sinh(alpha));
      expect_close(strain, exact_strain, 1e-5);  // midpoint rule, and the logarithm amplifies near saturation
    }
  }
}

TEST(MechanicalThresholdStress, HistoryReferenceValues) {
  // Fourth-order Runge-Kutta with 2e5 steps by a separate program; the midpoint rule with 4000 steps is good to 1e-6.
  constexpr double tolerance = 1e-6;
  auto at = hy100_at(0.0, 2e3, 300.0);
  double history = strained(sets::threshold_hy100, at, 0.0, 0.3, 4000);
  expect_close(history, 367086907.4373102, tolerance);
  expect_close(sets::threshold_hy100(at, history), 1245180903.9021468, tolerance);
  at = hy100_at(0.0, 1.0, 300.0);
  history = strained(sets::threshold_hy100, at, 0.0, 1.0, 4000);
  expect_close(history, 479300414.5956225, tolerance);
  expect_close(sets::threshold_hy100(at, history), 1256733927.1887367, tolerance);
  at = copper_at(0.0, 2e3, 300.0);
  history = strained(sets::threshold_copper, at, 0.0, 0.3, 4000);
  expect_close(history, 331853830.5301109, tolerance);
  expect_close(sets::threshold_copper(at, history), 332853752.4980518, tolerance);
  at = copper_at(0.0, 1e-3, 600.0);
  history = strained(sets::threshold_copper, at, 0.0, 0.5, 4000);
  expect_close(history, 205724610.62316108, tolerance);
  expect_close(sets::threshold_copper(at, history), 164924268.44779894, tolerance);
}

TEST(MechanicalThresholdStress, StepOfTheHistoryIsSecondOrder) {
  const auto law = sets::with_voce_hardening(sets::threshold_copper);
  const auto at = copper_at(0.0, 1e3, 300.0);
  const double saturation = saturation_of(law, at), initial = initial_hardening_of(law, at), strain = 0.2;
  const double exact = saturation * (1.0 - std::exp(-initial * strain / saturation));
  double coarse = std::abs(strained(law, at, 0.0, strain, 16) - exact);
  for (int steps : {32, 64, 128}) {
    const double fine = std::abs(strained(law, at, 0.0, strain, steps) - exact);
    EXPECT_NEAR(coarse / fine, 4.0, 0.1) << steps;
    coarse = fine;
  }
}

TEST(MechanicalThresholdStress, StepOfTheHistorySolvesItsImplicitEquation) {
  constexpr double tolerance = 1e-12;
  for (const auto* law : {&sets::threshold_copper, &sets::threshold_hy100, &sets::threshold_al6061})
    for (double temperature : {50.0, 300.0, 700.0, 1100.0})
      for (double rate : {1e-3, 1.0, 1e3, 1e6})
        for (double start : {0.0, 1e8, 6e8})
          for (double increment : {0.0, 1e-6, 1e-3, 1e-2}) {
            const auto at = copper_at(0.1, rate, temperature);
            const double end = advance_history(*law, at, start, increment);
            const double hardening = law->hardening(at, 0.5 * (start + end));
            EXPECT_LE(std::abs(end - start - increment * hardening), tolerance * std::max(end, 1e6))
                << temperature << ' ' << rate << ' ' << start << ' ' << increment;
          }
}

TEST(MechanicalThresholdStress, HardeningStartsAtThetaZeroAndEndsAtThetaFour) {
  const auto& law = sets::threshold_hy100;
  const auto at = hy100_at(0.0, 1e3, 400.0);
  expect_close(law.hardening(at, 0.0), 6e9 - 2.0758e6 * 400.0);
  expect_close(law.hardening(at, saturation_of(law, at)), 200e6, 1e-11);  // the difference of numbers 25 times as large
}

TEST(MechanicalThresholdStress, ThresholdTendsToSaturationWithoutStageFourAndPassesItWith) {
  const auto copper = copper_at(0.0, 1.0, 600.0);
  expect_close(strained(sets::threshold_copper, copper, 0.0, 30.0, 6000), saturation_of(sets::threshold_copper, copper), 1e-9);
  const auto steel = hy100_at(0.0, 1.0, 300.0);
  EXPECT_GT(strained(sets::threshold_hy100, steel, 0.0, 1.5, 2000), 1.05 * saturation_of(sets::threshold_hy100, steel));
}

TEST(MechanicalThresholdStress, BarriersGiveTheirWholeStressAtTheirRateAndAtZeroTemperature) {
  auto law = sets::threshold_hy100;
  constexpr double threshold = 5e8;
  auto cold = hy100_at(0.1, 1.0, 300.0);
  cold.temperature = 0.0;
  cold.shear_modulus = law.reference_shear_modulus;
  expect_close(law(cold, threshold), 40e6 + 1341e6 + threshold);
  auto fast = hy100_at(0.1, 1e13, 300.0);  // beyond both rates
  expect_close(law(fast, threshold), 40e6 + (1341e6 + threshold) * fast.shear_modulus / 71.46e9);
  law.intrinsic_stress = 0.0;
  fast.plastic_strain_rate = law.evolving_rate;
  expect_close(law(fast, threshold), 40e6 + threshold * fast.shear_modulus / 71.46e9);
}

TEST(MechanicalThresholdStress, ZeroTemperatureIsApproachedContinuously) {
  const auto& law = sets::threshold_copper;
  double previous = 0.0;
  for (double temperature : {10.0, 1.0, 0.1, 0.01}) {
    auto at = copper_at(0.1, 1.0, temperature);
    const double gap = 40e6 + 3e8 - law(at, 3e8);
    EXPECT_GT(gap, 0.0);
    // 1 - S = (3/2) k T/(g0 b^3 mu) ln(r0/r) to first order: proportional to T.
    if (previous > 0.0) {
      EXPECT_NEAR(previous / gap, 10.0, 0.1) << temperature;
    }
    previous = gap;
  }
}

TEST(MechanicalThresholdStress, HeatLowersWhatTheBarriersResist) {
  // At a fixed modulus only S depends on temperature.
  for (const auto* law : {&sets::threshold_copper, &sets::threshold_hy100}) {
    auto at = copper_at(0.1, 1e3, 300.0);
    double colder = 1e300;
    for (double temperature = 0.0; temperature < 1300.0; temperature += 10.0) {
      at.temperature = temperature;
      const double Y = (*law)(at, 3e8);
      EXPECT_LT(Y, colder) << temperature;
      colder = Y;
    }
  }
}

TEST(MechanicalThresholdStress, RateJumpActsOnTheBarriersAtOnceAndOnTheThresholdByFurtherStrain) {
  const auto& law = sets::threshold_hy100;
  const auto slow = hy100_at(0.2, 1e-3, 300.0), fast = hy100_at(0.2, 1e4, 300.0);
  const double before = strained(law, slow, 0.0, 0.2, 2000);

  // At the jump: the same threshold stress, another fraction of it.
  const double at_the_jump = advance_history(law, fast, before, 0.0);
  EXPECT_EQ(at_the_jump, before);
  const auto evolving = [&](const auto& at) { return fraction_of(law, at, 1.6, 1e7, 2.0 / 3.0, 1.0); };
  const auto intrinsic = [&](const auto& at) { return fraction_of(law, at, 1.161, 1e13, 0.5, 1.5); };
  const double jump = ((evolving(fast) - evolving(slow)) * before + (intrinsic(fast) - intrinsic(slow)) * 1341e6) *
                      fast.shear_modulus / 71.46e9;
  expect_close(law(fast, at_the_jump) - law(slow, before), jump, 1e-10);

  // Afterwards: evolution from there, by Runge-Kutta; not what straining at the fast rate from the beginning gives.
  const double saturation = saturation_of(law, fast), initial = initial_hardening_of(law, fast);
  const auto slope = [&](double s) { return initial + (200e6 - initial) * std::tanh(3.0 * s / saturation) / std::tanh(3.0); };
  double expected = before;
  constexpr int steps = 4000;
  constexpr double h = 0.05 / steps;
  for (int i = 0; i < steps; ++i) {
    const double k1 = slope(expected), k2 = slope(expected + h / 2 * k1), k3 = slope(expected + h / 2 * k2);
    expected += h / 6 * (k1 + 2 * k2 + 2 * k3 + slope(expected + h * k3));
  }
  const double after = strained(law, fast, before, 0.05, 2000);
  expect_close(after, expected, 1e-6);  // midpoint rule
  EXPECT_GT(strained(law, fast, 0.0, 0.25, 2000), 1.01 * after);
}

// Steinberg-Cochran-Guinan and Lund -----------------------------------------------------------------------------------

TEST(SteinbergCochranGuinan, StopsHardeningAtItsLargestStress) {
  const auto& law = sets::steinberg_copper;
  // 0.12 (1 + 36 e)^0.45 = 0.64 GPa
  const double capped_at = (std::pow(0.64 / 0.12, 1.0 / 0.45) - 1.0) / 36.0;
  auto at = copper_at(capped_at, 1e6, 300.0);
  at.shear_modulus = 47.7e9;
  expect_close(law(at), 0.64e9);
  at.plastic_strain = 2.0 * capped_at;
  EXPECT_EQ(law(at), 0.64e9);
  at.plastic_strain = 0.9 * capped_at;
  EXPECT_LT(law(at), 0.64e9);
}

TEST(SteinbergCochranGuinan, ScalesWithTheShearModulusWhateverPressureAndTemperature) {
  const auto ambient = copper_at(0.2, 1e6, 300.0);
  const double ratio = sets::steinberg_copper(ambient) / ambient.shear_modulus;
  for (double modulus : {20e9, 40e9, 90e9})
    for (double pressure : {-2e9, 0.0, 50e9})
      for (double temperature : {20.0, 700.0, 1300.0}) {
        auto at = ambient;
        at.shear_modulus = modulus;
        at.pressure = pressure;
        at.temperature = temperature;
        expect_close(sets::steinberg_copper(at) / modulus, ratio);
      }
}

/// r times the time that a dislocation takes per unit of strain, less one.
double lund_residual(const SteinbergCochranGuinanLund& law, double rate, double temperature, double stress) {
  const double y = stress / law.peierls_stress;
  const double E = 2.0 * law.kink_energy / (1.380649e-23 * temperature);
  // In one exponential, for its two parts overflow at low temperature.
  return std::exp(E * (1.0 - y) * (1.0 - y) - std::log(law.attempt_rate / rate)) + rate * law.drag_coefficient / stress - 1.0;
}

TEST(SteinbergCochranGuinanLund, ThermalStressSolvesTheImplicitLaw) {
  constexpr double tolerance = 1e-10;
  int solved = 0;
  for (int i = 0; i < 10000; ++i) {
    SteinbergCochranGuinanLund law = sets::lund_4340;
    law.attempt_rate = Range{1e3, 1e10, true}.at(halton(i, 2));
    law.drag_coefficient = Range{1.0, 1e6, true}.at(halton(i, 3));
    law.kink_energy = Range{0.05, 1.0}.at(halton(i, 5)) * sets::electron_volt;
    law.peierls_stress = Range{1e6, 3e9, true}.at(halton(i, 7));
    const double rate = Range{1e-12, 1e9, true}.at(halton(i, 11)), temperature = Range{5.0, 3000.0, true}.at(halton(i, 13));
    const double stress = law.thermal_stress(rate, temperature);
    const double drag_rate = 1.0 / (1.0 / law.attempt_rate + law.drag_coefficient / law.peierls_stress);
    if (rate < drag_rate) {
      ++solved;
      ASSERT_LE(std::abs(lund_residual(law, rate, temperature, stress)), tolerance) << rate << ' ' << temperature;
    } else {
      ASSERT_EQ(stress, law.peierls_stress) << rate << ' ' << temperature;
    }
  }
  EXPECT_GT(solved, 5000);
}

TEST(SteinbergCochranGuinanLund, ReachesThePeierlsStressContinuouslyAndKeepsIt) {
  const auto& law = sets::lund_4340;
  const double last = 1.0 / (1.0 / 3.1e6 + 2.4e4 / 7e8);
  EXPECT_LT(law.thermal_stress(0.99 * last, 300.0), 7e8);
  // The stress meets sP with slope dsT/dr = sP/(r d) = sP/r: a relative gap of rate becomes one of stress.
  expect_close(law.thermal_stress(last * (1.0 - 1e-9), 300.0), 7e8, 2e-9);
  EXPECT_EQ(law.thermal_stress(1.001 * last, 300.0), 7e8);
  EXPECT_EQ(law.thermal_stress(1e12, 300.0), 7e8);
}

TEST(SteinbergCochranGuinanLund, HasNoThermalStressWithoutRate) {
  auto rate_free = copper_at(0.2, 0.0, 300.0), cold = copper_at(0.2, 0.0, 3.0);
  for (const auto& at : {rate_free, cold}) EXPECT_EQ(sets::lund_copper(at), sets::steinberg_copper(at));
}

TEST(SteinbergCochranGuinanLund, AddsTheThermalStressToTheHardenedOneUnderTheSameModulus) {
  auto at = copper_at(0.2, 1e3, 300.0);
  at.shear_modulus = 0.8 * 47.7e9;
  expect_close(sets::lund_copper(at), sets::steinberg_copper(at) + 0.8 * sets::lund_copper.thermal_stress(1e3, 300.0));
}

// Zerilli-Armstrong ---------------------------------------------------------------------------------------------------

TEST(ZerilliArmstrong, WithoutStrainABodyCentredMetalHasItsThermalExponential) {
  for (double rate : {1e-3, 1.0, 1e4})
    for (double temperature : {77.0, 300.0, 900.0}) {
      const double beta = 0.00698 - 0.000415 * std::log(rate);
      expect_close(sets::zerilli_iron(copper_at(0.0, rate, temperature)), 1033e6 * std::exp(-beta * temperature));
    }
}

TEST(ZerilliArmstrong, FaceCentredHardeningGrowsWithTheRootOfStrainAndBodyCentredIgnoresTemperature) {
  const auto& copper = sets::zerilli_copper;
  const auto gain = [](const auto& law, double strain, double temperature) {
    return law(copper_at(strain, 1e3, temperature)) - law(copper_at(0.0, 1e3, temperature));
  };
  expect_close(gain(copper, 0.4, 300.0) / gain(copper, 0.1, 300.0), 2.0, 1e-11);
  EXPECT_GT(gain(copper, 0.4, 100.0), 1.5 * gain(copper, 0.4, 600.0));
  expect_close(gain(sets::zerilli_iron, 0.4, 100.0), 266e6 * std::pow(0.4, 0.289), 1e-11);
  expect_close(gain(sets::zerilli_iron, 0.4, 1000.0), 266e6 * std::pow(0.4, 0.289), 1e-11);
}

// Preston-Tonks-Wallace -----------------------------------------------------------------------------------------------

/// Saturation and yield, each over 2 mu, written out again.
struct PrestonStresses {
  double saturation, yield;
};
PrestonStresses preston_stresses(const PrestonTonksWallace& law, const Arguments<double>& at) {
  const double M = law.atomic_mass * 1.66053906660e-27, pi = 3.14159265358979323846;
  const double xi = 0.5 * std::cbrt(4.0 * pi * at.density / (3.0 * M)) * std::sqrt(at.shear_modulus / at.density);
  const double x = at.plastic_strain_rate / (law.gamma * xi);
  const double u = law.kappa * at.temperature / at.melting_temperature * std::log(1.0 / x);
  const double shock = law.s0 * std::pow(x, law.beta);
  return {std::max(law.s0 - (law.s0 - law.s_inf) * std::erf(u), shock),
          std::max(law.y0 - (law.y0 - law.y_inf) * std::erf(u), std::min(law.y1 * std::pow(x, law.y2), shock))};
}

TEST(PrestonTonksWallace, GoesFromYieldToSaturationWithInitialSlopeTheta) {
  using Number = Dual<double>;
  for (double p : {0.0, 1e-8, 1e-3, 0.5, 2.0, 5.0})
    for (double rate : {1e-3, 1e3, 1e6}) {
      auto law = sets::preston_copper;
      law.p = p;
      auto at = copper_at(0.0, rate, 300.0);
      const auto [saturation, yield] = preston_stresses(law, at);
      expect_close(law(at), 2.0 * at.shear_modulus * yield);
      at.plastic_strain = 1000.0;
      expect_close(law(at), 2.0 * at.shear_modulus * saturation, 1e-8);  // 1/p digits of log1p at p = 1e-8
      const Arguments<Number> start{Number::variable(0.0), rate, at.temperature, at.melting_temperature,
                                    at.shear_modulus,      0.0,  at.density};
      expect_close(law(start).derivative[0], 2.0 * at.shear_modulus * 0.025);
    }
}

TEST(PrestonTonksWallace, TendsToVoceHardeningAsPVanishes) {
  constexpr double tolerance = 1e-5;
  for (double strain : {0.01, 0.1, 0.5, 2.0})
    for (double rate : {1e-3, 1e3, 1e6}) {
      auto law = sets::preston_tantalum;
      auto at = copper_at(strain, rate, 300.0);
      at.melting_temperature = 3290.0;
      at.shear_modulus = 69e9;
      at.density = 16690.0;
      const double voce = law(at);
      const auto [saturation, yield] = preston_stresses(law, at);
      expect_close(voce, 138e9 * (saturation - (saturation - yield) * std::exp(-0.02 * strain / (saturation - yield))));
      law.p = 1e-6;
      expect_close(law(at), voce, tolerance);
      EXPECT_NE(law(at), voce);
    }
}

TEST(PrestonTonksWallace, OverdrivenShockIsAPowerOfTheRateWithoutHardening) {
  const auto& law = sets::preston_copper;
  const auto strength = [&](double strain, double rate) { return law(copper_at(strain, rate, 300.0)); };
  EXPECT_EQ(strength(0.0, 1e12), strength(1.0, 1e12));
  expect_close(std::log(strength(0.1, 1e13) / strength(0.1, 1e12)), 0.25 * std::log(10.0));
}

TEST(PrestonTonksWallace, EnteringTheShockRegimeIsContinuous) {
  for (const auto* law : {&sets::preston_copper, &sets::preston_tantalum}) {
    double last = (*law)(copper_at(0.1, 1e5, 300.0));
    for (double exponent = 5.0; exponent < 13.0; exponent += 1e-3) {
      const double Y = (*law)(copper_at(0.1, std::pow(10.0, exponent), 300.0));
      ASSERT_LE(Y / last, std::pow(10.0, 1e-3)) << exponent;  // no law of the rate here is steeper than linear
      last = Y;
    }
  }
}

// Derivatives ---------------------------------------------------------------------------------------------------------

/// Strain, rate, temperature, melting temperature, shear modulus, density, threshold stress at the start.
template <class Law>
void expect_exact(const Law& law, const char* name) {
  SCOPED_TRACE(name);
  double modulus = 50e9;
  if constexpr (requires { law.reference_shear_modulus; }) modulus = law.reference_shear_modulus;
  test::expect_exact_derivatives<7>(
      [&]<class Real>(const std::array<Real, 7>& x) {
        const Arguments<Real> at{x[0], x[1], x[2] * x[3], x[3], x[4], Real(0.0), x[5]};
        return evaluate(law, at, x[6], Real(0.01 * x[0])).flow_stress;
      },
      {Range{1e-4, 1.0, true}, Range{1e-4, 1e9, true}, Range{0.03, 0.97}, Range{900.0, 2500.0},
       Range{0.6 * modulus, 1.6 * modulus}, Range{2000.0, 20000.0}, Range{5e7, 9e8}});
}

TEST(FlowStress, DualNumbersGiveTheDerivativesOfEveryLaw) {
  sets::for_each([](const auto& law, const char* name) { expect_exact(law, name); });
}

TEST(MechanicalThresholdStress, DualNumbersGiveTheDerivativesOfTheHistory) {
  for (const auto* law : {&sets::threshold_copper, &sets::threshold_hy100})
    test::expect_exact_derivatives<5>(
        [&]<class Real>(const std::array<Real, 5>& x) {
          const Arguments<Real> at{Real(0.1), x[0], x[1], Real(1800.0), x[2], Real(0.0), Real(8000.0)};
          return advance_history(*law, at, x[3], x[4]);
        },
        {Range{1e-4, 1e9, true}, Range{20.0, 1000.0}, Range{40e9, 80e9}, Range{0.0, 9e8}, Range{1e-6, 1e-2, true}});
}

TEST(SteinbergCochranGuinanLund, ThermalStressGivesSecondDerivativesToo) {
  // d2 sT/dT2 from duals of duals against the difference of first derivatives.
  using First = Dual<double>;
  using Second = Dual<First>;
  const auto& law = sets::lund_4340;
  for (double temperature : {200.0, 300.0, 500.0}) {
    const Second T(First::variable(temperature), {First(1.0)});
    const double exact = law.thermal_stress(Second(1e3), T).derivative[0].derivative[0];
    const auto slope = [&](double t) { return law.thermal_stress(First(1e3), First::variable(t)).derivative[0]; };
    const double h = 1e-2;
    const double difference =
        (8.0 * (slope(temperature + h) - slope(temperature - h)) - (slope(temperature + 2 * h) - slope(temperature - 2 * h))) /
        (12.0 * h);
    expect_close(exact, difference, 1e-6);  // rounding of the slopes over h
  }
}

}  // namespace
}  // namespace brisance::flow_stress
