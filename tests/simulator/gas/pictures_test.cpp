// What the pictures of gas show of bodies and references.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/case_reader.hpp"
#include "simulator/gas/outline.hpp"
#include "simulator/output/line_out.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/command_line.hpp"
#include "tests/simulator/gas/bodies_set_up.hpp"
#include "tests/simulator/small_bar.hpp"
#include "tests/simulator/told_to_gnuplot.hpp"

namespace brisance::simulator {
namespace {

double area_of(const std::vector<Vector>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()])[2];
  return 0.5 * std::abs(twice);
}

/// The circle that a disk, or a sphere through its middle, is in the picture.
TEST(TheOutlineOfABall, IsACircle) {
  constexpr double h = 0.01, radius = 0.06;
  const Vector centre = {0.2, 0.1, 0.0};
  for (const Geometry geometry : {Geometry::plane, Geometry::three_dimensional}) {
    const auto domain = single_process();
    const bool space = geometry == Geometry::three_dimensional;
    const Vector middle = space ? Vector{0.2, 0.1, 0.105} : centre;
    gas::Gas gas = gas::set_up::box(geometry, h, {0, 0, 0}, {40, 20, space ? 20 : 0}, {gas::set_up::ideal_gas()}, *domain);
    gas.bodies.all = {gas::set_up::ball(geometry, h, middle, radius)};
    fill(
        gas,
        [](const Vector&, double) {
          return gas::Filling{0, 1.2, 1e5, {}};
        },
        *domain);
    const gas::Outline outline = gas::outline_of(gas, 10);
    double length = 0.0, area = 0.0;
    for (const auto& [from, to] : outline.contour) {
      constexpr double smeared = 0.1 * h;  // the contour of a curved body lies a little within it
      for (const Vector& x : {from, to}) EXPECT_NEAR(std::hypot(x[0] - centre[0], x[1] - centre[1]), radius, smeared);
      length += magnitude(to - from);
    }
    for (const auto& polygon : outline.solid) area += area_of(polygon);
    constexpr double part = 0.03;  // of smear and particles
    EXPECT_NEAR(length, 2.0 * std::numbers::pi * radius, part * 2.0 * std::numbers::pi * radius);
    EXPECT_NEAR(area, std::numbers::pi * radius * radius, part * std::numbers::pi * radius * radius);
  }
}

/// A disk with its middle on a side of the box: half a circle, and its diameter along the side.
TEST(TheOutlineOfADiskHalfOutOfTheBox, IsClosedAtTheSide) {
  constexpr double h = 0.01, radius = 0.06;
  const auto domain = single_process();
  gas::Gas gas = gas::set_up::box(Geometry::plane, h, {0, 0, 0}, {40, 20, 0}, {gas::set_up::ideal_gas()}, *domain);
  gas.bodies.all = {gas::set_up::ball(Geometry::plane, h, {0.2, 0.0, 0.0}, radius)};
  fill(
      gas,
      [](const Vector&, double) {
        return gas::Filling{0, 1.2, 1e5, {}};
      },
      *domain);
  double along_the_side = 0.0, elsewhere = 0.0;
  for (const auto& [from, to] : gas::outline_of(gas, 0).contour)
    (from[1] == 0.0 && to[1] == 0.0 ? along_the_side : elsewhere) += magnitude(to - from);
  constexpr double part = 0.03;  // of smear and particles
  EXPECT_NEAR(along_the_side, 2.0 * radius, part * 2.0 * radius);
  EXPECT_NEAR(elsewhere, std::numbers::pi * radius, part * std::numbers::pi * radius);
}

TEST(AReferenceOfGas, IsInterruptedWhereABodyIs) {
  constexpr double h = 0.1;
  const LineOut computed{"x", {0.05, 0.15, 0.25, 0.65, 0.75, 0.85}, {}};  // a body from 0.3 to 0.6
  const auto pieces_of = [&](const std::vector<double>& place, const std::vector<double>& value) {
    const LineOut shown = outside_bodies({"x", place, {value}}, computed, h);
    std::vector<std::vector<std::pair<double, double>>> pieces(1);
    for (std::size_t i = 0; i < shown.place.size(); ++i) {
      if (std::isnan(shown.place[i]))
        pieces.emplace_back();
      else
        pieces.back().emplace_back(shown.place[i], shown.values[0][i]);
    }
    return pieces;
  };
  using Piece = std::vector<std::pair<double, double>>;
  // Rows at the faces of the body: nothing is drawn between them.
  EXPECT_EQ(pieces_of({0.0, 0.3, 0.6, 0.9}, {2, 2, 1, 1}), (std::vector<Piece>{{{0.0, 2}, {0.3, 2}}, {{0.6, 1}, {0.9, 1}}}));
  // Rows far away: the line comes as near as the cells do.
  EXPECT_EQ(pieces_of({0.0, 0.9}, {1, 1}), (std::vector<Piece>{{{0.0, 1}, {0.25, 1}}, {{0.65, 1}, {0.9, 1}}}));
  // Without a body nothing is cut.
  const LineOut whole = outside_bodies({"x", {0.0, 1.0}, {{1, 2}}}, {"x", {0.05, 0.15, 0.25, 0.35}, {}}, h);
  EXPECT_EQ(whole.place, (std::vector<double>{0.0, 1.0}));
}

TEST(PicturesOfGas, ShowTheReferenceOverWhatWasComputedAndTheBodyOverTheCells) {
  const fs::path directory = scratch();
  const Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/piston_in_gas.toml", {"end_time=0.05"});
  Simulation s = set_up(c);
  ASSERT_EQ(run(c, s, {directory, {}, 3}).ending, Ending::interrupted);
  const std::string told = told_to_gnuplot(c, s, directory);
  const std::size_t line = told.find("title \"computed\"");
  ASSERT_NE(line, std::string::npos) << told.substr(0, 2000);
  const std::string plot = told.substr(told.rfind('\n', line) + 1, told.find('\n', line) - told.rfind('\n', line) - 1);
  EXPECT_LT(plot.find("title \"computed\""), plot.find("title \"reference\"")) << plot;
  const std::size_t tiles = told.find("boxxyerror");
  ASSERT_NE(tiles, std::string::npos);
  const std::string field = told.substr(tiles, told.find('\n', tiles) - tiles);
  EXPECT_TRUE(contains(field, "filledcurves closed") && contains(field, "with lines")) << field;
}

/// A point is drawn however many places a line has, and these tell where they are; energies are of three kinds.
TEST(PicturesOfGas, DrawEveryPointAndKindOfEnergy) {
  const fs::path directory = scratch();
  Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/sod.toml", {"output.figures=false"});
  for (const char* name : {"profile", "mast"}) {
    GaugeConfig gauge;
    const bool line = std::string(name) == "profile";
    gauge.name = name, gauge.fields = {"pressure"}, gauge.moves = false;
    gauge.kind = line ? GaugeKind::line : GaugeKind::point;
    gauge.from = {0.25, 0.0, 0.0}, gauge.to = {line ? 0.5 : 0.0, 0.0, 0.0};
    c.gauges.push_back(gauge);
  }
  Simulation s = set_up(c);
  ASSERT_EQ(run(c, s, {directory, {}, 30}).ending, Ending::interrupted);
  const std::string told = told_to_gnuplot(c, s, directory);
  for (const char* curve : {"title \"mast\"", "title \"profile, x = 250 mm\"", "title \"profile, x = 500 mm\"",
                            "\"8 of 101 places; all are in history.csv\"", "title \"kinetic\"", "title \"change of internal\"",
                            "Energy of the gas, at the start 1.375 J/m"})
    EXPECT_TRUE(contains(told, curve)) << curve << "\n" << told.substr(0, 6000);
}

/// What gnuplot is told of a range for the first time: "1:2".
std::string range_after(const std::string& told, const std::string& command) {
  const std::size_t begin = told.find(command + " [");
  if (begin == std::string::npos) return "none";
  const std::size_t first = begin + command.size() + 2;
  return told.substr(first, told.find(']', first) - first);
}

/// Of 40 x 20 cells with pressures from 1 to 1.8 Pa one goes wrong: it takes neither all of the colours nor all of the height
/// of a line through it.
TEST(PicturesOfAFailedRun, ShowWhatMostCellsHoldAndSayThatAFewDoNot) {
  constexpr double h = 0.01;
  Case c;
  c.title = "slope", c.geometry = Geometry::plane, c.cell_size = h, c.output.figure_field = "pressure";
  c.figures.push_back({"through", FigureKind::line, "", {"pressure"}, {0.0, 0.105, 0.0}, {0.4, 0.105, 0.0}, {}});
  Simulation s;
  s.geometry = Geometry::plane, s.grid.cell_size = h;
  s.gas = gas::set_up::box(Geometry::plane, h, {0, 0, 0}, {40, 20, 0}, {gas::set_up::ideal_gas()}, *s.domain);
  fill(
      s.gas,
      [](const Vector& x, double) {
        return gas::Filling{0, 1.0, 1.0 + 2.0 * x[0], {}};
      },
      *s.domain);
  const fs::path directory = scratch();
  const auto told = [&](const std::string& name, Of of) {
    fs::create_directories(directory / name);
    return told_to_gnuplot(c, s, directory / name, of);
  };
  const std::string alike = told("alike", Of::failed_run);
  EXPECT_FALSE(contains(alike, "run failed")) << "no value reaches far beyond the others";
  EXPECT_EQ(range_after(alike, "set cbrange"), range_after(told("good", Of::good_run), "set cbrange"));
  gas::set_up::for_each_cell(s.gas, [&](const gas::set_up::Cell& at) {
    if (at.index == std::array{20, 10, 0}) s.gas.primitive.cell(at.block, gas::Primitive::pressure, at.number) = 1e30;
  });
  const std::string failed = told("failed", Of::failed_run);
  const std::string colours = range_after(failed, "set cbrange");
  const double low = std::stod(colours), high = std::stod(colours.substr(colours.find(':') + 1));
  EXPECT_GT(low, 1.0);
  EXPECT_LT(low, 1.0 + 4.0 * h);
  EXPECT_GT(high, 1.8 - 4.0 * h);
  EXPECT_LT(high, 1.8);
  EXPECT_TRUE(contains(failed, "run failed: 1 of 800 values beyond; all from 1.01 Pa to 1e+21 GPa")) << failed.substr(0, 3000);
  const std::size_t line = failed.find("set yrange [1.0");
  EXPECT_NE(line, std::string::npos) << "of the line through the cell";
}

/// The same leaves through each of four sides: all four lines are to be seen, a quarter of the way each.
TEST(PicturesOfEnergy, ShowLinesThatLieOnEachOther) {
  const fs::path directory = scratch();
  std::string text = box_of_air("50 mm", "0.5 ms", "[0, 0]", "[1, 1]");
  for (const char* side : {"low_x", "high_x", "low_y", "high_y"})
    text += std::string("[[gas.edge]]\nside = \"") + side + "\"\nkind = \"pressure\"\npressure = \"0.5 atm\"\n";
  const Case c = read_case(write_text(directory / "box.toml", text), {"output.figures=false"});
  Simulation s = set_up(c);
  ASSERT_EQ(run(c, s, {directory, {}}).ending, Ending::done);
  const std::string told = told_to_gnuplot(c, s, directory);
  const auto style_of = [&](const std::string& title) {
    const std::size_t at = told.find("title \"" + title + '"'), begin = told.rfind("lines", at);
    return told.substr(begin, told.find(" lc", begin) - begin);
  };
  EXPECT_EQ(style_of("through low\\\\_x"), "lines lw 2");
  EXPECT_EQ(style_of("through high\\\\_x"), "lines lw 2 dt (21,7)");
  EXPECT_EQ(style_of("through low\\\\_y"), "lines lw 2 dt (14,14)");
  EXPECT_EQ(style_of("through high\\\\_y"), "lines lw 2 dt (7,21)");
  EXPECT_EQ(style_of("change of internal"), "lines lw 2") << "on no other";
  EXPECT_EQ(style_of("change of the total"), "lines lw 2 dt (14,14)") << "on that, as little is kinetic";
}

TEST(PicturesAboutAnAxis, NameTheCoordinatesAsTheCaseFileDoes) {
  const fs::path directory = scratch();
  const Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/sphere_with_the_gas.toml", {"end_time=1e-3"});
  Simulation s = set_up(c);
  ASSERT_NE(run(c, s, {directory, {}, 2}).ending, Ending::failed);
  const std::string told = told_to_gnuplot(c, s, directory);
  EXPECT_TRUE(contains(told, "set xlabel \"x, the radius")) << told.substr(0, 2000);
  EXPECT_TRUE(contains(told, "set ylabel \"y, along the axis"));
}

}  // namespace
}  // namespace brisance::simulator
