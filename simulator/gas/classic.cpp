#include "simulator/gas/classic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/exchange.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/ghosts.hpp"
#include "simulator/gas/transport.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;
using Values = std::vector<double>;
using State = ClassicState;

/// A cell of the box that this process owns.
struct Cell {
  CellPlace place;
  std::array<int, 3> index;
};

/// Straight cells, all alike.
struct Lattice {
  const Cells& cells;
  double h, cell_volume, area;  // m, m^3, m^2
  int dimensions, fluids;
  std::array<bool, 3> periodic{};

  explicit Lattice(const Gas& gas)
      : cells(gas.cells),
        h(cells.cell_size),
        cell_volume(std::pow(h, cells.dimensions)),
        area(std::pow(h, cells.dimensions - 1)),
        dimensions(cells.dimensions),
        fluids(static_cast<int>(gas.fluids.size())) {
    for (std::size_t a = 0; 2 * a < gas.edges.size(); ++a) periodic[a] = gas.edges[2 * a].kind == EdgeKind::periodic;
  }
  CellSet field(int quantities) const {
    CellSet set(quantities, cells.packs());
    set.resize(cells.blocks.size());
    return set;
  }
  /// The next cell along an axis: of the box, the halo or the ghosts.
  CellPlace next(const CellPlace& at, int axis, int step) const {
    const int side = dimensions == 1 ? 64 : line, stride = axis == 0 ? 1 : axis == 1 ? line : line * line;
    const int i = at.cell / stride % side + step;
    if (i >= 0 && i < side) return {at.block, at.cell + step * stride};
    const std::int32_t block = cells.neighbours[at.block][static_cast<std::size_t>(2 * axis + (step > 0 ? 1 : 0))];
    return {static_cast<std::size_t>(block), at.cell - step * (side - 1) * stride};
  }
  bool wall(const Cell& c, int axis, int step) const {
    const auto a = static_cast<std::size_t>(axis);
    return !periodic[a] && c.index[a] == (step > 0 ? cells.upper[a] - 1 : cells.lower[a]);
  }
};

double& at(CellSet& set, int quantity, const CellPlace& c) {
  return set.cell(c.block, quantity, c.cell);
}
double at(const CellSet& set, int quantity, const CellPlace& c) {
  return set.cell(c.block, quantity, c.cell);
}

template <class F>
void for_each_cell_of(const Cells& cells, std::int32_t b, F&& f) {
  const auto block = static_cast<std::size_t>(b);
  for (int c = 0; c < 8 * cells.packs(); ++c)
    if (const std::array<int, 3> index = cells.index(block, c); cells.contains(index)) f(Cell{{block, c}, index});
}
template <class F>
void for_each_own_cell(const Cells& cells, F&& f) {
  parallel_for_blocks(cells.mine.size(), [&](std::size_t i) { for_each_cell_of(cells, cells.mine[i], f); });
}
/// Whether all own cells of all ranks are.
template <class F>
bool all_own_cells(const Cells& cells, Domain& domain, F&& good) {
  std::atomic<bool> all = true;
  for_each_own_cell(cells, [&](const Cell& c) {
    if (!good(c)) all = false;
  });
  return domain.maximum(all ? 0.0 : 1.0) == 0.0;
}

/// Quantities of the fluids of a cell at one pressure.
struct Equilibrium {
  static constexpr int pressure = 0, density = 1, sound = 2;  // of the mixture, the fastest of its fluids
  static int part(int r) { return 3 + 3 * r; }                // theta
  static int specific_volume(int r) { return 4 + 3 * r; }
  static int compressibility(int r) { return 5 + 3 * r; }  // kappa
};
constexpr double least_part = 1e-12;

/// Specific volume at a pressure and energy, from a start near it.
double specific_volume_at(const Fluid& fluid, double pressure, double energy, double start) {
  double v = start;
  for (int n = 0; n < 100; ++n) {
    const auto now = slopes_of(fluid.equation_of_state, 1.0 / v, energy);
    const double change = (now.pressure - pressure) * v * v / now.per_density;
    const double next = std::clamp(v + change, 0.5 * v, 2.0 * v);
    const bool settled = std::abs(next - v) <= 1e-15 * v;
    v = next;
    if (settled) break;
  }
  return v;
}

/// False where there is none.
bool find_equilibrium(const Gas& gas, const CellSet& s, const Lattice& lattice, const Cell& c, CellSet& q) {
  const auto fluids = static_cast<std::size_t>(lattice.fluids);
  const double cell_volume = lattice.cell_volume;
  Values mass(fluids), v(fluids), energy(fluids);
  std::vector<bool> here(fluids);
  double p = 0.0, weight = 0.0, density_of_all = 0.0;
  bool good = true;
  for (std::size_t r = 0; r < fluids; ++r) {
    const auto of = [&](int quantity) { return at(s, State::of(lattice.dimensions, static_cast<int>(r), quantity), c.place); };
    mass[r] = of(State::mass);
    density_of_all += mass[r] / cell_volume;
    here[r] = mass[r] > 0.0 && of(State::volume) > least_part * cell_volume;
    if (!here[r]) continue;
    v[r] = fluids == 1 ? cell_volume / mass[r] : of(State::volume) / mass[r], energy[r] = of(State::internal) / mass[r];
    const auto now = slopes_of(gas.fluids[r].equation_of_state, 1.0 / v[r], energy[r]);
    const double soft = mass[r] * v[r] * v[r] / now.per_density;
    p += soft * now.pressure, weight += soft;
  }
  p /= weight;
  // Newton in the pressure at fixed energies; halved where it would leave the positive ones.
  constexpr int most_iterations = 100;
  for (int k = 0; fluids > 1 && k < most_iterations; ++k) {
    double sum = -1.0, slope = 0.0;
    for (std::size_t r = 0; r < fluids; ++r) {
      if (!here[r]) continue;
      const double density = mass[r] / cell_volume;
      v[r] = specific_volume_at(gas.fluids[r], p, energy[r], v[r]);
      sum += density * v[r];
      slope += density * v[r] * v[r] / slopes_of(gas.fluids[r].equation_of_state, 1.0 / v[r], energy[r]).per_density;
    }
    if (std::abs(sum) < 1e-13) break;
    if (k + 1 == most_iterations) good = false;
    p = std::max(p + sum / slope, 0.5 * p);
  }
  at(q, Equilibrium::pressure, c.place) = p, at(q, Equilibrium::density, c.place) = density_of_all;
  double sound = 0.0;
  for (std::size_t r = 0; r < fluids; ++r) {
    double part = 0.0, compressibility = 0.0;
    if (here[r]) {
      const auto now = slopes_of(gas.fluids[r].equation_of_state, 1.0 / v[r], energy[r]);
      const double square = now.per_density + now.pressure * now.per_energy * v[r] * v[r];
      part = mass[r] * v[r] / cell_volume, compressibility = v[r] / square;
      sound = std::max(sound, std::sqrt(square));
    }
    const int n = static_cast<int>(r);
    at(q, Equilibrium::part(n), c.place) = part, at(q, Equilibrium::compressibility(n), c.place) = compressibility;
    at(q, Equilibrium::specific_volume(n), c.place) = here[r] ? v[r] : 1.0;
  }
  at(q, Equilibrium::sound, c.place) = sound;
  return good && p > 0.0;
}

/// Gradient of a field in a cell, limited so that no corner of the cell leaves the range of its neighbours. `shrink` divides
/// what the corners may differ by: mass and what it carries vary together.
Vector limited_gradient(const Lattice& lattice, const CellSet& set, int quantity, const CellPlace& c, double shrink = 1.0) {
  Vector gradient{};
  const double here = at(set, quantity, c);
  double lowest = here, highest = here, reach_of_corner = 0.0;
  for (int a = 0; a < lattice.dimensions; ++a) {
    const double below = at(set, quantity, lattice.next(c, a, -1)), above = at(set, quantity, lattice.next(c, a, 1));
    lowest = std::min({lowest, below, above}), highest = std::max({highest, below, above});
    double& slope = gradient[static_cast<std::size_t>(a)];
    slope = (above - below) / (2.0 * lattice.h);
    reach_of_corner += 0.5 * lattice.h * std::abs(slope) * shrink;
  }
  if (reach_of_corner == 0.0) return gradient;
  const double factor = std::min({1.0, (highest - here) / reach_of_corner, (here - lowest) / reach_of_corner});
  for (double& g : gradient) g *= factor;
  return gradient;
}

/// What the high faces let pass: velocity of each fluid, and slopes of its part of the cell. Quantities by fluid and axis.
struct Flow {
  const Lattice& lattice;
  CellSet speeds, slopes;

  int number(int fluid, int axis) const { return fluid * lattice.dimensions + axis; }
  /// Through the low (-1) or high (1) face of a cell, m/s along the axis.
  double speed(const Cell& c, int fluid, int axis, int side) const {
    if (lattice.wall(c, axis, side)) return 0.0;
    return at(speeds, number(fluid, axis), side > 0 ? c.place : lattice.next(c.place, axis, -1));
  }
  /// Calls f(donor, sign, swept, offset) for the faces of a cell that are no walls: sign of what comes in along the axis, the
  /// volume that passes along it in dt (s), and how far its middle is from that of its donor.
  template <class F>
  void for_each_face(const Cell& c, int fluid, double dt, F&& f) const {
    for (int axis = 0; axis < lattice.dimensions; ++axis)
      for (const int side : {-1, 1}) {
        if (lattice.wall(c, axis, side)) continue;
        const double u = speed(c, fluid, axis, side);
        const CellPlace donor = (u > 0.0) == (side > 0) ? c.place : lattice.next(c.place, axis, side);
        f(axis, donor, -side, u * dt * lattice.area, (u > 0.0 ? 0.5 : -0.5) * (lattice.h - std::abs(u) * dt));
      }
  }
};

void find_velocities(const Gas& gas, const Lattice& lattice, const CellSet& s, const CellSet& q, double dt, const Cell& cell,
                     Flow& flow) {
  const auto fluids = static_cast<std::size_t>(lattice.fluids);
  const CellPlace& c = cell.place;
  Values velocity(fluids), capacity(fluids), part(fluids);
  for (int a = 0; a < lattice.dimensions; ++a) {
    if (lattice.wall(cell, a, 1)) continue;
    const CellPlace d = lattice.next(c, a, 1);
    double mixture = 0.0, mass = 0.0;
    for (std::size_t r = 0; r < fluids; ++r) {
      const int n = static_cast<int>(r);
      const auto sum = [&](int quantity) {
        return at(s, State::of(lattice.dimensions, n, quantity), c) + at(s, State::of(lattice.dimensions, n, quantity), d);
      };
      const double part_c = at(q, Equilibrium::part(n), c), part_d = at(q, Equilibrium::part(n), d);
      part[r] = 0.5 * (part_c + part_d);
      velocity[r] = capacity[r] = 0.0;
      if (!(part_c > 0.0) && !(part_d > 0.0)) continue;
      const double v_low = at(q, Equilibrium::specific_volume(n), part_c > 0.0 ? c : d);
      const double v_high = at(q, Equilibrium::specific_volume(n), part_d > 0.0 ? d : c);
      const double v = 2.0 * v_low * v_high / (v_low + v_high);
      velocity[r] = sum(State::momentum + a) / sum(State::mass) -
                    dt * v * (at(q, Equilibrium::pressure, d) - at(q, Equilibrium::pressure, c)) / lattice.h;
      capacity[r] = lattice.cell_volume * part[r] / v;
      mixture += capacity[r] * velocity[r], mass += capacity[r];
    }
    exchange<double>(velocity, capacity, part, dt * lattice.cell_volume * gas.classic->momentum_exchange);
    for (std::size_t r = 0; r < fluids; ++r)
      at(flow.speeds, flow.number(static_cast<int>(r), a), c) = part[r] > 0.0 ? velocity[r] : mixture / mass;
  }
}

/// What the drag makes of the velocities of a cell, and the exchange of heat of its temperatures. What the drag takes from the
/// kinetic energy is lost.
void exchange_in_cell(const Gas& gas, const Lattice& lattice, const CellSet& q, double dt, const CellPlace& c, CellSet& s) {
  const auto fluids = static_cast<std::size_t>(lattice.fluids);
  if (fluids == 1) return;
  Values x(fluids), capacity(fluids), part(fluids), mass(fluids), cold(fluids);
  const auto of = [&](std::size_t r, int quantity) -> double& {
    return at(s, State::of(lattice.dimensions, static_cast<int>(r), quantity), c);
  };
  for (std::size_t r = 0; r < fluids; ++r)
    part[r] = at(q, Equilibrium::part(static_cast<int>(r)), c), mass[r] = capacity[r] = of(r, State::mass);
  for (int a = 0; a < lattice.dimensions; ++a) {
    for (std::size_t r = 0; r < fluids; ++r) x[r] = mass[r] > 0.0 ? of(r, State::momentum + a) / mass[r] : 0.0;
    exchange<double>(x, capacity, part, dt * lattice.cell_volume * gas.classic->momentum_exchange);
    for (std::size_t r = 0; r < fluids; ++r) of(r, State::momentum + a) = mass[r] * x[r];
  }
  if (gas.heat_exchange == 0.0) return;
  for (std::size_t r = 0; r < fluids; ++r) {
    const EquationOfState& law = gas.fluids[r].equation_of_state;
    const double density = 1.0 / at(q, Equilibrium::specific_volume(static_cast<int>(r)), c);
    cold[r] = mass[r] * eos::energy(law, density, 0.0);
    capacity[r] = mass[r] * (eos::energy(law, density, 1.0) - eos::energy(law, density, 0.0));
    x[r] = capacity[r] > 0.0 ? (of(r, State::internal) - cold[r]) / capacity[r] : 0.0;
  }
  exchange<double>(x, capacity, part, dt * lattice.cell_volume * gas.heat_exchange);
  for (std::size_t r = 0; r < fluids; ++r) of(r, State::internal) = cold[r] + capacity[r] * x[r];
}

/// Velocities of the faces, and slopes of the parts of the cells.
Flow find_flow(const Gas& gas, const Lattice& lattice, const CellSet& s, const CellSet& q, double dt) {
  const int D = lattice.dimensions, fluids = lattice.fluids;
  Flow flow{lattice, lattice.field(fluids * D), lattice.field(fluids * D)};
  for_each_own_cell(lattice.cells, [&](const Cell& c) {
    find_velocities(gas, lattice, s, q, dt, c, flow);
    for (int r = 0; r < fluids; ++r) {
      const Vector slope = limited_gradient(lattice, q, Equilibrium::part(r), c.place);
      for (int a = 0; a < D; ++a) at(flow.slopes, flow.number(r, a), c.place) = slope[static_cast<std::size_t>(a)];
    }
  });
  return flow;
}

/// Pressures of a step, Pa.
struct Pressures {
  static constexpr int after = 0, change = 1, count = 2;
};
/// The change of pressure, by the divergence that the advection itself sees. False where more flows out of a cell than it has.
bool find_pressures(const Lattice& lattice, const CellSet& q, const Flow& flow, double dt, Domain& domain, CellSet& pressures) {
  return all_own_cells(lattice.cells, domain, [&](const Cell& c) {
    double change = 0.0, compliance = 0.0, most_out = 0.0;
    for (int r = 0; r < lattice.fluids; ++r) {
      const int part = Equilibrium::part(r);
      double swept_out = 0.0;
      flow.for_each_face(c, r, dt, [&](int axis, const CellPlace& donor, int sign, double swept, double offset) {
        change += sign * (swept * (at(q, part, donor) + at(flow.slopes, flow.number(r, axis), donor) * offset));
        if (donor.block == c.place.block && donor.cell == c.place.cell) swept_out += std::abs(swept);
      });
      most_out = std::max(most_out, swept_out);
      compliance += at(q, part, c.place) * at(q, Equilibrium::compressibility(r), c.place);
    }
    change /= lattice.cell_volume * compliance;
    constexpr double least_pressure = 1e-12;
    at(pressures, Pressures::change, c.place) = change;
    at(pressures, Pressures::after, c.place) = std::max(at(q, Equilibrium::pressure, c.place) + change, least_pressure);
    return !(most_out > lattice.cell_volume);
  });
}

/// Momentum, energy and volume of the fluids of a cell, by the new pressures.
void push_fluids(const Lattice& lattice, const CellSet& q, const CellSet& pressures, double dt, const CellPlace& c,
                 CellSet& s) {
  const int D = lattice.dimensions;
  const double cell_volume = lattice.cell_volume;
  const auto face_pressure = [&](const CellPlace& low, const CellPlace& high) {
    const double density_low = at(q, Equilibrium::density, low), density_high = at(q, Equilibrium::density, high);
    return (at(pressures, Pressures::after, low) * density_high + at(pressures, Pressures::after, high) * density_low) /
           (density_low + density_high);
  };
  for (int r = 0; r < lattice.fluids; ++r) {
    const auto own = [&](int quantity) -> double& { return at(s, State::of(D, r, quantity), c); };
    const double part = at(q, Equilibrium::part(r), c), compressibility = at(q, Equilibrium::compressibility(r), c);
    for (int a = 0; a < D; ++a)
      own(State::momentum + a) -=
          dt * part * lattice.area * (face_pressure(c, lattice.next(c, a, 1)) - face_pressure(lattice.next(c, a, -1), c));
    const double change = at(pressures, Pressures::change, c);
    own(State::internal) += cell_volume * part * compressibility * at(pressures, Pressures::after, c) * change;
    own(State::volume) -= cell_volume * part * compressibility * change;
  }
}

/// What a unit of mass carries, in the place of the amounts; of the mass the density.
CellSet carried_by(const Lattice& lattice, const CellSet& s) {
  const int D = lattice.dimensions, fluids = lattice.fluids;
  CellSet carried = lattice.field(fluids * State::count(D));
  for_each_own_cell(lattice.cells, [&](const Cell& cell) {
    const CellPlace& c = cell.place;
    for (int r = 0; r < fluids; ++r) {
      const double mass = at(s, State::of(D, r, State::mass), c);
      at(carried, State::of(D, r, State::mass), c) = mass / lattice.cell_volume;
      for (int n = State::mass + 1; n < State::count(D); ++n)
        at(carried, State::of(D, r, n), c) = mass > 0.0 ? at(s, State::of(D, r, n), c) / mass : 0.0;
    }
  });
  return carried;
}

/// Books the impulse of the walls.
void book_walls(const Lattice& lattice, const CellSet& q, const CellSet& pressures, double dt, std::vector<Passage>& passages) {
  for (Passage& side : passages)
    for_each_cell_of(lattice.cells, side.block, [&](const Cell& c) {
      const int axis = side.side / 2, outward = side.side % 2 == 0 ? -1 : 1;
      if (!lattice.wall(c, axis, outward)) return;
      double& impulse = side.step.momentum[static_cast<std::size_t>(axis)];
      for (int r = 0; r < lattice.fluids; ++r)
        impulse -=
            outward * dt * at(q, Equilibrium::part(r), c.place) * lattice.area * at(pressures, Pressures::after, c.place);
    });
}

/// Slopes of what is carried, along each axis.
CellSet slopes_of_carried(const Lattice& lattice, const CellSet& carried) {
  const int D = lattice.dimensions, fluids = lattice.fluids;
  CellSet slopes = lattice.field(fluids * State::count(D) * D);
  for_each_own_cell(lattice.cells, [&](const Cell& c) {
    for (int r = 0; r < fluids; ++r) {
      double shrink = 1.0;
      for (int n = State::mass; n < State::count(D); ++n) {
        const int quantity = State::of(D, r, n);
        const Vector slope = limited_gradient(lattice, carried, quantity, c.place, shrink);
        for (int a = 0; a < D; ++a) at(slopes, quantity * D + a, c.place) = slope[static_cast<std::size_t>(a)];
        if (n > State::mass) continue;
        const double density = at(carried, quantity, c.place);
        double lightest = density;
        for (const double g : slope) lightest -= 0.5 * lattice.h * std::abs(g);
        shrink = lightest > 0.0 ? density / lightest : 1e300;
      }
    }
  });
  return slopes;
}

/// Moves what the faces have swept from cell to cell. False where a cell is left without mass.
bool advect(const Lattice& lattice, const Flow& flow, const CellSet& carried, const CellSet& slopes, double dt, Domain& domain,
            CellSet& s) {
  const int D = lattice.dimensions;
  return all_own_cells(lattice.cells, domain, [&](const Cell& c) {
    double mass = 0.0;
    for (int r = 0; r < lattice.fluids; ++r) {
      const int first = State::of(D, r, State::mass);
      flow.for_each_face(c, r, dt, [&](int axis, const CellPlace& donor, int sign, double swept, double offset) {
        const auto slope = [&](int n) { return at(slopes, (first + n) * D + axis, donor); };
        const double density = at(carried, first, donor), through = swept * (density + slope(State::mass) * offset);
        at(s, first, c.place) += sign * through;
        for (int n = State::mass + 1; n < State::count(D); ++n)
          at(s, first + n, c.place) += sign * (through * at(carried, first + n, donor) + swept * density * slope(n) * offset);
      });
      mass += at(s, first, c.place);
    }
    return mass > 0.0;
  });
}

}  // namespace

std::vector<std::string> classic_limits(const ClassicDemands& demands) {
  std::vector<std::string> reasons;
  const auto refuse = [&](bool when, std::string_view reason) {
    if (when) reasons.push_back(fmt::format("ice_classic {}, or use scheme = \"ice\"", reason));
  };
  refuse(demands.round, "has no round geometries; use planar_1d, plane or three_dimensional");
  refuse(demands.open_sides, "has walls and periodic sides only; remove the other edges");
  refuse(demands.gravity, "has no gravity; remove it");
  refuse(demands.face_dissipation, "has no dissipation of faces; remove least_mach");
  refuse(demands.implicit, "is explicit; remove implicit");
  refuse(demands.transport, "has no viscosity or conduction; remove them");
  refuse(demands.reactions, "has no reactions; remove them");
  return reasons;
}

void open_classic(Gas& gas) {
  const ClassicDemands demands = demands_of(gas, gas.cells.geometry, gas.gravity, !gas.burns.empty());
  if (const std::vector<std::string> reasons = classic_limits(demands); !reasons.empty())
    throw std::runtime_error(fmt::format("{}", fmt::join(reasons, "\n")));
  const Lattice lattice(gas);
  const int D = lattice.dimensions;
  CellSet& s = gas.classic->state;
  s = lattice.field(lattice.fluids * State::count(D));
  for_each_own_cell(gas.cells, [&](const Cell& c) {
    double mass = 0.0, kinetic = 0.0;
    const auto of = [&](int quantity) { return at(gas.content, quantity, c.place); };
    for (int r = 0; r < lattice.fluids; ++r) mass += of(Content::of(D, r, Content::mass));
    for (int a = 0; a < D; ++a) kinetic += 0.5 * of(Content::momentum + a) * of(Content::momentum + a) / mass;
    for (int r = 0; r < lattice.fluids; ++r) {
      const auto own = [&](int quantity) -> double& { return at(s, State::of(D, r, quantity), c.place); };
      own(State::mass) = of(Content::of(D, r, Content::mass));
      own(State::volume) = lattice.fluids == 1 ? of(Content::cell_volume) : of(Content::of(D, r, Content::volume));
      own(State::internal) = lattice.fluids == 1 ? of(Content::energy) - kinetic : of(Content::of(D, r, Content::internal));
      for (int a = 0; a < D; ++a) own(State::momentum + a) = of(Content::momentum + a) * own(State::mass) / mass;
    }
  });
}

void show_classic(Gas& gas, Domain& domain) {
  const Lattice lattice(gas);
  const int D = lattice.dimensions;
  const CellSet& s = gas.classic->state;
  CellSet q = lattice.field(Equilibrium::part(lattice.fluids));
  for_each_own_cell(gas.cells, [&](const Cell& cell) {
    find_equilibrium(gas, s, lattice, cell, q);
    const CellPlace& c = cell.place;
    Vector momentum{};
    double mass = 0.0, energy = 0.0;
    for (int r = 0; r < lattice.fluids; ++r) {
      const auto own = [&](int quantity) { return at(s, State::of(D, r, quantity), c); };
      mass += own(State::mass), energy += own(State::internal);
      for (int a = 0; a < D; ++a) {
        const double p = own(State::momentum + a);
        momentum[static_cast<std::size_t>(a)] += p;
        if (own(State::mass) > 0.0) energy += 0.5 * p * p / own(State::mass);
      }
      at(gas.content, Content::of(D, r, Content::mass), c) = own(State::mass);
      if (lattice.fluids == 1) continue;
      at(gas.content, Content::of(D, r, Content::volume), c) = at(q, Equilibrium::part(r), c) * lattice.cell_volume;
      at(gas.content, Content::of(D, r, Content::internal), c) = own(State::internal);
    }
    at(gas.content, Content::energy, c) = energy;
    at(gas.primitive, Primitive::density, c) = mass / lattice.cell_volume;
    at(gas.primitive, Primitive::pressure, c) = at(q, Equilibrium::pressure, c);
    at(gas.primitive, Primitive::sound_speed, c) = at(q, Equilibrium::sound, c);
    for (int a = 0; a < D; ++a) {
      const double p = momentum[static_cast<std::size_t>(a)];
      at(gas.content, Content::momentum + a, c) = p, at(gas.primitive, Primitive::velocity + a, c) = p / mass;
    }
  });
  gas.wave_rate = gas.motion_rate = 0.0;
  for (const std::int32_t block : gas.cells.mine)
    for_each_cell_of(gas.cells, block, [&](const Cell& c) {
      double rate = D * at(gas.primitive, Primitive::sound_speed, c.place) / lattice.h;
      for (int a = 0; a < D; ++a) {
        const double motion = std::abs(at(gas.primitive, Primitive::velocity + a, c.place)) / lattice.h;
        rate += motion, gas.motion_rate = largest_rate(gas.motion_rate, motion);
      }
      gas.wave_rate = largest_rate(gas.wave_rate, rate);
    });
  gas.wave_rate = domain.maximum(gas.wave_rate), gas.motion_rate = domain.maximum(gas.motion_rate);
}

Outcome advance_classic(Gas& gas, double dt, Domain& domain) {
  const Lattice lattice(gas);
  CellSet s = gas.classic->state, q = lattice.field(Equilibrium::part(lattice.fluids));
  const auto all_in_equilibrium = [&] {
    return all_own_cells(gas.cells, domain, [&](const Cell& c) { return find_equilibrium(gas, s, lattice, c, q); });
  };
  const auto share_all = [&](CellSet& set) { share_scalars(gas, set, Beyond::continued, domain); };

  if (!all_in_equilibrium()) return Outcome::rejected;
  share_all(s), share_all(q);
  Flow flow = find_flow(gas, lattice, s, q, dt);
  share_all(flow.speeds), share_all(flow.slopes);

  CellSet pressures = lattice.field(Pressures::count);
  if (!find_pressures(lattice, q, flow, dt, domain, pressures)) return Outcome::rejected;
  share_all(pressures);
  for_each_own_cell(gas.cells, [&](const Cell& c) {
    push_fluids(lattice, q, pressures, dt, c.place, s);
    exchange_in_cell(gas, lattice, q, dt, c.place, s);
  });
  book_walls(lattice, q, pressures, dt, gas.passages);

  CellSet carried = carried_by(lattice, s);
  share_all(carried);
  CellSet slopes = slopes_of_carried(lattice, carried);
  share_all(slopes);
  if (!advect(lattice, flow, carried, slopes, dt, domain, s) || !all_in_equilibrium()) return Outcome::rejected;
  std::swap(gas.classic->state, s);
  return Outcome::done;
}

}  // namespace brisance::simulator::gas
