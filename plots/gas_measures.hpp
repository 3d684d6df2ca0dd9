#pragma once
// What is measured of the gas and compared with exact solutions.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/interpolate.hpp"
#include "rays.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/gas/initial_state.hpp"
#include "simulator/output/line_out.hpp"
#include "validation.hpp"

namespace brisance::simulator {

// What is measured ----------------------------------------------------------------------------------------------------

/// The cells along the line of a figure with the means of its reference over them.
struct Line {
  std::vector<double> place, computed, exact;
  double cell_size;
};

/// Mean of a polyline between two places.
inline double mean_of(const std::vector<double>& x, const std::vector<double>& y, double from, double to) {
  const auto at = [&](std::size_t i, double place) {
    return x[i + 1] > x[i] ? std::lerp(y[i], y[i + 1], (place - x[i]) / (x[i + 1] - x[i])) : y[i];
  };
  double sum = from < x.front() ? y.front() * (std::min(to, x.front()) - from) : 0.0;
  if (to > x.back()) sum += y.back() * (to - std::max(from, x.back()));
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double low = std::max(from, x[i]), high = std::min(to, x[i + 1]);
    if (high > low) sum += 0.5 * (at(i, low) + at(i, high)) * (high - low);
  }
  return sum / (to - from);
}

inline Line line_of(const Ran& ran, const std::string& field, std::size_t figure = 0) {
  const FigureConfig& config = ran.config.figures.at(figure);
  const auto f = static_cast<std::size_t>(std::find(config.fields.begin(), config.fields.end(), field) - config.fields.begin());
  const LineOut computed = line_out(ran.simulation, config);
  Line line{computed.place, computed.values.at(f), {}, ran.config.cell_size};
  if (config.reference.empty()) return line;
  const LineOut reference = read_reference(config);
  const double half = 0.5 * line.cell_size;
  for (const double x : line.place)
    line.exact.push_back(reference.values[f].empty() ? 0.0 : mean_of(reference.place, reference.values[f], x - half, x + half));
  return line;
}

inline double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v / static_cast<double>(values.size());
  return sum;
}

/// A run with what was seen of it on the way.
struct Watched : Ran {
  std::vector<double> time;
  std::vector<std::vector<double>> values;  // of each time
};
using Measure = std::function<double(const Watched&)>;

/// Mean error along the line of the first figure.
inline Measure error(const std::string& field) {
  return [field](const Ran& ran) {
    const Line line = line_of(ran, field);
    double sum = 0.0;
    for (std::size_t i = 0; i < line.place.size(); ++i) sum += std::abs(line.computed[i] - line.exact[i]);
    return sum / static_cast<double>(line.place.size());
  };
}
/// The same over the mean.
inline Measure relative_error(const std::string& field) {
  return [field](const Watched& ran) { return error(field)(ran) / mean(line_of(ran, field).exact); };
}
inline Measure largest_error(const std::string& field, double scale) {
  return [field, scale](const Ran& ran) {
    const Line line = line_of(ran, field);
    double most = 0.0;
    for (std::size_t i = 0; i < line.place.size(); ++i) most = std::max(most, std::abs(line.computed[i] - line.exact[i]));
    return most / scale;
  };
}
/// Energy that is neither there at the start nor has come through the edges, over what there was.
inline double lost_energy(const Ran& ran) {
  const GasBooks& books = *ran.result.summary.books.gas;
  return std::abs(books.residual().energy / books.initial.energy);
}
/// Part of the kinetic energy of the start.
inline double lost_motion(const Ran& ran) {
  const GasBooks& books = *ran.result.summary.books.gas;
  return 1.0 - books.state.kinetic / books.initial.kinetic;
}
/// Root of the mean square of the density's error against the profile that the case began with: of flow that comes back.
inline double error_of_return(const Ran& ran) {
  const ProfileConfig& config = *ran.config.gas->fills[0].profile;
  const gas::StateProfile start = gas::read_state_profile(config);
  const gas::Gas& gas = ran.simulation.gas;
  double square = 0.0;
  gas::for_each_cell(gas, [&](const gas::CellPlace& at) {
    const Vector away = gas.cells.centre(at.block, at.cell) - config.centre;
    const double exact = interpolate(start.place, start.density, std::sqrt(dot(away, away)));
    square += std::pow(gas.primitive.cell(at.block, gas::Primitive::density, at.cell) - exact, 2);
  });
  return std::sqrt(square / static_cast<double>(gas.cells.count()));
}
/// Mean of a field between two places.
inline double plateau(const Line& line, double from, double to) {
  std::vector<double> inside;
  for (std::size_t i = 0; i < line.place.size(); ++i)
    if (line.place[i] > from && line.place[i] < to) inside.push_back(line.computed[i]);
  return mean(inside);
}
/// The outermost place where a line of values falls through a level.
inline double front(const std::vector<double>& place, const std::vector<double>& value, double level) {
  for (std::size_t i = place.size() - 1; i > 0; --i)
    if (value[i] <= level && value[i - 1] > level)
      return std::lerp(place[i], place[i - 1], (level - value[i]) / (value[i - 1] - value[i]));
  return 0.0;
}
inline double peak(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}
inline double rise(const Line& line, const std::vector<double>& values, double from, double to) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (line.place[i] > from && line.place[i] < to) low = std::min(low, values[i]), high = std::max(high, values[i]);
  return high - low;
}

// Gas held by bodies --------------------------------------------------------------------------------------------------

struct Held {
  double mass = 0.0, volume = 0.0, energy = 0.0, pressure = 0.0;  // energy: total; pressure: mean
};
/// The gas of the cells whose middles are where `inside` says.
inline Held held(const Simulation& s, const std::function<bool(const Vector&)>& inside) {
  Held sum;
  gas::for_each_cell(s.gas, [&](const gas::CellPlace& at) {
    if (!inside(s.gas.cells.centre(at.block, at.cell))) return;
    const double open = gas::open_part(s.gas, at.block, at.cell),
                 V = open * s.gas.content.cell(at.block, gas::Content::cell_volume, at.cell);
    sum.mass += V * s.gas.primitive.cell(at.block, gas::Primitive::density, at.cell);
    sum.pressure += V * s.gas.primitive.cell(at.block, gas::Primitive::pressure, at.cell);
    sum.energy += open * s.gas.content.cell(at.block, gas::Content::energy, at.cell), sum.volume += V;
  });
  sum.pressure /= sum.volume;
  return sum;
}
/// The gas within a ring: from its middle to the middle of its wall.
inline Held held_by_ring(const Simulation& s, double radius) {
  const Vector centre = s.gas.bodies.all.at(0).state.displacement;
  return held(s, [=](const Vector& x) { return std::hypot(x[0] - centre[0], x[1] - centre[1]) < radius; });
}

// The same flow along many rays ---------------------------------------------------------------------------------------

/// Values at so many places along a ray, and at which.
inline void sample(const gas::Rays& rays, const Vector& direction, double reach, std::vector<double>& place,
                   std::vector<double>& value) {
  place.clear(), value.clear();
  for (double r = 0.0; r < reach; r += 0.1 * rays.cell_size()) place.push_back(r), value.push_back(rays.density(r * direction));
}

struct Fronts {
  double mean = 0.0, spread = 0.0;  // spread: largest less smallest over the mean
  double peak = 0.0;                // mean of the largest densities
};
/// Radii within a reach at which the density falls through a level, or half-way from its peak to `ahead` without one.
inline Fronts fronts(const Ran& ran, double reach, double ahead, std::optional<double> level = {}) {
  const gas::Rays rays(ran.simulation.gas);
  const std::vector<Vector> directions = rays.directions(rays.dimensions() == 2 ? 24 : 12);
  std::vector<double> radii, place, value;
  Fronts result;
  for (const Vector& direction : directions) {
    sample(rays, direction, reach, place, value);
    const double most = peak(value);
    result.peak += most / static_cast<double>(directions.size());
    radii.push_back(front(place, value, level.value_or(0.5 * (most + ahead))));
  }
  result.mean = mean(radii);
  result.spread = (peak(radii) - *std::min_element(radii.begin(), radii.end())) / result.mean;
  return result;
}

}  // namespace brisance::simulator
