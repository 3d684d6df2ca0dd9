#include "simulator/gas/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/equation_of_state/thermodynamics.hpp"

namespace brisance::simulator::gas {
namespace {

double content(const Gas& gas, const CellPlace& at, int quantity) {
  return gas.content.cell(at.block, quantity, at.cell);
}
double of_fluid(const Gas& gas, const CellPlace& at, std::size_t fluid, int quantity) {
  return content(gas, at, Content::of(gas.dimensions(), fluid, quantity));
}
double primitive(const Gas& gas, const CellPlace& at, int quantity) {
  return gas.primitive.cell(at.block, quantity, at.cell);
}

double mass_of(const Gas& gas, const CellPlace& at) {
  double mass = 0.0;
  for (std::size_t r = 0; r < gas.fluids.size(); ++r) mass += of_fluid(gas, at, r, Content::mass);
  return mass;
}
double internal_energy_of(const Gas& gas, const CellPlace& at) {
  double square = 0.0;
  for (int a = 0; a < gas.dimensions(); ++a) square += std::pow(content(gas, at, Content::momentum + a), 2);
  return content(gas, at, Content::energy) - 0.5 * square / mass_of(gas, at);
}

std::size_t fluid_of_most(const Gas& gas, const CellPlace& at) {
  std::size_t most = 0;
  for (std::size_t r = 1; r < gas.fluids.size(); ++r)
    if (of_fluid(gas, at, r, Content::volume) > of_fluid(gas, at, most, Content::volume)) most = r;
  return most;
}

/// Of the fluid that fills most of the cell: fluids share a pressure, not a temperature.
double temperature_of(const Gas& gas, const CellPlace& at) {
  const std::size_t most = fluid_of_most(gas, at);
  double volume = content(gas, at, Content::cell_volume), internal = internal_energy_of(gas, at);
  if (gas.fluids.size() > 1) {
    volume = of_fluid(gas, at, most, Content::volume), internal = of_fluid(gas, at, most, Content::internal);
  }
  const double mass = of_fluid(gas, at, most, Content::mass);
  return equation_of_state::temperature(gas.fluids[most].equation_of_state, mass / volume, internal / mass);
}

}  // namespace

std::vector<Field> fields(int dimensions, const std::vector<std::string>& fluids) {
  std::vector<Field> all = {
      {"density", "kg/m^3", "density", 1,
       [](const Gas& g, const CellPlace& at, int) { return primitive(g, at, Primitive::density); }},
      {"pressure", "Pa", "pressure", 1,
       [](const Gas& g, const CellPlace& at, int) { return primitive(g, at, Primitive::pressure); }},
      {"velocity", "m/s", "velocity", dimensions,
       [](const Gas& g, const CellPlace& at, int a) { return primitive(g, at, Primitive::velocity + a); }},
      {"speed", "m/s", "magnitude of the velocity", 1,
       [](const Gas& g, const CellPlace& at, int) {
         double square = 0.0;
         for (int a = 0; a < g.dimensions(); ++a) square += std::pow(primitive(g, at, Primitive::velocity + a), 2);
         return std::sqrt(square);
       }},
      {"temperature", "K", "temperature of the fluid that fills most", 1,
       [](const Gas& g, const CellPlace& at, int) { return temperature_of(g, at); }},
      {"energy", "J/kg", "specific internal energy", 1,
       [](const Gas& g, const CellPlace& at, int) { return internal_energy_of(g, at) / mass_of(g, at); }},
      {"sound_speed", "m/s", "speed of sound", 1,
       [](const Gas& g, const CellPlace& at, int) { return primitive(g, at, Primitive::sound_speed); }}};
  for (std::size_t r = 0; fluids.size() > 1 && r < fluids.size(); ++r)
    all.push_back({"fraction_" + fluids[r], "1", "part of the volume", 1, [r](const Gas& g, const CellPlace& at, int) {
                     return of_fluid(g, at, r, Content::volume) / content(g, at, Content::cell_volume);
                   }});
  return all;
}

std::vector<Field> fields_of(const Gas& gas) {
  std::vector<std::string> fluids;
  for (const Fluid& fluid : gas.fluids) fluids.push_back(fluid.name);
  return fields(gas.dimensions(), fluids);
}

MostOf most_of(const Gas& gas, const CellPlace& at) {
  const std::size_t most = fluid_of_most(gas, at);
  const bool alone = gas.fluids.size() == 1;
  return {gas.fluids[most].name,
          alone ? 1.0 : of_fluid(gas, at, most, Content::volume) / content(gas, at, Content::cell_volume)};
}

std::string in_words(const MostOf& most) {
  constexpr double all = 0.99995;  // shown as 100 %
  return most.part >= all ? most.fluid + " alone" : fmt::format("{:.4g} % {} and other fluids", 100.0 * most.part, most.fluid);
}

std::optional<CellPlace> find_cell(const Gas& gas, const Vector& position) {
  const Cells& cells = gas.cells;
  std::array<int, 3> index{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cells.dimensions); ++a) {
    // A place on the upper edge of the box belongs to its last cell.
    index[a] = std::min(static_cast<int>(std::floor(position[a] / cells.cell_size)), cells.upper[a] - 1);
    if (position[a] > cells.upper[a] * cells.cell_size || index[a] < cells.lower[a]) return std::nullopt;
  }
  const std::optional<CellPlace> place = cells.find(index);
  return place && open_part(gas, place->block, place->cell) > 0.0 ? place : std::nullopt;
}

}  // namespace brisance::simulator::gas
