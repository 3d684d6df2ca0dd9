// Writes the CSV files of the gas cases in data/cases: exact solutions, fine grids of the comparison solver where there is
// none, and the states from which they begin.
//   gas_references DIR
// Nothing in them comes from the solver that they are held against.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/programs/files.hpp"
#include "simulator/gas/muscl_hllc.hpp"
#include "tests/simulator/gas/chapman_jouguet.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/exact_solutions.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;

constexpr double gamma = 1.4;  // unless a problem says otherwise

struct Table {
  std::string comment, header;
  std::vector<std::vector<double>> rows = {};
  int digits = 9;
};
using Tables = std::map<std::string, Table>;  // by the names of their files

void write(const std::filesystem::path& path, const Table& table) {
  std::string text = fmt::format("# {}\n{}\n", table.comment, table.header);
  for (const std::vector<double>& row : table.rows) {
    const char* separator = "";
    for (const double x : row) {
      text += fmt::format("{}{:.{}g}", separator, x == 0.0 ? 0.0 : x, table.digits);
      separator = ",";
    }
    text += '\n';
  }
  replace_file_by_text(path, text);
}

constexpr const char* along_x = "x [m],density [kg/m^3],pressure [Pa],velocity [m/s]";
constexpr const char* along_any_ray = "x [m],distance [m],density [kg/m^3],pressure [Pa],velocity [m/s]";
std::vector<double> row(double x, const GasState& w) {
  return {x, w.density, w.pressure, w.velocity};
}
std::vector<double> ray_row(double r, const GasState& w) {
  return {r, r, w.density, w.pressure, w.velocity};
}

// Riemann problems: between their waves the states are uniform, or a fan ----------------------------------------------

Table riemann(const std::string& problem, const ExactRiemann& exact, double diaphragm, double time, double upper) {
  Table table{fmt::format("Exact solution of the Riemann problem {} at t = {:g} s", problem, time), along_x};
  std::vector<double> places = {0.0, upper};
  for (const double speed :
       {exact.left_head(), exact.left_tail(), exact.star_velocity(), exact.right_tail(), exact.right_head()})
    places.push_back(std::clamp(diaphragm + speed * time, 0.0, upper));
  std::sort(places.begin(), places.end());
  const auto at = [&](double x) { return exact.at((x - diaphragm) / time); };
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double from = places[i], width = places[i + 1] - from;
    if (width < 1e-12) continue;
    const bool uniform = at(from + 0.3 * width).pressure == at(from + 0.7 * width).pressure;
    const int parts = uniform ? 1 : 100;
    for (int k = 0; k <= parts; ++k)  // on a wave the state is that of its inner side
      table.rows.push_back(row(from + width * k / parts, at(from + width * std::clamp(1.0 * k / parts, 1e-9, 1.0 - 1e-9))));
  }
  return table;
}

void add_riemann_problems(Tables& all) {
  const auto add = [&](const std::string& name, const Table& table) { all[name] = table; };
  const std::string toro = "{} of Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. (2009), table 4.1,";
  add("sod", riemann("of Sod, J. Comput. Phys. 27 (1978) 1,", {{1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}}, 0.5, 0.2, 1.0));
  add("near_vacuum_tube", riemann(fmt::format(fmt::runtime(toro), 2), {{1.0, -2.0, 0.4}, {1.0, 2.0, 0.4}}, 0.5, 0.15, 1.0));
  add("strong_shock_tube",
      riemann(fmt::format(fmt::runtime(toro), 3), {{1.0, 0.0, 1000.0}, {1.0, 0.0, 0.01}}, 0.5, 0.012, 1.0));
  add("dense_driver_tube",
      riemann("of a pressure ratio of 1e5 and a density ratio of 10", {{10.0, 0.0, 1e5}, {1.0, 0.0, 1.0}}, 0.3, 0.0024, 1.0));
  Table at_rest{"A contact between gases at rest", along_x};
  for (const auto& [x, density] : {std::pair{0.0, 1.0}, {0.5, 1.0}, {0.5, 10.0}, {1.0, 10.0}})
    at_rest.rows.push_back({x, density, 1.0, 0.0});
  add("contact_at_rest", at_rest);
  add("moving_contact", riemann("of a contact that moves", {{1.0, 1.0, 1.0}, {10.0, 1.0, 1.0}}, 0.2, 0.5, 1.0));
  const StiffenedGas air{1.4}, water{4.4, 6e8};
  add("water_air_shock_tube", riemann("of water at 1 GPa and air at 0.1 MPa, two stiffened gases,",
                                      {{1000.0, 0.0, 1e9}, water, {50.0, 0.0, 1e5}, air}, 0.7, 2.4e-4, 1.0));
  add("dense_gas_into_air", riemann("of gas of 400 kg/m^3 at 600 MPa and air, both ideal,",
                                    {{400.0, 0.0, 6e8}, air, {1.2, 0.0, 1e5}, air}, 0.7, 1.6e-4, 1.3));
}

// Implosions and explosions -------------------------------------------------------------------------------------------

void add_noh(Tables& all, const std::string& name, int dimension) {
  constexpr double time = 0.6, upper = 0.5;
  const Noh noh{5.0 / 3.0, dimension};
  Table table{fmt::format("Exact solution of Noh, J. Comput. Phys. 72 (1987) 78, in {} dimensions, gamma 5/3, t = {:g} s",
                          dimension, time),
              along_any_ray};
  const double shock = noh.shock_radius(time);
  for (const double r : {0.0, shock}) table.rows.push_back(ray_row(r, noh.at(0.5 * shock, time)));
  constexpr int parts = 100;
  for (int k = 0; k <= parts; ++k) {
    const double r = shock + (upper - shock) * k / parts;
    table.rows.push_back(ray_row(r, noh.at(r, time)));
  }
  all[name] = table;
}

/// In cold gas of density 1, t = 1 s; `energy` of the whole space, per area or length.
void add_sedov(Tables& all, const std::string& name, const std::string& source, int dimension, double energy) {
  constexpr double ahead = 1e-6, beyond = 1.2;
  const Sedov sedov(gamma, dimension, energy);
  Table table{fmt::format("Exact solution of Sedov (1959) for {} in 1 kg/m^3, gamma {:g}, t = 1 s", source, gamma),
              along_any_ray};
  const double shock = sedov.shock_radius(1.0);
  constexpr int parts = 300;  // closer to each other towards the shock
  for (int k = 0; k <= parts; ++k) {
    const double left = 1.0 - static_cast<double>(k) / parts, r = shock * (1.0 - left * left);
    table.rows.push_back(ray_row(r, sedov.at(std::clamp(r, 1e-6, shock * (1.0 - 1e-12)), 1.0)));
  }
  for (const double r : {shock, beyond * std::round(20.0 * shock) / 20.0}) table.rows.push_back(ray_row(r, {1.0, 0.0, ahead}));
  all[name] = table;
}

// Fine grids of the comparison solver ---------------------------------------------------------------------------------

constexpr int fine_grid = 6400, cells_per_row = 4;

void add_fine_grid(Tables& all, const std::string& name, const std::string& problem, Euler1D& gas, double time) {
  advance_to(gas, time);
  Table table{fmt::format("{} at t = {:g} s by the MUSCL-HLLC scheme (simulator/gas/muscl_hllc.hpp) in {} cells, means of {}",
                          problem, time, fine_grid, cells_per_row),
              along_x};
  for (int i = 0; i < fine_grid; i += cells_per_row) {
    GasState mean{};
    for (int k = i; k < i + cells_per_row; ++k) {
      const GasState& w = gas.cells[static_cast<std::size_t>(k)];
      mean.density += w.density / cells_per_row, mean.velocity += w.velocity / cells_per_row,
          mean.pressure += w.pressure / cells_per_row;
    }
    table.rows.push_back(row(0.5 * (gas.face(i) + gas.face(i + cells_per_row)), mean));
  }
  all[name] = table;
}

void add_shu_osher(Tables& all) {
  Table start{"State from which the problem of Shu & Osher, J. Comput. Phys. 83 (1989) 32, begins",
              "x [m],density [kg/m^3],pressure [Pa],velocity_along [m/s]"};
  for (const double x : {-5.0, -4.0}) start.rows.push_back(row(x, shu_osher_start(-5.0)));
  constexpr int parts = 1800;
  for (int k = 0; k <= parts; ++k) {
    const double x = -4.0 + 9.0 * k / parts;
    start.rows.push_back(row(x, shu_osher_start(x)));
  }
  all["shu_osher_start"] = start;
  Euler1D gas;
  gas.lower = -5.0, gas.upper = 5.0, gas.at_lower = gas.at_upper = {EndKind::transmissive};
  gas.cells.resize(fine_grid);
  for (int i = 0; i < fine_grid; ++i)
    gas.cells[static_cast<std::size_t>(i)] = cell_average(shu_osher_start, gas.face(i), gas.face(i + 1));
  add_fine_grid(all, "shu_osher", "Problem of Shu & Osher, J. Comput. Phys. 83 (1989) 32,", gas, 1.8);
}

void add_cylindrical_explosion(Tables& all) {
  Euler1D gas;
  gas.dimension = 2, gas.at_upper = {EndKind::transmissive};
  gas.cells.resize(fine_grid);
  for (int i = 0; i < fine_grid; ++i)
    gas.cells[static_cast<std::size_t>(i)] = gas.centre(i) < 0.4 ? GasState{1.0, 0.0, 1.0} : GasState{0.125, 0.0, 0.1};
  add_fine_grid(all, "cylindrical_explosion", "Radial solution of the cylindrical explosion of Toro (2009), section 17.1,", gas,
                0.25);
  Table& table = all["cylindrical_explosion"];
  table.header = along_any_ray;
  for (std::vector<double>& w : table.rows) w.insert(w.begin(), w.front());
}

void add_woodward_colella(Tables& all) {
  Euler1D gas;
  gas.cells.resize(fine_grid);
  for (int i = 0; i < fine_grid; ++i) gas.cells[static_cast<std::size_t>(i)] = woodward_colella_start(gas.centre(i));
  add_fine_grid(all, "woodward_colella", "Two blast waves of Woodward & Colella, J. Comput. Phys. 54 (1984) 115,", gas, 0.038);
}

// Detonations ---------------------------------------------------------------------------------------------------------

/// What is behind the front of a detonation in the state of Chapman and Jouguet.
enum class Start {
  wall,      // the wave of Taylor, from a wall
  lit,       // products in that state, 2 mm of which have lit it at a wall, and then the wave of Taylor
  supported  // the same, and products that come in at that state
};
void add_detonation(Tables& all, const std::string& name, const std::string& explosive, const eos::JonesWilkinsLee& products,
                    double time, Start start) {
  constexpr double upper = 90e-3, atmosphere = 101325.0;
  const double lit = start == Start::wall ? 0.0 : 2e-3;
  const ChapmanJouguet cj = tangent(products);
  constexpr std::array words = {"from a wall, with the wave of Taylor",
                                "lit by 2 mm of that state at a wall: they are behind the front, then comes the wave of Taylor",
                                "products come in at that state"};
  Table table{
      fmt::format("Detonation of {} in the state of Chapman and Jouguet of its products (D = {:.1f} m/s, {:.3f} GPa) at "
                  "t = {:g} s, {}; no reaction zone",
                  explosive, cj.velocity, 1e-9 * cj.pressure, time, words[static_cast<std::size_t>(start)]),
      along_x};
  const GasState behind{cj.density, cj.particle_velocity, cj.pressure};
  if (start == Start::supported) {
    table.rows.push_back(row(0.0, behind));
  } else {
    const std::vector<WaveState> wave = taylor_wave(products);
    table.rows.push_back(row(0.0, wave.front().state));
    for (const WaveState& at : wave) table.rows.push_back(row(at.speed * time, at.state));
  }
  const double front = cj.velocity * time + lit;
  table.rows.push_back(row(front, behind));
  for (const double x : {front, upper}) table.rows.push_back({x, products.reference_density, atmosphere, 0.0});
  all[name] = table;
}

void add_detonations(Tables& all) {
  const eos::JonesWilkinsLee pbx_9501{1838.0, 1668.9e9, 59.69e9, 5.9, 2.1, 0.45, 594.96, 9.499985e9},
      composition_b{1717.0, 524.2e9, 7.678e9, 4.2, 1.1, 0.34, 1000.0, 8.5e9},
      tnt{1630.0, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 1000.0, 7.0e9};
  add_detonation(all, "detonation_pbx_9501", "PBX 9501", pbx_9501, 9e-6, Start::lit);
  add_detonation(all, "program_burn_pbx_9501", "PBX 9501", pbx_9501, 9e-6, Start::wall);
  add_detonation(all, "detonation_composition_b", "Composition B", composition_b, 10e-6, Start::supported);
  add_detonation(all, "detonation_tnt", "TNT", tnt, 11.5e-6, Start::supported);
}

// Smooth flows --------------------------------------------------------------------------------------------------------

void add_entropy_wave(Tables& all) {
  Table table{"Wave of entropy: where it begins and, after a period, ends", "x [m],density [kg/m^3]"};
  constexpr int parts = 1000;
  for (int k = 0; k <= parts; ++k)
    table.rows.push_back({1.0 * k / parts, EntropyWave{}.at(static_cast<double>(k) / parts, 0.0).density});
  all["entropy_wave"] = table;
}

constexpr const char* vortex_start = "radius [m],density [kg/m^3],pressure [Pa],velocity_around [m/s]";

/// A vortex about the origin as a profile, and what it is along a line beside its centre.
template <class At>
void add_vortex(Tables& all, const std::string& name, const std::string& words, const At& at, double reach, double beside,
                double upper) {
  Table start{words + ": along the radius", vortex_start};
  constexpr int parts = 800;
  for (int k = 0; k <= parts; ++k) {
    const double r = reach * k / parts;
    const PlaneGasState w = at(r, 0.0), still = at(10.0 * reach, 0.0);
    start.rows.push_back({r, w.density, w.pressure, w.velocity_y - still.velocity_y});
  }
  all[name + "_start"] = start;
  Table line{fmt::format("{}: along y = {:g} m", words, beside), along_x};
  for (int k = 0; k <= parts; ++k) {
    const double x = upper * (2.0 * k / parts - 1.0);
    const PlaneGasState w = at(x, beside);
    line.rows.push_back({x, w.density, w.pressure, w.velocity_x});
  }
  all[name] = line;
}

void add_vortices(Tables& all) {
  IsentropicVortex vortex;
  vortex.period = 1e3;  // of its images nothing is left here
  add_vortex(
      all, "isentropic_vortex", "Isentropic vortex of Shu, ICASE Report 97-65 (1998)",
      [&](double x, double y) { return vortex.at(x, y, 0.0); }, 7.2, 0.9765625, 5.0);
  for (const auto& [name, mach] :
       {std::pair{"gresho_vortex_mach_01", 0.1}, {"gresho_vortex_mach_001", 0.01}, {"gresho_vortex_mach_0001", 0.001}}) {
    const GreshoVortex gresho{1.4, mach};
    add_vortex(
        all, name, fmt::format("Vortex of Gresho & Chan, Int. J. Numer. Methods Fluids 11 (1990) 587, Mach {:g}", mach),
        [&](double x, double y) { return gresho.at(x, y); }, 0.5, 0.1015625, 0.5);
    constexpr double slow = 1e-3;
    if (mach <= slow) all[std::string(name) + "_start"].digits = 12;  // the pressure varies by a millionth
  }
}

/// In balance as cells can hold it: from cell to cell the pressure differs by the weight of half of either. Its scale height is
/// 4 millionths less than that of the exact column.
void add_hydrostatic_column(Tables& all) {
  constexpr double gas_constant = 0.4 * 718.0, temperature = 250.0, gravity = 9.81, lowest = 1e5;
  constexpr double cell = 50.0;
  constexpr int cells = 100, rows_per_cell = 10;
  const double half = 0.5 * gravity * cell / (gas_constant * temperature), ratio = (1.0 - half) / (1.0 + half);
  Table table{
      "Isothermal column of air at 250 K, in balance in cells of 50 m: from one to the next p falls by g h times the mean of "
      "their densities",
      "x [m],density [kg/m^3],pressure [Pa]"};
  table.digits = 17;  // what is missing from the balance moves the column
  for (int k = 0; k <= cells * rows_per_cell; ++k) {
    const double part = static_cast<double>(k) / rows_per_cell, p = lowest * std::pow(ratio, part);
    table.rows.push_back({cell * part, p / (gas_constant * temperature), p});
  }
  all["hydrostatic_column"] = table;
}

// Fluids --------------------------------------------------------------------------------------------------------------

void add_slab(Tables& all, const std::string& fluid, double density_of_it) {
  Table table{
      fmt::format("A slab of {}, 0.3 m to 0.6 m, after 3 ms at 100 m/s in air of the same velocity and pressure", fluid),
      "x [m],density [kg/m^3],pressure [Pa],velocity [m/s],fraction_" + fluid};
  const double air = 1.2;
  for (const auto& [x, density, fraction] : {std::tuple{0.0, air, 0.0},
                                             {0.6, air, 0.0},
                                             {0.6, density_of_it, 1.0},
                                             {0.9, density_of_it, 1.0},
                                             {0.9, air, 0.0},
                                             {1.0, air, 0.0}})
    table.rows.push_back({x, density, 1e5, 100.0, fraction});
  all[fluid + "_slab"] = table;
}

/// Material that runs against a wall comes to rest behind a shock; the jumps of mass, momentum and energy give its state.
void add_impact(Tables& all, const std::string& name, const EquationOfState& law, double density, double pressure, double speed,
                double time) {
  const double energy = eos::energy_at_pressure(law, density, pressure);
  const auto shocked_pressure = [&](double rho) { return pressure + density * speed * speed * rho / (rho - density); };
  const auto excess = [&](double rho) {
    const double p = shocked_pressure(rho), e = energy + 0.5 * (p + pressure) * (1.0 / density - 1.0 / rho);
    return eos::pressure(law, rho, e) - p;
  };
  double low = density * (1.0 + 1e-6), high = 2.5 * density;
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (excess(middle) > 0.0 ? high : low) = middle;
  const double shock = speed * density / (low - density) * time;
  Table table{
      fmt::format("Shock by the jumps of mass, momentum and energy: material that ran against the wall at x = 0 with {:g} "
                  "m/s, after {:g} s",
                  speed, time),
      along_x};
  for (const double x : {0.0, shock}) table.rows.push_back({x, low, shocked_pressure(low), 0.0});
  for (const double x : {shock, 1.0}) table.rows.push_back({x, density, pressure, -speed});
  all[name] = table;
}

void add_impacts(Tables& all) {
  const eos::Murnaghan water{1000.0, 2.18e9, 7.15, 1e5, 4180.0, 298.0};
  add_impact(all, "murnaghan_impact", water, 1000.0, 1e5, 500.0, 3e-4);
  const eos::Tillotson aluminium{2700.0, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5.0, 5.0, 896.0, 298.0};
  add_impact(all, "tillotson_impact", aluminium, 2700.0, 0.0, 2000.0, 1e-4);
}

// Bodies --------------------------------------------------------------------------------------------------------------

/// Gas of density and pressure 1 within a ring that widens or shrinks slowly: uniform.
void add_ring(Tables& all, const std::string& name, double from, double to) {
  Table table{
      fmt::format("Gas of density and pressure 1 in a ring whose radius has slowly come from {:g} m to {:g} m: p V^{:g} "
                  "is what it was",
                  from, to, gamma),
      "x [m],density [kg/m^3],pressure [Pa]"};
  const double density = from * from / (to * to);
  for (const double x : {0.0, to}) table.rows.push_back({x, density, std::pow(density, gamma)});
  all[name] = table;
}

void add_piston(Tables& all) {
  constexpr double speed = 0.05, start = 1.0075, way = 0.5, thickness = 0.125, upper = 1.25;
  Table table{fmt::format("Gas of density and pressure 1 in front of a piston that has come from {:g} m to {:g} m at {:g} m/s: "
                          "p V^{:g} is what it was; behind it the simple wave that follows it",
                          start, start - way, speed, gamma),
              along_x};
  const double front = start - way, density = start / front;
  for (const double part : {0.0, 1.0}) table.rows.push_back({part * front, density, std::pow(density, gamma), -part * speed});
  const double sound = 1.0 - 0.5 * (gamma - 1.0) * speed / std::sqrt(gamma);  // over that of the gas at rest
  const double behind = std::pow(sound, 2.0 / (gamma - 1.0));
  for (const double x : {front + thickness, upper}) table.rows.push_back({x, behind, std::pow(behind, gamma), -speed});
  all["piston_in_gas"] = table;
}

/// A chamber of one state, whose entropy stays, loses rho c A (2/(gamma + 1))^((gamma + 1)/(2 (gamma - 1))) to its slot.
void add_vented_chamber(Tables& all) {
  constexpr double density = 12.0, pressure = 1e6, slot = 4e-3, time = 200e-6;
  constexpr double length = 28e-3, height = 36e-3, round = 8e-3;  // up to the plates; of their ends
  const double volume = length * height + slot * round + 2.0 * round * round * (1.0 - 0.25 * std::numbers::pi);
  const double sound = std::sqrt(gamma * pressure / density);
  const double choked = std::pow(2.0 / (gamma + 1.0), 0.5 * (gamma + 1.0) / (gamma - 1.0));
  const double left = std::pow(1.0 + 0.5 * (gamma - 1.0) * choked * sound * slot / volume * time, -2.0 / (gamma - 1.0));
  Table table{
      fmt::format("A chamber of one state (1 MPa, 12 kg/m^3, {:.5g} m^3/m) that loses the choked flow of a slot of 4 mm, "
                  "t = {:g} s",
                  volume, time),
      along_x};
  for (const double x : {0.0, length}) table.rows.push_back({x, density * left, pressure * std::pow(left, gamma), 0.0});
  all["vented_chamber"] = table;
}

void add_bodies(Tables& all) {
  add_ring(all, "widening_ring", 0.25, 0.351), add_ring(all, "shrinking_ring", 0.35, 0.25);
  add_piston(all);
  const double speed = 0.1 * std::sqrt(gamma);
  for (const auto& [name, axis] : {std::pair{"disk_with_the_gas", "x"}, {"sphere_with_the_gas", "y"}}) {
    Table table{"Gas that a body moves with, undisturbed", fmt::format("{} [m],pressure [Pa],velocity [m/s]", axis)};
    for (const double x : {0.0, 1.0}) table.rows.push_back({x, 1.0, speed});
    all[name] = table;
  }
  add_vented_chamber(all);
  Table closed{"Hot gas in a closed ring, 12 m to 13.5 m", "x [m],density [kg/m^3],pressure [Pa]"};
  for (const auto& [x, density, pressure] : {std::tuple{-24.0, 1.0, 1.0},
                                             {-13.5, 1.0, 1.0},
                                             {-12.0, 5.0, 10.0},
                                             {12.0, 5.0, 10.0},
                                             {13.5, 1.0, 1.0},
                                             {24.0, 1.0, 1.0}})
    closed.rows.push_back({x, density, pressure});
  all["closed_ring"] = closed;
}

}  // namespace
}  // namespace brisance::simulator::gas

int main(int argc, char** argv) {
  using namespace brisance::simulator::gas;
  CLI::App app{"Writes the reference CSV files of the gas cases."};
  std::filesystem::path directory;
  app.add_option("DIR", directory, "where to")->required();
  CLI11_PARSE(app, argc, argv);
  Tables all;
  add_riemann_problems(all);
  add_noh(all, "noh_planar", 1), add_noh(all, "noh_cylindrical", 2), add_noh(all, "noh_spherical", 3);
  add_sedov(all, "sedov", "a sphere of energy 0.851072 J", 3, 0.851072);
  add_sedov(all, "sedov_cylindrical", "a cylinder of energy 0.311357 J/m", 2, 0.311357);
  add_sedov(all, "sedov_planar", "a plane of energy 0.0673185 J/m^2 to each side", 1, 2.0 * 0.0673185);
  add_detonations(all);
  add_shu_osher(all), add_woodward_colella(all), add_cylindrical_explosion(all);
  add_entropy_wave(all), add_vortices(all), add_hydrostatic_column(all);
  add_slab(all, "water", 1000.0), add_slab(all, "products", 2.0), add_impacts(all);
  add_bodies(all);
  for (const auto& [name, table] : all) write(directory / (name + ".csv"), table);
}
