// What the fills of a case make is told as the cells hold it.

#include "simulator/gas/fill_reports.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/commands.hpp"
#include "simulator/gas/initial_state.hpp"
#include "simulator/set_up_warnings.hpp"
#include "tests/command_line.hpp"
#include "tests/simulator/case_files.hpp"
#include "tests/simulator/running.hpp"

namespace brisance::simulator {
namespace {

Answer check(const std::string& file, const std::vector<std::string>& changes = {}) {
  std::vector<std::string> words = {"brisance", "check", file};
  for (const std::string& change : changes) words.insert(words.end(), {"--set", change});
  return call_program(run_command_line, words);
}

/// Shapes that cut cells, on lines, radii, in the plane and about an axis; profiles, formulas, energies, several fluids.
TEST(TheContentOfFills, AddsUpToWhatTheCellsHold) {
  for (const auto& [name, changes] :
       {std::pair<const char*, std::vector<std::string>>{"sod", {"gas.fill.1.shape.box.upper=[0.4321]"}},
        {"sedov_spherical_1d", {"gas.fill.1.shape.sphere.radius=0.0083"}},
        {"cylindrical_explosion", {}},
        {"sedov_axisymmetric", {}},
        {"water_air_shock_tube", {}},
        {"isentropic_vortex", {"cell_size=0.3125"}},
        {"blast_tnt_sphere", {"cell_size=10 mm"}}}) {
    SCOPED_TRACE(name);
    const Case c = shipped_case(name, changes);
    const Simulation s = set_up(c);
    const gas::InitialState start(*c.gas, s.gas.fluids, s.gas.cells);
    double mass = 0.0, energy = 0.0, volume = 0.0;
    for (std::size_t n = 0; n < c.gas->fills.size(); ++n) {
      const gas::FillContent content = start.content_of(n);
      mass += content.mass, volume += content.volume;
      EXPECT_LE(content.energy.lowest, content.energy.highest);
      energy += content.mass * content.energy.lowest;
    }
    const gas::Totals totals = gas::totals(s.gas, *s.domain);
    double held = 0.0;
    for (const double m : totals.mass) held += m;
    constexpr double rounding = 1e-11;
    EXPECT_NEAR(mass, held, rounding * held);
    if (totals.kinetic == 0.0) {
      EXPECT_NEAR(energy, totals.energy, rounding * totals.energy);
    }
  }
}

TEST(CheckOfACharge, TellsItsMassAndStateWithUnits) {
  const std::string good = check("blast_tnt_sphere").out;
  for (const char* part :
       {"fill 0, air ", "fill 1, products ", " 0.999061 kg in 0.000612921 m^3 (the whole sphere); 1630 kg/m^3, ",
        ", 4.29851e+06 J/kg, sound ", "; 42.2 cells across\n"})
    EXPECT_TRUE(contains(good, part)) << part << "\n" << good;
  EXPECT_FALSE(contains(good, "warning")) << good;
  // A thousandth of the density.
  EXPECT_TRUE(
      contains(check("blast_tnt_sphere", {"gas.fill.1.density=1.63 kg/m^3"}).out, " 0.000999061 kg in 0.000612921 m^3"));
  // A sphere of 2 mm in cells of 5 mm, as it is and off the centre.
  const std::string small = check("blast_tnt_sphere", {"cell_size=5 mm", "gas.fill.1.shape.sphere.radius=2 mm"}).out;
  EXPECT_TRUE(contains(small, "warning: fill 1, products: 0.8 cells are across it, fewer than 5")) << small;
}

std::string charge(const std::string& geometry, const std::string& lower, const std::string& upper, const std::string& shape) {
  return "geometry = \"" + geometry + "\"\ncell_size = 0.01\nend_time = 1e-6\n[gas]\nlower = " + lower + "\nupper = " + upper +
         "\n[[gas.fluid]]\nname = \"air\"\nmaterial = \"air.toml\"\n[[gas.fill]]\ndensity = 1.2\npressure = 1e5\n"
         "[[gas.fill]]\nshape = " +
         shape + "\ndensity = 1000\npressure = 1e9\n";
}
std::string words_of(const std::string& text, std::size_t fill = 1) {
  const Case c = read_case(written(text));
  const Simulation s = set_up(c);
  return gas::fill_reports(c, s.gas).at(fill).words;
}

TEST(FillReports, NameWhatOneGeometryShowsOfTheWhole) {
  const auto expect = [](const std::string& text, const std::string& part) { EXPECT_TRUE(contains(text, part)) << text; };
  const std::string box = "{ box = { lower = [0.1, 0.1, 0.1], upper = [0.2, 0.3, 0.4] } }";
  expect(words_of(charge("three_dimensional", "[0, 0, 0]", "[0.5, 0.5, 0.5]", box)),
         "6 kg in 0.006 m^3; 1000 kg/m^3, 1e+09 Pa, ");
  // An eighth in a corner of walls.
  expect(words_of(charge("three_dimensional", "[0, 0, 0]", "[0.5, 0.5, 0.5]",
                         "{ box = { lower = [-0.1, -0.1, -0.1], upper = [0.1, 0.1, 0.1] } }")),
         "1 kg in 0.001 m^3, with the mirror images beyond low_x, low_y, low_z 8 kg; ");
  const std::string flat = "{ box = { lower = [0, 0.1], upper = [0.1, 0.2] } }";
  expect(words_of(charge("plane", "[0, 0]", "[0.5, 0.5]", flat)),
         "10 kg/m in 0.01 m^3/m, with the mirror image beyond low_x 20 kg/m; ");
  expect(words_of(charge("axisymmetric", "[0, 0]", "[0.5, 0.5]", flat)), "3.14159 kg in 0.00314159 m^3 (the whole turn); ");
  expect(words_of(charge("planar_1d", "[0]", "[1]", "{ box = { lower = [0.1], upper = [0.3] } }")),
         "200 kg/m^2 in 0.2 m^3/m^2; ");
  // What a later fill lies over is not told twice, and what none is left of is said to be nothing.
  const std::string twice = charge("planar_1d", "[0]", "[1]", "{ box = { lower = [0.1], upper = [0.3] } }") +
                            "[[gas.fill]]\nshape = { box = { lower = [0.1], upper = [0.4] } }\ndensity = 1\npressure = 1e5\n";
  expect(words_of(twice), "nothing: later fills or bodies lie over all of it");
  expect(words_of(twice, 0), "0.84 kg/m^2 in 0.7 m^3/m^2; ");
}

TEST(FillReports, GiveARangeOfWhatVaries) {
  std::string text = charge("planar_1d", "[0]", "[1]", "{ box = { lower = [0], upper = [1] } }");
  text.replace(text.find("density = 1000"), 14, "density = \"1 + x\"");
  const std::string words = words_of(text);
  EXPECT_TRUE(contains(words, "1.5 kg/m^2 in 1 m^3/m^2; 1.00008 to 1.99992 kg/m^3, 1e+09 Pa, ")) << words;
  EXPECT_FALSE(contains(words, "across")) << "it fills the box: " << words;
}

TEST(FillsOfFewCells, AreWarnedOf) {
  const auto warned = [](const std::string& geometry, const std::string& lower, const std::string& upper,
                         const std::string& shape) {
    const std::vector<std::string> all = set_up_warnings(read_case(written(charge(geometry, lower, upper, shape))));
    return std::any_of(all.begin(), all.end(), [](const std::string& w) { return contains(w, "cells are across it"); });
  };
  const auto sphere = [](const char* x, double radius) {
    return fmt::format("{{ sphere = {{ centre = [{}], radius = {} }} }}", x, radius);
  };
  EXPECT_FALSE(warned("spherical_1d", "[0]", "[1]", sphere("0", 0.025)));
  EXPECT_TRUE(warned("spherical_1d", "[0]", "[1]", sphere("0", 0.024)));
  EXPECT_FALSE(warned("plane", "[0, 0]", "[1, 1]", sphere("0.5, 0.5", 0.025)));
  EXPECT_TRUE(warned("plane", "[0, 0]", "[1, 1]", sphere("0.5, 0.5", 0.024)));
  EXPECT_TRUE(warned("plane", "[0, 0]", "[1, 1]", "{ box = { lower = [0.5, 0.1], upper = [0.53, 0.9] } }"));
  EXPECT_TRUE(warned("plane", "[0, 0]", "[1, 1]", "{ sphere = { centre = [0.5, 0.5], radius = 0.3, inner_radius = 0.26 } }"));
  // A strip of four cells, filled from side to side.
  EXPECT_FALSE(warned("plane", "[0, 0]", "[1, 0.04]", "{ box = { lower = [0.2, 0], upper = [0.5, 0.04] } }"));
}

}  // namespace
}  // namespace brisance::simulator
