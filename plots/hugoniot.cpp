// Shock states of aluminium against two sets of data; expansion of detonation products along their isentrope.

#include <fmt/format.h>

#include <cmath>

#include "driver/point.hpp"
#include "gallery.hpp"
#include "models/equation_of_state/hugoniot.hpp"
#include "models/input/csv.hpp"
#include "models/update.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using equation_of_state::MieGruneisenEnergy;
using equation_of_state::MieGruneisenTemperature;

constexpr double room = 298.0;

struct Measured {
  std::string title;
  Mark mark;
  int colour;
  std::vector<double> volume, pressure;  // V/V0, Pa
};
Measured measured(std::string title, Mark mark, int colour, std::string_view folder) {
  const CsvFile csv = CsvFile::load(data_folder() / "experiments" / folder / "hugoniot.csv");
  return {std::move(title), mark, colour, csv.numbers("volume_ratio", Unit::one), csv.numbers("pressure", Unit::Pa)};
}

/// The pressure behind a shock by a single step of the update from rest: its energy balance over a step is the jump condition.
double pressure_by_one_step(const Material& material, double volume) {
  driver::PointUpdate update(material);
  constexpr double dt = 1e-6;
  const double rate = std::log(volume) / (3.0 * dt);
  return update(initial_state(material, room), rate * Tensor<double>::identity(), dt, dt).pressure;
}

struct Models {
  MieGruneisenTemperature thermal;
  MieGruneisenEnergy energy;

  double density() const { return thermal.reference_density; }
  double exact(double volume) const {
    const double x = 1.0 - volume, stretch = 1.0 - thermal.slope * x;
    return density() * thermal.sound_speed * thermal.sound_speed * x / (stretch * stretch);
  }
  template <class Law>
  double shock(const Law& law, double volume) const {
    return equation_of_state::shock_to_density(law, density(), room, density() / volume)->pressure;
  }
};

Models aluminium_models() {
  const auto thermal = std::get<MieGruneisenTemperature>(read("aluminium_6061_t6_johnson_cook").equation_of_state);
  return {thermal,
          {thermal.reference_density, thermal.sound_speed, thermal.slope, thermal.gruneisen, thermal.specific_heat, room}};
}

Panel pressure_and_volume(const Models& models, const std::vector<Measured>& data, std::vector<Check>& checks) {
  Panel panel{.title = "aluminium, states behind a shock", .x_label = "V / V_0", .y_label = "pressure (GPa)"};
  panel.legend = "top right";
  panel.x_range = {0.54, 1.0}, panel.y_range = {0.0, 260.0};
  Curve energy{"energy form", {}, {}, Mark::line, 0}, thermal{"temperature form", {}, {}, Mark::dashed, 1},
      cold{"temperature form, unheated", {}, {}, Mark::dashed, 5},
      steps{"energy form, one step of the update", {}, {}, Mark::points, 6};
  double worst = 0.0;
  for (const double V : evenly(0.999, 0.55, 100)) {
    energy.x.push_back(V), energy.y.push_back(1e-9 * models.shock(models.energy, V));
    thermal.x.push_back(V), thermal.y.push_back(1e-9 * models.shock(models.thermal, V));
    cold.x.push_back(V), cold.y.push_back(1e-9 * models.thermal.pressure(models.density() / V, 0.0));
    worst = std::max(worst, std::abs(models.shock(models.energy, V) / models.exact(V) - 1.0));
  }
  Material material;
  material.density = models.density();
  material.equation_of_state = models.energy;
  double step_error = 0.0;
  for (const double V : evenly(0.97, 0.79, 6)) {
    const double p = pressure_by_one_step(material, V);
    steps.x.push_back(V), steps.y.push_back(1e-9 * p);
    step_error = std::max(step_error, std::abs(p / models.exact(V) - 1.0));
  }
  panel.curves = {energy, thermal, cold, steps};
  for (const Measured& set : data)
    panel.curves.push_back(curve(set.title, set.volume, set.pressure, 1.0, 1e-9, set.mark, set.colour));
  checks.push_back({"energy form: largest relative error of the shock pressure", "rho0 c0^2 x/(1 - s x)^2", worst, 1e-10});
  checks.push_back({"temperature form less energy form behind a shock to V/V0 = 0.9",
                    "the cold compression that it leaves out",
                    100.0 * (models.shock(models.thermal, 0.9) / models.shock(models.energy, 0.9) - 1.0),
                    {},
                    "%"});
  checks.push_back({"one step of the update: relative error", "rho0 c0^2 x/(1 - s x)^2", step_error, 1e-10});
  return panel;
}

Panel shock_and_particle_velocity(const Models& models, const std::vector<Measured>& data) {
  Panel panel{.title = "the same as velocities", .x_label = "particle velocity (km/s)", .y_label = "shock velocity (km/s)"};
  Curve energy{"energy form = 5.24 + 1.40 up", {}, {}, Mark::line, 0}, thermal{"temperature form", {}, {}, Mark::dashed, 1};
  for (const double up : evenly(50.0, 5500.0, 60)) {
    const auto add = [&](Curve& line, const auto& law) {
      if (const auto behind = equation_of_state::shock_to_particle_velocity(law, models.density(), room, up))
        line.x.push_back(1e-3 * up), line.y.push_back(1e-3 * behind->shock_velocity);
    };
    add(energy, models.energy), add(thermal, models.thermal);
  }
  panel.curves = {energy, thermal};
  panel.x_range = {0.0, 6.0};
  for (const Measured& set : data) {
    Curve dots{set.title, {}, {}, set.mark, set.colour};
    for (std::size_t i = 0; i < set.volume.size(); ++i) {
      const double x = 1.0 - set.volume[i];
      dots.x.push_back(1e-3 * std::sqrt(set.pressure[i] * x / models.density()));
      dots.y.push_back(1e-3 * std::sqrt(set.pressure[i] / (x * models.density())));
    }
    panel.curves.push_back(std::move(dots));
  }
  return panel;
}

Panel deviations(const Models& models, const std::vector<Measured>& data, std::vector<Check>& checks) {
  Panel panel{
      .title = "data against the energy form", .x_label = "pressure (GPa)", .y_label = "(computed − measured) / measured (%)"};
  panel.legend = "top right";
  panel.y_range = {-20.0, 20.0};
  for (const Measured& set : data) {
    Curve dots{set.title, {}, {}, set.mark, set.colour};
    double mean = 0.0, squares = 0.0, thermal = 0.0;
    for (std::size_t i = 0; i < set.volume.size(); ++i) {
      const double error = models.exact(set.volume[i]) / set.pressure[i] - 1.0;
      const double n = static_cast<double>(set.volume.size());
      mean += error / n, squares += error * error / n;
      thermal += (models.shock(models.thermal, set.volume[i]) / set.pressure[i] - 1.0) / n;
      dots.x.push_back(1e-9 * set.pressure[i]), dots.y.push_back(100.0 * error);
    }
    panel.curves.push_back(std::move(dots));
    // Digitised points scatter by 6 % and two laboratories differ by 4 %.
    checks.push_back({"shock pressure: mean deviation, energy form", set.title, 100.0 * mean, 5.0, "%"});
    checks.push_back({"shock pressure: RMS deviation, energy form", set.title, 100.0 * std::sqrt(squares), {}, "%"});
    checks.push_back({"shock pressure: mean deviation, temperature form", set.title, 100.0 * thermal, {}, "%"});
  }
  panel.curves.push_back({"", {0.0, 200.0}, {0.0, 0.0}, Mark::line, 6});
  return panel;
}

/// The products of PBX 9501 from their Chapman-Jouguet volume to ten times that of the explosive.
Panel expansion(std::vector<Check>& checks) {
  Panel panel{.title = "PBX 9501 products, isentrope from the Chapman-Jouguet state",
              .x_label = "V = ρ_0 / ρ",
              .y_label = "pressure (GPa)"};
  panel.logarithmic_x = panel.logarithmic_y = true;
  panel.legend = "top right";
  panel.x_range = {0.7, 12.0};
  const Material products = read("pbx_9501_products");
  const auto& law = std::get<equation_of_state::JonesWilkinsLee>(products.equation_of_state);
  constexpr double C = 1.8229e9, chapman_jouguet_volume = 0.7621;
  const double rho0 = law.reference_density;
  const auto isentrope = [&](double V) {
    return law.A * std::exp(-law.R1 * V) + law.B * std::exp(-law.R2 * V) + C * std::pow(V, -1.0 - law.omega);
  };
  driver::PathSegment expand;
  expand.where = "expansion";
  expand.velocity_gradient = 1e5 / 3.0 * Tensor<double>::identity();
  expand.until = driver::Until{"density", rho0 / 10.0};
  driver::LoadingPath path;
  path.density = rho0 / chapman_jouguet_volume;
  path.temperature = C / (law.omega * rho0 * law.specific_heat) * std::pow(chapman_jouguet_volume, -law.omega);
  path.strain_increment = 1e-3;
  path.segments = {expand};
  const Run run = follow(products, path);
  std::vector<double> volume, computed, closed;
  double worst = 0.0;
  for (std::size_t i = 0; i < run["density"].size(); ++i) {
    volume.push_back(rho0 / run["density"][i]);
    computed.push_back(1e-9 * run["pressure"][i]);
    closed.push_back(1e-9 * isentrope(volume.back()));
    worst = std::max(worst, std::abs(run["pressure"][i] / isentrope(volume.back()) - 1.0));
  }
  panel.curves = {curve("A exp(-R1 V) + B exp(-R2 V) + C V^(-1-ω)", volume, closed, 1.0, 1.0, Mark::line, 0),
                  curve("update", volume, computed, 1.0, 1.0, Mark::points, 1, 25)};
  checks.push_back({"JWL expansion to V = 10: largest relative error of p", "isentrope in closed form", worst, 1e-4});
  return panel;
}

}  // namespace

Picture hugoniot() {
  const Models models = aluminium_models();
  const std::vector<Measured> data{measured("McQueen et al. 1970", Mark::points, 2, "mcqueen_1970_aluminium_hugoniot"),
                                   measured("Mitchell & Nellis 1981", Mark::squares, 3, "mitchell_1981_aluminium_hugoniot")};
  Picture picture;
  picture.figure = {
      .title = "Shocks in aluminium: Mie-Grueneisen with Us = 5.24 km/s + 1.40 up; expansion of detonation products",
      .panels = {},
      .columns = 2,
      .panel_width = 600,
      .panel_height = 430};
  picture.figure.panels.push_back(pressure_and_volume(models, data, picture.checks));
  picture.figure.panels.push_back(shock_and_particle_velocity(models, data));
  picture.figure.panels.push_back(deviations(models, data, picture.checks));
  picture.figure.panels.push_back(expansion(picture.checks));
  return picture;
}

}  // namespace brisance::plots
