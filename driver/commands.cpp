#include "driver/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "driver/calibrate.hpp"
#include "driver/check.hpp"
#include "driver/compare.hpp"
#include "driver/laws.hpp"
#include "driver/run_command.hpp"
#include "models/input/diagnostics.hpp"

namespace brisance::driver {
namespace {

int list() {
  fmt::print("{}", list_laws());
  return done;
}

int describe(const std::string& name) {
  std::string suggestion;
  if (const auto text = describe_laws(name, suggestion)) {
    fmt::print("{}", *text);
    return done;
  }
  fmt::print(stderr, "describe: \"{}\" is no law{}; `pointdriver list` shows all\n", name, suggestion);
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
  run_command->add_option("PATH", options.file, "path file (TOML)")->required();
  run_command->add_option("--set", options.overrides, "replace a value: key.0.key=value")->allow_extra_args(false);
  run_command->add_option("-o,--output", options.output, "history.csv or .h5; for a sweep a directory");
  run_command->add_option("--plot", options.figure, "figure, .png or .svg");
  run_command->add_flag("--reference", options.reference, "compare with the rate form, integrated with error control");
  run_command->callback([&] { code = run(options); });

  CompareOptions comparison;
  CLI::App* compare_command = app.add_subcommand("compare", "Measured stress-strain curves against material models");
  compare_command->add_option("CASE", comparison.file, "comparison file (TOML)")->required();
  compare_command->add_option("--set", comparison.overrides, "replace a value: key.0.key=value")->allow_extra_args(false);
  compare_command->add_option("-o,--output", comparison.output,
                              "NAME.csv of the errors of each test; NAME_points.csv goes beside it");
  compare_command->add_option("--plot", comparison.figures, "figure, .png or .svg; may be given twice")
      ->allow_extra_args(false);
  compare_command->callback([&] { code = run_comparison(comparison); });

  app.add_subcommand("list", "All laws, folder by folder")->callback([&] { code = list(); });

  CalibrateOptions calibration;
  CLI::App* calibrate_command = app.add_subcommand("calibrate", "Parameters of a material from measured flow curves");
  calibrate_command->add_option("FIT", calibration.file, "calibration file (TOML)")->required();
  calibrate_command->add_option("--set", calibration.overrides, "replace a value: key.0.key=value")->allow_extra_args(false);
  calibrate_command->add_option("-o,--output", calibration.output, "material file with the parameters found");
  calibrate_command->add_option("--plot", calibration.figures, "figure, .png or .svg; may be given twice")
      ->allow_extra_args(false);
  calibrate_command->callback([&] { code = run_calibration(calibration); });

  std::vector<std::filesystem::path> materials;
  CLI::App* check_command = app.add_subcommand("check", "Material files against the analytical limits of their laws");
  check_command->add_option("FILE", materials, "material files (default: all that come with the program)");
  check_command->callback([&] { code = run_check(materials); });

  std::string law;
  CLI::App* describe_command = app.add_subcommand("describe", "Equation, source and parameters of a law");
  describe_command->add_option("LAW", law, "name, folder/name, or folder")->required();
  describe_command->callback([&] { code = describe(law); });

  return exit_code_of([&] {
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? static_cast<int>(done) : bad_input;
    }
    return code;
  });
}

}  // namespace brisance::driver
