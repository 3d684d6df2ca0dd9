#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/input/csv.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"

namespace brisance::simulator::figures {

void draw_gas_bodies(const Case& c, const Simulation& s, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const std::vector<double> time = history.numbers("time", Unit::s);
  Figure figure{c.title + ": bodies", {}, 1, 900, 280};
  const gas::Cells& cells = s.gas.cells;
  int longest = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(s.dimensions()); ++a)
    longest = std::max(longest, cells.upper[a] - cells.lower[a]);
  // Forces that balance each other on a closed body leave rounding.
  constexpr double rounding = 1e-9;
  const double energy = largest(history.numbers("gas_energy", unit_of(Extensive::energy, c.geometry)));
  const double noise_of_force = rounding * energy / (longest * cells.cell_size);
  struct Quantity {
    std::string_view name;
    Unit unit;
    double noise;
    std::ptrdiff_t first_row;
  };
  const Unit force = unit_of(Extensive::force, c.geometry);
  const Quantity quantities[] = {{"displacement", Unit::m, 0.0, 0},
                                 {"velocity", Unit::m_per_s, 0.0, 0},
                                 {"force", force, noise_of_force, 1}};  // of the last step: at the start there is none
  for (const auto& [quantity, unit, noise, first] : quantities) {
    const auto known = [from = first](const std::vector<double>& values) {
      return std::vector<double>(values.begin() + from, values.end());
    };
    std::vector<Curve> curves;
    for (const gas::MovingBody& body : s.gas.bodies.all)
      for (const char axis : std::string_view("xyz"))
        if (const std::string column = fmt::format("{}_{}_{}", body.name, quantity, axis); history.has(column))
          curves.push_back({fmt::format("{} along {}", body.name, axis), {}, known(history.numbers(column, unit))});
    const bool rests = std::all_of(curves.begin(), curves.end(), [](const Curve& curve) { return largest(curve.y) == 0.0; });
    if (rests && quantity != "force") continue;
    figure.panels.push_back(against_time("", quantity, known(time), std::move(curves), unit, noise));
    colour_in_order(figure.panels.back());
  }
  draw(c, std::move(figure), directory / "bodies.png");
}

}  // namespace brisance::simulator::figures
