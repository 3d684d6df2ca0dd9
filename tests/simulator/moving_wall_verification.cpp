// A rigid wall that travels: what it does is what a wall at rest does to a body that comes, and a shock that it drives follows
// the Hugoniot.

#include <map>

#include "simulator/gates.hpp"
#include "simulator/output/history.hpp"
#include "tests/simulator/running.hpp"

namespace brisance::simulator {
namespace {

constexpr double round_off = 1e-10;  // of sums over particles and some hundred steps

Simulation bar_and_wall(double bar_speed, double wall_speed) {
  Case c =
      shipped_case("taylor_copper_190_mts", {"cell_size=0.635 mm", "solid.0.velocity=[0," + std::to_string(bar_speed) + "]"});
  c.boundaries[0].velocity = by_hand::table({{0.0, wall_speed}});
  return set_up(c);
}

TEST(MovingWall, StrikesABarAsABarStrikesAWall) {
  constexpr double V = 190.0, end = 15e-6, length = 25.4e-3;
  Simulation at_rest = bar_and_wall(-V, 0.0), moving = bar_and_wall(0.0, V);
  run_until(at_rest, end), run_until(moving, end);
  ASSERT_EQ(at_rest.step, moving.step);
  const Particles &a = at_rest.bodies[0].particles, &b = moving.bodies[0].particles;
  std::map<std::uint64_t, int> by_id;
  for (int p = 0; p < a.size; ++p) by_id[a.id[static_cast<std::size_t>(p)]] = p;
  double farthest = 0.0, fastest = 0.0, strain = 0.0, most_strain = 0.0;
  for (int p = 0; p < b.size; ++p) {
    const int q = by_id.at(b.id[static_cast<std::size_t>(p)]);
    const Vector travelled{0.0, V * end, 0.0}, carried{0.0, V, 0.0};
    farthest = std::max(farthest, magnitude(by_hand::position(b, p) - travelled - by_hand::position(a, q)));
    fastest = std::max(fastest, magnitude(by_hand::velocity(b, p) - carried - by_hand::velocity(a, q)));
    const double of_a = a.rest.at(Columns::Rest::plastic_strain, q), of_b = b.rest.at(Columns::Rest::plastic_strain, p);
    strain = std::max(strain, std::abs(of_a - of_b)), most_strain = std::max(most_strain, of_a);
  }
  std::printf("after %.3g us: places differ by %.2g of the length, velocities by %.2g of the speed, strains by %.2g of %.3g\n",
              1e6 * end, farthest / length, fastest / V, strain, most_strain);
  // Equal but for round-off: in another frame every number is rounded otherwise.
  constexpr double same = 1e-10;
  EXPECT_LT(farthest, same * length);
  EXPECT_LT(fastest, same * V);
  EXPECT_LT(strain, same);
  // The wall that comes does the work that the bar had as motion: its impulse at its own speed.
  const Change of_wall = moving.ledger.boundary.back().total(), of_wall_at_rest = at_rest.ledger.boundary.back().total();
  EXPECT_NEAR(of_wall.momentum[1], of_wall_at_rest.momentum[1], 1e-10 * of_wall.momentum[1]);
  EXPECT_NEAR(of_wall.energy - of_wall_at_rest.energy, V * of_wall.momentum[1], 1e-10 * of_wall.energy);
  expect_closed_books(moving);
}

/// Until it arrives there is no energy but the heat in the metal, of which the books may miss no more than its round-off.
TEST(MovingWall, ComesNearToABarAtRestWithBooksThatClose) {
  Case c = shipped_case("taylor_copper_190_johnson_cook",
                        {"cell_size=0.635 mm", "solid.0.velocity=[0,0]", "boundary.0.position=-6.35 mm"});
  c.boundaries[0].velocity = by_hand::table({{0.0, 500.0}});
  Simulation s = set_up(c);
  while (s.time < 15e-6) {
    run_until(s, s.time + 1e-7);
    ASSERT_NO_THROW(check_gates(c.gates, s, books_of(s))) << s.step;
  }
  EXPECT_GT(s.ledger.boundary.back().total().momentum[1], 0.0) << "it has arrived";
}

/// A wall that gains speed presses as gravity does on a wall at rest: the frame falls.
TEST(MovingWall, ThatAcceleratesIsAWallAtRestUnderGravity) {
  constexpr double h = 0.05, size = 0.2, a = 2e4, end = 3.3e-3, courant = 0.125;
  const Material elastic = by_hand::elastic_material(1000.0, 1e8, 0.3);
  const auto make = [&](double gravity, const Table& velocity) {
    Case c;
    c.geometry = Geometry::plane, c.cell_size = h, c.gravity = {0, -gravity, 0};
    c.bodies = {by_hand::body("block", elastic, by_hand::box({0, 0, 0}, {size, size, 0}))};
    BoundaryConfig wall = by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above);
    wall.velocity = velocity;
    c.boundaries = {wall};
    return set_up(c);
  };
  Simulation pulled = make(a, {}), pushed = make(0.0, by_hand::table({{0.0, 0.0}, {1.0, a}}));
  by_hand::run_to(pulled, end, courant), by_hand::run_to(pushed, end, courant);
  const double way = 0.5 * a * end * end;
  const auto centre = [](const Simulation& s) { return by_hand::mean(s.bodies[0], by_hand::position); };
  const double sunk = 0.5 * size - centre(pulled)[1];
  ASSERT_GT(way, h) << "the grid travels";
  // Of second order in the step: 0.9, 0.12 and 0.02 % with 50, 99 and 197 of them.
  constexpr double of_the_step = 1e-3;
  EXPECT_NEAR(0.5 * size - (centre(pushed)[1] - way), sunk, of_the_step * sunk);
  std::printf("sunk by %.4g and %.4g mm in %ld steps\n", 1e3 * sunk, 1e3 * (0.5 * size - (centre(pushed)[1] - way)),
              static_cast<long>(pushed.step));
  const double pressed = pushed.ledger.boundary[0].total().momentum[1];
  EXPECT_NEAR(pressed, pulled.ledger.boundary[0].total().momentum[1], of_the_step * pressed);
  expect_closed_books(pushed);
}

/// The metal of the plate impacts, without strength, driven by a wall at half the speed of their flyer.
Case piston_on_copper(double speed, BoundaryKind kind) {
  Case c = shipped_case("plate_impact_copper", {"solid.1.shape.box.upper=[0.012, 0.0001]"});
  c.bodies.erase(c.bodies.begin());
  BoundaryConfig piston = by_hand::plane(kind, Axis::x, 0.0, Side::above);
  piston.name = "piston", piston.velocity = by_hand::table({{0.0, speed}});
  c.boundaries.push_back(piston);
  c.end_time = 2.4e-6;
  return c;
}

struct Piston : testing::TestWithParam<BoundaryKind> {};

TEST_P(Piston, DrivesAShockOnTheHugoniot) {
  constexpr double u = 250.0, density = 8930.0, speed = 3940.0 + 1.489 * u, pressure = density * speed * u;
  const Case c = piston_on_copper(u, GetParam());
  Simulation s = set_up(c);
  // The momentum of a steady shock grows with the mass that it reaches.
  run_until(s, 0.5 * c.end_time);
  const double first = s.ledger.state.momentum[0], first_time = s.time;
  run_until(s, c.end_time);
  const double shock_speed = (s.ledger.state.momentum[0] - first) / (s.time - first_time) / (density * u * 1e-4);
  const double h = c.cell_size, face = u * s.time, front = speed * s.time;
  double p = 0.0, v = 0.0, rho = 0.0;
  int count = 0;
  const Particles& ps = s.bodies[0].particles;
  for (int i = 0; i < ps.size; ++i) {
    const double x = by_hand::position(ps, i)[0];
    EXPECT_GT(x, face) << "no particle goes through the wall";
    if (x < face + 8.0 * h || x > front - 12.0 * h) continue;  // wall heating; where the shock stands
    p -= (by_hand::stress(ps, i, 0) + by_hand::stress(ps, i, 1) + by_hand::stress(ps, i, 2)) / 3.0;
    v += by_hand::velocity(ps, i)[0], rho += ps.load.at(Columns::Load::density, i), ++count;
  }
  ASSERT_GT(count, 16 * 40);
  p /= count, v /= count, rho /= count;
  const Balance b = balance(s.ledger, internal_energy(s));
  const Change work = s.ledger.boundary.back().total();
  std::printf(
      "pressure %+.3f %%, velocity %+.4f %%, density %+.4f %%, shock speed %+.3f %%, numerical books %.3f %% of the work\n",
      100.0 * (p / pressure - 1.0), 100.0 * (v / u - 1.0), 100.0 * (rho * (1.0 - u / speed) / density - 1.0),
      100.0 * (shock_speed / speed - 1.0), 100.0 * b.numerical() / b.boundary);
  EXPECT_NEAR(p, pressure, 0.01 * pressure);
  EXPECT_NEAR(v, u, 0.01 * u);
  EXPECT_NEAR(rho, density / (1.0 - u / speed), 0.01 * rho);
  EXPECT_NEAR(shock_speed, speed, 0.01 * speed);
  // The wall is the only force along x, and moves with u all the time; what it gives is in the metal.
  const Change filter = s.ledger.filter.total();
  EXPECT_NEAR(work.momentum[0] + filter.momentum[0], s.ledger.state.momentum[0], round_off * work.momentum[0]);
  const double gained = b.kinetic + b.internal.total - s.ledger.initial_internal;
  EXPECT_NEAR(gained, b.boundary + b.numerical(), round_off * b.boundary);
  EXPECT_NEAR(b.boundary, u * work.momentum[0], 0.01 * b.boundary);
  expect_closed_books(s);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Piston, testing::Values(BoundaryKind::rigid_wall, BoundaryKind::velocity),
                         [](const auto& kind) {
                           return std::string(choices<BoundaryKind>[static_cast<std::size_t>(kind.param)]);
                         });

}  // namespace
}  // namespace brisance::simulator
