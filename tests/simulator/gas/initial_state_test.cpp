// What fills the gas at the start: shapes that cut cells, profiles from files, energies spread over a region.

#include "simulator/gas/initial_state.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <numbers>
#include <string>
#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "tests/command_line.hpp"
#include "tests/simulator/gas/fluids.hpp"
#include "tests/simulator/gas/set_up.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::air;
using set_up::water;

constexpr int cells_across = 20;
constexpr double h = 0.05;

/// A cube of 1 m, or its quarter of a round geometry.
Gas box_of(Geometry geometry, const std::vector<Fluid>& fluids, Domain& domain) {
  return set_up::box(geometry, h, {}, {cells_across, cells_across, cells_across}, fluids, domain);
}

GasConfig config_of(const std::vector<Fluid>& fluids, const std::vector<FillConfig>& fills) {
  GasConfig config;
  for (const Fluid& fluid : fluids) config.fluids.push_back({fluid.name, {}});
  config.fills = fills;
  return config;
}
FillConfig fill_of(const std::string& fluid, double density, double pressure, const Vector& velocity = {}) {
  FillConfig fill;
  fill.fluid = fluid, fill.density = density, fill.pressure = pressure, fill.velocity = velocity;
  return fill;
}
FillConfig in_sphere(FillConfig fill, const Vector& centre, double radius) {
  fill.shape = std::make_shared<const Shape>(Shape{Sphere{centre, radius}});
  return fill;
}

Gas filled(Geometry geometry, const std::vector<Fluid>& fluids, const std::vector<FillConfig>& fills, Domain& domain) {
  Gas gas = box_of(geometry, fluids, domain);
  const GasConfig config = config_of(fluids, fills);
  const InitialState start(config, fluids, gas.cells);
  fill_in_portions(
      gas, [&](const Vector& middle) { return start.in_cell(middle); }, domain);
  return gas;
}

struct Ball {
  Geometry geometry;
  Vector centre;
  double volume;  // per radian or steradian in the round geometries
};
constexpr double radius = 0.437;  // on no face of a cell
const std::vector<Ball> balls = {
    {Geometry::planar_1d, {0.51, 0, 0}, 2.0 * radius},
    {Geometry::cylindrical_1d, {}, radius* radius / 2.0},
    {Geometry::spherical_1d, {}, radius* radius* radius / 3.0},
    {Geometry::plane, {0.51, 0.47, 0}, std::numbers::pi* radius* radius},
    {Geometry::axisymmetric, {0, 0.47, 0}, 2.0 / 3.0 * radius* radius* radius},
    {Geometry::three_dimensional, {0.51, 0.47, 0.52}, 4.0 / 3.0 * std::numbers::pi* radius* radius* radius}};
/// The places in a cell are known to a part in their number; the errors of the cells that the surface cuts, some of either
/// sign, add up to less than a hundredth of one layer of cells, h/radius of the volume.
constexpr double of_the_places = 2e-3;

double volume_of_box(Geometry geometry) {
  switch (geometry) {
    case Geometry::cylindrical_1d:
    case Geometry::axisymmetric:
      return 1.0 / 2.0;
    case Geometry::spherical_1d:
      return 1.0 / 3.0;
    default:
      return 1.0;
  }
}

TEST(CutCells, HoldTheMassMomentumAndEnergyOfABall) {
  const Vector fast = {30.0, 0.0, 0.0}, slow = {10.0, 0.0, 0.0};
  for (const Ball& ball : balls) {
    const auto domain = single_process();
    const Gas gas =
        filled(ball.geometry, {air},
               {fill_of("air", 1.0, 1e5, slow), in_sphere(fill_of("air", 3.0, 4e5, fast), ball.centre, radius)}, *domain);
    const double inside = ball.volume, outside = volume_of_box(ball.geometry) - ball.volume;
    const Totals all = totals(gas, *domain);
    const auto kind = static_cast<int>(ball.geometry);
    EXPECT_NEAR(all.mass[0] / (3.0 * inside + outside), 1.0, of_the_places) << kind;
    EXPECT_NEAR(all.momentum[0] / (90.0 * inside + 10.0 * outside), 1.0, of_the_places) << kind;
    EXPECT_NEAR(all.energy / ((1e6 + 1350.0) * inside + (2.5e5 + 50.0) * outside), 1.0, of_the_places) << kind;
  }
}

TEST(CutCells, ShareTheirVolumeAtOnePressure) {
  constexpr double rounding = 1e-9;  // of the pressure, which is a millionth of the water's stiffness
  for (const Ball& ball : balls) {
    const auto domain = single_process();
    const Gas gas = filled(ball.geometry, {air, water},
                           {fill_of("air", 1.2, 1e5), in_sphere(fill_of("water", 1000.0, 1e5), ball.centre, radius)}, *domain);
    double volume = 0.0;
    int cut = 0;
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      const double part = set_up::fraction(gas, c, 1);
      volume += part * c.volume;
      if (part > 0.0 && part < 1.0) ++cut;
      EXPECT_NEAR(c.pressure / 1e5, 1.0, rounding);
      EXPECT_NEAR(c.density, 1000.0 * part + 1.2 * (1.0 - part), 1e-9 * c.density);
    });
    EXPECT_GT(cut, 0);
    EXPECT_NEAR(volume / ball.volume, 1.0, of_the_places) << static_cast<int>(ball.geometry);
  }
}

/// Different pressures in a cut cell come to one; the energies add up all the same.
TEST(CutCells, ComeToOnePressureWithoutLosingEnergy) {
  const auto domain = single_process();
  const double water_energy = equation_of_state::energy_at_pressure(water.equation_of_state, 1000.0, 1e8) * 1000.0;
  const Gas gas =
      filled(Geometry::plane, {air, water},
             {fill_of("air", 1.2, 1e5), in_sphere(fill_of("water", 1000.0, 1e8), {0.51, 0.47, 0}, radius)}, *domain);
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const double mass_of_water = gas.content.cell(c.block, Content::of(2, 1, Content::mass), c.number);
    const double part = mass_of_water / (1000.0 * c.volume);
    const double energy = gas.content.cell(c.block, Content::energy, c.number) / c.volume;
    constexpr double rounding = 1e-13;
    EXPECT_NEAR(energy, part * water_energy + (1.0 - part) * 2.5e5, rounding * energy);
    EXPECT_GE(c.pressure, 1e5 * (1.0 - rounding * water_energy / 1e5));
    EXPECT_LE(c.pressure, 1e8 * (1.0 + rounding * water_energy / 1e8));
  });
}

TEST(UncutCells, AreFilledAsByTheirMiddles) {
  const auto domain = single_process();
  FillConfig inside = fill_of("air", 3.0, 4e5, {7.0, 0.0, 0.0});
  inside.shape = std::make_shared<const Shape>(Shape{Box{{0.25, 0.5, 0.0}, {0.75, 1.0, 0.0}}});
  const Gas gas = filled(Geometry::plane, {air}, {fill_of("air", 1.0, 1e5), inside}, *domain);
  Gas by_middles = box_of(Geometry::plane, {air}, *domain);
  fill(
      by_middles,
      [](const Vector& x, double) {
        return x[0] > 0.25 && x[0] < 0.75 && x[1] > 0.5 ? Filling{0, 3.0, 4e5, {7.0, 0.0, 0.0}} : Filling{0, 1.0, 1e5, {}};
      },
      *domain);
  EXPECT_TRUE(numbers_of(gas) == numbers_of(by_middles));
}

// Profiles ------------------------------------------------------------------------------------------------------------

FillConfig with_profile(FillConfig fill, const std::string& text, ProfileAlong along, const Vector& centre = {}) {
  fill.profile = ProfileConfig{write_text(scratch() / "profile.csv", text), along, centre};
  return fill;
}
FillConfig velocity_only() {
  return fill_of("air", 1.0, 1e5);
}

TEST(Profile, AlongARadiusMovesAwayAndAround) {
  constexpr double rounding = 1e-12;
  const Vector centre = {0.5, 0.5, 0.0};
  const auto domain = single_process();
  const Gas gas =
      filled(Geometry::plane, {air},
             {with_profile(velocity_only(), "radius [cm],velocity_along [m/s],velocity_around [m/s]\n0,0,0\n100,3,20\n",
                           ProfileAlong::radius, centre)},
             *domain);
  // Both rise with the radius: the means of the cells are what is at their middles.
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const Vector r = c.centre - centre;
    EXPECT_NEAR(c.velocity[0], 3.0 * r[0] - 20.0 * r[1], 20.0 * rounding);
    EXPECT_NEAR(c.velocity[1], 3.0 * r[1] + 20.0 * r[0], 20.0 * rounding);
  });
}

TEST(Profile, ConstantTowardsAPointHasUnitVelocityInEveryGeometry) {
  for (const Geometry geometry : {Geometry::planar_1d, Geometry::cylindrical_1d, Geometry::spherical_1d, Geometry::plane,
                                  Geometry::axisymmetric, Geometry::three_dimensional}) {
    const auto domain = single_process();
    const Gas gas =
        filled(geometry, {air},
               {with_profile(velocity_only(), "radius [m],velocity_along [m/s]\n0,-1\n", ProfileAlong::radius)}, *domain);
    set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
      const double r = std::sqrt(dot(c.centre, c.centre));
      if (r < 4.0 * h) return;       // where the direction turns within a cell
      constexpr double turn = 0.02;  // (h/r)^2/6 at four cells
      EXPECT_NEAR(dot(c.velocity, c.centre) / r, -1.0, turn);
    });
  }
}

TEST(Profile, JumpsWhereTwoRowsAreAtOnePlaceAndGoesOnBeyondItsEnds) {
  const auto domain = single_process();
  FillConfig fill = fill_of("air", 1.0, 1e5);
  fill.density.reset(), fill.pressure.reset();
  const Gas gas = filled(
      Geometry::planar_1d, {air},
      {with_profile(fill, "x [m],density [kg/m^3],pressure [bar]\n0.2,1,1\n0.4,3,2\n0.4,7,5\n0.8,7,5\n", ProfileAlong::x)},
      *domain);
  constexpr double rounding = 1e-12;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    const double x = c.centre[0];
    const double density = x < 0.2 ? 1.0 : x < 0.4 ? 1.0 + 2.0 * (x - 0.2) / 0.2 : 7.0;
    const double pressure = x < 0.2 ? 1e5 : x < 0.4 ? 1e5 * (1.0 + (x - 0.2) / 0.2) : 5e5;
    EXPECT_NEAR(c.density / density, 1.0, rounding) << x;
    EXPECT_NEAR(c.pressure / pressure, 1.0, rounding) << x;
  });
}

TEST(Profile, OfPressureWithATemperatureGivesTheDensity) {
  const auto domain = single_process();
  FillConfig fill;
  fill.fluid = "air", fill.temperature = 250.0;
  const Gas gas =
      filled(Geometry::planar_1d, {air}, {with_profile(fill, "x [m],pressure [bar]\n0,1\n1,2\n", ProfileAlong::x)}, *domain);
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) { EXPECT_NEAR(c.density, c.pressure / (0.4 * 718.0 * 250.0), 1e-9); });
}

// Energies ------------------------------------------------------------------------------------------------------------

TEST(Energy, PutIntoABallIsThereToRoundOff) {
  constexpr double energy = 5e4, rounding = 1e-12;
  for (const Ball& ball : balls) {
    const auto domain = single_process();
    FillConfig blast = fill_of("air", 1.0, 0.0);
    blast.pressure.reset(), blast.energy = energy;
    const Gas gas = filled(ball.geometry, {air}, {fill_of("air", 1.0, 1e-6), in_sphere(blast, ball.centre, radius)}, *domain);
    const double cold = 2.5e-6 * whole_of(ball.geometry) * volume_of_box(ball.geometry);
    EXPECT_NEAR(whole_of(ball.geometry) * totals(gas, *domain).energy / energy, 1.0, rounding + cold / energy)
        << static_cast<int>(ball.geometry);
  }
}

TEST(Energy, OutsideTheBoxIsRefused) {
  const auto domain = single_process();
  FillConfig blast = fill_of("air", 1.0, 0.0);
  blast.pressure.reset(), blast.energy = 1.0;
  EXPECT_THROW(static_cast<void>(
                   filled(Geometry::plane, {air}, {fill_of("air", 1.0, 1.0), in_sphere(blast, {5.0, 5.0, 0.0}, 0.1)}, *domain)),
               std::runtime_error);
}

TEST(InitialState, HasTheSameBitsOnAnyNumberOfRanks) {
  FillConfig blast = fill_of("air", 1.0, 0.0);
  blast.pressure.reset(), blast.energy = 5e4;
  const Vector middle = {0.51, 0.47, 0.0};
  const std::vector<FillConfig> fills = {
      with_profile(velocity_only(), "radius [m],velocity_around [m/s]\n0,0\n1,20\n", ProfileAlong::radius, middle),
      in_sphere(fill_of("water", 1000.0, 1e6), middle, radius), in_sphere(blast, middle, 0.2)};
  using Bits = std::map<std::array<int, 3>, std::vector<std::uint64_t>>;
  const auto on = [&](int ranks) {
    Bits bits;
    std::mutex one_at_a_time;
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      const Gas gas = filled(Geometry::plane, {air, water}, fills, *domain);
      const std::lock_guard lock(one_at_a_time);
      set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
        for (int q = 0; q < gas.contents(); ++q)
          bits[c.index].push_back(std::bit_cast<std::uint64_t>(gas.content.cell(c.block, q, c.number)));
      });
    });
    return bits;
  };
  const Bits one = on(1);
  EXPECT_EQ(one.size(), static_cast<std::size_t>(cells_across * cells_across));
  for (const int ranks : {2, 3}) EXPECT_TRUE(on(ranks) == one) << ranks << " ranks";
}

// What it is good for -------------------------------------------------------------------------------------------------

/// Root mean square, over circles, of the deviation of the density from its mean on the circle.
double anisotropy(const Gas& gas) {
  const int n = gas.cells.upper[0];
  std::vector<double> density(static_cast<std::size_t>(n * n));
  set_up::for_each_cell(
      gas, [&](const set_up::Cell& c) { density[static_cast<std::size_t>(c.index[0] + n * c.index[1])] = c.density; });
  const auto at = [&](double x, double y) {
    const double u = std::max(x / gas.cells.cell_size - 0.5, 0.0), v = std::max(y / gas.cells.cell_size - 0.5, 0.0);
    const int i = std::min(static_cast<int>(u), n - 2), j = std::min(static_cast<int>(v), n - 2);
    const auto value = [&](int a, int b) { return density[static_cast<std::size_t>(a + n * b)]; };
    return std::lerp(std::lerp(value(i, j), value(i + 1, j), u - i), std::lerp(value(i, j + 1), value(i + 1, j + 1), u - i),
                     v - j);
  };
  constexpr int angles = 31, circles = 80;
  double square = 0.0;
  for (int k = 1; k <= circles; ++k) {
    const double r = 0.9 * k / circles;
    std::vector<double> on_circle;
    double mean = 0.0;
    for (int a = 0; a < angles; ++a) {
      const double angle = 0.5 * std::numbers::pi * a / (angles - 1);
      on_circle.push_back(at(r * std::cos(angle), r * std::sin(angle))), mean += on_circle.back() / angles;
    }
    for (const double value : on_circle) square += (value - mean) * (value - mean) / (angles * circles);
  }
  return std::sqrt(square);
}

TEST(CylindricalExplosion, IsRounderFromCutCells) {
  const auto run = [](bool cut) {
    constexpr int cells = 50;
    const auto domain = single_process();
    Gas gas = set_up::box(Geometry::plane, 1.0 / cells, {}, {cells, cells, 0}, {set_up::ideal_gas()}, *domain);
    const GasConfig config = config_of(gas.fluids, {fill_of("gas", 0.125, 0.1), in_sphere(fill_of("gas", 1.0, 1.0), {}, 0.4)});
    const InitialState start(config, gas.fluids, gas.cells);
    if (cut)
      fill_in_portions(
          gas, [&](const Vector& middle) { return start.in_cell(middle); }, *domain);
    else
      fill(
          gas,
          [](const Vector& x, double) {
            return dot(x, x) < 0.16 ? Filling{0, 1.0, 1.0, {}} : Filling{0, 0.125, 0.1, {}};
          },
          *domain);
    set_up::Stepper().to(gas, 0.25, *domain);
    return anisotropy(gas);
  };
  const double by_middles = run(false), in_proportion = run(true);
  RecordProperty("anisotropy", std::to_string(by_middles) + " by middles, " + std::to_string(in_proportion) + " in proportion");
  EXPECT_LT(in_proportion, by_middles);
}

}  // namespace
}  // namespace brisance::simulator::gas
