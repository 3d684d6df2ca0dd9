// A metal above its melting temperature: a fluid without shear strength that bears pressure and no tension.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "models/equation_of_state/thermodynamics.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance {
namespace {

using namespace samples;

template <class Real>
class Melt : public ::testing::Test {};
using Numbers = ::testing::Types<double, Lanes>;
TYPED_TEST_SUITE(Melt, Numbers);

constexpr double dt = 1e-8, rate = 1e5;                // s, 1/s: a thousandth of strain in each step
constexpr double melting_temperature = 1793.0;         // K
constexpr double liquid = melting_temperature + 50.0;  // K

/// Steel with every flow stress and every shear modulus, each with both yield surfaces.
std::vector<Material> metals() {
  std::vector<Material> all;
  for (const Sample& flow : flow_stresses())
    for (const ShearModulus& modulus : shear_moduli())
      for (const Yield& surface : yields()) {
        Material m = steel_4340();
        m.flow_stress = flow.law, m.shear_modulus = modulus, m.yield = surface;
        m.damage.reset(), m.failure.clear();
        m.name = "flow stress " + std::to_string(m.flow_stress->index()) + ", shear modulus " +
                 std::to_string(m.shear_modulus->index()) + ", yield " + std::to_string(m.yield->index());
        all.push_back(m);
      }
  return all;
}

Tensor<double> motion(double xx, double yy, double zz, double xy = 0.0) {
  Tensor<double> L;
  L.xx = rate * xx, L.yy = rate * yy, L.zz = rate * zz, L.xy = rate * xy;
  return L;
}

/// The equivalent stress of the deviator itself: that of the total stress is what rounding leaves of the pressure.
template <class Real>
double shear_stress(const Specimen<Real>& specimen) {
  return lane(equivalent_stress(specimen.batch.points[0].deviator), 0);
}

/// No shear stress, no plastic strain or work, and finite numbers.
template <class Real>
void expect_fluid(const Specimen<Real>& specimen) {
  ASSERT_EQ(specimen.trouble(), Trouble::none) << specimen.material.name;
  const State<double> s = specimen.state();
  EXPECT_EQ(shear_stress(specimen), 0.0) << specimen.material.name;
  EXPECT_EQ(s.plastic_strain, 0.0) << specimen.material.name;
  EXPECT_EQ(specimen[&Point<Real>::plastic_work], 0.0) << specimen.material.name;
  EXPECT_TRUE(std::isfinite(s.temperature) && std::isfinite(s.energy)) << specimen.material.name;
  EXPECT_GE(-specimen.mean_stress(), 0.0) << specimen.material.name << ": a melt bears no tension";
}

TYPED_TEST(Melt, AtRestKeepsItsBits) {
  for (const Material& m : metals())
    for (const State<double>& start : {stress_free_state(m, liquid), initial_state(m, liquid)}) {
      Specimen<TypeParam> specimen(m, start);
      specimen.step({}, dt);  // a stress-free start may be under a tension of round-off, which a melt does not bear
      State<double> before = specimen.state();
      specimen.steps(20, {}, dt);
      expect_fluid(specimen);
      State<double> after = specimen.state();
      const auto a = numbers(before), b = numbers(after);
      for (std::size_t n = 0; n < a.size(); ++n) ASSERT_EQ(*a[n], *b[n]) << m.name << ", number " << n;
    }
}

TYPED_TEST(Melt, ShearsWithoutStress) {
  for (const Material& m : metals()) {
    Specimen<TypeParam> specimen(m, initial_state(m, liquid));
    const double pressure = -specimen.mean_stress(), energy = specimen.state().energy;
    specimen.steps(100, motion(0, 0, 0, 1), dt);
    expect_fluid(specimen);
    constexpr double round_off = 1e-12;
    EXPECT_NEAR(-specimen.mean_stress(), pressure, round_off * pressure) << m.name;
    EXPECT_NEAR(specimen.state().energy, energy, round_off * std::abs(energy)) << m.name;
  }
}

TYPED_TEST(Melt, UnderCompressionHasThePressureOfItsEquationOfState) {
  for (const Material& m : metals()) {
    Specimen<TypeParam> specimen(m, initial_state(m, liquid));
    specimen.steps(50, motion(-1, 0, 0), dt);
    expect_fluid(specimen);
    const State<double> s = specimen.state();
    const auto& law = std::get<equation_of_state::MieGruneisenTemperature>(m.equation_of_state);
    constexpr double round_off = 1e-12;
    const double pressure = equation_of_state::pressure_at(law, s.density, s.temperature);
    EXPECT_GT(pressure, 8e9);  // K/20 and the thermal pressure
    EXPECT_NEAR(-specimen.mean_stress(), pressure, round_off * pressure) << m.name;
  }
}

TYPED_TEST(Melt, DispersesWithoutTensionAndMeetsPressureAgainWhereItLostIt) {
  for (const Material& m : metals()) {
    Specimen<TypeParam> specimen(m, stress_free_state(m, liquid));
    const double free = specimen.state().density;
    constexpr int apart = 3000;  // to exp(-3) of the density: beyond the range of any equation of state of a solid
    specimen.steps(apart, motion(1, 0, 0), dt);
    expect_fluid(specimen);
    EXPECT_EQ(specimen.mean_stress(), 0.0) << m.name;
    EXPECT_NEAR(specimen.state().density / free, std::exp(-3.0), 1e-9) << m.name;
    constexpr double found = 1e-9;  // of the density, where the search for no pressure stops
    EXPECT_NEAR(specimen[&Point<TypeParam>::metal_density] / free, 1.0, found) << m.name;
    specimen.steps(apart - 1, motion(-1, 0, 0), dt);
    EXPECT_EQ(specimen.mean_stress(), 0.0) << m.name << ": its voids are not closed yet";
    specimen.steps(51, motion(-1, 0, 0), dt);
    expect_fluid(specimen);
    const State<double> s = specimen.state();
    EXPECT_EQ(s.plastic_volume_strain, 0.0) << m.name;
    const auto& law = std::get<equation_of_state::MieGruneisenTemperature>(m.equation_of_state);
    const double pressure = equation_of_state::pressure_at(law, s.density, s.temperature);
    EXPECT_GT(pressure, 4e9);
    EXPECT_NEAR(-specimen.mean_stress(), pressure, 1e-9 * pressure) << m.name;
  }
}

TYPED_TEST(Melt, SoundInADispersedMeltIsThatOfItsMetal) {
  const Material m = steel_4340();
  Specimen<TypeParam> specimen(m, stress_free_state(m, liquid));
  specimen.step({}, dt);
  const double dense = lane(longitudinal_sound_speed(specimen.batch.points[0]), 0);
  specimen.steps(2000, motion(1, 0, 0), dt);
  constexpr double found = 1e-6;
  EXPECT_NEAR(lane(longitudinal_sound_speed(specimen.batch.points[0]), 0) / dense, 1.0, found);
}

/// Changes the temperature from outside.
template <class Real>
void heat(Specimen<Real>& specimen, double temperature) {
  for (int i = 0; i < width_of<Real>; ++i) set_lane(specimen.batch.points[0].state.temperature, i, temperature);
}

TYPED_TEST(Melt, TurnsTheElasticEnergyOfItsDeviatorIntoHeatAndFreezesWithoutOne) {
  for (const Material& m : metals()) {
    Specimen<TypeParam> specimen(m, initial_state(m, melting_temperature - 50.0));
    specimen.steps(30, motion(0, 0, 0, 1), dt);
    const State<double> solid = specimen.state();
    const SymmetricTensor<double> s = deviator(solid.stress);
    ASSERT_GT(norm(s), 0.0) << m.name;
    const double plastic_strain = solid.plastic_strain;

    heat(specimen, liquid);
    specimen.step({}, dt);
    EXPECT_EQ(shear_stress(specimen), 0.0) << m.name;
    constexpr double round_off = 1e-9;
    const double warming = double_dot(s, s) / (4.0 * solid.shear_modulus * solid.density * 477.0);
    EXPECT_NEAR(specimen.state().temperature - liquid, warming, round_off * warming + 1e-12 * liquid) << m.name;
    specimen.steps(100, motion(1, -0.5, -0.5, 1), dt);
    ASSERT_EQ(specimen.trouble(), Trouble::none) << m.name;
    EXPECT_EQ(shear_stress(specimen), 0.0) << m.name;
    EXPECT_EQ(specimen.state().plastic_strain, plastic_strain) << m.name << ": what a melt flows does not harden the crystal";

    heat(specimen, melting_temperature - 50.0);
    specimen.step(motion(0, 0, 0, 1e-4), dt);  // too little to yield
    ASSERT_EQ(specimen.trouble(), Trouble::none) << m.name;
    const double mu = specimen.state().shear_modulus;
    EXPECT_GT(mu, 0.0) << m.name;
    EXPECT_NEAR(specimen.equivalent_stress(), std::sqrt(3.0) * mu * 1e-4 * rate * dt, 1e-3) << m.name;  // Pa
    specimen.steps(100, motion(0, 0, 0, 1), dt);
    EXPECT_EQ(specimen.trouble(), Trouble::none) << m.name;
  }
}

TYPED_TEST(Melt, PassesThroughMeltingByPressureBothWays) {
  // Under pressure the melting temperature lies above that of the point, without pressure below.
  for (const Material& any : metals())
    for (const Melting& melting : {meltings()[1], meltings()[3]}) {
      Material m = any;
      m.melting = melting;
      m.heating = Heating{constant_table(0.0), false, false};
      Specimen<TypeParam> specimen(m, stress_free_state(m, 1500.0));
      int frozen = 0, molten = 0;
      for (int cycle = 0; cycle < 3; ++cycle)
        for (const double sign : {-1.0, 1.0}) {
          specimen.steps(100, motion(sign, 0, 0, 0.5), dt);
          ASSERT_EQ(specimen.trouble(), Trouble::none) << m.name;
          (specimen.state().shear_modulus > 0.0 ? frozen : molten) += 1;
        }
      EXPECT_EQ(frozen, 3) << m.name;
      EXPECT_EQ(molten, 3) << m.name;
    }
}

TEST(MeltOnLanes, GivesTheResultsOfDoublesOnBothSidesOfMelting) {
  constexpr double same = 1e-9;  // exponentials differ by round-off, and returns and the search for no pressure stop
  for (const Material& m : metals()) {
    Batch<Lanes> lanes;
    Batch<double> doubles;
    const auto each = [&](auto&& f) {
      for (int i = 0; i < Batch<double>::capacity; ++i)
        f(doubles.points[static_cast<std::size_t>(i)], lanes.points[static_cast<std::size_t>(i / Lanes::width)],
          i % Lanes::width);
    };
    int n = 0;
    each([&](Point<double>& p, Point<Lanes>& q, int i) {
      p.state = stress_free_state(m, melting_temperature + 10.0 * (n++ - 32));
      set_state(q.state, i, p.state);
    });
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> component(-4e-3, 4e-3);
    for (int step = 0; step < 60; ++step) {
      each([&](Point<double>& p, Point<Lanes>& q, int i) {
        Tensor<double> L;
        for (double* x : {&L.xx, &L.xy, &L.xz, &L.yx, &L.yy, &L.yz, &L.zx, &L.zy, &L.zz}) *x = component(random) / dt;
        p.velocity_gradient = L;
        set_velocity_gradient(q, i, L);
      });
      update(m, doubles, dt);
      update(m, lanes, dt);
    }
    each([&](Point<double>& p, Point<Lanes>& q, int i) {
      EXPECT_EQ(p.trouble, 0.0) << m.name;
      State<double> a = p.state, b = state_of(q.state, i);
      EXPECT_LE(norm(a.stress - b.stress), same * 164e9) << m.name;
      EXPECT_NEAR(a.temperature, b.temperature, same * a.temperature) << m.name;
      EXPECT_NEAR(a.plastic_strain, b.plastic_strain, same) << m.name;
      EXPECT_NEAR(a.plastic_volume_strain, b.plastic_volume_strain, same) << m.name;
    });
  }
}

}  // namespace
}  // namespace brisance
