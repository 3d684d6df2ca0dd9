#pragma once

#include "models/bracketed_root.hpp"
#include "models/reaction/arguments.hpp"

namespace brisance::reaction {

struct WardSonBrewster {
  static constexpr std::string_view name = "ward_son_brewster";
  static constexpr std::string_view equation =
      "m''^2 = Ac R Ts^2 kc rho exp(-Ec/(R Ts)) / (cp Ec (Ts - T - Qc/(2 cp))),  Ts = T + Qc/cp + (Qg/cp) d/(sqrt(m''^2 + "
      "d) + m'')^2,  d = 4 kg Bg W^2 p^2/(cp R^2), where T > ignition and p > threshold";
  static constexpr std::string_view source =
      "Ward, Son & Brewster, Combust. Flame 114 (1998) 556-568. Above T = 550 K (molten HMX) it is an extrapolation: T + "
      "Qc/cp alone then exceeds the usual surface temperature.";
  static constexpr Kind kind = Kind::surface;

  double condensed_prefactor, condensed_activation_energy, gas_prefactor, condensed_heat, gas_heat, condensed_conductivity,
      gas_conductivity, specific_heat, molar_mass, pressure_threshold, ignition_temperature, gas_constant;

  static constexpr auto parameters = std::tuple{
      Parameter{"condensed_prefactor", &WardSonBrewster::condensed_prefactor, Unit::per_s, "Ac, of the decomposition",
                positive},
      Parameter{"condensed_activation_energy", &WardSonBrewster::condensed_activation_energy, Unit::J_per_mol,
                "Ec, of the decomposition", positive},
      Parameter{"gas_prefactor", &WardSonBrewster::gas_prefactor, Unit{"m^3/(kg s K)"}, "Bg, of the reaction in the gas",
                positive},
      Parameter{"condensed_heat", &WardSonBrewster::condensed_heat, Unit::J_per_kg, "Qc, heat of the decomposition", positive},
      Parameter{"gas_heat", &WardSonBrewster::gas_heat, Unit::J_per_kg, "Qg, heat of the reaction in the gas", positive},
      Parameter{"condensed_conductivity", &WardSonBrewster::condensed_conductivity, Unit::W_per_m_K, "kc, of the solid",
                positive},
      Parameter{"gas_conductivity", &WardSonBrewster::gas_conductivity, Unit::W_per_m_K, "kg, of the gas", positive},
      Parameter{"specific_heat", &WardSonBrewster::specific_heat, Unit::J_per_kg_K, "cp, of solid and gas", positive},
      Parameter{"molar_mass", &WardSonBrewster::molar_mass, Unit::kg_per_mol, "W, of the gas", positive},
      Parameter{"pressure_threshold", &WardSonBrewster::pressure_threshold, Unit::Pa, "pressure above which it burns",
                non_negative},
      Parameter{"ignition_temperature", &WardSonBrewster::ignition_temperature, Unit::K,
                "temperature of the solid above which it burns", non_negative},
      Parameter{"gas_constant", &WardSonBrewster::gas_constant, Unit::J_per_mol_K, "R, as in the fit of the other constants",
                positive, 8.314462618}};

  double heat() const { return condensed_heat + gas_heat; }

  /// m'' that a surface temperature gives by decomposition of the solid, kg/(m^2 s).
  template <class Real>
  Real decomposition_rate(const Real& surface_temperature, const Arguments<Real>& at) const {
    const Real Ts = surface_temperature;
    const double factor =
        condensed_prefactor * gas_constant * condensed_conductivity / (specific_heat * condensed_activation_energy);
    const Real excess = Ts - at.temperature - 0.5 * condensed_heat / specific_heat;
    return Ts * sqrt(factor * at.density * exp(-condensed_activation_energy / gas_constant / Ts) / excess);
  }

  /// Ts, between what the decomposition alone and both reactions together can heat.
  template <class Real>
  Real surface_temperature(const Arguments<Real>& at) const {
    const Real lowest = at.temperature + condensed_heat / specific_heat;
    const Real highest = lowest + gas_heat / specific_heat;
    const double ratio = molar_mass / gas_constant;
    const Real d = 4.0 * gas_conductivity * gas_prefactor * ratio * ratio / specific_heat * at.pressure * at.pressure;
    using Derived = Dual<Real>;
    const Arguments<Derived> constants{.pressure = at.pressure, .temperature = at.temperature, .density = at.density};
    const auto excess = [&](const Derived& Ts) {
      const Derived m = decomposition_rate(Ts, constants);
      const Derived standoff = sqrt(m * m + Derived(d)) + m;
      return Derived(Ts - Derived(lowest) - gas_heat / specific_heat * Derived(d) / (standoff * standoff));
    };
    return increasing_root<Real>(excess, lowest, highest, Real(0.5 * (lowest + highest)));
  }

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real rate = decomposition_rate(surface_temperature(at), at);
    const Real hot = select(at.temperature > ignition_temperature, rate, Real(0.0));
    return select(at.pressure > pressure_threshold, hot, Real(0.0));
  }
};

}  // namespace brisance::reaction
