#pragma once
// A tile of the grid as the kernels of the transfers see it.

#include "simulator/simulation.hpp"
#include "simulator/solid/eight.hpp"
#include "simulator/solid/transfer/stencil.hpp"

namespace brisance::simulator {

template <Geometry G>
inline constexpr int dimensions_of = G == Geometry::three_dimensional ? 3 : 2;

/// Calls f.template operator()<geometry, basis>() for those of the run.
template <class F>
auto with_kernel(const Simulation& s, F&& f) {
  const auto basis = [&]<Geometry G>() {
    return s.numerics.basis == Basis::ugimp ? f.template operator()<G, Basis::ugimp>()
                                            : f.template operator()<G, Basis::quadratic_spline>();
  };
  switch (s.geometry) {
    case Geometry::plane:
      return basis.template operator()<Geometry::plane>();
    case Geometry::axisymmetric:
      return basis.template operator()<Geometry::axisymmetric>();
    default:
      return basis.template operator()<Geometry::three_dimensional>();
  }
}

/// The bin of a body in a block, if it has particles there.
inline const Bin* find_bin(const Body& body, BlockKey block) {
  const auto& bins = body.bins.bins;
  const auto at = std::lower_bound(bins.begin(), bins.end(), block, [](const Bin& b, BlockKey key) { return b.block < key; });
  return at != bins.end() && at->block == block ? &*at : nullptr;
}

/// Tile of the grid with what the kernels need around it.
struct TileView {
  BlockKey key;
  BlockPosition position;
  std::size_t number;
};
inline TileView view(const Grid& grid, std::size_t i) {
  const auto t = static_cast<std::size_t>(grid.my_tiles[i]);
  return {grid.tile_block[t], block_position(grid.tile_block[t]), t};
}

template <class F>
void for_each_share(Simulation& s, const TileView& tile, F&& f) {
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    if (const Bin* bin = find_bin(s.bodies[b], tile.key)) f(b, s.bodies[b], *bin);
}

/// Positions with respect to the grid's origin, m.
template <std::size_t D>
std::array<Lanes, D> on_grid(const Grid& grid, std::array<Lanes, D> position) {
  for (std::size_t a = 0; a < D; ++a) position[a] -= grid.origin[a];
  return position;
}

/// The nodes that each of eight particles sees, from the first of the fields of their tile.
template <std::size_t D>
auto nodes_of(const Body& body, const Eight& eight, Lanes* fields) {
  return [&body, &eight, first = fields + body.field * Block<D>::tile_nodes](std::size_t i) {
    const auto& second = body.particles.second_field;
    return TwoFields{first, Block<D>::tile_nodes, second.empty() ? 0u : second[eight.particle[i]]};
  };
}

/// The motion of a tile's nodes, ghosts included: [field][node].
template <int D>
std::vector<Lanes> motion_of(const Simulation& s, const TileView& tile) {
  std::vector<Lanes> motion(static_cast<std::size_t>(s.grid.fields) * Block<D>::tile_nodes);
  for (int f = 0; f < s.grid.fields; ++f) {
    Lanes* nodes = motion.data() + f * Block<D>::tile_nodes;
    load_tile(s.grid, tile.number, f, nodes);
    unfold<D>(s.boundaries, tile.key, nodes);
  }
  return motion;
}

}  // namespace brisance::simulator
