#pragma once

#include "models/equation_of_state/definitions.hpp"
#include "models/equation_of_state/expansion_branch.hpp"

namespace brisance::equation_of_state {

struct Murnaghan {
  static constexpr std::string_view name = "murnaghan";
  static constexpr std::string_view equation = "p = p0 + (K0/n) ((rho/rho0)^n - 1); below rho0 p = p0 (rho/rho0)^(K0/p0)";
  static constexpr std::string_view source =
      "Murnaghan, Proc. Natl. Acad. Sci. 30 (1944) 244-247. The expanded side is continuous to the first derivative and keeps "
      "p > 0.";
  static constexpr Caloric caloric = Caloric::barotropic;

  double reference_density, bulk_modulus, n, reference_pressure, specific_heat, reference_temperature;

  static constexpr auto parameters = std::tuple{
      Parameter{"reference_density", &Murnaghan::reference_density, Unit::kg_per_m3, "rho0, density at p0", positive},
      Parameter{"bulk_modulus", &Murnaghan::bulk_modulus, Unit::Pa, "K0, isothermal bulk modulus at rho0", positive},
      Parameter{"n", &Murnaghan::n, Unit::one, "dK/dp", Interval{1.0, 20.0, true}},
      Parameter{"reference_pressure", &Murnaghan::reference_pressure, Unit::Pa, "p0, pressure at rho0", positive},
      Parameter{"specific_heat", &Murnaghan::specific_heat, Unit::J_per_kg_K, "cv, for the energy", positive},
      Parameter{"reference_temperature", &Murnaghan::reference_temperature, Unit::K, "T0, where the energy counts from",
                non_negative}};

  ExpansionBranch expansion() const { return {reference_density, bulk_modulus, reference_pressure}; }
  DensityRange range() const { return {0.2 * reference_density, 3.0 * reference_density}; }
  double lowest_sound_speed() const { return 0.1 * std::sqrt(bulk_modulus / reference_density); }

  template <class Real>
  Real pressure(const Real& rho, const Real& /*e*/) const {
    const Real log_compression = log(rho * (1.0 / reference_density));
    const Real compressed = reference_pressure + bulk_modulus / n * expm1(n * max(log_compression, Real(0.0)));
    return select(log_compression < 0.0, expansion().pressure(log_compression), compressed);
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    const Real log_compression = log(rho * (1.0 / reference_density));
    const Real h = max(log_compression, Real(0.0));
    const Real compressed =
        (bulk_modulus / n - reference_pressure) * expm1(-h) + bulk_modulus / (n * (n - 1.0)) * expm1((n - 1.0) * h);
    return compressed * (1.0 / reference_density) + expansion().energy(log_compression) +
           specific_heat * (temperature - reference_temperature);
  }
};

}  // namespace brisance::equation_of_state
