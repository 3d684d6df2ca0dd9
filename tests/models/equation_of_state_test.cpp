#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "models/equation_of_state/thermodynamics.hpp"

namespace brisance::equation_of_state {
namespace {

const MieGruneisenEnergy copper_energy{8930.0, 3940.0, 1.489, 2.02, 383.0, 294.0};
const MieGruneisenTemperature copper_temperature{8930.0, 3940.0, 1.489, 2.02, 383.0, 294.0};
const JonesWilkinsLee products{1835.0, 1668.9e9, 59.69e9, 5.9, 2.1, 0.45, 1000.0, 10.2e9};
const Tillotson aluminium{2700.0, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5.0, 5.0, 896.0, 294.0};
const Murnaghan unreacted{1840.0, 36e9, 7.4, 1e5, 1000.0, 300.0};
const BirchMurnaghan finite_strain{1840.0, 36e9, 7.4, 1e5, 1000.0, 300.0};
const Hypoelastic rate_form{7830.0, 160e9, 477.0, 294.0};
const Logarithmic logarithm{7830.0, 160e9, 477.0, 294.0};
const Hyperelastic stored{7830.0, 160e9, 477.0, 294.0};
const IdealGas air{1.4, 716.0};
const Abel propellant{1.25, 1500.0, 1e-3};
const StiffenedGas water{4.4, 6e8, 1000.0};
const TwuSimTassone hmx_gas{1.63, 514.96, -260.1385968, 7.955153678e-4};

/// Densities on which a law is exercised: within its range, and where the expanded side has a slope to invert.
struct Sample {
  double lowest, highest;
};
template <class Law>
Sample densities(const Law& law) {
  if constexpr (std::is_same_v<Law, Murnaghan> || std::is_same_v<Law, BirchMurnaghan>)
    return {law.reference_density, 1.9 * law.reference_density};
  else if constexpr (std::is_same_v<Law, JonesWilkinsLee>)
    return {1e-3 * law.reference_density, 2.0 * law.reference_density};
  else if constexpr (std::is_same_v<Law, Tillotson>)
    return {0.85 * law.reference_density, 2.0 * law.reference_density};
  else if constexpr (requires { law.reference_density; })
    return {0.7 * law.reference_density, std::min(1.6 * law.reference_density, law.range().highest)};
  else
    return {0.01, std::min(law.range().highest, 1000.0)};
}

template <class F>
void for_each_law(const F& f) {
  const auto named = [&](const auto& law) {
    SCOPED_TRACE(law.name);
    f(law);
  };
  std::apply([&](const auto&... law) { (named(law), ...); },
             std::tuple{copper_energy, copper_temperature, products, aluminium, unreacted, finite_strain, rate_form, logarithm,
                        stored, air, propellant, water, hmx_gas});
}

/// f(law, density, temperature) on random states of every law.
template <class F>
void for_random_states(const F& f, int count = 300) {
  for_each_law([&](const auto& law) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Sample sample = densities(law);
    for (int i = 0; i < count; ++i) {
      const double rho = sample.lowest * std::pow(sample.highest / sample.lowest, unit(random));
      f(law, rho, 250.0 + 4000.0 * unit(random));
    }
  });
}

TEST(EquationOfState, TheExamplesCoverTheWholeList) {
  int laws = 0;
  for_each_law([&](const auto&) { ++laws; });
  EXPECT_EQ(laws, int(std::variant_size_v<EquationOfState>));
}

// Round-off of an energy that is the difference of a large cold part and a small thermal one, or the like in pressure.
constexpr double round_trip = 1e-10;

TEST(Thermodynamics, TemperatureInvertsTheEnergy) {
  for_random_states(
      [](const auto& law, double rho, double T) { EXPECT_NEAR(temperature(law, rho, law.energy(rho, T)), T, round_trip * T); });
}

TEST(Thermodynamics, EnergyIsLinearInTemperature) {
  for_random_states([](const auto& law, double rho, double T) {
    const double middle = law.energy(rho, T), ends = 0.5 * (law.energy(rho, 0.5 * T) + law.energy(rho, 1.5 * T));
    EXPECT_NEAR(middle, ends, round_trip * std::max(std::abs(middle), 1e5));
    EXPECT_GT(specific_heat_at_constant_volume(law, rho), 0.0);
  });
}

TEST(Thermodynamics, DensityInvertsThePressureAtConstantTemperature) {
  for_random_states([](const auto& law, double rho, double T) {
    const double p = pressure_at(law, rho, T);
    EXPECT_NEAR(density_at(law, p, T), rho, round_trip * rho) << "T " << T << " p " << p;
  });
}

TEST(Thermodynamics, EnergyInvertsThePressureAtConstantDensity) {
  for_random_states([](const auto& law, double rho, double T) {
    if constexpr (!is_barotropic<std::decay_t<decltype(law)>>) {
      const double e = law.energy(rho, T), p = law.pressure(rho, e);
      // The pressure carries round-off of its largest term; divided by dp/de that is an error of the energy.
      const double error =
          1e-14 * (std::abs(p) + rho * sound_speed_squared(law, rho, e)) / pressure_slopes(law, rho, e).per_energy;
      EXPECT_NEAR(energy_at_pressure(law, rho, p), e, error + round_trip * std::abs(e)) << "rho " << rho << " T " << T;
    }
  });
}

TEST(Thermodynamics, OutOfReachPressuresGiveTheEndsOfTheRange) {
  EXPECT_DOUBLE_EQ(density_at(copper_energy, -1e15, 300.0), copper_energy.range().lowest);
  EXPECT_DOUBLE_EQ(density_at(copper_energy, 1e19, 300.0), copper_energy.range().highest);
  // Colder than absolute zero is not a state of the products.
  EXPECT_DOUBLE_EQ(energy_at_pressure(products, 1835.0, 0.0), products.energy(1835.0, 0.0));
}

TEST(Thermodynamics, BarotropicPressureIgnoresTheEnergy) {
  for_random_states([](const auto& law, double rho, double T) {
    if constexpr (is_barotropic<std::decay_t<decltype(law)>>) {
      EXPECT_EQ(law.pressure(rho, 0.0), law.pressure(rho, 1e6));
      EXPECT_EQ(energy_at_pressure(law, rho, T), law.energy(rho, law.reference_temperature));
    }
  });
}

TEST(Thermodynamics, DerivativesAreThoseOfCentralDifferences) {
  constexpr double truncation = 1e-6;  // of a central difference with a relative step of 1e-5, plus its round-off
  for_random_states([](const auto& law, double rho, double T) {
    const double e = law.energy(rho, T);
    const auto slopes = pressure_slopes(law, rho, e);
    const double dr = 1e-5 * rho, de = 1e-5 * std::max(std::abs(e), 1e5);
    if constexpr (requires { law.reference_density; })
      if (std::abs(rho - law.reference_density) < 2.0 * dr) return;  // a kink in the slope
    const double by_density = (law.pressure(rho + dr, e) - law.pressure(rho - dr, e)) / (2.0 * dr);
    const double by_energy = (law.pressure(rho, e + de) - law.pressure(rho, e - de)) / (2.0 * de);
    const double scale = slopes.per_density + slopes.per_energy * std::max(std::abs(e), 1e5) / rho;
    EXPECT_NEAR(slopes.per_density, by_density, truncation * scale) << "rho " << rho << " e " << e;
    EXPECT_NEAR(slopes.per_energy, by_energy, truncation * scale * rho / std::max(std::abs(e), 1e5)) << "rho " << rho;
  });
}

TEST(Thermodynamics, SolvedDensityCarriesItsDerivatives) {
  constexpr double root_error = 1e-9;  // the slope at a root that is known to about 1e-15, times the curvature of the law
  using Derived = Dual<double, 2>;
  for_random_states(
      [](const auto& law, double rho, double T) {
        const Derived p = pressure_at(law, Derived::variable(rho, 0), Derived::variable(T, 1));
        const Derived solved = density_at(law, Derived::variable(p.value, 0), Derived::variable(T, 1));
        EXPECT_NEAR(solved.derivative[0] * p.derivative[0], 1.0, root_error);
        EXPECT_NEAR(solved.derivative[1] * p.derivative[0], -p.derivative[1], root_error * (std::abs(p.derivative[1]) + 1e3));
      },
      50);
}

TEST(Thermodynamics, PressureRisesWithDensityAndTheSoundSpeedIsReal) {
  for_random_states([](const auto& law, double rho, double T) {
    const double e = law.energy(rho, T);
    EXPECT_GT(pressure_slopes(law, rho, e).per_density, 0.0) << "rho " << rho << " T " << T;
    EXPECT_GT(sound_speed_squared(law, rho, e), 0.0) << "rho " << rho << " T " << T;
    EXPECT_GE(gruneisen_coefficient(law, rho, e), 0.0);
    EXPECT_GE(expansion_coefficient(law, rho, T), 0.0);
  });
}

TEST(Thermodynamics, EverythingIsFiniteOverTheWholeRange) {
  for_each_law([](const auto& law) {
    const double lowest = std::max(law.range().lowest, 1e-3), highest = std::min(law.range().highest, 2000.0 * 5.0);
    const double floor = law.lowest_sound_speed();
    for (double rho = lowest; rho <= highest; rho *= 1.07)
      for (double e : {-1e5, 0.0, 1e4, 1e6, 3e6, 5e6, 1e7, 2e7, 1e8}) {
        const double c2 = sound_speed_squared(law, rho, e);
        EXPECT_TRUE(std::isfinite(law.pressure(rho, e)) && std::isfinite(temperature(law, rho, e))) << rho << " " << e;
        EXPECT_TRUE(std::isfinite(c2) && c2 >= floor * floor) << rho << " " << e;
        if (!is_barotropic<std::decay_t<decltype(law)>>) {
          EXPECT_GE(pressure_slopes(law, rho, e).per_energy, 0.0) << rho << " " << e;
        }
      }
  });
}

TEST(Thermodynamics, StrongTensionLeavesATenthOfTheSoundSpeed) {
  // c^2 = (c0^2/u^2)(1 + Gamma0 x) along the cold tension branch vanishes at x = -1/Gamma0.
  const double rho = 8930.0 / (1.0 + 0.9);
  EXPECT_DOUBLE_EQ(sound_speed_squared(copper_temperature, rho, 0.0), 394.0 * 394.0);
}

TEST(Thermodynamics, LanesGiveWhatTheyGiveAlone) {
  constexpr double library = 1e-12;  // exp and log of the lanes against those of the C library, amplified by cancellation
  for_each_law([](const auto& law) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Sample sample = densities(law);
    Lanes rho, T;
    for (int i = 0; i < Lanes::width; ++i) {
      rho.set(i, sample.lowest + (sample.highest - sample.lowest) * unit(random));
      T.set(i, 250.0 + 3000.0 * unit(random));
    }
    const Lanes e = law.energy(rho, T), p = law.pressure(rho, e), c2 = sound_speed_squared(law, rho, e);
    const Lanes solved = density_at(law, p, T);
    for (int i = 0; i < Lanes::width; ++i) {
      const double ei = law.energy(rho[i], T[i]), K = rho[i] * c2[i];
      EXPECT_NEAR(e[i], ei, library * (std::abs(ei) + 1e6));
      EXPECT_NEAR(p[i], law.pressure(rho[i], ei), library * (K + 1e6 * rho[i]));
      EXPECT_NEAR(c2[i], sound_speed_squared(law, rho[i], ei), 10.0 * library * c2[i]);
      // A lane among equals: the same bits as among others.
      const Lanes alone = density_at(law, Lanes(p[i]), Lanes(T[i]));
      EXPECT_EQ(alone[0], solved[i]);
    }
  });
}

/// Value and both slopes on the two sides of a join agree.
template <class Law>
void expect_smooth_in_density(const Law& law, double rho, double e, double curvature_scale) {
  constexpr double side = 1e-9;
  const auto left = pressure_slopes(law, rho * (1.0 - side), e), right = pressure_slopes(law, rho * (1.0 + side), e);
  const double jump = curvature_scale * side;
  EXPECT_NEAR(left.per_density, right.per_density, jump * std::abs(left.per_density)) << law.name;
  EXPECT_NEAR(left.pressure, right.pressure, 3.0 * side * rho * std::abs(left.per_density)) << law.name;
}

TEST(EquationOfState, BranchesJoinSmoothlyInDensity) {
  constexpr double ordinary = 100.0;  // |rho p''/p'| of a metal or explosive near its reference density
  expect_smooth_in_density(copper_energy, 8930.0, 1e5, ordinary);
  expect_smooth_in_density(copper_temperature, 8930.0, 1e5, ordinary);
  expect_smooth_in_density(aluminium, 2700.0, 1e6, ordinary);
  expect_smooth_in_density(aluminium, 2700.0, -1e4, ordinary);
  expect_smooth_in_density(unreacted, 1840.0, 0.0, 2.0 * 36e9 / 1e5);  // the expanded side decays with the exponent K0/p0
  expect_smooth_in_density(finite_strain, 1840.0, 0.0, 2.0 * 36e9 / 1e5);
  // Close to the poles the compressed side bends within 2 to 5 % of the density.
  expect_smooth_in_density(copper_energy, copper_energy.range().highest, 1e5, 1e4);
  expect_smooth_in_density(propellant, propellant.range().highest, 3e6, 1e4);
  expect_smooth_in_density(hmx_gas, hmx_gas.range().highest, 3e6, 1e4);
}

TEST(EquationOfState, PressureKeepsRisingBeyondTheRange) {
  const auto rises = [](const auto& law, double e) {
    const double end = law.range().highest;
    EXPECT_GT(law.pressure(1.1 * end, e), law.pressure(end, e));
    EXPECT_GT(law.pressure(2.0 * end, e), law.pressure(1.1 * end, e));
  };
  rises(copper_energy, 0.0);
  rises(copper_temperature, 0.0);
  rises(propellant, 3e6);
  rises(hmx_gas, 3e6);
}

TEST(Hypoelastic, IncrementsAddUpAlongAnyPath) {
  const auto step = [](double from, double to) { return rate_form.pressure(to, 0.0) - rate_form.pressure(from, 0.0); };
  constexpr double round_off = 1e-12 * 160e9;
  EXPECT_NEAR(step(7830.0, 8000.0) + step(8000.0, 7700.0), 160e9 * std::log(7700.0 / 7830.0), round_off);
  EXPECT_EQ(Hypoelastic::caloric, Caloric::incremental);
}

TEST(JonesWilkinsLee, ProductsNeverPull) {
  for (double rho : {1e-3, 1.0, 100.0, 1835.0, 4000.0})
    for (double e : {-1e7, 0.0, 1e6}) EXPECT_GE(products.pressure(rho, e), 0.0) << rho << " " << e;
}

TEST(Tillotson, GivesTheValuesOfItsThreeBranches) {
  // By separate arithmetic from the formulas in the header, aluminium.
  constexpr double round_off = 1e-12;
  struct Value {
    double rho, e, p;
  };
  for (const Value& v : {Value{3240.0, 4e6, 37700228571.42857}, Value{5400.0, 5e7, 400942857142.8572},  // compressed
                         Value{2600.0, 1e6, 2000928224.4035177},                                        // cold, expanded
                         Value{2500.0, 8e6, 16535449579.241787},                                        // partly vaporized
                         Value{1500.0, 2e7, 15117831954.27483}})                                        // vapour
    EXPECT_NEAR(aluminium.pressure(v.rho, v.e), v.p, round_off * v.p);
}

TEST(Tillotson, IsContinuousInTheEnergyWhereVaporizationStartsAndEnds) {
  for (double e : {3e6, 13.9e6})
    for (double rho : {600.0, 1500.0, 2600.0}) {
      const double below = aluminium.pressure(rho, e - 1.0), above = aluminium.pressure(rho, e + 1.0);
      EXPECT_NEAR(above, below, 1e5) << rho;  // 2 J/kg times at most 1e4 kg/m^3, against pressures of 1e9 to 1e10 Pa
    }
}

TEST(Tillotson, DiluteHotVapourIsAnIdealGas) {
  const double rho = 0.01 * 2700.0, e = 5e7;
  EXPECT_NEAR(aluminium.pressure(rho, e), 0.5 * rho * e, 1e-12 * rho * e);
}

TEST(Tillotson, NegativeEnergiesKeepTheCoefficientOfTheColdSolid) {
  const double e = -5e6;  // where the formula read literally has a pole
  EXPECT_NEAR(aluminium.pressure(2700.0, e), (0.5 + 1.63) * 2700.0 * e, 1e-12 * 2.9e10);
}

TEST(TwuSimTassone, GivesThePressureOfItsTemperatureForm) {
  constexpr double round_off = 1e-12;
  struct Value {
    double rho, T, p;
  };
  for (const Value& v : {Value{1.0, 3000.0, 974308.893673217}, Value{100.0, 3000.0, 107926318.86084549},
                         Value{800.0, 2500.0, 1868512029.810804}})
    EXPECT_NEAR(pressure_at(hmx_gas, v.rho, v.T), v.p, round_off * v.p);
}

TEST(Murnaghan, GivesTheValueOfSeparateArithmetic) {
  constexpr double round_off = 1e-12;
  EXPECT_NEAR(unreacted.pressure(1.2 * 1840.0, 0.0), 13885698380.323168, round_off * 1.4e10);
  EXPECT_NEAR(finite_strain.pressure(1.2 * 1840.0, 0.0), 12574336096.449268, round_off * 1.3e10);
  EXPECT_DOUBLE_EQ(unreacted.pressure(1840.0, 0.0), 1e5);
  EXPECT_DOUBLE_EQ(finite_strain.pressure(1840.0, 0.0), 1e5);
}

TEST(Murnaghan, ExpansionKeepsThePressurePositive) {
  for (double u : {0.9999, 0.999999, 0.9999999}) {
    EXPECT_GT(unreacted.pressure(u * 1840.0, 0.0), 0.0);
    EXPECT_LT(unreacted.pressure(u * 1840.0, 0.0), 1e5);
    EXPECT_EQ(unreacted.pressure(u * 1840.0, 0.0), finite_strain.pressure(u * 1840.0, 0.0));
  }
}

TEST(Quadrature, IntegratesPolynomialsOfDegreeThirtyOne) {
  const auto f = [](double x) { return std::pow(x, 31.0) + x * x; };
  EXPECT_NEAR(integral(f, 0.0, 2.0), std::pow(2.0, 32.0) / 32.0 + 8.0 / 3.0, 1e-14 * std::pow(2.0, 27.0));
}

TEST(BracketedRoot, BisectsWhereNewtonHasNoSlope) {
  // Flat on both sides of a steep front at 0.3, started on the plateau.
  const auto front = [](const Dual<double>& x) { return tanh(1e4 * (x - 0.3)) + 0.5; };
  EXPECT_NEAR(increasing_root<double>(front, 0.0, 1.0, 0.9), 0.3 - 1e-4 * std::atanh(0.5), 1e-15);
}

TEST(BracketedRoot, StaysInTheBracketWithoutARoot) {
  const auto line = [](const Dual<double>& x) { return x - 5.0; };
  EXPECT_EQ(increasing_root<double>(line, 0.0, 1.0, 0.5), 1.0);
  EXPECT_EQ(increasing_root<double>(line, 6.0, 9.0, 7.0), 6.0);
}

TEST(Thermodynamics, TheVariantSpeaksForItsLaw) {
  const EquationOfState law = products;
  EXPECT_EQ(caloric(law), Caloric::complete);
  EXPECT_EQ(pressure(law, 1000.0, 4e6), products.pressure(1000.0, 4e6));
  EXPECT_EQ(energy(law, 1000.0, 2000.0), products.energy(1000.0, 2000.0));
  EXPECT_EQ(temperature(law, 1000.0, 4e6), temperature(products, 1000.0, 4e6));
  EXPECT_EQ(density_at(law, 1e9, 3000.0), density_at(products, 1e9, 3000.0));
  EXPECT_EQ(energy_at_pressure(law, 1000.0, 5e9), energy_at_pressure(products, 1000.0, 5e9));
  EXPECT_EQ(bulk_modulus(law, 1000.0, 4e6), 1000.0 * sound_speed_squared(products, 1000.0, 4e6));
  EXPECT_EQ(range(law).highest, 3.0 * 1835.0);
}

}  // namespace
}  // namespace brisance::equation_of_state
