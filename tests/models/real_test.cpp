// Lanes and its functions against the long double functions of the mathematics library, which are 11 bits finer.

#include "models/real.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <vector>

using namespace brisance;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = 5e-324;
constexpr double epsilon = std::numeric_limits<double>::epsilon();  // one unit in the last place of 1

// Errors of the value over the value. Half an epsilon is the rounding of the result; the rest is what each function adds:
constexpr double tolerance_exp = 1.1 * epsilon;      // a polynomial and one scaling, one rounding each
constexpr double tolerance_log = 0.6 * epsilon;      // carried to 60 bits before the last rounding
constexpr double tolerance_pow = 1.25 * epsilon;     // exp of a logarithm carried to 60 bits
constexpr double tolerance_derived = 4.0 * epsilon;  // expm1, log1p, tanh, sinh, cosh: few operations on the above
constexpr double tolerance_erf_absolute = 1e-15;

std::mt19937_64 generator(7);
double uniform(double lower, double upper) {
  return lower + (upper - lower) * 0x1p-53 * static_cast<double>(generator() >> 11);
}
std::vector<double> spread(double lower, double upper) {
  std::vector<double> x{lower, upper};
  while (x.size() < 80'000) x.push_back(uniform(lower, upper));
  return x;
}
// Of both signs, evenly over the decades.
std::vector<double> decades(double lower, double upper) {
  std::vector<double> x{std::pow(10.0, lower), std::pow(10.0, upper)};
  while (x.size() < 80'000) x.push_back(std::pow(10.0, uniform(lower, upper)));
  return x;
}
std::vector<double> both_signs(std::vector<double> x) {
  for (std::size_t i = 0; i < x.size(); i += 2) x[i] = -x[i];
  return x;
}

double apply(const auto& f, double x) {
  const Lanes y = f(Lanes(x));
  return y[3];
}

struct Error {
  double relative = 0, absolute = 0, at = 0;
};
// The largest error of f on Lanes. NaN counts as infinite.
Error largest_error(const auto& f, const auto& exact, const std::vector<double>& arguments) {
  Error worst;
  for (std::size_t first = 0; first + Lanes::width <= arguments.size(); first += Lanes::width) {
    const Lanes y = f(Lanes::load(&arguments[first]));
    for (int i = 0; i < Lanes::width; ++i) {
      const double x = arguments[first + i];
      const long double expected = exact(static_cast<long double>(x));
      const auto absolute = static_cast<double>(std::abs(y[i] - expected));
      const double relative = absolute == 0.0 ? 0.0 : absolute / std::abs(static_cast<double>(expected));
      if (!(relative <= worst.relative)) worst.relative = std::isnan(relative) ? infinity : relative, worst.at = x;
      if (!(absolute <= worst.absolute)) worst.absolute = std::isnan(absolute) ? infinity : absolute;
    }
  }
  return worst;
}
void expect_accurate(double tolerance, const auto& f, const auto& exact, const std::vector<double>& arguments) {
  const Error error = largest_error(f, exact, arguments);
  EXPECT_LE(error.relative, tolerance) << "at " << error.at << ", in epsilons " << error.relative / epsilon;
}

const auto lanes_exp = [](const Lanes& x) { return exp(x); };
const auto lanes_expm1 = [](const Lanes& x) { return expm1(x); };
const auto lanes_log = [](const Lanes& x) { return log(x); };
const auto lanes_log1p = [](const Lanes& x) { return log1p(x); };
const auto lanes_tanh = [](const Lanes& x) { return tanh(x); };
const auto lanes_sinh = [](const Lanes& x) { return sinh(x); };
const auto lanes_cosh = [](const Lanes& x) { return cosh(x); };
const auto lanes_erf = [](const Lanes& x) { return erf(x); };
const auto lanes_sqrt = [](const Lanes& x) { return sqrt(x); };

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
Lanes counting(double first, double step) {
  Lanes x;
  for (int i = 0; i < Lanes::width; ++i) x.set(i, first + step * i);
  return x;
}

}  // namespace

// The type -----------------------------------------------------------------------------------------------------------

TEST(Lanes, HasTheSameWidthOnEveryMachine) {
  static_assert(Lanes::width == 8 && sizeof(Lanes) == 64);
  static_assert(width_of<double> == 1 && width_of<Lanes> == 8);
  static_assert(std::is_same_v<mask_of<Lanes>, LanesMask> && std::is_same_v<mask_of<double>, bool>);
  static_assert(std::is_trivially_copyable_v<Lanes>);
}

TEST(Lanes, AreZeroUnlessGivenAValue) {
  const Lanes zero, seven = 7.0;
  for (int i = 0; i < Lanes::width; ++i) {
    EXPECT_TRUE(same_bits(zero[i], 0.0));
    EXPECT_EQ(seven[i], 7.0);
  }
  EXPECT_TRUE(same_bits(Lanes(-0.0)[5], -0.0));
}

TEST(Lanes, LoadAndStoreAtAnyAddressOfADouble) {
  std::vector<double> from(20), to(20, -1.0);
  for (int i = 0; i < 20; ++i) from[i] = i;
  for (int start = 0; start < 12; ++start) {
    const Lanes x = Lanes::load(&from[start]);
    for (int i = 0; i < Lanes::width; ++i) EXPECT_EQ(x[i], start + i);
    to.assign(20, -1.0);
    x.store(&to[start]);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(to[i], i >= start && i < start + 8 ? i : -1.0);
  }
}

TEST(Lanes, SetChangesOneLane) {
  for (int changed = 0; changed < Lanes::width; ++changed) {
    Lanes x = 1.0;
    x.set(changed, 2.0);
    for (int i = 0; i < Lanes::width; ++i) EXPECT_EQ(x[i], i == changed ? 2.0 : 1.0);
  }
}

TEST(Lanes, LaneReadsEveryKindOfNumber) {
  const Lanes x = counting(0.0, 1.5);
  EXPECT_EQ(lane(x, 4), 6.0);
  EXPECT_EQ(lane(2.5, 4), 2.5);
  EXPECT_TRUE(lane(true, 4));
  EXPECT_TRUE(lane(x < 6.5, 4));
  EXPECT_FALSE(lane(x < 6.5, 5));
}

TEST(Lanes, ArithmeticIsThatOfDoubleInEveryLane) {
  for (int trial = 0; trial < 1000; ++trial) {
    double x[8], y[8];
    for (int i = 0; i < 8; ++i) x[i] = uniform(-1e3, 1e3), y[i] = uniform(-1e3, 1e3);
    const Lanes a = Lanes::load(x), b = Lanes::load(y);
    Lanes sum = a, difference = a, product = a, quotient = a;
    sum += b, difference -= b, product *= b, quotient /= b;
    for (int i = 0; i < 8; ++i) {
      ASSERT_EQ((a + b)[i], x[i] + y[i]);
      ASSERT_EQ((a - b)[i], x[i] - y[i]);
      ASSERT_EQ((a * b)[i], x[i] * y[i]);
      ASSERT_EQ((a / b)[i], x[i] / y[i]);
      ASSERT_EQ((-a)[i], -x[i]);
      ASSERT_EQ(sum[i], x[i] + y[i]);
      ASSERT_EQ(difference[i], x[i] - y[i]);
      ASSERT_EQ(product[i], x[i] * y[i]);
      ASSERT_EQ(quotient[i], x[i] / y[i]);
      ASSERT_EQ((2.0 * a + 1.0)[i], 2.0 * x[i] + 1.0);
      ASSERT_EQ((1.0 - a / 3.0)[i], 1.0 - x[i] / 3.0);
      ASSERT_EQ(abs(a)[i], std::fabs(x[i]));
      ASSERT_EQ(sqrt(abs(a))[i], std::sqrt(std::fabs(x[i])));
      ASSERT_EQ(clamp(a, -100.0, 200.0)[i], std::clamp(x[i], -100.0, 200.0));
    }
  }
  EXPECT_TRUE(same_bits((-Lanes(0.0))[0], -0.0));
}

TEST(Lanes, ComparisonsMinMaxAndSelectAreThoseOfDouble) {
  const std::vector<double> values{-infinity, -1.0, -0.0, 0.0, smallest, 1.0, infinity, not_a_number};
  for (double x : values)
    for (double y : values) {
      const Lanes a = x, b = y;
      for (int i = 0; i < Lanes::width; ++i) {
        EXPECT_EQ((a < b)[i], x < y);
        EXPECT_EQ((a <= b)[i], x <= y);
        EXPECT_EQ((a > b)[i], x > y);
        EXPECT_EQ((a >= b)[i], x >= y);
        EXPECT_EQ((a == b)[i], x == y);
        EXPECT_EQ((a != b)[i], x != y);
        EXPECT_TRUE(same_bits(min(a, b)[i], min(x, y))) << x << " " << y;
        EXPECT_TRUE(same_bits(max(a, b)[i], max(x, y))) << x << " " << y;
        EXPECT_TRUE(same_bits(select(a < b, a, b)[i], select(x < y, x, y)));
        EXPECT_EQ(is_finite(a)[i], std::isfinite(x));
      }
    }
}

TEST(Lanes, MasksFollowBooleanAlgebraLaneByLane) {
  const Lanes x = counting(0.0, 1.0);
  const LanesMask low = x < 5.0, high = x >= 3.0;
  for (int i = 0; i < Lanes::width; ++i) {
    EXPECT_EQ((low & high)[i], i < 5 && i >= 3);
    EXPECT_EQ((low | high)[i], i < 5 || i >= 3);
    EXPECT_EQ((!low)[i], !(i < 5));
    EXPECT_EQ(select(low, 1.0, x)[i], i < 5 ? 1.0 : i);
    EXPECT_TRUE(LanesMask(true)[i]);
    EXPECT_FALSE(LanesMask(false)[i]);
  }
}

TEST(Lanes, AnyAllNoneSeeEveryLane) {
  EXPECT_TRUE(all(LanesMask(true)) && any(LanesMask(true)) && !none(LanesMask(true)));
  EXPECT_TRUE(none(LanesMask(false)) && !any(LanesMask(false)) && !all(LanesMask(false)));
  for (int i = 0; i < Lanes::width; ++i) {
    Lanes x = 0.0;
    x.set(i, 1.0);
    EXPECT_TRUE(any(x > 0.5) && !all(x > 0.5) && !none(x > 0.5));
    EXPECT_TRUE(any(x < 0.5) && !all(x < 0.5));
  }
}

// Accuracy -----------------------------------------------------------------------------------------------------------

TEST(LanesFunctions, ExponentialIsAccurateOverItsWholeRange) {
  const auto exact = [](long double x) { return std::exp(x); };
  expect_accurate(tolerance_exp, lanes_exp, exact, spread(-708.0, 709.7));
  expect_accurate(tolerance_exp, lanes_exp, exact, spread(-1.0, 1.0));
  expect_accurate(tolerance_exp, lanes_exp, exact, both_signs(decades(-17.0, 0.0)));
  // subnormal results cannot be closer than half the smallest number
  EXPECT_LE(largest_error(lanes_exp, exact, spread(-746.0, -708.4)).absolute, smallest);
}

TEST(LanesFunctions, Expm1KeepsTheDigitsOfSmallArguments) {
  const auto exact = [](long double x) { return std::expm1(x); };
  expect_accurate(tolerance_derived, lanes_expm1, exact, spread(-2.0, 2.0));
  expect_accurate(tolerance_derived, lanes_expm1, exact, spread(-50.0, 700.0));
  expect_accurate(tolerance_derived, lanes_expm1, exact, both_signs(decades(-30.0, 0.0)));
}

TEST(LanesFunctions, LogarithmIsAccurateOverItsWholeRange) {
  const auto exact = [](long double x) { return std::log(x); };
  expect_accurate(tolerance_log, lanes_log, exact, decades(-307.0, 308.0));
  expect_accurate(tolerance_log, lanes_log, exact, decades(-323.0, -307.0));
  expect_accurate(tolerance_log, lanes_log, exact, spread(0.5, 2.0));
  expect_accurate(tolerance_log, lanes_log, exact, spread(0.999, 1.001));
}

TEST(LanesFunctions, Log1pKeepsTheDigitsOfSmallArguments) {
  const auto exact = [](long double x) { return std::log1p(x); };
  expect_accurate(tolerance_derived, lanes_log1p, exact, spread(-0.999, 3.0));
  expect_accurate(tolerance_derived, lanes_log1p, exact, decades(-30.0, 300.0));
  expect_accurate(tolerance_derived, lanes_log1p, exact, both_signs(decades(-30.0, -0.01)));
}

TEST(LanesFunctions, PowerIsAccurateForHardeningExponents) {
  for (double n : {0.01, 0.1, 0.26, 0.31, 0.5, 1.0, 1.09, 1.5, 2.0, 3.0, 10.0, -0.5, -1.5}) {
    const auto power = [n](const Lanes& x) { return pow(x, n); };
    const auto exact = [n](long double x) { return std::pow(x, static_cast<long double>(n)); };
    SCOPED_TRACE(n);
    expect_accurate(tolerance_pow, power, exact, decades(-15.0, 3.0));
    expect_accurate(tolerance_pow, power, exact, spread(0.5, 2.0));
  }
}

TEST(LanesFunctions, PowerWithAnExponentPerLane) {
  for (int trial = 0; trial < 10'000; ++trial) {
    double base[8], exponent[8];
    for (int i = 0; i < 8; ++i) base[i] = std::pow(10.0, uniform(-15.0, 3.0)), exponent[i] = uniform(-3.0, 3.0);
    const Lanes y = pow(Lanes::load(base), Lanes::load(exponent));
    for (int i = 0; i < 8; ++i) {
      const long double exact = std::pow(static_cast<long double>(base[i]), static_cast<long double>(exponent[i]));
      ASSERT_LE(std::abs((y[i] - exact) / exact), tolerance_pow) << base[i] << "^" << exponent[i];
      ASSERT_TRUE(same_bits(y[i], pow(Lanes(base[i]), exponent[i])[0]));
    }
  }
}

TEST(LanesFunctions, HyperbolicFunctionsAreAccurateNearZeroAndFarOut) {
  const auto exact_tanh = [](long double x) { return std::tanh(x); };
  const auto exact_sinh = [](long double x) { return std::sinh(x); };
  const auto exact_cosh = [](long double x) { return std::cosh(x); };
  for (const auto& x : {spread(-3.0, 3.0), spread(-30.0, 30.0), both_signs(decades(-30.0, 2.0))}) {
    expect_accurate(tolerance_derived, lanes_tanh, exact_tanh, x);
    expect_accurate(tolerance_derived, lanes_sinh, exact_sinh, x);
    expect_accurate(tolerance_derived, lanes_cosh, exact_cosh, x);
  }
  expect_accurate(tolerance_derived, lanes_sinh, exact_sinh, spread(-710.4, 710.4));
  expect_accurate(tolerance_derived, lanes_cosh, exact_cosh, spread(-710.4, 710.4));
}

TEST(LanesFunctions, ErrorFunctionIsAccurate) {
  const auto exact = [](long double x) { return std::erf(x); };
  EXPECT_LE(largest_error(lanes_erf, exact, spread(-8.0, 8.0)).absolute, tolerance_erf_absolute);
  EXPECT_LE(largest_error(lanes_erf, exact, spread(0.999, 1.001)).absolute, tolerance_erf_absolute);
  expect_accurate(tolerance_derived, lanes_erf, exact, both_signs(decades(-30.0, 0.0)));
}

// Special values -----------------------------------------------------------------------------------------------------

TEST(LanesFunctions, ExponentialOverflowsToInfinityAndUnderflowsToZero) {
  EXPECT_EQ(apply(lanes_exp, 0.0), 1.0);
  EXPECT_TRUE(std::isfinite(apply(lanes_exp, 709.78)));
  for (double x : {709.79, 1e4, 1e300, infinity}) EXPECT_EQ(apply(lanes_exp, x), infinity) << x;
  EXPECT_GT(apply(lanes_exp, -745.1), 0.0);
  for (double x : {-745.2, -1e4, -1e300, -infinity}) EXPECT_EQ(apply(lanes_exp, x), 0.0) << x;
  EXPECT_EQ(apply(lanes_expm1, infinity), infinity);
  EXPECT_EQ(apply(lanes_expm1, -infinity), -1.0);
  EXPECT_EQ(apply(lanes_expm1, 0.0), 0.0);
}

TEST(LanesFunctions, LogarithmOfZeroInfinityAndNegativeNumbers) {
  EXPECT_EQ(apply(lanes_log, 1.0), 0.0);
  EXPECT_EQ(apply(lanes_log, 0.0), -infinity);
  EXPECT_EQ(apply(lanes_log, -0.0), -infinity);
  EXPECT_EQ(apply(lanes_log, infinity), infinity);
  for (double x : {-smallest, -1.0, -infinity}) EXPECT_TRUE(std::isnan(apply(lanes_log, x))) << x;
  EXPECT_EQ(apply(lanes_log1p, 0.0), 0.0);
  EXPECT_EQ(apply(lanes_log1p, -1.0), -infinity);
  EXPECT_EQ(apply(lanes_log1p, infinity), infinity);
  EXPECT_TRUE(std::isnan(apply(lanes_log1p, -1.5)));
}

TEST(LanesFunctions, PowersOfZeroOneAndInfinity) {
  const auto power = [](double base, double exponent) { return pow(Lanes(base), exponent)[2]; };
  for (double n : {0.01, 0.31, 1.0, 2.0}) {
    EXPECT_EQ(power(0.0, n), 0.0);
    EXPECT_EQ(power(-0.0, n), 0.0);
    EXPECT_EQ(power(0.0, -n), infinity);
    EXPECT_EQ(power(infinity, n), infinity);
    EXPECT_EQ(power(infinity, -n), 0.0);
    EXPECT_TRUE(std::isnan(power(-1.0, n)));
    EXPECT_TRUE(std::isnan(power(not_a_number, n)));
  }
  for (double x : {0.0, smallest, 1e-12, 1.0, 1e300, infinity}) EXPECT_EQ(power(x, 0.0), 1.0);
  for (double n : {-1e8, -2.0, 0.31, 3.0, 1e8}) EXPECT_EQ(power(1.0, n), 1.0);
  EXPECT_EQ(power(1e200, 2.0), infinity);
  EXPECT_EQ(power(1e-200, 2.0), 0.0);
  EXPECT_EQ(power(2.0, 1e6), infinity);
  EXPECT_EQ(power(0.5, 1e6), 0.0);
}

TEST(LanesFunctions, OddFunctionsAreExactlyOddAndSaturate) {
  for (double x : {1e-30, 0.1, 0.3465, 0.3467, 0.999, 1.001, 5.0, 30.0, 700.0, infinity}) {
    EXPECT_EQ(apply(lanes_tanh, -x), -apply(lanes_tanh, x));
    EXPECT_EQ(apply(lanes_sinh, -x), -apply(lanes_sinh, x));
    EXPECT_EQ(apply(lanes_erf, -x), -apply(lanes_erf, x));
    EXPECT_EQ(apply(lanes_cosh, -x), apply(lanes_cosh, x));
  }
  EXPECT_EQ(apply(lanes_tanh, infinity), 1.0);
  EXPECT_EQ(apply(lanes_erf, infinity), 1.0);
  EXPECT_EQ(apply(lanes_sinh, infinity), infinity);
  EXPECT_EQ(apply(lanes_cosh, infinity), infinity);
  EXPECT_EQ(apply(lanes_cosh, 0.0), 1.0);
  EXPECT_TRUE(same_bits(apply(lanes_tanh, -0.0), -0.0));
  EXPECT_TRUE(same_bits(apply(lanes_sinh, -0.0), -0.0));
}

TEST(LanesFunctions, NanStaysNan) {
  const auto expect_nan = [](const auto& f) { EXPECT_TRUE(std::isnan(apply(f, not_a_number))); };
  expect_nan(lanes_exp), expect_nan(lanes_expm1), expect_nan(lanes_log), expect_nan(lanes_log1p), expect_nan(lanes_tanh);
  expect_nan(lanes_sinh), expect_nan(lanes_cosh), expect_nan(lanes_erf), expect_nan(lanes_sqrt);
  EXPECT_TRUE(std::isnan(apply(lanes_sqrt, -1.0)));
  EXPECT_TRUE(std::isnan(pow(Lanes(2.0), Lanes(not_a_number))[0]));
}

// Independence -------------------------------------------------------------------------------------------------------

TEST(LanesFunctions, ALaneNeverDependsOnItsNeighbours) {
  const std::vector<double> strange{not_a_number, infinity, -infinity, 0.0, -1.0, 1e300, smallest, -745.2};
  const auto expect_independent = [&](const char* name, const auto& f) {
    for (int trial = 0; trial < 2000; ++trial) {
      const int place = trial % Lanes::width;
      const double x = uniform(0.01, 8.0);
      Lanes mixed;
      for (int i = 0; i < Lanes::width; ++i) mixed.set(i, strange[generator() % strange.size()]);
      mixed.set(place, x);
      const Lanes alone = f(Lanes(x)), among_others = f(mixed);
      ASSERT_TRUE(same_bits(among_others[place], alone[0])) << name << " at " << x << " in lane " << place;
    }
  };
  expect_independent("exp", lanes_exp);
  expect_independent("expm1", lanes_expm1);
  expect_independent("log", lanes_log);
  expect_independent("log1p", lanes_log1p);
  expect_independent("tanh", lanes_tanh);
  expect_independent("sinh", lanes_sinh);
  expect_independent("cosh", lanes_cosh);
  expect_independent("erf", lanes_erf);
  expect_independent("sqrt", lanes_sqrt);
  expect_independent("pow(x, 0.31)", [](const Lanes& x) { return pow(x, 0.31); });
  expect_independent("pow(2, x)", [](const Lanes& x) { return pow(Lanes(2.0), x); });
}
