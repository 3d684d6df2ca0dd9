#pragma once
// The steady detonation of Chapman and Jouguet: the products leave the front at their own speed of sound.

#include <cmath>
#include <optional>

#include "models/equation_of_state/thermodynamics.hpp"

namespace brisance::equation_of_state {

struct DetonationState {
  double velocity;                                // D, m/s
  double pressure, density, energy, temperature;  // of the products behind the front: Pa, kg/m^3, J/kg, K
  double relative_volume;                         // V = rho0/rho
  double particle_velocity;                       // m/s
  double isentropic_exponent;                     // -dln p/dln V along the isentrope of the products
};

/// Products on the detonation adiabat e = e0 + (p + p0)/2 (1/rho0 - 1/rho) of an explosive of density rho0 at a pressure p0,
/// where e0 is the energy of the products before any work, J/kg. None where the law has no sonic point in its range.
template <AnyLaw Law>
std::optional<DetonationState> chapman_jouguet(const Law& law, double rho0, double e0, double p0 = 0.0) {
  const auto products = [&](double rho) {
    const double volume_change = 1.0 / rho0 - 1.0 / rho;
    double e = e0;
    constexpr int most_steps = 60;
    for (int i = 0; i < most_steps; ++i) {  // one step where p is linear in e
      const Dual<double> p = law.pressure(Dual<double>(rho), Dual<double>::variable(e));
      const double step = (e - e0 - 0.5 * (p.value + p0) * volume_change) / (1.0 - 0.5 * p.derivative[0] * volume_change);
      e -= step;
      if (std::abs(step) <= 1e-15 * std::abs(e)) break;
    }
    return e;
  };
  // The tangent of the isentrope less the slope of the Rayleigh line: negative on weak detonations, positive on strong ones.
  const auto sonic_excess = [&](double rho) {
    const double e = products(rho), p = law.pressure(rho, e);
    return rho * rho * sound_speed_squared(law, rho, e) - (p - p0) / (1.0 / rho0 - 1.0 / rho);
  };
  double below = rho0 * (1.0 + 1e-6), above = below;
  const double highest = std::min(law.range().highest, 10.0 * rho0);
  do {
    above = std::min(above * 1.05, highest);
    if (above >= highest && !(sonic_excess(above) > 0.0)) return std::nullopt;
  } while (!(sonic_excess(above) > 0.0));
  if (!(sonic_excess(below) < 0.0)) return std::nullopt;
  for (double middle = 0.5 * (below + above); below < middle && middle < above; middle = 0.5 * (below + above))
    (sonic_excess(middle) > 0.0 ? above : below) = middle;
  const double rho = above, e = products(rho), p = law.pressure(rho, e);
  const double D = std::sqrt((p - p0) / (1.0 / rho0 - 1.0 / rho)) / rho0;
  const double u = (p - p0) / (rho0 * D);
  return DetonationState{D, p, rho, e, temperature(law, rho, e), rho0 / rho, u, sound_speed_squared(law, rho, e) * rho / p};
}

/// Of the explosive that the products' own parameters describe.
inline std::optional<DetonationState> chapman_jouguet(const JonesWilkinsLee& law) {
  return chapman_jouguet(law, law.reference_density, law.initial_energy());
}

}  // namespace brisance::equation_of_state
