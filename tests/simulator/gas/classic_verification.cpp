// The classic scheme: its exchange, which is exact, and its weaknesses, which are what it is kept to show.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "simulator/gas/classic.hpp"
#include "simulator/gas/exchange.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;
constexpr double round_off = 1e-14;

// Exchange -------------------------------------------------------------------------------------------------------------

struct Mixture {
  std::vector<double> masses, parts, velocities;
};
const std::vector<Mixture> mixtures = {{{1.2, 900.0}, {0.4, 0.6}, {300.0, -20.0}},
                                       {{1.0, 2.0, 500.0, 1e-3}, {0.1, 0.3, 0.2, 0.4}, {100.0, -50.0, 3.0, 1e3}}};

double momentum_of(const Mixture& m, const std::vector<double>& velocities) {
  double sum = 0.0;
  for (std::size_t r = 0; r < m.masses.size(); ++r) sum += m.masses[r] * velocities[r];
  return sum;
}

TEST(Exchange, WithoutBoundsGivesAllTheMeanVelocity) {
  for (const Mixture& m : mixtures) {
    constexpr double drag = 1e15;
    std::vector<double> u = m.velocities;
    exchange<double>(u, m.masses, m.parts, drag);
    double mass = 0.0, scale = 0.0;
    for (std::size_t r = 0; r < u.size(); ++r) mass += m.masses[r], scale += std::abs(m.masses[r] * m.velocities[r]);
    const double mean = momentum_of(m, m.velocities) / mass;
    EXPECT_NEAR(momentum_of(m, u), momentum_of(m, m.velocities), round_off * scale);
    constexpr double slip = 1e-10;  // what is left after the time that so strong a drag needs: M/(drag)
    for (const double v : u) EXPECT_NEAR(v, mean, slip * scale / mass);
  }
}

/// Two fluids: the difference decays as exp(-g theta_1 theta_2 (1/M_1 + 1/M_2) t); the implicit step is first order.
TEST(Exchange, OfTwoRelaxesAsInClosedForm) {
  const Mixture m{{1.0, 3.0}, {0.25, 0.75}, {10.0, -2.0}};
  const double rate = 0.25 * 0.75 * (1.0 + 1.0 / 3.0), exact = 12.0 * std::exp(-rate);
  std::vector<double> errors;
  for (const int steps : {100, 200}) {
    std::vector<double> u = m.velocities;
    for (int n = 0; n < steps; ++n) {
      const double before = momentum_of(m, u);
      exchange<double>(u, m.masses, m.parts, 1.0 / steps);
      EXPECT_NEAR(momentum_of(m, u), before, round_off * 16.0);
    }
    errors.push_back(std::abs(u[0] - u[1] - exact));
  }
  EXPECT_LT(errors[1], 1e-3 * exact);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1.0, 0.02);
}

/// Four fluids against the linear system of all pairs, integrated in very small explicit steps.
TEST(Exchange, OfFourFollowsTheLawOfPairs) {
  const Mixture& m = mixtures[1];
  constexpr double drag = 1e-3, time = 1.0;
  constexpr int fine = 200'000;
  std::vector<double> exact = m.velocities;
  for (int n = 0; n < fine; ++n) {
    std::vector<double> rate(4, 0.0);
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t s = 0; s < 4; ++s) rate[r] += drag * m.parts[r] * m.parts[s] * (exact[s] - exact[r]) / m.masses[r];
    for (std::size_t r = 0; r < 4; ++r) exact[r] += time / fine * rate[r];
  }
  std::vector<double> u = m.velocities;
  constexpr int steps = 2000;
  for (int n = 0; n < steps; ++n) exchange<double>(u, m.masses, m.parts, drag * time / steps);
  for (std::size_t r = 0; r < 4; ++r) EXPECT_NEAR(u[r], exact[r], 1e-4 * (std::abs(exact[r]) + std::abs(m.velocities[r])));
}

// The scheme -----------------------------------------------------------------------------------------------------------

struct Tube {
  GasState left, right;
  double diaphragm, time;
};
const Tube sod{{1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 0.5, 0.2};
const Tube strong{{1.0, 0.0, 1000.0}, {1.0, 0.0, 0.01}, 0.5, 0.012};

struct Outcomes {
  double density_error, energy_drift, mass_drift;
};
Outcomes run(const Tube& tube, int cells, bool classic) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0}, {set_up::ideal_gas()}, *domain);
  if (classic) gas.classic.emplace();
  fill(
      gas,
      [&](const Vector& x, double) {
        const GasState& w = x[0] < tube.diaphragm ? tube.left : tube.right;
        return Filling{0, w.density, w.pressure, {}};
      },
      *domain);
  const Totals before = totals(gas, *domain);
  Stepper{.courant = 0.4}.to(gas, tube.time, *domain);
  const Totals after = totals(gas, *domain);
  const ExactRiemann exact(tube.left, tube.right);
  const GasState e =
      set_up::mean_errors(gas, [&](double from, double to) { return exact.average(from, to, tube.time, tube.diaphragm); });
  return {e.density, after.energy / before.energy - 1.0, after.mass[0] / before.mass[0] - 1.0};
}

/// Half of an order at Sod's tube, and a part of the energy that no refinement brings back. What the prototype of the
/// same equations has lost was 0.3 to 0.4 %.
TEST(ClassicScheme, OfSodLosesEnergyAtEveryResolution) {
  double last_error = 0.0;
  for (const int cells : {100, 200, 400}) {
    const Outcomes o = run(sod, cells, true);
    RecordProperty("sod_" + std::to_string(cells), std::to_string(o.density_error) + " " + std::to_string(o.energy_drift));
    EXPECT_LT(std::abs(o.mass_drift), 1e-13);
    EXPECT_LT(o.energy_drift, -1e-3);
    EXPECT_GT(o.energy_drift, -1e-2);
    if (last_error > 0.0) {
      EXPECT_LT(std::log2(last_error / o.density_error), 0.8);
    }
    last_error = o.density_error;
  }
  EXPECT_LT(last_error, 0.01);
}

TEST(ClassicScheme, DoesNotConvergeAtAStrongShockWhereTheConservativeDoes) {
  std::vector<Outcomes> classic, conservative;
  for (const int cells : {100, 200, 400}) {
    classic.push_back(run(strong, cells, true)), conservative.push_back(run(strong, cells, false));
    RecordProperty("strong_" + std::to_string(cells), std::to_string(classic.back().density_error) + " " +
                                                          std::to_string(classic.back().energy_drift) + "; " +
                                                          std::to_string(conservative.back().density_error));
    EXPECT_LT(classic.back().energy_drift, -0.01);
    EXPECT_LT(std::abs(conservative.back().energy_drift), 1e-13);
  }
  EXPECT_GT(classic[2].density_error, 0.9 * classic[0].density_error);
  EXPECT_LT(conservative[2].density_error, 0.35 * conservative[0].density_error);
}

/// A slab of another gas, carried along: with a boundless drag both fluids keep one velocity and one pressure.
TEST(ClassicScheme, CarriesTwoFluidsAtOneVelocity) {
  constexpr int cells = 50;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0},
                        {set_up::ideal_gas(1.4), {"other", equation_of_state::IdealGas{1.6, 1.0}}}, *domain);
  gas.edges.assign(2, set_up::around());
  gas.classic.emplace();
  fill(
      gas,
      [&](const Vector& x, double) {
        return x[0] > 0.3 && x[0] < 0.6 ? Filling{1, 4.0, 1.0, {1.0, 0.0, 0.0}} : Filling{0, 1.0, 1.0, {1.0, 0.0, 0.0}};
      },
      *domain);
  const Totals before = totals(gas, *domain);
  Stepper{.courant = 0.4}.to(gas, 1.0, *domain);
  const Totals after = totals(gas, *domain);
  for (std::size_t r = 0; r < 2; ++r) EXPECT_LT(set_up::relative_change(before.mass[r], after.mass[r]), 1e-13);
  EXPECT_LT(set_up::relative_change(before.momentum[0], after.momentum[0]), 1e-12);
  double slip = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const auto of = [&](int fluid, int quantity) {
      return gas.classic->state.cell(c.block, ClassicState::of(1, fluid, quantity), c.number);
    };
    const auto velocity = [&](int fluid) { return of(fluid, ClassicState::momentum) / of(fluid, ClassicState::mass); };
    if (of(0, ClassicState::volume) < 1e-6 || of(1, ClassicState::volume) < 1e-6) return;
    slip = std::max(slip, std::abs(velocity(0) - velocity(1)));
  });
  RecordProperty("slip", std::to_string(slip));
  EXPECT_LT(slip, 1e-9);
}

TEST(ClassicScheme, KeepsMassAndBooksThePushOfWalls) {
  for (const Geometry geometry : {Geometry::planar_1d, Geometry::plane, Geometry::three_dimensional}) {
    const auto domain = single_process();
    Gas gas = set_up::box(geometry, 0.1, {}, {14, 12, 10},
                          {set_up::ideal_gas(1.4), {"other", equation_of_state::IdealGas{1.6, 1.0}}}, *domain);
    gas.classic.emplace();
    fill(
        gas,
        [](const Vector& x, double) {
          return x[0] < 0.6 && x[1] < 0.5 ? Filling{1, 4.0, 3.0, {0.5, 0.1, -0.2}} : Filling{0, 1.0, 1.0, {}};
        },
        *domain);
    const Totals before = totals(gas, *domain);
    Stepper{.courant = 0.4}.steps(gas, 40, *domain);
    const Totals after = totals(gas, *domain);
    for (std::size_t r = 0; r < 2; ++r) EXPECT_LT(set_up::relative_change(before.mass[r], after.mass[r]), 1e-13);
    const std::vector<Totals> walls = passed(gas, *domain);
    for (std::size_t a = 0; a < static_cast<std::size_t>(gas.dimensions()); ++a) {
      double impulse = before.momentum[a], scale = 0.0;
      for (const Totals& wall : walls) impulse += wall.momentum[a], scale += std::abs(wall.momentum[a]);
      EXPECT_NEAR(after.momentum[a], impulse, 1e-13 * scale);
    }
  }
}

TEST(ClassicScheme, GoesOnAfterARestartAsWithoutIt) {
  const auto domain = single_process();
  const auto start = [&] {
    Gas gas = set_up::box(Geometry::plane, 0.1, {}, {16, 8, 0},
                          {set_up::ideal_gas(1.4), {"other", equation_of_state::IdealGas{1.6, 1.0}}}, *domain);
    gas.classic.emplace();
    fill(
        gas,
        [](const Vector& x, double) {
          return x[0] < 0.5 ? Filling{1, 4.0, 2.0, {}} : Filling{0, 1.0, 1.0, {}};
        },
        *domain);
    return gas;
  };
  Gas gas = start(), again = start();
  Stepper().steps(gas, 10, *domain);
  restore(again, numbers_of(gas), *domain);
  Stepper().steps(gas, 5, *domain), Stepper().steps(again, 5, *domain);
  EXPECT_EQ(numbers_of(gas), numbers_of(again));
}

TEST(ClassicScheme, RefusesWhatItCannotDo) {
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::axisymmetric, 0.1, {}, {8, 8, 0}, {set_up::ideal_gas()}, *domain);
  gas.classic.emplace(), gas.gravity[1] = -9.81;
  try {
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.0, 1.0, {}};
        },
        *domain);
    FAIL() << "it has been taken";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("round"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("gravity"), std::string::npos);
  }
}

}  // namespace
}  // namespace brisance::simulator::gas
