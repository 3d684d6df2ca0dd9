#pragma once
// Cells that bodies of particles cut: their gas, the open parts of their faces, the wall in them. All of it follows from the
// fraction of solid at the nodes and is computed alike by every rank that sees a cell.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "simulator/gas/cells.hpp"

namespace brisance::simulator::gas {

/// The cells that a rank computes with: the least box around its blocks and eight cells on all sides. Quantities stand in
/// arrays of `length` numbers, x fastest; what lies before the first and after the last cell is there to be read. A node has
/// the number of the cell above it.
struct Window {
  static constexpr int depth = 8;
  int dimensions = 0;
  std::array<int, 3> lower{}, size{};
  std::array<std::ptrdiff_t, 3> stride{};
  std::size_t first = 0, cells = 0, length = 0;

  bool empty() const { return cells == 0; }
  std::size_t at(const std::array<int, 3>& cell) const {
    std::ptrdiff_t n = 0;
    for (std::size_t a = 0; a < 3; ++a) n += stride[a] * (cell[a] - lower[a]);
    return first + static_cast<std::size_t>(n);
  }
  std::array<int, 3> index(std::size_t n) const;
  /// Whether the cell lies at least so many cells from the window's sides.
  bool holds(const std::array<int, 3>& cell, int margin = 0) const;
};
Window make_window(const Cells& cells);

/// A part of the window: cells lower ... upper - 1.
struct Part {
  std::array<int, 3> lower{}, upper{};
  bool empty() const { return lower[0] >= upper[0]; }
};
template <class F>
void for_each_cell_of(const Part& part, F&& f) {
  for (int k = part.lower[2]; k < part.upper[2]; ++k)
    for (int j = part.lower[1]; j < part.upper[1]; ++j)
      for (int i = part.lower[0]; i < part.upper[0]; ++i) f(std::array<int, 3>{i, j, k});
}

/// What the bodies leave open at one time.
struct OpenSpace {
  std::vector<double> volume;               // m^3, gas in a cell
  std::array<std::vector<double>, 3> area;  // m^2, open part of a cell's low faces
  std::vector<double> side;                 // m^2, of the cell across the angle: axisymmetric
  Part cut;                                 // beyond, all is open
};
/// Volume and low faces of a whole cell.
struct WholeCell {
  double volume, side;
  std::array<double, 3> area;
};
WholeCell whole_cell(const Cells& cells, int x);

/// Points of a body: where they are, how they move, their volumes (m^3, per radian about an axis).
struct BodyPoints {
  std::vector<Vector> position, velocity;
  std::vector<double> volume;
};
/// What the points of all bodies put on the nodes.
struct BodyNodes {
  std::vector<double> fraction;                 // of solid
  std::array<std::vector<double>, 3> momentum;  // fraction times velocity, m/s
  std::vector<double> share;                    // the largest fraction of one body
  std::vector<std::int16_t> body;               // whose it is; -1: none
  std::vector<double> second_share;             // the largest of another body, and whose; of several bodies
  std::vector<std::int16_t> other;
  Part touched;
};
/// Which sides of the box mirror what is near them, and along which axes it repeats itself: side by side as Gas::edges.
struct BoxImages {
  std::array<bool, 6> mirror{};
  std::array<bool, 3> repeat{};
};
/// Solid fraction of a node that two bodies share; 0 of others.
inline double shared_fraction(const BodyNodes& nodes, std::size_t n) {
  constexpr double least_share = 0.2;  // of the second: the smear of a neighbour is not its body
  return !nodes.second_share.empty() && nodes.second_share[n] > least_share ? nodes.fraction[n] : 0.0;
}
/// The two bodies with the largest parts of such a node, the lower number first.
inline std::pair<int, int> sharing_bodies(const BodyNodes& nodes, std::size_t n) {
  return {std::min(nodes.body[n], nodes.other[n]), std::max(nodes.body[n], nodes.other[n])};
}
void put_on_nodes(const Window& window, const Cells& cells, const BoxImages& images, std::span<const BodyPoints> bodies,
                  BodyNodes& nodes);
/// The gas around the contour where the depth below the surface is zero.
void find_open_space(const Window& window, const Cells& cells, const BodyNodes& nodes, OpenSpace& space);

/// A cell in which a wall is, or was, during a step.
struct CutCell {
  std::size_t cell;
  Vector wall;      // m^2, B: area of the wall, from the gas to the solid
  double growth;    // m^3, of its gas
  Vector velocity;  // of the wall, m/s
  int body;
};
/// The step from one open space to the next.
struct CutCells {
  std::array<std::vector<double>, 3> area;    // m^2, open on average; none where there is gas on neither side
  std::array<std::vector<double>, 3> smooth;  // 1 where slopes along an axis may be taken, 0 elsewhere
  std::vector<CutCell> cut;
  std::vector<std::uint8_t> is_cut;
  Part touched;
};
void find_cut_cells(const Window& window, const Cells& cells, const OpenSpace& before, const OpenSpace& after,
                    const BodyNodes& nodes, CutCells& step);

}  // namespace brisance::simulator::gas
