#pragma once
// The inner operations of the transfers: between one particle and the nodes of its stencil, eight channels side by side.

#include "simulator/solid/basis.hpp"

namespace brisance::simulator {

/// The nodes a particle sees: those of its field's tile, or, where its bit of the mask is set, of the next field's.
struct OneField {
  Lanes* first;
  Lanes* at(int /*n*/) const { return first; }
};
struct TwoFields {
  Lanes* first;
  std::ptrdiff_t to_second;
  std::uint32_t second;  // bit n: node n of the stencil (27 or 9 nodes, x fastest)
  Lanes* at(int n) const { return first + ((second >> n) & 1u) * to_second; }
};

/// What varies along direction a, at the three nodes, and carries S along the others: [a][node].
template <std::size_t D>
using Slopes = std::array<std::array<Lanes, 3>, D>;

/// Adds value S + sum_a slope[a]_i to the nodes around particle p of eight.
template <std::size_t D, class Field>
[[gnu::always_inline]] inline void scatter_to(const Weights<D>& w, std::size_t p, const Lanes& value, const Slopes<D>& slope,
                                              const Field& to) {
  using B = Block<D>;
  const auto S = [&](std::size_t k, std::size_t a) { return w.along[a].value[k][p]; };
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    Lanes in_plane = value;
    double Sz = 1.0;
    if constexpr (D == 3) {
      Sz = S(k, 2);
      in_plane = multiply_add(Sz, value, slope[2][k]);
    }
    for (int j = 0; j < 3; ++j) {
      const double Sy = S(j, 1), SySz = Sy * Sz;
      const Lanes in_row = multiply_add(Sy, in_plane, Lanes(Sz) * slope[1][j]);
      const int row = w.corner[p] + B::tile_node(0, j, k);
      for (int i = 0; i < 3; ++i) {
        Lanes& node = to.at(i + 3 * (j + 3 * k))[row + i];
        node = multiply_add(S(i, 0), in_row, multiply_add(SySz, slope[0][i], node));
      }
    }
  }
}
template <std::size_t D>
[[gnu::always_inline]] inline void scatter(const Weights<D>& w, std::size_t p, const Lanes& value, const Slopes<D>& slope,
                                           const TwoFields& to) {
  if (to.second == 0)
    scatter_to<D>(w, p, value, slope, OneField{to.first});
  else
    scatter_to<D>(w, p, value, slope, to);
}

/// Sums over the nodes with the weights S, and with S along all directions but one, where another weight stands.
template <std::size_t D>
struct Gathered {
  Lanes value;
  std::array<Lanes, D> slope;
  Lanes hoop;
};
enum class Slope { lever, gradient };

/// The sums around particle p of eight, channels side by side.
template <Slope kind, bool hoop, std::size_t D, class Field>
[[gnu::always_inline]] inline Gathered<D> gather_from(const Weights<D>& w, std::size_t p, const Field& from) {
  using B = Block<D>;
  const auto S = [&](std::size_t k, std::size_t a) { return w.along[a].value[k][p]; };
  const auto T = [&](std::size_t k, std::size_t a) {
    return kind == Slope::lever ? w.along[a].lever[k][p] : w.along[a].gradient[k][p];
  };
  Gathered<D> sum;
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    Lanes plane(0.0), plane_x(0.0), plane_y(0.0), plane_hoop(0.0);
    for (int j = 0; j < 3; ++j) {
      const int row = w.corner[p] + B::tile_node(0, j, k);
      Lanes in_row(0.0), in_row_x(0.0), in_row_hoop(0.0);
      for (int i = 0; i < 3; ++i) {
        const Lanes& node = from.at(i + 3 * (j + 3 * k))[row + i];
        in_row = multiply_add(S(i, 0), node, in_row);
        in_row_x = multiply_add(T(i, 0), node, in_row_x);
        if constexpr (hoop) in_row_hoop = multiply_add(w.hoop[i][p], node, in_row_hoop);
      }
      plane = multiply_add(S(j, 1), in_row, plane), plane_x = multiply_add(S(j, 1), in_row_x, plane_x);
      plane_y = multiply_add(T(j, 1), in_row, plane_y);
      if constexpr (hoop) plane_hoop = multiply_add(S(j, 1), in_row_hoop, plane_hoop);
    }
    if constexpr (D == 3) {
      sum.value = multiply_add(S(k, 2), plane, sum.value), sum.slope[0] = multiply_add(S(k, 2), plane_x, sum.slope[0]);
      sum.slope[1] = multiply_add(S(k, 2), plane_y, sum.slope[1]), sum.slope[2] = multiply_add(T(k, 2), plane, sum.slope[2]);
    } else {
      sum.value = plane, sum.slope[0] = plane_x, sum.slope[1] = plane_y, sum.hoop = plane_hoop;
    }
  }
  return sum;
}

/// The sums around eight particles: [channel][particle].
template <std::size_t D>
struct GatheredByChannel {
  Square value;
  std::array<Square, D> slope;
  Square hoop;
};
template <Slope kind, bool hoop, std::size_t D, class FieldOf>
[[gnu::always_inline]] inline GatheredByChannel<D> gather(const Weights<D>& w, const FieldOf& field_of) {
  GatheredByChannel<D> sums;
  for (std::size_t p = 0; p < 8; ++p) {
    const TwoFields from = field_of(p);
    const Gathered<D> sum =
        from.second == 0 ? gather_from<kind, hoop, D>(w, p, OneField{from.first}) : gather_from<kind, hoop, D>(w, p, from);
    sums.value[p] = sum.value;
    for (std::size_t a = 0; a < D; ++a) sums.slope[a][p] = sum.slope[a];
    if constexpr (hoop) sums.hoop[p] = sum.hoop;
  }
  sums.value = transposed(sums.value);
  for (Square& slope : sums.slope) slope = transposed(slope);
  if constexpr (hoop) sums.hoop = transposed(sums.hoop);
  return sums;
}

}  // namespace brisance::simulator
