#include "simulator/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulator/output/fields.hpp"
#include "simulator/solid/shapes.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator {
namespace {

constexpr double least_cells = 4.0;

/// The thinnest thing in a shape, and what it is.
struct Thinnest {
  double size = std::numeric_limits<double>::infinity();
  std::string what;
  void add(double thickness, const std::string& name) {
    if (thickness > 0.0 && thickness < size) size = thickness, what = name;
  }
};

void look(const Shape& shape, const Case& c, Thinnest& thinnest) {
  const auto along_axes = [&](const Vector& lower, const Vector& upper) {
    for (int a = 0; a < c.dimensions(); ++a) {
      const auto k = static_cast<std::size_t>(a);
      // What a plane of symmetry cuts in half is twice as thick.
      const bool mirrored = (c.geometry == Geometry::axisymmetric && a == 0 && lower[0] <= 0.0) ||
                            std::any_of(c.boundaries.begin(), c.boundaries.end(), [&](const BoundaryConfig& b) {
                              return b.kind == BoundaryKind::symmetry && static_cast<int>(b.axis) == a &&
                                     b.position >= lower[k] && b.position <= upper[k];
                            });
      thinnest.add((mirrored ? 2.0 : 1.0) * (upper[k] - lower[k]), fmt::format("the body along {}", "xyz"[a]));
    }
  };
  struct Visitor {
    const Case& c;
    Thinnest& thinnest;
    const decltype(along_axes)& along;
    void operator()(const Box& b) const { along(b.lower, b.upper); }
    void operator()(const Cone& b) const {
      thinnest.add(2.0 * std::max(b.start_radius, b.end_radius), "the diameter");
      thinnest.add(std::sqrt(dot(b.end - b.start, b.end - b.start)), "the length");
      if (b.inner_start_radius > 0.0) thinnest.add(b.start_radius - b.inner_start_radius, "the wall");
      if (b.inner_end_radius > 0.0) thinnest.add(b.end_radius - b.inner_end_radius, "the wall");
    }
    void operator()(const Sphere& b) const {
      thinnest.add(2.0 * b.radius, "the diameter");
      if (b.inner_radius > 0.0) thinnest.add(b.radius - b.inner_radius, "the wall");
    }
    void operator()(const Union& u) const {
      for (const ShapePointer& part : u.parts) look(*part, c, thinnest);
    }
    void operator()(const Intersection& u) const {
      for (const ShapePointer& part : u.parts) look(*part, c, thinnest);
    }
    void operator()(const Difference& d) const { look(*d.from, c, thinnest); }
  };
  std::visit(Visitor{c, thinnest, along_axes}, shape.form);
}

std::vector<std::string> warnings_of(const Case& c, const Simulation& s, double first_step) {
  std::vector<std::string> warnings;
  for (const BodyConfig& body : c.bodies) {
    Thinnest thinnest;
    look(*body.shape, c, thinnest);
    const double cells = thinnest.size / c.cell_size;
    if (cells < least_cells)
      warnings.push_back(
          fmt::format("{}: {} is {:.3g} cells, fewer than {:g}: it will bend and neck too easily; take smaller cells",
                      body.name, thinnest.what, cells, least_cells));
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
  if (c.output.snapshot_interval > 0.0 && c.end_time / c.output.snapshot_interval > 1000.0)
    warnings.push_back(fmt::format("output.snapshot_interval gives {:.0f} snapshots", c.end_time / c.output.snapshot_interval));
  if (fastest == 0.0 && c.loads.empty() && dot(c.gravity, c.gravity) == 0.0 &&
      std::none_of(c.boundaries.begin(), c.boundaries.end(),
                   [](const BoundaryConfig& b) { return b.kind == BoundaryKind::velocity; }))
    warnings.push_back("nothing moves: no body has a velocity, and there is no load, no gravity and no moving boundary");
  return warnings;
}

}  // namespace

DryRun dry_run(const Case& c, Simulation& s) {
  DryRun result;
  double particles = 0.0;
  for (const Body& body : s.bodies) {
    result.particles.emplace_back(body.name, body.particles.size);
    particles += body.particles.size;
  }
  result.first_step = next_step(s, c.numerics, c.end_time).dt;
  result.warnings = warnings_of(c, s, result.first_step);
  using Clock = std::chrono::steady_clock;
  constexpr double long_enough = 1.0;  // s
  constexpr int most_steps = 20;
  const auto start = Clock::now();
  const auto seconds = [](Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); };
  double shortest = 0.0;  // other programs only make a step longer
  for (int i = 0; i < most_steps && seconds(start) < long_enough; ++i) {
    const auto step_start = Clock::now();
    if (advance(s, next_step(s, c.numerics, c.end_time).dt) == StepOutcome::rejected) break;
    shortest = i == 0 ? seconds(step_start) : std::min(shortest, seconds(step_start));
  }
  double bytes = static_cast<double>(s.grid.bytes());
  for (const Body& body : s.bodies) bytes += static_cast<double>(body.particles.bytes());
  result.megabytes = bytes / 1e6;
  // The start is often slower than what follows, or faster: this is a guess.
  const double step = std::max(result.first_step, s.last_time_step);
  result.steps = c.end_time / step;
  result.nanoseconds = 1e9 * shortest / particles;
  result.hours = result.steps * particles * result.nanoseconds * 1e-9 / 3600.0;
  return result;
}

}  // namespace brisance::simulator
