#pragma once
// The outline of the bodies in the gas, for pictures: the contour that cuts the cells (contour.hpp).

#include <array>
#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

struct Outline {
  std::vector<std::vector<Vector>> solid;  // m, polygons: what the bodies fill of each cell
  /// m, pieces of the surface, and of the sides of the box that the bodies reach through; not of the axis.
  std::vector<std::array<Vector, 2>> contour;
};

/// In the plane of x and y of a gas in two dimensions, or halfway through the layer of cells `layer` along z, within the box.
/// Looks at the cells of this process.
Outline outline_of(const Gas& gas, int layer);

}  // namespace brisance::simulator::gas
