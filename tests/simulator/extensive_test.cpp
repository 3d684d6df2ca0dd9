// What is shown of mass, momentum and energy says what it is of: the whole, a metre of depth or length, a square metre.

#include "simulator/output/extensive.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "models/input/csv.hpp"
#include "models/input/diagnostics.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/gates.hpp"
#include "simulator/output/figures.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/simulator/by_hand.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

constexpr double pi = std::numbers::pi, rounding = 1e-12;

/// Gas of 2 kg/m^3 from 0 to 1 m along every axis, in cells of 1/8 m.
double mass_of_gas(Geometry geometry) {
  Case c;
  c.geometry = geometry, c.cell_size = 0.125, c.end_time = 1.0;
  GasConfig& gas = c.gas.emplace();
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a) gas.upper[a] = 1.0;
  FluidConfig fluid;
  fluid.name = "air", fluid.material.material.equation_of_state = equation_of_state::IdealGas{1.4, 718.0};
  gas.fluids.push_back(fluid);
  FillConfig fill;
  fill.fluid = "air", fill.density = 2.0, fill.pressure = 1e5;
  gas.fills.push_back(fill);
  const BookEntry mass = entries_of(books_of(set_up(c))).front();
  EXPECT_EQ(mass.name, "gas_mass");
  EXPECT_EQ(mass.unit.text, unit_of(Extensive::mass, geometry).text);
  return mass.value;
}

TEST(Extensive, MassOfGasIsThatOfTheVolumeWhichItsUnitSays) {
  const auto expect = [](Geometry geometry, double mass, std::string_view unit) {
    EXPECT_NEAR(mass_of_gas(geometry) / mass, 1.0, rounding) << unit;
    EXPECT_EQ(unit_of(Extensive::mass, geometry).text, unit);
  };
  expect(Geometry::planar_1d, 2.0, "kg/m^2");
  expect(Geometry::cylindrical_1d, 2.0 * pi, "kg/m");
  expect(Geometry::spherical_1d, 2.0 * 4.0 / 3.0 * pi, "kg");
  expect(Geometry::plane, 2.0, "kg/m");
  expect(Geometry::axisymmetric, 2.0 * pi, "kg");
  expect(Geometry::three_dimensional, 2.0, "kg");
}

/// The small bar as a plate.
const std::vector<std::string> as_a_plate = {
    "geometry=plane", "solid.0.shape={box = {lower = [0, 0], upper = [3.2e-3, 12e-3]}}", "end_time=0.2 us"};
Case plate(const fs::path& directory, const std::string& more) {
  return read_case(write_text(directory / "bar.toml", small_bar(more)), as_a_plate);
}

TEST(PlaneStrain, IsShownPerMetreOfDepthEverywhere) {
  const fs::path directory = scratch(), run_directory = directory / "run";
  const Case c = plate(directory, "");
  Simulation s = set_up(c);
  prepare_directory(run_directory, c, false);
  const RunResult result = run(c, s, {run_directory, {}});
  ASSERT_EQ(result.ending, Ending::done) << result.message;
  const CsvFile history = CsvFile::load(run_directory / "history.csv");
  const double mass = c.bodies[0].material.material.density * 3.2e-3 * 12e-3;
  EXPECT_NEAR(history.numbers("mass", Unit{"kg/m"})[0] / mass, 1.0, rounding);
  EXPECT_NEAR(history.numbers("kinetic_energy", Unit{"J/m"})[0] / (0.5 * mass * 190.0 * 190.0), 1.0, rounding);
  EXPECT_NEAR(history.numbers("momentum_y", Unit{"N s/m"})[0] / (-190.0 * mass), 1.0, rounding);
  EXPECT_NO_THROW(history.numbers("angular_momentum_z", Unit{"N s"})) << "N m s per m";
  EXPECT_THROW(history.numbers("kinetic_energy", Unit::J), InputError);
  EXPECT_TRUE(contains(in_words(result.summary), "J/m")) << in_words(result.summary);
  EXPECT_TRUE(contains(text_of(run_directory / "summary.json"), "\"energy\": \"J/m\""));
  EXPECT_FALSE(contains(text_of(run_directory / "log.txt"), "missing")) << "the figures found their columns";
  EXPECT_TRUE(fs::exists(run_directory / "energy.png"));
}

TEST(PlaneStrain, AGateSaysItsLimitPerMetreOfDepth) {
  const fs::path directory = scratch();
  const Case c = plate(directory, "[gates]\nresidual = 1e-30\n[output]\nfigures = false\n");
  Simulation s = set_up(c);
  prepare_directory(directory / "run", c, false);
  const RunResult result = run(c, s, {directory / "run", {}});
  ASSERT_EQ(result.ending, Ending::failed);
  EXPECT_TRUE(contains(result.message, " J/m at most is allowed") || contains(result.message, " N s/m at most is allowed"))
      << result.message;
}

}  // namespace
}  // namespace brisance::simulator
