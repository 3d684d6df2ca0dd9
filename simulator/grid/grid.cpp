#include "simulator/grid/grid.hpp"

#include <algorithm>

#include "simulator/domain/message.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator {
namespace {

/// Calls f(neighbour's position, offset, index) for the blocks around one and itself.
template <class F>
void for_each_neighbour(int dimensions, const BlockPosition& b, F&& f) {
  const int depth = dimensions == 3 ? 1 : 0;
  int index = 0;
  for (int k = -depth; k <= depth; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i, ++index)
        f(BlockPosition{b[0] + i, b[1] + j, b[2] + k},
          std::array<std::int8_t, 3>{static_cast<std::int8_t>(i), static_cast<std::int8_t>(j), static_cast<std::int8_t>(k)},
          index);
}

/// The nodes of a block that lie in a tile at a given offset along one axis: [begin, end) in the block, and where the first
/// stands in the tile.
struct Overlap {
  int begin, end, in_tile;
};
constexpr Overlap overlap(int side, int offset) {
  if (offset == 0) return {0, side, 1};
  if (offset > 0) return {0, 1, side + 1};
  return {side - 1, side, 0};
}

/// Calls f(first node in the block, first node in the tile, count) for each row of nodes they share.
template <int D, class F>
void for_each_shared_row(const std::array<std::int8_t, 3>& offset, F&& f) {
  using B = Block<D>;
  const Overlap x = overlap(B::side, offset[0]), y = overlap(B::side, offset[1]),
                z = D == 3 ? overlap(B::side, offset[2]) : Overlap{0, 1, 0};
  for (int k = z.begin; k < z.end; ++k)
    for (int j = y.begin; j < y.end; ++j)
      f(B::node(x.begin, j, k), B::tile_node(x.in_tile, y.in_tile + j - y.begin, z.in_tile + k - z.begin), x.end - x.begin);
}

template <int D>
void sum(Grid& grid) {
  parallel_for_blocks(grid.my_blocks.size(), [&](std::size_t i) {
    const auto b = static_cast<std::size_t>(grid.my_blocks[i]);
    for (int field = 0; field < grid.fields; ++field) {
      Lanes* nodes = grid.block_sums(b, field);
      std::fill(nodes, nodes + 64, Lanes(0.0));
      for (const Contribution& c : grid.contributions[b]) {
        const Lanes* tile = grid.tile(static_cast<std::size_t>(c.tile), field);
        for_each_shared_row<D>(c.offset, [&](int to, int from, int count) {
          for (int n = 0; n < count; ++n) nodes[to + n] += tile[from + n];
        });
      }
    }
  });
}

template <int D>
void load(const Grid& grid, std::size_t tile, int field, Lanes* nodes) {
  const BlockPosition center{};
  for_each_neighbour(D, center, [&](const BlockPosition&, const std::array<std::int8_t, 3>& offset, int index) {
    const std::int32_t b = grid.tile_neighbours[tile][static_cast<std::size_t>(index)];
    const Lanes* from = grid.block_motion(static_cast<std::size_t>(b), field);
    for_each_shared_row<D>(offset, [&](int in_block, int in_tile, int count) {
      for (int n = 0; n < count; ++n) nodes[in_tile + n] = from[in_block + n];
    });
  });
}

}  // namespace

int Partition::owner(BlockKey key) const {
  return static_cast<int>(std::upper_bound(first.begin(), first.end(), key) - first.begin()) - 1;
}

std::size_t Grid::bytes() const {
  return (tiles.capacity() + sums.capacity() + motion.capacity()) * sizeof(Lanes) +
         tile_neighbours.capacity() * sizeof(tile_neighbours[0]);
}

void activate(Grid& grid, std::span<const BlockKey> with_particles, const Partition& partition, Domain& domain) {
  const int me = domain.rank(), ranks = domain.size();
  Message mine;
  append(mine, with_particles.data(), with_particles.size());
  const std::vector<Message> lists = ranks > 1 ? all_gather(domain, mine) : std::vector<Message>{mine};

  std::vector<BlockKey> tiles, blocks;
  grid.tiles_to_send.assign(static_cast<std::size_t>(ranks), {});
  std::vector<std::vector<BlockKey>> tile_keys_to_send(static_cast<std::size_t>(ranks)), block_keys_to_send = tile_keys_to_send;
  for (int r = 0; r < ranks; ++r) {
    const Message& list = lists[static_cast<std::size_t>(r)];
    for (MessageReader reader(list); !reader.at_end();) {
      const auto key = reader.read<BlockKey>();
      bool touches_mine = false;
      std::vector<int> owners;
      for_each_neighbour(grid.dimensions, block_position(key), [&](const BlockPosition& n, const auto&, int) {
        const BlockKey neighbour = block_key(n);
        const int owner = partition.owner(neighbour);
        touches_mine = touches_mine || owner == me;
        if (r == me || owner == me) blocks.push_back(neighbour);
        if (r == me && owner != me && std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
        if (r != me && owner == me) block_keys_to_send[static_cast<std::size_t>(r)].push_back(neighbour);
      });
      if (r == me || touches_mine) tiles.push_back(key);
      for (const int owner : owners) tile_keys_to_send[static_cast<std::size_t>(owner)].push_back(key);
    }
  }
  const auto sort_unique = [](std::vector<BlockKey>& keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  };
  sort_unique(tiles), sort_unique(blocks);
  if (tiles == grid.tile_block && blocks == grid.blocks && ranks == 1) return;
  grid.tile_block = std::move(tiles), grid.blocks = std::move(blocks);
  const auto find = [](const std::vector<BlockKey>& keys, BlockKey key) -> std::int32_t {
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    return at != keys.end() && *at == key ? static_cast<std::int32_t>(at - keys.begin()) : -1;
  };

  grid.my_tiles.clear(), grid.my_blocks.clear();
  for (const BlockKey key : with_particles) grid.my_tiles.push_back(find(grid.tile_block, key));
  grid.contributions.assign(grid.blocks.size(), {});
  grid.tile_neighbours.assign(grid.tile_block.size(), {});
  for (std::size_t b = 0; b < grid.blocks.size(); ++b)
    if (partition.owner(grid.blocks[b]) == me) grid.my_blocks.push_back(static_cast<std::int32_t>(b));
  for (std::size_t t = 0; t < grid.tile_block.size(); ++t)  // in Morton order, so contributions are as well
    for_each_neighbour(grid.dimensions, block_position(grid.tile_block[t]),
                       [&](const BlockPosition& n, const auto& offset, int index) {
                         const std::int32_t b = find(grid.blocks, block_key(n));
                         grid.tile_neighbours[t][static_cast<std::size_t>(index)] = b;
                         if (b >= 0)
                           grid.contributions[static_cast<std::size_t>(b)].push_back({static_cast<std::int32_t>(t), offset});
                       });
  grid.blocks_to_send.assign(static_cast<std::size_t>(ranks), {});
  for (std::size_t r = 0; r < static_cast<std::size_t>(ranks); ++r) {
    sort_unique(block_keys_to_send[r]);
    for (const BlockKey key : tile_keys_to_send[r]) grid.tiles_to_send[r].push_back(find(grid.tile_block, key));
    for (const BlockKey key : block_keys_to_send[r]) grid.blocks_to_send[r].push_back(find(grid.blocks, key));
  }

  const auto fields = static_cast<std::size_t>(grid.fields);
  grid.tiles.resize(grid.tile_block.size() * fields * static_cast<std::size_t>(grid.tile_nodes()));
  grid.sums.resize(grid.blocks.size() * fields * 64);
  grid.motion.resize(grid.blocks.size() * fields * 64);
}

namespace {

/// Hands on what belongs to blocks: to each rank those that `to_send` tells, by their numbers among `keys`. `values(n)`: where
/// the `length` numbers of the block number n begin.
template <class Values>
void exchange_blocks(Domain& domain, const std::vector<std::vector<std::int32_t>>& to_send, const std::vector<BlockKey>& keys,
                     std::size_t length, const Values& values) {
  std::vector<Message> messages(to_send.size());
  for (std::size_t r = 0; r < messages.size(); ++r)
    for (const std::int32_t n : to_send[r]) {
      append(messages[r], keys[static_cast<std::size_t>(n)]);
      append(messages[r], values(static_cast<std::size_t>(n)), length);
    }
  const std::vector<Message> received = domain.exchange(std::move(messages));
  for (const Message& message : received)
    for (MessageReader reader(message); !reader.at_end();) {
      const auto at = std::lower_bound(keys.begin(), keys.end(), reader.read<BlockKey>());
      reader.read(values(static_cast<std::size_t>(at - keys.begin())), length);
    }
}

}  // namespace

void gather_tiles(Grid& grid, Domain& domain) {
  if (domain.size() == 1) return;
  const auto length = static_cast<std::size_t>(grid.fields * grid.tile_nodes());
  exchange_blocks(domain, grid.tiles_to_send, grid.tile_block, length, [&](std::size_t t) { return grid.tile(t, 0); });
}

void sum_tiles(Grid& grid) {
  grid.dimensions == 3 ? sum<3>(grid) : sum<2>(grid);
}

void broadcast_motion(Grid& grid, Domain& domain) {
  if (domain.size() == 1) return;
  const std::size_t length = static_cast<std::size_t>(grid.fields) * 64;
  exchange_blocks(domain, grid.blocks_to_send, grid.blocks, length, [&](std::size_t b) { return grid.block_motion(b, 0); });
}

void load_tile(const Grid& grid, std::size_t tile, int field, Lanes* nodes) {
  grid.dimensions == 3 ? load<3>(grid, tile, field, nodes) : load<2>(grid, tile, field, nodes);
}

}  // namespace brisance::simulator
