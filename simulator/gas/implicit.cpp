#include "simulator/gas/implicit.hpp"

#include <algorithm>

#include "simulator/domain/message.hpp"
#include "simulator/gas/acoustic.hpp"
#include "simulator/gas/ghosts.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/gas/passages.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr double solver_tolerance = 1e-9;  // residual over right side

/// Where in the step the pressures are: in the middle, and a little later in steps so long that sound is not resolved, for then
/// nothing else would make it fade.
double centring(const Gas& gas, double dt) {
  constexpr double later = 0.02;
  return 0.5 + later * std::clamp(dt * gas.wave_rate - 1.0, 0.0, 1.0);
}

/// What a face's law and its pressure are made of.
struct FaceStates {
  Pencil density, pressure, sound, gruneisen, velocity, speed, change, still;
};
template <int D>
void load_states(const Gas& gas, std::size_t block, int axis, int n, FaceStates& s) {
  load<D>(gas.cells, gas.primitive, block, Primitive::density, axis, n, s.density);
  load<D>(gas.cells, gas.primitive, block, Primitive::pressure, axis, n, s.pressure);
  load<D>(gas.cells, gas.primitive, block, Primitive::sound_speed, axis, n, s.sound);
  load<D>(gas.cells, gas.primitive, block, Primitive::gruneisen, axis, n, s.gruneisen);
  load<D>(gas.cells, gas.primitive, block, Primitive::velocity + axis, axis, n, s.velocity);
  load<D>(gas.cells, gas.half_step, block, HalfStep::pressure, axis, n, s.change);
  load_squared_speed<D>(gas, block, axis, n, s.velocity, s.speed);
  s.still.fill(Lanes(0.0));
}

/// The two sides of a face and the waves between them, with a change of the pressures.
struct Face {
  FaceSide L, R;
  FaceWaves waves;
};
Face face_at(const Gas& gas, const FaceStates& s, const Pencil& change, std::size_t f, double half_head) {
  const std::size_t l = ring + f - 1, r = ring + f;
  const FaceSide L = face_side(s.density, s.pressure, s.velocity, change, s.still, l, 0.5, half_head);
  const FaceSide R = face_side(s.density, s.pressure, s.velocity, change, s.still, r, -0.5, half_head);
  return {L, R,
          face_waves(L, R, s.sound[l], s.sound[r], 1.0 + 0.5 * max(s.gruneisen[l], s.gruneisen[r]),
                     sqrt(max(s.speed[l], s.speed[r])), gas.least_mach)};
}

/// The jumps that the slopes leave at a face damp it. That part is explicit, and is cut down to what a long step can bear.
template <int D>
Lanes bearable(const Gas& gas, const Lanes& sound, double dt) {
  return min(Lanes(0.5 * gas.cells.cell_size / (D * dt)) / sound, Lanes(1.0));
}

template <int D>
void find_laws(Gas& gas, std::size_t block, double dt) {
  const double h = gas.cells.cell_size, part_of_step = centring(gas, dt) * dt;
  for (int axis = 0; axis < D; ++axis) {
    const double g = gas.gravity[static_cast<std::size_t>(axis)], half_head = 0.5 * g * h;
    for (int n = 0; n < BlockShape<D>::pencils; ++n) {
      FaceStates s;
      load_states<D>(gas, block, axis, n, s);
      FaceLaw* laws = gas.face_laws.data() + gas.first_face(block, axis, n);
      for (std::size_t f = 0; f < line_faces; ++f) {
        const std::size_t l = ring + f - 1, r = ring + f;
        const auto [L, R, waves] = face_at(gas, s, s.still, f, half_head);
        const Lanes both = s.density[l] + s.density[r];
        const Lanes part = bearable<D>(gas, max(s.sound[l], s.sound[r]), dt);
        laws[f].free = (s.density[l] * L.velocity + s.density[r] * R.velocity) / both +
                       part * waves.sum * (L.pressure - R.pressure) + part_of_step * g;
        laws[f].yield = (2.0 * part_of_step / h) / both;
      }
      for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t) {
        const auto f = static_cast<std::size_t>(passage.face);
        const std::size_t outside = sign > 0.0 ? ring + f - 1 : ring + f, inside = sign > 0.0 ? ring + f : ring + f - 1;
        FaceLaw law = laws[f];
        switch (gas.edges[static_cast<std::size_t>(passage.side)].kind) {
          case EdgeKind::wall:
          case EdgeKind::no_slip:
            law = {Lanes(0.0), Lanes(0.0)};
            break;
          case EdgeKind::inflow:
          case EdgeKind::non_reflecting: {  // what the pressure inside has beyond that outside is that of an outgoing wave
            const LanesMask leaves_room = sign * s.velocity[outside] < s.sound[inside];  // for waves: slower than they
            law = {s.velocity[outside], select(leaves_room, 1.0 / (s.density[inside] * s.sound[inside]), Lanes(0.0))};
            break;
          }
          case EdgeKind::pressure:
          case EdgeKind::periodic:
            return;
        }
        // Other lines of the pencil pass the same face number within the box only in one dimension.
        for (int lane = 0; lane < 8; ++lane)
          if (passage.lanes[static_cast<std::size_t>(n)] >> lane & 1)
            laws[f].free.set(lane, law.free[lane]), laws[f].yield.set(lane, law.yield[lane]);
      });
    }
  }
}

/// The rows of a block's cells.
template <int D>
SystemRows rows_of(const Gas& gas, std::size_t block, double dt) {
  SystemRows rows;
  int first = -1;
  for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
    if (!gas.cells.contains(gas.cells.index(block, c))) continue;
    if (first < 0) first = static_cast<int>(gas.unknown.cell(block, 0, c));
    rows.right_side.push_back(0.0);
  }
  const double weight = centring(gas, dt) * dt;
  for (int axis = 0; axis < D; ++axis)
    for (int n = 0; n < BlockShape<D>::pencils; ++n) {
      Pencil unknown, density, sound, pressure, change;
      load<D>(gas.cells, gas.unknown, block, 0, axis, n, unknown);
      load<D>(gas.cells, gas.primitive, block, Primitive::density, axis, n, density);
      load<D>(gas.cells, gas.primitive, block, Primitive::sound_speed, axis, n, sound);
      load<D>(gas.cells, gas.primitive, block, Primitive::pressure, axis, n, pressure);
      load<D>(gas.cells, gas.half_step, block, HalfStep::pressure, axis, n, change);
      PencilMetric metric;
      load_metric<D>(gas.cells, block, axis, n, metric);
      const FaceLaw* laws = gas.face_laws.data() + gas.first_face(block, axis, n);
      FacePencil flow, conductance;
      for (std::size_t f = 0; f < line_faces; ++f) {
        const Lanes velocity = laws[f].free - laws[f].yield * (pressure[ring + f] - pressure[ring + f - 1]);
        flow[f] = weight * metric.area[f] * velocity, conductance[f] = weight * metric.area[f] * laws[f].yield;
      }
      for (std::size_t c = ring; c < ring + line; ++c) {
        const std::size_t f = c - ring;
        const LanesMask inside = lanes_inside<D>(gas.cells, block, axis, n, static_cast<int>(f));
        const Lanes stiffness = metric.volume[c] / (density[c] * sound[c] * sound[c]);
        for (int l = 0; l < 8; ++l) {
          if (!inside[l]) continue;
          const int row = static_cast<int>(unknown[c][l]);
          double diagonal = conductance[f][l] + conductance[f + 1][l], known = flow[f][l] - flow[f + 1][l];
          if (axis == 0) diagonal += stiffness[l];
          const auto neighbour = [&](std::size_t cell, double coefficient) {
            const int column = static_cast<int>(unknown[cell][l]);
            if (column >= 0)
              rows.entries.push_back({row, column, -coefficient});
            else
              known += coefficient * change[cell][l];
          };
          neighbour(c - 1, conductance[f][l]), neighbour(c + 1, conductance[f + 1][l]);
          rows.entries.push_back({row, row, diagonal});
          rows.right_side[static_cast<std::size_t>(row - first)] += known;
        }
      }
    }
  return rows;
}

}  // namespace

void open_implicit(Gas& gas, Domain& domain) {
  gas.face_laws.resize(gas.swept.size());
  gas.unknown = CellSet(1, gas.cells.packs());
  gas.unknown.resize(gas.cells.blocks.size());
  const auto for_each_cell = [&](auto&& f) {
    for (const std::int32_t b : gas.cells.mine)
      for (int c = 0; c < 8 * gas.cells.packs(); ++c)
        if (gas.cells.contains(gas.cells.index(static_cast<std::size_t>(b), c))) f(static_cast<std::size_t>(b), c);
  };
  std::int64_t mine = 0, next = 0;
  for_each_cell([&](std::size_t, int) { ++mine; });
  Message count;
  append(count, mine);
  const std::vector<Message> counts = all_gather(domain, count);
  for (std::size_t r = 0; r < static_cast<std::size_t>(domain.rank()); ++r)
    next += MessageReader(counts[r]).read<std::int64_t>();
  for (std::size_t block = 0; block < gas.cells.blocks.size(); ++block)
    std::fill_n(gas.unknown.at(block, 0), gas.cells.packs(), Lanes(-1.0));
  for_each_cell([&](std::size_t block, int c) { gas.unknown.cell(block, 0, c) = static_cast<double>(next++); });
  share(gas.cells, gas.unknown, domain);
  for (std::size_t s = 0; s < gas.cells.sides.size(); ++s)
    if (gas.edges[s].kind == EdgeKind::periodic)
      for (const Ghost& g : gas.cells.sides[s].wrapped)
        gas.unknown.cell(static_cast<std::size_t>(g.block), 0, g.cell) =
            gas.unknown.cell(static_cast<std::size_t>(g.source_block), 0, g.source_cell);
}

bool solve_pressure(Gas& gas, double dt, Domain& domain) {
  const std::vector<std::int32_t>& mine = gas.cells.mine;
  for (const std::int32_t b : mine)
    for (int q = 0; q < HalfStep::first_order(gas.dimensions()); ++q)
      std::fill_n(gas.half_step.at(static_cast<std::size_t>(b), q), gas.cells.packs(), Lanes(0.0));
  share_half_step(gas, dt, domain);  // what lies beyond the edges

  std::vector<SystemRows> of_blocks(mine.size());
  for_each_own_block(gas, [&](auto D, std::size_t i, std::size_t block) {
    find_laws<D()>(gas, block, dt);
    of_blocks[i] = rows_of<D()>(gas, block, dt);
  });
  SystemRows rows;
  for (const SystemRows& of_block : of_blocks) {
    rows.entries.insert(rows.entries.end(), of_block.entries.begin(), of_block.entries.end());
    rows.right_side.insert(rows.right_side.end(), of_block.right_side.begin(), of_block.right_side.end());
  }
  const std::optional<std::vector<double>> change = domain.solve_spd(rows, solver_tolerance);
  if (!change) return false;
  auto next = change->begin();
  for (const std::int32_t b : mine) {
    const auto block = static_cast<std::size_t>(b);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c)
      if (gas.cells.contains(gas.cells.index(block, c))) gas.half_step.cell(block, HalfStep::pressure, c) = *next++;
  }
  return true;
}

template <int D>
void solved_faces(Gas& gas, std::size_t block, int axis, int n, double dt, FacePencil& velocity, FacePencil& pressure) {
  const double half_head = 0.5 * gas.gravity[static_cast<std::size_t>(axis)] * gas.cells.cell_size;
  FaceStates s;
  load_states<D>(gas, block, axis, n, s);
  const FaceLaw* laws = gas.face_laws.data() + gas.first_face(block, axis, n);
  for (std::size_t f = 0; f < line_faces; ++f) {
    const std::size_t l = ring + f - 1, r = ring + f;
    const auto [L, R, waves] = face_at(gas, s, s.change, f, half_head);
    const Lanes part = bearable<D>(gas, max(s.sound[l], s.sound[r]), dt) * waves.damping;
    velocity[f] = laws[f].free - laws[f].yield * ((s.pressure[r] + s.change[r]) - (s.pressure[l] + s.change[l]));
    // Without the slopes: with those of the velocity the cells would feel a steeper wave than the matrix lets their faces feel,
    // and some would grow.
    const Lanes low = s.pressure[l] + s.change[l] + half_head * s.density[l];
    const Lanes high = s.pressure[r] + s.change[r] - half_head * s.density[r];
    pressure[f] = (s.density[r] * low + s.density[l] * high) / (s.density[l] + s.density[r]) -
                  part * (waves.Z_L * waves.Z_R) * waves.sum * (R.velocity - L.velocity);
  }
  for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
    const EdgeKind kind = gas.edges[static_cast<std::size_t>(passage.side)].kind;
    if (kind != EdgeKind::inflow && kind != EdgeKind::non_reflecting) return;
    const auto f = static_cast<std::size_t>(passage.face);
    const std::size_t inside = sign > 0.0 ? ring + f : ring + f - 1;
    for (int l = 0; l < 8; ++l)
      if (lanes >> l & 1) pressure[f].set(l, s.pressure[inside][l] + s.change[inside][l]);
  });
}

template void solved_faces<1>(Gas&, std::size_t, int, int, double, FacePencil&, FacePencil&);
template void solved_faces<2>(Gas&, std::size_t, int, int, double, FacePencil&, FacePencil&);
template void solved_faces<3>(Gas&, std::size_t, int, int, double, FacePencil&, FacePencil&);

}  // namespace brisance::simulator::gas
