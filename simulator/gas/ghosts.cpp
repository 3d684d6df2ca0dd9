#include "simulator/gas/ghosts.hpp"

#include "simulator/gas/equilibrium.hpp"

namespace brisance::simulator::gas {
namespace {

std::size_t index(std::int32_t block) {
  return static_cast<std::size_t>(block);
}

/// Copies all quantities; a mirror turns the component of the vector along its axis.
void copy(CellSet& set, const std::vector<Ghost>& ghosts, int turned) {
  for (int q = 0; q < set.quantities(); ++q) {
    const double sign = q == turned ? -1.0 : 1.0;
    for (const Ghost& g : ghosts)
      set.cell(index(g.block), q, g.cell) = sign * set.cell(index(g.source_block), q, g.source_cell);
  }
}
void clear(CellSet& set, const std::vector<Ghost>& ghosts) {
  for (int q = 0; q < set.quantities(); ++q)
    for (const Ghost& g : ghosts) set.cell(index(g.block), q, g.cell) = 0.0;
}

/// f(edge, side) for every side of the box; walls and periods are served here.
template <class F>
void fill_ghosts(const Gas& gas, CellSet& set, int first_component, F&& otherwise) {
  for (std::size_t s = 0; s < gas.cells.sides.size(); ++s) {
    const GhostSide& side = gas.cells.sides[s];
    const Edge& edge = gas.edges[s];
    if (edge.kind == EdgeKind::wall)
      copy(set, side.mirrored, first_component + side.axis);
    else if (edge.kind == EdgeKind::periodic)
      copy(set, side.wrapped, -1);
    else
      otherwise(edge, side);
  }
}

}  // namespace

void share_primitives(Gas& gas, double time, Domain& domain) {
  CellSet& set = gas.primitive;
  share(gas.cells, set, domain);
  fill_ghosts(gas, set, Primitive::velocity, [&](const Edge& edge, const GhostSide& side) {
    if (edge.kind == EdgeKind::pressure) {
      copy(set, side.nearest, -1);
      for (const Ghost& g : side.nearest)
        set.cell(index(g.block), Primitive::pressure, g.cell) =
            edge.beyond(gas.cells.centre(index(g.block), g.cell), time).pressure;
      return;
    }
    for (const Ghost& g : side.nearest) {
      const Filling beyond = edge.beyond(gas.cells.centre(index(g.block), g.cell), time);
      write_primitive(gas, index(g.block), g.cell, beyond);
    }
  });
}

void share_half_step(Gas& gas, Domain& domain) {
  CellSet& set = gas.half_step;
  share(gas.cells, set, domain);
  fill_ghosts(gas, set, HalfStep::velocity, [&](const Edge&, const GhostSide& side) { clear(set, side.nearest); });
}

void share_moved(Gas& gas, double time, Domain& domain) {
  CellSet& set = gas.moved;
  share(gas.cells, set, domain);
  fill_ghosts(gas, set, Content::momentum, [&](const Edge& edge, const GhostSide& side) {
    if (edge.kind == EdgeKind::pressure) return copy(set, side.nearest, -1);
    for (const Ghost& g : side.nearest) {
      const Filling beyond = edge.beyond(gas.cells.centre(index(g.block), g.cell), time);
      write_content(gas, set, index(g.block), g.cell, beyond);
    }
  });
}

}  // namespace brisance::simulator::gas
