#pragma once
// A gas by hand: a box of cells, what fills it, a run to a time, what it then holds and how far that is from the truth.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/gas/gas.hpp"
#include "simulator/gas/gas_state.hpp"

namespace brisance::simulator::gas::set_up {

inline Fluid ideal_gas(double gamma = 1.4) {
  return {"gas", equation_of_state::IdealGas{gamma, 1.0}};
}
inline Edge wall() {
  return {"wall", EdgeKind::wall, {}};
}
inline Edge around() {
  return {"periodic", EdgeKind::periodic, {}};
}
inline Edge beyond(EdgeKind kind, FillingFunction state) {
  return {"beyond", kind, std::move(state)};
}
/// One state, whatever the place and the time.
inline Edge beyond(EdgeKind kind, const Filling& state) {
  return beyond(kind, [state](const Vector&, double) { return state; });
}

/// Cells lower ... upper - 1 of a lattice, not filled yet; walls all around.
inline Gas box(Geometry geometry, double cell_size, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
               std::vector<Fluid> fluids, Domain& domain) {
  Gas gas;
  gas.cells = make_cells(geometry, cell_size, lower, upper, domain);
  gas.fluids = std::move(fluids);
  gas.edges.assign(static_cast<std::size_t>(2 * gas.dimensions()), wall());
  return gas;
}

/// Steps up to a time. The first steps are short: the waves from a jump do not move at once as those will by which the longest
/// step is found.
struct Stepper {
  double courant = 0.5;
  double first = 0.1, growth = 1.2;  // of the longest step; from step to step
  std::int64_t rejected = 0;

  void to(Gas& gas, double end, Domain& domain) {
    constexpr double rounding = 1e-12;
    while (gas.time < end * (1.0 - rounding)) step(gas, end - gas.time, domain);
  }
  void steps(Gas& gas, int count, Domain& domain) {
    for (int n = 0; n < count; ++n) step(gas, 1e300, domain);
  }

 private:
  void step(Gas& gas, double longest, Domain& domain) {
    double part = first;
    for (std::int64_t n = 0; n < gas.step && part < 1.0; ++n) part *= growth;
    double dt = std::min(std::min(part, 1.0) * largest_step(gas, courant), longest);
    constexpr int most_rejections = 20;
    for (int n = 0; advance(gas, dt, domain) == Outcome::rejected; ++n, ++rejected, dt *= 0.5)
      if (n == most_rejections || !(dt > 0.0)) throw std::runtime_error("no step is short enough");
  }
};

/// A cell of the box.
struct Cell {
  std::array<int, 3> index;
  Vector centre;
  double volume;  // m^3, see Metric
  double density, pressure, sound_speed;
  Vector velocity;
  std::size_t block;
  int number;  // in the block
};

/// f(cell) for the cells that this rank owns, in the order of the blocks.
template <class F>
void for_each_cell(const Gas& gas, F&& f) {
  for (const std::int32_t b : gas.cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const std::array<int, 3> index = gas.cells.index(block, c);
      if (!gas.cells.contains(index)) continue;
      Cell cell{index, gas.cells.centre(block, c), gas.content.cell(block, Content::cell_volume, c), {}, {}, {}, {}, block, c};
      cell.density = gas.primitive.cell(block, Primitive::density, c);
      cell.pressure = gas.primitive.cell(block, Primitive::pressure, c);
      cell.sound_speed = gas.primitive.cell(block, Primitive::sound_speed, c);
      for (int a = 0; a < gas.dimensions(); ++a)
        cell.velocity[static_cast<std::size_t>(a)] = gas.primitive.cell(block, Primitive::velocity + a, c);
      f(cell);
    }
  }
}
/// Part of a cell's volume that a fluid takes.
inline double fraction(const Gas& gas, const Cell& cell, int fluid) {
  if (gas.fluids.size() == 1) return 1.0;
  return gas.content.cell(cell.block, Content::of(gas.dimensions(), fluid, Content::volume), cell.number) / cell.volume;
}
/// The cells along a line, in order.
inline std::vector<GasState> profile(const Gas& gas) {
  std::vector<GasState> result(static_cast<std::size_t>(gas.cells.count()));
  set_up::for_each_cell(gas, [&](const Cell& c) {
    result[static_cast<std::size_t>(c.index[0] - gas.cells.lower[0])] = {c.density, c.velocity[0], c.pressure};
  });
  return result;
}

/// Mean over the cells of the absolute errors, `average(from, to)` being the exact mean over a cell. On the unit line these
/// are the integrals of the errors.
inline GasState mean_errors(const Gas& gas, const std::function<GasState(double, double)>& average) {
  GasState sum{};
  const double h = gas.cells.cell_size, part = 1.0 / static_cast<double>(gas.cells.count());
  set_up::for_each_cell(gas, [&](const Cell& c) {
    const GasState exact = average(c.index[0] * h, (c.index[0] + 1) * h);
    sum.density += part * std::abs(c.density - exact.density);
    sum.velocity += part * std::abs(c.velocity[0] - exact.velocity);
    sum.pressure += part * std::abs(c.pressure - exact.pressure);
  });
  return sum;
}

inline double relative_change(double before, double after) {
  return std::abs(after / before - 1.0);
}

}  // namespace brisance::simulator::gas::set_up
