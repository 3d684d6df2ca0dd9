#pragma once
// Weights of eight particles at the three nodes per direction around each: values, gradients, and lever arms for affine motion.
// Quadratic B-splines: Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922-948. uGIMP: Bardenhagen & Kober,
// CMES 5 (2004) 477-495. Axisymmetric weights: Nairn & Guilkey, Int. J. Numer. Meth. Engng 101 (2015) 127-147.

#include <array>

#include "simulator/config.hpp"
#include "simulator/grid/grid.hpp"
#include "simulator/solid/packs.hpp"

namespace brisance::simulator {

/// Along one direction, at the nodes n-1, n, n+1, where n is the nearest one.
struct LineWeights {
  std::array<StoredPack, 3> value;     // S
  std::array<StoredPack, 3> gradient;  // dS/dx, 1/m
  std::array<StoredPack, 3> lever;     // S (x_i - sum S x), m
  StoredPack spread;                   // sum S (x_i - sum S x)^2, m^2
};

template <std::size_t D>
struct Weights {
  std::array<LineWeights, D> along;
  std::array<StoredPack, 3> hoop;  // axisymmetric: the weights of v_r/r, 1/m
  std::array<Lanes, D> nearest;    // indices of the nearest nodes in the block
  std::array<int, 8> corner;       // the first nodes of the stencils in the tile
};

/// At distances xi (in cells) from the nearest node. Outside [-1/2, 1/2) the polynomials are continued: they still sum to one
/// and reproduce linear fields.
inline LineWeights quadratic_spline(const Lanes& xi, double h) {
  const Lanes a = 0.5 - xi, b = 0.5 + xi, inverse_h(1.0 / h);
  const Lanes below = 0.5 * a * a, middle = 0.75 - xi * xi, above = 0.5 * b * b;
  return {{below, middle, above},
          {-a * inverse_h, -2.0 * xi * inverse_h, b * inverse_h},
          {below * (-1.0 - xi) * h, middle * -xi * h, above * (1.0 - xi) * h},
          Lanes(0.25 * h * h)};
}

/// A hat function averaged over the particle's width 2 l, with lambda = l/h <= 1/2.
inline LineWeights ugimp(const Lanes& xi, double h, const Lanes& lambda) {
  const Lanes inverse_h(1.0 / h);
  const auto outer = [&](const Lanes& x, Lanes& gradient) {  // of the node towards which x points
    const Lanes overlap = x + lambda;
    gradient = select(x >= lambda, Lanes(1.0), select(x <= -lambda, Lanes(0.0), overlap * (0.5 / lambda)));
    return select(x >= lambda, x, select(x <= -lambda, Lanes(0.0), overlap * overlap * (0.25 / lambda)));
  };
  Lanes g_above, g_below;
  const Lanes above = outer(xi, g_above), below = outer(-xi, g_below), middle = 1.0 - above - below;
  const Lanes to_below = (-1.0 - xi) * h, to_middle = -xi * h, to_above = (1.0 - xi) * h;
  return {{below, middle, above},
          {-g_below * inverse_h, (g_below - g_above) * inverse_h, g_above * inverse_h},
          {below * to_below, middle * to_middle, above * to_above},
          below * to_below * to_below + middle * to_middle * to_middle + above * to_above * to_above};
}

/// The weights along the radius (direction 0) of uGIMP particles of half width l, weighted with r over their parts at r > 0.
/// `node` is the nearest node.
inline void ugimp_radial(const Lanes& r, const Lanes& l, const Lanes& node, double h, Weights<2>& w) {
  const Lanes a = max(Lanes(0.0), r - l), b = r + l;
  const Lanes moment = 0.5 * (b * b - a * a);  // integral of r
  LineWeights& radial = w.along[0];
  Lanes centre(0.0), spread(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes x = (node + (static_cast<double>(k) - 1.0)) * h;  // of the node
    Lanes N(0.0), Nr(0.0), dNr(0.0);                              // integrals of N, N r, N' r
    for (const double side : {-1.0, 1.0}) {                       // the hat falls to both sides of its node
      const Lanes from = max(a, side < 0 ? x - h : x), to = max(from, min(b, side < 0 ? x : x + h));
      const Lanes slope(-side / h), at_zero = 1.0 - slope * x;
      const Lanes i1 = to - from, i2 = 0.5 * (to * to - from * from), i3 = (to * to * to - from * from * from) / 3.0;
      N += at_zero * i1 + slope * i2, Nr += at_zero * i2 + slope * i3, dNr += slope * i2;
    }
    radial.value[k] = Nr / moment, radial.gradient[k] = dNr / moment, w.hoop[k] = N / moment;
    centre += radial.value[k] * x;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes x = (node + (static_cast<double>(k) - 1.0)) * h - centre;
    radial.lever[k] = radial.value[k] * x, spread += radial.lever[k] * x;
  }
  radial.spread = spread;
}

/// Numbers of nodes from their indices, x fastest, for `side` nodes in a row.
template <std::size_t D>
std::array<int, 8> node_numbers(const std::array<Lanes, D>& index, int side) {
  Lanes sum = index[D - 1];
  for (std::size_t a = D - 1; a-- > 0;) sum = sum * side + index[a];
  const StoredPack number = sum;
  std::array<int, 8> result;
  for (std::size_t i = 0; i < 8; ++i) result[i] = static_cast<int>(number[i]);
  return result;
}

inline Lanes nearest_node(const Lanes& coordinate, double inverse_cell_size) {
  return floor(coordinate * inverse_cell_size + 0.5);
}

/// The nodes of a block that are nearest to eight points: their indices in the block.
template <std::size_t D>
[[gnu::always_inline]] inline std::array<Lanes, D> nearest_in_block(const std::array<Lanes, D>& position,
                                                                    const BlockPosition& block, double h) {
  constexpr int side = Block<D>::side;
  const double inverse_h = 1.0 / h;
  std::array<Lanes, D> index;
  for (std::size_t a = 0; a < D; ++a) {
    const Lanes first(block[a] * side), n = nearest_node(position[a], inverse_h) - first;
    index[a] = min(Lanes(side - 1), max(Lanes(0.0), n));
  }
  return index;
}

/// Weights of particles whose nearest nodes lie in the block. Positions and half widths in m.
template <Geometry G, Basis B, std::size_t D = G == Geometry::three_dimensional ? 3 : 2>
[[gnu::always_inline]] inline Weights<D> find_weights(const std::array<Lanes, D>& position, const Lanes& half_width,
                                                      const BlockPosition& block, double h) {
  const double inverse_h = 1.0 / h;
  Weights<D> w;
  w.nearest = nearest_in_block(position, block, h);
  w.corner = node_numbers(w.nearest, Block<D>::tile_side);
  for (std::size_t a = 0; a < D; ++a) {
    const Lanes xi = position[a] * inverse_h - (w.nearest[a] + Lanes(block[a] * Block<D>::side));
    w.along[a] = B == Basis::quadratic_spline ? quadratic_spline(xi, h) : ugimp(xi, h, half_width * inverse_h);
  }
  if constexpr (G == Geometry::axisymmetric) {
    if constexpr (B == Basis::quadratic_spline) {
      const Lanes inverse_r = 1.0 / max(position[0], 0.5 * half_width);
      for (std::size_t k = 0; k < 3; ++k) w.hoop[k] = w.along[0].value[k] * inverse_r;
    } else {
      ugimp_radial(position[0], half_width, w.nearest[0] + Lanes(block[0] * Block<D>::side), h, w);
    }
  }
  return w;
}

}  // namespace brisance::simulator
