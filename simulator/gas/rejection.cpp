#include "simulator/gas/rejection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <span>

#include "simulator/gas/fields.hpp"

namespace brisance::simulator::gas {

std::string why_rejected(const Gas& gas) {
  std::optional<CellPlace> marked;  // the first that has not borne the last attempt
  for_each_cell(gas, [&](const CellPlace& at) {
    if (!marked && gas.marks.cell(at.block, 0, at.cell) > 0.0) marked = at;
  });
  if (!marked) {
    if (gas.implicit) return "the iteration for the pressures did not come to its end";
    return gas.bodies.empty() ? "more volume or energy would leave a cell of gas than it has"
                              : "gas would get from one side of a thin body to the other";
  }
  const Vector place = gas.cells.centre(marked->block, marked->cell);
  return fmt::format("more volume or energy would leave the cell of gas at ({:.6g}) m than it has; it holds {}",
                     fmt::join(std::span(place).first(static_cast<std::size_t>(gas.dimensions())), ", "),
                     in_words(most_of(gas, *marked)));
}

}  // namespace brisance::simulator::gas
