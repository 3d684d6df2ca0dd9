#pragma once

#include "models/shear_modulus/arguments.hpp"

namespace brisance::shear_modulus {

struct VarshniChenGray {
  static constexpr std::string_view name = "varshni_chen_gray";
  static constexpr std::string_view equation = "mu = mu0 - D/(exp(T0/T) - 1)";
  static constexpr std::string_view source =
      "Varshni, Phys. Rev. B 2 (1970) 3952-3958; Chen & Gray, Metall. Mater. Trans. A 27 (1996) 2994-3006.";

  double zero_temperature_value, D, T0;

  static constexpr auto parameters = std::tuple{
      Parameter{"zero_temperature_value", &VarshniChenGray::zero_temperature_value, Unit::Pa, "mu0, modulus at 0 K", positive},
      Parameter{"D", &VarshniChenGray::D, Unit::Pa, "softening", non_negative},
      Parameter{"T0", &VarshniChenGray::T0, Unit::K, "temperature where softening sets in", positive}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    // T below T0/700 would overflow; the modulus there is mu0 to all digits.
    const Real ratio = T0 / max(at.temperature, Real(T0 / 700.0));
    return max(zero_temperature_value - D / expm1(ratio), Real(0.0));
  }
};

}  // namespace brisance::shear_modulus
