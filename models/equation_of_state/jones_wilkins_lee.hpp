#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct JonesWilkinsLee {
  static constexpr std::string_view name = "jones_wilkins_lee";
  static constexpr std::string_view equation =
      "p = A exp(-R1 V) + B exp(-R2 V) + omega rho max(e - ec, 0),  V = rho0/rho,  e = ec + cv T,  ec = (A/R1 exp(-R1 V) + "
      "B/R2 exp(-R2 V))/rho0; the usual p(V, E) with E = rho0 e";
  static constexpr std::string_view source =
      "Lee, Hornig & Kury, UCRL-50422 (1968), with the caloric form of Menikoff, LA-UR-15-29536 (2015). Energies below the "
      "cold curve count as the cold curve, so p >= 0 in any expansion.";
  static constexpr Caloric caloric = Caloric::complete;

  double reference_density, A, B, R1, R2, omega, specific_heat, detonation_energy;

  static constexpr auto parameters =
      std::tuple{Parameter{"reference_density", &JonesWilkinsLee::reference_density, Unit::kg_per_m3,
                           "rho0, density of the explosive", positive},
                 Parameter{"A", &JonesWilkinsLee::A, Unit::Pa, "first cold coefficient", positive},
                 Parameter{"B", &JonesWilkinsLee::B, Unit::Pa, "second cold coefficient", any_value},
                 Parameter{"R1", &JonesWilkinsLee::R1, Unit::one, "first cold exponent", positive},
                 Parameter{"R2", &JonesWilkinsLee::R2, Unit::one, "second cold exponent", positive},
                 Parameter{"omega", &JonesWilkinsLee::omega, Unit::one, "Grueneisen coefficient of the products", positive},
                 Parameter{"specific_heat", &JonesWilkinsLee::specific_heat, Unit::J_per_kg_K, "cv", positive},
                 Parameter{"detonation_energy", &JonesWilkinsLee::detonation_energy, Unit::J_per_m3,
                           "E0, energy of the products at V = 1 before any work, per volume of the explosive", non_negative}};

  /// No pole anywhere; the table of isentropes ends far below three-fold compression.
  DensityRange range() const { return {0.0, 3.0 * reference_density}; }
  double lowest_sound_speed() const { return 0.0; }
  /// e of products that fill the volume of the explosive, J/kg.
  double initial_energy() const { return detonation_energy / reference_density; }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    const Real V = reference_density / rho;
    const Real first = A * exp(-R1 * V), second = B * exp(-R2 * V);
    const Real cold = (first * (1.0 / R1) + second * (1.0 / R2)) * (1.0 / reference_density);
    return first + second + omega * rho * max(e - cold, Real(0.0));
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    const Real V = reference_density / rho;
    const Real cold = (A / R1 * exp(-R1 * V) + B / R2 * exp(-R2 * V)) * (1.0 / reference_density);
    return cold + specific_heat * temperature;
  }
};

}  // namespace brisance::equation_of_state
