// What varies from particle to particle at the start: porosity and damage, drawn by the particle's id.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "tests/simulator/by_hand.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator {
namespace {

constexpr double scale = 0.1, shape = 2.0, upper = 0.5;

/// 1600 particles of a porous steel in 100 blocks of the grid.
Case plate() {
  Case c;
  c.geometry = Geometry::plane, c.cell_size = 1e-3, c.end_time = 1.0;
  c.bodies.push_back(by_hand::body("plate", read_material(BRISANCE_SOURCE_DIR "/data/materials/steel_hy100.toml"),
                                   by_hand::box({0, 0, 0}, {20e-3, 20e-3, 0})));
  c.bodies[0].damage = porosity::initial::Weibull{scale, shape, upper};
  c.bodies[0].porosity = porosity::initial::Weibull{scale, shape, upper};
  return c;
}

struct Fields {
  double porosity, damage;
  bool operator==(const Fields&) const = default;
};
std::map<std::uint64_t, Fields> start(const Case& c, int ranks) {
  std::map<std::uint64_t, Fields> fields;
  std::mutex one_at_a_time;
  VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
    const Simulation s = set_up(c, domain);
    const std::lock_guard lock(one_at_a_time);
    const Particles& ps = s.bodies[0].particles;
    using Rest = Layout<2>::Rest;
    for (int p = 0; p < ps.size; ++p)
      fields[ps.id[static_cast<std::size_t>(p)]] = {ps.rest.at(Rest::porosity, p), ps.rest.at(Rest::damage, p)};
  });
  return fields;
}

TEST(InitialDamage, FollowsItsDistribution) {
  const auto fields = start(plate(), 1);
  ASSERT_EQ(fields.size(), 1600u);
  // Kolmogorov and Smirnov: the sample's distribution function is nowhere farther from the true one, in 999 of 1000 samples.
  const double farthest = 1.95 / std::sqrt(1600.0);
  std::vector<double> damage;
  for (const auto& [id, f] : fields) damage.push_back(f.damage);
  std::sort(damage.begin(), damage.end());
  for (std::size_t i = 0; i < damage.size(); ++i) {
    const auto below = [](double x) { return -std::expm1(-std::pow(x / scale, shape)); };
    EXPECT_NEAR(static_cast<double>(i) / 1600.0, below(damage[i]) / below(upper), farthest);
  }
}

TEST(InitialDamage, IsIndependentOfThePorosityOfTheSameDistribution) {
  const auto fields = start(plate(), 1);
  const auto mean = [&](auto&& of) {
    double total = 0.0;
    for (const auto& [id, f] : fields) total += of(f);
    return total / 1600.0;
  };
  const double f = mean([](const Fields&x) { return x.porosity; }), d = mean([](const Fields&x) { return x.damage; });
  const double covariance = mean([&](const Fields& x) { return (x.porosity - f) * (x.damage - d); });
  const double variance = mean([&](const Fields& x) { return (x.damage - d) * (x.damage - d); });
  EXPECT_LT(std::abs(covariance / variance), 3.3 / std::sqrt(1600.0)) << "in 999 of 1000 samples of independent numbers";
}

TEST(InitialFields, DoNotDependOnTheNumberOfRanks) {
  const Case c = plate();
  const auto one = start(c, 1);
  for (const int ranks : {2, 3}) EXPECT_TRUE(start(c, ranks) == one);
}

TEST(InitialFields, AreTheMaterialsWhereTheBodySaysNothing) {
  Case c = plate();
  c.bodies[0].damage.reset();
  c.bodies[0].material.material.initial_damage = porosity::initial::Constant{0.25};
  for (const auto& [id, f] : start(c, 1)) EXPECT_EQ(f.damage, 0.25);
  c.bodies[0].material.material.initial_damage.reset();
  for (const auto& [id, f] : start(c, 1)) EXPECT_EQ(f.damage, 0.0);
}

}  // namespace
}  // namespace brisance::simulator
