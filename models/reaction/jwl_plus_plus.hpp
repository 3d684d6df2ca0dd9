#pragma once

#include "models/reaction/arguments.hpp"

namespace brisance::reaction {

struct JwlPlusPlus {
  static constexpr std::string_view name = "jwl_plus_plus";
  static constexpr std::string_view equation = "dF/dt = G (p/p0)^b (1 - F) where p > p_threshold, else 0";
  static constexpr std::string_view source =
      "Souers, Anderson, Mercer, McGuire & Vitello, Propellants Explos. Pyrotech. 25 (2000) 54-58. p0 = 1 Pa gives G the "
      "published number in 1/(s Pa^b).";
  static constexpr Kind kind = Kind::bulk;

  double G, b, reference_pressure, pressure_threshold, heat_of_reaction;

  static constexpr auto parameters =
      std::tuple{Parameter{"G", &JwlPlusPlus::G, Unit::per_s, "rate of the unburned fraction at p0", positive},
                 Parameter{"b", &JwlPlusPlus::b, Unit::one, "exponent of the pressure", Interval{0.0, 5.0}},
                 Parameter{"reference_pressure", &JwlPlusPlus::reference_pressure, Unit::Pa, "p0", positive, 1.0},
                 Parameter{"pressure_threshold", &JwlPlusPlus::pressure_threshold, Unit::Pa, "pressure above which it burns",
                           non_negative},
                 Parameter{"heat_of_reaction", &JwlPlusPlus::heat_of_reaction, Unit::J_per_kg,
                           "Q = E0/rho0, heat set free per burned mass", non_negative}};

  double heat() const { return heat_of_reaction; }

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real rate = G * pow(max(at.pressure * (1.0 / reference_pressure), Real(0.0)), b);
    return select(at.pressure > pressure_threshold, rate * (1.0 - clamp(at.burned_fraction, 0.0, 1.0)), Real(0.0));
  }
};

}  // namespace brisance::reaction
