// Case files of gas that are refused, with which words.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/simulator/case_files.hpp"

namespace brisance::simulator {
namespace {

TEST(CaseReader, RefusesBodiesInTheGasThatOverlapOrDoNotShow) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = bodies_in_gas;
    text.replace(text.find(from), from.size(), to);
    return problems_of(text);
  };
  const auto expect = [](const std::string& problems, const std::string& message) {
    EXPECT_NE(problems.find(message), std::string::npos) << message << "\n" << problems;
  };
  EXPECT_EQ(changed("[\"15 mm\", \"5 mm\"]", "[\"12 mm\", \"5 mm\"]"), "none") << "they touch";
  EXPECT_EQ(
      changed("{ centre = [\"15 mm\", \"5 mm\"], radius = \"3 mm\" }", "{ centre = [\"5 mm\", \"5 mm\"], radius = \"1 mm\" }"),
      "none")
      << "within the ring";
  expect(changed("[\"15 mm\", \"5 mm\"]", "[\"11.5 mm\", \"5 mm\"]"), "ring and shot overlap near (0.00875, 0.005, 0) m");
  // A sheet of 0.6 cells whose middle lies between two lines of nodes.
  const auto sheet = [](const std::string& top) {
    return "{ box = { lower = [\"12 mm\", \"5.2 mm\"], upper = [\"18 mm\", \"" + top + "\"] } }";
  };
  const std::string shot = "{ sphere = { centre = [\"15 mm\", \"5 mm\"], radius = \"3 mm\" } }";
  const std::string unseen = changed(shot, sheet("5.8 mm"));
  expect(unseen, "shot is so thin that the gas does not see it");
  EXPECT_EQ(changed(shot, sheet("6.3 mm")), "none") << "a sheet of 1.1 cells shows wherever it lies";
  // From 1.05 cells on a sheet shows everywhere; by how much the fullest node is filled, 0.4 to 0.6 of its thickness, tells no
  // better than to a half how thick it is.
  const double asked_for = std::stod(unseen.substr(unseen.find("cells of ") + 9));
  EXPECT_GT(0.6e-3 / asked_for, 1.05);
  EXPECT_LT(0.6e-3 / asked_for, 1.5 * 1.05 + 0.01);
  expect(changed(shot, sheet("5.3 mm")), "shot is so thin that the gas does not see it");
  // What reaches beyond the walls is there once, not twice.
  const std::string across = "{ box = { lower = [\"15.2 mm\", \"-9 mm\"], upper = [\"15.7 mm\", \"19 mm\"] } }";
  expect(changed(shot, across), "shot is so thin that the gas does not see it");
}

TEST(CaseReader, RefusesMotionsThatABodyInTheGasCannotMake) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = bodies_in_gas;
    text.replace(text.find(from), from.size(), to);
    return problems_of(text);
  };
  const auto expect = [](const std::string& problems, const std::string& message) {
    EXPECT_NE(problems.find(message), std::string::npos) << "wanted: " << message << "\ngot:    " << problems;
  };
  expect(changed("mass = \"0.2 kg\"", "mass = \"0.2 kg\"\nvelocity = [1, 0]"), "gas.body.1.mass: the gas drives");
  expect(changed("rotation = [0, 0, 5]", "rotation = [1, 0, 5]"), "gas.body.0.rotation: in the plane");
  expect(changed("radius = \"2 mm\"\namp", "amp"), "gas.body.0.radial_velocity: give `radius`");
  expect(changed("radial_velocity = \"10 m/s\"", ""), "gas.body.0.radius: it would be ignored");
  expect(changed("name = \"shot\"", "name = \"ring\""), "is given twice");
  expect(changed("axis = \"y\"", "axis = \"z\""), "gas.body.1.axis");
  expect(changed("mass = \"0.2 kg\"", ""), "gas.body.1.axis: it would be ignored");
  expect(changed("mass = \"0.2 kg\"\naxis = \"y\"", "centre = [1, 1]"), "gas.body.1.centre: it would be ignored");
  expect(changed("mass = \"0.2 kg\"\naxis = \"y\"", "amplitude = { time = [0, 1], value = [0, 1] }"),
         "gas.body.1.amplitude: it would be ignored");
  std::string round = bodies_in_gas;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"\"plane\"", "\"axisymmetric\""},
                                 {"[\"5 mm\", \"5 mm\"]", "[0, \"5 mm\"]"},
                                 {"[\"5 mm\", \"5 mm\"]", "[0, \"5 mm\"]"},
                                 {"[\"15 mm\", \"5 mm\"]", "[0, \"5 mm\"]"}})
    round.replace(round.find(from), from.size(), to);
  expect(problems_of(round), "gas.body.0.velocity: about an axis of symmetry a body can only move along it");
  expect(problems_of(round), "gas.body.0.rotation: about an axis of symmetry a body cannot turn");
  expect(changed("[gas]", "[gas]\nimplicit = true"), "the implicit option in a gas with bodies");
  expect(changed("[gas]", "[gas]\nscheme = \"ice_classic\""), "the classic scheme in a gas with bodies");
  expect(changed("\"air.toml\"", "\"air.toml\"\nviscosity = \"1 Pa s\""), "viscosity or conduction in a gas with bodies");
}

struct HostileGas {
  std::string from, to, message;
};

struct WrongGas : testing::TestWithParam<HostileGas> {};
TEST_P(WrongGas, IsRefusedWithWhatIsAllowed) {
  std::string text = gases;
  const auto& [from, to, message] = GetParam();
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string problems = problems_of(text);
  EXPECT_NE(problems.find(message), std::string::npos) << "wanted: " << message << "\ngot:    " << problems;
}

INSTANTIATE_TEST_SUITE_P(
    CaseReader, WrongGas,
    testing::Values(
        HostileGas{"fluid = \"air\"\n", "fluid = \"aire\"\n",
                   "there is no fluid \"aire\"; there is air, products; did you mean \"air\"?"},
        HostileGas{"temperature = \"300 K\"", "density = 1\ntemperature = \"300 K\"",
                   "gas.fill.0: there are a density and a temperature; give one of the two"},
        HostileGas{"temperature = \"300 K\"\n", "", "gas.fill.0: neither density nor temperature is given"},
        HostileGas{"centre = [\"5 mm\", \"5 mm\"], radius = \"2 mm\"", "centre = [\"5 mm\", \"5 m\"], radius = \"2 mm\"",
                   "case.toml:23:9: gas.fill.1.shape: it fills nothing: no part of it lies in the box of the gas"},
        HostileGas{"shape = { sphere = { centre = [\"5 mm\", \"5 mm\"], radius = \"2 mm\" } }\n", "",
                   "gas.fill.1: without a `shape` it fills all of the box"},
        HostileGas{"pressure = \"1 atm\"\n", "",
                   "gas.fill.0.pressure: missing: the pressure of the gas, or instead of it the density and an energy"},
        HostileGas{"pressure = \"1 atm\"\n", "density = 1\n",
                   "gas.fill.0: there are a density and a temperature; give one of the two and a pressure, or the density and "
                   "an energy"},
        HostileGas{"density = \"2 kg/m^3\"\n", "", "gas.fill.2: neither density nor temperature is given"},
        HostileGas{"density = \"2 kg/m^3\"\n", "density = 2\npressure = 1\n",
                   "gas.fill.2.pressure: it follows from the profile; give one of the two"},
        HostileGas{"file = \"swirl.csv\", along = \"radius\", centre = [\"15 mm\", \"5 mm\"]",
                   "file = \"swirl.csv\", along = \"x\"", "swirl.csv:1:1: there is no column \"x\""},
        HostileGas{"\"swirl.csv\"", "\"bad_profile.csv\"",
                   "bad_profile.csv: the column \"z\" says nothing of a gas; there may be radius, density, pressure"},
        HostileGas{"\"swirl.csv\"", "\"falling.csv\"", "falling.csv: radius must rise from row to row"},
        HostileGas{"\"swirl.csv\"", "\"empty.csv\"", "empty.csv: a density is not above 0"},
        HostileGas{"\"swirl.csv\"", "\"nowhere.csv\"", "nowhere.csv"},
        HostileGas{"shape = { box = { lower = [0, 0], upper = [\"2 mm\", \"2 mm\"] } }\n", "",
                   "gas.fill.3.shape: missing: the region that the energy is put into"},
        HostileGas{"energy = \"2 kJ\"", "energy = \"2 kJ\"\npressure = 1",
                   "gas.fill.3.pressure: it follows from the energy; give one of the two"},
        HostileGas{"density = 1\n", "temperature = \"300 K\"\n",
                   "gas.fill.3.density: missing: the energy needs it, instead of the temperature"},
        HostileGas{"side = \"high_x\"", "side = \"high_z\"", "in 2 dimensions there is no such side"},
        HostileGas{"kind = \"non_reflecting\"", "kind = \"periodic\"", "a state would be ignored"},
        HostileGas{"upper = [\"20 mm\", \"10 mm\"]", "upper = [\"20.5 mm\", \"10 mm\"]", "is on no plane of nodes"},
        HostileGas{"upper = [\"20 mm\", \"10 mm\"]", "upper = [\"20 mm\", \"3 mm\"]",
                   "along y the box is 3 cells of 0.001 m wide; 4 at least"},
        HostileGas{"fraction_air", "fraction_water", "\"fraction_water\" is not known of gas"},
        HostileGas{"from = [\"20 mm\"", "from = [\"25 mm\"",
                   "gauge.0.from: along x 0.025 m is outside the box of the gas, which goes from 0 m to 0.02 m"},
        HostileGas{"[gas]\n", "[[boundary]]\nkind = \"symmetry\"\naxis = \"x\"\nposition = 0\nside = \"above\"\n[gas]\n",
                   "boundary: it would be ignored: there are no solids"},
        HostileGas{"kind = \"non_reflecting\"\nfluid = \"air\"\ntemperature = \"300 K\"\npressure = \"1 atm\"",
                   "kind = \"non_reflecting\"\nfluid = \"air\"\ndensity = \"1.2 kg/m^3\"\npressure = \"-1 atm\"",
                   "\"air\" has no state with -101325 Pa"},
        HostileGas{"kind = \"non_reflecting\"\nfluid = \"air\"\ntemperature = \"300 K\"\npressure = \"1 atm\"",
                   "kind = \"non_reflecting\"\nfluid = \"air\"\ndensity = \"1.2 kg/m^3\"\npressure = 0",
                   "at 1.2 kg/m^3 and 0 Pa \"air\" carries no sound"},
        HostileGas{"\"swirl.csv\"", "\"tension.csv\"", "gas.fill.2.profile: row 2, at 0.004 m: at 2 kg/m^3"},
        HostileGas{"\"swirl.csv\"", "\"nowhere.csv\"", "gas.fill.2.profile: its file cannot be used"},
        HostileGas{"courant = 0.4\n", "acoustic_courant = 5\n", "it is the Courant number of implicit = true"},
        HostileGas{"courant = 0.4\n", "courant = 0.4\nimplicit = true\n", "the steps of implicit = true are those of acoustic"},
        HostileGas{"courant = 0.4\n", "momentum_exchange = 5\n", "have one velocity but with scheme = \"ice_classic\""},
        HostileGas{"courant = 0.4\n", "scheme = \"ice_classic\"\n", "ice_classic has no gravity; remove it"},
        HostileGas{"courant = 0.4\n", "scheme = \"ice_classic\"\n", "ice_classic has walls and periodic sides only"},
        HostileGas{"kind = \"non_reflecting\"", "kind = \"no_slip\"", "of a wall only its velocity and temperature count"},
        HostileGas{"kind = \"non_reflecting\"\nfluid = \"air\"\ntemperature = \"300 K\"\npressure = \"1 atm\"",
                   "kind = \"no_slip\"\nvelocity = [1, 0]", "a wall moves along itself only"},
        HostileGas{"kind = \"non_reflecting\"\nfluid = \"air\"\ntemperature = \"300 K\"\npressure = \"1 atm\"",
                   "kind = \"no_slip\"\ntemperature = \"300 K\"", "nothing sticks to a wall without viscosity"},
        HostileGas{"material = \"air.toml\"", "material = \"air.toml\"\nviscosity = \"1 m\"", "viscosity"}));

TEST(CaseReader, AnEnergyThatNeedsADensityIsOneProblem) {
  std::string text = gases;
  text.erase(text.find("density = 1\n"), 12);
  const std::string problems = problems_of(text);
  EXPECT_TRUE(contains(problems, "gas.fill.3.density: missing: the energy needs it")) << problems;
  EXPECT_EQ(std::count(problems.begin(), problems.end(), '\n'), 0) << problems;
}

/// What is wrong with an edge whatever its kind is meant to be is told beside its unknown kind.
TEST(CaseReader, AnEdgeOfAnUnknownKindDoesNotHideItsOtherMistakes) {
  std::string text = gases;
  const std::string kind = "kind = \"non_reflecting\"\nfluid = \"air\"\n";
  text.replace(text.find(kind), kind.size(), "kind = \"inflw\"\nfluid = \"aire\"\ndensity = 1\n");
  const std::string problems = problems_of(text);
  EXPECT_TRUE(contains(problems, "gas.edge.0.kind: \"inflw\" is unknown")) << problems;
  EXPECT_TRUE(contains(problems, "gas.edge.0.fluid: there is no fluid \"aire\"")) << problems;
  EXPECT_TRUE(contains(problems, "gas.edge.0: there are a density and a temperature")) << problems;
  text.replace(text.find("aire"), 4, "air");
  text.erase(text.find("density = 1\ntemp"), 12);
  text.replace(text.find("pressure = \"1 atm\"", text.find("inflw")), 18, "pressure = -1     ");
  EXPECT_TRUE(contains(problems_of(text), "gas.edge.0.pressure: ")) << problems_of(text);
}

}  // namespace
}  // namespace brisance::simulator
