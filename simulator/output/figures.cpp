#include "simulator/output/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "models/input/csv.hpp"
#include "models/programs/figure.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/measures.hpp"

namespace brisance::simulator {
namespace {

using Path = std::filesystem::path;
constexpr double mm = 1e3;  // per m

bool is_mirrored(const Simulation& s, int axis) {
  return std::any_of(s.boundaries.begin(), s.boundaries.end(),
                     [&](const Boundary& b) { return b.kind == BoundaryKind::symmetry && b.axis == axis && b.node == 0; });
}

void draw_energy(const Case& c, const Simulation&, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  std::vector<double> time = history.numbers("time", Unit::s);
  const bool micro = !time.empty() && time.back() < 1e-3;
  for (double& t : time) t *= micro ? 1e6 : 1e3;
  const auto curve = [&](const std::string& column, const std::string& title, int colour, Mark mark = Mark::line,
                         double sign = 1.0) {
    std::vector<double> y = history.numbers(column, Unit::J);
    for (double& value : y) value *= sign;
    return Curve{title, time, std::move(y), mark, colour};
  };
  Panel large, numerical;
  large.title = "Energy", numerical.title = "Numerical books";
  for (Panel* panel : {&large, &numerical}) {
    panel->x_label = micro ? "time (µs)" : "time (ms)";
    panel->y_label = "energy (J)";
    panel->legend = "outside right top vertical";
    panel->wide = true;
  }
  large.curves = {curve("kinetic_energy", "kinetic", 0),           curve("internal_energy_change", "internal, change", 1),
                  curve("plastic_work", "plastic work", 2),        curve("external_work", "work of loads", 3),
                  curve("boundary_work", "work of boundaries", 4), curve("viscous_work", "artificial viscosity", 5)};
  numerical.curves = {curve("transfer_energy", "transfer", 0), curve("filter_energy", "filter", 1),
                      curve("stress_timing_energy", "stress timing", 2), curve("energy_residual", "in no book", 6)};
  draw({c.title, {large, numerical}, 1, 900, 380}, directory / "energy.png");
}

/// Half a particle in units of gnuplot's point size, on a panel so many pixels wide that shows so many metres.
double point_size(double width, double pixels, double metres) {
  constexpr double pixels_per_size = 7.0;
  return std::clamp(pixels * width / metres / pixels_per_size, 0.15, 6.0);
}

struct Window {
  double lower[2] = {1e300, 1e300}, upper[2] = {-1e300, -1e300};
  void add(double x, double y) {
    lower[0] = std::min(lower[0], x), upper[0] = std::max(upper[0], x);
    lower[1] = std::min(lower[1], y), upper[1] = std::max(upper[1], y);
  }
  double width() const { return upper[0] - lower[0]; }
  double height() const { return upper[1] - lower[1]; }
};

/// A panel that shows the window with equal axes on a figure of a sensible shape.
void fit(Figure& figure, const Window& w, double margin) {
  Panel& panel = figure.panels.front();
  panel.equal_axes = true;
  panel.x_range = {{mm * (w.lower[0] - margin), mm * (w.upper[0] + margin)}};
  panel.y_range = {{mm * (w.lower[1] - margin), mm * (w.upper[1] + margin)}};
  constexpr double largest = 820.0, smallest = 320.0;
  const double scale = largest / std::max(w.width() + 2.0 * margin, w.height() + 2.0 * margin);
  const auto pixels = [&](double size) { return static_cast<int>(std::max(smallest, scale * (size + 2.0 * margin))); };
  figure.panel_width = pixels(w.width()) + 190;  // scale and labels
  figure.panel_height = pixels(w.height()) + 90;
}

void draw_field(const Case& c, const Simulation& s, const Path& directory) {
  const Field* field = find_field(c.output.figure_field);
  if (!field) throw std::runtime_error(fmt::format("output.figure_field: there is no field \"{}\"", c.output.figure_field));
  const double h = s.grid.cell_size;
  const bool mirror = s.dimensions() == 3 ? is_mirrored(s, 0) : s.geometry == Geometry::axisymmetric || is_mirrored(s, 0);
  Curve points;
  points.mark = Mark::dots;
  Window window;
  double particle = 0.0;
  for (const Body& body : s.bodies)
    for (int p = 0; p < body.particles.size; ++p) {
      const ParticleView view(body.particles, p);
      const Vector x = view.position();
      if (s.dimensions() == 3 && std::abs(x[2]) > h) continue;
      double components[3] = {};
      field->read(view, components);
      const double value =
          field->components == 1
              ? components[0]
              : std::sqrt(dot({components[0], components[1], components[2]}, {components[0], components[1], components[2]}));
      for (const double side : {1.0, -1.0}) {
        if (side < 0.0 && !mirror) continue;
        points.x.push_back(mm * side * x[0]), points.y.push_back(mm * x[1]), points.values.push_back(value);
        window.add(side * x[0], x[1]);
      }
      particle = std::max(particle, 2.0 * view.half_width());
    }
  if (points.x.empty()) throw std::runtime_error("no particle is in the picture");
  Figure figure;
  figure.title = fmt::format("{}: {} at {:.4g} µs", c.title, std::string(field->meaning), 1e6 * s.time);
  Panel panel;
  const bool axisymmetric = s.geometry == Geometry::axisymmetric;
  panel.x_label = axisymmetric ? "r (mm)" : "x (mm)", panel.y_label = axisymmetric ? "z (mm)" : "y (mm)";
  panel.scale_label = std::string(field->meaning) + (field->unit == "1" ? "" : " (" + std::string(field->unit) + ")");
  figure.panels.push_back(panel);
  fit(figure, window, 2.0 * h);
  points.size = point_size(particle, figure.panel_width - 190, window.width() + 4.0 * h);
  figure.panels.front().curves.push_back(std::move(points));
  draw(figure, directory / "field.png");
}

/// The outline of a body about its axis, whole, with what experiments say.
void draw_profile(const Case& c, const Simulation& s, const MeasureConfig& measure, const Path& directory) {
  const Body& body = s.bodies[body_of(measure, s)];
  const auto axis = static_cast<std::size_t>(measure.axis);
  const Profile profile = profile_of(s, body, measure.axis);
  Curve outline{"computed", {}, {}, Mark::line, 0};
  Curve strained{"plastic strain above 0.5", {}, {}, Mark::dots, 4}, measured{"measured", {}, {}, Mark::squares, 1};
  measured.size = 1.2;
  Window window;
  const auto go_to = [&](double radius, double height) {
    outline.x.push_back(mm * radius), outline.y.push_back(mm * height);
    window.add(radius, height);
  };
  if (profile.height.empty()) throw std::runtime_error(body.name + " has no particles left");
  go_to(profile.radius.front(), 0.0);
  for (std::size_t i = 0; i < profile.height.size(); ++i) go_to(profile.radius[i], profile.height[i]);
  go_to(profile.radius.back(), profile.length), go_to(-profile.radius.back(), profile.length);
  for (std::size_t i = profile.height.size(); i-- > 0;) go_to(-profile.radius[i], profile.height[i]);
  go_to(-profile.radius.front(), 0.0), go_to(profile.radius.front(), 0.0);
  double particle = 0.0;
  constexpr double strongly_strained = 0.5;
  for (int p = 0; p < body.particles.size; ++p) {
    const ParticleView view(body.particles, p);
    if (view.rest(Layout<2>::Rest::plastic_strain) < strongly_strained) continue;
    Vector from_axis = view.position();
    from_axis[axis] = 0.0;
    const double r = std::sqrt(dot(from_axis, from_axis)), z = view.position()[axis] - profile.lower;
    for (const double side : {1.0, -1.0}) strained.x.push_back(mm * side * r), strained.y.push_back(mm * z);
    particle = std::max(particle, 2.0 * view.half_width());
  }
  for (const MeasureConfig& m : c.measures) {
    if (m.profile.empty() || body_of(m, s) != body_of(measure, s)) continue;
    const MeasuredProfile points = read_profile(m.profile);
    for (std::size_t i = 0; i < points.height.size(); ++i)
      for (const double side : {1.0, -1.0}) {
        measured.x.push_back(mm * side * points.radius[i]), measured.y.push_back(mm * points.height[i]);
        window.add(side * points.radius[i], points.height[i]);
      }
  }
  Figure figure;
  figure.title = fmt::format("{}: {} at {:.4g} µs", c.title, body.name, 1e6 * s.time);
  Panel panel;
  panel.x_label = "radius (mm)", panel.y_label = "height above the impact face (mm)";
  panel.legend = "outside right top vertical";
  figure.panels.push_back(panel);
  fit(figure, window, 2.0 * s.grid.cell_size);
  figure.panel_width += 100;  // legend
  strained.size = 0.7 * point_size(particle, figure.panel_width - 290, window.width() + 4.0 * s.grid.cell_size);
  figure.panels.front().curves = {strained, outline, measured};
  draw(figure, directory / fmt::format("profile_{}.png", body.name));
}

}  // namespace

std::vector<std::string> draw_figures(const Case& c, const Simulation& s, const Path& directory) {
  std::vector<std::string> troubles;
  const auto attempt = [&](const std::function<void()>& draw_it) {
    try {
      draw_it();
    } catch (const std::exception& error) {
      troubles.push_back(fmt::format("a figure is missing: {}", error.what()));
    }
  };
  attempt([&] { draw_energy(c, s, directory); });
  attempt([&] { draw_field(c, s, directory); });
  std::vector<std::size_t> drawn;
  for (const MeasureConfig& measure : c.measures) {
    const std::size_t body = body_of(measure, s);
    if (std::find(drawn.begin(), drawn.end(), body) != drawn.end()) continue;
    drawn.push_back(body);
    attempt([&] { draw_profile(c, s, measure, directory); });
  }
  return troubles;
}

}  // namespace brisance::simulator
