// Bodies in gas that has weight and burns: the same bits for ranks and restarts; energies of fills beside bodies.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <mutex>
#include <vector>

#include "simulator/case_reader.hpp"
#include "simulator/gas/passages.hpp"
#include "simulator/setup.hpp"
#include "tests/command_line.hpp"
#include "tests/simulator/gas/charge.hpp"
#include "tests/simulator/virtual_ranks.hpp"

namespace brisance::simulator::gas {
namespace {

using set_up::Stepper;

TEST(SameBits, OfGasWithWeightThatBurnsAroundBodies) {
  const auto numbers_after = [](int ranks, bool restarted) {
    std::map<std::array<int, 3>, std::vector<double>> cells;
    std::vector<double> bodies;
    std::mutex one_at_a_time;
    VirtualRanks::run(ranks, [&](std::shared_ptr<Domain> domain) {
      const auto start = [&] {
        Gas gas = charge_in_case(14, jwl_plus_plus(0.1e-6), *domain);
        gas.gravity[1] = -1e7;
        gas.bodies.all[0].mass = 1.0, gas.bodies.all[0].axis = 1;
        open_passages(gas), prepare_burns(gas);
        return gas;
      };
      Gas gas = start();
      Stepper().steps(gas, 12, *domain);
      if (restarted) {
        const std::vector<double> numbers = numbers_of(gas);
        gas = start();
        restore(gas, numbers, *domain);
      }
      Stepper().steps(gas, 12, *domain);
      const std::lock_guard lock(one_at_a_time);
      set_up::for_each_cell(gas, [&](const set_up::Cell& c) {
        for (int q = 0; q < gas.contents(); ++q) cells[c.index].push_back(gas.content.cell(c.block, q, c.number));
      });
      bodies = numbers_of(gas.bodies);
    });
    return std::pair{cells, bodies};
  };
  const auto one = numbers_after(1, false);
  for (const int ranks : {2, 3, 5}) EXPECT_TRUE(numbers_after(ranks, false) == one) << ranks << " ranks";
  EXPECT_TRUE(numbers_after(2, true) == one) << "restarted";
}

TEST(EnergyOfAFill, GoesToTheGasThatABodyLeavesOfIt) {
  const fs::path file = scratch() / "case.toml";
  std::ofstream(file) << R"(
title = "Energy beside a body"
geometry = "plane"
cell_size = 1
end_time = 1
[gas]
lower = [-24, -24]
upper = [24, 24]
[[gas.fluid]]
name = "gas"
[gas.fluid.material]
name = "ideal gas"
density = 1
density_source = "a textbook gas"
[gas.fluid.material.equation_of_state]
law = "ideal_gas"
source = "a textbook gas"
gamma = 1.4
specific_heat = 1
[[gas.fill]]
density = 1
pressure = 1e-12
[[gas.fill]]
shape = { sphere = { centre = [0, 0], radius = 12.7 } }
density = 5
energy = 1000
[[gas.body]]
name = "disk"
shape = { sphere = { centre = [7, 2], radius = 6.4 } }
)";
  const Simulation s = simulator::set_up(read_case(file, {}));
  const double cold = 1e-12 / 0.4 * 48.0 * 48.0;
  EXPECT_NEAR(s.gas.initial.energy, 1000.0, 1e-12 * 1000.0 + cold);
}

}  // namespace
}  // namespace brisance::simulator::gas
