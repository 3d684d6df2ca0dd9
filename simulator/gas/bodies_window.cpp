// The window of a step with bodies: what the cells of all ranks hold, and what lies beyond the box.

#include <algorithm>
#include <cmath>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/domain/message.hpp"
#include "simulator/gas/bodies_step.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/ghosts.hpp"

namespace brisance::simulator::gas::unsplit {
namespace {

namespace eos = equation_of_state;

void allocate(const Gas& gas, StepFields& s, std::size_t length) {
  if (s.volume.size() == length) return;
  const auto D = static_cast<std::size_t>(gas.dimensions());
  const auto columns = [&](std::vector<Column>& all, std::size_t count) { all.assign(count, Column(length, 1.0)); };
  const auto contents = static_cast<std::size_t>(gas.contents());
  columns(s.primitive, static_cast<std::size_t>(gas.primitive.quantities()));
  columns(s.content, contents), columns(s.change, contents), columns(s.half, 1 + D);
  for (Column* c : {&s.volume, &s.density, &s.energy, &s.covered, &s.mean, &s.rubbing, &s.first_order}) c->assign(length, 1.0);
  for (std::size_t a = 0; a < D; ++a) {
    s.flow[a].assign(length, 0.0), s.pressure[a].assign(length, 0.0), s.velocity[a].assign(length, 0.0);
    columns(s.passing[a], contents);
  }
  if (gas.fluids.size() == 1) return;
  s.heat.assign(length, 0.0);
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
  if (gas.any_first_order) wanted.push_back({&gas.half_step, HalfStep::first_order(gas.dimensions()), &s.first_order});
  gather(gas, wanted, domain);
}

/// Writes a state into a cell of the window.
void write_state(Gas& gas, const Filling& filling, const Index& cell, std::size_t n) {
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(gas.dimensions());
  // Through a cell of scratch.
  const auto block = static_cast<std::size_t>(gas.cells.mine.front());
  write_content(gas, gas.next, block, 0, filling);
  const double cell_volume = gas.next.cell(block, Content::cell_volume, 0),
               part = whole_cell(gas.cells, cell[0]).volume / cell_volume;
  for (std::size_t q = 0; q < s.content.size(); ++q) s.content[q][n] = part * gas.next.cell(block, static_cast<int>(q), 0);
  double kinetic = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    s.primitive[Primitive::velocity + a][n] = filling.velocity[a];
    kinetic += 0.5 * filling.density * filling.velocity[a] * filling.velocity[a];
  }
  const EquationOfState& law = gas.fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state;
  const double energy = (gas.next.cell(block, Content::energy, 0) / cell_volume - kinetic) / filling.density;
  s.primitive[Primitive::density][n] = filling.density, s.primitive[Primitive::pressure][n] = filling.pressure;
  s.primitive[Primitive::sound_speed][n] = std::sqrt(eos::sound_speed_squared(law, filling.density, energy));
  s.primitive[Primitive::gruneisen][n] = eos::gruneisen_coefficient(law, filling.density, energy);
  if (gas.fluids.size() == 1) return;
  const int dimensions = gas.dimensions(), fluids = static_cast<int>(gas.fluids.size());
  const auto at = [&](int quantity) -> double& { return s.primitive[static_cast<std::size_t>(quantity)][n]; };
  for (int r = 0; r < fluids; ++r) at(Primitive::share(dimensions, r)) = r == filling.fluid ? 1.0 : 0.0;
  at(Primitive::impedance_ratio(dimensions, fluids)) = 1.0;
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
      s.first_order[n] = s.first_order[source];
      s.primitive[Primitive::velocity + a][n] *= sign, s.content[Content::momentum + a][n] *= sign;
      // Contents are those of whole cells, which about an axis are the wider the farther out they lie.
      const double wider = whole_cell(cells, cell[0]).volume / whole_cell(cells, from[0]).volume;
      for (Column& column : s.content) column[n] *= wider;
      if (edge.kind == EdgeKind::wall) {
        // A column that rests on the wall, or hangs from it, goes on beyond it (continue_column in ghosts.cpp).
        const int inward = cell[a] < lower ? 1 : -1, depth = inward > 0 ? lower - cell[a] : cell[a] - (upper - 1);
        double between = s.primitive[Primitive::density][source];
        Index at_wall = cell;
        for (int k = 1; gas.gravity[a] != 0.0 && k < std::min(depth, upper - lower); ++k)
          at_wall[a] = cell[a] + inward * (depth + k - 1), between += 2.0 * s.primitive[Primitive::density][w.at(at_wall)];
        s.primitive[Primitive::pressure][n] -= inward * gas.gravity[a] * cells.cell_size * between;
        return;
      }
      Vector x{};
      for (std::size_t b = 0; b < static_cast<std::size_t>(w.dimensions); ++b) {
        // What lies beyond two sides is as beside the corner: a state beyond one of them need not make sense there.
        const int nearest = b == a ? cell[b] : std::clamp(cell[b], cells.lower[b], cells.upper[b] - 1);
        x[b] = (nearest + 0.5) * cells.cell_size;
      }
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
      for (Column& column : s.primitive) column[n] = part * column[n] + (1.0 - part) * column[source];
      for (Column& column : s.content) column[n] = part * column[n] + (1.0 - part) * wider * column[source];
      const double of_velocity = part_of_velocity(part, density, s.primitive[Primitive::density][n]);
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

}  // namespace

void take_state(Gas& gas, Domain& domain) {
  allocate(gas, gas.bodies.fields, gas.bodies.window.length);
  gather_state(gas, domain);
  if (!gas.bodies.window.empty()) fill_beyond(gas);
}

}  // namespace brisance::simulator::gas::unsplit
