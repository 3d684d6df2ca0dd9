#include "simulator/gas/passages.hpp"

#include <algorithm>

namespace brisance::simulator::gas {

void open_passages(Gas& gas) {
  const Cells& cells = gas.cells;
  const int D = gas.dimensions();
  gas.passages.clear();
  gas.passage_of.assign(cells.blocks.size(), {-1, -1, -1, -1, -1, -1, -1});
  for (const std::int32_t b : cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    const std::array<int, 3> corner = cells.corner(block);
    for (int side = 0; side < 2 * D; ++side) {
      const auto axis = static_cast<std::size_t>(side / 2);
      const int cell = (side % 2 == 0 ? cells.lower[axis] : cells.upper[axis] - 1) - corner[axis];  // next to the side
      if (cell < 0 || cell >= (D == 1 ? 64 : line)) continue;
      Passage passage;
      passage.block = b, passage.side = side, passage.face = cell % line + side % 2;
      passage.mass.resize(gas.fluids.size()), passage.step.mass.resize(gas.fluids.size());
      for (int n = 0; n < (D == 3 ? 8 : 1); ++n)
        for (int l = 0; l < 8; ++l) {
          // The cell next to the side on line l of pencil n: the lines of a pencil along x lie beside each other along y, the
          // others along x.
          std::array<int, 3> at = corner;
          if (D == 1) {
            if (l != cell / line) continue;
            at[0] += cell;
          } else {
            at[axis] += cell;
            at[axis == 0 ? 1 : 0] += l;
            if (D == 3) at[axis == 2 ? 1 : 2] += n;
          }
          if (cells.contains(at)) passage.lanes[static_cast<std::size_t>(n)] |= static_cast<std::uint8_t>(1u << l);
        }
      gas.passage_of[block][static_cast<std::size_t>(side)] = static_cast<std::int32_t>(gas.passages.size());
      gas.passages.push_back(passage);
    }
    if (gas.gravity == Vector{}) continue;
    Passage weight;
    weight.block = b, weight.side = 2 * D;
    weight.mass.resize(gas.fluids.size()), weight.step.mass.resize(gas.fluids.size());
    gas.passage_of[block].back() = static_cast<std::int32_t>(gas.passages.size());
    gas.passages.push_back(weight);
  }
}

void clear_step(std::vector<Passage>& passages) {
  for (Passage& p : passages) {
    std::fill(p.step.mass.begin(), p.step.mass.end(), 0.0);
    p.step.momentum.fill(0.0), p.step.energy = 0.0;
  }
}

void book_step(std::vector<Passage>& passages) {
  for (Passage& p : passages) {
    for (std::size_t r = 0; r < p.mass.size(); ++r) p.mass[r].add(p.step.mass[r]);
    for (std::size_t a = 0; a < 3; ++a) p.momentum[a].add(p.step.momentum[a]);
    p.energy.add(p.step.energy);
  }
}

}  // namespace brisance::simulator::gas
