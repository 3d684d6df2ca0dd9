#pragma once
// The background grid: a uniform lattice of nodes at (i h, j h, k h) from an origin, stored in sparse blocks of 64 nodes. Only
// blocks that particles touch exist. A block's particles are those whose nearest node it owns; they add to a private tile,
// which is the block with a ring of one node, and the owner of a node adds what the tiles contribute in Morton order. So the
// order of every sum is given by the grid, not by who computes it.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "models/real.hpp"
#include "simulator/domain/domain.hpp"
#include "simulator/grid/morton.hpp"
#include "simulator/vector.hpp"

namespace brisance::simulator {

/// What a node holds, side by side: eight numbers are one pack of lanes. Vectors use as many components as the run has
/// dimensions.
struct Channel {
  static constexpr int mass = 0;      // kg
  static constexpr int momentum = 1;  // kg m/s, in sums; velocity (m/s) in motion
  static constexpr int velocity = 1;
  static constexpr int force = 4;  // N, in sums; change of velocity over the step (m/s) in motion
  static constexpr int change = 4;
  static constexpr int touch = 7;  // which walls particles touch at the node: see boundary.hpp
};

/// Shape of blocks and tiles in D dimensions.
template <int D>
struct Block {
  static constexpr int side = D == 3 ? 4 : 8;
  static constexpr int nodes = 64;
  static constexpr int tile_side = side + 2;
  static constexpr int tile_nodes = D == 3 ? tile_side * tile_side * tile_side : tile_side * tile_side;
  static constexpr int neighbours = D == 3 ? 27 : 9;

  static constexpr int node(int i, int j, int k) { return i + side * (j + side * k); }
  static constexpr int tile_node(int i, int j, int k) { return i + tile_side * (j + tile_side * k); }
};

/// The node nearest to a coordinate, and the distance from it in cells, in [-1/2, 1/2).
struct Nearest {
  int node;
  double offset;
};
inline Nearest nearest_node(double coordinate, double inverse_cell_size) {
  const double u = coordinate * inverse_cell_size, n = std::floor(u + 0.5);
  return {static_cast<int>(n), u - n};
}
template <int D>
constexpr int block_of_node(int node) {
  return node >> (D == 3 ? 2 : 3);
}
template <int D>
BlockKey block_at(const double* position, int stride, double inverse_cell_size) {
  BlockPosition b{};
  for (int a = 0; a < D; ++a) b[a] = block_of_node<D>(nearest_node(position[a * stride], inverse_cell_size).node);
  return block_key(b);
}

/// Who owns which blocks: rank r those from first[r] on, in Morton order.
struct Partition {
  std::vector<BlockKey> first{0};
  int owner(BlockKey key) const;
};

/// A tile's share in a block.
struct Contribution {
  std::int32_t tile;
  std::array<std::int8_t, 3> offset;  // of the block from the tile's block
};

struct Grid {
  int dimensions = 3;
  double cell_size = 0.0;  // m
  int fields = 1;          // velocity fields
  Vector origin{};         // m, where node (0, 0, 0) is: it travels with a boundary that has a velocity
  Vector velocity{};       // m/s, of the origin

  // Tiles: of the blocks that hold particles, here and, as far as they touch blocks owned here, on other ranks.
  std::vector<BlockKey> tile_block;  // in Morton order
  std::vector<std::int32_t> my_tiles;
  std::vector<Lanes> tiles;  // [tile][field][tile node]

  // Blocks of nodes: owned here, or read by tiles from here.
  std::vector<BlockKey> blocks;  // in Morton order
  std::vector<std::int32_t> my_blocks;
  std::vector<Lanes> sums;                                    // [block][field][node]: mass, momentum, force, touch
  std::vector<Lanes> motion;                                  // [block][field][node]: velocity, change of velocity
  std::vector<std::vector<Contribution>> contributions;       // to each block, in Morton order of the tiles
  std::vector<std::array<std::int32_t, 27>> tile_neighbours;  // blocks around each of my tiles, by offset

  int tile_nodes() const { return dimensions == 3 ? Block<3>::tile_nodes : Block<2>::tile_nodes; }
  Lanes* tile(std::size_t t, int field) {
    return tiles.data() +
           (t * static_cast<std::size_t>(fields) + static_cast<std::size_t>(field)) * static_cast<std::size_t>(tile_nodes());
  }
  Lanes* block_sums(std::size_t b, int field) {
    return sums.data() + (b * static_cast<std::size_t>(fields) + static_cast<std::size_t>(field)) * 64;
  }
  Lanes* block_motion(std::size_t b, int field) {
    return motion.data() + (b * static_cast<std::size_t>(fields) + static_cast<std::size_t>(field)) * 64;
  }
  const Lanes* block_motion(std::size_t b, int field) const { return const_cast<Grid*>(this)->block_motion(b, field); }
  std::size_t bytes() const;

  // What this rank and the others send each other; empty for one process.
  std::vector<std::vector<std::int32_t>> tiles_to_send, blocks_to_send;  // by rank
};

/// Makes the blocks for the given blocks with particles of this rank, in Morton order.
void activate(Grid& grid, std::span<const BlockKey> with_particles, const Partition& partition, Domain& domain);

/// Sends tiles to the owners of the blocks they touch.
void gather_tiles(Grid& grid, Domain& domain);
/// Adds the tiles into `sums`, each node in Morton order of the tiles.
void sum_tiles(Grid& grid);
/// Sends the motion of blocks to the ranks whose particles read them.
void broadcast_motion(Grid& grid, Domain& domain);
/// The motion of a tile's nodes; nodes of blocks that do not exist are at rest.
void load_tile(const Grid& grid, std::size_t tile, int field, Lanes* nodes);

}  // namespace brisance::simulator
