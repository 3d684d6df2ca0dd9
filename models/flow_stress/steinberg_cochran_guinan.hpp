#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct SteinbergCochranGuinan {
  static constexpr std::string_view name = "steinberg_cochran_guinan";
  static constexpr std::string_view equation = "Y = min(sigma0 (1 + beta (ep + ei))^n, Ymax) mu(p, T)/mu0";
  static constexpr std::string_view source =
      "Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498-1504. For rates above about 1e5/s, where the rate no longer "
      "matters.";
  static constexpr bool needs_melting_temperature = true;

  double initial_yield_stress, beta, n, initial_plastic_strain, largest_yield_stress, reference_shear_modulus;

  static constexpr auto parameters =
      std::tuple{Parameter{"initial_yield_stress", &SteinbergCochranGuinan::initial_yield_stress, Unit::Pa,
                           "sigma0, Y at ambient", positive},
                 Parameter{"beta", &SteinbergCochranGuinan::beta, Unit::one, "hardening coefficient", non_negative},
                 Parameter{"n", &SteinbergCochranGuinan::n, Unit::one, "hardening exponent", between(0.0, 2.0)},
                 Parameter{"initial_plastic_strain", &SteinbergCochranGuinan::initial_plastic_strain, Unit::one,
                           "ei, plastic strain of earlier working", non_negative},
                 Parameter{"largest_yield_stress", &SteinbergCochranGuinan::largest_yield_stress, Unit::Pa,
                           "Ymax, of hardening at ambient", positive},
                 Parameter{"reference_shear_modulus", &SteinbergCochranGuinan::reference_shear_modulus, Unit::Pa,
                           "mu0, shear modulus at ambient", positive}};

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    const auto at = bounded(state, 0.0);
    const Real hardened = initial_yield_stress * pow(1.0 + beta * (at.plastic_strain + initial_plastic_strain), n);
    return if_solid(state, min(hardened, Real(largest_yield_stress)) * (at.shear_modulus * (1.0 / reference_shear_modulus)));
  }
};

}  // namespace brisance::flow_stress
