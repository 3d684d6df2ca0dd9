#include "simulator/output/figures/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace brisance::simulator::figures {

Scale scale_for(std::string_view unit, double largest) {
  constexpr std::array prefixed = {"s", "m", "J", "J/m", "J/m^2", "Pa", "N", "N/m"};
  if (unit == "1") return {};
  Scale scale{1.0, std::string(unit)};
  if (std::find(prefixed.begin(), prefixed.end(), unit) == prefixed.end() || !(largest > 0.0)) return scale;
  constexpr std::array prefixes = {"n", "µ", "m", "", "k", "M", "G"};
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(largest) / 3.0)), -3, unit == "s" ? 0 : 3);
  return {std::pow(1e-3, thousands), prefixes[static_cast<std::size_t>(thousands + 3)] + scale.unit};
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

std::string label(std::string_view what, const Scale& scale) {
  return std::string(what) + (scale.unit.empty() ? "" : " (" + scale.unit + ")");
}

std::string in_words(double x, std::string_view unit, int digits) {
  constexpr double least = 1e-9;  // without a prefix
  const Scale scale = std::abs(x) < least ? Scale{1.0, std::string(unit)} : scale_for(unit, std::abs(x));
  return fmt::format("{:.{}g} {}", x * scale.per_si, digits, scale.unit);
}

std::string in_words(std::string_view field) {
  std::string name(field);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string coordinate_label(Geometry geometry, std::string_view coordinate) {
  const bool round = is_round(geometry);
  if (round && coordinate == "x") return "x, the radius";
  return geometry == Geometry::axisymmetric && coordinate == "y" ? "y, along the axis" : std::string(coordinate);
}

std::optional<MostOf> most_of(const std::vector<double>& all, std::string_view unit) {
  constexpr double outermost = 0.01, far = 10.0;
  std::vector<double> values;
  std::copy_if(all.begin(), all.end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
  std::sort(values.begin(), values.end());
  const auto left_out = static_cast<std::size_t>(std::ceil(outermost * static_cast<double>(values.size())));
  if (values.size() <= 2 * left_out) return std::nullopt;
  const double low = values[left_out], high = values[values.size() - 1 - left_out], reach = largest({low, high});
  const bool finite = values.size() == all.size();
  if (finite && (reach == 0.0 || largest({values.front(), values.back()}) <= far * reach)) return std::nullopt;
  const auto beyond = std::count_if(values.begin(), values.end(), [&](double v) { return v < low || v > high; });
  std::string words = fmt::format("run failed: {} of {} values beyond; all from {} to {}", beyond, all.size(),
                                  in_words(values.front(), unit, 3), in_words(values.back(), unit, 3));
  if (!finite) words += fmt::format("; {} no numbers", all.size() - values.size());
  return MostOf{{low, high}, words};
}

void legend_beside(Panel& panel) {
  panel.legend = "at graph 1.02, graph 1 left top vertical Left reverse";
  panel.legend_width = 27;
}

void colour_in_order(Panel& panel) {
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    panel.curves[k].colour = static_cast<int>(k % palette_size);
    if (k >= palette_size) panel.curves[k].mark = Mark::dashed;
  }
}

namespace {

/// Whether two curves at the same places lie on each other for a good part of their way, not counting the axis.
bool cover(const Curve& a, const Curve& b, double most) {
  constexpr double width_of_line = 0.005, good_part = 0.2;  // of the height and length of the panel
  if (a.y.size() != b.y.size()) return false;
  std::size_t common = 0;
  for (std::size_t i = 0; i < a.y.size(); ++i)
    common += std::abs(a.y[i]) > width_of_line * most && std::abs(a.y[i] - b.y[i]) < width_of_line * most;
  return static_cast<double>(common) > good_part * static_cast<double>(a.y.size());
}

}  // namespace

void let_all_be_seen(std::vector<Curve>& curves) {
  double most = 0.0;
  for (const Curve& curve : curves) most = std::max(most, largest(curve.y));
  for (std::size_t k = 0; k < curves.size(); ++k) {
    double below = 0.0, together = 1.0;
    for (std::size_t other = 0; other < curves.size(); ++other)
      if (other != k && cover(curves[k], curves[other], most)) together += 1.0, below += other < k ? 1.0 : 0.0;
    if (below > 0.0) curves[k].drawn = 1.0 - below / together;
  }
}

std::array<double, 2> from_the_start(double last, const Scale& times) {
  return {0.0, last > 0.0 ? times.per_si * last : 1.0};
}

Panel against_time(const std::string& title, std::string_view quantity, const std::vector<double>& time,
                   std::vector<Curve> curves, Unit unit, double noise) {
  const Scale times = scale_for("s", largest(time));
  double most = 0.0;
  for (const Curve& curve : curves) most = std::max(most, largest(curve.y));
  const Scale scale = most > noise ? scale_for(unit.text, most) : Scale{1.0, std::string(unit.text)};
  Panel panel;
  std::vector<std::pair<double, std::string>> small;  // by their peaks
  constexpr double visible = 0.005;                   // a pixel or two
  for (Curve& curve : curves) {
    const double peak = largest(curve.y);
    if (peak < visible * most || peak <= noise) {
      if (peak > 0.0) small.emplace_back(peak, fmt::format("{} {}", curve.title, in_words(peak, unit.text, 3)));
      continue;
    }
    curve.x = scaled(time, times.per_si), curve.y = scaled(std::move(curve.y), scale.per_si);
    panel.curves.push_back(std::move(curve));
  }
  if (time.size() > 1) let_all_be_seen(panel.curves);
  if (panel.curves.empty() && !curves.empty())  // nothing happens
    panel.curves.push_back({curves.back().title, scaled(time, times.per_si), std::vector<double>(time.size(), 0.0)});
  constexpr std::size_t most_told = 2;
  std::stable_sort(small.begin(), small.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  const std::size_t told = std::min(small.size(), most_told);
  panel.title = title;
  for (std::size_t k = 0; k < told; ++k)
    panel.title += (k > 0 ? ", " : title.empty() ? "not drawn: " : "; not drawn: ") + small[k].second;
  if (small.size() > told) panel.title += fmt::format(" and {} smaller", small.size() - told);
  panel.x_label = label("time", times), panel.y_label = label(quantity, scale);
  panel.x_range = from_the_start(largest(time), times);
  if (time.size() == 1)  // a line of one place is not to be seen
    for (Curve& curve : panel.curves) curve.mark = Mark::dots;
  legend_beside(panel);
  return panel;
}

Pixels pixels_of(double width, double height) {
  constexpr double largest_side = 820.0, smallest_side = 240.0;
  const double per_metre = largest_side / std::max(width, height);
  return {std::max(smallest_side, per_metre * width), std::max(smallest_side, per_metre * height)};
}

Scale fit(Figure& figure, const Window& w, double margin) {
  Panel& panel = figure.panels.front();
  const double width = w.width() + 2.0 * margin, height = w.height() + 2.0 * margin;
  constexpr double thinnest = 0.2;
  panel.equal_axes = std::min(width, height) > thinnest * std::max(width, height);
  const Scale scale =
      scale_for("m", std::max({std::abs(w.lower[0]), std::abs(w.upper[0]), std::abs(w.lower[1]), std::abs(w.upper[1])}));
  panel.x_range = {{scale.per_si * (w.lower[0] - margin), scale.per_si * (w.upper[0] + margin)}};
  panel.y_range = {{scale.per_si * (w.lower[1] - margin), scale.per_si * (w.upper[1] + margin)}};
  const Pixels pixels = pixels_of(width, height);
  figure.panel_width = static_cast<int>(pixels.width) + beside_window;
  figure.panel_height = static_cast<int>(pixels.height) + below_window;
  panel.x_label = label(panel.x_label, scale), panel.y_label = label(panel.y_label, scale);
  return scale;
}

void draw(const Case& c, Figure figure, const std::filesystem::path& path) {
  figure.subtitle = c.below_title();
  brisance::draw(figure, path);
}

}  // namespace brisance::simulator::figures
