#include "simulator/solid/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace brisance::simulator {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double square(double x) {
  return x * x;
}

bool holds(const Box& box, const Vector& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const bool flat = box.lower[k] == box.upper[k];  // across the two dimensions of a plane or axisymmetric geometry
    if (flat ? p[k] != box.lower[k] : p[k] < box.lower[k] || p[k] >= box.upper[k]) return false;
  }
  return true;
}

bool holds(const Sphere& sphere, const Vector& p) {
  const Vector d = p - sphere.centre;
  return dot(d, d) < square(sphere.radius) && dot(d, d) >= square(sphere.inner_radius);
}

bool holds(const Cone& cone, const Vector& p) {
  const Vector axis = cone.end - cone.start, d = p - cone.start;
  const double part = dot(d, axis) / dot(axis, axis);
  // The face with the smaller coordinates belongs to the cone, as with a box, whichever end is called the start.
  const bool upwards = axis > Vector{};
  if (upwards ? part < 0.0 || part >= 1.0 : part <= 0.0 || part > 1.0) return false;
  const Vector off_axis = d - part * axis;
  const double distance_squared = dot(off_axis, off_axis);
  return distance_squared < square(std::lerp(cone.start_radius, cone.end_radius, part)) &&
         distance_squared >= square(std::lerp(cone.inner_start_radius, cone.inner_end_radius, part));
}

bool holds(const Union& form, const Vector& p) {
  return std::any_of(form.parts.begin(), form.parts.end(), [&](const ShapePointer& part) { return contains(*part, p); });
}
bool holds(const Intersection& form, const Vector& p) {
  return std::all_of(form.parts.begin(), form.parts.end(), [&](const ShapePointer& part) { return contains(*part, p); });
}
bool holds(const Difference& form, const Vector& p) {
  return contains(*form.from, p) &&
         std::none_of(form.without.begin(), form.without.end(), [&](const ShapePointer& part) { return contains(*part, p); });
}

Bounds bounds_of(const Box& box) {
  return {box.lower, box.upper};
}
Bounds bounds_of(const Sphere& sphere) {
  Bounds result{sphere.centre, sphere.centre};
  for (std::size_t k = 0; k < 3; ++k) result.lower[k] -= sphere.radius, result.upper[k] += sphere.radius;
  return result;
}
Bounds bounds_of(const Cone& cone) {
  const Vector axis = cone.end - cone.start;
  Bounds result;
  for (std::size_t k = 0; k < 3; ++k) {
    // How far a disk of radius 1 across the axis reaches along direction k.
    const double reach = std::sqrt(std::max(0.0, 1.0 - square(axis[k]) / dot(axis, axis)));
    result.lower[k] = std::min(cone.start[k] - reach * cone.start_radius, cone.end[k] - reach * cone.end_radius);
    result.upper[k] = std::max(cone.start[k] + reach * cone.start_radius, cone.end[k] + reach * cone.end_radius);
  }
  return result;
}
double lesser(double a, double b) {
  return std::min(a, b);
}
double greater(double a, double b) {
  return std::max(a, b);
}
using Choice = double (*)(double, double);
/// The lower corners of the parts joined by one rule, the upper ones by another.
Bounds joined(const std::vector<ShapePointer>& parts, Bounds result, Choice lower, Choice upper) {
  for (const ShapePointer& part : parts) {
    const Bounds other = bounds(*part);
    for (std::size_t k = 0; k < 3; ++k) {
      result.lower[k] = lower(result.lower[k], other.lower[k]);
      result.upper[k] = upper(result.upper[k], other.upper[k]);
    }
  }
  return result;
}
constexpr Vector above_all = {infinity, infinity, infinity}, below_all = {-infinity, -infinity, -infinity};
Bounds bounds_of(const Union& form) {
  return joined(form.parts, {above_all, below_all}, lesser, greater);
}
Bounds bounds_of(const Intersection& form) {
  return joined(form.parts, {below_all, above_all}, greater, lesser);
}
Bounds bounds_of(const Difference& form) {
  return bounds(*form.from);
}

}  // namespace

bool contains(const Shape& shape, const Vector& point) {
  return std::visit([&](const auto& form) { return holds(form, point); }, shape.form);
}

Bounds bounds(const Shape& shape) {
  return std::visit([](const auto& form) { return bounds_of(form); }, shape.form);
}

double filled_fraction(const Shape& shape, Geometry geometry, const Vector& lower, const Vector& upper, int samples) {
  const int n = samples, n_z = geometry == Geometry::three_dimensional ? n : 1;
  const auto middle = [&](std::size_t k, int i) { return lower[k] + (upper[k] - lower[k]) * (i + 0.5) / n; };
  double all = 0.0, filled = 0.0;
  for (int k = 0; k < n_z; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vector point = {middle(0, i), middle(1, j), n_z > 1 ? middle(2, k) : 0.0};
        const double weight = geometry == Geometry::axisymmetric ? point[0] : 1.0;
        all += weight;
        if (contains(shape, point)) filled += weight;
      }
  return all > 0.0 ? filled / all : 0.0;
}

bool may_fill(const Shape& shape, int dimensions, Bounds box, double spacing) {
  const Bounds own = bounds(shape);
  std::array<double, 3> first{}, count{1.0, 1.0, 1.0};
  double all = 1.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) {
    box.lower[a] = std::max(box.lower[a], own.lower[a]), box.upper[a] = std::min(box.upper[a], own.upper[a]);
    first[a] = std::ceil(box.lower[a] / spacing - 0.5);
    count[a] = std::max(std::ceil(box.upper[a] / spacing - 0.5) - first[a], 0.0);
    all *= count[a];
  }
  constexpr double most = 3e6;  // a fraction of a second
  const double stride = std::max(1.0, std::ceil(std::pow(all / most, 1.0 / dimensions)));
  for (double k = 0.0; k<count[2]; k += dimensions> 2 ? stride : 1.0)
    for (double j = 0.0; j<count[1]; j += dimensions> 1 ? stride : 1.0)
      for (double i = 0.0; i < count[0]; i += stride) {
        const std::array<double, 3> at{i, j, k};
        Vector x{};
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) x[a] = (first[a] + at[a] + 0.5) * spacing;
        if (contains(shape, x)) return true;
      }
  return stride > 1.0;
}

Bounds bounds(const Shape& shape, Geometry geometry) {
  Bounds box = bounds(shape);
  if (is_round(geometry)) box.lower[0] = std::max(box.lower[0], 0.0);
  return box;
}

double volume(const Shape& shape, Geometry geometry, double spacing) {
  const Bounds box = bounds(shape, geometry);
  const std::size_t dimensions = static_cast<std::size_t>(number_of_dimensions(geometry));
  double of_box = is_round(geometry) ? 0.5 * (box.lower[0] + box.upper[0]) : 1.0, widest = 0.0;
  for (std::size_t a = 0; a < dimensions; ++a) {
    const double width = std::max(box.upper[a] - box.lower[a], 0.0);
    of_box *= width, widest = std::max(widest, width);
  }
  if (of_box == 0.0) return 0.0;
  const double most_samples = dimensions == 3 ? 256.0 : 4096.0;  // along each direction: a second or less in all
  const int samples = static_cast<int>(std::ceil(std::clamp(widest / spacing, 1.0, most_samples)));
  return of_box * filled_fraction(shape, geometry, box.lower, box.upper, samples);
}

}  // namespace brisance::simulator
