#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct PrestonTonksWallace {
  static constexpr std::string_view name = "preston_tonks_wallace";
  static constexpr std::string_view equation =
      "Y = 2 mu {ts + a ln[1 - (1 - exp(-b)) exp(-theta ep/(a (exp(b) - 1)))]},  a = (s0 - ty)/p, b = (ts - ty)/a;  "
      "ts = max(s0 - (s0 - s_inf) erf(u), s0 x^beta),  ty = max(y0 - (y0 - y_inf) erf(u), min(y1 x^y2, s0 x^beta)),  "
      "u = kappa T/Tm ln(1/x), x = r/(gamma xi), xi = (4 pi rho/(3 M))^(1/3) sqrt(mu/rho)/2;  "
      "p = 0: Y = 2 mu {ts - (ts - ty) exp(-theta ep/(ts - ty))}";
  static constexpr std::string_view source = "Preston, Tonks & Wallace, J. Appl. Phys. 93 (2003) 211-220.";
  static constexpr bool needs_melting_temperature = true;

  double theta, p, s0, s_inf, kappa, gamma, y0, y_inf, y1, y2, beta, atomic_mass;

  using Self = PrestonTonksWallace;
  static constexpr auto parameters =
      std::tuple{Parameter{"theta", &Self::theta, Unit::one, "initial hardening rate; dY/dep = 2 mu theta", non_negative},
                 Parameter{"p", &Self::p, Unit::one, "departure from Voce hardening, which is 0", between(0.0, 100.0)},
                 Parameter{"s0", &Self::s0, Unit::one, "saturation stress over 2 mu at 0 K", positive},
                 Parameter{"s_inf", &Self::s_inf, Unit::one, "the same near melting", non_negative},
                 Parameter{"kappa", &Self::kappa, Unit::one, "temperature dependence of activation", non_negative},
                 Parameter{"gamma", &Self::gamma, Unit::one, "rate dependence of activation", positive},
                 Parameter{"y0", &Self::y0, Unit::one, "yield stress over 2 mu at 0 K", non_negative},
                 Parameter{"y_inf", &Self::y_inf, Unit::one, "the same near melting", non_negative},
                 Parameter{"y1", &Self::y1, Unit::one, "yield stress at medium rates, coefficient", non_negative},
                 Parameter{"y2", &Self::y2, Unit::one, "yield stress at medium rates, exponent", between(0.0, 2.0)},
                 Parameter{"beta", &Self::beta, Unit::one, "exponent of the overdriven shock regime", between(0.0, 2.0)},
                 Parameter{"atomic_mass", &Self::atomic_mass, Unit::one, "M, mass of an atom in atomic mass units", positive}};

  static constexpr double atomic_mass_unit = 1.66053906660e-27;  // kg
  static constexpr double four_pi_over_three = 4.18879020478639098462;

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    const auto at = bounded(state, 1e-8);
    const Real atoms_per_volume = at.density * (1.0 / (atomic_mass * atomic_mass_unit));
    const Real xi = 0.5 * pow(four_pi_over_three * atoms_per_volume, 1.0 / 3.0) * sqrt(at.shear_modulus / at.density);
    const Real log_x = log(at.plastic_strain_rate / (gamma * xi));
    const Real activation = erf(-kappa * (at.temperature / at.melting_temperature) * log_x);
    const Real overdriven = s0 * exp(beta * log_x);
    const Real ts = max(s0 - (s0 - s_inf) * activation, overdriven);
    const Real ty = max(y0 - (y0 - y_inf) * activation, min(y1 * exp(y2 * log_x), overdriven));

    // Without room between yield and saturation there is no hardening, and its formula is not looked at.
    const Real room = ts - ty, least = Real(1e-12 * s0);
    const Real hardened = ty + hardening(at.plastic_strain, max(room, least), max(s0 - ty, least));
    return if_solid(state, 2.0 * at.shear_modulus * select(room > 0.0, hardened, ts));
  }

 private:
  /// The source's formula rewritten as growth from ty, which costs no digits at small strain:
  ///   a ln[1 + (exp(b) - 1) (1 - exp(-theta ep/(a (exp(b) - 1))))]
  /// Beyond b = 500 it is a line at any strain.
  template <class Real>
  Real hardening(const Real& plastic_strain, const Real& room, const Real& room_at_zero_kelvin) const {
    if (p == 0.0) return -(room * expm1(-theta * plastic_strain / room));
    const Real a = room_at_zero_kelvin * (1.0 / p);
    const Real e = expm1(min(room / a, Real(500.0)));
    return a * log1p(-(e * expm1(-theta * plastic_strain / (a * e))));
  }
};

}  // namespace brisance::flow_stress
