// Thin parts of shapes are found, whatever they are made of; corners, curved surfaces and halves at a mirror are not thin.

#include "simulator/thickness.hpp"

#include <gtest/gtest.h>

#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {
namespace {

using by_hand::box;
using by_hand::shape;

constexpr double h = 1e-3, least = 4.0 * h;

Case empty_case(Geometry g) {
  Case c;
  c.geometry = g, c.cell_size = h;
  return c;
}

ShapePointer minus(ShapePointer from, ShapePointer without) {
  return shape(Difference{std::move(from), {std::move(without)}});
}

TEST(Thickness, OfCornersAndRoundBodiesIsNotTakenForThin) {
  for (const Geometry g : {Geometry::plane, Geometry::three_dimensional}) {
    const Case c = empty_case(g);
    const double depth = g == Geometry::plane ? 0.0 : 8 * h;
    EXPECT_FALSE(thinnest_part(c, *box({0, 0, 0}, {8 * h, 12 * h, depth}), least));
    EXPECT_FALSE(thinnest_part(c, *box({0, 0, 0}, {4 * h, 12 * h, g == Geometry::plane ? 0.0 : 4 * h}), least));
    EXPECT_FALSE(thinnest_part(c, *shape(Sphere{{0, 0, 0}, 5 * h}), least));
  }
  EXPECT_FALSE(
      thinnest_part(empty_case(Geometry::three_dimensional), *shape(Cone{{0, 0, 0}, {0, 9 * h, 0}, 4 * h, 4 * h}), least));
}

TEST(Thickness, OfAPlateIsItsOwn) {
  const auto thin = thinnest_part(empty_case(Geometry::plane), *box({0, 0, 0}, {20 * h, 2 * h, 0}), least);
  ASSERT_TRUE(thin);
  EXPECT_NEAR(thin->thickness, 2 * h, 1e-9 * h);
  EXPECT_NEAR(thin->place[1], h, 0.25 * h);
}

TEST(Thickness, OfATubeIsThatOfItsWall) {
  const Cone tube{{0, 0, 0}, {0, 12 * h, 0}, 8 * h, 8 * h, 6 * h, 6 * h},
      thick{{0, 0, 0}, {0, 12 * h, 0}, 12 * h, 12 * h, 6 * h, 6 * h};
  for (const Geometry g : {Geometry::axisymmetric, Geometry::three_dimensional}) {
    const auto thin = thinnest_part(empty_case(g), *shape(tube), least);
    ASSERT_TRUE(thin);
    EXPECT_NEAR(thin->thickness, 2 * h, 0.5 * h);
    EXPECT_FALSE(thinnest_part(empty_case(g), *shape(thick), least));
  }
}

/// A cup bored out of a block: neither of the two shapes is thin, the bottom that is left is.
TEST(Thickness, OfADifferenceOfShapesIsThatOfWhatIsLeft) {
  const Case c = empty_case(Geometry::plane);
  const auto thin =
      thinnest_part(c, *minus(box({0, 0, 0}, {24 * h, 16 * h, 0}), box({6 * h, 3 * h, 0}, {18 * h, 20 * h, 0})), least);
  ASSERT_TRUE(thin);
  EXPECT_NEAR(thin->thickness, 3 * h, 1e-9 * h);
  EXPECT_GT(thin->place[0], 6 * h);
  EXPECT_LT(thin->place[0], 18 * h);
  EXPECT_LT(thin->place[1], 3 * h);
  EXPECT_FALSE(
      thinnest_part(c, *minus(box({0, 0, 0}, {24 * h, 16 * h, 0}), box({6 * h, 5 * h, 0}, {18 * h, 20 * h, 0})), least));
}

TEST(Thickness, OfAHalfIsThatOfTheWhole) {
  const auto half = box({0, 0, 0}, {20 * h, 2 * h, 0});
  Case c = empty_case(Geometry::plane);
  c.boundaries = {by_hand::plane(BoundaryKind::symmetry, Axis::y, 0.0, Side::above)};
  EXPECT_FALSE(thinnest_part(c, *half, least)) << "four cells with its mirror image";
  c.boundaries.push_back(by_hand::plane(BoundaryKind::symmetry, Axis::y, 2 * h, Side::below));
  EXPECT_FALSE(thinnest_part(c, *half, least)) << "without end between two mirrors";
}

}  // namespace
}  // namespace brisance::simulator
