#pragma once

#include "models/melting/arguments.hpp"

namespace brisance::melting {

struct BurakovskyPrestonSilbar {
  static constexpr std::string_view name = "burakovsky_preston_silbar";
  static constexpr std::string_view equation =
      "Tm = Tm0 [1/h + mu0' p/(mu0 h^(4/3))],  h = (1 + K0' p/K0)^(1/K0'),  "
      "Tm0 = kappa lambda mu0 v/(8 pi k ln(z - 1)) ln(alpha^2/(4 b^2 rho_c)),  v = a^3/(atoms per cell)";
  static constexpr std::string_view source =
      "Burakovsky, Preston & Silbar, J. Appl. Phys. 88 (2000) 6294-6301: melting by dislocations. Tension beyond p = -0.9 "
      "K0/K0' counts as that.";

  double bulk_modulus, bulk_modulus_slope, shear_modulus, shear_modulus_slope;
  double kappa, coordination_number, b2_rho_c, alpha, lambda, lattice_parameter, atoms_per_cell;

  using Self = BurakovskyPrestonSilbar;
  static constexpr auto parameters = std::tuple{
      Parameter{"bulk_modulus", &Self::bulk_modulus, Unit::Pa, "K0", positive},
      Parameter{"bulk_modulus_slope", &Self::bulk_modulus_slope, Unit::one, "K0' = dK/dp", positive},
      Parameter{"shear_modulus", &Self::shear_modulus, Unit::Pa, "mu0", positive},
      Parameter{"shear_modulus_slope", &Self::shear_modulus_slope, Unit::one, "mu0' = dmu/dp", non_negative},
      Parameter{"kappa", &Self::kappa, Unit::one, "anisotropy of the energy of a dislocation", positive},
      Parameter{"coordination_number", &Self::coordination_number, Unit::one, "z, nearest neighbours: 8 bcc, 12 fcc",
                Interval{.lower = 2.0, .lower_open = true}},
      Parameter{"b2_rho_c", &Self::b2_rho_c, Unit::one, "b^2 rho_c, critical density of dislocations times b^2", positive},
      Parameter{"alpha", &Self::alpha, Unit::one, "core radius parameter", positive},
      Parameter{"lambda", &Self::lambda, Unit::one, "b^3/v", positive},
      Parameter{"lattice_parameter", &Self::lattice_parameter, Unit::m, "a, edge of the unit cell", positive},
      Parameter{"atoms_per_cell", &Self::atoms_per_cell, Unit::one, "2 bcc, 4 fcc", positive}};

  static constexpr double boltzmann = 1.380649e-23;  // J/K
  static constexpr double pi = 3.14159265358979323846;

  double ambient_value() const {
    const double volume = lattice_parameter * lattice_parameter * lattice_parameter / atoms_per_cell;
    return kappa * lambda * shear_modulus * volume / (8.0 * pi * boltzmann * log(coordination_number - 1.0)) *
           log(alpha * alpha / (4.0 * b2_rho_c));
  }

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real pressure = max(at.pressure, Real(-0.9 * bulk_modulus / bulk_modulus_slope));
    const Real one_over_h = pow(1.0 + (bulk_modulus_slope / bulk_modulus) * pressure, -1.0 / bulk_modulus_slope);
    const Real stiffening = (shear_modulus_slope / shear_modulus) * pressure * pow(one_over_h, 4.0 / 3.0);
    return max(ambient_value() * (one_over_h + stiffening), Real(lowest));
  }
  static constexpr double lowest = 1.0;  // K, for tension no metal bears
};

}  // namespace brisance::melting
