// What happens when a step is too much for a material: it is taken smaller, and nothing is lost on the way.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "tests/simulator/running.hpp"
#include "tests/simulator/small_bar.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator {
namespace {

using by_hand::copper;

using Layout2 = Layout<2>;

/// A copper block in the plane geometry, 64 particles if it is 4 mm wide.
Case block(double side = 4e-3) {
  Case c;
  c.geometry = Geometry::plane, c.cell_size = 1e-3, c.end_time = 1.0;
  c.bodies.push_back(by_hand::body("block", copper(), by_hand::box({0, 0, 0}, {side, side, 1})));
  return c;
}

void set_gradients(Simulation& s, int violent, double rate, double violent_rate) {
  Particles& ps = s.bodies[0].particles;
  for (int p = 0; p < ps.size; ++p) {
    const double r = p == violent ? violent_rate : rate;
    for (int k = 0; k < Layout2::tensor_components; ++k) ps.gradient.at(k, p) = 0.0;
    ps.gradient.at(0, p) = r, ps.gradient.at(3, p) = -0.9 * r;
  }
}

std::vector<std::uint64_t> columns_of(const Simulation& s, int particle) {
  std::vector<std::uint64_t> bits;
  const Particles& ps = s.bodies[0].particles;
  for (const ColumnSet* set : {&ps.load, &ps.rest})
    for (int c = 0; c < set->columns(); ++c) bits.push_back(std::bit_cast<std::uint64_t>(set->at(c, particle)));
  return bits;
}

/// One particle is deformed more than the update can follow at once: it takes the step in two halves, the others do not.
TEST(Trouble, OfOneParticleIsCuredByPartsOfItsStepAlone) {
  constexpr double dt = 1e-7, rate = 1e5, violent_rate = 4e6;  // |dt L| = 0.013 and 0.54
  constexpr int violent = 13;
  Simulation whole = set_up(block()), halves = set_up(block()), mild = set_up(block());
  set_gradients(whole, violent, rate, violent_rate);
  set_gradients(halves, violent, rate, violent_rate);
  set_gradients(mild, violent, rate, rate);
  update_stress(whole, dt, &Particles::motion);
  for (int i = 0; i < 2; ++i) update_stress(halves, 0.5 * dt, &Particles::motion);
  update_stress(mild, dt, &Particles::motion);
  for (int p = 0; p < whole.bodies[0].particles.size; ++p)
    EXPECT_TRUE(columns_of(whole, p) == columns_of(p == violent ? halves : mild, p)) << p;
  // The energy has taken up the work of all parts.
  const InternalEnergy e = internal_energy(whole);
  EXPECT_NEAR(e.total - whole.ledger.initial_internal, e.stress_work + e.viscous_work, 1e-12 * e.stress_work);
}

TEST(Trouble, ThatNoPartCuresNamesTheParticleAsItWas) {
  Simulation s = set_up(block());
  const double before = s.bodies[0].particles.rest.at(Layout2::Rest::temperature, 5);
  set_gradients(s, 5, 1e5, std::numeric_limits<double>::quiet_NaN());
  std::string message;
  try {
    update_stress(s, 1e-7, &Particles::motion);
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_TRUE(contains(message, fmt::format("particle {} of block at", s.bodies[0].particles.id[5]))) << message;
  EXPECT_TRUE(contains(message, "temperature 300 K")) << message;
  EXPECT_TRUE(contains(message, "64 parts")) << message;
  EXPECT_EQ(s.bodies[0].particles.rest.at(Layout2::Rest::temperature, 5), before);
}

/// What each rank says when particles with these ids are deformed so fast (1/s).
template <class F>
std::vector<std::string> said_by_ranks(int ranks, const std::map<std::uint64_t, double>& rates, F&& say) {
  std::vector<std::string> said(static_cast<std::size_t>(ranks));
  VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
    Simulation s = set_up(block(16e-3), domain);
    Particles& ps = s.bodies[0].particles;
    EXPECT_GT(ps.size, 0) << "of rank " << domain->rank();
    set_gradients(s, -1, 1e5, 0.0);
    for (int p = 0; p < ps.size; ++p)
      if (const auto rate = rates.find(ps.id[static_cast<std::size_t>(p)]); rate != rates.end())
        ps.gradient.at(0, p) = rate->second, ps.gradient.at(3, p) = rate->second;
    said[static_cast<std::size_t>(domain->rank())] = say(s);
  });
  return said;
}

/// The block is 32 by 32 particles in 9 blocks of the grid; one in the first row and one in the last are on different ranks.
TEST(Trouble, OnOneOfSeveralRanksIsToldByAllInTheSameWords) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), dt = 1e-7;
  const auto update = [](Simulation& s) -> std::string {
    try {
      update_stress(s, dt, &Particles::motion);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "all is well";
  };
  const auto too_dense = [](Simulation& s) { return worst_point(s, dt); };
  const auto expect = [](const std::map<std::uint64_t, double>& rates, const auto& say, const std::string& words) {
    const std::string one = said_by_ranks(1, rates, say).front();
    EXPECT_TRUE(contains(one, words)) << one;
    for (const int ranks : {2, 3}) EXPECT_EQ(said_by_ranks(ranks, rates, say), std::vector<std::string>(ranks, one));
  };
  expect({{3, nan}}, update, "particle 3 of block");
  expect({{1020, nan}}, update, "particle 1020 of block");
  expect({{1020, nan}, {3, nan}}, update, "particle 3 of block");
  expect({}, update, "all is well");
  expect({{3, -5e6}, {1020, -6e6}}, too_dense, "particle 1020 of block");  // a third and less of its volume is left
  expect({{3, 2e5}, {1020, 3e5}}, too_dense, "particle 1020 of block");    // no density is out of range: the fastest
}

/// A bar strikes a wall whose material stiffens without bound towards 16 % of compression: the first step, as large as the
/// speed of sound at rest allows, would go beyond. What the smaller one leaves is stiffer, and the run comes to its end.
TEST(Trouble, CompressionOutOfRangeIsMetWithASmallerStepAndTheRunCompletes) {
  Case c;
  c.title = "stiffening", c.geometry = Geometry::plane, c.cell_size = 1e-3, c.end_time = 1e-6, c.output.figures = false;
  Material m = by_hand::elastic_material(8930.0, 1e9, 0.3);
  m.equation_of_state = equation_of_state::MieGruneisenTemperature{.reference_density = 8930.0,
                                                                   .sound_speed = 3940.0,
                                                                   .slope = 6.0,
                                                                   .gruneisen = 2.0,
                                                                   .specific_heat = 383.0,
                                                                   .reference_temperature = 300.0};
  m.artificial_viscosity = {0.06, 1.5};
  c.bodies.push_back(by_hand::body("bar", m, by_hand::box({0, 0, 0}, {4e-3, 8e-3, 1}), {0.0, -2500.0, 0.0}));
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above),
                  by_hand::plane(BoundaryKind::symmetry, Axis::x, 0.0, Side::above),
                  by_hand::plane(BoundaryKind::symmetry, Axis::x, 4e-3, Side::below)};
  c.boundaries[0].name = "wall", c.boundaries[1].name = "left", c.boundaries[2].name = "right";

  Simulation first = set_up(c);
  const std::vector<std::uint64_t> before = bits_of(first);
  const double dt = by_hand::stable_step(first, c.end_time);
  ASSERT_EQ(advance(first, dt), StepOutcome::rejected);
  EXPECT_TRUE(contains(worst_point(first, dt), "its density would leave the range of the equation of state"));
  EXPECT_TRUE(bits_of(first) == before && first.step == 0 && first.time == 0.0) << "rejection leaves no trace";

  Simulation s = set_up(c);
  const fs::path directory = scratch();
  const RunResult result = run(c, s, {directory, {}});
  EXPECT_EQ(result.ending, Ending::done) << result.message;
  EXPECT_TRUE(contains(text_of(directory / "log.txt"), "leave the range of the equation of state"));

  // On the way the metal is near to its limit, and never beyond.
  Simulation again = set_up(c);
  double fullest = 0.0;
  run_until(again, c.end_time, [&] { fullest = std::max(fullest, again.extremes.filling); });
  EXPECT_GT(fullest, 0.9);
  EXPECT_LT(fullest, 1.0);
}

/// Nothing holds a metal together that is torn apart at 40 km/s: however small the steps, its density leaves the range.
TEST(Trouble, ThatNoStepCuresEndsTheRunWithTheFactsOfTheWorstParticle) {
  Case c = block();
  c.title = "torn", c.end_time = 1e-5, c.output.figures = false;
  c.bodies[0].velocity.centre = {2e-3, 2e-3, 0.0};
  c.bodies[0].velocity.radial_rate = 1e7;
  Simulation s = set_up(c);
  const fs::path directory = scratch();
  const RunResult result = run(c, s, {directory, {}});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_TRUE(contains(result.message, "larger ones were rejected; particle ")) << result.message;
  EXPECT_TRUE(contains(result.message, "its density would leave the range of the equation of state")) << result.message;
}

}  // namespace
}  // namespace brisance::simulator
