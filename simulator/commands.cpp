#include "simulator/commands.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cstdio>

#include "models/input/diagnostics.hpp"
#include "models/input/material_folders.hpp"
#include "models/input/table_reader.hpp"
#include "models/input/units.hpp"
#include "models/programs/command_line.hpp"
#include "models/programs/laws.hpp"
#include "models/programs/progress.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/describe.hpp"
#include "simulator/dry_run.hpp"
#include "simulator/keys.hpp"
#include "simulator/memory_need.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "simulator/set_up_warnings.hpp"
#include "simulator/setup.hpp"

namespace brisance::simulator {
namespace {

using Path = std::filesystem::path;

constexpr const char* set_help =
    "replace a value: cell_size=1e-3, \"solid.0.material.flow_stress.A=95 MPa\"; list elements count from 0, and a list with "
    "texts stands in single quotes: 'solid.0.velocity=[0, \"-210 m/s\"]'";

struct Options {
  Path file, directory;
  std::vector<std::string> overrides;
  int threads = 0;  // 0: as OpenMP chooses
  bool overwrite = false;
  std::string until;  // a time in s, or with a unit
  std::string key;
};

int tell(const RunResult& result, const Path& directory) {
  if (result.ending == Ending::nothing_left) {
    fmt::print("{}\n", result.message);
    return done;
  }
  fmt::print("{}  files: {}\n", in_words(result.summary), directory.string());
  switch (result.ending) {
    case Ending::failed:
      std::fflush(stdout);
      fmt::print(stderr, "{}\npictures of what was reached: brisance report {}\n", result.message, directory.string());
      return failed_while_running;
    case Ending::interrupted:
      std::fflush(stdout);
      fmt::print(stderr, "interrupted; go on with: brisance resume {0}\npictures of what was reached: brisance report {0}\n",
                 directory.string());
      return interrupted;
    default:
      return done;
  }
}

/// A simulation from a case. What a shape makes impossible is as bad as a wrong word in the file, and so is what does not fit
/// into memory.
Simulation set_up_or_refuse(const Case& c) {
  require_memory(c, available_memory());
  try {
    return set_up(c);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(fmt::format("{}: {}", c.file.string(), error.what()));
  }
}

int run_case(const Options& o) {
  const Path file = find_case(o.file);
  const Case c = read_case(file, o.overrides);
  const Path directory = o.directory.empty() ? Path(file.stem().string() + "_run") : o.directory;
  Simulation s = set_up_or_refuse(c);
  use_threads(o.threads, s);
  prepare_directory(directory, c, o.overwrite);
  const std::vector<std::string> warnings = set_up_warnings(c);
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
  catch_interrupts();
  return tell(run(c, s, {.directory = directory, .until = std::nullopt, .warnings = warnings}), directory);
}

Case case_of_run(const Path& directory, const std::vector<std::string>& overrides = {}) {
  if (!std::filesystem::exists(directory / "case.toml"))
    throw std::invalid_argument(fmt::format("{}: is no run: it holds no case.toml", directory.string()));
  return read_case(directory / "case.toml", overrides);
}

std::optional<double> until_time(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    const bool plain = text.find_first_not_of("0123456789.eE+-") == std::string::npos;
    return to_si(plain ? text + " s" : text, Unit::s);
  } catch (const UnitError& error) {
    throw std::invalid_argument(fmt::format("--until {}: {}{}", text, error.what(), error.hint));
  }
}

/// What would be wrong with a case that lasted so long: it is refused or warned of as `run` does.
void look_ahead(const Path& directory, double until) {
  for (const std::string& warning : set_up_warnings(case_of_run(directory, {fmt::format("end_time={:.17g}", until)})))
    fmt::print(stderr, "warning: {}\n", warning);
}

int resume_run(const Options& o) {
  const Case c = case_of_run(o.directory);
  const std::optional<double> until = until_time(o.until);
  if (until && !(*until > 0.0)) throw std::invalid_argument(fmt::format("--until {}: must be later than 0 s", o.until));
  const bool later = until && *until > c.end_time;
  constexpr double surprising = 10.0;
  if (later && *until > surprising * c.end_time)
    fmt::print(stderr, "warning: --until {} is {:.3g} s, {:.3g} times the end of the case; a number alone counts seconds\n",
               o.until, *until, *until / c.end_time);
  if (later) look_ahead(o.directory, *until);
  Simulation s = set_up_or_refuse(c);
  use_threads(o.threads, s);
  catch_interrupts();
  return tell(resume(c, s, {o.directory, until}), o.directory);
}

int report_run(const Options& o) {
  const Case c = case_of_run(o.directory);
  const std::optional<ToldEnding> told = read_ending(o.directory / "summary.json");
  const bool failed = told && told->ending == word_of(Ending::failed);
  if (failed) fmt::print(stderr, "this run failed at {:.6g} s: {}\n", told->time, told->message);
  Simulation s = set_up_or_refuse(c);
  const Summary summary = report(c, s, o.directory);
  fmt::print("{}", in_words(summary));
  std::fflush(stdout);
  if (!summary.message.empty()) fmt::print(stderr, "{}\n", summary.message);
  return failed || !summary.message.empty() ? failed_while_running : done;
}

int check_case(const Options& o) {
  const Case c = read_case(find_case(o.file), o.overrides);
  Simulation s = set_up_or_refuse(c);
  use_threads(o.threads, s);
  const DryRun dry = dry_run(c, s);
  fmt::print("{}\n{}", c.title, c.below_title().empty() ? "" : "  " + c.below_title() + '\n');
  const std::string_view point = name_of_points(s);
  fmt::print("  {:24} {:.9g} m\n", "cell size", c.cell_size);
  for (const DryRun::Points& p : dry.points) fmt::print("  {:24} {} {}\n", p.name, p.count, p.kind);
  for (const gas::FillReport& fill : dry.fills) fmt::print("  {:24} {}\n", fill.name, fill.words);
  fmt::print("  {:24} {:.1f} MB\n  {:24} {:.4g} s, limited by {}\n", "memory", dry.megabytes, "time step", dry.first_step,
             dry.limit);
  const int threads = omp_get_max_threads();
  fmt::print("  {:24} {:.3g}\n", "steps, an estimate", dry.steps);
  if (dry.nanoseconds > 0.0)
    fmt::print("  {:24} {:.0f} ns per {} and step, measured now with {} thread{}\n  {:24} {}\n", "speed", dry.nanoseconds,
               point, threads, threads == 1 ? "" : "s", "time, an estimate",
               dry.hours < 0.1 ? fmt::format("{:.1f} s", 3600.0 * dry.hours) : fmt::format("{:.2f} h", dry.hours));
  for (const std::string& warning : dry.warnings) fmt::print("  warning: {}\n", warning);
  return done;
}

/// Name and title of the cases that come with the program.
int list_cases() {
  for (const Path& file : bundled_cases()) {
    InputFile input = InputFile::load(file);
    TableReader top = input.top();
    // Others are of the point driver.
    if (top.has("cell_size")) fmt::print("{:36} {}\n", file.stem().string(), top.text_or("title", file.stem().string()));
  }
  fmt::print("`brisance run NAME` runs one of them; their files, to copy and change: {}\n",
             bundled_cases().front().parent_path().string());
  return done;
}

int list(const std::string& what) {
  if (what == "cases") return list_cases();
  const auto row = [](std::string_view title, auto&& names) { fmt::print("{}\n  {}\n", title, fmt::join(names, ", ")); };
  constexpr std::string_view of_materials = "materials that come with the program";
  std::vector<std::string> materials;
  for (const Path& file : bundled_materials()) materials.push_back(file.filename().string());
  if (what == "materials") {
    row(of_materials, materials);
    return done;
  }
  if (!what.empty()) {
    fmt::print(stderr, "list: {} is no list; give cases, materials, or nothing{}\n", in_quotes(what),
               did_you_mean(what, std::array<std::string_view, 2>{"cases", "materials"}));
    return bad_input;
  }
  row("geometries", choices<Geometry>), row("shapes", shape_forms), row("boundaries", choices<BoundaryKind>);
  row("gauges", choices<GaugeKind>), row("fields of gauges", gauge_fields), row("measures", choices<MeasureKind>);
  row("edges of gas", choices<EdgeKind>), row("sides of its box", choices<BoxSide>), row("fields of gas", gas_field_names());
  std::vector<std::string> reactions;
  for (const LawPage& law : all_laws())
    if (law.folder == "reaction") reactions.push_back(law.name);
  row("laws of reactions", reactions), row("schemes of gas", choices<GasScheme>), row("figures", choices<FigureKind>);
  row("basis functions", choices<Basis>), row("stress timings", choices<StressTiming>),
      row("particle velocities", choices<ParticleVelocity>);
  row(of_materials, materials);
  fmt::print(
      "`brisance describe NAME` explains these words and materials, the keys of a case file and the laws, which `pointdriver "
      "list` names; `brisance list cases` names the cases that come with the program\n");
  return done;
}

int describe_keys(const std::string& key) {
  if (key.empty()) {
    fmt::print("{}`brisance describe KEY` explains a key, `brisance list` names values\n", overview_of(all_keys()));
    return done;
  }
  std::string suggestion;
  const std::optional<std::string> laws = describe_laws(key, suggestion);
  std::optional<std::string> thing = describe_shape(key);
  if (!thing) thing = describe_formula(key);
  const std::vector<KeyDescription> found = thing ? std::vector<KeyDescription>{} : find_keys(all_keys(), key);
  if (!thing) thing = describe_material(key);
  if (!thing && found.empty() && !laws) thing = describe_case(key);
  if (found.empty() && !laws && !thing) {
    std::vector<std::string_view> names = names_of(all_keys());
    const std::vector<LawPage> pages = all_laws();
    const std::vector<std::string> materials = material_names();
    for (const LawPage& page : pages) names.push_back(page.name);
    names.insert(names.end(), shape_forms.begin(), shape_forms.end());
    names.insert(names.end(), materials.begin(), materials.end());
    names.push_back("formula");
    fmt::print(stderr,
               "describe: \"{}\" is no key of a case file, no value of one, no shape, no law and no material that comes with "
               "the program{}\n",
               key, did_you_mean(key, names));
    return bad_input;
  }
  if (thing) fmt::print("{}", *thing);
  for (const KeyDescription& k : found) {
    fmt::print("{}", page_of(k));
    if (k.path == "gas.edge.kind") fmt::print("{}", describe_edges());
  }
  if (laws) fmt::print("{}{}", found.empty() ? "" : "\n", *laws);
  return done;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app{"Deformation, heating and failure of metal bodies under impact; gas dynamics, detonation."};
  app.name("brisance");
  app.set_version_flag("--version", "brisance " BRISANCE_VERSION);
  app.require_subcommand(1);
  int code = done;
  Options o;
  const auto add_threads = [&](CLI::App* command) {
    command
        ->add_option("--threads", o.threads,
                     "threads (if not given, OMP_NUM_THREADS or what pays); the results do not depend on it")
        ->check(CLI::Range(1, 4096));
  };
  const auto add_case = [&](CLI::App* command) {
    command->add_option("CASE", o.file, "case file (TOML), or a name of `brisance list cases`")->required()->type_name("");
    add_set(command, o.overrides, set_help);
    add_threads(command);
  };

  CLI::App* run_command = app.add_subcommand("run", "Simulate a case");
  add_case(run_command);
  run_command->add_option("-o,--output", o.directory, "directory of the run (default: CASE_run)")->type_name("DIR");
  run_command->add_flag("--overwrite", o.overwrite, "replace the run that is in that directory");
  run_command->callback([&] { code = run_case(o); });

  CLI::App* check_command = app.add_subcommand("check", "What a case would take, and what looks wrong with it");
  add_case(check_command);
  check_command->callback([&] { code = check_case(o); });

  CLI::App* resume_command = app.add_subcommand("resume", "Go on with a run from its last checkpoint");
  resume_command->add_option("DIR", o.directory, "directory of the run")->required()->type_name("");
  resume_command
      ->add_option("--until", o.until,
                   "simulated time at which to end, in s or such as \"100 us\", instead of the case's; a later one becomes "
                   "the end of the case in DIR")
      ->type_name("TIME");
  add_threads(resume_command);
  resume_command->callback([&] { code = resume_run(o); });

  CLI::App* report_command = app.add_subcommand("report", "Measures and energies of a run; draws its figures again");
  report_command->add_option("DIR", o.directory, "directory of the run")->required()->type_name("");
  report_command->callback([&] { code = report_run(o); });

  CLI::App* list_command = app.add_subcommand("list", "Materials, shapes, boundaries, fields, laws of reactions; cases");
  list_command->add_option("WHAT", o.key, "`cases` or `materials`: those that come with the program")->type_name("");
  list_command->callback([&] { code = list(o.key); });

  CLI::App* describe_command =
      app.add_subcommand("describe", "What a key of a case file, one of its values, a shape, a law or a material is");
  describe_command
      ->add_option("KEY", o.key,
                   "path or last name of a key, a table, a value, a shape, a law, or a material; without it all keys")
      ->type_name("");
  describe_command->callback([&] { code = describe_keys(o.key); });

  return exit_code_of([&] { return parse(app, argc, argv) ? code : bad_input; });
}

}  // namespace brisance::simulator
