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

/// A fluid of eight cells in the search for their pressure p. It works against that: its energy is e0 - p (v - v0). Where it is
/// next to without volume it is left alone, and its lanes compute with its usual state.
struct FluidOnTheWay {
  LanesMask present;
  Lanes mass;                // kg; 0 where it is not present
  Lanes v, v0, e0;           // m^3/kg, now and at the start; J/kg
  Lanes pressure;            // Pa
  Lanes stiffness, pushing;  // -dP/dv (Pa kg/m^3) and 1 - dP/dp along the way
};
struct Search {
  OfFluids<FluidOnTheWay> fluids;
  Lanes space;                      // m^3, for the fluids that are present
  Lanes pressure, lowest, highest;  // Pa, of these
  Lanes tolerance;                  // Pa
  LanesMask done;
  LanesMask crushed{false};  // one stands beside a pressure that crushes it
};

/// One lane, with certainty: the volume that the fluids take at a pressure falls with it, and the pressures they have now
/// bracket the one sought.
double bisect(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Search& s, int l) {
  double low = std::numeric_limits<double>::infinity(), high = -low, least = -low;
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    const double m = shares[r].mass[l], v = shares[r].volume[l];
    if (!s.fluids[r].present[l]) continue;
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
      if (s.fluids[r].present[l]) sum += volume_at(r, p);
    (sum > s.space[l] ? low : high) = p;
  }
  const double p = 0.5 * (low + high);
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    const double before = shares[r].volume[l];
    if (!s.fluids[r].present[l]) continue;
    const double now = volume_at(r, p);
    shares[r].internal.set(l, shares[r].internal[l] - p * (now - before));
    shares[r].volume.set(l, now);
  }
  return p;
}

/// From the states that the fluids have now. Sets their bulk moduli.
Search begin_search(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& cell_volume) {
  Search s;
  s.fluids.resize(fluids.size());
  s.space = cell_volume, s.lowest = Lanes(1e300), s.highest = Lanes(-1e300);
  Lanes sum(0.0), weight(0.0), least(-1e300), stiffest(0.0);
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    FluidOnTheWay& f = s.fluids[r];
    const EquationOfState& law = fluids[r].equation_of_state;
    f.present = is_present(shares[r].volume, shares[r].mass, cell_volume);
    s.space -= select(f.present, Lanes(0.0), shares[r].volume);
    f.mass = select(f.present, shares[r].mass, Lanes(0.0));
    f.v0 = f.v = select(f.present, shares[r].volume / shares[r].mass, Lanes(1.0 / fluids[r].usual_density));
    f.e0 = select(f.present, shares[r].internal / shares[r].mass, Lanes(fluids[r].usual_energy));
    const auto at = slopes_of(law, Lanes(1.0 / f.v), f.e0);
    const Lanes bulk =
        max(Lanes(at.per_density / f.v + at.pressure * at.per_energy * f.v), Lanes(least_bulk_modulus(law, 1.0)) / f.v);
    shares[r].bulk_modulus = bulk, f.pressure = at.pressure;
    const Lanes compliance = f.mass * f.v / bulk;
    sum += select(f.present, compliance * at.pressure, Lanes(0.0)), weight += compliance;
    s.lowest = select(f.present, min(s.lowest, at.pressure), s.lowest);
    s.highest = select(f.present, max(s.highest, at.pressure), s.highest);
    least = select(f.present, max(least, Lanes(fluids[r].least_pressure)), least);
    stiffest = select(f.present, max(stiffest, bulk), stiffest);
  }
  for (std::size_t r = 0; r < fluids.size(); ++r)
    s.crushed |= s.fluids[r].present & (s.highest - s.fluids[r].pressure > crushing * shares[r].bulk_modulus);
  // A liquid that pulls stretches a gas beside it, which cannot, to nothing: the gas would find another pressure below zero, at
  // which it has less than no heat.
  s.lowest = max(s.lowest, min(least, s.highest));
  s.pressure = max(Lanes(sum / weight), s.lowest);
  s.tolerance = 1e-14 * stiffest;
  s.done = s.highest - s.lowest <= s.tolerance;
  return s;
}

/// A step of Newton's method for all volumes and the pressure at once: the matrix is an arrow.
void newton_step(const std::vector<Fluid>& fluids, const std::vector<FluidShare>& shares, Search& s) {
  Lanes sum(0.0), free(0.0), slope(0.0);
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    FluidOnTheWay& f = s.fluids[r];
    const auto at = slopes_of(fluids[r].equation_of_state, Lanes(1.0 / f.v), Lanes(f.e0 - s.pressure * (f.v - f.v0)));
    f.pressure = at.pressure;
    f.stiffness = at.per_density / (f.v * f.v) + s.pressure * at.per_energy;
    f.stiffness = max(f.stiffness, Lanes(1e-3) * shares[r].bulk_modulus / f.v);
    f.pushing = 1.0 + at.per_energy * (f.v - f.v0);
    sum += f.mass * f.v, free += f.mass * (f.pressure - s.pressure) / f.stiffness, slope += f.mass * f.pushing / f.stiffness;
  }
  const Lanes step = (free + sum - s.space) / slope;
  const Lanes next = min(max(Lanes(s.pressure + step), s.lowest), s.highest);
  Lanes largest(0.0);
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    FluidOnTheWay& f = s.fluids[r];
    const Lanes change = (f.pressure - s.pressure - f.pushing * (next - s.pressure)) / f.stiffness;
    const Lanes limited = min(max(Lanes(f.v + change), Lanes(0.5 * f.v)), Lanes(2.0 * f.v));
    largest = max(largest, select(f.present, abs(limited - f.v) / f.v * shares[r].bulk_modulus, Lanes(0.0)));
    f.v = select(s.done, f.v, limited);
  }
  const Lanes moved = abs(next - s.pressure);
  s.pressure = select(s.done, s.pressure, next);
  s.done |= (moved <= s.tolerance) & (largest <= 1e2 * s.tolerance);
}

/// Whether the fluids fill their space. A trace that any pressure suits hides in the mean that the others have not come to
/// theirs.
LanesMask is_filled(const Search& s, const Lanes& cell_volume) {
  constexpr double leak = 1e-9;  // of the cell
  Lanes unfilled = s.space;
  for (const FluidOnTheWay& f : s.fluids) unfilled -= f.mass * f.v;
  return abs(unfilled) <= leak * cell_volume;
}

/// The work of the fluids that are present on their way, where they have come to its end.
void work_against_pressure(const Search& s, std::vector<FluidShare>& shares) {
  for (std::size_t r = 0; r < shares.size(); ++r) {
    const FluidOnTheWay& f = s.fluids[r];
    const LanesMask moves = f.present & s.done;
    shares[r].internal = select(moves, shares[r].internal - f.mass * s.pressure * (f.v - f.v0), shares[r].internal);
    shares[r].volume = select(moves, f.mass * f.v, shares[r].volume);
  }
}

/// J, of the fluids that are present.
Lanes energy_of_present(const Search& s, const std::vector<FluidShare>& shares) {
  Lanes sum(0.0);
  for (std::size_t r = 0; r < shares.size(); ++r) sum += select(s.fluids[r].present, shares[r].internal, Lanes(0.0));
  return sum;
}

/// What rounding has left over of the volume and of the energy goes to the fluid with most volume.
void give_rest_to_largest(const Search& s, std::vector<FluidShare>& shares, const Lanes& cell_volume, const Lanes& energy) {
  Lanes largest(0.0), volumes(0.0);
  for (const FluidShare& share : shares) volumes += share.volume, largest = max(largest, share.volume);
  const Lanes rest = energy - energy_of_present(s, shares);
  LanesMask given(false);
  for (FluidShare& share : shares) {
    const LanesMask most_of_it = (share.volume == largest) & !given;
    given |= most_of_it;
    share.volume = select(most_of_it, share.volume + (cell_volume - volumes), share.volume);
    share.internal = select(most_of_it, share.internal + rest, share.internal);
  }
}

void set_moduli(const std::vector<Fluid>& fluids, const Search& s, std::vector<FluidShare>& shares) {
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    FluidShare& share = shares[r];
    const EquationOfState& law = fluids[r].equation_of_state;
    const Lanes density = select(s.fluids[r].present, share.mass / share.volume, Lanes(fluids[r].usual_density));
    const Lanes energy = select(s.fluids[r].present, share.internal / share.mass, Lanes(fluids[r].usual_energy));
    const auto at = slopes_of(law, density, energy);
    share.bulk_modulus = max(Lanes(density * at.per_density + at.pressure * at.per_energy / density),
                             Lanes(least_bulk_modulus(law, 1.0)) * density);
    share.gruneisen = at.per_energy / density;
  }
}

}  // namespace

void relax(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& cell_volume, int l) {
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
      state[r].here = is_present(s.volume[l], s.mass[l], cell_volume[l]);
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

Lanes equilibrate(const std::vector<Fluid>& fluids, std::vector<FluidShare>& shares, const Lanes& cell_volume,
                  EquilibriumCount* count) {
  Search s = begin_search(fluids, shares, cell_volume);
  if (any(s.crushed)) {
    for (int l = 0; l < 8; ++l)
      if (s.crushed[l]) relax(fluids, shares, cell_volume, l);
    s = begin_search(fluids, shares, cell_volume);
  }
  const Lanes energy = energy_of_present(s, shares);
  constexpr int most_iterations = 15;
  for (int i = 0; i < most_iterations && !all(s.done); ++i) {
    if (count)
      for (int l = 0; l < 8; ++l) count->iterations += s.done[l] ? 0.0 : 1.0;
    newton_step(fluids, shares, s);
  }
  s.done &= is_filled(s, cell_volume);
  if (count) count->cells += 8.0;
  work_against_pressure(s, shares);
  for (int l = 0; l < 8 && !all(s.done); ++l) {
    if (s.done[l] || !std::isfinite(cell_volume[l])) continue;
    s.pressure.set(l, bisect(fluids, shares, s, l));
    if (count) count->bisected += 1.0;
  }
  give_rest_to_largest(s, shares, cell_volume, energy);
  set_moduli(fluids, s, shares);
  return s.pressure;
}

}  // namespace brisance::simulator::gas
