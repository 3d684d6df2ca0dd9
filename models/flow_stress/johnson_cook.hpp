#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct JohnsonCook {
  static constexpr std::string_view name = "johnson_cook";
  static constexpr std::string_view equation =
      "Y = (A + B ep^n) (1 + C ln max(r/r0, 1)) (1 - theta^m),  theta = clamp((T - T0)/(Tm - T0), 0, 1)";
  static constexpr std::string_view source =
      "Johnson & Cook, Proc. 7th Int. Symp. Ballistics (1983) 541-547. Rates below r0 and temperatures below T0 leave the "
      "factor at one: our choice, continuous at both ends.";
  static constexpr bool needs_melting_temperature = true;

  double A, B, n, C, m, reference_strain_rate, reference_temperature;

  static constexpr auto parameters =
      std::tuple{Parameter{"A", &JohnsonCook::A, Unit::Pa, "initial flow stress", positive},
                 Parameter{"B", &JohnsonCook::B, Unit::Pa, "hardening modulus", non_negative},
                 Parameter{"n", &JohnsonCook::n, Unit::one, "hardening exponent", between(0.0, 2.0)},
                 Parameter{"C", &JohnsonCook::C, Unit::one, "strain-rate coefficient", between(0.0, 1.0)},
                 Parameter{"m", &JohnsonCook::m, Unit::one, "thermal softening exponent", Interval{0.0, 10.0, true}},
                 Parameter{"reference_strain_rate", &JohnsonCook::reference_strain_rate, Unit::per_s,
                           "r0, rate at which A, B, n hold", positive},
                 Parameter{"reference_temperature", &JohnsonCook::reference_temperature, Unit::K,
                           "T0, temperature at and below which nothing softens", non_negative}};

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    const auto at = bounded(state, 0.0);
    const Real hardening = A + B * pow(at.plastic_strain, n);
    const Real rate = max(at.plastic_strain_rate * (1.0 / reference_strain_rate), Real(1.0));
    const Real melting_range = max(at.melting_temperature - reference_temperature, Real(1e-6));
    const Real theta = (at.temperature - reference_temperature) / melting_range;
    const Real softening = 1.0 - pow(clamp(theta, 0.0, 1.0), m);
    return if_solid(state, hardening * (1.0 + C * log(rate)) * softening);
  }
};

}  // namespace brisance::flow_stress
