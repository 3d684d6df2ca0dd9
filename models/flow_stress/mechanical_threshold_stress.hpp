#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {
/// How hardening goes out as the threshold stress approaches saturation.
enum class HardeningForm { tanh, voce };
}  // namespace brisance::flow_stress

namespace brisance {
template <>
inline constexpr std::array choices<flow_stress::HardeningForm> = {std::string_view{"tanh"}, std::string_view{"voce"}};
}  // namespace brisance

namespace brisance::flow_stress {

struct MechanicalThresholdStress {
  static constexpr std::string_view name = "mechanical_threshold_stress";
  static constexpr std::string_view equation =
      "Y = sigma_a + (Si sigma_i + Se sigma_e) mu(p, T)/mu_ref,  Sj = [1 - (k T/(g0j b^3 mu) ln(r0j/r))^(1/qj)]^(1/pj);  "
      "d sigma_e/d ep = theta0 (1 - F) + theta_IV F,  F = tanh(alpha X)/tanh(alpha) or F = X^kappa (voce), X = "
      "sigma_e/sigma_es,  "
      "theta0 = max(a0 + a1 ln r + a2 sqrt(r) - a3 T, 0),  ln(sigma_es/sigma_es0) = k T/(g0es b^3 mu) ln(r/r0es)";
  static constexpr std::string_view source =
      "Follansbee & Kocks, Acta Metall. 36 (1988) 81-93; intrinsic barrier and theta_IV: Goto, Garrett, Bingert, Chen & Gray, "
      "Metall. Mater. Trans. A 31 (2000) 1985-1996. Rates count from 1e-8/s up to r0j. sigma_e belongs to the history of the "
      "point: it is never integrated again from zero strain at the present rate and temperature.";
  static constexpr bool needs_melting_temperature = true;
  static constexpr HistoryColumn history{"threshold_stress", Unit::Pa, "sigma_e, strain-dependent mechanical threshold stress"};

  double athermal_stress, k_over_b3, reference_shear_modulus;
  double intrinsic_stress, intrinsic_barrier, intrinsic_rate, intrinsic_p, intrinsic_q;
  double evolving_barrier, evolving_rate, evolving_p, evolving_q;
  double a0, a1, a2, a3, stage_four_hardening;
  HardeningForm hardening_form;
  double alpha, saturation_stress, saturation_barrier, saturation_rate;
  double voce_exponent = 1.0;

  using Self = MechanicalThresholdStress;
  static constexpr Interval exponent{0.0, 4.0};
  static constexpr auto parameters = std::tuple{
      Parameter{"athermal_stress", &Self::athermal_stress, Unit::Pa, "sigma_a, of long-range barriers", non_negative},
      Parameter{"k_over_b3", &Self::k_over_b3, Unit::Pa_per_K, "k/b^3, Boltzmann constant over Burgers vector cubed", positive},
      Parameter{"reference_shear_modulus", &Self::reference_shear_modulus, Unit::Pa,
                "mu_ref, modulus at which the threshold stresses hold: mu at 0 K", positive},
      Parameter{"intrinsic_stress", &Self::intrinsic_stress, Unit::Pa, "sigma_i, threshold stress that does not evolve",
                non_negative},
      Parameter{"intrinsic_barrier", &Self::intrinsic_barrier, Unit::one,
                "g0i, normalised activation energy; 0 if there is no intrinsic part", non_negative},
      Parameter{"intrinsic_rate", &Self::intrinsic_rate, Unit::per_s, "r0i", non_negative},
      Parameter{"intrinsic_p", &Self::intrinsic_p, Unit::one, "pi", exponent},
      Parameter{"intrinsic_q", &Self::intrinsic_q, Unit::one, "qi", exponent},
      Parameter{"evolving_barrier", &Self::evolving_barrier, Unit::one, "g0e, normalised activation energy", positive},
      Parameter{"evolving_rate", &Self::evolving_rate, Unit::per_s, "r0e", positive},
      Parameter{"evolving_p", &Self::evolving_p, Unit::one, "pe", Interval{0.0, 4.0, true}},
      Parameter{"evolving_q", &Self::evolving_q, Unit::one, "qe", Interval{0.0, 4.0, true}},
      Parameter{"a0", &Self::a0, Unit::Pa, "initial hardening at 1/s and 0 K"},
      Parameter{"a1", &Self::a1, Unit::Pa, "its change with ln r"},
      Parameter{"a2", &Self::a2, Unit::Pa, "its change with the square root of r in 1/s"},
      Parameter{"a3", &Self::a3, Unit::Pa_per_K, "its decrease with temperature"},
      Parameter{"stage_four_hardening", &Self::stage_four_hardening, Unit::Pa,
                "theta_IV, hardening left at saturation; above 0 sigma_e passes sigma_es", non_negative},
      Parameter{"hardening_form", &Self::hardening_form, Unit::one, "F(X): tanh or voce"},
      Parameter{"alpha", &Self::alpha, Unit::one, "shape of the tanh form", positive},
      Parameter{"saturation_stress", &Self::saturation_stress, Unit::Pa, "sigma_es0, saturation at 0 K", positive},
      Parameter{"saturation_barrier", &Self::saturation_barrier, Unit::one, "g0es, normalised activation energy", positive},
      Parameter{"saturation_rate", &Self::saturation_rate, Unit::per_s, "r0es", positive},
      Parameter{"voce_exponent", &Self::voce_exponent, Unit::one,
                "kappa of the voce form: 1 is Voce's law, above it hardening lasts", at_least(1.0), 1.0}};

  static constexpr double lowest_rate = 1e-8;  // 1/s

  template <class Real>
  Real operator()(const Arguments<Real>& state, const Real& threshold_stress) const {
    const auto at = bounded(state, lowest_rate);
    Real resisted =
        threshold_stress * barrier_fraction(at, evolving_barrier, evolving_rate, 1.0 / evolving_p, 1.0 / evolving_q);
    if (intrinsic_barrier > 0.0 && intrinsic_stress > 0.0)
      resisted +=
          intrinsic_stress * barrier_fraction(at, intrinsic_barrier, intrinsic_rate, 1.0 / intrinsic_p, 1.0 / intrinsic_q);
    return if_solid(state, athermal_stress + resisted * (at.shear_modulus * (1.0 / reference_shear_modulus)));
  }

  /// d sigma_e/d(plastic strain) as a function of sigma_e at a given state; sigma_e may carry derivatives that the state does
  /// not.
  template <class Real>
  auto hardening(const Arguments<Real>& state) const {
    const auto at = bounded(state, lowest_rate);
    const Real& rate = at.plastic_strain_rate;
    const Real initial = max(a0 + a1 * log(rate) + a2 * sqrt(rate) - a3 * at.temperature, Real(0.0));
    const Real saturation = saturation_stress * exp(max(-activation(at, saturation_barrier, saturation_rate), Real(-30.0)));
    return [*this, initial, one_over_saturation = 1.0 / saturation,
            one_over_tanh = 1.0 / tanh(alpha)]<class Stress>(const Stress& threshold_stress) -> Stress {
      const Stress X = threshold_stress * one_over_saturation;
      const Stress F = hardening_form == HardeningForm::tanh ? tanh(alpha * X) * one_over_tanh
                       : voce_exponent == 1.0                ? X
                                                             : pow(max(X, Stress(0.0)), voce_exponent);
      return initial + (stage_four_hardening - initial) * F;
    };
  }
  template <class Real>
  Real hardening(const Arguments<Real>& state, const Real& threshold_stress) const {
    return hardening(state)(threshold_stress);
  }

 private:
  /// k T/(g0 b^3 mu) ln(r0/r): the energy that heat provides, over that of the barrier. None is needed above r0.
  template <class Real>
  Real activation(const Arguments<Real>& at, double barrier, double rate) const {
    return (k_over_b3 / barrier) * at.temperature / at.shear_modulus * log(max(rate / at.plastic_strain_rate, Real(1.0)));
  }

  /// Sj: the fraction of the barrier's threshold stress left to be overcome by stress.
  template <class Real>
  Real barrier_fraction(const Arguments<Real>& at, double barrier, double rate, double one_over_p, double one_over_q) const {
    return pow(max(1.0 - pow(activation(at, barrier, rate), one_over_q), Real(0.0)), one_over_p);
  }
};

}  // namespace brisance::flow_stress
