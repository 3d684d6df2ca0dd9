#pragma once
// State redistribution (Berger & Giuliani, J. Comput. Phys. 428 (2021) 109820): a cell with little gas shares a neighbourhood
// with others on its open side; what neighbourhoods hold is averaged and given back. Sums are gathered in the order of the
// cells, so the result does not depend on who visits which cell first.

#include <functional>

#include "simulator/gas/cut_cells.hpp"

namespace brisance::simulator::gas {

struct Neighbourhood {
  std::size_t cell = 0;  // whose it is
  int count = 0;
  std::array<std::size_t, 8> members{};  // itself as well, in the order of the cells
};
struct Neighbourhoods {
  std::vector<Neighbourhood> small;    // of cells with less than half of their volume, or that are being covered
  std::vector<std::int32_t> number;    // of a cell's in `small`; -1: it is alone
  std::vector<std::uint8_t> overlaps;  // in how many a cell is
  std::vector<std::size_t> shared;     // cells that are in a neighbourhood in `small`
};
void find_neighbourhoods(const Window& window, const Cells& cells, const OpenSpace& before, const OpenSpace& after,
                         const CutCells& step, Neighbourhoods& all);

/// What a member takes from the mean of one of its neighbourhoods, when it held `before` per volume or, without gas, `covered`.
inline double gain_of(const Neighbourhoods& all, std::size_t member, double volume, double mean, double before,
                      double covered) {
  return (volume > 0.0 ? volume * (mean - before) : -covered) / all.overlaps[member];
}

/// The mean of a quantity (per volume) over a neighbourhood; gas that has weight lies in it as in a column.
struct NeighbourhoodMean {
  double value = 0.0;
  Vector slope{}, middle{};  // per cell; in cells, of its gas
  double at(const std::array<int, 3>& cell) const {
    double sum = value;
    for (std::size_t a = 0; a < 3; ++a)
      if (slope[a] != 0.0) sum += slope[a] * (cell[a] - middle[a]);
    return sum;
  }
};
/// How a quantity changes from cell to cell of a neighbourhood, given one of its members with gas.
using SlopeAt = std::function<Vector(std::size_t cell)>;

/// Averages a quantity: `density` (per volume) of cells with gas, `covered` what cells without any still hold (zero
/// elsewhere). Both by cell of the window; `volume` is that of their gas. Returns the means of the neighbourhoods.
std::vector<NeighbourhoodMean> redistribute(const Window& window, const Neighbourhoods& all, const std::vector<double>& volume,
                                            std::vector<double>& density, const std::vector<double>& covered,
                                            const SlopeAt& slope = {});

}  // namespace brisance::simulator::gas
