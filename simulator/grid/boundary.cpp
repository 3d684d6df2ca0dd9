#include "simulator/grid/boundary.hpp"

#include "simulator/table.hpp"

namespace brisance::simulator {
namespace {

/// Calls f(plane, inside, ghost) with the tile indices of the three nodes of each line across the plane.
template <int D, class F>
void for_each_line(const Boundary& boundary, int plane, F&& f) {
  using B = Block<D>;
  const int at = plane + 1, in = at + boundary.inward, out = at - boundary.inward;
  const int depth = D == 3 ? B::tile_side : 1;
  for (int k = 0; k < (boundary.axis == 2 ? 1 : depth); ++k)
    for (int j = 0; j < (boundary.axis == 1 ? 1 : B::tile_side); ++j)
      for (int i = 0; i < (boundary.axis == 0 ? 1 : B::tile_side); ++i) {
        const auto node = [&](int n) {
          return B::tile_node(boundary.axis == 0 ? n : i, boundary.axis == 1 ? n : j, boundary.axis == 2 ? n : k);
        };
        f(node(at), node(in), node(out));
      }
}

/// The lowest bit of a wall's.
int touch_shift(const Boundary& wall) {
  return 8 * (2 * wall.axis + (wall.inward > 0 ? 0 : 1));
}

/// 1 in every channel, -1 in those that point across the plane.
Lanes parity(int axis) {
  Lanes sign(1.0);
  sign.set(Channel::momentum + axis, -1.0);
  sign.set(Channel::force + axis, -1.0);
  return sign;
}

}  // namespace

double touch_number(const Boundary& wall) {
  return static_cast<double>(std::uint64_t{1} << touch_shift(wall));
}
bool touches(double sum, const Boundary& wall) {
  return (static_cast<std::uint64_t>(sum) >> touch_shift(wall) & 255u) != 0;
}

template <int D>
int local_plane(const Boundary& boundary, BlockKey block) {
  const int local = boundary.node - block_position(block)[boundary.axis] * Block<D>::side;
  return local >= 0 && local < Block<D>::side ? local : -1;
}

template <int D>
void fold(const std::vector<Boundary>& boundaries, BlockKey block, Lanes* tile) {
  for (const Boundary& b : boundaries) {
    const int plane = b.has_ghosts() ? local_plane<D>(b, block) : -1;
    if (plane < 0) continue;
    if (b.is_mirror()) {
      const Lanes sign = parity(b.axis);
      for_each_line<D>(b, plane, [&](int, int in, int out) {
        tile[in] += sign * tile[out];
        tile[out] = Lanes(0.0);
      });
    } else {
      Lanes to_plane(2.0), to_inside(-1.0);
      to_plane.set(Channel::touch, 1.0), to_inside.set(Channel::touch, 0.0);
      for_each_line<D>(b, plane, [&](int at, int in, int out) {
        tile[at] += to_plane * tile[out];
        tile[in] += to_inside * tile[out];
        tile[out] = Lanes(0.0);
      });
    }
  }
}

template <int D>
void unfold(const std::vector<Boundary>& boundaries, BlockKey block, Lanes* tile) {
  for (auto b = boundaries.rbegin(); b != boundaries.rend(); ++b) {
    const int plane = b->has_ghosts() ? local_plane<D>(*b, block) : -1;
    if (plane < 0) continue;
    if (b->is_mirror()) {
      const Lanes sign = parity(b->axis);
      for_each_line<D>(*b, plane, [&](int, int in, int out) { tile[out] = sign * tile[in]; });
    } else {
      for_each_line<D>(*b, plane, [&](int at, int in, int out) { tile[out] = Lanes(2.0) * tile[at] - tile[in]; });
    }
  }
}

template int local_plane<2>(const Boundary&, BlockKey);
template int local_plane<3>(const Boundary&, BlockKey);
template void fold<2>(const std::vector<Boundary>&, BlockKey, Lanes*);
template void fold<3>(const std::vector<Boundary>&, BlockKey, Lanes*);
template void unfold<2>(const std::vector<Boundary>&, BlockKey, Lanes*);
template void unfold<3>(const std::vector<Boundary>&, BlockKey, Lanes*);

double velocity_of(const Boundary& boundary, double time) {
  return boundary.velocity.size > 0 ? boundary.velocity(time) : 0.0;
}

Vector grid_origin(const std::vector<Boundary>& boundaries, double time) {
  Vector origin{};
  for (const Boundary& b : boundaries)
    if (b.carries_grid) origin[static_cast<std::size_t>(b.axis)] = integral(b.velocity, time);
  return origin;
}

void place_grid(Grid& grid, const std::vector<Boundary>& boundaries, double time) {
  grid.origin = grid_origin(boundaries, time);
  for (const Boundary& b : boundaries)
    if (b.carries_grid) grid.velocity[static_cast<std::size_t>(b.axis)] = velocity_of(b, time);
}

Vector bounded(const Boundary& boundary, Vector velocity, bool touched, double time) {
  double& normal = velocity[static_cast<std::size_t>(boundary.axis)];
  switch (boundary.kind) {
    case BoundaryKind::symmetry:
      normal = 0.0;
      break;
    case BoundaryKind::fixed:
      velocity = {};
      break;
    case BoundaryKind::velocity:
      normal = velocity_of(boundary, time);
      break;
    case BoundaryKind::rigid_wall:
      if (const double V = velocity_of(boundary, time); touched && (normal - V) * boundary.inward < 0.0) normal = V;
      break;
    case BoundaryKind::outflow:
      break;
  }
  return velocity;
}

}  // namespace brisance::simulator
