#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct StiffenedGas {
  static constexpr std::string_view name = "stiffened_gas";
  static constexpr std::string_view equation = "p = (gamma - 1) rho e - gamma pi,  e = cv T + pi/rho";
  static constexpr std::string_view source =
      "Harlow & Amsden, LA-4700 (1971); Menikoff & Plohr, Rev. Mod. Phys. 61 (1989) 75-130";
  static constexpr Caloric caloric = Caloric::complete;

  double gamma, stiffening_pressure, specific_heat;

  static constexpr auto parameters =
      std::tuple{Parameter{"gamma", &StiffenedGas::gamma, Unit::one, "exponent of the isentropes", Interval{1.0, 20.0, true}},
                 Parameter{"stiffening_pressure", &StiffenedGas::stiffening_pressure, Unit::Pa,
                           "pi, cohesion: the lowest pressure is -pi", non_negative},
                 Parameter{"specific_heat", &StiffenedGas::specific_heat, Unit::J_per_kg_K, "cv", positive}};

  DensityRange range() const { return {}; }
  double lowest_sound_speed() const { return 0.0; }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    return (gamma - 1.0) * rho * e - gamma * stiffening_pressure;
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    return specific_heat * temperature + stiffening_pressure / rho;
  }

  template <class Real>
  Real density(const Real& p, const Real& temperature) const {
    return (p + stiffening_pressure) / ((gamma - 1.0) * specific_heat * temperature);
  }
};

}  // namespace brisance::equation_of_state
