#include "models/failure/failure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace brisance::failure {
namespace {

Arguments<double> sound() {
  return {.temperature = 300.0,
          .melting_temperature = 1800.0,
          .plastic_strain = 0.0,
          .damage = 0.0,
          .porosity = 0.0,
          .capacity_used = 0.0,
          .stability_margin = 1.0,
          .mean_stress = 0.0};
}

TEST(Failure, ASoundPointFailsByNoCriterion) {
  EXPECT_LT(Melting{}(sound()), 0.0);
  EXPECT_LT(TeplaF{.failure_porosity = 0.3}(sound()), 0.0);
  EXPECT_LT(CriticalDamage{.damage = 1.0}(sound()), 0.0);
  EXPECT_LT(CriticalPorosity{.porosity = 0.2}(sound()), 0.0);
  EXPECT_LT((Instability{.min_plastic_strain = 0.0, .tension_only = false}(sound())), 0.0);
  EXPECT_LT(TensileLimit{.mean_stress = 2e9}(sound()), 0.0);
}

TEST(Failure, MeltsAtTheMeltingTemperature) {
  Arguments<double> at = sound();
  at.temperature = 1800.0;
  EXPECT_EQ(Melting{}(at), 0.0);
  at.temperature = 1799.999;
  EXPECT_LT(Melting{}(at), 0.0);
}

TEST(Failure, TeplaLocusIsAnEllipse) {
  // Half of the porosity leaves a damage of sqrt(1 - 1/4).
  constexpr double round_off = 4e-16;
  const TeplaF law{.failure_porosity = 0.3};
  Arguments<double> at = sound();
  for (double f : {0.0, 0.05, 0.15, 0.29}) {
    at.porosity = f;
    at.damage = std::sqrt(1.0 - (f / 0.3) * (f / 0.3));
    EXPECT_NEAR(law(at), 0.0, round_off) << f;
    at.damage *= 0.999;
    EXPECT_LT(law(at), 0.0) << f;
  }
  at.damage = 0.0, at.porosity = 0.3;
  EXPECT_EQ(law(at), 0.0);
}

TEST(Failure, APorousSurfaceThatHasVanishedIsFailureWhateverThePorosityLimit) {
  // q1 = 1.5, fc = 0.05, kc = 4: f* = 1/q1 already at f = 0.2042, well below a limit of 0.3.
  Arguments<double> at = sound();
  at.porosity = 0.2042;
  at.capacity_used = 1.0 - 1e-6;
  EXPECT_GE(TeplaF{.failure_porosity = 0.3}(at), 0.0);
  EXPECT_GE(CriticalPorosity{.porosity = 0.3}(at), 0.0);
  at.capacity_used = 0.99;
  EXPECT_LT(TeplaF{.failure_porosity = 0.3}(at), 0.0);
  EXPECT_LT(CriticalPorosity{.porosity = 0.3}(at), 0.0);
}

TEST(Failure, DamageAndPorosityFailAtTheirLimits) {
  Arguments<double> at = sound();
  at.damage = 1.0, at.porosity = 0.2;
  EXPECT_EQ(CriticalDamage{.damage = 1.0}(at), 0.0);
  EXPECT_GT(CriticalDamage{.damage = 0.7}(at), 0.0);
  EXPECT_EQ(CriticalPorosity{.porosity = 0.2}(at), 0.0);
  EXPECT_LT(CriticalPorosity{.porosity = 0.21}(at), 0.0);
}

TEST(Failure, AnUnstablePointFailsOnceItIsJudged) {
  Arguments<double> at = sound();
  at.stability_margin = -0.01, at.plastic_strain = 0.1;
  EXPECT_GE((Instability{.min_plastic_strain = 0.0, .tension_only = false}(at)), 0.0);
  EXPECT_GE((Instability{.min_plastic_strain = 0.1, .tension_only = false}(at)), 0.0);
  EXPECT_LT((Instability{.min_plastic_strain = 0.2, .tension_only = false}(at)), 0.0);
  EXPECT_LT((Instability{.min_plastic_strain = 0.0, .tension_only = true}(at)), 0.0);
  at.mean_stress = 1.0;
  EXPECT_GE((Instability{.min_plastic_strain = 0.0, .tension_only = true}(at)), 0.0);
  at.stability_margin = 0.0;  // the onset counts
  EXPECT_GE((Instability{.min_plastic_strain = 0.0, .tension_only = true}(at)), 0.0);
}

TEST(Failure, SpallsAtTheLimitOfMeanTensionAndNeverUnderPressure) {
  const TensileLimit law{.mean_stress = 2e9};
  Arguments<double> at = sound();
  at.mean_stress = 2e9;
  EXPECT_NEAR(law(at), 0.0, 4e-16);
  at.mean_stress = -1e11;
  EXPECT_LT(law(at), 0.0);
}

TEST(Failure, EachLaneFailsByItself) {
  Arguments<Lanes> at;
  at.melting_temperature = 1800.0, at.stability_margin = 1.0;
  at.temperature = 300.0, at.temperature.set(3, 1900.0);
  at.porosity.set(5, 0.4), at.damage.set(6, 1.0), at.mean_stress.set(1, 3e9);
  const auto only = [](const Lanes& excess, int lane) {
    for (int i = 0; i < 8; ++i) EXPECT_EQ(excess[i] >= 0.0, i == lane) << i;
  };
  only(Melting{}(at), 3);
  only(CriticalPorosity{.porosity = 0.3}(at), 5);
  only(CriticalDamage{.damage = 1.0}(at), 6);
  only(TensileLimit{.mean_stress = 2e9}(at), 1);
  at.stability_margin.set(1, -0.1), at.stability_margin.set(2, -0.1);
  only(Instability{.min_plastic_strain = 0.0, .tension_only = true}(at), 1);
  at.porosity = 0.1;
  only(TeplaF{.failure_porosity = 0.3}(at), 6);
}

TEST(Failure, EveryCriterionRecordsACauseOfItsOwn) {
  const auto cause = []<class... Law>(std::type_identity<std::variant<Law...>>) {
    return std::array{Law::cause...};
  }(std::type_identity<Failure>{});
  for (std::size_t i = 0; i < cause.size(); ++i) {
    EXPECT_NE(cause[i], FailureCause::none);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(cause[i], cause[j]);
  }
}

}  // namespace
}  // namespace brisance::failure
