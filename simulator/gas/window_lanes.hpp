#pragma once
// Quantities in the cells of a window, eight cells at a time.

#include <algorithm>

#include "simulator/gas/gas.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {

using Column = StepFields::Column;

inline std::size_t offset(const Window& w, std::size_t axis) {
  return static_cast<std::size_t>(w.stride[axis]);
}
inline Lanes at(const Column& column, std::size_t n) {
  return Lanes::load(column.data() + n);
}
/// Which column of the content holds a quantity of a fluid.
inline std::size_t content_of(const Window& w, std::size_t fluid, int quantity) {
  return static_cast<std::size_t>(Content::of(w.dimensions, fluid, quantity));
}
/// Volumes of eight whole cells; before and after the window those of its ends.
inline Lanes whole_volumes(const Cells& cells, const Window& w, std::size_t n) {
  Lanes whole;
  for (int l = 0; l < 8; ++l) {
    const std::size_t cell = std::clamp(n + static_cast<std::size_t>(l), w.first, w.first + w.cells - 1);
    whole.set(l, whole_cell(cells, w.index(cell)[0]).volume);
  }
  return whole;
}
/// Calls f(n) for the first of every eight cells of the window.
template <class F>
void for_each_eight(const Window& w, F&& f) {
  constexpr std::size_t share = 128;
  const std::size_t eights = (w.cells + 7) / 8;
  parallel_for_blocks((eights + share - 1) / share, [&](std::size_t part) {
    const std::size_t end = std::min(eights, (part + 1) * share);
    for (std::size_t k = part * share; k < end; ++k) f(w.first + 8 * k);
  });
}

}  // namespace brisance::simulator::gas
