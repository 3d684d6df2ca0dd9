#include "simulator/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulator/gas/rejection.hpp"
#include "simulator/gas/step_estimate.hpp"
#include "simulator/run.hpp"
#include "simulator/set_up_warnings.hpp"
#include "simulator/step_size.hpp"
#include "simulator/thickness.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator {
namespace {

constexpr double least_cells = 4.0;

std::vector<std::string> warnings_of(const Case& c, const Simulation& s, double first_step) {
  std::vector<std::string> warnings = set_up_warnings(c);
  for (const BodyConfig& body : c.bodies) {
    if (const auto thin = thinnest_part(c, *body.shape, least_cells * c.cell_size))
      warnings.push_back(
          fmt::format("{}: near ({:.4g}, {:.4g}, {:.4g}) m it is {:.2g} cells thick, fewer than {:g}: it will bend and neck "
                      "too easily; take smaller cells",
                      body.name, thin->place[0], thin->place[1], thin->place[2], thin->thickness / c.cell_size, least_cells));
    if (body.particles_per_direction < 2)
      warnings.push_back(fmt::format("{}: one particle per cell and direction: gaps open at small strains", body.name));
  }
  const double sound = s.extremes.wave_speed, fastest = s.extremes.speed;
  if (fastest > sound)
    warnings.push_back(fmt::format(
        "bodies move at {:.4g} m/s, faster than sound, {:.4g} m/s: shocks need an equation of state that holds there, "
        "and artificial viscosity",
        fastest, sound));
  if (c.numerics.least_step > first_step)
    warnings.push_back(fmt::format("numerics.least_step, {:.4g} s, is above the first step, {:.4g} s: the run stops at once",
                                   c.numerics.least_step, first_step));
  if (!c.bodies.empty() && fastest == 0.0 && c.loads.empty() && dot(c.gravity, c.gravity) == 0.0 &&
      std::none_of(c.boundaries.begin(), c.boundaries.end(), [](const BoundaryConfig& b) { return b.velocity.size > 0; }))
    warnings.emplace_back("nothing moves: no body has a velocity, and there is no load, no gravity and no moving boundary");
  return warnings;
}

/// After the first step has been rejected, as a run would: warns if none of the shorter ones is taken either.
void try_shorter(Simulation& s, double first, std::vector<std::string>& warnings) {
  constexpr double shortest = 1e-6;  // of the first
  for (double dt = 0.5 * first; dt > shortest * first; dt *= 0.5)
    if (advance(s, dt) == StepOutcome::done) return;
  warnings.push_back(fmt::format("its first step fails, however short: the start is no state to go on from{}",
                                 s.gas.empty() ? ""
                                               : "; " + gas::why_rejected(s.gas) +
                                                     "; a fluid may hold less energy than its density takes when it is "
                                                     "cold"));
}

}  // namespace

DryRun dry_run(const Case& c, Simulation& s) {
  DryRun result;
  for (const Body& body : s.bodies) result.points.push_back({body.name, body.particles.size, "particles"});
  if (!s.gas.empty()) result.points.push_back({"gas", s.gas.cells.count(), "cells"});
  for (const gas::MovingBody& body : s.gas.bodies.all)
    result.points.push_back({body.name, static_cast<std::int64_t>(body.places.size()), "particles"});
  if (!s.gas.empty()) result.fills = gas::fill_reports(c, s.gas);
  const auto points = static_cast<double>(count_points(s));
  const StepSize first = next_step(s, c.numerics, c.end_time);
  result.first_step = first.dt, result.limit = first.limit;
  result.warnings = warnings_of(c, s, result.first_step);
  using Clock = std::chrono::steady_clock;
  constexpr double long_enough = 1.0;  // s
  constexpr int most_steps = 20;
  const auto start = Clock::now();
  const auto seconds = [](Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); };
  const double gas_step = s.gas.empty() ? 0.0 : gas::step_after_jumps(s.gas, gas_courant(s.gas));
  double shortest = 0.0;  // other programs only make a step longer
  for (int i = 0; i < most_steps && seconds(start) < long_enough; ++i) {
    const auto step_start = Clock::now();
    const double dt = next_step(s, c.numerics, c.end_time).dt;
    if (advance(s, dt) == StepOutcome::rejected) {
      if (i == 0) try_shorter(s, dt, result.warnings);
      break;
    }
    shortest = i == 0 ? seconds(step_start) : std::min(shortest, seconds(step_start));
  }
  double bytes = static_cast<double>(s.grid.bytes() + s.gas.bytes());
  for (const Body& body : s.bodies) bytes += static_cast<double>(body.particles.bytes());
  result.megabytes = bytes / 1e6;
  // The start is often slower than what follows, or faster.
  const double step = s.gas.empty() ? std::max(result.first_step, s.last_time_step)
                                    : std::min(gas_step, gas::largest_step(s.gas, gas_courant(s.gas)));
  result.steps = c.end_time / step;
  // Short first steps grow geometrically until they are as long as those that follow.
  if (result.first_step < step)
    result.steps += std::log(step / result.first_step) / std::log(c.numerics.growth) -
                    (1.0 - result.first_step / step) / (c.numerics.growth - 1.0);
  result.nanoseconds = 1e9 * shortest / points;
  result.hours = result.steps * points * result.nanoseconds * 1e-9 / 3600.0;
  constexpr double day = 24.0;  // h
  if (result.hours > day)
    result.warnings.push_back(fmt::format(
        "it would take about {:.2g} days; cells twice as large take {} times less, planes of symmetry{} less as well",
        result.hours / day, 2 << c.dimensions(), c.dimensions() > 1 ? " and fewer dimensions" : ""));
  return result;
}

}  // namespace brisance::simulator
