#pragma once
// Specific heat cp (J/(kg K)). A law gives cp = law(temperature in K), finite and > 0 for any finite temperature.
// To add a law: write its file, add its name to the list below, add its test.

#include <variant>

#include "models/specific_heat/constant.hpp"
#include "models/specific_heat/copper.hpp"
#include "models/specific_heat/polynomial.hpp"
#include "models/specific_heat/steel_goto.hpp"
#include "models/specific_heat/steel_lambda.hpp"

namespace brisance {

using SpecificHeat = std::variant<specific_heat::Constant, specific_heat::Polynomial, specific_heat::SteelLambda,
                                  specific_heat::SteelGoto, specific_heat::Copper>;

}  // namespace brisance
