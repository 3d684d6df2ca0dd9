#pragma once
// Figures: panels of curves, drawn by gnuplot as PNG or SVG.

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brisance {

/// Curves of as many colours can be told apart.
inline constexpr std::size_t palette_size = 8;

/// `thin` lies over points and lets them be seen. `area` is filled: polygons, one after the other, with a place that is no
/// number between two of them; such a place interrupts lines, too.
enum class Mark { line, dashed, thin, points, squares, dots, area };

struct Curve {
  std::string title;  // empty: not in the legend
  std::vector<double> x, y;
  Mark mark = Mark::line;
  int colour = 0;                                     // index into the palette
  std::vector<double> values{};                       // of points, or of polygons: shown by colours on a scale instead
  double size = 0.7;                                  // of points
  std::vector<double> half_widths{}, half_heights{};  // of tiles with values instead of points, in units of the axes
  double drawn = 0.0;                                 // part of a line that its dashes cover; 0: as the mark says
};

struct Panel {
  std::string title{}, x_label{}, y_label{};
  std::vector<Curve> curves{};
  std::optional<std::array<double, 2>> x_range{}, y_range{};
  bool logarithmic_x = false, logarithmic_y = false;
  bool equal_axes = false;                              // one unit is as long along x as along y
  std::string scale_label{};                            // of the colours of values
  std::optional<std::array<double, 2>> colour_range{};  // values beyond it have the colours of its ends
  bool wide = false;                                    // takes a row of its own
  double height = 1.0;                                  // of its row, in units of Figure::panel_height
  std::string legend = "top left";                      // gnuplot's words for its place
  int legend_width = 0;  // characters kept free on the right, so that panels above each other are as wide; 0: as it needs
};

struct Figure {
  std::string title;
  std::vector<Panel> panels;
  int columns = 1;
  int panel_width = 520, panel_height = 390;  // pixels
  std::string subtitle{};                     // cut, as the title, where it is longer than the figure is wide
};

/// Draws a figure; the ending of the path, .png or .svg, chooses the format. Throws std::runtime_error when gnuplot does not
/// deliver it. The file appears complete or not at all.
void draw(const Figure& figure, const std::filesystem::path& path);

}  // namespace brisance
