// What the gas keeps in every geometry, what its books say of the sides, and what its bits do not depend on.

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "simulator/gas/rejection.hpp"
#include "tests/simulator/gas/set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

/// Sums of thousands of rounded numbers, of which each has passed hundreds of steps.
constexpr double round_off = 1e-13;

const std::vector<Fluid> air_and_water = {{"air", equation_of_state::IdealGas{1.4, 718.0}},
                                          {"water", equation_of_state::StiffenedGas{4.4, 6e8, 1000.0}}};

/// Along which axes the sides' books hold all of the momentum: across a widening cell its walls push as well.
bool straight(Geometry geometry, int axis) {
  return axis > 0 || geometry == Geometry::planar_1d || geometry == Geometry::plane || geometry == Geometry::three_dimensional;
}

enum class Scheme { waves, implicit, classic };

/// A box of a size that is no multiple of a block's: hot air in one part of it, air that streams in another, water in a third.
struct Problem {
  std::string name;
  Geometry geometry;
  std::array<int, 3> lower, upper;
  std::size_t fluids = 2;
  std::vector<Edge> edges = {};  // walls
  Scheme scheme = Scheme::waves;

  static constexpr double cell_size = 0.01;

  Gas filled(Domain& domain) const {
    Gas gas = set_up::box(geometry, cell_size, lower, upper, air_and_water, domain);
    gas.fluids.resize(fluids);
    if (!edges.empty()) gas.edges = edges;
    gas.implicit = scheme == Scheme::implicit;
    if (scheme == Scheme::classic) gas.classic.emplace();
    fill(
        gas, [this](const Vector& x, double) { return start(x); }, domain);
    return gas;
  }
  Filling start(const Vector& x) const {
    const int D = number_of_dimensions(geometry);
    double from_hot = 0.0, from_water = 0.0, wave = 0.0;
    Vector u{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) {
      const double part = (x[a] / cell_size - lower[a]) / (upper[a] - lower[a]);
      from_hot += (part - 0.4) * (part - 0.4), from_water += (part - 0.7) * (part - 0.7);
      wave += std::sin(2.0 * std::numbers::pi * part);
      u[a] = 80.0 - 50.0 * static_cast<double>(a);
    }
    // A ring of liquid that widens would be torn.
    const Vector u_water = straight(geometry, 0) ? u : Vector{0.0, u[1], 0.0};
    if (fluids > 1 && from_water < 0.02) return {1, 1000.0, 2e5, u_water};
    if (from_hot < 0.05) return {0, 5.0, 2e6, {}};
    return {0, 1.2 + 0.2 * wave, 1e5, u};
  }
};

const std::vector<Problem> closed = {{"planar_1d", Geometry::planar_1d, {-20, 0, 0}, {151, 0, 0}},
                                     {"cylindrical_1d", Geometry::cylindrical_1d, {0, 0, 0}, {171, 0, 0}},
                                     {"spherical_1d", Geometry::spherical_1d, {0, 0, 0}, {171, 0, 0}},
                                     {"spherical_1d away from the centre", Geometry::spherical_1d, {30, 0, 0}, {201, 0, 0}},
                                     {"plane", Geometry::plane, {-5, 3, 0}, {32, 24, 0}},
                                     {"axisymmetric", Geometry::axisymmetric, {0, -9, 0}, {29, 18, 0}},
                                     {"three_dimensional", Geometry::three_dimensional, {-3, 0, 5}, {16, 13, 16}},
                                     {"one gas on a line", Geometry::planar_1d, {-20, 0, 0}, {151, 0, 0}, 1},
                                     {"one gas in a plane", Geometry::plane, {-5, 3, 0}, {32, 24, 0}, 1},
                                     {"one gas about an axis", Geometry::axisymmetric, {0, -9, 0}, {29, 18, 0}, 1},
                                     {"one gas in space", Geometry::three_dimensional, {-3, 0, 5}, {16, 13, 16}, 1}};

struct Books {
  std::vector<double> mass;
  Vector momentum{};
  double energy = 0.0;
  Vector gross{};  // sum of the absolute impulses of the sides
};
Books books(const Gas& gas) {
  Books sum;
  sum.mass.resize(gas.fluids.size());
  for (const Passage& p : gas.passages) {
    for (std::size_t r = 0; r < sum.mass.size(); ++r) sum.mass[r] += p.mass[r].value();
    for (std::size_t a = 0; a < 3; ++a) {
      sum.momentum[a] += p.momentum[a].value(), sum.gross[a] += std::abs(p.momentum[a].value());
    }
    sum.energy += p.energy.value();
  }
  return sum;
}

/// The most momentum that so much kinetic energy can hold.
double motion(const Totals& all) {
  return std::sqrt(2.0 * all.kinetic * std::accumulate(all.mass.begin(), all.mass.end(), 0.0));
}

void expect_closed_books(const Problem& problem, const Gas& gas, const Totals& before, const Totals& after) {
  const Books passed = books(gas);
  for (std::size_t r = 0; r < gas.fluids.size(); ++r)
    EXPECT_NEAR(after.mass[r] - before.mass[r], passed.mass[r], round_off * (before.mass[r] + std::abs(passed.mass[r])))
        << problem.name << ", fluid " << r;
  EXPECT_NEAR(after.energy - before.energy, passed.energy, round_off * before.energy) << problem.name;
  for (int a = 0; a < gas.dimensions(); ++a) {
    if (!straight(problem.geometry, a)) continue;
    const auto i = static_cast<std::size_t>(a);
    EXPECT_NEAR(after.momentum[i] - before.momentum[i], passed.momentum[i], round_off * (passed.gross[i] + motion(before)))
        << problem.name << ", axis " << a;
  }
}

/// In each cell the fluids fill it and hold the energy that is not of motion; nothing is less than nothing.
void expect_whole_cells(const Problem& problem, const Gas& gas) {
  const int D = gas.dimensions();
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const auto at = [&](int quantity) { return gas.content.cell(c.block, quantity, c.number); };
    double mass = 0.0, volume = 0.0, internal = 0.0, square = 0.0;
    const int fluids = static_cast<int>(gas.fluids.size());
    for (int r = 0; r < fluids; ++r) {
      const auto own = [&](int quantity) { return at(Content::of(D, r, quantity)); };
      mass += own(Content::mass);
      ASSERT_GE(own(Content::mass), 0.0) << problem.name;
      if (fluids == 1) continue;
      ASSERT_GE(own(Content::volume), -1e-14 * c.volume) << problem.name;
      volume += own(Content::volume), internal += own(Content::internal);
    }
    for (int a = 0; a < D; ++a) square += at(Content::momentum + a) * at(Content::momentum + a);
    ASSERT_GT(mass, 0.0) << problem.name;
    if (fluids == 1) return;
    constexpr double rounding = 1e-14;
    ASSERT_NEAR(volume / c.volume, 1.0, rounding) << problem.name;
    ASSERT_NEAR((internal + 0.5 * square / mass) / at(Content::energy), 1.0, 4.0 * rounding) << problem.name;
  });
}

// Conservation ---------------------------------------------------------------------------------------------------------

constexpr int steps = 60;

TEST(Conservation, OfMassMomentumAndEnergyInClosedBoxes) {
  for (const Problem& problem : closed) {
    const auto domain = single_process();
    Gas gas = problem.filled(*domain);
    const Totals before = totals(gas, *domain);
    Stepper().steps(gas, steps, *domain);
    const Totals after = totals(gas, *domain);
    for (std::size_t r = 0; r < gas.fluids.size(); ++r)
      EXPECT_LT(set_up::relative_change(before.mass[r], after.mass[r]), round_off) << problem.name << ", fluid " << r;
    EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off) << problem.name;
    EXPECT_NE(before.kinetic, after.kinetic) << problem.name << ": nothing has happened";
    for (const double mass : books(gas).mass) EXPECT_EQ(mass, 0.0) << problem.name << ": walls let nothing through";
    expect_closed_books(problem, gas, before, after);
    expect_whole_cells(problem, gas);
  }
}

TEST(Conservation, OfMomentumWhereTheBoxIsEndless) {
  for (Problem problem : closed) {
    if (!straight(problem.geometry, 0)) continue;
    const auto domain = single_process();
    problem.edges.assign(static_cast<std::size_t>(2 * number_of_dimensions(problem.geometry)), set_up::around());
    Gas gas = problem.filled(*domain);
    const Totals before = totals(gas, *domain);
    Stepper().steps(gas, steps, *domain);
    const Totals after = totals(gas, *domain);
    for (int a = 0; a < gas.dimensions(); ++a) {
      const auto i = static_cast<std::size_t>(a);
      EXPECT_NEAR(after.momentum[i], before.momentum[i], round_off * motion(before)) << problem.name << ", axis " << a;
    }
    EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off) << problem.name;
  }
}

TEST(Conservation, BooksOfTheSidesTellWhatComesAndGoes) {
  const Filling stream = {0, 1.5, 1.5e5, {120.0, -20.0, 10.0}}, still = {0, 1.2, 1e5, {}};
  for (const Problem& box : closed)
    for (const EdgeKind kind : {EdgeKind::inflow, EdgeKind::pressure, EdgeKind::non_reflecting}) {
      Problem problem = box;
      const int sides = 2 * number_of_dimensions(problem.geometry);
      const bool has_axis = !straight(problem.geometry, 0) && problem.lower[0] == 0;
      for (int s = 0; s < sides; ++s)
        problem.edges.push_back(s == 0 && has_axis ? set_up::wall()
                                                   : set_up::beyond(kind, kind == EdgeKind::inflow ? stream : still));
      problem.name += ", edge kind " + std::to_string(static_cast<int>(kind));
      const auto domain = single_process();
      Gas gas = problem.filled(*domain);
      const Totals before = totals(gas, *domain);
      Stepper().steps(gas, steps, *domain);
      const Totals after = totals(gas, *domain);
      EXPECT_GT(set_up::relative_change(before.mass[0], after.mass[0]), 1e-6) << problem.name << ": nothing has passed";
      expect_closed_books(problem, gas, before, after);
      expect_whole_cells(problem, gas);
    }
}

// Steps that fail ------------------------------------------------------------------------------------------------------

using State = std::map<BlockKey, std::vector<std::uint64_t>>;  // bits of the contents of the box's cells

void add_state(const Gas& gas, State& state) {
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    std::vector<std::uint64_t>& bits = state[gas.cells.blocks[c.block]];
    for (int q = 0; q < gas.contents(); ++q)
      bits.push_back(std::bit_cast<std::uint64_t>(gas.content.cell(c.block, q, c.number)));
  });
  for (const Passage& p : gas.passages) {
    std::vector<std::uint64_t>& bits = state[gas.cells.blocks[static_cast<std::size_t>(p.block)]];
    for (const CompensatedSum& m : p.mass) bits.push_back(std::bit_cast<std::uint64_t>(m.value()));
    for (const CompensatedSum& m : p.momentum) bits.push_back(std::bit_cast<std::uint64_t>(m.value()));
    bits.push_back(std::bit_cast<std::uint64_t>(p.energy.value()));
  }
}
State state_of(const Gas& gas) {
  State state;
  add_state(gas, state);
  return state;
}

/// Lanes beyond the box hold whatever they hold.
TEST(Cautions, CountCellsOfTheBoxAlone) {
  const auto flattened = [](int rows) {
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::plane, 0.01, {0, 0, 0}, {40, rows, 0}, {set_up::ideal_gas()}, *domain);
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.2, 1e5, {100.0, 0.0, 0.0}};
        },
        *domain);
    Stepper().steps(gas, 100, *domain);
    return gas.flattened;
  };
  for (const int rows : {4, 5, 8, 10}) EXPECT_EQ(flattened(rows), 0) << rows;
}

TEST(RejectedStep, ChangesNothing) {
  for (const Problem& problem : closed) {
    const auto domain = single_process();
    Gas gas = problem.filled(*domain);
    Stepper().steps(gas, 10, *domain);
    Gas twin = gas;
    const double dt = largest_step(gas, 0.5);
    ASSERT_EQ(advance(gas, 20.0 * dt, *domain), Outcome::rejected) << problem.name;
    EXPECT_EQ(state_of(gas), state_of(twin)) << problem.name;
    EXPECT_EQ(gas.time, twin.time);
    EXPECT_EQ(gas.step, twin.step);
    EXPECT_EQ(gas.flattened, twin.flattened);
    EXPECT_EQ(largest_step(gas, 0.5), dt);
    ASSERT_EQ(advance(gas, dt, *domain), Outcome::done);
    ASSERT_EQ(advance(twin, dt, *domain), Outcome::done);
    EXPECT_EQ(state_of(gas), state_of(twin)) << problem.name << ": the step after it";
  }
}

/// At rest, but one cell of the second fluid has a pressure that drives the next out of theirs.
TEST(RejectedStep, NamesTheCellAndItsFluid) {
  const auto domain = single_process();
  constexpr double h = 0.01;
  Fluid other = set_up::ideal_gas(1.6);
  other.name = "other";
  Gas gas = set_up::box(Geometry::planar_1d, h, {0, 0, 0}, {40, 0, 0}, {set_up::ideal_gas(), other}, *domain);
  fill(
      gas,
      [](const Vector& x, double) {
        return Filling{x[0] < 0.2 ? 0 : 1, 1.0, x[0] > 0.30 && x[0] < 0.31 ? 1e3 : 1.0, {}};
      },
      *domain);
  const double dt = largest_step(gas, 0.5);
  ASSERT_EQ(advance(gas, 20.0 * dt, *domain), Outcome::rejected);
  const std::string why = why_rejected(gas), before = "leave the cell of gas at (";
  ASSERT_NE(why.find(before), std::string::npos) << why;
  EXPECT_NEAR(std::stod(why.substr(why.find(before) + before.size())), 0.305, 2.0 * h) << why;
  EXPECT_NE(why.find("it holds other alone"), std::string::npos) << why;
  // What is accepted since has no part in it.
  ASSERT_EQ(advance(gas, 0.1 * dt, *domain), Outcome::done);
  EXPECT_EQ(why_rejected(gas).find(before), std::string::npos);
}

// Bits -----------------------------------------------------------------------------------------------------------------

struct Outcomes {
  State state;
  Totals all;
  double time = 0.0;
  std::int64_t flattened = 0;
};

enum class Way { whole, restarted };

Outcomes after_steps(const Problem& problem, int ranks, Way way = Way::whole) {
  Outcomes result;
  std::mutex one_at_a_time;
  VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
    Gas gas = problem.filled(*domain);
    constexpr int before_restart = 8, all_steps = 20;
    Stepper().steps(gas, before_restart, *domain);
    if (way == Way::restarted) {
      const std::vector<double> numbers = numbers_of(gas);
      gas = problem.filled(*domain);
      restore(gas, numbers, *domain);
    }
    Stepper().steps(gas, all_steps - before_restart, *domain);
    const Totals all = totals(gas, *domain);
    const std::lock_guard lock(one_at_a_time);
    add_state(gas, result.state);
    result.all = all, result.time = gas.time, result.flattened += gas.flattened;
  });
  return result;
}
void expect_same(const Outcomes& a, const Outcomes& b, const std::string& what) {
  EXPECT_EQ(a.time, b.time) << what;
  EXPECT_EQ(a.flattened, b.flattened) << what;
  EXPECT_EQ(a.all.mass, b.all.mass) << what;
  EXPECT_EQ(a.all.momentum, b.all.momentum) << what;
  EXPECT_EQ(a.all.energy, b.all.energy) << what;
  EXPECT_EQ(a.all.kinetic, b.all.kinetic) << what;
  ASSERT_EQ(a.state.size(), b.state.size()) << what;
  for (const auto& [block, bits] : a.state) EXPECT_TRUE(b.state.at(block) == bits) << what << ": block " << block;
}

std::vector<Problem> problems_for_ranks() {
  std::vector<Problem> all;
  for (const Problem& box : closed) {
    Problem problem = box;
    if (problem.upper[0] > 100) problem.upper[0] += 130;  // five blocks
    all.push_back(problem);
    if (!straight(problem.geometry, 0)) continue;
    problem.name += ", endless along x";
    const Filling still = {0, 1.2, 1e5, {}};
    problem.edges = {set_up::around(),
                     set_up::around(),
                     set_up::beyond(EdgeKind::pressure, still),
                     set_up::beyond(EdgeKind::inflow, still),
                     set_up::beyond(EdgeKind::non_reflecting, still),
                     set_up::wall()};
    problem.edges.resize(static_cast<std::size_t>(2 * number_of_dimensions(problem.geometry)));
    all.push_back(problem);
  }
  const std::size_t of_waves = all.size();
  for (std::size_t n = 0; n < of_waves; ++n) {
    Problem problem = all[n];
    if (problem.fluids == 1 && problem.geometry != Geometry::plane) continue;
    problem.scheme = Scheme::implicit, problem.name += ", implicit";
    all.push_back(problem);
    if (!straight(problem.geometry, 0)) continue;
    problem.scheme = Scheme::classic, problem.name = all[n].name + ", classic";
    for (Edge& edge : problem.edges)
      if (edge.kind != EdgeKind::periodic) edge = set_up::wall();
    all.push_back(problem);
  }
  return all;
}

#ifdef __SANITIZE_ADDRESS__
constexpr std::array numbers_of_ranks = {3};  // reads the same places as others do; all of them take minutes
#else
constexpr std::array numbers_of_ranks = {2, 3, 5};
#endif

TEST(SameBits, ForAnyNumberOfRanks) {
  for (const Problem& problem : problems_for_ranks()) {
    const Outcomes one = after_steps(problem, 1);
    for (const int ranks : numbers_of_ranks)
      expect_same(one, after_steps(problem, ranks), problem.name + ", ranks " + std::to_string(ranks));
    expect_same(one, after_steps(problem, 3, Way::restarted), problem.name + ", restarted on 3 ranks");
  }
}

TEST(SameBits, ForAnyNumberOfThreads) {
  for (const Problem& problem : problems_for_ranks()) {
    std::vector<State> states;
    for (const int threads : {1, 2}) {
      omp_set_num_threads(threads);
      const auto domain = single_process();
      Gas gas = problem.filled(*domain);
      Stepper().steps(gas, 20, *domain);
      states.push_back(state_of(gas));
    }
    omp_set_num_threads(1);
    EXPECT_TRUE(states[0] == states[1]) << problem.name;
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
