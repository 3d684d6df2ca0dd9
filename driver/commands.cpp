#include "driver/commands.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "driver/calibrate.hpp"
#include "driver/check.hpp"
#include "driver/compare.hpp"
#include "driver/keys.hpp"
#include "driver/run_command.hpp"
#include "models/input/diagnostics.hpp"
#include "models/input/material_folders.hpp"
#include "models/programs/command_line.hpp"
#include "models/programs/laws.hpp"

namespace brisance::driver {
namespace {

constexpr const char* set_help =
    "replace a value: segment.0.strain_rate=-5000, \"material.flow_stress.A=95 MPa\"; list elements count from 0, and a list "
    "with texts stands in single quotes: 'key=[0, \"1 mm\"]'";

int list() {
  fmt::print("LAWS of materials\n\n{}\n", list_laws());
  for (const FileKind& kind : file_kinds())
    fmt::print("KEYS of a {} (pointdriver {})\n\n{}\n", kind.name, kind.command, overview_of(kind.keys));
  fmt::print("`pointdriver describe NAME` explains a law, a key, or a value of a key\n");
  return done;
}

/// Laws and keys of this name.
int describe(const std::string& name) {
  std::string pages, suggestion;
  std::vector<std::string_view> names;
  if (const auto laws = describe_laws(name, suggestion)) pages = *laws;
  for (const FileKind& kind : file_kinds()) {
    const std::vector<KeyDescription> found = find_keys(kind.keys, name);
    if (!found.empty()) pages += fmt::format("{}{}\n\n", pages.empty() ? "" : "\n", kind.name);
    for (const KeyDescription& key : found) pages += page_of(key);
    const auto known = names_of(kind.keys);
    names.insert(names.end(), known.begin(), known.end());
  }
  if (!pages.empty()) {
    fmt::print("{}", pages);
    return done;
  }
  if (suggestion.empty()) suggestion = did_you_mean(name, names);
  fmt::print(stderr, "describe: \"{}\" is no law and no key{}; `pointdriver list` shows all\n", name, suggestion);
  return bad_input;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app{"One material point along a loading path."};
  app.name("pointdriver");
  app.require_subcommand(1);
  int code = done;

  RunOptions options;
  CLI::App* run_command = app.add_subcommand("run", "Follow a path file, or every member of its sweep");
  run_command->add_option("PATH", options.file, "path file (TOML)")->required()->type_name("");
  add_set(run_command, options.overrides, set_help);
  run_command->add_option("-o,--output", options.output, "history: NAME.csv or NAME.h5; for a sweep also a directory")
      ->type_name("FILE");
  run_command->add_option("--plot", options.figure, "figure, .png or .svg")->type_name("FILE");
  run_command->add_flag("--reference", options.reference, "compare with the rate form, integrated with error control");
  run_command->callback([&] {
    options.file = find_case(options.file);
    code = run(options);
  });

  CompareOptions comparison;
  CLI::App* compare_command = app.add_subcommand("compare", "Measured stress-strain curves against material models");
  compare_command->add_option("CASE", comparison.file, "comparison file (TOML)")->required()->type_name("");
  add_set(compare_command, comparison.overrides, set_help);
  compare_command
      ->add_option("-o,--output", comparison.output, "NAME.csv of the errors of each test; NAME_points.csv goes beside it")
      ->type_name("FILE");
  compare_command->add_option("--plot", comparison.figures, "figure, .png or .svg; may be given twice")
      ->type_name("FILE")
      ->allow_extra_args(false);
  compare_command->callback([&] {
    comparison.file = find_case(comparison.file);
    code = run_comparison(comparison);
  });

  app.add_subcommand("list", "All laws, folder by folder, and all keys of input files")->callback([&] { code = list(); });

  CalibrateOptions calibration;
  CLI::App* calibrate_command = app.add_subcommand("calibrate", "Parameters of a material from measured flow curves");
  calibrate_command->add_option("FIT", calibration.file, "calibration file (TOML)")->required()->type_name("");
  add_set(calibrate_command, calibration.overrides, set_help);
  calibrate_command->add_option("-o,--output", calibration.output, "material file with the parameters found")
      ->type_name("FILE");
  calibrate_command->add_option("--plot", calibration.figures, "figure, .png or .svg; may be given twice")
      ->type_name("FILE")
      ->allow_extra_args(false);
  calibrate_command->callback([&] {
    calibration.file = find_case(calibration.file);
    code = run_calibration(calibration);
  });

  std::vector<std::filesystem::path> materials;
  CLI::App* check_command = app.add_subcommand("check", "Material files against the analytical limits of their laws");
  check_command->add_option("FILE", materials, "material files (default: all that come with the program)")->type_name("");
  check_command->callback([&] { code = run_check(materials); });

  std::string law;
  CLI::App* describe_command =
      app.add_subcommand("describe", "A law: equation, source, parameters. A key: meaning, unit, default, values");
  describe_command->add_option("NAME", law, "law, folder/law or folder; key or its path; without it all are listed")
      ->type_name("");
  describe_command->callback([&] { code = law.empty() ? list() : describe(law); });

  return exit_code_of([&] { return parse(app, argc, argv) ? code : bad_input; });
}

}  // namespace brisance::driver
