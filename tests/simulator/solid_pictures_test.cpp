// What the pictures of solids show: the particles fill their body, and the walls are there.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/output/fields.hpp"
#include "simulator/output/particle_cells.hpp"
#include "simulator/run.hpp"
#include "tests/simulator/by_hand.hpp"
#include "tests/simulator/told_to_gnuplot.hpp"

namespace brisance::simulator {
namespace {

constexpr double h = 1e-3, radius = 5.3 * h;

double area_of(const std::vector<Vector>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()])[2];
  return 0.5 * twice;
}

Case disk() {
  Case c;
  c.geometry = Geometry::plane, c.cell_size = h, c.end_time = 1e-5;
  c.bodies = {by_hand::body("disk", by_hand::copper(), by_hand::shape(Sphere{{0.0, 7.0 * h, 0.0}, radius}))};
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above)};
  return c;
}

TEST(TheCellsOfParticles, FillADiskUpToItsEdge) {
  const Case c = disk();
  const Simulation s = set_up(c);
  double area = 0.0, farthest = 0.0;
  for (int p = 0; p < s.bodies[0].particles.size; ++p) {
    const std::vector<Vector> cell = cell_of_particle(c, s.bodies[0], p);
    area += area_of(cell);
    for (const Vector& x : cell) farthest = std::max(farthest, std::hypot(x[0], x[1] - 7.0 * h));
  }
  constexpr double chords = 0.005;  // the edge is straight across a cell
  EXPECT_NEAR(area, std::numbers::pi * radius * radius, chords * area);
  EXPECT_NEAR(farthest, radius, chords * radius);
}

/// Sheared and stretched as a whole: neighbours still touch, and the area grows by det F.
TEST(TheCellsOfParticles, GoWithTheMaterial) {
  const Case c = disk();
  Simulation s = set_up(c);
  Particles& ps = s.bodies[0].particles;
  using L = Layout<2>;
  const double F[2][2] = {{1.3, 0.4}, {0.1, 0.9}};
  double area = 0.0, before = 0.0;
  for (int p = 0; p < ps.size; ++p) {
    before += area_of(cell_of_particle(c, s.bodies[0], p));
    const Vector x = ParticleView(ps, p).position();
    for (int a = 0; a < 2; ++a) {
      ps.motion.at(L::Motion::position + a, p) = F[a][0] * x[0] + F[a][1] * x[1];
      for (int b = 0; b < 2; ++b) ps.rest.at(L::Rest::deformation_gradient + 2 * a + b, p) = F[a][b];
    }
  }
  double highest = 0.0;
  for (int p = 0; p < ps.size; ++p) {
    const std::vector<Vector> cell = cell_of_particle(c, s.bodies[0], p);
    area += area_of(cell);
    for (const Vector& x : cell) highest = std::max(highest, x[1]);
  }
  constexpr double rounding = 1e-6;
  EXPECT_NEAR(area, (1.3 * 0.9 - 0.4 * 0.1) * before, rounding * before);
  constexpr double chords = 0.005;  // the edge is straight across a cell
  EXPECT_NEAR(highest, 0.9 * 7.0 * h + radius * std::hypot(0.1, 0.9), chords * radius);
}

/// A particle that has come far from its neighbours is not drawn as if it still reached them.
TEST(TheCellsOfParticles, AreNoLongerThanNeighboursFeelEachOther) {
  const Case c = disk();
  Simulation s = set_up(c);
  s.bodies[0].particles.rest.at(Layout<2>::Rest::deformation_gradient, 40) = 100.0;
  double low = 1.0, high = -1.0;
  for (const Vector& x : cell_of_particle(c, s.bodies[0], 40)) low = std::min(low, x[0]), high = std::max(high, x[0]);
  EXPECT_NEAR(high - low, 2.0 * h, 1e-5 * h);
}

/// The room ends within a letter of two bytes in one of the two.
TEST(EveryPicture, SaysBelowItsTitleHowItsCaseDiffersAsFarAsThereIsRoom) {
  Case c = disk();
  for (const char* set : {"with cell_size=1 mm", "with cell_size=10 mm"}) {
    c.subtitle = set;
    for (int n = 0; n < 300; ++n) c.subtitle += "µ";
    const std::string told = told_to_gnuplot(c, set_up(c), scratch());
    EXPECT_TRUE(contains(told, "{/=10 \".\"with cell\\\\_size=1")) << told.substr(0, 1000);
    EXPECT_TRUE(contains(told, "µ...\"")) << told.substr(0, 1000);
  }
}

/// A title that has to be small draws its second line nearer: letters of the usual size would lie over it.
TEST(EveryPicture, HasNoLargerLettersBelowItsTitleThanInIt) {
  Case c = disk();
  c.title = std::string(200, 't'), c.subtitle = "below";
  const std::string told = told_to_gnuplot(c, set_up(c), scratch());
  EXPECT_TRUE(contains(told, "{/=8 ")) << told.substr(0, 1000);
  EXPECT_TRUE(contains(told, "t...\"")) << "cut, not beyond both ends of the figure: " << told.substr(0, 1000);
}

/// One row and a body at rest in itself: neither ranges without extent nor lines of one place, nor colours below zero.
TEST(PicturesOfARunThatHasNotBegun, ShowItsOneRow) {
  const fs::path directory = scratch();
  Case c = disk();
  c.output.figures = false;
  GaugeConfig gauge;
  gauge.name = "middle", gauge.kind = GaugeKind::point, gauge.from = {0.0, 7.0 * h, 0.0}, gauge.fields = {"pressure"};
  c.gauges = {gauge};
  Simulation s = set_up(c);
  const RunResult result = run(c, s, {directory, {}, 0});
  ASSERT_EQ(result.ending, Ending::interrupted) << result.message;
  const std::string told = told_to_gnuplot(c, s, directory);
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (std::size_t at = 0; (at = told.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_EQ(count("set xrange [0:1]"), 3) << "energies, numerical books, gauges";
  EXPECT_EQ(count("with lines lw 2"), 0);
  EXPECT_TRUE(contains(told, "set cbrange [0:1]") && contains(told, "set title \"0 everywhere\"")) << told.substr(0, 3000);
}

/// A picture of many fields is no higher than a screen by much.
TEST(ThePictureOfGauges, HasTwoColumnsWhereItsFieldsAreMany) {
  const auto told_of = [](const std::vector<std::string>& fields) {
    const fs::path directory = scratch();
    Case c = disk();
    c.output.figures = false;
    GaugeConfig gauge;
    gauge.name = "middle", gauge.kind = GaugeKind::point, gauge.from = {0.0, 7.0 * h, 0.0}, gauge.fields = fields;
    c.gauges = {gauge};
    Simulation s = set_up(c);
    EXPECT_EQ(run(c, s, {directory, {}, 0}).ending, Ending::interrupted);
    return told_to_gnuplot(c, s, directory);
  };
  EXPECT_TRUE(contains(told_of({"pressure", "density", "temperature", "damage"}), "size 900,1154\n"));
  EXPECT_TRUE(contains(told_of({"pressure", "density", "temperature", "velocity"}), "size 1400,874\n"))
      << "five: two of them components";
}

/// Of a body in space, the layer of particles that the plane z = 0 cuts.
TEST(TheCellsOfParticles, InSpaceAreThoseOfTheMiddle) {
  Case c;
  c.geometry = Geometry::three_dimensional, c.cell_size = h, c.end_time = 1e-5;
  c.bodies = {by_hand::body("block", by_hand::copper(), by_hand::box({0, 0, 0}, {4 * h, 6 * h, 3 * h}))};
  const Simulation s = set_up(c);
  double area = 0.0;
  for (int p = 0; p < s.bodies[0].particles.size; ++p) area += area_of(cell_of_particle(c, s.bodies[0], p));
  EXPECT_NEAR(area, 24 * h * h, 1e-5 * 24 * h * h);
}

TEST(PicturesOfSolids, ShowTheWallsBesideTheBodies) {
  const fs::path directory = scratch();
  Case c = disk();
  const auto lines_of = [&](const std::string& name) {
    const Simulation s = set_up(c);
    const std::string told = told_to_gnuplot(c, s, directory / name);
    EXPECT_TRUE(contains(told, "filledcurves closed")) << told.substr(0, 2000);
    return contains(told, "with lines lw 1.2");
  };
  EXPECT_TRUE(lines_of("with_a_wall"));
  c.boundaries[0].position = -40 * h;  // far away
  EXPECT_FALSE(lines_of("far_from_the_wall"));
}

}  // namespace
}  // namespace brisance::simulator
