#pragma once

#include "models/equation_of_state/logarithmic.hpp"

namespace brisance::equation_of_state {

struct Hypoelastic {
  static constexpr std::string_view name = "hypoelastic";
  static constexpr std::string_view equation =
      "dp/dt = -K tr D, that is p1 = p0 + K ln(rho1/rho0) over a step from rho0 to rho1";
  static constexpr std::string_view source =
      "Truesdell, J. Rational Mech. Anal. 4 (1955) 83-133. The pressure depends on where the step began, so a stress that was "
      "released stays released.";
  static constexpr Caloric caloric = Caloric::incremental;

  double reference_density, bulk_modulus, specific_heat, reference_temperature;

  static constexpr auto parameters = std::tuple{
      Parameter{"reference_density", &Hypoelastic::reference_density, Unit::kg_per_m3, "rho0, stress-free density", positive},
      Parameter{"bulk_modulus", &Hypoelastic::bulk_modulus, Unit::Pa, "K", positive},
      Parameter{"specific_heat", &Hypoelastic::specific_heat, Unit::J_per_kg_K, "cv, for the energy", positive},
      Parameter{"reference_temperature", &Hypoelastic::reference_temperature, Unit::K, "T0, where the energy counts from",
                non_negative}};

  /// The law whose increments this one takes.
  Logarithmic potential() const { return {reference_density, bulk_modulus, specific_heat, reference_temperature}; }

  DensityRange range() const { return potential().range(); }
  double lowest_sound_speed() const { return potential().lowest_sound_speed(); }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    return potential().pressure(rho, e);
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    return potential().energy(rho, temperature);
  }
};

}  // namespace brisance::equation_of_state
