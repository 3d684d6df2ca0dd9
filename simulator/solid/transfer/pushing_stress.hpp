#pragma once
// The stress with which particles push the grid.

#include "simulator/solid/transfer/cell_means.hpp"
#include "simulator/solid/transfer/tile.hpp"

namespace brisance::simulator {

template <int D>
SymmetricTensor<Lanes> read_stress(const Columns& load) {
  const auto at = [&](int k) { return load[Layout<D>::Load::stress + k]; };
  if constexpr (D == 3)
    return {at(0), at(1), at(2), at(3), at(4), at(5)};
  else
    return {at(0), at(1), at(2), Lanes(0.0), Lanes(0.0), at(3)};
}

/// The pressure with artificial viscosity (Pa) of each cell of a tile, if the body wants pressures averaged.
template <int D>
CellMeans<D> cell_pressures(const Grid& grid, const Body& body, const Bin& bin, const BlockPosition& block) {
  using L = Layout<D>;
  CellMeans<D> means;
  if (!body.locking_cure) return means;
  for_each_eight(body.bins, bin, [&](const Eight& eight) {
    const Columns motion(body.particles.motion, eight), load(body.particles.load, eight);
    const Lanes pressure = load[L::Load::artificial_viscosity] - trace(read_stress<D>(load)) / 3.0;
    const auto nearest = nearest_in_block(on_grid(grid, read_vector<D>(motion, L::Motion::position)), block, grid.cell_size);
    means.add(eight, CellMeans<D>::cells(nearest), load[L::Load::mass] / load[L::Load::density], pressure);
  });
  return means;
}

/// The stress that pushes the grid (Pa): with artificial viscosity, and with the pressure of its cell if the body wants that.
template <int D>
SymmetricTensor<Lanes> pushing_stress(const Body& body, const Columns& load, const CellMeans<D>& pressures,
                                      const Weights<D>& w) {
  const SymmetricTensor<Lanes> sigma = read_stress<D>(load);
  const Lanes q = load[Layout<D>::Load::artificial_viscosity];
  if (!body.locking_cure) return add_to_diagonal(sigma, -q);
  const Lanes pressure = q - trace(sigma) / 3.0;
  return add_to_diagonal(sigma, pressure - q - pressures(CellMeans<D>::cells(w.nearest)));
}

}  // namespace brisance::simulator
