// Voids: growth with the plastic volume, nucleation with the plastic strain, and the porous yield surface with the points
// that the update returned to it.

#include <fmt/format.h>

#include <cmath>

#include "driver/point.hpp"
#include "gallery.hpp"
#include "models/equation_of_state/thermodynamics.hpp"
#include "models/update.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using yield::GursonTvergaardNeedleman;

/// HY-100 with a rate-independent matrix of 1 GPa, voids that only grow, and the surface of its file.
Material porous_metal(double hardening_modulus) {
  Material material = read("steel_hy100");
  material.flow_stress = flow_stress::LinearHardening{1e9, hardening_modulus};
  material.porosity = brisance::porosity::Growth{};
  material.initial_porosity.reset();
  material.stability.clear();
  material.heating.reset();
  return material;
}

Panel growth(std::vector<Check>& checks) {
  Panel panel{.title = "growth in uniaxial strain", .x_label = "plastic volume strain", .y_label = "porosity"};
  panel.y_range = {0.0, 0.16};
  const Material material = porous_metal(0.0);
  double worst = 0.0;
  int colour = 0;
  for (const double f0 : {0.001, 0.01, 0.05}) {
    driver::PathSegment stretch;
    stretch.where = "uniaxial strain";
    stretch.velocity_gradient.xx = 1e3;
    stretch.until = driver::Until{"porosity", 0.15};
    driver::LoadingPath path;
    path.temperature = 298.0, path.porosity = f0, path.segments = {stretch};
    const Run run = follow(material, path);
    const std::vector<double>&volume = run["plastic_volume_strain"], &f = run["porosity"];
    std::vector<double> closed;
    for (std::size_t i = 0; i < volume.size(); ++i) {
      closed.push_back(1.0 - (1.0 - f0) * std::exp(-volume[i]));
      worst = std::max(worst, std::abs(f[i] - closed[i]));
    }
    panel.curves.push_back(curve(fmt::format("f0 = {:g}", f0), volume, closed, 1.0, 1.0, Mark::line, colour));
    panel.curves.push_back(curve("", volume, f, 1.0, 1.0, Mark::points, colour, 16));
    ++colour;
  }
  panel.curves.back().title = "update";
  checks.push_back({"growth: largest |f - closed form|", "f = 1 - (1 - f0) exp(-ev)", worst, 1e-10});
  return panel;
}

Panel nucleation(std::vector<Check>& checks) {
  Panel panel{
      .title = "nucleation in tension, none in compression", .x_label = "plastic strain of the matrix", .y_label = "porosity"};
  panel.y_range = {0.0, 0.1};
  Material material = porous_metal(1e9);
  material.yield = yield::VonMises{};  // no growth: what nucleates stays as it is
  double worst = 0.0;
  int colour = 0;
  for (const double deviation : {0.05, 0.1, 0.2}) {
    const double fN = 0.08, eN = 0.3;
    material.porosity = brisance::porosity::ChuNeedleman{fN, eN, deviation, false};
    const Run run = follow(material, uniaxial_stress(1e3, 298.0, 0.8));
    const std::vector<double>&strain = run["plastic_strain"], &f = run["porosity"];
    std::vector<double> closed;
    const auto part = [&](double e) { return 0.5 * fN * std::erf((e - eN) / (deviation * std::sqrt(2.0))); };
    for (std::size_t i = 0; i < strain.size(); ++i) {
      closed.push_back(part(strain[i]) - part(0.0));
      worst = std::max(worst, std::abs(f[i] - closed[i]));
    }
    panel.curves.push_back(curve(fmt::format("sN = {:g}", deviation), strain, closed, 1.0, 1.0, Mark::line, colour));
    panel.curves.push_back(curve("", strain, f, 1.0, 1.0, Mark::points, colour, 21));
    ++colour;
  }
  panel.curves.back().title = "update";
  const Run squeezed = follow(material, uniaxial_stress(-1e3, 298.0, 0.8));
  panel.curves.push_back(curve("compression", squeezed["plastic_strain"], squeezed["porosity"], 1.0, 1.0, Mark::dashed, 6));
  checks.push_back({"nucleation: largest |f - closed form|", "erf integral of Chu & Needleman", worst, 1e-10});
  checks.push_back({"nucleation in compression", "none", squeezed["porosity"].back(), 0.0});
  return panel;
}

/// From an unstressed point along one direction of strain in short steps, until the first plastic one.
Point<double> first_plastic_point(const Material& material, double porosity, double angle) {
  driver::PointUpdate update(material);
  State<double> state = initial_state(material, 298.0);
  state.porosity = porosity;
  const double K = std::visit([&](const auto& law) { return equation_of_state::bulk_modulus(law, state.density, 0.0); },
                              material.equation_of_state);
  // Elastic steps of q = 3 G e and sm = K v, of which 2000 reach Y.
  constexpr double share = 1.0 / 2000.0;
  const double stretch = share * std::cos(angle) * 1e9 / (3.0 * state.shear_modulus),
               volume = share * std::sin(angle) * 3e9 / K;
  const Tensor<double> strain = to_tensor(
      SymmetricTensor<double>{stretch + volume / 3, -0.5 * stretch + volume / 3, -0.5 * stretch + volume / 3, 0, 0, 0});
  constexpr double dt = 1e-7;
  for (int i = 1; i < 20000; ++i) {
    const Point<double>& point = update(state, (1.0 / dt) * strain, dt, i * dt);
    state = point.state;
    if (point.plastic_strain_increment > 0.0) return point;
  }
  throw std::logic_error("the strains did not reach the yield surface");
}

/// q/Y on the surface at a mean stress, from Phi = 0; none beyond its tip.
std::optional<double> height(const GursonTvergaardNeedleman& surface, double mean_over_Y, double porosity) {
  const double squared = -surface(0.0, mean_over_Y, surface.effective_porosity(porosity));
  return squared >= 0.0 ? std::optional(std::sqrt(squared)) : std::nullopt;
}

Panel surfaces(std::vector<Check>& checks) {
  Panel panel{.title = "yield surface and returned stresses", .x_label = "mean stress / Y", .y_label = "equivalent stress / Y"};
  panel.y_range = {0.0, 1.3};
  panel.x_range = {-3.0, 3.0};
  panel.legend = "top right maxrows 2";
  // Voids of less than 0.5 % in this metal open at a jump at the tip in tension, where the surface shrinks faster than the
  // stress can fall.
  const Material material = porous_metal(0.0);
  const auto& surface = std::get<GursonTvergaardNeedleman>(*material.yield);
  double worst = 0.0, tip_error = 0.0;
  int colour = 0;
  for (const double f : {0.01, 0.03, 0.06, 0.1}) {
    // The tip: cosh(3 q2 sm/(2 Y)) = (1 + q3 f*^2)/(2 q1 f*).
    const double f_star = surface.effective_porosity(f);
    const double tip =
        2.0 / (3.0 * surface.q2) * std::acosh((1.0 + surface.q3 * f_star * f_star) / (2.0 * surface.q1 * f_star));
    Curve line{fmt::format("f = {:g}", f), {}, {}, Mark::line, colour}, points{"", {}, {}, Mark::points, colour};
    for (const double turn : evenly(-1.0, 1.0, 200)) {
      const double mean = tip * std::sin(0.5 * std::numbers::pi * turn);
      line.x.push_back(mean), line.y.push_back(height(surface, mean, f).value_or(0.0));
    }
    for (int i = -8; i <= 8; ++i) {
      const Point<double> point = first_plastic_point(material, f, 0.5 * std::numbers::pi * i / 8.0);
      const double Y = point.flow_stress, q = equivalent_stress(point.deviator) / Y, mean = -point.pressure / Y;
      points.x.push_back(mean), points.y.push_back(q);
      worst = std::max(worst, std::abs(surface(q, mean, surface.effective_porosity(point.state.porosity))));
      if (std::abs(i) == 8) tip_error = std::max(tip_error, std::abs(std::abs(mean) / tip - 1.0));
    }
    panel.curves.push_back(std::move(line));
    panel.curves.push_back(std::move(points));
    ++colour;
  }
  panel.curves.back().title = "update";
  // The return stops at a residual of 1e-10 of the stress.
  checks.push_back({"returned stresses: largest |Phi|", "on the surface: 0", worst, 1e-8});
  checks.push_back({"hydrostatic limit: largest relative difference", "acosh((1 + q3 f*^2)/(2 q1 f*))", tip_error, 2e-3});
  return panel;
}

/// f against the matrix strain at a constant triaxiality, as an ordinary differential equation. Normality and the balance of
/// work, (1 - f) Y dep = q dq_p + sm dv, give in stresses over Y: df/dep = (1 - f)^2 Phi_m/(q Phi_q + sm Phi_m): the strength
/// of the matrix cancels.
double growth_rate(const GursonTvergaardNeedleman& surface, double f, double triaxiality) {
  const double f_star = surface.effective_porosity(f);
  double low = 0.0, high = 1.0;  // of q/Y along the ray
  for (int i = 0; i < 60; ++i) {
    const double q = 0.5 * (low + high);
    (surface(q, triaxiality * q, f_star) < 0.0 ? low : high) = q;
  }
  const double q = low, mean = triaxiality * q;
  const double by_q = 2.0 * q, by_mean = 3.0 * surface.q1 * surface.q2 * f_star * std::sinh(1.5 * surface.q2 * mean);
  return (1.0 - f) * (1.0 - f) * by_mean / (q * by_q + mean * by_mean);
}
std::vector<double> grown(const GursonTvergaardNeedleman& surface, double f, double triaxiality,
                          const std::vector<double>& strains) {
  std::vector<double> result;
  double at = 0.0;
  for (const double strain : strains) {
    constexpr int steps = 40;
    const double h = (strain - at) / steps;
    for (int i = 0; i < steps; ++i) {
      const double k1 = growth_rate(surface, f, triaxiality), k2 = growth_rate(surface, f + 0.5 * h * k1, triaxiality),
                   k3 = growth_rate(surface, f + 0.5 * h * k2, triaxiality), k4 = growth_rate(surface, f + h * k3, triaxiality);
      f += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    at = strain;
    result.push_back(f);
  }
  return result;
}

Panel triaxialities(std::vector<Check>& checks) {
  Panel panel{
      .title = "growth at constant triaxiality, f0 = 0.005", .x_label = "plastic strain of the matrix", .y_label = "porosity"};
  panel.x_range = {0.0, 0.8}, panel.y_range = {0.0, 0.06};
  panel.legend = "top right maxrows auto";
  constexpr double f0 = 0.005, before_coalescence = 0.049;
  const Material material = porous_metal(1e9);
  double worst = 0.0;
  int colour = 0;
  for (const double triaxiality : {3.0, 2.0, 1.0, 1.0 / 3.0}) {
    driver::LoadingPath path = constant_triaxiality(triaxiality, 0.0, 1e3, 298.0, 0.8);
    path.porosity = f0;
    if (triaxiality >= 1.0) path.segments[0].until = driver::Until{"porosity", before_coalescence};
    path.strain_increment = 2e-4;
    const Run run = follow(material, path);
    const std::vector<double>&strain = run["plastic_strain"], &f = run["porosity"];
    panel.curves.push_back(curve(fmt::format("triaxiality {:.2g}", triaxiality), strain, f, 1.0, 1.0, Mark::line, colour));
    const std::vector<double> stations = evenly(0.0, strain.back(), 10);
    const std::vector<double> exact = grown(std::get<GursonTvergaardNeedleman>(*material.yield), f0, triaxiality, stations);
    for (std::size_t i = 1; i < stations.size(); ++i)
      worst = std::max(worst, std::abs(interpolate(strain, f, stations[i]) / exact[i] - 1.0));
    panel.curves.push_back({colour == 3 ? "df/dep integrated" : "", stations, exact, Mark::points, colour});
    ++colour;
  }
  checks.push_back({"constant triaxiality 1/3 to 3: largest relative difference of f", "df/dep of Gurson's flow, Runge-Kutta",
                    worst, 0.005});
  return panel;
}

}  // namespace

Picture porosity() {
  Picture picture;
  picture.figure = {.title = "Porous metal: q1 = 1.5, q2 = 1, q3 = 2.25, coalescence from f = 0.05",
                    .panels = {},
                    .columns = 2,
                    .panel_width = 600,
                    .panel_height = 430};
  for (const auto panel : {growth, nucleation, surfaces, triaxialities}) picture.figure.panels.push_back(panel(picture.checks));
  return picture;
}

}  // namespace brisance::plots
