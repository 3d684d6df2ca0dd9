#include "simulator/gas/muscl_hllc.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace brisance::simulator::gas {
namespace {

double sound_speed(const GasState& w, double gamma) {
  return std::sqrt(gamma * w.pressure / w.density);
}
double energy_density(const GasState& w, double gamma) {
  return w.pressure / (gamma - 1.0) + 0.5 * w.density * w.velocity * w.velocity;
}
Conserved conserved(const GasState& w, double gamma) {
  return {w.density, w.density * w.velocity, energy_density(w, gamma)};
}
GasState primitive(const Conserved& u, double gamma) {
  const double velocity = u.momentum / u.mass;
  return {u.mass, velocity, (gamma - 1.0) * (u.energy - 0.5 * u.momentum * velocity)};
}
Conserved flux(const GasState& w, double gamma) {
  const double mass = w.density * w.velocity;
  return {mass, mass * w.velocity + w.pressure, (energy_density(w, gamma) + w.pressure) * w.velocity};
}
bool is_gas(const GasState& w) {
  return w.density > 0.0 && w.pressure > 0.0;
}

/// Monotonized central difference (van Leer 1977).
double limited(double backward, double forward) {
  if (backward * forward <= 0.0) return 0.0;
  const double least = std::min({2.0 * std::abs(backward), 2.0 * std::abs(forward), 0.5 * std::abs(backward + forward)});
  return std::copysign(least, forward);
}

/// The cells with two more beyond each end.
std::vector<GasState> with_neighbours(const Euler1D& gas) {
  const int size = static_cast<int>(gas.cells.size());
  const auto beyond = [&](const End& end, int i, int mirror, int nearest) {
    if (end.kind == EndKind::prescribed) return end.state(gas.centre(i), gas.time);
    GasState w = gas.cells[static_cast<std::size_t>(end.kind == EndKind::reflecting ? mirror : nearest)];
    if (end.kind == EndKind::reflecting) w.velocity = -w.velocity;
    return w;
  };
  std::vector<GasState> all{beyond(gas.at_lower, -2, 1, 0), beyond(gas.at_lower, -1, 0, 0)};
  all.insert(all.end(), gas.cells.begin(), gas.cells.end());
  all.push_back(beyond(gas.at_upper, size, size - 1, size - 1));
  all.push_back(beyond(gas.at_upper, size + 1, size - 2, size - 1));
  return all;
}

/// A cell half a step on: at its centre and at its two faces. Where that would leave no density or no pressure, as it is.
struct HalfStep {
  GasState below, centre, above;
};

HalfStep half_step(const Euler1D& gas, const GasState* w, double x, double dt) {
  const GasState slope = {limited(w[0].density - w[-1].density, w[1].density - w[0].density),
                          limited(w[0].velocity - w[-1].velocity, w[1].velocity - w[0].velocity),
                          limited(w[0].pressure - w[-1].pressure, w[1].pressure - w[0].pressure)};
  const auto [density, velocity, pressure] = *w;
  const double k = 0.5 * dt / gas.width();
  const double divergence = k * slope.velocity + 0.5 * dt * (gas.dimension - 1) * velocity / x;
  const GasState later = {density - k * velocity * slope.density - density * divergence,
                          velocity - k * (velocity * slope.velocity + slope.pressure / density),
                          pressure - k * velocity * slope.pressure - gas.gamma * pressure * divergence};
  const auto at = [&](double s) {
    return GasState{later.density + s * slope.density, later.velocity + s * slope.velocity,
                    later.pressure + s * slope.pressure};
  };
  const HalfStep half = {at(-0.5), later, at(0.5)};
  return is_gas(half.below) && is_gas(half.above) ? half : HalfStep{*w, *w, *w};
}

}  // namespace

double Euler1D::area(double x) const {
  return dimension == 1 ? 1.0 : dimension == 2 ? x : x * x;
}
double Euler1D::volume(double from, double to) const {
  // (to^d - from^d)/d without the loss of digits far from the centre.
  const double mean_area = dimension == 1   ? 1.0
                           : dimension == 2 ? 0.5 * (from + to)
                                            : (from * from + from * to + to * to) / 3.0;
  return (to - from) * mean_area;
}

Conserved totals(const Euler1D& gas) {
  Conserved sum;
  for (int i = 0; i < static_cast<int>(gas.cells.size()); ++i) {
    const double volume = gas.volume(gas.face(i), gas.face(i + 1));
    const Conserved u = conserved(gas.cells[static_cast<std::size_t>(i)], gas.gamma);
    sum.mass += volume * u.mass, sum.momentum += volume * u.momentum, sum.energy += volume * u.energy;
  }
  return sum;
}

Conserved hllc_flux(const GasState& left, const GasState& right, double gamma) {
  // Wave speeds of Einfeldt by Roe averages: with them density and pressure stay positive (Batten et al. 1997).
  const double root_left = std::sqrt(left.density), root_right = std::sqrt(right.density);
  const auto roe = [&](double a, double b) { return (root_left * a + root_right * b) / (root_left + root_right); };
  const auto enthalpy = [&](const GasState& w) { return (energy_density(w, gamma) + w.pressure) / w.density; };
  const double u = roe(left.velocity, right.velocity);
  const double c = std::sqrt((gamma - 1.0) * (roe(enthalpy(left), enthalpy(right)) - 0.5 * u * u));
  const double slowest = std::min(left.velocity - sound_speed(left, gamma), u - c);
  const double fastest = std::max(right.velocity + sound_speed(right, gamma), u + c);
  if (slowest >= 0.0) return flux(left, gamma);
  if (fastest <= 0.0) return flux(right, gamma);

  const double through_left = left.density * (slowest - left.velocity);
  const double through_right = right.density * (fastest - right.velocity);
  const double contact = (right.pressure - left.pressure + through_left * left.velocity - through_right * right.velocity) /
                         (through_left - through_right);
  const bool from_left = contact >= 0.0;
  const GasState& w = from_left ? left : right;
  const double wave = from_left ? slowest : fastest, through = from_left ? through_left : through_right;
  const double density = through / (wave - contact);
  const double energy =
      density * (energy_density(w, gamma) / w.density + (contact - w.velocity) * (contact + w.pressure / through));
  const Conserved f = flux(w, gamma), before = conserved(w, gamma);
  return {f.mass + wave * (density - before.mass), f.momentum + wave * (density * contact - before.momentum),
          f.energy + wave * (energy - before.energy)};
}

double stable_step(const Euler1D& gas, double courant) {
  double fastest = 0.0;
  for (const GasState& w : gas.cells) fastest = std::max(fastest, std::abs(w.velocity) + sound_speed(w, gas.gamma));
  return courant * gas.width() / fastest;
}

void advance(Euler1D& gas, double dt) {
  const std::size_t size = gas.cells.size();
  const std::vector<GasState> old = with_neighbours(gas);
  std::vector<HalfStep> halves(size + 2);
  for (std::size_t i = 0; i < size + 2; ++i) halves[i] = half_step(gas, &old[i + 1], gas.centre(static_cast<int>(i) - 1), dt);

  // Beyond a wall lies the mirror image of its cell, so that nothing passes it.
  const auto turned = [](const GasState& w) { return GasState{w.density, -w.velocity, w.pressure}; };
  const auto mirror = [&](const HalfStep& h) { return HalfStep{turned(h.above), turned(h.centre), turned(h.below)}; };
  if (gas.at_lower.kind == EndKind::reflecting) halves.front() = mirror(halves[1]);
  if (gas.at_upper.kind == EndKind::reflecting) halves.back() = mirror(halves[size]);

  std::vector<Conserved> fluxes(size + 1);
  for (std::size_t i = 0; i <= size; ++i) fluxes[i] = hllc_flux(halves[i].above, halves[i + 1].below, gas.gamma);
  for (std::size_t i = 0; i < size; ++i) {
    const double from = gas.face(static_cast<int>(i)), to = gas.face(static_cast<int>(i) + 1);
    const double k = dt / gas.volume(from, to), below = k * gas.area(from), above = k * gas.area(to);
    const double beside = (above - below) * halves[i + 1].centre.pressure;  // impulse of the neighbours around the axis
    Conserved u = conserved(old[i + 2], gas.gamma);
    u.mass -= above * fluxes[i + 1].mass - below * fluxes[i].mass;
    u.momentum -= above * fluxes[i + 1].momentum - below * fluxes[i].momentum - beside;
    u.energy -= above * fluxes[i + 1].energy - below * fluxes[i].energy;
    gas.cells[i] = primitive(u, gas.gamma);
    if (!is_gas(gas.cells[i])) throw std::runtime_error("no density or no pressure is left in a cell");
  }
  gas.time += dt;
}

void advance_to(Euler1D& gas, double time, double courant) {
  while (gas.time < time) {
    const double dt = stable_step(gas, courant);
    // The last step ends on the time itself.
    const bool last = gas.time + dt >= time;
    advance(gas, last ? time - gas.time : dt);
    if (last) gas.time = time;
  }
}

}  // namespace brisance::simulator::gas
