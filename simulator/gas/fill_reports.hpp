#pragma once
// What the fills of a case make, for whoever wrote them: a charge of the wrong density or of too few cells runs all the same.

#include <string>
#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

struct FillReport {
  std::string name;   // "fill 1, products"
  std::string words;  // its mass and volume with their units, its state, how many cells are across it
};
/// Of each fill of a gas that has been set up from the case, what later ones and bodies leave of it.
std::vector<FillReport> fill_reports(const Case& c, const Gas& gas);

/// A sentence for each fill that few cells are across.
std::vector<std::string> warnings_of_fills(const Case& c);

}  // namespace brisance::simulator::gas
