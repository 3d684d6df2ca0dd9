#pragma once
// The cells of the gas: a box of a uniform lattice in sparse blocks, known by their Morton index like those of the nodes. Cell
// i lies between the nodes i and i + 1. A block is 8 cells wide along each axis, 64 in one dimension; around the box lie two
// rings of ghost cells, whose blocks exist as well.
//
// All kernels see the gas as pencils: eight parallel lines of eight cells along one axis, with two more cells at either end.
// One pack of lanes holds one cell of each line, so the same code runs along every axis and in every number of dimensions.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "models/real.hpp"
#include "simulator/config.hpp"
#include "simulator/domain/domain.hpp"
#include "simulator/grid/grid.hpp"
#include "simulator/grid/morton.hpp"

namespace brisance::simulator::gas {

inline constexpr int line = 8;  // cells of a pencil that belong to its block
inline constexpr int ring = 2;  // cells beyond each end
inline constexpr int reach = line + 2 * ring;
inline constexpr int line_faces = line + 1;

/// An array whose elements are nothing until something is put there: to make lanes zero first takes time.
template <class T, std::size_t count>
class Unset {
 public:
  Unset() {}
  T& operator[](std::size_t i) { return elements_[i]; }
  const T& operator[](std::size_t i) const { return elements_[i]; }
  void fill(const T& value) { std::fill_n(elements_, count, value); }

 private:
  union {
    T elements_[count];
  };
};
/// A quantity in the cells of a pencil; cells ring ... ring + line - 1 are the block's.
using Pencil = Unset<Lanes, reach>;
/// A quantity at the faces of a pencil's own cells; face f is the low one of cell ring + f.
using FacePencil = Unset<Lanes, line_faces>;

template <int D>
struct BlockShape {
  static constexpr int side = D == 1 ? 64 : 8;   // cells along x
  static constexpr int packs = D == 3 ? 64 : 8;  // of one quantity
  static constexpr int cells = 8 * packs;
  static constexpr int pencils = D == 3 ? 8 : 1;      // along each axis
  static constexpr int faces = pencils * line_faces;  // packs of a quantity at the faces across one axis
};

/// A cell of this process.
struct CellPlace {
  std::size_t block = 0;
  int cell = 0;
};

/// Quantities in the cells of all blocks: [block][quantity][cell].
class CellSet {
 public:
  CellSet() = default;
  CellSet(int quantities, int packs) : quantities_(quantities), packs_(packs) {}
  int quantities() const { return quantities_; }
  int packs() const { return packs_; }
  void resize(std::size_t blocks) { data_.resize(blocks * block_packs(), Lanes(0.0)); }
  Lanes* at(std::size_t block, int quantity) {
    return data_.data() + block * block_packs() + static_cast<std::size_t>(quantity * packs_);
  }
  const Lanes* at(std::size_t block, int quantity) const { return const_cast<CellSet*>(this)->at(block, quantity); }
  double& cell(std::size_t block, int quantity, int c) { return reinterpret_cast<double*>(at(block, quantity))[c]; }
  double cell(std::size_t block, int quantity, int c) const { return const_cast<CellSet*>(this)->cell(block, quantity, c); }
  std::size_t bytes() const { return data_.capacity() * sizeof(Lanes); }
  /// Asks the memory for a pack of quantities first ... first + count - 1, to be read (0) or written (1). Inlined, or GCC takes
  /// what does nothing else for a function without effect, and leaves it out.
  template <int write>
  [[gnu::always_inline]] void fetch(std::size_t block, int pack, int first, int count) const {
    for (int q = first; q < first + count; ++q) __builtin_prefetch(at(block, q) + pack, write);
  }

 private:
  std::size_t block_packs() const { return static_cast<std::size_t>(quantities_ * packs_); }
  int quantities_ = 0, packs_ = 0;
  std::vector<Lanes> data_;
};

/// A ghost cell and the cell inside that it takes after.
struct Ghost {
  std::int32_t block, source_block;
  std::int16_t cell, source_cell;
};
/// The ghosts beyond one side of the box.
struct GhostSide {
  int axis = 0;
  int inward = 1;  // +1: the gas lies above
  std::vector<Ghost> mirrored, wrapped,
      nearest;  // the same ghosts with the source as in a mirror, a period away, next to the side
};

/// Volumes and areas, by the index of the cell along x; on the low side of the axis as beyond it. Plane: of one metre of depth;
/// cylindrical and axisymmetric: per radian; spherical: per steradian.
struct Metric {
  int first = 0;
  std::vector<double> volume;    // m^3
  std::vector<double> area_x;    // m^2, low face across x
  std::vector<double> area;      // m^2, faces across the other axes
  std::vector<double> widening;  // 1/m, (d area/dx)/area at the centre: divergence of a unit vector along x
};

struct Cells {
  Geometry geometry = Geometry::planar_1d;
  int dimensions = 1;
  double cell_size = 0.0;               // m
  std::array<int, 3> lower{}, upper{};  // the box: cells lower ... upper - 1
  Metric metric;

  std::vector<BlockKey> blocks;                         // owned here, read from here, and those of ghosts; in Morton order
  std::vector<std::int32_t> mine;                       // that hold cells of the box and are owned here
  std::vector<std::array<std::int32_t, 6>> neighbours;  // low x, high x, low y ...; -1: none
  std::vector<std::uint8_t> partial;                    // some of the block's cells are not of the box
  std::vector<GhostSide> sides;                         // low x, high x, low y, ...
  std::vector<std::vector<std::int32_t>> to_send, to_receive;  // whole blocks, by rank

  int packs() const { return dimensions == 3 ? 64 : 8; }
  /// The cell at the block's lower corner.
  std::array<int, 3> corner(std::size_t block) const;
  /// Position of the middle of a cell, m.
  Vector centre(std::size_t block, int cell) const;
  std::array<int, 3> index(std::size_t block, int cell) const;
  bool contains(const std::array<int, 3>& cell) const;
  std::int64_t count() const;  // cells of the box
  /// Where a cell is kept, if its block is owned here.
  std::optional<CellPlace> find(const std::array<int, 3>& cell) const;
};

/// The blocks of a box of cells, shared out to the ranks of the domain in Morton order.
Cells make_cells(Geometry geometry, double cell_size, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
                 const Domain& domain);

/// Sends the blocks that other ranks read.
void share(const Cells& cells, CellSet& set, Domain& domain);

// Pencils ------------------------------------------------------------------------------------------------------------

/// The quantity along the axis in pencil number n of a block.
template <int D>
void load(const Cells& cells, const CellSet& set, std::size_t block, int quantity, int axis, int n, Pencil& pencil);
/// The block's own cells only.
template <int D>
void load_own(const CellSet& set, std::size_t block, int quantity, int axis, int n, Pencil& pencil);
/// Writes the block's own cells of a pencil.
template <int D>
void store(CellSet& set, std::size_t block, int quantity, int axis, int n, const Pencil& pencil);

/// The packs of a block that pencil number n is made of: its cells one after the other; along x its lines.
struct PencilPacks {
  int first, step;
  PencilPacks(int axis, int n) : first(axis == 2 ? n : 8 * n), step(axis == 2 ? 8 : 1) {}
  int operator[](int m) const { return first + step * m; }
};

/// Asks the memory for the pencil after one (the next of the block, or the first of the block after it) while that one is
/// computed with: each call for another part of it, 0 ... line - 1. Asked for all at once, they would wait for each other.
template <int D>
class NextPencil {
 public:
  NextPencil(const Cells& cells, std::size_t block, int axis, int n)
      : block_(n + 1 < BlockShape<D>::pencils ? block : std::min(block + 1, cells.blocks.size() - 1)),
        packs_(axis, (n + 1) % BlockShape<D>::pencils),
        deep_(axis == 0 ? line : ring) {
    const auto beside = [&](int side) {
      const std::int32_t b = cells.neighbours[block_][static_cast<std::size_t>(2 * axis + side)];
      return b < 0 ? block_ : static_cast<std::size_t>(b);
    };
    low_ = beside(0), high_ = beside(1);
  }
  /// What `load` reads of quantities first ... first + count - 1.
  [[gnu::always_inline]] void fetch(const CellSet& set, int first, int count, std::size_t part) const {
    const int m = static_cast<int>(part);
    set.fetch<0>(block_, packs_[m], first, count);
    if (m < deep_) set.fetch<0>(high_, packs_[m], first, count);
    if (m >= line - deep_) set.fetch<0>(low_, packs_[m], first, count);
  }
  /// What `store` writes.
  [[gnu::always_inline]] void fetch_to_write(const CellSet& set, int first, int count, std::size_t part) const {
    set.fetch<1>(block_, packs_[static_cast<int>(part)], first, count);
  }

 private:
  std::size_t block_, low_, high_;
  PencilPacks packs_;
  int deep_;  // packs of a neighbour that `load` reads
};

/// Volumes of the cells and areas of the faces of a pencil.
struct PencilMetric {
  Pencil volume;
  FacePencil area;
};
template <int D>
void load_metric(const Cells& cells, std::size_t block, int axis, int n, PencilMetric& metric);

/// Which of the block's cells belong to the box, one bit a cell, pack by pack.
std::uint8_t cells_inside(const Cells& cells, std::size_t block, int pack);
LanesMask lanes_of(std::uint8_t bits);
/// The same for the cells number m of a pencil's lines.
template <int D>
LanesMask lanes_inside(const Cells& cells, std::size_t block, int axis, int n, int m);

}  // namespace brisance::simulator::gas
