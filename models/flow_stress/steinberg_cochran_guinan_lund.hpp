#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct SteinbergCochranGuinanLund {
  static constexpr std::string_view name = "steinberg_cochran_guinan_lund";
  static constexpr std::string_view equation =
      "Y = [min(sigma0 (1 + beta (ep + ei))^n, Ymax) + sT(r, T)] mu(p, T)/mu0,  "
      "1/r = exp(2 Uk/(k T) (1 - sT/sP)^2)/C1 + C2/sT,  sT <= sP";
  static constexpr std::string_view source =
      "Steinberg & Lund, J. Appl. Phys. 65 (1989) 1528-1533; thermally activated part after Hoge & Mukherjee, J. Mater. Sci. "
      "12 (1977) 1666-1672. sT stays at sP beyond the rate at which it gets there.";
  static constexpr bool needs_melting_temperature = true;

  double initial_yield_stress, beta, n, initial_plastic_strain, largest_yield_stress, reference_shear_modulus;
  double attempt_rate, drag_coefficient, kink_energy, peierls_stress;

  using Self = SteinbergCochranGuinanLund;
  static constexpr auto parameters = std::tuple{
      Parameter{"initial_yield_stress", &Self::initial_yield_stress, Unit::Pa, "sigma0, athermal part of Y at ambient",
                positive},
      Parameter{"beta", &Self::beta, Unit::one, "hardening coefficient", non_negative},
      Parameter{"n", &Self::n, Unit::one, "hardening exponent", between(0.0, 2.0)},
      Parameter{"initial_plastic_strain", &Self::initial_plastic_strain, Unit::one, "ei, plastic strain of earlier working",
                non_negative},
      Parameter{"largest_yield_stress", &Self::largest_yield_stress, Unit::Pa, "Ymax, of the athermal part at ambient",
                positive},
      Parameter{"reference_shear_modulus", &Self::reference_shear_modulus, Unit::Pa, "mu0, shear modulus at ambient", positive},
      Parameter{"attempt_rate", &Self::attempt_rate, Unit::per_s, "C1, rate of overcoming the Peierls barrier", positive},
      Parameter{"drag_coefficient", &Self::drag_coefficient, Unit::Pa_s, "C2, dislocation drag", positive},
      Parameter{"kink_energy", &Self::kink_energy, Unit::J, "Uk, energy of a pair of kinks is 2 Uk", positive},
      Parameter{"peierls_stress", &Self::peierls_stress, Unit::Pa, "sP, largest thermal stress", positive}};

  static constexpr double boltzmann = 1.380649e-23;  // J/K
  static constexpr double no_rate = 1e-280;          // 1/s, small enough for any temperature to make sT vanish

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    const auto at = bounded(state, no_rate);
    const Real hardened = initial_yield_stress * pow(1.0 + beta * (at.plastic_strain + initial_plastic_strain), n);
    const Real athermal = min(hardened, Real(largest_yield_stress));
    const Real thermal =
        select(state.plastic_strain_rate > no_rate, thermal_stress(at.plastic_strain_rate, at.temperature), Real(0.0));
    return if_solid(state, (athermal + thermal) * (at.shear_modulus * (1.0 / reference_shear_modulus)));
  }

  /// sT(r, T), the root of the implicit law. With y = sT/sP its residual
  ///   F(y) = exp(E (1 - y)^2 - c) + d/y - 1,  E = 2 Uk/(k T),  c = ln(C1/r),  d = r C2/sP
  /// falls and is convex, so Newton's method started below the root climbs to it and cannot miss. Where the start is close,
  /// few steps do; each of these lies below:
  ///   the root without its activated term                                 y = d
  ///   the root with d/y replaced by d, its least value                    y = 1 - sqrt((c + ln(1 - d))/E)
  ///   the root with exp(E (1 - y)^2 - c) replaced by g (1 - 2 E y),  g = exp(min(E - c, 0))
  template <class Real>
  Real thermal_stress(const Real& rate, const Real& temperature) const {
    const Real E = (2.0 * kink_energy / boltzmann) / max(temperature, Real(1.0));
    const Real c = std::log(attempt_rate) - log(rate);
    const Real d = rate * (drag_coefficient / peierls_stress);
    const auto E0 = without_derivatives(E), c0 = without_derivatives(c), d0 = without_derivatives(d);
    using Value = std::remove_cvref_t<decltype(E0)>;

    const Value room = c0 + log(max(1.0 - d0, Value(1e-300)));
    const Value activated = 1.0 - sqrt(clamp(room / E0, 0.0, 1.0));
    const Value log_g = min(E0 - c0, Value(0.0));
    const Value lost = -expm1(log_g);
    const Value dragged = 2.0 * d0 / (lost + sqrt(lost * lost + 8.0 * E0 * exp(log_g) * d0));
    Value y = min(max(max(activated, dragged), d0), Value(1.0)), slope(-1.0);
    for (int i = 0; i < newton_steps; ++i) {
      const Value e = exp(E0 * (1.0 - y) * (1.0 - y) - c0);
      slope = -2.0 * E0 * (1.0 - y) * e - d0 / y / y;
      y = clamp(y - (e + d0 / y - 1.0) / slope, 1e-290, 1.0);
    }
    // One step more in Real: it moves the value by round-off and gives it the derivatives of the implicit function.
    const Real residual = exp(E * ((1.0 - y) * (1.0 - y)) - c) + d / Real(y) - 1.0;
    const Real root = Real(y) - residual / Real(slope);
    return peierls_stress * select(room > 0.0, clamp(root, 0.0, 1.0), Real(1.0));
  }
  static constexpr int newton_steps = 7;
};

}  // namespace brisance::flow_stress
