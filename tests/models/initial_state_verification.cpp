// The states that bodies start from, against closed forms of thermal expansion.

#include <gtest/gtest.h>

#include <cmath>

#include "models/update.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance {
namespace {

using namespace samples;

// Annealed copper.
constexpr double rho0 = 8930.0, c0 = 3940.0, s = 1.489, gruneisen = 2.02, cv = 383.0, T0 = 298.0;
constexpr double modulus = rho0 * c0 * c0;
constexpr double round_off = 1e-12;

template <class Law>
Material copper() {
  Material m;
  m.name = "copper";
  m.density = rho0;
  m.equation_of_state = Law{rho0, c0, s, gruneisen, cv, T0};
  m.shear_modulus = shear_modulus::VarshniChenGray{.zero_temperature_value = 47.7e9, .D = 3e9, .T0 = 180.0};
  return m;
}
using ByTemperature = equation_of_state::MieGruneisenTemperature;
using ByEnergy = equation_of_state::MieGruneisenEnergy;

double pressure(const State<double>& state) {
  return -trace(state.stress) / 3.0;
}

TEST(InitialState, HeatedAtConstantDensityIsUnderThermalPressure) {
  for (const double T : {100.0, 298.0, 718.0, 1300.0})
    EXPECT_NEAR(pressure(initial_state(copper<ByTemperature>(), T)), gruneisen * rho0 * cv * (T - T0), round_off * modulus);
}

TEST(StressFreeState, HotCopperHasExpanded) {
  // In tension the reference curve is rho0 c0^2 x with x = 1 - rho0/rho, which thermal pressure balances.
  for (const double T : {298.0, 400.0, 718.0, 1300.0}) {
    const State<double> state = stress_free_state(copper<ByTemperature>(), T);
    EXPECT_NEAR(state.density, rho0 / (1.0 + gruneisen * cv * (T - T0) / (c0 * c0)), round_off * rho0) << T;
    EXPECT_NEAR(norm(state.stress), 0.0, round_off * modulus) << T;
    EXPECT_EQ(state.temperature, T);
  }
}

TEST(StressFreeState, ColdCopperHasContracted) {
  // c0^2 x (1 - Gamma0 x/2) = D (1 - s x)^2 with D = Gamma0 cv (T0 - T), a quadratic equation in x.
  for (const double T : {20.0, 77.0, 200.0}) {
    const double D = gruneisen * cv * (T0 - T);
    const double a = -0.5 * gruneisen * c0 * c0 - D * s * s, b = c0 * c0 + 2.0 * s * D;
    const double x = 2.0 * D / (b + std::sqrt(b * b + 4.0 * a * D));
    const State<double> state = stress_free_state(copper<ByTemperature>(), T);
    EXPECT_NEAR(state.density, rho0 / (1.0 - x), round_off * rho0) << T;
    EXPECT_NEAR(norm(state.stress), 0.0, round_off * modulus) << T;
  }
}

TEST(StressFreeState, ExpandsAtFirstByTheThermodynamicCoefficient) {
  // beta = Gamma0 cv/c0^2 with the isothermal modulus K_T = K - Gamma0^2 rho0 cv T0 in the place of K where the energy of the
  // law is the whole energy. The law of temperature leaves the work of compression out of it: its own isothermal modulus is K.
  const double beta = gruneisen * cv / (c0 * c0);
  // The reference curve has a curvature in compression and none in tension, which leaves half of (2 s - Gamma0/2) beta dT in
  // the central difference.
  constexpr double dT = 0.1;
  const double curvature = s * beta * dT;
  const auto expansion = [](const Material& m) {
    return (stress_free_state(m, T0 - dT).density - stress_free_state(m, T0 + dT).density) / (2.0 * dT * rho0);
  };
  EXPECT_NEAR(expansion(copper<ByTemperature>()) / beta, 1.0, curvature);
  const double isothermal = 1.0 - gruneisen * gruneisen * cv * T0 / (c0 * c0);
  EXPECT_NEAR(expansion(copper<ByEnergy>()) * isothermal / beta, 1.0, curvature);
}

TEST(StressFreeState, MayBeUnderAPressure) {
  for (const double p : {-1e9, -1e6, 1e6, 1e9})
    for (const double T : {298.0, 718.0}) {
      EXPECT_NEAR(pressure(stress_free_state(copper<ByTemperature>(), T, p)), p, round_off * modulus);
      EXPECT_NEAR(pressure(stress_free_state(copper<ByEnergy>(), T, p)), p, round_off * modulus);
      const double x = (p - gruneisen * rho0 * cv * (T - T0)) / modulus;
      if (x < 0.0) {
        EXPECT_NEAR(stress_free_state(copper<ByTemperature>(), T, p).density, rho0 / (1.0 - x), round_off * rho0);
      }
    }
}

TEST(StressFreeState, StaysFreeOfStressAtRest) {
  for (const Material& m : {copper<ByTemperature>(), copper<ByEnergy>()})
    for (const double T : {77.0, 718.0}) {
      Specimen<double> bar(m, stress_free_state(m, T));
      bar.steps(100, {}, 1e-6);
      EXPECT_EQ(bar.trouble(), Trouble::none);
      EXPECT_NEAR(norm(bar.state().stress), 0.0, round_off * modulus) << T;
      EXPECT_NEAR(bar.state().temperature, T, round_off * T);
    }
}

TEST(StressFreeState, HasTheShearModulusOfItsTemperature) {
  for (const double T : {77.0, 718.0})
    EXPECT_NEAR(stress_free_state(copper<ByTemperature>(), T).shear_modulus, 47.7e9 - 3e9 / std::expm1(180.0 / T),
                round_off * 47.7e9);
}

TEST(StressFreeState, WithoutThermalPressureIsTheSameAtAllTemperatures) {
  for (const Material& m : {elastic(), hypoelastic()})
    for (const double T : {77.0, 298.0, 1000.0}) {
      EXPECT_NEAR(stress_free_state(m, T).density, m.density, round_off * m.density);
      EXPECT_NEAR(norm(stress_free_state(m, T).stress), 0.0, round_off * 160e9);
    }
}

TEST(StressFreeState, OfAGasNeedsAPressure) {
  constexpr double atmosphere = 101325.0;
  EXPECT_EQ(stress_free_state(air(), 300.0).density, air().density);
  for (const double T : {300.0, 3000.0})
    EXPECT_NEAR(stress_free_state(air(), T, atmosphere).density / (atmosphere / (0.4 * 716.0 * T)), 1.0, round_off);
}

}  // namespace
}  // namespace brisance
