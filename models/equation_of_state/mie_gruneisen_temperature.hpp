#pragma once

#include "models/equation_of_state/definitions.hpp"
#include "models/equation_of_state/mie_gruneisen_reference.hpp"

namespace brisance::equation_of_state {

struct MieGruneisenTemperature {
  static constexpr std::string_view name = "mie_gruneisen_temperature";
  static constexpr std::string_view equation =
      "p = rho0 c0^2 x (1 - Gamma0 x/2)/(1 - s x)^2 + rho0 Gamma0 e,  x = 1 - rho0/rho,  e = cv (T - T0); in tension the "
      "first term is rho0 c0^2 x";
  static constexpr std::string_view source =
      "Zocher, Maudlin, Chen & Flower-Maudlin, ECCOMAS 2000: the temperature-corrected form. Beyond x = "
      "0.98/s the reference curve continues along its tangent. The energy leaves out the cold compression, so a shock "
      "comes out low in pressure where mie_gruneisen_energy is exact.";
  static constexpr Caloric caloric = Caloric::thermal;

  double reference_density, sound_speed, slope, gruneisen, specific_heat, reference_temperature;

  static constexpr auto parameters =
      std::tuple{Parameter{"reference_density", &MieGruneisenTemperature::reference_density, Unit::kg_per_m3,
                           "rho0, stress-free density at T0", positive},
                 Parameter{"sound_speed", &MieGruneisenTemperature::sound_speed, Unit::m_per_s, "c0, Us at up = 0", positive},
                 Parameter{"slope", &MieGruneisenTemperature::slope, Unit::one, "s, dUs/dup", Interval{1.0, 4.0}},
                 Parameter{"gruneisen", &MieGruneisenTemperature::gruneisen, Unit::one,
                           "Gamma0, Grueneisen coefficient; rho Gamma is constant", non_negative},
                 Parameter{"specific_heat", &MieGruneisenTemperature::specific_heat, Unit::J_per_kg_K, "cv", positive},
                 Parameter{"reference_temperature", &MieGruneisenTemperature::reference_temperature, Unit::K,
                           "T0, temperature at which the body has its reference density without pressure", positive}};

  LinearHugoniot reference() const { return {reference_density, sound_speed, slope, gruneisen}; }
  DensityRange range() const { return reference().range(); }
  double lowest_sound_speed() const { return 0.1 * sound_speed; }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    return reference().pressure(reference().strain(rho)) + reference_density * gruneisen * e;
  }

  template <class Real>
  Real energy(const Real& /*rho*/, const Real& temperature) const {
    return specific_heat * (temperature - reference_temperature);
  }
};

}  // namespace brisance::equation_of_state
