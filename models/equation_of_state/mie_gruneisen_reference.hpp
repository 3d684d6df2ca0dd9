#pragma once

#include "models/equation_of_state/quadrature.hpp"

namespace brisance::equation_of_state {

/// What the Mie-Grueneisen laws share: the pressure at e = 0 for a Hugoniot Us = c0 + s up and constant rho Gamma,
///   p0 = rho0 c0^2 x (1 - Gamma0 x/2)/(1 - s x)^2,  x = 1 - rho0/rho.
/// In tension p0 = rho0 c0^2 x, continuous to the first derivative; beyond x = 0.98/s p0 continues along its tangent.
struct LinearHugoniot {
  double reference_density, sound_speed, slope, gruneisen;

  double last_strain() const { return 0.98 / slope; }
  DensityRange range() const { return {0.2 * reference_density, reference_density / (1.0 - last_strain())}; }

  template <class Real>
  Real strain(const Real& rho) const {
    return 1.0 - reference_density / rho;
  }

  template <class Real>
  Real pressure(const Real& x) const {
    const double K0 = reference_density * sound_speed * sound_speed;
    const Real y = min(x, Real(last_strain()));
    const Real d = 1.0 / (1.0 - slope * y);
    const Real curve = K0 * y * (1.0 - 0.5 * gruneisen * y) * d * d;
    const Real tangent = K0 * (1.0 + (slope - gruneisen) * y) * d * d * d;
    return select(x < 0.0, K0 * x, curve + tangent * (x - y));
  }

  /// Energy on the isentrope through (rho0, e = 0): de/dx = p/rho0 with p = p0(x) + rho0 Gamma0 e, so that
  /// e = exp(Gamma0 x) integral of exp(-Gamma0 t) p0(t)/rho0 dt from 0 to x.
  template <class Real>
  Real isentropic_energy(const Real& x) const {
    // With t = (1 - exp(-u))/s the integrand of the compressed part has no pole near x = 1/s and the rule converges fast.
    const Real y = clamp(x, 0.0, last_strain());
    const auto compressed = [this](const Real& u) {
      const Real t = -expm1(-u) * (1.0 / slope);
      return Real(exp(u - gruneisen * t) * t * (1.0 - 0.5 * gruneisen * t));
    };
    const Real inside = sound_speed * sound_speed / slope * integral(compressed, Real(0.0), Real(-log1p(-slope * y)));
    const auto straight = [this](const Real& t) { return Real(exp(-gruneisen * t) * pressure(t)); };
    const Real outside = integral(straight, y, x) * (1.0 / reference_density);
    return exp(gruneisen * x) * (inside + outside);
  }
};

}  // namespace brisance::equation_of_state
