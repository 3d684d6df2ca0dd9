#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "simulator/output/figures/each.hpp"
#include "simulator/output/figures/parts.hpp"
#include "simulator/output/gauge_history.hpp"
#include "simulator/output/gauges.hpp"

namespace brisance::simulator::figures {
namespace {

/// "mast", or of a place of a line "profile, x = 25 mm": where it was at the start.
std::string title_of(const GaugeSeries& series, const Case& c) {
  std::string title = in_words(series.gauge);
  if (!series.place) return title;
  const GaugeConfig& gauge =
      *std::find_if(c.gauges.begin(), c.gauges.end(), [&](const GaugeConfig& g) { return g.name == series.gauge; });
  const Vector place = places_of(gauge, c.cell_size)[*series.place];
  for (std::size_t a = 0; a < 3; ++a)
    if (gauge.from[a] != gauge.to[a]) title += fmt::format(", {} = {}", "xyz"[a], in_words(place[a], "m", 3));
  return title;
}

}  // namespace

void draw_gauges(const Case& c, const Path& directory) {
  const std::vector<GaugeSeries> all = read_gauges(c, directory);
  struct Shown {
    std::string field;
    bool of_line;
    std::vector<const GaugeSeries*> series;
  };
  std::vector<Shown> panels;
  double end = 0.0;
  for (const GaugeSeries& s : all) {
    const bool of_line = s.place.has_value();
    const auto same = [&](const Shown& panel) { return panel.field == s.field && panel.of_line == of_line; };
    auto panel = std::find_if(panels.begin(), panels.end(), same);
    if (panel == panels.end()) panel = panels.insert(panels.end(), {s.field, of_line, {}});
    panel->series.push_back(&s);
    end = std::max(end, largest(s.time));
  }
  const Scale times = scale_for("s", end);
  constexpr std::size_t most_above_each_other = 4;
  Figure figure{c.title + ": gauges", {}, 1, 900, 280};
  if (panels.size() > most_above_each_other) figure.columns = 2, figure.panel_width = 700;
  for (const auto& [field, of_line, series] : panels) {
    double most = 0.0;
    for (const GaugeSeries* s : series) most = std::max(most, largest(s->value));
    const Scale scale = scale_for(series.front()->unit, most);
    Panel panel;
    panel.x_label = label("time", times), panel.y_label = label(in_words(field), scale);
    panel.x_range = from_the_start(end, times);
    const std::size_t count = series.size(), shown = of_line ? std::min(count, palette_size) : count;
    if (shown < count) panel.title = fmt::format("{} of {} places; all are in history.csv", shown, count);
    legend_beside(panel);
    for (std::size_t k = 0; k < shown; ++k) {
      const GaugeSeries& s = *series[shown < count ? k * (count - 1) / (shown - 1) : k];
      panel.curves.push_back({title_of(s, c), scaled(s.time, times.per_si), scaled(s.value, scale.per_si)});
    }
    colour_in_order(panel);
    for (Curve& curve : panel.curves)
      if (curve.x.size() == 1) curve.mark = Mark::dots;
    let_all_be_seen(panel.curves);
    figure.panels.push_back(std::move(panel));
  }
  draw(c, std::move(figure), directory / "gauges.png");
}

}  // namespace brisance::simulator::figures
