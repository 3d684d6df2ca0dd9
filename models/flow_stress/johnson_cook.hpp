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

  /// The law at one temperature.
  template <class Real>
  struct Isothermal {
    const JohnsonCook& law;
    Real softening;  // zero where molten

    template <class Number>
    Number operator()(const Arguments<Number>& state) const {
      const auto at = bounded(state, 0.0);
      const Number hardening = law.A + law.B * pow(at.plastic_strain, law.n);
      const Number rate = max(at.plastic_strain_rate * (1.0 / law.reference_strain_rate), Number(1.0));
      return max(hardening * (1.0 + law.C * log(rate)) * Number(softening), Number(0.0));
    }
  };
  template <class Real>
  Isothermal<Real> isothermal(const Arguments<Real>& state) const {
    const auto at = bounded(state, 0.0);
    const Real melting_range = max(at.melting_temperature - reference_temperature, Real(1e-6));
    const Real theta = (at.temperature - reference_temperature) / melting_range;
    return {*this, if_solid(state, Real(1.0 - pow(clamp(theta, 0.0, 1.0), m)))};
  }
  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    return isothermal(state)(state);
  }
};

}  // namespace brisance::flow_stress
