#pragma once
// Fans that open at a face. A cell from which gas rushes into a much lower pressure lets out what has expanded in the fan of a
// rarefaction, dense and slow where it begins, thin and fast at its tail. A mean over the cell, with any slopes, mixes the two:
// it lets out gas that is too slow and too hot. What passes the old place of the face in a step is the one state of the fan
// that stands there: that of its tail, or where the tail is faster than its sound the state with u = c
// (Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. 2009, ch. 4.4).

#include <cmath>
#include <optional>

#include "models/real.hpp"
#include "simulator/gas/gas_state.hpp"

namespace brisance::simulator::gas {

/// A face of a pencil at which fans may open, until the remap lets their flow out.
struct Fan {
  int axis = 0, pencil = 0, face = 0;
  LanesMask opens;                    // in these lanes
  Lanes density, velocity, pressure;  // kg/m^3, m/s, Pa: before the fan, as the donor sends them; velocity along the axis
  Lanes gamma, p_infinity;            // 1, Pa: of the stiffened gas with the donor's sound speed and Gruneisen coefficient
  Lanes tail_pressure;                // Pa, of the face
  Lanes area_time;                    // m^2 s, area of the old place times the step
};

/// Whether a fan may open: the pressure falls by much of what compresses the gas. What is no fan the remap finds out.
inline LanesMask may_open_fan(const Lanes& pressure, const Lanes& face_pressure, const Lanes& bulk_modulus) {
  constexpr double least = 0.05;
  return pressure - face_pressure > least * bulk_modulus;
}

/// The state that passes the old place of the face; velocities are positive outwards. None where the fan is shallow, as the
/// slopes of the cells know its flow, or where it has been carried off.
inline std::optional<GasState> state_at_old_place(const GasState& head, double gamma, double p_infinity, double tail_pressure) {
  constexpr double least_gruneisen = 0.05;  // below, what expands does not cool
  constexpr double slowing = 0.9;           // part of the sound speed that is left at the tail
  const double from = head.pressure + p_infinity, to = std::fmax(tail_pressure + p_infinity, 0.0);
  if (!(gamma > 1.0 + least_gruneisen) || !(from > 0.0) || !(to < from)) return {};
  const double half = 0.5 * (gamma - 1.0), sound = std::sqrt(gamma * from / head.density);
  const double left = std::pow(to / from, half / gamma), tail_velocity = head.velocity + sound / half * (1.0 - left);
  if (left > slowing || head.velocity >= sound) return {};
  // u + c/half is the same throughout the fan.
  const bool sonic = tail_velocity > left * sound;
  const double here = sonic ? (half * head.velocity / sound + 1.0) / (half + 1.0) : left;  // c over that before the fan
  const double velocity = sonic ? here * sound : tail_velocity;
  if (!(velocity > 0.0)) return {};
  return GasState{head.density * std::pow(here, 1.0 / half), velocity, from * std::pow(here, gamma / half) - p_infinity};
}

/// What a fan lets out of the donor beyond what the Lagrangian phase has done to it. Positive outwards but for the momentum.
struct FanFlow {
  double mass = 0.0, momentum = 0.0, energy = 0.0;  // kg; N s, along the axis; J, without motion along the face
};
/// Of one lane, where the face has swept so much (m^3, along the axis). `energy_of(density, pressure)`: J/kg, of the fluid.
template <class Energy>
std::optional<FanFlow> flow_of(const Fan& fan, int lane, double swept, const Energy& energy_of) {
  const double outward = swept > 0.0 ? 1.0 : -1.0, gamma = fan.gamma[lane], p_infinity = fan.p_infinity[lane];
  const GasState head{fan.density[lane], outward * fan.velocity[lane], fan.pressure[lane]};
  const double tail_pressure = fan.tail_pressure[lane], area_time = fan.area_time[lane];
  const std::optional<GasState> state = state_at_old_place(head, gamma, p_infinity, tail_pressure);
  if (!state) return {};
  const auto [density, velocity, pressure] = *state;
  const double mass = area_time * density * velocity;
  // What has expanded is nowhere denser than before. Where a face stands still between gases that part no fan passes it.
  if (!(mass < head.density * outward * swept)) return {};
  const auto stiffened = [&](const GasState& w) { return (w.pressure + gamma * p_infinity) / ((gamma - 1.0) * w.density); };
  const double energy = energy_of(head.density, head.pressure) - stiffened(head) + stiffened(*state);
  return FanFlow{
      mass, area_time * (pressure - tail_pressure) + mass * velocity,
      mass * (energy + 0.5 * velocity * velocity) + area_time * pressure * velocity - tail_pressure * outward * swept};
}

}  // namespace brisance::simulator::gas
