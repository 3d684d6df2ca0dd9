#pragma once
// Yield: the surface in stress space that the flow stress Y of the matrix scales. Plastic flow is normal to it.

#include <variant>

#include "models/yield/gurson_tvergaard_needleman.hpp"
#include "models/yield/von_mises.hpp"

namespace brisance {

using Yield = std::variant<yield::VonMises, yield::GursonTvergaardNeedleman>;

}  // namespace brisance
