// Burning gas against closed forms and independent integrations: the state of Chapman and Jouguet from the tangent to the
// detonation adiabat, a closed bomb from its ordinary differential equation, the area of circles and spheres.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/reaction.hpp"
#include "tests/simulator/gas/burning_surface.hpp"
#include "tests/simulator/gas/chapman_jouguet.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {
namespace {

using equation_of_state::IdealGas;
using equation_of_state::JonesWilkinsLee;
using equation_of_state::Murnaghan;
using set_up::Stepper;

constexpr double atmosphere = 1e5;  // Pa

// Detonation -----------------------------------------------------------------------------------------------------------

/// Products of a set, and a reactant that starts from the same density.
struct Explosive {
  std::string name;
  JonesWilkinsLee products;
  double bulk_modulus, n;  // of the reactant's Murnaghan law, Pa, 1

  Murnaghan reactant() const { return {products.reference_density, bulk_modulus, n, atmosphere, 1000.0, 300.0}; }
  double heat() const { return products.detonation_energy / products.reference_density; }
};
const Explosive pbx_9501{"PBX 9501", {1838.0, 1668.9e9, 59.69e9, 5.9, 2.1, 0.45, 594.96, 9.499985e9}, 1.0 / 2.78e-11, 7.4};
const Explosive comp_b{"Comp B", {1717.0, 524.2e9, 7.678e9, 4.2, 1.1, 0.34, 1000.0, 8.5e9}, 1717.0 * 3030.0 * 3030.0, 5.92};
const Explosive tnt{"TNT", {1630.0, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 1000.0, 7.0e9}, 1630.0 * 2390.0 * 2390.0, 7.2};

/// A line of explosive, lit at its low end by products at the energy of the explosive and its volume.
struct Stick {
  Explosive explosive;
  double reaction_time = 0.1e-6;  // s, of the exponential decay at the pressure of Chapman and Jouguet
  double b = 1.3;
  double cell_size = 0.2e-3;
  int cells = 600, lit = 20;
  bool supported = false;  // products come in at the state of Chapman and Jouguet

  Gas filled(Domain& domain) const {
    const ChapmanJouguet cj = tangent(explosive.products);
    Gas gas = set_up::box(Geometry::planar_1d, cell_size, {0, 0, 0}, {cells, 1, 1},
                          {{"explosive", explosive.reactant()}, {"products", explosive.products}}, domain);
    gas.burns.push_back({"detonation",
                         0,
                         1,
                         reaction::JwlPlusPlus{1.0 / reaction_time, b, cj.pressure, 0.01 * cj.pressure, explosive.heat()},
                         {}});
    const double density = explosive.products.reference_density;
    const Filling behind{1, cj.density, cj.pressure, {cj.particle_velocity, 0.0, 0.0}};
    if (supported) gas.edges[0] = set_up::beyond(EdgeKind::inflow, behind);
    const Filling lit_products =
        supported ? behind : Filling{1, density, explosive.products.pressure(density, explosive.heat()), {}};
    fill(
        gas,
        [&](const Vector& x, double) {
          return x[0] < lit * cell_size ? lit_products : Filling{0, density, atmosphere, {}};
        },
        domain);
    return gas;
  }
};

/// Where the pressure falls through a level, from the high end.
double front(const std::vector<GasState>& profile, double level, double cell_size) {
  for (std::size_t i = profile.size() - 1; i-- > 0;)
    if (profile[i].pressure > level) {
      const double part = (profile[i].pressure - level) / (profile[i].pressure - profile[i + 1].pressure);
      return (static_cast<double>(i) + 0.5 + part) * cell_size;
    }
  return 0.0;
}

/// Velocity of the front between two places, given as parts of the line.
double front_velocity(const Stick& stick, Gas& gas, double from, double to, Domain& domain) {
  const ChapmanJouguet cj = tangent(stick.explosive.products);
  const double length = stick.cells * stick.cell_size;
  Stepper stepper;
  const auto reach = [&](double place) {
    double x = front(set_up::profile(gas), 0.5 * cj.pressure, stick.cell_size);
    while (x < place * length) {
      stepper.steps(gas, 1, domain);
      x = front(set_up::profile(gas), 0.5 * cj.pressure, stick.cell_size);
    }
    return std::pair{x, gas.time};
  };
  const auto [x0, t0] = reach(from);
  const auto [x1, t1] = reach(to);
  return (x1 - x0) / (t1 - t0);
}

/// Cells in which the reaction is under way: from a hundredth to nine tenths.
int zone(const Gas& gas) {
  int cells = 0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const auto mass = [&](int fluid) { return gas.content.cell(c.block, Content::of(1, fluid, Content::mass), c.number); };
    const double F = mass(1) / (mass(0) + mass(1));
    cells += F > 0.01 && F < 0.9;
  });
  return cells;
}

TEST(Detonation, RunsAtTheVelocityOfChapmanAndJouguetWhateverItsRate) {
  constexpr double velocity_within = 0.01, plateau_within = 0.03;  // the reaction ends beyond any finite number of cells
  for (const Explosive& explosive : {pbx_9501, comp_b, tnt})
    for (const double reaction_time : {0.2e-6, 0.4e-6}) {
      SCOPED_TRACE(explosive.name + ", " + std::to_string(1e6 * reaction_time) + " us");
      const ChapmanJouguet cj = tangent(explosive.products);
      const auto domain = single_process();
      Stick stick{explosive, reaction_time};
      stick.supported = true;
      Gas gas = stick.filled(*domain);
      const double D = front_velocity(stick, gas, 0.6, 0.9, *domain);
      EXPECT_NEAR(D / cj.velocity, 1.0, velocity_within);
      EXPECT_GE(zone(gas), 8);
      EXPECT_EQ(gas.capped, 0);
      const std::vector<GasState> profile = set_up::profile(gas);
      double farthest = 0.0;
      for (std::size_t c = 0; c < 400; ++c)  // the reaction is over there
        farthest = std::max(farthest, std::abs(profile[c].pressure / cj.pressure - 1.0));
      EXPECT_LE(farthest, plateau_within);
      RecordProperty(explosive.name + (reaction_time < 0.3e-6 ? " fast" : " slow"),
                     std::to_string(D / cj.velocity) + ", plateau " + std::to_string(farthest));
    }
}

TEST(Detonation, RunsAsFastUnsupported) {
  // The wave behind it takes some of the heat of the last part of the zone: less, the longer the way behind it.
  constexpr double velocity_within = 0.01;
  for (const Explosive& explosive : {pbx_9501, comp_b, tnt}) {
    const auto domain = single_process();
    Stick stick{explosive};
    stick.cells = 800;
    Gas gas = stick.filled(*domain);
    const double D = front_velocity(stick, gas, 0.7, 0.95, *domain);
    EXPECT_NEAR(D / tangent(explosive.products).velocity, 1.0, velocity_within) << explosive.name;
    RecordProperty(explosive.name, std::to_string(D / tangent(explosive.products).velocity));
  }
}

TEST(ProgramBurn, ArrivesWhenItShouldAndSetsItsHeatFree) {
  const auto domain = single_process();
  constexpr double h = 0.5e-3, D = 8734.0;
  Gas gas = set_up::box(Geometry::plane, h, {0, 0, 0}, {60, 40, 1},
                        {{"explosive", pbx_9501.reactant()}, {"products", pbx_9501.products}}, *domain);
  const auto region = [](auto form) { return std::make_shared<const Shape>(Shape{std::move(form)}); };
  // A plane at x = 0 from the start on, a point in the far corner a little later.
  const Vector corner{60 * h, 40 * h, 0.0};
  constexpr double radius = 1e-4, later = 0.5e-6;
  gas.burns.push_back({"burn",
                       0,
                       1,
                       reaction::ProgramBurn{D, 0.0, 3.0, pbx_9501.heat(), {}},
                       {{region(Box{{-1.0, -1.0, -1.0}, {0.0, 1.0, 1.0}}), 0.0}, {region(Sphere{corner, radius}), later}}});
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1838.0, atmosphere, {}};
      },
      *domain);
  const Totals before = totals(gas, *domain);
  Stepper stepper;
  constexpr double end = 1.2e-6;
  stepper.to(gas, end, *domain);
  double longest = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const auto mass = [&](int fluid) { return gas.content.cell(c.block, Content::of(2, fluid, Content::mass), c.number); };
    const double arrival = std::min(c.centre[0] / D, later + (magnitude(c.centre - corner) - radius) / D);
    const double F = mass(1) / (mass(0) + mass(1)), program = std::clamp(D * (end - arrival) / (3.0 * h), 0.0, 1.0);
    // What flows in from the cell behind has burned more.
    longest = std::max(longest, std::abs(F - program));
    if (program == 1.0) {
      EXPECT_GT(F, 0.999) << c.index[0] << ' ' << c.index[1];
    }
  });
  EXPECT_LT(longest, 0.2);
  const Totals after = totals(gas, *domain);
  EXPECT_GT(after.mass[1], 0.3 * before.mass[0]);
  EXPECT_NEAR(after.energy - before.energy, pbx_9501.heat() * after.mass[1], 1e-12 * after.energy);
}

// Burning area ---------------------------------------------------------------------------------------------------------

/// Sum of the burning area over a ball (or disk, or slab) of reactant, with the fractions of the cells that it cuts.
double area_of_ball(Geometry geometry, double radius, const Vector& centre, bool cut) {
  const auto domain = single_process();
  const int D = number_of_dimensions(geometry), n = static_cast<int>(std::ceil(radius)) + 4;
  std::array<int, 3> lower{-n, D > 1 ? -n : 0, D > 2 ? -n : 0}, upper{n, D > 1 ? n : 1, D > 2 ? n : 1};
  if (is_round(geometry)) lower[0] = 0;
  Gas gas = set_up::box(geometry, 1.0, lower, upper, {{"solid", pbx_9501.reactant()}, {"gas", IdealGas{1.4, 716.0}}}, *domain);
  gas.burns.push_back({"burn", 0, 1, reaction::PressurePower{1.0, 1.0, 1.0, 0.0, 0.0, 1.0}, {}});
  fill(
      gas,
      [&](const Vector& x, double) {
        return magnitude(x - centre) < radius ? Filling{0, 1838.0, atmosphere, {}} : Filling{1, 1.0, atmosphere, {}};
      },
      *domain);
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    if (!cut) return;
    constexpr int samples = 8;
    int inside = 0, all = 0;
    for (int i = 0; i < samples; ++i)
      for (int j = 0; j < (D > 1 ? samples : 1); ++j)
        for (int k = 0; k < (D > 2 ? samples : 1); ++k) {
          Vector x = c.centre;
          const int index[] = {i, j, k};
          for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) x[a] += (index[a] + 0.5) / samples - 0.5;
          inside += magnitude(x - centre) < radius, ++all;
        }
    const double part = static_cast<double>(inside) / all;
    const auto at = [&](int fluid) -> double& {
      return gas.content.cell(c.block, Content::of(D, fluid, Content::volume), c.number);
    };
    at(0) = part * c.volume, at(1) = (1.0 - part) * c.volume;
  });
  find_burning_area(gas, 0, *domain);
  double sum = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) { sum += gas.burning_area.cell(c.block, 0, c.number); });
  return sum;
}

TEST(BurningArea, IsThatOfCirclesAndSpheres) {
  constexpr double part = 0.02;
  const double R = 8.0, pi = std::numbers::pi;
  EXPECT_NEAR(area_of_ball(Geometry::planar_1d, R, {}, true), 2.0, 1e-12);
  EXPECT_NEAR(area_of_ball(Geometry::spherical_1d, R, {}, true) / (R * R), 1.0, part);
  for (const Vector& centre : {Vector{}, Vector{0.3, 0.1, 0.0}, Vector{0.5, 0.45, 0.25}}) {
    EXPECT_NEAR(area_of_ball(Geometry::plane, R, centre, true) / (2.0 * pi * R), 1.0, part);
    EXPECT_NEAR(area_of_ball(Geometry::three_dimensional, R, centre, true) / (4.0 * pi * R * R), 1.0, part);
  }
  EXPECT_NEAR(area_of_ball(Geometry::axisymmetric, R, {}, true) / (2.0 * R * R), 1.0, part);
}

TEST(BurningArea, OfStepsOfCellsIsThatOfTheBallTheyStandFor) {
  // A fill gives whole cells: steps instead of a circle, which smoothing takes for a little more than it.
  constexpr double part = 0.03;
  const double R = 8.0, pi = std::numbers::pi;
  EXPECT_NEAR(area_of_ball(Geometry::plane, R, {}, false) / (2.0 * pi * R), 1.0, part);
  EXPECT_NEAR(area_of_ball(Geometry::three_dimensional, R, {}, false) / (4.0 * pi * R * R), 1.0, part);
}

// Closed bomb ----------------------------------------------------------------------------------------------------------

/// A slab that burns in a closed bomb, and the gas that it sets free: V = 1e-3 m^3, 0.1 kg, A = 0.01 m^2.
struct Bomb {
  static constexpr double volume = 1e-3, charge = 0.1, area = 0.01, solid_density = 1840.0;
  static constexpr double solid_energy = 996.0 * 600.0;  // J/kg
  reaction::PressurePower law{75.3, 0.778, 101325.0, 5e4, 450.0, 2e6};
  IdealGas gas{1.4, 716.0};
  double solid_modulus = 1.0 / 2.78e-11;  // Pa

  Murnaghan solid() const { return {solid_density, solid_modulus, 7.4, 1e5, 996.0, 0.0}; }

  struct State {
    double time, solid, pressure;
  };
  double pressure(double solid) const {
    const double free = volume - solid / solid_density, start_free = volume - charge / solid_density;
    const double energy = 1e5 * start_free / (gas.gamma - 1.0) + (charge - solid) * (law.heat() + solid_energy);
    return (gas.gamma - 1.0) * energy / free;
  }
  /// dm/dt = -A a (p/p0)^n by Runge and Kutta's rule, until the charge has burned.
  std::vector<State> history(double dt) const {
    std::vector<State> states{{0.0, charge, pressure(charge)}};
    const auto rate = [&](double m) {
      return -area * law.coefficient * std::pow(pressure(m) / law.reference_pressure, law.exponent);
    };
    while (states.back().solid > 0.0) {
      const double m = states.back().solid;
      const double a = rate(m), b = rate(m + 0.5 * dt * a), c = rate(m + 0.5 * dt * b), d = rate(m + dt * c);
      const double next = m + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
      const double part = next < 0.0 ? m / (m - next) : 1.0;
      states.push_back({states.back().time + part * dt, std::max(next, 0.0), pressure(std::max(next, 0.0))});
    }
    return states;
  }

  /// The bomb as a line of cells, the slab at its low end.
  Gas filled(int slab_cells, Domain& domain) const {
    const double h = charge / solid_density / area / slab_cells;
    const int cells = static_cast<int>(std::lround(volume / area / h));
    Gas made = set_up::box(Geometry::planar_1d, h, {0, 0, 0}, {cells, 1, 1}, {{"solid", solid()}, {"gas", gas}}, domain);
    made.burns.push_back({"burn", 0, 1, law, {}});
    const auto start = [&](const Vector& x, double) {
      if (x[0] < slab_cells * h) return Filling{0, solid_density, 1e5, {}, 600.0};
      return Filling{1, 1e5 / ((gas.gamma - 1.0) * gas.specific_heat * 300.0), 1e5, {}};
    };
    fill(made, start, domain);
    return made;
  }
};
double mean_pressure(const Gas& gas) {
  double sum = 0.0;
  for (const GasState& s : set_up::profile(gas)) sum += s.pressure;
  return sum / static_cast<double>(gas.cells.count());
}

TEST(ClosedBomb, OfOneStateFollowsItsEquation) {
  // All cells hold the same mixture, and burn a surface that is given.
  constexpr double part = 0.01;
  const Bomb bomb;
  constexpr double dt = 1e-7;
  const std::vector<Bomb::State> exact = bomb.history(dt);
  EXPECT_NEAR(exact.back().time, 2.0746e-3, 1e-4 * 2.0746e-3);  // worked out apart from this
  EXPECT_NEAR(exact.back().pressure, 1.039986e8, 1e-5 * 1.039986e8);
  const auto domain = single_process();
  Gas gas = bomb.filled(5, *domain);
  const int cells = static_cast<int>(gas.cells.count());
  const auto mix = [&](CellSet& set) {
    std::vector<double> mean(static_cast<std::size_t>(gas.contents()), 0.0);
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      for (int q = 0; q < gas.contents(); ++q) mean[static_cast<std::size_t>(q)] += set.cell(c.block, q, c.number) / cells;
    });
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      for (int q = 0; q < gas.contents(); ++q) set.cell(c.block, q, c.number) = mean[static_cast<std::size_t>(q)];
      gas.burning_area.cell(c.block, 0, c.number) = 1.0 / cells;  // of a bomb of one square metre
    });
  };
  mix(gas.content);
  begin(gas, *domain);
  double farthest = 0.0;
  for (std::size_t n = 1; n < exact.size(); ++n) {
    gas.moved = gas.content;
    mix(gas.moved);  // and the area
    burn_cells(gas, 0, dt, *domain);
    mix(gas.moved);
    gas.content = gas.moved;
    begin(gas, *domain);
    if (n % 2000 == 0) {
      EXPECT_NEAR(mean_pressure(gas) / exact[n].pressure, 1.0, part) << exact[n].time;
      farthest = std::max(farthest, std::abs(mean_pressure(gas) / exact[n].pressure - 1.0));
    }
  }
  EXPECT_NEAR(mean_pressure(gas) / exact.back().pressure, 1.0, part);
  RecordProperty("farthest", std::to_string(farthest));
}

TEST(ClosedBomb, WithASlabThatBurnsFollowsTheSameEquation) {
  // The equation knows one pressure. At the published rate the gas leaves the surface at half the speed of sound, and burns it
  // at a pressure above the mean; at a tenth of it the bomb has one pressure. A soft solid allows longer steps.
  constexpr double part = 0.03;
  Bomb bomb;
  bomb.law.coefficient *= 0.1;
  bomb.solid_modulus *= 0.1;
  constexpr double dt = 1e-6;
  const std::vector<Bomb::State> exact = bomb.history(dt);
  const auto domain = single_process();
  Gas gas = bomb.filled(5, *domain);
  Stepper stepper;
  for (const double t : {2e-3, 5e-3, 10e-3, 12e-3, 15e-3, 17e-3}) {
    stepper.to(gas, t, *domain);
    const Bomb::State& at = exact[static_cast<std::size_t>(std::lround(t / dt))];
    EXPECT_NEAR(mean_pressure(gas) / at.pressure, 1.0, part) << t;
    RecordProperty(std::to_string(t), std::to_string(mean_pressure(gas) / at.pressure));
  }
}

/// The same bomb with the slab as the end of a tube of gas.
BurningSurface with_a_surface(const Bomb& bomb, int cells) {
  BurningSurface made;
  made.gamma = bomb.gas.gamma, made.length = Bomb::volume / Bomb::area;
  made.solid_density = Bomb::solid_density, made.thickness = Bomb::charge / Bomb::solid_density / Bomb::area;
  made.energy = Bomb::solid_energy + bomb.law.heat();
  made.coefficient = bomb.law.coefficient, made.exponent = bomb.law.exponent;
  made.reference_pressure = bomb.law.reference_pressure;
  fill(made, cells, 1e5 / ((bomb.gas.gamma - 1.0) * bomb.gas.specific_heat * 300.0), 1e5);
  return made;
}

TEST(BurningSurface, OfSlowFlowFollowsTheEquationOfOnePressure) {
  // At a twentieth of the rate the gas leaves at Mach 0.03 to 0.01.
  Bomb bomb;
  bomb.law.coefficient *= 0.05;
  constexpr double dt = 1e-6, time = 20e-3;
  const Bomb::State exact = bomb.history(dt)[static_cast<std::size_t>(std::lround(time / dt))];
  BurningSurface reference = with_a_surface(bomb, 25);
  const double gas = totals(reference).mass, energy = totals(reference).energy;
  advance_to(reference, time);
  constexpr double small = 0.01, round_off = 1e-12;
  EXPECT_NEAR(reference.burned * Bomb::area / (Bomb::charge - exact.solid), 1.0, small);
  EXPECT_NEAR(mean_pressure(reference) / exact.pressure, 1.0, small);
  EXPECT_NEAR(totals(reference).mass / (gas + reference.burned), 1.0, round_off);
  EXPECT_NEAR(totals(reference).energy / (energy + reference.burned * reference.energy), 1.0, round_off);
  RecordProperty("burned", std::to_string(reference.burned * Bomb::area / (Bomb::charge - exact.solid)));
}

TEST(ClosedBomb, AtThePublishedRateIsThatOfAMovingSurface) {
  // The gas leaves the surface at Mach 0.46 and less, and presses the solid by that much more: half as much again has burned at
  // 1 ms as the equation of one pressure says.
  constexpr double part = 0.03;
  const Bomb bomb;
  constexpr double dt = 1e-7;
  const std::vector<Bomb::State> one_pressure = bomb.history(dt);
  BurningSurface reference = with_a_surface(bomb, 100);
  const auto domain = single_process();
  Gas gas = bomb.filled(15, *domain);
  Stepper stepper;
  for (const double t : {0.2e-3, 0.5e-3, 1e-3, 1.5e-3}) {
    advance_to(reference, t);
    stepper.to(gas, t, *domain);
    double pressure = 0.0, volume = 0.0;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      const double free = set_up::fraction(gas, c, 1);
      pressure += free * c.pressure, volume += free;
    });
    const double burned = 1.0 - totals(gas, *domain).mass[0] * Bomb::area / Bomb::charge;
    const double expected = reference.burned * Bomb::area / Bomb::charge;
    EXPECT_NEAR(burned / expected, 1.0, part) << t;
    EXPECT_NEAR(pressure / volume / mean_pressure(reference), 1.0, part) << t;
    const double solid = one_pressure[static_cast<std::size_t>(std::lround(t / dt))].solid;
    EXPECT_GT(expected / (1.0 - solid / Bomb::charge), 1.3) << t;
    RecordProperty(std::to_string(t * 1e3) + "_ms", std::to_string(burned) + " of " + std::to_string(expected) + ", pressure " +
                                                        std::to_string(pressure / volume / mean_pressure(reference)));
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
