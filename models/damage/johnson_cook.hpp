#pragma once

#include "models/damage/arguments.hpp"

namespace brisance::damage {

struct JohnsonCook {
  static constexpr std::string_view name = "johnson_cook";
  static constexpr std::string_view equation =
      "dD/dep = 1/ef,  ef = max([D1 + D2 exp(D3 t)] [1 + D4 ln max(r/r0, 1)] [1 + D5 theta], ef_min),  t = sm/q within "
      "[-1.5, 1.5],  theta = clamp((T - T0)/(Tm - T0), 0, 1); the rate bracket counts no less than 0";
  static constexpr std::string_view source =
      "Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31-48. The bounds on the triaxiality replace the straight line to the spall "
      "stress beyond 1.5; the least fracture strain is needed because several published sets are negative at high triaxiality.";
  static constexpr bool needs_melting_temperature = true;

  double D1, D2, D3, D4, D5, reference_strain_rate, reference_temperature, min_fracture_strain;

  static constexpr auto parameters = std::tuple{
      Parameter{"D1", &JohnsonCook::D1, Unit::one, "fracture strain at the highest triaxiality"},
      Parameter{"D2", &JohnsonCook::D2, Unit::one, "further fracture strain at no triaxiality", non_negative},
      Parameter{"D3", &JohnsonCook::D3, Unit::one, "exponent of the triaxiality (tension positive)", between(-10.0, 0.0)},
      Parameter{"D4", &JohnsonCook::D4, Unit::one, "strain-rate coefficient", between(-1.0, 1.0)},
      Parameter{"D5", &JohnsonCook::D5, Unit::one, "temperature coefficient", between(-1.0, 10.0)},
      Parameter{"reference_strain_rate", &JohnsonCook::reference_strain_rate, Unit::per_s,
                "r0, rate at and below which the rate has no effect", positive},
      Parameter{"reference_temperature", &JohnsonCook::reference_temperature, Unit::K,
                "T0, temperature at and below which heat has no effect", non_negative},
      Parameter{"min_fracture_strain", &JohnsonCook::min_fracture_strain, Unit::one, "ef_min, least fracture strain", positive,
                0.01}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real ductility = D1 + D2 * exp(D3 * clamp(at.triaxiality, -1.5, 1.5));
    const Real rate = max(at.plastic_strain_rate * (1.0 / reference_strain_rate), Real(1.0));
    const Real theta = (at.temperature - reference_temperature) / (at.melting_temperature - reference_temperature);
    const Real rate_factor = max(1.0 + D4 * log(rate), Real(0.0));  // two negative factors must not make a tough metal
    const Real fracture_strain = ductility * rate_factor * (1.0 + D5 * clamp(theta, 0.0, 1.0));
    return max(fracture_strain, Real(min_fracture_strain));
  }
};

}  // namespace brisance::damage
