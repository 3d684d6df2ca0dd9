#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct TwuSimTassone {
  static constexpr std::string_view name = "twu_sim_tassone";
  static constexpr std::string_view equation =
      "p = (Gamma - 1) cv T/(v - b) - a/((v + 3 b)(v - b/2)),  v = 1/rho,  e = cv T + a/(3.5 b) ln((v - b/2)/(v + 3 b)); "
      "beyond b rho = 0.95 along the tangent";
  static constexpr std::string_view source =
      "Twu, Sim & Tassone, Fluid Phase Equilib. 194-197 (2002) 385-399. The energy is the one that belongs to p(rho, T).";
  static constexpr Caloric caloric = Caloric::complete;

  double gamma, specific_heat, a, b;

  static constexpr auto parameters =
      std::tuple{Parameter{"gamma", &TwuSimTassone::gamma, Unit::one, "Gamma, ratio of the specific heats of the dilute gas",
                           Interval{1.0, 10.0, true}},
                 Parameter{"specific_heat", &TwuSimTassone::specific_heat, Unit::J_per_kg_K, "cv", positive},
                 Parameter{"a", &TwuSimTassone::a, Unit{"Pa m^6/kg^2"}, "attraction; negative for gases that repel"},
                 Parameter{"b", &TwuSimTassone::b, Unit::m3_per_kg, "covolume", positive}};

  DensityRange range() const { return {0.0, 0.95 / b}; }
  double lowest_sound_speed() const { return 0.0; }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    const Real y = min(rho, Real(range().highest));
    const Dual<Real> at = curve(Dual<Real>::variable(y), Dual<Real>(e));
    return at.value + at.derivative[0] * (rho - y);
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    return attraction_energy(Real(min(rho, Real(range().highest)))) + specific_heat * temperature;
  }

 private:
  template <class Real>
  Real curve(const Real& rho, const Real& e) const {
    const Real thermal = e - attraction_energy(rho);
    return (gamma - 1.0) * rho * thermal / (1.0 - b * rho) - a * rho * rho / ((1.0 + 3.0 * b * rho) * (1.0 - 0.5 * b * rho));
  }

  template <class Real>
  Real attraction_energy(const Real& rho) const {
    return a / (3.5 * b) * (log1p(-0.5 * b * rho) - log1p(3.0 * b * rho));
  }
};

}  // namespace brisance::equation_of_state
