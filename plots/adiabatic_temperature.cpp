// Heat of plastic work: against the closed form for Johnson-Cook's law with m = 1, and against the rate form of the laws.

#include <fmt/format.h>

#include <cmath>

#include "driver/rate_form.hpp"
#include "gallery.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using driver::Curve;
using driver::Mark;
using driver::Panel;

/// Johnson-Cook with m = 1 softens linearly, so that heat and strength make one linear equation:
/// theta = 1 - (1 - theta0) exp(-k (A ep + B ep^(n+1)/(n+1))), k = chi (1 + C ln(r/r0))/(rho cp (Tm - T0)).
struct ClosedForm {
  flow_stress::JohnsonCook law;
  double melting_temperature, heat_capacity, fraction, rate;

  double operator()(double strain, double initial_temperature) const {
    const double range = melting_temperature - law.reference_temperature;
    const double k = fraction * (1.0 + law.C * std::log(rate / law.reference_strain_rate)) / (heat_capacity * range);
    const double work = law.A * strain + law.B * std::pow(strain, law.n + 1.0) / (law.n + 1.0);
    const double theta = (initial_temperature - law.reference_temperature) / range;
    return law.reference_temperature + range * (1.0 - (1.0 - theta) * std::exp(-k * work));
  }
};

double constant_of(const Material& material, double heat) {
  return material.density * heat;
}

Panel closed_form(std::vector<Check>& checks) {
  Panel panel{
      .title = "4340 steel with m = 1, 1000 /s, volume kept", .x_label = "plastic strain", .y_label = "temperature (K)"};
  Material material = read("steel_4340");
  auto& law = std::get<flow_stress::JohnsonCook>(*material.flow_stress);
  law.m = 1.0;
  // The plastic rate differs from the applied one while the elastic strain changes; without its factor the check is exact.
  law.C = 0.0;
  const double cp = std::get<specific_heat::Constant>(*material.specific_heat).value;
  const double Tm = std::get<melting::Constant>(*material.melting).value;
  const ClosedForm exact{law, Tm, constant_of(material, cp), material.heating->taylor_quinney.y[0], 1.0};
  std::vector<double> errors;
  int colour = 0;
  for (const double T0 : {298.0, 600.0, 900.0}) {
    for (const double increment : {5e-4, 2.5e-4}) {
      driver::LoadingPath path = constant_volume(1e3, T0, 1.0);
      path.strain_increment = increment;
      const Run run = follow(material, path);
      const std::vector<double>&strain = run["plastic_strain"], &T = run["temperature"];
      double error = 0.0;
      std::vector<double> closed;
      for (std::size_t i = 0; i < strain.size(); ++i) {
        closed.push_back(exact(strain[i], T0));
        error = std::max(error, std::abs(T[i] - closed[i]));
      }
      errors.push_back(error);
      if (increment < 5e-4) continue;
      panel.curves.push_back(curve(fmt::format("closed form, {:g} K", T0), strain, closed, 1.0, 1.0, Mark::line, colour));
      panel.curves.push_back(curve("update", strain, T, 1.0, 1.0, Mark::points, colour, 21));
      ++colour;
    }
  }
  // The flow stress of a step sees the temperature at its start: half a step of lag, 0.04 K of some 1 K per step of 4e-4.
  checks.push_back({"m = 1: largest |T - closed form| from 298, 600, 900 K", "Johnson-Cook adiabat, closed form",
                    std::max({errors[0], errors[2], errors[4]}), 0.2, "K"});
  checks.push_back({"m = 1: order of convergence - 1", "explicit heating: 1", std::log2(errors[0] / errors[1]) - 1.0, 0.1});
  return panel;
}

/// One metal at four rates; the rate form, integrated with error control, gives the points.
void real_metal(std::string_view title, const Material& material, double largest_strain, Panel& temperature, Panel& stress,
                std::vector<Check>& checks) {
  temperature = {.title = std::string(title) + ", adiabatic", .x_label = "plastic strain", .y_label = "temperature (K)"};
  stress = {.title = std::string(title) + ", flow stress", .x_label = "plastic strain", .y_label = "equivalent stress (MPa)"};
  double worst = 0.0;
  int colour = 0;
  for (const double rate : {1e4, 1e2, 1.0}) {
    const Run run = follow(material, constant_volume(rate, 298.0, largest_strain));
    temperature.curves.push_back(
        curve(fmt::format("{:g} /s", rate), run["plastic_strain"], run["temperature"], 1.0, 1.0, Mark::line, colour));
    stress.curves.push_back(
        curve(fmt::format("{:g} /s", rate), run["plastic_strain"], run["equivalent_stress"], 1.0, 1e-6, Mark::line, colour));
    Curve hot{colour == 2 ? "rate form" : "", {}, {}, Mark::points, colour}, strong = hot;
    State<double> state = run.outcome.start;
    constexpr int points = 8;
    const std::size_t steps = run.outcome.taken.size();
    for (int i = 0; i < points; ++i) {
      const std::size_t from = i * steps / points, to = (i + 1) * steps / points;
      state = driver::integrate_rate_form(material, state, std::span(run.outcome.taken).subspan(from, to - from),
                                          {.tolerance = 1e-8});
      hot.x.push_back(state.plastic_strain), hot.y.push_back(state.temperature);
      strong.x.push_back(state.plastic_strain), strong.y.push_back(1e-6 * equivalent_stress(deviator(state.stress)));
      worst = std::max(worst, std::abs(run["temperature"][to] - state.temperature));
    }
    temperature.curves.push_back(std::move(hot));
    stress.curves.push_back(std::move(strong));
    ++colour;
  }
  driver::LoadingPath cold = constant_volume(1e4, 298.0, largest_strain);
  cold.heat = driver::Heat::isothermal;
  const Run run = follow(material, cold);
  stress.curves.push_back(
      curve("10000 /s, isothermal", run["plastic_strain"], run["equivalent_stress"], 1.0, 1e-6, Mark::dashed, 6));
  stress.legend = "bottom right";
  checks.push_back({fmt::format("{}: largest temperature difference at 1, 100, 10000 /s", title),
                    "rate form, error control 1e-8", worst, 0.2, "K"});
}

}  // namespace

Picture adiabatic_temperature() {
  Picture picture;
  picture.figure = {.title = "Temperature rise by plastic work, nine tenths of it heat",
                    .panels = {},
                    .columns = 3,
                    .panel_width = 470,
                    .panel_height = 420};
  std::vector<Panel> panels(4);
  panels[0] = closed_form(picture.checks);
  real_metal("4340 steel", read("steel_4340"), 0.8, panels[1], panels[2], picture.checks);
  Panel copper_stress;
  real_metal("OFHC copper", read("copper_ofhc_johnson_cook"), 0.8, panels[3], copper_stress, picture.checks);
  panels.push_back(copper_stress);
  picture.figure.panels = std::move(panels);
  picture.figure.columns = 2;
  return picture;
}

}  // namespace brisance::plots
