// The bits of a run depend on the case alone: not on the number of threads or ranks, nor on where particles stand in memory.

#include <gtest/gtest.h>
#include <omp.h>

#include <bit>
#include <cstring>
#include <map>
#include <mutex>
#include <numeric>
#include <random>
#include <string>

#include "simulator/parallel.hpp"
#include "simulator/solid/internal_energy.hpp"
#include "tests/simulator/by_hand.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator {
namespace {

using by_hand::copper;

// Cases that together use every way in which particles and ranks meet ---------------------------------------------------

constexpr double bar_radius = 3.81e-3, bar_length = 7e-3, bar_speed = 190.0;

/// A quarter of a bar between two mirrors strikes a rough wall; its strength varies from particle to particle.
Case quarter_bar() {
  Case c;
  c.cell_size = bar_radius / 4.0;
  c.bodies.push_back(
      by_hand::body("bar", copper(),
                    by_hand::shape(Intersection{{by_hand::shape(Cone{{}, {0.0, bar_length, 0.0}, bar_radius, bar_radius}),
                                                 by_hand::box({}, {1.0, 1.0, 1.0})}}),
                    {0.0, -bar_speed, 0.0}));
  c.bodies[0].strength = StrengthDistribution{1.0, 10.0, 1e-9};
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above, 0.2),
                  by_hand::plane(BoundaryKind::symmetry, Axis::x, 0.0, Side::above),
                  by_hand::plane(BoundaryKind::symmetry, Axis::z, 0.0, Side::above)};
  return c;
}

Case axisymmetric_bar() {
  Case c;
  c.geometry = Geometry::axisymmetric;
  c.numerics.basis = Basis::ugimp;
  c.cell_size = bar_radius / 8.0;
  c.bodies.push_back(by_hand::body("bar", copper(), by_hand::shape(Cone{{}, {0.0, bar_length, 0.0}, bar_radius, bar_radius}),
                                   {0.0, -bar_speed, 0.0}));
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above)};
  return c;
}

/// One disk under pressure drives another through an outflow; both fall.
Case disks_that_leave() {
  Case c;
  c.geometry = Geometry::plane;
  c.cell_size = 0.75e-3;
  c.gravity = {0.0, -1e6, 0.0};
  c.bodies = {by_hand::body("lower", copper(), by_hand::shape(Sphere{{0.3e-3, 3.2e-3, 0.0}, 3e-3}), {20.0, -1000.0, 0.0}),
              by_hand::body("upper", copper(), by_hand::shape(Sphere{{-0.4e-3, 9.4e-3, 0.0}, 3e-3}), {0.0, -1200.0, 0.0})};
  LoadConfig load;
  load.body = "upper", load.pressure = by_hand::table({{0.0, 1e9}});
  c.loads.push_back(load);
  c.boundaries = {by_hand::plane(BoundaryKind::outflow, Axis::y, 0.0, Side::above)};
  return c;
}

// State of a run --------------------------------------------------------------------------------------------------------

/// Bits of every column of every particle, by body and id.
using State = std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::uint64_t>>;

void add_state(const Simulation& s, State& state) {
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Particles& ps = s.bodies[b].particles;
    const std::vector<Column> columns = ps.columns();
    for (int p = 0; p < ps.size; ++p) {
      std::vector<std::uint64_t>& bits = state[{b, ps.id[static_cast<std::size_t>(p)]}];
      ASSERT_TRUE(bits.empty()) << "particle " << ps.id[static_cast<std::size_t>(p)] << " is there twice";
      bits.push_back(ps.block[static_cast<std::size_t>(p)]);
      for (const Column& c : columns) bits.push_back(std::bit_cast<std::uint64_t>(ps.set(c.set).at(c.index, p)));
    }
  }
}

/// Fowler-Noll-Vo over 64 bits, and the books after it.
struct Fingerprint {
  std::uint64_t particles = 14695981039346656037ull;
  std::size_t count = 0;
  std::size_t changed_block = 0;  // since the start
  Balance books;
  double time = 0.0, outflow_mass = 0.0;
};

Fingerprint fingerprint(const State& state, const Simulation& s) {
  Fingerprint f;
  const auto mix = [&](std::uint64_t x) {
    for (int i = 0; i < 8; ++i) f.particles = (f.particles ^ (x >> 8 * i & 0xff)) * 1099511628211ull;
  };
  for (const auto& [id, bits] : state) {
    mix(id.first), mix(id.second);
    for (const std::uint64_t x : bits) mix(x);
  }
  f.count = state.size();
  f.time = s.time, f.outflow_mass = s.ledger.outflow_mass;
  return f;
}

void expect_same(const Fingerprint& a, const Fingerprint& b, const std::string& what) {
  EXPECT_EQ(a.count, b.count) << what;
  EXPECT_EQ(a.particles, b.particles) << what << ": bits of the particles";
  EXPECT_EQ(a.time, b.time) << what;
  EXPECT_EQ(a.outflow_mass, b.outflow_mass) << what;
  EXPECT_EQ(std::memcmp(&a.books, &b.books, sizeof(Balance)), 0)
      << what << ": books; kinetic " << a.books.kinetic << " and " << b.books.kinetic << ", residual " << a.books.residual
      << " and " << b.books.residual;
}

// Ways of running -------------------------------------------------------------------------------------------------------

constexpr int steps = 100;

void go(Simulation& s, int dimensions, const std::function<void(Simulation&)>& before_step) {
  for (int i = 0; i < steps; ++i) {
    if (before_step) before_step(s);
    double dt = by_hand::stable_step(s, 1.0, dimensions == 3 ? 0.4 : 0.5);
    while (advance(s, dt) != StepOutcome::done) dt *= 0.5;
  }
}

/// One process. `prepare` may change how the particles lie in memory.
Fingerprint on_threads(const Case& c, int threads, const std::function<void(Simulation&)>& prepare = {},
                       const std::function<void(Simulation&)>& before_step = {}) {
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Simulation s = set_up(c);
  State start;
  add_state(s, start);
  if (prepare) prepare(s);
  go(s, c.dimensions(), before_step);
  omp_set_num_threads(threads_before);
  EXPECT_GE(s.grid.my_blocks.size(), least_blocks_per_thread * static_cast<std::size_t>(threads)) << "enough to be shared";
  State state;
  add_state(s, state);
  Fingerprint f = fingerprint(state, s);
  for (const auto& [id, bits] : state) f.changed_block += bits[0] != start.at(id)[0];
  f.books = balance(s.ledger, internal_energy(s));
  for (const Body& b : s.bodies)
    for (const Column& column : b.particles.columns())
      for (int p = 0; p < b.particles.size; ++p)
        EXPECT_TRUE(std::isfinite(b.particles.set(column.set).at(column.index, p))) << column.name;
  EXPECT_GT(f.books.internal.plastic_work, 0.0);
  return f;
}

Fingerprint on_ranks(const Case& c, int ranks) {
  State state;
  Fingerprint result;
  std::mutex one_at_a_time;
  Balance books;
  VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
    Simulation s = set_up(c, domain);
    go(s, c.dimensions(), {});
    const Balance mine = balance(s.ledger, internal_energy(s));
    {
      const std::lock_guard lock(one_at_a_time);
      add_state(s, state);
      if (domain->rank() == 0) books = mine;
    }
    domain->maximum(0.0);  // all have added
    if (domain->rank() == 0) result = fingerprint(state, s);
  });
  result.books = books;
  return result;
}

void never_tidy(Simulation& s) {
  for (Body& b : s.bodies) b.bins.strayed = 0;
}
void always_tidy(Simulation& s) {
  for (Body& b : s.bodies) b.bins.strayed = static_cast<std::size_t>(b.particles.size);
}
/// Puts the particles in any order in memory.
void shuffle(Simulation& s) {
  std::mt19937 random(1);
  for (Body& b : s.bodies) {
    std::vector<std::uint32_t> order(static_cast<std::size_t>(b.particles.size));
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    b.particles.reorder(order);
    b.bins.sort(b.particles);
  }
}

void expect_same_bits(const Case& c) {
  const Fingerprint reference = on_threads(c, 1);
  EXPECT_GT(reference.changed_block, reference.count / 20) << "too few particles have changed their block to matter";
  expect_same(reference, on_threads(c, 2), "two threads");
  expect_same(reference, on_threads(c, 1, {}, never_tidy), "never put in order in memory");
  expect_same(reference, on_threads(c, 1, {}, always_tidy), "put in order after every step");
  expect_same(reference, on_threads(c, 2, shuffle, never_tidy), "shuffled in memory");
  for (const int ranks : {1, 2, 3, 5}) expect_same(reference, on_ranks(c, ranks), std::to_string(ranks) + " ranks");
  const Fingerprint other = [&] {
    Case changed = c;
    changed.bodies[0].velocity.translation[1] *= 1.0 + 1e-15;
    return on_threads(changed, 1);
  }();
  EXPECT_NE(reference.particles, other.particles) << "the fingerprint does not see the particles";
}

TEST(SameBits, QuarterOfABarOnAWall) {
  expect_same_bits(quarter_bar());
}
TEST(SameBits, AxisymmetricBarOnAWall) {
  expect_same_bits(axisymmetric_bar());
}
TEST(SameBits, BarOnAWallThatTravels) {
  Case c = axisymmetric_bar();
  c.boundaries.back().velocity = by_hand::table({{0.0, 100.0}, {5e-6, 300.0}});
  expect_same_bits(c);
}
TEST(SameBits, DisksThatMeetAndLeave) {
  const Case c = disks_that_leave();
  expect_same_bits(c);
  EXPECT_GT(on_threads(c, 1).outflow_mass, 0.0);
}

// Rejected steps --------------------------------------------------------------------------------------------------------

/// Every byte of what a step starts from.
std::vector<std::uint64_t> bytes_of(const Simulation& s) {
  std::vector<std::uint64_t> all;
  const auto add = [&](const void* from, std::size_t size) {
    const std::size_t words = (size + 7) / 8;
    all.resize(all.size() + words, 0);
    if (size > 0) std::memcpy(all.data() + all.size() - words, from, size);
  };
  for (const Body& b : s.bodies) {
    const Particles& p = b.particles;
    for (int set = 0; set < 3; ++set)
      for (int c = 0; c < p.chunks(); ++c)
        add(p.set(set).chunk(c), sizeof(double) * static_cast<std::size_t>(p.set(set).columns() * chunk_size));
    add(p.id.data(), p.id.size() * sizeof(p.id[0])), add(p.block.data(), p.block.size() * sizeof(p.block[0]));
    add(p.second_field.data(), p.second_field.size() * sizeof(std::uint32_t));
    add(b.bins.order.data(), b.bins.order.size() * sizeof(std::uint32_t)), add(&b.bins.strayed, sizeof(b.bins.strayed));
    for (const Bin& bin : b.bins.bins) add(&bin, sizeof(Bin));
  }
  add(&s.time, sizeof(s.time)), add(&s.step, sizeof(s.step)), add(&s.last_time_step, sizeof(s.last_time_step));
  add(&s.extremes, sizeof(s.extremes));
  const Ledger& l = s.ledger;
  add(&l.state, sizeof(l.state)), add(&l.peak_kinetic, sizeof(double));
  for (const Account* a : {&l.internal_force, &l.external, &l.transfer, &l.filter, &l.advection, &l.outflow})
    add(a, sizeof(Account));
  for (const Account& a : l.boundary) add(&a, sizeof(Account));
  for (const CompensatedSum& f : l.friction) add(&f, sizeof(f));
  add(&l.filter_heat, sizeof(l.filter_heat)), add(&l.outflow_internal, sizeof(double)), add(&l.outflow_mass, sizeof(double));
  return all;
}

TEST(RejectedStep, LeavesEveryByteOfTheStateAsItWas) {
  for (const StressTiming timing : {StressTiming::musl, StressTiming::usl, StressTiming::usf})
    for (Case c : {quarter_bar(), axisymmetric_bar()}) {
      c.numerics.stress_timing = timing;
      Simulation s = set_up(c);
      const auto step = [&] { return by_hand::stable_step(s, 1.0, 0.3); };
      for (int i = 0; i < 20; ++i) ASSERT_EQ(advance(s, step()), StepOutcome::done);
      const auto before = bytes_of(s);
      ASSERT_EQ(advance(s, 100.0 * step()), StepOutcome::rejected);
      EXPECT_EQ(before, bytes_of(s));
      // Nor does it leave a trace in what is computed from the state.
      Simulation t = set_up(c);
      for (int i = 0; i < 20; ++i) advance(t, by_hand::stable_step(t, 1.0, 0.3));
      const double dt = step();
      advance(s, dt), advance(t, dt);
      EXPECT_EQ(bytes_of(s), bytes_of(t));
    }
}

}  // namespace
}  // namespace brisance::simulator
