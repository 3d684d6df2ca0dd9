// Viscosity, conduction and the exchange of heat against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/transport.hpp"
#include "tests/simulator/gas/set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

constexpr double gamma_of_air = 1.4;

Fluid viscous_gas(double viscosity, double bulk_viscosity = 0.0, double conductivity = 0.0) {
  Fluid fluid = set_up::ideal_gas(gamma_of_air);  // its cv is 1 J/(kg K)
  fluid.viscosity = viscosity, fluid.bulk_viscosity = bulk_viscosity, fluid.conductivity = conductivity;
  return fluid;
}
Edge sticking(const Vector& velocity, std::optional<double> temperature = {}) {
  Edge edge = set_up::beyond(EdgeKind::no_slip, Filling{0, 0.0, 0.0, velocity});
  edge.temperature = temperature;
  return edge;
}

/// The largest and the mean error of a velocity component, over the largest exact value.
struct Errors {
  double largest = 0.0, mean = 0.0;
};
template <class Exact>
Errors errors_of(const Gas& gas, std::size_t component, double scale, Exact&& exact) {
  Errors e;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const double error = std::abs(c.velocity[component] - exact(c.centre)) / scale;
    e.largest = std::max(e.largest, error), e.mean += error / static_cast<double>(gas.cells.count());
  });
  return e;
}

// Shear ----------------------------------------------------------------------------------------------------------------

/// Between a wall at rest and one that moves, started from rest: the series of Batchelor, An Introduction to Fluid Dynamics,
/// section 4.3.
double couette(double y, double width, double speed, double kinematic_viscosity, double time) {
  double u = speed * y / width;
  for (int n = 1; n < 200; ++n)
    u += 2.0 * speed / (n * M_PI) * (n % 2 == 0 ? 1.0 : -1.0) *
         std::exp(-std::pow(n * M_PI / width, 2) * kinematic_viscosity * time) * std::sin(n * M_PI * y / width);
  return u;
}

TEST(Couette, StartsAndComesToItsStraightProfile) {
  constexpr double speed = 0.01, viscosity = 0.1, width = 1.0;
  for (const double time : {0.5, 8.0}) {
    std::vector<double> errors;
    for (const int cells : {8, 16}) {
      const auto domain = single_process();
      Gas gas = set_up::box(Geometry::plane, width / cells, {}, {4, cells, 0}, {viscous_gas(viscosity)}, *domain);
      gas.edges = {set_up::around(), set_up::around(), sticking({}), sticking({speed, 0.0, 0.0})};
      fill(
          gas,
          [](const Vector&, double) {
            return Filling{0, 1.0, 1.0, {}};
          },
          *domain);
      Stepper().to(gas, time, *domain);
      errors.push_back(
          errors_of(gas, 0, speed, [&](const Vector& x) { return couette(x[1], width, speed, viscosity, time); }).largest);
    }
    RecordProperty("error_at_" + std::to_string(time), std::to_string(errors[0]) + " " + std::to_string(errors[1]));
    if (time < 1.0)
      EXPECT_GE(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << ", " << errors[1];
    else
      EXPECT_LT(errors[1], 1e-3);  // the straight line is exact; what is left has not died away
  }
}

TEST(Poiseuille, FallsBetweenWallsWithAParabola) {
  constexpr double viscosity = 0.1, width = 1.0, pull = 0.01;
  std::vector<double> errors;
  for (const int cells : {8, 16}) {
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::plane, width / cells, {}, {4, cells, 0}, {viscous_gas(viscosity)}, *domain);
    gas.edges = {set_up::around(), set_up::around(), sticking({}), sticking({})};
    gas.gravity[0] = pull;
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.0, 1.0, {}};
        },
        *domain);
    Stepper().to(gas, 10.0, *domain);
    errors.push_back(errors_of(gas, 0, pull * width * width / (8.0 * viscosity), [&](const Vector& x) {
                       return 0.5 * pull / viscosity * x[1] * (width - x[1]);
                     }).largest);
  }
  RecordProperty("errors", std::to_string(errors[0]) + " " + std::to_string(errors[1]));
  EXPECT_LT(errors[1], 0.01);
  EXPECT_GE(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << ", " << errors[1];
}

/// Along a pipe: the viscous force about the axis.
TEST(Poiseuille, FallsThroughAPipe) {
  constexpr double viscosity = 0.1, radius = 1.0, pull = 0.01;
  constexpr int cells = 12;
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::axisymmetric, radius / cells, {}, {cells, 4, 0}, {viscous_gas(viscosity)}, *domain);
  gas.edges = {set_up::wall(), sticking({}), set_up::around(), set_up::around()};
  gas.gravity[1] = pull;
  fill(
      gas,
      [](const Vector&, double) {
        return Filling{0, 1.0, 1.0, {}};
      },
      *domain);
  Stepper().to(gas, 10.0, *domain);
  const double error = errors_of(gas, 1, pull * radius * radius / (4.0 * viscosity), [&](const Vector& x) {
                         return 0.25 * pull / viscosity * (radius * radius - x[0] * x[0]);
                       }).largest;
  RecordProperty("error", std::to_string(error));
  EXPECT_LT(error, 0.01);
}

/// A wave of shear fades with nu k^2; oblique to the grid every component of the stress takes part.
TEST(ShearWave, FadesAtItsRate) {
  constexpr double viscosity = 0.02, height = 1e-3;
  for (const bool oblique : {false, true}) {
    std::vector<double> errors;
    for (const int cells : {16, 32}) {
      const auto domain = single_process();
      Gas gas = set_up::box(Geometry::plane, 1.0 / cells, {}, {cells, cells, 0}, {viscous_gas(viscosity)}, *domain);
      gas.edges.assign(4, set_up::around());
      const Vector k = oblique ? Vector{2.0 * M_PI, 2.0 * M_PI, 0.0} : Vector{0.0, 2.0 * M_PI, 0.0};
      const double size = std::hypot(k[0], k[1]);
      fill(
          gas,
          [&](const Vector& x, double) {
            const double u = height * std::sin(k[0] * x[0] + k[1] * x[1]);
            return Filling{0, 1.0, 1.0, {u * k[1] / size, -u * k[0] / size, 0.0}};
          },
          *domain);
      const double before = totals(gas, *domain).kinetic;
      constexpr double time = 0.25;
      Stepper{.courant = 0.02}.to(gas, time, *domain);  // in time the stresses are first order
      const double rate = -0.5 * std::log(totals(gas, *domain).kinetic / before) / time;
      errors.push_back(std::abs(rate / (viscosity * size * size) - 1.0));
    }
    RecordProperty(oblique ? "oblique" : "along", std::to_string(errors[0]) + " " + std::to_string(errors[1]));
    EXPECT_LT(errors[1], 0.005);
    EXPECT_GE(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << ", " << errors[1];
  }
}

/// Gas that expands alike in all directions has one stress everywhere, hoop stress and all: no force.
TEST(UniformExpansion, FeelsNoViscousForce) {
  constexpr double round_off = 1e-12, dt = 1.0;
  for (const Geometry geometry : {Geometry::planar_1d, Geometry::cylindrical_1d, Geometry::spherical_1d, Geometry::plane,
                                  Geometry::axisymmetric, Geometry::three_dimensional}) {
    const int D = number_of_dimensions(geometry);
    const auto domain = single_process();
    Gas gas = set_up::box(geometry, 0.1, {}, {D == 1 ? 40 : 12, 12, 12}, {viscous_gas(0.3, 0.2)}, *domain);
    fill(
        gas,
        [](const Vector& x, double) {
          return Filling{0, 1.0, 1.0, x};
        },
        *domain);
    apply_transport(gas, dt);
    double strongest = 0.0;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      for (int a = 0; a < D; ++a)
        if (c.index[static_cast<std::size_t>(a)] >= (D == 1 ? 38 : 10)) return;  // feels the wall
      for (int a = 0; a < D; ++a)
        strongest = std::max(strongest, std::abs(gas.moved.cell(c.block, Content::momentum + a, c.number) -
                                                 gas.content.cell(c.block, Content::momentum + a, c.number)) /
                                            (dt * 0.3 * c.volume / 0.1));
    });
    EXPECT_LT(strongest, round_off) << D;
  }
}

// Heat -----------------------------------------------------------------------------------------------------------------

/// Heat from a wall into gas that hardly expands: its gamma is next to 1.
TEST(Conduction, IntoALayerFollowsTheErrorFunction) {
  constexpr double conductivity = 0.01, cold = 1.0, hot = 1.001, time = 1.0;
  std::vector<double> errors;
  for (const int cells : {25, 50, 100}) {
    const auto domain = single_process();
    Fluid fluid{"gas", equation_of_state::IdealGas{1.0 + 1e-6, 1.0}};
    fluid.conductivity = conductivity;
    Gas gas = set_up::box(Geometry::planar_1d, 1.0 / cells, {}, {cells, 0, 0}, {fluid}, *domain);
    gas.edges[0] = sticking({}, hot);
    fill(
        gas,
        [&](const Vector&, double) {
          return Filling{0, 1.0, 1e-6 * cold, {}};
        },
        *domain);
    Stepper().to(gas, time, *domain);
    double sum = 0.0;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      const double temperature = c.pressure / (1e-6 * c.density);
      const double exact = std::erfc(c.centre[0] / std::sqrt(4.0 * conductivity * time));
      sum += std::abs((temperature - cold) / (hot - cold) - exact) / cells;
    });
    errors.push_back(sum);
  }
  RecordProperty("errors", std::to_string(errors[0]) + " " + std::to_string(errors[1]) + " " + std::to_string(errors[2]));
  EXPECT_LT(errors[1], 1e-3);
  EXPECT_GE(std::log2(errors[1] / errors[2]), 1.8);
}

/// Two gases of one gamma keep their pressure, so with heat capacities at constant pressure their temperatures come together as
/// exp(-H theta_1 theta_2 (1/C_1 + 1/C_2) t), or all at once if the steps are longer than that.
TEST(HeatExchange, BringsTwoFluidsToOneTemperature) {
  for (const double coefficient : {1.0, 1e12}) {
    const auto domain = single_process();
    Gas gas = set_up::box(
        Geometry::planar_1d, 0.1, {}, {16, 0, 0},
        {{"hot", equation_of_state::IdealGas{1.4, 700.0}}, {"cold", equation_of_state::IdealGas{1.4, 1400.0}}}, *domain);
    gas.heat_exchange = coefficient;
    fill(
        gas,
        [](const Vector&, double) {
          return Filling{0, 1.0, 1e5, {}};
        },
        *domain);
    // Half of each cell becomes the second fluid at the same pressure.
    const auto block = static_cast<std::size_t>(gas.cells.mine[0]);
    for (int c = 0; c < 64; ++c) {
      const double cell_volume = gas.content.cell(block, Content::cell_volume, c),
                   energy = gas.content.cell(block, Content::energy, c);
      for (int r = 0; r < 2; ++r) {
        gas.content.cell(block, Content::of(1, r, Content::mass), c) = cell_volume * (r == 0 ? 0.3 : 0.6);
        gas.content.cell(block, Content::of(1, r, Content::volume), c) = 0.5 * cell_volume;
        gas.content.cell(block, Content::of(1, r, Content::internal), c) = 0.5 * energy;
      }
    }
    begin(gas, *domain);
    const auto difference = [&] {
      const auto t = [&](int r, double cv) {
        return gas.content.cell(block, Content::of(1, r, Content::internal), 3) /
               (cv * gas.content.cell(block, Content::of(1, r, Content::mass), 3));
      };
      return t(0, 700.0) - t(1, 1400.0);
    };
    const double before = difference(), energy = totals(gas, *domain).energy;
    const double rate = coefficient * 0.25 / 1.4 * (1.0 / (0.3 * 700.0) + 1.0 / (0.6 * 1400.0));
    const double time = 1e-2 / rate;
    for (int n = 0; n < 100; ++n) ASSERT_EQ(advance(gas, coefficient > 1e6 ? 1e-6 : time / 100.0, *domain), Outcome::done);
    if (coefficient > 1e6)
      EXPECT_LT(std::abs(difference()), 1e-9 * before);
    else
      EXPECT_NEAR(std::log(before / difference()), 1e-2, 1e-5);  // the implicit step is first order: 1e-4 of it
    EXPECT_LT(set_up::relative_change(energy, totals(gas, *domain).energy), 1e-14);
  }
}

// Shocks ---------------------------------------------------------------------------------------------------------------

/// Becker's shock: at a Prandtl number of 3/4 the total enthalpy is uniform and the profile is known in closed form
/// (Becker, Z. Phys. 8 (1922) 321; Morduchow & Libby, J. Aeronaut. Sci. 16 (1949) 674), with constant viscosity
///   2 gamma/(gamma + 1) (4 mu/3)/(rho_1 u_1) [u_1 ln(u_1 - u) - u_2 ln(u - u_2)]/(u_1 - u_2) = x + constant.
struct BeckerShock {
  double mach = 2.0, viscosity = 0.02;
  // Ahead: density 1, pressure 1/gamma, so that the sound speed is 1.
  double fast() const { return mach; }
  double slow() const { return mach * ((gamma_of_air - 1.0) * mach * mach + 2.0) / ((gamma_of_air + 1.0) * mach * mach); }
  double conductivity() const { return gamma_of_air * viscosity / 0.75; }  // cv = 1
  double place(double u) const {
    const double u1 = fast(), u2 = slow();
    return 2.0 * gamma_of_air / (gamma_of_air + 1.0) * (4.0 / 3.0 * viscosity) / mach *
           (u1 * std::log(u1 - u) - u2 * std::log(u - u2)) / (u1 - u2);
  }
  /// The middle velocity lies at x = 0.
  Filling at(double x) const {
    const double u1 = fast(), u2 = slow(), origin = place(0.5 * (u1 + u2));
    double low = u2, high = u1;
    for (int n = 0; n < 200; ++n) {
      const double u = 0.5 * (low + high);
      if (u <= low || u >= high) break;
      (place(u) - origin < x ? high : low) = u;  // u falls with x, place with u
    }
    const double u = 0.5 * (low + high);
    const double enthalpy = 1.0 / (gamma_of_air - 1.0) + 0.5 * u1 * u1 - 0.5 * u * u, density = u1 / u;
    return {0, density, density * enthalpy * (gamma_of_air - 1.0) / gamma_of_air, {u, 0.0, 0.0}};
  }
};

TEST(ViscousShock, HasTheProfileOfBecker) {
  const BeckerShock shock;
  std::vector<double> errors;
  for (const int cells : {40, 80}) {
    const auto domain = single_process();
    const double h = 0.8 / cells;
    Gas gas = set_up::box(Geometry::planar_1d, h, {-cells / 2, 0, 0}, {cells / 2, 0, 0},
                          {viscous_gas(shock.viscosity, 0.0, shock.conductivity())}, *domain);
    const FillingFunction exact = [&](const Vector& x, double) { return shock.at(x[0]); };
    gas.edges.assign(2, set_up::beyond(EdgeKind::inflow, exact));
    fill(gas, exact, *domain);
    Stepper().to(gas, 1.0, *domain);
    double sum = 0.0;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      sum += std::abs(c.velocity[0] - shock.at(c.centre[0]).velocity[0]) / (shock.fast() - shock.slow()) / cells;
    });
    errors.push_back(sum);
  }
  RecordProperty("errors", std::to_string(errors[0]) + " " + std::to_string(errors[1]));
  EXPECT_LT(errors[1], 0.005);
  EXPECT_GE(std::log2(errors[0] / errors[1]), 1.5) << errors[0] << ", " << errors[1];
}

// Books ----------------------------------------------------------------------------------------------------------------

TEST(ViscousBox, KeepsMomentumAndEnergyInEveryGeometry) {
  constexpr double round_off = 1e-13;
  struct Place {
    Geometry geometry;
    std::array<int, 3> upper;
  };
  for (const Place& place : {Place{Geometry::planar_1d, {70, 0, 0}}, Place{Geometry::cylindrical_1d, {50, 0, 0}},
                             Place{Geometry::spherical_1d, {50, 0, 0}}, Place{Geometry::plane, {20, 20, 0}},
                             Place{Geometry::axisymmetric, {20, 20, 0}}, Place{Geometry::three_dimensional, {12, 12, 12}}}) {
    const auto domain = single_process();
    Fluid thick = viscous_gas(0.01, 0.02, 0.03), thin = viscous_gas(0.001, 0.0, 0.1);
    Gas gas = set_up::box(place.geometry, 0.05, {}, place.upper, {thick, thin}, *domain);
    gas.heat_exchange = 10.0;
    for (Edge& edge : gas.edges)
      if (!(is_round(place.geometry) && &edge == &gas.edges.front())) edge = sticking({});
    fill(
        gas,
        [&](const Vector& x, double) {
          const double u = 0.3 * std::sin(9.0 * x[0]) * std::cos(7.0 * x[1]);
          return Filling{x[0] + x[1] > 0.6 ? 1 : 0, x[0] < 0.3 ? 2.0 : 1.0, 1.0, {u, 0.5 * u, -u}};
        },
        *domain);
    const Totals before = totals(gas, *domain);
    Stepper().steps(gas, 60, *domain);
    const Totals after = totals(gas, *domain);
    const int geometry = static_cast<int>(place.geometry);
    for (std::size_t r = 0; r < 2; ++r)
      EXPECT_LT(set_up::relative_change(before.mass[r], after.mass[r]), round_off) << geometry;
    EXPECT_LT(set_up::relative_change(before.energy, after.energy), round_off) << geometry;
    const std::vector<Totals> walls = passed(gas, *domain);
    for (std::size_t a = 0; a < static_cast<std::size_t>(gas.dimensions()); ++a) {
      if (is_round(place.geometry) && a == 0) continue;
      double impulse = before.momentum[a], scale = 0.0;
      for (const Totals& wall : walls) impulse += wall.momentum[a], scale += std::abs(wall.momentum[a]);
      EXPECT_NEAR(after.momentum[a], impulse, round_off * scale) << geometry;
    }
  }
}

// Bits -----------------------------------------------------------------------------------------------------------------

Gas stirred(Domain& domain) {
  Gas gas = set_up::box(Geometry::axisymmetric, 0.05, {}, {40, 24, 0},
                        {viscous_gas(0.01, 0.02, 0.03), viscous_gas(0.001, 0.0, 0.1)}, domain);
  gas.heat_exchange = 10.0;
  gas.edges[1] = sticking({0.0, 0.2, 0.0}, 2.0);
  gas.edges[2] = gas.edges[3] = set_up::around();
  fill(
      gas,
      [&](const Vector& x, double) {
        const double u = 0.3 * std::sin(5.0 * x[0]);
        return Filling{x[0] + x[1] > 1.2 ? 1 : 0, x[0] < 0.9 ? 2.0 : 1.0, 1.0, {u, 0.5 * u, 0.0}};
      },
      domain);
  return gas;
}

TEST(ViscousBox, HasTheSameBitsForAnyNumberOfRanksAndAfterARestart) {
  constexpr int steps = 15;
  using State = std::map<std::array<int, 3>, std::array<double, 4>>;
  const auto add_state = [](const Gas& gas, State& state) {
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      state[c.index] = {c.density, c.pressure, c.velocity[0], c.velocity[1]};
    });
  };
  std::vector<State> states;
  for (const int ranks : {1, 2, 5}) {
    State state;
    std::mutex one_at_a_time;
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      Gas gas = stirred(*domain);
      Stepper().steps(gas, steps, *domain);
      const std::lock_guard lock(one_at_a_time);
      add_state(gas, state);
    });
    states.push_back(state);
  }
  EXPECT_TRUE(states[0] == states[1]);
  EXPECT_TRUE(states[0] == states[2]);

  const auto domain = single_process();
  Gas gas = stirred(*domain), again = stirred(*domain);
  Stepper().steps(gas, steps - 5, *domain);
  restore(again, numbers_of(gas), *domain);
  Stepper().steps(again, 5, *domain);
  State state;
  add_state(again, state);
  EXPECT_TRUE(states[0] == state);
}

}  // namespace
}  // namespace brisance::simulator::gas
