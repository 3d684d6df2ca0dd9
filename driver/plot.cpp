#include "driver/plot.hpp"

#include <fmt/format.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace brisance::driver {
namespace {

// Okabe & Ito's colours can be told apart with any colour vision.
constexpr std::array<std::string_view, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#e69f00", "#56b4e9", "#000000", "#8c6d31"};

std::string quoted_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += c;
  }
  return "\"" + safe + "\"";
}

/// Text without the marks of gnuplot's enhanced mode, such as the underscores of file names.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '_' || c == '^' || c == '@' || c == '{' || c == '}' || c == '&' || c == '~') safe += "\\\\";
    safe += c == '"' ? '\'' : c;
  }
  return "\"" + safe + "\"";
}

std::string style_of(const Curve& curve) {
  const std::string_view colour = palette[static_cast<std::size_t>(curve.colour) % palette.size()];
  switch (curve.mark) {
    case Mark::line:
      return fmt::format("with lines lw 2 lc rgb '{}'", colour);
    case Mark::dashed:
      return fmt::format("with lines lw 2 dt (7,4) lc rgb '{}'", colour);
    case Mark::points:
      return fmt::format("with points pt 6 ps 0.7 lw 1.2 lc rgb '{}'", colour);
    case Mark::squares:
      return fmt::format("with points pt 4 ps 0.7 lw 1.2 lc rgb '{}'", colour);
  }
  return {};
}

void draw_panel(Gnuplot& plot, const Panel& panel) {
  plot << "set title " << plain(panel.title) << " font ',12'\n";
  plot << "set xlabel " << quoted_text(panel.x_label) << "\nset ylabel " << quoted_text(panel.y_label) << "\n";
  plot << "set xrange [*:*]\nset yrange [*:*]\n";
  if (panel.x_range) plot << fmt::format("set xrange [{}:{}]\n", (*panel.x_range)[0], (*panel.x_range)[1]);
  if (panel.y_range) plot << fmt::format("set yrange [{}:{}]\n", (*panel.y_range)[0], (*panel.y_range)[1]);
  plot << (panel.logarithmic_x ? "set logscale x\nset format x '10^{%L}'\n" : "unset logscale x\nset format x '%g'\n");
  plot << (panel.logarithmic_y ? "set logscale y\n" : "unset logscale y\n");
  if (!panel.x_names.empty()) {
    plot << "set bmargin 13\nset xtics rotate by 90 right (";
    for (std::size_t i = 0; i < panel.x_names.size(); ++i) plot << (i ? ", " : "") << plain(panel.x_names[i]) << " " << i;
    plot << ") font ',7'\n";
  } else {
    plot << "set bmargin\nset xtics norotate autofreq font ',10'\n";
  }
  const bool legend = std::any_of(panel.curves.begin(), panel.curves.end(), [](const Curve& c) { return !c.title.empty(); });
  plot << (legend ? "set key default " + panel.legend + " samplen 2.2 spacing 1.1 font ',10'\n" : "unset key\n");
  plot << "plot ";
  bool first = true;
  for (const Curve& curve : panel.curves) {
    if (curve.x.empty()) continue;
    plot << (first ? "" : ", ") << "'-' using 1:2 " << style_of(curve)
         << (curve.title.empty() ? std::string(" notitle") : " title " + plain(curve.title));
    first = false;
  }
  if (first) plot << "NaN notitle";
  plot << "\n";
  for (const Curve& curve : panel.curves) {
    if (curve.x.empty()) continue;
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < curve.x.size(); ++i) points.emplace_back(curve.x[i], curve.y[i]);
    plot.send1d(points);
  }
}

struct Cell {
  int row, column, width;
};
std::vector<Cell> arrange(const std::vector<Panel>& panels, int columns) {
  std::vector<Cell> cells;
  int row = 0, column = 0;
  for (const Panel& panel : panels) {
    const int width = panel.wide ? columns : 1;
    if (column + width > columns) ++row, column = 0;
    cells.push_back({row, column, width});
    column += width;
  }
  return cells;
}

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

void draw(const Figure& figure, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending != ".png" && ending != ".svg")
    throw std::invalid_argument(fmt::format("{}: the ending of a figure is .png or .svg", path.string()));
  const int columns = std::max(1, figure.columns);
  const std::vector<Cell> cells = arrange(figure.panels, columns);
  std::vector<double> row_heights(cells.empty() ? 1 : static_cast<std::size_t>(cells.back().row) + 1, 0.0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double& row = row_heights[static_cast<std::size_t>(cells[i].row)];
    row = std::max(row, figure.panels[i].height * figure.panel_height);
  }
  constexpr int title_height = 34;
  const int width = columns * figure.panel_width;
  const double height = std::ceil(std::accumulate(row_heights.begin(), row_heights.end(), 0.0) + title_height);
  replace_file(path, [&](const std::filesystem::path& temporary) {
    {
      Gnuplot plot("gnuplot");
      if (ending == ".png")
        plot << fmt::format("set terminal pngcairo enhanced font 'DejaVu Sans,11' size {},{}\n", width, height);
      else
        plot << fmt::format("set terminal svg enhanced font 'DejaVu Sans,11' size {},{} background 'white'\n", width, height);
      plot << "set encoding utf8\nset output " << quoted_text(temporary.string()) << "\n";
      plot << "set border 3 lw 1.2\nset tics nomirror out scale 0.6 font ',10'\nset grid lc rgb '#e4e4e4' lw 0.6\n";
      plot << fmt::format("set multiplot title {} font ',13'\n", plain(figure.title));
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto row = row_heights.begin() + cells[i].row;
        const double above = std::accumulate(row_heights.begin(), row + 1, static_cast<double>(title_height));
        plot << fmt::format("set size {},{}\nset origin {},{}\n", cells[i].width / static_cast<double>(columns), *row / height,
                            cells[i].column / static_cast<double>(columns), 1.0 - above / height);
        draw_panel(plot, figure.panels[i]);
      }
      plot << "unset multiplot\nunset output\n";
    }  // waits for gnuplot to end
    if (!std::filesystem::exists(temporary) || std::filesystem::file_size(temporary) == 0)
      throw std::runtime_error("gnuplot did not write it; is gnuplot installed?");
  });
}

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
    panel.wide = runs.size() > 1 && figure.panels.empty();  // the legend needs room
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Curve curve{runs.size() > 1 && figure.panels.empty() ? runs[i].first : "",
                  {},
                  {},
                  i < palette.size() ? Mark::line : Mark::dashed,
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
