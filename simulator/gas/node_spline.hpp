#pragma once
// The quadratic B-spline by which particles fill the nodes around them.

#include <array>
#include <cmath>

namespace brisance::simulator::gas {

/// Its values at the three nodes of a line that are nearest to a particle.
struct NodesOnLine {
  int first;
  std::array<double, 3> value;
};
inline NodesOnLine spline_at(double x, double h) {
  const double u = x / h, n = std::floor(u + 0.5), xi = u - n;
  return {static_cast<int>(n) - 1, {0.5 * (0.5 - xi) * (0.5 - xi), 0.75 - xi * xi, 0.5 * (0.5 + xi) * (0.5 + xi)}};
}

}  // namespace brisance::simulator::gas
