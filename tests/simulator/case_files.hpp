#pragma once
// Case files as texts, in a folder beside what they name, and what is found wrong with them.

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "models/input/diagnostics.hpp"
#include "simulator/case_reader.hpp"
#include "tests/scratch.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {

inline const fs::path& folder() {
  static const fs::path path = [] {
    const fs::path made = scratch("case");
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

inline fs::path written(const std::string& text, const std::string& name = "case.toml") {
  std::ofstream(folder() / name) << text;
  return folder() / name;
}

inline std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
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

inline const std::string bar = R"(geometry = "axisymmetric"
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

/// Every key of the gas.
inline const std::string gases = R"(
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

/// The same with a measure and an explosive that is lit.
inline const std::string burning = gases + R"([[measure]]
kind = "peak_overpressure"
gauge = "wall"
ambient = "1 atm"
measured = "2 MPa"
[[gas.fluid]]
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
inline const std::string bodies_in_gas = box_of_air("1 mm", "1 us", "[0, 0]", "[0.02, 0.01]") + R"([[gas.body]]
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

}  // namespace brisance::simulator
