#pragma once

#include "models/shear_modulus/arguments.hpp"

namespace brisance::shear_modulus {

struct SteinbergCochranGuinan {
  static constexpr std::string_view name = "steinberg_cochran_guinan";
  static constexpr std::string_view equation = "mu = mu0 [max(1 + A p/eta^(1/3), 1/2) - B (T - Tr)],  eta = rho/rho0";
  static constexpr std::string_view source =
      "Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498-1504. The floor in tension is our choice.";

  double ambient_value, A, B, reference_temperature;

  using Self = SteinbergCochranGuinan;
  static constexpr auto parameters = std::tuple{
      Parameter{"ambient_value", &Self::ambient_value, Unit::Pa, "mu0, modulus at Tr and no pressure", positive},
      Parameter{"A", &Self::A, Unit::per_Pa, "(dmu/dp)/mu0", non_negative},
      Parameter{"B", &Self::B, Unit::per_K, "-(dmu/dT)/mu0", non_negative},
      Parameter{"reference_temperature", &Self::reference_temperature, Unit::K, "Tr, 300 K in the source", positive, 300.0}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real softening = B * (clamp(at.temperature, 0.0, 1e7) - reference_temperature);
    return max(ambient_value * (pressure_factor(at, A) - softening), Real(0.0));
  }
};

}  // namespace brisance::shear_modulus
