#include "gas_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brisance::simulator {
namespace {

constexpr double gamma = 1.4;
/// (2/(gamma + 1))^((gamma + 1)/(2 (gamma - 1))): choked flow over rho c A.
const double choked = std::pow(2.0 / (gamma + 1.0), 0.5 * (gamma + 1.0) / (gamma - 1.0));

/// Gas in a ring whose inner radius goes at a speed, under walls of a thickness at the start: mass, pressure.
Watch pressure_in_ring(double radius, double speed, double thickness) {
  return {25, "mean pressure (Pa)",
          [=](const Simulation& s) {
            const Held gas = held_by_ring(s, radius + speed * s.time + 0.4 * thickness);
            return std::vector{gas.pressure, gas.mass};
          },
          [=](const Watched&, double t) { return std::pow(radius / (radius + speed * t), 2.0 * gamma); }};
}
Watch mass_in_ring(double radius) {
  return {20, "mass in the ring (kg/m)", [=](const Simulation& s) { return std::vector{held_by_ring(s, radius).mass}; },
          [](const Watched& run, double) { return run.values[0][0]; }};
}
/// The last of what was seen over what it should be, less 1.
double last_error(const Watched& run, const Watch& watch) {
  return std::abs(run.values.back()[0] / watch.exact(run, run.time.back()) - 1.0);
}
/// Largest change of a number that should not.
double largest_change(const Watched& run, std::size_t number) {
  double most = 0.0;
  for (const std::vector<double>& values : run.values)
    most = std::max(most, std::abs(values[number] / run.values[0][number] - 1.0));
  return most;
}

/// The chamber behind a slot at x = 36 mm: mass, energy, volume.
Watch chamber(double slot) {
  constexpr double grams = 1e3;
  return {32, "mass in the chamber (g/m)",
          [](const Simulation& s) {
            constexpr double throat = 36e-3;
            const Held in = held(s, [](const Vector& x) { return x[0] < throat; });
            return std::vector{in.mass, in.energy, in.volume};
          },
          // A chamber of one state whose entropy stays, from half of the time on, when the flow has come to its own.
          [slot](const Watched& run, double t) {
            const std::size_t half = run.time.size() / 2;
            const std::vector<double>& then = run.values[half];
            const double sound = std::sqrt(gamma * (gamma - 1.0) * then[1] / then[0]);
            const double rate = 0.5 * (gamma - 1.0) * choked * sound * slot / then[2];
            return then[0] * std::pow(1.0 + rate * (t - run.time[half]), -2.0 / (gamma - 1.0));
          },
          grams};
}
/// What has left in the second half of the time over the choked flow of the chamber's mean states.
Measure flow_through(double slot) {
  return [slot](const Watched& run) {
    const std::size_t first = run.time.size() / 2;
    double expected = 0.0;
    for (std::size_t n = first; n + 1 < run.time.size(); ++n) {
      const std::vector<double>& in = run.values[n];
      const double density = in[0] / in[2], pressure = (gamma - 1.0) * in[1] / in[2];
      expected += (run.time[n + 1] - run.time[n]) * slot * choked * density * std::sqrt(gamma * pressure / density);
    }
    return (run.values[first][0] - run.values.back()[0]) / expected;
  };
}

/// Where the pressure falls through a level, in one dimension.
Watch front_of(double level) {
  return {20,
          "way of the front (m)",
          [level](const Simulation& s) {
            std::vector<std::pair<double, double>> cells;
            gas::for_each_cell(s.gas, [&](const gas::CellPlace& at) {
              cells.emplace_back(s.gas.cells.centre(at.block, at.cell)[0],
                                 s.gas.primitive.cell(at.block, gas::Primitive::pressure, at.cell));
            });
            std::sort(cells.begin(), cells.end());
            std::vector<double> place, pressure;
            for (const auto& [x, p] : cells) place.push_back(x), pressure.push_back(p);
            return std::vector{front(place, pressure, level)};
          },
          {}};
}

/// Noise of a body that moves with gas of pressure 1: largest and mean change of the pressure.
const Watch noise = {50, "largest change of the pressure (Pa)",
                     [](const Simulation& s) {
                       double most = 0.0, sum = 0.0, volume = 0.0;
                       gas::for_each_cell(s.gas, [&](const gas::CellPlace& at) {
                         const double change =
                             std::abs(s.gas.primitive.cell(at.block, gas::Primitive::pressure, at.cell) - 1.0);
                         const double V = gas::open_part(s.gas, at.block, at.cell) *
                                          s.gas.content.cell(at.block, gas::Content::cell_volume, at.cell);
                         most = std::max(most, change), sum += V * change, volume += V;
                       });
                       return std::vector{most, sum / volume};
                     },
                     [](const Watched&, double) { return 0.0; }};

}  // namespace

std::vector<Entry> entries() {
  std::vector<Entry> all;
  const auto add = [&](const std::string& file, const std::string& field, std::vector<Goal> goals,
                       std::vector<std::string> changes = {}, const std::string& variation = "") {
    all.push_back({"gas_" + file + variation, file, std::move(changes), field, std::move(goals)});
  };
  const auto L1 = [](double limit) { return Goal{"L1 of the density", limit, error("density")}; };
  const auto relative_L1 = [](double limit) {
    return Goal{"L1 of the density over its mean", limit, relative_error("density")};
  };
  const auto relative = [](const std::string& field, double limit) {
    return Goal{"L1 of the " + field + " over its mean", limit, relative_error(field)};
  };
  const Goal closed{"energy in no book, of all", 1e-13, lost_energy};

  add("sod", "density", {L1(1.6e-3), closed});
  add("near_vacuum_tube", "density", {L1(0.010)});
  add("strong_shock_tube", "density", {L1(0.03), closed});
  add("dense_driver_tube", "density", {L1(0.03), closed});
  add("moving_contact", "density",
      {{"error of the pressure", 1e-12, largest_error("pressure", 1.0)},
       {"error of the velocity", 1e-12, largest_error("velocity", 1.0)}});
  add("contact_at_rest", "density",
      {{"error of the pressure", 1e-12, largest_error("pressure", 1.0)},
       {"error of the velocity", 1e-12, largest_error("velocity", 1.0)},
       {"error of the density", 1e-12, largest_error("density", 1.0)}});
  add("entropy_wave", "density", {L1(1.2 * 3.05e-4), closed});
  add("shu_osher", "density",
      {L1(1.2 * 0.043),
       relative_L1(0.05),
       {"height of the short waves, of the reference", 0.8,
        [](const Ran& ran) {
          const Line line = line_of(ran, "density");
          return rise(line, line.computed, 0.6, 2.2) / rise(line, line.exact, 0.6, 2.2);
        },
        true}});
  add("woodward_colella", "density",
      {relative_L1(0.05), closed, {"peak of the density against the reference", 0.05, [](const Ran& ran) {
                                     const FigureConfig& figure = ran.config.figures[0];
                                     return std::abs(
                                         peak(line_of(ran, "density").computed) / peak(read_reference(figure).values[0]) - 1.0);
                                   }}});
  const auto noh = [&](const std::string& file, double plateau_known, double behind, double ahead) {
    add(file, "density",
        {{"mean density at 0.05 < r < 0.15, below that of another code", 0.01,
          [=](const Ran& ran) { return 1.0 - plateau(line_of(ran, "density"), 0.05, 0.15) / plateau_known; }},
         {"shock from r = 0.2, in cells", 1.0, [=](const Ran& ran) {
            const Line line = line_of(ran, "density");
            return std::abs(front(line.place, line.computed, 0.5 * (behind + ahead)) - 0.2) / line.cell_size;
          }}});
  };
  noh("noh_planar_1d", 4.0, 4.0, 1.0), noh("noh_cylindrical_1d", 15.87, 16.0, 4.0), noh("noh_spherical_1d", 62.4, 64.0, 16.0);
  for (const char* file : {"noh_axisymmetric", "noh_three_dimensional"})
    add(file, "density",
        {{"spread of the radius", 0.015, [](const Ran& ran) { return fronts(ran, 0.22, 16.0, 40.0).spread; }},
         {"shock from r = 0.2, in cells", 1.0,
          [](const Ran& ran) { return std::abs(fronts(ran, 0.22, 16.0, 40.0).mean - 0.2) / ran.config.cell_size; }},
         {"plateau across the axis, below 64", 0.03,
          [](const Ran& ran) { return 1.0 - plateau(line_of(ran, "density"), 0.1, 0.16) / 64.0; }}});
  const auto from_radius = [](double radius, double h, double exact = 1.0) {
    return std::abs(radius - exact) - 0.5 * h - 0.003 * exact;
  };
  const auto highest = [](const Ran& ran) { return peak(line_of(ran, "density").computed); };
  const auto outermost_front = [](const Ran& ran) {
    const Line line = line_of(ran, "density");
    return front(line.place, line.computed, 0.5 * (peak(line.computed) + 1.0));
  };
  for (const auto& [file, exact, peak_goal] : {std::tuple{"sedov_planar_1d", 0.5, -reported},
                                               {"sedov_cylindrical_1d", 0.75, 0.98 * 5.46},
                                               {"sedov_spherical_1d", 1.0, 0.98 * 5.41}})
    add(file, "density",
        {{"radius, beyond half a cell and 0.3 %", 0.0,
          [=](const Ran& ran) { return from_radius(outermost_front(ran), ran.config.cell_size, exact); }},
         {peak_density, peak_goal, highest, true},
         closed});
  // In the cells of the case in space: a smeared front is ahead of the exact one by a part of its cells, on a radius as well.
  add("sedov_spherical_1d", "density", {{front_radius, reported, outermost_front}, {peak_density, reported, highest}},
      {"cell_size=0.02", "gas.fill.1.shape.sphere.radius=0.06", "title=Point blast of Sedov, 50 cells to the front"}, "_50");
  const Goal round_front{"spread of the radius", 0.015, [](const Ran& ran) { return fronts(ran, 1.15, 1.0).spread; }};
  add("sedov_axisymmetric", "density",
      {{"radius from 1, beyond half a cell and 0.3 %", 0.0,
        [=](const Ran& ran) { return from_radius(fronts(ran, 1.15, 1.0).mean, ran.config.cell_size); }},
       round_front,
       {peak_density, 0.85 * 5.04, [](const Ran& ran) { return fronts(ran, 1.15, 1.0).peak; }, true},
       closed});
  add("sedov_three_dimensional", "density",
      {{"radius from 1, beyond half a cell and 0.3 %", 0.0,
        [=](const Ran& ran) { return from_radius(fronts(ran, 1.15, 1.0).mean, ran.config.cell_size); }},
       {front_radius, reported, [](const Ran& ran) { return fronts(ran, 1.15, 1.0).mean; }},
       round_front,
       {peak_density, reported, [](const Ran& ran) { return fronts(ran, 1.15, 1.0).peak; }},
       closed});
  add("cylindrical_explosion", "density",
      {relative_L1(0.05),
       {"spread of the radius of the shock", 0.015, [](const Ran& ran) { return fronts(ran, 0.95, 0.125, 0.18).spread; }},
       closed});
  const Goal motion{"kinetic energy lost", 0.02, lost_motion};
  add("isentropic_vortex", "velocity", {closed}, {"cell_size=0.15625 m", "title=Isentropic vortex, 64 x 64 cells"}, "_64");
  add("isentropic_vortex", "velocity", {closed});
  add("gresho_vortex", "velocity", {motion, closed});
  add("gresho_vortex", "velocity", {motion, closed},
      {"gas.fill.0.profile.file=gresho_vortex_mach_001_start.csv", "figure.0.reference=gresho_vortex_mach_001.csv",
       "title=Vortex of Gresho at Mach 0.01"},
      "_mach_001");
  add("gresho_vortex_implicit", "velocity", {motion, closed});
  add("gresho_vortex_implicit", "velocity", {motion, closed},
      {"gas.fill.0.profile.file=gresho_vortex_mach_0001_start.csv", "figure.0.reference=gresho_vortex_mach_0001.csv",
       "title=Vortex of Gresho at Mach 0.001, implicit"},
      "_mach_0001");
  add("hydrostatic_column", "pressure",
      {{"fastest, over the speed of sound", 1e-10, largest_error("velocity", std::sqrt(1.4 * 0.4 * 718.0 * 250.0))}});
  add("water_air_shock_tube", "density", {relative_L1(2.4e-3), closed});
  add("dense_gas_into_air", "density", {relative_L1(1.65e-3), closed});
  for (const std::string fluid : {"water", "products"})
    add(fluid + "_slab", "fraction_" + fluid,
        {{"error of the pressure, of it", 1e-9, largest_error("pressure", 1e5)},
         {"error of the velocity in m/s", 1e-8, largest_error("velocity", 1.0)},
         closed});
  const auto impact = [&](const std::string& file) {
    add(file, "pressure", {{"pressure behind the shock", 0.01, [](const Ran& ran) {
                              const Line line = line_of(ran, "pressure");
                              const double high = line.exact.front(), shock = front(line.place, line.exact, 0.5 * high);
                              return std::abs(plateau(line, 0.2 * shock, 0.8 * shock) / high - 1.0);
                            }}});
  };
  impact("murnaghan_impact"), impact("tillotson_impact");
  add("couette", "speed", {{"error of the speed, of the wall's", 0.005, [](const Watched& ran) {
                              const Line line = line_of(ran, "speed");
                              return error("speed")(ran) / peak(line.exact);
                            }}});
  add("closed_bomb", "pressure", {relative("pressure", 0.03)});
  for (const auto& [file, velocity, pressure, supported] : {std::tuple{"detonation_pbx_9501", 8734.1, 33.354e9, false},
                                                            {"program_burn_pbx_9501", 8734.1, 33.354e9, false},
                                                            {"detonation_composition_b", 7979.9, 29.499e9, true},
                                                            {"detonation_tnt", 6929.4, 21.0e9, true}}) {
    add(file, "pressure",
        {relative("pressure", 0.03),
         {"velocity of the front from that of Chapman and Jouguet", 0.01, [velocity](const Watched& run) {
            const std::size_t from = run.time.size() * 6 / 10, to = run.time.size() * 9 / 10;
            return std::abs((run.values[to][0] - run.values[from][0]) / (run.time[to] - run.time[from]) / velocity - 1.0);
          }}});
    all.back().watch = front_of(0.5 * pressure);
    if (supported)  // the wave of Taylor leaves no plateau
      all.back().goals.push_back({"largest error of the plateau", 0.03, [pressure](const Ran& ran) {
                                    constexpr double reaction_is_over = 60e-3;
                                    const Line line = line_of(ran, "pressure");
                                    double most = 0.0;
                                    for (std::size_t i = 0; line.place[i] < reaction_is_over; ++i)
                                      most = std::max(most, std::abs(line.computed[i] / pressure - 1.0));
                                    return most;
                                  }});
  }
  add("gas_driven_projectile", "pressure", {relative("pressure", 0.01)});
  add("supersonic_wedge", "pressure", {relative("pressure", 0.03)});
  const auto watched = [&](const std::string& file, const std::string& field, const Watch& watch, std::vector<Goal> goals,
                           std::vector<std::string> changes = {}, const std::string& variation = "") {
    add(file, field, std::move(goals), std::move(changes), variation);
    all.back().watch = watch;
  };
  const auto kept = [](std::size_t number) {
    return Goal{"change of the mass of its gas", 1e-12, [=](const Watched& run) { return largest_change(run, number); }};
  };
  const auto ring = [&](const std::string& file, double radius, double speed, double thickness, double near,
                        std::vector<std::string> changes = {}, const std::string& variation = "") {
    const Watch watch = pressure_in_ring(radius, speed, thickness);
    watched(file, "", watch,
            {{"mean pressure from p V^1.4", near, [watch](const Watched& run) { return last_error(run, watch); }}, kept(1)},
            std::move(changes), variation);
  };
  ring("widening_ring", 0.25, 0.05, 0.08, 2e-3,
       {"cell_size=0.02 m", "gas.body.0.shape.sphere.radius=0.33 m", "figure.0.from=[0, 0.01]", "figure.0.to=[0.5, 0.01]",
        "title=Gas in a ring that widens, 12 cells"},
       "_12");
  ring("widening_ring", 0.25, 0.05, 0.04, 4e-4);
  ring("shrinking_ring", 0.35, -0.05, 0.06, 0.01);
  watched("closed_ring", "pressure", mass_in_ring(12.75), {kept(0)});
  watched("closed_ring_in_motion", "", mass_in_ring(13.0), {kept(0)});
  const Watch piston = {25, "mean pressure (Pa)",
                        [](const Simulation& s) {
                          const double face = 1.0075 + s.gas.bodies.all.at(0).state.displacement[0];
                          const Held gas = held(s, [face](const Vector& x) { return x[0] < face + 0.05; });
                          return std::vector{gas.pressure, gas.mass, gas.volume};
                        },
                        [](const Watched& run, double t) {
                          constexpr double width = 0.1, speed = 0.05;
                          const double start = run.values[0][2] / width;  // its particles show it to a part of their width
                          return std::pow(start / (start - speed * t), gamma);
                        }};
  watched("piston_in_gas", "", piston,
          {{"mean pressure from p V^1.4", 0.01, [piston](const Watched& run) { return last_error(run, piston); }}, kept(1)});
  for (const char* file : {"disk_with_the_gas", "sphere_with_the_gas", "sphere_with_the_gas_3d"})
    watched(file, "pressure", noise,
            {{"largest change of the pressure, at any time", 2e-2,
              [](const Watched& run) {
                double most = 0.0;
                for (const std::vector<double>& values : run.values) most = std::max(most, values[0]);
                return most;
              }},
             {"mean change of the pressure", 5e-4, [](const Watched& run) { return run.values.back()[1]; }}});
  for (const auto& [cells, variation] : {std::pair{4.0, ""}, {2.0, "_2_cells"}, {1.0, "_1_cell"}, {0.5, "_half_a_cell"}}) {
    const double slot = cells * 1e-3, shift = 0.23, end = 8.0 + 0.5 * cells;
    const auto at = [&](double x, double y) { return fmt::format("[\"{:g} mm\", \"{:g} mm\"]", x, y); };
    std::vector<std::string> changes;
    if (cells != 4.0)
      changes = {"gas.body.0.shape.union.0.box.lower=" + at(28.0, shift + end),
                 "gas.body.0.shape.union.1.sphere.centre=" + at(36.0, shift + end),
                 "gas.body.1.shape.union.0.box.upper=" + at(44.0, shift - end),
                 "gas.body.1.shape.union.1.sphere.centre=" + at(36.0, shift - end),
                 fmt::format("title=Chamber with a slot, {:g} cell{}", cells, cells > 1.0 ? "s" : "")};
    const Measure flow = flow_through(slot);
    watched("vented_chamber", "", chamber(slot),
            cells < 2.0 ? std::vector<Goal>{{"flow through the slot over the choked flow", reported, flow}}
                        : std::vector<Goal>{{"flow through the slot from the choked flow", 0.05,
                                             [flow](const Watched& run) { return std::abs(flow(run) - 1.0); }}},
            changes, variation);
  }
  return all;
}

}  // namespace brisance::simulator
