// Heat of plastic work: against the closed form for Johnson-Cook's law with m = 1, and against the adiabat integrated apart.

#include <fmt/format.h>

#include <cmath>

#include "gallery.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

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

Panel closed_form(std::vector<Check>& checks) {
  Panel panel{
      .title = "4340 steel with m = 1, 1000 /s, volume kept", .x_label = "plastic strain", .y_label = "temperature (K)"};
  panel.x_range = {0.0, 1.0}, panel.y_range = {200.0, 1400.0};
  Material material = read("steel_4340");
  auto& law = std::get<flow_stress::JohnsonCook>(*material.flow_stress);
  law.m = 1.0;
  // The plastic rate differs from the applied one while the elastic strain changes; without its factor the check is exact.
  law.C = 0.0;
  const double cp = std::get<specific_heat::Constant>(*material.specific_heat).value;
  const double Tm = std::get<melting::Constant>(*material.melting).value;
  std::vector<double> errors;
  int colour = 0;
  for (const double T0 : {298.0, 600.0, 900.0}) {
    for (const double increment : {5e-4, 2.5e-4}) {
      driver::LoadingPath path = constant_volume(1e3, T0, 1.0);
      path.strain_increment = increment;
      const Run run = follow(material, path);
      // A hot body starts free of stress, at less than the density of its material.
      const ClosedForm exact{law, Tm, run["density"].front() * cp, material.heating->taylor_quinney.y[0], 1.0};
      const std::vector<double>&strain = run["plastic_strain"], &T = run["temperature"];
      double error = 0.0;
      std::vector<double> closed;
      for (std::size_t i = 0; i < strain.size(); ++i) {
        closed.push_back(exact(strain[i], T0));
        error = std::max(error, std::abs(T[i] - closed[i]));
      }
      errors.push_back(error);
      if (increment < 5e-4) continue;
      panel.curves.push_back(curve(fmt::format("{:g} K, closed form", T0), strain, closed, 1.0, 1.0, Mark::line, colour));
      panel.curves.push_back(curve(T0 > 600.0 ? "update" : "", strain, T, 1.0, 1.0, Mark::points, colour, 21));
      ++colour;
    }
  }
  // The flow stress of a step sees the temperature at its start: half a step of lag, 0.04 K of some 1 K per step of 4e-4.
  checks.push_back({"m = 1: largest |T - closed form| from 298, 600, 900 K", "Johnson-Cook adiabat, closed form",
                    std::max({errors[0], errors[2], errors[4]}), 0.2, "K"});
  checks.push_back({"m = 1: order of convergence - 1", "explicit heating: 1", std::log2(errors[0] / errors[1]) - 1.0, 0.1});
  return panel;
}

/// T of the adiabat dT/dep = chi Y(ep, r, T)/(rho cp) at plastic strains, by Runge and Kutta's method. The variable is the
/// fourth root of the strain, in which the flow stress is smooth at its start.
std::vector<double> adiabat(const Material& material, double rate, double initial_temperature,
                            const std::vector<double>& strains) {
  const auto& law = std::get<flow_stress::JohnsonCook>(*material.flow_stress);
  const double Tm = std::get<melting::Constant>(*material.melting).value;
  const double cp = std::get<specific_heat::Constant>(*material.specific_heat).value;
  const double chi = material.heating->taylor_quinney.y[0];
  const auto slope = [&](double x, double T) {
    const flow_stress::Arguments<double> at{x * x * x * x, rate, T, Tm, 1.0, 0.0, material.density};
    return 4.0 * x * x * x * chi * law(at) / (material.density * cp);
  };
  std::vector<double> result;
  double x = 0.0, T = initial_temperature;
  for (const double strain : strains) {
    constexpr int steps = 50;
    const double h = (std::sqrt(std::sqrt(strain)) - x) / steps;
    for (int i = 0; i < steps; ++i, x += h) {
      const double k1 = slope(x, T), k2 = slope(x + 0.5 * h, T + 0.5 * h * k1), k3 = slope(x + 0.5 * h, T + 0.5 * h * k2),
                   k4 = slope(x + h, T + h * k3);
      T += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    result.push_back(T);
  }
  return result;
}

/// One metal at three rates; points from the adiabat as an ordinary differential equation.
void real_metal(std::string_view title, const Material& material, Panel& temperature, Panel& stress,
                std::vector<Check>& checks) {
  temperature = {.title = std::string(title) + ", adiabatic", .x_label = "plastic strain", .y_label = "temperature (K)"};
  stress = {.title = std::string(title) + ", flow stress", .x_label = "plastic strain", .y_label = "equivalent stress (MPa)"};
  constexpr double largest_strain = 0.8;
  double worst = 0.0;
  int colour = 0;
  for (const double rate : {1e4, 1e2, 1.0}) {
    const Run run = follow(material, constant_volume(rate, 298.0, largest_strain));
    const std::vector<double>&strain = run["plastic_strain"], &T = run["temperature"];
    const std::string name = fmt::format("{:g} /s", rate);
    temperature.curves.push_back(curve(name, strain, T, 1.0, 1.0, Mark::line, colour));
    stress.curves.push_back(curve(name, strain, run["equivalent_stress"], 1.0, 1e-6, Mark::line, colour));
    const std::vector<double> stations = evenly(0.0, largest_strain, 16), exact = adiabat(material, rate, 298.0, stations);
    for (std::size_t i = 1; i < stations.size(); ++i)
      worst = std::max(worst, std::abs(interpolate(strain, T, stations[i]) - exact[i]));
    temperature.curves.push_back({colour == 2 ? "dT/dep integrated" : "", stations, exact, Mark::points, colour});
    ++colour;
  }
  driver::LoadingPath cold = constant_volume(1e4, 298.0, largest_strain);
  cold.heat = driver::Heat::isothermal;
  const Run run = follow(material, cold);
  stress.curves.push_back(
      curve("10000 /s, isothermal", run["plastic_strain"], run["equivalent_stress"], 1.0, 1e-6, Mark::dashed, 6));
  stress.legend = "bottom right";
  checks.push_back({fmt::format("{}: largest temperature difference at 1, 100, 10000 /s", title),
                    "dT/dep = chi Y/(rho cp), Runge-Kutta", worst, 0.2, "K"});
}

}  // namespace

Picture adiabatic_temperature() {
  Picture picture;
  picture.figure = {.title = "Temperature rise by plastic work, nine tenths of it heat",
                    .panels = {},
                    .columns = 2,
                    .panel_width = 600,
                    .panel_height = 430};
  std::vector<Panel> panels(4);
  Panel copper_stress;
  panels[0] = closed_form(picture.checks);
  real_metal("4340 steel", read("steel_4340"), panels[1], panels[2], picture.checks);
  real_metal("OFHC copper", read("copper_ofhc_johnson_cook"), panels[3], copper_stress, picture.checks);
  picture.figure.panels = std::move(panels);
  return picture;
}

}  // namespace brisance::plots
