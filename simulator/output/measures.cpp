#include "simulator/output/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "models/input/csv.hpp"
#include "models/interpolate.hpp"
#include "simulator/output/fields.hpp"

namespace brisance::simulator {
namespace {

/// Where a body ends along an axis.
struct Extent {
  double lower = std::numeric_limits<double>::infinity(), upper = -std::numeric_limits<double>::infinity();
};
Extent extent_of(const Body& body, std::size_t axis) {
  Extent e;
  Vector direction{};
  direction[axis] = 1.0;
  const double whole = whole_half_width(body);
  for (int p = 0; p < body.particles.size; ++p) {
    const ParticleView particle(body.particles, p);
    const double x = particle.position()[axis], half = particle.reach(direction, whole);
    e.lower = std::min(e.lower, x - half), e.upper = std::max(e.upper, x + half);
  }
  return e;
}

/// Where a particle is around the axis, and the distance of its outermost point from it.
struct Polar {
  double outer_radius, angle;
};
Polar about_axis(const ParticleView& particle, std::size_t axis, double whole) {
  Vector from_axis = particle.position();
  from_axis[axis] = 0.0;
  const double r = std::sqrt(dot(from_axis, from_axis));
  const double outer = r > 0.0 ? r + particle.reach((1.0 / r) * from_axis, whole) : particle.half_width();
  return {outer, std::atan2(from_axis[(axis + 2) % 3], from_axis[(axis + 1) % 3])};
}

/// How many parts of about a cell there are around a body's axis. A surface that runs across the lattice of particles has
/// steps; the mean over the parts is on the surface, the outermost particle of all is beyond it.
std::size_t sectors_of(const Simulation& s, const Body& body, std::size_t axis) {
  if (s.dimensions() == 2) return 1;
  double largest = 0.0;
  const double whole = whole_half_width(body);
  for (int p = 0; p < body.particles.size; ++p)
    largest = std::max(largest, about_axis(ParticleView(body.particles, p), axis, whole).outer_radius);
  return static_cast<std::size_t>(std::ceil(2.0 * std::numbers::pi * largest / s.grid.cell_size));
}

/// From the rear end to where the radius exceeds the undeformed one by this part.
constexpr double visible_widening = 0.01;

double undeformed_length(const Profile& profile, const Undeformed& undeformed) {
  const double limit = (1.0 + visible_widening) * undeformed.radius;
  for (std::size_t i = profile.height.size(); i-- > 0;) {
    if (profile.radius[i] <= limit) continue;
    if (i + 1 == profile.height.size()) return 0.0;
    const double part = (profile.radius[i] - limit) / (profile.radius[i] - profile.radius[i + 1]);
    return profile.length - (profile.height[i] + part * (profile.height[i + 1] - profile.height[i]));
  }
  return profile.length;
}

double mean_deviation(const Profile& profile, const MeasuredProfile& measured, const Undeformed& undeformed) {
  double sum = 0.0;
  for (std::size_t i = 0; i < measured.height.size(); ++i)
    sum += std::abs(profile.radius_at(measured.height[i]) - measured.radius[i]);
  return sum / (static_cast<double>(measured.height.size()) * undeformed.radius);
}

}  // namespace

double Profile::radius_at(double at) const {
  return height.empty() ? 0.0 : interpolate(height, radius, at);
}

Profile profile_of(const Simulation& s, const Body& body, Axis along) {
  const auto axis = static_cast<std::size_t>(along);
  Profile profile;
  if (body.particles.size == 0) return profile;
  const Extent extent = extent_of(body, axis);
  profile.lower = extent.lower, profile.length = extent.upper - extent.lower;
  // Bins of about a cell: each holds particles of two layers, so that its outermost one is on the surface.
  const auto bins = static_cast<std::size_t>(std::max(1.0, std::floor(profile.length / s.grid.cell_size)));
  const double width = profile.length / static_cast<double>(bins);
  const std::size_t sectors = sectors_of(s, body, axis);
  const double whole = whole_half_width(body);
  std::vector<std::vector<double>> outermost(bins, std::vector<double>(sectors, 0.0));
  for (int p = 0; p < body.particles.size; ++p) {
    const ParticleView particle(body.particles, p);
    const double at = (particle.position()[axis] - extent.lower) / width;
    const auto [r, angle] = about_axis(particle, axis, whole);
    const std::size_t bin = std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, at)));
    const double turn = 0.5 + 0.5 * angle / std::numbers::pi;
    double& radius = outermost[bin][std::min(sectors - 1, static_cast<std::size_t>(turn * static_cast<double>(sectors)))];
    radius = std::max(radius, r);
  }
  for (std::size_t b = 0; b < bins; ++b) {
    double sum = 0.0;
    int count = 0;
    for (const double r : outermost[b])
      if (r > 0.0) sum += r, ++count;  // a part of the bar has no particles in the sectors beyond its planes of symmetry
    if (count == 0) continue;          // torn apart
    profile.height.push_back((static_cast<double>(b) + 0.5) * width), profile.radius.push_back(sum / count);
    profile.largest = std::max(profile.largest, profile.radius.back());
  }
  return profile;
}

MeasuredProfile read_profile(const std::filesystem::path& path) {
  CsvColumns csv(path);
  MeasuredProfile profile{csv.numbers("height", Unit::m), csv.numbers("radius", Unit::m)};
  csv.finish();
  return profile;
}

std::size_t body_of(const MeasureConfig& measure, const Simulation& s) {
  if (measure.body.empty() && s.bodies.size() == 1) return 0;
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    if (s.bodies[b].name == measure.body) return b;
  throw std::invalid_argument(fmt::format("measure {}: there is no body \"{}\"", measure.name, measure.body));
}

std::vector<std::string> other_experiment(const Case& c) {
  const bool compared = std::any_of(c.measures.begin(), c.measures.end(),
                                    [](const MeasureConfig& m) { return m.measured || m.kind == MeasureKind::profile_error; });
  std::vector<std::string> changes;
  for (const std::string& change : c.set) {
    const std::string key = change.substr(0, change.find('='));
    const auto of = [&](std::string_view table) { return key == table || key.starts_with(std::string(table) + '.'); };
    const bool how = key.find(".material") != std::string::npos || key.ends_with(".particles_per_direction") ||
                     key.ends_with(".locking_cure") || key.ends_with(".name");
    if (compared && !how && (of("solid") || of("boundary") || of("load") || of("gravity") || of("geometry")))
      changes.push_back(change);
  }
  return changes;
}

Measures::Measures(const Case& c, const Simulation& start) {
  for (const MeasureConfig& config : c.measures) {
    Measure measure{config, body_of(config, start), {}, {}};
    const Profile profile = profile_of(start, start.bodies[measure.body], config.axis);
    measure.undeformed = {profile.length, profile.largest};
    if (config.kind == MeasureKind::profile_error) measure.profile = read_profile(config.profile);
    measures_.push_back(std::move(measure));
  }
}

std::vector<MeasuredValue> Measures::read(const Simulation& s) const {
  std::vector<MeasuredValue> values;
  for (const Measure& measure : measures_) {
    const MeasureConfig& config = measure.config;
    const Profile profile = profile_of(s, s.bodies[measure.body], config.axis);
    MeasuredValue result{config.name, "m", 0.0, config.measured};
    switch (config.kind) {
      case MeasureKind::final_length:
        result.value = profile.length;
        break;
      case MeasureKind::mushroom_diameter:
        result.value = 2.0 * profile.largest;
        break;
      case MeasureKind::diameter_at:
        result.value = 2.0 * profile.radius_at(config.at * measure.undeformed.length);
        break;
      case MeasureKind::undeformed_length:
        result.value = undeformed_length(profile, measure.undeformed);
        break;
      case MeasureKind::profile_error:
        result.unit = "1";
        result.value = mean_deviation(profile, measure.profile, measure.undeformed);
        break;
    }
    values.push_back(result);
  }
  return values;
}

}  // namespace brisance::simulator
