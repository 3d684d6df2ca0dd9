// Case files: what is read, what is written, and what is refused with which words.

#include "simulator/case_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "models/input/csv.hpp"
#include "models/input/diagnostics.hpp"
#include "simulator/keys.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

namespace fs = std::filesystem;

const fs::path& folder() {
  static const fs::path path = [] {
    const fs::path made = fs::path(testing::TempDir()) / ("brisance_case_" + std::to_string(getpid()));
    fs::create_directories(made);
    std::ofstream(made / "profile.csv") << "radius [mm],height [mm]\n5.5,0\n3.81,22.5\n";
    std::ofstream(made / "reference.csv") << "y [mm],pressure [GPa]\n0,1\n10,0\n";
    std::ofstream(made / "bad_profile.csv") << "radius [mm],z [mm]\n5.5,0\n";
    std::ofstream(made / "swirl.csv") << "radius [mm],pressure [bar],velocity_around [m/s]\n0,1,0\n2,2,10\n2,3,0\n";
    std::ofstream(made / "tension.csv") << "radius [mm],pressure [bar]\n0,1\n4,-200\n";
    std::ofstream(made / "falling.csv") << "radius [mm],density [kg/m^3]\n2,1\n0,1\n";
    std::ofstream(made / "worse.csv") << "radius [mm],density [kg/m^3],pressure [m],colour\n2,1,1,1\n0,-1,1,1\n";
    std::ofstream(made / "empty.csv") << "radius [mm],density [kg/m^3]\n0,0\n";
    return made;
  }();
  return path;
}

fs::path written(const std::string& text, const std::string& name = "case.toml") {
  std::ofstream(folder() / name) << text;
  return folder() / name;
}

std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_case(written(text), overrides);
  } catch (const InputError& error) {
    std::string what = error.what();
    const std::string prefix = folder().string() + '/';
    for (std::size_t at = 0; (at = what.find(prefix)) != std::string::npos;) what.erase(at, prefix.size());
    return what;
  }
  return "none";
}

const std::string bar = R"(geometry = "axisymmetric"
cell_size = "0.3175 mm"
end_time = "80 us"

[[solid]]
name = "bar"
material = "copper_ofhc_mts.toml"
temperature = "295 K"
velocity = [0, "-190 m/s"]
shape = { cylinder = { start = [0, 0], end = [0, "25.4 mm"], radius = "3.81 mm" } }

[[boundary]]
kind = "rigid_wall"
axis = "y"
position = 0
side = "above"
)";

// Every key, each with another value than its default.
const std::string everything = R"(title = "Everything \"at once\""
subtitle = "with numerics.courant=0.2"
geometry = "three_dimensional"
cell_size = "1 mm"
end_time = "10 us"
gravity = [0, 0, -9.81]
[numerics]
basis = "ugimp"
stress_timing = "usl"
particle_velocity = "flip"
filter_time = 20
courant = 0.25
most_volume_change = 0.05
growth = 1.05
first_step = "1 ns"
least_step = "1 ps"
trimming = 0.1
seed = 7
[[solid]]
name = "target"
material = "steel_hy100.toml"
temperature = "600 K"
shape = { difference = { from = { box = { lower = [-0.01, 0, 0], upper = [0.01, 0.01, 0.01] } }, without = [ { sphere = { centre = [0, 0.01, 0], radius = "3 mm", inner_radius = "1 mm" } } ] } }
porosity = { law = "gaussian", mean = 0.005, standard_deviation = 0.001, upper = 0.02 }
damage = { law = "weibull", scale = 0.1, shape = 2, upper = 0.5 }
strength = { median = 0.9, weibull_modulus = 12, reference_volume = "1 cm^3" }
particles_per_direction = 3
locking_cure = false
velocity = { translation = [1, 2, 3], rotation = [0, 0, "100 1/s"], centre = [0, 0, "5 mm"], radial = "2 m/s", radial_rate = "3 1/s" }
[[solid]]
name = "rod"
material = "copper_ofhc_johnson_cook.toml"
temperature = "300 K"
shape = { union = [ { tube = { start = [0, 0.02, 0], end = [0, 0.03, 0], radius = 0.002, inner_radius = 0.001 } }, { cone = { start = [0, 0.01, 0], end = [0, 0.02, 0], start_radius = 0, end_radius = 0.002 } }, { intersection = [ { cylinder = { start = [0, 0.03, 0], end = [0, 0.04, 0], radius = 0.002 } }, { box = { lower = [0, 0.03, 0], upper = [1, 1, 1] } } ] } ] }
[[boundary]]
kind = "velocity"
axis = "z"
position = "-3 mm"
side = "above"
name = "piston"
velocity = { time = [0, "1 us"], value = ["100 m/s", 0] }
[[boundary]]
kind = "rigid_wall"
axis = "x"
position = "12 mm"
side = "below"
friction = 0.1
[[load]]
body = "target"
region = { sphere = { centre = [0, 0, 0], radius = 0.1 } }
pressure = { time = [0, "5 us"], value = ["10 MPa", 0] }
[[load]]
body = "rod"
traction = [0, "1 MPa", 0]
amplitude = 0.5
[[gauge]]
name = "line"
kind = "line"
fields = ["velocity", "stress_xx"]
from = [0, 0, 0]
to = [0, "1 mm", 0]
moves = false
body = "rod"
[[gauge]]
name = "face"
kind = "surface"
fields = ["velocity"]
from = [0, 0, 0]
to = [0, "1 mm", 0]
axis = "z"
side = "below"
[[measure]]
kind = "diameter_at"
name = "waist"
body = "rod"
axis = "z"
at = 0.5
measured = "4 mm"
[[measure]]
kind = "profile_error"
body = "rod"
profile = "profile.csv"
[[figure]]
name = "through"
kind = "line"
fields = ["velocity", "pressure"]
from = [0, 0, 0]
to = [0, "10 mm", 0]
body = "target"
reference = "reference.csv"
[output]
history_interval = "1 us"
snapshot_interval = "2 us"
checkpoint_interval = "3 us"
checkpoint_steps = 400
checkpoint_wall = "5 min"
figure_field = "temperature"
figures = false
grid = true
[gates]
residual = 1e-9
numerical = 0.5
fastest = "3 km/s"
)";

TEST(CaseReader, ReadsABarAsWritten) {
  const Case c = read_case(written(bar));
  EXPECT_EQ(c.title, "case");
  EXPECT_EQ(c.geometry, Geometry::axisymmetric);
  EXPECT_EQ(c.dimensions(), 2);
  EXPECT_EQ(c.cell_size, 0.3175e-3);
  EXPECT_EQ(c.end_time, 80e-6);
  ASSERT_EQ(c.bodies.size(), 1u);
  EXPECT_EQ(c.bodies[0].velocity.translation, (Vector{0, -190, 0}));
  EXPECT_EQ(c.bodies[0].temperature, 295);
  EXPECT_EQ(c.bodies[0].material.material.name, "OFHC copper, annealed (mechanical threshold stress)");
  const Cone& cylinder = std::get<Cone>(c.bodies[0].shape->form);
  EXPECT_EQ(cylinder.end, (Vector{0, 0.0254, 0}));
  EXPECT_EQ(cylinder.start_radius, 0.00381);
  EXPECT_EQ(cylinder.end_radius, 0.00381);
  ASSERT_EQ(c.boundaries.size(), 1u);
  EXPECT_EQ(c.boundaries[0].name, "rigid_wall_y_above");
  EXPECT_EQ(c.numerics.courant, 0.0);
}

TEST(CaseReader, ReadsEveryKey) {
  const Case c = read_case(written(everything));
  EXPECT_EQ(c.title, "Everything \"at once\"");
  EXPECT_EQ(c.gravity, (Vector{0, 0, -9.81}));
  EXPECT_EQ(c.numerics.basis, Basis::ugimp);
  EXPECT_EQ(c.numerics.stress_timing, StressTiming::usl);
  EXPECT_EQ(c.numerics.particle_velocity, ParticleVelocity::flip);
  EXPECT_EQ(c.numerics.least_step, 1e-12);
  EXPECT_EQ(c.numerics.seed, 7u);
  const BodyConfig& target = c.bodies.at(0);
  EXPECT_EQ(std::get<porosity::initial::Gaussian>(target.porosity.value()).mean, 0.005);
  EXPECT_EQ(std::get<porosity::initial::Weibull>(target.damage.value()).shape, 2.0);
  EXPECT_EQ(target.strength.value().reference_volume, 1e-6);
  EXPECT_EQ(target.velocity.rotation, (Vector{0, 0, 100}));
  EXPECT_EQ(target.velocity.radial_rate, 3.0);
  EXPECT_EQ(target.particles_per_direction, 3);
  EXPECT_FALSE(target.locking_cure);
  EXPECT_EQ(std::get<Difference>(target.shape->form).without.size(), 1u);
  EXPECT_EQ(std::get<Union>(c.bodies.at(1).shape->form).parts.size(), 3u);
  EXPECT_EQ(c.boundaries.at(0).velocity(0.5e-6), 50.0);
  EXPECT_EQ(c.boundaries.at(1).friction, 0.1);
  EXPECT_EQ(c.loads.at(0).pressure.value()(2.5e-6), 5e6);
  EXPECT_TRUE(c.loads.at(0).region);
  EXPECT_EQ(c.loads.at(1).traction, (Vector{0, 1e6, 0}));
  EXPECT_EQ(c.loads.at(1).amplitude.value()(0.0), 0.5);
  EXPECT_EQ(c.gauges.at(0).fields, (std::vector<std::string>{"velocity", "stress_xx"}));
  EXPECT_EQ(c.gauges.at(0).moves, false);
  EXPECT_FALSE(c.gauges.at(0).axis || c.gauges.at(1).moves);
  EXPECT_EQ(c.gauges.at(1).axis, Axis::z);
  EXPECT_EQ(c.gauges.at(1).side, Side::below);
  EXPECT_EQ(c.measures.at(0).measured, 0.004);
  EXPECT_EQ(c.measures.at(1).profile, folder() / "profile.csv");
  EXPECT_EQ(c.figures.at(0).fields, (std::vector<std::string>{"velocity", "pressure"}));
  EXPECT_EQ(c.figures.at(0).to, (Vector{0, 0.01, 0}));
  EXPECT_EQ(c.figures.at(0).reference, folder() / "reference.csv");
  EXPECT_EQ(c.output.checkpoint_wall, 300.0);
  EXPECT_TRUE(c.output.grid);
  EXPECT_EQ(c.output.figure_field, "temperature");
  EXPECT_EQ(c.gates.fastest, 3000.0);
}

std::string without_comments(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    result += line.substr(0, line.find("  # ")) + '\n';
    begin = end + 1;
  }
  return result;
}

/// Every key of the gas.
const std::string gases = R"(
geometry = "plane"
cell_size = "1 mm"
end_time = "1 us"
gravity = [0, -9.81]
[gas]
lower = [0, 0]
upper = ["20 mm", "10 mm"]
courant = 0.4
least_mach = 0.02
[[gas.fluid]]
name = "air"
material = "air.toml"
[[gas.fluid]]
name = "products"
material = "pbx_9501_products.toml"
[[gas.fill]]
fluid = "air"
temperature = "300 K"
pressure = "1 atm"
[[gas.fill]]
fluid = "products"
shape = { sphere = { centre = ["5 mm", "5 mm"], radius = "2 mm" } }
density = "1000 kg/m^3"
pressure = "5 GPa"
velocity = ["100 m/s", 0]
[[gas.fill]]
fluid = "air"
shape = { sphere = { centre = ["15 mm", "5 mm"], radius = "2 mm" } }
density = "2 kg/m^3"
profile = { file = "swirl.csv", along = "radius", centre = ["15 mm", "5 mm"] }
[[gas.fill]]
fluid = "air"
shape = { box = { lower = [0, 0], upper = ["2 mm", "2 mm"] } }
density = 1
energy = "2 kJ"
[[gas.edge]]
side = "high_x"
kind = "non_reflecting"
fluid = "air"
temperature = "300 K"
pressure = "1 atm"
[[gauge]]
name = "wall"
kind = "point"
from = ["20 mm", "5 mm"]
fields = ["pressure", "fraction_air"]
)";
/// The same with an explosive that is lit.
const std::string burning = gases + R"([[gas.fluid]]
name = "explosive"
material = "pbx_9501.toml"
[[gas.reaction]]
reactant = "explosive"
product = "products"
[[gas.reaction.ignition]]
shape = { box = { lower = [0, 0], upper = ["5 mm", "10 mm"] } }
time = "1 us"
)";

/// Every key of a body in the gas.
const std::string bodies_in_gas = box_of_air("1 mm", "1 us", "[0, 0]", "[0.02, 0.01]") + R"([[gas.body]]
name = "ring"
shape = { sphere = { centre = ["5 mm", "5 mm"], radius = "4 mm", inner_radius = "2 mm" } }
particles_per_direction = 3
velocity = ["100 m/s", 0]
rotation = [0, 0, 5]
centre = ["5 mm", "5 mm"]
radial_velocity = "10 m/s"
radius = "2 mm"
amplitude = { time = [0, "1 us"], value = [0, 1] }
[[gas.body]]
name = "shot"
shape = { sphere = { centre = ["15 mm", "5 mm"], radius = "3 mm" } }
mass = "0.2 kg"
axis = "y"
)";

TEST(CaseReader, ReadsBodiesInTheGas) {
  const Case c = read_case(written(bodies_in_gas));
  const std::vector<GasBodyConfig>& bodies = c.gas.value().bodies;
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0].rotation, (Vector{0, 0, 5}));
  EXPECT_EQ(bodies[0].radial_velocity, 10.0);
  EXPECT_EQ((*bodies[0].amplitude)(0.5e-6), 0.5);
  EXPECT_FALSE(bodies[0].mass.has_value());
  EXPECT_EQ(bodies[1].mass, 0.2);
  EXPECT_EQ(bodies[1].axis, Axis::y);
}

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

TEST(CaseReader, ReadsTheGas) {
  const Case c = read_case(written(gases));
  ASSERT_TRUE(c.gas.has_value());
  EXPECT_EQ(c.gas->upper, (Vector{0.02, 0.01, 0}));
  EXPECT_EQ(c.gas->fluids.at(1).name, "products");
  EXPECT_EQ(c.gas->fills.at(0).pressure->number, 101325.0);
  EXPECT_EQ(c.gas->fills.at(1).velocity.numbers(), (Vector{100, 0, 0}));
  EXPECT_EQ(c.gas->fills.at(2).profile->file, folder() / "swirl.csv");
  EXPECT_EQ(c.gas->fills.at(2).profile->along, ProfileAlong::radius);
  EXPECT_EQ(c.gas->fills.at(2).profile->centre, (Vector{0.015, 0.005, 0}));
  EXPECT_EQ(c.gas->fills.at(3).energy, 2000.0);
  EXPECT_EQ(c.gas->edges.at(0).kind, EdgeKind::non_reflecting);
  EXPECT_EQ(c.gauges.at(0).moves, false);
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
        HostileGas{"pressure = \"1 atm\"\n", "", "gas.fill.0.pressure: missing"},
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
        HostileGas{"upper = [\"20 mm\", \"10 mm\"]", "upper = [\"20 mm\", \"3 mm\"]", "the box is 3 cells wide; 4 at least"},
        HostileGas{"fraction_air", "fraction_water", "\"fraction_water\" is not known of gas"},
        HostileGas{"from = [\"20 mm\"", "from = [\"25 mm\"", "along x it leaves the box of the gas"},
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

TEST(CaseReader, AWrittenCaseReadsBackToTheSame) {
  for (const std::string& text : {bar, everything, burning, bodies_in_gas}) {
    const std::string once = write_case(read_case(written(text)));
    EXPECT_EQ(write_case(read_case(written(once, "again.toml"))), once);
  }
}

TEST(CaseReader, AWrittenCaseHoldsEveryKey) {
  // The text that is written is what the comparison above rests on: no key may be missing from it.
  const std::string text = without_comments(write_case(read_case(written(everything)))) +
                           without_comments(write_case(read_case(written(burning)))) +
                           without_comments(write_case(read_case(written(bodies_in_gas))));
  for (const KeyDescription& key : all_keys()) {
    if (key.path.find("cylinder") != std::string::npos || key.path.find("tube") != std::string::npos)
      continue;                                            // written as cones
    if (key.path.ends_with("material_changes")) continue;  // they are in the material
    const std::string name = key.path.substr(key.path.rfind('.') + 1);
    const bool found = text.find(name + " = ") != std::string::npos || text.find('[' + name + ']') != std::string::npos ||
                       text.find('.' + name + ']') != std::string::npos;
    EXPECT_TRUE(found) << key.path;
  }
}

TEST(CaseReader, OverridesReachIntoMaterialFiles) {
  const auto strength = [](const Case& c) {
    return std::get<flow_stress::MechanicalThresholdStress>(c.bodies.at(0).material.material.flow_stress.value())
        .athermal_stress;
  };
  EXPECT_EQ(strength(read_case(written(bar))), 40e6);
  EXPECT_EQ(strength(read_case(written(bar), {"solid.0.material.flow_stress.athermal_stress=50 MPa"})), 50e6);
  std::string changed = bar;
  changed.insert(changed.find("temperature"), "material_changes = [\"flow_stress.athermal_stress = 45 MPa\"]\n");
  EXPECT_EQ(strength(read_case(written(changed))), 45e6);
  // The command line has the last word.
  EXPECT_EQ(strength(read_case(written(changed), {"solid.0.material.flow_stress.athermal_stress=50 MPa"})), 50e6);
  EXPECT_EQ(strength(read_case(written(changed), {"solid.0.material_changes=[\"flow_stress.athermal_stress = 55 MPa\"]"})),
            55e6);
  EXPECT_EQ(read_case(written(bar), {"solid.0.velocity=[0, -200]", "cell_size=0.5 mm"}).bodies[0].velocity.translation[1],
            -200);
}

/// A change of the bar that makes it wrong, and the message.
struct Hostile {
  const char* found;  // text that is replaced
  const char* by;
  const char* message;
};

TEST(CaseReader, SaysWhatIsWrongAndWhatIsAllowed) {
  const std::vector<Hostile> all = {
      {"cell_size = \"0.3175 mm\"\n", "",
       "cell_size: missing: width of a cell of the grid; give a number in m or a text such as \"25.4 mm\", > 0"},
      {"80 us", "0 us", "case.toml:3:12: end_time: \"0 us\" is out of range; it must be > 0 (in s)"},
      {"80 us", "80 mm",
       "case.toml:3:12: end_time: \"80 mm\" is not a time: \"mm\" measures a length; give a number in s or a text such as \"20 "
       "us\""},
      {"axisymmetric", "axisymetric",
       "case.toml:1:12: geometry: \"axisymetric\" is unknown; it must be one of plane, axisymmetric, three_dimensional, "
       "planar_1d, "
       "cylindrical_1d, spherical_1d; did "
       "you mean \"axisymmetric\"?"},
      {"cell_size", "cellsize", "case.toml:2:1: cellsize: unknown key; did you mean \"cell_size\"?"},
      {"[0, \"-190 m/s\"]", "[0, 0, \"-190 m/s\"]",
       "case.toml:9:12: solid.0.velocity: the list has 3 elements; give a list of 2 elements, each a number in m/s or a text "
       "such as \"4.5 km/s\""},
      {"[0, \"-190 m/s\"]", "[1, \"-190 m/s\"]",
       "case.toml:9:12: solid.0.velocity: in the axisymmetric geometry no body moves along the radius x as a whole; give 0, or "
       "`radial`"},
      {"[0, \"-190 m/s\"]", "{ rotation = [0, 0, 1] }",
       "case.toml:9:12: solid.0.velocity: in the axisymmetric geometry nothing rotates"},
      {"copper_ofhc_mts.toml", "copper_ofhc_mtx.toml", "did you mean \"copper_ofhc_mts.toml\"?"},
      {"name = \"bar\"", "name = \"a bar\"",
       "case.toml:6:8: solid.0.name: \"a bar\": it becomes part of file names; give letters, digits, _ and -"},
      {"cylinder", "cylindre",
       "solid.0.shape.cylindre: \"cylindre\" is no shape; it must be one of box, cylinder, cone, sphere, tube, union, "
       "intersection, difference; did you mean \"cylinder\"?"},
      {"{ cylinder = { start = [0, 0], end = [0, \"25.4 mm\"], radius = \"3.81 mm\" } }", "3",
       "case.toml:10:9: solid.0.shape: this is the number 3; a table [solid.0.shape] is required"},
      {"start = [0, 0]", "start = [1, 0]",
       "solid.0.shape.cylinder.start: in the axisymmetric geometry it lies on the axis; give x = 0"},
      {"\"25.4 mm\"]", "0]", "solid.0.shape.cylinder.end: it is where the start is; a solid of revolution has a length"},
      {"3.81 mm\" } }", "0.2 mm\" } }",
       "case.toml:10:9: solid.0.shape: along x it is 0.0002 m wide, less than one cell of 0.0003175 m"},
      {"{ cylinder = { start = [0, 0], end = [0, \"25.4 mm\"], radius = \"3.81 mm\" } }",
       "{ box = { lower = [0, 1], upper = [1, 0] } }",
       "solid.0.shape.box.upper: along y it is 0 m, not above the lower corner's 1 m"},
      {"{ cylinder = { start = [0, 0], end = [0, \"25.4 mm\"], radius = \"3.81 mm\" } }",
       "{ intersection = [ { box = { lower = [0, 0], upper = [1, 1] } }, { box = { lower = [2, 0], upper = [3, 1] } } ] }",
       "solid.0.shape: it fills nothing: its parts do not meet"},
      {"{ cylinder = { start = [0, 0], end = [0, \"25.4 mm\"], radius = \"3.81 mm\" } }",
       "{ difference = { from = { sphere = { centre = [0, 0.1], radius = 0.01 } }, without = [ { box = { lower = [0, 0], upper "
       "= "
       "[1, 1] } } ] } }",
       "case.toml:10:9: solid.0.shape: it fills nothing: what is taken away leaves no part that could hold a particle"},
      {"{ cylinder = { start = [0, 0], end = [0, \"25.4 mm\"], radius = \"3.81 mm\" } }", "{ union = [] }",
       "solid.0.shape.union: a list of shapes is required, with at least one"},
      {"position = 0", "position = \"-1 mm\"",
       "case.toml:15:12: boundary.0.position: -0.001 m is on no plane of nodes; the nearest are -0.00127 m and -0.0009525 m"},
      {"position = 0", "position = \"3.175 mm\"",
       "case.toml:16:8: boundary.0.side: solid \"bar\" reaches to y = 0 m, below the boundary at 0.003175 m; the bodies must "
       "be above it"},
      {"position = 0", "position = \"317.5 km\"",
       "boundary.0.side: solid \"bar\" reaches to y = 0 m, below the boundary at 317500 m"},
      {"axis = \"y\"", "axis = \"z\"", "case.toml:14:8: boundary.0.axis: there is no z in two dimensions; give x or y"},
      {"rigid_wall", "velocity", "boundary.0.velocity: missing: how the boundary moves, for its kind is velocity"},
      {"\"rigid_wall\"", "\"symmetry\"\nvelocity = \"10 m/s\"",
       "boundary.0.velocity: it would be ignored: the kind is neither velocity nor rigid_wall"},
      {"\"rigid_wall\"", "\"symmetry\"\nfriction = 0.2",
       "case.toml:14:12: boundary.0.friction: it would be ignored: the kind is not rigid_wall"},
      {"side = \"above\"\n", "side = \"above\"\n[[measure]]\nkind = \"final_length\"\nbody = \"bat\"",
       "case.toml:19:8: measure.0.body: there is no solid \"bat\"; there is bar; did you mean \"bar\"?"},
      {"side = \"above\"\n", "side = \"above\"\n[[measure]]\nkind = \"diameter_at\"",
       "measure.0.at: missing: where along the initial length, > 0 and up to 1"},
      {"side = \"above\"\n", "side = \"above\"\n[[measure]]\nkind = \"profile_error\"\nprofile = \"bad_profile.csv\"",
       "bad_profile.csv:1:1: there is no column \"height\"; there are radius, z"},
      {"side = \"above\"\n", "side = \"above\"\n[[measure]]\nkind = \"final_length\"\n[[measure]]\nkind = \"final_length\"",
       "measure.1.name: the name \"final_length\" is given twice; give each its own"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"point\"\nfrom = [0, 0]\nfields = [\"presure\"]",
       "case.toml:21:10: gauge.0.fields: \"presure\" cannot be recorded; it must be one of position, velocity,"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[figure]]\nname = \"a\"\nkind = \"line\"\nfrom = [0, 0]\nto = [0, 1]\nfields = [\"position\"]",
       "figure.0.fields: \"position\" cannot be drawn; it must be one of velocity, stress_xx,"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[figure]]\nname = \"a\"\nkind = \"line\"\nfrom = [0, 0]\nto = [0, 0]\nfields = [\"pressure\"]",
       "figure.0.to: it is where `from` is; a line has a length"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[figure]]\nname = \"a/b\"\nkind = \"line\"\nfrom = [0, 0]\nto = [0, 1]\nfields = [\"pressure\"]",
       "figure.0.name: \"a/b\": it becomes part of file names; give letters, digits, _ and -"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[figure]]\nname = \"a\"\nkind = \"line\"\nfrom = [0, 0]\nto = [0, 1]\nfields = [\"density\"]\n"
       "reference = \"reference.csv\"",
       "reference.csv: none of its columns is drawn; at least one of density is required"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"point\"\nfrom = [0, 0]\nfields = [\"pressure\"]\naxis = \"y\"",
       "gauge.0.axis: it would be ignored: the kind is not surface"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"plane\"\nfrom = [0, 0]\nto = [1, 1]\nfields = "
       "[\"pressure\"]\nside = "
       "\"below\"",
       "gauge.0.side: it would be ignored: the kind is not surface"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"surface\"\nfrom = [0, 0]\nto = [1, 1]\nfields = [\"pressure\"]",
       "gauge.0.axis: missing: the direction in which the surface is sought"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"surface\"\naxis = \"y\"\nmoves = true\nfrom = [0, 0]\nto = [1, "
       "1]\nfields = [\"pressure\"]",
       "gauge.0.moves: it would be ignored: a surface is where the material ends"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"point\"\nfrom = [0, \"-1 mm\"]\nfields = [\"pressure\"]\nmoves = "
       "false",
       "gauge.0.from: it lies beyond the boundary \"rigid_wall_y_above\" at y = 0 m, where there is never any material"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"point\"\nfrom = [\"-1 mm\", 0]\nfields = [\"pressure\"]",
       "gauge.0.from: x = -0.001 m; a radius is not negative"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"point\"\nfrom = [0, \"26 mm\"]\nfields = [\"pressure\"]",
       "gauge.0.from: it is more than a cell away from all solids; what moves with the material starts in it: give another "
       "place, or moves = false"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"plane\"\nfrom = [\"5 mm\", 0]\nto = [\"6 mm\", \"1 mm\"]\nfields "
       "= "
       "[\"pressure\"]\nbody = \"bar\"",
       "gauge.0.from: all of it is more than a cell away from solid \"bar\""},
      // Of the bar's volume, 3.81^2 x 25.4 mm^3, the ball has 2/3 x 27 mm^3.
      {"[[boundary]]",
       "[[solid]]\nname = \"ball\"\nmaterial = \"copper_ofhc_mts.toml\"\ntemperature = \"295 K\"\nshape = { sphere = { centre "
       "= "
       "[0, \"25.4 mm\"], radius = \"3 mm\" } }\n[[boundary]]",
       "solid.1.shape: it fills about 4.9 % of solid \"bar\" as well, between (0, 0.0224) and (0.003, 0.0254) m; two bodies "
       "are not in "
       "one place"},
      {"[[boundary]]", "[numerics]\ntrimming = 0.05\n[[boundary]]",
       "numerics.trimming: it would be ignored: in two dimensions a sub-cell is sampled in 16 places; give 0, or 0.0625 and "
       "more"},
      {"[[boundary]]", "[output]\nfigure_field = \"velocity\"\n[[boundary]]",
       "output.figure_field: \"velocity\" cannot be drawn; it must be one of stress_xx,"},
      {"side = \"above\"\n",
       "side = \"above\"\n[[boundary]]\nname = \"piston\"\nkind = \"velocity\"\naxis = \"y\"\nposition = \"25.4 mm\"\nside = "
       "\"below\"\nvelocity = \"-400 m/s\"",
       "boundary.1.velocity: it moves 0.032 m; the grid travels with the only plane across an axis, and here y has others"},
      {"side = \"above\"\n", "side = \"above\"\n[[load]]\nregion = { sphere = { centre = [0, 0], radius = 1 } }",
       "load.0: nothing acts; give pressure or traction"},
      {"temperature = \"295 K\"", "temperature = \"295 K\"\nporosity = { law = \"constant\", value = 0.01 }",
       "solid.0.porosity: it would be ignored: the material has no [porosity] table"},
      {"temperature = \"295 K\"", "temperature = \"295 K\"\nmaterial_changes = [\"flow_stress.beta = 1\"]",
       "case.toml: solid.0.material_changes: flow_stress.beta: unknown key"},
      {"[[boundary]]", "[numerics]\nseed = -1\n[[boundary]]",
       "numerics.seed: -1 is out of range; it must be a whole number between 0 and 2147483647"},
  };
  for (const Hostile& hostile : all) {
    std::string text = bar;
    const std::size_t at = text.find(hostile.found);
    ASSERT_NE(at, std::string::npos) << hostile.found;
    text.replace(at, std::string(hostile.found).size(), hostile.by);
    EXPECT_NE(problems_of(text).find(hostile.message), std::string::npos)
        << "wanted: " << hostile.message << "\ngot:    " << problems_of(text);
  }
}

TEST(CaseReader, DoesNotBlameAShapeForAWrongCellSize) {
  std::string text = bar;
  text.replace(text.find("0.3175 mm"), 9, "0.3175 s");
  const std::string problems = problems_of(text);
  EXPECT_NE(problems.find("cell_size: \"0.3175 s\" is not a length"), std::string::npos) << problems;
  EXPECT_EQ(problems.find("fills nothing"), std::string::npos) << problems;
}

TEST(CaseReader, ReportsAllProblemsAtOnce) {
  const std::string text = R"(geometry = "axisymmetric"
cell_size = -1
[[solid]]
name = "bar"
material = "nothing.toml"
shape = { ball = {} }
[[measure]]
kind = "weight"
)";
  const std::string what = problems_of(text);
  for (const char* key : {"cell_size: ", "end_time: missing", "solid.0.material: there is no material file",
                          "solid.0.shape.ball: ", "solid.0.temperature: missing", "measure.0.kind: \"weight\" is unknown"})
    EXPECT_NE(what.find(key), std::string::npos) << key << "\n" << what;
  EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 5) << what;  // these six and no follow-ups
}

/// Many mistakes, of which none hides another: each is reported in the first round, and no follow-ups.
const std::string wrong_gas = R"(geometry = "plane"
cell_size = "1 mm"
end_time = "1 us"
[gas]
lower = [0, 0]
upper = ["20.5 mm", "10 mm"]
courant = 5
[[gas.fluid]]
name = "air"
material = "air.toml"
viscosity = "1 m"
[[gas.fluid]]
name = "air"
material = "nothing.toml"
[[gas.fill]]
fluid = "aire"
pressure = "1 atm"
temperature = "300 K"
[[gas.fill]]
fluid = "air"
shape = { sphere = { centre = [0, 0] } }
density = -1
[[gas.edge]]
side = "high_x"
kind = "periodic"
[[gas.edge]]
side = "up"
kind = "inflow"
fluid = "air"
[[gas.body]]
name = "a b"
shape = { sphere = { centre = ["5 mm", "5 mm"], radius = "3 mm" } }
rotation = [1, 0, 0]
particles_per_direction = 20
[[gas.body]]
name = "c"
shape = { sphere = { centre = ["7 mm", "5 mm"], radius = "3 mm" } }
mass = "1 m"
[[gauge]]
name = "g"
kind = "point"
from = ["50 mm", 0]
fields = ["presure"]
colour = "red"
[[figure]]
name = "f"
kind = "lines"
fields = ["pressure"]
from = [0, 0]
to = [0, "5 mm"]
reference = "nowhere.csv"
)";
const std::string wrong_solids = R"(geometry = "axisymmetric"
cell_size = "1 mm"
end_time = "80 us"
[[solid]]
name = "bar"
material = "nothing.toml"
temperature = "295 K"
velocity = [3, "-190 m/s"]
shape = { cylinder = { start = [0, 0], end = [0, "25 mm"], radius = "4 mm" } }
[[solid]]
name = "bar"
material = "copper_ofhc_mts.toml"
shape = { cylinder = { start = [0, "20 mm"], end = [0, "30 mm"], radius = "4 mm" } }
porosity = { law = "constant", value = 0.01 }
[[boundary]]
kind = "symmetry"
axis = "w"
position = 0
side = "above"
friction = 0.2
[[boundary]]
kind = "rigid_wall"
axis = "y"
position = "5.5 mm"
side = "up"
[[load]]
body = "bat"
region = { sphere = { centre = [0, 0] } }
[[gauge]]
name = "g"
kind = "pint"
from = [0, 0]
fields = ["presure"]
[[gauge]]
name = "g"
kind = "point"
from = [0, "-500 mm"]
to = [0, "1 mm"]
fields = 3
[[measure]]
kind = "diameter_at"
body = "bat"
measured = "4 s"
[[measure]]
kind = "profile_error"
profile = "nowhere.csv"
axis = "q"
[[figure]]
name = "a/b"
kind = "line"
fields = ["position"]
from = [0, 0]
to = [0, 0]
[output]
figure_field = 3
history_interval = -1
[gates]
residual = 0
)";

struct FirstRound {
  std::string text;
  std::vector<std::string> problems;  // each on a line of its own
};
TEST(CaseReader, ReportsWhatCanBeJudgedWhateverElseIsWrong) {
  const auto with_geometry = [](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::vector<std::string> of_gas = {"gas.upper: along x 0.0205 m is on no plane of nodes",
                                           "gas.courant: 5 is out of range",
                                           "gas.fluid.0.viscosity: \"1 m\" is not a viscosity",
                                           "gas.fluid.1.name: the name \"air\" is given twice",
                                           "gas.fluid.1.material: there is no material file",
                                           "gas.fill.0.fluid: there is no fluid \"aire\"",
                                           "gas.fill.1.pressure: missing",
                                           "gas.fill.1.shape.sphere.radius: missing",
                                           "gas.fill.1.density: -1 kg/m^3 is out of range",
                                           "gas.edge.1.pressure: missing",
                                           "gas.edge.1: neither density nor temperature",
                                           "gas.edge.1.side: \"up\" is unknown",
                                           "gas.body: a b and c overlap",
                                           "gas.body.0.name: \"a b\": it becomes part of file names",
                                           "gas.body.0.rotation: in the plane a body can only turn about z",
                                           "gas.body.0.particles_per_direction: 20",
                                           "gas.body.1.mass: \"1 m\" is not a mass",
                                           "gauge.0.fields: \"presure\"",
                                           "gauge.0.colour: unknown key",
                                           "figure.0.kind: \"lines\" is unknown",
                                           "figure.0.reference: its file cannot be used",
                                           "nowhere.csv: there is no such file"};
  const std::vector<std::string> of_solids = {"solid.0.material: there is no material file",
                                              "solid.0.velocity: in the axisymmetric geometry no body moves",
                                              "solid.1.temperature: missing",
                                              "solid.1.name: the name \"bar\" is given twice",
                                              "solid.1.shape: it fills about 20 %",
                                              "solid.1.porosity: it would be ignored",
                                              "boundary.0.axis: \"w\" is unknown",
                                              "boundary.0.friction: it would be ignored",
                                              "boundary.1.position: 0.0055 m is on no plane of nodes",
                                              "boundary.1.side: \"up\" is unknown",
                                              "load.0: nothing acts",
                                              "load.0.body: there is no solid \"bat\"",
                                              "load.0.region.sphere.radius: missing",
                                              "gauge.0.kind: \"pint\" is unknown",
                                              "gauge.0.fields: \"presure\" cannot be recorded",
                                              "gauge.1.name: the name \"g\" is given twice",
                                              "gauge.1.from: it is more than a cell away",
                                              "gauge.1.to: it would be ignored",
                                              "gauge.1.fields: this is the number 3",
                                              "measure.0.at: missing",
                                              "measure.0.body: there is no solid \"bat\"",
                                              "measure.0.measured: \"4 s\" is not a length",
                                              "measure.1: which body the measure is of is unknown",
                                              "measure.1.profile: its file cannot be used",
                                              "measure.1.axis: \"q\" is unknown",
                                              "figure.0.name: \"a/b\"",
                                              "figure.0.fields: \"position\" cannot be drawn",
                                              "figure.0.to: it is where `from` is",
                                              "output.figure_field: this is the number 3",
                                              "output.history_interval: -1 s",
                                              "gates.residual: 0 is out of range",
                                              "nowhere.csv: there is no such file"};
  const auto without = [](std::vector<std::string> all, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
      std::erase_if(all, [&](const std::string& problem) { return problem.starts_with(key); });
    all.push_back("geometry: \"flat\" is unknown");
    return all;
  };
  const std::string head = "geometry = \"plane\"\ncell_size = 1\nend_time = 1\n";
  for (const auto& [text, problems] : {
           FirstRound{wrong_gas, of_gas},
           FirstRound{wrong_solids, of_solids},
           // Without a geometry nothing is known of places and directions.
           FirstRound{with_geometry(wrong_gas, "\"plane\"", "\"flat\""),
                      without(of_gas, {"gas.upper", "gas.body: ", "gas.body.0.rotation"})},
           FirstRound{
               with_geometry(wrong_solids, "\"axisymmetric\"", "\"flat\""),
               without(of_solids, {"solid.0.velocity", "solid.1.shape", "boundary.1.position", "gauge.1.from", "gauge.1.to"})},
           FirstRound{head + "[gas]\nlower = [0, 0]\nupper = [10, 10]\n",
                      {"gas.fluid: missing: a gas or liquid; begin one by [[gas.fluid]]", "gas.fill: missing"}},
           // A box that cannot be read is not one that ends at the origin.
           FirstRound{
               head +
                   "[gas]\nlower = [-60, 0]\nupper = [\"x\", 10]\n[[gauge]]\nname = \"a\"\nkind = \"point\"\nfrom = [50, 0]\n"
                   "fields = [\"pressure\"]\n",
               {"gas.upper", "gas.fluid: missing", "gas.fill: missing"}},
           FirstRound{head + "gas = 3\nsolid = 2\n[[gauge]]\nname = \"a\"\nkind = \"point\"\nfrom = [50, 0]\nfields = "
                             "[\"pressure\"]\n",
                      {"gas: this is the number 3", "solid: this is the number 2"}},
       }) {
    const std::string what = problems_of(text);
    for (const std::string& problem : problems) EXPECT_NE(what.find(problem), std::string::npos) << problem << "\n" << what;
    EXPECT_EQ(std::count(what.begin(), what.end(), '\n') + 1, static_cast<std::ptrdiff_t>(problems.size())) << what;
  }
}

TEST(CaseReader, ReportsAllThatIsWrongWithAFileOfNumbers) {
  const auto count = [](const std::string& what, const std::string& file) {
    std::ptrdiff_t lines = 0;
    for (std::size_t at = 0; (at = what.find(file, at)) != std::string::npos; ++at) ++lines;
    return lines;
  };
  std::string of_gas = gases;
  of_gas.replace(of_gas.find("swirl.csv"), 9, "worse.csv");
  const std::string profile = problems_of(of_gas);
  for (const char* problem : {"column pressure: ", "the column \"colour\" says nothing", "radius must rise from row to row",
                              "a density is not above 0"})
    EXPECT_NE(profile.find(problem), std::string::npos) << problem << "\n" << profile;
  EXPECT_EQ(count(profile, "worse.csv:"), 4) << profile;
  const std::string measured = problems_of(bar + "[[measure]]\nkind = \"profile_error\"\nprofile = \"reference.csv\"\n");
  EXPECT_EQ(count(measured, "reference.csv:1:1: there is no column"), 2) << measured;
  const std::string figure = problems_of(bar +
                                         "[[figure]]\nname = \"a\"\nkind = \"line\"\nfields = [\"pressure\", \"density\"]\n"
                                         "from = [0, 0]\nto = [\"1 mm\", 0]\nreference = \"worse.csv\"\n");
  EXPECT_EQ(count(figure, "worse.csv:"), 2) << "no column x, no pressure in m\n" << figure;
}

TEST(CaseReader, ACaseHasABody) {
  for (const char* none : {"", "solid = []\n"})
    EXPECT_EQ(problems_of(std::string(none) + "geometry = \"plane\"\ncell_size = 1\nend_time = 1\n"),
              "case.toml: there is no [[solid]] and no [gas]; a case has one of them");
}

TEST(CaseReader, BodiesMayTouchAndGaugesMayWaitForMaterialOrSitOnItsSurface) {
  const std::string text = bar + R"([[solid]]
name = "sleeve"
material = "copper_ofhc_mts.toml"
temperature = "295 K"
shape = { tube = { start = [0, 0], end = [0, "25.4 mm"], radius = "6 mm", inner_radius = "3.81 mm" } }
[[solid]]
name = "cap"
material = "copper_ofhc_mts.toml"
temperature = "295 K"
shape = { box = { lower = [0, "25.4 mm"], upper = ["6 mm", "30 mm"] } }
[[gauge]]
name = "corner"
kind = "point"
from = ["6 mm", "30 mm"]
fields = ["pressure"]
[[gauge]]
name = "waiting"
kind = "point"
moves = false
from = ["20 mm", 0]
fields = ["pressure"]
[[gauge]]
name = "rim"
kind = "surface"
axis = "x"
from = ["-1 mm", 0]
to = ["-1 mm", "1 mm"]
fields = ["position"]
)";
  EXPECT_EQ(problems_of(text), "none");
}

TEST(CaseReader, ABodyMayBeCutAtABoundary) {
  // The bounds of a difference are those of the whole; only what is left counts.
  const std::string text = R"(geometry = "plane"
cell_size = 0.1
end_time = 1
[[solid]]
name = "half"
material = "copper_ofhc_mts.toml"
temperature = "295 K"
shape = { difference = { from = { sphere = { centre = [0, 0], radius = 1 } }, without = [ { box = { lower = [-2, -2], upper = [0, 2] } } ] } }
[[boundary]]
kind = "symmetry"
axis = "x"
position = 0
side = "above"
)";
  EXPECT_EQ(problems_of(text), "none");
}

TEST(CaseReader, EveryTaylorCaseOfTheProjectIsReadAndMeetsItsExperiment) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(BRISANCE_SOURCE_DIR) / "data/cases")) {
    if (!entry.path().filename().string().starts_with("taylor_")) continue;
    ++count;
    const Case c = read_case(entry.path());
    ASSERT_EQ(c.measures.size(), 5u) << entry.path();
    const Shape* shape = c.bodies.at(0).shape.get();
    if (const auto* cut = std::get_if<Intersection>(&shape->form)) shape = cut->parts.at(0).get();
    const Cone& cylinder = std::get<Cone>(shape->form);
    // Twelve cells along the radius, the rear face of the measured profile where the measured length says, within the error of
    // its digitisation, 2 %.
    EXPECT_NEAR(cylinder.start_radius / c.cell_size, 12.0, 1e-9) << entry.path();
    const std::vector<double> height = CsvFile::load(c.measures.at(4).profile).numbers("height", Unit::m);
    const double length = c.measures.at(0).measured.value();
    EXPECT_NEAR(*std::max_element(height.begin(), height.end()), length, 0.02 * length) << entry.path();
    EXPECT_LT(length, cylinder.end[1]) << entry.path();
    EXPECT_GT(c.measures.at(1).measured.value(), c.measures.at(2).measured.value()) << entry.path();
  }
  EXPECT_EQ(count, 24);
}

TEST(Keys, DescribesByPathAndByName) {
  const auto one = find_keys(all_keys(), "boundary.friction");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].meaning, "Coulomb's coefficient, of kind rigid_wall");
  EXPECT_EQ(one[0].default_value, "0");
  const auto by_name = find_keys(all_keys(), "cell_size");
  ASSERT_EQ(by_name.size(), 1u);
  EXPECT_EQ(by_name[0].default_value, "required");
  EXPECT_EQ(by_name[0].values, "a number in m or a text such as \"25.4 mm\", > 0");
  EXPECT_EQ(find_keys(all_keys(), "gates").size(), 4u);  // the table and its three keys
  EXPECT_EQ(find_keys(all_keys(), "friction").size(), 1u);
  EXPECT_TRUE(find_keys(all_keys(), "frictoin").empty());
  EXPECT_EQ(did_you_mean("frictoin", names_of(all_keys())), "; did you mean \"friction\"?");
}

}  // namespace
}  // namespace brisance::simulator
