#pragma once
// States behind a steady plane shock, from the jump conditions across it:
//   rho0 Us = rho1 (Us - up),  p1 - p0 = rho0 Us up,  e1 - e0 = (p0 + p1)/2 (1/rho0 - 1/rho1).

#include <cmath>
#include <optional>

#include "models/equation_of_state/quadrature.hpp"
#include "models/equation_of_state/thermodynamics.hpp"

namespace brisance::equation_of_state {

struct ShockState {
  double density, pressure, temperature, energy;  // kg/m^3, Pa, K, J/kg; the energy is the internal one
  double shock_velocity, particle_velocity;       // m/s, relative to the material ahead; 0 for a shock of no strength
};

/// Specific internal energy, whose differences are heat and work. That of a thermal law, whose e is thermal energy alone, is
/// completed by (de/drho)_T = (p - T dp/dT)/rho^2, so that its p(rho, T) is kept and no work is lost.
template <AnyLaw Law>
double internal_energy(const Law& law, double rho, double temperature) {
  if constexpr (Law::caloric == Caloric::thermal) {
    // In the volume relative to rho0, piece by piece: the compressed side bends sharply near its limit, and the two sides
    // join with a jump in curvature.
    const auto slope = [&](double volume) {
      const double density = law.reference_density / volume;
      const Dual<double> p = pressure_at(law, Dual<double>(density), Dual<double>::variable(temperature));
      return (temperature * p.derivative[0] - p.value) / law.reference_density;
    };
    constexpr int pieces = 32;
    const double volume = law.reference_density / rho;
    double sum = law.energy(rho, temperature);
    for (int i = 0; i < pieces; ++i) {
      const double a = 1.0 + (volume - 1.0) * i / pieces, b = 1.0 + (volume - 1.0) * (i + 1) / pieces;
      sum += integral(slope, a, b);
    }
    return sum;
  } else {
    return law.energy(rho, temperature);
  }
}

/// Behind the shock that compresses material at rho0, T0 to a density. None where the law has no such shock: beyond the
/// limiting compression of a gas, or on a release.
template <AnyLaw Law>
std::optional<ShockState> shock_to_density(const Law& law, double density, double temperature, double density_behind) {
  const double volume_change = 1.0 / density - 1.0 / density_behind;
  const double p0 = pressure_at(law, density, temperature), e0 = internal_energy(law, density, temperature);
  if (volume_change == 0.0) return ShockState{density, p0, temperature, e0, 0.0, 0.0};
  if (!(volume_change > 0.0)) return std::nullopt;
  // The gain of energy less the work of the mean pressure grows with T1 as long as that shock exists, and is linear in T1
  // for most laws.
  const auto internal = [&](double T1) { return internal_energy(law, density_behind, T1); };
  constexpr int most_steps = 60;
  const double cv = specific_heat_at_constant_volume(law, density_behind);
  const double e_cold = internal(0.0);
  double T1 = temperature;
  for (int i = 0; i < most_steps; ++i) {
    const Dual<double> p1 = pressure_at(law, Dual<double>(density_behind), Dual<double>::variable(T1));
    const double defect = e_cold + cv * T1 - e0 - 0.5 * (p0 + p1.value) * volume_change;
    const double slope = cv - 0.5 * p1.derivative[0] * volume_change;
    if (!(slope > 0.0)) return std::nullopt;
    const double step = defect / slope;
    T1 -= step;
    if (std::abs(step) <= 1e-14 * std::abs(T1)) break;
  }
  const double p1 = pressure_at(law, density_behind, T1);
  if (!(p1 > p0)) return std::nullopt;
  const double shock_velocity = std::sqrt((p1 - p0) / volume_change) / density;
  return ShockState{density_behind, p1, T1, internal(T1), shock_velocity, std::sqrt((p1 - p0) * volume_change)};
}

/// Behind the shock that sets material at rho0, T0 moving with a particle velocity. None where the law's range ends before.
template <AnyLaw Law>
std::optional<ShockState> shock_to_particle_velocity(const Law& law, double density, double temperature,
                                                     double particle_velocity) {
  if (particle_velocity == 0.0) return shock_to_density(law, density, temperature, density);
  const double highest = law.range().highest;
  const auto fast_enough = [&](double density_behind) {
    const auto behind = shock_to_density(law, density, temperature, density_behind);
    return !behind || behind->particle_velocity >= particle_velocity;
  };
  double below = density, above = std::min(2.0 * density, highest);
  while (!fast_enough(above)) {
    if (above >= highest) return std::nullopt;
    below = above;
    above = std::min(2.0 * above, highest);
  }
  for (double middle = 0.5 * (below + above); below < middle && middle < above; middle = 0.5 * (below + above))
    (fast_enough(middle) ? above : below) = middle;
  // Where shocks end at a limiting compression, the least density that counts as fast enough may have no shock.
  return shock_to_density(law, density, temperature, below > density ? below : above);
}

inline std::optional<ShockState> shock_to_density(const EquationOfState& law, double density, double temperature,
                                                  double density_behind) {
  return std::visit([&](const auto& l) { return shock_to_density(l, density, temperature, density_behind); }, law);
}
inline std::optional<ShockState> shock_to_particle_velocity(const EquationOfState& law, double density, double temperature,
                                                            double particle_velocity) {
  return std::visit([&](const auto& l) { return shock_to_particle_velocity(l, density, temperature, particle_velocity); }, law);
}

}  // namespace brisance::equation_of_state
