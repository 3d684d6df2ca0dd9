#pragma once
// Melting temperature Tm (K). A law gives Tm = law(arguments), finite and > 0 for any finite arguments.
// To add a law: write its file, add its name to the list below, add its test.

#include <variant>

#include "models/melting/burakovsky_preston_silbar.hpp"
#include "models/melting/constant.hpp"
#include "models/melting/linear_in_pressure.hpp"
#include "models/melting/steinberg_cochran_guinan.hpp"

namespace brisance {

using Melting = std::variant<melting::Constant, melting::SteinbergCochranGuinan, melting::BurakovskyPrestonSilbar,
                             melting::LinearInPressure>;

}  // namespace brisance
