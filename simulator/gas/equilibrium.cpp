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

}  // namespace brisance::simulator::gas
