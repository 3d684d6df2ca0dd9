#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "simulator/output/fields.hpp"
#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"
#include "simulator/output/measures.hpp"

namespace brisance::simulator::figures {
namespace {

/// Half a particle in units of gnuplot's point size, on a panel so many pixels wide that shows so many metres.
double point_size(double width, double pixels, double metres) {
  constexpr double pixels_per_size = 7.0;
  return std::clamp(pixels * width / metres / pixels_per_size, 0.15, 6.0);
}

void add(Curve& curve, double radius, double height) {
  curve.x.push_back(radius), curve.y.push_back(height);
}

/// Both sides of a body, closed.
Curve outline_of(const Profile& profile) {
  Curve outline{"computed", {}, {}, Mark::line, 0};
  const std::size_t last = profile.height.size() - 1;
  add(outline, profile.radius[0], 0.0);
  for (std::size_t i = 0; i <= last; ++i) add(outline, profile.radius[i], profile.height[i]);
  add(outline, profile.radius[last], profile.length), add(outline, -profile.radius[last], profile.length);
  for (std::size_t i = last + 1; i-- > 0;) add(outline, -profile.radius[i], profile.height[i]);
  add(outline, -profile.radius[0], 0.0), add(outline, profile.radius[0], 0.0);
  return outline;
}

/// The particles that have strained strongly; its size is the width of the widest of them, m.
Curve strongly_strained(const Body& body, std::size_t axis, const Profile& profile) {
  constexpr double strongly = 0.5;
  Curve strained{fmt::format("plastic strain above {}", strongly), {}, {}, Mark::dots, 4};
  strained.size = 0.0;
  for (int p = 0; p < body.particles.size; ++p) {
    const ParticleView view(body.particles, p);
    if (view.rest(Layout<2>::Rest::plastic_strain) < strongly) continue;
    Vector from_axis = view.position();
    from_axis[axis] = 0.0;
    const double r = std::sqrt(dot(from_axis, from_axis)), z = view.position()[axis] - profile.lower;
    for (const double side : {1.0, -1.0}) add(strained, side * r, z);
    strained.size = std::max(strained.size, 2.0 * view.half_width());
  }
  return strained;
}

/// What the experiments of all measures of a body say.
Curve measured_of(const Case& c, const Simulation& s, std::size_t body) {
  Curve measured{"measured", {}, {}, Mark::squares, 1};
  measured.size = 1.2;
  for (const MeasureConfig& m : c.measures) {
    if (m.profile.empty() || body_of(m, s) != body) continue;
    const MeasuredProfile points = read_profile(m.profile);
    for (std::size_t i = 0; i < points.height.size(); ++i)
      for (const double side : {1.0, -1.0}) add(measured, side * points.radius[i], points.height[i]);
  }
  return measured;
}

}  // namespace

void draw_profile(const Case& c, const Simulation& s, const MeasureConfig& measure, const Path& directory) {
  const std::size_t index = body_of(measure, s);
  const Body& body = s.bodies[index];
  const Profile profile = profile_of(s, body, measure.axis);
  if (profile.height.empty()) throw std::runtime_error(body.name + " has no particles left");
  Curve strained = strongly_strained(body, static_cast<std::size_t>(measure.axis), profile);
  Curve outline = outline_of(profile), measured = measured_of(c, s, index);
  Window window;
  for (const Curve* curve : {&outline, &measured})
    for (std::size_t i = 0; i < curve->x.size(); ++i) window.add(curve->x[i], curve->y[i]);
  Figure figure;
  figure.title = fmt::format("{}: {} at {}", c.title, body.name, in_words(s.time, "s"));
  Panel panel;
  panel.x_label = "radius", panel.y_label = "height above the impact face";
  legend_beside(panel);
  figure.panels.push_back(panel);
  const double margin = 2.0 * s.grid.cell_size;
  const Scale lengths = fit(figure, window, margin);
  strained.size = 0.7 * point_size(strained.size, figure.panel_width - beside_window, window.width() + 2.0 * margin);
  figure.panel_width += 180;  // the legend and its margins, 41 characters of 9 pixels, are wider than colours
  for (Curve* curve : {&outline, &measured, &strained}) {
    curve->x = scaled(std::move(curve->x), lengths.per_si), curve->y = scaled(std::move(curve->y), lengths.per_si);
  }
  figure.panels.front().curves = {std::move(strained), std::move(outline), std::move(measured)};
  draw(c, std::move(figure), directory / fmt::format("profile_{}.png", body.name));
}

}  // namespace brisance::simulator::figures
