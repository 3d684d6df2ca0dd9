#include "simulator/output/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "models/input/csv.hpp"
#include "models/programs/figure.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/gas/outline.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/gauge_history.hpp"
#include "simulator/output/gauges.hpp"
#include "simulator/output/line_out.hpp"
#include "simulator/output/measures.hpp"
#include "simulator/output/particle_cells.hpp"

namespace brisance::simulator {
namespace {

using Path = std::filesystem::path;

/// A unit in which numbers are neither very large nor very small.
struct Scale {
  double per_si = 1.0;
  std::string unit;  // "" of a number without one
};
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
/// "80 µs"
std::string in_words(double x, std::string_view unit, int digits = 4) {
  constexpr double least = 1e-9;  // without a prefix
  const Scale scale = std::abs(x) < least ? Scale{1.0, std::string(unit)} : scale_for(unit, std::abs(x));
  return fmt::format("{:.{}g} {}", x * scale.per_si, digits, scale.unit);
}
std::string in_words(std::string_view field) {
  std::string name(field);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// What a coordinate of the case file, x or y, is in the round geometries: "x, the radius".
std::string coordinate_label(Geometry geometry, std::string_view coordinate) {
  const bool round = is_round(geometry);
  if (round && coordinate == "x") return "x, the radius";
  return geometry == Geometry::axisymmetric && coordinate == "y" ? "y, along the axis" : std::string(coordinate);
}

/// From the smallest to the largest value, so that a panel has no empty part; none without one.
std::optional<std::array<double, 2>> extent(const std::vector<const std::vector<double>*>& all, const Scale& scale) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<double>* values : all)
    for (const double v : *values) low = std::min(low, v), high = std::max(high, v);
  if (!(low < high)) return std::nullopt;
  return {{scale.per_si * low, scale.per_si * high}};
}

/// What a picture shows of the values of a run that failed, if a few of them would leave no room for the others.
struct MostOf {
  std::array<double, 2> range;
  std::string words;  // what lies beyond the range
};
/// All but the outermost hundredth at either end; nothing if the rest does not reach ten times as far as these do.
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

bool is_mirrored(const Simulation& s, int axis) {
  return std::any_of(s.boundaries.begin(), s.boundaries.end(),
                     [&](const Boundary& b) { return b.kind == BoundaryKind::symmetry && b.axis == axis && b.node == 0; });
}

/// Whether two curves at the same places lie on each other for a good part of their way, not counting the axis.
bool cover(const Curve& a, const Curve& b, double most) {
  constexpr double width_of_line = 0.005, good_part = 0.2;  // of the height and length of the panel
  if (a.y.size() != b.y.size()) return false;
  std::size_t common = 0;
  for (std::size_t i = 0; i < a.y.size(); ++i)
    common += std::abs(a.y[i]) > width_of_line * most && std::abs(a.y[i] - b.y[i]) < width_of_line * most;
  return static_cast<double>(common) > good_part * static_cast<double>(a.y.size());
}

/// Curves that lie on each other take turns along the line: each later one leaves a part of it to those below.
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

/// From 0 to the last time, s; of a run that has not begun some time after.
std::array<double, 2> from_the_start(double last, const Scale& times) {
  return {0.0, last > 0.0 ? times.per_si * last : 1.0};
}

/// Curves of a quantity against time. Those that would lie on the axis, and what is below `noise`, are not drawn; the title
/// tells the largest values of the largest of them, unless they are zero all the time.
Panel against_time(const std::string& title, std::string_view quantity, const std::vector<double>& time,
                   std::vector<Curve> curves, Unit unit, double noise = 0.0) {
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

/// Every figure says what its case is.
void draw(const Case& c, Figure figure, const Path& path) {
  figure.subtitle = c.below_title();
  brisance::draw(figure, path);
}

/// Colours in the order of the curves; where there are more, the others are dashed.
void colour_in_order(Panel& panel) {
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    panel.curves[k].colour = static_cast<int>(k % palette_size);
    if (k >= palette_size) panel.curves[k].mark = Mark::dashed;
  }
}

void draw_energy(const Case& c, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const Unit unit = unit_of(Extensive::energy, c.geometry);
  const auto curve = [&](const std::string& column, const std::string& title, int colour) {
    return Curve{title, {}, history.numbers(column, unit), Mark::line, colour};
  };
  const std::vector<double> time = history.numbers("time", Unit::s);
  Panel physical =
      against_time("Energy", "energy", time,
                   {curve("kinetic_energy", "kinetic", 0), curve("plastic_work", "plastic work", 2),
                    curve("external_work", "work of loads", 3), curve("boundary_work", "work of boundaries", 4),
                    curve("friction_work", "friction", 6), curve("viscous_work", "artificial viscosity", 5),
                    curve("outflow_energy", "outflow", 7), curve("internal_energy_change", "change of internal", 1)},
                   unit);
  Panel numerical = against_time("Numerical books", "energy", time,
                                 {curve("transfer_energy", "transfer", 0), curve("filter_energy", "filter", 1),
                                  curve("filter_heat", "heat of the filter", 3),
                                  curve("stress_timing_energy", "stress timing", 2), curve("energy_residual", "in no book", 6)},
                                 unit);
  draw(c, {c.title, {std::move(physical), std::move(numerical)}, 1, 900, 380}, directory / "energy.png");
}

/// What has changed the energy of the gas since the start.
void draw_gas_energy(const Case& c, const Simulation& s, const Path& directory) {
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const std::vector<double> time = history.numbers("time", Unit::s);
  const Unit unit = unit_of(Extensive::energy, c.geometry);
  std::vector<double> change = history.numbers("gas_energy", unit);
  const std::vector<double> kinetic = history.numbers("gas_kinetic_energy", unit);
  constexpr double rounding = 1e-12;
  const double start = change.front(), noise = rounding * std::abs(start);
  std::vector<double> internal;  // its change
  for (std::size_t i = 0; i < change.size(); ++i) {
    change[i] -= start;
    internal.push_back(change[i] - (kinetic[i] - kinetic.front()));
  }
  std::vector<Curve> curves;
  const auto add = [&](const std::string& title, const std::string& column, double factor = 1.0) {
    curves.push_back({title, {}, scaled(history.numbers(column, unit), factor)});
  };
  add("kinetic", "gas_kinetic_energy");
  for (const gas::Edge& edge : s.gas.edges)  // what leaves at a periodic side comes in at the other
    if (edge.kind != EdgeKind::periodic) add("through " + edge.name, edge.name + "_energy");
  for (const gas::Burn& burn : s.gas.burns) add("heat of " + burn.name, burn.name + "_heat");
  for (const gas::MovingBody& body : s.gas.bodies.all) add("work of " + body.name, body.name + "_work", -1.0);
  if (s.gas.gravity != Vector{}) add("work of gravity", "gravity_energy");
  add("in no book", "gas_residual_energy");
  curves.push_back({"change of internal", {}, std::move(internal)});
  curves.push_back({"change of the total", {}, std::move(change)});
  Panel panel = against_time(fmt::format("Energy of the gas, at the start {}", in_words(start, unit.text)), "energy", time,
                             std::move(curves), unit, noise);
  colour_in_order(panel);
  draw(c, {c.title, {std::move(panel)}, 1, 900, 380}, directory / "energy.png");
}

/// How bodies in the gas move, and what drives them.
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

/// What has burned, and its heat.
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

/// A panel for each field that gauges have recorded: of those at points, all of them, and another of the places of lines, as
/// many of them, evenly, as there are colours.
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

/// Half a particle in units of gnuplot's point size, on a panel so many pixels wide that shows so many metres.
double point_size(double width, double pixels, double metres) {
  constexpr double pixels_per_size = 7.0;
  return std::clamp(pixels * width / metres / pixels_per_size, 0.15, 6.0);
}

struct Window {
  double lower[2] = {1e300, 1e300}, upper[2] = {-1e300, -1e300};
  void add(double x, double y) {
    lower[0] = std::min(lower[0], x), upper[0] = std::max(upper[0], x);
    lower[1] = std::min(lower[1], y), upper[1] = std::max(upper[1], y);
  }
  double width() const { return upper[0] - lower[0]; }
  double height() const { return upper[1] - lower[1]; }
};

/// How many pixels the sides of a picture that shows so many metres have: equal axes, unless one would be too short to see.
struct Pixels {
  double width, height;
};
Pixels pixels_of(double width, double height) {
  constexpr double largest_side = 820.0, smallest_side = 240.0;
  const double per_metre = largest_side / std::max(width, height);
  return {std::max(smallest_side, per_metre * width), std::max(smallest_side, per_metre * height)};
}

/// A panel that shows the window on a figure of a sensible shape: with equal axes, unless one direction would be too thin to
/// see. Returns how many units of the axes make a metre.
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
  figure.panel_width = static_cast<int>(pixels.width) + 190;  // colours and labels
  figure.panel_height = static_cast<int>(pixels.height) + 90;
  panel.x_label = label(panel.x_label, scale), panel.y_label = label(panel.y_label, scale);
  return scale;
}

/// The coloured tiles or polygons of a picture, before they have units.
struct Tiles {
  Curve points;
  std::string field, unit;
  Curve solid{"", {}, {}, Mark::area}, contour{"", {}, {}, Mark::line, 6};  // of bodies in gas, over the tiles
  Window window;                                                            // all of it, before it is mirrored
  bool mirrored = false;                                                    // to be drawn a second time at negative x
};

/// A polygon or a line; between two of them is a place that is no number.
void add_polygon(Curve& curve, std::span<const Vector> places) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const Vector& x : places) curve.x.push_back(x[0]), curve.y.push_back(x[1]);
  curve.x.push_back(none), curve.y.push_back(none);
}

void add_bodies(Tiles& tiles, const gas::Outline& outline) {
  for (const auto& polygon : outline.solid) add_polygon(tiles.solid, polygon);
  for (const auto& piece : outline.contour) add_polygon(tiles.contour, piece);
}

Tiles tiles_of_gas(const Simulation& s, const std::string& name) {
  const std::vector<gas::Field> known = gas::fields_of(s.gas);
  const auto field = std::find_if(known.begin(), known.end(), [&](const gas::Field& f) { return f.name == name; });
  const gas::Cells& cells = s.gas.cells;
  Tiles tiles;
  tiles.field = field->name, tiles.unit = field->unit;
  tiles.mirrored = s.geometry == Geometry::axisymmetric && cells.lower[0] == 0;
  for (const auto& corner : {cells.lower, cells.upper})
    tiles.window.add(corner[0] * cells.cell_size, corner[1] * cells.cell_size);
  const int slice = (cells.lower[2] + cells.upper[2]) / 2;
  gas::for_each_cell(s.gas, [&](const gas::CellPlace& at) {
    if (s.dimensions() == 3 && cells.index(at.block, at.cell)[2] != slice) return;
    const Vector x = cells.centre(at.block, at.cell);
    tiles.points.x.push_back(x[0]), tiles.points.y.push_back(x[1]), tiles.points.values.push_back(field->read(s.gas, at, 0));
  });
  tiles.points.half_widths.assign(tiles.points.x.size(), 0.5 * cells.cell_size);
  tiles.points.half_heights = tiles.points.half_widths;
  add_bodies(tiles, gas::outline_of(s.gas, slice));
  return tiles;
}

Tiles tiles_of_solids(const Case& c, const Simulation& s) {
  const Field* field = find_field(c.output.figure_field);
  if (!field) throw std::runtime_error(fmt::format("output.figure_field: there is no field \"{}\"", c.output.figure_field));
  Tiles tiles;
  Curve& cells = tiles.points;
  cells.mark = Mark::area;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Body& body : s.bodies)
    for (int p = 0; p < body.particles.size; ++p) {
      std::vector<Vector> corners = cell_of_particle(c, body, p);
      if (corners.empty()) continue;
      corners.push_back(corners.front());  // so that its border is closed
      add_polygon(cells, corners);
      std::array<double, 3> components{};
      field->read(ParticleView(body.particles, p), components.data());
      cells.values.push_back(components[0]);
      for (const Vector& x : corners) nearest = std::min(nearest, std::abs(x[0])), tiles.window.add(x[0], x[1]);
    }
  if (cells.x.empty()) throw std::runtime_error("no particle is in the picture");
  tiles.field = field->name, tiles.unit = field->unit;
  // Not if there is a hole between the two halves.
  tiles.mirrored = (s.geometry == Geometry::axisymmetric || is_mirrored(s, 0)) && nearest < s.grid.cell_size;
  return tiles;
}

/// All of it once more at negative x.
void mirror(Tiles& tiles) {
  for (Curve* curve : {&tiles.points, &tiles.solid, &tiles.contour}) {
    for (std::size_t i = 0, count = curve->x.size(); i < count; ++i) curve->x.push_back(-curve->x[i]);
    for (std::vector<double>* same : {&curve->y, &curve->values, &curve->half_widths, &curve->half_heights})
      for (std::size_t i = 0, count = same->size(); i < count; ++i) same->push_back((*same)[i]);
  }
  tiles.window.add(-tiles.window.upper[0], tiles.window.upper[1]);
}

/// The planes that bound the bodies, as far as they are near the window, which grows to hold them: walls with the hatching of
/// what is behind them, planes of symmetry that the picture is not mirrored at without.
Curve planes_of(const Simulation& s, Tiles& tiles) {
  Window& window = tiles.window;
  constexpr double near = 0.25, none = std::numeric_limits<double>::quiet_NaN();
  constexpr double stroke = 9.0;  // pixels
  const double reach = near * std::max(window.width(), window.height()) + 2.0 * s.grid.cell_size;
  struct Plane {
    std::size_t axis;
    double position, outwards;
    bool is_wall;
  };
  std::vector<Plane> planes;
  for (const Boundary& b : s.boundaries) {
    const auto axis = static_cast<std::size_t>(b.axis);
    if (axis > 1 || b.kind == BoundaryKind::outflow) continue;
    if (b.kind == BoundaryKind::symmetry && tiles.mirrored && axis == 0) continue;
    const double position = b.node * s.grid.cell_size + s.grid.origin[axis];
    if (position < window.lower[axis] - reach || position > window.upper[axis] + reach) continue;
    planes.push_back({axis, position, static_cast<double>(-b.inward), b.kind != BoundaryKind::symmetry});
  }
  const Pixels pixels = pixels_of(window.width(), window.height());
  const double size[2] = {stroke * window.width() / pixels.width, stroke * window.height() / pixels.height};  // m
  for (const Plane& plane : planes) {
    double x[2] = {window.lower[0], window.lower[1]};
    x[plane.axis] = plane.position;
    window.add(x[0], x[1]);
    x[plane.axis] += plane.is_wall ? plane.outwards * size[plane.axis] : 0.0;
    window.add(x[0], x[1]);
  }
  Curve lines{"", {}, {}, Mark::thin, 6};
  for (const Plane& plane : planes) {
    const std::size_t along = 1 - plane.axis;
    const auto add = [&](double place, double height) {
      double x[2];
      x[along] = place, x[plane.axis] = plane.position + height * plane.outwards * size[plane.axis];
      lines.x.push_back(x[0]), lines.y.push_back(x[1]);
    };
    const auto interrupt = [&] { lines.x.push_back(none), lines.y.push_back(none); };
    add(window.lower[along], 0.0), add(window.upper[along], 0.0);
    interrupt();
    for (double at = window.lower[along]; plane.is_wall && at + size[along] < window.upper[along]; at += size[along]) {
      add(at, 1.0), add(at + size[along], 0.0);
      interrupt();
    }
  }
  return lines;
}

void draw_field(const Case& c, const Simulation& s, const Path& directory, Of of) {
  const double h = s.grid.cell_size;
  Tiles tiles = s.gas.empty() ? tiles_of_solids(c, s) : tiles_of_gas(s, c.output.figure_field);
  Curve& points = tiles.points;
  const std::optional<MostOf> most = of == Of::failed_run ? most_of(points.values, tiles.unit) : std::nullopt;
  if (tiles.mirrored) mirror(tiles);
  Curve planes = planes_of(s, tiles);
  Figure figure;
  figure.title = fmt::format("{}: {} at {}", c.title, in_words(tiles.field), in_words(s.time, "s"));
  Panel panel;
  panel.x_label = coordinate_label(s.geometry, "x"), panel.y_label = coordinate_label(s.geometry, "y");
  if (const auto [low, high] = std::minmax_element(points.values.begin(), points.values.end()); *low == *high)
    panel.title = (tiles.unit == "1" ? fmt::format("{:.4g}", *low) : in_words(*low, tiles.unit)) + " everywhere";
  const Scale values = scale_for(tiles.unit, most ? largest({most->range[0], most->range[1]}) : largest(points.values));
  panel.scale_label = label(in_words(tiles.field), values);
  if (most) {
    panel.title = most->words;
    panel.colour_range = {{values.per_si * most->range[0], values.per_si * most->range[1]}};
  }
  figure.panels.push_back(panel);
  const Scale lengths = fit(figure, tiles.window, 0.5 * h);
  // Tiles reach a pixel beyond their edges, so that no light shines through between them.
  for (double& half : points.half_widths) half += (tiles.window.width() + h) / (figure.panel_width - 190);
  for (double& half : points.half_heights) half += (tiles.window.height() + h) / (figure.panel_height - 90);
  points.values = scaled(std::move(points.values), values.per_si);
  for (Curve* curve : {&points, &tiles.solid, &tiles.contour, &planes}) {
    for (std::vector<double>* length : {&curve->x, &curve->y, &curve->half_widths, &curve->half_heights})
      *length = scaled(std::move(*length), lengths.per_si);
    figure.panels.front().curves.push_back(std::move(*curve));
  }
  draw(c, std::move(figure), directory / "field.png");
}

/// The fields of a figure along its line, one below the other.
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

/// The outline of a body about its axis, whole, with what experiments say.
void draw_profile(const Case& c, const Simulation& s, const MeasureConfig& measure, const Path& directory) {
  const Body& body = s.bodies[body_of(measure, s)];
  const auto axis = static_cast<std::size_t>(measure.axis);
  const Profile profile = profile_of(s, body, measure.axis);
  if (profile.height.empty()) throw std::runtime_error(body.name + " has no particles left");
  Curve outline{"computed", {}, {}, Mark::line, 0};
  Curve strained{"plastic strain above 0.5", {}, {}, Mark::dots, 4}, measured{"measured", {}, {}, Mark::squares, 1};
  measured.size = 1.2;
  Window window;
  const auto add = [&](Curve& curve, double radius, double height) {
    curve.x.push_back(radius), curve.y.push_back(height);
    window.add(radius, height);
  };
  const std::size_t last = profile.height.size() - 1;
  add(outline, profile.radius[0], 0.0);
  for (std::size_t i = 0; i <= last; ++i) add(outline, profile.radius[i], profile.height[i]);
  add(outline, profile.radius[last], profile.length), add(outline, -profile.radius[last], profile.length);
  for (std::size_t i = last + 1; i-- > 0;) add(outline, -profile.radius[i], profile.height[i]);
  add(outline, -profile.radius[0], 0.0), add(outline, profile.radius[0], 0.0);
  double particle = 0.0;
  constexpr double strongly_strained = 0.5;
  for (int p = 0; p < body.particles.size; ++p) {
    const ParticleView view(body.particles, p);
    if (view.rest(Layout<2>::Rest::plastic_strain) < strongly_strained) continue;
    Vector from_axis = view.position();
    from_axis[axis] = 0.0;
    const double r = std::sqrt(dot(from_axis, from_axis)), z = view.position()[axis] - profile.lower;
    for (const double side : {1.0, -1.0}) strained.x.push_back(side * r), strained.y.push_back(z);
    particle = std::max(particle, 2.0 * view.half_width());
  }
  for (const MeasureConfig& m : c.measures) {
    if (m.profile.empty() || body_of(m, s) != body_of(measure, s)) continue;
    const MeasuredProfile points = read_profile(m.profile);
    for (std::size_t i = 0; i < points.height.size(); ++i)
      for (const double side : {1.0, -1.0}) add(measured, side * points.radius[i], points.height[i]);
  }
  Figure figure;
  figure.title = fmt::format("{}: {} at {}", c.title, body.name, in_words(s.time, "s"));
  Panel panel;
  panel.x_label = "radius", panel.y_label = "height above the impact face";
  legend_beside(panel);
  figure.panels.push_back(panel);
  const double margin = 2.0 * s.grid.cell_size;
  const Scale lengths = fit(figure, window, margin);
  strained.size = 0.7 * point_size(particle, figure.panel_width - 190, window.width() + 2.0 * margin);
  figure.panel_width += 180;  // the legend and its margins, 41 characters of 9 pixels, are wider than colours
  for (Curve* curve : {&outline, &measured, &strained}) {
    curve->x = scaled(std::move(curve->x), lengths.per_si), curve->y = scaled(std::move(curve->y), lengths.per_si);
  }
  figure.panels.front().curves = {std::move(strained), std::move(outline), std::move(measured)};
  draw(c, std::move(figure), directory / fmt::format("profile_{}.png", body.name));
}

}  // namespace

std::vector<std::string> draw_figures(const Case& c, const Simulation& s, const Path& directory, Of of) {
  std::vector<std::string> troubles;
  const auto attempt = [&](const std::function<void()>& draw_it) {
    try {
      draw_it();
    } catch (const std::exception& error) {
      troubles.push_back(fmt::format("a figure is missing: {}", error.what()));
    }
  };
  attempt([&] { s.gas.empty() ? draw_energy(c, directory) : draw_gas_energy(c, s, directory); });
  if (!s.gas.bodies.empty()) attempt([&] { draw_gas_bodies(c, s, directory); });
  if (!s.gas.burns.empty()) attempt([&] { draw_reactions(c, s, directory); });
  if (!c.gauges.empty()) attempt([&] { draw_gauges(c, directory); });
  if (s.dimensions() > 1) attempt([&] { draw_field(c, s, directory, of); });
  std::vector<std::size_t> drawn;
  for (const MeasureConfig& measure : c.measures) {
    if (is_of_gas(measure.kind)) continue;
    const std::size_t body = body_of(measure, s);
    if (std::find(drawn.begin(), drawn.end(), body) != drawn.end()) continue;
    drawn.push_back(body);
    attempt([&] { draw_profile(c, s, measure, directory); });
  }
  for (const FigureConfig& figure : c.figures) attempt([&] { draw_line(c, s, figure, directory, of); });
  return troubles;
}

}  // namespace brisance::simulator
