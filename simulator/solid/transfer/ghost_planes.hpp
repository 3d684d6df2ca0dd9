#pragma once
// Weights and lever arms beside planes with ghosts.

#include "simulator/solid/transfer/tile.hpp"

namespace brisance::simulator {

/// A plane with ghosts as a tile sees it: the ghosts are among the nodes of a particle whose nearest node is on the plane.
struct GhostPlane {
  std::size_t axis;
  int plane, inward;  // plane: index in the block
  bool mirror;
};
template <int D>
std::vector<GhostPlane> ghost_planes(const Simulation& s, BlockKey block) {
  std::vector<GhostPlane> planes;
  for (const Boundary& b : s.boundaries)
    if (const int plane = b.has_ghosts() ? local_plane<D>(b, block) : -1; plane >= 0)
      planes.push_back({static_cast<std::size_t>(b.axis), plane, b.inward, b.is_mirror()});
  return planes;
}

/// Lever arms that, folded, are those of the folded weights, N (x_i - x): then a particle's affine motion arrives at the nodes
/// as the linear field that it is. With the arms of the ghosts, a particle at distance y from the plane would leave the node
/// inside with the velocity v + C h^2/(4 y), whatever the step: near the plane its gradient would grow from step to step.
template <std::size_t D>
void reach_inside(const std::vector<GhostPlane>& planes, double h, Weights<D>& w) {
  for (const GhostPlane& p : planes) {
    if (p.mirror) continue;  // what a mirror adds is the motion of the mirrored particle
    const LanesMask beside = w.nearest[p.axis] == static_cast<double>(p.plane);
    if (none(beside)) continue;
    const auto ghost = static_cast<std::size_t>(1 - p.inward), inside = static_cast<std::size_t>(1 + p.inward);
    LineWeights& along = w.along[p.axis];
    const Lanes moved = select(beside, (p.inward * h) * Lanes(along.value[ghost]), Lanes(0.0));
    along.lever[ghost] = Lanes(along.lever[ghost]) + moved, along.lever[inside] = Lanes(along.lever[inside]) - moved;
  }
}

/// Sums of the squares of particles' folded weights: what each sees of a field that it alone has made with mass one.
template <std::size_t D>
Lanes own_weights(const std::vector<GhostPlane>& planes, const Weights<D>& w) {
  Lanes product(1.0);
  for (std::size_t a = 0; a < D; ++a) {
    std::array<Lanes, 3> N{Lanes(w.along[a].value[0]), Lanes(w.along[a].value[1]), Lanes(w.along[a].value[2])};
    for (const GhostPlane& p : planes) {
      if (p.axis != a) continue;
      Lanes& of_ghost = N[static_cast<std::size_t>(1 - p.inward)];
      const Lanes ghost = select(w.nearest[a] == static_cast<double>(p.plane), of_ghost, Lanes(0.0));
      N[1] += (p.mirror ? 0.0 : 2.0) * ghost;
      N[static_cast<std::size_t>(1 + p.inward)] += (p.mirror ? 1.0 : -1.0) * ghost;
      of_ghost -= ghost;
    }
    product *= N[0] * N[0] + N[1] * N[1] + N[2] * N[2];
  }
  return product;
}

}  // namespace brisance::simulator
