#include "simulator/gas/fluid_state.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::simulator::gas {

namespace eos = equation_of_state;

double energy_of(const EquationOfState& law, double density, double pressure) {
  double e = eos::energy_at_pressure(law, density, pressure);
  for (int n = 0; n < 3; ++n) {
    const auto at = slopes_of(law, density, e);
    if (at.per_energy > 0.0) e += (pressure - at.pressure) / at.per_energy;
  }
  return e;
}

Lanes coldest_energy(const Fluid& fluid, const Lanes& density) {
  constexpr double without_limit = -1e30;
  return std::visit(
      [&]<class Law>(const Law& law) {
        return Law::caloric == eos::Caloric::complete ? Lanes(law.energy(density, Lanes(0.0))) : Lanes(without_limit);
      },
      fluid.equation_of_state);
}

void give_usual_state(Fluid& fluid) {
  constexpr double atmosphere = 101325.0, warm = 300.0;  // Pa, K
  fluid.usual_density = eos::density_at(fluid.equation_of_state, atmosphere, warm);
  fluid.usual_energy = eos::energy(fluid.equation_of_state, fluid.usual_density, warm);
  fluid.usual_heat = fluid.usual_energy - eos::energy(fluid.equation_of_state, fluid.usual_density, 0.0);
  if (eos::caloric(fluid.equation_of_state) != eos::Caloric::complete) return;
  constexpr double densest = 10.0, sparser = 0.8;  // of the usual density
  constexpr int densities = 200;
  fluid.least_pressure = 1e300;
  for (int n = 0; n < densities; ++n) {
    const double density = densest * fluid.usual_density * std::pow(sparser, n);
    const double cold = eos::energy(fluid.equation_of_state, density, 0.0);
    fluid.least_pressure = std::min(fluid.least_pressure, eos::pressure(fluid.equation_of_state, density, cold));
  }
}

double internal_energy_of(const EquationOfState& law, const Filling& filling) {
  const bool by_temperature = filling.temperature > 0.0 && eos::caloric(law) == eos::Caloric::barotropic;
  return by_temperature ? eos::energy(law, filling.density, filling.temperature)
                        : energy_of(law, filling.density, filling.pressure);
}

void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, std::span<const Portion> portions) {
  const int D = gas.dimensions();
  const auto i = static_cast<std::size_t>(gas.cells.index(block, cell)[0] - gas.cells.metric.first);
  const double whole = gas.cells.metric.volume[i];
  for (int q = 0; q < content.quantities(); ++q) content.cell(block, q, cell) = 0.0;
  content.cell(block, Content::cell_volume, cell) = whole;
  for (const auto& [part, filling] : portions) {
    const double volume = part * whole, mass = filling.density * volume;
    const EquationOfState& law = gas.fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state;
    const double internal = mass * internal_energy_of(law, filling);
    double kinetic = 0.0;
    for (int a = 0; a < D; ++a) {
      const double u = filling.velocity[static_cast<std::size_t>(a)];
      content.cell(block, Content::momentum + a, cell) += mass * u;
      kinetic += 0.5 * mass * u * u;
    }
    content.cell(block, Content::energy, cell) += internal + kinetic;
    const auto of_fluid = [&](int quantity) -> double& {
      return content.cell(block, Content::of(D, filling.fluid, quantity), cell);
    };
    of_fluid(Content::mass) += mass;
    if (gas.fluids.size() == 1) continue;
    of_fluid(Content::volume) += volume, of_fluid(Content::internal) += internal;
  }
}
void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, const Filling& filling) {
  const Portion all{1.0, filling};
  write_content(gas, content, block, cell, {&all, 1});
}

void write_primitive(Gas& gas, std::size_t block, int cell, const Filling& filling) {
  const EquationOfState& law = gas.fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state;
  const double energy = energy_of(law, filling.density, filling.pressure);
  CellSet& set = gas.primitive;
  set.cell(block, Primitive::density, cell) = filling.density;
  set.cell(block, Primitive::pressure, cell) = filling.pressure;
  set.cell(block, Primitive::sound_speed, cell) = std::sqrt(eos::sound_speed_squared(law, filling.density, energy));
  set.cell(block, Primitive::gruneisen, cell) = eos::gruneisen_coefficient(law, filling.density, energy);
  for (int a = 0; a < gas.dimensions(); ++a)
    set.cell(block, Primitive::velocity + a, cell) = filling.velocity[static_cast<std::size_t>(a)];
  const int fluids = static_cast<int>(gas.fluids.size());
  if (fluids == 1) return;
  for (int r = 0; r < fluids; ++r)
    set.cell(block, Primitive::share(gas.dimensions(), r), cell) = r == filling.fluid ? 1.0 : 0.0;
  set.cell(block, Primitive::impedance_ratio(gas.dimensions(), fluids), cell) = 1.0;
}

}  // namespace brisance::simulator::gas
