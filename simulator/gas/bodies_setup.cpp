#include "simulator/gas/bodies_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "simulator/solid/shapes.hpp"
#include "simulator/thickness.hpp"

namespace brisance::simulator::gas {
namespace {

/// A radial motion about the centre needs particles that are not on it, and that have room to move inwards.
void check_radial_motion(const GasBodyConfig& config, const MovingBody& body) {
  for (const Vector& place : body.places)
    if (config.radial_velocity != 0.0 && magnitude(place) == 0.0)
      throw std::runtime_error(
          fmt::format("{}: a particle lies on the centre of the radial motion; only hollow bodies can grow or shrink about it",
                      config.name));
}

}  // namespace

MovingBody make_body(const Case& c, const GasBodyConfig& config) {
  MovingBody body;
  body.name = config.name, body.centre = config.centre;
  const auto D = static_cast<std::size_t>(c.dimensions());
  const double spacing = c.cell_size / config.particles_per_direction;
  const bool round = c.geometry == Geometry::axisymmetric;
  const Bounds box = bounds(*config.shape);
  std::array<int, 3> first{}, last{0, 0, 1};
  for (std::size_t a = 0; a < D; ++a) {
    const double lower = round && a == 0 ? std::max(box.lower[a], 0.0) : box.lower[a];
    first[a] = static_cast<int>(std::floor(lower / spacing)), last[a] = static_cast<int>(std::ceil(box.upper[a] / spacing));
  }
  for (int k = first[2]; k < last[2]; ++k)
    for (int j = first[1]; j < last[1]; ++j)
      for (int i = first[0]; i < last[0]; ++i) {
        const std::array<int, 3> index{i, j, k};
        Vector lower{}, upper{}, middle{};
        for (std::size_t a = 0; a < D; ++a)
          lower[a] = index[a] * spacing, upper[a] = (index[a] + 1) * spacing, middle[a] = (index[a] + 0.5) * spacing;
        const double filled = filled_fraction(*config.shape, c.geometry, lower, upper, samples_per_direction);
        if (filled == 0.0) continue;
        body.places.push_back(middle - config.centre);
        body.volumes.push_back(filled * std::pow(spacing, static_cast<double>(D)) * (round ? middle[0] : 1.0));
      }
  if (body.places.empty())
    throw std::runtime_error(
        fmt::format("{}: the body gets no particles; its shape must reach a middle of the parts of {:.4g} m "
                    "into which the cells are cut",
                    config.name, spacing / samples_per_direction));
  check_radial_motion(config, body);
  const auto amplitude = [table = config.amplitude](double time) { return table ? (*table)(time) : 1.0; };
  if (config.velocity != Vector{}) body.motion.velocity = [=, v = config.velocity](double time) { return amplitude(time) * v; };
  if (config.rotation != Vector{}) body.motion.rotation = [=, w = config.rotation](double time) { return amplitude(time) * w; };
  if (config.radial_velocity != 0.0)
    body.motion.radial_velocity = [=, v = config.radial_velocity](double time) { return amplitude(time) * v; };
  body.motion.radius = config.radius;
  if (config.mass) body.mass = *config.mass / (round ? 2.0 * std::numbers::pi : 1.0);
  body.axis = static_cast<int>(config.axis);
  return body;
}

std::vector<std::string> warnings_of_bodies(const Case& c) {
  std::vector<std::string> warnings;
  if (!c.gas) return warnings;
  constexpr double least_cells = 2.0;
  // What walls mirror makes a body thicker.
  Case mirrored = c;
  for (std::size_t side = 0; side < static_cast<std::size_t>(2 * c.dimensions()); ++side) {
    const bool wall = std::none_of(c.gas->edges.begin(), c.gas->edges.end(), [&](const EdgeConfig& edge) {
      return edge.side == static_cast<BoxSide>(side) && edge.kind != EdgeKind::wall;
    });
    if (!wall) continue;
    BoundaryConfig plane;
    plane.axis = static_cast<Axis>(side / 2), plane.side = side % 2 == 0 ? Side::above : Side::below;
    plane.position = (side % 2 == 0 ? c.gas->lower : c.gas->upper)[side / 2];
    mirrored.boundaries.push_back(plane);
  }
  for (std::size_t n = 0; n < c.gas->bodies.size(); ++n) {
    const GasBodyConfig& body = c.gas->bodies[n];
    const Bounds extent = bounds(*body.shape);
    const auto apart = [&](const Vector& lower, const Vector& upper) {
      for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a)
        if (extent.upper[a] <= lower[a] || extent.lower[a] >= upper[a]) return true;
      return false;
    };
    if (apart(c.gas->lower, c.gas->upper))
      warnings.push_back(fmt::format("{}: it starts outside the box of the gas", body.name));
    for (std::size_t m = 0; m < n; ++m) {
      const Bounds other = bounds(*c.gas->bodies[m].shape);
      if (!apart(other.lower, other.upper))
        warnings.push_back(fmt::format("{} and {}: their boxes overlap; bodies in the gas know nothing of each other",
                                       body.name, c.gas->bodies[m].name));
    }
    if (const auto thin = thinnest_part(mirrored, *body.shape, least_cells * c.cell_size))
      warnings.push_back(
          fmt::format("{}: near ({:.4g}, {:.4g}, {:.4g}) m it is {:.2g} cells thick, fewer than {:g}: gas may leak "
                      "through it; take smaller cells or make it thicker",
                      body.name, thin->place[0], thin->place[1], thin->place[2], thin->thickness / c.cell_size, least_cells));
  }
  return warnings;
}

}  // namespace brisance::simulator::gas
