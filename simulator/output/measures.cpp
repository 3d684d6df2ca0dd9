#include "simulator/output/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "models/input/csv.hpp"
#include "models/interpolate.hpp"
#include "simulator/gas/fields.hpp"
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

MeasuredValue result_of(const MeasureConfig& config) {
  return {config.name, std::string(unit_of(config.kind).text), std::numeric_limits<double>::quiet_NaN(), config.measured};
}

MeasuredValue of_body(const MeasureConfig& config, const Profile& profile, const Undeformed& undeformed,
                      const MeasuredProfile& measured) {
  MeasuredValue result = result_of(config);
  switch (config.kind) {
    case MeasureKind::final_length:
      result.value = profile.length;
      break;
    case MeasureKind::mushroom_diameter:
      result.value = 2.0 * profile.largest;
      break;
    case MeasureKind::diameter_at:
      result.value = 2.0 * profile.radius_at(config.at * undeformed.length);
      break;
    case MeasureKind::undeformed_length:
      result.value = undeformed_length(profile, undeformed);
      break;
    default:
      result.value = mean_deviation(profile, measured, undeformed);
  }
  return result;
}

MeasuredValue of_phase(const MeasureConfig& config, const PositivePhase::Result& phase) {
  constexpr double negligible = 1e-6;  // of the ambient pressure; rounding is far below
  MeasuredValue result = result_of(config);
  if (phase.peak < negligible * *config.ambient) {
    result.missing = "the pressure there has not risen above the ambient one";
    return result;
  }
  const bool over_all_of_it = config.kind == MeasureKind::positive_duration || config.kind == MeasureKind::positive_impulse;
  if (over_all_of_it && !phase.ended) {
    result.missing = "the positive phase has not ended; take a later end_time";
    return result;
  }
  switch (config.kind) {
    case MeasureKind::peak_overpressure:
      result.value = phase.peak;
      break;
    case MeasureKind::arrival_time:
      result.value = phase.arrival;
      break;
    case MeasureKind::positive_duration:
      result.value = phase.end - phase.arrival;
      break;
    default:
      result.value = phase.impulse;
  }
  return result;
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
    if (compared && !how &&
        (of("solid") || of("boundary") || of("load") || of("gravity") || of("geometry") || of("gas.fill") || of("gas.edge") ||
         of("gas.body") || of("gas.reaction") || of("gauge")))
      changes.push_back(change);
  }
  return changes;
}

Measures::Measures(const Case& c, const Simulation& start) {
  for (const MeasureConfig& config : c.measures) {
    Measure measure{config};
    if (is_of_gas(config.kind)) {
      measure.place = std::find_if(c.gauges.begin(), c.gauges.end(), [&](const GaugeConfig& gauge) {
                        return gauge.name == config.gauge;
                      })->from;
    } else {
      measure.body = body_of(config, start);
      const Profile profile = profile_of(start, start.bodies[measure.body], config.axis);
      measure.undeformed = {profile.length, profile.largest};
      if (config.kind == MeasureKind::profile_error) measure.profile = read_profile(config.profile);
    }
    measures_.push_back(std::move(measure));
  }
}

void Measures::observe(const Simulation& s) {
  for (Measure& measure : measures_) {
    if (!is_of_gas(measure.config.kind)) continue;
    if (const auto cell = gas::find_cell(s.gas, measure.place))  // none where a body is
      measure.phase.add(s.time,
                        s.gas.primitive.cell(cell->block, gas::Primitive::pressure, cell->cell) - *measure.config.ambient);
  }
}

std::vector<double> Measures::numbers() const {
  std::vector<double> numbers;
  for (const Measure& measure : measures_)
    if (is_of_gas(measure.config.kind)) measure.phase.append_to(numbers);
  return numbers;
}

void Measures::restore(const std::vector<double>& numbers) {
  std::span<const double> rest(numbers);
  for (Measure& measure : measures_)
    if (is_of_gas(measure.config.kind)) measure.phase.take_from(rest);
  if (!rest.empty()) throw std::runtime_error("its measures are of another case");
}

std::vector<MeasuredValue> Measures::read(const Simulation& s) const {
  std::vector<MeasuredValue> values;
  for (const Measure& measure : measures_)
    values.push_back(is_of_gas(measure.config.kind)
                         ? of_phase(measure.config, measure.phase.result())
                         : of_body(measure.config, profile_of(s, s.bodies[measure.body], measure.config.axis),
                                   measure.undeformed, measure.profile));
  return values;
}

}  // namespace brisance::simulator
