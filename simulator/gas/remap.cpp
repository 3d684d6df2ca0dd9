#include "simulator/gas/remap.hpp"

#include <algorithm>
#include <vector>

#include "simulator/gas/donor.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/limiter.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/gas/passages.hpp"
#include "simulator/gas/pressure_equilibrium.hpp"

namespace brisance::simulator::gas {
namespace {

/// The cells of a pencil after the Lagrangian phase, and what passes its faces along the axis. What leaves a cell depends on
/// its own slopes alone, so both neighbours of a face compute the same.
template <int D>
struct SweptPencil {
  std::size_t block;
  int axis, number;
  Pencil volume, total, momentum[D];      // what the cells hold: m^3, J, kg m/s
  Pencil mass, density, energy;           // kg; kg/m^3; J/m^3, internal
  Pencil velocity[D], velocity_slope[D];  // m/s; the slope from cell to cell
  Pencil first_order;                     // 1 where a cell does without slopes, if any do
  const Lanes* swept;                     // m^3
  FacePencil dE, dp[D];                   // J, N s

  SweptPencil(Gas& gas, std::size_t of_block, int along, int n)
      : block(of_block), axis(along), number(n), swept(gas.swept_faces(of_block, along, n)) {
    if (gas.any_first_order) load<D>(gas.cells, gas.half_step, block, HalfStep::first_order(D), axis, number, first_order);
    load_moved(gas, Content::cell_volume, volume);
    load_moved(gas, Content::energy, total);
    for (int a = 0; a < D; ++a) load_moved(gas, Content::momentum + a, momentum[a]);
  }
  void load_moved(const Gas& gas, int quantity, Pencil& held) const {
    load<D>(gas.cells, gas.moved, block, quantity, axis, number, held);
  }
  void find_slopes() {
    for (int a = 0; a < D; ++a)
      for (std::size_t c = ring - 1; c <= ring + line; ++c) velocity_slope[a][c] = slope(velocity[a], c);
  }
};

/// The flow through one face: which of its two cells gives, and what part of it.
struct Giving {
  std::size_t low, high;  // cells of the pencil
  LanesMask up;           // along the axis: the low cell gives
  Lanes part;
  Lanes order;  // 0: without slopes, 1

  Lanes of(const Pencil& field) const { return select(up, field[low], field[high]); }
  Lanes ahead(const Pencil& field) const { return select(up, field[high], field[low]); }
  LanesMask of(const std::array<LanesMask, reach>& mask) const { return (up & mask[low]) | ((!up) & mask[high]); }
  /// Mean of a field over what leaves.
  Lanes leaving(const Pencil& field) const { return of(field) + (0.5 * order) * (1.0 - part) * difference(field, part); }
  /// The same of a field of one fluid.
  Lanes leaving(const Pencil& field, const Lanes& fourth_order, const Lanes& steepening) const {
    const Lanes across =
        difference_across_donor(up, field[low - 1], field[low], field[high], field[high + 1], part, fourth_order, steepening);
    return of(field) + (0.5 * order) * (1.0 - part) * across;
  }
  /// The same of a fluid's field, where the fluid has slopes: what leaves is a part of its own.
  Lanes leaving(const Pencil& field, const LanesMask& sloped, const Lanes& own_part) const {
    return of(field) + select(sloped, (0.5 * order) * (1.0 - own_part) * difference(field, own_part), Lanes(0.0));
  }
  /// Where the cells about the donor have a fluid, too, and the donor is not at its edge.
  LanesMask sloped(const std::array<LanesMask, reach>& present, const Pencil& filling) const {
    const LanesMask low_side = present[low - 1] & present[low] & present[high];
    const LanesMask high_side = present[low] & present[high] & present[high + 1];
    const Lanes behind = select(up, filling[low - 1], filling[high + 1]);
    return ((up & low_side) | ((!up) & high_side)) & has_slopes(behind, of(filling), ahead(filling));
  }
  Lanes difference(const Pencil& field, const Lanes& what_leaves) const {
    return difference_across_donor(up, field[low - 1], field[low], field[high], field[high + 1], what_leaves);
  }
};

template <int D>
Giving giving_at(const Gas& gas, const SweptPencil<D>& p, std::size_t face) {
  Giving g{ring + face - 1, ring + face, p.swept[face] > 0.0, Lanes(0.0), Lanes(1.0)};
  g.part = abs(p.swept[face]) / g.of(p.volume);
  if (gas.any_first_order) g.order = select(p.first_order[g.low] + p.first_order[g.high] > 0.0, Lanes(0.0), Lanes(1.0));
  return g;
}

/// Asks the memory for a part of what the next pencil reads and writes.
template <int D>
[[gnu::always_inline]] inline void ask_for(const NextPencil<D>& next, const Gas& gas, std::size_t part) {
  if (part >= line) return;
  next.fetch(gas.moved, 0, gas.contents(), part);
  next.fetch_to_write(gas.next, 0, gas.contents(), part);
}

/// Marks the cells number m of a pencil's lines.
template <int D>
void mark(Gas& gas, const SweptPencil<D>& p, std::size_t m, const LanesMask& cells) {
  Pencil marks;
  load_own<D>(gas.marks, p.block, 0, p.axis, p.number, marks);
  marks[ring + m] = select(cells, Lanes(1.0), marks[ring + m]);
  store<D>(gas.marks, p.block, 0, p.axis, p.number, marks);
}

/// How many of the cells beside a face of a pencil that give are in the box: of rows beyond it nothing counts.
template <int D>
std::int64_t count_inside(const Gas& gas, const SweptPencil<D>& p, std::size_t face, const LanesMask& which) {
  const int above = std::min(static_cast<int>(face), line - 1), below = static_cast<int>(face) - 1;
  LanesMask inside = lanes_inside<D>(gas.cells, p.block, p.axis, p.number, above);
  if (below >= 0) inside |= lanes_inside<D>(gas.cells, p.block, p.axis, p.number, below);
  std::int64_t count = 0;
  for (int l = 0; l < 8; ++l) count += which[l] && inside[l] ? 1 : 0;
  return count;
}

/// How a mass goes through a face with its momentum.
struct Carried {
  Lanes kinetic;    // J
  Lanes heat_kept;  // part of the heat
  LanesMask flattened;
  Lanes steepness;  // (m/s)^2, of the velocity from cell to cell
};
/// Momentum that goes with a mass (positive along the axis).
template <int D>
Carried carry_momentum(SweptPencil<D>& p, const Giving& giving, const Lanes& mass, std::size_t face) {
  const Lanes part = abs(mass) / giving.of(p.mass);
  Lanes steepness(0.0), slopes[D];
  for (int a = 0; a < D; ++a) {
    slopes[a] = giving.of(p.velocity_slope[a]);
    steepness += slopes[a] * slopes[a];
  }
  const Leaving leaving =
      leaving_with_momentum(giving.up, part, giving.of(p.density), steepness, giving.of(p.energy), giving.order);
  Carried carried{Lanes(0.0), leaving.heat_kept, leaving.too_steep, steepness};
  for (int a = 0; a < D; ++a) {
    const Lanes u = giving.of(p.velocity[a]) + leaving.offset * slopes[a];
    p.dp[a][face] = mass * u, carried.kinetic += 0.5 * mass * u * u;
  }
  return carried;
}
/// How many of the cells that give through a face have lost slopes that could be noticed.
template <int D>
std::int64_t count_flattened(const Gas& gas, const SweptPencil<D>& p, std::size_t face, const Giving& giving,
                             const Carried& carried) {
  if (none(carried.flattened)) return 0;
  Pencil sound;
  load<D>(gas.cells, gas.primitive, p.block, Primitive::sound_speed, p.axis, p.number, sound);
  return count_inside(gas, p, face, carried.flattened & noticeable(carried.steepness, giving.of(sound)));
}

/// A fluid that fills a cell, with its mass (kg); -1: none does.
struct Filled {
  int fluid = -1;
  double mass = 0.0;
};
/// Calls let_out(face, lane, donor, fluid, flow, internal) for the fans of a pencil: donor among its cells, internal energy (J)
/// of what leaves. `filled(donor, lane)`: only cells of one fluid have fans.
template <int D, class WhatFills, class LetOut>
void for_each_fan(const Gas& gas, const SweptPencil<D>& p, const WhatFills& filled, const LetOut& let_out) {
  for (const Fan& fan : gas.fans[p.block]) {
    if (fan.axis != p.axis || fan.pencil != p.number) continue;
    const auto f = static_cast<std::size_t>(fan.face);
    for (int l = 0; l < 8; ++l) {
      if (!fan.opens[l]) continue;
      const double swept = p.swept[f][l];
      const std::size_t donor = swept > 0.0 ? ring + f - 1 : ring + f;
      const auto [r, held] = filled(donor, l);
      if (r < 0) continue;
      const Fluid& fluid = gas.fluids[static_cast<std::size_t>(r)];
      const std::optional<FanFlow> flow = flow_of(fan, l, swept, [&](double density, double pressure) {
        return energy_of(fluid.equation_of_state, density, pressure);
      });
      constexpr double most = 0.8;  // of what the donor has
      if (!flow || !(flow->mass < most * held)) continue;
      const double internal = flow->energy - 0.5 * flow->momentum * flow->momentum / flow->mass;
      const double cold = flow->mass * coldest_energy(fluid, Lanes(flow->mass / std::abs(swept)))[0];
      if (internal > cold) let_out(f, l, donor, r, *flow, internal);
    }
  }
}

/// Keeps what the cells of a pencil hold of a quantity when that has passed its faces.
template <int D, class Flow>
void exchange(Gas& gas, const SweptPencil<D>& p, int quantity, Pencil& held, const Flow& flow) {
  for (std::size_t f = 0; f < line; ++f) held[ring + f] -= flow[f + 1] - flow[f];
  store<D>(gas.next, p.block, quantity, p.axis, p.number, held);
}
/// The same of what all fluids have in common.
template <int D>
void exchange_common(Gas& gas, SweptPencil<D>& p) {
  exchange(gas, p, Content::cell_volume, p.volume, p.swept);
  exchange(gas, p, Content::energy, p.total, p.dE);
  for (int a = 0; a < D; ++a) exchange(gas, p, Content::momentum + a, p.momentum[a], p.dp[a]);
}

/// Books what passes the sides of the box; dm(fluid): kg through the faces.
template <int D, class MassFlow>
void book(Gas& gas, const SweptPencil<D>& p, const MassFlow& dm) {
  for_each_passage(gas, p.block, p.axis, p.number, [&](Passage& passage, double sign, std::uint8_t lanes) {
    const auto f = static_cast<std::size_t>(passage.face);
    for (int l = 0; l < 8; ++l) {
      if (!(lanes >> l & 1)) continue;
      for (std::size_t r = 0; r < gas.fluids.size(); ++r) passage.step.mass[r] += sign * dm(r)[f][l];
      passage.step.energy += sign * p.dE[f][l];
      for (std::size_t a = 0; a < D; ++a) passage.step.momentum[a] += sign * p.dp[a][f][l];
    }
  });
}

struct SweepResult {
  std::int64_t flattened = 0;  // faces
  bool good = true;            // no fluid is left with less than nothing
};

// One fluid

template <int D>
void find_state(SweptPencil<D>& p) {
  for (std::size_t c = 0; c < reach; ++c) {
    p.density[c] = p.mass[c] / p.volume[c];
    Lanes kinetic(0.0);
    const Lanes inverse_mass = 1.0 / p.mass[c];
    for (int a = 0; a < D; ++a)
      p.velocity[a][c] = p.momentum[a][c] * inverse_mass, kinetic += p.momentum[a][c] * p.velocity[a][c];
    p.energy[c] = (p.total[c] - 0.5 * kinetic) / p.volume[c];
  }
  p.find_slopes();
}

/// What passes a face; returns how many slopes have been flattened.
template <int D>
std::int64_t pass(const Gas& gas, SweptPencil<D>& p, FacePencil& dm, std::size_t f) {
  const Giving giving = giving_at(gas, p, f);
  // A shock steepens itself. Held together like a contact, and with fourth order, it rings.
  const std::size_t l = giving.low, h = giving.high;
  const Pencil& e = p.energy;
  const Lanes closing = max(Lanes(p.velocity[p.axis][l] - p.velocity[p.axis][h]), Lanes(0.0));
  const Lanes calm =
      away_from_shocks(giving.up, e[l - 1], e[l], e[h], e[h + 1], min(p.density[l], p.density[h]) * closing * closing);
  dm[f] = p.swept[f] * giving.leaving(p.density, calm, Lanes(1.0));
  const Carried carried = carry_momentum(p, giving, dm[f], f);
  p.dE[f] = p.swept[f] * giving.leaving(e, calm, calm) * carried.heat_kept + carried.kinetic;
  return count_flattened(gas, p, f, giving, carried);
}

template <int D>
void let_fans_out(const Gas& gas, SweptPencil<D>& p, FacePencil& dm) {
  const auto filled = [&](std::size_t c, int l) { return Filled{0, p.mass[c][l]}; };
  for_each_fan(gas, p, filled, [&](std::size_t f, int l, std::size_t donor, int, const FanFlow& flow, double) {
    const double sign = p.swept[f][l] > 0.0 ? 1.0 : -1.0, along = sign * flow.mass;
    double motion = 0.0;
    for (int a = 0; a < D; ++a) {
      const double u = p.velocity[a][donor][l];
      p.dp[a][f].set(l, a == p.axis ? flow.momentum : along * u);
      if (a != p.axis) motion += 0.5 * along * u * u;
    }
    dm[f].set(l, along), p.dE[f].set(l, sign * flow.energy + motion);
  });
}

template <int D>
[[gnu::flatten]] SweepResult sweep_single(Gas& gas, std::size_t block, int axis) {
  constexpr int mass_at = Content::of(D, 0, Content::mass);
  SweepResult result;
  for (int n = 0; n < BlockShape<D>::pencils; ++n) {
    SweptPencil<D> p(gas, block, axis, n);
    FacePencil dm;  // kg
    p.load_moved(gas, mass_at, p.mass);
    find_state(p);
    const NextPencil<D> next(gas.cells, block, axis, n);
    for (std::size_t f = 0; f < line_faces; ++f) {
      ask_for(next, gas, f);
      result.flattened += pass(gas, p, dm, f);
    }
    let_fans_out(gas, p, dm);
    exchange_common(gas, p);
    exchange(gas, p, mass_at, p.mass, dm);
    book(gas, p, [&](std::size_t) -> const FacePencil& { return dm; });
  }
  return result;
}

// Several fluids

struct FluidPencils {
  Pencil mass, volume, internal;  // what the cells hold of the fluid: kg, m^3, J
  Pencil part, density, energy;   // of their volumes; kg/m^3, J/m^3, by its own volume
  std::array<LanesMask, reach> present;
  FacePencil dm, dV, dI;  // kg, m^3, J
};
using Mixture = std::vector<FluidPencils>;

template <int D>
void load_fluid(const Gas& gas, const SweptPencil<D>& p, std::size_t r, FluidPencils& at) {
  p.load_moved(gas, Content::of(D, r, Content::mass), at.mass);
  p.load_moved(gas, Content::of(D, r, Content::volume), at.volume);
  p.load_moved(gas, Content::of(D, r, Content::internal), at.internal);
  for (std::size_t c = 0; c < reach; ++c) {
    at.present[c] = is_present(at.volume[c], at.mass[c], p.volume[c]);
    at.part[c] = at.volume[c] / p.volume[c];
    const Lanes volume = select(at.present[c], at.volume[c], Lanes(1.0));
    at.density[c] = at.mass[c] / volume, at.energy[c] = at.internal[c] / volume;
  }
}

template <int D>
void find_state(const Gas& gas, SweptPencil<D>& p, Mixture& fluids) {
  p.mass.fill(Lanes(0.0)), p.energy.fill(Lanes(0.0));
  for (std::size_t r = 0; r < fluids.size(); ++r) {
    load_fluid(gas, p, r, fluids[r]);
    for (std::size_t c = 0; c < reach; ++c) p.mass[c] += fluids[r].mass[c], p.energy[c] += fluids[r].internal[c];
  }
  for (std::size_t c = 0; c < reach; ++c) {
    p.density[c] = p.mass[c] / p.volume[c], p.energy[c] /= p.volume[c];
    for (int a = 0; a < D; ++a) p.velocity[a][c] = p.momentum[a][c] / p.mass[c];
  }
  p.find_slopes();
}

/// The volumes of the fluids that pass a face are together what it has swept. What the limits leave over goes to the largest.
/// Of a fluid of which there is next to nothing as much leaves as of the cell.
void share_swept_volume(const Giving& giving, const Lanes& swept, Mixture& fluids, std::size_t f) {
  constexpr double most = 0.999;  // of what the donor has
  const Lanes all = abs(swept), sign = select(giving.up, Lanes(1.0), Lanes(-1.0));
  Lanes left = all, largest(0.0);
  for (FluidPencils& at : fluids) {
    const LanesMask here = giving.of(at.present), whole = giving.of(at.part) > 1.0 - least_fraction;
    const Lanes volume = giving.of(at.volume), wanted = max(Lanes(all * giving.leaving(at.part)), Lanes(0.0));
    at.dV[f] = select(whole, all, select(here, min(wanted, Lanes(most * volume)), giving.part * volume));
    left -= at.dV[f], largest = max(largest, volume);
  }
  LanesMask given(false);
  for (FluidPencils& at : fluids) {
    const LanesMask most_of_it = (giving.of(at.volume) == largest) & !given;
    given |= most_of_it;
    at.dV[f] = sign * (at.dV[f] + select(most_of_it, left, Lanes(0.0)));
  }
}

/// Mass and internal energy that go with a fluid's volume.
void carry_fluid(const Giving& giving, FluidPencils& at, std::size_t f) {
  const LanesMask here = giving.of(at.present), sloped = giving.sloped(at.present, at.part);
  const Lanes sign = select(giving.up, Lanes(1.0), Lanes(-1.0)), residue = sign * giving.part;
  const Lanes own_part = min(Lanes(sign * at.dV[f] / max(giving.of(at.volume), Lanes(1e-300))), Lanes(0.9999));
  const auto leaving = [&](const Pencil& per_volume, const Pencil& held) {
    return select(here, at.dV[f] * giving.leaving(per_volume, sloped, own_part), residue * giving.of(held));
  };
  at.dm[f] = leaving(at.density, at.mass), at.dI[f] = leaving(at.energy, at.internal);
}

/// What passes a face; returns how many slopes have been flattened.
template <int D>
std::int64_t pass(const Gas& gas, SweptPencil<D>& p, Mixture& fluids, std::size_t f) {
  const Giving giving = giving_at(gas, p, f);
  share_swept_volume(giving, p.swept[f], fluids, f);
  Lanes dm(0.0), dI(0.0);
  for (FluidPencils& at : fluids) {
    carry_fluid(giving, at, f);
    dm += at.dm[f], dI += at.dI[f];
  }
  const Carried carried = carry_momentum(p, giving, dm, f);
  p.dE[f] = dI * carried.heat_kept + carried.kinetic;
  return count_flattened(gas, p, f, giving, carried);
}

template <int D>
void let_fans_out(const Gas& gas, SweptPencil<D>& p, Mixture& fluids) {
  const auto filled = [&](std::size_t c, int l) {
    for (std::size_t r = 0; r < fluids.size(); ++r)
      if (fluids[r].part[c][l] > nearly_all) return Filled{static_cast<int>(r), fluids[r].mass[c][l]};
    return Filled{};
  };
  for_each_fan(gas, p, filled, [&](std::size_t f, int l, std::size_t donor, int filling, const FanFlow& flow, double internal) {
    const double sign = p.swept[f][l] > 0.0 ? 1.0 : -1.0, along = sign * flow.mass;
    FluidPencils& at = fluids[static_cast<std::size_t>(filling)];
    at.dm[f].set(l, along), at.dI[f].set(l, sign * internal);
    double traces = 0.0, carried = sign * flow.energy;  // traces of others leave as they would
    for (const FluidPencils& other : fluids)
      if (&other != &at) traces += other.dm[f][l], carried += other.dI[f][l];
    for (int a = 0; a < D; ++a) {
      const double u = p.velocity[a][donor][l], beside = a == p.axis ? traces : traces + along;
      p.dp[a][f].set(l, beside * u + (a == p.axis ? flow.momentum : 0.0));
      carried += 0.5 * beside * u * u;
    }
    p.dE[f].set(l, carried);
  });
}

/// Whether no own cell is left with less than nothing of a fluid. Marks those that are.
template <int D>
bool nothing_is_overdrawn(Gas& gas, const SweptPencil<D>& p, const FluidPencils& at) {
  bool good = true;
  for (std::size_t f = 0; f < line; ++f) {
    const std::size_t c = ring + f;
    const LanesMask overdrawn = ((at.mass[c] < 0.0) | (at.volume[c] < -1e-14 * p.volume[c])) &
                                lanes_inside<D>(gas.cells, p.block, p.axis, p.number, static_cast<int>(f));
    if (none(overdrawn)) continue;
    mark(gas, p, f, overdrawn);
    good = false;
  }
  return good;
}

template <int D>
[[gnu::flatten]] SweepResult sweep_mixture(Gas& gas, std::size_t block, int axis) {
  SweepResult result;
  Mixture fluids(gas.fluids.size());
  for (int n = 0; n < BlockShape<D>::pencils; ++n) {
    SweptPencil<D> p(gas, block, axis, n);
    find_state(gas, p, fluids);
    const NextPencil<D> next(gas.cells, block, axis, n);
    for (std::size_t f = 0; f < line_faces; ++f) {
      ask_for(next, gas, f);
      result.flattened += pass(gas, p, fluids, f);
    }
    let_fans_out(gas, p, fluids);
    exchange_common(gas, p);
    for (std::size_t r = 0; r < fluids.size(); ++r) {
      FluidPencils& at = fluids[r];
      exchange(gas, p, Content::of(D, r, Content::mass), at.mass, at.dm);
      exchange(gas, p, Content::of(D, r, Content::volume), at.volume, at.dV);
      exchange(gas, p, Content::of(D, r, Content::internal), at.internal, at.dI);
      result.good = nothing_is_overdrawn(gas, p, at) && result.good;
    }
    book(gas, p, [&](std::size_t r) -> const FacePencil& { return fluids[r].dm; });
  }
  return result;
}

template <int D>
SweepResult sweep_block(Gas& gas, std::size_t block, int axis) {
  return gas.fluids.size() == 1 ? sweep_single<D>(gas, block, axis) : sweep_mixture<D>(gas, block, axis);
}

}  // namespace

bool sweep(Gas& gas, int axis) {
  std::vector<SweepResult> results(gas.cells.mine.size());
  for_each_own_block(gas, [&](auto D, std::size_t i, std::size_t block) { results[i] = sweep_block<D()>(gas, block, axis); });
  bool good = true;
  for (const SweepResult& r : results) gas.flattened += r.flattened, good = good && r.good;
  return good;
}

}  // namespace brisance::simulator::gas
