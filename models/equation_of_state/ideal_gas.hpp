#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct IdealGas {
  static constexpr std::string_view name = "ideal_gas";
  static constexpr std::string_view equation = "p = (gamma - 1) rho e,  e = cv T";
  static constexpr std::string_view source = "Clapeyron 1834; Joule 1845";
  static constexpr Caloric caloric = Caloric::complete;

  double gamma, specific_heat;

  static constexpr auto parameters =
      std::tuple{Parameter{"gamma", &IdealGas::gamma, Unit::one, "ratio of the specific heats", Interval{1.0, 10.0, true}},
                 Parameter{"specific_heat", &IdealGas::specific_heat, Unit::J_per_kg_K, "cv", positive}};

  DensityRange range() const { return {}; }
  double lowest_sound_speed() const { return 0.0; }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    return (gamma - 1.0) * rho * e;
  }

  template <class Real>
  Real energy(const Real& /*rho*/, const Real& temperature) const {
    return specific_heat * temperature;
  }

  template <class Real>
  Real density(const Real& p, const Real& temperature) const {
    return p / ((gamma - 1.0) * specific_heat * temperature);
  }
};

}  // namespace brisance::equation_of_state
