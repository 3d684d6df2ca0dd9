// Bodies that meet what they must not touch.

#include <fmt/format.h>

#include <algorithm>

#include "simulator/gas/bodies_step.hpp"

namespace brisance::simulator::gas::unsplit {
namespace {

/// A body whose face closes in on a wall of the box, until a cell between them has so little gas that it would share it with
/// its mirror image: half a cell from the wall. One that slides along a wall, or reaches through it, has no such face.
void note_meeting_with_side(const Gas& gas, Meeting& meeting) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  for (const CutCell& c : bodies.step.cut) {
    const double size = magnitude(c.wall);
    const std::int32_t small = bodies.small.number[c.cell];
    if (c.body < 0 || size == 0.0 || small < 0) continue;
    const Neighbourhood& hood = bodies.small.small[static_cast<std::size_t>(small)];
    const auto any_member = [&](auto&& where) {
      return std::any_of(hood.members.begin(), hood.members.begin() + hood.count, where);
    };
    if (!any_member([&](std::size_t n) { return gas.cells.contains(w.index(n)); })) continue;
    for (std::size_t side = 0; side < 2 * static_cast<std::size_t>(w.dimensions); ++side) {
      if (gas.edges[side].kind != EdgeKind::wall) continue;
      const std::size_t a = side / 2;
      const double outward = side % 2 == 0 ? -1.0 : 1.0;
      constexpr double facing = 0.5;  // cosine
      const bool closes_in = outward * c.wall[a] < -facing * size && outward * c.velocity[a] > 0.0;
      if (!closes_in || !gas.cells.contains(w.index(c.cell))) continue;
      const bool beyond = any_member([&](std::size_t n) {
        const int at = w.index(n)[a];
        return side % 2 == 0 ? at < gas.cells.lower[a] : at >= gas.cells.upper[a];
      });
      if (beyond) meeting.note({c.body, Meeting::of_side(side)});
    }
  }
}

/// Two bodies that push into each other: at a node they fill more than there is, and more than they did at the start.
void note_meeting_of_bodies(const Gas& gas, Meeting& meeting) {
  const Bodies& bodies = gas.bodies;
  const auto at_start = [&](const std::pair<int, int>& pair) {
    const auto found = bodies.built_in.find(pair);
    return found == bodies.built_in.end() ? 1.0 : found->second;
  };
  constexpr double deeper = 0.1;
  for_each_cell_of(bodies.nodes.touched, [&](const Index& node) {
    const std::size_t n = bodies.window.at(node);
    const double fraction = shared_fraction(bodies.nodes, n);
    if (fraction == 0.0) return;
    const std::pair<int, int> pair = sharing_bodies(bodies.nodes, n);
    if (fraction > at_start(pair) + deeper) meeting.note(pair);
  });
}

}  // namespace

void note_meetings(const Gas& gas, Meeting& meeting) {
  note_meeting_with_side(gas, meeting);
  note_meeting_of_bodies(gas, meeting);
}

void note_bodies_around(const Bodies& bodies, const Index& cell, Meeting& meeting) {
  int lowest = Meeting::none, highest = -1;
  Part around;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool used = static_cast<int>(a) < bodies.window.dimensions;
    around.lower[a] = cell[a] - (used ? 1 : 0), around.upper[a] = cell[a] + (used ? 3 : 1);
  }
  for_each_cell_of(around, [&](const Index& node) {
    const std::size_t n = bodies.window.at(node);
    constexpr double solid = 0.5;
    if (bodies.nodes.fraction[n] < solid) return;
    lowest = std::min<int>(lowest, bodies.nodes.body[n]), highest = std::max<int>(highest, bodies.nodes.body[n]);
  });
  if (highest > lowest) meeting.note({lowest, highest});
}

bool bodies_meet(const Gas& gas, const Meeting& meeting, double dt, Domain& domain) {
  const auto least = [&](int mine) { return -static_cast<int>(domain.maximum(-static_cast<double>(mine))); };
  const int body = least(meeting.pair.first);
  if (body == Meeting::none) return false;
  const int other = least(body == meeting.pair.first ? meeting.pair.second : Meeting::none);
  constexpr double farthest = 0.5;  // cells
  if (fastest(gas) * dt > farthest * gas.cells.cell_size) return true;
  const auto name = [&](int number) { return gas.bodies.all[static_cast<std::size_t>(number)].name; };
  const std::string when = fmt::format("between {:.6g} and {:.6g} s", gas.time, gas.time + dt);
  constexpr const char* advice =
      "and the gas between them has nowhere to go; bodies in the gas must not touch what they approach: end the run before "
      "that, or let the body stop";
  if (other >= 0) throw BodiesMeet(fmt::format("bodies {} and {}: they meet {}, {}", name(body), name(other), when, advice));
  const auto side = static_cast<std::size_t>(Meeting::of_side(0) - other);
  throw BodiesMeet(fmt::format("body {}: it runs into the wall {} {}, {}", name(body), gas.edges[side].name, when, advice));
}

bool gas_changes_sides(const Gas& gas) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  for (const CutCell& c : bodies.step.cut) {
    if (!(bodies.space.volume[c.cell] > 0.0 && bodies.next_space.volume[c.cell] > 0.0)) continue;
    if (!gas.cells.contains(w.index(c.cell))) continue;
    bool before = false, after = false, both = false;
    for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a)
      for (const std::size_t face : {c.cell, c.cell + offset(w, a)}) {
        const bool was = bodies.space.area[a][face] > 0.0, is = bodies.next_space.area[a][face] > 0.0;
        before = before || was, after = after || is, both = both || (was && is);
      }
    if (before && after && !both) return true;
  }
  return false;
}

}  // namespace brisance::simulator::gas::unsplit
