#pragma once
// The contour of a body of particles: where the smeared fraction of solid at the nodes is one half. Square and cubic cells are
// cut along it by linear pieces that need no tables: what two cells share is the same from both sides, so nothing leaks.

#include <array>

namespace brisance::simulator::gas {

/// Depth below the surface (in cells, positive in the solid) at which a half space of solid, smeared by the quadratic B-spline,
/// has this fraction; within +- 3/2, and never zero.
double depth_of(double fraction);

/// Part of an edge, a triangle, a tetrahedron that is gas: where the linear function with these values at the corners is
/// negative. No value is zero.
double open_part(double a, double b);
double open_part(double a, double b, double c);
double open_part(double a, double b, double c, double d);

/// The gas of a square or a cube of unit size, of the values at its corners (x fastest).
/// A face across an axis of the cube is a square of its four corners.
double open_part(const std::array<double, 4>& corners);
double open_part(const std::array<double, 8>& corners);
/// The same with the distance from an axis as weight, which runs from r0 to r1 along x: mean of r over the square where it is
/// gas, zero where it is not; and along an edge.
double open_moment(const std::array<double, 4>& corners, double r0, double r1);
double open_moment(double a, double b, double r_a, double r_b);

/// Whether gas corners are joined through others along the edges; the centre of a square joins as well.
bool gas_is_connected(const std::array<double, 4>& corners);
bool gas_is_connected(const std::array<double, 8>& corners);

}  // namespace brisance::simulator::gas
