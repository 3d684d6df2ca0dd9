#include "simulator/gas/ghosts.hpp"
#include "simulator/gas/fluid_state.hpp"

#include <algorithm>

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
/// A column that rests on a wall, or hangs from one, goes on beyond it: the pressure in the mirror less the weight between.
void continue_column(Gas& gas, const GhostSide& side) {
  const double head = side.inward * gas.gravity[static_cast<std::size_t>(side.axis)] * gas.cells.cell_size;
  if (head == 0.0) return;
  CellSet& set = gas.primitive;
  for (std::size_t k = 0; k < side.mirrored.size(); ++k) {
    const Ghost &mirrored = side.mirrored[k], &nearest = side.nearest[k];
    const double next = set.cell(index(nearest.source_block), Primitive::density, nearest.source_cell);
    const double there = set.cell(index(mirrored.source_block), Primitive::density, mirrored.source_cell);
    const bool first = mirrored.source_block == nearest.source_block && mirrored.source_cell == nearest.source_cell;
    set.cell(index(mirrored.block), Primitive::pressure, mirrored.cell) -= head * (first ? next : 2.0 * next + there);
  }
}

/// f(edge, side) for both sides of the box across an axis; walls and periods are served here.
template <class F>
void fill_ghosts(const Gas& gas, CellSet& set, int axis, int first_component, F&& otherwise) {
  for (const int s : {2 * axis, 2 * axis + 1}) {
    const GhostSide& side = gas.cells.sides[static_cast<std::size_t>(s)];
    const Edge& edge = gas.edges[static_cast<std::size_t>(s)];
    if (is_wall(edge.kind))
      copy(set, side.mirrored, first_component + side.axis);
    else if (edge.kind == EdgeKind::periodic)
      copy(set, side.wrapped, -1);
    else
      otherwise(edge, side);
  }
}

template <class F>
void fill_ghosts(const Gas& gas, CellSet& set, int first_component, F&& otherwise) {
  for (int axis = 0; axis < gas.dimensions(); ++axis) fill_ghosts(gas, set, axis, first_component, otherwise);
}

/// Part of what lies beyond an open side that a cell feels which the gas leaves through it: see share_of_beyond.
double felt(const Gas& gas, const Edge& edge, const GhostSide& side, const Ghost& ghost) {
  const std::size_t block = index(ghost.source_block);
  const double outwards = -side.inward * gas.primitive.cell(block, Primitive::velocity + side.axis, ghost.source_cell);
  return share_of_beyond(edge.kind, outwards / gas.primitive.cell(block, Primitive::sound_speed, ghost.source_cell));
}
/// What is in a ghost cell becomes a mean with what is next to the side.
void mix(CellSet& set, const Ghost& g, double part) {
  if (part == 1.0) return;
  for (int q = 0; q < set.quantities(); ++q) {
    const double inside = set.cell(index(g.source_block), q, g.source_cell);
    double& there = set.cell(index(g.block), q, g.cell);
    there = part > 0.0 ? part * there + (1.0 - part) * inside : inside;
  }
}
void mix_primitives(Gas& gas, const Ghost& g, double part) {
  CellSet& set = gas.primitive;
  const std::size_t block = index(g.block);
  const double density = set.cell(block, Primitive::density, g.cell);
  Vector velocity{};
  for (int a = 0; a < gas.dimensions(); ++a)
    velocity[static_cast<std::size_t>(a)] = set.cell(block, Primitive::velocity + a, g.cell);
  mix(set, g, part);
  const double of_velocity = part_of_velocity(part, density, set.cell(block, Primitive::density, g.cell));
  for (int a = 0; a < gas.dimensions(); ++a) {
    const double inside = set.cell(index(g.source_block), Primitive::velocity + a, g.source_cell);
    set.cell(block, Primitive::velocity + a, g.cell) = inside + of_velocity * (velocity[static_cast<std::size_t>(a)] - inside);
  }
}

/// The state beyond an edge of what was in a ghost cell before it moved for some time (s) along each axis. The cells of a step
/// move with the gas, and so do the ghosts.
Filling moved_beyond(const Gas& gas, const Edge& edge, const Ghost& ghost, double time, const Vector& moved) {
  Vector x = gas.cells.centre(index(ghost.block), ghost.cell);
  const Vector u = edge.beyond(x, time).velocity;
  for (std::size_t a = 0; a < 3; ++a) x[a] += moved[a] * u[a];
  return edge.beyond(x, time);
}

}  // namespace

double share_of_beyond(EdgeKind kind, double outward_mach) {
  if (kind == EdgeKind::inflow) return 1.0;
  const double mach = std::clamp(outward_mach, 0.0, 1.0);
  return 1.0 - mach * mach;
}

double part_of_velocity(double part, double density, double mixed_density) {
  return part == 1.0 ? 1.0 : part * density / mixed_density;
}

void ask_beyond(const Gas& gas, double time) {
  for (std::size_t s = 0; s < gas.cells.sides.size(); ++s) {
    const Edge& edge = gas.edges[s];
    if (is_wall(edge.kind) || edge.kind == EdgeKind::periodic) continue;
    for (const Ghost& g : gas.cells.sides[s].nearest) edge.beyond(gas.cells.centre(index(g.block), g.cell), time);
  }
}

void share_primitives(Gas& gas, double time, Domain& domain) {
  CellSet& set = gas.primitive;
  share(gas.cells, set, domain);
  fill_ghosts(gas, set, Primitive::velocity, [&](const Edge& edge, const GhostSide& side) {
    if (edge.kind == EdgeKind::pressure) {
      copy(set, side.nearest, -1);
      for (const Ghost& g : side.nearest) {
        double& pressure = set.cell(index(g.block), Primitive::pressure, g.cell);
        const double part = felt(gas, edge, side, g);
        const double beyond = edge.beyond(gas.cells.centre(index(g.block), g.cell), time).pressure;
        pressure = part == 1.0 ? beyond : part * beyond + (1.0 - part) * pressure;
      }
      return;
    }
    for (const Ghost& g : side.nearest) {
      const Filling beyond = edge.beyond(gas.cells.centre(index(g.block), g.cell), time);
      write_primitive(gas, index(g.block), g.cell, beyond);
      const double part = felt(gas, edge, side, g);
      if (part < 1.0) mix_primitives(gas, g, part);
    }
  });
  for (std::size_t s = 0; s < gas.cells.sides.size(); ++s)
    if (is_wall(gas.edges[s].kind)) continue_column(gas, gas.cells.sides[s]);
}

namespace {

/// In a mirror faces tilt the other way.
void mirror_tilts(Gas& gas) {
  const int D = gas.dimensions();
  for (const GhostSide& side : gas.cells.sides) {
    if (!is_wall(gas.edges[static_cast<std::size_t>(2 * side.axis + (side.inward > 0 ? 0 : 1))].kind)) continue;
    for (int across = 0; across < D; ++across)
      for (int towards = 0; towards < D; ++towards)
        if ((across == side.axis) != (towards == side.axis))
          for (const Ghost& g : side.mirrored) {
            double& tilt = gas.half_step.cell(index(g.block), HalfStep::area(D, across, towards), g.cell);
            tilt = -tilt;
          }
  }
}

}  // namespace

void share_half_step(Gas& gas, double dt, Domain& domain) {
  CellSet& set = gas.half_step;
  share(gas.cells, set, domain);
  fill_ghosts(gas, set, HalfStep::velocity, [&](const Edge& edge, const GhostSide& side) {
    copy(set, side.nearest, -1);
    Vector moved{};  // along the face what has moved on has been replaced
    moved[static_cast<std::size_t>(side.axis)] = 0.5 * dt;
    for (const Ghost& g : side.nearest) {
      const std::size_t block = index(g.block);
      const double part = felt(gas, edge, side, g);
      if (part == 0.0) continue;
      const Filling now = edge.beyond(gas.cells.centre(block, g.cell), gas.time);
      const Filling beyond = moved_beyond(gas, edge, g, gas.time + 0.5 * dt, moved);
      const auto change = [&](int quantity, double of_it, double before, double after) {
        double& inside = set.cell(block, quantity, g.cell);
        inside = of_it == 1.0 ? after - before : of_it * (after - before) + (1.0 - of_it) * inside;
      };
      change(HalfStep::pressure, part, now.pressure, beyond.pressure);
      if (edge.kind == EdgeKind::pressure) continue;
      const double of_velocity = part_of_velocity(part, now.density, gas.primitive.cell(block, Primitive::density, g.cell));
      for (std::size_t a = 0; a < static_cast<std::size_t>(gas.dimensions()); ++a)
        change(HalfStep::velocity + static_cast<int>(a), of_velocity, now.velocity[a], beyond.velocity[a]);
    }
  });
  mirror_tilts(gas);
}

void share_moved(Gas& gas, int axis, double time, const Vector& moved, Domain& domain) {
  CellSet& set = gas.moved;
  share(gas.cells, set, domain);
  fill_ghosts(gas, set, axis, Content::momentum, [&](const Edge& edge, const GhostSide& side) {
    if (edge.kind == EdgeKind::pressure) return copy(set, side.nearest, -1);
    for (const Ghost& g : side.nearest) {
      write_content(gas, set, index(g.block), g.cell, moved_beyond(gas, edge, g, time, moved));
      mix(set, g, felt(gas, edge, side, g));
    }
  });
}

void share_scalars(const Gas& gas, CellSet& set, Beyond beyond, Domain& domain) {
  constexpr int no_component = -10;
  share(gas.cells, set, domain);
  if (beyond == Beyond::nothing) {
    for (std::size_t s = 0; s < gas.cells.sides.size(); ++s)
      for (const Ghost& g : gas.cells.sides[s].nearest)
        for (int q = 0; q < set.quantities(); ++q) set.cell(index(g.block), q, g.cell) = 0.0;
    for (std::size_t s = 0; s < gas.cells.sides.size(); ++s)
      if (gas.edges[s].kind == EdgeKind::periodic) copy(set, gas.cells.sides[s].wrapped, -1);
    return;
  }
  fill_ghosts(gas, set, no_component, [&](const Edge&, const GhostSide& side) { copy(set, side.nearest, -1); });
}

}  // namespace brisance::simulator::gas
