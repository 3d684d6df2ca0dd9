#include "simulator/gas/cells.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/domain/message.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr int block_of(int cell, int axis, int dimensions) {
  return cell >> (dimensions == 1 && axis == 0 ? 6 : 3);
}
int side_of(int axis, int dimensions) {
  return dimensions == 1 && axis == 0 ? 64 : 8;
}
BlockKey key_of(const std::array<int, 3>& cell, int dimensions) {
  BlockPosition b{};
  for (int a = 0; a < dimensions; ++a)
    b[static_cast<std::size_t>(a)] = block_of(cell[static_cast<std::size_t>(a)], a, dimensions);
  return block_key(b);
}
/// The number of a cell within its block.
int cell_in_block(const std::array<int, 3>& cell, int dimensions) {
  if (dimensions == 1) return cell[0] & 63;
  return (cell[0] & 7) + 8 * (cell[1] & 7) + (dimensions == 3 ? 64 * (cell[2] & 7) : 0);
}

/// Calls f(cell) for every cell of a box.
template <class F>
void for_each_cell(const std::array<int, 3>& lower, const std::array<int, 3>& upper, F&& f) {
  for (int k = lower[2]; k < upper[2]; ++k)
    for (int j = lower[1]; j < upper[1]; ++j)
      for (int i = lower[0]; i < upper[0]; ++i) f(std::array<int, 3>{i, j, k});
}

/// The box of ghosts beyond one side.
void ghost_box(const Cells& c, int axis, int inward, std::array<int, 3>& lower, std::array<int, 3>& upper) {
  const auto a = static_cast<std::size_t>(axis);
  lower = c.lower, upper = c.upper;
  if (inward > 0)
    lower[a] = c.lower[a] - ring, upper[a] = c.lower[a];
  else
    lower[a] = c.upper[a], upper[a] = c.upper[a] + ring;
}

/// Where a ghost's value may come from: as in a mirror, from one period away, from the cell next to the side.
struct Sources {
  std::array<int, 3> mirrored, wrapped, nearest;
};
Sources sources_of(const Cells& c, const std::array<int, 3>& ghost, int axis, int inward) {
  const auto a = static_cast<std::size_t>(axis);
  const int lower = c.lower[a], upper = c.upper[a];
  Sources s{ghost, ghost, ghost};
  s.mirrored[a] = inward > 0 ? 2 * lower - 1 - ghost[a] : 2 * upper - 1 - ghost[a];
  s.wrapped[a] = inward > 0 ? ghost[a] + (upper - lower) : ghost[a] - (upper - lower);
  s.nearest[a] = inward > 0 ? lower : upper - 1;
  return s;
}

template <class F>
void for_each_ghost(const Cells& c, F&& f) {
  for (int axis = 0; axis < c.dimensions; ++axis)
    for (const int inward : {1, -1}) {
      std::array<int, 3> lower, upper;
      ghost_box(c, axis, inward, lower, upper);
      for_each_cell(lower, upper, [&](const std::array<int, 3>& cell) { f(axis, inward, cell); });
    }
}

Metric make_metric(Geometry geometry, int dimensions, double h, int lower, int upper) {
  // Padded so that eight cells can be read from any block on.
  Metric m;
  m.first = (lower - ring - 64) & ~63;
  const int count = ((upper + ring + 64) | 63) + 65 - m.first;
  for (int n = 0; n < count; ++n) {
    const double i = m.first + n;
    const double face = std::abs(i * h), next = std::abs((i + 1.0) * h), centre = std::abs((i + 0.5) * h);
    double volume = 0.0, area_x = 0.0, area = 0.0, widening = 0.0;
    switch (geometry) {
      case Geometry::axisymmetric:
        volume = centre * h * h, area_x = face * h, area = centre * h, widening = 1.0 / centre;
        break;
      case Geometry::cylindrical_1d:
        volume = centre * h, area_x = face, widening = 1.0 / centre;
        break;
      case Geometry::spherical_1d:
        volume = std::abs(next * next * next - face * face * face) / 3.0, area_x = face * face, widening = 2.0 / centre;
        break;
      default:
        volume = std::pow(h, dimensions), area_x = area = std::pow(h, dimensions - 1);
    }
    m.volume.push_back(volume), m.area_x.push_back(area_x), m.area.push_back(area);
    m.widening.push_back(i < 0 ? -widening : widening);
  }
  return m;
}

Lanes strided(const double* from) {
  Lanes result;
  alignas(64) double eight[8];
  for (int l = 0; l < 8; ++l) eight[l] = from[8 * l];
  result = Lanes::load(eight);
  return result;
}

/// Lane i of pack j becomes lane j of pack i, of eight packs.
void transpose(const Lanes* from, Lanes* to) {
  const double* const __restrict__ rows = reinterpret_cast<const double*>(from);
  double* const __restrict__ columns = reinterpret_cast<double*>(to);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) columns[8 * i + j] = rows[8 * j + i];
}

}  // namespace

std::array<int, 3> Cells::corner(std::size_t block) const {
  const BlockPosition b = block_position(blocks[block]);
  std::array<int, 3> cell{};
  for (int a = 0; a < dimensions; ++a)
    cell[static_cast<std::size_t>(a)] = b[static_cast<std::size_t>(a)] * side_of(a, dimensions);
  return cell;
}

std::array<int, 3> Cells::index(std::size_t block, int cell) const {
  std::array<int, 3> result = corner(block);
  if (dimensions == 1) return {result[0] + cell, 0, 0};
  result[0] += cell & 7, result[1] += cell >> 3 & 7, result[2] += cell >> 6;
  return result;
}

Vector Cells::centre(std::size_t block, int cell) const {
  const std::array<int, 3> i = index(block, cell);
  Vector x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) x[a] = (i[a] + 0.5) * cell_size;
  return x;
}

bool Cells::contains(const std::array<int, 3>& cell) const {
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a)
    if (cell[a] < lower[a] || cell[a] >= upper[a]) return false;
  return true;
}

std::optional<CellPlace> Cells::find(const std::array<int, 3>& cell) const {
  const auto place = std::lower_bound(blocks.begin(), blocks.end(), key_of(cell, dimensions));
  if (place == blocks.end() || *place != key_of(cell, dimensions)) return std::nullopt;
  const auto block = static_cast<std::int32_t>(place - blocks.begin());
  if (!std::binary_search(mine.begin(), mine.end(), block)) return std::nullopt;
  return CellPlace{static_cast<std::size_t>(block), cell_in_block(cell, dimensions)};
}

std::int64_t Cells::count() const {
  std::int64_t n = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) n *= upper[a] - lower[a];
  return n;
}

Cells make_cells(Geometry geometry, double cell_size, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
                 const Domain& domain) {
  Cells c;
  c.geometry = geometry, c.dimensions = number_of_dimensions(geometry), c.cell_size = cell_size;
  c.lower = lower, c.upper = upper;
  for (std::size_t a = static_cast<std::size_t>(c.dimensions); a < 3; ++a) c.lower[a] = 0, c.upper[a] = 1;
  c.metric = make_metric(geometry, c.dimensions, cell_size, c.lower[0], c.upper[0]);

  const auto sort_unique = [](std::vector<BlockKey>& keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  };
  std::vector<BlockKey> inside;  // blocks with cells of the box, of all ranks
  std::array<int, 3> first{}, last{};
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    if (a < c.dimensions)
      first[i] = block_of(c.lower[i], a, c.dimensions), last[i] = block_of(c.upper[i] - 1, a, c.dimensions) + 1;
    else
      last[i] = 1;
  }
  for_each_cell(first, last, [&](const std::array<int, 3>& b) { inside.push_back(block_key({b[0], b[1], b[2]})); });
  sort_unique(inside);
  const auto ranks = static_cast<std::size_t>(domain.size()), me = static_cast<std::size_t>(domain.rank());
  const auto owner_of = [&](std::size_t i) { return i * ranks / inside.size(); };

  // What each rank reads: the blocks around its own, and where their ghosts take their values from.
  std::vector<std::vector<BlockKey>> owned(ranks), read(ranks);
  for (std::size_t i = 0; i < inside.size(); ++i) owned[owner_of(i)].push_back(inside[i]);
  const auto faces_of = [&](BlockKey key, auto&& f) {
    for (int a = 0; a < c.dimensions; ++a)
      for (const int step : {-1, 1}) {
        BlockPosition b = block_position(key);
        b[static_cast<std::size_t>(a)] += step;
        f(2 * a + (step > 0 ? 1 : 0), block_key(b));
      }
  };
  for (std::size_t r = 0; r < ranks; ++r) {
    read[r] = owned[r];
    for (const BlockKey key : owned[r]) faces_of(key, [&](int, BlockKey neighbour) { read[r].push_back(neighbour); });
    sort_unique(read[r]);
  }
  for_each_ghost(c, [&](int axis, int inward, const std::array<int, 3>& cell) {
    const BlockKey at = key_of(cell, c.dimensions);
    const Sources s = sources_of(c, cell, axis, inward);
    for (std::size_t r = 0; r < ranks; ++r)
      if (std::binary_search(read[r].begin(), read[r].end(), at))
        for (const auto& source : {s.mirrored, s.wrapped, s.nearest}) {
          const BlockKey key = key_of(source, c.dimensions);
          const auto place = std::lower_bound(read[r].begin(), read[r].end(), key);
          if (place == read[r].end() || *place != key) read[r].insert(place, key);
        }
  });

  c.blocks = read[me];
  const auto find = [&](BlockKey key) -> std::int32_t {
    const auto place = std::lower_bound(c.blocks.begin(), c.blocks.end(), key);
    return place != c.blocks.end() && *place == key ? static_cast<std::int32_t>(place - c.blocks.begin()) : -1;
  };
  c.neighbours.resize(c.blocks.size()), c.partial.resize(c.blocks.size());
  for (std::size_t b = 0; b < c.blocks.size(); ++b) {
    c.neighbours[b].fill(-1);
    faces_of(c.blocks[b], [&](int side, BlockKey key) { c.neighbours[b][static_cast<std::size_t>(side)] = find(key); });
    const std::array<int, 3> low = c.corner(b);
    for (int a = 0; a < c.dimensions; ++a) {
      const auto i = static_cast<std::size_t>(a);
      if (low[i] < c.lower[i] || low[i] + side_of(a, c.dimensions) > c.upper[i]) c.partial[b] = 1;
    }
  }
  for (const BlockKey key : owned[me]) c.mine.push_back(find(key));
  c.to_send.resize(ranks), c.to_receive.resize(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    if (r == me) continue;
    for (const BlockKey key : read[r])
      if (std::binary_search(owned[me].begin(), owned[me].end(), key)) c.to_send[r].push_back(find(key));
    for (const BlockKey key : owned[r])
      if (std::binary_search(read[me].begin(), read[me].end(), key)) c.to_receive[r].push_back(find(key));
  }

  c.sides.resize(static_cast<std::size_t>(2 * c.dimensions));
  for_each_ghost(c, [&](int axis, int inward, const std::array<int, 3>& cell) {
    GhostSide& side = c.sides[static_cast<std::size_t>(2 * axis + (inward > 0 ? 0 : 1))];
    side.axis = axis, side.inward = inward;
    const std::int32_t block = find(key_of(cell, c.dimensions));
    if (block < 0) return;
    const Sources s = sources_of(c, cell, axis, inward);
    const auto ghost = [&](const std::array<int, 3>& source) {
      return Ghost{block, find(key_of(source, c.dimensions)), static_cast<std::int16_t>(cell_in_block(cell, c.dimensions)),
                   static_cast<std::int16_t>(cell_in_block(source, c.dimensions))};
    };
    side.mirrored.push_back(ghost(s.mirrored)), side.wrapped.push_back(ghost(s.wrapped)),
        side.nearest.push_back(ghost(s.nearest));
  });
  return c;
}

void share(const Cells& cells, CellSet& set, Domain& domain) {
  if (domain.size() == 1) return;
  const auto numbers = static_cast<std::size_t>(set.quantities() * set.packs());
  std::vector<Message> messages(cells.to_send.size());
  for (std::size_t r = 0; r < messages.size(); ++r)
    for (const std::int32_t b : cells.to_send[r]) append(messages[r], set.at(static_cast<std::size_t>(b), 0), numbers);
  const std::vector<Message> received = domain.exchange(std::move(messages));
  for (std::size_t r = 0; r < received.size(); ++r) {
    MessageReader reader(received[r]);
    for (const std::int32_t b : cells.to_receive[r]) reader.read(set.at(static_cast<std::size_t>(b), 0), numbers);
  }
}

template <int D>
void load(const Cells& cells, const CellSet& set, std::size_t block, int quantity, int axis, int n, Pencil& pencil) {
  const auto side = static_cast<std::size_t>(2 * axis);
  const Lanes* low = set.at(static_cast<std::size_t>(cells.neighbours[block][side]), quantity);
  const Lanes* own = set.at(block, quantity);
  const Lanes* high = set.at(static_cast<std::size_t>(cells.neighbours[block][side + 1]), quantity);
  const PencilPacks packs(axis, n);
  if (axis == 0) {
    transpose(own + packs.first, &pencil[ring]);
    for (std::size_t m = 0; m < ring; ++m) {
      Lanes &low_end = pencil[m], &high_end = pencil[ring + line + m];
      if constexpr (D == 1) {  // the lines follow each other
        for (int l = 1; l < 8; ++l) low_end.set(l, pencil[line + m][l - 1]), high_end.set(l - 1, pencil[ring + m][l]);
        low_end.set(0, low[7][line - ring + static_cast<int>(m)]), high_end.set(7, high[0][static_cast<int>(m)]);
      } else {
        low_end = strided(reinterpret_cast<const double*>(low + packs.first) + (line - ring) + m);
        high_end = strided(reinterpret_cast<const double*>(high + packs.first) + m);
      }
    }
    return;
  }
  for (int m = 0; m < ring; ++m) {
    pencil[static_cast<std::size_t>(m)] = low[packs[line - ring + m]];
    pencil[static_cast<std::size_t>(ring + line + m)] = high[packs[m]];
  }
  for (int m = 0; m < line; ++m) pencil[static_cast<std::size_t>(ring + m)] = own[packs[m]];
}

template <int D>
void load_own(const CellSet& set, std::size_t block, int quantity, int axis, int n, Pencil& pencil) {
  const Lanes* own = set.at(block, quantity);
  const PencilPacks packs(axis, n);
  if (axis == 0) return transpose(own + packs.first, &pencil[ring]);
  for (int m = 0; m < line; ++m) pencil[static_cast<std::size_t>(ring + m)] = own[packs[m]];
}

template <int D>
void store(CellSet& set, std::size_t block, int quantity, int axis, int n, const Pencil& pencil) {
  Lanes* own = set.at(block, quantity);
  const PencilPacks packs(axis, n);
  if (axis == 0) return transpose(&pencil[ring], own + packs.first);
  for (int m = 0; m < line; ++m) own[packs[m]] = pencil[static_cast<std::size_t>(ring + m)];
}

template <int D>
void load_metric(const Cells& cells, std::size_t block, int axis, int /*n*/, PencilMetric& metric) {
  const Metric& all = cells.metric;
  const int first = cells.corner(block)[0] - all.first;
  if (axis > 0) {  // the lanes are cells along x
    metric.volume.fill(Lanes::load(all.volume.data() + first));
    metric.area.fill(Lanes::load(all.area.data() + first));
    return;
  }
  for (int m = 0; m < reach; ++m) {
    const double* volume = all.volume.data() + first - ring + m;
    const double* area = all.area_x.data() + first - ring + m;
    metric.volume[static_cast<std::size_t>(m)] = D == 1 ? strided(volume) : Lanes(*volume);
    if (m >= ring && m < ring + line_faces)
      metric.area[static_cast<std::size_t>(m - ring)] = D == 1 ? strided(area) : Lanes(*area);
  }
}

std::uint8_t cells_inside(const Cells& cells, std::size_t block, int pack) {
  if (!cells.partial[block]) return 0xff;
  std::uint8_t bits = 0;
  for (int l = 0; l < 8; ++l)
    if (cells.contains(cells.index(block, 8 * pack + l))) bits |= static_cast<std::uint8_t>(1u << l);
  return bits;
}

LanesMask lanes_of(std::uint8_t bits) {
  if (bits == 0xff) return LanesMask(true);
  Lanes flag;
  for (int l = 0; l < 8; ++l) flag.set(l, bits >> l & 1);
  return flag > 0.0;
}

template <int D>
LanesMask lanes_inside(const Cells& cells, std::size_t block, int axis, int n, int m) {
  if (!cells.partial[block]) return LanesMask(true);
  if (axis > 0) return lanes_of(cells_inside(cells, block, axis == 1 ? m + 8 * n : n + 8 * m));
  Lanes flag;
  for (int l = 0; l < 8; ++l) flag.set(l, cells.contains(cells.index(block, 8 * l + m + (D == 3 ? 64 * n : 0))) ? 1.0 : 0.0);
  return flag > 0.0;
}

template LanesMask lanes_inside<1>(const Cells&, std::size_t, int, int, int);
template LanesMask lanes_inside<2>(const Cells&, std::size_t, int, int, int);
template LanesMask lanes_inside<3>(const Cells&, std::size_t, int, int, int);
template void load<1>(const Cells&, const CellSet&, std::size_t, int, int, int, Pencil&);
template void load<2>(const Cells&, const CellSet&, std::size_t, int, int, int, Pencil&);
template void load<3>(const Cells&, const CellSet&, std::size_t, int, int, int, Pencil&);
template void load_own<1>(const CellSet&, std::size_t, int, int, int, Pencil&);
template void load_own<2>(const CellSet&, std::size_t, int, int, int, Pencil&);
template void load_own<3>(const CellSet&, std::size_t, int, int, int, Pencil&);
template void store<1>(CellSet&, std::size_t, int, int, int, const Pencil&);
template void store<2>(CellSet&, std::size_t, int, int, int, const Pencil&);
template void store<3>(CellSet&, std::size_t, int, int, int, const Pencil&);
template void load_metric<1>(const Cells&, std::size_t, int, int, PencilMetric&);
template void load_metric<2>(const Cells&, std::size_t, int, int, PencilMetric&);
template void load_metric<3>(const Cells&, std::size_t, int, int, PencilMetric&);

}  // namespace brisance::simulator::gas
