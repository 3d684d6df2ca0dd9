#pragma once
// Derivatives from dual numbers against central differences of the same formula on double.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "models/dual.hpp"

namespace brisance::test {

/// Point number i of the Halton sequence in base b, in (0, 1).
inline double halton(int i, int b) {
  double fraction = 1.0, result = 0.0;
  for (++i; i > 0; i /= b) {
    fraction /= b;
    result += fraction * (i % b);
  }
  return result;
}

/// A variable and where to try it; positive ones that span decades are spread in the logarithm.
struct Range {
  double from, to;
  bool logarithmic = false;
  double at(double u) const { return logarithmic ? from * std::pow(to / from, u) : from + (to - from) * u; }
};

inline constexpr int derivative_states = 10000;
/// What is asked of a derivative; the difference quotients below are good to about 1e-9.
inline constexpr double derivative_tolerance = 1e-6;
/// Quotients over two spacings that differ by more see a kink (a clamp, a branch) between their points.
inline constexpr double kink_tolerance = 1e-7;
/// Rounding of the values divided by the step leaves this part of value/variable undetermined.
inline constexpr double difference_noise = 1e-10;

/// f: array of N numbers -> number. Checks df/dx_j on Halton states, each variable in its turn, away from kinks; few states
/// may be near one.
template <int N, class F>
void expect_exact_derivatives(const F& f, const std::array<Range, N>& ranges, double largest_kink_share = 0.05) {
  constexpr std::array bases{2, 3, 5, 7, 11, 13, 17, 19};
  static_assert(N <= static_cast<int>(bases.size()));
  int kinks = 0;
  for (int i = 0; i < derivative_states; ++i) {
    std::array<double, N> x;
    for (int j = 0; j < N; ++j) x[j] = ranges[j].at(halton(i, bases[j]));
    using Number = Dual<double, N>;
    std::array<Number, N> dual;
    for (int j = 0; j < N; ++j) dual[j] = Number::variable(x[j], j);
    const Number exact = f(dual);
    ASSERT_LE(std::abs(exact.value - f(x)), 1e-12 * std::abs(exact.value)) << "value on duals, state " << i;

    const int j = i % N;
    const double scale = ranges[j].logarithmic ? x[j] : std::max(std::abs(x[j]), 1e-3 * (ranges[j].to - ranges[j].from));
    const auto shifted = [&](double by) {
      auto y = x;
      y[j] += by;
      return f(y);
    };
    // Five points: error proportional to step^4.
    const auto quotient = [&](double h) {
      return (8.0 * (shifted(h) - shifted(-h)) - (shifted(2.0 * h) - shifted(-2.0 * h))) / (12.0 * h);
    };
    const double coarse = quotient(1e-3 * scale), fine = quotient(5e-4 * scale);
    const double noise = difference_noise * std::abs(exact.value) / scale;
    if (std::abs(coarse - fine) > kink_tolerance * std::abs(fine) + noise) {
      ++kinks;
      continue;
    }
    ASSERT_LE(std::abs(exact.derivative[j] - fine), derivative_tolerance * std::abs(fine) + noise)
        << "variable " << j << " = " << x[j] << ", state " << i << ": dual " << exact.derivative[j] << ", difference " << fine;
  }
  EXPECT_LE(kinks, largest_kink_share * derivative_states) << "states near a kink";
}

}  // namespace brisance::test
