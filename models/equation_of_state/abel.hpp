#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct Abel {
  static constexpr std::string_view name = "abel";
  static constexpr std::string_view equation =
      "p = (gamma - 1) rho e/(1 - b rho),  e = cv T; beyond b rho = 0.98 along the tangent";
  static constexpr std::string_view source = "Noble & Abel, Phil. Trans. R. Soc. 165 (1875) 49-155";
  static constexpr Caloric caloric = Caloric::complete;

  double gamma, specific_heat, covolume;

  static constexpr auto parameters = std::tuple{
      Parameter{"gamma", &Abel::gamma, Unit::one, "ratio of the specific heats of the dilute gas", Interval{1.0, 10.0, true}},
      Parameter{"specific_heat", &Abel::specific_heat, Unit::J_per_kg_K, "cv", positive},
      Parameter{"covolume", &Abel::covolume, Unit::m3_per_kg, "b, volume of the molecules", positive}};

  DensityRange range() const { return {0.0, 0.98 / covolume}; }
  double lowest_sound_speed() const { return 0.0; }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    const Real y = min(rho, Real(range().highest));
    const Real d = 1.0 / (1.0 - covolume * y);
    return (gamma - 1.0) * e * d * (y + d * (rho - y));
  }

  template <class Real>
  Real energy(const Real& /*rho*/, const Real& temperature) const {
    return specific_heat * temperature;
  }
};

}  // namespace brisance::equation_of_state
