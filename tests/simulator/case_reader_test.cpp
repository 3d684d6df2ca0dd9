// Case files: what is read, and what is written.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "models/input/csv.hpp"
#include "simulator/keys.hpp"
#include "tests/simulator/case_files.hpp"

namespace brisance::simulator {
namespace {

// Every key, each with another value than its default.
const std::string everything = R"(title = "Everything \"at once\""
subtitle = "of all that there is"
set = ["numerics.courant=0.2"]
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
to = ["1 mm", "1 mm", 0]
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

TEST(CaseReader, WhatHasBeenSetIsNotToBeSet) {
  EXPECT_EQ(problems_of(small_bar(""), {"set=[\"cell_size=1 mm\"]"}),
            "--set set: a run writes it itself; set the keys that it would name");
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
  const auto set = find_keys(all_keys(), "set");
  ASSERT_EQ(set.size(), 1u);
  EXPECT_EQ(set[0].values, "a list of texts such as \"cell_size=1 mm\"");  // no names of fields
  EXPECT_EQ(find_keys(all_keys(), "gates").size(), 4u);                    // the table and its three keys
  EXPECT_EQ(find_keys(all_keys(), "friction").size(), 1u);
  EXPECT_TRUE(find_keys(all_keys(), "frictoin").empty());
  EXPECT_EQ(did_you_mean("frictoin", names_of(all_keys())), "; did you mean \"friction\"?");
}

}  // namespace
}  // namespace brisance::simulator
