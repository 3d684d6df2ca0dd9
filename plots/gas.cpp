// The gas against exact solutions: runs the cases, writes the table of what they must reach and the figure of all of them.
//   gas [NAME]... [--list] [-o DIR] [--runs DIR]

#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <optional>

#include "models/programs/figure.hpp"
#include "models/programs/files.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/gas/initial_state.hpp"
#include "simulator/output/line_out.hpp"
#include "validation.hpp"

namespace brisance::simulator {
namespace {

// What is measured ----------------------------------------------------------------------------------------------------

/// The cells along the line of a figure with the means of its reference over them.
struct Line {
  std::vector<double> place, computed, exact;
  double cell_size;
};

/// Mean of a polyline between two places.
double mean_of(const std::vector<double>& x, const std::vector<double>& y, double from, double to) {
  const auto at = [&](std::size_t i, double place) {
    return x[i + 1] > x[i] ? std::lerp(y[i], y[i + 1], (place - x[i]) / (x[i + 1] - x[i])) : y[i];
  };
  double sum = from < x.front() ? y.front() * (std::min(to, x.front()) - from) : 0.0;
  if (to > x.back()) sum += y.back() * (to - std::max(from, x.back()));
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double low = std::max(from, x[i]), high = std::min(to, x[i + 1]);
    if (high > low) sum += 0.5 * (at(i, low) + at(i, high)) * (high - low);
  }
  return sum / (to - from);
}

Line line_of(const Ran& ran, const std::string& field, std::size_t figure = 0) {
  const FigureConfig& config = ran.config.figures.at(figure);
  const auto f = static_cast<std::size_t>(std::find(config.fields.begin(), config.fields.end(), field) - config.fields.begin());
  const LineOut computed = line_out(ran.simulation, config);
  Line line{computed.place, computed.values.at(f), {}, ran.config.cell_size};
  if (config.reference.empty()) return line;
  const LineOut reference = read_reference(config);
  const double half = 0.5 * line.cell_size;
  for (const double x : line.place)
    line.exact.push_back(reference.values[f].empty() ? 0.0 : mean_of(reference.place, reference.values[f], x - half, x + half));
  return line;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v / static_cast<double>(values.size());
  return sum;
}

using Measure = std::function<double(const Ran&)>;

/// Mean error along the line of the first figure.
Measure error(const std::string& field) {
  return [field](const Ran& ran) {
    const Line line = line_of(ran, field);
    double sum = 0.0;
    for (std::size_t i = 0; i < line.place.size(); ++i) sum += std::abs(line.computed[i] - line.exact[i]);
    return sum / static_cast<double>(line.place.size());
  };
}
/// The same over the mean.
Measure relative_error(const std::string& field) {
  return [field](const Ran& ran) { return error(field)(ran) / mean(line_of(ran, field).exact); };
}
Measure largest_error(const std::string& field, double scale) {
  return [field, scale](const Ran& ran) {
    const Line line = line_of(ran, field);
    double most = 0.0;
    for (std::size_t i = 0; i < line.place.size(); ++i) most = std::max(most, std::abs(line.computed[i] - line.exact[i]));
    return most / scale;
  };
}
/// Energy that is neither there at the start nor has come through the edges, over what there was.
double lost_energy(const Ran& ran) {
  const GasBooks& books = *ran.result.summary.books.gas;
  return std::abs(books.residual().energy / books.initial.energy);
}
/// Part of the kinetic energy of the start.
double lost_motion(const Ran& ran) {
  const GasBooks& books = *ran.result.summary.books.gas;
  return 1.0 - books.state.kinetic / books.initial.kinetic;
}
/// Root of the mean square of the density's error against the profile that the case began with: of flow that comes back.
double error_of_return(const Ran& ran) {
  const ProfileConfig& config = *ran.config.gas->fills[0].profile;
  const gas::StateProfile start = gas::read_state_profile(config);
  const gas::Gas& gas = ran.simulation.gas;
  double square = 0.0;
  gas::for_each_cell(gas, [&](const gas::CellPlace& at) {
    const Vector away = gas.cells.centre(at.block, at.cell) - config.centre;
    const double exact = gas::interpolate(start.place, start.density, std::sqrt(dot(away, away)));
    square += std::pow(gas.primitive.cell(at.block, gas::Primitive::density, at.cell) - exact, 2);
  });
  return std::sqrt(square / static_cast<double>(gas.cells.count()));
}
/// Mean of a field between two places.
double plateau(const Line& line, double from, double to) {
  std::vector<double> inside;
  for (std::size_t i = 0; i < line.place.size(); ++i)
    if (line.place[i] > from && line.place[i] < to) inside.push_back(line.computed[i]);
  return mean(inside);
}
/// The outermost place where a line of values falls through a level.
double front(const std::vector<double>& place, const std::vector<double>& value, double level) {
  for (std::size_t i = place.size() - 1; i > 0; --i)
    if (value[i] <= level && value[i - 1] > level)
      return std::lerp(place[i], place[i - 1], (level - value[i]) / (value[i - 1] - value[i]));
  return 0.0;
}
double peak(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}
double rise(const Line& line, const std::vector<double>& values, double from, double to) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (line.place[i] > from && line.place[i] < to) low = std::min(low, values[i]), high = std::max(high, values[i]);
  return high - low;
}

// The same flow along many rays ---------------------------------------------------------------------------------------

/// Density in the quadrant of two dimensions, linear between the middles of the cells.
class Quadrant {
 public:
  explicit Quadrant(const Ran& ran) : h_(ran.config.cell_size) {
    const gas::Gas& gas = ran.simulation.gas;
    for (std::size_t a = 0; a < 2; ++a) cells_[a] = gas.cells.upper[a];
    density_.resize(static_cast<std::size_t>(cells_[0] * cells_[1]));
    gas::for_each_cell(gas, [&](const gas::CellPlace& at) {
      const std::array<int, 3> i = gas.cells.index(at.block, at.cell);
      density_[static_cast<std::size_t>(i[0] + cells_[0] * i[1])] =
          gas.primitive.cell(at.block, gas::Primitive::density, at.cell);
    });
  }
  /// Values at so many places along a ray, and at which.
  void sample(double angle, double reach, std::vector<double>& place, std::vector<double>& value) const {
    place.clear(), value.clear();
    for (double r = 0.0; r < reach; r += 0.1 * h_)
      place.push_back(r), value.push_back(at(r * std::cos(angle), r * std::sin(angle)));
  }

 private:
  double at(double x, double y) const {
    const double u = std::max(x / h_ - 0.5, 0.0), v = std::max(y / h_ - 0.5, 0.0);
    const int i = std::min(static_cast<int>(u), cells_[0] - 2), j = std::min(static_cast<int>(v), cells_[1] - 2);
    const auto value = [&](int a, int b) { return density_[static_cast<std::size_t>(a + cells_[0] * b)]; };
    return std::lerp(std::lerp(value(i, j), value(i + 1, j), u - i), std::lerp(value(i, j + 1), value(i + 1, j + 1), u - i),
                     v - j);
  }
  double h_;
  std::array<int, 2> cells_{};
  std::vector<double> density_;
};

struct Fronts {
  double mean = 0.0, spread = 0.0;  // spread: largest less smallest over the mean
  double peak = 0.0;                // mean of the largest densities
};
/// Radii within a reach at which the density falls through a level, or half-way from its peak to `ahead` without one.
Fronts fronts(const Ran& ran, double reach, double ahead, std::optional<double> level = {}) {
  const Quadrant quadrant(ran);
  constexpr int parts = 24;
  std::vector<double> radii, place, value;
  Fronts result;
  for (int k = 0; k <= parts; ++k) {
    quadrant.sample(0.5 * std::numbers::pi * k / parts, reach, place, value);
    const double most = peak(value);
    result.peak += most / (parts + 1);
    radii.push_back(front(place, value, level.value_or(0.5 * (most + ahead))));
  }
  result.mean = mean(radii);
  result.spread = (peak(radii) - *std::min_element(radii.begin(), radii.end())) / result.mean;
  return result;
}

// The cases -----------------------------------------------------------------------------------------------------------

struct Goal {
  std::string text;
  double limit;
  Measure measure;
  bool at_least = false;
};
struct Entry {
  std::string name, file;
  std::vector<std::string> changes;
  std::string field;  // that the figure of all shows, of the first of the case's figures
  std::vector<Goal> goals;
};

std::vector<Entry> entries() {
  std::vector<Entry> all;
  const auto add = [&](const std::string& file, const std::string& field, std::vector<Goal> goals,
                       std::vector<std::string> changes = {}, const std::string& variation = "") {
    all.push_back({"gas_" + file + variation, file, std::move(changes), field, std::move(goals)});
  };
  const auto L1 = [](double limit) { return Goal{"L1 of the density", limit, error("density")}; };
  const auto relative_L1 = [](double limit) {
    return Goal{"L1 of the density over its mean", limit, relative_error("density")};
  };
  const auto relative = [](const std::string& field, double limit) {
    return Goal{"L1 of the " + field + " over its mean", limit, relative_error(field)};
  };
  const Goal closed{"energy in no book, of all", 1e-13, lost_energy};

  add("sod", "density", {L1(1.6e-3), closed});
  add("near_vacuum_tube", "density", {L1(0.010)});
  add("strong_shock_tube", "density", {L1(0.03), closed});
  add("dense_driver_tube", "density", {L1(0.03), closed});
  add("moving_contact", "density",
      {{"error of the pressure", 1e-12, largest_error("pressure", 1.0)},
       {"error of the velocity", 1e-12, largest_error("velocity", 1.0)}});
  add("entropy_wave", "density", {L1(1.2 * 3.05e-4), closed});
  add("shu_osher", "density",
      {L1(1.2 * 0.043),
       relative_L1(0.05),
       {"height of the short waves, of the reference", 0.8,
        [](const Ran& ran) {
          const Line line = line_of(ran, "density");
          return rise(line, line.computed, 0.6, 2.2) / rise(line, line.exact, 0.6, 2.2);
        },
        true}});
  add("woodward_colella", "density",
      {relative_L1(0.05), closed, {"peak of the density against the reference", 0.05, [](const Ran& ran) {
                                     const FigureConfig& figure = ran.config.figures[0];
                                     return std::abs(
                                         peak(line_of(ran, "density").computed) / peak(read_reference(figure).values[0]) - 1.0);
                                   }}});
  const auto noh = [&](const std::string& file, double plateau_known, double behind, double ahead) {
    add(file, "density",
        {{"mean density at 0.05 < r < 0.15, below that of another code", 0.01,
          [=](const Ran& ran) { return 1.0 - plateau(line_of(ran, "density"), 0.05, 0.15) / plateau_known; }},
         {"shock from r = 0.2, in cells", 1.0, [=](const Ran& ran) {
            const Line line = line_of(ran, "density");
            return std::abs(front(line.place, line.computed, 0.5 * (behind + ahead)) - 0.2) / line.cell_size;
          }}});
  };
  noh("noh_cylindrical_1d", 15.87, 16.0, 4.0), noh("noh_spherical_1d", 62.4, 64.0, 16.0);
  add("noh_axisymmetric", "density",
      {{"spread of the radius", 0.015, [](const Ran& ran) { return fronts(ran, 0.5, 16.0, 40.0).spread; }},
       {"shock from r = 0.2, in cells", 1.0,
        [](const Ran& ran) { return std::abs(fronts(ran, 0.5, 16.0, 40.0).mean - 0.2) / ran.config.cell_size; }},
       {"plateau across the axis, below 64", 0.03,
        [](const Ran& ran) { return 1.0 - plateau(line_of(ran, "density"), 0.1, 0.16) / 64.0; }}});
  const auto from_radius = [](double radius, double h) { return std::abs(radius - 1.0) - 0.5 * h - 0.003; };
  add("sedov_spherical_1d", "density",
      {{"radius from 1, beyond half a cell and 0.3 %", 0.0,
        [=](const Ran& ran) {
          const Line line = line_of(ran, "density");
          return from_radius(front(line.place, line.computed, 0.5 * (peak(line.computed) + 1.0)), line.cell_size);
        }},
       {"peak of the density", 0.98 * 5.04, [](const Ran& ran) { return peak(line_of(ran, "density").computed); }, true},
       closed});
  add("sedov_axisymmetric", "density",
      {{"radius from 1, beyond half a cell and 0.3 %", 0.0,
        [=](const Ran& ran) { return from_radius(fronts(ran, 1.15, 1.0).mean, ran.config.cell_size); }},
       {"spread of the radius", 0.015, [](const Ran& ran) { return fronts(ran, 1.15, 1.0).spread; }},
       {"peak of the density", 0.85 * 4.50, [](const Ran& ran) { return fronts(ran, 1.15, 1.0).peak; }, true},
       closed});
  add("cylindrical_explosion", "density",
      {relative_L1(0.05),
       {"spread of the radius of the shock", 0.015, [](const Ran& ran) { return fronts(ran, 0.95, 0.125, 0.18).spread; }},
       closed});
  const Goal motion{"kinetic energy lost", 0.02, lost_motion};
  add("isentropic_vortex", "velocity", {closed}, {"cell_size=0.15625 m", "title=Isentropic vortex, 64 x 64 cells"}, "_64");
  add("isentropic_vortex", "velocity", {closed});
  add("gresho_vortex", "velocity", {motion, closed});
  add("gresho_vortex", "velocity", {motion, closed},
      {"gas.fill.0.profile.file=gresho_vortex_mach_001_start.csv", "figure.0.reference=gresho_vortex_mach_001.csv",
       "title=Vortex of Gresho at Mach 0.01"},
      "_mach_001");
  add("hydrostatic_column", "pressure",
      {{"fastest, over the speed of sound", 1e-10, largest_error("velocity", std::sqrt(1.4 * 0.4 * 718.0 * 250.0))}});
  add("water_air_shock_tube", "density", {relative_L1(2.4e-3), closed});
  add("dense_gas_into_air", "density", {relative_L1(1.65e-3), closed});
  add("water_slab", "fraction_water",
      {{"error of the pressure, of it", 1e-9, largest_error("pressure", 1e5)},
       {"error of the velocity in m/s", 1e-8, largest_error("velocity", 1.0)},
       closed});
  const auto impact = [&](const std::string& file) {
    add(file, "pressure", {{"pressure behind the shock", 0.01, [](const Ran& ran) {
                              const Line line = line_of(ran, "pressure");
                              const double high = line.exact.front(), shock = front(line.place, line.exact, 0.5 * high);
                              return std::abs(plateau(line, 0.2 * shock, 0.8 * shock) / high - 1.0);
                            }}});
  };
  impact("murnaghan_impact"), impact("tillotson_impact");
  add("couette", "speed", {{"error of the speed, of the wall's", 0.005, [](const Ran& ran) {
                              const Line line = line_of(ran, "speed");
                              return error("speed")(ran) / peak(line.exact);
                            }}});
  add("closed_bomb", "pressure", {relative("pressure", 0.03)});
  add("detonation_pbx_9501", "pressure", {relative("pressure", 0.03)});
  add("gas_driven_projectile", "pressure", {relative("pressure", 0.01)});
  add("supersonic_wedge", "pressure", {relative("pressure", 0.03)});
  return all;
}

// Table and figure ----------------------------------------------------------------------------------------------------

struct Done {
  Entry entry;
  std::string title;
  std::vector<Check> checks;
  double seconds;
  Panel panel;
  double error = 0.0;  // of a flow that comes back
};

Panel panel_of(const Ran& ran, const Entry& entry) {
  const FigureConfig& figure = ran.config.figures.at(0);
  const LineOut computed = line_out(ran.simulation, figure), reference = read_reference(figure);
  const auto f =
      static_cast<std::size_t>(std::find(figure.fields.begin(), figure.fields.end(), entry.field) - figure.fields.begin());
  Panel panel;
  panel.title = ran.config.title, panel.x_label = computed.coordinate + " (m)";
  const std::string unit = unit_of_field(entry.field);
  panel.y_label = entry.field + (unit == "1" ? "" : " (" + unit + ")");
  std::replace(panel.y_label.begin(), panel.y_label.end(), '_', ' ');
  panel.curves.push_back({"", computed.place, computed.values[f], Mark::dots, 0});
  panel.curves.back().size = 0.4;
  panel.curves.push_back({"", reference.place, reference.values[f], Mark::line, 1});
  constexpr double mega = 1e6;
  if (unit == "Pa" && peak(reference.values[f]) > mega) {
    panel.y_label = entry.field + " (MPa)";
    for (Curve& curve : panel.curves)
      for (double& y : curve.y) y /= mega;
  }
  return panel;
}

std::string table(const std::vector<Done>& runs) {
  std::string text = "# The gas against exact solutions\n\n";
  text += fmt::format(
      "Written by `./bootstrap.sh validate`; commit {}. The cases are data/cases/*.toml of these names; their references are "
      "exact "
      "solutions, or where there is none a fine grid of another scheme (plots/gas_references.cpp). SI units. Wall time in "
      "seconds; threads: {}.\n\n",
      commit_hash(), omp_get_max_threads());
  text += "| case | quantity | goal | reached | | wall |\n|---|---|---|---|---|---|\n";
  for (const Done& d : runs)
    for (const Check& c : d.checks)
      text += fmt::format("| {} | {} | {} {:.3g} | {:.3g} | {} | {:.1f} |\n", d.entry.name.substr(4), c.text,
                          c.at_least ? "at least" : "at most", c.limit, c.value, c.holds() ? "holds" : "MISSED", d.seconds);
  return text;
}

int run_all(const std::vector<std::string>& names, const std::filesystem::path& output, const std::filesystem::path& runs_in) {
  std::vector<Done> runs;
  for (const Entry& e : entries()) {
    if (!names.empty() && std::find(names.begin(), names.end(), e.name) == names.end()) continue;
    const Ran ran = run_case(e.file, e.changes, runs_in / e.name);
    if (ran.result.ending != Ending::done) {
      fmt::print("{}: {}\n", e.name, ran.result.message);
      return ran.result.ending == Ending::interrupted ? 3 : 1;
    }
    Done done{e, ran.config.title, {}, ran.result.summary.wall_time, panel_of(ran, e)};
    for (const Goal& goal : e.goals) {
      done.checks.push_back({goal.text, goal.measure(ran), goal.limit, goal.at_least});
      const Check& c = done.checks.back();
      fmt::print("{:32} {:62} {:>10.3g} of {:>8.3g}  {}\n", e.name, c.text, c.value, c.limit, c.holds() ? "holds" : "MISSED");
    }
    std::fflush(stdout);
    if (e.file == "isentropic_vortex") done.error = error_of_return(ran);
    runs.push_back(std::move(done));
  }
  // Twice as many cells along each direction: the order of the error.
  const auto run_named = [&](const std::string& name) {
    return std::find_if(runs.begin(), runs.end(), [&](const Done& d) { return d.entry.name == name; });
  };
  const auto coarse = run_named("gas_isentropic_vortex_64"), fine = run_named("gas_isentropic_vortex");
  if (coarse != runs.end() && fine != runs.end())
    fine->checks.push_back(
        {"order of the L2 error of the density from 64 cells", std::log2(coarse->error / fine->error), 1.9, true});
  if (runs.empty()) throw std::invalid_argument("gas: no run of that name; `--list` shows all");
  if (names.empty()) {
    std::filesystem::create_directories(output);
    replace_file_by_text(output / "gas.md", table(runs));
    Figure figure{"The gas: computed (dots) and exact (lines)", {}, 4, 420, 300};
    for (Done& d : runs) figure.panels.push_back(std::move(d.panel));
    draw(figure, output / "gas.png");
    fmt::print("\ntable: {}\nfigure: {}\n", (output / "gas.md").string(), (output / "gas.png").string());
  } else {
    for (const Done& d : runs) fmt::print("figures of {}: {}\n", d.title, (runs_in / d.entry.name).string());
  }
  const bool good = std::all_of(runs.begin(), runs.end(), [](const Done& d) {
    return std::all_of(d.checks.begin(), d.checks.end(), [](const Check& c) { return c.holds(); });
  });
  return good ? 0 : 1;
}

}  // namespace
}  // namespace brisance::simulator

int main(int argc, char** argv) {
  CLI::App app{"The gas against exact solutions."};
  std::vector<std::string> names;
  bool list = false;
  std::string output = "plots/gallery", runs = "out/validation/runs";
  app.add_option("NAME", names, "runs to make; all if none is given");
  app.add_flag("--list", list, "names of all runs");
  app.add_option("-o,--output", output, "directory for table and figure")->capture_default_str();
  app.add_option("--runs", runs, "directory for the runs")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    if (!list) return brisance::simulator::run_all(names, output, runs);
    for (const auto& e : brisance::simulator::entries()) fmt::print("{}\n", e.name);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
