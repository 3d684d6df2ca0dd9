// The end of a step with bodies: whether the cells bear it, what has passed the sides of the box, what is kept.

#include <algorithm>

#include "simulator/gas/bodies_step.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/passages.hpp"

namespace brisance::simulator::gas::unsplit {

bool all_is_well(Gas& gas) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  const StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  std::vector<char> good(gas.cells.mine.size(), 1);
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const Index index = gas.cells.index(block, c);
      if (!gas.cells.contains(index)) continue;
      const std::size_t n = w.at(index);
      if (bodies.next_space.volume[n] == 0.0) continue;
      const double cell_volume = whole_cell(gas.cells, index[0]).volume;
      double mass = 0.0, cold = 0.0, kinetic = 0.0;
      bool fine = true;
      for (std::size_t r = 0; r < gas.fluids.size(); ++r) {
        const double own = s.content[content_of(w, r, Content::mass)][n];
        mass += own;
        if (!(own >= 0.0)) fine = false;
        const Fluid& fluid = gas.fluids[r];
        const double volume = gas.fluids.size() == 1 ? cell_volume : s.content[content_of(w, r, Content::volume)][n];
        cold += own * coldest_energy(fluid, Lanes(volume > 0.0 ? own / volume : fluid.usual_density))[0];
        if (volume < -1e-14 * cell_volume) fine = false;
      }
      for (std::size_t a = 0; a < D; ++a)
        kinetic += 0.5 * s.content[Content::momentum + a][n] * s.content[Content::momentum + a][n];
      if (fine && mass > 0.0 && s.content[Content::energy][n] - kinetic / mass > cold) continue;
      gas.marks.cell(block, 0, c) = 1.0, good[i] = 0;
    }
  });
  return std::all_of(good.begin(), good.end(), [](char g) { return g != 0; });
}

void book_sides(Gas& gas, double dt) {
  const StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(gas.dimensions());
  for_each_side_face(gas, [&](Passage& passage, double sign, std::size_t a, std::size_t n) {
    passage.step.momentum[a] += sign * dt * gas.bodies.step.area[a][n] * s.pressure[a][n];
    passage.step.energy += sign * (dt * s.pressure[a][n] * s.flow[a][n] + s.passing[a][Content::energy][n]);
    for (std::size_t b = 0; b < D; ++b) passage.step.momentum[b] += sign * s.passing[a][Content::momentum + b][n];
    for (std::size_t r = 0; r < gas.fluids.size(); ++r)
      passage.step.mass[r] += sign * s.passing[a][content_of(gas.bodies.window, r, Content::mass)][n];
  });
}

void keep(Gas& gas) {
  const StepFields& s = gas.bodies.fields;
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const Index index = gas.cells.index(block, c);
      if (!gas.cells.contains(index)) continue;
      const std::size_t n = gas.bodies.window.at(index);
      for (std::size_t q = 1; q < s.content.size(); ++q) gas.content.cell(block, static_cast<int>(q), c) = s.content[q][n];
    }
  });
}

}  // namespace brisance::simulator::gas::unsplit
