#include "simulator/gas/transport.hpp"

#include <algorithm>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/exchange.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/gas/passages.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;

/// A fluid's share of some cells.
struct Warmth {
  Lanes capacity;     // J/K
  Lanes temperature;  // K
};
Warmth warmth_of(const Fluid& fluid, const Lanes& mass, const Lanes& volume, const Lanes& internal) {
  const LanesMask here = (mass > 0.0) & (volume > 0.0);
  const Lanes density = select(here, mass / volume, Lanes(fluid.usual_density));
  const Lanes energy = select(here, internal / mass, Lanes(fluid.usual_energy));
  return std::visit(
      [&](const auto& law) {
        return Warmth{mass * eos::specific_heat_at_constant_volume(law, density), eos::temperature(law, density, energy)};
      },
      fluid.equation_of_state);
}

/// Kinetic energy of some cells, J.
template <int D>
Lanes kinetic_energy(const Gas& gas, const CellSet& set, std::size_t block, int k) {
  Lanes mass(0.0), square(0.0);
  for (int r = 0; r < static_cast<int>(gas.fluids.size()); ++r) mass += set.at(block, Content::of(D, r, Content::mass))[k];
  for (int a = 0; a < D; ++a) {
    const Lanes p = set.at(block, Content::momentum + a)[k];
    square += p * p;
  }
  return 0.5 * square / mass;
}

std::vector<Warmth> warmths_of(const Gas& gas, const CellSet& set, std::size_t block, int k, const Lanes& internal) {
  std::vector<Warmth> all;
  const auto of = [&](int r, int quantity) { return set.at(block, Content::of(gas.dimensions(), r, quantity))[k]; };
  if (gas.fluids.size() == 1)
    return {warmth_of(gas.fluids[0], of(0, Content::mass), set.at(block, Content::cell_volume)[k], internal)};
  for (int r = 0; r < static_cast<int>(gas.fluids.size()); ++r)
    all.push_back(warmth_of(gas.fluids[static_cast<std::size_t>(r)], of(r, Content::mass), of(r, Content::volume),
                            of(r, Content::internal)));
  return all;
}

/// Beyond a wall that the gas sticks to lies what makes the mean of both sides that of the wall.
void stick(Gas& gas, std::size_t block, int axis, int n, const std::function<std::optional<double>(const Edge&)>& of_wall,
           Pencil& values) {
  for_each_passage(gas, block, axis, n, [&](const Passage& passage, double sign, std::uint8_t lanes) {
    const Edge& edge = gas.edges[static_cast<std::size_t>(passage.side)];
    if (edge.kind != EdgeKind::no_slip) return;
    const std::optional<double> wall = of_wall(edge);
    if (!wall) return;
    const auto f = static_cast<std::size_t>(passage.face);
    const std::size_t outside = sign > 0.0 ? ring + f - 1 : ring + f, inside = sign > 0.0 ? ring + f : ring + f - 1;
    for (int l = 0; l < 8; ++l)
      if (lanes >> l & 1) values[outside].set(l, 2.0 * *wall - values[inside][l]);
  });
}
template <int D>
void load_velocity(Gas& gas, std::size_t block, int component, int axis, int n, Pencil& velocity) {
  load<D>(gas.cells, gas.primitive, block, Primitive::velocity + component, axis, n, velocity);
  stick(
      gas, block, axis, n,
      [&](const Edge& edge) -> std::optional<double> {
        return edge.beyond(Vector{}, gas.time).velocity[static_cast<std::size_t>(component)];
      },
      velocity);
}

/// Own cells: coefficients, temperature, gradients. Gives the largest rate of diffusion.
template <int D>
double prepare(Gas& gas, std::size_t block) {
  const double h = gas.cells.cell_size;
  double fastest = 0.0;
  for (int k = 0; k < BlockShape<D>::packs; ++k) {
    const std::uint8_t inside = cells_inside(gas.cells, block, k);
    const Lanes internal = gas.content.at(block, Content::energy)[k] - kinetic_energy<D>(gas, gas.content, block, k);
    const std::vector<Warmth> warmths = warmths_of(gas, gas.content, block, k, internal);
    const Lanes cell_volume = gas.content.at(block, Content::cell_volume)[k],
                density = gas.primitive.at(block, Primitive::density)[k];
    Lanes viscosity(0.0), bulk(0.0), conductivity(0.0), capacity(0.0), heat(0.0);
    for (std::size_t r = 0; r < gas.fluids.size(); ++r) {
      const Fluid& fluid = gas.fluids[r];
      const Lanes part =
          gas.fluids.size() == 1 ? Lanes(1.0) : gas.content.at(block, Content::of(D, r, Content::volume))[k] / cell_volume;
      viscosity += fluid.viscosity * part, bulk += fluid.bulk_viscosity * part, conductivity += fluid.conductivity * part;
      capacity += warmths[r].capacity, heat += warmths[r].capacity * warmths[r].temperature;
    }
    const Lanes of_momentum = ((4.0 / 3.0) * viscosity + bulk) / density, of_heat = conductivity * cell_volume / capacity;
    for (int l = 0; l < 8; ++l)
      if (inside >> l & 1) fastest = std::max({fastest, of_momentum[l], of_heat[l]});
    const auto put = [&](int quantity, const Lanes& value) { gas.transport.at(block, quantity)[k] = value; };
    put(Transport::viscosity, viscosity), put(Transport::bulk_viscosity, bulk);
    put(Transport::conductivity, conductivity), put(Transport::temperature, heat / capacity);
  }
  for (int axis = 0; axis < D; ++axis)
    for (int n = 0; n < BlockShape<D>::pencils; ++n)
      for (int a = 0; a < D; ++a) {
        Pencil velocity, gradient;
        load_velocity<D>(gas, block, a, axis, n, velocity);
        for (std::size_t c = ring; c < ring + line; ++c) gradient[c] = (velocity[c + 1] - velocity[c - 1]) * (0.5 / h);
        store<D>(gas.transport, block, Transport::gradient + a * D + axis, axis, n, gradient);
      }
  return 2.0 * D * fastest / (h * h);
}

/// Beyond the sides of the box: as in a mirror, a period away, or as next to the side.
void fill_ghosts(Gas& gas) {
  const int D = gas.dimensions();
  CellSet& set = gas.transport;
  for (std::size_t s = 0; s < gas.cells.sides.size(); ++s) {
    const GhostSide& side = gas.cells.sides[s];
    const EdgeKind kind = gas.edges[s].kind;
    const bool mirror = is_wall(kind);
    for (int q = 0; q < set.quantities(); ++q) {
      const int a = (q - Transport::gradient) / D, b = (q - Transport::gradient) % D;
      const double sign = mirror && q >= Transport::gradient && (a == side.axis) != (b == side.axis) ? -1.0 : 1.0;
      for (const Ghost& g : mirror ? side.mirrored : kind == EdgeKind::periodic ? side.wrapped : side.nearest)
        set.cell(static_cast<std::size_t>(g.block), q, g.cell) =
            sign * set.cell(static_cast<std::size_t>(g.source_block), q, g.source_cell);
    }
  }
}

/// The coefficient that carries the same through a face as the two cells in a row.
Lanes in_a_row(const Lanes& low, const Lanes& high) {
  return select(low + high > 0.0, 2.0 * low * high / (low + high), Lanes(0.0));
}

/// 1/m, divergence of a unit vector along x in the cells of a pencil.
template <int D>
void load_widening(const Cells& cells, std::size_t block, int axis, Pencil& widening) {
  const double* first = cells.metric.widening.data() + (cells.corner(block)[0] - cells.metric.first);
  for (int m = 0; m < reach; ++m) {
    Lanes& at = widening[static_cast<std::size_t>(m)];
    if (axis > 0)
      at = Lanes::load(first);
    else  // the lines of a pencil lie one behind the other in one dimension, and side by side in others
      for (int l = 0; l < 8; ++l) at.set(l, first[(D == 1 ? line * l : 0) + m - ring]);
  }
}

template <int D>
void add_fluxes(Gas& gas, std::size_t block, double dt) {
  const Cells& cells = gas.cells;
  const double h = cells.cell_size;
  const bool round = is_round(cells.geometry);
  const double circles = cells.geometry == Geometry::spherical_1d ? 2.0 : 1.0;  // along which the hoop stress acts
  for (int axis = 0; axis < D; ++axis)
    for (int n = 0; n < BlockShape<D>::pencils; ++n) {
      Pencil viscosity, bulk, conductivity, temperature, velocity[D], across[D], stretch[D], hoop;
      load<D>(cells, gas.transport, block, Transport::viscosity, axis, n, viscosity);
      load<D>(cells, gas.transport, block, Transport::bulk_viscosity, axis, n, bulk);
      load<D>(cells, gas.transport, block, Transport::conductivity, axis, n, conductivity);
      load<D>(cells, gas.transport, block, Transport::temperature, axis, n, temperature);
      stick(
          gas, block, axis, n, [](const Edge& edge) { return edge.temperature; }, temperature);
      for (int a = 0; a < D; ++a) {
        load_velocity<D>(gas, block, a, axis, n, velocity[a]);
        load<D>(cells, gas.transport, block, Transport::gradient + axis * D + a, axis, n, across[a]);
        load<D>(cells, gas.transport, block, Transport::gradient + a * D + a, axis, n, stretch[a]);
      }
      hoop.fill(Lanes(0.0));
      if (round) {
        load_widening<D>(cells, block, axis, hoop);
        for (std::size_t c = 0; c < reach; ++c) hoop[c] *= velocity[0][c];
      }
      PencilMetric metric;
      load_metric<D>(cells, block, axis, n, metric);
      FacePencil push[D], energy;  // into the high cell from the low one: negative stress
      for (std::size_t f = 0; f < line_faces; ++f) {
        const std::size_t l = ring + f - 1, r = ring + f;
        const Lanes mu = in_a_row(viscosity[l], viscosity[r]), zeta = in_a_row(bulk[l], bulk[r]);
        Lanes divergence = 0.5 * (hoop[l] + hoop[r]), heat_and_work(0.0);
        for (int a = 0; a < D; ++a)
          divergence += a == axis ? (velocity[a][r] - velocity[a][l]) * (1.0 / h) : 0.5 * (stretch[a][l] + stretch[a][r]);
        heat_and_work = in_a_row(conductivity[l], conductivity[r]) * (temperature[r] - temperature[l]) * (1.0 / h);
        for (int a = 0; a < D; ++a) {
          const Lanes along = (velocity[a][r] - velocity[a][l]) * (1.0 / h);
          const Lanes stress = a == axis ? 2.0 * mu * along + (zeta - (2.0 / 3.0) * mu) * divergence
                                         : mu * (along + 0.5 * (across[a][l] + across[a][r]));
          push[a][f] = dt * metric.area[f] * stress;
          heat_and_work += 0.5 * (velocity[a][l] + velocity[a][r]) * stress;
        }
        energy[f] = dt * metric.area[f] * heat_and_work;
      }
      const auto add = [&](int quantity, const FacePencil& through) {
        Pencil values;
        load_own<D>(gas.moved, block, quantity, axis, n, values);
        for (std::size_t f = 0; f < line; ++f) values[ring + f] += through[f + 1] - through[f];
        if (round && axis == 0 && quantity == Content::momentum)
          for (std::size_t f = 0; f < line; ++f) {
            const std::size_t c = ring + f;
            Lanes divergence = hoop[c];
            for (int a = 0; a < D; ++a) divergence += stretch[a][c];
            const Lanes stress = (2.0 / circles) * viscosity[c] * hoop[c] + (bulk[c] - (2.0 / 3.0) * viscosity[c]) * divergence;
            values[c] -= dt * stress * (metric.area[f + 1] - metric.area[f]);
          }
        store<D>(gas.moved, block, quantity, axis, n, values);
      };
      for (int a = 0; a < D; ++a) add(Content::momentum + a, push[a]);
      add(Content::energy, energy);
      for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
        const auto f = static_cast<std::size_t>(passage.face);
        for (int l = 0; l < 8; ++l) {
          if (!(lanes >> l & 1)) continue;
          for (std::size_t a = 0; a < D; ++a) passage.step.momentum[a] -= sign * push[a][f][l];
          passage.step.energy -= sign * energy[f][l];
        }
      });
    }
}

/// Heat between the fluids of some cells, J to each.
void exchange_heat(const Gas& gas, const std::vector<Warmth>& warmths, const std::vector<Lanes>& parts,
                   const Lanes& cell_volume, double dt, std::vector<Lanes>& gained) {
  std::vector<Lanes> temperatures, capacities;
  for (const Warmth& w : warmths) temperatures.push_back(w.temperature), capacities.push_back(w.capacity);
  exchange<Lanes>(temperatures, capacities, parts, dt * gas.heat_exchange * cell_volume);
  // What rounding left over goes to the fluid with most volume.
  Lanes rest(0.0), largest(0.0);
  for (std::size_t r = 0; r < warmths.size(); ++r) {
    gained[r] = capacities[r] * (temperatures[r] - warmths[r].temperature);
    rest -= gained[r], largest = max(largest, parts[r]);
  }
  LanesMask given(false);
  for (std::size_t r = 0; r < warmths.size(); ++r) {
    const LanesMask most = (parts[r] == largest) & !given;
    given |= most;
    gained[r] += select(most, rest, Lanes(0.0));
  }
}

template <int D>
void apply(Gas& gas, std::size_t block, double dt) {
  constexpr int packs = BlockShape<D>::packs;
  const std::size_t fluids = gas.fluids.size();
  const auto internal = [&](int k) -> Lanes {
    return gas.moved.at(block, Content::energy)[k] - kinetic_energy<D>(gas, gas.moved, block, k);
  };
  std::array<Lanes, packs> before;
  for (int k = 0; k < packs; ++k) before[static_cast<std::size_t>(k)] = internal(k);
  if (has_transport(gas)) add_fluxes<D>(gas, block, dt);
  if (fluids == 1) return;
  std::vector<Lanes> parts(fluids), gained(fluids);
  for (int k = 0; k < packs; ++k) {
    const Lanes heat = internal(k) - before[static_cast<std::size_t>(k)],
                cell_volume = gas.moved.at(block, Content::cell_volume)[k];
    std::vector<Warmth> warmths = warmths_of(gas, gas.moved, block, k, Lanes(0.0));
    Lanes capacity(0.0);
    const auto of = [&](std::size_t r, int quantity) -> Lanes& { return gas.moved.at(block, Content::of(D, r, quantity))[k]; };
    for (std::size_t r = 0; r < fluids; ++r) capacity += warmths[r].capacity, parts[r] = of(r, Content::volume) / cell_volume;
    for (std::size_t r = 0; r < fluids; ++r) {
      of(r, Content::internal) += heat * warmths[r].capacity / capacity;
      warmths[r].temperature += heat / capacity;
    }
    if (gas.heat_exchange == 0.0) continue;
    exchange_heat(gas, warmths, parts, cell_volume, dt, gained);
    for (std::size_t r = 0; r < fluids; ++r) of(r, Content::internal) += gained[r];
  }
}

}  // namespace

void prepare_transport(Gas& gas, Domain& domain) {
  if (!has_transport(gas)) return;
  if (gas.transport.quantities() == 0) {
    gas.transport = CellSet(Transport::count(gas.dimensions()), gas.cells.packs());
    gas.transport.resize(gas.cells.blocks.size());
  }
  std::vector<double> rates(gas.cells.mine.size());
  for_each_own_block(gas, [&](auto D, std::size_t i, std::size_t block) { rates[i] = prepare<D()>(gas, block); });
  gas.diffusion_rate = 0.0;
  for (const double rate : rates) gas.diffusion_rate = std::max(gas.diffusion_rate, rate);
  gas.diffusion_rate = domain.maximum(gas.diffusion_rate);
  share(gas.cells, gas.transport, domain);
  fill_ghosts(gas);
}

Lanes heat_capacity(const Fluid& fluid, const Lanes& mass, const Lanes& volume) {
  return warmth_of(fluid, mass, volume, Lanes(0.0)).capacity;
}

void warm_alike(const Gas& gas, CellSet& set, std::size_t block, int k, const Lanes& heat) {
  Lanes capacity(0.0);
  const std::vector<Warmth> warmths = warmths_of(gas, set, block, k, Lanes(0.0));
  for (const Warmth& w : warmths) capacity += w.capacity;
  for (std::size_t r = 0; r < warmths.size(); ++r)
    set.at(block, Content::of(gas.dimensions(), r, Content::internal))[k] += heat * warmths[r].capacity / capacity;
}

void apply_transport(Gas& gas, double dt) {
  if (!has_transport(gas) && (gas.heat_exchange == 0.0 || gas.fluids.size() == 1)) return;
  for_each_own_block(gas, [&](auto D, std::size_t, std::size_t block) { apply<D()>(gas, block, dt); });
}

}  // namespace brisance::simulator::gas
