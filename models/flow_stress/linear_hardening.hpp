#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct LinearHardening {
  static constexpr std::string_view name = "linear_hardening";
  static constexpr std::string_view equation = "Y = max(Y0 + H ep, 0)";
  static constexpr std::string_view source =
      "Textbook law of rate-independent plasticity, e.g. Hill, The Mathematical Theory of "
      "Plasticity (1950): the one with closed-form solutions.";

  double yield_stress, hardening_modulus;

  static constexpr auto parameters =
      std::tuple{Parameter{"yield_stress", &LinearHardening::yield_stress, Unit::Pa, "Y0, initial flow stress", non_negative},
                 Parameter{"hardening_modulus", &LinearHardening::hardening_modulus, Unit::Pa,
                           "H, slope dY/dep; 0 is perfect plasticity, negative softens"}};

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    return max(yield_stress + hardening_modulus * bounded(state, 0.0).plastic_strain, Real(0.0));
  }
};

}  // namespace brisance::flow_stress
