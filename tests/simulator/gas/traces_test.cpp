// A little of a fluid in a cell of another, at fronts of high pressure: it must not grow thinner and hotter without end.

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "simulator/case_reader.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/setup.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"
#include "tests/simulator/gas/fluids.hpp"
#include "tests/simulator/gas/set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::air;
using set_up::products;
using set_up::Stepper;
using set_up::water;

/// The front of products that rush into air is a cell that both share. It used to be emptied until what was left in it was at
/// 1e14 J/kg and more, and ten thousand steps led to 16 us.
TEST(Charge, ThatExpandsIntoAirDoesNotEmptyTheCellsAtItsFront) {
  constexpr double h = 5e-3, radius = 0.08, end = 40e-6;
  constexpr int cells = 60, most_steps = 600;  // it takes 300
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::axisymmetric, h, {}, {cells, cells, 0}, {air, products}, *domain);
  gas.edges.assign(4, set_up::wall());
  fill(
      gas,
      [&](const Vector& x, double) {
        return magnitude(x) < radius ? Filling{1, 1838.0, 1.2e10, {}} : Filling{0, 1.2, 1e5, {}};
      },
      *domain);
  Stepper stepper;
  while (gas.time < end && gas.step < most_steps) stepper.steps(gas, 20, *domain);
  EXPECT_GE(gas.time, end);
  RecordProperty("steps", std::to_string(gas.step));
}

/// On these cells a trace of the air was carried along the side of the stick by its detonation, into the explosive ahead, and
/// grew thinner and hotter from cell to cell: after 367 steps nothing was left of its mass, and no pressure was found.
TEST(RateStick, DetonatesOnFineCells) {
  const Case c =
      read_case(std::string(BRISANCE_SOURCE_DIR) + "/data/cases/anfo_rate_stick.toml",
                {"cell_size=0.125 mm", "gas.fill.1.shape.cylinder.radius=4 mm", "gas.fill.2.shape.cylinder.radius=4 mm",
                 "gas.upper=[\"8 mm\", \"12 mm\"]", "figure.0.to=[0, \"12 mm\"]"});
  Simulation s = simulator::set_up(c);
  constexpr double end = 1.6e-6;
  constexpr int most_steps = 450;  // it takes 373
  while (s.time < end && s.gas.step < most_steps) {
    const StepSize size = next_step(s, c.numerics, end);
    ASSERT_GT(size.dt, 0.0) << "at " << s.time << " s";
    for (double dt = size.dt; advance(s, dt) == StepOutcome::rejected;) dt *= 0.5;
  }
  EXPECT_GE(s.time, end * (1.0 - 1e-12));
}

/// Bubbles of next to no mass in water of 1 GPa give their heat to the water, and nothing is lost.
TEST(Trace, DoesNotStayHotterThanAnyWaveMadeIt) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 1e-3, {}, {8, 0, 0}, {water, air}, *domain);
  constexpr double thin = 1e-15, pressure = 1e9;  // kg/m^3, Pa
  fill_in_portions(
      gas,
      [&](const Vector&) {
        return std::vector<Portion>{{0.99, Filling{0, 1200.0, pressure, {}}}, {0.01, Filling{1, thin, pressure, {}}}};
      },
      *domain);
  const Totals before = totals(gas, *domain);
  const int mass = Content::fluids(1) + 3 + Content::mass, internal = Content::fluids(1) + 3 + Content::internal;
  const auto block = static_cast<std::size_t>(gas.cells.mine.front());
  const auto energy = [&] { return gas.content.cell(block, internal, 0) / gas.content.cell(block, mass, 0); };
  EXPECT_GT(energy(), 1e23);
  // What it gives away, the pressure about it gives back in part: a thinner bubble every time.
  constexpr int times = 60;
  for (int n = 0; n < times; ++n) find_equilibrium(gas, *domain);
  const double fastest = gas.wave_rate * gas.cells.cell_size, gamma = 0.4;
  EXPECT_LT(gamma * (gamma + 1.0) * energy(), 110.0 * fastest * fastest);
  const Totals after = totals(gas, *domain);
  EXPECT_LT(set_up::relative_change(before.energy, after.energy), 1e-13);
  EXPECT_LT(set_up::relative_change(before.mass[1], after.mass[1]), 1e-15);
}

/// How hot a trace may be depends on the fastest waves of all, wherever they are: of those of its own rank it would be cooled.
TEST(Trace, HasTheSameBitsOnEveryNumberOfRanks) {
  const auto energies_after = [](int ranks) {
    std::map<std::array<int, 3>, double> energies;
    std::mutex one_at_a_time;
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      Gas gas = set_up::box(Geometry::planar_1d, 1e-3, {}, {256, 0, 0}, {water, air}, *domain);
      constexpr double pressure = 1e9;  // Pa
      fill_in_portions(
          gas,
          [&](const Vector& x) {
            if (x[0] > 0.2) return std::vector<Portion>{{1.0, Filling{1, 0.01, pressure, {}}}};  // sound of 370 km/s
            return std::vector<Portion>{{0.99, Filling{0, 1200.0, pressure, {}}}, {0.01, Filling{1, 2.5e-4, pressure, {}}}};
          },
          *domain);
      for (int n = 0; n < 2; ++n) find_equilibrium(gas, *domain);  // twice in a step of reactions around bodies
      const std::lock_guard lock(one_at_a_time);
      const int internal = Content::fluids(1) + 3 + Content::internal;
      set_up::for_each_cell(gas,
                            [&](const set_up::Cell& c) { energies[c.index] = gas.content.cell(c.block, internal, c.number); });
    });
    return energies;
  };
  const auto one = energies_after(1);
  for (const int ranks : {2, 4}) EXPECT_TRUE(energies_after(ranks) == one) << ranks << " ranks";
}

TEST(Equilibrium, LeavesAFluidAloneThatHasVolumeButNoMass) {
  std::vector<Fluid> fluids = {water, air};
  for (Fluid& f : fluids) give_usual_state(f);
  std::vector<FluidShare<Lanes>> shares(2);
  const double energy = energy_of(water.equation_of_state, 1000.0, 1e7);
  shares[0].mass = Lanes(999.0), shares[0].volume = Lanes(0.999), shares[0].internal = Lanes(999.0 * energy);
  shares[1].mass = Lanes(0.0), shares[1].volume = Lanes(0.001), shares[1].internal = Lanes(5.0);
  const Lanes found = equilibrate(fluids, shares, Lanes(1.0));
  // It fills what is left: nothing pushes it.
  EXPECT_NEAR(found[0], 1e7, 1e-6 * 1e7);
  EXPECT_EQ(shares[1].volume[0], 0.001);
  EXPECT_EQ(shares[1].internal[0], 5.0);
}

}  // namespace
}  // namespace brisance::simulator::gas
