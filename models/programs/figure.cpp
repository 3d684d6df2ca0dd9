#include "models/programs/figure.hpp"

#include <fmt/format.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "models/programs/files.hpp"

namespace brisance {
namespace {

// Okabe & Ito's colours can be told apart with any colour vision.
constexpr std::array<std::string_view, palette_size> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
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

constexpr std::string_view area_colour = "#bdbdbd";

std::string style_of(const Curve& curve) {
  const std::string_view colour = palette[static_cast<std::size_t>(curve.colour) % palette.size()];
  if (!curve.half_widths.empty()) return "using 1:2:4:5:3 with boxxyerror fs solid noborder lc palette";
  if (!curve.values.empty()) return fmt::format("using 1:2:3 with points pt 7 ps {} lc palette", curve.size);
  constexpr double period = 28.0;  // of dashes
  if (curve.drawn > 0.0 && curve.drawn < 1.0)
    return fmt::format("using 1:2 with lines lw 2 dt ({:.3g},{:.3g}) lc rgb '{}'", period * curve.drawn,
                       period * (1.0 - curve.drawn), colour);
  switch (curve.mark) {
    case Mark::line:
      return fmt::format("using 1:2 with lines lw 2 lc rgb '{}'", colour);
    case Mark::dashed:
      return fmt::format("using 1:2 with lines lw 2 dt (7,4) lc rgb '{}'", colour);
    case Mark::thin:
      return fmt::format("using 1:2 with lines lw 1.2 lc rgb '{}'", colour);
    case Mark::points:
      return fmt::format("using 1:2 with points pt 6 ps {} lw 1.2 lc rgb '{}'", curve.size, colour);
    case Mark::squares:
      return fmt::format("using 1:2 with points pt 4 ps {} lw 1.2 lc rgb '{}'", curve.size, colour);
    case Mark::dots:
      return fmt::format("using 1:2 with points pt 7 ps {} lc rgb '{}'", curve.size, colour);
    case Mark::area:  // with a border, so that nothing shines through between two polygons
      return fmt::format("using 1:2 with filledcurves closed fc rgb '{0}' fs solid 1.0 border lc rgb '{0}'", area_colour);
  }
  return {};
}

/// A range for values that are the same but for rounding: they are drawn as level, not as noise, and gnuplot complains about a
/// range without extent. None for others.
std::optional<std::array<double, 2>> level_range(const std::array<double, 2>& of_values) {
  const auto [low, high] = of_values;
  constexpr double rounding = 1e-6, margin = 0.1;
  const double size = std::max(std::abs(low), std::abs(high));
  if (!std::isfinite(size) || high - low > rounding * size) return std::nullopt;
  const double extent = size > 0.0 ? margin * size : 1.0;
  return {{low - extent, high + extent}};
}
/// The same of a scale of colours: nothing but zeros has no place in its middle, for most fields are never negative.
std::optional<std::array<double, 2>> level_scale(const std::array<double, 2>& of_values) {
  return of_values[0] == 0.0 && of_values[1] == 0.0 ? std::array{0.0, 1.0} : level_range(of_values);
}

std::array<double, 2> extremes(const std::vector<Curve>& curves, std::vector<double> Curve::*values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : curves)
    for (const double value : curve.*values) low = std::min(low, value), high = std::max(high, value);
  return {low, high};
}

/// As gnuplot understands it; its own choice if there is none.
std::string range(const std::optional<std::array<double, 2>>& chosen) {
  return chosen ? fmt::format("[{}:{}]", (*chosen)[0], (*chosen)[1]) : "[*:*]";
}

/// The distance of tics along x, 1, 2 or 5 times a power of ten, that leaves room for their numbers; gnuplot's choice where
/// that is known to be right.
std::string tic_step(const Panel& panel) {
  constexpr double most_tics = 6.0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : panel.curves)
    for (const double x : curve.x) low = std::min(low, x), high = std::max(high, x);
  if (panel.x_range) low = (*panel.x_range)[0], high = (*panel.x_range)[1];
  if (panel.logarithmic_x || panel.wide || panel.equal_axes || !(high > low)) return "autofreq";
  const double decade = std::pow(10.0, std::floor(std::log10((high - low) / most_tics)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (high - low <= most_tics * factor * decade) return fmt::format("{:g}", factor * decade);
  return fmt::format("{:g}", 10.0 * decade);
}

/// Whether it is polygons with values.
bool is_shaded(const Curve& curve) {
  return curve.mark == Mark::area && !curve.values.empty();
}

/// Polygons with values as areas of one colour each, as many as the eye can tell apart, and a place on the scale of colours for
/// each of them. gnuplot's areas have a colour of their own, not one from the data.
struct Shade {
  Curve areas;
  double on_scale;  // 0 to 1
};
constexpr std::size_t shades = 128;
std::vector<Shade> in_shades(const Curve& polygons, const std::array<double, 2>& scale) {
  std::vector<Shade> all(shades);
  for (std::size_t k = 0; k < shades; ++k) all[k].on_scale = (static_cast<double>(k) + 0.5) / shades;
  std::size_t polygon = 0;
  for (std::size_t i = 0; i < polygons.x.size(); ++i) {
    const double place = shades * (polygons.values.at(polygon) - scale[0]) / (scale[1] - scale[0]);
    const auto shade = place > 0.0 ? static_cast<std::size_t>(std::min(place, shades - 1.0)) : 0;
    all[shade].areas.x.push_back(polygons.x[i]), all[shade].areas.y.push_back(polygons.y[i]);
    if (std::isnan(polygons.x[i])) ++polygon;
  }
  std::erase_if(all, [](const Shade& shade) { return shade.areas.x.empty(); });
  return all;
}

/// With a border, so that nothing shines through between two polygons.
std::string style_of(const Shade& shade) {
  return fmt::format(
      "using 1:2 with filledcurves closed lw 3 fc palette frac {0:.5f} fs solid 1.0 border lc palette frac {0:.5f}",
      shade.on_scale);
}

/// An empty line ends a polygon.
void send_polygons(Gnuplot& plot, const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    plot << (std::isnan(curve.x[i]) ? std::string("\n") : fmt::format("{:.9g} {:.9g}\n", curve.x[i], curve.y[i]));
  plot << "e\n";
}

void draw_panel(Gnuplot& plot, const Panel& panel) {
  plot << "set title " << plain(panel.title) << " font ',12'\n";
  plot << "set xlabel " << quoted_text(panel.x_label) << "\nset ylabel " << quoted_text(panel.y_label) << "\n";
  const std::array<double, 2> heights = panel.y_range.value_or(extremes(panel.curves, &Curve::y));
  const auto level = panel.logarithmic_y ? std::nullopt : level_range(heights);
  const auto height = level ? level : panel.y_range;
  const std::array<double, 2> places = panel.x_range.value_or(extremes(panel.curves, &Curve::x));
  const auto width = places[0] == places[1] && !panel.logarithmic_x ? level_range(places) : panel.x_range;
  plot << "set xrange " << range(width) << "\nset yrange " << range(height) << "\n";
  plot << (panel.logarithmic_x ? "set logscale x\nset format x '10^{%L}'\n" : "unset logscale x\nset format x '%g'\n");
  plot << (panel.logarithmic_y ? "set logscale y\n" : "unset logscale y\n");
  plot << fmt::format("set xtics {} font ',10'\n", tic_step(panel));
  plot << (panel.equal_axes ? "set size ratio -1\n" : "set size noratio\n");
  const bool shaded = std::any_of(panel.curves.begin(), panel.curves.end(), is_shaded);
  const std::array<double, 2> values = panel.colour_range.value_or(extremes(panel.curves, &Curve::values));
  std::optional<std::array<double, 2>> colours = level_scale(values);
  if ((shaded || panel.colour_range) && !colours)  // shades need to know it
    colours = std::isfinite(values[0]) && std::isfinite(values[1]) ? values : std::array{0.0, 1.0};
  plot << "set cbrange " << range(colours) << "\n";
  if (!panel.scale_label.empty())
    plot << "set cblabel " << quoted_text(panel.scale_label)
         << "\nset palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', 3 '#22a884', 4 '#7ad151', 5 '#fde725')\n";
  const bool legend = std::any_of(panel.curves.begin(), panel.curves.end(), [](const Curve& c) { return !c.title.empty(); });
  plot << (panel.legend_width > 0 ? fmt::format("set lmargin 14\nset rmargin {}\n", panel.legend_width)
                                  : "set lmargin\nset rmargin\n");
  // Below the panel an empty title keeps the legend off the label of the axis.
  const std::string apart = panel.legend.starts_with("below") ? " title ' '" : "";
  plot << (legend ? "set key default " + panel.legend + apart + " samplen 2.2 spacing 1.1 font ',10'\n" : "unset key\n");
  plot << "plot ";
  bool first = true;
  const auto announce = [&](const std::string& style, const std::string& title) {
    plot << (first ? "" : ", ") << "'-' " << style << (title.empty() ? std::string(" notitle") : " title " + plain(title));
    first = false;
  };
  for (const Curve& curve : panel.curves) {
    if (curve.x.empty()) continue;
    if (!is_shaded(curve))
      announce(style_of(curve), curve.title);
    else
      for (const Shade& shade : in_shades(curve, *colours)) announce(style_of(shade), "");
  }
  if (first) plot << "NaN notitle";
  plot << "\n";
  for (const Curve& curve : panel.curves) {
    if (curve.x.empty()) continue;
    if (is_shaded(curve)) {
      for (const Shade& shade : in_shades(curve, *colours)) send_polygons(plot, shade.areas);
      continue;
    }
    const auto rows = [&](const auto&... columns) {
      std::vector<std::tuple<std::remove_cvref_t<decltype(columns[0])>...>> points;
      for (std::size_t i = 0; i < curve.x.size(); ++i) points.emplace_back(columns[i]...);
      plot.send1d(points);
    };
    if (curve.mark == Mark::area)
      send_polygons(plot, curve);
    else if (!curve.half_widths.empty())
      rows(curve.x, curve.y, curve.values, curve.half_widths, curve.half_heights);
    else if (!curve.values.empty())
      rows(curve.x, curve.y, curve.values);
    else
      rows(curve.x, curve.y);
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
  const int title_height = figure.subtitle.empty() ? 34 : 50;
  const int width = columns * figure.panel_width;
  constexpr double largest_font = 13.0, smallest_font = 8.0, width_of_letter = 0.69;  // on average, of the font's size
  const double title_font =
      std::clamp(width / (width_of_letter * static_cast<double>(figure.title.size())), smallest_font, largest_font);
  const double subtitle_font = std::min(10.0, title_font);  // lines are as far apart as the title's letters are high
  const auto cut_to_width = [&](const std::string& text, double font) {
    const auto most_letters = static_cast<std::size_t>(std::lround(width / (width_of_letter * font)));
    if (text.size() <= most_letters) return text;
    std::size_t end = most_letters - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not within a letter of UTF-8
    return text.substr(0, end) + "...";
  };
  const std::string title = cut_to_width(figure.title, title_font), subtitle = cut_to_width(figure.subtitle, subtitle_font);
  const double height = std::ceil(std::accumulate(row_heights.begin(), row_heights.end(), 0.0) + title_height);
  replace_file(path, [&](const std::filesystem::path& temporary) {
    {
      Gnuplot plot("gnuplot");
      if (ending == ".png")
        plot << fmt::format("set terminal pngcairo enhanced rounded font 'DejaVu Sans,11' size {},{}\n", width, height);
      else
        plot << fmt::format("set terminal svg enhanced font 'DejaVu Sans,11' size {},{} background 'white'\n", width, height);
      plot << "set encoding utf8\nset output " << quoted_text(temporary.string()) << "\n";
      plot << "set border 3 lw 1.2\nset tics nomirror out scale 0.6 font ',10'\nset grid lc rgb '#e4e4e4' lw 0.6\n";
      const std::string below =
          subtitle.empty() ? "" : fmt::format(".\"\\n{{/={:.3g} \".{}.\"}}\"", subtitle_font, plain(subtitle));
      plot << fmt::format("set multiplot title {}{} font ',{:.3g}'\n", plain(title), below, title_font);
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

}  // namespace brisance
