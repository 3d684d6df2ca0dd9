// Elastic bodies against closed forms: what is free of stress, vibrates, spins, rebounds, slides and sticks.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "simulator/solid/internal_energy.hpp"
#include "simulator/solid/motion.hpp"
#include "simulator/solid/transfer.hpp"
#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {
namespace {

using std::numbers::pi;

/// Kinetic and internal energy.
double energy(const Simulation& s) {
  return s.ledger.state.energy + internal_energy(s).total;
}
Vector momentum(const Simulation& s) {
  Vector sum{};
  for (const Body& b : s.bodies) sum = sum + by_hand::mass(b) * by_hand::mean(b, by_hand::velocity);
  return sum;
}

// Motions without strain ------------------------------------------------------------------------------------------------

constexpr double stress_round_off = 1e-12;  // of Young's modulus

TEST(UniformTranslation, ThroughManyCellsLeavesABodyFreeOfStress) {
  for (const Geometry g : {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional})
    for (const Basis basis : {Basis::quadratic_spline, Basis::ugimp})
      for (const ParticleVelocity v : {ParticleVelocity::flip, ParticleVelocity::aflip}) {
        Case c;
        c.geometry = g, c.cell_size = 0.1;
        c.numerics.basis = basis, c.numerics.particle_velocity = v;
        const Vector velocity =
            g == Geometry::axisymmetric ? Vector{0.0, 0.7, 0.0} : Vector{0.7, -0.9, g == Geometry::plane ? 0.0 : 0.4};
        c.bodies.push_back(
            by_hand::body("ball", by_hand::elastic_material(1000.0, 1000.0, 0.3), by_hand::shape(Sphere{{}, 0.25}), velocity));
        Simulation s = set_up(c);
        by_hand::run_to(s, 3.0, 0.4);  // twenty cells and more
        EXPECT_LT(by_hand::largest_stress(s), stress_round_off * 1000.0);
        const Particles& ps = s.bodies[0].particles;
        for (int p = 0; p < ps.size; ++p) EXPECT_LT(magnitude(by_hand::velocity(ps, p) - velocity), 1e-12);
      }
}

/// The velocities of the grid are given: omega x r. The stress of the body has to turn with it, and no other may come.
TEST(RigidRotation, OfTheGridTurnsStressAndMakesNone) {
  for (const Geometry g : {Geometry::plane, Geometry::three_dimensional})
    for (const Basis basis : {Basis::quadratic_spline, Basis::ugimp})
      for (const bool stressed : {false, true}) {
        Case c;
        c.geometry = g, c.cell_size = 0.1;
        c.numerics.basis = basis;
        constexpr double modulus = 1000.0, sigma = 100.0;
        c.bodies.push_back(
            by_hand::body("ball", by_hand::elastic_material(1000.0, modulus, 0.3), by_hand::shape(Sphere{{}, 0.25})));
        Simulation s = set_up(c);
        Particles& ps = s.bodies[0].particles;
        if (stressed)
          for (int p = 0; p < ps.size; ++p) ps.load.at(Layout<3>::Load::stress, p) = sigma;
        ps.pad();
        const Vector omega = g == Geometry::plane ? Vector{0.0, 0.0, 1.0} : Vector{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
        const auto turning = [&](const Vector& x) { return cross(omega, x); };
        activate_blocks(s);
        g == Geometry::plane ? by_hand::set_grid_velocity<2>(s, turning) : by_hand::set_grid_velocity<3>(s, turning);
        constexpr int steps = 100;
        const double dt = 0.08;
        for (int i = 0; i < steps; ++i) {
          velocity_gradients(s);
          update_stress(s, dt, &Particles::motion);
        }
        // Rodrigues: the direction that was x; the stress is sigma times its dyad.
        const double angle = steps * dt, cosine = std::cos(angle), sine = std::sin(angle);
        const Vector x{1.0, 0.0, 0.0};
        const Vector e = cosine * x + sine * cross(omega, x) + ((1.0 - cosine) * dot(omega, x)) * omega;
        const double expected = stressed ? sigma : 0.0;
        const std::array<double, 6> t{e[0] * e[0], e[1] * e[1], e[2] * e[2], e[1] * e[2], e[0] * e[2], e[0] * e[1]};
        double worst = 0.0;
        for (int p = 0; p < ps.size; ++p)
          for (int k = 0; k < by_hand::stress_components(ps); ++k) {
            const double exact = expected * t[static_cast<std::size_t>(ps.dimensions == 2 && k == 3 ? 5 : k)];
            worst = std::max(worst, std::abs(by_hand::stress(ps, p, k) - exact));
          }
        EXPECT_LT(worst, stress_round_off * modulus);
      }
}

/// Particles that nothing pushes fly apart with v = A X, so F = 1 + A t. A step takes the exponential of the gradient in its
/// middle: of second order. The gradient on the places where the step starts would be of first.
TEST(HomogeneousMotion, DeformsParticlesAsTheyMove) {
  constexpr double A[3][3] = {{0.5, 0.2, -0.1}, {-0.3, -0.4, 0.2}, {0.1, 0.3, 0.2}};
  const auto error = [&]<int D>(Geometry g, StressTiming timing, int steps) {
    using L = Layout<D>;
    const bool ring = g == Geometry::axisymmetric;
    Case c;
    c.geometry = g, c.cell_size = 0.1, c.numerics.stress_timing = timing;
    c.bodies.push_back(by_hand::body("ball", by_hand::elastic_material(1000.0, 1000.0, 0.3), by_hand::shape(Sphere{{}, 0.25})));
    Simulation s = set_up(c);
    s.bodies[0].stress = [](Body&, int) {};
    s.bodies[0].material.bulk_modulus = 1.0;
    Particles& ps = s.bodies[0].particles;
    const auto rate = [&](int a, int b) { return ring && a != b ? 0.0 : A[a][b]; };
    for (int p = 0; p < ps.size; ++p)
      for (int a = 0; a < D; ++a) {
        double v = 0.0;
        for (int b = 0; b < D; ++b) v += rate(a, b) * by_hand::position(ps, p)[static_cast<std::size_t>(b)];
        ps.motion.at(L::Motion::velocity + a, p) = v;
        for (int b = 0; b < D; ++b) ps.motion.at(L::Motion::affine + D * a + b, p) = rate(a, b);
      }
    ps.pad();
    constexpr double end = 0.5;
    for (int i = 0; i < steps; ++i) EXPECT_EQ(advance(s, end / steps), StepOutcome::done);
    double worst = 0.0;
    for (int p = 0; p < ps.size; ++p) {
      for (int a = 0; a < D; ++a)
        for (int b = 0; b < D; ++b)
          worst =
              std::max(worst, std::abs(ps.rest.at(L::Rest::deformation_gradient + D * a + b, p) - (a == b) - rate(a, b) * end));
      if (ring) worst = std::max(worst, std::abs(ps.rest.at(L::Rest::deformation_gradient + 4, p) - 1.0 - A[0][0] * end));
    }
    return worst;
  };
  for (const StressTiming timing : {StressTiming::musl, StressTiming::usl})
    for (const Geometry g : {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional}) {
      const auto of = [&](int steps) {
        return g == Geometry::three_dimensional ? error.operator()<3>(g, timing, steps) : error.operator()<2>(g, timing, steps);
      };
      const double coarse = of(10), fine = of(20);
      std::printf("homogeneous motion: F errs by %.1e and %.1e, order %.2f\n", coarse, fine, std::log2(coarse / fine));
      EXPECT_LT(fine, 1e-4);
      EXPECT_GT(std::log2(coarse / fine), 1.9);
    }
}

// A free ring spins. Equilibrium, d(r sigma_rr)/dr = sigma_tt - rho omega^2 r^2 with free edges, gives the integral of the hoop
// stress over the section: that of rho omega^2 r^2. A sudden start makes the ring breathe with the period 2 pi R/c; the mean
// over time does not.
TEST(SpinningRing, CarriesTheHoopStressOfItsSpin) {
  constexpr double R = 8.0, density = 1.0, c = 1.0, omega = 0.02 * c / R;
  Case ring;
  ring.geometry = Geometry::plane, ring.cell_size = 1.0;
  ring.bodies.push_back(by_hand::body("ring", by_hand::elastic_material(density, density * c * c, 0.0),
                                      by_hand::shape(Sphere{{}, R + 1.0, R - 1.0})));
  ring.bodies[0].velocity.rotation = {0.0, 0.0, omega};
  Simulation s = set_up(ring);
  const Particles& ps = s.bodies[0].particles;
  const double spin = s.ledger.state.angular_momentum[2];
  const double end = 10.0 * 2.0 * pi * R / c;
  double hoop = 0.0, expected = 0.0;
  by_hand::run_to(s, end, 0.3, [&] {
    double stress = 0.0, inertia = 0.0;
    for (int p = 0; p < ps.size; ++p) {
      const Vector x = by_hand::position(ps, p);
      const double r2 = dot(x, x), section = by_hand::volume(ps, p) / std::sqrt(r2);
      const double xx = by_hand::stress(ps, p, 0), yy = by_hand::stress(ps, p, 1), xy = by_hand::stress(ps, p, 3);
      stress += section * (xx * x[1] * x[1] - 2.0 * xy * x[0] * x[1] + yy * x[0] * x[0]) / r2;
      inertia += section * density * omega * omega * r2;
    }
    // Hann's window: how much of the last breath is counted does not matter.
    const double weight = s.last_time_step * (1.0 - std::cos(2.0 * pi * s.time / end));
    hoop += weight * stress, expected += weight * inertia;
  });
  std::printf("spinning ring: hoop stress/rho omega^2 r^2 = %.5f; angular momentum changed by %.1e in %.2f turns\n",
              hoop / expected, s.ledger.state.angular_momentum[2] / spin - 1.0, omega * end / (2.0 * pi));
  EXPECT_NEAR(hoop / expected, 1.0, 0.01);
  EXPECT_NEAR(s.ledger.state.angular_momentum[2] / spin, 1.0, 1e-3);
}

// Vibration ---------------------------------------------------------------------------------------------------------------

/// A bar held at one end with the velocities of its first mode. Without Poisson's effect the plane bar between mirrors is a
/// bar: period 4 L/c, amplitude of the free end V0/omega.
TEST(VibratingBar, KeepsPeriodAmplitudeAndEnergy) {
  constexpr double E = 100.0, density = 1.0, L = 25.0, V0 = 0.1, h = 0.5, c = 10.0, period = 4.0 * L / c;
  constexpr double wave_number = 0.5 * pi / L;
  constexpr int periods = 10;
  Case bar;
  bar.geometry = Geometry::plane, bar.cell_size = h;
  bar.numerics.particle_velocity = ParticleVelocity::flip;
  bar.bodies.push_back(by_hand::body("bar", by_hand::elastic_material(density, E, 0.0), by_hand::box({}, {L, 2.0 * h, 1.0})));
  bar.boundaries = {by_hand::plane(BoundaryKind::fixed, Axis::x, 0.0, Side::above),
                    by_hand::plane(BoundaryKind::symmetry, Axis::y, 0.0, Side::above),
                    by_hand::plane(BoundaryKind::symmetry, Axis::y, 2.0 * h, Side::below)};
  Simulation s = set_up(bar);
  Particles& ps = s.bodies[0].particles;
  std::uint32_t tip = 0;
  for (int p = 0; p < ps.size; ++p) {
    const double x = by_hand::position(ps, p)[0];
    ps.motion.at(Layout<2>::Motion::velocity, p) = V0 * std::sin(wave_number * x);
    if (x > by_hand::position(ps, static_cast<int>(tip))[0]) tip = static_cast<std::uint32_t>(p);
  }
  const std::uint64_t tip_id = ps.id[tip];
  const double tip_start = by_hand::position(ps, static_cast<int>(tip))[0];
  open_books(s);
  const double energy_at_start = energy(s), kinetic = s.ledger.state.energy;
  std::vector<double> crossings;  // of the mean velocity through zero
  double before = 0.0, time_before = 0.0, amplitude = 0.0, first_amplitude = 0.0;
  double energy_in_first = 0.0, energy_in_last = 0.0;
  by_hand::run_to(s, (periods + 0.1) * period, 0.5, [&] {
    const double mean = by_hand::mean(s.bodies[0], by_hand::velocity)[0];
    const double at = s.time - 0.5 * s.last_time_step;  // velocities lag
    if (before != 0.0 && before * mean < 0.0) crossings.push_back(time_before + (at - time_before) * before / (before - mean));
    before = mean, time_before = at;
    for (int p = 0; p < ps.size; ++p)
      if (ps.id[static_cast<std::size_t>(p)] == tip_id) {
        const double u = std::abs(by_hand::position(ps, p)[0] - tip_start);
        if (s.time < period) first_amplitude = std::max(first_amplitude, u);
        if (s.time > (periods - 1) * period) amplitude = std::max(amplitude, u);
      }
    // Velocities lag half a step behind stresses, so the sum of the energies swings; its mean over a period does not.
    if (s.time <= period) energy_in_first += s.last_time_step * (energy(s) - energy_at_start);
    if (s.time > (periods - 1) * period && s.time <= periods * period)
      energy_in_last += s.last_time_step * (energy(s) - energy_at_start);
  });
  ASSERT_EQ(crossings.size(), 2u * periods);
  const double measured = (crossings.back() - crossings.front()) / (periods - 0.5);
  const double exact_amplitude = V0 / (wave_number * c) * std::sin(wave_number * tip_start);
  const double drift = (energy_in_last - energy_in_first) / (period * kinetic);
  std::printf("vibrating bar: period %.5f of %.5f, amplitude %.5f first, %.5f last, of %.5f; energy drifts by %.1e\n", measured,
              period, first_amplitude, amplitude, exact_amplitude, drift);
  EXPECT_NEAR(measured, period, 0.005 * period);
  EXPECT_NEAR(first_amplitude, exact_amplitude, 0.01 * exact_amplitude);
  EXPECT_NEAR(amplitude, exact_amplitude, 0.01 * exact_amplitude);
  EXPECT_LT(std::abs(drift), 1e-3);
}

// Collisions --------------------------------------------------------------------------------------------------------------

/// Two disks collide and part: Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Engng 118 (1994) 179-196.
struct Collision {
  double energy_change;  // of the kinetic energy at the start
  Balance books;         // in the same units
};
Collision collide(double h, ParticleVelocity v, double courant = 0.3) {
  constexpr double R = 0.2, speed = 0.1;
  Case c;
  c.geometry = Geometry::plane, c.cell_size = h;
  c.numerics.particle_velocity = v;
  const Material rubber = by_hand::elastic_material(1000.0, 1000.0, 0.3);
  c.bodies = {by_hand::body("one", rubber, by_hand::shape(Sphere{{-0.3, -0.3, 0.0}, R}), {speed, speed, 0.0}),
              by_hand::body("other", rubber, by_hand::shape(Sphere{{0.3, 0.3, 0.0}, R}), {-speed, -speed, 0.0})};
  Simulation s = set_up(c);
  const double kinetic = s.ledger.state.energy, start = energy(s);
  const double unit = std::sqrt(2.0 * kinetic * 2.0 * by_hand::mass(s.bodies[0]));  // of momentum
  double least_kinetic = kinetic, momentum_error = 0.0, asymmetry = 0.0;
  // Velocities lag half a step behind stresses: the kinetic energy of a time is the mean of those around it. The disks vibrate
  // when they have parted; the mean is taken over half a second of that.
  double kinetic_before = kinetic, internal_before = start - kinetic, sum = 0.0, steps = 0.0;
  by_hand::run_to(s, 3.3, courant, [&] {
    if (s.time > 2.8) sum += 0.5 * (kinetic_before + s.ledger.state.energy) + internal_before - start, steps += 1.0;
    kinetic_before = s.ledger.state.energy, internal_before = internal_energy(s).total;
    least_kinetic = std::min(least_kinetic, s.ledger.state.energy);
    momentum_error = std::max(momentum_error, magnitude(momentum(s)));
    asymmetry = std::max(
        asymmetry, magnitude(by_hand::mean(s.bodies[0], by_hand::position) + by_hand::mean(s.bodies[1], by_hand::position)));
  });
  EXPECT_LT(least_kinetic, 0.6 * kinetic) << "they meet";
  EXPECT_LT(dot(by_hand::mean(s.bodies[0], by_hand::velocity), {1.0, 1.0, 0.0}), 0.0) << "and part";
  EXPECT_LT(momentum_error, 1e-13 * unit);
  EXPECT_LT(asymmetry, 1e-13);
  Balance b = balance(s.ledger, internal_energy(s));
  EXPECT_LT(b.residual, 1e-10 * kinetic);
  for (double* x : {&b.transfer, &b.filter, &b.filter_heat, &b.stress_timing}) *x /= kinetic;
  const Collision result{sum / (steps * kinetic), b};
  EXPECT_NEAR((energy(s) - start) / kinetic, b.numerical(), 1e-10) << "every change of energy is in a bin";
  std::printf(
      "disks, h = %.3f, %s: energy changes by %.3f %%: transfer %.3f, filter %.3f, its heat %.3f, stress timing %.3f; "
      "momentum %.1e, asymmetry %.1e\n",
      h, v == ParticleVelocity::flip ? "FLIP" : "AFLIP", 100.0 * result.energy_change, 100.0 * b.transfer, 100.0 * b.filter,
      100.0 * b.filter_heat, 100.0 * b.stress_timing, momentum_error / unit, asymmetry);
  return result;
}

TEST(CollidingDisks, ReboundWithTheirEnergyUnderFlip) {
  // A prototype in another language measured -0.4 % with the coarse grid. What is left is in proportion to the step: MUSL
  // takes the strain from velocities before, and the forces from those after the particles have moved.
  const Collision coarse = collide(0.05, ParticleVelocity::flip), fine = collide(0.025, ParticleVelocity::flip);
  EXPECT_LT(std::abs(coarse.energy_change), 0.005);
  EXPECT_LT(std::abs(fine.energy_change), 0.003);
  EXPECT_EQ(fine.books.filter, 0.0);
  // Half the step leaves half of it: what would not be the step's may be a tenth of all.
  const Collision half_the_step = collide(0.05, ParticleVelocity::flip, 0.15);
  EXPECT_NEAR(half_the_step.energy_change, 0.5 * coarse.energy_change, 0.1 * std::abs(coarse.energy_change));
}
TEST(CollidingDisks, LoseLittleUnderAflipMostOfWhatTheFilterTakesBeingHeat) {
  const Collision coarse = collide(0.05, ParticleVelocity::aflip), fine = collide(0.025, ParticleVelocity::aflip);
  for (const Collision& c : {coarse, fine}) {
    EXPECT_LT(c.energy_change, 0.0);
    EXPECT_LT(c.books.filter, -0.01) << "what the filter takes has a bin of its own";
    EXPECT_GT(c.books.filter_heat, -0.8 * c.books.filter);
    EXPECT_LT(c.books.filter_heat, -c.books.filter) << "heat is what is lost relative to the grid, not more";
  }
  // Transfer and stress timing under AFLIP, of first order in the size of a cell: of disks of four and eight cells in the
  // radius.
  EXPECT_GT(coarse.energy_change, -0.04);
  EXPECT_GT(fine.energy_change, -0.02);
}

/// A bar in uniaxial strain strikes a wall: stress rho c V, contact for 2 L/c, then it leaves with its velocity reversed.
struct Strike {
  double stress, contact, rebound;  // over rho c V, 2 L/c, V
};
Strike strike(double cells) {
  constexpr double density = 2703.0, c = 6398.61, L = 0.1, V = 10.0, nu = 0.33;
  const double h = L / cells;
  constexpr double modulus = density * c * c * (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu);
  constexpr double plateau = density * c * V, contact = 2.0 * L / c;
  Case bar;
  bar.geometry = Geometry::plane, bar.cell_size = h;
  bar.bodies.push_back(by_hand::body("bar", by_hand::elastic_material(density, modulus, nu),
                                     by_hand::box({}, {2.0 * h, L, 1.0}), {0.0, -V, 0.0}));
  bar.bodies[0].material.material.artificial_viscosity = {};
  bar.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above),
                    by_hand::plane(BoundaryKind::symmetry, Axis::x, 0.0, Side::above),
                    by_hand::plane(BoundaryKind::symmetry, Axis::x, 2.0 * h, Side::below)};
  Simulation s = set_up(bar);
  const Particles& ps = s.bodies[0].particles;
  const auto impulse = [&] { return s.ledger.boundary[0].total().momentum[1]; };
  const auto mean_stress = [&] {  // between a fifth and two fifths of the bar
    double sum = 0.0, count = 0.0;
    for (int p = 0; p < ps.size; ++p)
      if (const double y = by_hand::position(ps, p)[1]; y > 0.2 * L && y < 0.4 * L)
        sum -= by_hand::stress(ps, p, 1), count += 1.0;
    return sum / count;
  };
  by_hand::run_to(s, 0.35 * contact, 0.5);
  const double stress = mean_stress();
  // The force is half of the plateau when the wave is back; it is taken over a twentieth of the contact.
  std::vector<std::pair<double, double>> history{{s.time, impulse()}};
  double released = 0.0;
  const double force = plateau * 2.0 * h, window = 0.02 * contact;
  by_hand::run_to(s, 1.5 * contact, 0.5, [&] {
    history.emplace_back(s.time, impulse());
    std::size_t first = history.size() - 1;
    while (first > 0 && history[first].first > s.time - window) --first;
    const double mean_force = (history.back().second - history[first].second) / (history.back().first - history[first].first);
    if (released == 0.0 && mean_force < 0.5 * force) released = 0.5 * (history.back().first + history[first].first);
  });
  const double left_with = by_hand::mean(s.bodies[0], by_hand::velocity)[1], impulse_then = impulse();
  by_hand::run_to(s, 3.0 * contact, 0.5);
  const double lowest = [&] {
    double y = L;
    for (int p = 0; p < ps.size; ++p) y = std::min(y, by_hand::position(ps, p)[1]);
    return y;
  }();
  std::printf("bar on a wall: stress/rho c V = %.4f, contact/(2 L/c) = %.4f, rebound/V = %.4f, gap/h = %.2f\n",
              stress / plateau, released / contact, left_with / V, lowest / h);
  EXPECT_EQ(impulse(), impulse_then) << "a wall that is not touched does nothing";
  EXPECT_GT(lowest, 0.3 * h);
  return {stress / plateau, released / contact, left_with / V};
}

TEST(BarOnAWall, IsReleasedAfterTheWaveHasReturned) {
  const Strike coarse = strike(50.0), fine = strike(100.0);
  EXPECT_NEAR(fine.stress, 1.0, 0.02);
  EXPECT_NEAR(fine.contact, 1.0, 0.01);
  // The front is a few cells wide, and what is behind it when the wall lets go stays in the bar as vibration.
  EXPECT_NEAR(fine.rebound, 1.0, 0.03);
  EXPECT_LT(1.0 - fine.rebound, 0.75 * (1.0 - coarse.rebound));
}

// Friction ----------------------------------------------------------------------------------------------------------------

constexpr double mu = 0.3, pressure = 1.0, height = 8.0, width = 16.0, ramp = 2.0;

/// A block on a wall, pressed from above; a shear traction pushes it along. Both grow slowly.
Simulation pressed_block(double speed, double traction) {
  Case c;
  c.geometry = Geometry::plane, c.cell_size = 1.0;
  c.bodies.push_back(by_hand::body("block", by_hand::elastic_material(1.0, 1e4, 0.3),
                                   by_hand::box({0.0, 0.0, 0.0}, {width, height, 1.0}), {speed, 0.0, 0.0}));
  LoadConfig load;
  load.body = "block", load.region = by_hand::box({-1.0, height - 0.2, -1.0}, {width + 1.0, height + 1.0, 1.0});
  load.pressure = by_hand::table({{0.0, 0.0}, {ramp, pressure}});
  load.traction = {traction, 0.0, 0.0}, load.amplitude = by_hand::table({{0.0, 0.0}, {ramp, 1.0}});
  c.loads.push_back(load);
  c.boundaries = {by_hand::plane(BoundaryKind::rigid_wall, Axis::y, 0.0, Side::above, mu)};
  return set_up(c);
}
double speed_of(const Simulation& s) {
  return by_hand::mean(s.bodies[0], by_hand::velocity)[0];
}
constexpr double deceleration = mu * pressure / height;  // of a density of one

TEST(BlockOnAWall, SlidesAgainstCoulombsFrictionAndStops) {
  constexpr double speed = 0.4;
  Simulation s = pressed_block(speed, 0.0);
  const double first = ramp + 1.0, second = 8.0;
  by_hand::run_to(s, first, 0.5);
  const auto by_wall = [&] { return s.ledger.boundary[0].total().momentum; };
  const double v1 = speed_of(s), t1 = s.time, m = by_hand::mass(s.bodies[0]);
  const Vector impulse1 = by_wall(), p1 = momentum(s);
  by_hand::run_to(s, second, 0.5);
  const double v2 = speed_of(s), time = s.time - t1;
  const Vector impulse = by_wall() - impulse1;
  // The block bounces a little on its own elasticity: what presses is the load and the change of the vertical momentum.
  const double pressed = pressure * width * time + (momentum(s) - p1)[1], measured = (v1 - v2) / time,
               expected = mu * pressed / (m * time);
  // Half of the ramp is lost for friction.
  by_hand::run_to(s, speed / deceleration + 0.5 * ramp + 1.0, 0.5);
  const double stopped_at = by_hand::mean(s.bodies[0], by_hand::position)[0];
  by_hand::run_to(s, s.time + 4.0, 0.5);
  const double crept = by_hand::mean(s.bodies[0], by_hand::position)[0] - stopped_at;
  const Balance b = balance(s.ledger, internal_energy(s));
  std::printf(
      "sliding block: deceleration/(mu p/(rho H)) = %.5f, friction/normal impulse %.6f; then speed %.1e of the first, crept "
      "%.1e cells in 4 s; friction %.4f "
      "of the kinetic energy\n",
      measured / expected, -impulse[0] / impulse[1], speed_of(s) / speed, crept, b.friction / s.ledger.initial.energy);
  EXPECT_NEAR(measured, expected, 0.01 * expected);
  EXPECT_NEAR(-impulse[0], mu * impulse[1], 1e-3 * mu * impulse[1]);
  EXPECT_LT(std::abs(speed_of(s)), 0.01 * speed);
  EXPECT_LT(std::abs(crept), 0.01);
  EXPECT_NEAR(b.friction, -s.ledger.initial.energy, 0.02 * s.ledger.initial.energy) << "friction has taken the kinetic energy";
}

TEST(BlockOnAWall, SticksBelowCoulombsLimitAndSlidesAboveIt) {
  for (const double part : {0.8, 1.25}) {
    Simulation s = pressed_block(0.0, part * mu * pressure);
    by_hand::run_to(s, ramp + 1.0, 0.5);
    const double v1 = speed_of(s), x1 = by_hand::mean(s.bodies[0], by_hand::position)[0], t1 = s.time;
    by_hand::run_to(s, 8.0, 0.5);
    const double acceleration = (speed_of(s) - v1) / (s.time - t1),
                 moved = by_hand::mean(s.bodies[0], by_hand::position)[0] - x1;
    std::printf("block pushed with %.2f mu p: acceleration/(mu p/(rho H)) = %.4f, moved %.1e cells\n", part,
                acceleration / deceleration, moved);
    if (part < 1.0) {
      EXPECT_LT(std::abs(moved), 1e-3) << "elastic shear is 1e-4 of a cell";
    } else {
      EXPECT_NEAR(acceleration, (part - 1.0) * deceleration, 0.01 * deceleration);
    }
  }
}

}  // namespace
}  // namespace brisance::simulator
