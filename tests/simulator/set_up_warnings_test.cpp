// Bodies that start in a way nobody means are named, with the numbers; those that may be meant are not.

#include "simulator/set_up_warnings.hpp"

#include <gtest/gtest.h>

#include "simulator/output/summary.hpp"
#include "simulator/solid/shapes.hpp"
#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {
namespace {

using by_hand::box;

constexpr double h = 1e-3;

/// A block of ten cells that flies down from y = 20 mm at 100 m/s for 1 ms: to y = -80 mm.
Case falling_block() {
  Case c;
  c.geometry = Geometry::plane, c.cell_size = h, c.end_time = 1e-3;
  c.bodies.push_back(by_hand::body("block", by_hand::elastic_material(1000.0, 1e9, 0.3),
                                   box({0, 20 * h, 0}, {10 * h, 30 * h, 0}), {0, -100, 0}));
  return c;
}

void expect_that_it_meets_something(const Case& c, bool expected) {
  const std::vector<std::string> warnings = set_up_warnings(c);
  if (expected) {
    EXPECT_TRUE(warnings.empty()) << warnings.front();
  } else {
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings.front(),
              "block: it flies at 100 m/s and meets no boundary and no other body before the end at 0.001 s; look at its "
              "direction and at end_time");
  }
}

TEST(MovingBody, MeetsAWallInItsWayBeforeTheEnd) {
  Case c = falling_block();
  expect_that_it_meets_something(c, false);
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above)};
  expect_that_it_meets_something(c, true);
  c.end_time = 0.1e-3;  // half of the way
  EXPECT_EQ(set_up_warnings(c).size(), 1u);
}

TEST(MovingBody, LeavesAWallBehindOrSlidesAlongAMirror) {
  Case c = falling_block();
  c.boundaries = {by_hand::plane(BoundaryKind::symmetry, Axis::x, 0.0, Side::above),
                  by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 30 * h, Side::below)};
  expect_that_it_meets_something(c, false);
  c.boundaries[0].kind = BoundaryKind::fixed;  // it holds what slides along it
  expect_that_it_meets_something(c, true);
}

TEST(MovingBody, ThatIsVeryColdWasPerhapsMeantInDegreesCelsius) {
  Case c = falling_block();
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above)};
  EXPECT_TRUE(set_up_warnings(c).empty());
  c.bodies[0].temperature = 25.0;
  ASSERT_EQ(set_up_warnings(c).size(), 1u);
  EXPECT_NE(
      set_up_warnings(c).front().find("block: it starts at 25 K; degrees Celsius are given as a text, such as \"25 degC\""),
      std::string::npos)
      << set_up_warnings(c).front();
}

TEST(MovingBody, MeetsAnotherBodyIfTheirWaysCross) {
  Case c = falling_block();
  c.bodies.push_back(by_hand::body("target", c.bodies[0].material.material, box({12 * h, -50 * h, 0}, {20 * h, -40 * h, 0})));
  expect_that_it_meets_something(c, false);
  c.bodies[1].velocity.translation[0] = -10.0;  // 10 mm to the side until the end
  EXPECT_TRUE(set_up_warnings(c).empty());
  c.bodies[1].velocity.translation[0] = 10.0;
  EXPECT_EQ(set_up_warnings(c).size(), 2u) << "the target flies into nothing as well";
}

/// Two blocks a few cells apart, which come together: they are named from then on, and that they stick.
TEST(Bodies, ThatHaveMetAreNamedInTheSummary) {
  Case c = falling_block();
  c.boundaries.clear();
  const Bounds block = bounds(*c.bodies[0].shape);
  const double gap = 4.0 * h, below = block.lower[1] - gap;
  c.bodies.push_back(by_hand::body("target", c.bodies[0].material.material,
                                   box({block.lower[0], below - 4.0 * h, 0.0}, {block.upper[0], below, 0.0})));
  Simulation s = set_up(c);
  EXPECT_TRUE(in_contact(s).empty());
  c.bodies[0].shape = box({block.lower[0], below, 0.0}, {block.upper[0], below + 4.0 * h, 0.0});
  Summary summary;
  summary.in_contact = in_contact(set_up(c));
  ASSERT_EQ(summary.in_contact.size(), 1u);
  EXPECT_EQ(summary.in_contact[0], (std::array<std::string, 2>{"block", "target"}));
  EXPECT_NE(in_words(summary).find("in contact: block and target; bodies that have met stick together"), std::string::npos);
}

TEST(MovingBody, InDoubtMeetsSomething) {
  Case turning = falling_block(), falling = falling_block(), loaded = falling_block(), spreading = falling_block();
  turning.bodies[0].velocity.rotation[2] = 1.0;
  falling.gravity[1] = -9.81;
  loaded.loads.push_back({"block", nullptr, by_hand::table({{0.0, 1e6}}), {}, {}});
  spreading.bodies[0].velocity.radial = 1.0;
  for (const Case& c : {turning, falling, loaded, spreading}) expect_that_it_meets_something(c, true);
}

TEST(Body, ThatStartsMoltenIsNamedWithBothTemperatures) {
  Case c = falling_block();
  c.bodies[0].velocity = {};
  Material& metal = c.bodies[0].material.material;
  metal.melting = melting::Constant{1356.0};
  c.bodies[0].temperature = 1355.9;
  EXPECT_TRUE(set_up_warnings(c).empty());
  c.bodies[0].temperature = 1400.0;
  ASSERT_EQ(set_up_warnings(c).size(), 1u);
  EXPECT_EQ(set_up_warnings(c).front(),
            "block: it starts at 1400 K, not below the melting temperature of elastic, 1356 K: it has no strength");
}

}  // namespace
}  // namespace brisance::simulator
