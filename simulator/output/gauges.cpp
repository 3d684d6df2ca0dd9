#include "simulator/output/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_set>

namespace brisance::simulator {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double distance(const Vector& a, const Vector& b) {
  return std::sqrt(dot(a - b, a - b));
}

bool within(const Vector& x, const GaugeConfig& g, int dimensions, int except_axis = -1) {
  for (int a = 0; a < dimensions; ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (a != except_axis && (x[k] < std::min(g.from[k], g.to[k]) || x[k] > std::max(g.from[k], g.to[k]))) return false;
  }
  return true;
}

/// Quadratic spline of a distance in cells: what a particle weighs at a place.
double spline(double u) {
  u = std::abs(u);
  return u < 0.5 ? 0.75 - u * u : u < 1.5 ? 0.5 * (1.5 - u) * (1.5 - u) : 0.0;
}

/// A sum of values with weights.
struct Mean {
  std::vector<double> sum;
  double weight = 0.0;
  void add(const std::vector<double>& values, double w) {
    if (sum.empty()) sum.assign(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += w * values[i];
    weight += w;
  }
  std::vector<double> value(std::size_t size) const {
    std::vector<double> result(size, nan);
    if (weight > 0.0)
      for (std::size_t i = 0; i < size; ++i) result[i] = sum[i] / weight;
    return result;
  }
};

}  // namespace

std::vector<Vector> places_of(const GaugeConfig& g, double cell_size) {
  if (g.kind != GaugeKind::line) return {g.from};
  const int parts = std::clamp(static_cast<int>(std::lround(distance(g.from, g.to) / cell_size)), 1, 100);
  std::vector<Vector> places;
  for (int i = 0; i <= parts; ++i) places.push_back(g.from + (static_cast<double>(i) / parts) * (g.to - g.from));
  return places;
}

template <class F>
void Gauges::for_each_particle(const Simulation& s, const GaugeConfig& config, F&& f) {
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    if (!config.body.empty() && s.bodies[b].name != config.body) continue;
    // In the order of the bins, so that sums do not depend on where particles stand in memory.
    for (const std::uint32_t p : s.bodies[b].bins.order) f(b, static_cast<int>(p));
  }
}

Gauges::Gauges(const Case& c, const Simulation& start) : dimensions_(start.dimensions()) {
  for (const GaugeConfig& config : c.gauges) {
    Gauge gauge{config, {}, {}, {}, {}};
    if (!start.gas.empty()) {
      watch_gas(std::move(gauge), start);
      continue;
    }
    for (const std::string& name : config.fields) {
      const Field* field = find_field(name);
      if (!field) throw std::invalid_argument(fmt::format("gauge {}: there is no field \"{}\"", config.name, name));
      gauge.fields.push_back(field);
    }
    if (config.kind == GaugeKind::point || config.kind == GaugeKind::line)
      gauge.places = places_of(config, start.grid.cell_size);
    if (config.moves.value_or(true) && !gauge.places.empty()) {
      for (const Vector& place : gauge.places) {
        Followed nearest{0, 0};
        double least = std::numeric_limits<double>::infinity();
        for_each_particle(start, config, [&](std::size_t b, int p) {
          const double d = distance(ParticleView(start.bodies[b].particles, p).position(), place);
          const std::uint64_t id = start.bodies[b].particles.id[static_cast<std::size_t>(p)];
          if (d < least || (d == least && id < nearest.id)) least = d, nearest = {b, id};
        });
        gauge.followed.push_back(nearest);
      }
    }
    if (config.moves.value_or(true) && config.kind == GaugeKind::plane)
      for_each_particle(start, config, [&](std::size_t b, int p) {
        const Particles& ps = start.bodies[b].particles;
        if (within(ParticleView(ps, p).position(), config, dimensions_))
          gauge.followed.push_back({b, ps.id[static_cast<std::size_t>(p)]});
      });
    const std::size_t places = std::max<std::size_t>(1, gauge.places.size());
    for (std::size_t i = 0; i < places; ++i)
      for (const Field* field : gauge.fields)
        for (int a = 0; a < std::min(field->components, dimensions_); ++a)
          columns_.push_back({fmt::format("gauge_{}_{}{}{}", config.name, field->name,
                                          field->components > 1 ? std::string("_") + "xyz"[a] : "",
                                          places > 1 ? fmt::format("_{:02}", i) : ""),
                              std::string(field->unit)});
    gauges_.push_back(std::move(gauge));
  }
}

void Gauges::watch_gas(Gauge gauge, const Simulation& start) {
  const std::vector<gas::Field> known = gas::fields_of(start.gas);
  for (const std::string& name : gauge.config.fields)
    gauge.gas_fields.push_back(
        *std::find_if(known.begin(), known.end(), [&](const gas::Field& field) { return field.name == name; }));
  gauge.places = places_of(gauge.config, start.grid.cell_size);
  for (std::size_t i = 0; i < gauge.places.size(); ++i)
    for (const gas::Field& field : gauge.gas_fields)
      for (int a = 0; a < field.components; ++a)
        columns_.push_back({fmt::format("gauge_{}_{}{}{}", gauge.config.name, field.name,
                                        field.name == "velocity" ? std::string("_") + "xyz"[a] : "",
                                        gauge.places.size() > 1 ? fmt::format("_{:02}", i) : ""),
                            field.unit});
  gauges_.push_back(std::move(gauge));
}

Gauges::Values Gauges::of_gas(const Gauge& gauge, const Simulation& s, const Vector& place) const {
  const std::optional<gas::CellPlace> cell = gas::find_cell(s.gas, place);
  Values values;
  for (const gas::Field& field : gauge.gas_fields)
    for (int a = 0; a < field.components; ++a) values.push_back(cell ? field.read(s.gas, *cell, a) : nan);
  return values;
}

std::size_t Gauges::components(const Gauge& gauge) const {
  std::size_t count = 0;
  for (const Field* field : gauge.fields) count += static_cast<std::size_t>(std::min(field->components, dimensions_));
  return count;
}

Gauges::Values Gauges::all_fields_of(const Gauge& gauge, const ParticleView& particle) const {
  Values values;
  for (const Field* field : gauge.fields) {
    double components[3];
    field->read(particle, components);
    values.insert(values.end(), components, components + std::min(field->components, dimensions_));
  }
  return values;
}

Gauges::Values Gauges::of_particle(const Gauge& gauge, const Simulation& s, const Followed& followed) const {
  const Particles& ps = s.bodies[followed.body].particles;
  const auto found = std::find(ps.id.begin(), ps.id.end(), followed.id);
  if (found == ps.id.end()) return Values(components(gauge), nan);
  return all_fields_of(gauge, ParticleView(ps, static_cast<int>(found - ps.id.begin())));
}

Gauges::Values Gauges::around(const Gauge& gauge, const Simulation& s, const Vector& place) const {
  Mean mean;
  for_each_particle(s, gauge.config, [&](std::size_t b, int p) {
    const ParticleView particle(s.bodies[b].particles, p);
    const Vector u = (1.0 / s.grid.cell_size) * (particle.position() - place);
    double weight = 1.0;
    for (int a = 0; a < dimensions_; ++a) weight *= spline(1.5 * u[static_cast<std::size_t>(a)]);  // reaches one cell
    if (weight > 0.0) mean.add(all_fields_of(gauge, particle), weight * particle.volume());
  });
  return mean.value(components(gauge));
}

Gauges::Values Gauges::over_plane(const Gauge& gauge, const Simulation& s) const {
  Mean mean;
  std::unordered_set<std::uint64_t> ids;  // of all bodies: an id says which body it is of
  for (const Followed& f : gauge.followed) ids.insert(f.id);
  for_each_particle(s, gauge.config, [&](std::size_t b, int p) {
    const Particles& ps = s.bodies[b].particles;
    const ParticleView particle(ps, p);
    const bool counts = gauge.config.moves.value_or(true) ? ids.contains(ps.id[static_cast<std::size_t>(p)])
                                                          : within(particle.position(), gauge.config, dimensions_);
    if (counts) mean.add(all_fields_of(gauge, particle), particle.volume());
  });
  return mean.value(components(gauge));
}

Gauges::Values Gauges::at_surface(const Gauge& gauge, const Simulation& s) const {
  const auto axis = static_cast<std::size_t>(*gauge.config.axis);
  const double outward = gauge.config.side.value_or(Side::above) == Side::above ? 1.0 : -1.0;
  Vector direction{};
  direction[axis] = outward;
  double farthest = -std::numeric_limits<double>::infinity();
  Values values(components(gauge), nan);
  std::vector<double> whole;
  for (const Body& body : s.bodies) whole.push_back(whole_half_width(body));
  for_each_particle(s, gauge.config, [&](std::size_t b, int p) {
    const ParticleView particle(s.bodies[b].particles, p);
    if (!within(particle.position(), gauge.config, dimensions_, static_cast<int>(axis))) return;
    const double at = outward * particle.position()[axis] + particle.reach(direction, whole[b]);
    if (at <= farthest) return;
    farthest = at;
    values = all_fields_of(gauge, particle);
    std::size_t column = 0;
    for (const Field* field : gauge.fields) {
      if (field->name == "position") values[column + axis] = outward * at;  // of the surface, not of the particle's middle
      column += static_cast<std::size_t>(std::min(field->components, dimensions_));
    }
  });
  return values;
}

std::vector<double> Gauges::read(const Simulation& s) const {
  std::vector<double> row;
  const auto add = [&](const Values& values) { row.insert(row.end(), values.begin(), values.end()); };
  for (const Gauge& gauge : gauges_) switch (gauge.config.kind) {
      case GaugeKind::plane:
        add(over_plane(gauge, s));
        break;
      case GaugeKind::surface:
        add(at_surface(gauge, s));
        break;
      default:
        for (std::size_t i = 0; i < gauge.places.size(); ++i)
          add(!s.gas.empty()                      ? of_gas(gauge, s, gauge.places[i])
              : gauge.config.moves.value_or(true) ? of_particle(gauge, s, gauge.followed[i])
                                                  : around(gauge, s, gauge.places[i]));
    }
  return row;
}

}  // namespace brisance::simulator
