#pragma once
// Gas in a closed tube, one end of which is a burning solid: an ideal gas on cells that stretch from the receding surface to
// the wall, with fluxes of the comparison solver and the balances of mass, momentum and energy at the surface. Nothing of it is
// shared with the solver that keeps solid and gas in the same cells.

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/gas/muscl_hllc.hpp"

namespace brisance::simulator::gas {

struct BurningSurface {
  double gamma = 1.4;
  double length = 0.1;                          // m, of the tube
  double solid_density = 0.0, thickness = 0.0;  // kg/m^3, m; at rest and incompressible
  double energy = 0.0;                          // J/kg, of the solid, with the heat that burning sets free
  double coefficient = 0.0, exponent = 0.0, reference_pressure = 0.0;  // kg/(m^2 s) = coefficient (p/reference)^exponent
  std::vector<Conserved> cells{};                                      // kg/m^2, kg/(m s), J/m^2: from the surface to the wall
  double time = 0.0, burned = 0.0;                                     // s, kg/m^2

  double place() const { return thickness - burned / solid_density; }  // m, of the surface
  double width() const { return (length - place()) / static_cast<double>(cells.size()); }
  GasState state(std::size_t cell) const {
    const Conserved& u = cells[cell];
    const double velocity = u.momentum / u.mass;
    return {u.mass / width(), velocity, (gamma - 1.0) * (u.energy - 0.5 * u.momentum * velocity) / width()};
  }
};

inline void fill(BurningSurface& tube, int cells, double density, double pressure) {
  const double width = (tube.length - tube.place()) / cells;
  tube.cells.assign(static_cast<std::size_t>(cells), {width * density, 0.0, width * pressure / (tube.gamma - 1.0)});
}
inline Conserved totals(const BurningSurface& tube) {
  Conserved sum;
  for (const Conserved& u : tube.cells) sum.mass += u.mass, sum.momentum += u.momentum, sum.energy += u.energy;
  return sum;
}
inline double mean_pressure(const BurningSurface& tube) {
  double sum = 0.0;
  for (std::size_t i = 0; i < tube.cells.size(); ++i) sum += tube.state(i).pressure;
  return sum / static_cast<double>(tube.cells.size());
}

/// What leaves the surface, kg/(m^2 s), and the pressure on the solid, Pa: above that of the gas by the momentum of what
/// leaves.
struct Outflow {
  double flux = 0.0, pressure = 0.0;
};
/// The gas leaves with the speed v against the surface and w against the tube, and with the pressure
///   p = flux (energy - w^2/2)/(v/(gamma - 1) + w)    of the balance of energy,
///   p = p_next + Z (w - u_next)                       of the wave that runs from the surface into the gas.
inline Outflow pressed_by(const BurningSurface& tube, double flux, const GasState& next) {
  const double impedance = std::sqrt(tube.gamma * next.pressure * next.density), recession = flux / tube.solid_density;
  const auto balance = [&](double v) {
    const double w = v - recession;
    return flux * (tube.energy - 0.5 * w * w) / (v / (tube.gamma - 1.0) + w);
  };
  double low = recession, high = std::sqrt(2.0 * tube.energy);
  constexpr int halvings = 50;
  for (int n = 0; n < halvings; ++n) {
    const double v = 0.5 * (low + high);
    (balance(v) > next.pressure + impedance * (v - recession - next.velocity) ? low : high) = v;
  }
  return {flux, balance(low) + flux * (low - recession)};
}
/// The flux that its own pressure burns.
inline Outflow outflow(const BurningSurface& tube) {
  const GasState next = tube.state(0);
  const auto burned_by = [&](double pressure) {
    return tube.coefficient * std::pow(pressure / tube.reference_pressure, tube.exponent);
  };
  double low = 0.0, high = 10.0 * burned_by(next.pressure);
  constexpr int halvings = 40;
  for (int n = 0; n < halvings; ++n) {
    const double flux = 0.5 * (low + high);
    (burned_by(pressed_by(tube, flux, next).pressure) > flux ? low : high) = flux;
  }
  return pressed_by(tube, low, next);
}

/// dt times the rates of change.
struct Change {
  std::vector<Conserved> cells;
  double burned;
};
inline Change change(const BurningSurface& tube, double dt) {
  const std::size_t count = tube.cells.size();
  std::vector<GasState> w;
  for (std::size_t i = 0; i < count; ++i) w.push_back(tube.state(i));
  const auto at = [&](std::size_t i, double part) {
    if (i == 0 || i + 1 == count) return w[i];
    const auto value = [&](auto member) {
      const double a = w[i].*member - w[i - 1].*member, b = w[i + 1].*member - w[i].*member;
      const double size = std::min({2.0 * std::abs(a), 2.0 * std::abs(b), 0.5 * std::abs(a + b)});
      return w[i].*member + (a * b > 0.0 ? part * std::copysign(size, a) : 0.0);
    };
    return GasState{value(&GasState::density), value(&GasState::velocity), value(&GasState::pressure)};
  };
  const Outflow out = outflow(tube);
  Change c{std::vector<Conserved>(count), dt * out.flux};
  c.cells[0] = {dt * out.flux, dt * out.pressure, dt * out.flux * tube.energy};
  for (std::size_t f = 1; f <= count; ++f) {
    // The face moves with a part of the surface's speed, and the flux is found as it sees the gas.
    const double speed = -out.flux / tube.solid_density * (1.0 - static_cast<double>(f) / static_cast<double>(count));
    const auto seen = [&](GasState g) { return g.velocity -= speed, g; };
    const GasState low = seen(at(f - 1, 0.5));
    const GasState high = f < count ? seen(at(f, -0.5)) : GasState{low.density, -low.velocity, low.pressure};
    const Conserved flux = hllc_flux(low, high, tube.gamma);
    const double mass = dt * flux.mass, momentum = dt * (flux.momentum + speed * flux.mass),
                 energy = dt * (flux.energy + speed * (flux.momentum + 0.5 * speed * flux.mass));
    const auto add = [&](Conserved& to, double sign) {
      to.mass += sign * mass, to.momentum += sign * momentum, to.energy += sign * energy;
    };
    add(c.cells[f - 1], -1.0);
    if (f < count) add(c.cells[f], 1.0);
  }
  return c;
}

/// Steps up to a time by Heun's rule.
inline void advance_to(BurningSurface& tube, double end, double courant = 0.4) {
  const auto add = [&](const Change& c, double part) {
    for (std::size_t i = 0; i < tube.cells.size(); ++i)
      tube.cells[i].mass += part * c.cells[i].mass, tube.cells[i].momentum += part * c.cells[i].momentum,
          tube.cells[i].energy += part * c.cells[i].energy;
    tube.burned += part * c.burned;
  };
  while (tube.time < end) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < tube.cells.size(); ++i) {
      const GasState w = tube.state(i);
      fastest = std::max(fastest, std::abs(w.velocity) + std::sqrt(tube.gamma * w.pressure / w.density));
    }
    const double longest = courant * tube.width() / fastest;
    const bool last = tube.time + longest >= end;
    const double dt = last ? end - tube.time : longest;
    const Change first = change(tube, dt);
    add(first, 1.0);
    const Change second = change(tube, dt);
    add(first, -0.5), add(second, 0.5);
    tube.time = last ? end : tube.time + dt;
  }
}

}  // namespace brisance::simulator::gas
