#pragma once
// Figures: panels of curves, drawn by gnuplot as PNG or SVG.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "driver/history.hpp"

namespace brisance::driver {

enum class Mark { line, dashed, points, squares };

struct Curve {
  std::string title;  // empty: not in the legend
  std::vector<double> x, y;
  Mark mark = Mark::line;
  int colour = 0;  // index into the palette
};

struct Panel {
  std::string title{}, x_label{}, y_label{};
  std::vector<Curve> curves{};
  std::optional<std::array<double, 2>> x_range{}, y_range{};
  bool logarithmic_x = false, logarithmic_y = false;
  bool wide = false;                   // takes a row of its own
  double height = 1.0;                 // of its row, in units of Figure::panel_height
  std::string legend = "top left";     // gnuplot's words for its place
  std::vector<std::string> x_names{};  // stand upright under x = 0, 1, 2, ...
};

struct Figure {
  std::string title;
  std::vector<Panel> panels;
  int columns = 1;
  int panel_width = 520, panel_height = 390;  // pixels
};

/// Draws a figure; the ending of the path, .png or .svg, chooses the format. Throws std::runtime_error when gnuplot does not
/// deliver it. The file appears complete or not at all.
void draw(const Figure& figure, const std::filesystem::path& path);

/// A column of a history in units and words for an axis: MPa and microseconds instead of Pa and seconds.
struct Axis {
  std::string label;
  double per_si = 1.0;
};
Axis axis_for(const Record::Series& series);

/// What a run looks like: y against x, and temperature, pressure, porosity and damage where they change.
Figure figure_of(const std::string& title, const std::vector<std::pair<std::string, const Record*>>& runs, const std::string& x,
                 const std::string& y);

}  // namespace brisance::driver
