// The books of a run close to round-off, and they do because everything is booked: leaving out one thing shows.

#include "simulator/gates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "simulator/output/history.hpp"
#include "simulator/solid/internal_energy.hpp"
#include "simulator/solid/motion.hpp"
#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {
namespace {

using by_hand::copper;

/// A copper block strikes a rough wall aslant, under gravity, with a pressure and a shear traction on its top: everything that
/// the books know of, but outflow.
Case everything(Geometry g, StressTiming timing = StressTiming::musl) {
  Case c;
  c.geometry = g, c.cell_size = 0.5e-3;
  c.numerics.stress_timing = timing;
  c.gravity = {0.0, -1e6, 0.0};
  const double slant = g == Geometry::axisymmetric ? 0.0 : 50.0, depth = g == Geometry::three_dimensional ? 1.5e-3 : 1.0;
  c.bodies.push_back(
      by_hand::body("block", copper(), by_hand::box({0.0, 0.0, 0.0}, {3e-3, 4e-3, depth}), {slant, -150.0, 0.5 * slant}));
  LoadConfig load;
  load.body = "block", load.region = by_hand::box({-1.0, 3.8e-3, -1.0}, {1.0, 1.0, 2.0});
  load.pressure = by_hand::table({{0.0, 1e8}, {1e-6, 5e8}}), load.traction = {2e7, 0.0, 0.0};
  c.loads.push_back(load);
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above, 0.3)};
  return c;
}

/// What the gates of a run say about the books; empty if they pass.
std::string complaint(const Simulation& s) {
  try {
    check_gates(GateConfig{}, s, books_of(s));
  } catch (const GateExceeded& gate) {
    return gate.what();
  }
  return "";
}

void go(Simulation& s, int steps, double courant = 0.3) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(advance(s, by_hand::stable_step(s, 1.0, courant)), StepOutcome::done);
}

TEST(Ledger, ClosesToRoundOffWithEverythingAtOnce) {
  for (const Geometry g : {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional})
    for (const StressTiming timing : {StressTiming::musl, StressTiming::usl, StressTiming::usf})
      for (const Basis basis : {Basis::quadratic_spline, Basis::ugimp}) {
        Case c = everything(g, timing);
        c.numerics.basis = basis;
        Simulation s = set_up(c);
        go(s, 80, timing == StressTiming::usl ? 0.2 : 0.3);
        const Balance b = balance(s.ledger, internal_energy(s));
        const std::string what = std::string(choices<Geometry>[static_cast<std::size_t>(g)]) + ", " +
                                 std::string(choices<StressTiming>[static_cast<std::size_t>(timing)]) + ", " +
                                 std::string(choices<Basis>[static_cast<std::size_t>(basis)]);
        std::printf("%s: residual of energy %.1e of the peak\n", what.c_str(), b.residual / s.ledger.peak_kinetic);
        EXPECT_EQ(complaint(s), "") << what;
        // Each bin has something in it.
        const double some = 1e-6 * s.ledger.peak_kinetic;
        for (const double x :
             {b.external, b.boundary, b.transfer, b.filter, b.stress_timing, b.internal.plastic_work, b.internal.viscous_work})
          EXPECT_GT(std::abs(x), some) << what;
        EXPECT_EQ(b.filter_heat > some, timing != StressTiming::usf) << what;
        if (g != Geometry::axisymmetric) {
          EXPECT_LT(b.friction, -some) << what;
          // Action is reaction: in Cartesian coordinates the internal forces give no momentum, nor does the way between
          // particles and grid.
          const double momentum = std::sqrt(2.0 * s.ledger.peak_kinetic * internal_energy(s).mass);
          EXPECT_LT(magnitude(s.ledger.internal_force.total().momentum), 1e-11 * momentum) << what;
        }
      }
}

// Mutations ---------------------------------------------------------------------------------------------------------------

/// Something that a step may forget, after it is computed and before it is booked.
using Mutation = std::function<void(ParticleResult&, NodeResult&)>;
/// A work per mass that a step does not add to the internal energy: a column of the particles' sums of work.
constexpr int no_work = -1;

/// A step with MUSL, in which something may be forgotten.
void step_by_hand(Simulation& s, const Mutation& forget = {}, int work_forgotten = no_work) {
  const double dt = by_hand::stable_step(s, 1.0, 0.3), dt_velocity = 0.5 * (dt + s.last_time_step);
  const auto share = [&] { gather_tiles(s.grid, *s.domain), sum_tiles(s.grid); };
  activate_blocks(s);
  particles_to_grid(s, Carry::motion_and_force, dt);
  share();
  NodeResult nodes = accelerate(s, dt_velocity);
  ParticleResult particles = grid_to_particles(s, {dt, dt_velocity, true});
  share();
  velocities_from_momentum(s, Touch::as_accelerated, s.time + 0.5 * dt);
  velocity_gradients(s, 0.5 * dt);
  Particles& ps = s.bodies[0].particles;
  const ColumnSet before = ps.rest;
  update_stress(s, dt, &Particles::next_motion);
  for (int p = 0; work_forgotten != no_work && p < ps.size; ++p)
    ps.rest.at(Layout<2>::Rest::energy, p) -= ps.rest.at(work_forgotten, p) - before.at(work_forgotten, p);
  if (forget) forget(particles, nodes);
  accept_motion(s, particles, nodes, dt);
}

/// What the gates say after twenty steps, in one of which something is forgotten.
std::string forgetting(const Mutation& forget, int work_forgotten = no_work) {
  Simulation s = set_up(everything(Geometry::plane));
  for (int i = 0; i < 20; ++i) step_by_hand(s, i == 15 ? forget : Mutation{}, i == 15 ? work_forgotten : no_work);
  return complaint(s);
}

void expect_missed(const std::string& what, const std::string& complaint) {
  EXPECT_NE(complaint.find("gate residual: " + what), std::string::npos) << "the gates say: \"" << complaint << '"';
}

TEST(Gates, PassWhenNothingIsForgotten) {
  Simulation s = set_up(everything(Geometry::plane)), t = set_up(everything(Geometry::plane));
  for (int i = 0; i < 20; ++i) {
    step_by_hand(s);
    advance(t, by_hand::stable_step(t, 1.0, 0.3));
  }
  EXPECT_EQ(s.ledger.state.energy, t.ledger.state.energy) << "the step by hand is the step";
  EXPECT_EQ(complaint(s), "");
}

TEST(Gates, MissTheImpulseOfABoundary) {
  expect_missed("energy", forgetting([](ParticleResult&, NodeResult& nodes) {
                  for (auto& block : nodes.boundaries)
                    if (block[0].impulse.momentum[1] > 0.0) {
                      block[0].impulse = {};
                      return;
                    }
                }));
}
TEST(Gates, MissTheMomentumOfABoundary) {
  expect_missed("momentum", forgetting([](ParticleResult&, NodeResult& nodes) {
                  for (auto& block : nodes.boundaries) block[0].impulse.momentum[0] = 0.0;
                }));
}
TEST(Gates, MissTheFrictionOfABoundary) {
  expect_missed("energy", forgetting([](ParticleResult&, NodeResult& nodes) {
                  for (auto& block : nodes.boundaries) block[0].impulse.energy -= block[0].friction;
                }));
}
TEST(Gates, MissTheAngularMomentumOfABoundary) {
  expect_missed("angular momentum", forgetting([](ParticleResult&, NodeResult& nodes) {
                  for (auto& block : nodes.boundaries) block[0].impulse.angular_momentum = {};
                }));
}
TEST(Gates, MissExternalWork) {
  expect_missed("energy", forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().external.energy = 0.0; }));
}
TEST(Gates, MissTheFilterOfVelocities) {
  expect_missed("energy", forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().filter = {}; }));
}
TEST(Gates, MissTheHeatOfTheFilter) {
  expect_missed("energy", forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().filter_heat = 0.0; }));
}
TEST(Gates, MissInternalWork) {
  expect_missed("energy", forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().internal = 0.0; }));
}
TEST(Gates, MissWhatTheGridGives) {
  expect_missed("energy", forgetting([](ParticleResult&, NodeResult& nodes) {
                  for (NodeTally& t : nodes.tallies) t.change = {};
                }));
}
TEST(Gates, MissAForce) {
  expect_missed("momentum", forgetting([](ParticleResult&, NodeResult& nodes) {
                  std::max_element(nodes.tallies.begin(), nodes.tallies.end(), [](const NodeTally& a, const NodeTally& b) {
                    return magnitude(a.force.momentum) < magnitude(b.force.momentum);
                  })->force.momentum = {};
                }));
}
/// Where every change is booked, but momentum is where it has no business.
TEST(Gates, MissAnActionWithoutReaction) {
  Simulation s = set_up(everything(Geometry::plane));
  go(s, 20);
  const Books books = books_of(s);
  EXPECT_NO_THROW(check_gates(GateConfig{}, s, books));
  const double some = 1e-9 * magnitude(books.state.momentum);
  for (Change Books::*cause : {&Books::transfer, &Books::internal_force}) {
    Books wrong = books;
    (wrong.*cause).momentum[0] += some;
    EXPECT_THROW(check_gates(GateConfig{}, s, wrong), GateExceeded);
  }
}
TEST(Gates, MissTheAdvectionOfAngularMomentum) {
  expect_missed("angular momentum", forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().advection = {}; }));
}
TEST(Gates, MissTheHeatOfArtificialViscosity) {
  expect_missed("energy", forgetting({}, Layout<2>::Rest::viscous_work));
}
TEST(Gates, MissTheHeatOfPlasticFlow) {
  expect_missed("energy", forgetting({}, Layout<2>::Rest::plastic_work));
}
TEST(Gates, MissTheWorkOfTheStress) {
  expect_missed("energy", forgetting({}, Layout<2>::Rest::stress_work));
}

// What history.csv says of each body and of heat ----------------------------------------------------------------------------

TEST(Books, OfBodiesAddUpToThoseOfAll) {
  Case c = everything(Geometry::plane);
  c.bodies.push_back(by_hand::body("second", copper(), by_hand::box({4e-3, 0.0, 0.0}, {6e-3, 2e-3, 1.0}), {0.0, -100.0, 0.0}));
  Simulation s = set_up(c);
  go(s, 40);
  const Books books = books_of(s);
  ASSERT_EQ(books.bodies.size(), 2u);
  Change state;
  InternalEnergy internal;
  for (const BodyBooks& body : books.bodies) state += body.state, internal += body.internal;
  constexpr double round_off = 1e-13;
  EXPECT_NEAR(state.energy, books.state.energy, round_off * books.peak_kinetic);
  EXPECT_NEAR(state.momentum[1], books.state.momentum[1], round_off * std::abs(state.momentum[1]));
  EXPECT_NEAR(internal.total, books.balance.internal.total, round_off * std::abs(internal.total));
  for (std::size_t b = 0; b < 2; ++b) {
    const Vector momentum = by_hand::mass(s.bodies[b]) * by_hand::mean(s.bodies[b], by_hand::velocity);
    EXPECT_NEAR(books.bodies[b].state.momentum[0], momentum[0], round_off * magnitude(momentum));
    EXPECT_NEAR(books.bodies[b].internal.mass, by_hand::mass(s.bodies[b]), round_off * books.balance.internal.mass);
  }
}

/// Without heat conduction or compression to speak of, heat is the plastic work that Taylor and Quinney's coefficient leaves,
/// that of the artificial viscosity and that of the filter; the rest of the plastic work is stored.
TEST(Books, TellHeatFromStoredWork) {
  Case c = everything(Geometry::plane);
  Material& m = c.bodies[0].material.material;
  m.specific_heat = specific_heat::Constant{.value = 383.0};
  Table chi;
  chi.size = 1, chi.y[0] = 0.6;
  m.heating = Heating{.taylor_quinney = chi, .viscous = true, .thermoelastic = false};
  Simulation s = set_up(c);
  go(s, 80);
  const InternalEnergy e = internal_energy(s);
  ASSERT_GT(e.plastic_work, 0.0);
  EXPECT_NEAR(e.plastic_heat, 0.6 * e.plastic_work, 1e-12 * e.plastic_work);
  EXPECT_NEAR(e.stored_cold_work(), 0.4 * e.plastic_work, 1e-12 * e.plastic_work);
  const double filter_heat = s.ledger.filter_heat.value();
  EXPECT_GT(filter_heat, 0.0);
  // Temperature takes the viscous heat at the end of the step, energy over it: equal to the order of the step.
  EXPECT_NEAR(e.thermal, e.plastic_heat + e.viscous_work + filter_heat, 1e-3 * e.thermal);
  EXPECT_NEAR(e.gained, e.stress_work + e.viscous_work + filter_heat, 1e-9 * e.stress_work);
  EXPECT_GT(e.elastic, 0.0);
  EXPECT_NEAR(e.thermal + e.elastic + e.stored_cold_work() + e.cold(), e.gained, 1e-12 * e.gained);
}

// Outflow -----------------------------------------------------------------------------------------------------------------

TEST(Outflow, CountsMassMomentumAndEnergyOfWhatLeaves) {
  for (const Geometry g : {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional}) {
    Case c;
    c.geometry = g, c.cell_size = 0.5e-3;
    c.gravity = {0.0, -2e6, 0.0};
    const double depth = g == Geometry::three_dimensional ? 1e-3 : 1.0;
    c.bodies = {by_hand::body("first", copper(), by_hand::box({0.0, 0.2e-3, 0.0}, {2e-3, 2e-3, depth}), {0.0, -800.0, 0.0}),
                by_hand::body("second", copper(), by_hand::box({0.0, 2e-3, 0.0}, {2e-3, 3e-3, depth}), {0.0, -1000.0, 0.0})};
    c.boundaries = {by_hand::plane(BoundaryKind::outflow, Axis::y, 0.0, Side::above)};
    Simulation s = set_up(c);
    const double mass = internal_energy(s).mass;
    const std::size_t particles = static_cast<std::size_t>(s.bodies[0].particles.size + s.bodies[1].particles.size);
    bool some_left = false;
    double heat_before = -1.0;
    for (int i = 0; i < 400 && internal_energy(s).mass > 0.0; ++i) {
      // By the particles themselves: what goes is what is no longer there.
      go(s, 1);
      const InternalEnergy inside = internal_energy(s);
      ASSERT_NEAR(inside.mass + s.ledger.outflow_mass, mass, 1e-13 * mass);
      ASSERT_EQ(complaint(s), "");
      double kinetic = 0.0;
      for (const Body& b : s.bodies)
        for (int p = 0; p < b.particles.size; ++p) {
          ASSERT_GE(by_hand::position(b.particles, p)[1], 0.0) << "nothing stays beyond";
          const Vector v = by_hand::velocity(b.particles, p);
          kinetic += 0.5 * by_hand::mass(b.particles, p) * dot(v, v);
        }
      ASSERT_NEAR(s.ledger.state.energy, kinetic, 1e-12 * s.ledger.peak_kinetic) << "the books know who is still there";
      some_left = some_left || (s.ledger.outflow_mass > 0.0 && inside.mass > 0.0);
      heat_before = s.ledger.outflow_internal;
    }
    EXPECT_TRUE(some_left);
    EXPECT_GT(particles, 20u);
    EXPECT_NEAR(s.ledger.outflow_mass, mass, 1e-13 * mass) << "all have left in the end";
    EXPECT_NE(heat_before, 0.0);
    EXPECT_LT(s.ledger.outflow.total().momentum[1], -0.9 * mass * 800.0);
  }
}

}  // namespace
}  // namespace brisance::simulator
