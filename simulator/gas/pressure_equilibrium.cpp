#include "simulator/gas/pressure_equilibrium.hpp"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "simulator/gas/fluid_state.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;

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

}  // namespace brisance::simulator::gas
