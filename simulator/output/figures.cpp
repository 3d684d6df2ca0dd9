#include "simulator/output/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>

#include "simulator/output/figures/each.hpp"
#include "simulator/output/measures.hpp"

namespace brisance::simulator {

std::vector<std::string> draw_figures(const Case& c, const Simulation& s, const std::filesystem::path& directory, Of of) {
  std::vector<std::string> troubles;
  const auto attempt = [&](const std::function<void()>& draw_it) {
    try {
      draw_it();
    } catch (const std::exception& error) {
      troubles.push_back(fmt::format("a figure is missing: {}", error.what()));
    }
  };
  attempt([&] { s.gas.empty() ? figures::draw_energy(c, directory) : figures::draw_gas_energy(c, s, directory); });
  if (!s.gas.bodies.empty()) attempt([&] { figures::draw_gas_bodies(c, s, directory); });
  if (!s.gas.burns.empty()) attempt([&] { figures::draw_reactions(c, s, directory); });
  if (!c.gauges.empty()) attempt([&] { figures::draw_gauges(c, directory); });
  if (s.dimensions() > 1) attempt([&] { figures::draw_field(c, s, directory, of); });
  std::vector<std::size_t> drawn;
  for (const MeasureConfig& measure : c.measures) {
    if (is_of_gas(measure.kind)) continue;
    const std::size_t body = body_of(measure, s);
    if (std::find(drawn.begin(), drawn.end(), body) != drawn.end()) continue;
    drawn.push_back(body);
    attempt([&] { figures::draw_profile(c, s, measure, directory); });
  }
  for (const FigureConfig& figure : c.figures) attempt([&] { figures::draw_line(c, s, figure, directory, of); });
  return troubles;
}

}  // namespace brisance::simulator
