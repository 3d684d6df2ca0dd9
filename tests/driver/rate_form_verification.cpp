// The rate form against closed forms, and the incremental update against the rate form.

#include "driver/rate_form.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "driver/point.hpp"
#include "models/update.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance::driver {
namespace {

// The laws alone decide the results below, so round-off and the tolerance of the integration are all there is.
constexpr double integration_tolerance = 1e-8;  // relative; each step is held to 1e-10

constexpr double copper_density = 8930.0, room_temperature = 298.0;

Material johnson_cook_copper(double rate_coefficient, double thermal_exponent) {
  Material m = samples::copper_johnson_cook();
  auto& law = std::get<flow_stress::JohnsonCook>(*m.flow_stress);
  law.C = rate_coefficient, law.m = thermal_exponent;
  return m;
}
Material elastic_copper() {
  Material m = samples::copper_johnson_cook();
  m.flow_stress.reset(), m.yield.reset(), m.specific_heat.reset(), m.heating.reset();
  return m;
}

State<double> run(const Material& material, const State<double>& start, const Tensor<double>& L, double duration) {
  return integrate_rate_form(
      material, start, [&](double) { return L; }, 0.0, duration);
}
Tensor<double> simple_shear(double rate) {
  Tensor<double> L;
  L.xy = rate;
  return L;
}
/// Extension along x that keeps the volume.
Tensor<double> isochoric_extension(double rate) {
  Tensor<double> L;
  L.xx = rate, L.yy = L.zz = -0.5 * rate;
  return L;
}

// Closed forms --------------------------------------------------------------------------------------------------------

TEST(RateForm, JaumannStressOscillatesInSimpleShear) {
  const Material copper = elastic_copper();
  const double G = 45e9;
  for (const double shear : {0.1, 1.0, 4.0}) {
    const auto s = run(copper, initial_state(copper, room_temperature), simple_shear(1e4), shear * 1e-4).stress;
    EXPECT_NEAR(s.xy, G * std::sin(shear), integration_tolerance * G);
    EXPECT_NEAR(s.xx, G * (1.0 - std::cos(shear)), integration_tolerance * G);
    EXPECT_NEAR(s.yy, -G * (1.0 - std::cos(shear)), integration_tolerance * G);
    EXPECT_NEAR(s.zz, 0.0, integration_tolerance * G);
  }
}

TEST(RateForm, GreenNaghdiStressGrowsMonotonicallyInSimpleShear) {
  Material copper = elastic_copper();
  copper.objective_rate = ObjectiveRate::green_naghdi;
  const double G = 45e9;
  for (const double shear : {0.1, 1.0, 4.0}) {
    const auto s = run(copper, initial_state(copper, room_temperature), simple_shear(1e4), shear * 1e-4).stress;
    const double b = std::atan(0.5 * shear), c = std::cos(2.0 * b), log_cos = std::log(std::cos(b));
    const double normal = 4.0 * G * (c * log_cos + b * std::sin(2.0 * b) - std::sin(b) * std::sin(b));
    EXPECT_NEAR(s.xy, 2.0 * G * c * (2.0 * b - 2.0 * std::tan(2.0 * b) * log_cos - std::tan(b)), integration_tolerance * G);
    EXPECT_NEAR(s.xx, normal, integration_tolerance * G);
    EXPECT_NEAR(s.yy, -normal, integration_tolerance * G);
  }
}

TEST(RateForm, AdiabaticJohnsonCookWithLinearSofteningFollowsTheExponential) {
  const double C = 0.0;  // without rate dependence the plastic rate comes from consistency alone
  const Material copper = johnson_cook_copper(C, 1.0);
  const State<double> end = run(copper, initial_state(copper, room_temperature), isochoric_extension(1e3), 1e-3);
  const double melting = 1356.0, ep = end.plastic_strain;
  const double k = 0.9 / (copper_density * 383.0 * (melting - room_temperature));
  const double homologous = 1.0 - std::exp(-k * (90e6 * ep + 292e6 * std::pow(ep, 1.31) / 1.31));
  EXPECT_GT(ep, 0.9);
  EXPECT_NEAR((end.temperature - room_temperature) / (melting - room_temperature), homologous, integration_tolerance);
  const double Y = (90e6 + 292e6 * std::pow(ep, 0.31)) * (1.0 - homologous);
  EXPECT_NEAR(equivalent_stress(deviator(end.stress)) / Y, 1.0, integration_tolerance);
}

TEST(RateForm, JohnsonCookStressAtASteadyRateIsTheFlowStressAtThatRate) {
  Material copper = johnson_cook_copper(0.025, 1.09);
  copper.heating.reset();  // isothermal
  const State<double> end = run(copper, initial_state(copper, room_temperature), isochoric_extension(1e3), 1e-3);
  const double Y = std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.C; })
          return (law.A + law.B * std::pow(end.plastic_strain, law.n)) * (1.0 + law.C * std::log(end.plastic_strain_rate));
        else
          return 0.0;
      },
      *copper.flow_stress);
  EXPECT_NEAR(equivalent_stress(deviator(end.stress)) / Y, 1.0, integration_tolerance);
  EXPECT_NEAR(end.plastic_strain_rate, 1e3, 3.0);  // the elastic strain still grows a little with hardening
  EXPECT_EQ(end.temperature, room_temperature);
}

TEST(RateForm, ElasticUnloadingLeavesThePlasticStrainAlone) {
  const Material copper = johnson_cook_copper(0.025, 1.09);
  const State<double> loaded = run(copper, initial_state(copper, room_temperature), isochoric_extension(1e3), 1e-4);
  const double yield_strain = equivalent_stress(deviator(loaded.stress)) / (3.0 * 45e9);
  const State<double> unloaded = run(copper, loaded, isochoric_extension(-1e3), yield_strain * 1e-3);
  // The first instants of unloading still flow: a rate-dependent stress relaxes to the quasi-static surface.
  EXPECT_NEAR(unloaded.plastic_strain, loaded.plastic_strain, 1e-4);
  EXPECT_LT(equivalent_stress(deviator(unloaded.stress)), 0.05 * equivalent_stress(deviator(loaded.stress)));
}

TEST(RateForm, HydrostaticVoidGrowthStaysOnTheGursonLimitAndBalancesMass) {
  Material copper = elastic_copper();
  copper.specific_heat = specific_heat::Constant{.value = 383.0};
  copper.flow_stress = flow_stress::LinearHardening{.yield_stress = 200e6, .hardening_modulus = 300e6};
  const yield::GursonTvergaardNeedleman surface{.q1 = 1.5,
                                                .q2 = 1.0,
                                                .q3 = 2.25,
                                                .coalescence_porosity = 1.0,
                                                .coalescence_slope = 1.0,
                                                .return_to = yield::ReturnTo::porous_surface};
  copper.yield = surface;
  copper.porosity = porosity::Growth{};
  State<double> start = initial_state(copper, room_temperature);
  start.porosity = 0.01;
  Tensor<double> L = Tensor<double>::identity();
  const State<double> end = run(copper, start, 1e3 * L, 1e-4);
  EXPECT_GT(end.porosity, 0.1);
  EXPECT_NEAR(end.porosity, 1.0 - 0.99 * std::exp(-end.plastic_volume_strain), integration_tolerance);
  const double Y = 200e6 + 300e6 * end.plastic_strain;
  const double limit = 2.0 / 3.0 * Y * std::log(1.0 / (1.5 * end.porosity));
  EXPECT_NEAR(trace(end.stress) / 3.0 / limit, 1.0, integration_tolerance);
}

TEST(RateForm, RotatingTheWorldRotatesTheStress) {
  for (const auto rate : {ObjectiveRate::incremental_rotation, ObjectiveRate::green_naghdi}) {
    Material copper = johnson_cook_copper(0.025, 1.09);
    copper.objective_rate = rate;
    Tensor<double> L = isochoric_extension(1e3);
    L.xy = 700.0, L.zx = -300.0;
    const double duration = 2e-4, spin = 4.0 * std::numbers::pi / duration;  // two turns
    const State<double> still = run(copper, initial_state(copper, room_temperature), L, duration);
    // x* = Q(t) x gives L* = Q L Q^T + dQ/dt Q^T
    const auto turning = [&](double t) {
      Tensor<double> Q = Tensor<double>::identity(), W;
      Q.xx = Q.yy = std::cos(spin * t), Q.yx = std::sin(spin * t), Q.xy = -Q.yx;
      W.yx = spin, W.xy = -spin;
      return Q * L * transpose(Q) + W;
    };
    const State<double> turned = integrate_rate_form(copper, initial_state(copper, room_temperature), turning, 0.0, duration);
    EXPECT_LT(norm(turned.stress - still.stress), integration_tolerance * norm(still.stress));
    EXPECT_NEAR(turned.plastic_strain, still.plastic_strain, integration_tolerance * still.plastic_strain);
  }
}

// The incremental update against the rate form -----------------------------------------------------------------------

Material hy100_porous() {
  Material m;
  m.name = "hy100";
  m.density = 7860.0;
  m.equation_of_state = equation_of_state::MieGruneisenTemperature{.reference_density = 7860.0,
                                                                   .sound_speed = 4578.0,
                                                                   .slope = 1.33,
                                                                   .gruneisen = 1.67,
                                                                   .specific_heat = 477.0,
                                                                   .reference_temperature = room_temperature};
  m.shear_modulus = shear_modulus::VarshniChenGray{.zero_temperature_value = 71.46e9, .D = 2.9e9, .T0 = 204.0};
  m.melting = melting::Constant{.value = 1793.0};
  m.specific_heat = specific_heat::SteelGoto{};
  m.flow_stress = flow_stress::sets::threshold_hy100;
  m.yield = yield::GursonTvergaardNeedleman{.q1 = 1.5,
                                            .q2 = 1.0,
                                            .q3 = 2.25,
                                            .coalescence_porosity = 0.05,
                                            .coalescence_slope = 4.0,
                                            .return_to = yield::ReturnTo::porous_surface};
  m.porosity = porosity::ChuNeedleman{
      .volume_fraction = 0.04, .mean_strain = 0.1, .standard_deviation = 0.05, .nucleates_in_compression = false};
  m.damage = damage::JohnsonCook{.D1 = 0.05,
                                 .D2 = 3.44,
                                 .D3 = -2.12,
                                 .D4 = 0.002,
                                 .D5 = 0.61,
                                 .reference_strain_rate = 1.0,
                                 .reference_temperature = room_temperature,
                                 .min_fracture_strain = 0.01};
  m.heating = johnson_cook_copper(0.0, 1.0).heating;
  m.heating->thermoelastic = true;
  return m;
}

Material preston_tonks_wallace_copper() {
  Material m = johnson_cook_copper(0.0, 1.0);
  m.shear_modulus = shear_modulus::PrestonTonksWallace{.zero_temperature_value = 51.8e9, .A = 28e-12, .alpha = 0.20};
  m.flow_stress = flow_stress::sets::preston_copper;
  return m;
}

/// A plastic-bonded explosive: Maxwell elements and cracks in the place of shear modulus, flow stress and yield.
Material pbx9501() {
  Material m;
  m.name = "pbx9501";
  m.density = 1840.0;
  m.equation_of_state = equation_of_state::MieGruneisenTemperature{.reference_density = 1840.0,
                                                                   .sound_speed = 2500.0,
                                                                   .slope = 2.3,
                                                                   .gruneisen = 1.0,
                                                                   .specific_heat = 996.0,
                                                                   .reference_temperature = room_temperature};
  m.specific_heat = specific_heat::Constant{.value = 996.0};
  m.viscoelastic = samples::viscoelastics().front();
  m.heating = johnson_cook_copper(0.0, 1.0).heating;
  return m;
}

Material steinberg_lund_copper() {
  Material m = johnson_cook_copper(0.0, 1.0);
  m.shear_modulus = shear_modulus::SteinbergCochranGuinan{
      .ambient_value = 47.7e9, .A = 28.3e-12, .B = 3.77e-4, .reference_temperature = 300.0};
  m.melting = melting::SteinbergCochranGuinan{.ambient_value = 1790.0, .gruneisen = 2.02, .a = 1.5};
  m.flow_stress = flow_stress::sets::lund_copper;
  return m;
}

/// The update along a constant velocity gradient in equal steps.
State<double> update_in_steps(const Material& material, const State<double>& start, const Tensor<double>& L, double duration,
                              int steps) {
  PointUpdate update(material);
  State<double> s = start;
  for (int i = 0; i < steps; ++i) {
    const Point<double>& point = update(s, L, duration / steps, duration * (i + 1) / steps);
    EXPECT_EQ(trouble_of(point), Trouble::none) << facts(s, i * duration / steps);
    if (trouble_of(point) != Trouble::none) break;
    s = point.state;
  }
  return s;
}

/// The first power of the step: halving it halves the difference, or does better. Room is left for the next power.
constexpr double least_ratio = 1.8;
/// What is asked of the finest steps, and differences so small that the reference itself decides their ratio.
constexpr double agreement = 1e-6, reference_noise = 1e-8;

struct Steps {
  int coarse, fine;
};
/// Every quantity of the update tends to that of the rate form with the first power of the step or a higher one, and in the end
/// agrees with it.
void expect_convergence(const Material& material, const State<double>& start, const Tensor<double>& L, double duration,
                        Steps steps) {
  const State<double> reference = run(material, start, L, duration);
  const auto error = [&](int n) { return differences(update_in_steps(material, start, L, duration, n), reference); };
  const auto coarse = error(steps.coarse), half = error(2 * steps.coarse), fine = error(steps.fine);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    SCOPED_TRACE(coarse[i].quantity);
    EXPECT_LT(fine[i].relative, agreement);
    if (half[i].relative < reference_noise) continue;
    EXPECT_GT(coarse[i].relative / half[i].relative, least_ratio);
  }
}

TEST(Update, ConvergesForJohnsonCookInUniaxialCompression) {
  Material copper = johnson_cook_copper(0.025, 1.09);
  copper.heating->thermoelastic = true;
  Tensor<double> L;
  L.xx = -1e5;
  expect_convergence(copper, initial_state(copper, room_temperature), L, 2e-6, {1000, 100000});
}

TEST(Update, ConvergesForThresholdStressAndVoidsInTriaxialTension) {
  const Material steel = hy100_porous();
  State<double> start = initial_state(steel, room_temperature);
  start.porosity = 0.002;
  const Tensor<double> L = isochoric_extension(1e4) + 1e3 * Tensor<double>::identity();
  EXPECT_LT(run(steel, start, L, 1.5e-5).damage, 1.0);  // where it would stop, and differences with it
  expect_convergence(steel, start, L, 1.5e-5, {2000, 700000});
}

TEST(Update, ConvergesForPrestonTonksWallace) {
  const Material copper = preston_tonks_wallace_copper();
  expect_convergence(copper, initial_state(copper, room_temperature), isochoric_extension(1e4), 3e-5, {5000, 500000});
}

TEST(Update, OpeningVoidsDoNotDiluteTheMetalBetweenThem) {
  // Modulus and melting temperature depend on the density: that of the metal, not of metal and voids.
  Material copper = johnson_cook_copper(0.025, 1.09);
  copper.shear_modulus = shear_modulus::SteinbergCochranGuinan{
      .ambient_value = 47.7e9, .A = 28.3e-12, .B = 3.77e-4, .reference_temperature = 300.0};
  copper.melting = melting::SteinbergCochranGuinan{.ambient_value = 1790.0, .gruneisen = 2.02, .a = 1.5};
  copper.yield = hy100_porous().yield;
  copper.porosity = porosity::Growth{};
  copper.heating->thermoelastic = true;
  State<double> start = initial_state(copper, room_temperature);
  start.porosity = 0.01;
  const Tensor<double> L = isochoric_extension(1e4) + 2e3 * Tensor<double>::identity();
  const State<double> end = run(copper, start, L, 1e-5);
  EXPECT_GT(end.porosity, 0.05);
  // A tenth of porosity in 2e5 steps leaves 9e-6, falling with the first power; 1e-6 would take ten times as many.
  expect_convergence(copper, start, L, 1e-5, {2000, 600000});
}

TEST(Update, ConvergesForSteinbergLundUnderPressure) {
  const Material copper = steinberg_lund_copper();
  Tensor<double> L;
  L.xx = -1e5;
  expect_convergence(copper, initial_state(copper, room_temperature), L, 2e-6, {1000, 20000});
}

TEST(Update, ConvergesInLargeSimpleShearWithEitherObjectiveRate) {
  for (const auto rate : {ObjectiveRate::incremental_rotation, ObjectiveRate::green_naghdi}) {
    Material copper = johnson_cook_copper(0.025, 1.09);
    copper.objective_rate = rate;
    expect_convergence(copper, initial_state(copper, room_temperature), simple_shear(1e4), 2e-4, {20000, 1000000});
  }
}

TEST(Update, ConvergesForAViscoelasticSolidWithGrowingCracks) {
  const Material explosive = pbx9501();
  const State<double> start = initial_state(explosive, room_temperature);
  Tensor<double> L = isochoric_extension(1e3);
  L.xy = 500.0;
  const State<double> end = run(explosive, start, L, 2e-5);
  EXPECT_GT(end.history[0], 1.5 * start.history[0]);  // the cracks do grow
  expect_convergence(explosive, start, L, 2e-5, {1000, 100000});
}

TEST(Update, RigidRotationThroughTwoTurnsOnlyRotatesTheStress) {
  constexpr double round_off = 1e-12;
  constexpr int steps = 720;
  for (const auto rate : {ObjectiveRate::incremental_rotation, ObjectiveRate::green_naghdi}) {
    for (Material material : {johnson_cook_copper(0.025, 1.09), hy100_porous(), pbx9501()}) {
      SCOPED_TRACE(material.name);
      material.objective_rate = rate;
      Tensor<double> L = isochoric_extension(1e3);
      L.xy = 500.0, L.yz = -200.0;
      const State<double> loaded = update_in_steps(material, initial_state(material, room_temperature), L, 2e-5, 200);
      ASSERT_GT(norm(loaded.stress), 1e6);
      // An arbitrary axis; one degree per step. What relaxes does so in the material at rest, too.
      const double x = 2.0 / 7.0, y = 3.0 / 7.0, z = 6.0 / 7.0, duration = 1e-4, speed = 4.0 * std::numbers::pi / duration;
      Tensor<double> W;
      W.xy = -speed * z, W.xz = speed * y, W.yz = -speed * x;
      W.yx = -W.xy, W.zx = -W.xz, W.zy = -W.yz;
      const State<double> still = update_in_steps(material, loaded, Tensor<double>{}, duration, steps);
      const State<double> turned = update_in_steps(material, loaded, W, duration, steps);
      EXPECT_LT(norm(turned.stress - still.stress), round_off * norm(still.stress));
      const State<double> turned_half = update_in_steps(material, loaded, W, duration / 8.0, steps / 8);
      const State<double> still_half = update_in_steps(material, loaded, Tensor<double>{}, duration / 8.0, steps / 8);
      const Tensor<double> R = turned_half.deformation_gradient * inverse(loaded.deformation_gradient);  // a quarter turn
      EXPECT_LT(norm(turned_half.stress - rotate(R, still_half.stress)), round_off * norm(still.stress));
    }
  }
}

TEST(RateForm, APathOfSegmentsIsTheSameAsTheWhole) {
  const Material copper = johnson_cook_copper(0.025, 1.09);
  const State<double> start = initial_state(copper, room_temperature);
  const Tensor<double> L = simple_shear(1e3);
  const std::vector<Segment> path(20, Segment{1e-5, L});
  for (const Difference& d : differences(integrate_rate_form(copper, start, path), run(copper, start, L, 2e-4)))
    EXPECT_LT(d.relative, integration_tolerance) << d.quantity;
}

}  // namespace
}  // namespace brisance::driver
