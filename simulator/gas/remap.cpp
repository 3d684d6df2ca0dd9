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

/// What leaves a cell through a face depends on its own slopes alone, so both neighbours of the face compute the same.
template <int D>
struct Donors {
  Pencil mass, density, energy;  // kg; kg/m^3; J/m^3, internal
  Pencil velocity[D], velocity_slope[D];

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

/// `plain` is there in careful steps.
Giving giving_at(const Lanes& swept, const Pencil& room, const Pencil* plain, std::size_t face) {
  Giving g{ring + face - 1, ring + face, swept > 0.0, Lanes(0.0), Lanes(1.0)};
  g.part = abs(swept) / g.of(room);
  if (plain) g.order = select((*plain)[g.low] + (*plain)[g.high] > 0.0, Lanes(0.0), Lanes(1.0));
  return g;
}

/// Marks the cells number m of a pencil's lines.
template <int D>
void mark(Gas& gas, std::size_t block, int axis, int n, std::size_t m, const LanesMask& cells) {
  Pencil marks;
  load_own<D>(gas.marks, block, 0, axis, n, marks);
  marks[ring + m] = select(cells, Lanes(1.0), marks[ring + m]);
  store<D>(gas.marks, block, 0, axis, n, marks);
}

/// How many of the cells beside a face of a pencil that give are in the box: of rows beyond it nothing counts.
template <int D>
std::int64_t count_inside(const Gas& gas, std::size_t block, int axis, int n, std::size_t face, const LanesMask& which) {
  const int above = std::min(static_cast<int>(face), line - 1), below = static_cast<int>(face) - 1;
  LanesMask inside = lanes_inside<D>(gas.cells, block, axis, n, above);
  if (below >= 0) inside |= lanes_inside<D>(gas.cells, block, axis, n, below);
  std::int64_t count = 0;
  for (int l = 0; l < 8; ++l) count += which[l] && inside[l] ? 1 : 0;
  return count;
}

struct Carried {
  Lanes kinetic;    // J
  Lanes heat_kept;  // part of the heat
  LanesMask flattened;
  Lanes steepness;  // (m/s)^2, of the velocity from cell to cell
};
/// Momentum that goes with a mass (positive along the axis) into dp.
template <int D>
Carried carry_momentum(const Giving& giving, const Donors<D>& donors, const Lanes& mass, std::size_t face,
                       FacePencil (&dp)[D]) {
  const Lanes part = abs(mass) / giving.of(donors.mass);
  Lanes steepness(0.0), slopes[D];
  for (int a = 0; a < D; ++a) {
    slopes[a] = giving.of(donors.velocity_slope[a]);
    steepness += slopes[a] * slopes[a];
  }
  const Leaving leaving =
      leaving_with_momentum(giving.up, part, giving.of(donors.density), steepness, giving.of(donors.energy), giving.order);
  Carried carried{Lanes(0.0), leaving.heat_kept, leaving.too_steep, steepness};
  for (int a = 0; a < D; ++a) {
    const Lanes u = giving.of(donors.velocity[a]) + leaving.offset * slopes[a];
    dp[a][face] = mass * u, carried.kinetic += 0.5 * mass * u * u;
  }
  return carried;
}

/// How many of the cells that give through a face have lost slopes that could be noticed.
template <int D>
std::int64_t count_flattened(const Gas& gas, std::size_t block, int axis, int n, std::size_t face, const Giving& giving,
                             const Carried& carried) {
  Pencil sound;
  load<D>(gas.cells, gas.primitive, block, Primitive::sound_speed, axis, n, sound);
  return count_inside<D>(gas, block, axis, n, face, carried.flattened & noticeable(carried.steepness, giving.of(sound)));
}

/// A fluid that fills a cell, with its mass (kg); -1: none does.
struct Filled {
  int fluid = -1;
  double mass = 0.0;
};
/// Calls let_out(face, lane, donor, fluid, flow, internal) for the fans of a pencil: donor among its cells, internal energy (J)
/// of what leaves. `filled(donor, lane)`: only cells of one fluid have fans.
template <class WhatFills, class LetOut>
void for_each_fan(const Gas& gas, std::size_t block, int axis, int n, const Lanes* swept, const WhatFills& filled,
                  const LetOut& let_out) {
  for (const Fan& fan : gas.fans[block]) {
    if (fan.axis != axis || fan.pencil != n) continue;
    const auto f = static_cast<std::size_t>(fan.face);
    for (int l = 0; l < 8; ++l) {
      if (!fan.opens[l]) continue;
      const std::size_t donor = swept[f][l] > 0.0 ? ring + f - 1 : ring + f;
      const auto [r, held] = filled(donor, l);
      if (r < 0) continue;
      const Fluid& fluid = gas.fluids[static_cast<std::size_t>(r)];
      const std::optional<FanFlow> flow = flow_of(fan, l, swept[f][l], [&](double density, double pressure) {
        return energy_of(fluid.equation_of_state, density, pressure);
      });
      constexpr double most = 0.8;  // of what the donor has
      if (!flow || !(flow->mass < most * held)) continue;
      const double internal = flow->energy - 0.5 * flow->momentum * flow->momentum / flow->mass;
      const double cold = flow->mass * coldest_energy(fluid, Lanes(flow->mass / std::abs(swept[f][l])))[0];
      if (internal > cold) let_out(f, l, donor, r, *flow, internal);
    }
  }
}

struct SweepResult {
  std::int64_t flattened = 0;  // faces
  bool good = true;            // no fluid is left with less than nothing
};

template <int D>
[[gnu::flatten]] SweepResult sweep_single(Gas& gas, std::size_t block, int axis) {
  constexpr int mass_at = Content::fluids(D) + Content::mass;
  SweepResult result;
  for (int n = 0; n < BlockShape<D>::pencils; ++n) {
    Donors<D> donors;
    auto& [mass, density, energy, velocity, velocity_slope] = donors;
    Pencil room, total, momentum[D], plain;
    if (gas.careful) load<D>(gas.cells, gas.half_step, block, HalfStep::plain(D), axis, n, plain);
    load<D>(gas.cells, gas.moved, block, Content::room, axis, n, room);
    load<D>(gas.cells, gas.moved, block, Content::energy, axis, n, total);
    load<D>(gas.cells, gas.moved, block, mass_at, axis, n, mass);
    for (int a = 0; a < D; ++a) load<D>(gas.cells, gas.moved, block, Content::momentum + a, axis, n, momentum[a]);
    for (std::size_t c = 0; c < reach; ++c) {
      density[c] = mass[c] / room[c];
      Lanes kinetic(0.0);
      const Lanes inverse_mass = 1.0 / mass[c];
      for (int a = 0; a < D; ++a) velocity[a][c] = momentum[a][c] * inverse_mass, kinetic += momentum[a][c] * velocity[a][c];
      energy[c] = (total[c] - 0.5 * kinetic) / room[c];
    }
    donors.find_slopes();
    const Lanes* swept = gas.swept_faces(block, axis, n);
    const NextPencil<D> next(gas.cells, block, axis, n);
    FacePencil dm, dE, dp[D];
    for (std::size_t f = 0; f < line_faces; ++f) {
      if (f < line) {
        next.fetch(gas.moved, 0, gas.contents(), f);
        next.fetch_to_write(gas.next, 0, gas.contents(), f);
      }
      const Giving giving = giving_at(swept[f], room, gas.careful ? &plain : nullptr, f);
      // A shock steepens itself. Held together like a contact, and with fourth order, it rings.
      const std::size_t l = giving.low, h = giving.high;
      const Lanes closing = max(Lanes(velocity[axis][l] - velocity[axis][h]), Lanes(0.0));
      const Lanes calm = away_from_shocks(giving.up, energy[l - 1], energy[l], energy[h], energy[h + 1],
                                          min(density[l], density[h]) * closing * closing);
      const Lanes leaving = swept[f] * giving.leaving(density, calm, Lanes(1.0));
      dm[f] = leaving;
      const Carried carried = carry_momentum<D>(giving, donors, leaving, f, dp);
      if (any(carried.flattened)) result.flattened += count_flattened<D>(gas, block, axis, n, f, giving, carried);
      dE[f] = swept[f] * giving.leaving(energy, calm, calm) * carried.heat_kept + carried.kinetic;
    }
    for_each_fan(
        gas, block, axis, n, swept,
        [&](std::size_t c, int l) {
          return Filled{0, mass[c][l]};
        },
        [&](std::size_t f, int l, std::size_t donor, int, const FanFlow& flow, double) {
          const double along = swept[f][l] > 0.0 ? flow.mass : -flow.mass;
          double motion = 0.0;
          for (int a = 0; a < D; ++a) {
            const double u = velocity[a][donor][l];
            dp[a][f].set(l, a == axis ? flow.momentum : along * u);
            if (a != axis) motion += 0.5 * along * u * u;
          }
          dm[f].set(l, along), dE[f].set(l, (swept[f][l] > 0.0 ? flow.energy : -flow.energy) + motion);
        });
    for (std::size_t f = 0; f < line; ++f) {
      const std::size_t c = ring + f;
      room[c] -= swept[f + 1] - swept[f];
      mass[c] -= dm[f + 1] - dm[f];
      total[c] -= dE[f + 1] - dE[f];
      for (int a = 0; a < D; ++a) momentum[a][c] -= dp[a][f + 1] - dp[a][f];
    }
    store<D>(gas.next, block, Content::room, axis, n, room);
    store<D>(gas.next, block, Content::energy, axis, n, total);
    store<D>(gas.next, block, mass_at, axis, n, mass);
    for (int a = 0; a < D; ++a) store<D>(gas.next, block, Content::momentum + a, axis, n, momentum[a]);
    for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
      const auto f = static_cast<std::size_t>(passage.face);
      for (int l = 0; l < 8; ++l) {
        if (!(lanes >> l & 1)) continue;
        passage.step.mass[0] += sign * dm[f][l], passage.step.energy += sign * dE[f][l];
        for (std::size_t a = 0; a < D; ++a) passage.step.momentum[a] += sign * dp[a][f][l];
      }
    });
  }
  return result;
}

template <int D>
[[gnu::flatten]] SweepResult sweep_mixture(Gas& gas, std::size_t block, int axis) {
  const std::size_t fluids = gas.fluids.size();
  SweepResult result;
  struct FluidPencils {
    Pencil mass, volume, internal, part, density, energy;
    std::array<LanesMask, reach> present;
    FacePencil dm, dV, dI;
  };
  std::vector<FluidPencils> fluid(fluids);
  for (int n = 0; n < BlockShape<D>::pencils; ++n) {
    Donors<D> donors;
    auto& [mass, density, energy, velocity, velocity_slope] = donors;
    Pencil room, total, momentum[D], plain;
    if (gas.careful) load<D>(gas.cells, gas.half_step, block, HalfStep::plain(D), axis, n, plain);
    load<D>(gas.cells, gas.moved, block, Content::room, axis, n, room);
    load<D>(gas.cells, gas.moved, block, Content::energy, axis, n, total);
    for (int a = 0; a < D; ++a) load<D>(gas.cells, gas.moved, block, Content::momentum + a, axis, n, momentum[a]);
    mass.fill(Lanes(0.0)), energy.fill(Lanes(0.0));
    for (std::size_t r = 0; r < fluids; ++r) {
      FluidPencils& at = fluid[r];
      const int first = Content::fluids(D) + 3 * static_cast<int>(r);
      load<D>(gas.cells, gas.moved, block, first + Content::mass, axis, n, at.mass);
      load<D>(gas.cells, gas.moved, block, first + Content::volume, axis, n, at.volume);
      load<D>(gas.cells, gas.moved, block, first + Content::internal, axis, n, at.internal);
      for (std::size_t c = 0; c < reach; ++c) {
        at.present[c] = is_present(at.volume[c], at.mass[c], room[c]);
        at.part[c] = at.volume[c] / room[c];
        const Lanes volume = select(at.present[c], at.volume[c], Lanes(1.0));
        at.density[c] = at.mass[c] / volume, at.energy[c] = at.internal[c] / volume;
        mass[c] += at.mass[c], energy[c] += at.internal[c];
      }
    }
    for (std::size_t c = 0; c < reach; ++c) {
      density[c] = mass[c] / room[c], energy[c] /= room[c];
      for (int a = 0; a < D; ++a) velocity[a][c] = momentum[a][c] / mass[c];
    }
    donors.find_slopes();
    const Lanes* swept = gas.swept_faces(block, axis, n);
    const NextPencil<D> next(gas.cells, block, axis, n);
    FacePencil dE, dp[D];
    for (std::size_t f = 0; f < line_faces; ++f) {
      if (f < line) {
        next.fetch(gas.moved, 0, gas.contents(), f);
        next.fetch_to_write(gas.next, 0, gas.contents(), f);
      }
      const Giving giving = giving_at(swept[f], room, gas.careful ? &plain : nullptr, f);
      const Lanes q = abs(swept[f]);
      // Volumes first: together they are what the face has swept. What the limits leave over goes to the largest. Of a fluid of
      // which there is next to nothing as much leaves as of the cell.
      constexpr double most = 0.999;  // of what the donor has
      Lanes left = q, largest(0.0);
      for (FluidPencils& at : fluid) {
        const LanesMask here = giving.of(at.present), whole = giving.of(at.part) > 1.0 - least_fraction;
        const Lanes volume = giving.of(at.volume), wanted = max(Lanes(q * giving.leaving(at.part)), Lanes(0.0));
        at.dV[f] = select(whole, q, select(here, min(wanted, Lanes(most * volume)), giving.part * volume));
        left -= at.dV[f], largest = max(largest, volume);
      }
      LanesMask given(false);
      Lanes dm_all(0.0), dI_all(0.0);
      const Lanes sign = select(giving.up, Lanes(1.0), Lanes(-1.0));
      for (FluidPencils& at : fluid) {
        const LanesMask here = giving.of(at.present), most_of_it = (giving.of(at.volume) == largest) & !given;
        given |= most_of_it;
        const Lanes volume = at.dV[f] + select(most_of_it, left, Lanes(0.0));
        at.dV[f] = sign * volume;
        const Lanes own_part = min(Lanes(volume / max(giving.of(at.volume), Lanes(1e-300))), Lanes(0.9999));
        const LanesMask sloped = giving.sloped(at.present, at.part);
        const Lanes dm = at.dV[f] * giving.leaving(at.density, sloped, own_part);
        const Lanes dI = at.dV[f] * giving.leaving(at.energy, sloped, own_part);
        const Lanes residue = sign * giving.part;
        at.dm[f] = select(here, dm, residue * giving.of(at.mass)),
        at.dI[f] = select(here, dI, residue * giving.of(at.internal));
        dm_all += at.dm[f], dI_all += at.dI[f];
      }
      const Carried carried = carry_momentum<D>(giving, donors, dm_all, f, dp);
      if (any(carried.flattened)) result.flattened += count_flattened<D>(gas, block, axis, n, f, giving, carried);
      dE[f] = dI_all * carried.heat_kept + carried.kinetic;
    }
    const auto filled = [&](std::size_t c, int l) {
      for (std::size_t r = 0; r < fluids; ++r)
        if (fluid[r].part[c][l] > nearly_all) return Filled{static_cast<int>(r), fluid[r].mass[c][l]};
      return Filled{};
    };
    for_each_fan(gas, block, axis, n, swept, filled,
                 [&](std::size_t f, int l, std::size_t donor, int filling, const FanFlow& flow, double internal) {
                   const double sign = swept[f][l] > 0.0 ? 1.0 : -1.0, along = sign * flow.mass;
                   FluidPencils& at = fluid[static_cast<std::size_t>(filling)];
                   at.dm[f].set(l, along), at.dI[f].set(l, sign * internal);
                   double traces = 0.0, carried = sign * flow.energy;  // traces of others leave as they would
                   for (const FluidPencils& other : fluid)
                     if (&other != &at) traces += other.dm[f][l], carried += other.dI[f][l];
                   for (int a = 0; a < D; ++a) {
                     const double u = velocity[a][donor][l], beside = a == axis ? traces : traces + along;
                     dp[a][f].set(l, beside * u + (a == axis ? flow.momentum : 0.0));
                     carried += 0.5 * beside * u * u;
                   }
                   dE[f].set(l, carried);
                 });
    for (std::size_t f = 0; f < line; ++f) {
      const std::size_t c = ring + f;
      room[c] -= swept[f + 1] - swept[f];
      total[c] -= dE[f + 1] - dE[f];
      for (int a = 0; a < D; ++a) momentum[a][c] -= dp[a][f + 1] - dp[a][f];
      for (FluidPencils& at : fluid) {
        at.mass[c] -= at.dm[f + 1] - at.dm[f];
        at.volume[c] -= at.dV[f + 1] - at.dV[f];
        at.internal[c] -= at.dI[f + 1] - at.dI[f];
        const LanesMask overdrawn = ((at.mass[c] < 0.0) | (at.volume[c] < -1e-14 * room[c])) &
                                    lanes_inside<D>(gas.cells, block, axis, n, static_cast<int>(f));
        if (none(overdrawn)) continue;
        mark<D>(gas, block, axis, n, f, overdrawn);
        result.good = false;
      }
    }
    store<D>(gas.next, block, Content::room, axis, n, room);
    store<D>(gas.next, block, Content::energy, axis, n, total);
    for (int a = 0; a < D; ++a) store<D>(gas.next, block, Content::momentum + a, axis, n, momentum[a]);
    for (std::size_t r = 0; r < fluids; ++r) {
      const int first = Content::fluids(D) + 3 * static_cast<int>(r);
      store<D>(gas.next, block, first + Content::mass, axis, n, fluid[r].mass);
      store<D>(gas.next, block, first + Content::volume, axis, n, fluid[r].volume);
      store<D>(gas.next, block, first + Content::internal, axis, n, fluid[r].internal);
    }
    for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
      const auto f = static_cast<std::size_t>(passage.face);
      for (int l = 0; l < 8; ++l) {
        if (!(lanes >> l & 1)) continue;
        for (std::size_t r = 0; r < fluids; ++r) passage.step.mass[r] += sign * fluid[r].dm[f][l];
        passage.step.energy += sign * dE[f][l];
        for (std::size_t a = 0; a < D; ++a) passage.step.momentum[a] += sign * dp[a][f][l];
      }
    });
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
