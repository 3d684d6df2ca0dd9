#pragma once

#include "models/equation_of_state/definitions.hpp"

namespace brisance::equation_of_state {

struct Tillotson {
  static constexpr std::string_view name = "tillotson";
  static constexpr std::string_view equation =
      "eta = rho/rho0, mu = eta - 1, w = 1 + e/(E0 eta^2).  eta >= 1 or e <= Eiv: p = pc = (a + b/w) rho e + A mu + B mu^2 "
      "(B only for mu > 0);  eta < 1 and e >= Ecv: p = pe = a rho e + (b rho e/w + A mu exp(-beta (1/eta - 1))) "
      "exp(-alpha (1/eta - 1)^2);  eta < 1 between Eiv and Ecv: linear in e from pc to pe";
  static constexpr std::string_view source =
      "Tillotson, GA-3216 (1962); blend of Brundage, Procedia Eng. 58 (2013) 461-470. B acts in compression alone, or the cold "
      "solid would have no stiffness at mu = -A/(2 B); w counts e >= 0. The temperature is cv (T - Ts) = e - es about the "
      "isentrope es, Ts through rho0, T0, integrated with dT/T = Gamma drho/rho: our choice, Tillotson gives none. Below about "
      "0.7 rho0 cold tension and the blend can lose all stiffness; there the floor of the sound speed holds.";
  static constexpr Caloric caloric = Caloric::energy;

  double reference_density, a, b, A, B, reference_energy, incipient_vaporization_energy, complete_vaporization_energy, alpha,
      beta, specific_heat, reference_temperature;

  static constexpr auto parameters = std::tuple{
      Parameter{"reference_density", &Tillotson::reference_density, Unit::kg_per_m3, "rho0, density at p = 0, e = 0", positive},
      Parameter{"a", &Tillotson::a, Unit::one, "Grueneisen coefficient of the dilute vapour", positive},
      Parameter{"b", &Tillotson::b, Unit::one, "a + b is the Grueneisen coefficient of the cold solid", non_negative},
      Parameter{"A", &Tillotson::A, Unit::Pa, "bulk modulus at rho0, e = 0", positive},
      Parameter{"B", &Tillotson::B, Unit::Pa, "coefficient of mu^2", non_negative},
      Parameter{"reference_energy", &Tillotson::reference_energy, Unit::J_per_kg, "E0, a fit constant", positive},
      Parameter{"incipient_vaporization_energy", &Tillotson::incipient_vaporization_energy, Unit::J_per_kg,
                "Eiv, energy at the start of vaporization", positive},
      Parameter{"complete_vaporization_energy", &Tillotson::complete_vaporization_energy, Unit::J_per_kg,
                "Ecv, energy at its end; above Eiv", positive},
      Parameter{"alpha", &Tillotson::alpha, Unit::one, "decay of the solid's terms with (1/eta - 1)^2", non_negative},
      Parameter{"beta", &Tillotson::beta, Unit::one, "decay of the A term with 1/eta - 1", non_negative},
      Parameter{"specific_heat", &Tillotson::specific_heat, Unit::J_per_kg_K, "cv", positive},
      Parameter{"reference_temperature", &Tillotson::reference_temperature, Unit::K, "T0, temperature at rho0, e = 0",
                positive}};

  DensityRange range() const { return {0.2 * reference_density, 5.0 * reference_density}; }
  double lowest_sound_speed() const { return 0.1 * std::sqrt(A / reference_density); }

  template <class Real>
  Real pressure(const Real& rho, const Real& e) const {
    const Real eta = rho * (1.0 / reference_density), mu = eta - 1.0, squeezed = max(mu, Real(0.0));
    const Real w = 1.0 + max(e, Real(0.0)) / (reference_energy * eta * eta);
    const Real solid_thermal = b * rho * e / w;
    const Real condensed = a * rho * e + solid_thermal + A * mu + B * squeezed * squeezed;

    const Real swelling = max(1.0 / eta - 1.0, Real(0.0));
    const Real vapour =
        a * rho * e + (solid_thermal + A * min(mu, Real(0.0)) * exp(-beta * swelling)) * exp(-alpha * swelling * swelling);

    const double latent = complete_vaporization_energy - incipient_vaporization_energy;
    const Real vaporized = clamp(Real((e - incipient_vaporization_energy) * (1.0 / latent)), 0.0, 1.0);
    return condensed + select(mu < 0.0, vaporized, Real(0.0)) * (vapour - condensed);
  }

  template <class Real>
  Real energy(const Real& rho, const Real& temperature) const {
    const Isentrope<Real> cold = isentrope(rho);
    return cold.energy + specific_heat * (temperature - reference_temperature * exp(cold.log_temperature));
  }

 private:
  template <class Real>
  struct Isentrope {
    Real energy, log_temperature;  // J/kg; ln(T/T0)
  };

  /// d(energy)/d(ln rho) = p/rho and d(ln T)/d(ln rho) = Gamma = (dp/de)/rho.
  template <class Real>
  Isentrope<Real> slope(const Real& log_eta, const Real& e) const {
    const Real rho = reference_density * exp(log_eta);
    const Dual<Real> p = pressure(Dual<Real>(rho), Dual<Real>::variable(e));
    return {p.value / rho, p.derivative[0] / rho};
  }

  /// The isentrope from rho0, e = 0 to a density, by the classical Runge-Kutta rule.
  template <class Real>
  Isentrope<Real> isentrope(const Real& rho) const {
    constexpr int steps = 32;  // relative error of the energy below 1e-6 for two-fold compression of a metal
    const Real h = log(rho * (1.0 / reference_density)) * (1.0 / steps);
    Isentrope<Real> at{Real(0.0), Real(0.0)};
    for (int i = 0; i < steps; ++i) {
      const Real x = h * double(i);
      const auto k1 = slope(x, at.energy);
      const auto k2 = slope(Real(x + 0.5 * h), Real(at.energy + 0.5 * h * k1.energy));
      const auto k3 = slope(Real(x + 0.5 * h), Real(at.energy + 0.5 * h * k2.energy));
      const auto k4 = slope(Real(x + h), Real(at.energy + h * k3.energy));
      at.energy = at.energy + h * (1.0 / 6.0) * (k1.energy + 2.0 * (k2.energy + k3.energy) + k4.energy);
      at.log_temperature =
          at.log_temperature +
          h * (1.0 / 6.0) * (k1.log_temperature + 2.0 * (k2.log_temperature + k3.log_temperature) + k4.log_temperature);
    }
    return at;
  }
};

}  // namespace brisance::equation_of_state
