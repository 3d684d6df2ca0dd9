#pragma once
// Damage D: 0 in the new material, 1 when its ductility is used up. A law gives the plastic strain to fracture in the present
// conditions, law(arguments) > 0 and finite for any finite arguments; the damage of a path is the sum of d(plastic strain) over
// it.

#include <variant>

#include "models/damage/hancock_mackenzie.hpp"
#include "models/damage/johnson_cook.hpp"

namespace brisance {

using Damage = std::variant<damage::JohnsonCook, damage::HancockMackenzie>;

}  // namespace brisance
