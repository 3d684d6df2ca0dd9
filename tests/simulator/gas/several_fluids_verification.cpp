// Fluids that share cells: contacts that move, shock tubes of two fluids, pressure equilibria and Riemann problems at random
// across all equations of state.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/lagrangian.hpp"
#include "simulator/gas/pressure_equilibrium.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/fluids.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;
using set_up::air;
using set_up::products;
using set_up::Stepper;
using set_up::water;

/// BRISANCE_LONG_TESTS makes all of the samples that the programs otherwise make a part of.
bool long_tests() {
  return std::getenv("BRISANCE_LONG_TESTS") != nullptr;
}

/// So many cells on a length of 1.
Gas line(int cells, std::vector<Fluid> fluids, Domain& domain, double length = 1.0) {
  return set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {static_cast<int>(std::lround(length * cells)), 0, 0},
                     std::move(fluids), domain);
}

// Contacts -------------------------------------------------------------------------------------------------------------

struct Slab {
  std::string name;
  Fluid inside;
  double density, pressure;  // inside; air at the same pressure around it
};

TEST(Advection, OfASlabThroughAirMakesNoPressureWave) {
  constexpr double speed = 100.0, distance = 0.4;
  constexpr double calm = 1e-9, still = 1e-8;  // of the pressure; m/s
  for (const Slab& slab :
       {Slab{"water", water, 1000.0, 1e5}, {"products", products, 2.0, 1e5}, {"dense products", products, 50.0, 2e7}})
    for (const int cells : {100, 200}) {
      const auto domain = single_process();
      Gas gas = line(cells, {slab.inside, air}, *domain);
      gas.edges = {set_up::around(), set_up::around()};
      fill(
          gas,
          [&](const Vector& x, double) {
            return x[0] > 0.3 && x[0] < 0.6 ? Filling{0, slab.density, slab.pressure, {speed, 0.0, 0.0}}
                                            : Filling{1, 1.2e-5 * slab.pressure, slab.pressure, {speed, 0.0, 0.0}};
          },
          *domain);
      const Totals before = totals(gas, *domain);
      Stepper().to(gas, distance / speed, *domain);
      const Totals after = totals(gas, *domain);
      constexpr double round_off = 1e-13;
      EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off) << slab.name;
      for (std::size_t r = 0; r < 2; ++r)
        EXPECT_LT(set_up::relative_change(before.mass[r], after.mass[r]), round_off) << slab.name;
      double pressure = 0.0, velocity = 0.0, mixed = 0.0;
      set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
        pressure = std::max(pressure, std::abs(c.pressure / slab.pressure - 1.0));
        velocity = std::max(velocity, std::abs(c.velocity[0] - speed));
        const double part = set_up::fraction(gas, c, 0);
        mixed += part > 0.01 && part < 0.99 ? 1.0 : 0.0;
      });
      EXPECT_LT(pressure, calm) << slab.name << ", " << cells << " cells";
      EXPECT_LT(velocity, still) << slab.name << ", " << cells << " cells";
      EXPECT_LT(mixed, 16.0) << slab.name << ": its two contacts";
      const std::string name = slab.name + "_" + std::to_string(cells);
      RecordProperty(name, std::to_string(pressure * 1e12) + "e-12, velocity " + std::to_string(velocity * 1e12) +
                               "e-12, mixed " + std::to_string(mixed));
    }
}

// Shock tubes ----------------------------------------------------------------------------------------------------------

struct Tube {
  std::string name;
  const Fluid &left_fluid, &right_fluid;
  GasState left, right;
  StiffenedGas left_gas, right_gas;  // the same in the exact solution
  double diaphragm, time, length;
};

/// Mean error of the density over its mean.
double relative_error(const Tube& tube, int cells) {
  const ExactRiemann exact(tube.left, tube.left_gas, tube.right, tube.right_gas);
  EXPECT_LT(tube.diaphragm + exact.right_head() * tube.time, tube.length) << tube.name << ": the shock has reached the end";
  EXPECT_GT(tube.diaphragm + exact.left_head() * tube.time, 0.0) << tube.name << ": the rarefaction has reached the end";
  const auto domain = single_process();
  Gas gas = line(cells, {tube.left_fluid, tube.right_fluid}, *domain, tube.length);
  fill(
      gas,
      [&](const Vector& x, double) {
        return x[0] < tube.diaphragm ? Filling{0, tube.left.density, tube.left.pressure, {}}
                                     : Filling{1, tube.right.density, tube.right.pressure, {}};
      },
      *domain);
  const Totals before = totals(gas, *domain);
  Stepper().to(gas, tube.time, *domain);
  const Totals after = totals(gas, *domain);
  constexpr double round_off = 1e-13;
  EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off) << tube.name;
  for (std::size_t r = 0; r < 2; ++r) EXPECT_LT(set_up::relative_change(before.mass[r], after.mass[r]), round_off) << tube.name;
  const auto average = [&](double from, double to) { return exact.average(from, to, tube.time, tube.diaphragm); };
  double mean = 0.0;
  const int count = static_cast<int>(gas.cells.count());
  for (int i = 0; i < count; ++i) mean += average(i * gas.cells.cell_size, (i + 1) * gas.cells.cell_size).density / count;
  const double error = set_up::mean_errors(gas, average).density / mean;
  testing::Test::RecordProperty("density_" + std::to_string(cells), std::to_string(error));
  return error;
}

TEST(ShockTube, OfWaterIntoGasConverges) {
  const Tube tube = {"water into gas", water, air, {1000.0, 0.0, 1e9}, {50.0, 0.0, 1e5}, {4.4, 6e8}, {1.4, 0.0}, 0.7,
                     2.4e-4,           1.0};
  for (const auto& [cells, most] : {std::pair{100, 6e-3}, {200, 4e-3}, {400, 2.4e-3}, {800, 1.5e-3}})
    EXPECT_LE(relative_error(tube, cells), most) << cells << " cells";
}

TEST(ShockTube, OfDenseGasIntoAirConverges) {
  // The shock runs 0.59 and the contact 0.49: the line is so long that they stay on it. The dense gas fills 0.7 of it; what is
  // relative to the mass depends on that.
  const Tube tube = {"dense gas into air",
                     {"dense", eos::IdealGas{1.4, 718.0}},
                     air,
                     {400.0, 0.0, 6e8},
                     {1.2, 0.0, 1e5},
                     {1.4, 0.0},
                     {1.4, 0.0},
                     0.7,
                     1.6e-4,
                     1.3};
  for (const auto& [cells, most] : {std::pair{100, 6e-3}, {200, 3.2e-3}, {400, 1.65e-3}, {800, 8.5e-4}})
    EXPECT_LE(relative_error(tube, cells), most) << cells << " cells";
}

// Sound ------------------------------------------------------------------------------------------------------------------

/// Of water with bubbles. The waves of its cells are softer than its sound where the steps are short, as beside a liquid of one
/// cell: then they fade. Without a bound for that a wave in long steps would grow, to hundreds of its height.
TEST(Sound, InBubblyWaterStaysAsHighAsItWas) {
  constexpr double part = 0.1, pressure = 1e5, water_density = 1000.0, air_density = 1.2;
  constexpr double small = 1e-4;  // of the speed of sound
  const double compliance = part / (1.4 * pressure) + (1.0 - part) / (4.4 * (pressure + 6e8));
  const double sound = 1.0 / std::sqrt(compliance * ((1.0 - part) * water_density + part * air_density));
  for (const auto& [courant, cells, lost] :
       {std::tuple{0.5, 32, 0.005}, {0.5, 128, 0.0005}, {0.02, 32, 0.1}, {0.02, 128, 0.002}}) {
    const auto domain = single_process();
    Gas gas = line(cells, {water, air}, *domain);
    gas.edges = {set_up::around(), set_up::around()};
    const auto wave = [](double x) { return std::sin(2.0 * std::numbers::pi * x); };
    fill_in_portions(
        gas,
        [&](const Vector& x) -> std::vector<Portion> {
          const Vector velocity = {small * sound * wave(x[0]), 0.0, 0.0};
          return {{1.0 - part, {0, water_density, pressure, velocity}}, {part, {1, air_density, pressure, velocity}}};
        },
        *domain);
    Stepper stepper;
    stepper.courant = courant;
    stepper.to(gas, 1.0 / sound, *domain);  // a period
    double height = 0.0;
    set_up::for_each_cell(
        gas, [&](const set_up::Cell& c) { height += 2.0 / cells * c.velocity[0] * wave(c.centre[0]) / (small * sound); });
    EXPECT_NEAR(height, 1.0, lost) << cells << " cells, Courant number " << courant;
    RecordProperty("height_" + std::to_string(cells) + (courant < 0.1 ? "_short_steps" : ""), std::to_string(height));
  }
}

// Pressure equilibria --------------------------------------------------------------------------------------------------

std::vector<Fluid> all_fluids() {
  std::vector<Fluid> all = {
      air,
      water,
      products,
      {"abel", eos::Abel{1.25, 1500.0, 1e-3}},
      {"twu_sim_tassone", eos::TwuSimTassone{1.63, 514.96, -260.1385968, 7.955153678e-4}},
      {"murnaghan", eos::Murnaghan{1840.0, 36e9, 7.4, 1e5, 1000.0, 298.0}},
      {"birch_murnaghan", eos::BirchMurnaghan{1840.0, 36e9, 7.4, 1e5, 1000.0, 298.0}},
      {"tillotson", eos::Tillotson{2700.0, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5.0, 5.0, 896.0, 298.0}}};
  for (Fluid& f : all) give_usual_state(f);
  return all;
}

/// What one fluid has before equilibrium: per kg.
struct Before {
  const Fluid* fluid;
  double mass, volume, energy;
};

/// The pressure at which the fluids fill the cell, by bisection in bisection. Each works against the final pressure.
double bisected_pressure(const std::vector<Before>& all, double cell_volume) {
  const auto volume_at = [](const Before& b, double p) {
    const auto excess = [&](double v) {
      return eos::pressure(b.fluid->equation_of_state, 1.0 / v, b.energy - p * (v - b.volume)) - p;
    };
    double low = b.volume, high = b.volume;
    constexpr int most = 300;
    for (int n = 0; n < most && excess(low) < 0.0; ++n) high = low, low *= 0.8;
    for (int n = 0; n < most && excess(high) > 0.0; ++n) low = high, high *= 1.25;
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
      (excess(middle) > 0.0 ? low : high) = middle;
    return 0.5 * (low + high);
  };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Before& b : all) {
    const double p = eos::pressure(b.fluid->equation_of_state, 1.0 / b.volume, b.energy);
    low = std::min(low, p), high = std::max(high, p);
  }
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high)) {
    double sum = 0.0;
    for (const Before& b : all) sum += b.mass * volume_at(b, middle);
    (sum > cell_volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

TEST(Equilibrium, IsFoundForAnyFluidsAndIsThatOfBisection) {
  const std::vector<Fluid> all = all_fluids();
  std::mt19937 random(20240611);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto logarithmic = [&](double low, double high) { return std::exp(between(std::log(low), std::log(high))); };
  const int packs = long_tests() ? 12500 : 2500;  // of eight cells
  EquilibriumCount count;
  int failures = 0, wrong = 0;
  double worst = 0.0;
  for (int pack = 0; pack < packs; ++pack) {
    const int n = 2 + pack % 2;
    std::vector<Fluid> fluids;
    std::vector<FluidShare> shares(static_cast<std::size_t>(n));
    for (int r = 0; r < n; ++r) fluids.push_back(all[random() % all.size()]);
    Lanes cell_volume;
    for (int l = 0; l < 8; ++l) {
      cell_volume.set(l, logarithmic(1e-9, 1.0));
      std::vector<double> part;
      double sum = 0.0;
      for (int r = 0; r < n; ++r) part.push_back(logarithmic(1e-8, 1.0)), sum += part.back();
      double filled = 0.0;
      for (int r = 0; r < n; ++r) {
        const auto i = static_cast<std::size_t>(r);
        const EquationOfState& law = fluids[i].equation_of_state;
        const double temperature = between(250.0, 3000.0), density = eos::density_at(law, logarithmic(1e4, 1e10), temperature);
        const double volume = r + 1 < n ? cell_volume[l] * part[i] / sum : cell_volume[l] - filled;
        filled += volume;
        const double energy = eos::energy(law, density, temperature);
        shares[i].mass.set(l, density * volume), shares[i].volume.set(l, volume),
            shares[i].internal.set(l, density * volume * energy);
      }
    }
    std::vector<FluidShare> relaxed = shares;
    const Lanes pressure = equilibrate(fluids, shares, cell_volume, &count);
    for (int l = 0; l < 8; ++l) {
      double volume = 0.0, stiffest = 0.0;
      bool good = std::isfinite(pressure[l]);
      for (const auto& s : shares) {
        volume += s.volume[l];
        good = good && s.volume[l] > 0.0 && std::isfinite(s.internal[l]);
        stiffest = std::max(stiffest, s.bulk_modulus[l]);
      }
      good = good && std::abs(volume / cell_volume[l] - 1.0) < 1e-12;
      if (!good) ++failures;
      // Bisection takes a thousand times as long.
      if (pack % 25 != 0) continue;
      relax(fluids, relaxed, cell_volume, l);
      std::vector<Before> before;
      for (std::size_t i = 0; i < relaxed.size(); ++i) {
        const double m = relaxed[i].mass[l];
        before.push_back({&fluids[i], m, relaxed[i].volume[l] / m, relaxed[i].internal[l] / m});
      }
      const double exact = bisected_pressure(before, cell_volume[l]);
      // What the pressures' own rounding leaves.
      const double rounding = 1e-13 * stiffest;
      const double off = (std::abs(pressure[l] - exact) - rounding) / std::abs(exact);
      worst = std::max(worst, off);
      if (!(off < 1e-10)) {
        if (++wrong < 10)
          ADD_FAILURE() << fluids[0].name << ", " << fluids[1].name << ", " << fluids.back().name << ": " << pressure[l]
                        << " instead of " << exact;
      }
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(wrong, 0);
  const double mean = count.iterations / count.cells;
  EXPECT_LE(mean, 12.0);
  RecordProperty("newton", std::to_string(mean) + ", bisected " + std::to_string(count.bisected) + " of " +
                               std::to_string(count.cells) + ", worst " + std::to_string(worst * 1e12) + "e-12");
}

/// A little air beside dense fluids of far higher pressure comes to that pressure along its isentrope, and what this leaves
/// over of their work warms all by mass: next to none of it the air. Work against the final pressure would give it 8 to 900
/// times as much energy.
TEST(Equilibrium, PressesAirTogetherAlongItsIsentrope) {
  struct Dense {
    double pressure, water, products;  // Pa, kg/m^3
  };
  for (const bool wet : {true, false}) {
    for (const Dense& d : {Dense{1e7, 1000.0, 20.0}, {1e8, 1050.0, 150.0}, {1e9, 1200.0, 700.0}, {8e9, 1400.0, 1600.0}}) {
      const Fluid& dense = wet ? water : products;
      const double pressure = d.pressure, density = wet ? d.water : d.products, part = 1e-4, start = 1e5;
      std::vector<Fluid> fluids = {air, dense};
      for (Fluid& f : fluids) give_usual_state(f);
      const double energies[2] = {energy_of(air.equation_of_state, 1.2, start),
                                  energy_of(dense.equation_of_state, density, pressure)};
      std::vector<FluidShare> shares(2);
      shares[0].mass = Lanes(1.2 * part), shares[0].volume = Lanes(part);
      shares[1].mass = Lanes(density * (1.0 - part)), shares[1].volume = Lanes(1.0 - part);
      for (std::size_t r = 0; r < 2; ++r) shares[r].internal = shares[r].mass * energies[r];
      const Lanes found = equilibrate(fluids, shares, Lanes(1.0));
      EXPECT_NEAR(found[0], pressure, 0.03 * pressure);  // the air gives room
      const double isentropic = energies[0] * std::pow(found[0] / start, 0.4 / 1.4),
                   now = shares[0].internal[0] / shares[0].mass[0];
      EXPECT_NEAR(now / isentropic, 1.0, 0.05) << dense.name << " at " << pressure << " Pa";
      EXPECT_NEAR((shares[0].volume + shares[1].volume)[0], 1.0, 1e-14);
      EXPECT_NEAR((shares[0].internal + shares[1].internal)[0], energies[0] * 1.2 * part + energies[1] * density * (1.0 - part),
                  1e-13 * std::abs(shares[1].internal[0]));
    }
  }
}

/// A fluid that stands between two others is seen, whichever of it and stiff water has the lower pressure, and no energy is
/// lost.
TEST(Equilibrium, SeesTheFluidThatIsCrushedWhateverWaterHas) {
  for (const double of_water : {1.1e5, 0.9e5, -1e6}) {
    std::vector<Fluid> fluids = {air, water, products};
    for (Fluid& f : fluids) give_usual_state(f);
    std::vector<FluidShare> shares(3);
    double before = 0.0, after = 0.0;
    const auto put = [&](std::size_t r, double density, double pressure, double part) {
      shares[r].mass = Lanes(density * part), shares[r].volume = Lanes(part);
      shares[r].internal = shares[r].mass * energy_of(fluids[r].equation_of_state, density, pressure);
      before += shares[r].internal[0];
    };
    put(0, 1.2, 1e5, 1e-3), put(1, 1000.0, of_water, 0.499), put(2, 150.0, 1e8, 0.5);
    const double start = shares[0].internal[0];
    const Lanes found = equilibrate(fluids, shares, Lanes(1.0));
    for (const auto& s : shares) after += s.internal[0];
    EXPECT_NEAR(shares[0].internal[0] / (start * std::pow(found[0] / 1e5, 0.4 / 1.4)), 1.0, 0.05) << "water at " << of_water;
    EXPECT_NEAR(after, before, 1e-13 * shares[1].internal[0]);
  }
}

/// Two gases of equal mass and very different pressures: each takes half of what the work of the one is more than that of the
/// other. p V^1.4 is integrated in small steps.
TEST(Equilibrium, WarmsByMassWhatIsLeftOfTheWork) {
  std::vector<Fluid> fluids = {air, air};
  for (Fluid& f : fluids) give_usual_state(f);
  std::vector<FluidShare> shares(2);
  shares[0].mass = Lanes(1.0), shares[0].volume = Lanes(0.9), shares[0].internal = Lanes(1e4);
  shares[1].mass = Lanes(1.0), shares[1].volume = Lanes(0.1), shares[1].internal = Lanes(1e6);
  double volume = 0.9, low = 1e4, high = 1e6;
  for (double step = 1e-5; 0.4 * low / volume < 0.4 * high / (1.0 - volume); volume -= step) {
    const double taken = 0.4 * low / volume * step, done = 0.4 * high / (1.0 - volume) * step;
    low += taken + 0.5 * (done - taken), high -= done - 0.5 * (done - taken);
  }
  const Lanes pressure = equilibrate(fluids, shares, Lanes(1.0));
  EXPECT_NEAR(pressure[0], 0.4 * 1.01e6, 1e-9 * pressure[0]);
  EXPECT_NEAR(shares[0].internal[0], low, 0.02 * low);
  EXPECT_NEAR(shares[0].volume[0], volume, 0.02 * volume);
}

// Riemann problems -----------------------------------------------------------------------------------------------------

/// Less energy than at T = 0, kg/m^3 of nothing, volumes below nothing: what no cell may hold.
std::string impossible(const Gas& gas) {
  std::string found;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    if (!found.empty()) return;
    const auto tell = [&](const std::string& what, double value) {
      found = what + " " + std::to_string(value) + " in cell " + std::to_string(c.index[0]);
    };
    if (!(c.density > 0.0) || !std::isfinite(c.density)) return tell("density", c.density);
    if (!std::isfinite(c.pressure) || !(c.sound_speed > 0.0)) return tell("pressure", c.pressure);
    for (std::size_t r = 0; r < gas.fluids.size(); ++r) {
      const auto at = [&](int q) { return gas.content.cell(c.block, Content::of(1, r, q), c.number); };
      const double mass = at(Content::mass), volume = at(Content::volume);
      if (volume < -1e-14 * c.volume) return tell(gas.fluids[r].name + ": volume", volume / c.volume);
      if (mass < 0.0) return tell(gas.fluids[r].name + ": mass", mass);
      if (volume < least_fraction * c.volume) continue;
      const EquationOfState& law = gas.fluids[r].equation_of_state;
      if (eos::caloric(law) != eos::Caloric::complete) continue;
      const double energy = at(Content::internal) / mass, cold = eos::energy(law, mass / volume, 0.0);
      if (!(energy >= cold - 1e-9 * std::abs(cold))) return tell(gas.fluids[r].name + ": thermal energy", energy - cold);
    }
  });
  return found;
}

TEST(RiemannProblem, AtRandomLeavesNothingImpossible) {
  const std::vector<Fluid> all = all_fluids();
  std::mt19937 random(7);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const int problems = long_tests() ? 10000 : 500;
  int failures = 0;
  std::int64_t first_order_cell_steps = 0;
  for (int n = 0; n < problems; ++n) {
    std::vector<Fluid> fluids = {all[random() % all.size()], all[random() % all.size()]};
    std::array<Filling, 2> side;
    for (std::size_t s = 0; s < 2; ++s) {
      const EquationOfState& law = fluids[s].equation_of_state;
      const double pressure = std::exp(between(std::log(1e4), std::log(1e10)));
      const double density = eos::density_at(law, pressure, between(250.0, 2000.0));
      side[s] = {static_cast<int>(s), density, pressure, {}};
      if (eos::caloric(law) == eos::Caloric::barotropic) side[s].pressure = eos::pressure(law, density, 0.0);
      const double energy = eos::energy_at_pressure(law, density, side[s].pressure);
      // Liquids that part are torn, which none of these laws describes: the two approach each other.
      side[s].velocity[0] =
          (s == 0 ? 1.0 : -1.0) * between(0.0, 0.3) * std::sqrt(eos::sound_speed_squared(law, density, energy));
    }
    const auto domain = single_process();
    Gas gas = line(64, fluids, *domain);
    gas.edges = {set_up::beyond(EdgeKind::inflow, side[0]), set_up::beyond(EdgeKind::inflow, side[1])};
    std::string trouble;
    try {
      fill(
          gas, [&](const Vector& x, double) { return side[x[0] < 0.5 ? 0 : 1]; }, *domain);
      trouble = impossible(gas);
      for (int steps = 0; steps < 60 && trouble.empty(); steps += 6) {
        Stepper().steps(gas, 6, *domain);
        trouble = impossible(gas);
      }
    } catch (const std::exception& e) {
      trouble = e.what();
    }
    first_order_cell_steps += gas.first_order_cell_steps;
    if (!trouble.empty() && ++failures <= 20)
      std::cout << "problem " << n << ", step " << gas.step << ": " << trouble << "; " << fluids[0].name << " "
                << side[0].density << " kg/m^3, " << side[0].pressure << " Pa, " << side[0].velocity[0] << " m/s | "
                << fluids[1].name << " " << side[1].density << " kg/m^3, " << side[1].pressure << " Pa, " << side[1].velocity[0]
                << " m/s\n";
  }
  EXPECT_EQ(failures, 0);
  RecordProperty("cells_without_slopes", std::to_string(first_order_cell_steps));
}

/// Products at 7.7 GPa and 250 K stand on their cold curve; slopes would cool them below it where they are let go.
TEST(RiemannProblem, OfColdProductsDoesWithoutSlopesWhereTheyWouldCoolBelowTheColdCurve) {
  const auto domain = single_process();
  Gas gas = line(64, {air, products}, *domain);
  const double density = eos::density_at(products.equation_of_state, 7.7e9, 260.0);
  fill(
      gas,
      [&](const Vector& x, double) {
        return x[0] < 0.5 ? Filling{0, 0.5, 2.4e5, {}} : Filling{1, density, 7.7e9, {-1127.0, 0.0, 0.0}};
      },
      *domain);
  gas.edges[1] = set_up::beyond(EdgeKind::inflow, Filling{1, density, 7.7e9, {-1127.0, 0.0, 0.0}});
  const Totals before = totals(gas, *domain);
  Stepper().steps(gas, 15, *domain);
  EXPECT_EQ(impossible(gas), "");
  EXPECT_GT(gas.first_order_cell_steps, 0);
  // A few cells in a few steps: the rest keeps its second order.
  EXPECT_LT(gas.first_order_cell_steps, 64);
  const Totals after = totals(gas, *domain);
  const std::vector<Totals> through = passed(gas, *domain);
  double energy = before.energy, mass = before.mass[1];
  for (const Totals& t : through) energy += t.energy, mass += t.mass[1];
  constexpr double round_off = 1e-13;
  EXPECT_LT(set_up::relative_change(energy, after.energy), round_off);
  EXPECT_LT(set_up::relative_change(mass, after.mass[1]), round_off);
}

TEST(RiemannProblem, AtRandomHasThePlateauOfTheExactSolution) {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const int problems = long_tests() ? 1000 : 60;
  constexpr int cells = 400, least_plateau = 10;
  constexpr double close = 0.02;  // of the pressure; of the larger of velocity and sound speed
  constexpr double h = 1.0 / cells;
  // What a plateau is small against: behind a fan in which the pressure falls to a hundredth 2 % of it are 2e-4 of the pressure
  // before it; in a liquid they are a change of 4e-5 of p_infinity, and of the density by a hundred-thousandth.
  constexpr double deep_fan = 0.01, soft = 2e-3;  // of the pressure before it; of p_infinity
  int compared = 0, failures = 0, plain = 0, plain_failures = 0;
  double worst_pressure = 0.0, worst_velocity = 0.0, worst_of_drive = 0.0;
  while (compared < problems) {
    std::array<StiffenedGas, 2> gas_of;
    std::array<GasState, 2> state;
    std::vector<Fluid> fluids;
    for (std::size_t s = 0; s < 2; ++s) {
      const bool liquid = random() % 3 == 0;
      gas_of[s] = liquid ? StiffenedGas{4.4, 6e8} : StiffenedGas{between(1.15, 1.67), 0.0};
      const eos::StiffenedGas law{gas_of[s].gamma, gas_of[s].p_infinity, 1000.0};
      const double pressure = std::exp(between(std::log(1e4), std::log(1e10)));
      const double density = liquid ? 1000.0 * between(0.9, 1.3) : pressure / (between(200.0, 500.0) * between(250.0, 3000.0));
      state[s] = {density, 0.0, pressure};
      state[s].velocity = (s == 0 ? 1.0 : -1.0) * between(-0.05, 0.3) * gas_of[s].sound_speed(state[s]);
      fluids.push_back({liquid ? "liquid" : "gas", law});
    }
    const ExactRiemann exact(state[0], gas_of[0], state[1], gas_of[1]);
    if (exact.has_vacuum() || exact.star_pressure() < 0.0) continue;
    const double fastest = std::max(std::abs(exact.left_head()), std::abs(exact.right_head()));
    const double time = 0.45 / fastest, u = exact.star_velocity(), p = exact.star_pressure();
    if ((u - exact.left_tail()) * time < least_plateau * h || (exact.right_tail() - u) * time < least_plateau * h) continue;
    ++compared;
    const auto domain = single_process();
    Gas gas = line(cells, fluids, *domain);
    const auto side = [&](std::size_t s) {
      return Filling{static_cast<int>(s), state[s].density, state[s].pressure, {state[s].velocity, 0.0, 0.0}};
    };
    gas.edges = {set_up::beyond(EdgeKind::inflow, side(0)), set_up::beyond(EdgeKind::inflow, side(1))};
    std::string trouble;
    double pressure = 0.0, velocity = 0.0;
    try {
      fill(
          gas, [&](const Vector& x, double) { return side(x[0] < 0.5 ? 0 : 1); }, *domain);
      Stepper().to(gas, time, *domain);
      // The middle half of either plateau.
      int count = 0;
      const std::vector<GasState> profile = set_up::profile(gas);
      for (int i = 0; i < cells; ++i) {
        const double speed = ((i + 0.5) * h - 0.5) / time;
        const bool left = speed > u + 0.75 * (exact.left_tail() - u) && speed < u + 0.25 * (exact.left_tail() - u);
        const bool right = speed < u + 0.75 * (exact.right_tail() - u) && speed > u + 0.25 * (exact.right_tail() - u);
        if (left || right)
          pressure += profile[static_cast<std::size_t>(i)].pressure, velocity += profile[static_cast<std::size_t>(i)].velocity,
              ++count;
      }
      pressure /= count, velocity /= count;
    } catch (const std::exception& e) {
      trouble = e.what();
    }
    const double sound = std::max(gas_of[0].sound_speed({exact.left_star_density(), u, p}),
                                  gas_of[1].sound_speed({exact.right_star_density(), u, p}));
    const double off_pressure = std::abs(pressure / p - 1.0),
                 off_velocity = std::abs(velocity - u) / std::max(std::abs(u), sound);
    worst_pressure = std::max(worst_pressure, off_pressure), worst_velocity = std::max(worst_velocity, off_velocity);
    const double highest = std::max(state[0].pressure, state[1].pressure);
    worst_of_drive = std::max(worst_of_drive, std::abs(pressure - p) / std::max(highest, p));
    const bool small = p < deep_fan * highest || p < soft * std::max(gas_of[0].p_infinity, gas_of[1].p_infinity);
    if (!small) ++plain;
    if (!trouble.empty() || !(off_pressure < close) || !(off_velocity < close)) {
      if (!small) ++plain_failures;
      if (++failures <= 20)
        std::cout << "problem " << compared << " " << trouble << ": p " << pressure << " for " << p << ", u " << velocity
                  << " for " << u << "; " << gas_of[0].gamma << " " << state[0].density << " " << state[0].velocity << " "
                  << state[0].pressure << " | " << gas_of[1].gamma << " " << state[1].density << " " << state[1].velocity << " "
                  << state[1].pressure << "\n";
    }
  }
  // The goal is none. What is reached: all that miss are small against what drives the flow, and of the 60 right by that
  // measure: the farthest is a shock from gas into water (54), 0.48 % off with 400 cells, 0.008 % with 800. While fluids had
  // slopes at their edges it was 0.25 %.
  const int known = long_tests() ? 86 : 4;
  EXPECT_LE(failures, known) << "of " << compared;
  EXPECT_EQ(plain_failures, 0) << "of " << plain;
  EXPECT_LT(worst_of_drive, long_tests() ? close : 0.005);
  EXPECT_GT(plain, compared / 3);
  RecordProperty("missed", std::to_string(failures) + "; of " + std::to_string(plain) + " that are not small " +
                               std::to_string(plain_failures) + "; worst of the highest pressure " +
                               std::to_string(worst_of_drive));
  RecordProperty("worst", std::to_string(worst_pressure) + ", velocity " + std::to_string(worst_velocity));
}

// Friction along shocks ------------------------------------------------------------------------------------------------

TEST(FrictionAlongShocks, WarmsTheFluidsOfACellAlike) {
  // Bubbly water that is compressed along y slides along z: one Lagrangian phase, with and without.
  constexpr double closing = 50.0, sliding = 100.0, dt = 1e-4;  // m/s, m/s, s; cells of 1 m
  constexpr int half = 8;
  const auto warmed = [&](double jump) {
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::three_dimensional, 1.0, {-half, -half, -half}, {half, half, half}, {water, air}, *domain);
    fill_in_portions(
        gas,
        [&](const Vector& x) -> std::vector<Portion> {
          const Vector velocity = {0.0, -closing * x[1], x[0] < 0.0 ? -0.5 * jump : 0.5 * jump};
          return {{0.99, {0, 1000.0, 1e5, velocity}}, {0.01, {1, 1.2, 1e5, velocity}}};
        },
        *domain);
    advance_half_step(gas, dt);
    EXPECT_TRUE(lagrangian_phase(gas, dt));
    std::array<double, 2> energies{};
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      if (c.index != std::array{0, 0, 0}) return;
      for (int r = 0; r < 2; ++r)
        energies[static_cast<std::size_t>(r)] = gas.moved.cell(c.block, Content::of(3, r, Content::internal), c.number);
    });
    return energies;
  };
  const std::array<double, 2> calm = warmed(0.0), rubbed = warmed(sliding);
  const double of_water = (rubbed[0] - calm[0]) / (990.0 * 1000.0), of_air = (rubbed[1] - calm[1]) / (0.012 * 718.0);  // K
  constexpr double rounding = 1e-4;  // of joules beside the 1e9 of the cell
  EXPECT_GT(of_water, 0.0);
  EXPECT_NEAR(of_air / of_water, 1.0, rounding);
}

}  // namespace
}  // namespace brisance::simulator::gas
