#include "simulator/gas/outline.hpp"

#include <algorithm>

#include "simulator/gas/contour.hpp"

namespace brisance::simulator::gas {
namespace {

struct Corner {
  Vector place;
  double depth;  // below the surface, in cells; negative in the gas
};

/// Adds what a triangle has of the solid and of its surface; the depth is linear in it.
void add_triangle(Outline& outline, const std::array<Corner, 3>& corners) {
  std::vector<Vector> solid, crossings;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &from = corners[k], &to = corners[(k + 1) % 3];
    if (from.depth >= 0.0) solid.push_back(from.place);
    if ((from.depth < 0.0) == (to.depth < 0.0)) continue;
    crossings.push_back(from.place + from.depth / (from.depth - to.depth) * (to.place - from.place));
    solid.push_back(crossings.back());
  }
  if (!solid.empty()) outline.solid.push_back(std::move(solid));
  if (crossings.size() == 2) outline.contour.push_back({crossings[0], crossings[1]});
}

/// Adds the part of a face of the box that a body lies against.
void add_at_side(Outline& outline, const Corner& from, const Corner& to) {
  if (from.depth < 0.0 && to.depth < 0.0) return;
  const auto surface = [&] { return from.place + from.depth / (from.depth - to.depth) * (to.place - from.place); };
  outline.contour.push_back({from.depth < 0.0 ? surface() : from.place, to.depth < 0.0 ? surface() : to.place});
}

}  // namespace

Outline outline_of(const Gas& gas, int layer) {
  Outline outline;
  const Bodies& bodies = gas.bodies;
  if (bodies.empty() || bodies.window.empty()) return outline;
  std::vector<BodyPoints> points;
  for (const MovingBody& body : bodies.all) points.push_back(points_of(body, gas.cells.geometry, body.state, body.state, 0.0));
  BodyNodes nodes;
  put_on_nodes(bodies.window, gas.cells, images_of(gas), points, nodes);
  const Cells& cells = gas.cells;
  const bool space = cells.dimensions == 3;
  const auto corner = [&](int i, int j) {
    const auto depth = [&](int k) { return depth_of(nodes.fraction[bodies.window.at({i, j, k})]); };
    return Corner{{i * cells.cell_size, j * cells.cell_size, 0.0}, space ? 0.5 * (depth(layer) + depth(layer + 1)) : depth(0)};
  };
  for (const std::int32_t b : cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    for (int c = 0; c < 8 * cells.packs(); ++c) {
      const std::array<int, 3> at = cells.index(block, c);
      if (!cells.contains(at) || (space && at[2] != layer)) continue;
      const auto [i, j, k] = at;
      const std::array around = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      if (std::all_of(around.begin(), around.end(), [](const Corner& x) { return x.depth < 0.0; })) continue;
      Corner centre{};
      for (const Corner& x : around) centre.place = centre.place + 0.25 * x.place, centre.depth += 0.25 * x.depth;
      for (std::size_t n = 0; n < 4; ++n) add_triangle(outline, {around[n], around[(n + 1) % 4], centre});
      const bool axis = is_round(cells.geometry) && cells.lower[0] == 0;
      const bool at_side[] = {j == cells.lower[1], i + 1 == cells.upper[0], j + 1 == cells.upper[1],
                              i == cells.lower[0] && !axis};
      for (std::size_t n = 0; n < 4; ++n)
        if (at_side[n]) add_at_side(outline, around[n], around[(n + 1) % 4]);
    }
  }
  return outline;
}

}  // namespace brisance::simulator::gas
