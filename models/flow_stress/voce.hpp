#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct Voce {
  static constexpr std::string_view name = "voce";
  static constexpr std::string_view equation = "Y = Y0 + Q (1 - exp(-b ep))";
  static constexpr std::string_view source = "Voce, J. Inst. Metals 74 (1948) 537-562.";

  double yield_stress, saturation_increment, saturation_exponent;

  static constexpr auto parameters =
      std::tuple{Parameter{"yield_stress", &Voce::yield_stress, Unit::Pa, "Y0, initial flow stress", non_negative},
                 Parameter{"saturation_increment", &Voce::saturation_increment, Unit::Pa, "Q, what hardening adds in the end",
                           non_negative},
                 Parameter{"saturation_exponent", &Voce::saturation_exponent, Unit::one,
                           "b, inverse of the strain over which it saturates; the initial slope is b Q", non_negative}};

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    return yield_stress - saturation_increment * expm1(-saturation_exponent * bounded(state, 0.0).plastic_strain);
  }
};

}  // namespace brisance::flow_stress
