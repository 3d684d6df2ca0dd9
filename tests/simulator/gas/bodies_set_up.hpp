#pragma once
// Bodies of particles by hand: points of a lattice, turned by an angle, that a shape holds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas::set_up {

/// A body of the points of a lattice (two per cell and direction), each with the part of its lattice cell that lies where
/// `inside` says. The lattice of the plane is turned by an angle (rad).
inline MovingBody body_of(Geometry geometry, double cell_size, const Vector& centre, double reach,
                          const std::function<bool(const Vector& from_centre)>& inside, double lattice_angle = 0.0) {
  MovingBody body;
  body.name = "body", body.centre = centre;
  const double spacing = 0.5 * cell_size;
  const int n = static_cast<int>(std::ceil(1.5 * reach / spacing));
  const bool space = geometry == Geometry::three_dimensional, round = geometry == Geometry::axisymmetric;
  for (int k = space ? -n : 0; k < (space ? n : 1); ++k)
    for (int j = -n; j < n; ++j)
      for (int i = round ? 0 : -n; i < n; ++i) {
        const double c = std::cos(lattice_angle), s = std::sin(lattice_angle);
        const auto turned = [&](double x, double y, double z) { return Vector{c * x - s * y, s * x + c * y, z}; };
        constexpr int samples = 4;
        int filled = 0;
        for (int n3 = 0; n3 < (space ? samples : 1); ++n3)
          for (int n2 = 0; n2 < samples; ++n2)
            for (int n1 = 0; n1 < samples; ++n1)
              filled += inside(turned((i + (n1 + 0.5) / samples) * spacing, (j + (n2 + 0.5) / samples) * spacing,
                                      space ? (k + (n3 + 0.5) / samples) * spacing : 0.0));
        if (filled == 0) continue;
        const Vector x = turned((i + 0.5) * spacing, (j + 0.5) * spacing, space ? (k + 0.5) * spacing : 0.0);
        body.places.push_back(x);
        body.volumes.push_back(filled / std::pow(samples, space ? 3 : 2) * spacing * spacing *
                               (space   ? spacing
                                : round ? centre[0] + x[0]
                                        : 1.0));
      }
  return body;
}
inline MovingBody ball(Geometry geometry, double cell_size, const Vector& centre, double radius, double lattice_angle = 0.0,
                       double inner_radius = 0.0) {
  return body_of(
      geometry, cell_size, centre, radius,
      [=](const Vector& x) { return magnitude(x) < radius && magnitude(x) >= inner_radius; }, lattice_angle);
}
inline void give_velocity(MovingBody& body, const Vector& velocity) {
  body.motion.velocity = [velocity](double) { return velocity; };
}

inline constexpr double round_off = 1e-12;  // of sums that have passed hundreds of steps

/// f(cell, open part) for the cells that hold gas.
template <class F>
void for_each_gas_cell(const Gas& gas, F&& f) {
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const double open = open_part(gas, c.block, c.number);
    if (open > 0.0) f(c, open);
  });
}

/// The books of a step: what the gas holds now that it neither held at the start nor received.
inline void expect_closed_books(const Gas& gas, Domain& domain, const std::string& what) {
  Totals rest = totals(gas, domain);
  double gross = 0.0;
  for (const Totals& through : passed(gas, domain)) {
    for (std::size_t r = 0; r < rest.mass.size(); ++r) rest.mass[r] -= through.mass[r];
    rest.momentum = rest.momentum - through.momentum, rest.energy -= through.energy;
    gross += magnitude(through.momentum);
  }
  for (std::size_t r = 0; r < rest.mass.size(); ++r)
    EXPECT_NEAR(rest.mass[r], gas.initial.mass[r], round_off * gas.initial.mass[r]) << what;
  EXPECT_NEAR(rest.energy, gas.initial.energy, round_off * gas.initial.energy) << what;
  if (is_round(gas.cells.geometry)) rest.momentum[0] = gas.initial.momentum[0];  // walls push along the radius
  const double motion = std::sqrt(2.0 * gas.initial.mass[0] * gas.initial.energy);
  EXPECT_LT(magnitude(rest.momentum - gas.initial.momentum), round_off * (motion + gross)) << what;
}

/// Change of a pressure that was 1 everywhere: the largest, the mean over the gas.
struct Noise {
  double worst = 0.0, mean = 0.0;
};
inline Noise noise_in(const Gas& gas) {
  Noise noise;
  double sum = 0.0, volume = 0.0;
  for_each_gas_cell(gas, [&](const Cell& c, double open) {
    noise.worst = std::max(noise.worst, std::abs(c.pressure - 1.0));
    sum += open * c.volume * std::abs(c.pressure - 1.0), volume += open * c.volume;
  });
  noise.mean = sum / volume;
  return noise;
}

}  // namespace brisance::simulator::gas::set_up
