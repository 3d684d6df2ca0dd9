#include "driver/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brisance::driver {
namespace {

bool changes(const Record& record, std::string_view name, double threshold) {
  const Record::Series* series = record.find(name);
  if (!series || series->values.empty()) return false;
  const auto [low, high] = std::minmax_element(series->values.begin(), series->values.end());
  return *high - *low > threshold * std::max(std::abs(*low), std::abs(*high));
}

std::string in_words(std::string name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> words{{{"strain_", "logarithmic strain, "},
                                                                                 {"stress_", "stress, "},
                                                                                 {"F_", "deformation gradient, "},
                                                                                 {"accumulated_strain", "accumulated strain"},
                                                                                 {"equivalent_stress", "equivalent stress"},
                                                                                 {"plastic_strain", "plastic strain"},
                                                                                 {"mean_stress", "mean stress"},
                                                                                 {"failure_cause", "failure cause"},
                                                                                 {"shear_modulus", "shear modulus"},
                                                                                 {"sound_speed", "sound speed"}}};
  for (const auto& [start, word] : words)
    if (name.starts_with(start)) {
      name = std::string(word) + name.substr(start.size());
      break;
    }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

Axis axis_for(const Record::Series& series) {
  double largest = 0.0;
  for (const double v : series.values) largest = std::max(largest, std::isfinite(v) ? std::abs(v) : 0.0);
  const std::string words = in_words(series.name);
  if (series.unit == "Pa") return largest > 2e10 ? Axis{words + " (GPa)", 1e-9} : Axis{words + " (MPa)", 1e-6};
  if (series.unit == "s") {
    if (largest < 1e-3) return {words + " (µs)", 1e6};
    if (largest < 1.0) return {words + " (ms)", 1e3};
  }
  if (series.unit == "1") return {words, 1.0};
  return {fmt::format("{} ({})", words, series.unit), 1.0};
}

Figure figure_of(const std::string& title, const std::vector<std::pair<std::string, const Record*>>& runs, const std::string& x,
                 const std::string& y) {
  Figure figure;
  figure.title = title;
  const auto any_changes = [&](std::string_view name, double threshold) {
    return std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return changes(*run.second, name, threshold); });
  };
  std::vector<std::string> ordinates{y};
  constexpr double visible = 1e-3;
  for (const std::string_view name : {"temperature", "pressure", "porosity", "damage"})
    if (name != y && name != x && any_changes(name, visible)) ordinates.emplace_back(name);
  for (const std::string& ordinate : ordinates) {
    Panel panel;
    Record::Series all_x{x, "", {}}, all_y{ordinate, "", {}};
    for (const auto& [name, record] : runs) {
      const auto add = [](Record::Series& all, const Record::Series& some) {
        all.unit = some.unit;
        all.values.insert(all.values.end(), some.values.begin(), some.values.end());
      };
      add(all_x, *record->find(x));
      add(all_y, *record->find(ordinate));
    }
    const Axis x_axis = axis_for(all_x), y_axis = axis_for(all_y);
    panel.x_label = x_axis.label;
    panel.y_label = y_axis.label;
    panel.legend = "outside right top vertical";
    panel.wide = runs.size() > 1 && figure.panels.empty();  // the legend stands beside it
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Curve curve{runs.size() > 1 && figure.panels.empty() ? runs[i].first : "",
                  {},
                  {},
                  i < palette_size ? Mark::line : Mark::dashed,
                  static_cast<int>(i)};
      for (const double value : runs[i].second->find(x)->values) curve.x.push_back(value * x_axis.per_si);
      for (const double value : runs[i].second->find(ordinate)->values) curve.y.push_back(value * y_axis.per_si);
      panel.curves.push_back(std::move(curve));
    }
    figure.panels.push_back(std::move(panel));
  }
  figure.columns = figure.panels.size() == 1 && runs.size() == 1 ? 1 : 2;
  return figure;
}

}  // namespace brisance::driver
