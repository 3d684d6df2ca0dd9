// The return to von Mises' circle, drawn in the deviatoric plane: coordinates in which the distance from the centre is q.

#include <cmath>

#include "driver/point.hpp"
#include "gallery.hpp"
#include "models/update.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using S = SymmetricTensor<double>;

constexpr double shear_modulus = 80e9, yield_stress = 1e9;
constexpr double half_width = 1.75;  // of the planes, GPa

Material metal(double hardening_modulus) {
  Material material = read("steel_4340");
  material.heating.reset();
  material.shear_modulus = shear_modulus::Constant{shear_modulus};
  material.flow_stress = flow_stress::LinearHardening{yield_stress, hardening_modulus};
  return material;
}

struct Place {
  double x, y;
};
Place in_plane(const S& s) {
  return {std::sqrt(0.75) * (s.xx - s.yy), 0.5 * (2.0 * s.zz - s.xx - s.yy)};
}
/// The deviator with principal axes along the coordinates at a place.
S deviator_at(double x, double y) {
  return {x / std::sqrt(3.0) - y / 3.0, -x / std::sqrt(3.0) - y / 3.0, 2.0 / 3.0 * y, 0, 0, 0};
}
S on_circle(double radius, double angle) {
  return deviator_at(radius * std::cos(angle), radius * std::sin(angle));
}

/// One step by a deviatoric strain increment, whose trial stress is the old deviator plus 2 G of it.
State<double> step(driver::PointUpdate& update, const State<double>& before, const S& strain) {
  constexpr double dt = 1e-6;
  return update(before, to_tensor((1.0 / dt) * strain), dt, dt).state;
}

Panel plane(std::string title, double reach) {
  Panel panel{.title = std::move(title), .x_label = "(√3/2) (s_x − s_y) (GPa)", .y_label = "(3/2) s_z (GPa)"};
  panel.x_range = panel.y_range = {-reach, reach};
  panel.legend = "top right";
  return panel;
}
Curve circle(std::string title, double radius, Mark mark, int colour) {
  Curve result{std::move(title), {}, {}, mark, colour};
  for (const double angle : evenly(0.0, 2.0 * std::numbers::pi, 180)) {
    result.x.push_back(1e-9 * radius * std::cos(angle));
    result.y.push_back(1e-9 * radius * std::sin(angle));
  }
  return result;
}
void add(Curve& curve, const S& s) {
  const Place place = in_plane(s);
  curve.x.push_back(1e-9 * place.x), curve.y.push_back(1e-9 * place.y);
}
void lift_pen(Curve& curve) {
  curve.x.push_back(std::nan("")), curve.y.push_back(std::nan(""));
}

/// From stresses inside the circle to trial stresses outside and back.
Panel perfectly_plastic(std::vector<Check>& checks) {
  Panel panel = plane("perfectly plastic: q = Y = 1 GPa", half_width);
  Curve trials{"trial", {}, {}, Mark::points, 1}, returned{"returned", {}, {}, Mark::points, 2}, way{"", {}, {}, Mark::line, 5},
      start{"start", {}, {}, Mark::squares, 6};
  const Material material = metal(0.0);
  driver::PointUpdate update(material);
  double off_circle = 0.0, off_direction = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 20.0;
    State<double> state = initial_state(material, 298.0);
    state.stress = on_circle((0.35 + 0.3 * (i % 2)) * yield_stress, angle + 0.5);
    const S before = deviator(state.stress);
    const S trial = on_circle((1.2 + 0.11 * (i % 4)) * yield_stress, angle);
    const S after = deviator(step(update, state, (0.5 / shear_modulus) * (trial - before)).stress);
    add(start, before), add(trials, trial), add(returned, after);
    add(way, before), add(way, trial), add(way, after), lift_pen(way);
    off_circle = std::max(off_circle, std::abs(equivalent_stress(after) / yield_stress - 1.0));
    const double cosine = double_dot(after, trial) / (norm(after) * norm(trial));
    off_direction = std::max(off_direction, norm((1.0 / norm(after)) * after - (cosine / norm(trial)) * trial));
  }
  panel.curves = {circle("von Mises", yield_stress, Mark::line, 6), way, start, trials, returned};
  checks.push_back({"perfectly plastic: largest |q/Y - 1|", "q = Y", off_circle, 1e-12});
  checks.push_back({"returned stress: part across the trial direction", "radial: none", off_direction, 1e-12});
  return panel;
}

/// Linear hardening: one step from the origin in every direction, each longer than the last.
Panel hardening(std::vector<Check>& checks) {
  constexpr double H = 40e9;
  Panel panel = plane("linear hardening, H = 40 GPa: one step from the origin", half_width);
  Curve trials{"trial", {}, {}, Mark::points, 1}, returned{"returned", {}, {}, Mark::points, 2}, way{"", {}, {}, Mark::line, 5},
      closed{"closed form", {}, {}, Mark::dashed, 0};
  const Material material = metal(H);
  driver::PointUpdate update(material);
  double error = 0.0;
  constexpr int rays = 24;
  for (int i = 0; i <= 2 * rays; ++i) {
    const double q_trial = (1.05 + 0.6 * i / (2 * rays)) * yield_stress, angle = 2.0 * std::numbers::pi * i / (2 * rays);
    const double strain = (q_trial - yield_stress) / (3.0 * shear_modulus + H);
    add(closed, on_circle(yield_stress + H * strain, angle));
    if (i % 2 != 0 || i == 2 * rays) continue;
    const S trial = on_circle(q_trial, angle);
    const State<double> after = step(update, initial_state(material, 298.0), (0.5 / shear_modulus) * trial);
    add(trials, trial), add(returned, deviator(after.stress));
    add(way, trial), add(way, deviator(after.stress)), lift_pen(way);
    error = std::max(error, std::abs(after.plastic_strain / strain - 1.0));
  }
  panel.curves = {circle("first yield", yield_stress, Mark::line, 6), way, closed, trials, returned};
  checks.push_back(
      {"linear hardening: plastic strain of one step, largest relative error", "(q_tr - Y)/(3G + H)", error, 1e-10});
  return panel;
}

/// A strain rate that does not point along the stress turns it along the circle; the exact way is known (Krieg & Krieg, J.
/// Press. Vessel Technol. 99 (1977) 510-515).
Panel turning(std::vector<Check>& checks) {
  Panel panel{.title = "strain at 85° to the stress, perfectly plastic",
              .x_label = "3 G × equivalent strain / Y",
              .y_label = "angle between stress and strain rate (degrees)"};
  panel.legend = "top right";
  constexpr double first_angle = 85.0 / degrees, longest = 3.0;
  const auto exact = [&](double strain) { return 2.0 * std::atan(std::tan(0.5 * first_angle) * std::exp(-strain)); };
  Curve line{"exact", {}, {}, Mark::line, 6};
  for (const double strain : evenly(0.0, longest, 120)) line.x.push_back(strain), line.y.push_back(degrees * exact(strain));
  panel.curves.push_back(line);
  const Material material = metal(0.0);
  driver::PointUpdate update(material);
  std::vector<double> errors;
  int colour = 1;
  for (const int steps : {6, 24, 96, 192}) {
    Curve points{std::to_string(steps) + " steps", {0.0}, {degrees * first_angle}, Mark::points, colour++};
    State<double> state = initial_state(material, 298.0);
    state.stress = on_circle(yield_stress, first_angle);
    const S increment = (0.5 / shear_modulus) * on_circle(yield_stress * longest / steps, 0.0);
    double error = 0.0;
    for (int i = 1; i <= steps; ++i) {
      state = step(update, state, increment);
      const Place place = in_plane(deviator(state.stress));
      const double angle = std::atan2(place.y, place.x), strain = longest * i / steps;
      error = std::max(error, std::abs(angle - exact(strain)));
      points.x.push_back(strain), points.y.push_back(degrees * angle);
    }
    errors.push_back(error);
    if (steps < 96) panel.curves.push_back(std::move(points));
  }
  checks.push_back({"turning stress: largest angle error in 96 steps", "tan(a/2) = tan(42.5°) exp(-3G e/Y)",
                    degrees * errors[2], 1.0, "degrees"});
  checks.push_back(
      {"turning stress: order of convergence - 1", "backward Euler: 1", std::log2(errors[2] / errors[3]) - 1.0, 0.1});
  return panel;
}

/// A square of strains, twice around, in a hardening metal.
Panel around_a_square(std::vector<Check>& checks) {
  constexpr double H = 5e9;
  Panel panel = plane("strains around a square, H = 5 GPa", half_width);
  Curve path{"stress", {}, {}, Mark::line, 0};
  const Material material = metal(H);
  driver::PointUpdate update(material);
  State<double> state = initial_state(material, 298.0);
  double error = 0.0;
  const auto walk = [&](double x, double y) {
    constexpr int steps = 60;
    for (int i = 0; i < steps; ++i) {
      const double before = state.plastic_strain;
      state = step(update, state, (0.5 / shear_modulus / steps) * deviator_at(x * yield_stress, y * yield_stress));
      add(path, deviator(state.stress));
      const double Y = yield_stress + H * state.plastic_strain;
      if (state.plastic_strain > before) error = std::max(error, std::abs(equivalent_stress(deviator(state.stress)) / Y - 1.0));
    }
  };
  add(path, deviator(state.stress));
  walk(1.5, 1.5);
  for (int round = 0; round < 2; ++round) walk(-3.0, 0.0), walk(0.0, -3.0), walk(3.0, 0.0), walk(0.0, 3.0);
  panel.curves = {circle("first yield", yield_stress, Mark::line, 6), path,
                  circle("yield at the end", yield_stress + H * state.plastic_strain, Mark::dashed, 1)};
  checks.push_back({"around a square: largest |q/Y - 1| while plastic", "q = Y0 + H ep", error, 1e-9});
  return panel;
}

}  // namespace

Picture radial_return() {
  Picture picture;
  picture.figure = {.title = "Return to von Mises’ circle in the deviatoric plane (distance from the centre = q)",
                    .panels = {},
                    .columns = 2,
                    .panel_width = 600,
                    .panel_height = 622};
  for (const auto panel : {perfectly_plastic, hardening, around_a_square, turning})
    picture.figure.panels.push_back(panel(picture.checks));
  return picture;
}

}  // namespace brisance::plots
