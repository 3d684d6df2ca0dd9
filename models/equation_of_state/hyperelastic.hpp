#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct Hyperelastic {
  static constexpr std::string_view name = "hyperelastic";
  static constexpr std::string_view equation =
      "p = (K/2) (rho/rho0 - rho0/rho), from the stored energy (K/2) ((J^2 - 1)/2 - ln J), J = rho0/rho";
  static constexpr std::string_view source = "Simo & Hughes, Computational Inelasticity (Springer 1998), section 9.2";
  static constexpr Caloric caloric = Caloric::barotropic;

  double reference_density, bulk_modulus, specific_heat, reference_temperature;

  static constexpr auto parameters = std::tuple{
      Parameter{"reference_density", &Hyperelastic::reference_density, Unit::kg_per_m3, "rho0, stress-free density", positive},
      Parameter{"bulk_modulus", &Hyperelastic::bulk_modulus, Unit::Pa, "K", positive},
      Parameter{"specific_heat", &Hyperelastic::specific_heat, Unit::J_per_kg_K, "cv, for the energy", positive},
      Parameter{"reference_temperature", &Hyperelastic::reference_temperature, Unit::K, "T0, where the energy counts from",
                non_negative}};

  DensityRange range() const { return {0.2 * reference_density, 5.0 * reference_density}; }
  double lowest_sound_speed() const { return 0.1 * std::sqrt(bulk_modulus / reference_density); }

  template <class Real>
  Real pressure(const Real& rho, const Real& /*e*/) const {
    const Real J = reference_density / rho;
    return 0.5 * bulk_modulus * (1.0 / J - J);
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    const Real J = reference_density / rho;
    const Real stored = 0.5 * bulk_modulus / reference_density * (0.5 * (J * J - 1.0) - log(J));
    return stored + specific_heat * (temperature - reference_temperature);
  }
};

}  // namespace brisance::equation_of_state
