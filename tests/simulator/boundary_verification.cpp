// Boundaries and loads: what they do to a body, and that the books say so.

#include <numbers>

#include "running.hpp"

namespace brisance::simulator {
namespace {

using L = Columns;

constexpr double round_off = 1e-11;  // of sums over particles and some hundred steps
constexpr double density = 1000.0, bulk_modulus = 1e9, shear_modulus_ = 0.6e9;
constexpr double stiffness = bulk_modulus + 4.0 / 3.0 * shear_modulus_;  // in uniaxial strain

/// An elastic bar [0, length] x [0, height] in the plane geometry.
Case bar(double h, double length, double height) {
  Case c;
  c.geometry = Geometry::plane, c.cell_size = h;
  BodyConfig body;
  body.name = "bar", body.temperature = 300.0;
  body.shape = std::make_shared<const Shape>(Shape{Box{{0, 0, 0}, {length, height, 0}}});
  Material& m = body.material.material;
  m.density = density;
  m.equation_of_state = equation_of_state::Logarithmic{density, bulk_modulus, 1000.0, 300.0};
  m.shear_modulus = shear_modulus::Constant{shear_modulus_};
  m.artificial_viscosity = {0.0, 0.0};
  c.bodies.push_back(body);
  return c;
}

BoundaryConfig plane(BoundaryKind kind, Axis axis, double position, Side side = Side::above) {
  BoundaryConfig b;
  b.name = std::string(choices<BoundaryKind>[static_cast<std::size_t>(kind)]) + std::to_string(position);
  b.kind = kind, b.axis = axis, b.position = position, b.side = side;
  return b;
}

/// Planes of symmetry below and above, which make the motion one along x.
void confine(Case& c, double height) {
  c.boundaries.push_back(plane(BoundaryKind::symmetry, Axis::y, 0.0));
  c.boundaries.push_back(plane(BoundaryKind::symmetry, Axis::y, height, Side::below));
}

Change momentum_of(const Simulation& s) {
  return s.ledger.state;
}
/// The filter of the particle velocities draws them to those of the nodes, and where a boundary holds nodes it passes on some
/// of its impulse; the books have it under the filter.
Vector filtered(const Simulation& s) {
  return s.ledger.filter.total().momentum;
}

// Prescribed velocity ----------------------------------------------------------------------------------------------------

TEST(PrescribedVelocity, PistonDoesTheWorkOfItsForce) {
  constexpr double V = 2.0, h = 0.01;
  Case c = bar(h, 1.0, h);
  confine(c, h);
  BoundaryConfig piston = plane(BoundaryKind::velocity, Axis::x, 0.0);
  piston.velocity = {1, {0.0}, {V}};
  c.boundaries.push_back(piston);
  Simulation s = set_up(c);
  const double wave = std::sqrt(stiffness / density), end = 0.5 / wave;
  run_until(s, end);
  const Change work = s.ledger.boundary[2].total();
  const Balance b = balance(s.ledger, internal_energy(s));
  // The only force along x is that of the piston, which moves with V all the time.
  EXPECT_NEAR(work.momentum[0] + filtered(s)[0], momentum_of(s).momentum[0], round_off * work.momentum[0]);
  EXPECT_LT(std::abs(filtered(s)[0]), 0.01 * work.momentum[0]);
  EXPECT_NEAR(work.energy, V * work.momentum[0], round_off * work.energy);
  EXPECT_NEAR(b.boundary, work.energy, round_off * work.energy);
  // What it has put in is in the bar: half as motion, half as strain, but for what the numerical bins hold.
  const double gained = b.kinetic + b.internal.total - s.ledger.initial_internal;
  EXPECT_NEAR(gained, b.boundary + b.numerical(), closure * b.boundary);
  // Exact: stress rho c V over the height for the time.
  const double force = density * wave * V * h;
  EXPECT_NEAR(work.momentum[0], force * end, 0.01 * force * end);
  expect_closed_books(s);
}

// Rigid walls that meet ----------------------------------------------------------------------------------------------------

/// An elastic block that slides on one wall towards another is held by that when it arrives, and not by its sliding.
TEST(Corner, AWallActsWhenItIsReachedWhateverElseIsTouched) {
  constexpr double V = 10.0, h = 0.05, gap = 1.0 * h, size = 0.2;
  Case c = bar(h, size, size);
  c.bodies[0].shape = std::make_shared<const Shape>(Shape{Box{{gap, 0, 0}, {gap + size, size, 0}}});
  c.bodies[0].velocity.translation = {-V, 0, 0};
  c.boundaries = {plane(BoundaryKind::rigid_wall, Axis::x, 0.0), plane(BoundaryKind::rigid_wall, Axis::y, 0.0)};
  Simulation s = set_up(c);
  const auto push = [&](std::size_t wall) { return s.ledger.boundary[wall].total().momentum[wall]; };
  const double whole = 2.0 * density * size * size * V;
  run_until(s, 0.9 * gap / V);
  EXPECT_EQ(push(0), 0.0) << "it has not arrived";
  EXPECT_LT(std::abs(push(1)), round_off * whole) << "sliding freely it does not press on the floor";
  run_until(s, 3.0 * gap / V);
  EXPECT_GT(push(0), 0.5 * whole) << "it has bounced";
  EXPECT_GT(momentum_of(s).momentum[0], 0.0);
}

/// Pressed on the wall it jumps off the floor, by half a cell, and falls back: all the time the wall holds it, the floor only
/// from when it lands.
TEST(Corner, ABodyLeavesOneWallWhileItStaysOnTheOther) {
  constexpr double V = 10.0, h = 0.05, size = 0.2, g = V * V / h, flight = 2.0 * V / g;
  Case c = bar(h, size, size);
  c.bodies[0].velocity.translation = {0, V, 0};
  c.gravity = {-g, -g, 0.0};
  c.boundaries = {plane(BoundaryKind::rigid_wall, Axis::x, 0.0), plane(BoundaryKind::rigid_wall, Axis::y, 0.0)};
  Simulation s = set_up(c);
  const auto push = [&](std::size_t wall) { return s.ledger.boundary[wall].total().momentum[wall]; };
  const double weight = density * size * size * g;
  run_until(s, 0.9 * flight);
  EXPECT_EQ(push(1), 0.0) << "it has not landed";
  EXPECT_NEAR(push(0), weight * s.time, 0.3 * weight * s.time) << "it rests on the wall, and swings";
  run_until(s, 1.3 * flight);
  EXPECT_GT(push(1), density * size * size * V) << "it has landed";
}

// Fixed ------------------------------------------------------------------------------------------------------------------

TEST(Fixed, HangingBarStretchesToTwiceItsStaticExtension) {
  constexpr double g = 10.0, h = 0.02, length = 1.0;
  Case c = bar(h, length, h);
  confine(c, h);
  c.boundaries.push_back(plane(BoundaryKind::fixed, Axis::x, 0.0));
  c.gravity = {g, 0, 0};
  Simulation s = set_up(c);
  const Particles& ps = s.bodies[0].particles;
  const double wave = std::sqrt(stiffness / density), extension = density * g * length * length / (2.0 * stiffness);
  const auto stretch = [&] {
    double most = 0.0;
    for (int p = 0; p < ps.size; ++p) most = std::max(most, ps.motion.at(0, p));
    return most - (length - 0.25 * h);
  };
  // Suddenly let go, the free end falls freely until it hears of the other, and turns when it has heard twice.
  double most = 0.0, when = 0.0;
  run_until(s, 3.0 * length / wave, [&] {
    if (stretch() > most) most = stretch(), when = s.time;
  });
  EXPECT_NEAR(most, 2.0 * extension, 0.01 * 2.0 * extension);
  EXPECT_NEAR(when, 2.0 * length / wave, 0.02 * 2.0 * length / wave);
  // Newton: what gravity and the support have given is what it has.
  double mass = 0.0;
  for (int p = 0; p < ps.size; ++p) mass += ps.load.at(L::Load::mass, p);
  const Vector weight = s.ledger.external.total().momentum, support = s.ledger.boundary[2].total().momentum;
  EXPECT_NEAR(weight[0] + support[0] + filtered(s)[0], momentum_of(s).momentum[0], round_off * weight[0]);
  EXPECT_NEAR(weight[0], mass * g * (s.time - 0.5 * s.last_time_step), round_off * weight[0]);  // velocities lag half a step
  EXPECT_EQ(s.ledger.boundary[2].total().energy, 0.0);  // what does not move does no work
  expect_closed_books(s);
}

TEST(Fixed, SticksWhereSymmetrySlips) {
  constexpr double g = 10.0, h = 0.02;
  for (const BoundaryKind kind : {BoundaryKind::fixed, BoundaryKind::symmetry}) {
    Case c = bar(h, 0.2, 0.2);
    c.boundaries.push_back(plane(kind, Axis::x, 0.0));
    c.gravity = {0, g, 0};
    Simulation s = set_up(c);
    run_until(s, 1e-3);
    const Change support = s.ledger.boundary[0].total(), weight = s.ledger.external.total();
    EXPECT_NEAR(support.momentum[1] + weight.momentum[1] + filtered(s)[1], momentum_of(s).momentum[1],
                round_off * weight.momentum[1]);
    if (kind == BoundaryKind::symmetry)
      EXPECT_EQ(support.momentum[1], 0.0);
    else
      EXPECT_LT(support.momentum[1], -0.1 * weight.momentum[1]);
    expect_closed_books(s);
  }
}

// Outflow ----------------------------------------------------------------------------------------------------------------

TEST(Outflow, TakesWhatLeavesIntoTheBooks) {
  constexpr double V = 100.0, h = 0.02, length = 0.2, height = 0.1, gap = 0.1;
  Case c = bar(h, length, height);
  c.bodies[0].velocity.translation = {V, 0, 0};
  c.boundaries.push_back(plane(BoundaryKind::outflow, Axis::x, length + gap, Side::below));
  Simulation s = set_up(c);
  const double mass = density * length * height, energy = 0.5 * mass * V * V;
  run_until(s, (gap + 0.5 * length) / V);
  EXPECT_NEAR(s.ledger.outflow_mass, 0.5 * mass, 0.5 * h * height * density);  // one column of particles
  EXPECT_NEAR(s.ledger.outflow_mass + internal_energy(s).mass, mass, round_off * mass);
  EXPECT_NEAR(s.ledger.outflow.total().energy, s.ledger.outflow_mass * V * V / 2, round_off * energy);
  expect_closed_books(s);
  run_until(s, (gap + length) / V + 2.0 * h / V);
  EXPECT_EQ(s.bodies[0].particles.size, 0);
  EXPECT_NEAR(s.ledger.outflow_mass, mass, round_off * mass);
  EXPECT_NEAR(s.ledger.outflow.total().energy, energy, round_off * energy);
  EXPECT_NEAR(s.ledger.outflow.total().momentum[0], mass * V, round_off * mass * V);
  expect_closed_books(s);
}

// Loads ------------------------------------------------------------------------------------------------------------------

class EndLoad : public testing::TestWithParam<Basis> {};

/// A free bar under traction on its right end: whatever waves run in it, its mass centre accelerates with F/m, the force being
/// that per undeformed area.
TEST_P(EndLoad, AcceleratesTheBarByForceOverMass) {
  constexpr double traction = 5e6, h = 0.02, length = 0.4, height = 0.1;
  Case c = bar(h, length, height);
  c.numerics.basis = GetParam();
  LoadConfig load;
  load.body = "bar", load.traction = {traction, 0.3 * traction, 0};
  // Reaches the end faces of the last particles and not those above and below.
  load.region = std::make_shared<const Shape>(Shape{Box{{length - 0.18 * h, -1, 0}, {1, 1, 0}}});
  c.loads.push_back(load);
  Simulation s = set_up(c);
  const double mass = density * length * height, force = traction * height;
  run_until(s, 1e-3);
  const double time = s.time - 0.5 * s.last_time_step;  // velocities lag half a step
  const Vector p = momentum_of(s).momentum;
  EXPECT_NEAR(p[0] / mass, force / mass * time, round_off * force / mass * time);
  EXPECT_NEAR(p[1] / mass, 0.3 * force / mass * time, round_off * force / mass * time);
  EXPECT_NEAR(s.ledger.external.total().momentum[0], p[0], round_off * p[0]);
  expect_closed_books(s);
}
INSTANTIATE_TEST_SUITE_P(Bases, EndLoad, testing::Values(Basis::quadratic_spline, Basis::ugimp),
                         [](const testing::TestParamInfo<Basis>& tested) {
                           return std::string(choices<Basis>[static_cast<std::size_t>(tested.param)]);
                         });

/// Pressure on one end of a confined bar, risen at once: a wave of that pressure, and p/(rho c) behind it.
TEST(PressureLoad, SendsAWaveOfThatPressure) {
  constexpr double pressure = 1e5, h = 0.01, length = 1.0;
  Case c = bar(h, length, h);
  confine(c, h);
  LoadConfig load;
  load.body = "bar", load.pressure = Table{1, {0.0}, {pressure}};
  load.region = std::make_shared<const Shape>(Shape{Box{{-1, -1, 0}, {0.18 * h, 1, 0}}});
  c.loads.push_back(load);
  Simulation s = set_up(c);
  const double wave = std::sqrt(stiffness / density);
  run_until(s, 0.7 * length / wave);
  const Particles& ps = s.bodies[0].particles;
  double stress = 0.0, velocity = 0.0;
  int count = 0;
  for (int p = 0; p < ps.size; ++p)
    if (ps.motion.at(0, p) > 0.1 * length && ps.motion.at(0, p) < 0.5 * length)
      stress -= ps.load.at(L::Load::stress, p), velocity += ps.motion.at(L::Motion::velocity, p), ++count;
  EXPECT_NEAR(stress / count, pressure, 0.01 * pressure);
  EXPECT_NEAR(velocity / count, pressure / (density * wave), 0.01 * pressure / (density * wave));
  const double impulse = pressure * h * (s.time - 0.5 * s.last_time_step);
  EXPECT_NEAR(momentum_of(s).momentum[0], impulse, round_off * impulse);
  expect_closed_books(s);
}

}  // namespace
}  // namespace brisance::simulator
