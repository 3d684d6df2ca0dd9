#pragma once
// What can be said about a cell of gas: the vocabulary of gauges, snapshots and figures.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// A quantity of a cell; vectors have as many components as the gas has dimensions.
struct Field {
  std::string name, unit, meaning;
  int components = 1;
  std::function<double(const Gas& gas, const CellPlace& at, int component)> read;
};

/// density, pressure, velocity, speed, temperature, energy, sound_speed; of several fluids also their fractions of the volume.
std::vector<Field> fields(int dimensions, const std::vector<std::string>& fluids);
std::vector<Field> fields_of(const Gas& gas);

/// The fluid that takes most of a cell, and which part of its volume.
struct MostOf {
  std::string fluid;
  double part = 1.0;
};
MostOf most_of(const Gas& gas, const CellPlace& at);
/// "air alone", "60 % water and other fluids"
std::string in_words(const MostOf& most);

/// The cell that holds a position; none outside the box, within bodies and in other processes.
std::optional<CellPlace> find_cell(const Gas& gas, const Vector& position);
/// Calls f(place) for the cells of the box that this process owns and that hold gas, in Morton order of the blocks.
template <class F>
void for_each_cell(const Gas& gas, F&& f) {
  for (const std::int32_t b : gas.cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c)
      if ((!gas.cells.partial[block] || gas.cells.contains(gas.cells.index(block, c))) && open_part(gas, block, c) > 0.0)
        f(CellPlace{block, c});
  }
}

}  // namespace brisance::simulator::gas
