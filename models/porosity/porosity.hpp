#pragma once
// Porosity f: void volume over total volume. Growth follows from the plastic volume strain (return mapping); a law adds
// nucleation by the porosity nucleated so far at a matrix plastic strain: law.nucleated(plastic_strain).

#include <variant>

#include "models/porosity/chu_needleman.hpp"
#include "models/porosity/growth.hpp"

namespace brisance {

using Porosity = std::variant<porosity::Growth, porosity::ChuNeedleman>;

}  // namespace brisance
