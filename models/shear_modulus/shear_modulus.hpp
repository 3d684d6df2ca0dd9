#pragma once
// Shear modulus mu (Pa). A law gives mu = law(arguments) below melting, finite and >= 0; the update makes it 0 above.
// To add a law: write its file, add its name to the list below, add its test.

#include <variant>

#include "models/shear_modulus/constant.hpp"
#include "models/shear_modulus/nadal_le_poac.hpp"
#include "models/shear_modulus/preston_tonks_wallace.hpp"
#include "models/shear_modulus/steinberg_cochran_guinan.hpp"
#include "models/shear_modulus/varshni_chen_gray.hpp"

namespace brisance {

using ShearModulus =
    std::variant<shear_modulus::Constant, shear_modulus::VarshniChenGray, shear_modulus::SteinbergCochranGuinan,
                 shear_modulus::NadalLePoac, shear_modulus::PrestonTonksWallace>;

}  // namespace brisance
