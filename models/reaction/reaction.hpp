#pragma once
// Burn of an explosive. A law is a struct with name, equation, source, parameters and
//   rate = law(arguments)     kg/(m^2 s) for Kind::surface, 1/s for Kind::bulk; finite and >= 0
//   Law::kind                 which of the two
//   law.heat()                J/kg, set free per burned mass
// To add a law: write its file, add its name to the list below, add its test.

#include <variant>

#include "models/reaction/jwl_plus_plus.hpp"
#include "models/reaction/pressure_power.hpp"
#include "models/reaction/program_burn.hpp"
#include "models/reaction/ward_son_brewster.hpp"

namespace brisance {

using Reaction = std::variant<reaction::PressurePower, reaction::WardSonBrewster, reaction::JwlPlusPlus, reaction::ProgramBurn>;

}  // namespace brisance
