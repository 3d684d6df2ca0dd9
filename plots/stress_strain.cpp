// Copper under the five flow stress laws: every curve is the update's own, along uniaxial compression.

#include <fmt/format.h>

#include <cmath>

#include "gallery.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

struct Metal {
  std::string_view title;
  Material material;
};

/// Annealed OFHC copper with the constants of Zerilli & Armstrong 1987; everything else from the Johnson-Cook file.
Material zerilli_armstrong_copper() {
  Material material = read("copper_ofhc_johnson_cook");
  flow_stress::ZerilliArmstrong law{};
  law.athermal_stress = 46.5e6, law.hall_petch_slope = 5e6 * std::sqrt(1e-3), law.grain_size = 73e-6;
  law.B0 = 890e6, law.alpha0 = 0.0028, law.alpha1 = 0.000115;
  material.flow_stress = law;
  return material;
}

/// Largest |q/Y - 1| of a run, with Y from the formula at the state that the return was asked to meet: strain and rate at the
/// end of the step, temperature and pressure at its start.
double inconsistency(const Material& material, const Run& run) {
  double worst = 0.0;
  const std::vector<double>&q = run["equivalent_stress"], &strain = run["plastic_strain"], &rate = run["plastic_strain_rate"],
        &T = run["temperature"], &Tm = run["melting_temperature"], &mu = run["shear_modulus"], &p = run["pressure"],
        &rho = run["density"];
  std::visit(
      [&]<class Law>(const Law& law) {
        for (std::size_t i = 1; i < q.size(); ++i) {
          if (!(strain[i] > strain[i - 1])) continue;
          const flow_stress::Arguments<double> at{strain[i], rate[i], T[i - 1], Tm[i], mu[i], p[i - 1], rho[i]};
          double Y = 0.0;
          if constexpr (flow_stress::WithHistory<Law>)
            Y = law(at, run[Law::history.name][i]);
          else
            Y = law(at);
          worst = std::max(worst, std::abs(q[i] / Y - 1.0));
        }
      },
      *material.flow_stress);
  return worst;
}

constexpr double largest_strain = 0.6, room = 298.0;
constexpr double adiabatic_from = 1.0;  // 1/s: slower tests keep their temperature

Run compress(const Material& material, double rate, double temperature, double strain) {
  driver::LoadingPath path = uniaxial_stress(-rate, temperature, strain);
  path.heat = rate > adiabatic_from ? driver::Heat::adiabatic : driver::Heat::isothermal;
  return follow(material, path);
}

Panel family(const Metal& metal, double& worst) {
  Panel panel{.title = std::string(metal.title), .x_label = "plastic strain", .y_label = "flow stress (MPa)"};
  panel.x_range = {0.0, largest_strain}, panel.y_range = {0.0, 800.0};
  const auto add = [&](std::string title, double rate, double temperature, Mark mark, int colour) {
    const Run run = compress(metal.material, rate, temperature, largest_strain);
    worst = std::max(worst, inconsistency(metal.material, run));
    panel.curves.push_back(curve(std::move(title), run["plastic_strain"], run["equivalent_stress"], 1.0, 1e-6, mark, colour));
  };
  add("298 K, 10⁵ /s", 1e5, room, Mark::line, 1);
  add("298 K, 10³ /s", 1e3, room, Mark::line, 0);
  add("298 K, 10⁻³ /s", 1e-3, room, Mark::line, 2);
  add("77 K, 10³ /s", 1e3, 77.0, Mark::dashed, 5);
  add("600 K, 10³ /s", 1e3, 600.0, Mark::dashed, 4);
  add("900 K, 10³ /s", 1e3, 900.0, Mark::dashed, 3);
  return panel;
}

Panel against_rate(const std::vector<Metal>& metals) {
  Panel panel{
      .title = "plastic strain 0.15, isothermal at 298 K", .x_label = "strain rate (1/s)", .y_label = "flow stress (MPa)"};
  panel.logarithmic_x = true;
  panel.y_range = {0.0, 1000.0};
  for (std::size_t m = 0; m < metals.size(); ++m) {
    Curve line{std::string(metals[m].title), {}, {}, Mark::line, static_cast<int>(m)};
    for (double exponent = -3.0; exponent <= 8.0; exponent += 0.5) {
      driver::LoadingPath path = uniaxial_stress(-std::pow(10.0, exponent), room, 0.15);
      path.heat = driver::Heat::isothermal;
      path.strain_increment = 1e-3;
      line.x.push_back(std::pow(10.0, exponent));
      line.y.push_back(1e-6 * follow(metals[m].material, path)["equivalent_stress"].back());
    }
    panel.curves.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

Picture stress_strain() {
  const std::vector<Metal> metals{{"Johnson-Cook", read("copper_ofhc_johnson_cook")},
                                  {"mechanical threshold stress", read("copper_ofhc_mts")},
                                  {"Preston-Tonks-Wallace", read("copper_ofhc_ptw")},
                                  {"Steinberg-Cochran-Guinan (half hard)", read("copper_ofhc_scg")},
                                  {"Zerilli-Armstrong", zerilli_armstrong_copper()}};
  Picture picture;
  picture.figure = {.title = "OFHC copper in uniaxial compression: adiabatic at 10³ and 10⁵ /s, isothermal at 10⁻³ /s",
                    .panels = {},
                    .columns = 3,
                    .panel_width = 480,
                    .panel_height = 420};
  for (const Metal& metal : metals) {
    double worst = 0.0;
    picture.figure.panels.push_back(family(metal, worst));
    // The return mapping stops at a residual of 1e-10 of the stress; the rest is the round-off of q and of the record.
    picture.checks.push_back({fmt::format("{}: largest |q/Y - 1|", metal.title), "formula at the recorded state", worst, 1e-9});
  }
  picture.figure.panels.push_back(against_rate(metals));
  return picture;
}

}  // namespace brisance::plots
