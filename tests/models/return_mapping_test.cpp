// The return to the yield surface: consistent for every law from any state, and exact where a closed form exists.

#include "models/return_mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/models/sample_laws.hpp"

namespace brisance {
namespace {

// The specification of the solver: |q - Y| below this part of the flow stress.
constexpr double consistency = 1e-9;
// q is a difference of two numbers of the size of the trial stress.
constexpr double round_off = 2e-15;

/// States from the whole range a simulation may visit: cold to near melt, zero to huge strain, any rate, stresses from just
/// outside the surface to far beyond it.
class States {
 public:
  explicit States(const samples::Sample& sample) : sample_(sample) {}

  Trial<double> next() {
    Trial<double> t;
    const double melt = std::min(sample_.melting_temperature, 2000.0);
    t.shear_modulus = sample_.shear_modulus * uniform(0.3, 1.5);
    t.bulk_modulus = sample_.bulk_modulus * uniform(0.5, 2.0);
    t.at.plastic_strain = coin() ? 0.0 : logarithmic(1e-8, 10.0);
    t.at.temperature = coin() ? uniform(1.0, melt) : melt * (1.0 - logarithmic(1e-9, 1e-2));
    t.at.melting_temperature = sample_.melting_temperature;
    t.at.shear_modulus = t.shear_modulus;
    t.at.pressure = uniform(-5e9, 50e9);
    t.at.density = sample_.density * uniform(0.9, 1.4);
    t.inverse_time_step = 1.0 / logarithmic(1e-12, 1e-3);
    t.last_rate = coin() ? 0.0 : logarithmic(1e-6, 1e9);
    t.flow_history = coin() ? 0.0 : uniform(0.0, 1e9);
    t.porosity = 0.0;
    const double quasi_static = std::visit(
        [&](const auto& law) { return flow_stress::evaluate(law, t.at, t.flow_history, 0.0).flow_stress; }, sample_.law);
    t.equivalent_stress = std::max(quasi_static, 1.0) * (1.0 + logarithmic(1e-9, 1e3));
    t.mean_stress = uniform(-5e9, 5e9);
    return t;
  }
  double uniform(double a, double b) { return a + (b - a) * std::uniform_real_distribution<double>()(random_); }
  double logarithmic(double a, double b) { return a * std::exp(uniform(0.0, std::log(b / a))); }
  bool coin() { return uniform(0.0, 1.0) < 0.3; }

 private:
  samples::Sample sample_;
  std::mt19937_64 random_{20260101};
};

template <class Law>
double flow_stress_at(const Law& law, const Trial<double>& t, double increment) {
  return detail::flow_stress_after(law, t, increment).flow_stress;
}

TEST(ReturnMapping, MeetsTheConsistencyConditionForEveryLawFromAnyState) {
  for (const samples::Sample& sample : samples::flow_stresses()) {
    std::visit(
        [&](const auto& law) {
          States states(sample);
          double worst = 0.0;
          int plastic = 0;
          for (int i = 0; i < 100'000; ++i) {
            const Trial<double> t = states.next();
            const auto end = return_to_surface(yield::VonMises{}, law, nucleation_of({}), t);
            ASSERT_TRUE(end.converged) << law.name << " state " << i;
            ASSERT_TRUE(std::isfinite(end.equivalent_stress) && std::isfinite(end.flow_history)) << law.name << " state " << i;
            if (end.plastic_strain_increment == 0.0) continue;
            ++plastic;
            const double Y = flow_stress_at(law, t, end.plastic_strain_increment);
            const double excess = std::abs(end.equivalent_stress - Y) - round_off * t.equivalent_stress;
            worst = std::max(worst, excess / std::max(Y, 1e-300));
            ASSERT_LE(excess, consistency * Y)
                << law.name << " state " << i << " Y " << Y << " x " << end.plastic_strain_increment << " q_tr "
                << t.equivalent_stress << " T " << t.at.temperature;
          }
          EXPECT_GT(plastic, 90'000) << law.name;
          RecordProperty(std::string(law.name), std::to_string(worst));
        },
        sample.law);
  }
}

TEST(ReturnMapping, LinearHardeningHasItsClosedForm) {
  const flow_stress::LinearHardening law{400e6, 100e6};
  Trial<double> t{};
  t.shear_modulus = 45e9, t.bulk_modulus = 140e9, t.inverse_time_step = 1e6;
  t.at.plastic_strain = 0.2, t.at.melting_temperature = 1e30, t.at.temperature = 300.0;
  for (double q : {421e6, 600e6, 5e9}) {
    t.equivalent_stress = q;
    for (double mean : {-1e9, 0.0, 3e9}) {
      t.mean_stress = mean;  // must not matter
      const auto end = return_to_surface(yield::VonMises{}, law, nucleation_of({}), t);
      const double x = (q - 420e6) / (3 * 45e9 + 100e6);
      EXPECT_NEAR(end.plastic_strain_increment, x, 1e-9 * x);
      EXPECT_NEAR(end.equivalent_stress, 420e6 + 100e6 * x, 1e-9 * 420e6);
      EXPECT_EQ(end.mean_stress, mean);
      EXPECT_EQ(end.plastic_volume_increment, 0.0);
    }
  }
}

TEST(ReturnMapping, StaysElasticInsideTheSurface) {
  for (const samples::Sample& sample : samples::flow_stresses())
    std::visit(
        [&](const auto& law) {
          States states(sample);
          for (int i = 0; i < 1000; ++i) {
            Trial<double> t = states.next();
            t.equivalent_stress = 0.999 * flow_stress_at(law, t, 0.0);
            const auto end = return_to_surface(yield::VonMises{}, law, nucleation_of({}), t);
            EXPECT_EQ(end.plastic_strain_increment, 0.0) << law.name;
            EXPECT_EQ(end.equivalent_stress, t.equivalent_stress) << law.name;
            EXPECT_EQ(end.flow_history, t.flow_history) << law.name;
          }
        },
        sample.law);
}

constexpr yield::GursonTvergaardNeedleman steel_surface{1.5, 1.0, 2.25, 0.05, 4.0, yield::ReturnTo::porous_surface};
constexpr porosity::ChuNeedleman steel_nucleation{0.1, 0.3, 0.1, false};

TEST(PorousReturnMapping, EndsOnTheSurfaceWithNormalFlowAndMatchingWorkFromAnyState) {
  for (const samples::Sample& sample : samples::flow_stresses()) {
    std::visit(
        [&](const auto& law) {
          States states(sample);
          int plastic = 0;
          for (int i = 0; i < 12'500; ++i) {  // 1e5 states over the eight laws
            Trial<double> t = states.next();
            // From dense to just short of the porosity at which the surface is a point (0.2042), at any triaxiality.
            t.porosity = states.coin() ? states.logarithmic(1e-8, 1e-2) : states.uniform(0.0, 0.2041);
            // A trial stress of ten times the flow stress, a triaxiality of a hundred: more than an explicit step can ask for.
            const double Y0 = flow_stress_at(law, t, 0.0);
            t.equivalent_stress = std::min(t.equivalent_stress, 10.0 * Y0);
            t.mean_stress =
                (states.coin() ? -1.0 : 1.0) * std::min(t.equivalent_stress * states.logarithmic(1e-3, 1e2), 20.0 * Y0);
            const auto end = return_to_surface(steel_surface, law, steel_nucleation, t);
            ASSERT_TRUE(end.converged) << law.name << " state " << i << " q " << t.equivalent_stress << " sm " << t.mean_stress
                                       << " f " << t.porosity << " Y0 " << flow_stress_at(law, t, 0.0);
            ASSERT_TRUE(std::isfinite(end.equivalent_stress) && std::isfinite(end.mean_stress) && std::isfinite(end.porosity));
            if (end.plastic_strain_increment == 0.0) continue;
            ++plastic;
            const double x = end.plastic_strain_increment, v = end.plastic_volume_increment;
            const double Y = flow_stress_at(law, t, x);
            const double f_star = steel_surface.effective_porosity(end.porosity);
            // Phi = 0, to the consistency asked of q.
            const double z = 1.5 * steel_surface.q2 * end.mean_stress / Y;
            const double size = 1 + 2.25 * f_star * f_star - 3.0 * f_star * std::cosh(z);
            // 1e-14 is the round-off of the terms of order one whose difference is left when the surface is nearly a point.
            const double ratio = end.equivalent_stress / Y;
            EXPECT_NEAR(ratio * ratio, size, 2 * consistency * ratio + 1e-14 * (1 + std::abs(z))) << law.name << " state " << i;
            EXPECT_LE(std::abs(size), 1.0 + 1e-12);
            // Stresses follow from the elastic strain that is left.
            EXPECT_NEAR(end.mean_stress, t.mean_stress - t.bulk_modulus * v, 1e-12 * std::abs(t.mean_stress) + consistency * Y);
            EXPECT_GE(end.mean_stress * t.mean_stress, -consistency * Y * std::abs(t.mean_stress));
            // Work of the matrix = work of the stress, as long as there is a surface to work on.
            if (f_star >= 0.9999 * steel_surface.ultimate_porosity()) continue;
            const double dq = (t.equivalent_stress - end.equivalent_stress) / (3 * t.shear_modulus);
            const double work = end.equivalent_stress * dq + end.mean_stress * v;
            // Both are differences of elastic strains of the size of the trial's, which round.
            const double elastic_strain = t.equivalent_stress / t.shear_modulus + std::abs(t.mean_stress) / t.bulk_modulus;
            EXPECT_NEAR((1 - end.porosity) * Y * x, work, 1e-6 * work + 2e-14 * Y * elastic_strain)
                << law.name << " state " << i;
          }
          EXPECT_GT(plastic, 10'000) << law.name;
        },
        sample.law);
  }
}

TEST(PorousReturnMapping, IsVonMisesWithoutVoids) {
  constexpr porosity::ChuNeedleman no_nucleation{0.0, 0.0, 1.0, false};
  for (const samples::Sample& sample : samples::flow_stresses())
    std::visit(
        [&](const auto& law) {
          States states(sample);
          for (int i = 0; i < 10'000; ++i) {
            const Trial<double> t = states.next();
            const auto porous = return_to_surface(steel_surface, law, no_nucleation, t);
            const auto dense = return_to_surface(yield::VonMises{}, law, no_nucleation, t);
            EXPECT_EQ(porous.equivalent_stress, dense.equivalent_stress) << law.name;
            EXPECT_EQ(porous.plastic_strain_increment, dense.plastic_strain_increment) << law.name;
            EXPECT_EQ(porous.mean_stress, dense.mean_stress) << law.name;
          }
        },
        sample.law);
}

TEST(PorousReturnMapping, ReferenceOptionTestsThePorousSurfaceButReturnsToTheMatrix) {
  auto surface = steel_surface;
  surface.return_to = yield::ReturnTo::matrix_stress;
  const flow_stress::LinearHardening law{400e6, 0.0};
  Trial<double> t{};
  t.shear_modulus = 45e9, t.bulk_modulus = 140e9, t.inverse_time_step = 1e6, t.porosity = 0.05;
  t.at.melting_temperature = 1e30, t.at.temperature = 300.0;
  t.equivalent_stress = 500e6, t.mean_stress = 300e6;
  const auto end = return_to_surface(surface, law, steel_nucleation, t);
  EXPECT_NEAR(end.equivalent_stress, 400e6, consistency * 400e6);
  EXPECT_EQ(end.mean_stress, 300e6);
  EXPECT_EQ(end.plastic_volume_increment, 0.0);
}

TEST(PorousReturnMapping, LanesGiveWhatDoublesGive) {
  // Solvers stop at 1e-10 to 1e-12 relative, and lanes round their elementary functions differently.
  constexpr double agreement = 1e-8;
  for (const samples::Sample& sample : samples::flow_stresses())
    std::visit(
        [&](const auto& law) {
          States states(sample);
          for (int pack = 0; pack < 500; ++pack) {
            Trial<double> one[8];
            Trial<Lanes> all{};
            const auto put = [&](Lanes& to, int i, double value) { to.set(i, value); };
            for (int i = 0; i < 8; ++i) {
              Trial<double>& t = one[i] = states.next();
              t.porosity = states.uniform(0.0, 0.2);
              t.equivalent_stress = std::min(t.equivalent_stress, 20e9);
              put(all.equivalent_stress, i, t.equivalent_stress), put(all.mean_stress, i, t.mean_stress);
              put(all.shear_modulus, i, t.shear_modulus), put(all.bulk_modulus, i, t.bulk_modulus);
              put(all.at.plastic_strain, i, t.at.plastic_strain), put(all.at.temperature, i, t.at.temperature);
              put(all.at.melting_temperature, i, t.at.melting_temperature), put(all.at.shear_modulus, i, t.at.shear_modulus);
              put(all.at.pressure, i, t.at.pressure), put(all.at.density, i, t.at.density);
              put(all.flow_history, i, t.flow_history), put(all.porosity, i, t.porosity);
              put(all.inverse_time_step, i, t.inverse_time_step), put(all.last_rate, i, t.last_rate);
            }
            const auto packed = return_to_surface(steel_surface, law, steel_nucleation, all);
            for (int i = 0; i < 8; ++i) {
              const auto single = return_to_surface(steel_surface, law, steel_nucleation, one[i]);
              const double scale = one[i].equivalent_stress + std::abs(one[i].mean_stress);
              EXPECT_TRUE(lane(packed.converged, i)) << law.name;
              EXPECT_NEAR(lane(packed.equivalent_stress, i), single.equivalent_stress, agreement * scale) << law.name;
              EXPECT_NEAR(lane(packed.mean_stress, i), single.mean_stress, agreement * scale) << law.name;
              EXPECT_NEAR(lane(packed.plastic_strain_increment, i), single.plastic_strain_increment,
                          agreement * (single.plastic_strain_increment + scale / one[i].shear_modulus))
                  << law.name;
            }
          }
        },
        sample.law);
}

}  // namespace
}  // namespace brisance
