// Shapes against their volumes in closed form, and the rule that a point on a common boundary belongs to one shape.

#include "simulator/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace brisance::simulator {
namespace {

constexpr double pi = std::numbers::pi;

template <class Form>
ShapePointer shape(Form form) {
  return std::make_shared<const Shape>(Shape{std::move(form)});
}
ShapePointer cylinder(Vector start, Vector end, double radius) {
  return shape(Cone{start, end, radius, radius});
}

// Counting sample points errs by a part of the boxes that the surface crosses, that is, in proportion to the volume of the box
// that bounds the shape. Over a curved surface the errors nearly cancel: they stay below a quarter of a sample's width.
constexpr int samples = 80;
constexpr double counting = 0.25 / samples;

void expect_volume(const ShapePointer& s, Geometry geometry, double expected) {
  const Bounds b = bounds(*s, geometry);
  const Vector width = b.upper - b.lower;
  double box = width[0] * width[1], whole = 1.0;
  if (geometry == Geometry::axisymmetric) box *= pi * b.upper[0], whole = 2.0 * pi;
  if (geometry == Geometry::three_dimensional) box *= width[2];
  const double spacing = *std::max_element(width.begin(), width.begin() + number_of_dimensions(geometry)) / samples;
  EXPECT_NEAR(whole * volume(*s, geometry, spacing), expected, counting * box);
}

TEST(Shapes, VolumesInThreeDimensionsAreThoseOfTheFormulas) {
  const auto check = [](const ShapePointer& s, double expected) { expect_volume(s, Geometry::three_dimensional, expected); };
  check(shape(Box{{-1, 0, 2}, {1, 3, 2.5}}), 3.0);
  check(shape(Sphere{{1, 2, 3}, 2.0}), 4.0 / 3.0 * pi * 8.0);
  check(shape(Sphere{{1, 2, 3}, 2.0, 1.5}), 4.0 / 3.0 * pi * (8.0 - 3.375));
  check(cylinder({0, 0, 0}, {0, 3, 0}, 0.5), pi * 0.25 * 3.0);
  check(cylinder({1, 0, 0}, {2, 2, 2}, 0.5), pi * 0.25 * 3.0);  // oblique, of length 3
  check(shape(Cone{{0, 0, 0}, {0, 0, 3}, 0.1, 0.5}), pi * 3.0 / 3.0 * (0.01 + 0.05 + 0.25));
  check(shape(Cone{{0, 0, 0}, {3, 0, 0}, 1.0, 1.0, 0.8, 0.8}), pi * 3.0 * (1.0 - 0.64));
  check(shape(Difference{shape(Box{{0, 0, 0}, {2, 2, 2}}), {shape(Sphere{{0, 0, 0}, 1.0}), shape(Sphere{{2, 2, 2}, 1.0})}}),
        8.0 - pi / 3.0);
  check(shape(Union{{shape(Box{{0, 0, 0}, {1, 1, 1}}), shape(Box{{0.5, 0, 0}, {2, 1, 1}})}}), 2.0);
  check(shape(Intersection{{shape(Sphere{{0, 0, 0}, 1.0}), shape(Box{{0, 0, 0}, {2, 2, 2}})}}), pi / 6.0);
}

TEST(Shapes, VolumesAboutTheAxisCountEachRingWithItsCircumference) {
  const auto check = [](const ShapePointer& s, double expected) { expect_volume(s, Geometry::axisymmetric, expected); };
  check(cylinder({0, 0, 0}, {0, 25.4, 0}, 3.81), pi * 3.81 * 3.81 * 25.4);
  check(shape(Cone{{0, 0, 0}, {0, 10, 0}, 1.0, 5.0}), pi * 10.0 / 3.0 * (1.0 + 5.0 + 25.0));
  check(shape(Sphere{{0, 4, 0}, 2.0}), 4.0 / 3.0 * pi * 8.0);
  check(shape(Box{{0, -1, 0}, {2, 1, 0}}), pi * 4.0 * 2.0);
}

TEST(Shapes, AreasInThePlaneAreThoseOfTheSection) {
  expect_volume(shape(Sphere{{0.3, 0.1, 0}, 0.2}), Geometry::plane, pi * 0.04);
  expect_volume(cylinder({0, 0, 0}, {2, 0, 0}, 0.5), Geometry::plane, 2.0);
}

TEST(Shapes, OfTwoThatTouchExactlyOneClaimsAPointOfTheCommonFace) {
  const auto claims = [](const ShapePointer& a, const ShapePointer& b, const Vector& p) {
    return contains(*a, p) + contains(*b, p);
  };
  const auto low = shape(Box{{0, 0, 0}, {1, 1, 1}}), high = shape(Box{{0, 1, 0}, {1, 2, 1}});
  EXPECT_EQ(claims(low, high, {0.5, 1.0, 0.5}), 1);
  const auto ball = shape(Sphere{{0, 0, 0}, 5.0}), shell = shape(Sphere{{0, 0, 0}, 6.0, 5.0});
  EXPECT_EQ(claims(ball, shell, {3.0, 4.0, 0.0}), 1);
  const auto rod = cylinder({0, 0, 0}, {0, 2, 0}, 5.0), tube = shape(Cone{{0, 0, 0}, {0, 2, 0}, 6.0, 6.0, 5.0, 5.0});
  EXPECT_EQ(claims(rod, tube, {3.0, 1.0, 4.0}), 1);
  // Whichever end of the cylinder is called the start, its lower face is its own.
  for (const auto& above : {cylinder({0, 1, 0}, {0, 2, 0}, 0.4), cylinder({0, 2, 0}, {0, 1, 0}, 0.4)}) {
    EXPECT_EQ(claims(low, above, {0.1, 1.0, 0.1}), 1);
    EXPECT_EQ(claims(above, shape(Box{{0, 2, 0}, {1, 3, 1}}), {0.1, 2.0, 0.1}), 1);
  }
}

TEST(Shapes, BoundsAreTheLeastBox) {
  const auto expect = [](const ShapePointer& s, const Vector& lower, const Vector& upper) {
    const Bounds b = bounds(*s);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_DOUBLE_EQ(b.lower[k], lower[k]);
      EXPECT_DOUBLE_EQ(b.upper[k], upper[k]);
    }
  };
  expect(shape(Sphere{{1, 2, 3}, 2.0}), {-1, 0, 1}, {3, 4, 5});
  expect(shape(Cone{{0, 0, 0}, {0, 10, 0}, 1.0, 5.0}), {-5, 0, -5}, {5, 10, 5});
  expect(cylinder({0, 0, 0}, {3, 4, 0}, 5.0), {-4, -3, -5}, {7, 7, 5});
  expect(shape(Union{{shape(Box{{0, 0, 0}, {1, 1, 1}}), shape(Box{{2, 0, -1}, {3, 1, 1}})}}), {0, 0, -1}, {3, 1, 1});
  expect(shape(Intersection{{shape(Sphere{{0, 0, 0}, 2.0}), shape(Box{{0, -9, 0}, {9, 9, 9}})}}), {0, -2, 0}, {2, 2, 2});
  const Bounds apart = bounds(*shape(Intersection{{shape(Box{{0, 0, 0}, {1, 1, 1}}), shape(Box{{2, 0, 0}, {3, 1, 1}})}}));
  EXPECT_GT(apart.lower[0], apart.upper[0]);
}

TEST(Shapes, AFullBoxIsExactlyOneAndAnEmptyOneExactlyZero) {
  const auto bar = cylinder({0, 0, 0}, {0, 25.4, 0}, 3.81);
  for (const Geometry geometry : {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional}) {
    EXPECT_EQ(filled_fraction(*bar, geometry, {0.1, 0.1, 0.1}, {0.4, 0.7, 0.3}, 4), 1.0);
    EXPECT_EQ(filled_fraction(*bar, geometry, {4.0, 0.1, 0.1}, {4.4, 0.7, 0.3}, 4), 0.0);
  }
  // Half of the width, but of a ring between r = 3.61 and 4.01: (3.81^2 - 3.61^2)/(4.01^2 - 3.61^2).
  EXPECT_NEAR(filled_fraction(*bar, Geometry::axisymmetric, {3.61, 1, 0}, {4.01, 2, 0}, 4), (3.81 + 3.61) / (2 * (4.01 + 3.61)),
              1e-14);
}

}  // namespace
}  // namespace brisance::simulator
