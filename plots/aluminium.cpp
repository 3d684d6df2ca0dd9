// State functions of aluminium against measurements: compression, melting, moduli, specific heat.

#include <fmt/format.h>

#include <cmath>

#include "gallery.hpp"
#include "models/equation_of_state/thermodynamics.hpp"
#include "models/input/csv.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using equation_of_state::MieGruneisenEnergy;
using equation_of_state::MieGruneisenTemperature;

constexpr double melting_point = 933.5;  // K, of pure aluminium, which the measurements are of

CsvFile experiment(std::string_view folder, std::string_view file) {
  return CsvFile::load(data_folder() / "experiments" / folder / file);
}
MieGruneisenEnergy equation_of_state_of_aluminium() {
  const auto law = std::get<MieGruneisenTemperature>(read("aluminium_6061_t6_johnson_cook").equation_of_state);
  return {law.reference_density, law.sound_speed, law.slope, law.gruneisen, law.specific_heat, 298.0};
}

/// Mean of computed/measured - 1, in per cent.
template <class Model>
double mean_deviation(const std::vector<double>& x, const std::vector<double>& measured, Model&& model) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += model(x[i]) / measured[i] - 1.0;
  return 100.0 * sum / static_cast<double>(x.size());
}
template <class Model>
Curve sampled(std::string title, const std::vector<double>& x, double x_factor, double y_factor, Mark style, int colour,
              Model&& model) {
  Curve line{std::move(title), {}, {}, style, colour};
  for (const double at : x) line.x.push_back(x_factor * at), line.y.push_back(y_factor * model(at));
  return line;
}

Panel isotherm(std::vector<Check>& checks) {
  Panel panel{.title = "compression at room temperature", .x_label = "pressure (GPa)", .y_label = "V / V_0"};
  panel.legend = "top right";
  const CsvFile csv = experiment("vaidya_1970_aluminium_isotherm", "isotherm.csv");
  const std::vector<double> p = csv.numbers("pressure", Unit::Pa), V = csv.numbers("volume_ratio", Unit::one);
  const MieGruneisenEnergy law = equation_of_state_of_aluminium();
  const auto volume = [&](double pressure) {
    return law.reference_density / equation_of_state::density_at(law, pressure, 298.0);
  };
  panel.curves = {sampled("Mie-Grueneisen, energy form", evenly(0.0, 5e9, 100), 1e-9, 1.0, Mark::line, 0, volume),
                  curve("Vaidya & Kennedy 1970", p, V, 1e-9, 1.0, Mark::points, 2)};
  double worst = 0.0, compression = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    worst = std::max(worst, std::abs(volume(p[i]) - V[i]));
    compression += ((1.0 - volume(p[i])) / (1.0 - V[i]) - 1.0) / static_cast<double>(p.size());
  }
  checks.push_back({"isotherm to 4.5 GPa: largest difference of V/V0", "Vaidya & Kennedy 1970", worst, 0.01});
  checks.push_back(
      {"isotherm: mean deviation of the compression 1 - V/V0", "Vaidya & Kennedy 1970", 100.0 * compression, {}, "%"});
  return panel;
}

/// Tm of a law whose argument is the compression, at a pressure: the compression is that of the solid at Tm itself.
template <class Law>
double melting_temperature(const Law& law, const MieGruneisenEnergy& metal, double pressure) {
  double low = 1.0, high = 2e4;
  for (int i = 0; i < 60; ++i) {
    const double T = 0.5 * (low + high);
    const double compression = equation_of_state::density_at(metal, pressure, T) / metal.reference_density;
    (law(melting::Arguments<double>{pressure, compression}) > T ? low : high) = T;
  }
  return 0.5 * (low + high);
}

Panel melting_curve(std::vector<Check>& checks) {
  Panel panel{.title = "melting", .x_label = "pressure (GPa)", .y_label = "melting temperature (K)"};
  panel.legend = "bottom right";
  const CsvFile csv = experiment("boehler_1997_aluminium_melting", "melting.csv");
  const std::vector<double> p = csv.numbers("pressure", Unit::Pa), T = csv.numbers("temperature", Unit::K),
                            low = csv.numbers("lowest_temperature", Unit::K),
                            high = csv.numbers("highest_temperature", Unit::K);
  const MieGruneisenEnergy metal = equation_of_state_of_aluminium();
  const melting::SteinbergCochranGuinan lindemann{1220.0, 1.97, 1.5};
  // Metal constants as far as they are tabulated; kappa, b^2 rho_c, alpha and lambda are those of an fcc metal (copper).
  melting::BurakovskyPrestonSilbar dislocations{};
  dislocations.bulk_modulus = 74.2e9, dislocations.bulk_modulus_slope = 4.0 * metal.slope - 1.0;
  dislocations.shear_modulus = 27.6e9, dislocations.shear_modulus_slope = 65.2e-12 * 27.6e9;
  dislocations.kappa = 1.25, dislocations.coordination_number = 12.0, dislocations.b2_rho_c = 0.64, dislocations.alpha = 2.9;
  dislocations.lambda = 1.41, dislocations.lattice_parameter = 4.05e-10, dislocations.atoms_per_cell = 4.0;
  const auto scg = [&](double pressure) { return melting_temperature(lindemann, metal, pressure); };
  const auto bps = [&](double pressure) { return dislocations(melting::Arguments<double>{pressure, 1.0}); };
  Curve bars{"", {}, {}, Mark::line, 2};
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (const double end : {low[i], high[i]}) bars.x.push_back(1e-9 * p[i]), bars.y.push_back(end);
    bars.x.push_back(std::nan("")), bars.y.push_back(std::nan(""));
  }
  const std::vector<double> at = evenly(0.0, 130e9, 100);
  panel.curves = {sampled("Steinberg-Cochran-Guinan", at, 1e-9, 1.0, Mark::line, 0, scg),
                  sampled("Burakovsky-Preston-Silbar, core of copper", at, 1e-9, 1.0, Mark::dashed, 1, bps),
                  curve("Boehler & Ross 1997", p, T, 1e-9, 1.0, Mark::points, 2), bars};
  // The bars of the measurement are 4 to 6 % above ambient pressure.
  checks.push_back(
      {"melting, Steinberg-Cochran-Guinan: mean deviation", "Boehler & Ross 1997", mean_deviation(p, T, scg), {}, "%"});
  checks.push_back(
      {"melting, Burakovsky-Preston-Silbar: mean deviation", "Boehler & Ross 1997", mean_deviation(p, T, bps), {}, "%"});
  checks.push_back({"melting point at ambient pressure, SCG", "933.5 K", 100.0 * (scg(0.0) / melting_point - 1.0), {}, "%"});
  return panel;
}

Panel shear_moduli(std::vector<Check>& checks) {
  Panel panel{.title = "shear modulus at ambient pressure", .x_label = "temperature (K)", .y_label = "shear modulus (GPa)"};
  panel.legend = "bottom left";
  panel.y_range = {0.0, 34.0};
  const CsvFile csv = experiment("tallon_1979_aluminium_moduli", "moduli.csv");
  const std::vector<double> T = csv.numbers("temperature", Unit::K), C44 = csv.numbers("C44", Unit::Pa),
                            C_prime = csv.numbers("C_prime", Unit::Pa);
  std::vector<double> mean;
  for (std::size_t i = 0; i < T.size(); ++i) mean.push_back(0.5 * (C44[i] + C_prime[i]));
  const auto of = [](const auto& law) {
    return [law](double temperature) {
      return law(shear_modulus::Arguments<double>{temperature, melting_point, 0.0, 2703.0, 1.0});
    };
  };
  const auto varshni = of(shear_modulus::VarshniChenGray{28.0e9, 4.5e9, 294.0});
  const auto steinberg = of(shear_modulus::SteinbergCochranGuinan{27.6e9, 65.2e-12, 6.16e-4, 300.0});
  const auto nadal = of(shear_modulus::NadalLePoac{26.5e9, 65.0e-12, 0.04, 0.047, 26.98});
  const std::vector<double> at = evenly(50.0, 932.0, 120);
  panel.curves = {curve("C44", T, C44, 1.0, 1e-9, Mark::dashed, 5),
                  curve("C'", T, C_prime, 1.0, 1e-9, Mark::dashed, 4),
                  curve("their mean (Tallon & Wolfenden 1979)", T, mean, 1.0, 1e-9, Mark::points, 2),
                  sampled("Varshni-Chen-Gray", at, 1.0, 1e-9, Mark::line, 0, varshni),
                  sampled("Steinberg-Cochran-Guinan", at, 1.0, 1e-9, Mark::line, 1, steinberg),
                  sampled("Nadal-Le Poac", at, 1.0, 1e-9, Mark::line, 3, nadal)};
  checks.push_back({"shear modulus, Varshni-Chen-Gray: mean deviation", "Tallon & Wolfenden 1979",
                    mean_deviation(T, mean, varshni), 5.0, "%"});
  checks.push_back({"shear modulus, Steinberg-Cochran-Guinan: mean deviation",
                    "Tallon & Wolfenden 1979",
                    mean_deviation(T, mean, steinberg),
                    {},
                    "%"});
  checks.push_back(
      {"shear modulus, Nadal-Le Poac: mean deviation", "Tallon & Wolfenden 1979", mean_deviation(T, mean, nadal), {}, "%"});
  return panel;
}

Panel heat(std::vector<Check>& checks) {
  Panel panel{
      .title = "specific heat at constant pressure", .x_label = "temperature (K)", .y_label = "specific heat (J/(kg K))"};
  panel.legend = "bottom right";
  panel.y_range = {400.0, 1300.0}, panel.x_range = {0.0, 1000.0};
  const CsvFile csv = experiment("desai_1987_aluminium_specific_heat", "specific_heat.csv");
  const std::vector<double> T = csv.numbers("temperature", Unit::K), cp = csv.numbers("specific_heat", Unit::J_per_kg_K);
  const double value = std::get<specific_heat::Constant>(*read("aluminium_6061_t6_johnson_cook").specific_heat).value;
  panel.curves = {curve("Desai 1987", T, cp, 1.0, 1.0, Mark::points, 2),
                  {fmt::format("constant, {:g} J/(kg K)", value), {T.front(), T.back()}, {value, value}, Mark::line, 0}};
  checks.push_back({"specific heat of 6061-T6 at 298 K: relative difference", "Desai 1987",
                    100.0 * (value / interpolate(T, cp, 298.0) - 1.0), 2.0, "%"});
  checks.push_back({"specific heat of 6061-T6 at 900 K: relative difference",
                    "Desai 1987",
                    100.0 * (value / interpolate(T, cp, 900.0) - 1.0),
                    {},
                    "%"});
  return panel;
}

}  // namespace

Picture aluminium() {
  Picture picture;
  picture.figure = {.title = "State functions of aluminium against measurements",
                    .panels = {},
                    .columns = 2,
                    .panel_width = 600,
                    .panel_height = 430};
  for (const auto panel : {isotherm, melting_curve, shear_moduli, heat}) picture.figure.panels.push_back(panel(picture.checks));
  return picture;
}

}  // namespace brisance::plots
