// Reactions of the gas: what they keep, and what they do not depend on.

#include "simulator/gas/reaction.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <bit>
#include <cmath>
#include <map>
#include <mutex>

#include "tests/simulator/gas/set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator {
namespace {

using gas::Filling;
using gas::Gas;
using gas::Totals;
using gas::set_up::Stepper;

ShapePointer shape(auto form) {
  return std::make_shared<const Shape>(Shape{std::move(form)});
}

// What a burn keeps ----------------------------------------------------------------------------------------------------

/// A lump of explosive between air and a start of hot products, in a box that is no multiple of a block's.
struct Burning {
  std::string name;
  Geometry geometry;
  std::array<int, 3> lower, upper;
  Reaction law;
  std::vector<gas::Ignition> ignitions = {};

  static constexpr double cell_size = 1e-3;

  Gas filled(Domain& domain) const {
    const equation_of_state::Murnaghan solid{1160.0, 25.641e9, 7.4, 1e5, 1740.0, 300.0};
    const equation_of_state::JonesWilkinsLee products{1160.0, 298.67e9, 4.11706e9, 4.95, 1.15, 0.35, 1740.0, 4e9};
    Gas gas =
        gas::set_up::box(geometry, cell_size, lower, upper,
                         {{"solid", solid}, {"products", products}, {"air", equation_of_state::IdealGas{1.4, 716.0}}}, domain);
    gas.burns.push_back({"burn", 0, 1, law, ignitions});
    const bool detonates = std::holds_alternative<reaction::JwlPlusPlus>(law);
    const auto start = [&](const Vector& x, double) {
      const double r = magnitude(x) / cell_size;
      if (detonates && r < 4.0) return Filling{1, 1160.0, 4e9, {}};
      return r < 11.0 ? Filling{0, 1160.0, 1e5, {}} : Filling{2, 1.2, 1e5, {}};
    };
    fill(gas, start, domain);
    return gas;
  }
};

const Reaction detonation = reaction::JwlPlusPlus{3.5083e-7, 1.3, 1.0, 2e8, 3.448276e6};
const Reaction surface = reaction::PressurePower{75.3, 0.778, 101325.0, 5e4, 200.0, 2e6};
const Reaction steady =
    reaction::WardSonBrewster{1.637e15, 1.76e5, 1.6e-3, 4e5, 3.018e6, 0.2, 0.07, 1400.0, 0.0342, 5e4, 550.0, 8.314};
const Reaction programmed = reaction::ProgramBurn{5900.0, 0.0, 3.0, 3.448276e6, {0.0, 0.0, 0.0}};

std::vector<Burning> problems() {
  const std::vector<gas::Ignition> lit = {{shape(Sphere{{0.0, 8e-3, 0.0}, 6e-3}), 0.0}, {nullptr, 1e-7}};
  return {{"planar_1d", Geometry::planar_1d, {-20, 0, 0}, {151, 1, 1}, detonation},
          {"spherical_1d", Geometry::spherical_1d, {0, 0, 0}, {171, 1, 1}, detonation},
          {"plane", Geometry::plane, {-15, -13, 0}, {16, 14, 1}, detonation},
          {"axisymmetric", Geometry::axisymmetric, {0, -13, 0}, {21, 18, 1}, detonation},
          {"three_dimensional", Geometry::three_dimensional, {0, 0, 0}, {13, 13, 14}, detonation},
          {"surface in a line", Geometry::planar_1d, {-20, 0, 0}, {151, 1, 1}, surface},
          {"surface about an axis", Geometry::axisymmetric, {0, -13, 0}, {21, 18, 1}, surface},
          {"surface in space", Geometry::three_dimensional, {0, 0, 0}, {13, 13, 14}, surface},
          {"surface that is lit", Geometry::plane, {-15, -13, 0}, {16, 14, 1}, steady, lit},
          {"programmed", Geometry::plane, {-15, -13, 0}, {16, 14, 1}, programmed, {{shape(Sphere{{}, 1e-3}), 0.0}}}};
}

/// Along which axes momentum is a sum that is kept: the walls of a widening cell push as well, and so do those of the box.
TEST(ReactionBooks, HoldTheHeatAndTheMassThatHasBurned) {
  constexpr double round_off = 1e-13;
  for (const Burning& problem : problems()) {
    SCOPED_TRACE(problem.name);
    const auto domain = single_process();
    Gas gas = problem.filled(*domain);
    const Totals before = totals(gas, *domain);
    Stepper().steps(gas, 40, *domain);
    const Totals after = totals(gas, *domain), burned = gas::burned(gas, *domain).front();
    EXPECT_GT(burned.mass[1], 0.0) << "nothing has burned";
    EXPECT_NEAR(burned.mass[0] + burned.mass[1], 0.0, round_off * before.mass[0]);
    EXPECT_NEAR(burned.energy, std::visit([](const auto& law) { return law.heat(); }, problem.law) * burned.mass[1],
                round_off * burned.energy);
    const double whole = before.mass[0] + before.mass[1];
    for (std::size_t r = 0; r < 3; ++r)
      EXPECT_NEAR(after.mass[r] - before.mass[r], burned.mass[r], round_off * (r < 2 ? whole : before.mass[r]))
          << "fluid " << r;
    EXPECT_NEAR(after.energy - before.energy, burned.energy, round_off * after.energy);
    gas::set_up::for_each_cell(gas, [&](const gas::set_up::Cell& c) {
      double volume = 0.0;
      for (int r = 0; r < 3; ++r) volume += gas::set_up::fraction(gas, c, r);
      ASSERT_NEAR(volume, 1.0, 1e-14);
    });
  }
}

TEST(ReactionBooks, TheSurfaceKeepsMomentum) {
  // Away from every wall, before any wave arrives there.
  constexpr double round_off = 1e-13;
  Burning problem{"", Geometry::plane, {-24, -24, 0}, {24, 24, 1}, surface};
  const auto domain = single_process();
  Gas gas = problem.filled(*domain);
  gas.edges.assign(4, gas::set_up::around());
  Stepper().steps(gas, 40, *domain);
  const Totals after = totals(gas, *domain);
  EXPECT_GT(after.kinetic, 0.0);
  double scale = 0.0;
  for (const double m : after.mass) scale += m;
  scale = std::sqrt(2.0 * scale * after.kinetic);
  for (std::size_t a = 0; a < 2; ++a) EXPECT_NEAR(after.momentum[a], 0.0, round_off * scale) << "axis " << a;
}

// Bits -----------------------------------------------------------------------------------------------------------------

using State = std::map<BlockKey, std::vector<std::uint64_t>>;

void add_state(const Gas& gas, State& state) {
  gas::set_up::for_each_cell(gas, [&](const gas::set_up::Cell& c) {
    std::vector<std::uint64_t>& bits = state[gas.cells.blocks[c.block]];
    for (int q = 0; q < gas.contents(); ++q)
      bits.push_back(std::bit_cast<std::uint64_t>(gas.content.cell(c.block, q, c.number)));
  });
}

TEST(ReactionBits, AreTheSameForAnyNumberOfRanksAndThreads) {
  constexpr int steps = 8;
  for (Burning problem : problems()) {
    SCOPED_TRACE(problem.name);
    if (problem.geometry == Geometry::three_dimensional || problem.geometry == Geometry::spherical_1d) continue;  // for time
    if (problem.upper[0] > 100) problem.upper[0] += 130;  // several blocks
    State one;
    Totals burned_by_one;
    for (const int ranks : {1, 3}) {
      State state;
      std::mutex one_at_a_time;
      VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
        Gas gas = problem.filled(*domain);
        Stepper().steps(gas, steps, *domain);
        const Totals burned = gas::burned(gas, *domain).front();
        const std::lock_guard lock(one_at_a_time);
        add_state(gas, state);
        if (ranks == 1) burned_by_one = burned;
        EXPECT_EQ(burned.mass, burned_by_one.mass);
        EXPECT_EQ(burned.energy, burned_by_one.energy);
      });
      if (ranks == 1) one = state;
      EXPECT_TRUE(state == one) << ranks << " ranks";
    }
    omp_set_num_threads(2);
    const auto domain = single_process();
    Gas gas = problem.filled(*domain);
    Stepper().steps(gas, steps, *domain);
    omp_set_num_threads(1);
    State two_threads;
    add_state(gas, two_threads);
    EXPECT_TRUE(two_threads == one) << "two threads";
  }
}

TEST(ReactionBits, ARejectedStepChangesNothing) {
  for (const Burning& problem : problems()) {
    SCOPED_TRACE(problem.name);
    const auto domain = single_process();
    Gas gas = problem.filled(*domain);
    Stepper().steps(gas, 10, *domain);
    const Gas before = gas;
    double factor = 20.0;
    while (advance(gas, factor * largest_step(before, 0.5), *domain) == gas::Outcome::done && factor < 1e9)
      gas = before, factor *= 4.0;
    ASSERT_LT(factor, 1e9);
    EXPECT_TRUE(numbers_of(gas) == numbers_of(before));
  }
}

// Laws in the gas ------------------------------------------------------------------------------------------------------

TEST(Distance, IsThatToTheNearestPartOfARegion) {
  const ShapePointer plane = shape(Box{{-1.0, 2.0, -1.0}, {1.0, 3.0, 1.0}}), point = shape(Sphere{{5.0, 0.0, 0.0}, 0.5});
  EXPECT_DOUBLE_EQ(*gas::distance(*plane, {0.0, 0.0, 0.0}), 2.0);
  EXPECT_DOUBLE_EQ(*gas::distance(*plane, {4.0, 7.0, 0.0}), 5.0);
  EXPECT_DOUBLE_EQ(*gas::distance(*plane, {0.0, 2.5, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(*gas::distance(*point, {5.0, 3.0, 4.0}), 4.5);
  EXPECT_DOUBLE_EQ(*gas::distance(*shape(Union{{plane, point}}), {5.0, 0.0, 2.5}), 2.0);
  EXPECT_FALSE(gas::distance(*shape(Cone{{}, {1.0, 0.0, 0.0}, 1.0, 1.0}), {}).has_value());
}

TEST(Ignition, LightsASurfaceThatIsTooCold) {
  const ShapePointer half = shape(Box{{-1.0, -1.0, -1.0}, {1.0, 0.0, 1.0}});  // y < 0
  Burning problem{"", Geometry::plane, {-16, -16, 0}, {16, 16, 1}, steady, {{half, 1e-6}}};
  const auto domain = single_process();
  Gas gas = problem.filled(*domain);
  const auto burned_above = [&] {
    double sum = 0.0;
    gas::set_up::for_each_cell(gas, [&](const gas::set_up::Cell& c) {
      if (c.centre[1] > 3.0 * gas.cells.cell_size)
        sum += gas.content.cell(c.block, gas::Content::of(2, 1, gas::Content::mass), c.number);
    });
    return sum;
  };
  Stepper().to(gas, 0.99e-6, *domain);
  EXPECT_EQ(burned(gas, *domain).front().mass[1], 0.0) << "before its time";
  Stepper().to(gas, 3e-6, *domain);
  EXPECT_GT(burned(gas, *domain).front().mass[1], 0.0) << "lit";
  EXPECT_LT(burned_above(), 1e-30) << "out of the region, but for what the numbers carry there";
}

TEST(Threshold, ColdSurfacesDoNotBurn) {
  for (const Reaction& law : {surface, steady}) {
    const auto domain = single_process();
    Gas gas = Burning{"", Geometry::plane, {-16, -16, 0}, {16, 16, 1}, law}.filled(*domain);
    Stepper().steps(gas, 5, *domain);
    const bool warm = std::holds_alternative<reaction::PressurePower>(law);  // its threshold is 200 K, the other one's 550 K
    EXPECT_EQ(burned(gas, *domain).front().mass[1] > 0.0, warm);
  }
}

}  // namespace
}  // namespace brisance::simulator
