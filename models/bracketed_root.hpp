#pragma once

#include <limits>

#include "models/dual.hpp"

namespace brisance {

/// The root between two bounds of an increasing function: Newton's method with the slope from duals, and bisection where
/// Newton would leave the bracket or the last step did not halve the function. Without a root between the bounds the result is
/// the bound where the function is nearest to zero. `scale` is a magnitude of x too small to matter. A lane that has converged
/// computes the same step again and stays, so it does not feel its neighbours. The last step squares the remaining error, and
/// gives the derivatives of the root when Real is a dual.
template <class Real, class Function>
Real increasing_root(const Function& f, const Real& lower, const Real& upper, Real x, double scale = 0.0) {
  constexpr int most_steps = 100;
  constexpr double last_but_one = 1e-9;  // relative; squared by the last step
  constexpr double least_slope = 1e-300;
  Real lowest = lower, highest = upper;
  const auto newton_from = [&f](const Real& at, Real& value) {
    const Dual<Real> y = f(Dual<Real>::variable(at));
    value = y.value;
    return Real(at - y.value / max(y.derivative[0], Real(least_slope)));
  };
  Real value, last_size(std::numeric_limits<double>::infinity());
  for (int i = 0; i < most_steps; ++i) {
    const Real newton = newton_from(x, value);
    lowest = select(value < 0.0, x, lowest);
    highest = select(value > 0.0, x, highest);
    const Real middle = 0.5 * (lowest + highest);
    const Real small = last_but_one * (abs(x) + scale);
    const mask_of<Real> arriving = (abs(value) <= 0.5 * last_size) | (abs(newton - x) <= small);
    const mask_of<Real> trusted = (newton >= lowest) & (newton <= highest) & arriving;
    const Real next = select(trusted, newton, middle);
    const mask_of<Real> moves = abs(next - x) > small;
    x = select(moves, next, x);
    last_size = select(moves, abs(value), last_size);
    if (none(moves)) break;
  }
  const Real last = newton_from(x, value);
  return min(max(last, lower), upper);
}

}  // namespace brisance
