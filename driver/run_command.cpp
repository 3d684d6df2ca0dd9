#include "driver/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "driver/commands.hpp"
#include "driver/follow.hpp"
#include "driver/path_reader.hpp"
#include "driver/plot.hpp"
#include "driver/rate_form.hpp"
#include "driver/sweep.hpp"
#include "models/programs/progress.hpp"

namespace brisance::driver {
namespace {

std::string ending_text(const Outcome& outcome) {
  switch (outcome.ending) {
    case Ending::completed:
      return outcome.failure == FailureCause::none ? "completed"
                                                   : fmt::format("completed; the point failed by {} at {:.6g} s",
                                                                 describe(outcome.failure), outcome.failure_time);
    case Ending::failure:
      return fmt::format("stopped: the point failed by {} at {:.6g} s", describe(outcome.failure), outcome.failure_time);
    case Ending::interrupted:
      return "interrupted";
  }
  return {};
}

void print_end(const PointCase& point, const Outcome& outcome, double wall_time) {
  const State<double>& s = outcome.state;
  const std::string rejected = point.path.tolerance > 0.0 ? fmt::format(" ({} rejected)", outcome.rejected) : "";
  fmt::print("{}\n  material: {}\n  {}; {} steps{}, {} updates, {:.2f} s\n", point.path.title, point.file.material.name,
             ending_text(outcome), outcome.steps, rejected, outcome.updates, wall_time);
  fmt::print("  time {:.6g} s, temperature {:.2f} K, density {:.2f} kg/m^3, pressure {:.6g} MPa\n", outcome.time, s.temperature,
             s.density, -trace(s.stress) / 3e6);
  fmt::print("  stress (MPa): xx {:.6g}, yy {:.6g}, zz {:.6g}, yz {:.6g}, xz {:.6g}, xy {:.6g}; equivalent {:.6g}\n",
             s.stress.xx / 1e6, s.stress.yy / 1e6, s.stress.zz / 1e6, s.stress.yz / 1e6, s.stress.xz / 1e6, s.stress.xy / 1e6,
             equivalent_stress(deviator(s.stress)) / 1e6);
  fmt::print("  plastic strain {:.6g}, porosity {:.6g}, damage {:.6g}\n", s.plastic_strain, s.porosity, s.damage);
}

/// The rate form along the steps that were taken, against the update.
void print_reference(const PointCase& point, const Outcome& outcome) {
  Material material = point.file.material;
  if (point.path.heat != Heat::adiabatic) material.heating.reset();
  const State<double> reference = integrate_rate_form(material, outcome.start, outcome.taken);
  fmt::print("  differences from the rate form, integrated with error control along the same path:\n");
  for (const Difference& d : differences(outcome.state, reference)) fmt::print("    {:22} {:9.2e}\n", d.quantity, d.relative);
}

struct Done {
  Outcome outcome;
  Record record;
};

/// Follows the path; what is known of the history is written even when the run ends early.
Done follow_and_write(const PointCase& point, const RunOptions& options, const std::filesystem::path& output) {
  History history(point.file.material, point.path.output);
  ProgressLine progress;
  const Watcher watcher = [&](std::size_t segment, double time, long step) {
    progress.show(fmt::format("segment {} of {}, step {}, time {:.4g} s", segment, point.path.segments.size(), step, time));
    return !interrupt_requested();
  };
  const auto keep = [&] {
    if (!output.empty()) write(history.record(), output);
  };
  Outcome outcome;
  try {
    outcome = follow(point.file.material, point.path, history, {watcher, options.reference});
  } catch (const RunError& error) {
    keep();
    if (output.empty()) throw;
    throw RunError(fmt::format("{}\nThe history up to there: {}", error.what(), output.string()));
  }
  keep();
  return {std::move(outcome), history.record()};
}

int run_one(const RunOptions& options) {
  const PointCase point = read_case(options.file, options.overrides);
  const auto begin = std::chrono::steady_clock::now();
  const Done done = follow_and_write(point, options, options.output);
  print_end(point, done.outcome, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  if (options.reference) print_reference(point, done.outcome);
  if (!options.output.empty()) fmt::print("  history: {}\n", options.output.string());
  if (!options.figure.empty()) {
    draw(figure_of(point.path.title, {{"", &done.record}}, point.path.x, point.path.y), options.figure);
    fmt::print("  figure: {}\n", options.figure.string());
  }
  return done.outcome.ending == Ending::interrupted ? interrupted : ExitCode::done;
}

int run_sweep(const RunOptions& options, std::vector<SweptValues> members) {
  // Every member is read before the first one runs: a mistake in the last one shows at once.
  std::vector<PointCase> points;
  std::size_t width = 8;
  for (SweptValues& values : members) {
    std::vector<std::string> overrides = options.overrides;
    for (const SweptValue& v : values) overrides.push_back(v.key + "=" + v.text);
    points.push_back(read_case(options.file, overrides));
    find_units(values, points.back().file.material);
    width = std::max(width, name_of(values).size());
  }
  fmt::print("{}: {} members\n", points.front().path.title, members.size());
  fmt::print("  {:{}}  {:>13}  {:>13}  {:>11}  {:>11}  {}\n", "member", width, points.front().path.x, "stress, MPa", "temp., K",
             "plastic", "ending");
  std::vector<SweepMember> results;
  const auto keep = [&] {
    if (options.output.empty() || results.empty()) return;
    write_sweep(results, options.output);
    fmt::print("  histories: {}\n", options.output.string());
  };
  bool was_interrupted = false;
  for (std::size_t m = 0; m < members.size() && !was_interrupted; ++m) {
    try {
      Done done = follow_and_write(points[m], options, {});
      results.push_back({members[m], std::move(done.record)});
      const Outcome& outcome = done.outcome;
      was_interrupted = outcome.ending == Ending::interrupted;
      fmt::print("  {:{}}  {:13.6g}  {:13.6g}  {:11.2f}  {:11.5g}  {}\n", name_of(members[m]), width,
                 results.back().record.find(points[m].path.x)->values.back(),
                 equivalent_stress(deviator(outcome.state.stress)) / 1e6, outcome.state.temperature,
                 outcome.state.plastic_strain, ending_text(outcome));
    } catch (const RunError& error) {
      keep();
      throw RunError(fmt::format("{}: {}", name_of(members[m]), error.what()));
    }
  }
  keep();
  if (!options.figure.empty()) {
    std::vector<std::pair<std::string, const Record*>> runs;
    for (const SweepMember& member : results) runs.emplace_back(name_of(member.values), &member.record);
    draw(figure_of(points.front().path.title, runs, points.front().path.x, points.front().path.y), options.figure);
    fmt::print("  figure: {}\n", options.figure.string());
  }
  return was_interrupted ? interrupted : ExitCode::done;
}

}  // namespace

int run(const RunOptions& options) {
  catch_interrupts();
  const std::vector<SweptValues> members = read_sweep(options.file);
  if (members.empty())
    require_place_for(options.output, {".csv", ".h5", ".hdf5"});
  else
    require_sweep_output(options.output);
  require_place_for(options.figure, {".png", ".svg"});
  return members.empty() ? run_one(options) : run_sweep(options, members);
}

}  // namespace brisance::driver
