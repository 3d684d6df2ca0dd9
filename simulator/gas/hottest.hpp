#pragma once
// The hottest cells of the gas. Where several fluids meet, the hottest is often one that they share: a trace of a fluid in it
// may have a temperature that means nothing.

#include <optional>
#include <string>

#include "simulator/gas/fields.hpp"

namespace brisance::simulator::gas {

/// A temperature as the field of that name has it: of the fluid that takes most of its cell.
struct HotCell {
  double temperature = 0.0;  // K
  Vector place{};            // m, middle of the cell
  MostOf fluid{};
};
struct Hottest {
  HotCell of_all;
  std::optional<HotCell> of_one_fluid;  // of the cells that one fluid fills but for a thousandth, if there are any
};
/// Of the cells of this process.
Hottest hottest(const Gas& gas);
/// Whether the hottest cell is shared by fluids, and far hotter than all that are not.
bool is_doubtful(const Hottest& hottest);

}  // namespace brisance::simulator::gas
