#pragma once
// Work on the blocks of this process, by kernels that know the number of dimensions.

#include <cstddef>
#include <type_traits>

#include "simulator/gas/gas.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {

/// f(D, i, block) for the own blocks side by side: D() is the number of dimensions, a constant, and i counts the blocks.
template <class F>
void for_each_own_block(const Gas& gas, F&& f) {
  const auto all = [&](auto D) {
    parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) { f(D, i, static_cast<std::size_t>(gas.cells.mine[i])); });
  };
  switch (gas.dimensions()) {
    case 1:
      return all(std::integral_constant<int, 1>{});
    case 2:
      return all(std::integral_constant<int, 2>{});
    default:
      return all(std::integral_constant<int, 3>{});
  }
}

}  // namespace brisance::simulator::gas
