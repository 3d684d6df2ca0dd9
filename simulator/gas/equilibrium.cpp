#include "simulator/gas/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/gas/pressure_equilibrium.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {
namespace {

namespace eos = equation_of_state;

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

/// What eight cells side by side hold, as wholes.
template <int D>
struct Pack {
  std::size_t block;
  int number;  // in the block
  std::uint8_t inside;
  LanesMask active = lanes_of(inside);
  Lanes cell_volume, mass, density;  // m^3, kg, kg/m^3
  Unset<Lanes, D> velocity;          // m/s
  Lanes internal;                    // J

  Pack(const Gas& gas, std::size_t of_block, int k, std::uint8_t of_box)
      : block(of_block),
        number(k),
        inside(of_box),
        cell_volume(at(gas.content, Content::cell_volume)),
        mass(at(gas.content, Content::of(D, 0, Content::mass))),
        internal(at(gas.content, Content::energy)) {
    for (std::size_t r = 1; r < gas.fluids.size(); ++r) mass += at(gas.content, Content::of(D, r, Content::mass));
    density = mass / cell_volume;
    Lanes kinetic(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const Lanes momentum = at(gas.content, Content::momentum + static_cast<int>(a));
      velocity[a] = momentum / mass, kinetic += 0.5 * momentum * velocity[a];
    }
    internal -= kinetic;
  }
  template <class AnyCellSet>
  auto& at(AnyCellSet& set, int quantity) const {
    return set.at(block, quantity)[number];
  }
  void put(CellSet& set, int quantity, const Lanes& value) const {
    Lanes& old = at(set, quantity);
    old = select(active, value, old);
  }
};

/// Its answer to compression.
struct Response {
  Lanes pressure, bulk_modulus, gruneisen;  // Pa, Pa, 1
};

template <int D>
Response response_of(const Fluid& fluid, const Pack<D>& p) {
  const Lanes density = p.density, energy = p.internal / p.mass;
  const auto at = slopes_of(fluid.equation_of_state, density, energy);
  const Lanes gruneisen = at.per_energy / density, least = Lanes(least_bulk_modulus(fluid.equation_of_state, 1.0)) * density;
  return {at.pressure, max(Lanes(density * at.per_density + at.pressure * gruneisen), least), gruneisen};
}

/// The fluids of the cells. Cells that are not of the box hold anything: to look for its pressure can take very long, so the
/// first fluid fills them, as it usually is.
template <int D>
void load_shares(const Gas& gas, const Pack<D>& p, std::vector<FluidShare>& shares) {
  for (std::size_t r = 0; r < shares.size(); ++r) {
    const Fluid& fluid = gas.fluids[r];
    const double usual = r == 0 ? fluid.usual_density : 0.0;
    const auto load = [&](int quantity, double beyond) {
      return select(p.active, p.at(gas.content, Content::of(D, r, quantity)), Lanes(beyond));
    };
    shares[r].mass = load(Content::mass, usual), shares[r].volume = load(Content::volume, r == 0 ? 1.0 : 0.0);
    shares[r].internal = load(Content::internal, usual * fluid.usual_energy);
  }
}

/// Keeps what part of the compressibility of the cells each fluid has; returns their response.
template <int D>
Response response_of(Gas& gas, const Pack<D>& p, const std::vector<FluidShare>& shares, const Lanes& pressure) {
  Lanes compliance(0.0), gruneisen(0.0), impedance_ratio(0.0);
  for (const FluidShare& s : shares) {
    compliance += select(is_present(s.volume, s.mass, p.cell_volume), s.volume / s.bulk_modulus, Lanes(0.0));
    gruneisen += s.volume / p.cell_volume * s.gruneisen;
  }
  // The square of a fluid's impedance over the cell's is its part of the mass over that of the compressibility.
  for (std::size_t r = 0; r < shares.size(); ++r) {
    const FluidShare& s = shares[r];
    const LanesMask present = is_present(s.volume, s.mass, p.cell_volume);
    Lanes& share = p.at(gas.primitive, Primitive::share(D, static_cast<int>(r)));
    share = select(present, s.volume / (s.bulk_modulus * compliance), Lanes(0.0));
    impedance_ratio += sqrt(share * s.mass / p.mass);
  }
  p.at(gas.primitive, Primitive::impedance_ratio(D, static_cast<int>(shares.size()))) = min(impedance_ratio, Lanes(1.0));
  return {pressure, p.cell_volume / compliance, gruneisen};
}

/// Brings the fluids of the cells to one pressure; `fastest`: m/s, of the waves of the step before.
template <int D>
Response come_to_equilibrium(Gas& gas, const Pack<D>& p, std::vector<FluidShare>& shares, double fastest) {
  load_shares(gas, p, shares);
  // Where velocities have mixed, kinetic energy has become heat.
  Lanes heat = select(p.active, p.internal, shares[0].internal);
  for (const FluidShare& s : shares) heat -= s.internal;
  share_heat(gas.fluids, shares, heat);
  warm_cold_fluids(gas.fluids, shares);
  cool_traces(gas.fluids, shares, fastest);
  const Lanes pressure = equilibrate(gas.fluids, shares, select(p.active, p.cell_volume, Lanes(1.0)));
  for (std::size_t r = 0; r < shares.size(); ++r) {
    p.put(gas.content, Content::of(D, r, Content::volume), shares[r].volume);
    p.put(gas.content, Content::of(D, r, Content::internal), shares[r].internal);
  }
  return response_of(gas, p, shares, pressure);
}

/// 1/s; see Gas.
struct Rates {
  double wave = 0.0, motion = 0.0;
  void note(double other_wave, double other_motion) {
    wave = largest_rate(wave, other_wave), motion = largest_rate(motion, other_motion);
  }
};

/// Returns the largest rates of the cells.
template <int D>
Rates put_primitives(Gas& gas, const Pack<D>& p, const Response& response) {
  const Lanes sound = sqrt(response.bulk_modulus / p.density);
  p.put(gas.primitive, Primitive::density, p.density), p.put(gas.primitive, Primitive::pressure, response.pressure);
  p.put(gas.primitive, Primitive::sound_speed, sound), p.put(gas.primitive, Primitive::gruneisen, response.gruneisen);
  Lanes speed(0.0), motion(0.0);
  for (std::size_t a = 0; a < D; ++a) {
    const Lanes u = p.velocity[a];
    p.put(gas.primitive, Primitive::velocity + static_cast<int>(a), u);
    speed += abs(u), motion = max(motion, abs(u));
  }
  const double inverse_cell_size = 1.0 / gas.cells.cell_size;
  const Lanes wave = (speed + static_cast<double>(D) * sound) * inverse_cell_size;
  Rates largest;
  for (int l = 0; l < 8; ++l)
    if (p.inside >> l & 1) largest.note(wave[l], motion[l] * inverse_cell_size);
  return largest;
}

template <int D>
Rates find_equilibrium_of(Gas& gas, std::size_t block) {
  Rates largest;
  std::vector<FluidShare> shares(gas.fluids.size());
  const double fastest =
      gas.wave_rate > 0.0 ? gas.wave_rate * gas.cells.cell_size : 1e150;  // nobody knows before the first step
  for (int k = 0; k < gas.cells.packs(); ++k) {
    const std::uint8_t inside = cells_inside(gas.cells, block, k);
    if (inside == 0) continue;
    const Pack<D> p(gas, block, k, inside);
    const Response response = shares.size() == 1 ? response_of(gas.fluids[0], p) : come_to_equilibrium(gas, p, shares, fastest);
    const Rates rates = put_primitives(gas, p, response);
    largest.note(rates.wave, rates.motion);
  }
  return largest;
}

}  // namespace

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
        const Fluid& fluid = gas.fluids[static_cast<std::size_t>(r)];
        const Lanes own = at(Content::of(D, r, Content::mass)),
                    volume = at(fluids == 1 ? Content::cell_volume : Content::of(D, r, Content::volume));
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
  std::vector<Rates> rates(gas.cells.mine.size());
  for_each_own_block(gas, [&](auto D, std::size_t i, std::size_t block) { rates[i] = find_equilibrium_of<D()>(gas, block); });
  Rates largest;
  for (const Rates& r : rates) largest.note(r.wave, r.motion);
  gas.wave_rate = domain.maximum(largest.wave), gas.motion_rate = domain.maximum(largest.motion);
}

}  // namespace brisance::simulator::gas
