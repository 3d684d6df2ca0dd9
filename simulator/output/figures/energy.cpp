#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "models/input/csv.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"

namespace brisance::simulator::figures {

void draw_energy(const Case& c, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const Unit unit = unit_of(Extensive::energy, c.geometry);
  const auto curve = [&](const std::string& column, const std::string& title, int colour) {
    return Curve{title, {}, history.numbers(column, unit), Mark::line, colour};
  };
  const std::vector<double> time = history.numbers("time", Unit::s);
  Panel physical =
      against_time("Energy", "energy", time,
                   {curve("kinetic_energy", "kinetic", 0), curve("plastic_work", "plastic work", 2),
                    curve("external_work", "work of loads", 3), curve("boundary_work", "work of boundaries", 4),
                    curve("friction_work", "friction", 6), curve("viscous_work", "artificial viscosity", 5),
                    curve("outflow_energy", "outflow", 7), curve("internal_energy_change", "change of internal", 1)},
                   unit);
  Panel numerical = against_time("Numerical books", "energy", time,
                                 {curve("transfer_energy", "transfer", 0), curve("filter_energy", "filter", 1),
                                  curve("filter_heat", "heat of the filter", 3),
                                  curve("stress_timing_energy", "stress timing", 2), curve("energy_residual", "in no book", 6)},
                                 unit);
  draw(c, {c.title, {std::move(physical), std::move(numerical)}, 1, 900, 380}, directory / "energy.png");
}

void draw_gas_energy(const Case& c, const Simulation& s, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const std::vector<double> time = history.numbers("time", Unit::s);
  const Unit unit = unit_of(Extensive::energy, c.geometry);
  std::vector<double> change = history.numbers("gas_energy", unit);
  const std::vector<double> kinetic = history.numbers("gas_kinetic_energy", unit);
  constexpr double rounding = 1e-12;
  const double start = change.front(), noise = rounding * std::abs(start);
  std::vector<double> internal;  // its change
  for (std::size_t i = 0; i < change.size(); ++i) {
    change[i] -= start;
    internal.push_back(change[i] - (kinetic[i] - kinetic.front()));
  }
  std::vector<Curve> curves;
  const auto add = [&](const std::string& title, const std::string& column, double factor = 1.0) {
    curves.push_back({title, {}, scaled(history.numbers(column, unit), factor)});
  };
  add("kinetic", "gas_kinetic_energy");
  for (const gas::Edge& edge : s.gas.edges)  // what leaves at a periodic side comes in at the other
    if (edge.kind != EdgeKind::periodic) add("through " + edge.name, edge.name + "_energy");
  for (const gas::Burn& burn : s.gas.burns) add("heat of " + burn.name, burn.name + "_heat");
  for (const gas::MovingBody& body : s.gas.bodies.all) add("work of " + body.name, body.name + "_work", -1.0);
  if (s.gas.gravity != Vector{}) add("work of gravity", "gravity_energy");
  add("in no book", "gas_residual_energy");
  curves.push_back({"change of internal", {}, std::move(internal)});
  curves.push_back({"change of the total", {}, std::move(change)});
  Panel panel = against_time(fmt::format("Energy of the gas, at the start {}", in_words(start, unit.text)), "energy", time,
                             std::move(curves), unit, noise);
  colour_in_order(panel);
  draw(c, {c.title, {std::move(panel)}, 1, 900, 380}, directory / "energy.png");
}

}  // namespace brisance::simulator::figures
