#include "simulator/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "models/programs/files.hpp"
#include "models/programs/progress.hpp"
#include "simulator/gas/fill_reports.hpp"
#include "simulator/gas/foreseen_meetings.hpp"
#include "simulator/gas/rejection.hpp"
#include "simulator/gates.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/figures.hpp"
#include "simulator/output/gauges.hpp"
#include "simulator/output/grid_snapshot.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/output/snapshot.hpp"
#include "simulator/solid/stress.hpp"
#include "simulator/step_failure.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator {
namespace {

using Clock = std::chrono::steady_clock;
using Path = std::filesystem::path;

/// How often an interval fits into a time; what is due at a time depends on nothing else.
std::int64_t count(double time, double interval) {
  return interval > 0.0 ? static_cast<std::int64_t>(std::floor(time / interval)) : 0;
}

double megabytes_used() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Begins the line of the log which tells what had ended a run that was resumed.
constexpr std::string_view after = "resumed after ";
/// The gates that had ended a run before it was resumed, each once.
std::vector<std::string> gates_passed(const Path& directory) {
  std::vector<std::string> gates;
  for (const std::string& line : read_log(directory / "log.txt"))
    if (line.starts_with(std::string(after) + "gate ")) gates.push_back(line.substr(after.size()));
  std::sort(gates.begin(), gates.end());
  gates.erase(std::unique(gates.begin(), gates.end()), gates.end());
  return gates;
}

/// Begins the line of the log which tells when, in s, a gate that had ended a run is judged again: what resumes it may come to
/// its end before.
constexpr std::string_view again = "the gate that ended it is judged again at ";
/// The last such time; -1: never.
double gate_time_in(const Path& directory) {
  double time = -1.0;
  for (const std::string& line : read_log(directory / "log.txt"))
    if (line.starts_with(again)) time = std::strtod(line.c_str() + again.size(), nullptr);
  return time;
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(std::min(seconds, 3.6e8));
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60) : fmt::format("{}:{:02}", s / 60, s % 60);
}

/// Why a step was too large.
std::string why_rejected(const Simulation& s, double dt) {
  return s.gas.empty() ? worst_point(s, dt) : gas::why_rejected(s.gas);
}

/// What a summary tells of the state of a run.
void tell_state(Summary& summary, const Case& c, const Simulation& s, const Measures& measures, const Path& directory) {
  summary.title = c.title, summary.subtitle = c.below_title();
  summary.time = s.time, summary.steps = s.step, summary.particles = count_points(s);
  summary.threads = omp_get_max_threads();
  summary.books = books_of(s), summary.measures = measures.read(s), summary.failed = failed_particles(s);
  summary.in_contact = in_contact(s);
  if (!s.gas.empty()) summary.hottest = gas::hottest(s.gas);
  summary.not_gated = not_gated(c.gates, s), summary.resumed_after = gates_passed(directory);
  summary.other_experiment = other_experiment(c);
}

/// What a run writes, and when.
class Run {
 public:
  Run(const Case& c, Simulation& s, const RunOptions& options)
      : case_(lasting(c, options.until.value_or(0.0))),
        s_(s),
        options_(options),
        end_(options.until.value_or(c.end_time)),
        lasts_longer_(case_.end_time > c.end_time),
        log_(options.directory / "log.txt"),
        gauges_(case_, s),
        measures_(case_, s),
        row_interval_(row_interval(case_)) {}

  RunResult begin() {
    const int threads = omp_get_max_threads();
    const std::string subtitle = case_.below_title().empty() ? "" : ", " + case_.below_title();
    log_.line(fmt::format("{}{}: {} {}s, {} thread{}", case_.title, subtitle, count_points(s_), name_of_points(s_), threads,
                          threads == 1 ? "" : "s"));
    if (!s_.gas.empty())
      for (const gas::FillReport& fill : gas::fill_reports(case_, s_.gas)) log_.line(fill.name + ": " + fill.words);
    for (const std::string& warning : options_.warnings) log_.line("warning: " + warning);
    if (const std::string what = not_gated(case_.gates, s_); !what.empty()) log_.line("not gated: " + what);
    if (s_.gas.implicit)
      log_.line(
          "gas.implicit: pressures are found by iteration, so the last digits of the results may differ from machine to "
          "machine; nothing need be done about it");
    return guarded([&] {
      history_.emplace(options_.directory / "history.csv", books_of(s_), gauges_.columns(), 0);
      measures_.observe(s_);
      add_row();
      if (case_.output.snapshot_interval > 0.0) add_snapshot();
      loop();
    });
  }

  RunResult go_on() {
    if (!has_checkpoint(options_.directory)) {
      keep_later_end();
      log_.line("killed before its first checkpoint: starts again");
      return begin();
    }
    const Restored restored = restore_newest(options_.directory, s_, [&](const std::string& trouble) { log_.line(trouble); });
    const std::optional<ToldEnding> told = read_ending(options_.directory / "summary.json");
    const bool had_failed = told && told->ending == word_of(Ending::failed);
    const bool past_end = s_.time > end_ && !at(end_);
    if (past_end || (at(end_) && told && !had_failed)) return nothing_left();
    keep_later_end();
    log_.line(fmt::format("goes on from {}, step {}, time {:.6g} s", restored.file.string(), s_.step, s_.time));
    if (had_failed && told->message.starts_with("gate ")) log_.line(fmt::format("{}{} s", again, told->time));
    gate_time_ = gate_time_in(options_.directory);
    std::filesystem::remove(options_.directory / "summary.json");  // it told of the part before
    snapshot_times_ = restored.progress.snapshot_times;
    row_time_ = restored.progress.row_time;
    measures_.restore(restored.progress.measures);
    last_checkpoint_ = restored.file;
    return guarded([&] {
      history_.emplace(options_.directory / "history.csv", books_of(s_), gauges_.columns(), restored.progress.history_rows);
      // A run that a gate has ended does not go on past it: its last row is judged again, by the gates as they are now.
      if (row_time_ == s_.time) check_gates(case_.gates, s_, books_of(s_));
      if (had_failed) log_.line(std::string(after) + told->message.substr(0, told->message.find('\n')));
      loop();
    });
  }

 private:
  /// Runs, and turns whatever happens into a result.
  template <class F>
  RunResult guarded(F&& f) {
    RunResult result;
    started_ = progress_time_ = Clock::now();
    first_step_ = s_.step;
    try {
      f();
      result.ending = interrupted_ ? Ending::interrupted : Ending::done;
    } catch (const std::exception& error) {
      result.ending = Ending::failed;
      const bool good = dynamic_cast<const StepFailure*>(&error) != nullptr;
      result.message = dynamic_cast<const std::bad_alloc*>(&error) ? "there is not enough memory" : error.what();
      result.message += foreseen_by_now() + "\n" + keep_last_state(good);
      if (dynamic_cast<const GateExceeded*>(&error))
        result.message += fmt::format("\nto go on all the same, raise the limit under [gates] in {} and resume",
                                      (options_.directory / "case.toml").string());
    }
    progress_line_.reset();
    finish(result);
    return result;
  }

  /// What was to be foreseen of bodies in the gas, and ends a run, explains many a failure; a line for each.
  std::string foreseen_by_now() const {
    std::string text;
    try {
      Case whole = case_;
      whole.end_time = end_;
      for (const gas::ForeseenMeeting& meeting : gas::foreseen_meetings(whole))
        if (meeting.kind != gas::ForeseenMeeting::Kind::slides_along_body && meeting.time <= s_.time + 2.0 * s_.last_time_step)
          text += "\n" + in_words(meeting);
    } catch (const std::exception&) {  // it is no more than an explanation
    }
    return text;
  }

  /// Leaves the state of a run that has failed to be looked at, and says where. If it is `good` (as it was between two steps),
  /// or between two steps and there is no other, a checkpoint of it as well.
  std::string keep_last_state(bool good) {
    const bool whole = good || !within_step_;
    std::string kept;
    try {
      if (!whole || snapshot_times_.empty() || snapshot_times_.back() != s_.time) add_snapshot();
      kept = fmt::format("{} is in snapshot {:06} of {}; log.txt there tells the rest",
                         whole ? "the state at the end" : "the state within the step that failed, only to be looked at,",
                         snapshot_times_.size() - 1, options_.directory.string());
      if (history_ && (good || (whole && last_checkpoint_.empty()))) add_checkpoint();
    } catch (const std::exception& error) {
      log_.line(fmt::format("the state at the end could not be kept: {}", error.what()));
    }
    return (last_checkpoint_.empty() ? "no checkpoint has been written" : "last checkpoint: " + last_checkpoint_.string()) +
           (kept.empty() ? "" : "\n" + kept);
  }

  /// What goes on next ends at the later time, too.
  void keep_later_end() {
    if (lasts_longer_) replace_case(options_.directory, case_);
  }

  RunResult nothing_left() {
    RunResult result;
    result.ending = Ending::nothing_left;
    result.message = fmt::format(
        "{0}: nothing was left to do: the run has come to {1:.6g} s, and {2} is at {3:.6g} s{4}. To go on, name a later time: "
        "brisance resume {0} --until \"{5:.6g} s\"",
        options_.directory.string(), s_.time, options_.until ? "--until" : "its end", end_, at(end_) ? "" : ", before that",
        2.0 * s_.time);
    return result;
  }

  void loop() {
    last_checkpoint_time_ = Clock::now();
    while (!at_end()) {
      if (interrupt_requested() || s_.step - first_step_ >= options_.most_steps) {
        interrupted_ = true;
        break;
      }
      const double before = s_.time;
      within_step_ = true;
      advance_one_step();
      within_step_ = false;
      measures_.observe(s_);
      const bool gate_is_due = before < gate_time_ && gate_time_ <= s_.time;
      if (count(s_.time, row_interval_) > count(before, row_interval_) || gate_is_due) add_row();
      if (count(s_.time, case_.output.snapshot_interval) > count(before, case_.output.snapshot_interval)) add_snapshot();
      if (checkpoint_is_due(before)) add_checkpoint();
      show_progress();
    }
    if (!interrupted_) {
      if (row_time_ != s_.time) add_row();
      if (snapshot_times_.empty() || snapshot_times_.back() != s_.time) add_snapshot();
    }
    add_checkpoint();
  }

  /// Times are sums of steps: the last one may miss the end by rounding.
  bool at(double time) const {
    constexpr double rounding = 1e-12;
    return std::abs(time - s_.time) <= rounding * time;
  }
  bool at_end() const { return s_.time > end_ || at(end_); }

  void advance_one_step() {
    StepSize size = next_step(s_, case_.numerics, end_);
    for (int rejections = 0;; ++rejections, size.dt *= 0.5) {
      if (is_too_small(size) || (rejections > 0 && size.dt < smallest_step()))
        throw StepFailure(fmt::format(
            "step {} at {:.6g} s would have to be {:.4g} s{}; it is limited by {}{}", s_.step + 1, s_.time, size.dt,
            case_.numerics.least_step > 0.0 ? fmt::format(", less than {:.4g} s", case_.numerics.least_step) : "", size.limit,
            rejections > 0 ? fmt::format(", and larger ones were rejected; {}", why_rejected(s_, 2.0 * size.dt)) : ""));
      if (advance(s_, size.dt) == StepOutcome::done) return;
      constexpr int most_lines = 100;
      if (++rejections_ <= most_lines)
        log_.line(fmt::format("step {} at {:.6g} s: {:.4g} s are too much, half is tried; {}", s_.step + 1, s_.time, size.dt,
                              why_rejected(s_, size.dt)));
    }
  }

  bool is_too_small(const StepSize& size) const {
    return !(size.dt > 0.0) || !std::isfinite(size.dt) || (size.dt < case_.numerics.least_step && size.limit != last_steps);
  }

  /// After rejections a millionth of what waves and motion allow. Each step may be rejected a few times only, and yet the steps
  /// come to an end: towards the end of an equation of state's range they halve again and again.
  double smallest_step() const {
    NumericsConfig at_once = case_.numerics;
    at_once.growth = std::numeric_limits<double>::infinity();
    return 1e-6 * next_step(s_, at_once, end_).dt;
  }

  void add_row() {
    const Books books = books_of(s_);
    history_->add_row(s_, books, gauges_.read(s_));
    row_time_ = s_.time;
    check_gates(case_.gates, s_, books);
  }

  void add_snapshot() {
    std::vector<double> times = snapshot_times_;
    times.push_back(s_.time);
    write_snapshot(options_.directory, s_, times);
    if (case_.output.grid && !s_.bodies.empty()) write_grid_snapshot(options_.directory, solid_grid, solid_image(s_), times);
    if (!s_.gas.empty()) write_grid_snapshot(options_.directory, gas_grid, gas_image(s_), times);
    snapshot_times_ = std::move(times);  // what could not be written is none
  }

  bool checkpoint_is_due(double before) const {
    const OutputConfig& o = case_.output;
    return count(s_.time, o.checkpoint_interval) > count(before, o.checkpoint_interval) ||
           (o.checkpoint_steps > 0 && s_.step % o.checkpoint_steps == 0) ||
           std::chrono::duration<double>(Clock::now() - last_checkpoint_time_).count() > o.checkpoint_wall;
  }
  void add_checkpoint() {
    history_->synchronise();
    last_checkpoint_ = write_checkpoint(options_.directory, s_,
                                        {log_.wall_time(), history_->rows(), row_time_, snapshot_times_, measures_.numbers()});
    last_checkpoint_time_ = Clock::now();
    log_.line(fmt::format("step {}, time {:.6g} s, time step {:.4g} s: checkpoint {}", s_.step, s_.time, s_.last_time_step,
                          last_checkpoint_.filename().string()));
  }

  void show_progress() {
    const auto now = Clock::now();
    const double since = std::chrono::duration<double>(now - progress_time_).count();
    if (since < 0.5) return;
    const double rate = static_cast<double>(s_.step - progress_step_) / since, speed = (s_.time - progress_simulated_) / since;
    progress_time_ = now, progress_step_ = s_.step, progress_simulated_ = s_.time;
    if (!progress_line_) progress_line_.emplace();
    progress_line_->show(fmt::format(
        "{:5.1f} %  {:.4g} s  step {} of {:.3g} s  {:.3g} steps/s  {:.3g} {}-steps/s  {} left  {:.0f} MB",
        100.0 * s_.time / end_, s_.time, s_.step, s_.last_time_step, rate, rate * static_cast<double>(count_points(s_)),
        name_of_points(s_), clock_text((end_ - s_.time) / speed), megabytes_used()));
  }

  /// What goes wrong from here on is told as well, but does not hide what went wrong before.
  void finish(RunResult& result) {
    try {
      summarise(result);
      write_summary(result.summary, options_.directory / "summary.json");
    } catch (const std::exception& error) {
      result.ending = Ending::failed;
      result.message += (result.message.empty() ? "" : "\n") + std::string(error.what());
      result.summary.ending = word_of(result.ending), result.summary.message = result.message;
    }
    log_.line(fmt::format("{} at step {}, time {:.6g} s{}{}", word_of(result.ending), s_.step, s_.time,
                          result.message.empty() ? "" : ": ", result.message));
    if (const auto& gas = result.summary.books.gas)
      for (const gas::RangeReport& report : gas->outside) log_.line("warning: " + in_words(report, s_.dimensions()));
    if (result.ending != Ending::done || !case_.output.figures) return;
    for (const std::string& trouble : draw_figures(case_, s_, options_.directory)) log_.line(trouble);
  }

  void summarise(RunResult& result) {
    const double seconds = std::chrono::duration<double>(Clock::now() - started_).count();
    Summary& summary = result.summary;
    summary.ending = word_of(result.ending), summary.message = result.message, summary.wall_time = log_.wall_time();
    tell_state(summary, case_, s_, measures_, options_.directory);
    summary.particle_steps_per_second = static_cast<double>((s_.step - first_step_) * count_points(s_)) / seconds;
    if (history_) summary.peaks = peaks_of(read_gauges(case_, options_.directory));
  }

  const Case case_;
  Simulation& s_;
  RunOptions options_;
  double end_;
  bool lasts_longer_;  // than the case in the directory
  Log log_;
  Gauges gauges_;
  Measures measures_;
  double row_interval_;
  std::optional<History> history_;
  std::vector<double> snapshot_times_;
  Path last_checkpoint_;
  double row_time_ = -1.0;
  double gate_time_ = -1.0;  // when a gate had ended the run, perhaps at a row of its own: there it is judged again
  bool interrupted_ = false;
  bool within_step_ = false;
  int rejections_ = 0;
  std::int64_t first_step_ = 0;
  Clock::time_point started_, last_checkpoint_time_, progress_time_;
  std::int64_t progress_step_ = 0;
  double progress_simulated_ = 0.0;
  std::optional<ProgressLine> progress_line_;
};

}  // namespace

std::int64_t count_points(const Simulation& s) {
  std::int64_t count = s.gas.empty() ? 0 : s.gas.cells.count();
  for (const Body& body : s.bodies) count += body.particles.size;
  return count;
}

std::string_view name_of_points(const Simulation& s) {
  return s.gas.empty() ? "particle" : "cell";
}

void use_threads(int threads, const Simulation& s) {
  // To wake one takes longer than a step of few points. On two threads 3840 particles and 10000 cells in the plane take as long
  // as on one, 400 cells on a line two to twelve times as long.
  constexpr std::int64_t points_per_thread = 8000;
  if (threads > 0)
    omp_set_num_threads(threads);
  else if (!std::getenv("OMP_NUM_THREADS"))
    omp_set_num_threads(
        static_cast<int>(std::clamp<std::int64_t>(count_points(s) / points_per_thread, 1, omp_get_num_procs())));
}

std::string word_of(Ending ending) {
  constexpr std::array words = {"done", "failed", "interrupted", "done"};
  return words[static_cast<std::size_t>(ending)];
}

RunResult run(const Case& c, Simulation& s, const RunOptions& options) {
  return Run(c, s, options).begin();
}

RunResult resume(const Case& c, Simulation& s, const RunOptions& options) {
  return Run(c, s, options).go_on();
}

Summary report(const Case& c, Simulation& s, const Path& directory) {
  Measures measures(c, s);
  const std::string ending = read_ending(directory / "summary.json").value_or(ToldEnding{"has no end yet", ""}).ending;
  const Of of = ending == word_of(Ending::failed) ? Of::failed_run : Of::good_run;
  std::vector<std::string> troubles;
  const Restored restored = restore_newest(directory, s, [&](const std::string& trouble) { troubles.push_back(trouble); });
  measures.restore(restored.progress.measures);
  Summary summary;
  tell_state(summary, c, s, measures, directory);
  summary.ending = ending + ", as of " + restored.file.filename().string();
  summary.wall_time = restored.progress.wall_time;
  for (auto& found :
       {damaged_snapshots(directory, c, restored.progress.snapshot_times.size()), draw_figures(c, s, directory, of)})
    troubles.insert(troubles.end(), found.begin(), found.end());
  summary.message = fmt::format("{}", fmt::join(troubles, "\n"));
  return summary;
}

}  // namespace brisance::simulator
