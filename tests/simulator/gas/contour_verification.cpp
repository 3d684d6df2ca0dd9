// The contour of bodies of particles: what it makes of a plane, of disks and spheres.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "simulator/gas/contour.hpp"
#include "tests/simulator/gas/bodies_set_up.hpp"

namespace brisance::simulator::gas {
namespace {

/// Fraction of solid at a node that lies at a depth below the surface of a half space (in cells): the B-spline integrated.
double smeared_half_space(double depth) {
  const double s = std::abs(depth);
  const double solid = s <= 0.5   ? 0.5 + 0.75 * s - s * s * s / 3.0
                       : s <= 1.5 ? 1.0 - (1.5 - s) * (1.5 - s) * (1.5 - s) / 6.0
                                  : 1.0;
  return depth < 0.0 ? 1.0 - solid : solid;
}

TEST(Depth, OfAHalfSpaceIsTheDistanceToItsSurface) {
  constexpr double round_off = 1e-7;  // the smeared step is flat at its ends
  for (double s = -1.495; s < 1.5; s += 0.01) EXPECT_NEAR(depth_of(smeared_half_space(s)), s, round_off);
  EXPECT_EQ(depth_of(0.0), -1.5);
  EXPECT_EQ(depth_of(1.2), 1.5);
  EXPECT_NE(depth_of(0.5), 0.0);
}

/// Random values at the corners of a cell, among them many small ones.
std::array<double, 8> random_corners(std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::array<double, 8> f;
  for (double& x : f) x = value(random);
  return f;
}

TEST(OpenParts, OfSimplexesAreWhatSamplingFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int problem = 0; problem < 20; ++problem) {
    const std::array<double, 8> f = random_corners(random);
    int open[3] = {};
    constexpr int samples = 40000;
    for (int n = 0; n < samples; ++n) {
      // Uniform in a simplex: the gaps between sorted numbers.
      double u[3] = {part(random), part(random), part(random)};
      open[0] += f[0] + u[0] * (f[1] - f[0]) < 0.0;
      std::sort(u, u + 2);
      open[1] += u[0] * f[0] + (u[1] - u[0]) * f[1] + (1.0 - u[1]) * f[2] < 0.0;
      std::sort(u, u + 3);
      open[2] += u[0] * f[0] + (u[1] - u[0]) * f[1] + (u[2] - u[1]) * f[2] + (1.0 - u[2]) * f[3] < 0.0;
    }
    constexpr double scatter = 5.0 * 0.5 / 200.0;  // five standard deviations
    EXPECT_NEAR(open_part(f[0], f[1]), open[0] / double{samples}, scatter);
    EXPECT_NEAR(open_part(f[0], f[1], f[2]), open[1] / double{samples}, scatter);
    EXPECT_NEAR(open_part(f[0], f[1], f[2], f[3]), open[2] / double{samples}, scatter);
  }
}

TEST(OpenParts, AreMirrorImagesOfEachOther) {
  constexpr double round_off = 1e-14;
  std::mt19937 random(2);
  for (int problem = 0; problem < 1000; ++problem) {
    const std::array<double, 8> f = random_corners(random);
    for (const unsigned axis : {1u, 2u, 4u}) {
      std::array<double, 8> mirrored, opposite;
      for (unsigned i = 0; i < 8; ++i) mirrored[i] = f[i ^ axis], opposite[i] = -f[i];
      EXPECT_NEAR(open_part(f), open_part(mirrored), round_off);
      EXPECT_NEAR(open_part(f) + open_part(opposite), 1.0, round_off) << "gas and solid fill the cell";
    }
  }
}

TEST(OpenParts, OfAPlaneAreExact) {
  constexpr double round_off = 1e-13;
  // x + y + z < 1 cuts a sixth off the cube, and a half of each face through the origin.
  std::array<double, 8> f;
  for (unsigned i = 0; i < 8; ++i) f[i] = static_cast<double>((i & 1) + (i >> 1 & 1) + (i >> 2)) - 1.0 + 1e-15;
  EXPECT_NEAR(open_part(f), 1.0 / 6.0, round_off);
  EXPECT_NEAR(open_part(std::array{f[0], f[1], f[2], f[3]}), 0.5, round_off);
  // x < 3/4 of a square from r = 2 to 3: the mean of r over it is (2 + 2.75)/2, its part 3/4.
  const std::array<double, 4> upright = {-0.75, 0.25, -0.75, 0.25};
  EXPECT_NEAR(open_moment(upright, 2.0, 3.0), 0.75 * 2.375, round_off);
  EXPECT_NEAR(open_moment(-0.75, 0.25, 2.0, 3.0), 0.75 * 2.375, round_off);
  const std::array<double, 4> slanted = {-1.0 + 1e-15, 1e-15, 1e-15, 1.0};  // x + y < 1: centre at a third
  EXPECT_NEAR(open_moment(slanted, 2.0, 3.0), 0.5 * (2.0 + 1.0 / 3.0), round_off);
}

TEST(Gas, OnTwoSidesOfSolidIsSeenAsTwo) {
  EXPECT_FALSE(gas_is_connected(std::array{-0.1, 1.0, 1.0, -0.1}));
  EXPECT_TRUE(gas_is_connected(std::array{-1.0, 0.1, 0.1, -1.0}));
  EXPECT_TRUE(gas_is_connected(std::array{-1.0, -1.0, 0.1, 0.1}));
  EXPECT_FALSE(gas_is_connected(std::array{-1.0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, -1.0}));
  EXPECT_TRUE(gas_is_connected(std::array{-1.0, -0.1, 0.1, -0.1, 0.1, 0.1, 0.1, -1.0}));
}

// Bodies ---------------------------------------------------------------------------------------------------------------

struct Seen {
  double volume = 0.0, area = 0.0;  // of the solid
  double defect = 0.0;              // root mean square
};
/// The body as the contour shows it, and by how much the change of the gas in its cells differs from what the wall sweeps when
/// the body moves a small way.
Seen seen(Geometry geometry, double cell_size, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
          const MovingBody& body, const Vector& way) {
  const auto domain = single_process();
  Gas gas = set_up::box(geometry, cell_size, lower, upper, {set_up::ideal_gas()}, *domain);
  gas.bodies.all = {body};
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1.0, 1.0, {}};
      },
      *domain);
  Bodies& b = gas.bodies;
  MovingBody::State next = body.state;
  next.displacement = way;
  put_on_nodes(b.window, gas.cells, images_of(gas), std::vector{points_of(body, geometry, body.state, next, 1.0)}, b.nodes);
  find_open_space(b.window, gas.cells, b.nodes, b.next_space);
  find_cut_cells(b.window, gas.cells, b.space, b.next_space, b.nodes, b.step);
  Seen result;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    result.volume += (1.0 - open_part(gas, c.block, c.number)) * whole_cell(gas.cells, c.index[0]).volume;
  });
  double square = 0.0, count = 0.0;
  for (const CutCell& c : b.step.cut) {
    if (!gas.cells.contains(b.window.index(c.cell))) continue;
    result.area += magnitude(c.wall);
    const double area = whole_cell(gas.cells, b.window.index(c.cell)[0]).area[1];
    const double defect = (c.growth - dot(c.wall, c.velocity)) / (magnitude(way) * area);
    square += defect * defect, count += 1.0;
  }
  result.defect = std::sqrt(square / count);
  return result;
}

TEST(Contour, OfASphereOfParticlesHasItsAreaAndVolume) {
  // The prototype's numbers, of spheres with random centres: area and volume seen over true ones, defect.
  struct Case {
    double radius, area, volume, defect;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  for (const Case& c : {Case{2.0, 0.790, 0.685, 0.036}, Case{4.0, 0.948, 0.918, 0.016}, Case{8.0, 0.987, 0.980, 0.009}}) {
    const int half = static_cast<int>(c.radius) + 4;
    Seen mean;
    const int samples = c.radius < 5.0 ? 6 : 1;
    for (int n = 0; n < samples; ++n) {
      const Vector centre = {shift(random), shift(random), shift(random)};
      const Seen s = seen(Geometry::three_dimensional, 1.0, {-half, -half, -half}, {half, half, half},
                          set_up::ball(Geometry::three_dimensional, 1.0, centre, c.radius), {0.05, 0.03, 0.02});
      mean.area += s.area / samples, mean.volume += s.volume / samples, mean.defect += s.defect / samples;
    }
    const double area = mean.area / (4.0 * std::numbers::pi * c.radius * c.radius),
                 volume = mean.volume / (4.0 / 3.0 * std::numbers::pi * std::pow(c.radius, 3));
    // A sphere of particles is itself a few percent off where it is small.
    const double tolerance = c.radius < 3.0 ? 0.06 : 0.02;
    EXPECT_NEAR(area, c.area, tolerance) << c.radius;
    EXPECT_NEAR(volume, c.volume, tolerance) << c.radius;
    EXPECT_LT(mean.defect, 1.5 * c.defect) << c.radius;
    RecordProperty(
        "radius_" + std::to_string(static_cast<int>(c.radius)),
        "area " + std::to_string(area) + ", volume " + std::to_string(volume) + ", defect " + std::to_string(mean.defect));
  }
}

TEST(Contour, OfADiskMovesAsTheDisk) {
  constexpr double most = 0.03;  // of the way times a face
  for (const double angle : {0.0, 30.0})
    for (const double radius : {5.0, 10.0, 20.0}) {
      const int half = static_cast<int>(radius) + 4;
      const MovingBody disk = set_up::ball(Geometry::plane, 1.0, {0.13, -0.21, 0.0}, radius, angle * std::numbers::pi / 180.0);
      const Seen s = seen(Geometry::plane, 1.0, {-half, -half, 0}, {half, half, 0}, disk, {0.06, 0.02, 0.0});
      EXPECT_LT(s.defect, most) << radius << " cells, " << angle << " degrees";
      RecordProperty("disk_" + std::to_string(static_cast<int>(radius)) + "_" + std::to_string(static_cast<int>(angle)),
                     std::to_string(s.defect));
    }
}

TEST(Contour, OfASphereAboutTheAxisIsThatOfTheSphere) {
  constexpr double radius = 10.0, most = 0.03, near = 0.02;
  const Seen s = seen(Geometry::axisymmetric, 1.0, {0, -14, 0}, {14, 14, 0},
                      set_up::ball(Geometry::axisymmetric, 1.0, {0.0, 0.17, 0.0}, radius), {0.0, 0.05, 0.0});
  EXPECT_NEAR(s.volume / (2.0 / 3.0 * std::pow(radius, 3)), 1.0, near) << "per radian";
  EXPECT_LT(s.defect, most);
  RecordProperty("defect", std::to_string(s.defect));
}

TEST(Walls, OfAClosedBodyPushItNowhere) {
  constexpr double round_off = 1e-11;
  const auto domain = single_process();
  for (const Geometry geometry : {Geometry::plane, Geometry::three_dimensional}) {
    Gas gas = set_up::box(geometry, 1.0, {-8, -8, -8}, {8, 8, 8}, {set_up::ideal_gas()}, *domain);
    gas.bodies.all = {set_up::ball(geometry, 1.0, {0.3, 0.1, 0.2}, 4.0)};
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.0, 1.0, {}};
        },
        *domain);
    Bodies& b = gas.bodies;
    find_cut_cells(b.window, gas.cells, b.space, b.space, b.nodes, b.step);
    Vector sum{};
    for (const CutCell& c : b.step.cut)
      if (gas.cells.contains(b.window.index(c.cell))) sum = sum + c.wall;
    EXPECT_LT(magnitude(sum), round_off);
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
