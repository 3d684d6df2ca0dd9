#pragma once
// The state of Chapman and Jouguet of products by the law of Jones, Wilkins and Lee, from their parameters alone, and the flow
// behind a detonation that runs in it.

#include <cmath>
#include <vector>

#include "models/equation_of_state/jones_wilkins_lee.hpp"
#include "simulator/gas/gas_state.hpp"

namespace brisance::simulator::gas {

struct ChapmanJouguet {
  double velocity, pressure, density, particle_velocity;
};
/// The least steep Rayleigh line that touches the detonation adiabat, by golden section. The adiabat in its usual form
/// p(V, E) with E = E0 + p (1 - V)/2 per volume of the explosive, the atmosphere neglected.
inline ChapmanJouguet tangent(const equation_of_state::JonesWilkinsLee& j) {
  const auto adiabat = [&](double V) {
    const double cold =
        j.A * (1.0 - j.omega / (j.R1 * V)) * std::exp(-j.R1 * V) + j.B * (1.0 - j.omega / (j.R2 * V)) * std::exp(-j.R2 * V);
    return (cold + j.omega / V * j.detonation_energy) / (1.0 - 0.5 * j.omega / V * (1.0 - V));
  };
  const auto steepness = [&](double V) { return adiabat(V) / (1.0 - V); };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = 0.55, high = 0.95;
  while (high - low > 1e-9) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (steepness(a) < steepness(b) ? high : low) = steepness(a) < steepness(b) ? b : a;
  }
  const double V = 0.5 * (low + high), p = adiabat(V), D = std::sqrt(steepness(V) / j.reference_density);
  return {D, p, j.reference_density / V, p / (j.reference_density * D)};
}

/// Where, over the time since the start, a state is.
struct WaveState {
  double speed;  // m/s
  GasState state;
};
/// The wave of Taylor behind a detonation that starts at a wall: a centred simple wave along the isentrope p = A exp(-R1 V) +
/// B exp(-R2 V) + C/V^(1 + omega) of the state of Chapman and Jouguet, from the gas at rest, which ends at the first of its
/// states, to the front.
inline std::vector<WaveState> taylor_wave(const equation_of_state::JonesWilkinsLee& j) {
  const ChapmanJouguet cj = tangent(j);
  const double start = j.reference_density / cj.density;
  const auto exponentials = [&](double V) { return j.A * std::exp(-j.R1 * V) + j.B * std::exp(-j.R2 * V); };
  const double C = (cj.pressure - exponentials(start)) * std::pow(start, 1.0 + j.omega);
  const auto pressure = [&](double V) { return exponentials(V) + C * std::pow(V, -1.0 - j.omega); };
  const auto sound = [&](double V) {
    const double slope =
        j.R1 * j.A * std::exp(-j.R1 * V) + j.R2 * j.B * std::exp(-j.R2 * V) + (1.0 + j.omega) * C * std::pow(V, -2.0 - j.omega);
    return V * std::sqrt(slope / j.reference_density);
  };
  std::vector<WaveState> wave;
  constexpr double step = 1e-5;
  constexpr int steps_per_state = 200;
  const auto add = [&](double V, double u) {
    wave.insert(wave.begin(), {u + sound(V), {j.reference_density / V, u, pressure(V)}});
  };
  // u + integral of c dV/V is the same everywhere.
  double V = start, u = cj.particle_velocity, next = u;
  for (int n = 0;; ++n, V += step, u = next) {
    if (n % steps_per_state == 0) add(V, u);
    next = u - sound(V + 0.5 * step) * step / (V + 0.5 * step);
    if (next <= 0.0) break;
  }
  add(V + step * u / (u - next), 0.0);
  return wave;
}

}  // namespace brisance::simulator::gas
