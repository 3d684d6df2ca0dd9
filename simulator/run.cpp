#include "simulator/run.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "models/programs/files.hpp"
#include "models/programs/progress.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/figures.hpp"
#include "simulator/output/gauges.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/output/snapshot.hpp"
#include "simulator/solid/worst_particle.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator {
namespace {

using Clock = std::chrono::steady_clock;
using Path = std::filesystem::path;

/// The run cannot go on; what() says why.
struct RunFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

double courant_number(const Simulation& s, const NumericsConfig& n) {
  if (n.courant > 0.0) return n.courant;
  if (n.stress_timing == StressTiming::usl) return 0.3;
  return s.dimensions() == 3 ? 0.4 : 0.5;
}

std::int64_t count_particles(const Simulation& s) {
  std::int64_t count = 0;
  for (const Body& body : s.bodies) count += body.particles.size;
  return count;
}

/// What limits the steps that end a run: they may be as small as they have to be.
constexpr std::string_view last_steps = "the end of the run";

/// How often an interval fits into a time; what is due at a time depends on nothing else.
std::int64_t count(double time, double interval) {
  return interval > 0.0 ? static_cast<std::int64_t>(std::floor(time / interval)) : 0;
}

double megabytes_used() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(std::min(seconds, 3.6e8));
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60) : fmt::format("{}:{:02}", s / 60, s % 60);
}

double magnitude(const Vector& v) {
  return std::sqrt(dot(v, v));
}

/// Stops a run whose books do not close, or that is out of bounds.
class Gates {
 public:
  explicit Gates(const GateConfig& limits) : limits_(limits) {}

  void check(const Simulation& s, const Books& books) const {
    const Balance& b = books.balance;
    // A body at rest that is loaded has no kinetic energy to speak of, but takes up energy all the same.
    const double energy = std::max(books.peak_kinetic, std::abs(b.internal - books.initial_internal));
    // Energies of the particles are kept as totals: every step rounds them.
    const double rounding =
        std::numeric_limits<double>::epsilon() * std::abs(b.internal) * std::sqrt(static_cast<double>(s.step + 1));
    require("residual", "energy that is in no book", b.residual, limits_.residual * energy + rounding, "J", s);
    const double momentum = std::sqrt(2.0 * (books.mass + books.outflow_mass) * energy) + magnitude(books.boundary_momentum) +
                            magnitude(books.external_momentum);
    require("residual", "momentum that is in no book", magnitude(b.momentum_residual), limits_.residual * momentum, "kg m/s",
            s);
    require("residual", "angular momentum that is in no book", magnitude(b.angular_momentum_residual),
            limits_.residual * momentum * reach(s), "kg m^2/s", s);
    require("numerical", "energy in numerical books", std::abs(b.numerical()), limits_.numerical * energy, "J", s);
    check_fastest(s);
  }

 private:
  static void require(std::string_view gate, std::string_view what, double value, double limit, std::string_view unit,
                      const Simulation& s) {
    if (value <= limit) return;
    throw RunFailure(fmt::format("gate {}: {} is {:.6g} {}, {:.6g} {} at most is allowed; step {}, time {:.6g} s", gate, what,
                                 value, unit, limit, unit, s.step, s.time));
  }
  static double reach(const Simulation& s) {
    double farthest = 0.0;
    for (const Boundary& b : s.boundaries)  // what has left was booked there
      if (b.kind == BoundaryKind::outflow) farthest = std::max(farthest, std::abs(b.position));
    for_each(s, [&](const Body&, const ParticleView& p) { farthest = std::max(farthest, magnitude(p.position())); });
    return farthest + s.grid.cell_size;
  }
  void check_fastest(const Simulation& s) const {
    for_each(s, [&](const Body& body, const ParticleView& p) {
      if (magnitude(p.velocity()) <= limits_.fastest) return;
      const Vector x = p.position();
      throw RunFailure(
          fmt::format("gate fastest: a particle of {} at ({:.6g}, {:.6g}, {:.6g}) m moves at {:.6g} m/s, {:.6g} m/s at most is "
                      "allowed; step {}, time {:.6g} s",
                      body.name, x[0], x[1], x[2], magnitude(p.velocity()), limits_.fastest, s.step, s.time));
    });
  }
  template <class F>
  static void for_each(const Simulation& s, F&& f) {
    for (const Body& body : s.bodies)
      for (int p = 0; p < body.particles.size; ++p) f(body, ParticleView(body.particles, p));
  }

  GateConfig limits_;
};

/// What a run writes, and when.
class Run {
 public:
  Run(const Case& c, Simulation& s, const RunOptions& options)
      : case_(c),
        s_(s),
        options_(options),
        end_(options.until.value_or(c.end_time)),
        log_(options.directory / "log.txt"),
        gauges_(c, s),
        measures_(c, s),
        gates_(c.gates),
        row_interval_(c.output.history_interval > 0.0 ? c.output.history_interval : c.end_time / 500.0) {}

  RunResult begin() {
    log_.line(fmt::format("{}: {} particles, {} threads", case_.title, count_particles(s_), omp_get_max_threads()));
    return guarded([&] {
      history_.emplace(options_.directory / "history.csv", books_of(s_), gauges_.columns(), 0);
      add_row();
      if (case_.output.snapshot_interval > 0.0) add_snapshot();
      loop();
    });
  }

  RunResult go_on() {
    if (!has_checkpoint(options_.directory)) {
      log_.line("killed before its first checkpoint: starts again");
      return begin();
    }
    const Restored restored = restore_newest(options_.directory, s_, [&](const std::string& trouble) { log_.line(trouble); });
    log_.set_wall_time_before(restored.progress.wall_time);
    log_.line(fmt::format("goes on from {}, step {}, time {:.6g} s", restored.file.string(), s_.step, s_.time));
    snapshot_times_ = restored.progress.snapshot_times;
    row_time_ = restored.progress.row_time;
    last_checkpoint_ = restored.file;
    return guarded([&] {
      history_.emplace(options_.directory / "history.csv", books_of(s_), gauges_.columns(), restored.progress.history_rows);
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
      if (dynamic_cast<const RunFailure*>(&error)) keep_last_state();
      result.message = fmt::format(
          "{}\n{}", error.what(),
          last_checkpoint_.empty() ? "no checkpoint has been written" : "last checkpoint: " + last_checkpoint_.string());
    }
    progress_line_.reset();
    finish(result);
    return result;
  }

  /// A run fails between two steps: the state is good, and what is wrong with it can be looked at.
  void keep_last_state() {
    try {
      if (snapshot_times_.empty() || snapshot_times_.back() != s_.time) add_snapshot();
      add_checkpoint();
    } catch (const std::exception& error) {
      log_.line(error.what());
    }
  }

  void loop() {
    last_checkpoint_time_ = Clock::now();
    while (!at_end()) {
      if (interrupt_requested() || s_.step - first_step_ >= options_.most_steps) {
        interrupted_ = true;
        break;
      }
      const double before = s_.time;
      advance_one_step();
      if (count(s_.time, row_interval_) > count(before, row_interval_)) add_row();
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
  bool at_end() const {
    constexpr double rounding = 1e-12;
    return end_ - s_.time <= rounding * end_;
  }

  void advance_one_step() {
    StepSize size = next_step(s_, case_.numerics, end_);
    constexpr int most_halvings = 20;
    for (int halvings = 0;; ++halvings, size.dt *= 0.5) {
      if (!(size.dt > 0.0) || !std::isfinite(size.dt) || (size.dt < case_.numerics.least_step && size.limit != last_steps) ||
          halvings > most_halvings)
        throw RunFailure(fmt::format(
            "step {} at {:.6g} s would have to be {:.4g} s{}; it is limited by {}{}", s_.step + 1, s_.time, size.dt,
            case_.numerics.least_step > 0.0 ? fmt::format(", less than {:.4g} s", case_.numerics.least_step) : "", size.limit,
            halvings > 0 ? fmt::format(", and was rejected {} times: {}", halvings, fastest_deforming(s_)) : ""));
      if (advance(s_, size.dt) == StepOutcome::done) return;
      constexpr int most_lines = 100;
      if (++rejections_ <= most_lines)
        log_.line(fmt::format("step {} at {:.6g} s: rejected with {:.4g} s, a particle would be deformed too much", s_.step + 1,
                              s_.time, size.dt));
    }
  }

  void add_row() {
    const Books books = books_of(s_);
    history_->add_row(s_, books, gauges_.read(s_));
    row_time_ = s_.time;
    gates_.check(s_, books);
  }

  void add_snapshot() {
    snapshot_times_.push_back(s_.time);
    write_snapshot(options_.directory, s_, snapshot_times_);
  }

  bool checkpoint_is_due(double before) const {
    const OutputConfig& o = case_.output;
    return count(s_.time, o.checkpoint_interval) > count(before, o.checkpoint_interval) ||
           (o.checkpoint_steps > 0 && s_.step % o.checkpoint_steps == 0) ||
           std::chrono::duration<double>(Clock::now() - last_checkpoint_time_).count() > o.checkpoint_wall;
  }
  void add_checkpoint() {
    last_checkpoint_ =
        write_checkpoint(options_.directory, s_, {log_.wall_time(), history_->rows(), row_time_, snapshot_times_});
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
    progress_line_->show(
        fmt::format("{:5.1f} %  {:.4g} s  step {} of {:.3g} s  {:.3g} steps/s  {:.3g} particle-steps/s  {} left  {:.0f} MB",
                    100.0 * s_.time / end_, s_.time, s_.step, s_.last_time_step, rate,
                    rate * static_cast<double>(count_particles(s_)), clock_text((end_ - s_.time) / speed), megabytes_used()));
  }

  void finish(RunResult& result) {
    constexpr std::array endings = {"done", "failed", "interrupted"};
    const double seconds = std::chrono::duration<double>(Clock::now() - started_).count();
    Summary& summary = result.summary;
    summary = {case_.title,
               endings[static_cast<std::size_t>(result.ending)],
               result.message,
               s_.time,
               s_.step,
               count_particles(s_),
               log_.wall_time(),
               static_cast<double>((s_.step - first_step_) * count_particles(s_)) / seconds,
               omp_get_max_threads(),
               books_of(s_),
               measures_.read(s_)};
    log_.line(fmt::format("{} at step {}, time {:.6g} s{}{}", summary.ending, s_.step, s_.time,
                          result.message.empty() ? "" : ": ", result.message));
    try {
      write_summary(summary, options_.directory / "summary.json");
    } catch (const std::exception& error) {
      result.ending = Ending::failed;
      result.message += (result.message.empty() ? "" : "\n") + std::string(error.what());
    }
    if (result.ending != Ending::done || !case_.output.figures) return;
    for (const std::string& trouble : draw_figures(case_, s_, options_.directory)) log_.line(trouble);
  }

  const Case& case_;
  Simulation& s_;
  RunOptions options_;
  double end_;
  Log log_;
  Gauges gauges_;
  Measures measures_;
  Gates gates_;
  double row_interval_;
  std::optional<History> history_;
  std::vector<double> snapshot_times_;
  Path last_checkpoint_;
  double row_time_ = -1.0;
  bool interrupted_ = false;
  int rejections_ = 0;
  std::int64_t first_step_ = 0;
  Clock::time_point started_, last_checkpoint_time_, progress_time_;
  std::int64_t progress_step_ = 0;
  double progress_simulated_ = 0.0;
  std::optional<ProgressLine> progress_line_;
};

}  // namespace

StepSize next_step(const Simulation& s, const NumericsConfig& numerics, double end_time) {
  const double h = s.grid.cell_size;
  const Extremes& e = s.extremes;
  StepSize size{std::numeric_limits<double>::infinity(), "nothing"};
  const auto limit = [&](double dt, std::string_view reason) {
    if (!(dt >= size.dt)) size = {dt, reason};
  };
  constexpr double farthest = 0.5;  // cells a particle may move
  if (e.wave_and_motion > 0.0) limit(courant_number(s, numerics) * h / e.wave_and_motion, "the speed of waves");
  if (e.speed > 0.0) limit(farthest * h / e.speed, "the speed of particles");
  if (e.volume_rate > 0.0) limit(numerics.most_volume_change / e.volume_rate, "the rate of volume change");
  if (s.last_time_step > 0.0)
    limit(numerics.growth * s.last_time_step, "growth from the step before");
  else if (numerics.first_step > 0.0)
    limit(numerics.first_step, "numerics.first_step");
  const double left = end_time - s.time;
  // Two steps of equal size instead of a very small last one.
  if (size.dt >= left)
    size = {left, last_steps};
  else if (2.0 * size.dt > left)
    size = {0.5 * left, last_steps};
  return size;
}

RunResult run(const Case& c, Simulation& s, const RunOptions& options) {
  return Run(c, s, options).begin();
}

RunResult resume(const Case& c, Simulation& s, const RunOptions& options) {
  return Run(c, s, options).go_on();
}

Summary report(const Case& c, Simulation& s, const Path& directory) {
  const Measures measures(c, s);
  const Restored restored = restore_newest(directory, s);
  Summary summary{c.title,
                  "as of " + restored.file.filename().string(),
                  "",
                  s.time,
                  s.step,
                  count_particles(s),
                  restored.progress.wall_time,
                  0.0,
                  omp_get_max_threads(),
                  books_of(s),
                  measures.read(s)};
  for (const std::string& trouble : draw_figures(c, s, directory))
    summary.message += (summary.message.empty() ? "" : "\n") + trouble;
  return summary;
}

}  // namespace brisance::simulator
