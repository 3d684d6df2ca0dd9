#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"
#include "simulator/output/line_out.hpp"

namespace brisance::simulator::figures {
namespace {

/// From the smallest to the largest value, so that a panel has no empty part; none without one.
std::optional<std::array<double, 2>> extent(const std::vector<const std::vector<double>*>& all, const Scale& scale) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<double>* values : all)
    for (const double v : *values) low = std::min(low, v), high = std::max(high, v);
  if (!(low < high)) return std::nullopt;
  return {{scale.per_si * low, scale.per_si * high}};
}

}  // namespace

void draw_line(const Case& c, const Simulation& s, const FigureConfig& config, const Path& directory, Of of) {
  const LineOut computed = line_out(s, config);
  if (computed.place.empty()) throw std::runtime_error(fmt::format("figure {}: nothing is near its line", config.name));
  LineOut reference = config.reference.empty() ? LineOut{} : read_reference(config);
  if (!s.gas.bodies.empty()) reference = outside_bodies(reference, computed, s.grid.cell_size);
  const Scale lengths = scale_for("m", std::max(largest(computed.place), largest(reference.place)));
  Figure figure{fmt::format("{}: {} at {}", c.title, config.name, in_words(s.time, "s")), {}, 1, 900, 280};
  for (std::size_t f = 0; f < config.fields.size(); ++f) {
    const std::string& field = config.fields[f];
    const std::string unit = unit_of_field(field);
    const std::optional<MostOf> most = of == Of::failed_run ? most_of(computed.values[f], unit) : std::nullopt;
    const Scale scale = scale_for(unit, most ? largest({most->range[0], most->range[1]}) : largest(computed.values[f]));
    const auto curve = [&](const std::string& title, const LineOut& from, Mark mark, int colour) {
      return Curve{title, scaled(from.place, lengths.per_si), scaled(from.values[f], scale.per_si), mark, colour};
    };
    Panel panel;
    panel.x_label = label(coordinate_label(s.geometry, computed.coordinate), lengths);
    panel.y_label = label(in_words(field) + (field == "velocity" ? " along " + computed.coordinate : ""), scale);
    legend_beside(panel);
    panel.x_range = extent({&computed.place, &reference.place}, lengths);
    if (most) panel.title = most->words, panel.y_range = {{scale.per_si * most->range[0], scale.per_si * most->range[1]}};
    panel.curves.push_back(curve("computed", computed, Mark::dots, 5));
    panel.curves.back().size = 0.7;
    if (f < reference.values.size() && !reference.values[f].empty())
      panel.curves.push_back(curve("reference", reference, Mark::thin, 6));  // over the broader dots: both are seen
    figure.panels.push_back(std::move(panel));
  }
  draw(c, std::move(figure), directory / fmt::format("line_{}.png", config.name));
}

}  // namespace brisance::simulator::figures
