// A point along loading paths with closed-form answers. With p = -K ln J and a constant shear modulus the Cauchy stress is
// linear in the logarithmic strain as long as the strain does not rotate, so the textbook slopes hold at finite strain.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "driver/follow.hpp"
#include "driver/path_reader.hpp"
#include "models/update.hpp"
#include "tests/scratch.hpp"

namespace brisance::driver {
namespace {

constexpr double K = 160e9, G = 80e9, Y0 = 800e6, H = 2e9;  // Pa
constexpr double E = 9 * K * G / (3 * K + G);
constexpr double nu = (3 * K - 2 * G) / (2 * (3 * K + G));
// Stresses follow the update through sums of some thousand increments, and the mixed control to 1e-8 of the stress.
constexpr double stress_tolerance = 3e-8;

Material elastic() {
  Material m;
  m.name = "test steel";
  m.density = 7800;
  m.equation_of_state = equation_of_state::Logarithmic{7800, K, 450, 300};
  m.shear_modulus = shear_modulus::Constant{G};
  return m;
}

Material plastic(double hardening = 0.0) {
  Material m = elastic();
  m.flow_stress = flow_stress::LinearHardening{Y0, hardening};
  m.yield = yield::VonMises{};
  return m;
}

FreeDirection held(double SymmetricTensor<double>::*component, double target) {
  SymmetricTensor<double> unit;
  unit.*component = 1.0;
  return {to_tensor(unit), unit, {}, target};
}

LoadingPath path_of(std::vector<PathSegment> segments) {
  LoadingPath path;
  path.temperature = 300;
  path.output.every = 1;
  path.segments = std::move(segments);
  for (PathSegment& s : path.segments) s.where = "test";
  return path;
}

PathSegment uniaxial_stress(double rate, double duration) {
  PathSegment s;
  s.velocity_gradient.xx = rate;
  s.free = {held(&SymmetricTensor<double>::yy, 0.0), held(&SymmetricTensor<double>::zz, 0.0)};
  s.duration = duration;
  return s;
}

PathSegment along(double Tensor<double>::*component, double rate, double duration) {
  PathSegment s;
  s.velocity_gradient.*component = rate;
  s.duration = duration;
  return s;
}

struct Journey {
  Record record;
  Outcome outcome;
  double last(std::string_view column) const { return record.find(column)->values.back(); }
};
Journey run(const Material& material, const LoadingPath& path) {
  History history(material, path.output);
  const Outcome outcome = follow(material, path, history);
  return {history.record(), outcome};
}

TEST(UniaxialStress, RisesWithYoungsModulusAndContractsByPoissonsRatio) {
  const Journey r = run(elastic(), path_of({uniaxial_stress(100, 1e-4)}));
  EXPECT_NEAR(r.last("stress_xx") / (E * 0.01), 1.0, stress_tolerance);
  EXPECT_NEAR(r.last("strain_yy") / (-nu * 0.01), 1.0, stress_tolerance);
  EXPECT_NEAR(r.last("strain_xx"), 0.01, 1e-14);
}

TEST(UniaxialStress, KeepsTheFreeSidesFreeOfStressAtEveryStep) {
  const Journey r = run(plastic(H), path_of({uniaxial_stress(-100, 1e-3)}));
  for (std::size_t i = 0; i < r.record.rows(); ++i) {
    EXPECT_LE(std::abs(r.record.find("stress_yy")->values[i]), control_tolerance * Y0 * 2);
    EXPECT_LE(std::abs(r.record.find("stress_zz")->values[i]), control_tolerance * Y0 * 2);
  }
}

TEST(UniaxialStress, HardensWithTheTangentEHOverEPlusH) {
  const double strain = 0.05;
  const Journey r = run(plastic(H), path_of({uniaxial_stress(100, strain / 100)}));
  const double expected = Y0 + E * H / (E + H) * (strain - Y0 / E);
  EXPECT_NEAR(r.last("stress_xx") / expected, 1.0, stress_tolerance);
  EXPECT_NEAR(r.last("plastic_strain") / ((expected - Y0) / H), 1.0, stress_tolerance * (Y0 + expected) / (expected - Y0));
}

TEST(UniaxialStress, CarriesASuperposedPressureWithoutChangingTheDifferenceOfStresses) {
  const double p = 500e6;
  PathSegment squeeze;
  squeeze.free = {{Tensor<double>::identity(), (-1.0 / 3.0) * SymmetricTensor<double>::identity(), {}, p}};
  squeeze.duration = 1e-5;
  PathSegment load = uniaxial_stress(-100, 5e-4);
  load.free = {held(&SymmetricTensor<double>::yy, -p), held(&SymmetricTensor<double>::zz, -p)};
  const Journey r = run(plastic(), path_of({squeeze, load}));
  EXPECT_NEAR(r.last("stress_yy") / -p, 1.0, stress_tolerance);
  EXPECT_NEAR((r.last("stress_yy") - r.last("stress_xx")) / Y0, 1.0, stress_tolerance);
}

TEST(UniaxialStrain, YieldsAtTheHugoniotElasticLimitAndThenRisesWithTheBulkModulus) {
  const double elastic_limit = Y0 * (K + 4 * G / 3) / (2 * G), strain_at_limit = Y0 / (2 * G);
  PathSegment to_limit = along(&Tensor<double>::xx, -1000, 0.999 * strain_at_limit / 1000);
  EXPECT_NEAR(run(plastic(), path_of({to_limit})).last("stress_xx") / (-0.999 * elastic_limit), 1.0, stress_tolerance);

  const double strain = 0.03;
  const Journey r = run(plastic(), path_of({along(&Tensor<double>::xx, -1000, strain / 1000)}));
  EXPECT_NEAR(r.last("stress_xx") / -(K * strain + 2 * Y0 / 3), 1.0, stress_tolerance);
  EXPECT_NEAR(r.last("equivalent_stress") / Y0, 1.0, stress_tolerance);
}

// The closed forms are those of the rates of stress; the increments approach them with the square of the step.
constexpr double shear_tolerance = 2e-6;  // of G, for steps of 1e-3

TEST(SimpleShear, OscillatesUnderTheIncrementalRotationAsUnderJaumannsRate) {
  Material m = elastic();
  LoadingPath path = path_of({along(&Tensor<double>::xy, 1000, 2e-3)});
  path.strain_increment = 1e-3;
  const Journey r = run(m, path);
  EXPECT_NEAR(r.last("stress_xy") / G, std::sin(2.0), shear_tolerance);
  EXPECT_NEAR(r.last("stress_xx") / G, 1 - std::cos(2.0), shear_tolerance);
  EXPECT_NEAR(r.last("stress_yy") / G, std::cos(2.0) - 1, shear_tolerance);
}

TEST(SimpleShear, RisesWithoutEndUnderGreenAndNaghdisRate) {
  Material m = elastic();
  m.objective_rate = ObjectiveRate::green_naghdi;
  LoadingPath path = path_of({along(&Tensor<double>::xy, 1000, 2e-3)});
  path.strain_increment = 1e-3;
  const Journey r = run(m, path);
  const double b = std::atan(1.0);
  const double sigma_11 = 4 * (std::cos(2 * b) * std::log(std::cos(b)) + b * std::sin(2 * b) - std::sin(b) * std::sin(b));
  // The limit of 2 cos 2b (2b - 2 tan 2b ln cos b - tan b), written without the infinite tangent at b = 45 degrees.
  const double sigma_12 = 2 * (std::cos(2 * b) * (2 * b - std::tan(b)) - 2 * std::sin(2 * b) * std::log(std::cos(b)));
  EXPECT_NEAR(r.last("stress_xy") / G, sigma_12, shear_tolerance);
  EXPECT_NEAR(r.last("stress_xx") / G, sigma_11, shear_tolerance);
}

TEST(Hydrostatic, ReachesThePrescribedPressureWithoutShape) {
  PathSegment squeeze;
  squeeze.free = {{Tensor<double>::identity(), (-1.0 / 3.0) * SymmetricTensor<double>::identity(), {}, 5e9}};
  squeeze.duration = 1e-3;
  const Journey r = run(plastic(), path_of({squeeze}));
  EXPECT_NEAR(r.last("pressure") / 5e9, 1.0, stress_tolerance);
  EXPECT_NEAR(std::log(r.last("density") / 7800) / (5e9 / K), 1.0, stress_tolerance);
  EXPECT_LT(r.last("equivalent_stress"), 1e-9 * 5e9);
  EXPECT_EQ(r.last("plastic_strain"), 0.0);
}

/// A metal that hardens, depends on its rate and is warmed by its work.
Material hardening_metal() {
  Material m = plastic();
  m.flow_stress = flow_stress::JohnsonCook{
      .A = 90e6, .B = 292e6, .n = 0.31, .C = 0.025, .m = 1.09, .reference_strain_rate = 1.0, .reference_temperature = 300.0};
  m.melting = melting::Constant{1356.0};
  m.specific_heat = specific_heat::Constant{450.0};
  Table chi;
  chi.size = 1, chi.y[0] = 0.9;
  m.heating = Heating{.taylor_quinney = chi, .viscous = true, .thermoelastic = true};
  return m;
}
Journey drawn(double strain_increment, double tolerance) {
  LoadingPath path = path_of({uniaxial_stress(1000, 1e-4), uniaxial_stress(1e5, 1e-6)});  // to 0.2, with a jump of the rate
  path.strain_increment = strain_increment, path.tolerance = tolerance;
  return run(hardening_metal(), path);
}

TEST(Tolerance, KeepsTheErrorOfTheWholePath) {
  const Journey reference = drawn(2e-6, 0.0);
  double before = 1.0;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const Journey r = drawn(0.02, tolerance);
    double error = 0.0;
    for (const char* column : {"stress_xx", "temperature"})
      error = std::max(error, std::abs(r.last(column) / reference.last(column) - 1.0));
    // Two steps that are kept err by what they differ from one of twice the size, if the error of a step goes with its square.
    EXPECT_LT(error, 0.5 * tolerance * static_cast<double>(r.outcome.steps)) << "if all errors added up";
    EXPECT_LT(error, before);
    before = error;
  }
}

TEST(Tolerance, TakesShortStepsWhereTheyAreNeededAlone) {
  const Journey r = drawn(0.02, 1e-4), uniform = drawn(2e-4, 0.0);
  EXPECT_GT(r.outcome.rejected, 0);
  EXPECT_LT(r.outcome.steps, uniform.outcome.steps);
  EXPECT_EQ(uniform.outcome.rejected, 0);
  // The time goes on by the steps that were kept and comes to the end of each segment.
  const std::vector<double>& time = r.record.find("time")->values;
  EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
  EXPECT_NEAR(time.back() / 1.01e-4, 1.0, 1e-14);
  double shortest = 1.0, longest = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i)
    if (time[i] > time[i - 1] && time[i] <= 1e-4) {
      shortest = std::min(shortest, time[i] - time[i - 1]), longest = std::max(longest, time[i] - time[i - 1]);
    }
  EXPECT_GT(longest / shortest, 10.0) << "from the knee to where it hardens slowly";
}

LoadingPath read_path(const std::string& segment) {
  const fs::path file = scratch() / "path.toml";
  std::ofstream(file) << "material = \"" BRISANCE_SOURCE_DIR
                         "/data/materials/steel_4340.toml\"\nheat = \"isothermal\"\n[initial]\ntemperature = 298\n[[segment]]\n"
                      << segment;
  return read_case(file).path;
}

TEST(ConstantTriaxiality, KeepsTriaxialityLodeAngleAndTheRateConjugateToTheEquivalentStress) {
  for (const double triaxiality : {-1.0, 0.0, 1.0 / 3.0, 1.5})
    for (const double lode : {0.0, 20.0, 60.0}) {
      LoadingPath path = read_path("mode = \"constant_triaxiality\"\nstrain_rate = 100\nstrain = 0.05\ntriaxiality = " +
                                   std::to_string(triaxiality) + "\nlode_angle = " + std::to_string(lode) + "\n");
      path.output.every = 1;
      const Journey r = run(plastic(H), path);
      constexpr double printed_digits = 1e-6;  // std::to_string above
      for (std::size_t i = 1; i < r.record.rows(); ++i)
        ASSERT_NEAR(r.record.find("triaxiality")->values[i], triaxiality, printed_digits) << lode;
      const double q = r.last("equivalent_stress"), mean = r.last("mean_stress");
      EXPECT_NEAR((r.last("stress_xx") - mean) / q, 2.0 / 3.0 * std::cos(lode * std::numbers::pi / 180), 1e-7);
      // Total equivalent strain is elastic q/(3 G) plus plastic.
      EXPECT_NEAR(q / (3 * G) + r.last("plastic_strain"), 0.05, 1e-7) << triaxiality << " " << lode;
    }
}

TEST(BiaxialStress, KeepsTheRatioOfTheStresses) {
  LoadingPath path = read_path("mode = \"biaxial_stress\"\nstress_ratio = 0.5\nstrain_rate = 100\nstrain = 0.05\n");
  const Journey r = run(plastic(H), path);
  EXPECT_NEAR(r.last("stress_yy") / r.last("stress_xx"), 0.5, 1e-7);
  EXPECT_LT(std::abs(r.last("stress_zz")), control_tolerance * 4 * Y0);
  // With this ratio associated flow leaves the y direction at rest.
  EXPECT_NEAR(r.last("strain_yy") - (r.last("stress_yy") - nu * r.last("stress_xx")) / E, 0.0, 1e-7);
}

TEST(MixedControl, HoldsATensionWhileItShears) {
  const double tension = 300e6;
  PathSegment pull = uniaxial_stress(0.0, 1e-5);
  pull.free.insert(pull.free.begin(), held(&SymmetricTensor<double>::xx, tension));
  PathSegment shear = along(&Tensor<double>::xy, 1000, 5e-5);
  shear.free = {held(&SymmetricTensor<double>::xx, tension), held(&SymmetricTensor<double>::yy, 0.0),
                held(&SymmetricTensor<double>::zz, 0.0)};
  const Journey r = run(plastic(), path_of({pull, shear}));
  EXPECT_NEAR(r.last("stress_xx") / tension, 1.0, stress_tolerance);
  EXPECT_NEAR(r.last("stress_xy") / std::sqrt((Y0 * Y0 - tension * tension) / 3), 1.0, 1e-6);
}

TEST(MixedControl, PrescribesAShearStressWithoutDoublingIt) {
  PathSegment twist;
  twist.free = {held(&SymmetricTensor<double>::xy, 0.0)};
  twist.free.front().stress_weight.xy = 0.5;  // a shear component stands twice in a double product
  twist.free.front().target = 100e6;
  twist.duration = 1e-5;
  const Journey r = run(elastic(), path_of({twist}));
  EXPECT_NEAR(r.last("stress_xy") / 100e6, 1.0, stress_tolerance);
}

TEST(Cycle, ElasticStrainReturnsStressAndEnergyToNothing) {
  const Journey r =
      run(elastic(), path_of({uniaxial_stress(100, 2e-5), uniaxial_stress(-100, 4e-5), uniaxial_stress(100, 2e-5)}));
  EXPECT_LT(std::abs(r.last("stress_xx")), 1e-6 * E * 2e-3);
  const double largest_energy = 0.5 * E * 2e-3 * 2e-3 / 7800;  // J/kg
  // Work is summed by the trapezoidal rule with densities at both ends, exact to second order in the strain.
  EXPECT_LT(std::abs(r.last("energy")), 2e-2 * largest_energy);
}

TEST(Until, EndsWhereTheColumnHasItsValue) {
  PathSegment load = uniaxial_stress(100, 1.0);
  load.duration.reset();
  load.until = Until{"plastic_strain", 0.0123};
  PathSegment unload = uniaxial_stress(-100, 1.0);
  unload.duration.reset();
  unload.until = Until{"stress_xx", 0.0};
  const Journey r = run(plastic(H), path_of({load, unload}));
  EXPECT_NEAR(r.last("plastic_strain") / 0.0123, 1.0, 1e-9);
  EXPECT_LT(std::abs(r.last("stress_xx")), 1e-7 * Y0);
  EXPECT_NEAR(r.last("strain_xx") / 0.0123, 1.0, 1e-6);  // what remains is plastic
}

TEST(Steps, AreHalvedWhereTheUpdateIsInTrouble) {
  LoadingPath path = path_of({along(&Tensor<double>::xy, 1.0, 40.0)});
  path.strain_increment = 5.0;  // far more than a step of the update may take
  const Journey r = run(plastic(), path);
  EXPECT_EQ(r.outcome.ending, Ending::completed);
  EXPECT_NEAR(r.last("F_xy"), 40.0, 1e-10);
  EXPECT_NEAR(r.last("equivalent_stress") / Y0, 1.0, 1e-9);
}

TEST(Steps, EndWithTheFactsWhereAStressCannotBeCarried) {
  PathSegment pull = uniaxial_stress(0.0, 1e-4);
  pull.free.insert(pull.free.begin(), held(&SymmetricTensor<double>::xx, 2 * Y0));
  const LoadingPath path = path_of({pull});
  const Material m = plastic();
  History history(m, path.output);
  try {
    follow(m, path, history);
    FAIL() << "a perfectly plastic bar carried twice its strength";
  } catch (const RunError& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.find("cannot be held") != std::string::npos || what.find("gives way") != std::string::npos) << what;
    EXPECT_NE(what.find("plastic strain"), std::string::npos) << what;
  }
  EXPECT_NEAR(history.record().find("stress_xx")->values.back() / Y0, 1.0, 0.02);  // what was reached is kept
}

TEST(Heat, IsTakenAwayFromAnIsothermalPointAndKeptByAnAdiabaticOne) {
  Material m = plastic();
  Table chi;
  chi.size = 1;
  chi.y[0] = 0.9;
  m.heating = Heating{chi, true, false};
  m.specific_heat = specific_heat::Constant{450};
  LoadingPath path = path_of({uniaxial_stress(100, 2e-3)});
  const Journey adiabatic = run(m, path);
  const double rise = 0.9 * Y0 * adiabatic.last("plastic_strain") / (7800 * 450);
  EXPECT_NEAR((adiabatic.last("temperature") - 300) / rise, 1.0, 3e-3);  // the density falls by 0.2 % in tension
  path.heat = Heat::isothermal;
  const Journey isothermal = run(m, path);
  EXPECT_EQ(isothermal.last("temperature"), 300.0);
  EXPECT_NEAR((adiabatic.last("energy") - isothermal.last("energy")) / (450 * rise), 1.0, 3e-3);
}

TEST(Heat, FollowsAPrescribedTemperature) {
  LoadingPath path = path_of({along(&Tensor<double>::xx, -100, 1e-4), along(&Tensor<double>::xx, -100, 1e-4)});
  path.heat = Heat::prescribed;
  path.segments[0].temperature_rate = 1e6;
  path.segments[1].temperature_jump = 50.0;
  EXPECT_NEAR(run(elastic(), path).last("temperature"), 450.0, 1e-9);
}

TEST(Heat, ExpandsThePointFreelyWhenTheTemperatureJumps) {
  Material m = elastic();
  const equation_of_state::MieGruneisenTemperature law{7800, 4600, 1.5, 1.7, 450, 300};
  m.equation_of_state = law;
  PathSegment first = uniaxial_stress(100, 1e-5), second = first;
  second.temperature_jump = 200;
  LoadingPath path = path_of({first, second});
  path.heat = Heat::isothermal;
  const Journey one = run(m, path_of({first})), both = run(m, path);
  EXPECT_EQ(both.last("temperature"), 500.0);
  EXPECT_NEAR(both.last("stress_yy"), 0.0, 1.0);
  EXPECT_NEAR(both.last("stress_xx") / (2 * one.last("stress_xx")), 1.0, 5e-3);  // Young's modulus falls a little with density
  // Linear expansion alpha = Gamma rho0 cv/(3 K) per kelvin.
  const double alpha = 1.7 * 450 / (3 * 4600.0 * 4600.0);
  EXPECT_NEAR((both.last("strain_yy") - 2 * one.last("strain_yy")) / (200 * alpha), 1.0, 2e-2);
}

TEST(DeformationGradient, IsReachedExactlyAndReturnsToIdentity) {
  PathSegment there, back;
  there.deformation_gradient = Tensor<double>{1.1, 0.3, 0.0, 0.05, 0.95, -0.1, 0.0, 0.2, 0.9};
  there.duration = back.duration = 1e-3;
  back.deformation_gradient = Tensor<double>::identity();
  const Journey one = run(elastic(), path_of({there}));
  EXPECT_LT(norm(one.outcome.state.deformation_gradient - *there.deformation_gradient), 1e-11);
  const Journey both = run(elastic(), path_of({there, back}));
  EXPECT_LT(norm(both.outcome.state.deformation_gradient - Tensor<double>::identity()), 1e-11);
}

}  // namespace
}  // namespace brisance::driver
