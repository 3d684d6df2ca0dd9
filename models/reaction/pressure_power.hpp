#pragma once

#include "models/reaction/arguments.hpp"

namespace brisance::reaction {

struct PressurePower {
  static constexpr std::string_view name = "pressure_power";
  static constexpr std::string_view equation = "m'' = a (p/p0)^n where T > T_threshold and p > p_threshold, else 0";
  static constexpr std::string_view source =
      "Vieille 1893, in Corner, Theory of the Interior Ballistics of Guns (Wiley 1950). a = 0.75 kg/(m^2 s) at one atmosphere "
      "with n = 0.778 is HMX burning as a strand; exploding-container studies use 75.3, which stands for burning in cracks.";
  static constexpr Kind kind = Kind::surface;

  double coefficient, exponent, reference_pressure, pressure_threshold, temperature_threshold, heat_of_reaction;

  static constexpr auto parameters =
      std::tuple{Parameter{"coefficient", &PressurePower::coefficient, Unit::kg_per_m2_s, "a, burn rate at p0", positive},
                 Parameter{"exponent", &PressurePower::exponent, Unit::one, "n", Interval{0.0, 3.0}},
                 Parameter{"reference_pressure", &PressurePower::reference_pressure, Unit::Pa, "p0", positive},
                 Parameter{"pressure_threshold", &PressurePower::pressure_threshold, Unit::Pa, "pressure above which it burns",
                           non_negative},
                 Parameter{"temperature_threshold", &PressurePower::temperature_threshold, Unit::K,
                           "temperature of the solid above which it burns", non_negative},
                 Parameter{"heat_of_reaction", &PressurePower::heat_of_reaction, Unit::J_per_kg,
                           "Q, heat set free per burned mass", non_negative}};

  /// Heat set free per burned mass, J/kg.
  double heat() const { return heat_of_reaction; }

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real rate = coefficient * pow(max(at.pressure * (1.0 / reference_pressure), Real(0.0)), exponent);
    const Real hot = select(at.temperature > temperature_threshold, rate, Real(0.0));
    return select(at.pressure > pressure_threshold, hot, Real(0.0));
  }
};

}  // namespace brisance::reaction
