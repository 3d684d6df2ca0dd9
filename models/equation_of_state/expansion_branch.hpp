#pragma once

#include "models/real.hpp"

namespace brisance::equation_of_state {

/// Below the reference density the Murnaghan and Birch-Murnaghan laws follow p = p0 (rho/rho0)^(K0/p0): value and slope are
/// those of the compressed side, and the pressure stays positive, as a pressure shared with a gas must.
struct ExpansionBranch {
  double reference_density, bulk_modulus, reference_pressure;

  double exponent() const { return bulk_modulus / reference_pressure; }

  template <class Real>
  Real pressure(const Real& log_compression) const {
    return reference_pressure * exp(exponent() * min(log_compression, Real(0.0)));
  }

  /// Integral of p/rho^2 from rho0.
  template <class Real>
  Real energy(const Real& log_compression) const {
    const double power = exponent() - 1.0;
    const Real expansion = min(log_compression, Real(0.0));
    const Real volume = power == 0.0 ? expansion : expm1(power * expansion) * (1.0 / (power == 0.0 ? 1.0 : power));
    return reference_pressure / reference_density * volume;
  }
};

}  // namespace brisance::equation_of_state
