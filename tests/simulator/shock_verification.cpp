// Plane shocks against their jump conditions: impact of plates without strength, and the elastic and plastic wave of a piston.
// The bodies are one cell thick between two planes of symmetry, so the motion is along x.

#include "running.hpp"

namespace brisance::simulator {
namespace {

using L = Columns;

constexpr double one_percent = 0.01;

double pressure(const Particles& ps, int p) {
  return -(ps.load.at(L::Load::stress, p) + ps.load.at(L::Load::stress + 1, p) + ps.load.at(L::Load::stress + 2, p)) / 3.0;
}
double compression(const Particles& ps, int p) {  // normal stress of the wave, positive in compression
  return -ps.load.at(L::Load::stress, p);
}
double velocity(const Particles& ps, int p) {
  return ps.motion.at(L::Motion::velocity, p);
}
double density(const Particles& ps, int p) {
  return ps.load.at(L::Load::density, p);
}
double temperature(const Particles& ps, int p) {
  return ps.rest.at(L::Rest::temperature, p);
}

using Quantity = double (*)(const Particles&, int);

/// Particles of all bodies with from < x < to: mean and largest value.
struct Range {
  double mean = 0.0, most = -1e300;
  int count = 0;
};
Range range(const Simulation& s, double from, double to, Quantity f) {
  Range r;
  for (const Body& body : s.bodies)
    for (int p = 0; p < body.particles.size; ++p) {
      const double x = body.particles.motion.at(0, p);
      if (x <= from || x >= to) continue;
      const double value = f(body.particles, p);
      r.mean += value, r.most = std::max(r.most, value), ++r.count;
    }
  r.mean /= r.count;
  return r;
}

/// Where, coming from large x, a quantity first reaches a level (between two particles by linear interpolation).
double front(const Simulation& s, double level, Quantity f) {
  std::vector<std::pair<double, double>> profile;
  for (const Body& body : s.bodies)
    for (int p = 0; p < body.particles.size; ++p) profile.emplace_back(body.particles.motion.at(0, p), f(body.particles, p));
  std::sort(profile.begin(), profile.end());
  for (std::size_t i = profile.size() - 1; i > 0; --i) {
    const auto [x0, v0] = profile[i - 1];
    const auto [x1, v1] = profile[i];
    if (v0 >= level) return x1 > x0 ? x0 + (x1 - x0) * (v0 - level) / (v0 - v1) : x0;
  }
  return 0.0;
}

// Plates without strength ------------------------------------------------------------------------------------------------

/// A metal with the Hugoniot Us = c0 + s up.
struct Hugoniot {
  double density, sound_speed, slope, gruneisen, specific_heat, temperature;

  double pressure(double u) const { return density * (sound_speed + slope * u) * u; }
  double shock_speed(double u) const { return sound_speed + slope * u; }
  double density_behind(double u) const { return density / (1.0 - u / shock_speed(u)); }
  /// Runge-Kutta along the Hugoniot: cv dT = -rho Gamma cv T dV + ((V0 - V) dp + p dV)/2, rho Gamma constant.
  double temperature_behind(double u) const {
    const double V0 = 1.0 / density, V = 1.0 / density_behind(u);
    const auto slope_of = [&](double v, double T) {
      const double x = 1.0 - v / V0, q = 1.0 - slope * x, k = density * sound_speed * sound_speed;
      const double p = k * x / (q * q), dp = -k * (1.0 + slope * x) / (q * q * q) / V0;
      return -gruneisen / V0 * T + ((V0 - v) * dp + p) / (2.0 * specific_heat);
    };
    constexpr int steps = 2000;
    const double h = (V - V0) / steps;
    double v = V0, T = temperature;
    for (int i = 0; i < steps; ++i, v += h) {
      const double k1 = slope_of(v, T), k2 = slope_of(v + h / 2, T + h / 2 * k1), k3 = slope_of(v + h / 2, T + h / 2 * k2),
                   k4 = slope_of(v + h, T + h * k3);
      T += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return T;
  }
};
constexpr Hugoniot copper{8930, 3940, 1.489, 2.02, 383, 294};
constexpr Hugoniot aluminium{2703, 5386, 1.339, 1.99, 896, 294};

/// Velocity of the face on which a flyer presses a target at rest: equal pressures by bisection.
double interface_velocity(const Hugoniot& flyer, const Hugoniot& target, double speed) {
  double low = 0.0, high = speed;
  for (int i = 0; i < 200; ++i) {
    const double u = 0.5 * (low + high);
    (flyer.pressure(speed - u) > target.pressure(u) ? low : high) = u;
  }
  return low;
}

/// A shipped material with the Hugoniot of another metal.
void follow(Material& material, const Hugoniot& m) {
  material.density = m.density;
  material.equation_of_state =
      equation_of_state::MieGruneisenEnergy{m.density, m.sound_speed, m.slope, m.gruneisen, m.specific_heat, m.temperature};
  material.specific_heat = specific_heat::Constant{m.specific_heat};
}

constexpr double most_overshoot = 0.10;  // of the pressure, by the artificial viscosity's choice
constexpr double warmest = 3.0;          // K, between the temperature behind the shock and that of the Hugoniot
// Where the plates met, the shock was not yet formed and the artificial viscosity has heated the first cells too much ("wall
// heating"); the cells around the face are no part of the plateau, nor are those in which the shock stands.
constexpr double around_face = 8.0, around_shock = 12.0;  // cells
constexpr double formed = 30.0;                           // cells that a shock has run before it is taken for formed

void check_impact(Case c, const Hugoniot& flyer, const Hugoniot& target, double speed) {
  follow(c.bodies[0].material.material, flyer), follow(c.bodies[1].material.material, target);
  const double u = interface_velocity(flyer, target, speed), p = target.pressure(u), h = c.cell_size;
  Simulation s = set_up(c);
  const double drift = c.bodies[1].velocity.translation[0];  // of the target
  double overshoot = 0.0;
  const auto look_for_overshoot = [&] {
    if (s.time * target.shock_speed(u) < formed * h) return;
    overshoot = std::max(overshoot, range(s, (u + drift) * s.time + around_face * h, 1.0, pressure).most / p - 1.0);
  };
  run_until(s, 0.5 * c.end_time, look_for_overshoot);
  const double first = front(s, 0.5 * p, pressure), first_time = s.time;
  run_until(s, c.end_time, look_for_overshoot);
  const double last = front(s, 0.5 * p, pressure), shock_speed = (last - first) / (s.time - first_time) - drift;

  const double face = (u + drift) * s.time, from = face + around_face * h, to = last - around_shock * h;
  ASSERT_GT(to - from, 40.0 * h);
  const double back = face - around_face * h,
               flyer_front = (speed + drift) * s.time - flyer.shock_speed(speed - u) * s.time + around_shock * h;
  const Range p_t = range(s, from, to, pressure), u_t = range(s, from, to, velocity), T_t = range(s, from, to, temperature),
              rho_t = range(s, from, to, density), p_f = range(s, flyer_front, back, pressure),
              u_f = range(s, flyer_front, back, velocity), T_f = range(s, flyer_front, back, temperature);
  EXPECT_NEAR(p_t.mean, p, one_percent * p);
  EXPECT_NEAR(p_f.mean, p, one_percent * p);
  EXPECT_NEAR(u_t.mean - drift, u, one_percent * u);
  EXPECT_NEAR(u_f.mean - drift, u, one_percent * u);
  EXPECT_NEAR(rho_t.mean, target.density_behind(u), one_percent * target.density_behind(u));
  EXPECT_NEAR(shock_speed, target.shock_speed(u), one_percent * target.shock_speed(u));
  EXPECT_NEAR(T_t.mean, target.temperature_behind(u), warmest);
  EXPECT_NEAR(T_f.mean, flyer.temperature_behind(speed - u), warmest);
  EXPECT_LT(overshoot, most_overshoot);
  expect_closed_books(s);
}

TEST(PlateImpact, CopperOnCopperFollowsTheHugoniot) {
  EXPECT_NEAR(copper.pressure(250.0), 9.62710e9, 1e4);  // the tabulated states
  EXPECT_NEAR(copper.temperature_behind(250.0), 335.47, 0.01);
  check_impact(shipped_case("plate_impact_copper"), copper, copper, 500.0);
}

TEST(PlateImpact, CopperOnAluminiumMatchesTheImpedances) {
  const double u = interface_velocity(copper, aluminium, 500.0);
  EXPECT_NEAR(u, 350.676, 0.001);
  EXPECT_NEAR(aluminium.pressure(u), 5.55034e9, 1e4);
  check_impact(shipped_case("plate_impact_copper", {"solid.1.shape.box.upper=[0.03, 0.0001]"}), copper, aluminium, 500.0);
}

// Behind a shock the particles stand closer than they were laid. The beat of their spacing with that of the grid moves with the
// shock, where the metal behind it moves against the grid, and so rings; where that metal is at rest the beat is at rest too
// and half the particles do.
std::vector<std::string> centred(double speed) {
  const std::string half = std::to_string(0.5 * speed);
  return {"solid.0.velocity=[" + half + ", 0]", "solid.1.velocity=[-" + half + ", 0]", "solid.0.particles_per_direction=2",
          "solid.1.particles_per_direction=2"};
}

TEST(PlateImpact, PlatesThatStopEachOtherNeedFewerParticles) {
  check_impact(shipped_case("plate_impact_copper", centred(500.0)), copper, copper, 500.0);
}

TEST(PlateImpact, StrongerShockFollowsTheHugoniot) {
  EXPECT_NEAR(copper.pressure(500.0), 20.91629e9, 1e4);  // the tabulated state
  check_impact(shipped_case("plate_impact_copper", centred(1000.0)), copper, copper, 1000.0);
}

// Elastic-plastic piston -------------------------------------------------------------------------------------------------

/// Two waves that a piston sends into an elastic, perfectly plastic half space at rest, in uniaxial strain: jump conditions of
/// each, deviator -(4/3) G ln(rho/rho0) up to 2 Y/3, pressure on Us = c0 + s up with rho Gamma constant.
struct TwoWaves {
  double stress1, velocity1, speed1, density1;  // behind the elastic wave
  double stress2, speed2, density2;             // behind the plastic one
};
struct ElasticPlastic {
  double density, sound_speed, slope, gruneisen, shear_modulus, yield_stress;

  TwoWaves piston(double speed) const {
    const double r0 = density, Y = yield_stress;
    struct Jump {
      double stress, energy;
    };
    const auto behind = [&](double ra, const Jump& a, double rb) {
      const double dv = 1 / ra - 1 / rb, x = 1 - r0 / rb, q = 1 - slope * x, ph = r0 * sound_speed * sound_speed * x / (q * q),
                   eh = ph * x / (2 * r0), k = gruneisen * r0;
      const double stress = (ph + k * (a.energy + 0.5 * a.stress * dv - eh) + 2 * Y / 3) / (1 - 0.5 * k * dv);
      return Jump{stress, a.energy + 0.5 * (a.stress + stress) * dv};
    };
    TwoWaves w{};
    w.density1 = r0 * std::exp(Y / (2 * shear_modulus));
    const Jump one = behind(r0, {0, 0}, w.density1);
    w.stress1 = one.stress, w.velocity1 = std::sqrt(one.stress * (1 / r0 - 1 / w.density1));
    w.speed1 = w.velocity1 * w.density1 / (w.density1 - r0);
    double low = w.density1, high = 2.5 * w.density1;
    for (int i = 0; i < 200; ++i) {
      const double r = 0.5 * (low + high);
      const double u =
          w.velocity1 + std::sqrt(std::max(0.0, (behind(w.density1, one, r).stress - w.stress1) * (1 / w.density1 - 1 / r)));
      (u < speed ? low : high) = r;
    }
    w.density2 = low, w.stress2 = behind(w.density1, one, low).stress;
    w.speed2 = w.velocity1 + (speed - w.velocity1) * low / (low - w.density1);
    return w;
  }
};

/// The plate comes with the piston's speed and is stopped; seen from it the piston comes.
void check_piston(Case c, const ElasticPlastic& m, double speed) {
  const TwoWaves w = m.piston(speed);
  Material& material = c.bodies[0].material.material;
  material.density = m.density;
  material.equation_of_state = equation_of_state::MieGruneisenEnergy{m.density, m.sound_speed, m.slope, m.gruneisen, 383, 300};
  material.shear_modulus = shear_modulus::Constant{m.shear_modulus};
  material.flow_stress = flow_stress::LinearHardening{m.yield_stress, 0.0};
  c.bodies[0].velocity.translation = {-speed, 0, 0};
  Simulation s = set_up(c);
  const double h = c.cell_size, level1 = 0.5 * w.stress1, level2 = 0.5 * (w.stress1 + w.stress2);
  run_until(s, 0.5 * c.end_time);
  const double t = s.time, elastic0 = front(s, level1, compression), plastic0 = front(s, level2, compression);
  run_until(s, c.end_time);
  const double elastic = front(s, level1, compression), plastic = front(s, level2, compression);
  // Wave speeds relative to the plate before impact.
  const double D1 = (elastic - elastic0) / (s.time - t) + speed, D2 = (plastic - plastic0) / (s.time - t) + speed;
  const double gap = elastic - plastic;
  ASSERT_GT(gap, 40.0 * h);
  const auto plateau1 = [&](Quantity f) { return range(s, plastic + 0.35 * gap, plastic + 0.75 * gap, f); };
  const auto plateau2 = [&](Quantity f) { return range(s, around_face * h, plastic - around_shock * h, f); };
  EXPECT_NEAR(plateau1(compression).mean, w.stress1, one_percent * w.stress1);
  EXPECT_NEAR(plateau1(velocity).mean + speed, w.velocity1, one_percent * w.velocity1);
  EXPECT_NEAR(D1, w.speed1, one_percent * w.speed1);
  EXPECT_NEAR(plateau2(compression).mean, w.stress2, one_percent * w.stress2);
  EXPECT_NEAR(plateau2(density).mean - m.density, w.density2 - m.density, one_percent * (w.density2 - m.density));
  EXPECT_NEAR(plateau2(velocity).mean, 0.0, one_percent * speed);
  EXPECT_NEAR(D2, w.speed2, one_percent * w.speed2);
  expect_closed_books(s);
}

TEST(ElasticPlasticPiston, CopperCarriesTwoWaves) {
  const ElasticPlastic m{8930, 3940, 1.49, 2.0, 45e9, 90e6};
  const TwoWaves w = m.piston(20.0);
  EXPECT_NEAR(w.stress1, 0.1990301e9, 1e3);  // the tabulated states
  EXPECT_NEAR(w.stress2, 0.7415910e9, 1e3);
  check_piston(shipped_case("elastoplastic_piston"), m, 20.0);
}

TEST(ElasticPlasticPiston, AluminiumPlatesAt800MetresPerSecondCarryTwoWaves) {
  const ElasticPlastic m{2785, 5328, 1.338, 2.0, 27.6e9, 300e6};
  const TwoWaves w = m.piston(400.0);
  EXPECT_NEAR(w.stress1, 0.6358785e9, 1e3);
  EXPECT_NEAR(w.stress2, 6.635879e9, 1e4);
  check_piston(shipped_case("elastoplastic_piston", {"end_time=8 us"}), m, 400.0);
}

}  // namespace
}  // namespace brisance::simulator
