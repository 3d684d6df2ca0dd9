#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "models/porosity/initial_distribution.hpp"
#include "models/porosity/porosity.hpp"
#include "models/random.hpp"

namespace brisance {
namespace {

using porosity::initial::Constant;
using porosity::initial::Gaussian;
using porosity::initial::Weibull;

constexpr int points = 100000;
constexpr std::uint64_t seed = 20240229;

template <class Law>
std::vector<double> sample(const Law& law) {
  std::vector<double> f;
  for (int id = 0; id < points; ++id) f.push_back(law(uniform(seed, id, RandomProperty::porosity)));
  return f;
}

double mean(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}
double deviation(const std::vector<double>& x) {
  const double m = mean(x);
  double sum = 0.0;
  for (double v : x) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(x.size()));
}
double normal_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}
double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

TEST(Random, PhiloxGivesItsPublishedAnswers) {
  // Known-answer file of Random123 (Salmon, Moraes, Dror & Shaw, SC11), philox4x32 with 10 rounds.
  using Philox = r123::Philox4x32;
  const auto expect = [](Philox::ctr_type counter, Philox::key_type key, Philox::ctr_type answer) {
    EXPECT_EQ(Philox{}(counter, key), answer);
  };
  expect({{0, 0, 0, 0}}, {{0, 0}}, {{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}});
  expect({{~0u, ~0u, ~0u, ~0u}}, {{~0u, ~0u}}, {{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}});
  expect({{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}}, {{0xa4093822, 0x299f31d0}},
         {{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}});
}

TEST(Random, UniformIsTheFirst52BitsOfTheBlock) {
  EXPECT_EQ(uniform(0, 0, RandomProperty::porosity), (static_cast<double>(0x6627e8d5e169cULL) + 0.5) * 0x1p-52);
}

TEST(Random, UniformFillsTheUnitInterval) {
  // Mean 1/2 and deviation 1/sqrt 12 within four standard errors.
  const std::vector<double> u = sample([](double x) { return x; });
  EXPECT_NEAR(mean(u), 0.5, 4.0 / std::sqrt(12.0 * points));
  EXPECT_NEAR(deviation(u), 1.0 / std::sqrt(12.0), 4.0 / std::sqrt(180.0 * points) * std::sqrt(3.0));
  EXPECT_GT(*std::min_element(u.begin(), u.end()), 0.0);
  EXPECT_LT(*std::max_element(u.begin(), u.end()), 1.0);
}

TEST(Random, PropertiesSeedsAndDistantIdsAreIndependent) {
  // Correlation of independent samples: zero within four standard errors.
  const auto correlation = [](auto&& first, auto&& second) {
    double sum = 0.0;
    for (int id = 0; id < points; ++id) sum += (first(id) - 0.5) * (second(id) - 0.5);
    return 12.0 * sum / points;
  };
  const double allowed = 4.0 / std::sqrt(points);
  const auto base = [](std::uint64_t id) { return uniform(seed, id, RandomProperty::porosity); };
  EXPECT_NEAR(correlation(base, base), 1.0, 4.0 * allowed);
  EXPECT_NEAR(correlation(base, [](auto id) { return uniform(seed, id, RandomProperty::damage); }), 0.0, allowed);
  EXPECT_NEAR(correlation(base, [](auto id) { return uniform(seed + 1, id, RandomProperty::porosity); }), 0.0, allowed);
  EXPECT_NEAR(correlation(base, [](auto id) { return uniform(seed + (1ULL << 32), id, RandomProperty::porosity); }), 0.0,
              allowed);
  EXPECT_NEAR(correlation(base, [&](auto id) { return base(id + 1ULL); }), 0.0, allowed);
  EXPECT_NEAR(correlation(base, [&](auto id) { return base(id + (1ULL << 32)); }), 0.0, allowed);
}

TEST(InitialPorosity, DoesNotDependOnTheOrderOfThePoints) {
  const Gaussian law{.mean = 0.005, .standard_deviation = 0.001, .upper = 0.15};
  const std::vector<double> in_order = sample(law);
  std::vector<int> ids(points);
  std::iota(ids.begin(), ids.end(), 0);
  std::shuffle(ids.begin(), ids.end(), std::mt19937(3));
  for (int id : ids) ASSERT_EQ(law(uniform(seed, id, RandomProperty::porosity)), in_order[id]);
}

TEST(InitialPorosity, ConstantIsConstant) {
  EXPECT_EQ(Constant{.value = 0.005}(0.123), 0.005);
}

TEST(InitialPorosity, UntruncatedGaussianHasTheMomentsGiven) {
  const std::vector<double> f = sample(Gaussian{.mean = 0.005, .standard_deviation = 0.0005, .upper = 0.15});
  EXPECT_NEAR(mean(f), 0.005, 4.0 * 0.0005 / std::sqrt(points));
  EXPECT_NEAR(deviation(f), 0.0005, 4.0 * 0.0005 / std::sqrt(2.0 * points));
}

TEST(InitialPorosity, TruncatedGaussianHasNeitherFoldNorPile) {
  // Zero is one deviation below the mean and the upper bound half a deviation above it. Closed forms of the truncated moments.
  const Gaussian law{.mean = 0.005, .standard_deviation = 0.005, .upper = 0.0075};
  const std::vector<double> f = sample(law);
  EXPECT_GT(*std::min_element(f.begin(), f.end()), 0.0);
  EXPECT_LT(*std::max_element(f.begin(), f.end()), 0.0075);

  const double a = -1.0, b = 0.5, inside = normal_below(b) - normal_below(a);
  const double shift = (normal_density(a) - normal_density(b)) / inside;
  const double variance = 1.0 + (a * normal_density(a) - b * normal_density(b)) / inside - shift * shift;
  const double sigma = 0.005 * std::sqrt(variance);
  EXPECT_NEAR(mean(f), 0.005 * (1.0 + shift), 4.0 * sigma / std::sqrt(points));
  EXPECT_NEAR(deviation(f), sigma, 4.0 * sigma / std::sqrt(2.0 * points));  // kurtosis below 3: the error is smaller still
}

TEST(InitialPorosity, SampleFollowsTheDistributionFunction) {
  // Kolmogorov-Smirnov: a larger distance than 1.95/sqrt n comes in one sample of a thousand.
  const auto distance = [](std::vector<double> f, auto&& below) {
    std::sort(f.begin(), f.end());
    double largest = 0.0;
    for (int i = 0; i < points; ++i) largest = std::max(largest, std::abs((i + 0.5) / points - below(f[i])));
    return largest;
  };
  const double allowed = 1.95 / std::sqrt(points);
  const double from = normal_below(-1.0), inside = normal_below(0.5) - from;
  EXPECT_LT(distance(sample(Gaussian{.mean = 0.005, .standard_deviation = 0.005, .upper = 0.0075}),
                     [&](double f) { return (normal_below((f - 0.005) / 0.005) - from) / inside; }),
            allowed);
  const double all = 1.0 - std::exp(-std::pow(0.02 / 0.01, 1.7));
  EXPECT_LT(distance(sample(Weibull{.scale = 0.01, .shape = 1.7, .upper = 0.02}),
                     [&](double f) { return (1.0 - std::exp(-std::pow(f / 0.01, 1.7))) / all; }),
            allowed);
}

TEST(InitialPorosity, GaussianQuantilesAreExactIntoTheTails) {
  // With both bounds some ten deviations away it is the inverse of the normal distribution itself; tabulated quantiles.
  const Gaussian law{.mean = 0.5, .standard_deviation = 0.05, .upper = 0.99};
  constexpr double tolerance = 1e-14;
  EXPECT_NEAR(law(0.5), 0.5, tolerance);
  EXPECT_NEAR(law(0.975), 0.5 + 0.05 * 1.9599639845400542, tolerance);
  EXPECT_NEAR(law(0.001), 0.5 - 0.05 * 3.0902323061678132, tolerance);
  EXPECT_NEAR(law(1e-6), 0.5 - 0.05 * 4.753424308822899, tolerance);
  EXPECT_NEAR(law(1e-12), 0.5 - 0.05 * 7.034483825301132, 1e-13);  // the bound ten deviations away moves it by 5e-14
}

TEST(InitialPorosity, AGaussianFarOutsideItsBoundsStillLiesWithin) {
  for (double mean_porosity : {0.0, 0.2, 1.0}) {
    for (double width : {1e-4, 1e-2, 10.0}) {
      const Gaussian law{.mean = mean_porosity, .standard_deviation = width, .upper = 0.01};
      double before = 0.0;
      for (double u : {0x1p-53, 1e-3, 0.3, 0.7, 0.999, 1.0 - 0x1p-53}) {
        const double f = law(u);
        EXPECT_GE(f, before) << mean_porosity << ' ' << width << ' ' << u;
        EXPECT_LE(f, 0.01) << mean_porosity << ' ' << width << ' ' << u;
        before = f;
      }
    }
  }
  // A distribution much wider than the bounds is uniform between them.
  EXPECT_NEAR((Gaussian{.mean = 0.0, .standard_deviation = 1e3, .upper = 0.01}(0.3)), 0.003, 1e-11);
}

TEST(InitialPorosity, WeibullHasTheMeanOfTheGammaFunction) {
  const double scale = 0.01, shape = 2.0;  // the bound is 50 scales away
  const std::vector<double> f = sample(Weibull{.scale = scale, .shape = shape, .upper = 0.5});
  const double expected = scale * std::tgamma(1.5), sigma = scale * std::sqrt(1.0 - std::numbers::pi / 4.0);
  EXPECT_NEAR(mean(f), expected, 4.0 * sigma / std::sqrt(points));
  EXPECT_LE((Weibull{.scale = 0.1, .shape = 0.5, .upper = 0.2}(1.0 - 0x1p-53)), 0.2);
}

TEST(ChuNeedleman, NucleatesAllOfItsVolumeFractionHalfOfItAtTheMeanStrain) {
  const porosity::ChuNeedleman law{
      .volume_fraction = 0.04, .mean_strain = 0.3, .standard_deviation = 0.1, .nucleates_in_compression = false};
  EXPECT_NEAR(law.nucleated(0.3), 0.02, 1e-17);
  EXPECT_NEAR(law.nucleated(3.0), 0.04, 1e-17);
  EXPECT_NEAR(law.nucleated(0.4) - law.nucleated(0.2), 0.04 * 0.682689492137086, 1e-16);  // within one deviation
  // From no strain on, what is left of the bell: fN (1 + erf(eN/(sN sqrt 2)))/2.
  EXPECT_NEAR(law.nucleated(3.0) - law.nucleated(0.0), 0.02 * (1.0 + std::erf(3.0 / std::numbers::sqrt2)), 1e-16);
}

TEST(ChuNeedleman, NucleationRateIsTheGaussBell) {
  const porosity::ChuNeedleman law{
      .volume_fraction = 0.04, .mean_strain = 0.3, .standard_deviation = 0.1, .nucleates_in_compression = false};
  for (double strain : {0.0, 0.1, 0.3, 0.55}) {
    const double bell = 0.4 * normal_density((strain - 0.3) / 0.1);
    EXPECT_NEAR(law.nucleated(Dual<double>::variable(strain)).derivative[0], bell, 1e-14) << strain;
  }
}

}  // namespace
}  // namespace brisance
