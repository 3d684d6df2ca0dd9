#pragma once

#include "models/equation_of_state/definitions.hpp"
#include "models/equation_of_state/expansion_branch.hpp"

namespace brisance::equation_of_state {

struct BirchMurnaghan {
  static constexpr std::string_view name = "birch_murnaghan";
  static constexpr std::string_view equation =
      "p = p0 + (3 K0/2) (u^7 - u^5) (1 + (3/4)(n - 4)(u^2 - 1)),  u = (rho/rho0)^(1/3); below rho0 p = p0 (rho/rho0)^(K0/p0)";
  static constexpr std::string_view source =
      "Birch, Phys. Rev. 71 (1947) 809-824, third order. The expanded side is continuous to the first derivative and keeps p > "
      "0.";
  static constexpr Caloric caloric = Caloric::barotropic;

  double reference_density, bulk_modulus, n, reference_pressure, specific_heat, reference_temperature;

  static constexpr auto parameters = std::tuple{
      Parameter{"reference_density", &BirchMurnaghan::reference_density, Unit::kg_per_m3, "rho0, density at p0", positive},
      Parameter{"bulk_modulus", &BirchMurnaghan::bulk_modulus, Unit::Pa, "K0, isothermal bulk modulus at rho0", positive},
      Parameter{"n", &BirchMurnaghan::n, Unit::one, "dK/dp at rho0; below 3 the law softens within its range",
                between(3.0, 20.0)},
      Parameter{"reference_pressure", &BirchMurnaghan::reference_pressure, Unit::Pa, "p0, pressure at rho0", positive},
      Parameter{"specific_heat", &BirchMurnaghan::specific_heat, Unit::J_per_kg_K, "cv, for the energy", positive},
      Parameter{"reference_temperature", &BirchMurnaghan::reference_temperature, Unit::K, "T0, where the energy counts from",
                non_negative}};

  ExpansionBranch expansion() const { return {reference_density, bulk_modulus, reference_pressure}; }
  DensityRange range() const { return {0.2 * reference_density, 2.0 * reference_density}; }
  double lowest_sound_speed() const { return 0.1 * std::sqrt(bulk_modulus / reference_density); }

  template <class Real>
  Real pressure(const Real& rho, const Real& /*e*/) const {
    const Real log_compression = log(rho * (1.0 / reference_density));
    const Real h = max(log_compression, Real(0.0));
    const Real f = expm1(2.0 / 3.0 * h);  // u^2 - 1
    const Real compressed = reference_pressure + 1.5 * bulk_modulus * exp(5.0 / 3.0 * h) * f * (1.0 + 0.75 * (n - 4.0) * f);
    return select(log_compression < 0.0, expansion().pressure(log_compression), compressed);
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    const Real log_compression = log(rho * (1.0 / reference_density));
    const Real h = max(log_compression, Real(0.0));
    const Real f = expm1(2.0 / 3.0 * h);
    const Real strain_energy = 1.125 * bulk_modulus * f * f * (1.0 + 0.5 * (n - 4.0) * f);
    const Real compressed = strain_energy - reference_pressure * expm1(-h);
    return compressed * (1.0 / reference_density) + expansion().energy(log_compression) +
           specific_heat * (temperature - reference_temperature);
  }
};

}  // namespace brisance::equation_of_state
