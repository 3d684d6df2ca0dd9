#include "simulator/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/solid/shapes.hpp"

namespace brisance::simulator {
namespace {

/// Points of a box at equal distances.
struct Raster {
  double spacing;
  int dimensions;
  Vector lower{};
  std::array<int, 3> count{1, 1, 1};

  /// The bounds of the shape with a margin all around.
  Raster(const Case& c, const Shape& shape, double spacing_, double margin) : spacing(spacing_), dimensions(c.dimensions()) {
    const Bounds box = bounds(shape);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) {
      const int before = static_cast<int>(std::ceil(margin / spacing));
      lower[a] = box.lower[a] - before * spacing;
      count[a] = 2 * before + std::max(1, static_cast<int>(std::lround((box.upper[a] - box.lower[a]) / spacing)));
    }
  }
  std::size_t size() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
  std::array<int, 3> index(std::size_t i) const {
    const int n = static_cast<int>(i % static_cast<std::size_t>(count[0] * count[1]));
    return {n % count[0], n / count[0], static_cast<int>(i / static_cast<std::size_t>(count[0] * count[1]))};
  }
  std::ptrdiff_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? count[0] : static_cast<std::ptrdiff_t>(count[0]) * count[1];
  }
  Vector point(std::size_t i) const {
    Vector x = lower;
    const std::array<int, 3> n = index(i);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) x[a] += (n[a] + 0.5) * spacing;
    return x;
  }
};

/// Where a point is seen in the mirrors of a case; itself if it is in front of all of them.
Vector mirrored(const Case& c, Vector x) {
  constexpr int most_reflections = 64;  // between two mirrors
  for (int i = 0; i < most_reflections; ++i) {
    const Vector before = x;
    if (c.geometry == Geometry::axisymmetric) x[0] = std::abs(x[0]);
    for (const BoundaryConfig& b : c.boundaries) {
      if (b.kind != BoundaryKind::symmetry) continue;
      double& at = x[static_cast<std::size_t>(b.axis)];
      if (b.side == Side::above ? at < b.position : at > b.position) at = 2.0 * b.position - at;
    }
    if (x == before) break;
  }
  return x;
}

/// next[n] = the least of row[n + k stride] + k^2, |k| <= reach, as far as there are such rows: one run along x at a time,
/// which the compiler takes in lanes.
using Distance = std::uint16_t;
void relax(const Distance* row, Distance* next, std::ptrdiff_t length, std::ptrdiff_t stride, int before, int after) {
  std::copy_n(row, length, next);
  for (int k = -before; k <= after; ++k) {
    const Distance* other = row + k * stride;
    const auto square = static_cast<Distance>(k * k);
    for (std::ptrdiff_t n = 0; n < length; ++n) next[n] = std::min(next[n], static_cast<Distance>(other[n] + square));
  }
}

/// Squared distances, in spacings, to the nearest point where `to` holds; those beyond `reach` are at least (reach + 1)^2.
std::vector<Distance> squared_distances(const Raster& raster, const std::vector<char>& to, int reach) {
  const auto far = static_cast<Distance>((reach + 1) * (reach + 1));
  std::vector<Distance> distance(raster.size()), next(raster.size());
  for (std::size_t i = 0; i < to.size(); ++i) distance[i] = to[i] ? 0 : far;
  const auto length = static_cast<std::ptrdiff_t>(raster.count[0]);
  // Along x a row is its own neighbour, moved; beyond its ends everything is far.
  std::vector<Distance> padded(static_cast<std::size_t>(length + 2 * reach), far);
  for (std::size_t row = 0; row < distance.size(); row += static_cast<std::size_t>(length)) {
    std::copy_n(distance.data() + row, length, padded.data() + reach);
    relax(padded.data() + reach, distance.data() + row, length, 1, reach, reach);
  }
  for (int axis = 1; axis < raster.dimensions; ++axis) {
    for (std::size_t row = 0; row < distance.size(); row += static_cast<std::size_t>(length)) {
      const int n = raster.index(row)[static_cast<std::size_t>(axis)];
      const int after = raster.count[static_cast<std::size_t>(axis)] - 1 - n;
      relax(distance.data() + row, next.data() + row, length, raster.stride(axis), std::min(reach, n), std::min(reach, after));
    }
    std::swap(distance, next);
  }
  return distance;
}

/// Whether no neighbour within the raster has more.
bool is_largest_around(const Raster& raster, const std::vector<Distance>& values, std::size_t i) {
  const std::array<int, 3> n = raster.index(i);
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a) {
        const int step[3] = {a, b, c};
        std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i);
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          inside = inside && n[k] + step[k] >= 0 && n[k] + step[k] < raster.count[k];
          at += step[k] * raster.stride(static_cast<int>(k));
        }
        if (inside && values[static_cast<std::size_t>(at)] > values[i]) return false;
      }
  return true;
}

}  // namespace

std::optional<ThinPart> thinnest_part(const Case& c, const Shape& shape, double least) {
  constexpr std::size_t most_points = 20'000'000;
  Raster raster(c, shape, 0.25 * c.cell_size, 0.5 * least + 0.5 * c.cell_size);
  while (raster.size() > most_points) raster = Raster(c, shape, 2.0 * raster.spacing, 0.5 * least + 2.0 * raster.spacing);

  std::vector<char> empty(raster.size());
  for (std::size_t i = 0; i < empty.size(); ++i) empty[i] = contains(shape, mirrored(c, raster.point(i))) ? 0 : 1;
  const int radius = static_cast<int>(std::lround(0.5 * least / raster.spacing));
  const std::vector<Distance> depth = squared_distances(raster, empty, radius);
  std::vector<char> wide(raster.size());  // a ball of the least diameter fits around it
  for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = depth[i] >= radius * radius ? 1 : 0;
  // The corner of a box is as far from the ball that touches its faces.
  const int corner = static_cast<int>(std::ceil(std::sqrt(raster.dimensions) * radius)) + 1;
  const std::vector<Distance> to_wide = squared_distances(raster, wide, corner);

  std::optional<ThinPart> thinnest;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    if (empty[i] || to_wide[i] <= corner * corner || !is_largest_around(raster, depth, i)) continue;
    const Vector place = raster.point(i);
    const double thickness = 2.0 * std::sqrt(depth[i]) * raster.spacing;
    if (mirrored(c, place) == place && (!thinnest || thickness < thinnest->thickness)) thinnest = {thickness, place};
  }
  return thinnest;
}

}  // namespace brisance::simulator
