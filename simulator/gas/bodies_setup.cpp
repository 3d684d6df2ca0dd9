#include "simulator/gas/bodies_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <unordered_map>

#include "simulator/gas/gas.hpp"
#include "simulator/gas/node_spline.hpp"
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

/// Its name, centre and particles.
MovingBody body_of(const Case& c, const GasBodyConfig& config) {
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
  return body;
}

/// How full of a body the fullest node of the grid is. What is near a wall of the box has a mirror image in the place of what
/// lies beyond it.
double fullest_node(const Case& c, const GasBodyConfig& config) {
  const MovingBody body = body_of(c, config);
  const double h = c.cell_size;
  const auto D = static_cast<std::size_t>(c.dimensions());
  const auto key_of = [](const std::array<NodesOnLine, 3>& s, int i, int j, int k) {
    constexpr std::int64_t many = 1 << 21;
    return ((s[2].first + k) * many + s[1].first + j) * many + s[0].first + i;
  };
  std::unordered_map<std::int64_t, double> fraction;
  for (std::size_t p = 0; p < body.places.size(); ++p) {
    const Vector x = body.centre + body.places[p];
    const double volume = body.volumes[p] / (c.geometry == Geometry::axisymmetric ? x[0] : 1.0);
    std::vector<Vector> images = {x};
    for (std::size_t side = 0; side < 2 * D; ++side) {
      if (!is_wall(c, side)) continue;
      const double plane = (side % 2 == 0 ? c.gas->lower : c.gas->upper)[side / 2];
      const double inwards = (side % 2 == 0 ? 1.0 : -1.0) * (x[side / 2] - plane);
      if (inwards < 0.0) images.clear();
      if (inwards > 2.0 * h) continue;
      for (std::size_t k = 0, before = images.size(); k < before; ++k) {
        images.push_back(images[k]);
        images.back()[side / 2] = 2.0 * plane - x[side / 2];
      }
    }
    for (const Vector& image : images) {
      std::array<NodesOnLine, 3> s{};
      for (std::size_t a = 0; a < 3; ++a) s[a] = a < D ? spline_at(image[a], h) : NodesOnLine{0, {1.0, 0.0, 0.0}};
      for (int k = 0; k < (D == 3 ? 3 : 1); ++k)
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i)
            fraction[key_of(s, i, j, k)] += volume / std::pow(h, static_cast<double>(D)) *
                                            s[0].value[static_cast<std::size_t>(i)] * s[1].value[static_cast<std::size_t>(j)] *
                                            s[2].value[static_cast<std::size_t>(k)];
    }
  }
  double largest = 0.0;
  for (const auto& [node, filled] : fraction) largest = std::max(largest, filled);
  return largest;
}

constexpr double half_full = 0.5;  // the contour is where the smeared volume is that

/// Whether a body may be so thin that no node is half full of it: not if balls of some cells fit into it everywhere.
bool may_not_show(const Case& c, const GasBodyConfig& config) {
  constexpr double thick = 3.0;  // cells
  const auto thin = thinnest_part(c, *config.shape, thick * c.cell_size);
  const Bounds box = bounds(*config.shape);
  bool is_sheet = false;  // which may lie between the points that are looked at
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a)
    is_sheet = is_sheet || box.upper[a] - box.lower[a] < thick * c.cell_size;
  return thin || is_sheet;
}

}  // namespace

bool is_wall(const Case& c, std::size_t side) {
  return std::none_of(c.gas->edges.begin(), c.gas->edges.end(), [&](const EdgeConfig& edge) {
    return static_cast<std::size_t>(edge.side) == side && !is_wall(edge.kind);
  });
}

MovingBody make_body(const Case& c, const GasBodyConfig& config) {
  MovingBody body = body_of(c, config);
  if (body.places.empty())
    throw std::runtime_error(
        fmt::format("{}: the body gets no particles; its shape must reach a middle of the parts of {:.4g} m "
                    "into which the cells are cut",
                    config.name, c.cell_size / config.particles_per_direction / samples_per_direction));
  const bool round = c.geometry == Geometry::axisymmetric;
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

std::vector<std::string> overlaps_of_bodies(const Case& c) {
  std::vector<std::string> faults;
  const std::vector<GasBodyConfig>& bodies = c.gas->bodies;
  for (std::size_t n = 0; n < bodies.size(); ++n)
    for (std::size_t m = 0; m < n; ++m) {
      const Shape both{Intersection{{bodies[m].shape, bodies[n].shape}}};
      const double shared = volume(both, c.geometry, c.cell_size / bodies[n].particles_per_direction / samples_per_direction);
      if (!(shared > 0.0)) continue;
      const Bounds there = bounds(both);
      const Vector middle = 0.5 * (there.lower + there.upper);
      faults.push_back(
          fmt::format("{} and {} overlap near ({:.4g}, {:.4g}, {:.4g}) m; bodies in the gas must lie apart; move one of them, "
                      "or make them one body, a union",
                      bodies[m].name, bodies[n].name, middle[0], middle[1], middle[2]));
    }
  return faults;
}

std::vector<std::string> bodies_that_do_not_show(const Case& c) {
  std::vector<std::string> faults;
  for (const GasBodyConfig& body : c.gas->bodies) {
    if (!may_not_show(c, body)) continue;
    const double fullest = fullest_node(c, body);
    if (fullest > half_full) continue;
    // A sheet fills nodes to between 0.4 and 0.6 of its thickness in cells, as it lies between them; with 1.05 it shows
    // anywhere.
    constexpr double most_filled = 0.6 * 1.05;
    faults.push_back(
        fmt::format("{} is so thin that the gas does not see it: none of the nodes of the grid is half full of it; cells of "
                    "{:.3g} m would show it; take such, or make it thicker",
                    body.name, fullest / most_filled * c.cell_size));
  }
  return faults;
}

std::vector<std::string> warnings_of_bodies(const Case& c) {
  std::vector<std::string> warnings;
  if (!c.gas) return warnings;
  constexpr double least_cells = 2.0;
  // What walls mirror makes a body thicker.
  Case mirrored = c;
  for (std::size_t side = 0; side < static_cast<std::size_t>(2 * c.dimensions()); ++side) {
    if (!is_wall(c, side)) continue;
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
    if (const auto thin = thinnest_part(mirrored, *body.shape, least_cells * c.cell_size))
      warnings.push_back(
          fmt::format("{}: near ({:.4g}, {:.4g}, {:.4g}) m it is {:.2g} cells thick, fewer than {:g}: gas may leak "
                      "through it; take smaller cells or make it thicker",
                      body.name, thin->place[0], thin->place[1], thin->place[2], thin->thickness / c.cell_size, least_cells));
  }
  return warnings;
}

}  // namespace brisance::simulator::gas
