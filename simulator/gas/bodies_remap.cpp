// The remap of a step with bodies, of all axes at once, and the redistribution of what small cells hold.

#include <atomic>

#include "simulator/gas/bodies_step.hpp"
#include "simulator/gas/donor.hpp"
#include "simulator/gas/limiter.hpp"
#include "simulator/gas/pressure_equilibrium.hpp"

namespace brisance::simulator::gas::unsplit {
namespace {

/// The flow through eight faces: which of the two cells gives, and what part of it.
struct Giving {
  std::size_t low, high, step;
  LanesMask up, smooth;
  Lanes part;

  Lanes of(const Column& q) const { return select(up, at(q, low), at(q, high)); }
  Lanes ahead(const Column& q) const { return select(up, at(q, high), at(q, low)); }
  Lanes difference(const Column& q, const Lanes& leaving) const {
    return difference_across_donor(up, at(q, low - step), at(q, low), at(q, high), at(q, high + step), leaving);
  }
  Lanes leaving(const Column& q, const Lanes& own_part, const LanesMask& where) const {
    return of(q) + select(where, 0.5 * (1.0 - own_part) * difference(q, own_part), Lanes(0.0));
  }
  Lanes leaving(const Column& q) const { return leaving(q, part, smooth); }
};

/// Cells of a group of eight that this process owns and that hold gas: what they do is counted.
int count_own(const Gas& gas, const LanesMask& cells, const LanesMask& up, std::size_t low, std::size_t high) {
  const Bodies& bodies = gas.bodies;
  int count = 0;
  for (std::size_t l = 0; l < 8; ++l) {
    if (!cells[static_cast<int>(l)]) continue;
    const std::size_t n = (up[static_cast<int>(l)] ? low : high) + l;
    if (n < bodies.window.first || n >= bodies.window.first + bodies.window.cells || !(bodies.space.volume[n] > 0.0)) continue;
    const Index cell = bodies.window.index(n);
    count += gas.cells.contains(cell) && gas.cells.find(cell) ? 1 : 0;
  }
  return count;
}

/// What passes eight faces, along the axis.
struct Passing {
  Lanes mass, heat;  // kg, J
};

/// The volumes of the fluids that pass are together what the faces have swept. What the limits leave over goes to the largest.
std::vector<Lanes> share_swept_volume(const StepFields& s, const Giving& giving, const Lanes& swept) {
  const std::size_t fluids = s.part.size();
  constexpr double most = 0.999;  // of what the donor has
  const Lanes all = abs(swept), donor_volume = giving.of(s.volume), sign = select(giving.up, Lanes(1.0), Lanes(-1.0));
  Lanes left = all, largest(0.0);
  std::vector<Lanes> volume(fluids);
  for (std::size_t r = 0; r < fluids; ++r) {
    const Lanes part = giving.of(s.part[r]), wanted = max(Lanes(all * giving.leaving(s.part[r])), Lanes(0.0));
    volume[r] = select(part > 1.0 - least_fraction, all, min(wanted, Lanes(most * part * donor_volume)));
    left -= volume[r], largest = max(largest, part);
  }
  LanesMask given(false);
  for (std::size_t r = 0; r < fluids; ++r) {
    const LanesMask most_of_it = (giving.of(s.part[r]) == largest) & !given;
    given |= most_of_it;
    volume[r] = sign * (volume[r] + select(most_of_it, left, Lanes(0.0)));
  }
  return volume;
}

/// Volumes, masses and energies of several fluids; put(column, value).
template <class Put>
Passing pass_fluids(const Window& w, const StepFields& s, const Giving& giving, const Lanes& swept, const Put& put) {
  Passing all{Lanes(0.0), Lanes(0.0)};
  const std::vector<Lanes> volume = share_swept_volume(s, giving, swept);
  const Lanes sign = select(giving.up, Lanes(1.0), Lanes(-1.0));
  for (std::size_t r = 0; r < volume.size(); ++r) {
    const Lanes part = giving.of(s.part[r]), held = part * giving.of(s.volume);
    const Lanes own_part = min(Lanes(sign * volume[r] / max(held, Lanes(1e-300))), Lanes(0.9999));
    // Slopes only where the cell behind, this one and the next all have the fluid, and this one is not at its edge.
    const Lanes next = giving.ahead(s.part[r]),
                behind = select(giving.up, at(s.part[r], giving.low - giving.step), at(s.part[r], giving.high + giving.step));
    const LanesMask smooth = giving.smooth & (min(min(behind, part), next) > 0.0) & has_slopes(behind, part, next);
    const auto pass = [&](int quantity, const Lanes& value) {
      const Lanes passing = select(part > 0.0, value, Lanes(0.0));
      put(content_of(w, r, quantity), passing);
      return passing;
    };
    pass(Content::volume, volume[r]);
    all.mass += pass(Content::mass, volume[r] * giving.leaving(s.fluid_density[r], own_part, smooth));
    all.heat += pass(Content::internal, volume[r] * giving.leaving(s.fluid_energy[r], own_part, smooth));
  }
  return all;
}

/// Momentum and energy that go with the mass. Returns where slopes have been taken back so that it could be noticed.
template <class Put>
LanesMask carry_momentum(const Window& w, const StepFields& s, const Giving& giving, const Passing& passing, const Put& put) {
  const auto D = static_cast<std::size_t>(w.dimensions);
  const Lanes density = giving.of(s.density), part = abs(passing.mass) / (density * giving.of(s.volume));
  Lanes slopes[3], steepness(0.0), kinetic(0.0);
  for (std::size_t a = 0; a < D; ++a) {
    const auto of = [&](std::size_t cell) {
      return monotonised_central(at(s.velocity[a], cell - giving.step), at(s.velocity[a], cell),
                                 at(s.velocity[a], cell + giving.step));
    };
    slopes[a] = select(giving.smooth, select(giving.up, of(giving.low), of(giving.high)), Lanes(0.0));
    steepness += slopes[a] * slopes[a];
  }
  const Leaving leaving = leaving_with_momentum(giving.up, part, density, steepness, giving.of(s.energy), Lanes(1.0));
  for (std::size_t a = 0; a < D; ++a) {
    const Lanes u = giving.of(s.velocity[a]) + leaving.offset * slopes[a];
    put(Content::momentum + a, passing.mass * u), kinetic += 0.5 * passing.mass * u * u;
  }
  put(Content::energy, passing.heat * leaving.heat_kept + kinetic);
  return leaving.too_steep & noticeable(steepness, giving.of(s.primitive[Primitive::sound_speed]));
}

/// What passes the faces across an axis. Returns how many slopes of own cells have been taken back.
std::int64_t find_passing(Gas& gas, double dt, std::size_t axis) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  const StepFields& s = bodies.fields;
  std::vector<Column>& columns = gas.bodies.fields.passing[axis];
  std::atomic<std::int64_t> flattened = 0;
  for_each_eight(w, [&](std::size_t n) {
    const Lanes swept = dt * at(s.flow[axis], n);
    const LanesMask none_passes = swept == 0.0;
    const auto put = [&](std::size_t q, const Lanes& value) {
      select(none_passes, Lanes(0.0), value).store(columns[q].data() + n);
    };
    Giving giving{n - offset(w, axis), n, offset(w, axis), swept > 0.0, LanesMask(false), Lanes(0.0)};
    giving.part = abs(swept) / giving.of(s.volume);
    giving.smooth = (giving.of(bodies.step.smooth[axis]) > 0.5) & !first_order_face(gas, giving.low, giving.high);
    Passing passing;
    if (gas.fluids.size() == 1) {
      passing = {swept * giving.leaving(s.density), swept * giving.leaving(s.energy)};
      put(content_of(w, 0, Content::mass), passing.mass);
    } else {
      passing = pass_fluids(w, s, giving, swept, put);
    }
    const LanesMask too_steep = carry_momentum(w, s, giving, passing, put) & !none_passes;
    if (any(too_steep)) flattened += count_own(gas, too_steep, giving.up, giving.low, giving.high);
  });
  return flattened;
}

/// An own cell in a neighbourhood that reaches through an open side of the box: what it takes comes through that side.
struct SharedWithWorld {
  std::size_t cell, neighbourhood;
  std::int32_t passage;
};
std::vector<SharedWithWorld> find_shared_with_world(const Gas& gas) {
  const Window& w = gas.bodies.window;
  const auto open_side = [&](std::size_t n) {  // -1: none
    const Index cell = w.index(n);
    for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a) {
      const bool low = cell[a] < gas.cells.lower[a];
      const std::size_t side = 2 * a + (low ? 0 : 1);
      const EdgeKind kind = gas.edges[side].kind;
      if ((low || cell[a] >= gas.cells.upper[a]) && kind != EdgeKind::periodic && !is_wall(kind)) return static_cast<int>(side);
    }
    return -1;
  };
  std::vector<SharedWithWorld> found;
  const std::vector<Neighbourhood>& all = gas.bodies.small.small;
  for (std::size_t i = 0; i < all.size(); ++i) {
    int side = -1;
    for (std::size_t m = 0; m < static_cast<std::size_t>(all[i].count) && side < 0; ++m) side = open_side(all[i].members[m]);
    for (std::size_t m = 0; m < static_cast<std::size_t>(all[i].count) && side >= 0; ++m) {
      const Index cell = w.index(all[i].members[m]);
      if (!gas.cells.contains(cell)) continue;
      if (const auto place = gas.cells.find(cell))
        found.push_back(
            {all[i].members[m], i, gas.passage_of[static_cast<std::size_t>(place->block)][static_cast<std::size_t>(side)]});
    }
  }
  return found;
}

}  // namespace

void find_donors(Gas& gas) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions), fluids = gas.fluids.size();
  // From what a cell, or a neighbourhood, holds after the Lagrangian phase.
  const auto write = [&](auto&& held, const auto& volume, bool neighbourhood, auto&& put) {
    auto mass = held(content_of(w, 0, Content::mass));
    for (std::size_t r = 1; r < fluids; ++r) mass += held(content_of(w, r, Content::mass));
    auto kinetic = 0.0 * mass;
    for (std::size_t a = 0; a < D; ++a) {
      const auto p = held(Content::momentum + a);
      const auto u = p / mass;
      kinetic += 0.5 * p * u;
      put(s.velocity[a], u);
    }
    put(s.density, mass / volume);
    if (fluids == 1) return put(s.energy, (held(Content::energy) - kinetic) / volume);
    using Real = std::decay_t<decltype(mass)>;
    Real internal = 0.0 * mass, volumes = internal;
    for (std::size_t r = 0; r < fluids; ++r)
      internal += held(content_of(w, r, Content::internal)), volumes += held(content_of(w, r, Content::volume));
    // The cells of a neighbourhood share their motion: what it loses by that is heat of all of its fluids.
    const Real lost = held(Content::energy) - kinetic - internal;
    if (neighbourhood) internal += lost;
    for (std::size_t r = 0; r < fluids; ++r) {
      const Real own = held(content_of(w, r, Content::volume)), own_mass = held(content_of(w, r, Content::mass));
      const auto present = is_present(own, own_mass, Real(volume));
      const Real divisor = select(present, own, Real(1.0));
      Real heat = held(content_of(w, r, Content::internal));
      if (neighbourhood) heat += lost * (own / volumes);
      put(s.part[r], select(present, Real(own / volume), Real(0.0)));
      put(s.fluid_density[r], Real(own_mass / divisor)), put(s.fluid_energy[r], Real(heat / divisor));
    }
    put(s.energy, internal / volume);
  };
  for_each_eight(w, [&](std::size_t n) {
    const Lanes open = at(bodies.space.volume, n) / whole_volumes(gas.cells, w, n);
    write([&](std::size_t q) { return open * at(s.content[q], n) + at(s.change[q], n); }, at(s.volume, n), false,
          [&](Column& column, const Lanes& value) { value.store(column.data() + n); });
  });
  std::vector<double> merged(bodies.small.small.size());
  for (std::size_t i = 0; i < bodies.small.small.size(); ++i) {
    const Neighbourhood& hood = bodies.small.small[i];
    const auto sum = [&](auto&& of) {
      double total = 0.0;
      for (int m = 0; m < hood.count; ++m) total += of(hood.members[static_cast<std::size_t>(m)]);
      return total;
    };
    const auto held = [&](std::size_t q) {
      return sum([&](std::size_t n) {
        return bodies.space.volume[n] / whole_cell(gas.cells, w.index(n)[0]).volume * s.content[q][n] + s.change[q][n];
      });
    };
    merged[i] = sum([&](std::size_t n) { return s.volume[n]; });
    write(held, merged[i], true, [&](Column& column, double value) { column[hood.cell] = value; });
  }
  for (std::size_t i = 0; i < merged.size(); ++i) s.volume[bodies.small.small[i].cell] = merged[i];
}

bool nothing_is_overdrawn(Gas& gas, double dt) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  const StepFields& s = bodies.fields;
  bool good = true;
  for (const std::int32_t b : gas.cells.mine)
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const Index index = gas.cells.index(static_cast<std::size_t>(b), c);
      if (!gas.cells.contains(index)) continue;
      const std::size_t n = w.at(index);
      if (bodies.small.number[n] >= 0 || (bodies.space.volume[n] == 0.0 && bodies.next_space.volume[n] == 0.0)) continue;
      double out = 0.0;
      for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a)
        out += std::max(s.flow[a][n + offset(w, a)], 0.0) - std::min(s.flow[a][n], 0.0);
      constexpr double most = 0.9;
      if (dt * out <= most * s.volume[n] && s.volume[n] > least_volume_ratio * bodies.space.volume[n]) continue;
      gas.marks.cell(static_cast<std::size_t>(b), 0, c) = 1.0, good = false;
    }
  return good;
}

std::int64_t remap(Gas& gas, double dt) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  std::int64_t flattened = 0;
  for (std::size_t a = 0; a < D; ++a) flattened += find_passing(gas, dt, a);
  for_each_eight(w, [&](std::size_t n) {
    const Lanes whole = whole_volumes(gas.cells, w, n);
    const Lanes before = at(bodies.space.volume, n) / whole, after = at(bodies.next_space.volume, n) / whole;
    for (std::size_t q = 1; q < s.content.size(); ++q) {
      Lanes change = at(s.change[q], n);
      for (std::size_t a = 0; a < D; ++a) change -= at(s.passing[a][q], n + offset(w, a)) - at(s.passing[a][q], n);
      change.store(s.change[q].data() + n);
      const Lanes held = at(s.content[q], n);
      // Nothing changes, to the last bit, where nothing happens.
      const Lanes next = select(before > 0.0, held + (change - held * (after - before)) / after, change / after);
      select(after > 0.0, next, held).store(s.content[q].data() + n);
    }
  });
  return flattened;
}

/// How a quantity changes from cell to cell in a column of constant entropy at rest: d rho = rho g dx/c^2, de = (e + p) d
/// rho/rho per volume; none without gravity, and of what does not change so.
SlopeAt column_slope(const Gas& gas, std::size_t q) {
  const auto is_of_fluid = [&](int quantity) { return Content::is_of_fluid(gas.dimensions(), static_cast<int>(q), quantity); };
  const bool whole_energy = q == Content::energy, energy = whole_energy || is_of_fluid(Content::internal);
  if (gas.gravity == Vector{} || !(energy || is_of_fluid(Content::mass))) return {};
  return [&gas, q, energy, whole_energy](std::size_t n) {
    const StepFields& s = gas.bodies.fields;
    if (!(gas.bodies.space.volume[n] > 0.0)) return Vector{};
    const double c = s.primitive[Primitive::sound_speed][n], p = s.primitive[Primitive::pressure][n];
    const double whole = whole_cell(gas.cells, gas.bodies.window.index(n)[0]).volume;
    const double part = !energy ? 0.0 : whole_energy ? 1.0 : s.content[q - Content::internal + Content::volume][n] / whole;
    return (gas.cells.cell_size / (c * c) * (s.mean[n] + part * p)) * gas.gravity;
  };
}

void redistribute_all(Gas& gas, std::vector<double>& entrapped, Meeting& meeting) {
  Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const std::vector<SharedWithWorld> with_world = find_shared_with_world(gas);
  for (std::size_t q = 1; q < s.content.size(); ++q) {
    Column& held = s.content[q];
    const bool mass = Content::is_of_fluid(w.dimensions, static_cast<int>(q), Content::mass);
    const auto fluid = static_cast<std::size_t>(mass ? Content::fluid_of(w.dimensions, static_cast<int>(q)) : 0);
    for (const std::size_t n : bodies.small.shared) {
      const double whole = whole_cell(gas.cells, w.index(n)[0]).volume;
      const bool covered = bodies.next_space.volume[n] == 0.0;
      s.mean[n] = held[n] / whole;
      s.covered[n] = covered ? bodies.space.volume[n] / whole * held[n] + s.change[q][n] : 0.0;
    }
    std::vector<double> first;
    for (const std::size_t n : bodies.small.shared) first.push_back(s.mean[n]);
    std::vector<double> shared_before;
    for (const SharedWithWorld& m : with_world) shared_before.push_back(s.mean[m.cell]);
    const std::vector<NeighbourhoodMean> means =
        redistribute(w, bodies.small, bodies.next_space.volume, s.mean, s.covered, column_slope(gas, q));
    for (std::size_t k = 0; k < with_world.size(); ++k) {
      const SharedWithWorld& m = with_world[k];
      const double gain = gain_of(bodies.small, m.cell, bodies.next_space.volume[m.cell],
                                  means[m.neighbourhood].at(w.index(m.cell)), shared_before[k], s.covered[m.cell]);
      auto& step = gas.passages[static_cast<std::size_t>(m.passage)].step;
      if (q == Content::energy)
        step.energy += gain;
      else if (q < Content::momentum + D)
        step.momentum[q - Content::momentum] += gain;
      else if (mass)
        step.mass[fluid] += gain;
    }
    for (std::size_t k = 0; k < bodies.small.shared.size(); ++k) {
      const std::size_t n = bodies.small.shared[k];
      held[n] += whole_cell(gas.cells, w.index(n)[0]).volume * (s.mean[n] - first[k]);
    }
    for (const Neighbourhood& hood : bodies.small.small) {
      if (hood.count > 1 || bodies.next_space.volume[hood.cell] > 0.0) continue;
      const Index cell = w.index(hood.cell);
      if (!gas.cells.contains(cell) || !gas.cells.find(cell)) continue;
      if (q == Content::energy) note_bodies_around(bodies, cell, meeting);
      if (q == Content::energy)
        entrapped.back() += s.covered[hood.cell];
      else if (q < Content::momentum + D)
        entrapped[gas.fluids.size() + q - Content::momentum] += s.covered[hood.cell];
      else if (mass)
        entrapped[fluid] += s.covered[hood.cell];
    }
  }
}

}  // namespace brisance::simulator::gas::unsplit
