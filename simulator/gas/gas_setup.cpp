#include "simulator/gas/gas_setup.hpp"

#include <cmath>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/bodies_setup.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator::gas {
namespace {

int number_of(const GasConfig& config, const std::string& fluid) {
  int number = 0;
  while (config.fluids[static_cast<std::size_t>(number)].name != fluid) ++number;
  return number;
}

Filling filling_of(const GasConfig& config, const std::vector<Fluid>& fluids, const GasStateConfig& state) {
  Filling filling;
  filling.fluid = number_of(config, state.fluid);
  const EquationOfState& law = fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state;
  filling.density = state.density ? *state.density : equation_of_state::density_at(law, state.pressure, *state.temperature);
  filling.pressure = state.pressure, filling.velocity = state.velocity;
  return filling;
}

std::string name_of(std::size_t side) {
  return std::string(choices<BoxSide>[side]);
}

}  // namespace

Gas make_gas(const Case& c, Domain& domain) {
  Gas gas;
  if (!c.gas) return gas;
  const GasConfig& config = *c.gas;
  for (const FluidConfig& fluid : config.fluids) gas.fluids.push_back({fluid.name, fluid.material.material.equation_of_state});
  gas.gravity = c.gravity, gas.courant = config.courant, gas.least_mach = config.least_mach;
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
    Filling beyond;
    if (edge.kind == EdgeKind::pressure)
      beyond.pressure = edge.pressure;
    else if (edge.kind != EdgeKind::wall && edge.kind != EdgeKind::periodic)
      beyond = filling_of(config, gas.fluids, edge);
    made.beyond = [beyond](const Vector&, double) { return beyond; };
  }
  for (const GasBodyConfig& body : config.bodies) gas.bodies.all.push_back(make_body(c, body));
  std::vector<Filling> fillings;
  for (const FillConfig& fill : config.fills) fillings.push_back(filling_of(config, gas.fluids, fill));
  const auto filling = [&](const Vector& x, double) {
    std::size_t last = 0;
    for (std::size_t f = 0; f < fillings.size(); ++f)
      if (!config.fills[f].shape || contains(*config.fills[f].shape, x)) last = f;
    return fillings[last];
  };
  fill(gas, filling, domain);
  return gas;
}

}  // namespace brisance::simulator::gas
