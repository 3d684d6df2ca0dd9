#pragma once
// Means over the cells of a tile: the cure for volumetric locking, of pressures and of rates of volume.

#include "simulator/solid/eight.hpp"
#include "simulator/solid/transfer/stencil.hpp"

namespace brisance::simulator {

/// Means over the cells of a block, weighted by volume. A cell is what is nearest to one node: there the gradient of a
/// quadratic spline is linear, so a constant is the space below it.
template <std::size_t D>
class CellMeans {
 public:
  using Cells = std::array<int, 8>;  // of eight particles
  static Cells cells(const std::array<Lanes, D>& nearest) { return node_numbers(nearest, Block<D>::side); }

  void add(const Eight& eight, const Cells& cells, const Lanes& volume, const Lanes& value) {
    const StoredPack of_volume = volume, sum = volume * value;
    for (std::size_t i = 0; i < static_cast<std::size_t>(eight.used); ++i) {
      const auto cell = static_cast<std::size_t>(cells[i]);
      volume_[cell] += of_volume[i], sum_[cell] += sum[i];
    }
  }
  Lanes operator()(const Cells& cells) const {
    StoredPack volume, sum;
    for (std::size_t i = 0; i < 8; ++i) {
      const auto cell = static_cast<std::size_t>(cells[i]);
      volume.element[i] = volume_[cell], sum.element[i] = sum_[cell];
    }
    return Lanes(sum) / Lanes(volume);
  }

 private:
  std::array<double, 64> volume_{}, sum_{};
};

}  // namespace brisance::simulator
