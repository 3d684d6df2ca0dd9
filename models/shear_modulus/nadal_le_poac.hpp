#pragma once

#include "models/shear_modulus/arguments.hpp"

namespace brisance::shear_modulus {

struct NadalLePoac {
  static constexpr std::string_view name = "nadal_le_poac";
  static constexpr std::string_view equation =
      "mu = [mu0 max(1 + A p/eta^(1/3), 1/2) x + rho k T/(C m)]/J,  J = 1 + exp(-(1 + 1/zeta)/(1 + zeta/x)),  x = 1 - T/Tm,  "
      "eta = rho/rho0, m = M atomic mass units";
  static constexpr std::string_view source =
      "Nadal & Le Poac, J. Appl. Phys. 93 (2003) 2472-2480. The floor in tension is our choice.";
  static constexpr bool needs_melting_temperature = true;

  double zero_temperature_value, A, zeta, C, atomic_mass;

  using Self = NadalLePoac;
  static constexpr auto parameters =
      std::tuple{Parameter{"zero_temperature_value", &Self::zero_temperature_value, Unit::Pa,
                           "mu0, modulus at 0 K and no pressure", positive},
                 Parameter{"A", &Self::A, Unit::per_Pa, "(dmu/dp)/mu0", non_negative},
                 Parameter{"zeta", &Self::zeta, Unit::one, "width of melting, relative to Tm", Interval{0.0, 1.0, true}},
                 Parameter{"C", &Self::C, Unit::one, "(6 pi^2)^(2/3) f^2/3 with the Lindemann constant f", positive},
                 Parameter{"atomic_mass", &Self::atomic_mass, Unit::one, "M, mass of an atom in atomic mass units", positive}};

  static constexpr double boltzmann = 1.380649e-23;              // J/K
  static constexpr double atomic_mass_unit = 1.66053906660e-27;  // kg

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real temperature = clamp(at.temperature, 0.0, 1e7);
    // The modulus has gone where x = -zeta; the last bit of the way there is left out, and so is the overflow of J.
    const Real x = max(1.0 - temperature / max(at.melting_temperature, Real(1.0)), Real(-0.999999 * zeta));
    const Real J = 1.0 + exp(min(-(1.0 + 1.0 / zeta) * x / (x + zeta), Real(600.0)));
    const Real lattice = zero_temperature_value * pressure_factor(at, A) * x;
    const Real vibration = (boltzmann / (C * atomic_mass * atomic_mass_unit)) * at.density * temperature;
    return max((lattice + vibration) / J, Real(0.0));
  }
};

}  // namespace brisance::shear_modulus
