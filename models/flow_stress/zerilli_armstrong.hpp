#pragma once

#include "models/flow_stress/arguments.hpp"

namespace brisance::flow_stress {

struct ZerilliArmstrong {
  static constexpr std::string_view name = "zerilli_armstrong";
  static constexpr std::string_view equation =
      "Y = sigma_g + k_h/sqrt(l) + B exp(-beta T) + B0 sqrt(ep) exp(-alpha T) + K ep^n,  alpha = max(alpha0 - alpha1 ln r, 0), "
      "beta = max(beta0 - beta1 ln r, 0); fcc metals have B = K = 0, bcc metals B0 = 0";
  static constexpr std::string_view source =
      "Zerilli & Armstrong, J. Appl. Phys. 61 (1987) 1816-1825. alpha and beta are kept from turning negative, where heat "
      "would harden: our choice.";
  static constexpr bool needs_melting_temperature = true;

  double athermal_stress, hall_petch_slope, grain_size, B, beta0, beta1, B0, alpha0, alpha1, K, n;

  static constexpr auto parameters =
      std::tuple{Parameter{"athermal_stress", &ZerilliArmstrong::athermal_stress, Unit::Pa,
                           "sigma_g, of solutes and initial dislocations", non_negative},
                 Parameter{"hall_petch_slope", &ZerilliArmstrong::hall_petch_slope, Unit::Pa_sqrt_m,
                           "k_h, slope against 1/sqrt(l)", non_negative},
                 Parameter{"grain_size", &ZerilliArmstrong::grain_size, Unit::m, "l, mean grain diameter", positive},
                 Parameter{"B", &ZerilliArmstrong::B, Unit::Pa, "thermal stress without strain (bcc)", non_negative},
                 Parameter{"beta0", &ZerilliArmstrong::beta0, Unit::per_K, "softening of B at 1/s", non_negative},
                 Parameter{"beta1", &ZerilliArmstrong::beta1, Unit::per_K, "rate dependence of beta", non_negative},
                 Parameter{"B0", &ZerilliArmstrong::B0, Unit::Pa, "thermal stress with strain (fcc)", non_negative},
                 Parameter{"alpha0", &ZerilliArmstrong::alpha0, Unit::per_K, "softening of B0 at 1/s", non_negative},
                 Parameter{"alpha1", &ZerilliArmstrong::alpha1, Unit::per_K, "rate dependence of alpha", non_negative},
                 Parameter{"K", &ZerilliArmstrong::K, Unit::Pa, "athermal hardening (bcc)", non_negative},
                 Parameter{"n", &ZerilliArmstrong::n, Unit::one, "exponent of athermal hardening", between(0.0, 2.0)}};

  template <class Real>
  Real operator()(const Arguments<Real>& state) const {
    const auto at = bounded(state, 1e-8);
    const Real log_rate = log(at.plastic_strain_rate);
    const Real alpha = max(alpha0 - alpha1 * log_rate, Real(0.0));
    const Real beta = max(beta0 - beta1 * log_rate, Real(0.0));
    // The slope of the root is infinite at no strain; a floor far below any strain of interest keeps it a number.
    const Real root = sqrt(max(at.plastic_strain, Real(1e-30)));
    const double athermal = athermal_stress + hall_petch_slope / sqrt(grain_size);
    return if_solid(state, athermal + B * exp(-beta * at.temperature) + B0 * root * exp(-alpha * at.temperature) +
                               K * pow(at.plastic_strain, n));
  }
};

}  // namespace brisance::flow_stress
