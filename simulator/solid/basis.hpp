#pragma once
// Weights of a particle at the three nodes per direction around it: values, gradients, and lever arms for affine motion.
// Quadratic B-splines: Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922-948. uGIMP: Bardenhagen & Kober,
// CMES 5 (2004) 477-495. Axisymmetric weights: Nairn & Guilkey, Int. J. Numer. Meth. Engng 101 (2015) 127-147.

#include <algorithm>
#include <array>

#include "simulator/config.hpp"
#include "simulator/grid/grid.hpp"
#include "simulator/solid/packs.hpp"

namespace brisance::simulator {

/// At the nodes n-1, n, n+1 along each direction, where n is the nearest one. The directions stand side by side in lanes:
/// element [k][a] belongs to node n+k-1 of direction a.
struct Weights {
  using Row = std::array<double, 8>;
  alignas(64) std::array<Row, 3> value;     // S
  alignas(64) std::array<Row, 3> gradient;  // dS/dx, 1/m
  alignas(64) std::array<Row, 3> lever;     // S (x_i - sum S x), m
  alignas(64) Row spread;                   // sum S (x_i - sum S x)^2, m^2
  std::array<double, 3> hoop{};             // axisymmetric: the weights of v_r/r, 1/m
  std::array<int, 3> base{};                // first node of the stencil, counted in the tile
};

/// At distances xi (in cells) from the nearest node. Outside [-1/2, 1/2) the polynomials are continued: they still sum to one
/// and reproduce linear fields.
inline void quadratic_spline(const Lanes& xi, double h, Weights& w) {
  const Lanes a = 0.5 - xi, b = 0.5 + xi, inverse_h(1.0 / h);
  const Lanes below = 0.5 * a * a, middle = 0.75 - xi * xi, above = 0.5 * b * b;
  below.store(w.value[0].data()), middle.store(w.value[1].data()), above.store(w.value[2].data());
  (-a * inverse_h).store(w.gradient[0].data());
  (-2.0 * xi * inverse_h).store(w.gradient[1].data());
  (b * inverse_h).store(w.gradient[2].data());
  (below * (-1.0 - xi) * h).store(w.lever[0].data());
  (middle * -xi * h).store(w.lever[1].data());
  (above * (1.0 - xi) * h).store(w.lever[2].data());
  w.spread.fill(0.25 * h * h);
}

/// A hat function averaged over the particle's width 2 l, with lambda = l/h <= 1/2.
inline void ugimp(const Lanes& xi, double h, double lambda, Weights& w) {
  const Lanes low(-lambda), high(lambda), inverse_h(1.0 / h);
  const auto outer = [&](const Lanes& x, Lanes& gradient) {  // of the node towards which x points
    const Lanes overlap = x + high;
    gradient = select(x >= high, Lanes(1.0), select(x <= low, Lanes(0.0), overlap * (0.5 / lambda)));
    return select(x >= high, x, select(x <= low, Lanes(0.0), overlap * overlap * (0.25 / lambda)));
  };
  Lanes g_above, g_below;
  const Lanes above = outer(xi, g_above), below = outer(-xi, g_below), middle = 1.0 - above - below;
  below.store(w.value[0].data()), middle.store(w.value[1].data()), above.store(w.value[2].data());
  (-g_below * inverse_h).store(w.gradient[0].data());
  ((g_below - g_above) * inverse_h).store(w.gradient[1].data());
  (g_above * inverse_h).store(w.gradient[2].data());
  const Lanes to_below = (-1.0 - xi) * h, to_middle = -xi * h, to_above = (1.0 - xi) * h;
  (below * to_below).store(w.lever[0].data());
  (middle * to_middle).store(w.lever[1].data());
  (above * to_above).store(w.lever[2].data());
  (below * to_below * to_below + middle * to_middle * to_middle + above * to_above * to_above).store(w.spread.data());
}

/// The weights along the radius (direction 0) of a uGIMP particle of half width l, weighted with r over its part at r > 0.
inline void ugimp_radial(double r, double l, int node, double h, Weights& w) {
  const double a = std::max(0.0, r - l), b = r + l;
  const double moment = 0.5 * (b * b - a * a);  // integral of r
  double centre = 0.0, spread = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double x = (node + i - 1) * h;  // of the node
    double N = 0.0, Nr = 0.0, dNr = 0.0;  // integrals of N, N r, N' r
    for (const int side : {-1, 1}) {      // the hat falls to both sides of its node
      const double from = std::max(a, side < 0 ? x - h : x), to = std::min(b, side < 0 ? x : x + h);
      if (to <= from) continue;
      const double slope = -side / h, at_zero = 1.0 - slope * x;
      const double i1 = to - from, i2 = 0.5 * (to * to - from * from), i3 = (to * to * to - from * from * from) / 3.0;
      N += at_zero * i1 + slope * i2, Nr += at_zero * i2 + slope * i3, dNr += slope * i2;
    }
    const auto k = static_cast<std::size_t>(i);
    w.value[k][0] = Nr / moment, w.gradient[k][0] = dNr / moment, w.hoop[k] = N / moment;
    centre += w.value[k][0] * x;
  }
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = (node + i - 1) * h - centre;
    w.lever[k][0] = w.value[k][0] * x, spread += w.lever[k][0] * x;
  }
  w.spread[0] = spread;
}

/// Weights of a particle whose nearest node lies in the block (or, for points of its surface, next to it: the nearest node of
/// the block is taken then). Position and half width in m.
template <Geometry G, Basis B, std::size_t D = G == Geometry::three_dimensional ? 3 : 2>
[[gnu::always_inline]] inline void find_weights(const std::array<double, D>& position, double half_width,
                                                const BlockPosition& block, double h, Weights& w) {
  constexpr int side = Block<D>::side;
  const double inverse_h = 1.0 / h;
  std::array<double, 3> xi{};
  for (std::size_t a = 0; a < D; ++a) {
    const double u = position[a] * inverse_h;
    const int first = block[a] * side, n = std::clamp(static_cast<int>(std::floor(u + 0.5)), first, first + side - 1);
    w.base[a] = n - first;
    xi[a] = u - n;
  }
  const Lanes offsets = pack(xi[0], xi[1], xi[2], 0.0);
  if constexpr (B == Basis::quadratic_spline)
    quadratic_spline(offsets, h, w);
  else
    ugimp(offsets, h, half_width * inverse_h, w);
  if constexpr (G == Geometry::axisymmetric) {
    if constexpr (B == Basis::quadratic_spline) {
      const double inverse_r = 1.0 / std::max(position[0], 0.5 * half_width);
      for (std::size_t k = 0; k < 3; ++k) w.hoop[k] = w.value[k][0] * inverse_r;
    } else {
      ugimp_radial(position[0], half_width, block[0] * side + w.base[0], h, w);
    }
  }
}

}  // namespace brisance::simulator
