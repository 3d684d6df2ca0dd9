#pragma once
// The Riemann problem of two stiffened gases p = (gamma - 1) rho e - gamma p_infinity, each with constants of its own, solved
// exactly (Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. 2009, ch. 4; Ivings, Causon and Toro,
// Int. J. Numer. Methods Fluids 28, 1998, for the stiffened gas). The contact keeps the two apart.

#include <cmath>
#include <limits>

#include "simulator/gas/gas_state.hpp"

namespace brisance::simulator::gas {

/// An ideal gas where p_infinity (Pa) is 0.
struct StiffenedGas {
  double gamma = 1.4, p_infinity = 0.0;

  double sound_speed(const GasState& w) const { return std::sqrt(gamma * (w.pressure + p_infinity) / w.density); }
  /// Internal and kinetic energy per volume, J/m^3.
  double energy_density(const GasState& w) const {
    return (w.pressure + gamma * p_infinity) / (gamma - 1.0) + 0.5 * w.density * w.velocity * w.velocity;
  }
};

/// Mean of a state over a cell, by the midpoints of `parts` parts of equal width, weighted with their volumes where x is the
/// distance from an axis (dimension 2) or a centre (3). `state_at(x)` gives the state.
template <class StateAt>
GasState cell_average(const StateAt& state_at, double from, double to, int dimension = 1, int parts = 20) {
  GasState sum{};
  double total = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double x = from + (to - from) * (k + 0.5) / parts, width = (to - from) / parts;
    const double weight = dimension == 1 ? 1.0 : dimension == 2 ? x : x * x + width * width / 12.0;
    const GasState w = state_at(x);
    total += weight, sum.density += weight * w.density;
    sum.velocity += weight * w.velocity, sum.pressure += weight * w.pressure;
  }
  return {sum.density / total, sum.velocity / total, sum.pressure / total};
}

/// The solution depends on x/t alone. Where the gases part faster than they can expand, a vacuum of density 0 opens between
/// them, at the pressure at which the first of them is torn: 0 when one is ideal. In it the velocity is x/t. One side may be a
/// vacuum from the start (density 0).
class ExactRiemann {
 public:
  ExactRiemann(const GasState& left, const StiffenedGas& left_gas, const GasState& right, const StiffenedGas& right_gas)
      : left_{left, left_gas, -1.0}, right_{right, right_gas, 1.0} {
    const double tearing = std::fmax(-left_gas.p_infinity, -right_gas.p_infinity);
    vacuum_ = left_.empty() || right_.empty() || excess(tearing) >= 0.0;
    star_pressure_ = vacuum_ ? tearing : pressure_without_excess(tearing);
    left_.expand_or_compress(star_pressure_), right_.expand_or_compress(star_pressure_);
    // Alike but for round-off where there is no vacuum; one velocity keeps the contact a line.
    if (!vacuum_) left_.velocity = right_.velocity = 0.5 * (left_.velocity + right_.velocity);
  }
  ExactRiemann(const GasState& left, const GasState& right, double gamma = 1.4)
      : ExactRiemann(left, StiffenedGas{gamma}, right, StiffenedGas{gamma}) {}

  bool has_vacuum() const { return vacuum_; }
  double star_pressure() const { return star_pressure_; }
  /// Without a vacuum.
  double star_velocity() const { return 0.5 * (left_.velocity + right_.velocity); }
  double left_star_density() const { return left_.density; }
  double right_star_density() const { return right_.density; }
  /// Speeds of a shock (both alike) or of the edges of a rarefaction: next to the undisturbed gas, next to the contact.
  double left_head() const { return left_.head; }
  double left_tail() const { return left_.tail; }
  double right_head() const { return right_.head; }
  double right_tail() const { return right_.tail; }

  /// The state on the ray x/t = speed.
  GasState at(double speed) const {
    if (speed <= left_.velocity) return left_.at(speed, star_pressure_);
    if (speed >= right_.velocity) return right_.at(speed, star_pressure_);
    return {0.0, speed, star_pressure_};
  }
  /// The material on the ray; that of the right side in a vacuum.
  const StiffenedGas& gas_at(double speed) const { return speed <= left_.velocity ? left_.gas : right_.gas; }

  /// Mean state between two places at a time, the gases having met at x = origin at t = 0.
  GasState average(double from, double to, double time, double origin = 0.0) const {
    return cell_average([&](double x) { return at((x - origin) / time); }, from, to);
  }

 private:
  /// One of the two gases with the wave that runs into it, in direction `sign`.
  struct Side {
    GasState before;
    StiffenedGas gas;
    double sign;
    double density = 0.0, velocity = 0.0, head = 0.0, tail = 0.0;  // at the contact; of the wave

    bool empty() const { return before.density <= 0.0; }

    /// Change of velocity, against the direction of the wave for expansion, from the state before to the pressure p.
    double velocity_change(double p) const {
      const double g = gas.gamma, stiff_before = before.pressure + gas.p_infinity, stiff = p + gas.p_infinity;
      if (p > before.pressure)
        return (p - before.pressure) / std::sqrt(0.5 * before.density * ((g + 1.0) * stiff + (g - 1.0) * stiff_before));
      return 2.0 * gas.sound_speed(before) / (g - 1.0) * (std::pow(stiff / stiff_before, 0.5 * (g - 1.0) / g) - 1.0);
    }

    void expand_or_compress(double p) {
      if (empty()) {
        head = tail = velocity = sign * std::numeric_limits<double>::infinity();
        return;
      }
      const double g = gas.gamma, ratio = (p + gas.p_infinity) / (before.pressure + gas.p_infinity);
      velocity = before.velocity + sign * velocity_change(p);
      if (p > before.pressure) {
        const double k = (g - 1.0) / (g + 1.0);
        density = before.density * (ratio + k) / (k * ratio + 1.0);
        head = tail = before.velocity + sign * gas.sound_speed(before) * std::sqrt(0.5 * ((g + 1.0) * ratio + g - 1.0) / g);
      } else {
        density = before.density * std::pow(ratio, 1.0 / g);
        head = before.velocity + sign * gas.sound_speed(before);
        tail = velocity + sign * gas.sound_speed(before) * std::pow(ratio, 0.5 * (g - 1.0) / g);
      }
    }

    GasState at(double speed, double p) const {
      if (sign * (speed - head) >= 0.0) return before;
      if (sign * (speed - tail) <= 0.0) return {density, velocity, p};
      // Inside the fan the characteristic through this ray carries the invariant of the gas before it.
      const double g = gas.gamma, c = gas.sound_speed(before);
      const double fan_velocity = 2.0 / (g + 1.0) * (speed + 0.5 * (g - 1.0) * before.velocity - sign * c);
      const double cooling = sign * (speed - fan_velocity) / c;  // of the sound speed
      return {before.density * std::pow(cooling, 2.0 / (g - 1.0)), fan_velocity,
              (before.pressure + gas.p_infinity) * std::pow(cooling, 2.0 * g / (g - 1.0)) - gas.p_infinity};
    }
  };

  /// By how much the gases part if the waves bring both to the pressure p: it rises with p.
  double excess(double p) const {
    return right_.before.velocity - left_.before.velocity + left_.velocity_change(p) + right_.velocity_change(p);
  }

  /// Bisection down to neighbouring numbers: as exact for a vacuum almost reached as for a strong shock.
  double pressure_without_excess(double low) const {
    double high = std::fmax(std::fmax(left_.before.pressure, right_.before.pressure), 1e-300);
    while (excess(high) < 0.0) low = high, high *= 2.0;
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
      (excess(middle) > 0.0 ? high : low) = middle;
    return 0.5 * (low + high);
  }

  Side left_, right_;
  bool vacuum_ = false;
  double star_pressure_ = 0.0;
};

}  // namespace brisance::simulator::gas
