#pragma once
// How thin a shape is at its thinnest, for warnings.

#include <optional>

#include "simulator/config.hpp"

namespace brisance::simulator {

struct ThinPart {
  double thickness;  // m, of the largest ball that fits there, to a quarter of a cell
  Vector place;      // where its centre is
};

/// The thinnest part of a body's shape that no ball of diameter `least` (m) fits into or reaches. Corners do not count; what
/// planes of symmetry and the axis mirror does. Looks at points a quarter of a cell apart (more for very many).
std::optional<ThinPart> thinnest_part(const Case& c, const Shape& shape, double least);

}  // namespace brisance::simulator
