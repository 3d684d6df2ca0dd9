#pragma once
// Bodies of particles by hand: points of a lattice, turned by an angle, that a shape holds.

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

}  // namespace brisance::simulator::gas::set_up
