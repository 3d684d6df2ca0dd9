#pragma once

#include "models/failure/arguments.hpp"

namespace brisance::failure {

struct TensileLimit {
  static constexpr std::string_view name = "tensile_limit";
  static constexpr std::string_view equation = "sm >= sm_max";
  static constexpr std::string_view source =
      "spall by a limit on the mean tension: Grady, J. Mech. Phys. Solids 36 (1988) 353-384";
  static constexpr FailureCause cause = FailureCause::tensile_limit;

  double mean_stress;

  static constexpr auto parameters =
      std::tuple{Parameter{"mean_stress", &TensileLimit::mean_stress, Unit::Pa, "sm_max, mean tension at failure", positive}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    return at.mean_stress * (1.0 / mean_stress) - 1.0;
  }
};

}  // namespace brisance::failure
