// The gas against exact solutions: runs the cases, writes the table of what they must reach and the figure of all of them.
//   gas [NAME]... [--list] [-o DIR] [--runs DIR]

#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "gas_cases.hpp"
#include "models/programs/figure.hpp"
#include "models/programs/files.hpp"

namespace brisance::simulator {
namespace {

struct Done {
  Entry entry;
  std::string title;
  std::vector<Check> checks;
  double seconds, cell_size;
  Panel panel;
  double error = 0.0;  // of a flow that comes back
};

/// What is level within a twentieth is drawn so, not as noise.
void widen(Panel& panel) {
  double low = 1e300, high = -1e300;
  for (const Curve& curve : panel.curves)
    for (const double y : curve.y) low = std::min(low, y), high = std::max(high, y);
  constexpr double part = 0.05;
  const double middle = 0.5 * (low + high), least = middle != 0.0 ? part * std::abs(middle) : part;
  if (high - low < least) panel.y_range = {{middle - least, middle + least}};
}

Panel panel_of(const Watched& ran, const Entry& entry) {
  Panel panel;
  panel.title = ran.config.title;
  if (entry.field.empty()) {
    constexpr double milli = 1e3;
    const bool quick = ran.time.back() < 0.1;
    panel.x_label = quick ? "time (ms)" : "time (s)", panel.y_label = entry.watch->label;
    panel.curves = {{"", {}, {}, Mark::dots, 0}, {"", {}, {}, Mark::line, 1}};
    panel.curves[0].size = 0.4;
    for (std::size_t n = 0; n < ran.time.size(); ++n) {
      for (Curve& curve : panel.curves) curve.x.push_back((quick ? milli : 1.0) * ran.time[n]);
      panel.curves[0].y.push_back(entry.watch->per_si * ran.values[n][0]);
      panel.curves[1].y.push_back(entry.watch->per_si * entry.watch->exact(ran, ran.time[n]));
    }
    widen(panel);
    return panel;
  }
  const FigureConfig& figure = ran.config.figures.at(0);
  const LineOut computed = line_out(ran.simulation, figure);
  LineOut reference = read_reference(figure);
  if (!ran.simulation.gas.bodies.empty()) reference = outside_bodies(reference, computed, ran.simulation.grid.cell_size);
  const auto f =
      static_cast<std::size_t>(std::find(figure.fields.begin(), figure.fields.end(), entry.field) - figure.fields.begin());
  panel.x_label = computed.coordinate + " (m)";
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
  widen(panel);
  return panel;
}

std::string verdict(const Check& c) {
  return std::isinf(c.limit) ? "reported" : c.holds() ? "holds" : "MISSED";
}

std::string table(const std::vector<Done>& runs) {
  std::string text = "# The gas against exact solutions\n\n";
  text += fmt::format(
      "Written by `./bootstrap.sh validate`; commit {}. The cases are data/cases/*.toml of these names; their references are "
      "exact solutions, or where there is none a fine grid of another scheme (plots/gas_references.cpp). SI units. Wall time "
      "in seconds, with as many threads as pay, {} at most.\n\n",
      commit_hash(), omp_get_num_procs());
  text += "| case | quantity | goal | reached | | wall |\n|---|---|---|---|---|---|\n";
  for (const Done& d : runs)
    for (const Check& c : d.checks)
      text += fmt::format("| {} | {} | {} | {:.3g} | {} | {:.1f} |\n", d.entry.name.substr(4), c.text,
                          std::isinf(c.limit) ? "" : fmt::format("{} {:.3g}", c.at_least ? "at least" : "at most", c.limit),
                          c.value, verdict(c), d.seconds);
  return text;
}

int run_all(const std::vector<std::string>& names, const std::filesystem::path& output, const std::filesystem::path& runs_in) {
  std::vector<Done> runs;
  for (const Entry& e : entries()) {
    if (!names.empty() && std::find(names.begin(), names.end(), e.name) == names.end()) continue;
    Watched ran;
    const auto look = [&](const Simulation& s) {
      if (e.watch) ran.time.push_back(s.time), ran.values.push_back(e.watch->read(s));
    };
    static_cast<Ran&>(ran) = run_case(e.file, e.changes, runs_in / e.name, e.watch ? e.watch->parts : 1, look);
    if (ran.result.ending != Ending::done) {
      fmt::print("{}: {}\n", e.name, ran.result.message);
      return ran.result.ending == Ending::interrupted ? 3 : 1;
    }
    Done done{e, ran.config.title, {}, ran.result.summary.wall_time, ran.config.cell_size, panel_of(ran, e)};
    for (const Goal& goal : e.goals) {
      done.checks.push_back({goal.text, goal.measure(ran), goal.limit, goal.at_least});
      const Check& c = done.checks.back();
      fmt::print("{:32} {:62} {:>10.3g} of {:>8.3g}  {}\n", e.name, c.text, c.value, c.limit, verdict(c));
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
  // The same cells on a radius.
  const auto ball = run_named("gas_sedov_three_dimensional"), on_radius = run_named("gas_sedov_spherical_1d_50");
  if (ball != runs.end() && on_radius != runs.end()) {
    const auto value = [](const Done& run, const char* text) {
      return std::find_if(run.checks.begin(), run.checks.end(), [&](const Check& c) { return c.text == text; })->value;
    };
    ball->checks.push_back({"radius from that on a radius, in cells",
                            std::abs(value(*ball, front_radius) - value(*on_radius, front_radius)) / ball->cell_size, 0.5});
    ball->checks.push_back(
        {"peak over that on a radius", value(*ball, peak_density) / value(*on_radius, peak_density), 0.85, true});
  }
  if (runs.empty()) throw std::invalid_argument("gas: no run of these names; `--list` shows all");
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
