#pragma once
// Slow flow, whatever finds its pressures: Gresho's vortex, gas at rest, boxes in every geometry.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/simulator/gas/exact_solutions.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator::gas {

inline Filling filling(const PlaneGasState& w) {
  return {0, w.density, w.pressure, {w.velocity_x, w.velocity_y, 0.0}};
}

/// Part of its kinetic energy that Gresho's vortex loses on 64 x 64 cells.
inline double loss_of_gresho(double mach, double time, const std::function<void(Gas&)>& choose_options = {}) {
  constexpr int cells = 64;
  const GreshoVortex vortex{1.4, mach};
  const auto domain = single_process();
  Gas gas = set_up::box(Geometry::plane, 1.0 / cells, {-cells / 2, -cells / 2, 0}, {cells / 2, cells / 2, 0},
                        {set_up::ideal_gas()}, *domain);
  if (choose_options) choose_options(gas);
  gas.edges.assign(4, set_up::around());
  fill(
      gas, [&](const Vector& x, double) { return filling(vortex.at(x[0], x[1])); }, *domain);
  const double before = totals(gas, *domain).kinetic;
  set_up::Stepper().to(gas, time, *domain);
  return 1.0 - totals(gas, *domain).kinetic / before;
}
constexpr double most_lost = 0.02;  // at t = 1, when the gas at radius 0.2 has nearly turned once

inline void expect_little_loss(double loss, double most = most_lost) {
  testing::Test::RecordProperty("loss", std::to_string(loss));
  EXPECT_LT(loss, most);
  EXPECT_GT(loss, 0.0);
}

/// The largest velocity over the speed of sound.
inline double fastest_over_sound(const Gas& gas) {
  double fastest = 0.0;
  set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
    for (const double u : c.velocity) fastest = std::max(fastest, std::abs(u) / c.sound_speed);
  });
  return fastest;
}

struct Place {
  const char* name;
  Geometry geometry;
  std::array<int, 3> lower, upper;
};
inline const std::vector<Place> every_geometry = {{"planar_1d", Geometry::planar_1d, {0, 0, 0}, {70, 0, 0}},
                                                  {"cylindrical_1d", Geometry::cylindrical_1d, {0, 0, 0}, {50, 0, 0}},
                                                  {"spherical_1d", Geometry::spherical_1d, {0, 0, 0}, {50, 0, 0}},
                                                  {"spherical_1d, hollow", Geometry::spherical_1d, {20, 0, 0}, {70, 0, 0}},
                                                  {"plane", Geometry::plane, {0, 0, 0}, {20, 20, 0}},
                                                  {"axisymmetric", Geometry::axisymmetric, {0, 0, 0}, {20, 20, 0}},
                                                  {"three_dimensional", Geometry::three_dimensional, {0, 0, 0}, {12, 12, 12}}};

}  // namespace brisance::simulator::gas
