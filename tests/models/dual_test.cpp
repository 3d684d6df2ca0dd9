// Derivatives by dual numbers against derivatives by hand in long double, on every base: double, Lanes, and duals of both.

#include "models/dual.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "models/flow_stress/johnson_cook.hpp"

using namespace brisance;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// Errors over one plus the size of what is expected: a few roundings per operation, and a function takes part in each
// derivative two or three times.
constexpr double tolerance_value = 4 * epsilon;
constexpr double tolerance_first = 8 * epsilon;
constexpr double tolerance_second = 24 * epsilon;

void expect_close(double actual, long double expected, double tolerance, const char* what, double x) {
  EXPECT_LE(std::abs(actual - expected), tolerance * (1.0L + std::abs(expected))) << what << " at " << x;
}

struct Exact {
  long double value, first, second;
};

// f is written once for every Real; exact(x) gives the value and two derivatives by hand.
template <class F, class E>
void expect_derivatives(const F& f, const E& exact, double lower, double upper) {
  using D = Dual<double>;
  using L = Dual<Lanes>;
  for (int p = 0; p < 200; ++p) {
    Lanes x;
    for (int i = 0; i < Lanes::width; ++i) x.set(i, lower + (upper - lower) * (Lanes::width * p + i + 0.5) / 1600.0);
    const Lanes value = f(x);
    const L first = f(L::variable(x));
    const Dual<L> second = f(Dual<L>::variable(L::variable(x)));
    for (int i = 0; i < Lanes::width; ++i) {
      const Exact e = exact(static_cast<long double>(x[i]));
      expect_close(value[i], e.value, tolerance_value, "value on Lanes", x[i]);
      expect_close(first.value[i], e.value, tolerance_value, "value on Dual<Lanes>", x[i]);
      expect_close(first.derivative[0][i], e.first, tolerance_first, "first on Dual<Lanes>", x[i]);
      expect_close(second.value.value[i], e.value, tolerance_value, "value on Dual<Dual<Lanes>>", x[i]);
      expect_close(second.derivative[0].value[i], e.first, tolerance_first, "first on Dual<Dual<Lanes>>", x[i]);
      expect_close(second.derivative[0].derivative[0][i], e.second, tolerance_second, "second on Lanes", x[i]);

      const D one = f(D::variable(x[i]));
      const Dual<D> two = f(Dual<D>::variable(D::variable(x[i])));
      expect_close(one.value, e.value, tolerance_value, "value on Dual", x[i]);
      expect_close(one.derivative[0], e.first, tolerance_first, "first on Dual", x[i]);
      expect_close(two.derivative[0].value, e.first, tolerance_first, "first on Dual<Dual>", x[i]);
      expect_close(two.value.derivative[0], e.first, tolerance_first, "inner first on Dual<Dual>", x[i]);
      expect_close(two.derivative[0].derivative[0], e.second, tolerance_second, "second on Dual<Dual>", x[i]);
    }
  }
}

using Long = long double;

}  // namespace

TEST(Dual, ArithmeticObeysTheRulesOfDifferentiation) {
  expect_derivatives([](const auto& x) { return 3.0 * x * x - x / 2.0 + 1.0; },
                     [](Long x) {
                       return Exact{3 * x * x - x / 2 + 1, 6 * x - 0.5L, 6};
                     },
                     -2.0, 2.0);
  expect_derivatives([](const auto& x) { return 1.0 / x; },
                     [](Long x) {
                       return Exact{1 / x, -1 / (x * x), 2 / (x * x * x)};
                     },
                     0.2, 5.0);
  expect_derivatives([](const auto& x) { return (1.0 - x) / (1.0 + x); },
                     [](Long x) {
                       return Exact{(1 - x) / (1 + x), -2 / ((1 + x) * (1 + x)), 4 / ((1 + x) * (1 + x) * (1 + x))};
                     },
                     0.0, 3.0);
  expect_derivatives(
      [](auto x) {
        auto y = x;
        y += x * x;
        y -= 2.0;
        y *= x;
        y /= 4.0;
        return -y;
      },
      [](Long x) {
        return Exact{-(x * x + x * x * x - 2 * x) / 4, -(2 * x + 3 * x * x - 2) / 4, -(2 + 6 * x) / 4};
      },
      -2.0, 2.0);
}

TEST(Dual, EveryFunctionHasItsDerivative) {
  expect_derivatives([](const auto& x) { return sqrt(x); },
                     [](Long x) {
                       return Exact{std::sqrt(x), 0.5L / std::sqrt(x), -0.25L / (x * std::sqrt(x))};
                     },
                     0.1, 9.0);
  expect_derivatives([](const auto& x) { return exp(x); },
                     [](Long x) {
                       return Exact{std::exp(x), std::exp(x), std::exp(x)};
                     },
                     -5.0, 5.0);
  expect_derivatives([](const auto& x) { return expm1(x); },
                     [](Long x) {
                       return Exact{std::expm1(x), std::exp(x), std::exp(x)};
                     },
                     -3.0, 3.0);
  expect_derivatives([](const auto& x) { return log(x); },
                     [](Long x) {
                       return Exact{std::log(x), 1 / x, -1 / (x * x)};
                     },
                     0.1, 10.0);
  expect_derivatives([](const auto& x) { return log1p(x); },
                     [](Long x) {
                       return Exact{std::log1p(x), 1 / (1 + x), -1 / ((1 + x) * (1 + x))};
                     },
                     -0.8, 5.0);
  for (double n : {0.26, 0.5, 1.0, 1.09, 2.0, 3.5, -0.7})
    expect_derivatives([n](const auto& x) { return pow(x, n); },
                       [n](Long x) {
                         const Long m = n;
                         return Exact{std::pow(x, m), m * std::pow(x, m - 1), m * (m - 1) * std::pow(x, m - 2)};
                       },
                       0.05, 4.0);
  expect_derivatives([](const auto& x) { return tanh(x); },
                     [](Long x) {
                       const Long t = std::tanh(x), d = 1 / (std::cosh(x) * std::cosh(x));
                       return Exact{t, d, -2 * t * d};
                     },
                     -4.0, 4.0);
  expect_derivatives([](const auto& x) { return sinh(x); },
                     [](Long x) {
                       return Exact{std::sinh(x), std::cosh(x), std::sinh(x)};
                     },
                     -4.0, 4.0);
  expect_derivatives([](const auto& x) { return cosh(x); },
                     [](Long x) {
                       return Exact{std::cosh(x), std::sinh(x), std::cosh(x)};
                     },
                     -4.0, 4.0);
  expect_derivatives([](const auto& x) { return erf(x); },
                     [](Long x) {
                       const Long d = 2 * std::numbers::inv_sqrtpi_v<Long> * std::exp(-x * x);
                       return Exact{std::erf(x), d, -2 * x * d};
                     },
                     -4.0, 4.0);
}

TEST(Dual, CompositionObeysTheChainRule) {
  expect_derivatives([](const auto& x) { return exp(-x) * log1p(x * x); },
                     [](Long x) {
                       const Long e = std::exp(-x), l = std::log1p(x * x), d = 2 * x / (1 + x * x);
                       const Long dd = 2 * (1 - x * x) / ((1 + x * x) * (1 + x * x));
                       return Exact{e * l, e * (d - l), e * (l - 2 * d + dd)};
                     },
                     -1.0, 3.0);
}

TEST(Dual, BranchesBringTheirOwnDerivativeInEachLane) {
  using D = Dual<Lanes>;
  Lanes x;
  for (int i = 0; i < Lanes::width; ++i) x.set(i, i - 3.5);
  const D t = D::variable(x);
  const D chosen = select(t < 0.0, t * t, 5.0 * t), low = min(t, 1.0), high = max(2.0 * t, 1.0), size = abs(t);
  const D limited = clamp(t, -2.0, 2.0);
  for (int i = 0; i < Lanes::width; ++i) {
    const double at = i - 3.5;
    EXPECT_EQ(chosen.value[i], at < 0 ? at * at : 5 * at);
    EXPECT_EQ(chosen.derivative[0][i], at < 0 ? 2 * at : 5);
    EXPECT_EQ(low.derivative[0][i], at <= 1 ? 1 : 0);
    EXPECT_EQ(high.derivative[0][i], 2 * at >= 1 ? 2 : 0);
    EXPECT_EQ(size.value[i], std::fabs(at));
    EXPECT_EQ(size.derivative[0][i], at < 0 ? -1 : 1);
    EXPECT_EQ(limited.value[i], std::clamp(at, -2.0, 2.0));
    EXPECT_EQ(limited.derivative[0][i], std::fabs(at) <= 2 ? 1 : 0);
  }
}

TEST(Dual, TheBranchNotTakenMayBeInfinite) {
  using D = Dual<Lanes>;
  Lanes x = 0.0;
  x.set(2, 4.0);
  const D t = D::variable(x);
  const D safe = select(t > 0.0, sqrt(t), D(0.0));
  for (int i = 0; i < Lanes::width; ++i) {
    EXPECT_EQ(safe.value[i], i == 2 ? 2.0 : 0.0);
    EXPECT_EQ(safe.derivative[0][i], i == 2 ? 0.25 : 0.0);
  }
}

TEST(Dual, PowerAtZeroIsZeroWithoutSlope) {
  for (double n : {0.31, 1.0, 2.0}) {
    const auto one = pow(Dual<double>::variable(0.0), n);
    EXPECT_EQ(one.value, 0.0);
    EXPECT_EQ(one.derivative[0], 0.0);
    const auto lanes = pow(Dual<Lanes>::variable(Lanes(0.0)), n);
    EXPECT_EQ(lanes.value[4], 0.0);
    EXPECT_EQ(lanes.derivative[0][4], 0.0);
  }
}

TEST(Dual, SeveralVariablesGiveTheGradient) {
  using D = Dual<Lanes, 3>;
  const D x = D::variable(2.0, 0), y = D::variable(3.0, 1), z = D::variable(5.0, 2);
  const D f = x * y * y + y / z;
  for (int i = 0; i < Lanes::width; ++i) {
    expect_close(f.value[i], 18.6L, tolerance_value, "f", 0);
    expect_close(f.derivative[0][i], 9.0L, tolerance_first, "df/dx", 0);
    expect_close(f.derivative[1][i], 12.2L, tolerance_first, "df/dy", 0);
    expect_close(f.derivative[2][i], -0.12L, tolerance_first, "df/dz", 0);
  }
}

TEST(Dual, HoldsAsManyPointsAsItsBase) {
  static_assert(width_of<Dual<double>> == 1 && width_of<Dual<Lanes>> == 8 && width_of<Dual<Dual<Lanes, 2>, 3>> == 8);
  static_assert(std::is_same_v<mask_of<Dual<Dual<Lanes>>>, LanesMask>);
}

TEST(Dual, ALawGivesItsTangentOnLanes) {
  constexpr flow_stress::JohnsonCook copper{90e6, 292e6, 0.31, 0.025, 1.09, 1.0, 298.0};
  using D = Dual<Lanes, 3>;
  Lanes strain, rate, temperature;
  for (int i = 0; i < Lanes::width; ++i) {
    strain.set(i, 0.01 + 0.1 * i);
    rate.set(i, 10.0 * (1 << 2 * i));
    temperature.set(i, 320.0 + 100.0 * i);
  }
  const D yield = copper(flow_stress::Arguments<D>{.plastic_strain = D::variable(strain, 0),
                                                   .plastic_strain_rate = D::variable(rate, 1),
                                                   .temperature = D::variable(temperature, 2),
                                                   .melting_temperature = D(1356.0)});
  for (int i = 0; i < Lanes::width; ++i) {
    const Long ep = strain[i], r = rate[i], theta = (temperature[i] - 298.0L) / 1058.0L;
    const Long n = 0.31, m = 1.09, hardening = 90e6L + 292e6L * std::pow(ep, n), rate_factor = 1 + Long(0.025) * std::log(r);
    const Long softening = 1 - std::pow(theta, m);
    const auto expect_relative = [&](double actual, Long expected, const char* what) {
      EXPECT_LE(std::abs(actual / expected - 1), 16 * epsilon) << what << " in lane " << i;
    };
    expect_relative(yield.value[i], hardening * rate_factor * softening, "Y");
    expect_relative(yield.derivative[0][i], 292e6L * n * std::pow(ep, n - 1) * rate_factor * softening, "dY/dep");
    expect_relative(yield.derivative[1][i], hardening * Long(0.025) / r * softening, "dY/dr");
    expect_relative(yield.derivative[2][i], -hardening * rate_factor * m * std::pow(theta, m - 1) / 1058.0L, "dY/dT");
  }
}
