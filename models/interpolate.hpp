#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace brisance {

/// The value at `at` of a curve of at least one point, whose x do not fall (two alike make a jump): linear between the points,
/// constant beyond them.
inline double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  if (above == 0) return y.front();
  if (above == x.size()) return y.back();
  return std::lerp(y[above - 1], y[above], (at - x[above - 1]) / (x[above] - x[above - 1]));
}

}  // namespace brisance
