#pragma once
// Which nodes of a rigid wall are held: those that particles reach.

#include "simulator/solid/transfer/tile.hpp"

namespace brisance::simulator {

/// The particles that reach a wall within a step of dt (s): the half axis of their deformed shape is not less than their
/// distance at the end. One that is flat and fast would otherwise be beyond the wall before it has touched it.
template <int D>
LanesMask reaching(const Simulation& s, const Body& body, const Eight& eight, const std::array<Lanes, D>& position,
                   const std::array<Lanes, D>& velocity, double dt, const Lanes& half_width, const Boundary& wall) {
  using L = Layout<D>;
  const double h = s.grid.cell_size;
  const auto axis = static_cast<std::size_t>(wall.axis);
  const Lanes approach = dt * max((velocity_of(wall, s.time) - velocity[axis]) * wall.inward, Lanes(0.0));
  const Lanes distance = (position[axis] - s.grid.origin[axis] - wall.position) * wall.inward - approach;
  const LanesMask near = distance <= 2.0 * h;
  if (none(near)) return near;
  const Columns rest(body.particles.rest, eight);
  Lanes stretch(0.0);  // of the row of F that belongs to the normal
  for (int a = 0; a < D; ++a) {
    const Lanes F = rest[L::Rest::deformation_gradient + wall.axis * D + a];
    stretch += F * F;
  }
  constexpr double round_off = 1e-9;
  return near & (distance <= half_width * sqrt(stretch) + round_off * h);
}

/// Tells the nodes on the planes of the rigid walls that particles reach that they do.
template <int D, class FieldOf>
void touch_walls(const Simulation& s, const Body& body, const Eight& eight, const std::array<Lanes, D>& position,
                 const std::array<Lanes, D>& velocity, double dt, const Lanes& half_width, const Weights<D>& w,
                 const BlockPosition& block, const FieldOf& to) {
  using B = Block<D>;
  for (const Boundary& wall : s.boundaries) {
    if (wall.kind != BoundaryKind::rigid_wall) continue;
    const auto axis = static_cast<std::size_t>(wall.axis);
    const LanesMask reached = reaching<D>(s, body, eight, position, velocity, dt, half_width, wall);
    if (none(reached)) continue;
    for (std::size_t p = 0; p < static_cast<std::size_t>(eight.used); ++p) {
      if (!reached[static_cast<int>(p)]) continue;
      // The wall's place in the stencil.
      const int plane = wall.node - block[axis] * B::side - static_cast<int>(w.nearest[axis][static_cast<int>(p)]) + 1;
      const TwoFields fields = to(p);
      for (int k = 0; k < (D == 3 ? 3 : 1); ++k)
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) {
            const int at[3] = {i, j, k};
            if (at[axis] != plane) continue;
            double weight = 1.0;
            for (std::size_t a = 0; a < D; ++a) weight *= w.along[a].value[static_cast<std::size_t>(at[a])][p];
            if (weight == 0.0) continue;
            Lanes& node = fields.at(i + 3 * (j + 3 * k))[w.corner[p] + B::tile_node(i, j, k)];
            if (!touches(node[Channel::touch], wall)) node.set(Channel::touch, node[Channel::touch] + touch_number(wall));
          }
    }
  }
}

}  // namespace brisance::simulator
