// Case files that are refused, with which words.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/simulator/case_files.hpp"

namespace brisance::simulator {
namespace {

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
       "case.toml:10:9: solid.0.shape: it fills nothing: it leaves no part that could hold a particle of cells of "},
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
       "side = \"above\"\n[[gauge]]\nname = \"tip\"\nkind = \"surface\"\naxis = \"y\"\nfrom = [1e-4, 0]\nfields = "
       "[\"velocity\"]",
       "gauge.0.to: along x the surface is sought between 0.0001 m and 0 m, which is less than a cell: there may be no "
       "particle"},
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

TEST(CaseReader, TellsWhatIsAllowedOnceForAllWordsOfAList) {
  std::string text = bar;
  text += "[[gauge]]\nname = \"tip\"\nkind = \"point\"\nfrom = [0, 0]\nfields = [\"presure\", \"heat\", \"pressure\"]\n";
  const std::string problems = problems_of(text), second = problems.substr(problems.find("\"heat\""));
  EXPECT_NE(problems.find("\"presure\" cannot be recorded; it must be one of position, velocity,"), std::string::npos)
      << problems;
  EXPECT_NE(problems.find("did you mean \"pressure\"?"), std::string::npos) << problems;
  EXPECT_EQ(second, "\"heat\" cannot be recorded");
}

TEST(CaseReader, DoesNotBlameAShapeForAWrongCellSize) {
  std::string text = bar;
  text.replace(text.find("0.3175 mm"), 9, "0.3175 s");
  const std::string problems = problems_of(text);
  EXPECT_NE(problems.find("cell_size: \"0.3175 s\" is not a length"), std::string::npos) << problems;
  EXPECT_EQ(problems.find("fills nothing"), std::string::npos) << problems;
}

/// What each of the two refuses of the other's keys would only hide it.
TEST(CaseReader, SaysOfSolidsWithGasNothingButThatTheyAreNotTogether) {
  const std::string text = bar + gases.substr(gases.find("[gas]"));
  for (const std::vector<std::string>& overrides : {std::vector<std::string>{}, {"solid.0.material.flow_stress.beta=1"}})
    EXPECT_EQ(problems_of(text, overrides),
              "case.toml:17:1: gas: a case holds either solids or gas, not yet both; rigid bodies in a gas are [[gas.body]]");
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
                                           "figure.0.reference: its file cannot be used: nowhere.csv: there is no such file"};
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
                                              "measure.1.profile: its file cannot be used: nowhere.csv: there is no such file",
                                              "measure.1.axis: \"q\" is unknown",
                                              "figure.0.name: \"a/b\"",
                                              "figure.0.fields: \"position\" cannot be drawn",
                                              "figure.0.to: it is where `from` is",
                                              "output.figure_field: this is the number 3",
                                              "output.history_interval: -1 s",
                                              "gates.residual: 0 is out of range"};
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

TEST(CaseReader, AFileThatIsNotThereIsOneProblem) {
  EXPECT_EQ(problems_of(bar + "[[measure]]\nkind = \"profile_error\"\nprofile = \"nowhere.csv\"\n"),
            "case.toml:19:11: measure.0.profile: its file cannot be used: nowhere.csv: there is no such file");
}

TEST(CaseReader, RefusesATextOfSeveralLines) {
  EXPECT_EQ(problems_of(bar + "[[gauge]]\nname = \"a\\nb\"\nkind = \"point\"\nfrom = [0, 0]\nfields = [\"pressure\"]\n"),
            "case.toml:18:8: gauge.0.name: the text has a line break; give one line");
  EXPECT_EQ(problems_of("subtitle = \"\"\"above\nbelow\"\"\"\n" + bar),
            "case.toml:1:12: subtitle: the text has a line break; give one line");
}

TEST(CaseReader, ACaseHasABody) {
  for (const char* none : {"", "solid = []\n"})
    EXPECT_EQ(problems_of(std::string(none) + "geometry = \"plane\"\ncell_size = 1\nend_time = 1\n"),
              "case.toml: there is no [[solid]] and no [gas]; a case has one of them");
}

}  // namespace
}  // namespace brisance::simulator
