// Rigid, perfectly plastic bodies that come to rest: rings that fly apart and shells that collapse. Their kinetic energy
// becomes plastic work, which closed forms give as a function of where they stop. Elastic constants are high enough that what
// the elastic strain takes does not matter.

#include <numbers>

#include "running.hpp"

namespace brisance::simulator {
namespace {

using L = Columns;

constexpr double one_percent = 0.01;

struct Metal {
  double density, yield_stress, specific_heat;
};

/// The shipped material with other constants; `stiffness` is Young's modulus, at Poisson's ratio `ratio`.
void become(Material& m, const Metal& metal, double stiffness, double ratio) {
  m.density = metal.density;
  m.equation_of_state =
      equation_of_state::Hypoelastic{metal.density, stiffness / (3.0 * (1.0 - 2.0 * ratio)), metal.specific_heat, 300.0};
  m.shear_modulus = shear_modulus::Constant{stiffness / (2.0 * (1.0 + ratio))};
  m.flow_stress = flow_stress::LinearHardening{metal.yield_stress, 0.0};
  m.specific_heat = specific_heat::Constant{metal.specific_heat};
}

double mean(const Particles& ps, int column) {
  double sum = 0.0, mass = 0.0;
  for (int p = 0; p < ps.size; ++p) {
    const double m = ps.load.at(L::Load::mass, p);
    sum += m * ps.rest.at(column, p), mass += m;
  }
  return sum / mass;
}

// Rings ------------------------------------------------------------------------------------------------------------------

/// Thin ring under uniaxial hoop stress: rho R R'' = -Y, stops at the strain rho v^2/(2 Y).
void check_ring(const Metal& metal, double speed, double tabulated) {
  const double strain = metal.density * speed * speed / (2.0 * metal.yield_stress),
               heat = speed * speed / (2.0 * metal.specific_heat);
  EXPECT_NEAR(strain, tabulated, 1e-6);
  Case c = shipped_case("expanding_ring");
  // At the stop a strain Y/E is elastic, half of whose stress has worked: a two hundredth of the plastic strain at most.
  const double stiffness = std::max(123e9, 200.0 * metal.yield_stress / strain);
  become(c.bodies[0].material.material, metal, stiffness, 0.34);
  c.bodies[0].velocity.radial = speed;
  Simulation s = set_up(c);
  double radius = 0.0;
  const Particles& ps = s.bodies[0].particles;
  const auto mean_radius = [&] {
    double sum = 0.0, mass = 0.0;
    for (int p = 0; p < ps.size; ++p) {
      const double m = ps.load.at(L::Load::mass, p);
      sum += m * ps.motion.at(0, p), mass += m;
    }
    return sum / mass;
  };
  const double start = mean_radius(), time = 3.0 * start * std::expm1(strain) / speed;  // longer than to the stop
  double rate = 1.0, last = start;
  while (rate > 0.0 && s.time < time) {
    run_until(s, s.time + 1e-3 * time);
    const double now = mean_radius();
    rate = now - last, last = now, radius = std::max(radius, now);
  }
  const double got = mean(ps, L::Rest::plastic_strain), warmer = mean(ps, L::Rest::temperature) - 300.0;
  EXPECT_LE(rate, 0.0);
  EXPECT_NEAR(got, strain, one_percent * strain);
  EXPECT_NEAR(std::log(radius / start), strain, one_percent * strain);
  EXPECT_NEAR(warmer, heat, one_percent * heat);
  expect_closed_books(s);
}

TEST(ExpandingRing, CopperStopsWhereItsKineticEnergyIsSpent) {
  check_ring({8930, 90e6, 383}, 100.0, 0.496111);
}
TEST(ExpandingRing, SteelStopsWhereItsKineticEnergyIsSpent) {
  check_ring({7830, 792e6, 477}, 200.0, 0.197727);
}
TEST(ExpandingRing, AluminiumStopsWhereItsKineticEnergyIsSpent) {
  check_ring({2703, 300e6, 896}, 100.0, 0.045050);
}

// Shells -----------------------------------------------------------------------------------------------------------------

/// A shell of inner radius a and outer radius b collapses with v = V (a/r)^n, n = 1 for a cylinder in plane strain and 2 for a
/// sphere, until the inner radius is `stop`.
struct Shell {
  Metal metal;
  double a, b, stop;
  bool sphere;

  /// The speed V for which the kinetic energy is the plastic work to the stop.
  double speed() const {
    constexpr int steps = 20000;
    const double Y = metal.yield_stress, h = (a - stop) / steps;
    double work = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double x = stop + (i + 0.5) * h;
      const double outside = sphere ? std::cbrt(b * b * b - a * a * a + x * x * x) : std::sqrt(b * b - a * a + x * x);
      work += h * std::log(outside / x) *
              (sphere ? 8.0 * std::numbers::pi * Y * x * x : 4.0 * std::numbers::pi / std::numbers::sqrt3 * Y * x);
    }
    const double kinetic = sphere ? 2.0 * std::numbers::pi * metal.density * a * a * a * a * (1.0 / a - 1.0 / b)
                                  : std::numbers::pi * metal.density * a * a * std::log(b / a);
    return std::sqrt(work / kinetic);
  }
};

void check_shell(const Shell& shell, double stiffness, double h, int particles_per_direction, double tabulated) {
  const double V = shell.speed();
  EXPECT_NEAR(V, tabulated, 0.01);
  Case c = shipped_case("expanding_ring");
  become(c.bodies[0].material.material, shell.metal, stiffness, 0.4);
  c.cell_size = h;
  BodyConfig& body = c.bodies[0];
  body.velocity = {}, body.particles_per_direction = particles_per_direction;
  if (shell.sphere) {
    body.shape =
        std::make_shared<const Shape>(Shape{Intersection{{std::make_shared<const Shape>(Shape{Sphere{{}, shell.b, shell.a}}),
                                                          std::make_shared<const Shape>(Shape{Box{{0, 0, 0}, {1, 1, 0}}})}}});
  } else {
    body.shape = std::make_shared<const Shape>(Shape{Box{{shell.a, 0, 0}, {shell.b, h, 0}}});
    BoundaryConfig top = c.boundaries[0];
    top.position = h, top.side = Side::below;
    c.boundaries.push_back(top);
  }
  Simulation s = set_up(c);
  Particles& ps = s.bodies[0].particles;
  // v = -V a^n x/r^(n + 1) and its gradient.
  double mass = 0.0;
  for (int p = 0; p < ps.size; ++p) {
    const double x = ps.motion.at(0, p), y = shell.sphere ? ps.motion.at(1, p) : 0.0, r = std::hypot(x, y);
    const double n = shell.sphere ? 2.0 : 1.0, f = -V * std::pow(shell.a / r, n) / r;
    ps.motion.at(L::Motion::velocity, p) = f * x, ps.motion.at(L::Motion::velocity + 1, p) = f * y;
    const double e[2] = {x / r, y / r};
    for (const int i : {0, 1})
      for (const int j : {0, 1})
        ps.motion.at(L::Motion::affine + 2 * i + j, p) =
            !shell.sphere && (i == 1 || j == 1) ? 0.0 : f * ((i == j ? 1.0 : 0.0) - (n + 1.0) * e[i] * e[j]);
    mass += ps.load.at(L::Load::mass, p);
  }
  begin(s);  // the books open with these velocities
  const double exact_mass = shell.metal.density * (shell.sphere ? (std::pow(shell.b, 3) - std::pow(shell.a, 3)) / 3.0
                                                                : 0.5 * h * (shell.b * shell.b - shell.a * shell.a));
  EXPECT_NEAR(mass, exact_mass, 1e-4 * exact_mass);  // the surface of a sphere is sampled
  // The inner radius from the volume inside: every ring has kept its mass, so r^(n + 1) has changed by the same amount
  // everywhere, which is averaged.
  const auto power = [&](int p) {
    const double x = ps.motion.at(0, p), y = shell.sphere ? ps.motion.at(1, p) : 0.0;
    return shell.sphere ? std::pow(x * x + y * y, 1.5) : x * x;
  };
  const auto id_of = [&](int p) { return ps.id[static_cast<std::size_t>(p)]; };
  std::vector<std::pair<std::uint64_t, double>> before;
  for (int p = 0; p < ps.size; ++p) before.emplace_back(id_of(p), power(p));
  std::sort(before.begin(), before.end());
  const auto inner_radius = [&] {
    double change = 0.0;
    for (int p = 0; p < ps.size; ++p) {
      const auto at = std::lower_bound(before.begin(), before.end(), std::pair{id_of(p), -1e300});
      change += ps.load.at(L::Load::mass, p) * (power(p) - at->second) / mass;
    }
    return shell.sphere ? std::cbrt(std::pow(shell.a, 3) + change) : std::sqrt(shell.a * shell.a + change);
  };
  const double time = 4.0 * (shell.a - shell.stop) / V;
  double least = shell.a, now = shell.a;
  while (now <= least && s.time < time) {
    least = now;
    run_until(s, s.time + 2e-3 * time);
    now = inner_radius();
  }
  EXPECT_GT(now, least);  // it has stopped
  EXPECT_NEAR(least, shell.stop, one_percent * shell.stop);
  expect_closed_books(s);
}

constexpr Metal beryllium{1845, 330e6, 1825}, copper{8930, 90e6, 383};

TEST(CollapsingShell, BerylliumCylinderStopsWhereItsKineticEnergyIsSpent) {
  check_shell({beryllium, 0.08, 0.10, 0.05, false}, 300e9, 1e-3, 3, 417.0786);
}
TEST(CollapsingShell, CopperCylinderStopsWhereItsKineticEnergyIsSpent) {
  check_shell({copper, 0.05, 0.06, 0.03, false}, 123e9, 0.5e-3, 3, 103.5239);
}
TEST(CollapsingShell, BerylliumSphereStopsWhereItsKineticEnergyIsSpent) {
  check_shell({beryllium, 0.08, 0.10, 0.05, true}, 300e9, 2e-3, 2, 545.1447);
}

}  // namespace
}  // namespace brisance::simulator
