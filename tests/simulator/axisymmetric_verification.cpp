// The axisymmetric geometry: uniform expansion up to the axis, and the thick cylinder of Lame.

#include <numbers>

#include "running.hpp"

namespace brisance::simulator {
namespace {

using L = Columns;

std::string name_of(Basis basis) {
  return std::string(choices<Basis>[static_cast<std::size_t>(basis)]);
}
std::string name_of_case(const testing::TestParamInfo<Basis>& tested) {
  return name_of(tested.param);
}

class UniformExpansion : public testing::TestWithParam<Basis> {};

/// A disk of an elastic material whose particles are made to move with v = rate r before each step. With usf the stress follows
/// from these velocities before any force has acted on them: v = rate r at the end of a step, which began at r - v dt.
TEST_P(UniformExpansion, StrainsAlikeUpToTheAxis) {
  constexpr double rate = 40.0, h = 0.1, dt = 1e-4;
  constexpr int steps = 20;
  Case c;
  c.geometry = Geometry::axisymmetric, c.cell_size = h;
  c.numerics.basis = GetParam(), c.numerics.stress_timing = StressTiming::usf;
  BodyConfig body;
  body.name = "disk", body.temperature = 300.0;
  body.shape = std::make_shared<const Shape>(Shape{Cone{{0, 0, 0}, {0, 0.4, 0}, 1.0, 1.0}});
  Material& m = body.material.material;
  m.density = 1000.0;
  m.equation_of_state = equation_of_state::Logarithmic{1000.0, 1e6, 1000.0, 300.0};
  m.shear_modulus = shear_modulus::Constant{5e5};
  m.artificial_viscosity = {0.0, 0.0};
  c.bodies.push_back(body);
  Simulation s = set_up(c);
  Particles& ps = s.bodies[0].particles;
  for (int n = 0; n < steps; ++n) {
    for (int p = 0; p < ps.size; ++p) {
      const double r = ps.motion.at(0, p), l = ps.load.at(L::Load::half_width, p);
      // A uGIMP particle stands for its ring, whose centre of mass is a little outside its middle.
      const double centre = GetParam() == Basis::ugimp ? r + l * l / (3.0 * r) : r;
      ps.motion.at(L::Motion::velocity, p) = rate * centre, ps.motion.at(L::Motion::velocity + 1, p) = 0.0;
      for (int k = 0; k < 4; ++k) ps.motion.at(L::Motion::affine + k, p) = k == 0 ? rate : 0.0;
    }
    ASSERT_EQ(advance(s, dt), StepOutcome::done);
  }
  const double strain = rate / (1.0 - 0.5 * rate * dt) * dt * steps;  // logarithmic, along r and around
  const double mean = 1e6 * 2.0 * strain, shear = 2.0 * 5e5 * strain / 3.0;
  constexpr double round_off = 1e-12;
  double worst = 0.0, worst_F = 0.0, nearest = 1.0;
  for (int p = 0; p < ps.size; ++p) {
    for (const int k : {0, 2}) worst = std::max(worst, std::abs(ps.load.at(L::Load::stress + k, p) / (mean + shear) - 1.0));
    worst = std::max(worst, std::abs(ps.load.at(L::Load::stress + 1, p) / (mean - 2.0 * shear) - 1.0));
    worst = std::max(worst, std::abs(ps.load.at(L::Load::stress + 3, p)) / mean);
    for (const int k : {0, 4})
      worst_F = std::max(worst_F, std::abs(ps.rest.at(L::Rest::deformation_gradient + k, p) / std::exp(strain) - 1.0));
    nearest = std::min(nearest, ps.motion.at(0, p));
  }
  EXPECT_LT(nearest, 0.3 * h);
  EXPECT_LT(worst, round_off);
  EXPECT_LT(worst_F, round_off);
}

INSTANTIATE_TEST_SUITE_P(Bases, UniformExpansion, testing::Values(Basis::quadratic_spline, Basis::ugimp), name_of_case);

// Thick cylinder ---------------------------------------------------------------------------------------------------------

constexpr double inner = 0.5, outer = 1.0, pressure = 1e3;

/// Errors against Lame: root mean square over the wall, in parts of the pressure and of the displacement of the inner surface.
struct LameErrors {
  double stress = 0.0, displacement = 0.0;
  double hoop_inside = 0.0, hoop_outside = 0.0;  // of the outermost particles, over their exact values
};

/// The load rises over ten periods; means over the next ten, with weights that let the rest of the breathing vanish
/// (sin^2), are the state at rest.
LameErrors lame(double h, std::vector<std::string> changes) {
  changes.push_back("cell_size=" + std::to_string(h));
  changes.push_back("solid.0.shape.tube.end=[0, " + std::to_string(h) + "]");
  changes.push_back("boundary.1.position=" + std::to_string(h));
  // Reaches the inner faces of the first particles and not their faces on the planes of symmetry.
  changes.push_back("load.0.region.box.upper=[" + std::to_string(inner + 0.18 * h) + ", 1]");
  const Case c = shipped_case("lame_cylinder", changes);
  Simulation s = set_up(c);
  const double risen = c.loads[0].pressure->x[1];
  const Particles& ps = s.bodies[0].particles;
  const int columns = c.bodies[0].particles_per_direction * static_cast<int>(std::lround((outer - inner) / h));
  struct Row {
    double r0 = 0.0, weight = 0.0, displacement = 0.0, radial = 0.0, hoop = 0.0;
  };
  std::vector<Row> rows(static_cast<std::size_t>(columns));
  run_until(s, c.end_time, [&] {
    if (s.time < risen) return;
    const double part = (s.time - risen) / (c.end_time - risen),
                 w = std::pow(std::sin(std::numbers::pi * part), 2) * s.last_time_step;
    const double spacing = (outer - inner) / columns;
    for (int p = 0; p < ps.size; ++p) {
      const double r = ps.motion.at(0, p);
      const auto k = static_cast<std::size_t>((r - inner) / spacing);
      Row& row = rows.at(k);
      row.r0 = inner + (static_cast<double>(k) + 0.5) * spacing;
      row.weight += w, row.displacement += w * (r - row.r0);
      row.radial += w * ps.load.at(L::Load::stress, p), row.hoop += w * ps.load.at(L::Load::stress + 2, p);
    }
  });
  expect_closed_books(s);
  constexpr double E = 1e9, nu = 0.3;
  const double k = pressure * inner * inner / (outer * outer - inner * inner);
  const auto displacement = [&](double r) { return (1 + nu) / E * k * ((1 - 2 * nu) * r + outer * outer / r); };
  LameErrors e;
  for (Row& row : rows) {
    row.displacement /= row.weight, row.radial /= row.weight, row.hoop /= row.weight;
    const double q = outer * outer / (row.r0 * row.r0);
    e.stress +=
        (std::pow(row.radial - k * (1 - q), 2) + std::pow(row.hoop - k * (1 + q), 2)) / (2.0 * columns * pressure * pressure);
    e.displacement +=
        std::pow(row.displacement / displacement(inner) - displacement(row.r0) / displacement(inner), 2) / columns;
  }
  e.stress = std::sqrt(e.stress), e.displacement = std::sqrt(e.displacement);
  const auto hoop = [&](const Row& row) { return row.hoop / (k * (1 + outer * outer / (row.r0 * row.r0))); };
  e.hoop_inside = hoop(rows.front()), e.hoop_outside = hoop(rows.back());
  return e;
}

class LameCylinder : public testing::TestWithParam<Basis> {};

TEST_P(LameCylinder, ConvergesToTheClosedForm) {
  const std::vector<std::string> basis = {"numerics.basis=\"" + name_of(GetParam()) + "\""};
  const LameErrors coarse = lame(1.0 / 16, basis), fine = lame(1.0 / 32, basis);
  const double order = std::log2(coarse.displacement / fine.displacement),
               stress_order = std::log2(coarse.stress / fine.stress);
  // The stress of the particles at the surfaces is of first order; it is reported, the displacement is what converges.
  EXPECT_GT(order, 1.8);
  RecordProperty("stress_order", std::to_string(stress_order));
  EXPECT_NEAR(fine.hoop_inside, 1.0, 0.02);
  EXPECT_NEAR(fine.hoop_outside, 1.0, 0.02);
  EXPECT_LT(fine.displacement, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Bases, LameCylinder, testing::Values(Basis::quadratic_spline, Basis::ugimp), name_of_case);

}  // namespace
}  // namespace brisance::simulator
