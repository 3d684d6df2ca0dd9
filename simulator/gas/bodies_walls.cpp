// The walls of bodies: the pressure on them, what it does to the gas and to the bodies.

#include <algorithm>
#include <cmath>

#include "simulator/gas/bodies_step.hpp"
#include "simulator/gas/sums.hpp"

namespace brisance::simulator::gas::unsplit {
namespace {

/// What faces and walls do to a cell, before anything is carried along.
struct WallPush {
  double pressure, momentum_pressure;  // Pa: of the wall, of the gas in the cell
};
WallPush wall_pressure(const Gas& gas, const CutCell& c) {
  const StepFields& s = gas.bodies.fields;
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const std::size_t n = c.cell;
  if (gas.bodies.space.volume[n] == 0.0) {
    // It is being opened: the mean of its faces.
    double sum = 0.0, areas = 0.0;
    for (std::size_t a = 0; a < D; ++a)
      for (const std::size_t face : {n, n + offset(w, a)})
        sum += step.area[a][face] * s.pressure[a][face], areas += step.area[a][face];
    const double p = areas > 0.0 ? sum / areas : 0.0;
    return {p, p};
  }
  const double p = s.primitive[Primitive::pressure][n] + s.half[HalfStep::pressure][n];
  const double size = magnitude(c.wall);
  if (size == 0.0) return {p, p};
  double closing = 0.0;
  for (std::size_t a = 0; a < D; ++a)
    closing += (s.primitive[Primitive::velocity + a][n] + s.half[HalfStep::velocity + a][n] - c.velocity[a]) * c.wall[a] / size;
  const double rho = s.primitive[Primitive::density][n], sound = s.primitive[Primitive::sound_speed][n];
  // The speed of the shock that the wall drives into the gas, or of sound.
  const double push = 0.5 * (1.0 + 0.5 * s.primitive[Primitive::gruneisen][n]) * std::max(closing, 0.0);
  const double wave = push + std::sqrt(sound * sound + push * push);
  return {std::max(std::min(p, 0.0), p + rho * wave * closing), p};
}

/// f(k) for the cut cells k of an own block, in the order of its cells.
template <class F>
void for_each_cut_cell(const Gas& gas, const std::vector<std::int32_t>& number, std::size_t block, F&& f) {
  for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
    const Index index = gas.cells.index(block, c);
    if (!gas.cells.contains(index)) continue;
    const std::size_t n = gas.bodies.window.at(index);
    if (gas.bodies.step.is_cut[n]) f(static_cast<std::size_t>(number[n]));
  }
}

}  // namespace

std::vector<Received> push_by_walls(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  std::vector<Received> received(step.cut.size());
  parallel_for_blocks(step.cut.size(), [&](std::size_t k) {
    const CutCell& c = step.cut[k];
    const WallPush push = wall_pressure(gas, c);
    Received& r = received[k];
    r.impulse = (dt * push.pressure) * c.wall;
    // The pressure of the wall is taken off all around: what is in balance stays so to the last bit. The weight of the gas is
    // what a pressure that rises by `head` along its cell pushes all around the gas: it is taken off the faces, and the wall
    // takes its part of it.
    const double volume = gas.bodies.space.volume[c.cell];
    for (std::size_t a = 0; a < D; ++a) {
      const std::size_t low = c.cell, high = c.cell + offset(w, a);
      const double area_low = step.area[a][low], area_high = step.area[a][high], g = gas.gravity[a];
      const double half_head = volume > 0.0 ? 0.5 * g * gas.cells.cell_size * s.primitive[Primitive::density][c.cell] : 0.0;
      s.change[Content::momentum + a][c.cell] = -dt * (area_high * (s.pressure[a][high] - (push.pressure + half_head)) -
                                                       area_low * (s.pressure[a][low] - (push.pressure - half_head)));
      if (g == 0.0) continue;
      const double mass = volume / whole_cell(gas.cells, w.index(c.cell)[0]).volume * whole_mass(gas, c.cell)[0];
      r.impulse[a] += dt * (g * mass - half_head * (area_high + area_low));
    }
    if (gas.cells.geometry == Geometry::axisymmetric) {
      const double side = 0.5 * (gas.bodies.space.side[c.cell] + gas.bodies.next_space.side[c.cell]);
      s.change[Content::momentum][c.cell] +=
          dt * (w.index(c.cell)[0] < 0 ? -side : side) * (push.momentum_pressure - push.pressure);
    }
    r.work = push.pressure * c.growth, r.push = magnitude(r.impulse);
    s.change[Content::energy][c.cell] -= r.work;
  });
  return received;
}

void push_bodies(Gas& gas, const std::vector<Received>& received, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  std::vector<MovingBody::State>& next = bodies.next;
  std::vector<Received>& sums = bodies.received;
  sums.assign(bodies.all.size(), {});
  StepFields& s = bodies.fields;
  std::vector<std::int32_t> number(bodies.window.length, -1);
  for (std::size_t k = 0; k < bodies.step.cut.size(); ++k) number[bodies.step.cut[k].cell] = static_cast<std::int32_t>(k);
  constexpr std::size_t numbers = 5;
  std::vector<double> mine;
  for (const std::int32_t b : gas.cells.mine) {
    std::vector<double> of_block(numbers * bodies.all.size(), 0.0);
    for_each_cut_cell(gas, number, static_cast<std::size_t>(b), [&](std::size_t k) {
      if (bodies.step.cut[k].body < 0) return;
      double* at_body = of_block.data() + numbers * static_cast<std::size_t>(bodies.step.cut[k].body);
      for (std::size_t a = 0; a < 3; ++a) at_body[a] += received[k].impulse[a];
      at_body[3] += received[k].work, at_body[4] += received[k].push;
    });
    mine.insert(mine.end(), of_block.begin(), of_block.end());
  }
  const std::vector<double> total = sum_of_ranks(mine, numbers * bodies.all.size(), domain);
  std::vector<double> excess(bodies.all.size(), 0.0);  // J per N s
  for (std::size_t b = 0; b < bodies.all.size(); ++b) {
    const double* of = total.data() + numbers * b;
    sums[b] = {{of[0], of[1], of[2]}, of[3], of[4]};
    const MovingBody& body = bodies.all[b];
    if (body.mass == 0.0) continue;
    const auto axis = static_cast<std::size_t>(body.axis);
    const double before = body.state.velocity[axis],
                 after = before + sums[b].impulse[axis] / body.mass + dt * gas.gravity[axis];
    next[b].velocity[axis] = after, next[b].acceleration[axis] = (after - before) / dt;
    const double done = sums[b].impulse[axis] * (0.5 * (before + after));
    if (!(sums[b].push > 0.0)) continue;
    excess[b] = (sums[b].work - done) / sums[b].push;
    sums[b].work = done;
  }
  for (std::size_t k = 0; k < bodies.step.cut.size(); ++k) {
    const CutCell& c = bodies.step.cut[k];
    if (c.body >= 0) s.change[Content::energy][c.cell] += excess[static_cast<std::size_t>(c.body)] * received[k].push;
  }
}

}  // namespace brisance::simulator::gas::unsplit
