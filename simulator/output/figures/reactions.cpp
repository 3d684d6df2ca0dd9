#include <fmt/format.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "models/input/csv.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"

namespace brisance::simulator::figures {

void draw_reactions(const Case& c, const Simulation& s, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const std::vector<double> time = history.numbers("time", Unit::s);
  Figure figure{c.title + ": reactions", {}, 1, 900, 280};
  for (const auto& [column, quantity, extensive] :
       {std::tuple{"burned_mass", "burned mass", Extensive::mass}, {"heat", "heat", Extensive::energy}}) {
    const Unit unit = unit_of(extensive, c.geometry);
    std::vector<Curve> curves;
    for (const gas::Burn& burn : s.gas.burns)
      curves.push_back({burn.name, {}, history.numbers(burn.name + "_" + column, unit)});
    figure.panels.push_back(against_time("", quantity, time, std::move(curves), unit));
    colour_in_order(figure.panels.back());
  }
  draw(c, std::move(figure), directory / "reactions.png");
}

}  // namespace brisance::simulator::figures
