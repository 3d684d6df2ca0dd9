// The books of a run close to round-off, and they do because everything is booked: leaving out one thing shows.

#include "simulator/ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "models/input/material_reader.hpp"
#include "simulator/solid/motion.hpp"
#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {
namespace {

constexpr double gate = 1e-10;  // of the peak of kinetic energy, or of the momentum that goes with it

Material copper() {
  static const Material read =
      read_material(std::string(BRISANCE_SOURCE_DIR) + "/data/materials/copper_ofhc_johnson_cook.toml");
  return read;
}

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

struct Residuals {
  double energy, momentum, angular_momentum;  // relative
};
Residuals residuals(const Simulation& s) {
  const InternalEnergy internal = internal_energy(s);
  const Balance b = balance(s.ledger, internal);
  const double momentum = std::sqrt(2.0 * s.ledger.peak_kinetic * (internal.mass + s.ledger.outflow_mass)), extent = 1e-2;
  return {b.residual / s.ledger.peak_kinetic, by_hand::size(b.momentum_residual) / momentum,
          by_hand::size(b.angular_momentum_residual) / (momentum * extent)};
}

void go(Simulation& s, int steps, double courant = 0.3) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(advance(s, by_hand::courant_step(s, courant, 1.0)), StepOutcome::done);
}

TEST(Ledger, ClosesToRoundOffWithEverythingAtOnce) {
  for (const Geometry g : {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional})
    for (const StressTiming timing : {StressTiming::musl, StressTiming::usl, StressTiming::usf})
      for (const Basis basis : {Basis::quadratic_spline, Basis::ugimp}) {
        Case c = everything(g, timing);
        c.numerics.basis = basis;
        Simulation s = set_up(c);
        go(s, 80, timing == StressTiming::usl ? 0.2 : 0.3);
        const Residuals r = residuals(s);
        const Balance b = balance(s.ledger, internal_energy(s));
        const std::string what = std::string(choices<Geometry>[static_cast<std::size_t>(g)]) + ", " +
                                 std::string(choices<StressTiming>[static_cast<std::size_t>(timing)]) + ", " +
                                 std::string(choices<Basis>[static_cast<std::size_t>(basis)]);
        std::printf("%s: residual of energy %.1e, momentum %.1e, angular momentum %.1e\n", what.c_str(), r.energy, r.momentum,
                    r.angular_momentum);
        EXPECT_LT(r.energy, gate) << what;
        EXPECT_LT(r.momentum, gate) << what;
        EXPECT_LT(r.angular_momentum, gate) << what;
        // Each bin has something in it.
        const double some = 1e-6 * s.ledger.peak_kinetic;
        for (const double x : {b.external, b.boundary, b.transfer, b.filter, b.stress_timing, b.plastic_work, b.viscous_work})
          EXPECT_GT(std::abs(x), some) << what;
        if (g != Geometry::axisymmetric) {
          EXPECT_LT(b.friction, -some) << what;
          // Action is reaction: in Cartesian coordinates the internal forces give no momentum, nor does the way between
          // particles and grid.
          const double momentum = std::sqrt(2.0 * s.ledger.peak_kinetic * internal_energy(s).mass);
          EXPECT_LT(by_hand::size(s.ledger.internal_force.total().momentum), 1e-11 * momentum) << what;
        }
      }
}

// Mutations ---------------------------------------------------------------------------------------------------------------

using Mutation = std::function<void(ParticleResult&, NodeResult&)>;

/// A step with MUSL, in which something may be forgotten before it is booked.
void step_by_hand(Simulation& s, double dt, const Mutation& forget) {
  const double dt_velocity = 0.5 * (dt + s.last_time_step);
  const auto share = [&] { gather_tiles(s.grid, *s.domain), sum_tiles(s.grid); };
  activate_blocks(s);
  particles_to_grid(s, Carry::motion_and_force, dt);
  share();
  NodeResult nodes = accelerate(s, dt_velocity);
  ParticleResult particles = grid_to_particles(s, {dt, dt_velocity, true});
  share();
  velocities_from_momentum(s, Touch::as_accelerated, s.time + 0.5 * dt);
  velocity_gradients(s);
  update_stress(s, dt, &Particles::next_motion);
  if (forget) forget(particles, nodes);
  accept_motion(s, particles, nodes, dt);
}

/// The residuals after twenty steps, in one of which something is forgotten.
Residuals forgetting(const Mutation& forget) {
  Simulation s = set_up(everything(Geometry::plane));
  for (int i = 0; i < 20; ++i) step_by_hand(s, by_hand::courant_step(s, 0.3, 1.0), i == 15 ? forget : Mutation{});
  return residuals(s);
}

TEST(Ledger, MissesNothingWhenNothingIsForgotten) {
  Simulation s = set_up(everything(Geometry::plane)), t = set_up(everything(Geometry::plane));
  for (int i = 0; i < 20; ++i) {
    step_by_hand(s, by_hand::courant_step(s, 0.3, 1.0), {});
    advance(t, by_hand::courant_step(t, 0.3, 1.0));
  }
  EXPECT_EQ(s.ledger.state.energy, t.ledger.state.energy) << "the step by hand is the step";
  const Residuals r = residuals(s);
  EXPECT_LT(r.energy, gate);
  EXPECT_LT(r.momentum, gate);
}

TEST(Ledger, MissesTheImpulseOfABoundary) {
  const Residuals r = forgetting([](ParticleResult&, NodeResult& nodes) {
    for (auto& block : nodes.boundaries)
      if (block[0].impulse.momentum[1] > 0.0) {
        block[0].impulse = {};
        return;
      }
  });
  EXPECT_GT(r.energy, gate);
  EXPECT_GT(r.momentum, gate);
  EXPECT_GT(r.angular_momentum, gate);
}
TEST(Ledger, MissesTheFrictionOfABoundary) {
  const Residuals r = forgetting([](ParticleResult&, NodeResult& nodes) {
    for (auto& block : nodes.boundaries) block[0].impulse.momentum[0] = 0.0, block[0].impulse.energy -= block[0].friction;
  });
  EXPECT_GT(r.energy, gate);
  EXPECT_GT(r.momentum, gate);
}
TEST(Ledger, MissesExternalWork) {
  EXPECT_GT(forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().external.energy = 0.0; }).energy, gate);
}
TEST(Ledger, MissesTheFilterOfVelocities) {
  const Residuals r = forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().filter = {}; });
  EXPECT_GT(r.energy, gate);
}
TEST(Ledger, MissesInternalWork) {
  EXPECT_GT(forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().internal = 0.0; }).energy, gate);
}
TEST(Ledger, MissesWhatTheGridGives) {
  // The transfer is what particles receive less what nodes give: an error of either alone is no residual but shows as momentum
  // that the transfer has made.
  Simulation s = set_up(everything(Geometry::plane));
  for (int i = 0; i < 20; ++i) step_by_hand(s, by_hand::courant_step(s, 0.3, 1.0), {});
  const double unit = std::sqrt(2.0 * s.ledger.peak_kinetic * internal_energy(s).mass);
  EXPECT_LT(by_hand::size(s.ledger.transfer.total().momentum), 1e-12 * unit);
  step_by_hand(s, by_hand::courant_step(s, 0.3, 1.0), [](ParticleResult&, NodeResult& nodes) {
    for (NodeTally& t : nodes.tallies) t.change = {};
  });
  EXPECT_GT(by_hand::size(s.ledger.transfer.total().momentum), 1e-10 * unit);
}
TEST(Ledger, MissesTheAdvectionOfAngularMomentum) {
  EXPECT_GT(forgetting([](ParticleResult& p, NodeResult&) { p.tallies.front().advection = {}; }).angular_momentum, gate);
}

/// Heat that comes from nowhere, or is lost.
TEST(Ledger, MissesAHeatTerm) {
  for (const double part : {1.0, -1.0}) {
    Simulation s = set_up(everything(Geometry::plane));
    go(s, 20);
    ASSERT_LT(residuals(s).energy, gate);
    Particles& ps = s.bodies[0].particles;
    // The plastic work of the hottest particle's last step would be of this size.
    int hottest = 0;
    const int plastic_work = Layout<2>::Rest::plastic_work;
    for (int p = 0; p < ps.size; ++p)
      if (ps.rest.at(plastic_work, p) > ps.rest.at(plastic_work, hottest)) hottest = p;
    ASSERT_GT(ps.rest.at(plastic_work, hottest), 0.0);
    ps.rest.at(Layout<2>::Rest::energy, hottest) += part * 0.01 * ps.rest.at(plastic_work, hottest);
    EXPECT_GT(residuals(s).energy, gate);
  }
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
      const Residuals r = residuals(s);
      ASSERT_LT(r.energy, gate);
      ASSERT_LT(r.momentum, gate);
      ASSERT_LT(r.angular_momentum, gate);
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
