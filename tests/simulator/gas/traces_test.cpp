// A little of a fluid in a cell of another, at fronts of high pressure: it must not grow thinner and hotter without end.

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "simulator/case_reader.hpp"
#include "simulator/gas/donor.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/pressure_equilibrium.hpp"
#include "simulator/setup.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"
#include "tests/simulator/gas/bodies_set_up.hpp"
#include "tests/simulator/gas/fluids.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::air;
using set_up::products;
using set_up::Stepper;
using set_up::water;

/// The front of products that rush into air is a cell that both share. It used to be emptied until what was left in it was at
/// 1e14 J/kg and more, and ten thousand steps led to 16 us. The same in steps with a body, which is far from the charge.
void expect_few_steps_of_charge(bool with_body) {
  constexpr double h = 5e-3, radius = 0.08, end = 40e-6;
  constexpr int cells = 60, most_steps = 600;  // it takes 180
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::axisymmetric, h, {}, {cells, cells, 0}, {air, products}, *domain);
  gas.edges.assign(4, set_up::wall());
  if (with_body) gas.bodies.all = {set_up::ball(Geometry::axisymmetric, h, {0.0, 0.27, 0.0}, 0.02)};
  fill(
      gas,
      [&](const Vector& x, double) {
        return magnitude(x) < radius ? Filling{1, 1838.0, 1.2e10, {}} : Filling{0, 1.2, 1e5, {}};
      },
      *domain);
  Stepper stepper;
  while (gas.time < end && gas.step < most_steps) stepper.steps(gas, 20, *domain);
  EXPECT_GE(gas.time, end);
  testing::Test::RecordProperty("steps", std::to_string(gas.step));
}
TEST(Charge, ThatExpandsIntoAirDoesNotEmptyTheCellsAtItsFront) {
  expect_few_steps_of_charge(false);
}
TEST(Charge, ThatExpandsIntoAirDoesNotEmptyTheCellsAtItsFrontBesideABody) {
  expect_few_steps_of_charge(true);
}

/// On these cells a trace of the air was carried along the side of the stick by its detonation, into the explosive ahead, and
/// grew thinner and hotter from cell to cell: when shared cells had the impedance of foam, nothing was left of its mass after
/// 367 steps, and no pressure was found.
TEST(RateStick, DetonatesOnFineCells) {
  const Case c =
      read_case(BRISANCE_SOURCE_DIR "/data/cases/anfo_rate_stick.toml",
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
  const int mass = Content::of(1, 1, Content::mass), internal = Content::of(1, 1, Content::internal);
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
      const int internal = Content::of(1, 1, Content::internal);
      set_up::for_each_cell(gas,
                            [&](const set_up::Cell& c) { energies[c.index] = gas.content.cell(c.block, internal, c.number); });
    });
    return energies;
  };
  const auto one = energies_after(1);
  for (const int ranks : {2, 4}) EXPECT_TRUE(energies_after(ranks) == one) << ranks << " ranks";
}

/// A fluid has slopes where it fills the donor or there is about as much of it on both sides, and none at its edge.
TEST(Slopes, AreWhereAFluidIsNotAtItsEdge) {
  const auto has = [](double behind, double here, double ahead) {
    return has_slopes(Lanes(behind), Lanes(here), Lanes(ahead))[3];
  };
  EXPECT_TRUE(has(1.0, 1.0, 1.0));
  EXPECT_TRUE(has(0.0, 1.0, 0.4)) << "it fills the donor";
  EXPECT_TRUE(has(0.010, 0.011, 0.012)) << "a trace, as much of it everywhere";
  EXPECT_TRUE(has(0.40, 0.5, 0.62));
  EXPECT_FALSE(has(1.0, 0.7, 0.1));
  EXPECT_FALSE(has(0.5, 0.5, 0.1)) << "it ends ahead";
  EXPECT_FALSE(has(0.1, 0.5, 0.5)) << "it begins here";
  EXPECT_FALSE(has(1e-5, 1e-4, 1e-3));
}

/// A cell at the surface of water above a charge, as it was in a run: traces of products of no pressure at all, of air, and
/// water that fills the cell. Any pressure suited the products, whose compressibility was most of the cell's; so none was
/// looked for, the water took more than the cell, and the air less than nothing.
TEST(Equilibrium, IsFoundBesideATraceThatAnyPressureSuits) {
  std::vector<Fluid> fluids = {water, air, products};
  for (Fluid& f : fluids) give_usual_state(f);
  constexpr double cell_volume = 2.2e-7;  // m^3
  std::vector<FluidShare> shares(3);
  shares[0].mass = Lanes(2.1895426811955353e-4), shares[0].volume = Lanes(2.1990439061559027e-7);
  shares[0].internal = Lanes(170.9615920946205);
  shares[1].mass = Lanes(6.331586142202213e-22), shares[1].volume = Lanes(9.3493563931545112e-11);
  shares[1].internal = Lanes(2.1476937525332833e-12);
  shares[2].mass = Lanes(3.5053389909926537e-31), shares[2].volume = Lanes(2.1158204781709404e-12);
  shares[2].internal = Lanes(0.0);
  const double before = shares[0].internal[0] + shares[1].internal[0];
  const Lanes pressure = equilibrate(fluids, shares, Lanes(cell_volume));
  double volume = 0.0, after = 0.0;
  for (const auto& s : shares) {
    EXPECT_GT(s.volume[0], 0.0);
    volume += s.volume[0], after += s.internal[0];
  }
  EXPECT_NEAR(volume / cell_volume, 1.0, 1e-15);
  EXPECT_NEAR(after / before, 1.0, 1e-15);
  // The products go first: hundred times a tenth is taken from a gas that does not resist. What is left, of next to no heat, is
  // pressed together by p and keeps Gamma/(Gamma + 1) of its volume: p V = Gamma p (V0 - V).
  // The water, of 3.28244 MPa before, grows by the rest, which is so little that its compressibility does not change.
  const double left =
      cell_volume - 9.3493563931545112e-11 * 0.4 / 1.4 - 2.1158204781709404e-12 * std::pow(0.9, 100) * 0.45 / 1.45;
  const double growth = left / 2.1990439061559027e-7 - 1.0, stiffness = 4.4 * (3.28244e6 + 6e8);
  EXPECT_NEAR(pressure[0], 3.28244e6 - stiffness * growth, 1e-3 * 3.28244e6);
}

TEST(Equilibrium, IsFoundForManyFluids) {
  constexpr int count = 20;
  std::vector<Fluid> fluids(count, air);
  for (Fluid& f : fluids) give_usual_state(f);
  std::vector<FluidShare> shares(count);
  for (int r = 0; r < count; ++r) {
    auto& s = shares[static_cast<std::size_t>(r)];
    s.mass = Lanes(1.0 + r), s.volume = Lanes(1.0 / count), s.internal = Lanes(1e5 * (1.0 + r));
  }
  // Of one gas: work changes nothing of p = 0.4 E/V for all of them.
  const Lanes pressure = equilibrate(fluids, shares, Lanes(1.0));
  EXPECT_NEAR(pressure[0] / (0.4 * 1e5 * (count * (count + 1) / 2)), 1.0, 1e-12);
  for (const auto& s : shares) EXPECT_GT(s.volume[7], 0.0);
}

TEST(Equilibrium, LeavesAFluidAloneThatHasVolumeButNoMass) {
  std::vector<Fluid> fluids = {water, air};
  for (Fluid& f : fluids) give_usual_state(f);
  std::vector<FluidShare> shares(2);
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
