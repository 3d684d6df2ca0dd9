#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "simulator/gas/fields.hpp"
#include "simulator/gas/outline.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"
#include "simulator/output/particle_cells.hpp"

namespace brisance::simulator::figures {
namespace {

/// The coloured tiles or polygons of a picture, before they have units.
struct Tiles {
  Curve points;
  std::string field, unit;
  Curve solid{"", {}, {}, Mark::area}, contour{"", {}, {}, Mark::line, 6};  // of bodies in gas, over the tiles
  Window window;                                                            // all of it, before it is mirrored
  bool mirrored = false;                                                    // to be drawn a second time at negative x
};

/// A polygon or a line; between two of them is a place that is no number.
void add_polygon(Curve& curve, std::span<const Vector> places) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const Vector& x : places) curve.x.push_back(x[0]), curve.y.push_back(x[1]);
  curve.x.push_back(none), curve.y.push_back(none);
}

void add_bodies(Tiles& tiles, const gas::Outline& outline) {
  for (const auto& polygon : outline.solid) add_polygon(tiles.solid, polygon);
  for (const auto& piece : outline.contour) add_polygon(tiles.contour, piece);
}

Tiles tiles_of_gas(const Simulation& s, const std::string& name) {
  const std::vector<gas::Field> known = gas::fields_of(s.gas);
  const auto field = std::find_if(known.begin(), known.end(), [&](const gas::Field& f) { return f.name == name; });
  const gas::Cells& cells = s.gas.cells;
  Tiles tiles;
  tiles.field = field->name, tiles.unit = field->unit;
  tiles.mirrored = s.geometry == Geometry::axisymmetric && cells.lower[0] == 0;
  for (const auto& corner : {cells.lower, cells.upper})
    tiles.window.add(corner[0] * cells.cell_size, corner[1] * cells.cell_size);
  const int slice = (cells.lower[2] + cells.upper[2]) / 2;
  gas::for_each_cell(s.gas, [&](const gas::CellPlace& at) {
    if (s.dimensions() == 3 && cells.index(at.block, at.cell)[2] != slice) return;
    const Vector x = cells.centre(at.block, at.cell);
    tiles.points.x.push_back(x[0]), tiles.points.y.push_back(x[1]), tiles.points.values.push_back(field->read(s.gas, at, 0));
  });
  tiles.points.half_widths.assign(tiles.points.x.size(), 0.5 * cells.cell_size);
  tiles.points.half_heights = tiles.points.half_widths;
  add_bodies(tiles, gas::outline_of(s.gas, slice));
  return tiles;
}

bool is_mirrored(const Simulation& s, int axis) {
  return std::any_of(s.boundaries.begin(), s.boundaries.end(),
                     [&](const Boundary& b) { return b.kind == BoundaryKind::symmetry && b.axis == axis && b.node == 0; });
}

Tiles tiles_of_solids(const Case& c, const Simulation& s) {
  const Field* field = find_field(c.output.figure_field);
  if (!field) throw std::runtime_error(fmt::format("output.figure_field: there is no field \"{}\"", c.output.figure_field));
  Tiles tiles;
  Curve& cells = tiles.points;
  cells.mark = Mark::area;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Body& body : s.bodies)
    for (int p = 0; p < body.particles.size; ++p) {
      std::vector<Vector> corners = cell_of_particle(c, body, p);
      if (corners.empty()) continue;
      corners.push_back(corners.front());  // so that its border is closed
      add_polygon(cells, corners);
      std::array<double, 3> components{};
      field->read(ParticleView(body.particles, p), components.data());
      cells.values.push_back(components[0]);
      for (const Vector& x : corners) nearest = std::min(nearest, std::abs(x[0])), tiles.window.add(x[0], x[1]);
    }
  if (cells.x.empty()) throw std::runtime_error("no particle is in the picture");
  tiles.field = field->name, tiles.unit = field->unit;
  // Not if there is a hole between the two halves.
  tiles.mirrored = (s.geometry == Geometry::axisymmetric || is_mirrored(s, 0)) && nearest < s.grid.cell_size;
  return tiles;
}

/// All of it once more at negative x.
void mirror(Tiles& tiles) {
  for (Curve* curve : {&tiles.points, &tiles.solid, &tiles.contour}) {
    for (std::size_t i = 0, count = curve->x.size(); i < count; ++i) curve->x.push_back(-curve->x[i]);
    for (std::vector<double>* same : {&curve->y, &curve->values, &curve->half_widths, &curve->half_heights})
      for (std::size_t i = 0, count = same->size(); i < count; ++i) same->push_back((*same)[i]);
  }
  tiles.window.add(-tiles.window.upper[0], tiles.window.upper[1]);
}

/// The planes that bound the bodies, as far as they are near the window, which grows to hold them: walls with the hatching of
/// what is behind them, planes of symmetry that the picture is not mirrored at without.
Curve planes_of(const Simulation& s, Tiles& tiles) {
  Window& window = tiles.window;
  constexpr double near = 0.25, none = std::numeric_limits<double>::quiet_NaN();
  constexpr double stroke = 9.0;  // pixels
  const double reach = near * std::max(window.width(), window.height()) + 2.0 * s.grid.cell_size;
  struct Plane {
    std::size_t axis;
    double position, outwards;
    bool is_wall;
  };
  std::vector<Plane> planes;
  for (const Boundary& b : s.boundaries) {
    const auto axis = static_cast<std::size_t>(b.axis);
    if (axis > 1 || b.kind == BoundaryKind::outflow) continue;
    if (b.kind == BoundaryKind::symmetry && tiles.mirrored && axis == 0) continue;
    const double position = b.node * s.grid.cell_size + s.grid.origin[axis];
    if (position < window.lower[axis] - reach || position > window.upper[axis] + reach) continue;
    planes.push_back({axis, position, static_cast<double>(-b.inward), b.kind != BoundaryKind::symmetry});
  }
  const Pixels pixels = pixels_of(window.width(), window.height());
  const double size[2] = {stroke * window.width() / pixels.width, stroke * window.height() / pixels.height};  // m
  for (const Plane& plane : planes) {
    double x[2] = {window.lower[0], window.lower[1]};
    x[plane.axis] = plane.position;
    window.add(x[0], x[1]);
    x[plane.axis] += plane.is_wall ? plane.outwards * size[plane.axis] : 0.0;
    window.add(x[0], x[1]);
  }
  Curve lines{"", {}, {}, Mark::thin, 6};
  for (const Plane& plane : planes) {
    const std::size_t along = 1 - plane.axis;
    const auto add = [&](double place, double height) {
      double x[2];
      x[along] = place, x[plane.axis] = plane.position + height * plane.outwards * size[plane.axis];
      lines.x.push_back(x[0]), lines.y.push_back(x[1]);
    };
    const auto interrupt = [&] { lines.x.push_back(none), lines.y.push_back(none); };
    add(window.lower[along], 0.0), add(window.upper[along], 0.0);
    interrupt();
    for (double at = window.lower[along]; plane.is_wall && at + size[along] < window.upper[along]; at += size[along]) {
      add(at, 1.0), add(at + size[along], 0.0);
      interrupt();
    }
  }
  return lines;
}

}  // namespace

void draw_field(const Case& c, const Simulation& s, const Path& directory, Of of) {
  const double h = s.grid.cell_size;
  Tiles tiles = s.gas.empty() ? tiles_of_solids(c, s) : tiles_of_gas(s, c.output.figure_field);
  Curve& points = tiles.points;
  const std::optional<MostOf> most = of == Of::failed_run ? most_of(points.values, tiles.unit) : std::nullopt;
  if (tiles.mirrored) mirror(tiles);
  Curve planes = planes_of(s, tiles);
  Figure figure;
  figure.title = fmt::format("{}: {} at {}", c.title, in_words(tiles.field), in_words(s.time, "s"));
  Panel panel;
  panel.x_label = coordinate_label(s.geometry, "x"), panel.y_label = coordinate_label(s.geometry, "y");
  if (const auto [low, high] = std::minmax_element(points.values.begin(), points.values.end()); *low == *high)
    panel.title = (tiles.unit == "1" ? fmt::format("{:.4g}", *low) : in_words(*low, tiles.unit)) + " everywhere";
  const Scale values = scale_for(tiles.unit, most ? largest({most->range[0], most->range[1]}) : largest(points.values));
  panel.scale_label = label(in_words(tiles.field), values);
  if (most) {
    panel.title = most->words;
    panel.colour_range = {{values.per_si * most->range[0], values.per_si * most->range[1]}};
  }
  figure.panels.push_back(panel);
  const Scale lengths = fit(figure, tiles.window, 0.5 * h);
  // Tiles reach a pixel beyond their edges, so that no light shines through between them.
  for (double& half : points.half_widths) half += (tiles.window.width() + h) / (figure.panel_width - beside_window);
  for (double& half : points.half_heights) half += (tiles.window.height() + h) / (figure.panel_height - below_window);
  points.values = scaled(std::move(points.values), values.per_si);
  for (Curve* curve : {&points, &tiles.solid, &tiles.contour, &planes}) {
    for (std::vector<double>* length : {&curve->x, &curve->y, &curve->half_widths, &curve->half_heights})
      *length = scaled(std::move(*length), lengths.per_si);
    figure.panels.front().curves.push_back(std::move(*curve));
  }
  draw(c, std::move(figure), directory / "field.png");
}

}  // namespace brisance::simulator::figures
