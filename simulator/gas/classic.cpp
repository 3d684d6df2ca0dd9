#include "simulator/gas/classic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/exchange.hpp"
#include "simulator/gas/transport.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;
using Values = std::vector<double>;

/// The cells of the box in the order of x, y, z.
struct Lattice {
  std::array<int, 3> lower{}, cells{};
  std::array<bool, 3> periodic{};
  double h = 0.0;
  int dimensions = 1;
  std::size_t count = 0;

  explicit Lattice(const Gas& gas) : h(gas.cells.cell_size), dimensions(gas.dimensions()), count(1) {
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = gas.cells.lower[a], cells[a] = gas.cells.upper[a] - gas.cells.lower[a];
      periodic[a] = 2 * a < gas.edges.size() && gas.edges[2 * a].kind == EdgeKind::periodic;
      count *= static_cast<std::size_t>(cells[a]);
    }
  }
  double volume() const { return std::pow(h, dimensions); }
  double area() const { return std::pow(h, dimensions - 1); }
  std::size_t number(const std::array<int, 3>& i) const {
    return static_cast<std::size_t>(i[0] - lower[0] + cells[0] * (i[1] - lower[1] + cells[1] * (i[2] - lower[2])));
  }
  /// The next cell along an axis; the cell itself where a wall is in between.
  std::size_t next(std::size_t c, std::size_t axis, int step) const {
    const std::size_t stride = axis == 0   ? 1
                               : axis == 1 ? static_cast<std::size_t>(cells[0])
                                           : static_cast<std::size_t>(cells[0] * cells[1]);
    const auto length = static_cast<std::size_t>(cells[axis]);
    const std::size_t i = c / stride % length;
    if (step > 0) return i + 1 < length ? c + stride : periodic[axis] ? c - i * stride : c;
    return i > 0 ? c - stride : periodic[axis] ? c + (length - 1) * stride : c;
  }
};

template <class F>
void for_each_own_cell(const Gas& gas, F&& f) {
  for (const std::int32_t b : gas.cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c)
      if (gas.cells.contains(gas.cells.index(block, c))) f(block, c, gas.cells.index(block, c));
  }
}

eos::PressureSlopes<double> slopes_of(const Fluid& fluid, double density, double energy) {
  return std::visit([&](const auto& law) { return eos::pressure_slopes(law, density, energy); }, fluid.equation_of_state);
}

/// Fluids of all cells at one pressure.
struct Equilibrium {
  Values pressure, density, sound;                // [cell]; of the mixture, the fastest of its fluids
  Values part, specific_volume, compressibility;  // [fluid][cell]: theta, v, kappa
  bool good = true;
};
constexpr double least_part = 1e-12;

/// Specific volume at a pressure and energy, from a start near it.
double specific_volume_at(const Fluid& fluid, double pressure, double energy, double start) {
  double v = start;
  for (int n = 0; n < 100; ++n) {
    const auto at = slopes_of(fluid, 1.0 / v, energy);
    const double change = (at.pressure - pressure) * v * v / at.per_density;
    const double next = std::clamp(v + change, 0.5 * v, 2.0 * v);
    const bool settled = std::abs(next - v) <= 1e-15 * v;
    v = next;
    if (settled) break;
  }
  return v;
}

Equilibrium equilibrium_of(const Gas& gas, const Lattice& lattice) {
  const ClassicState& s = *gas.classic;
  const std::size_t fluids = gas.fluids.size(), n = lattice.count;
  const double room = lattice.volume();
  Equilibrium q;
  q.pressure.resize(n), q.density.resize(n), q.sound.resize(n);
  q.part.resize(fluids * n), q.specific_volume.assign(fluids * n, 1.0), q.compressibility.resize(fluids * n);
  for (std::size_t c = 0; c < n; ++c) {
    Values v(fluids), energy(fluids);
    std::vector<bool> here(fluids);
    double p = 0.0, weight = 0.0;
    for (std::size_t r = 0; r < fluids; ++r) {
      const std::size_t i = r * n + c;
      q.density[c] += s.mass[i] / room;
      here[r] = s.mass[i] > 0.0 && s.volume[i] > least_part * room;
      if (!here[r]) continue;
      v[r] = fluids == 1 ? room / s.mass[i] : s.volume[i] / s.mass[i], energy[r] = s.internal[i] / s.mass[i];
      const auto at = slopes_of(gas.fluids[r], 1.0 / v[r], energy[r]);
      const double soft = s.mass[i] * v[r] * v[r] / at.per_density;
      p += soft * at.pressure, weight += soft;
    }
    p /= weight;
    // Newton in the pressure at fixed energies; halved where it would leave the positive ones.
    constexpr int most_iterations = 100;
    for (int k = 0; fluids > 1 && k < most_iterations; ++k) {
      double sum = -1.0, slope = 0.0;
      for (std::size_t r = 0; r < fluids; ++r) {
        if (!here[r]) continue;
        const double density = s.mass[r * n + c] / room;
        v[r] = specific_volume_at(gas.fluids[r], p, energy[r], v[r]);
        sum += density * v[r];
        slope += density * v[r] * v[r] / slopes_of(gas.fluids[r], 1.0 / v[r], energy[r]).per_density;
      }
      if (std::abs(sum) < 1e-13) break;
      if (k + 1 == most_iterations) q.good = false;
      p = std::max(p + sum / slope, 0.5 * p);
    }
    q.pressure[c] = p;
    q.good = q.good && p > 0.0;
    for (std::size_t r = 0; r < fluids; ++r) {
      if (!here[r]) continue;
      const std::size_t i = r * n + c;
      const auto at = slopes_of(gas.fluids[r], 1.0 / v[r], energy[r]);
      const double square = at.per_density + at.pressure * at.per_energy * v[r] * v[r];
      q.part[i] = s.mass[i] * v[r] / room, q.specific_volume[i] = v[r], q.compressibility[i] = v[r] / square;
      q.sound[c] = std::max(q.sound[c], std::sqrt(square));
    }
  }
  return q;
}

/// Gradient of a field in a cell, limited so that no corner of the cell leaves the range of its neighbours. `shrink` divides
/// what the corners may differ by: mass and what it carries vary together.
Vector limited_gradient(const Lattice& lattice, const double* field, std::size_t c, double shrink = 1.0) {
  Vector gradient{};
  double lowest = field[c], highest = field[c], reach_of_corner = 0.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice.dimensions); ++a) {
    const double below = field[lattice.next(c, a, -1)], above = field[lattice.next(c, a, 1)];
    lowest = std::min({lowest, below, above}), highest = std::max({highest, below, above});
    gradient[a] = (above - below) / (2.0 * lattice.h);
    reach_of_corner += 0.5 * lattice.h * std::abs(gradient[a]) * shrink;
  }
  if (reach_of_corner == 0.0) return gradient;
  const double factor = std::min({1.0, (highest - field[c]) / reach_of_corner, (field[c] - lowest) / reach_of_corner});
  for (double& g : gradient) g *= factor;
  return gradient;
}

/// Velocity of each fluid through the high face of each cell: [axis][fluid][cell].
struct FaceVelocities {
  std::array<Values, 3> of;
  std::size_t cells;
  double at(std::size_t axis, std::size_t fluid, std::size_t cell) const { return of[axis][fluid * cells + cell]; }
};

FaceVelocities face_velocities(const Gas& gas, const Lattice& lattice, const Equilibrium& q, double dt) {
  const ClassicState& s = *gas.classic;
  const std::size_t fluids = gas.fluids.size(), n = lattice.count;
  const double room = lattice.volume();
  FaceVelocities u{{}, n};
  Values velocity(fluids), capacity(fluids), part(fluids);
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice.dimensions); ++a) {
    u.of[a].assign(fluids * n, 0.0);
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t d = lattice.next(c, a, 1);
      if (d == c) continue;  // a wall
      double mixture = 0.0, mass = 0.0;
      for (std::size_t r = 0; r < fluids; ++r) {
        const std::size_t i = r * n + c, j = r * n + d;
        const bool low = q.part[i] > 0.0, high = q.part[j] > 0.0;
        part[r] = 0.5 * (q.part[i] + q.part[j]);
        velocity[r] = capacity[r] = 0.0;
        if (!low && !high) continue;
        const double v_low = q.specific_volume[low ? i : j], v_high = q.specific_volume[high ? j : i];
        const double v = 2.0 * v_low * v_high / (v_low + v_high);
        velocity[r] = (s.momentum[i][a] + s.momentum[j][a]) / (s.mass[i] + s.mass[j]) -
                      dt * v * (q.pressure[d] - q.pressure[c]) / lattice.h;
        capacity[r] = room * part[r] / v;
        mixture += capacity[r] * velocity[r], mass += capacity[r];
      }
      exchange<double>(velocity, capacity, part, dt * room * s.momentum_exchange);
      for (std::size_t r = 0; r < fluids; ++r) u.of[a][r * n + c] = part[r] > 0.0 ? velocity[r] : mixture / mass;
    }
  }
  return u;
}

/// What passes the high faces of all cells in a step: the volume swept times the field where it comes from. With `mass` the
/// field is what a unit of mass carries, and goes with the mass (compatible fluxes).
template <class Add>
void advect(const Lattice& lattice, const FaceVelocities& u, std::size_t fluid, double dt, const double* density,
            const double* carried, Add&& add) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice.dimensions); ++a)
    for (std::size_t c = 0; c < lattice.count; ++c) {
      const std::size_t d = lattice.next(c, a, 1);
      if (d == c) continue;
      const double speed = u.at(a, fluid, c), swept = speed * dt * lattice.area();
      const std::size_t donor = speed > 0.0 ? c : d;
      const double offset = (speed > 0.0 ? 0.5 : -0.5) * (lattice.h - std::abs(speed) * dt);
      const Vector slope = limited_gradient(lattice, density, donor);
      double through = swept * (density[donor] + slope[a] * offset);
      if (carried) {
        double lightest = density[donor];
        for (const double g : slope) lightest -= 0.5 * lattice.h * std::abs(g);
        const double shrink = lightest > 0.0 ? density[donor] / lightest : 1e300;
        through =
            through * carried[donor] + swept * density[donor] * limited_gradient(lattice, carried, donor, shrink)[a] * offset;
      }
      add(c, d, through);
    }
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

void open_classic(Gas& gas, const Domain& domain) {
  if (domain.size() > 1) throw std::runtime_error("ice_classic runs in one process only");
  const ClassicDemands demands = demands_of(gas, gas.cells.geometry, gas.gravity, !gas.burns.empty());
  if (const std::vector<std::string> reasons = classic_limits(demands); !reasons.empty())
    throw std::runtime_error(fmt::format("{}", fmt::join(reasons, "\n")));
  const Lattice lattice(gas);
  const std::size_t fluids = gas.fluids.size(), n = lattice.count;
  ClassicState& s = *gas.classic;
  s.mass.assign(fluids * n, 0.0), s.volume = s.internal = s.mass, s.momentum.assign(fluids * n, Vector{});
  const int D = gas.dimensions();
  for_each_own_cell(gas, [&](std::size_t block, int c, const std::array<int, 3>& index) {
    double mass = 0.0, kinetic = 0.0;
    const auto of = [&](int quantity) { return gas.content.cell(block, quantity, c); };
    const auto first = [&](std::size_t r) { return Content::fluids(D) + static_cast<int>(r) * gas.fluid_quantities(); };
    for (std::size_t r = 0; r < fluids; ++r) mass += of(first(r));
    for (int a = 0; a < D; ++a) kinetic += 0.5 * of(Content::momentum + a) * of(Content::momentum + a) / mass;
    for (std::size_t r = 0; r < fluids; ++r) {
      const std::size_t i = r * n + lattice.number(index);
      s.mass[i] = of(first(r));
      s.volume[i] = fluids == 1 ? of(Content::room) : of(first(r) + Content::volume);
      s.internal[i] = fluids == 1 ? of(Content::energy) - kinetic : of(first(r) + Content::internal);
      for (int a = 0; a < D; ++a) s.momentum[i][static_cast<std::size_t>(a)] = of(Content::momentum + a) * s.mass[i] / mass;
    }
  });
}

void show_classic(Gas& gas) {
  const Lattice lattice(gas);
  const Equilibrium q = equilibrium_of(gas, lattice);
  const ClassicState& s = *gas.classic;
  const std::size_t fluids = gas.fluids.size(), n = lattice.count;
  const int D = gas.dimensions();
  gas.wave_rate = gas.motion_rate = 0.0;
  for_each_own_cell(gas, [&](std::size_t block, int cell, const std::array<int, 3>& index) {
    const std::size_t c = lattice.number(index);
    Vector momentum{};
    double mass = 0.0, energy = 0.0, rate = static_cast<double>(D) * q.sound[c] / lattice.h;
    for (std::size_t r = 0; r < fluids; ++r) {
      const std::size_t i = r * n + c;
      const int first = Content::fluids(D) + static_cast<int>(r) * gas.fluid_quantities();
      mass += s.mass[i], energy += s.internal[i];
      for (std::size_t a = 0; a < 3; ++a) {
        momentum[a] += s.momentum[i][a];
        if (s.mass[i] > 0.0) energy += 0.5 * s.momentum[i][a] * s.momentum[i][a] / s.mass[i];
      }
      gas.content.cell(block, first, cell) = s.mass[i];
      if (fluids == 1) continue;
      gas.content.cell(block, first + Content::volume, cell) = q.part[i] * lattice.volume();
      gas.content.cell(block, first + Content::internal, cell) = s.internal[i];
    }
    gas.content.cell(block, Content::energy, cell) = energy;
    gas.primitive.cell(block, Primitive::density, cell) = mass / lattice.volume();
    gas.primitive.cell(block, Primitive::pressure, cell) = q.pressure[c];
    gas.primitive.cell(block, Primitive::sound_speed, cell) = q.sound[c];
    for (int a = 0; a < D; ++a) {
      const double u = momentum[static_cast<std::size_t>(a)] / mass;
      gas.content.cell(block, Content::momentum + a, cell) = momentum[static_cast<std::size_t>(a)];
      gas.primitive.cell(block, Primitive::velocity + a, cell) = u;
      rate += std::abs(u) / lattice.h, gas.motion_rate = std::max(gas.motion_rate, std::abs(u) / lattice.h);
    }
    gas.wave_rate = rate < gas.wave_rate ? gas.wave_rate : rate;
  });
}

Outcome advance_classic(Gas& gas, double dt) {
  const Lattice lattice(gas);
  const std::size_t fluids = gas.fluids.size(), n = lattice.count, D = static_cast<std::size_t>(lattice.dimensions);
  const double room = lattice.volume(), area = lattice.area();
  const Equilibrium q = equilibrium_of(gas, lattice);
  if (!q.good) return Outcome::rejected;
  ClassicState s = *gas.classic;
  const FaceVelocities u = face_velocities(gas, lattice, q, dt);

  // The change of pressure, by the divergence that the advection itself sees.
  Values change(n), compliance(n), swept_out(fluids * n);
  for (std::size_t r = 0; r < fluids; ++r) {
    advect(lattice, u, r, dt, q.part.data() + r * n, nullptr,
           [&](std::size_t c, std::size_t d, double through) { change[c] -= through, change[d] += through; });
    for (std::size_t c = 0; c < n; ++c) compliance[c] += q.part[r * n + c] * q.compressibility[r * n + c];
    for (std::size_t a = 0; a < D; ++a)
      for (std::size_t c = 0; c < n; ++c) {
        const double swept = u.at(a, r, c) * dt * area;
        swept_out[r * n + (swept > 0.0 ? c : lattice.next(c, a, 1))] += std::abs(swept);
      }
  }
  if (*std::max_element(swept_out.begin(), swept_out.end()) > room) return Outcome::rejected;
  Values pressure(n);
  for (std::size_t c = 0; c < n; ++c) {
    change[c] /= room * compliance[c];
    constexpr double least_pressure = 1e-12;
    pressure[c] = std::max(q.pressure[c] + change[c], least_pressure);
  }

  // Lagrangian phase.
  const auto face_pressure = [&](std::size_t c, std::size_t d) {
    return (pressure[c] * q.density[d] + pressure[d] * q.density[c]) / (q.density[c] + q.density[d]);
  };
  for (std::size_t r = 0; r < fluids; ++r)
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t i = r * n + c;
      for (std::size_t a = 0; a < D; ++a)
        s.momentum[i][a] -=
            dt * q.part[i] * area * (face_pressure(c, lattice.next(c, a, 1)) - face_pressure(lattice.next(c, a, -1), c));
      s.internal[i] += room * q.part[i] * q.compressibility[i] * pressure[c] * change[c];
      s.volume[i] -= room * q.part[i] * q.compressibility[i] * change[c];
    }
  for (Passage& wall : gas.passages) {  // all of a side in its first passage
    const auto first =
        std::find_if(gas.passages.begin(), gas.passages.end(), [&](const Passage& p) { return p.side == wall.side; });
    const auto a = static_cast<std::size_t>(wall.side / 2);
    if (&*first != &wall || lattice.periodic[a]) continue;
    const int outward = wall.side % 2 == 0 ? -1 : 1;
    double impulse = 0.0;
    for (std::size_t c = 0; c < n; ++c)
      if (lattice.next(c, a, outward) == c)
        for (std::size_t r = 0; r < fluids; ++r) impulse -= outward * dt * q.part[r * n + c] * area * pressure[c];
    wall.step.momentum[a] = impulse;
  }

  // Exchange. What the drag takes from the kinetic energy is lost.
  Values x(fluids), capacity(fluids), part(fluids);
  for (std::size_t c = 0; fluids > 1 && c < n; ++c) {
    for (std::size_t r = 0; r < fluids; ++r) part[r] = q.part[r * n + c], capacity[r] = s.mass[r * n + c];
    for (std::size_t a = 0; a < D; ++a) {
      for (std::size_t r = 0; r < fluids; ++r) x[r] = capacity[r] > 0.0 ? s.momentum[r * n + c][a] / capacity[r] : 0.0;
      exchange<double>(x, capacity, part, dt * room * s.momentum_exchange);
      for (std::size_t r = 0; r < fluids; ++r) s.momentum[r * n + c][a] = capacity[r] * x[r];
    }
    if (gas.heat_exchange == 0.0) continue;
    Values cold(fluids);
    for (std::size_t r = 0; r < fluids; ++r) {
      const EquationOfState& law = gas.fluids[r].equation_of_state;
      const double density = 1.0 / q.specific_volume[r * n + c], mass = s.mass[r * n + c];
      cold[r] = mass * eos::energy(law, density, 0.0);
      capacity[r] = mass * (eos::energy(law, density, 1.0) - eos::energy(law, density, 0.0));
      x[r] = capacity[r] > 0.0 ? (s.internal[r * n + c] - cold[r]) / capacity[r] : 0.0;
    }
    exchange<double>(x, capacity, part, dt * room * gas.heat_exchange);
    for (std::size_t r = 0; r < fluids; ++r) s.internal[r * n + c] = cold[r] + capacity[r] * x[r];
  }

  // Advection.
  ClassicState next = s;
  for (std::size_t r = 0; r < fluids; ++r) {
    Values density(n), carried(n);
    for (std::size_t c = 0; c < n; ++c) density[c] = s.mass[r * n + c] / room;
    const auto carry = [&](auto&& amount_of, auto&& receive) {
      for (std::size_t c = 0; c < n; ++c) carried[c] = s.mass[r * n + c] > 0.0 ? amount_of(r * n + c) / s.mass[r * n + c] : 0.0;
      advect(lattice, u, r, dt, density.data(), carried.data(), [&](std::size_t c, std::size_t d, double through) {
        receive(r * n + c) -= through, receive(r * n + d) += through;
      });
    };
    advect(lattice, u, r, dt, density.data(), nullptr, [&](std::size_t c, std::size_t d, double through) {
      next.mass[r * n + c] -= through, next.mass[r * n + d] += through;
    });
    carry([&](std::size_t i) { return s.internal[i]; }, [&](std::size_t i) -> double& { return next.internal[i]; });
    carry([&](std::size_t i) { return s.volume[i]; }, [&](std::size_t i) -> double& { return next.volume[i]; });
    for (std::size_t a = 0; a < D; ++a)
      carry([&](std::size_t i) { return s.momentum[i][a]; }, [&](std::size_t i) -> double& { return next.momentum[i][a]; });
  }
  for (std::size_t c = 0; c < n; ++c) {
    double mass = 0.0;
    for (std::size_t r = 0; r < fluids; ++r) mass += next.mass[r * n + c];
    if (!(mass > 0.0)) return Outcome::rejected;
  }
  std::swap(*gas.classic, next);
  if (!equilibrium_of(gas, lattice).good) {
    std::swap(*gas.classic, next);
    return Outcome::rejected;
  }
  return Outcome::done;
}

}  // namespace brisance::simulator::gas
