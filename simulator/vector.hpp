#pragma once
// Places, directions, velocities: three components, whatever the geometry.

#include <array>
#include <cmath>

namespace brisance::simulator {

/// A place or a direction: x, y, z. In the axisymmetric geometry x is the radius r and y is z; in the plane z is unused.
using Vector = std::array<double, 3>;

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator*(double f, const Vector& a) {
  return {f * a[0], f * a[1], f * a[2]};
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double magnitude(const Vector& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace brisance::simulator
