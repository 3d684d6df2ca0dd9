#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct Logarithmic {
  static constexpr std::string_view name = "logarithmic";
  static constexpr std::string_view equation = "p = K ln(rho/rho0)";
  static constexpr std::string_view source = "Hencky, Z. Tech. Phys. 9 (1928) 215-220";
  static constexpr Caloric caloric = Caloric::barotropic;

  double reference_density, bulk_modulus, specific_heat, reference_temperature;

  static constexpr auto parameters = std::tuple{
      Parameter{"reference_density", &Logarithmic::reference_density, Unit::kg_per_m3, "rho0, stress-free density", positive},
      Parameter{"bulk_modulus", &Logarithmic::bulk_modulus, Unit::Pa, "K", positive},
      Parameter{"specific_heat", &Logarithmic::specific_heat, Unit::J_per_kg_K, "cv, for the energy", positive},
      Parameter{"reference_temperature", &Logarithmic::reference_temperature, Unit::K, "T0, where the energy counts from",
                non_negative}};

  DensityRange range() const { return {0.2 * reference_density, 5.0 * reference_density}; }
  double lowest_sound_speed() const { return 0.1 * std::sqrt(bulk_modulus / reference_density); }

  template <class Real>
  Real pressure(const Real& rho, const Real& /*e*/) const {
    return bulk_modulus * log(rho * (1.0 / reference_density));
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    const Real J = reference_density / rho;
    const Real cold = bulk_modulus / reference_density * (1.0 - J * (1.0 - log(J)));
    return cold + specific_heat * (temperature - reference_temperature);
  }
};

}  // namespace brisance::equation_of_state
