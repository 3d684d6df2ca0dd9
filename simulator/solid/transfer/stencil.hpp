#pragma once
// The inner operations of the transfers: between one particle and the nodes of its stencil, eight channels side by side.

#include "models/requests.hpp"
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

/// Of what the next particles need, with each particle.
inline constexpr int requests_at_once = 3;

/// What varies along direction a, at the three nodes, and carries S along the others: [a][node].
template <std::size_t D>
using Slopes = std::array<std::array<Lanes, 3>, D>;

/// Adds value S + sum_a slope[a]_i to the nodes around some of eight particles, from p on, which have the same nodes around
/// them.
template <std::size_t D, std::size_t count, class Field>
[[gnu::always_inline]] inline void scatter_to(const Weights<D>& w, std::size_t p, const Square& value,
                                              const std::array<Slopes<D>, count>& slope, const Field& to) {
  using B = Block<D>;
  const auto S = [&](std::size_t k, std::size_t a, std::size_t n) { return w.along[a].value[k][p + n]; };
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    std::array<Lanes, count> in_plane;
    std::array<Lanes, count> Sz;
    for (std::size_t n = 0; n < count; ++n) {
      in_plane[n] = value[p + n], Sz[n] = Lanes(1.0);
      if constexpr (D == 3) {
        Sz[n] = Lanes(S(k, 2, n));
        in_plane[n] = multiply_add(Sz[n], in_plane[n], slope[n][2][k]);
      }
    }
    for (int j = 0; j < 3; ++j) {
      std::array<Lanes, count> in_row;
      std::array<Lanes, count> SySz;
      for (std::size_t n = 0; n < count; ++n) {
        const double Sy = S(j, 1, n);
        SySz[n] = Sy * Sz[n];
        in_row[n] = multiply_add(Sy, in_plane[n], Sz[n] * slope[n][1][j]);
      }
      const int row = w.corner[p] + B::tile_node(0, j, k);
      for (int i = 0; i < 3; ++i) {
        Lanes& node = to.at(i + 3 * (j + 3 * k))[row + i];
        Lanes sum = node;
        for (std::size_t n = 0; n < count; ++n)
          sum = multiply_add(S(i, 0, n), in_row[n], multiply_add(SySz[n], slope[n][0][i], sum));
        node = sum;
      }
    }
  }
}
/// Adds what eight particles carry to the nodes around those in use: value[p] S + sum_a slope_of(p)[a]_i.
template <std::size_t D, class SlopeOf, class FieldOf>
[[gnu::always_inline]] inline void scatter(const Weights<D>& w, std::size_t used, const Square& value, const SlopeOf& slope_of,
                                           const FieldOf& field_of, Requests& requests) {
  for (std::size_t p = 0; p < used; ++p) {
    requests.send(requests_at_once);
    const TwoFields to = field_of(p);
    if (to.second != 0) {
      scatter_to<D, 1>(w, p, value, {slope_of(p)}, to);
    } else if (p + 1 < used && w.corner[p] == w.corner[p + 1] && field_of(p + 1).second == 0) {
      scatter_to<D, 2>(w, p, value, {slope_of(p), slope_of(p + 1)}, OneField{to.first});  // nodes are read and written once
      ++p;
      requests.send(requests_at_once);
    } else {
      scatter_to<D, 1>(w, p, value, {slope_of(p)}, OneField{to.first});
    }
  }
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
[[gnu::always_inline]] inline GatheredByChannel<D> gather(const Weights<D>& w, const FieldOf& field_of, Requests& requests) {
  GatheredByChannel<D> sums;
  for (std::size_t p = 0; p < 8; ++p) {
    requests.send(requests_at_once);
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

/// Gradients of the velocities around particle p of eight: half a pack, in which only the first channels stand, for each
/// direction. While one half is summed with the weights, the other one is with their slopes along x.
struct HalfGradients {
  Lanes y_and_x, z_or_hoop;  // in the first half and in the second; in the first half
};
template <bool hoop, std::size_t D, class Field>
[[gnu::always_inline]] inline HalfGradients gather_gradients_from(const Weights<D>& w, std::size_t p, const Field& from) {
  using B = Block<D>;
  const auto S = [&](std::size_t k, std::size_t a) { return w.along[a].value[k][p]; };
  const auto T = [&](std::size_t k, std::size_t a) { return w.along[a].gradient[k][p]; };
  const Lanes weights[] = {halves(S(0, 0), T(0, 0)), halves(S(1, 0), T(1, 0)), halves(S(2, 0), T(2, 0))};
  Lanes all(0.0), all_y(0.0), all_z(0.0);
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    Lanes plane(0.0), plane_y(0.0);
    for (int j = 0; j < 3; ++j) {
      const int row = w.corner[p] + B::tile_node(0, j, k);
      Lanes in_row(0.0), in_row_hoop(0.0);
      for (int i = 0; i < 3; ++i) {
        const Lanes node = first_half_twice(from.at(i + 3 * (j + 3 * k))[row + i]);
        in_row = multiply_add(weights[i], node, in_row);
        if constexpr (hoop) in_row_hoop = multiply_add(w.hoop[i][p], node, in_row_hoop);
      }
      plane = multiply_add(S(j, 1), in_row, plane), plane_y = multiply_add(T(j, 1), in_row, plane_y);
      if constexpr (hoop) all_z = multiply_add(S(j, 1), in_row_hoop, all_z);
    }
    if constexpr (D == 3) {
      all = multiply_add(S(k, 2), plane, all), all_y = multiply_add(S(k, 2), plane_y, all_y);
      all_z = multiply_add(T(k, 2), plane, all_z);
    } else {
      all = plane, all_y = plane_y;
    }
  }
  return {halves(all_y, all), all_z};
}

/// Velocity gradients at eight particles, dv_a/dx_b, and v_r/r.
template <std::size_t D>
class VelocityGradients {
 public:
  template <bool hoop, class FieldOf>
  [[gnu::always_inline]] static VelocityGradients gather(const Weights<D>& w, const FieldOf& field_of, Requests& requests) {
    VelocityGradients of;
    for (std::size_t p = 0; p < 8; ++p) {
      requests.send(requests_at_once);
      const TwoFields from = field_of(p);
      const HalfGradients sum = from.second == 0 ? gather_gradients_from<hoop, D>(w, p, OneField{from.first})
                                                 : gather_gradients_from<hoop, D>(w, p, from);
      of.y_and_x_[p] = sum.y_and_x;
      if constexpr (D == 3 || hoop) of.z_or_hoop_[p] = sum.z_or_hoop;
    }
    of.y_and_x_ = transposed(of.y_and_x_);
    if constexpr (D == 3 || hoop) of.z_or_hoop_ = transposed(of.z_or_hoop_);
    return of;
  }
  Lanes operator()(std::size_t a, std::size_t b) const {
    constexpr std::size_t second_half = 4;
    if (b == 2) return z_or_hoop_[Channel::velocity + a];
    return y_and_x_[Channel::velocity + a + (b == 0 ? second_half : 0)];
  }
  Lanes hoop() const { return z_or_hoop_[Channel::velocity]; }

 private:
  Square y_and_x_, z_or_hoop_;
};

}  // namespace brisance::simulator
