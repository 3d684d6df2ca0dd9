// Heat and temperature through the update, against closed forms: plastic heating, viscous heating, melting, reversible
// compression, and the energy of a Mie-Grueneisen solid.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "models/update.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance {
namespace {

using namespace samples;

// A few hundred steps, each with some ten roundings.
constexpr double round_off = 1e-12;
// The return to the yield surface stops at this part of the flow stress, which the heat inherits.
constexpr double return_tolerance = 1e-9;

constexpr double G = 80e9, rho = 7860.0, chi = 0.9;

template <class Real>
class Heat : public ::testing::Test {};
using Numbers = ::testing::Types<double, Lanes>;
TYPED_TEST_SUITE(Heat, Numbers);

Tensor<double> diagonal(double x, double y, double z) {
  Tensor<double> L;
  L.xx = x, L.yy = y, L.zz = z;
  return L;
}
/// Extension that keeps the volume.
Tensor<double> extension(double rate) {
  return diagonal(rate, -0.5 * rate, -0.5 * rate);
}

Material heated(FlowStress flow, SpecificHeat specific_heat, Material m = hypoelastic()) {
  m.flow_stress = flow;
  m.yield = yield::VonMises{};
  m.melting = melting::Constant{1793.0};
  m.specific_heat = specific_heat;
  m.heating = Heating{constant_table(chi), true, false};
  return m;
}

/// A quantity after a run in so many steps, its first-order error taken away: twice the fine result less the coarse one.
double extrapolated(const std::function<double(int)>& run, int steps) {
  const double coarse = run(steps), fine = run(2 * steps);
  return 2.0 * fine - coarse;
}
// What is left then is of second order; over a thousand steps and more that is a few parts in a million.
constexpr double second_order = 1e-5;

TYPED_TEST(Heat, OfAConstantFlowStressIsItsWork) {
  constexpr double Y = 500e6, cp = 477.0;
  Specimen<TypeParam> specimen(heated(flow_stress::LinearHardening{Y, 0.0}, specific_heat::Constant{cp}));
  specimen.steps(500, extension(1e-3), 1.0);
  const State<double> s = specimen.state();
  EXPECT_GT(s.plastic_strain, 0.4);
  const double rise = chi * Y * s.plastic_strain / (rho * cp);
  EXPECT_NEAR(s.temperature - room_temperature, rise, return_tolerance * rise);
}

TYPED_TEST(Heat, WithASpecificHeatThatRisesLinearlyFollowsItsIntegral) {
  constexpr double Y = 800e6, a = 300.0, b = 0.5;
  const Material m = heated(flow_stress::LinearHardening{Y, 0.0}, specific_heat::Polynomial{{a, b, 0.0, 0.0}, 0.0, 1e5});
  const auto defect = [&](int steps) {
    Specimen<TypeParam> specimen(m);
    specimen.steps(steps, extension(1.0 / steps), 1.0);
    const double T = specimen.state().temperature, T0 = room_temperature;
    return (a * (T - T0) + 0.5 * b * (T * T - T0 * T0)) / (chi * Y * specimen.state().plastic_strain / rho) - 1.0;
  };
  EXPECT_NEAR(defect(500) / defect(1000), 2.0, 0.05) << "first order";
  EXPECT_NEAR(extrapolated(defect, 1000), 0.0, second_order);
}

TYPED_TEST(Heat, OfJohnsonCooksLawWithLinearSofteningFollowsTheAdiabat) {
  const double A = 792e6, B = 510e6, n = 0.26, cp = 477.0, Tm = 1793.0, Tr = 298.0, T0 = 350.0;
  const Material m = heated(flow_stress::JohnsonCook{A, B, n, 0.0, 1.0, 1.0, Tr}, specific_heat::Constant{cp});
  const auto defect = [&](int steps) {
    Specimen<TypeParam> specimen(m, T0);
    specimen.steps(steps, extension(1.0 / steps), 1.0);
    const State<double> s = specimen.state();
    const double k = chi / (rho * cp * (Tm - Tr)), ep = s.plastic_strain;
    const double theta0 = (T0 - Tr) / (Tm - Tr);
    const double theta = 1.0 - (1.0 - theta0) * std::exp(-k * (A * ep + B * std::pow(ep, n + 1.0) / (n + 1.0)));
    return (s.temperature - Tr) / (Tm - Tr) / theta - 1.0;
  };
  EXPECT_NEAR(defect(1000) / defect(2000), 2.0, 0.1) << "first order";
  EXPECT_NEAR(extrapolated(defect, 2000), 0.0, second_order);
}

TYPED_TEST(Heat, IsTheTaylorQuinneyPartOfThePlasticWorkForEveryMetal) {
  for (Material m : {steel_4340(), steel_hy100()}) {
    m.specific_heat = specific_heat::Constant{500.0};
    m.heating = Heating{constant_table(chi), false, false};
    State<double> start = initial_state(m, room_temperature);
    if (m.porosity) start.porosity = 0.005;
    Specimen<TypeParam> specimen(m, start);
    double heat = 0.0;
    constexpr double dt = 1e-7;
    for (int i = 0; i < 200; ++i) {
      specimen.step(diagonal(5e3, -2e3, -1e3), dt);
      heat += chi * specimen[&Point<TypeParam>::plastic_work] / specimen.state().density;
    }
    EXPECT_GT(heat, 1e4);
    EXPECT_NEAR(500.0 * (specimen.state().temperature - room_temperature), heat, round_off * heat) << m.name;
  }
}

TYPED_TEST(Heat, TaylorQuinneyMayFollowATableOfPlasticStrain) {
  constexpr double Y = 500e6, cp = 477.0;
  Material m = heated(flow_stress::LinearHardening{Y, 0.0}, specific_heat::Constant{cp});
  Table table;  // rises from 0.4 to 0.8 over a plastic strain of 0.2
  table.size = 2, table.x = {0.0, 0.2}, table.y = {0.4, 0.8};
  m.heating->taylor_quinney = table;
  const auto defect = [&](int steps) {
    Specimen<TypeParam> specimen(m);
    specimen.steps(steps, extension(0.5 / steps), 1.0);
    const double ep = specimen.state().plastic_strain;
    const double integral = 0.6 * 0.2 + 0.8 * (ep - 0.2);
    return (specimen.state().temperature - room_temperature) / (Y * integral / (rho * cp)) - 1.0;
  };
  EXPECT_NEAR(extrapolated(defect, 1000), 0.0, second_order);
}

TYPED_TEST(Heat, OfArtificialViscosityIsItsWorkInTheTemperatureAndInTheEnergy) {
  constexpr double h = 1e-3, rate = 1e4, dt = 1e-9, cp = 477.0;
  const Tensor<double> L = diagonal(-rate, 0, 0);
  Material m = heated(flow_stress::LinearHardening{1e30, 0.0}, specific_heat::Constant{cp});
  for (const bool viscous : {true, false}) {
    m.heating->viscous = viscous;
    Specimen<TypeParam> with(m), without(m);
    with.batch.points[0].cell_size = TypeParam(h);
    double heat = 0.0;
    for (int i = 0; i < 100; ++i) {
      const double before = 1.0 / with.state().density, q_before = with[&Point<TypeParam>::artificial_viscosity];
      with.step(L, dt), without.step(L, dt);
      heat += 0.5 * (q_before + with[&Point<TypeParam>::artificial_viscosity]) * (before - 1.0 / with.state().density);
    }
    EXPECT_GT(heat, 1.0);
    EXPECT_NEAR(cp * (with.state().temperature - room_temperature), viscous ? heat : 0.0, 1e-9 * heat);
    EXPECT_NEAR(with.state().energy - without.state().energy, heat, 1e-9 * heat);
    EXPECT_EQ(without.state().temperature, room_temperature);
  }
}

// Melting --------------------------------------------------------------------------------------------------------------

TYPED_TEST(Heat, OfMeltingIsTheElasticEnergyOfTheDeviatorAndNoTensionIsLeft) {
  constexpr double cp = 477.0;
  for (const double volume : {-1e-3, 1e-3}) {
    Specimen<TypeParam> specimen(heated(flow_stress::LinearHardening{400e6, 0.0}, specific_heat::Constant{cp}));
    Tensor<double> L = diagonal(1e-3, -1e-3, 0.0);
    L.xy = 5e-4;
    specimen.step(L + (volume * Tensor<double>::identity()), 1.0);
    const SymmetricTensor<double> s = deviator(specimen.state().stress);
    const double pressure = -specimen.mean_stress(), density = specimen.state().density;
    EXPECT_GT(norm(s), 1e8);
    set_lane(specimen.batch.points[0].state.temperature, 0, 1800.0);
    specimen.step(Tensor<double>{}, 1.0);
    const double released = double_dot(s, s) / (4.0 * G * density);
    EXPECT_NEAR(cp * (specimen.state().temperature - 1800.0), released, round_off * cp * 1800.0);
    EXPECT_LE(norm(deviator(specimen.state().stress)), round_off * norm(s));
    EXPECT_EQ(specimen.state().shear_modulus, 0.0);
    EXPECT_NEAR(-specimen.mean_stress(), std::max(pressure, 0.0), round_off * std::abs(pressure));
    // It stays a liquid: shear meets no resistance, and nothing is released twice.
    const double temperature = specimen.state().temperature;
    L.xx = L.yy = 0.0;
    specimen.step(L, 1.0);
    EXPECT_LE(norm(deviator(specimen.state().stress)), round_off * norm(s));
    EXPECT_EQ(specimen.state().temperature, temperature);
    EXPECT_EQ(specimen.state().plastic_strain, 0.0);
  }
}

TYPED_TEST(Heat, FrozenMeltResistsShearAgain) {
  Specimen<TypeParam> specimen(heated(flow_stress::LinearHardening{400e6, 0.0}, specific_heat::Constant{477.0}));
  set_lane(specimen.batch.points[0].state.temperature, 0, 1800.0);
  specimen.step(extension(1e-4), 1.0);
  EXPECT_LE(specimen.equivalent_stress(), round_off * G);
  set_lane(specimen.batch.points[0].state.temperature, 0, 1700.0);
  specimen.step(extension(1e-4), 1.0);
  EXPECT_NEAR(specimen.equivalent_stress(), 3.0 * G * 1e-4, 1e-9 * G);
}

// Mie-Grueneisen -------------------------------------------------------------------------------------------------------

constexpr double rho0 = 8930.0, c0 = 3940.0, slope = 1.489, gamma0 = 2.02, cv = 383.0;

/// p(x, e) of the law, written again.
double mie_gruneisen(double x, double e) {
  const double d = 1.0 - slope * x;
  return (x < 0.0 ? rho0 * c0 * c0 * x : rho0 * c0 * c0 * x * (1.0 - 0.5 * gamma0 * x) / (d * d)) + rho0 * gamma0 * e;
}
/// Energy on the isentrope through rho0, e = 0 at x = 1 - rho0/rho: de = p dx/rho0, by the classical Runge-Kutta rule.
double isentropic_energy(double x) {
  constexpr int steps = 4000;
  const double h = x / steps;
  double e = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double at = i * h;
    const double k1 = mie_gruneisen(at, e) / rho0, k2 = mie_gruneisen(at + 0.5 * h, e + 0.5 * h * k1) / rho0;
    const double k3 = mie_gruneisen(at + 0.5 * h, e + 0.5 * h * k2) / rho0, k4 = mie_gruneisen(at + h, e + h * k3) / rho0;
    e += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
  }
  return e;
}

Material mie_gruneisen_solid() {
  Material m;
  m.name = "copper without strength";
  m.density = rho0;
  m.equation_of_state = equation_of_state::MieGruneisenEnergy{rho0, c0, slope, gamma0, cv, room_temperature};
  m.shear_modulus = shear_modulus::Constant{1.0};
  m.specific_heat = specific_heat::Constant{cv};
  m.heating = Heating{constant_table(chi), true, true};
  return m;
}

TYPED_TEST(Heat, CompressionWithoutDissipationFollowsTheMieGrueneisenIsentrope) {
  for (const double x : {0.02, 0.2, -0.05}) {
    const auto compressed = [&](int steps) {
      Specimen<TypeParam> specimen(mie_gruneisen_solid());
      const double rate = std::log(1.0 - x) / (3.0 * steps);
      specimen.steps(steps, diagonal(rate, rate, rate), 1.0);
      return specimen;
    };
    const double exact = isentropic_energy(x);
    const auto coarse = compressed(100), fine = compressed(200);
    const double coarse_error = coarse.state().energy / exact - 1.0, fine_error = fine.state().energy / exact - 1.0;
    EXPECT_LE(std::abs(coarse_error), 1e-3) << x;
    EXPECT_NEAR(coarse_error / fine_error, 4.0, 0.2) << "second order at x = " << x;
    EXPECT_NEAR((4.0 * fine.state().energy - coarse.state().energy) / 3.0, exact, 1e-7 * exact) << x;
    EXPECT_NEAR(-fine.mean_stress(), mie_gruneisen(x, fine.state().energy), 1e-10 * rho0 * c0 * c0);
  }
}

TYPED_TEST(Heat, ReversibleCompressionWarmsByTheGrueneisenCoefficient) {
  for (const double x : {0.02, 0.2, -0.05}) {
    const auto temperature = [&](int steps) {
      Specimen<TypeParam> specimen(mie_gruneisen_solid());
      const double rate = std::log(1.0 - x) / (3.0 * steps);
      specimen.steps(steps, diagonal(rate, rate, rate), 1.0);
      return specimen.state().temperature;
    };
    const double exact = room_temperature * std::exp(gamma0 * x);
    EXPECT_NEAR(extrapolated(temperature, 1000), exact, second_order * exact) << x;
  }
}

TYPED_TEST(Heat, PressureOfTheTemperatureFormAtTheReferenceDensityIsThermal) {
  const Material m = steel_4340();
  for (const double T : {200.0, 298.0, 600.0, 1200.0}) {
    Specimen<TypeParam> specimen(m, T);
    const double exact = 1.67 * 7830.0 * 477.0 * (T - 298.0);
    EXPECT_NEAR(-specimen.mean_stress(), exact, round_off * 1e10) << T;
    specimen.step(Tensor<double>{}, 1e-9);
    EXPECT_NEAR(-specimen.mean_stress(), exact, round_off * 1e10) << T;
  }
}

TYPED_TEST(Heat, GasIsCompressedAlongItsIsentrope) {
  constexpr double gamma = 1.4, factor = 3.0;  // in density
  const auto run = [&](int steps) {
    Specimen<TypeParam> specimen(air());
    const double rate = -std::log(factor) / (3.0 * steps);
    specimen.steps(steps, diagonal(rate, rate, rate), 1.0);
    return specimen;
  };
  const auto coarse = run(200), fine = run(400);
  const State<double> start = initial_state(air(), room_temperature);
  const double exact_p = -start.stress.xx * std::pow(factor, gamma), exact_T = room_temperature * std::pow(factor, gamma - 1.0);
  const auto error = [&](const auto& specimen) { return -specimen.mean_stress() / exact_p - 1.0; };
  EXPECT_NEAR(error(coarse) / error(fine), 4.0, 0.1);
  EXPECT_LE(std::abs(error(fine)), 1e-5);
  EXPECT_NEAR(fine.state().temperature, exact_T, 1e-5 * exact_T);
}

}  // namespace
}  // namespace brisance
