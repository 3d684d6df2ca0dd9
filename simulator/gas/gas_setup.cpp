#include "simulator/gas/gas_setup.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/gas/bodies_setup.hpp"
#include "simulator/gas/initial_state.hpp"

namespace brisance::simulator::gas {
namespace {

std::string name_of(std::size_t side) {
  return std::string(choices<BoxSide>[side]);
}

/// The part of each cell of the box that bodies leave to a gas which is not filled yet; every rank finds it for all cells.
OpenParts open_parts(Gas gas) {
  const auto domain = single_process();
  gas.cells = make_cells(gas.cells.geometry, gas.cells.cell_size, gas.cells.lower, gas.cells.upper, *domain);
  place_bodies(gas, *domain);
  return [gas = std::move(gas)](const std::array<int, 3>& cell) {
    const CellPlace place = gas.cells.find(cell).value();
    return open_part(gas, place.block, place.cell);
  };
}

}  // namespace

Gas make_gas(const Case& c, Domain& domain) {
  Gas gas;
  if (!c.gas) return gas;
  const GasConfig& config = *c.gas;
  for (const FluidConfig& fluid : config.fluids) {
    gas.fluids.push_back({fluid.name, fluid.material.material.equation_of_state});
    Fluid& made = gas.fluids.back();
    made.viscosity = fluid.viscosity, made.bulk_viscosity = fluid.bulk_viscosity, made.conductivity = fluid.conductivity;
  }
  gas.gravity = c.gravity, gas.courant = config.courant, gas.least_mach = config.least_mach;
  gas.implicit = config.implicit, gas.acoustic_courant = config.acoustic_courant, gas.heat_exchange = config.heat_exchange;
  if (config.scheme == GasScheme::ice_classic) gas.classic.emplace().momentum_exchange = config.momentum_exchange;
  std::array<int, 3> lower{}, upper{};
  for (std::size_t a = 0; a < 3; ++a) {
    lower[a] = static_cast<int>(std::lround(config.lower[a] / c.cell_size));
    upper[a] = static_cast<int>(std::lround(config.upper[a] / c.cell_size));
  }
  gas.cells = make_cells(c.geometry, c.cell_size, lower, upper, domain);
  for (std::size_t side = 0; side < static_cast<std::size_t>(2 * c.dimensions()); ++side)
    gas.edges.push_back({name_of(side), EdgeKind::wall, {}});
  for (const EdgeConfig& edge : config.edges) {
    Edge& made = gas.edges[static_cast<std::size_t>(edge.side)];
    made.kind = edge.kind;
    if (edge.kind == EdgeKind::no_slip) {
      const Filling beyond{.velocity = edge.velocity.numbers()};
      if (edge.temperature) made.temperature = edge.temperature->number;
      made.beyond = [beyond](const Vector&, double) { return beyond; };
    } else if (!is_wall(edge.kind) && edge.kind != EdgeKind::periodic) {
      made.beyond = state_beyond(config, gas.fluids, edge, c.dimensions());
    }
  }
  for (const ReactionConfig& reaction : config.reactions) {
    Burn burn{reaction.name, number_of(config, reaction.reactant), number_of(config, reaction.product), {}, {}};
    burn.law = *config.fluids[static_cast<std::size_t>(burn.reactant)].material.material.reaction;
    for (const IgnitionConfig& ignition : reaction.ignitions) burn.ignitions.push_back({ignition.shape, ignition.time});
    gas.burns.push_back(std::move(burn));
  }
  for (const GasBodyConfig& body : config.bodies) gas.bodies.all.push_back(make_body(c, body));
  const bool asked = std::any_of(config.fills.begin(), config.fills.end(), [](const FillConfig& f) { return f.energy; });
  const InitialState start(config, gas.fluids, gas.cells, asked && !gas.bodies.empty() ? open_parts(gas) : OpenParts{});
  fill_in_portions(
      gas, [&](const Vector& middle) { return start.in_cell(middle); }, domain);
  return gas;
}

}  // namespace brisance::simulator::gas
