#pragma once
// Which points a shape fills. A boundary belongs to one side only (the lower face of a box to the box, the upper face to its
// neighbour; the surface of a sphere to what is outside), so that of two shapes that touch exactly one claims a point.

#include "simulator/config.hpp"

namespace brisance::simulator {

/// In the axisymmetric geometry the point is (r, z, 0), in the plane geometry (x, y, 0).
bool contains(const Shape& shape, const Vector& point);

/// A box that holds the shape: the least one for the simple shapes and their unions. It is empty (lower > upper along some
/// axis) where the parts of an intersection lie apart.
struct Bounds {
  Vector lower, upper;
};
Bounds bounds(const Shape& shape);
/// The same without negative radii, where there is nothing.
Bounds bounds(const Shape& shape, Geometry geometry);

/// Places in a sub-cell along each direction where particles are made: how much of it a shape fills is known to a part in the
/// square (cube) of that.
inline constexpr int samples_per_direction = 4;

/// Filled part of the volume of a box, from the middles of `samples` equal parts along each direction of the
/// geometry. Exactly 1 or 0 if all of them are inside or outside. In the axisymmetric geometry the box is a ring, 0 <= r.
double filled_fraction(const Shape& shape, Geometry geometry, const Vector& lower, const Vector& upper, int samples);

/// Whether a shape holds one of the middles of parts of width `spacing` of a box, counted from the origin. Of very many of them
/// only some are looked at, and where those find nothing the answer is yes.
bool may_fill(const Shape& shape, int dimensions, Bounds box, double spacing);

/// Volume of a shape (of one metre of depth in the plane geometry, of one radian in the axisymmetric one), from points at most
/// `spacing` apart, unless they were very many.
double volume(const Shape& shape, Geometry geometry, double spacing);

}  // namespace brisance::simulator
