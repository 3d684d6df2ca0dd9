// The classic scheme beside the conservative one at a strong shock tube: one converges, the other does not.
//   ice_comparison [-o DIR]
// Ends with 1 when the conservative scheme misses its goals, 2 when it was called wrongly.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <vector>

#include "models/programs/figure.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {
namespace {

/// Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. 2009, section 4.3.3, test 3.
const GasState left{1.0, 0.0, 1000.0}, right{1.0, 0.0, 0.01};
constexpr double diaphragm = 0.5, end = 0.012, courant = 0.4;
constexpr std::array sizes = {50, 100, 200, 400, 800};
constexpr std::array goals = {0.0, 0.10, 0.06, 0.03, 0.015};  // of the conservative scheme; 0: none

struct Result {
  std::vector<GasState> profile;
  double error = 0.0, drift = 0.0;  // L1 of the density; part of the energy
};
Result run(bool classic, int cells) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0}, {set_up::ideal_gas()}, *domain);
  if (classic) gas.classic.emplace();
  fill(
      gas,
      [](const Vector& x, double) {
        const GasState& w = x[0] < diaphragm ? left : right;
        return Filling{0, w.density, w.pressure, {}};
      },
      *domain);
  const double before = totals(gas, *domain).energy;
  set_up::Stepper{.courant = courant}.to(gas, end, *domain);
  const ExactRiemann exact(left, right);
  const auto average = [&](double from, double to) { return exact.average(from, to, end, diaphragm); };
  return {set_up::profile(gas), set_up::mean_errors(gas, average).density, totals(gas, *domain).energy / before - 1.0};
}

Curve profile_of(const std::vector<GasState>& cells, double GasState::*what, std::string title, int colour) {
  Curve curve{std::move(title), {}, {}, Mark::points, colour};
  curve.size = 0.4;
  for (std::size_t i = 0; i < cells.size(); ++i)
    curve.x.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(cells.size())), curve.y.push_back(cells[i].*what);
  return curve;
}

int compare(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  Panel errors{.title = "error", .x_label = "cells", .y_label = "L1 of the density"};
  errors.logarithmic_x = errors.logarithmic_y = true, errors.legend = "bottom left";
  Panel drift{.title = "energy", .x_label = "cells", .y_label = "|change| of the energy (%)"};
  drift.logarithmic_x = drift.logarithmic_y = true, drift.legend = "right center";
  Panel density{.title = "400 cells", .x_label = "x", .y_label = "density"};
  density.x_range = {0.65, 0.85};
  Panel velocity{.title = "400 cells", .x_label = "x", .y_label = "velocity"};
  velocity.x_range = {0.4, 0.85}, velocity.legend = "left center";
  const ExactRiemann exact(left, right);
  for (const auto& [panel, what] : {std::pair{&density, &GasState::density}, {&velocity, &GasState::velocity}}) {
    Curve truth{"exact", {}, {}, Mark::line, 2};
    constexpr int places = 4000;
    for (int i = 0; i < places; ++i) {
      const double x = (i + 0.5) / places;
      truth.x.push_back(x), truth.y.push_back(exact.at((x - diaphragm) / end).*what);
    }
    panel->curves.push_back(truth);
  }
  bool good = true;
  fmt::print("{:14} {:>6} {:>12} {:>12}\n", "scheme", "cells", "L1 density", "energy");
  for (const bool classic : {true, false}) {
    const std::string name = classic ? "classic" : "conservative";
    const int colour = classic ? 1 : 0;
    Curve error{name, {}, {}, Mark::line, colour}, change{name, {}, {}, Mark::line, colour};
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const Result r = run(classic, sizes[k]);
      fmt::print("{:14} {:6} {:12.4g} {:12.3g}\n", name, sizes[k], r.error, r.drift);
      error.x.push_back(sizes[k]), error.y.push_back(r.error);
      change.x.push_back(sizes[k]), change.y.push_back(100.0 * std::max(std::abs(r.drift), 1e-16));
      if (!classic && goals[k] > 0.0) good = good && r.error <= goals[k] && std::abs(r.drift) < 1e-13;
      if (sizes[k] != 400) continue;
      density.curves.push_back(profile_of(r.profile, &GasState::density, name, colour));
      velocity.curves.push_back(profile_of(r.profile, &GasState::velocity, name, colour));
    }
    errors.curves.push_back(error), drift.curves.push_back(change);
  }
  const Figure figure{"Shock tube 1000 : 0.01, classic and conservative ICE", {errors, drift, density, velocity}, 2};
  for (const char* ending : {".png", ".svg"}) draw(figure, directory / (std::string("ice_comparison") + ending));
  if (!good) fmt::print("the conservative scheme misses a goal\n");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace brisance::simulator::gas

int main(int count, char** words) {
  CLI::App app{"Draws the classic scheme of the gas beside the conservative one."};
  std::string directory = "plots/gallery";
  app.add_option("-o", directory, "folder for the figure")->capture_default_str();
  try {
    app.parse(count, words);
    return brisance::simulator::gas::compare(directory);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ice_comparison: {}\n", error.what());
    return 1;
  }
}
