// One step of a gas with bodies in it: what lagrangian.cpp and remap.cpp do axis by axis is done for all axes at once, because
// the volumes between the sweeps of a split remap need not be positive in cells that a wall cuts.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/domain/message.hpp"
#include "simulator/gas/acoustic.hpp"
#include "simulator/gas/donor.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/gas.hpp"
#include "simulator/gas/ghosts.hpp"
#include "simulator/gas/limiter.hpp"
#include "simulator/gas/passages.hpp"
#include "simulator/gas/sums.hpp"
#include "simulator/gas/timed.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;
using Index = std::array<int, 3>;
using Column = StepFields::Column;

std::size_t offset(const Window& w, std::size_t axis) {
  return static_cast<std::size_t>(w.stride[axis]);
}
Lanes at(const Column& column, std::size_t n) {
  return Lanes::load(column.data() + n);
}
/// Volumes of eight whole cells.
Lanes whole_volumes(const Cells& cells, const Window& w, std::size_t n) {
  Lanes whole;
  for (int l = 0; l < 8; ++l) {
    const std::size_t cell = std::min(n + static_cast<std::size_t>(l), w.first + w.cells - 1);
    whole.set(l, whole_cell(cells, w.index(cell)[0]).volume);
  }
  return whole;
}
/// Calls f(n) for the first of every eight cells of the window.
template <class F>
void for_each_eight(const Window& w, F&& f) {
  constexpr std::size_t share = 128;
  const std::size_t eights = (w.cells + 7) / 8;
  parallel_for_blocks((eights + share - 1) / share, [&](std::size_t part) {
    const std::size_t end = std::min(eights, (part + 1) * share);
    for (std::size_t k = part * share; k < end; ++k) f(w.first + 8 * k);
  });
}

// The window's cells -----------------------------------------------------------------------------------------------------

void make_room(const Gas& gas, StepFields& s, std::size_t length) {
  if (s.volume.size() == length) return;
  const auto D = static_cast<std::size_t>(gas.dimensions());
  const auto columns = [&](std::vector<Column>& all, std::size_t count) { all.assign(count, Column(length, 1.0)); };
  const auto contents = static_cast<std::size_t>(gas.contents());
  columns(s.primitive, static_cast<std::size_t>(gas.primitive.quantities()));
  columns(s.content, contents), columns(s.change, contents), columns(s.half, 1 + D);
  for (Column* c : {&s.volume, &s.density, &s.energy, &s.covered, &s.mean, &s.plain}) c->assign(length, 1.0);
  for (std::size_t a = 0; a < D; ++a) {
    s.flow[a].assign(length, 0.0), s.pressure[a].assign(length, 0.0), s.velocity[a].assign(length, 0.0);
    columns(s.passing[a], contents);
  }
  if (gas.fluids.size() > 1)
    for (auto* all : {&s.part, &s.fluid_density, &s.fluid_energy}) columns(*all, gas.fluids.size());
}

/// How a block's position repeats: all shifts by periods, none among them.
std::vector<Index> shifts_of(const Gas& gas) {
  std::vector<Index> shifts{Index{}};
  for (std::size_t a = 0; a < static_cast<std::size_t>(gas.dimensions()); ++a) {
    if (gas.edges[2 * a].kind != EdgeKind::periodic) continue;
    const int period = gas.cells.upper[a] - gas.cells.lower[a];
    const std::size_t before = shifts.size();
    // A box narrower than the window sees itself more than once.
    const int times = (Window::depth + period - 1) / period;
    for (int n = -times; n <= times; ++n)
      for (std::size_t k = 0; k < before && n != 0; ++k) {
        shifts.push_back(shifts[k]);
        shifts.back()[a] += n * period;
      }
  }
  return shifts;
}
/// The part of a shifted block that is of the box and of a window.
Part seen_part(const Cells& cells, const Index& corner, const Index& shift, const Part& window) {
  Part p;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool used = static_cast<int>(a) < cells.dimensions;
    p.lower[a] = used ? std::max({std::max(corner[a], cells.lower[a]) + shift[a], window.lower[a]}) : 0;
    p.upper[a] = used ? std::min({std::min(corner[a] + line, cells.upper[a]) + shift[a], window.upper[a]}) : 1;
    if (p.lower[a] >= p.upper[a]) return {};
  }
  return p;
}

/// A quantity of the cells, and the column that it goes to.
struct Gathered {
  const CellSet* set;
  int quantity;
  Column* column;
};

/// Takes what the own blocks and those of other ranks hold into the window.
void gather(const Gas& gas, const std::vector<Gathered>& wanted, Domain& domain) {
  const Bodies& bodies = gas.bodies;
  const Cells& cells = gas.cells;
  const Window& w = bodies.window;
  const std::vector<Index> shifts = shifts_of(gas);
  const auto me = static_cast<std::size_t>(domain.rank());
  const auto place = [&](const Index& corner, auto&& numbers_of) {
    for (const Index& shift : shifts) {
      const Part seen = seen_part(cells, corner, shift, bodies.windows[me]);
      if (seen.empty()) continue;
      for (int k = seen.lower[2]; k < seen.upper[2]; ++k)
        for (int j = seen.lower[1]; j < seen.upper[1]; ++j) {
          const int from = (seen.lower[0] - shift[0] - corner[0]) + 8 * (j - shift[1] - corner[1]) +
                           (w.dimensions == 3 ? 64 * (k - shift[2] - corner[2]) : 0);
          const std::size_t to = w.at({seen.lower[0], j, k});
          const auto count = static_cast<std::size_t>(seen.upper[0] - seen.lower[0]);
          for (std::size_t q = 0; q < wanted.size(); ++q)
            std::copy_n(numbers_of(q) + from, count, wanted[q].column->data() + to);
        }
    }
  };
  const auto packs = static_cast<std::size_t>(cells.packs());
  if (domain.size() > 1) {
    std::vector<Message> messages(bodies.windows.size());
    for (std::size_t r = 0; r < messages.size(); ++r) {
      if (r == me) continue;
      for (const std::int32_t b : cells.mine) {
        const auto block = static_cast<std::size_t>(b);
        const Index corner = cells.corner(block);
        const bool seen = std::any_of(shifts.begin(), shifts.end(), [&](const Index& shift) {
          return !seen_part(cells, corner, shift, bodies.windows[r]).empty();
        });
        if (!seen) continue;
        append(messages[r], corner);
        for (const Gathered& g : wanted) append(messages[r], g.set->at(block, g.quantity), packs);
      }
    }
    std::vector<Lanes> numbers(wanted.size() * packs);
    for (const Message& message : domain.exchange(std::move(messages)))
      for (MessageReader reader(message); !reader.at_end();) {
        const auto corner = reader.read<Index>();
        reader.read(numbers.data(), numbers.size());
        place(corner, [&](std::size_t q) { return reinterpret_cast<const double*>(numbers.data() + q * packs); });
      }
  }
  for (const std::int32_t b : cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    place(cells.corner(block),
          [&](std::size_t q) { return reinterpret_cast<const double*>(wanted[q].set->at(block, wanted[q].quantity)); });
  }
}

/// The state at the start of the step, and which cells do without slopes.
void gather_state(Gas& gas, Domain& domain) {
  StepFields& s = gas.bodies.fields;
  std::vector<Gathered> wanted;
  for (std::size_t q = 0; q < s.primitive.size(); ++q) wanted.push_back({&gas.primitive, static_cast<int>(q), &s.primitive[q]});
  for (std::size_t q = 0; q < s.content.size(); ++q) wanted.push_back({&gas.content, static_cast<int>(q), &s.content[q]});
  if (gas.careful) wanted.push_back({&gas.half_step, HalfStep::plain(gas.dimensions()), &s.plain});
  gather(gas, wanted, domain);
}

/// Writes a state into a cell of the window.
void write_state(Gas& gas, const Filling& filling, const Index& cell, std::size_t n) {
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(gas.dimensions());
  // Through a cell of scratch.
  const auto block = static_cast<std::size_t>(gas.cells.mine.front());
  write_content(gas, gas.next, block, 0, filling);
  const double room = gas.next.cell(block, Content::room, 0), part = whole_cell(gas.cells, cell[0]).volume / room;
  for (std::size_t q = 0; q < s.content.size(); ++q) s.content[q][n] = part * gas.next.cell(block, static_cast<int>(q), 0);
  double kinetic = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    s.primitive[Primitive::velocity + a][n] = filling.velocity[a];
    kinetic += 0.5 * filling.density * filling.velocity[a] * filling.velocity[a];
  }
  const EquationOfState& law = gas.fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state;
  const double energy = (gas.next.cell(block, Content::energy, 0) / room - kinetic) / filling.density;
  s.primitive[Primitive::density][n] = filling.density, s.primitive[Primitive::pressure][n] = filling.pressure;
  s.primitive[Primitive::sound_speed][n] = std::sqrt(eos::sound_speed_squared(law, filling.density, energy));
  s.primitive[Primitive::gruneisen][n] = eos::gruneisen_coefficient(law, filling.density, energy);
  for (std::size_t r = 0; gas.fluids.size() > 1 && r < gas.fluids.size(); ++r)
    s.primitive[Primitive::velocity + D + r][n] = static_cast<int>(r) == filling.fluid ? 1.0 : 0.0;
}

/// What lies beyond the box, axis by axis.
void fill_beyond(Gas& gas) {
  const Cells& cells = gas.cells;
  const Window& w = gas.bodies.window;
  StepFields& s = gas.bodies.fields;
  for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a) {
    if (gas.edges[2 * a].kind == EdgeKind::periodic) continue;
    const int lower = cells.lower[a], upper = cells.upper[a];
    Part all;
    for (std::size_t b = 0; b < 3; ++b) all.lower[b] = w.lower[b], all.upper[b] = w.lower[b] + w.size[b];
    const auto fill_cell = [&](const Index& cell) {
      Index from = cell;
      double sign = 1.0;
      const Edge& edge = gas.edges[2 * a + (cell[a] < lower ? 0 : 1)];
      while (from[a] < lower || from[a] >= upper) {
        const bool low = from[a] < lower;
        if (gas.edges[2 * a + (low ? 0 : 1)].kind == EdgeKind::wall)
          from[a] = 2 * (low ? lower : upper) - 1 - from[a], sign = -sign;
        else
          from[a] = low ? lower : upper - 1;
      }
      const std::size_t n = w.at(cell), source = w.at(from);
      for (Column& column : s.primitive) column[n] = column[source];
      for (Column& column : s.content) column[n] = column[source];
      s.plain[n] = s.plain[source];
      s.primitive[Primitive::velocity + a][n] *= sign, s.content[Content::momentum + a][n] *= sign;
      if (edge.kind == EdgeKind::wall) return;
      Vector x{};
      for (std::size_t b = 0; b < static_cast<std::size_t>(w.dimensions); ++b) x[b] = (cell[b] + 0.5) * cells.cell_size;
      const double outwards = (cell[a] < lower ? -1.0 : 1.0) * s.primitive[Primitive::velocity + a][source];
      const double part = share_of_beyond(edge.kind, outwards / s.primitive[Primitive::sound_speed][source]);
      if (part == 0.0) return;
      const Filling beyond = edge.beyond(x, gas.time);
      if (edge.kind == EdgeKind::pressure)
        s.primitive[Primitive::pressure][n] = beyond.pressure;
      else
        write_state(gas, beyond, cell, n);
      if (part == 1.0) return;
      Vector velocity{};
      for (std::size_t b = 0; b < static_cast<std::size_t>(w.dimensions); ++b)
        velocity[b] = s.primitive[Primitive::velocity + b][n];
      const double density = s.primitive[Primitive::density][n];
      for (std::vector<Column>* columns : {&s.primitive, &s.content})
        for (Column& column : *columns) column[n] = part * column[n] + (1.0 - part) * column[source];
      const double of_velocity = part * density / s.primitive[Primitive::density][n];  // momentum is mixed
      for (std::size_t b = 0; b < static_cast<std::size_t>(w.dimensions); ++b)
        s.primitive[Primitive::velocity + b][n] =
            std::lerp(s.primitive[Primitive::velocity + b][source], velocity[b], of_velocity);
    };
    Part low = all, high = all;
    low.upper[a] = std::min(lower, all.upper[a]), high.lower[a] = std::max(upper, all.lower[a]);
    if (low.lower[a] < low.upper[a]) for_each_cell_of(low, fill_cell);
    if (high.lower[a] < high.upper[a]) for_each_cell_of(high, fill_cell);
  }
}

// The Lagrangian phase ---------------------------------------------------------------------------------------------------

Lanes slope_at(const Column& q, std::size_t n, std::size_t step, const LanesMask& smooth) {
  return select(smooth, monotonised_central(at(q, n - step), at(q, n), at(q, n + step)), Lanes(0.0));
}

void half_step(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const double h = gas.cells.cell_size;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const bool round = is_round(gas.cells.geometry);
  for_each_eight(w, [&](std::size_t n) {
    const Lanes density = at(s.primitive[Primitive::density], n), sound = at(s.primitive[Primitive::sound_speed], n);
    Lanes divergence(0.0);
    LanesMask whole(true);
    for (std::size_t a = 0; a < D; ++a) {
      const LanesMask smooth = at(step.smooth[a], n) > 0.5;
      const Lanes push = slope_at(s.primitive[Primitive::pressure], n, offset(w, a), smooth);
      ((-0.5 * dt / h) * push / density).store(s.half[HalfStep::velocity + a].data() + n);
      divergence += slope_at(s.primitive[Primitive::velocity + a], n, offset(w, a), smooth);
      whole &= smooth;
    }
    divergence *= 1.0 / h;
    if (round) {
      Lanes widening;
      for (int l = 0; l < 8; ++l) {
        const std::size_t cell = std::min(n + static_cast<std::size_t>(l), w.first + w.cells - 1);
        widening.set(l, gas.cells.metric.widening[static_cast<std::size_t>(w.index(cell)[0] - gas.cells.metric.first)]);
      }
      divergence += select(whole, widening * at(s.primitive[Primitive::velocity], n), Lanes(0.0));
    }
    (-0.5 * dt * density * sound * sound * divergence).store(s.half[HalfStep::pressure].data() + n);
    if (!gas.careful) return;
    const LanesMask plain = at(s.plain, n) > 0.0;
    for (Column& half : s.half) select(plain, Lanes(0.0), at(half, n)).store(half.data() + n);
  });
}

FaceSide face_side(const StepFields& s, const Window& w, const CutCells& step, std::size_t n, std::size_t axis, double towards,
                   const LanesMask& plain) {
  const LanesMask smooth = at(step.smooth[axis], n) > 0.5;
  const auto slope_of = [&](int quantity) {
    return slope_at(s.primitive[static_cast<std::size_t>(quantity)], n, offset(w, axis), smooth);
  };
  const int along = Primitive::velocity + static_cast<int>(axis);
  const Lanes density = at(s.primitive[Primitive::density], n), pressure = at(s.primitive[Primitive::pressure], n),
              velocity = at(s.primitive[static_cast<std::size_t>(along)], n);
  FaceSide side;
  side.density = density + towards * slope_of(Primitive::density);
  side.pressure = pressure + towards * slope_of(Primitive::pressure) + at(s.half[HalfStep::pressure], n);
  side.velocity = velocity + towards * slope_of(along) + at(s.half[HalfStep::velocity + axis], n);
  return trusted(side, density, pressure, velocity, plain);
}
/// Faces between two cells of which one does without slopes.
LanesMask first_order(const Gas& gas, std::size_t low, std::size_t high) {
  if (!gas.careful) return LanesMask(false);
  return at(gas.bodies.fields.plain, low) + at(gas.bodies.fields.plain, high) > 0.0;
}
FaceSide chosen(const LanesMask& yes, const FaceSide& a, const FaceSide& b) {
  return {select(yes, a.velocity, b.velocity), select(yes, a.pressure, b.pressure), select(yes, a.density, b.density)};
}

void find_faces(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const auto speed_at = [&](std::size_t n) {
    Lanes square(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const Lanes u = at(s.primitive[Primitive::velocity + a], n);
      square += u * u;
    }
    return square;
  };
  for (std::size_t a = 0; a < D; ++a)
    for_each_eight(w, [&](std::size_t n) {
      const std::size_t l = n - offset(w, a);
      const LanesMask plain = first_order(gas, l, n);
      FaceSide L = face_side(s, w, step, l, a, 0.5, plain), R = face_side(s, w, step, n, a, -0.5, plain);
      Lanes sound_L = at(s.primitive[Primitive::sound_speed], l), sound_R = at(s.primitive[Primitive::sound_speed], n);
      // A cell that is only being opened has no state to send.
      const LanesMask gas_L = at(gas.bodies.space.volume, l) > 0.0, gas_R = at(gas.bodies.space.volume, n) > 0.0;
      const FaceSide from_L = L;
      L = chosen(gas_L, L, R), R = chosen(gas_R, R, from_L);
      const Lanes c_L = sound_L;
      sound_L = select(gas_L, sound_L, sound_R), sound_R = select(gas_R, sound_R, c_L);
      const Lanes shock = 1.0 + 0.5 * max(at(s.primitive[Primitive::gruneisen], l), at(s.primitive[Primitive::gruneisen], n));
      const Star found = star(L, R, sound_L, sound_R, shock, sqrt(max(speed_at(l), speed_at(n))), gas.least_mach);
      // Gas at rest is so to the last bit.
      const LanesMask calm = (L.pressure == R.pressure) & (L.velocity == R.velocity);
      const Lanes velocity = select(calm, L.velocity, found.velocity);
      Lanes area = at(step.area[a], n);
      const LanesMask open = area > 0.0;
      if (a == 0 && is_round(gas.cells.geometry)) {
        const Lanes cut = area;
        area = area_on_the_way(gas.cells, area, dt * velocity);
        const LanesMask whole = (at(gas.bodies.space.area[0], n) == cut) & open;
        area = select(whole, area, cut);
      }
      select(open, area * velocity, Lanes(0.0)).store(s.flow[a].data() + n);
      // The face on the axis has no area, but a pressure.
      select(gas_L | gas_R, select(calm, L.pressure, found.pressure), Lanes(0.0)).store(s.pressure[a].data() + n);
    });
  // Nothing passes a wall, not even a rounding error.
  for (std::size_t side = 0; side < 2 * D; ++side) {
    const std::size_t a = side / 2;
    const int at_face = side % 2 == 0 ? gas.cells.lower[a] : gas.cells.upper[a];
    if (gas.edges[side].kind != EdgeKind::wall || at_face < w.lower[a] || at_face >= w.lower[a] + w.size[a]) continue;
    Part plane;
    for (std::size_t b = 0; b < 3; ++b) plane.lower[b] = w.lower[b], plane.upper[b] = w.lower[b] + w.size[b];
    plane.lower[a] = at_face, plane.upper[a] = at_face + 1;
    for_each_cell_of(plane, [&](const Index& cell) { s.flow[a][w.at(cell)] = 0.0; });
  }
}

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

/// Pushes cells along; returns what the cut cells give to the bodies, one of each cut cell.
std::vector<Received> push_cells(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  for_each_eight(w, [&](std::size_t n) {
    Lanes growth(0.0), work(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const std::size_t next = n + offset(w, a);
      const Lanes low = at(s.pressure[a], n), high = at(s.pressure[a], next);
      const Lanes in = at(s.flow[a], n), out = at(s.flow[a], next);
      growth += out - in, work += high * out - low * in;
      // The impulse of the pressure on the sides of a widening cell is that of the mean of its two faces.
      (-dt * (0.5 * (at(step.area[a], n) + at(step.area[a], next))) * (high - low))
          .store(s.change[Content::momentum + a].data() + n);
    }
    (-dt * work).store(s.change[Content::energy].data() + n);
    (at(gas.bodies.next_space.volume, n) + dt * growth).store(s.volume.data() + n);
    for (std::size_t q = Content::momentum + D; q < s.change.size(); ++q) Lanes(0.0).store(s.change[q].data() + n);
  });
  std::vector<Received> received(step.cut.size());
  parallel_for_blocks(step.cut.size(), [&](std::size_t k) {
    const CutCell& c = step.cut[k];
    const WallPush push = wall_pressure(gas, c);
    // The pressure of the wall is taken off all around: what is in balance stays so to the last bit.
    for (std::size_t a = 0; a < D; ++a) {
      const std::size_t low = c.cell, high = c.cell + offset(w, a);
      s.change[Content::momentum + a][c.cell] = -dt * (step.area[a][high] * (s.pressure[a][high] - push.pressure) -
                                                       step.area[a][low] * (s.pressure[a][low] - push.pressure));
    }
    if (gas.cells.geometry == Geometry::axisymmetric) {
      const double side = 0.5 * (gas.bodies.space.side[c.cell] + gas.bodies.next_space.side[c.cell]);
      s.change[Content::momentum][c.cell] +=
          dt * (w.index(c.cell)[0] < 0 ? -side : side) * (push.momentum_pressure - push.pressure);
    }
    Received& r = received[k];
    r.impulse = (dt * push.pressure) * c.wall, r.work = push.pressure * c.growth, r.push = magnitude(r.impulse);
    s.change[Content::energy][c.cell] -= r.work;
  });
  return received;
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

/// Sums what each body has received, and gives back to the gas what the work of the wall's pressure exceeds the work on a body
/// that the gas drives by: to each cell as it has pushed. Also sets the bodies' next velocities.
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
    const double before = body.state.velocity[axis], after = before + sums[b].impulse[axis] / body.mass;
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

/// The fluids of a cell share its change of volume and energy by their compressibility.
void share_changes(Gas& gas) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions), fluids = gas.fluids.size();
  const auto first = [&](std::size_t r) { return Content::momentum + D + 3 * r; };
  for_each_eight(w, [&](std::size_t n) {
    const Lanes volume = at(bodies.space.volume, n), open = volume / whole_volumes(gas.cells, w, n);
    Lanes mass(0.0), kinetic_before(0.0), kinetic(0.0);
    for (std::size_t r = 0; r < fluids; ++r) mass += open * at(s.content[first(r) + Content::mass], n);
    for (std::size_t a = 0; a < D; ++a) {
      const Lanes before = open * at(s.content[Content::momentum + a], n),
                  after = before + at(s.change[Content::momentum + a], n);
      kinetic_before += before * before, kinetic += after * after;
    }
    const Lanes growth = at(s.volume, n) - volume;
    const Lanes work = at(s.change[Content::energy], n) - 0.5 * (kinetic - kinetic_before) / mass;
    const LanesMask gas_here = volume > 0.0;
    Lanes rest(1.0), largest(0.0);
    for (std::size_t r = 0; r < fluids; ++r) largest = max(largest, at(s.content[first(r) + Content::volume], n));
    std::vector<Lanes> share(fluids);
    std::vector<LanesMask> majority(fluids);
    LanesMask given(false);
    for (std::size_t r = 0; r < fluids; ++r) {
      const Lanes own = at(s.content[first(r) + Content::volume], n);
      majority[r] = (own == largest) & !given;
      given |= majority[r];
      const Lanes wanted = at(s.primitive[Primitive::velocity + D + r], n);
      share[r] = select(majority[r], Lanes(0.0), limited_share(wanted, growth, open * own));
      rest -= share[r];
    }
    for (std::size_t r = 0; r < fluids; ++r) {
      const Lanes part = select(gas_here, select(majority[r], rest, share[r]), Lanes(0.0));
      select(gas_here, part * growth, Lanes(0.0)).store(s.change[first(r) + Content::volume].data() + n);
      select(gas_here, part * work, Lanes(0.0)).store(s.change[first(r) + Content::internal].data() + n);
    }
  });
}

// The remap --------------------------------------------------------------------------------------------------------------

/// The moved gas as it leaves through the faces: of each cell, or of the neighbourhood of a small one.
void find_donors(Gas& gas) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions), fluids = gas.fluids.size();
  const auto per_fluid = static_cast<std::size_t>(gas.fluid_quantities());
  const auto first = [&](std::size_t r) { return Content::momentum + D + per_fluid * r; };
  // From what a cell holds after the Lagrangian phase.
  const auto write = [&](auto&& held, const auto& volume, auto&& put) {
    auto mass = held(first(0) + Content::mass);
    for (std::size_t r = 1; r < fluids; ++r) mass += held(first(r) + Content::mass);
    auto kinetic = 0.0 * mass;
    for (std::size_t a = 0; a < D; ++a) {
      const auto p = held(Content::momentum + a);
      const auto u = p / mass;
      kinetic += 0.5 * p * u;
      put(s.velocity[a], u);
    }
    put(s.density, mass / volume);
    if (fluids == 1) return put(s.energy, (held(Content::energy) - kinetic) / volume);
    auto internal = 0.0 * mass;
    for (std::size_t r = 0; r < fluids; ++r) {
      using Real = std::decay_t<decltype(mass)>;
      const Real own = held(first(r) + Content::volume), own_mass = held(first(r) + Content::mass);
      const auto present = (own > least_fraction * volume) & (own_mass > 0.0);
      const Real divisor = select(present, own, Real(1.0)), heat = held(first(r) + Content::internal);
      internal += heat;
      put(s.part[r], select(present, Real(own / volume), Real(0.0)));
      put(s.fluid_density[r], Real(own_mass / divisor)), put(s.fluid_energy[r], Real(heat / divisor));
    }
    put(s.energy, internal / volume);
  };
  for_each_eight(w, [&](std::size_t n) {
    const Lanes open = at(bodies.space.volume, n) / whole_volumes(gas.cells, w, n);
    write([&](std::size_t q) { return open * at(s.content[q], n) + at(s.change[q], n); }, at(s.volume, n),
          [&](Column& column, const Lanes& value) { value.store(column.data() + n); });
  });
  std::vector<double> merged(bodies.small.small.size());
  for (std::size_t i = 0; i < bodies.small.small.size(); ++i) {
    const Neighbourhood& hood = bodies.small.small[i];
    const auto sum = [&](auto&& of) {
      double total = 0.0;
      for (int m = 0; m < hood.count; ++m) total += of(hood.members[static_cast<std::size_t>(m)]);
      return total;
    };
    const auto held = [&](std::size_t q) {
      return sum([&](std::size_t n) {
        return bodies.space.volume[n] / whole_cell(gas.cells, w.index(n)[0]).volume * s.content[q][n] + s.change[q][n];
      });
    };
    merged[i] = sum([&](std::size_t n) { return s.volume[n]; });
    write(held, merged[i], [&](Column& column, double value) { column[hood.cell] = value; });
  }
  for (std::size_t i = 0; i < merged.size(); ++i) s.volume[bodies.small.small[i].cell] = merged[i];
}

/// The flow through eight faces: which of the two cells gives, and what part of it.
struct Giving {
  std::size_t low, high, step;
  LanesMask up, smooth;
  Lanes part;

  Lanes of(const Column& q) const { return select(up, at(q, low), at(q, high)); }
  Lanes difference(const Column& q, const Lanes& leaving) const {
    return difference_across_donor(up, at(q, low - step), at(q, low), at(q, high), at(q, high + step), leaving);
  }
  Lanes leaving(const Column& q, const Lanes& own_part, const LanesMask& where) const {
    return of(q) + select(where, 0.5 * (1.0 - own_part) * difference(q, own_part), Lanes(0.0));
  }
  Lanes leaving(const Column& q) const { return leaving(q, part, smooth); }
};

/// Cells of a group of eight that this process owns and that hold gas: what they do is counted.
int count_own(const Gas& gas, const LanesMask& cells, const LanesMask& up, std::size_t low, std::size_t high) {
  const Bodies& bodies = gas.bodies;
  int count = 0;
  for (std::size_t l = 0; l < 8; ++l) {
    if (!cells[static_cast<int>(l)]) continue;
    const std::size_t n = (up[static_cast<int>(l)] ? low : high) + l;
    if (n < bodies.window.first || n >= bodies.window.first + bodies.window.cells || !(bodies.space.volume[n] > 0.0)) continue;
    const Index cell = bodies.window.index(n);
    count += gas.cells.contains(cell) && gas.cells.find(cell) ? 1 : 0;
  }
  return count;
}

/// What passes the faces across an axis. Returns how many slopes of own cells have been taken back.
std::int64_t find_passing(Gas& gas, double dt, std::size_t axis) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions), fluids = gas.fluids.size();
  const auto per_fluid = static_cast<std::size_t>(gas.fluid_quantities());
  std::vector<Column>& passing = s.passing[axis];
  std::atomic<std::int64_t> flattened = 0;
  for_each_eight(w, [&](std::size_t n) {
    const Lanes swept = dt * at(s.flow[axis], n);
    const LanesMask none_passes = swept == 0.0;
    const auto put = [&](std::size_t q, const Lanes& value) {
      select(none_passes, Lanes(0.0), value).store(passing[q].data() + n);
    };
    Giving giving{n - offset(w, axis), n, offset(w, axis), swept > 0.0, LanesMask(false), Lanes(0.0)};
    giving.part = abs(swept) / giving.of(s.volume);
    giving.smooth = (giving.of(bodies.step.smooth[axis]) > 0.5) & !first_order(gas, giving.low, giving.high);
    Lanes mass(0.0), heat(0.0);
    if (fluids == 1) {
      mass = swept * giving.leaving(s.density), heat = swept * giving.leaving(s.energy);
      put(Content::momentum + D, mass);
    } else {
      const Lanes q = abs(swept), sign = select(giving.up, Lanes(1.0), Lanes(-1.0)), room = giving.of(s.volume);
      constexpr double most = 0.999;  // of what the donor has
      Lanes left = q, largest(0.0);
      std::vector<Lanes> volume(fluids);
      for (std::size_t r = 0; r < fluids; ++r) {
        const Lanes part = giving.of(s.part[r]);
        const LanesMask whole = part > 1.0 - least_fraction;
        const Lanes wanted = max(Lanes(q * giving.leaving(s.part[r])), Lanes(0.0));
        volume[r] = select(whole, q, min(wanted, Lanes(most * part * room)));
        left -= volume[r], largest = max(largest, part);
      }
      LanesMask given(false);
      for (std::size_t r = 0; r < fluids; ++r) {
        const Lanes part = giving.of(s.part[r]);
        const LanesMask here = part > 0.0, most_of_it = (part == largest) & !given;
        given |= most_of_it;
        const Lanes own = volume[r] + select(most_of_it, left, Lanes(0.0));
        const Lanes own_part = min(Lanes(own / max(Lanes(part * room), Lanes(1e-300))), Lanes(0.9999));
        // Slopes only where the cell before, this one and the next all have the fluid.
        const Lanes around =
            min(min(at(s.part[r], giving.low), at(s.part[r], giving.high)),
                select(giving.up, at(s.part[r], giving.low - giving.step), at(s.part[r], giving.high + giving.step)));
        const LanesMask smooth = giving.smooth & (around > 0.0);
        const Lanes dm = select(here, sign * own * giving.leaving(s.fluid_density[r], own_part, smooth), Lanes(0.0));
        const Lanes dI = select(here, sign * own * giving.leaving(s.fluid_energy[r], own_part, smooth), Lanes(0.0));
        const std::size_t first = Content::momentum + D + per_fluid * r;
        put(first + Content::mass, dm), put(first + Content::volume, select(here, sign * own, Lanes(0.0)));
        put(first + Content::internal, dI);
        mass += dm, heat += dI;
      }
    }
    const Lanes density = giving.of(s.density), part = abs(mass) / (density * giving.of(s.volume));
    Lanes slopes[3], steepness(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const auto of = [&](std::size_t cell) {
        return monotonised_central(at(s.velocity[a], cell - giving.step), at(s.velocity[a], cell),
                                   at(s.velocity[a], cell + giving.step));
      };
      slopes[a] = select(giving.smooth, select(giving.up, of(giving.low), of(giving.high)), Lanes(0.0));
      steepness += slopes[a] * slopes[a];
    }
    const Leaving leaving = leaving_with_momentum(giving.up, part, density, steepness, giving.of(s.energy), Lanes(1.0));
    if (any(leaving.too_steep))
      flattened += count_own(gas, leaving.too_steep & !none_passes, giving.up, giving.low, giving.high);
    Lanes kinetic(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const Lanes u = giving.of(s.velocity[a]) + leaving.offset * slopes[a];
      put(Content::momentum + a, mass * u), kinetic += 0.5 * mass * u * u;
    }
    put(Content::energy, heat * leaving.heat_kept + kinetic);
  });
  return flattened;
}

/// New contents of the window's cells, by whole cell; in cells without gas what they held. Returns how many slopes of own cells
/// have been taken back.
std::int64_t remap(Gas& gas, double dt) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  std::int64_t flattened = 0;
  for (std::size_t a = 0; a < D; ++a) flattened += find_passing(gas, dt, a);
  for_each_eight(w, [&](std::size_t n) {
    const Lanes whole = whole_volumes(gas.cells, w, n);
    const Lanes before = at(bodies.space.volume, n) / whole, after = at(bodies.next_space.volume, n) / whole;
    for (std::size_t q = 1; q < s.content.size(); ++q) {
      Lanes change = at(s.change[q], n);
      for (std::size_t a = 0; a < D; ++a) change -= at(s.passing[a][q], n + offset(w, a)) - at(s.passing[a][q], n);
      change.store(s.change[q].data() + n);
      const Lanes held = at(s.content[q], n);
      // Nothing changes, to the last bit, where nothing happens.
      const Lanes next = select(before > 0.0, held + (change - held * (after - before)) / after, change / after);
      select(after > 0.0, next, held).store(s.content[q].data() + n);
    }
  });
  return flattened;
}

/// A pair of things that are about to meet, the first pair of all: of two bodies, or of a body and a side of the box.
struct Meeting {
  static constexpr int none = std::numeric_limits<int>::max();
  std::pair<int, int> pair{none, none};  // a body, and another one or a side
  void note(const std::pair<int, int>& other) { pair = std::min(pair, other); }
  static int of_side(std::size_t side) { return -1 - static_cast<int>(side); }
};

/// A body whose face closes in on a wall of the box, until a cell between them has so little gas that it would share it with
/// its mirror image: half a cell from the wall. One that slides along a wall, or reaches through it, has no such face. At an
/// open side it is a body that moves through: a small cell would share its gas with what lies beyond, and no book would know.
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
      const EdgeKind kind = gas.edges[side].kind;
      if (kind == EdgeKind::periodic) continue;
      const std::size_t a = side / 2;
      const double outward = side % 2 == 0 ? -1.0 : 1.0;
      constexpr double facing = 0.5;  // cosine
      const bool closes_in = outward * c.wall[a] < -facing * size && outward * c.velocity[a] > 0.0;
      if (kind == EdgeKind::wall ? !(closes_in && gas.cells.contains(w.index(c.cell))) : c.velocity[a] == 0.0) continue;
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

/// Two bodies that have closed a cell, with its gas in it, between them.
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

/// Ends the run on all ranks alike if something meets on one of them. True if it meets because the step is far too long: then
/// nothing is known.
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
  if (gas.edges[side].kind == EdgeKind::wall)
    throw BodiesMeet(fmt::format("body {}: it runs into the wall {} {}, {}", name(body), gas.edges[side].name, when, advice));
  throw BodiesMeet(fmt::format(
      "body {}: it moves through the open side {} {}, which bodies in the gas cannot; end the run before that, or place the "
      "side farther away",
      name(body), gas.edges[side].name, when));
}

/// Redistributes what small cells hold; adds what has been entrapped in own cells, and by which bodies.
void redistribute_all(Gas& gas, std::vector<double>& entrapped, Meeting& meeting) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const auto per_fluid = static_cast<std::size_t>(gas.fluid_quantities());
  for (std::size_t q = 1; q < s.content.size(); ++q) {
    Column& held = s.content[q];
    for (const std::size_t n : bodies.small.shared) {
      const double whole = whole_cell(gas.cells, w.index(n)[0]).volume;
      const bool covered = bodies.next_space.volume[n] == 0.0;
      s.mean[n] = held[n] / whole;
      s.covered[n] = covered ? bodies.space.volume[n] / whole * held[n] + s.change[q][n] : 0.0;
    }
    std::vector<double> first;
    for (const std::size_t n : bodies.small.shared) first.push_back(s.mean[n]);
    redistribute(w, bodies.small, bodies.next_space.volume, s.mean, s.covered);
    for (std::size_t k = 0; k < bodies.small.shared.size(); ++k) {
      const std::size_t n = bodies.small.shared[k];
      held[n] += whole_cell(gas.cells, w.index(n)[0]).volume * (s.mean[n] - first[k]);
    }
    for (const Neighbourhood& hood : bodies.small.small) {
      if (hood.count > 1 || bodies.next_space.volume[hood.cell] > 0.0) continue;
      const Index cell = w.index(hood.cell);
      if (!gas.cells.contains(cell) || !gas.cells.find(cell)) continue;
      if (q == Content::energy) note_bodies_around(bodies, cell, meeting);
      if (q == Content::energy)
        entrapped.back() += s.covered[hood.cell];
      else if (q < Content::momentum + D)
        entrapped[gas.fluids.size() + q - Content::momentum] += s.covered[hood.cell];
      else if ((q - Content::momentum - D) % per_fluid == Content::mass)
        entrapped[(q - Content::momentum - D) / per_fluid] += s.covered[hood.cell];
    }
  }
}

/// Whether every own cell with gas has mass and more energy than the coldest gas. Marks those that have not.
bool all_is_well(Gas& gas) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  const StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const auto per_fluid = static_cast<std::size_t>(gas.fluid_quantities());
  std::vector<char> good(gas.cells.mine.size(), 1);
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const Index index = gas.cells.index(block, c);
      if (!gas.cells.contains(index)) continue;
      const std::size_t n = w.at(index);
      if (bodies.next_space.volume[n] == 0.0) continue;
      const double room = whole_cell(gas.cells, index[0]).volume;
      double mass = 0.0, thermal = 0.0, kinetic = 0.0;
      bool fine = true;
      for (std::size_t r = 0; r < gas.fluids.size(); ++r) {
        const std::size_t first = Content::momentum + D + per_fluid * r;
        const double own = s.content[first][n];
        mass += own;
        if (!(own >= 0.0)) fine = false;
        if (gas.fluids.size() > 1 && s.content[first + Content::volume][n] < -1e-14 * room) fine = false;
      }
      for (std::size_t a = 0; a < D; ++a)
        kinetic += 0.5 * s.content[Content::momentum + a][n] * s.content[Content::momentum + a][n];
      thermal = s.content[Content::energy][n] - kinetic / mass;
      if (gas.fluids.size() == 1) thermal -= mass * coldest_energy(gas.fluids[0], Lanes(mass / room))[0];
      if (fine && mass > 0.0 && thermal > 0.0) continue;
      gas.marks.cell(block, 0, c) = 1.0, good[i] = 0;
    }
  });
  return std::all_of(good.begin(), good.end(), [](char g) { return g != 0; });
}

/// Whether no own cell gives more than it has. Marks those that do.
bool nothing_is_overdrawn(Gas& gas, double dt) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  const StepFields& s = bodies.fields;
  bool good = true;
  for (const std::int32_t b : gas.cells.mine)
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const Index index = gas.cells.index(static_cast<std::size_t>(b), c);
      if (!gas.cells.contains(index)) continue;
      const std::size_t n = w.at(index);
      if (bodies.small.number[n] >= 0 || (bodies.space.volume[n] == 0.0 && bodies.next_space.volume[n] == 0.0)) continue;
      double out = 0.0;
      for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a)
        out += std::max(s.flow[a][n + offset(w, a)], 0.0) - std::min(s.flow[a][n], 0.0);
      constexpr double most = 0.9;
      if (dt * out <= most * s.volume[n] && s.volume[n] > least_room * bodies.space.volume[n]) continue;
      gas.marks.cell(static_cast<std::size_t>(b), 0, c) = 1.0, good = false;
    }
  return good;
}

/// Books what passes the sides of the box.
void book_sides(Gas& gas, double dt) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  const StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const auto per_fluid = static_cast<std::size_t>(gas.fluid_quantities());
  for (Passage& passage : gas.passages) {
    if (passage.side >= 2 * gas.dimensions()) continue;
    const auto a = static_cast<std::size_t>(passage.side / 2);
    const bool low = passage.side % 2 == 0;
    const double sign = low ? 1.0 : -1.0;
    const Index corner = gas.cells.corner(static_cast<std::size_t>(passage.block));
    Part layer;
    for (std::size_t b = 0; b < 3; ++b) {
      const bool used = b < D;
      layer.lower[b] = used ? std::max(corner[b], gas.cells.lower[b]) : 0;
      layer.upper[b] = used ? std::min(corner[b] + line, gas.cells.upper[b]) : 1;
    }
    layer.lower[a] = low ? gas.cells.lower[a] : gas.cells.upper[a], layer.upper[a] = layer.lower[a] + 1;
    for_each_cell_of(layer, [&](const Index& face) {
      const std::size_t n = w.at(face);
      passage.step.momentum[a] += sign * dt * bodies.step.area[a][n] * s.pressure[a][n];
      passage.step.energy += sign * (dt * s.pressure[a][n] * s.flow[a][n] + s.passing[a][Content::energy][n]);
      for (std::size_t b = 0; b < D; ++b) passage.step.momentum[b] += sign * s.passing[a][Content::momentum + b][n];
      for (std::size_t r = 0; r < gas.fluids.size(); ++r)
        passage.step.mass[r] += sign * s.passing[a][Content::momentum + D + per_fluid * r][n];
    });
  }
}

/// Whether the gas of some own cell has left through one face and come in through another while the wall passed: it would be
/// carried through a thin wall. In a shorter step the cell is closed in between.
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

/// The cells as they are at the end of the step.
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

}  // namespace

bool move_bodies(Gas& gas, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  bodies.next.clear();
  bool still = true;
  for (const MovingBody& body : bodies.all) {
    bodies.next.push_back(moved(body, gas.time, dt));
    const MovingBody::State& next = bodies.next.back();
    still = still && next.displacement == body.state.displacement && next.turn == body.state.turn &&
            next.growth == body.state.growth;
  }
  if (still && bodies.still) return true;
  Meeting meeting;
  bool changes_sides = false;
  if (!bodies.window.empty()) {
    std::vector<BodyPoints> points;
    for (std::size_t b = 0; b < bodies.all.size(); ++b)
      points.push_back(points_of(bodies.all[b], gas.cells.geometry, bodies.all[b].state, bodies.next[b], dt));
    put_on_nodes(bodies.window, gas.cells, images_of(gas), points, bodies.nodes);
    find_open_space(bodies.window, gas.cells, bodies.nodes, bodies.next_space);
    find_cut_cells(bodies.window, gas.cells, bodies.space, bodies.next_space, bodies.nodes, bodies.step);
    find_neighbourhoods(bodies.window, gas.cells, bodies.space, bodies.next_space, bodies.step, bodies.small);
    note_meeting_with_side(gas, meeting);
    note_meeting_of_bodies(gas, meeting);
    changes_sides = gas_changes_sides(gas);
  }
  bodies.still = still;
  return !bodies_meet(gas, meeting, dt, domain) && domain.maximum(changes_sides ? 1.0 : 0.0) == 0.0;
}

bool try_step_with_bodies(Gas& gas, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  const bool here = !bodies.window.empty();
  timed(gas, Phase::ghosts, [&] {
    make_room(gas, bodies.fields, bodies.window.length);
    gather_state(gas, domain);
    if (here) fill_beyond(gas);
  });
  if (here) timed(gas, Phase::half_step, [&] { half_step(gas, dt); });
  timed(gas, Phase::lagrangian, [&] {
    std::vector<Received> received;
    if (here) find_faces(gas, dt), received = push_cells(gas, dt);
    push_bodies(gas, received, dt, domain);
    if (here && gas.fluids.size() > 1) share_changes(gas);
  });
  bodies.entrapped_now.assign(bodies.entrapped.size(), 0.0);
  bool good = true;
  Meeting meeting;
  std::int64_t flattened = 0;
  if (here) {
    timed(gas, Phase::remap, [&] {
      find_donors(gas);
      good = nothing_is_overdrawn(gas, dt);
      flattened = remap(gas, dt);
    });
    timed(gas, Phase::bodies, [&] { redistribute_all(gas, bodies.entrapped_now, meeting); });
    good = timed(gas, Phase::equilibrium, [&] { return all_is_well(gas); }) && good;
  }
  if (bodies_meet(gas, meeting, dt, domain)) return false;
  gas.flattened += flattened;
  return domain.maximum(good ? 0.0 : 1.0) == 0.0;
}

void settle_with_bodies(Gas& gas, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  const bool here = !bodies.window.empty();
  if (here) book_sides(gas, dt), keep(gas);
  const std::vector<double>& entrapped = bodies.entrapped_now;
  const bool lost = std::any_of(entrapped.begin(), entrapped.end(), [](double x) { return x != 0.0; });
  if (domain.maximum(lost ? 1.0 : 0.0) > 0.0) {
    const std::vector<double> total = sum_of_ranks(entrapped, entrapped.size(), domain);
    for (std::size_t n = 0; n < total.size(); ++n) bodies.entrapped[n].add(total[n]);
  }
  for (std::size_t b = 0; b < bodies.all.size(); ++b) {
    MovingBody& body = bodies.all[b];
    body.state = bodies.next[b], body.force = (1.0 / dt) * bodies.received[b].impulse;
    for (std::size_t a = 0; a < 3; ++a) body.impulse[a].add(bodies.received[b].impulse[a]);
    body.work.add(bodies.received[b].work);
  }
  if (here) {
    if (!bodies.still) std::swap(bodies.space, bodies.next_space);
    keep_open_parts(gas);
  }
}

}  // namespace brisance::simulator::gas
