// Taylor impacts against experiment: runs the cases, writes the table and the figure of all profiles.
//   taylor [NAME]... [--full] [--list] [-o DIR]
// The standard set is every case at its own resolution; --full adds refinement, friction and three-dimensional quarters.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <tuple>

#include "models/programs/figure.hpp"
#include "models/programs/files.hpp"
#include "simulator/output/measures.hpp"
#include "validation.hpp"

namespace brisance::simulator {
namespace {

/// One run: a case of data/cases, perhaps changed.
struct Entry {
  std::string name, test, law;
  std::string variation, study;  // what is varied and under which heading; empty: the standard set
  std::string file;
  std::vector<std::string> changes;

  bool full() const { return !study.empty(); }
  std::string label() const { return law + (full() ? ", " + variation : ""); }
};
/// What the standard run is in each study.
const std::map<std::string, std::string> standard = {
    {"resolution", "R/h = 12"}, {"friction", "frictionless"}, {"dimensions", "axisymmetric"}};

std::vector<Entry> entries() {
  struct Test {
    const char *id, *words, *stem;
    bool threshold_stress;
  };
  // Numbers A1 to A12 as in the table of the documentation.
  const std::vector<Test> tests{{"A1", "4340 steel, 208 m/s", "4340_208", false},
                                {"A2", "4340 steel, 343 m/s, short", "4340_343", false},
                                {"A3", "OFHC copper, 190 m/s", "copper_190", true},
                                {"A4", "OFHC copper, 130 m/s", "copper_130", true},
                                {"A5", "OFHC copper, 146 m/s", "copper_146", true},
                                {"A6", "OFHC copper, 210 m/s", "copper_210", true},
                                {"A7", "ETP copper, 188 m/s, 718 K", "copper_etp_188_718k", true},
                                {"A8", "ETP copper, 277 m/s", "copper_etp_277", true},
                                {"A9", "6061-T6, 200 m/s", "6061_t6_200", true},
                                {"A10", "6061-T6, 194 m/s, 635 K", "6061_t6_194_635k", true},
                                {"A11", "6061-T6, 275 m/s", "6061_t6_275", true},
                                {"A12", "6061-T6, 373 m/s", "6061_t6_373", true}};
  std::vector<Entry> all;
  for (const Test& t : tests) {
    const std::string stem = fmt::format("taylor_{}", t.stem), test = fmt::format("{}: {}", t.id, t.words);
    all.push_back({stem + "_johnson_cook", test, "Johnson-Cook", "", "", stem + "_johnson_cook", {}});
    if (t.threshold_stress) all.push_back({stem + "_mts", test, "threshold stress", "", "", stem + "_mts", {}});
  }
  const std::string a1 = "A1: 4340 steel, 208 m/s", a3 = "A3: OFHC copper, 190 m/s";
  const std::pair<std::string, std::string> studied[] = {
      {"taylor_4340_208_johnson_cook", a1}, {"taylor_copper_190_johnson_cook", a3}, {"taylor_copper_190_mts", a3}};
  for (const auto& [file, test] : studied) {
    const std::string law = file.ends_with("mts") ? "threshold stress" : "Johnson-Cook";
    all.push_back({file + "_r6", test, law, "R/h = 6", "resolution", file, {"cell_size=0.635 mm"}});
    all.push_back({file + "_r24", test, law, "R/h = 24", "resolution", file, {"cell_size=0.15875 mm"}});
    all.push_back({file + "_friction_05", test, law, "friction 0.05", "friction", file, {"boundary.0.friction=0.05"}});
    all.push_back({file + "_friction_10", test, law, "friction 0.1", "friction", file, {"boundary.0.friction=0.1"}});
  }
  for (const auto& [file, test, law] : {std::tuple{"taylor_4340_208_quarter", a1, "Johnson-Cook"},
                                        std::tuple{"taylor_copper_190_quarter_mts", a3, "threshold stress"}})
    all.push_back({file, test, law, "three dimensions", "dimensions", file, {}});
  return all;
}

struct Done {
  Entry entry;
  Case config;
  Summary summary;
  std::vector<Profile> profiles;
};

const MeasuredValue* find(const Summary& s, std::string_view name) {
  const auto at = std::find_if(s.measures.begin(), s.measures.end(), [&](const MeasuredValue& m) { return m.name == name; });
  return at == s.measures.end() ? nullptr : &*at;
}

/// Mean of the relative errors of length, diameter and diameter at 0.2 (Johnson & Holmquist, J. Appl. Phys. 64 (1988) 3901).
double mean_error(const Summary& s) {
  double sum = 0.0;
  int count = 0;
  for (const char* name : {"final_length", "mushroom_diameter", "diameter_at_0.2"})
    if (const MeasuredValue* m = find(s, name); m && m->deviation()) sum += std::abs(*m->deviation()), ++count;
  return count ? sum / count : std::nan("");
}

std::string row(const Done& d) {
  const auto cell = [&](std::string_view name) {
    const MeasuredValue* m = find(d.summary, name);
    return m ? fmt::format("{:.2f} ({:+.1f} %)", 1e3 * m->value, 100.0 * m->deviation().value_or(0.0)) : std::string("-");
  };
  const MeasuredValue* profile = find(d.summary, "profile_error");
  const Balance& b = d.summary.books.balance;
  const double all = d.summary.books.peak_kinetic;
  return fmt::format(
      "| {} | {} | {} | {} | {} | {:.1f} % | {} | {:.1f} | {:.2f} | {:+.2f} | {:+.2f} | {:+.2f} | {:+.2f} | {:.0e} | {} | "
      "{:.1f} |\n",
      d.entry.test, d.entry.label(), cell("final_length"), cell("mushroom_diameter"), cell("diameter_at_0.2"),
      100.0 * mean_error(d.summary), profile ? fmt::format("{:.1f} %", 100.0 * profile->value) : "-",
      100.0 * b.internal.plastic_work / all, 100.0 * b.internal.viscous_work / all, 100.0 * b.transfer / all,
      100.0 * b.filter / all, 100.0 * b.filter_heat / all, 100.0 * b.stress_timing / all, b.residual / all, d.summary.particles,
      d.summary.wall_time);
}

std::string table(const std::vector<Done>& runs, const std::string& commit) {
  std::string text = "# Taylor impacts against experiment\n\n";
  text += fmt::format(
      "Written by `./bootstrap.sh validate`; commit {}. Lengths in mm with the deviation from the measured value; D is the "
      "mean of the three; the profile error is relative to the initial radius. Energies in per cent of the initial kinetic "
      "energy: plastic work, artificial viscosity, and the numerical books (transfer, filter, what of it becomes heat, stress "
      "timing); `none` is what no book accounts for. Wall time in seconds, with as many threads as pay, {} at most.\n\n",
      commit, omp_get_num_procs());
  text +=
      "| test | law | length | diameter | at 0.2 L | D | profile | plastic | viscous | transfer | filter | its heat | timing | "
      "none | particles | wall |\n";
  text += "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Done& d : runs) text += row(d);
  return text;
}

/// What the runs at hand allow to check. The limits are what a good code reaches on these tests with published constants.
std::vector<Check> checks(const std::vector<Done>& runs) {
  std::vector<Check> all;
  const auto run_named = [&](const std::string& name) -> const Done* {
    const auto at = std::find_if(runs.begin(), runs.end(), [&](const Done& d) { return d.entry.name == name; });
    return at == runs.end() ? nullptr : &*at;
  };
  const auto deviation = [&](const Done& d, const char* measure) { return std::abs(*find(d.summary, measure)->deviation()); };
  const auto value = [&](const Done& d, const char* measure) { return find(d.summary, measure)->value; };
  if (const Done* a1 = run_named("taylor_4340_208_johnson_cook")) {
    all.push_back({"A1: length within 1 %", deviation(*a1, "final_length"), 0.01});
    all.push_back({"A1: diameter within 5 %", deviation(*a1, "mushroom_diameter"), 0.05});
    all.push_back({"A1: diameter at 0.2 L within 3 %", deviation(*a1, "diameter_at_0.2"), 0.03});
  }
  if (const Done* d = run_named("taylor_copper_190_mts"))
    all.push_back({"A3: D at most 4 % with threshold stress", mean_error(d->summary), 0.04});
  if (const Done* d = run_named("taylor_copper_190_johnson_cook"))
    all.push_back({"A3: D at most 8.5 % with Johnson-Cook", mean_error(d->summary), 0.085});
  const std::pair<const char*, const char*> copper[] = {{"A3", "taylor_copper_190"},
                                                        {"A4", "taylor_copper_130"},
                                                        {"A5", "taylor_copper_146"},
                                                        {"A7", "taylor_copper_etp_188_718k"},
                                                        {"A8", "taylor_copper_etp_277"}};
  for (const auto& [id, stem] : copper) {
    const Done *jc = run_named(std::string(stem) + "_johnson_cook"), *mts = run_named(std::string(stem) + "_mts");
    if (jc && mts)
      all.push_back({fmt::format("{}: D with threshold stress over D with Johnson-Cook below 1", id),
                     mean_error(mts->summary) / mean_error(jc->summary), 1.0});
  }
  for (const char* name : {"taylor_4340_208_johnson_cook", "taylor_copper_190_johnson_cook", "taylor_copper_190_mts"}) {
    const Done *coarse = run_named(std::string(name) + "_r6"), *middle = run_named(name),
               *fine = run_named(std::string(name) + "_r24");
    if (!middle || !fine) continue;
    const double change = value(*fine, "final_length") / value(*middle, "final_length") - 1.0;
    const bool mts = std::string(name).ends_with("mts");
    std::string text = fmt::format("{}: change of length from R/h = 12 to 24", name);
    if (coarse) {
      // Richardson: the error falls by the same factor with each halving.
      const double L1 = value(*coarse, "final_length"), L2 = value(*middle, "final_length"), L3 = value(*fine, "final_length");
      const double factor = (L1 - L2) / (L2 - L3);
      text += factor > 1.0
                  ? fmt::format("; order {:.2f}, limit of length {:.3f} mm", std::log2(factor),
                                1e3 * (L3 - (L2 - L3) / (factor - 1.0)))
                  : fmt::format("; not monotonic (6: {:.3f}, 12: {:.3f}, 24: {:.3f} mm)", 1e3 * L1, 1e3 * L2, 1e3 * L3);
    }
    all.push_back({text, std::abs(change), mts ? 0.008 : 0.005});
  }
  const std::pair<const char*, const char*> quarters[] = {{"taylor_4340_208_johnson_cook", "taylor_4340_208_quarter"},
                                                          {"taylor_copper_190_mts", "taylor_copper_190_quarter_mts"}};
  for (const auto& [flat, solid] : quarters) {
    const Done *axisymmetric = run_named(flat), *quarter = run_named(solid);
    if (!axisymmetric || !quarter) continue;
    for (const auto& [measure, limit] : {std::pair{"final_length", 0.005}, std::pair{"mushroom_diameter", 0.015}})
      all.push_back({fmt::format("{}: {} against axisymmetric", solid, measure),
                     std::abs(value(*quarter, measure) / value(*axisymmetric, measure) - 1.0), limit});
  }
  for (const Done& d : runs) {
    if (d.entry.name.ends_with("_r6")) continue;
    all.push_back({fmt::format("{}: energy in numerical books over the initial kinetic energy", d.entry.name),
                   std::abs(d.summary.books.balance.numerical()) / d.summary.books.peak_kinetic, 0.01});
  }
  return all;
}

Curve profile_curve(const std::string& title, const std::vector<double>& radius, const std::vector<double>& height, Mark mark,
                    int colour) {
  Curve curve{title, radius, height, mark, colour};
  for (std::vector<double>* lengths : {&curve.x, &curve.y})
    for (double& length : *lengths) length *= 1e3;
  return curve;
}

/// A panel for each test with the standard runs, then one for each study of a test with a law: what is varied beside the
/// standard.
Figure figure(const std::vector<Done>& runs) {
  Figure figure{"Taylor impacts: computed and measured profiles", {}, 4, 380, 420};
  std::vector<std::string> titles;
  const auto add = [&](const Done& d, const std::string& title, const std::string& label) {
    if (d.profiles.empty()) return;
    const auto at = std::find(titles.begin(), titles.end(), title);
    const auto number = static_cast<std::size_t>(at - titles.begin());
    if (at == titles.end()) {
      titles.push_back(title);
      Panel& fresh = figure.panels.emplace_back();
      fresh.title = title, fresh.x_label = "radius (mm)", fresh.y_label = "height (mm)", fresh.legend = "top right";
      for (const MeasureConfig& m : d.config.measures)
        if (!m.profile.empty()) {
          const MeasuredProfile p = read_profile(m.profile);
          fresh.curves.push_back(profile_curve("measured", p.radius, p.height, Mark::points, 7));
        }
    }
    Panel& panel = figure.panels[number];
    const auto before = static_cast<int>(
        std::count_if(panel.curves.begin(), panel.curves.end(), [](const Curve& c) { return c.title != "measured"; }));
    panel.curves.push_back(profile_curve(label, d.profiles[0].radius, d.profiles[0].height, Mark::line, before));
  };
  for (const Done& d : runs)
    if (!d.entry.full()) add(d, d.entry.test, d.entry.label());
  for (const auto& [study, standard_label] : standard)
    for (const Done& d : runs) {
      if (d.entry.study != study) continue;
      const std::string title = fmt::format("{}, {}: {}", d.entry.test.substr(0, d.entry.test.find(':')), d.entry.law, study);
      if (std::find(titles.begin(), titles.end(), title) == titles.end())
        for (const Done& base : runs)
          if (!base.entry.full() && base.entry.test == d.entry.test && base.entry.law == d.entry.law)
            add(base, title, standard_label);
      add(d, title, d.entry.variation);
    }
  return figure;
}

int run_all(const std::vector<std::string>& names, bool full, const std::filesystem::path& output) {
  std::vector<Done> runs;
  for (const Entry& e : entries()) {
    const bool named = std::find(names.begin(), names.end(), e.name) != names.end();
    if (!(named || (names.empty() && (full || !e.full())))) continue;
    const Ran ran = run_case(e.file, e.changes, output / "runs" / e.name);
    const RunResult& result = ran.result;
    fmt::print("{:44} D {:5.1f} %   {:7.1f} s{}\n", e.name, 100.0 * mean_error(result.summary), result.summary.wall_time,
               result.ending == Ending::done ? "" : "   " + result.message);
    std::fflush(stdout);
    if (result.ending == Ending::interrupted) return 3;
    if (result.ending == Ending::failed) return 1;
    runs.push_back({e, ran.config, result.summary, {profile_of(ran.simulation, ran.simulation.bodies[0], Axis::y)}});
  }
  if (runs.empty()) throw std::invalid_argument("taylor: no run of these names; `--list` shows all");
  std::filesystem::create_directories(output);
  const std::vector<Check> statements = checks(runs);
  const std::string text = table(runs, commit_hash()) + table(statements);
  fmt::print("\n{}", text);
  const std::string stem = names.empty() ? (full ? "taylor_full" : "taylor") : "taylor_selected";
  std::ofstream(output / (stem + ".md")) << text;
  draw(figure(runs), output / (stem + ".png"));
  fmt::print("\nfigure: {}\n", (output / (stem + ".png")).string());
  return std::all_of(statements.begin(), statements.end(), [](const Check& c) { return c.holds(); }) ? 0 : 1;
}

}  // namespace
}  // namespace brisance::simulator

int main(int argc, char** argv) {
  CLI::App app{"Taylor impacts against experiment."};
  std::vector<std::string> names;
  bool full = false, list = false;
  std::string output = "out/validation";
  app.add_option("NAME", names, "runs to make; all of the standard set if none is given");
  app.add_flag("--full", full, "refinement, friction and three dimensions as well");
  app.add_flag("--list", list, "names of all runs");
  app.add_option("-o,--output", output, "directory for runs, table and figure");
  CLI11_PARSE(app, argc, argv);
  try {
    if (list) {
      for (const auto& e : brisance::simulator::entries())
        fmt::print("{:46} {}, {}{}\n", e.name, e.test, e.label(), e.full() ? "  (full)" : "");
      return 0;
    }
    return brisance::simulator::run_all(names, full, output);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
