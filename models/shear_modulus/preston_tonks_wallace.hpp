#pragma once

#include "models/shear_modulus/arguments.hpp"

namespace brisance::shear_modulus {

struct PrestonTonksWallace {
  static constexpr std::string_view name = "preston_tonks_wallace";
  static constexpr std::string_view equation = "mu = mu0 max(1 + A p/eta^(1/3), 1/2) max(1 - alpha T/Tm, 0),  eta = rho/rho0";
  static constexpr std::string_view source =
      "Preston, Tonks & Wallace, J. Appl. Phys. 93 (2003) 211-220, temperature dependence; pressure dependence of Steinberg, "
      "Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498-1504, its floor in tension our choice.";
  static constexpr bool needs_melting_temperature = true;

  double zero_temperature_value, A, alpha;

  using Self = PrestonTonksWallace;
  static constexpr auto parameters =
      std::tuple{Parameter{"zero_temperature_value", &Self::zero_temperature_value, Unit::Pa,
                           "mu0, modulus at 0 K and no pressure", positive},
                 Parameter{"A", &Self::A, Unit::per_Pa, "(dmu/dp)/mu0", non_negative},
                 Parameter{"alpha", &Self::alpha, Unit::one, "loss of modulus from 0 K to melting", fraction}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real softening = alpha * (clamp(at.temperature, 0.0, 1e7) / max(at.melting_temperature, Real(1.0)));
    return zero_temperature_value * pressure_factor(at, A) * max(1.0 - softening, Real(0.0));
  }
};

}  // namespace brisance::shear_modulus
