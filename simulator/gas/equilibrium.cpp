#include "simulator/gas/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;

template <class Real>
eos::PressureSlopes<Real> slopes_of(const EquationOfState& law, const Real& density, const Real& energy) {
  return std::visit([&](const auto& l) { return eos::pressure_slopes(l, density, energy); }, law);
}
double least_bulk_modulus(const EquationOfState& law, double density) {
  const double c = std::visit([](const auto& l) { return l.lowest_sound_speed(); }, law);
  return density * std::max(c * c, 1e-12);
}

/// How far above its own a fluid may meet the highest pressure of the cell, in its bulk moduli, before it is relaxed.
constexpr double crushing = 0.5;

/// One value for each fluid, on the stack as a rule. Boost's own allocator does not align packs.
template <class T>
using OfFluids = boost::container::small_vector<T, 8, std::allocator<T>>;

/// One lane, with certainty: the volume that the fluids take at a pressure falls with it, and the pressures they have now
/// bracket the one sought.
double bisect(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const OfFluids<LanesMask>& present,
              double room, int l) {
  double low = std::numeric_limits<double>::infinity(), high = -low, least = -low;
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    const double m = shares[r].mass[l], v = shares[r].volume[l];
    if (!present[r][l]) continue;
    const double p = eos::pressure(fluids[r].equation_of_state, m / v, shares[r].internal[l] / m);
    low = std::min(low, p), high = std::max(high, p);
    least = std::max(least, fluids[r].least_pressure);
  }
  low = std::max(low, std::min(least, high));
  // Specific volume of a fluid that has worked against p: P(1/v, e0 - p (v - v0)) = p. The left side falls with v.
  const auto volume_at = [&](std::size_t r, double p) {
    const double m = shares[r].mass[l], v0 = shares[r].volume[l] / m, e0 = shares[r].internal[l] / m;
    const auto excess = [&](double v) { return eos::pressure(fluids[r].equation_of_state, 1.0 / v, e0 - p * (v - v0)) - p; };
    double a = v0, b = v0;
    for (int n = 0; n < 200 && excess(a) < 0.0; ++n) b = a, a *= 0.7;
    for (int n = 0; n < 200 && excess(b) > 0.0; ++n) a = b, b *= 1.4;
    for (int n = 0; n < 200 && b - a > 1e-15 * b; ++n) {
      const double middle = 0.5 * (a + b);
      (excess(middle) > 0.0 ? a : b) = middle;
    }
    return m * 0.5 * (a + b);
  };
  for (int n = 0; n < 200 && high - low > 1e-15 * (std::abs(high) + std::abs(low)); ++n) {
    const double p = 0.5 * (low + high);
    double sum = 0.0;
    for (std::size_t r = 0; r < fluids.size(); ++r)
      if (present[r][l]) sum += volume_at(r, p);
    (sum > room ? low : high) = p;
  }
  const double p = 0.5 * (low + high);
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    const double before = shares[r].volume[l];
    if (!present[r][l]) continue;
    const double now = volume_at(r, p);
    shares[r].internal.set(l, shares[r].internal[l] - p * (now - before));
    shares[r].volume.set(l, now);
  }
  return p;
}

/// Heat (J) that a fluid holds; of a law that does not tell, what it usually holds.
Lanes heat_in(const Fluid& fluid, const FluidShare& s) {
  if (eos::caloric(fluid.equation_of_state) != eos::Caloric::complete) return s.mass * fluid.usual_heat;
  const Lanes density = select(s.volume > 0.0, s.mass / s.volume, Lanes(fluid.usual_density));
  return s.internal - s.mass * coldest_energy(fluid, density);
}

/// Gives heat (J) to the fluids of a cell, by mass. What is taken away, other than rounding, comes from the heat that each has,
/// or a fluid of little heat would be left with less than none.
void share_heat(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& heat) {
  const std::size_t n = fluids.size();
  std::vector<Lanes> weight(n);
  Lanes sum(0.0), gross(0.0);
  for (const FluidShare& s : shares) gross += abs(s.internal);
  constexpr double rounding = 1e-12;
  const LanesMask taken = heat < -rounding * gross;
  for (std::size_t r = 0; r < n; ++r) {
    weight[r] = shares[r].mass;
    if (any(taken)) weight[r] = select(taken, max(heat_in(fluids[r], shares[r]), Lanes(0.0)), weight[r]);
    sum += weight[r];
  }
  for (std::size_t r = 0; r < n; ++r) shares[r].internal += heat * weight[r] / max(sum, Lanes(1e-300));
}

/// A fluid that has less than no heat, a share of the work of the whole cell having been more than it held, is warmed by the
/// others.
void warm_cold_fluids(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares) {
  const std::size_t n = fluids.size();
  LanesMask cold(false);
  Lanes held(0.0), lent(0.0), mass(0.0);
  std::vector<Lanes> lack(n), lends(n);
  for (std::size_t r = 0; r < n; ++r) {
    lends[r] = heat_in(fluids[r], shares[r]);
    mass += shares[r].mass;
    const LanesMask here = shares[r].mass > 0.0;
    lack[r] = select(here & (lends[r] < 0.0), -lends[r], Lanes(0.0));
    lends[r] = select(here, max(lends[r], Lanes(0.0)), Lanes(0.0));
    cold |= lack[r] > 0.0;
    held += lends[r];
  }
  if (none(cold)) return;
  constexpr double warmth = 1e-3;  // of the mean heat of the cell's mass
  for (std::size_t r = 0; r < n; ++r) {
    lack[r] = select(lack[r] > 0.0, lack[r] + warmth * held * shares[r].mass / mass, Lanes(0.0));
    lent += lack[r];
  }
  // Lent in proportion; more than there is goes to nobody.
  const Lanes part = select(cold & (lent < held), lent / max(held, Lanes(1e-300)), Lanes(0.0));
  for (std::size_t r = 0; r < n; ++r) shares[r].internal += select(part > 0.0, lack[r] - part * lends[r], Lanes(0.0));
}

/// What a fluid of a cell holds beyond a thousand times its usual heat, and beyond what makes its own sound ten times as fast
/// as the fastest waves of the step before (m/s; in foam they are far slower than the sound of the gas), goes to the others. A
/// trace that is carried ahead of a front expands in the cells of low pressure there, keeps its energy, and is pressed together
/// when the front comes: cell by cell it would grow hotter and thinner without end, and in detonating sticks it did so until
/// nothing was left of its mass.
void cool_traces(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, double fastest) {
  constexpr double times = 10.0, usual_heats = 1e3;
  constexpr double most_part = 2.0;  // of the energy, that a squared speed of sound, Gamma (Gamma + 1) e, may be
  const double square = times * times * fastest * fastest;
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    FluidShare& hot = shares[r];
    const double usual = usual_heats * fluids[r].usual_heat;
    const LanesMask suspicious = (most_part * hot.internal > square * hot.mass) & (hot.internal > usual * hot.mass) &
                                 (hot.mass > 0.0) & (hot.volume > 0.0);
    if (none(suspicious)) continue;
    const Lanes density = select(suspicious, hot.mass / hot.volume, Lanes(fluids[r].usual_density)),
                energy = select(suspicious, hot.internal / hot.mass, Lanes(fluids[r].usual_energy));
    const Lanes gamma = slopes_of(fluids[r].equation_of_state, density, energy).per_energy / density;
    const Lanes most = hot.mass * max(square / max(gamma * (gamma + 1.0), Lanes(1e-300)), Lanes(usual));
    Lanes others(0.0);
    for (const FluidShare& other : shares)
      if (&other != &hot) others += other.mass;
    const Lanes excess = select(suspicious & (others > 0.0), max(hot.internal - most, Lanes(0.0)), Lanes(0.0));
    if (none(excess > 0.0)) continue;
    hot.internal -= excess;
    for (FluidShare& other : shares)
      if (&other != &hot) other.internal += excess * other.mass / max(others, Lanes(1e-300));
  }
}

struct Largest {
  double wave = 0.0, motion = 0.0;
};

template <int D>
Largest equilibrium_of(Gas& gas, std::size_t block) {
  const std::size_t fluids = gas.fluids.size();
  Largest largest;
  std::vector<FluidShare> shares(fluids);
  const double inverse_cell_size = 1.0 / gas.cells.cell_size;
  const double fastest =
      gas.wave_rate > 0.0 ? gas.wave_rate * gas.cells.cell_size : 1e150;  // nobody knows before the first step
  for (int k = 0; k < gas.cells.packs(); ++k) {
    const std::uint8_t inside = cells_inside(gas.cells, block, k);
    if (inside == 0) continue;
    const LanesMask active = lanes_of(inside);
    const Lanes room = gas.content.at(block, Content::room)[k];
    Lanes mass(0.0);
    for (std::size_t r = 0; r < fluids; ++r)
      mass += shares[r].mass =
          gas.content.at(block, Content::fluids(D) + static_cast<int>(r) * gas.fluid_quantities() + Content::mass)[k];
    const Lanes density = mass / room;
    Lanes u[D], speed(0.0), motion(0.0), kinetic(0.0);
    for (int a = 0; a < D; ++a) {
      const Lanes p = gas.content.at(block, Content::momentum + a)[k];
      u[a] = p / mass, kinetic += 0.5 * p * u[a];
      speed += abs(u[a]), motion = max(motion, abs(u[a]));
    }
    const Lanes internal = gas.content.at(block, Content::energy)[k] - kinetic;
    Lanes pressure, bulk, gruneisen(0.0);
    if (fluids == 1) {
      const auto at = slopes_of(gas.fluids[0].equation_of_state, density, Lanes(internal / mass));
      pressure = at.pressure, gruneisen = at.per_energy / density;
      bulk = density * at.per_density + pressure * gruneisen;
      bulk = max(bulk, Lanes(least_bulk_modulus(gas.fluids[0].equation_of_state, 1.0)) * density);
    } else {
      for (std::size_t r = 0; r < fluids; ++r) {
        const int first = Content::fluids(D) + 3 * static_cast<int>(r);
        shares[r].volume = gas.content.at(block, first + Content::volume)[k];
        shares[r].internal = gas.content.at(block, first + Content::internal)[k];
      }
      // Cells that are not of the box hold anything: to look for its pressure can take very long.
      const Lanes space = select(active, room, Lanes(1.0));
      for (std::size_t r = 0; r < fluids; ++r) {
        const Fluid& fluid = gas.fluids[r];
        const double here = r == 0 ? fluid.usual_density : 0.0;
        shares[r].mass = select(active, shares[r].mass, Lanes(here));
        shares[r].volume = select(active, shares[r].volume, Lanes(r == 0 ? 1.0 : 0.0));
        shares[r].internal = select(active, shares[r].internal, Lanes(here * fluid.usual_energy));
      }
      // Where velocities have mixed, kinetic energy has become heat.
      Lanes heat = select(active, internal, shares[0].internal);
      for (std::size_t r = 0; r < fluids; ++r) heat -= shares[r].internal;
      share_heat(gas.fluids, shares, heat);
      warm_cold_fluids(gas.fluids, shares);
      cool_traces(gas.fluids, shares, fastest);
      pressure = equilibrate(gas.fluids, shares, space);
      Lanes compliance(0.0);
      for (std::size_t r = 0; r < fluids; ++r) {
        const int first = Content::fluids(D) + 3 * static_cast<int>(r);
        Lanes& volume = gas.content.at(block, first + Content::volume)[k];
        Lanes& energy = gas.content.at(block, first + Content::internal)[k];
        volume = select(active, shares[r].volume, volume), energy = select(active, shares[r].internal, energy);
        const LanesMask present = is_present(shares[r].volume, shares[r].mass, room);
        compliance += select(present, shares[r].volume / shares[r].bulk_modulus, Lanes(0.0));
        gruneisen += shares[r].volume / room * shares[r].gruneisen;
      }
      // The square of a fluid's impedance over the cell's is its part of the mass over that of the compressibility.
      Lanes softness(0.0);
      for (std::size_t r = 0; r < fluids; ++r) {
        Lanes& share = gas.primitive.at(block, Primitive::share(D, static_cast<int>(r)))[k];
        const LanesMask present = is_present(shares[r].volume, shares[r].mass, room);
        share = select(present, shares[r].volume / (shares[r].bulk_modulus * compliance), Lanes(0.0));
        softness += sqrt(share * shares[r].mass / mass);
      }
      gas.primitive.at(block, Primitive::softness(D, static_cast<int>(fluids)))[k] = min(softness, Lanes(1.0));
      bulk = room / compliance;
    }
    const Lanes sound = sqrt(bulk / density);
    const auto put = [&](int quantity, const Lanes& value) {
      Lanes& at = gas.primitive.at(block, quantity)[k];
      at = select(active, value, at);
    };
    put(Primitive::density, density), put(Primitive::pressure, pressure), put(Primitive::sound_speed, sound);
    put(Primitive::gruneisen, gruneisen);
    for (int a = 0; a < D; ++a) put(Primitive::velocity + a, u[a]);
    const Lanes wave = (speed + static_cast<double>(D) * sound) * inverse_cell_size;
    for (int l = 0; l < 8; ++l) {
      if (!(inside >> l & 1)) continue;
      // A state that is no state must not pass for one without waves.
      largest.wave = wave[l] < largest.wave ? largest.wave : wave[l];
      largest.motion = std::max(largest.motion, motion[l] * inverse_cell_size);
    }
  }
  return largest;
}

}  // namespace

void relax(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& room, int l) {
  constexpr double bit = 0.1;     // of the volume
  constexpr int most_bits = 100;  // a gas without heat resists nothing; it keeps 3e-5 of its volume
  struct State {
    bool here;
    double pressure, bulk_modulus;
  };
  const std::size_t n = fluids.size();
  OfFluids<State> state(n);
  for (int i = 0; i < most_bits; ++i) {
    double mass = 0.0;  // of those that are here: one may be pressed to next to nothing on the way
    std::size_t high = n, low = n;
    for (std::size_t r = 0; r < n; ++r) {
      const FluidShare& s = shares[r];
      state[r].here = is_present(s.volume[l], s.mass[l], room[l]);
      if (!state[r].here) continue;
      const double density = s.mass[l] / s.volume[l];
      const auto at = slopes_of(fluids[r].equation_of_state, density, s.internal[l] / s.mass[l]);
      state[r].pressure = at.pressure;
      state[r].bulk_modulus = std::max(density * at.per_density + at.pressure * at.per_energy / density,
                                       least_bulk_modulus(fluids[r].equation_of_state, density));
      mass += s.mass[l];
      if (high == n || at.pressure > state[high].pressure) high = r;
    }
    double worst = crushing;
    for (std::size_t r = 0; r < n; ++r) {
      const double jump = state[r].here ? (state[high].pressure - state[r].pressure) / state[r].bulk_modulus : 0.0;
      if (jump > worst) low = r, worst = jump;
    }
    if (low == n) return;
    FluidShare &pressed = shares[low], &expands = shares[high];
    const double a = pressed.volume[l], b = expands.volume[l];
    const double rise = state[low].bulk_modulus / a, fall = state[high].bulk_modulus / b;
    const double dV = std::min((state[high].pressure - state[low].pressure) / (rise + fall), bit * std::min(a, b));
    const double taken = (state[low].pressure + 0.5 * rise * dV) * dV, done = (state[high].pressure - 0.5 * fall * dV) * dV;
    pressed.volume.set(l, a - dV), pressed.internal.set(l, pressed.internal[l] + taken);
    expands.volume.set(l, b + dV), expands.internal.set(l, expands.internal[l] - done);
    for (std::size_t r = 0; r < n; ++r)
      if (state[r].here) shares[r].internal.set(l, shares[r].internal[l] + (done - taken) * shares[r].mass[l] / mass);
  }
}

Lanes equilibrate(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& room,
                  EquilibriumCount* count) {
  const std::size_t n = fluids.size();
  OfFluids<Lanes> v(n), v0(n), e0(n), m(n), residual(n), stiffness(n), push(n);
  OfFluids<LanesMask> present(n);
  Lanes pressure, weight, lowest, highest, least, stiffest, space;  // of those that are present
  LanesMask crushed;
  // Fluids next to without volume are left alone; their lanes compute with the numbers of the first fluid there is.
  const auto look = [&] {
    pressure = weight = stiffest = Lanes(0.0), lowest = Lanes(1e300), highest = least = Lanes(-1e300);
    space = room;
    for (std::size_t r = 0; r < n; ++r) {
      present[r] = is_present(shares[r].volume, shares[r].mass, room);
      space -= select(present[r], Lanes(0.0), shares[r].volume);
      m[r] = select(present[r], shares[r].mass, Lanes(0.0));
      v0[r] = v[r] = select(present[r], shares[r].volume / shares[r].mass, Lanes(1.0 / fluids[r].usual_density));
      e0[r] = select(present[r], shares[r].internal / shares[r].mass, Lanes(fluids[r].usual_energy));
      const auto at = slopes_of(fluids[r].equation_of_state, Lanes(1.0 / v[r]), e0[r]);
      const Lanes bulk = max(Lanes(at.per_density / v[r] + at.pressure * at.per_energy * v[r]),
                             Lanes(least_bulk_modulus(fluids[r].equation_of_state, 1.0)) / v[r]);
      shares[r].bulk_modulus = bulk, shares[r].gruneisen = at.per_energy * v[r];
      const Lanes compliance = m[r] * v[r] / bulk;
      pressure += select(present[r], compliance * at.pressure, Lanes(0.0)), weight += compliance;
      residual[r] = at.pressure;
      lowest = select(present[r], min(lowest, at.pressure), lowest);
      highest = select(present[r], max(highest, at.pressure), highest);
      least = select(present[r], max(least, Lanes(fluids[r].least_pressure)), least);
      stiffest = select(present[r], max(stiffest, bulk), stiffest);
    }
    crushed = LanesMask(false);
    for (std::size_t r = 0; r < n; ++r) crushed |= present[r] & (highest - residual[r] > crushing * shares[r].bulk_modulus);
  };
  look();
  if (any(crushed)) {
    for (int l = 0; l < 8; ++l)
      if (crushed[l]) relax(fluids, shares, room, l);
    look();
  }
  pressure /= weight;
  // A liquid that pulls stretches a gas beside it, which cannot, to nothing: the gas would find another pressure below zero, at
  // which it has less than no heat.
  lowest = max(lowest, min(least, highest));
  pressure = max(pressure, lowest);
  const Lanes tolerance = 1e-14 * stiffest;
  LanesMask done = highest - lowest <= tolerance;
  constexpr int most_iterations = 15;
  for (int i = 0; i < most_iterations && !all(done); ++i) {
    // Newton for all volumes and the pressure at once: the matrix is an arrow.
    Lanes sum(0.0), free(0.0), slope(0.0);
    for (std::size_t r = 0; r < n; ++r) {
      const auto at = slopes_of(fluids[r].equation_of_state, Lanes(1.0 / v[r]), Lanes(e0[r] - pressure * (v[r] - v0[r])));
      residual[r] = at.pressure - pressure;
      stiffness[r] = at.per_density / (v[r] * v[r]) + pressure * at.per_energy;  // -dP/dv along the path of work
      stiffness[r] = max(stiffness[r], Lanes(1e-3) * shares[r].bulk_modulus / v[r]);
      push[r] = 1.0 + at.per_energy * (v[r] - v0[r]);
      sum += m[r] * v[r], free += m[r] * residual[r] / stiffness[r], slope += m[r] * push[r] / stiffness[r];
    }
    const Lanes step = (free + sum - space) / slope;
    const Lanes next = min(max(Lanes(pressure + step), lowest), highest);
    Lanes largest(0.0);
    for (std::size_t r = 0; r < n; ++r) {
      const Lanes change = (residual[r] - push[r] * (next - pressure)) / stiffness[r];
      const Lanes limited = min(max(Lanes(v[r] + change), Lanes(0.5 * v[r])), Lanes(2.0 * v[r]));
      largest = max(largest, select(present[r], abs(limited - v[r]) / v[r] * shares[r].bulk_modulus, Lanes(0.0)));
      v[r] = select(done, v[r], limited);
    }
    if (count)
      for (int l = 0; l < 8; ++l) count->iterations += done[l] ? 0.0 : 1.0;
    const Lanes moved = abs(next - pressure);
    pressure = select(done, pressure, next);
    done |= (moved <= tolerance) & (largest <= 1e2 * tolerance);
  }
  // A trace that any pressure suits hides in the mean that the others have not come to theirs.
  Lanes unfilled = space;
  for (std::size_t r = 0; r < n; ++r) unfilled -= m[r] * v[r];
  constexpr double leak = 1e-9;  // of the room
  done &= abs(unfilled) <= leak * room;
  if (count) count->cells += 8.0;
  Lanes largest_volume(0.0), volumes(0.0), energies(0.0), before(0.0);
  for (std::size_t r = 0; r < n; ++r) before += select(present[r], shares[r].internal, Lanes(0.0));
  std::vector<FluidShare> original;
  if (!all(done)) original = shares;
  for (std::size_t r = 0; r < n; ++r) {
    shares[r].internal = select(present[r], shares[r].internal - m[r] * pressure * (v[r] - v0[r]), shares[r].internal);
    shares[r].volume = select(present[r], m[r] * v[r], shares[r].volume);
  }
  for (int l = 0; l < 8 && !all(done); ++l) {
    if (done[l] || !std::isfinite(room[l])) continue;
    for (std::size_t r = 0; r < n; ++r)
      shares[r].internal.set(l, original[r].internal[l]), shares[r].volume.set(l, original[r].volume[l]);
    pressure.set(l, bisect(fluids, shares, present, space[l], l));
    if (count) count->bisected += 1.0;
  }
  // What rounding left over goes to the fluid with most volume.
  for (std::size_t r = 0; r < n; ++r)
    volumes += shares[r].volume, energies += select(present[r], shares[r].internal, Lanes(0.0)),
        largest_volume = max(largest_volume, shares[r].volume);
  LanesMask taken(false);
  for (std::size_t r = 0; r < n; ++r) {
    const LanesMask majority = (shares[r].volume == largest_volume) & !taken;
    taken |= majority;
    shares[r].volume = select(majority, shares[r].volume + (room - volumes), shares[r].volume);
    shares[r].internal = select(majority, shares[r].internal + (before - energies), shares[r].internal);
    const Lanes density = select(present[r], shares[r].mass / shares[r].volume, Lanes(fluids[r].usual_density));
    const Lanes energy = select(present[r], shares[r].internal / shares[r].mass, Lanes(fluids[r].usual_energy));
    const auto at = slopes_of(fluids[r].equation_of_state, density, energy);
    shares[r].bulk_modulus = max(Lanes(density * at.per_density + at.pressure * at.per_energy / density),
                                 Lanes(least_bulk_modulus(fluids[r].equation_of_state, 1.0)) * density);
    shares[r].gruneisen = at.per_energy / density;
  }
  return pressure;
}

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

bool all_cells_hold_heat(Gas& gas, const CellSet& content) {
  const int D = gas.dimensions(), fluids = static_cast<int>(gas.fluids.size());
  std::vector<char> good(gas.cells.mine.size());
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    LanesMask all_good(true);
    for (int k = 0; k < gas.cells.packs(); ++k) {
      const auto at = [&](int quantity) { return content.at(block, quantity)[k]; };
      Lanes mass(0.0), square(0.0), cold(0.0);
      for (int r = 0; r < fluids; ++r) {
        const int first = Content::fluids(D) + r * gas.fluid_quantities();
        const Fluid& fluid = gas.fluids[static_cast<std::size_t>(r)];
        const Lanes own = at(first + Content::mass), volume = at(fluids == 1 ? Content::room : first + Content::volume);
        mass += own;
        cold += own * coldest_energy(fluid, Lanes(select(volume > 0.0, own / volume, Lanes(fluid.usual_density))));
      }
      for (int a = 0; a < D; ++a) square += at(Content::momentum + a) * at(Content::momentum + a);
      const LanesMask holds = (at(Content::energy) - 0.5 * square / mass > cold) | !lanes_of(cells_inside(gas.cells, block, k));
      all_good &= holds;
      if (all(holds)) continue;
      Lanes& mark = gas.marks.at(block, 0)[k];
      mark = select(holds, mark, Lanes(1.0));
    }
    good[i] = all(all_good);
  });
  return std::all_of(good.begin(), good.end(), [](char g) { return g != 0; });
}

void find_equilibrium(Gas& gas, Domain& domain) {
  std::vector<Largest> largest(gas.cells.mine.size());
  for_each_own_block(gas, [&](auto D, std::size_t i, std::size_t block) { largest[i] = equilibrium_of<D()>(gas, block); });
  gas.wave_rate = gas.motion_rate = 0.0;
  for (const Largest& l : largest) {
    gas.wave_rate = l.wave < gas.wave_rate ? gas.wave_rate : l.wave;
    gas.motion_rate = std::max(gas.motion_rate, l.motion);
  }
  gas.wave_rate = domain.maximum(gas.wave_rate), gas.motion_rate = domain.maximum(gas.motion_rate);
}

void write_content(const Gas& gas, CellSet& content, std::size_t block, int cell, std::span<const Portion> portions) {
  const int D = gas.dimensions();
  const auto i = static_cast<std::size_t>(gas.cells.index(block, cell)[0] - gas.cells.metric.first);
  const double whole = gas.cells.metric.volume[i];
  for (int q = 0; q < content.quantities(); ++q) content.cell(block, q, cell) = 0.0;
  content.cell(block, Content::room, cell) = whole;
  for (const auto& [part, filling] : portions) {
    const double room = part * whole, mass = filling.density * room;
    const EquationOfState& law = gas.fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state;
    const bool by_temperature = filling.temperature > 0.0 && eos::caloric(law) == eos::Caloric::barotropic;
    const double internal = mass * (by_temperature ? eos::energy(law, filling.density, filling.temperature)
                                                   : energy_of(law, filling.density, filling.pressure));
    double kinetic = 0.0;
    for (int a = 0; a < D; ++a) {
      const double u = filling.velocity[static_cast<std::size_t>(a)];
      content.cell(block, Content::momentum + a, cell) += mass * u;
      kinetic += 0.5 * mass * u * u;
    }
    content.cell(block, Content::energy, cell) += internal + kinetic;
    const int first = Content::fluids(D) + filling.fluid * gas.fluid_quantities();
    content.cell(block, first + Content::mass, cell) += mass;
    if (gas.fluid_quantities() == 1) continue;
    content.cell(block, first + Content::volume, cell) += room;
    content.cell(block, first + Content::internal, cell) += internal;
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
  set.cell(block, Primitive::softness(gas.dimensions(), fluids), cell) = 1.0;
}

}  // namespace brisance::simulator::gas
