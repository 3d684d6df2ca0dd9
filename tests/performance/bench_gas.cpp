// Nanoseconds per cell and step of the gas, phase by phase, beside those of the MUSCL-HLLC oracle in one dimension.

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulator/gas/gas.hpp"
#include "simulator/gas/muscl_hllc.hpp"
#include "simulator/parallel.hpp"
#include "tests/performance/environment.hpp"

namespace brisance::simulator::gas {
namespace {

struct Setting {
  Geometry geometry;
  int side;  // cells along each axis
  int fluids;
  int threads;
};

/// A ball of compressed gas in the middle of gas at rest; of several fluids each fills a layer. Everything moves, and every
/// face has something to do.
Gas ball(const Setting& setting, Domain& domain) {
  Gas gas;
  std::array<int, 3> upper{};
  for (int a = 0; a < number_of_dimensions(setting.geometry); ++a) upper[static_cast<std::size_t>(a)] = setting.side;
  gas.cells = make_cells(setting.geometry, 1.0 / setting.side, {}, upper, domain);
  for (int r = 0; r < setting.fluids; ++r)
    gas.fluids.push_back({fmt::format("gas {}", r), equation_of_state::IdealGas{1.4 + 0.1 * r, 718.0}});
  gas.edges.assign(static_cast<std::size_t>(2 * gas.dimensions()), {"wall", EdgeKind::wall, {}});
  fill(
      gas,
      [&](const Vector& x, double) {
        double square = 0.0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(gas.dimensions()); ++a) square += (x[a] - 0.5) * (x[a] - 0.5);
        const int fluid = std::min(static_cast<int>(x[0] * setting.fluids), setting.fluids - 1);
        return square < 0.09 ? Filling{fluid, 5.0, 1e6, {}} : Filling{fluid, 1.2, 1e5, {}};
      },
      domain);
  return gas;
}

void measure(const Setting& setting) {
  omp_set_num_threads(setting.threads);
  const auto domain = single_process();
  Gas gas = ball(setting, *domain);
  const auto step = [&] {
    while (advance(gas, largest_step(gas, 0.4), *domain) == Outcome::rejected) throw std::runtime_error("a step was rejected");
  };
  constexpr int warm_up = 3, least_steps = 5;
  for (int i = 0; i < warm_up; ++i) step();
  gas.seconds.fill(0.0);
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  int steps = 0;
  for (; steps < least_steps || seconds() < 2.0; ++steps) step();
  const double each = 1e9 / (static_cast<double>(gas.cells.count()) * steps);
  fmt::print("{:18} {:>9} {:>7} {:>8} {:>8.0f} ns", choices<Geometry>[static_cast<std::size_t>(setting.geometry)],
             gas.cells.count(), setting.fluids, setting.threads, each * seconds());
  for (const double phase : gas.seconds) fmt::print(" {:>7.0f}", each * phase);
  fmt::print(" {:>9.0f}\n", static_cast<double>(gas.bytes()) / static_cast<double>(gas.cells.count()));
}

void measure_oracle() {
  Euler1D gas;
  gas.cells.assign(4096, {1.2, 0.0, 1e5});
  for (std::size_t i = 1200; i < 2800; ++i) gas.cells[i] = {5.0, 0.0, 1e6};
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  int steps = 0;
  for (; seconds() < 2.0; ++steps) advance(gas, stable_step(gas, 0.4));
  fmt::print("{:18} {:>9} {:>7} {:>8} {:>8.0f} ns\n", "oracle, planar_1d", gas.cells.size(), 1, 1,
             1e9 * seconds() / (static_cast<double>(gas.cells.size()) * steps));
}

}  // namespace
}  // namespace brisance::simulator::gas

int main(int, char** argv) {
  using namespace brisance::simulator;
  choose_for_libraries(argv);  // as brisance does
  using namespace brisance::simulator::gas;
  const double flops = brisance::print_environment().flops;
  fmt::print("goal for 3-D, one gas, one thread: 150 ns on a core of 133 Gflop/s, here {:.0f}\n", 150.0 * 133.0 / flops);
  fmt::print("{:18} {:>9} {:>7} {:>8} {:>11}", "gas", "cells", "fluids", "threads", "cell-step");
  for (const std::string_view phase : gas::phase_names) fmt::print(" {:>7.7}", phase);
  fmt::print(" {:>9}\n", "bytes");
  for (const int fluids : {1, 3})
    for (const int threads : {1, 2}) {
      measure({Geometry::planar_1d, 4096, fluids, threads});
      measure({Geometry::plane, 256, fluids, threads});
      measure({Geometry::three_dimensional, 96, fluids, threads});
    }
  measure_oracle();
}
