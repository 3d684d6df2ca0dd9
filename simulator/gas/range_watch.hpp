#pragma once
// A watch on the densities that the equations of state of the gas declare (DensityRange). Beyond them a law gives numbers all
// the same; that they have been used is counted and told.

#include <optional>
#include <string>
#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Looks at all own cells: counts, for each fluid, those in which it is denser or thinner than its law declares, and keeps the
/// worst. A fluid that takes less than a thousandth of a cell is passed over: it has no weight, and its density is mostly
/// rounding.
void watch_ranges(Gas& gas);

/// What the watches of all ranks have seen of each fluid; nothing of those that stayed within.
struct RangeReport {
  std::string fluid;
  equation_of_state::DensityRange range;
  OutsideRange outside;
};
std::vector<RangeReport> range_reports(const Gas& gas, Domain& domain);
/// The same in a sentence.
std::string in_words(const RangeReport& report, int dimensions);

}  // namespace brisance::simulator::gas
