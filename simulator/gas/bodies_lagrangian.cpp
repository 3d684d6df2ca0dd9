// The Lagrangian phase of a step with bodies: half a step, the faces, and what they do to the cells.

#include <atomic>

#include "simulator/gas/acoustic.hpp"
#include "simulator/gas/bodies_step.hpp"
#include "simulator/gas/donor.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/friction.hpp"
#include "simulator/gas/limiter.hpp"
#include "simulator/gas/transport.hpp"

namespace brisance::simulator::gas::unsplit {
namespace {

Lanes slope_at(const Column& q, std::size_t n, std::size_t step, const LanesMask& smooth) {
  return select(smooth, monotonised_central(at(q, n - step), at(q, n), at(q, n + step)), Lanes(0.0));
}

/// Slope of the pressure less its hydrostatic part.
Lanes pressure_slope_at(const StepFields& s, std::size_t n, std::size_t step, const LanesMask& smooth, double half_head) {
  const Column &p = s.primitive[Primitive::pressure], &density = s.primitive[Primitive::density];
  if (half_head == 0.0) return slope_at(p, n, step, smooth);
  const Lanes below = at(p, n - step) + half_head * (at(density, n - step) + at(density, n));
  const Lanes above = at(p, n + step) - half_head * (at(density, n) + at(density, n + step));
  return select(smooth, monotonised_central(below, at(p, n), above), Lanes(0.0));
}

FaceSide face_side(const StepFields& s, const Window& w, const CutCells& step, std::size_t n, std::size_t axis, double towards,
                   const LanesMask& first_order, double half_head) {
  const LanesMask smooth = at(step.smooth[axis], n) > 0.5;
  const auto slope_of = [&](int quantity) {
    return slope_at(s.primitive[static_cast<std::size_t>(quantity)], n, offset(w, axis), smooth);
  };
  const int along = Primitive::velocity + static_cast<int>(axis);
  const Lanes density = at(s.primitive[Primitive::density], n), pressure = at(s.primitive[Primitive::pressure], n),
              velocity = at(s.primitive[static_cast<std::size_t>(along)], n);
  FaceSide side;
  side.density = density + towards * slope_of(Primitive::density);
  const Lanes excess = pressure_slope_at(s, n, offset(w, axis), smooth, half_head);
  side.pressure = pressure + towards * (excess + (2.0 * half_head) * density) + at(s.half[HalfStep::pressure], n);
  side.velocity = velocity + towards * slope_of(along) + at(s.half[HalfStep::velocity + axis], n);
  return trusted(side, density, pressure, velocity, first_order);
}
/// Of the low faces of eight cells along an axis: see passes_waves.
Lanes least_mach_at(const Gas& gas, std::size_t axis, std::size_t n) {
  const bool low = passes_waves(gas.edges[2 * axis].kind), high = passes_waves(gas.edges[2 * axis + 1].kind);
  Lanes least(gas.least_mach);
  if (!low && !high) return least;
  const Window& w = gas.bodies.window;
  for (int l = 0; l < 8; ++l) {
    const int at_face = w.index(std::min(n + static_cast<std::size_t>(l), w.first + w.cells - 1))[axis];
    if ((low && at_face == gas.cells.lower[axis]) || (high && at_face == gas.cells.upper[axis])) least.set(l, 1.0);
  }
  return least;
}
FaceSide chosen(const LanesMask& yes, const FaceSide& a, const FaceSide& b) {
  return {select(yes, a.velocity, b.velocity), select(yes, a.pressure, b.pressure), select(yes, a.density, b.density)};
}

}  // namespace

void half_step(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const double h = gas.cells.cell_size;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const bool round = is_round(gas.cells.geometry);
  for_each_eight(w, [&](std::size_t n) {
    const Lanes density = at(s.primitive[Primitive::density], n), sound = at(s.primitive[Primitive::sound_speed], n);
    Lanes divergence(0.0);
    LanesMask whole(true);
    for (std::size_t a = 0; a < D; ++a) {
      const LanesMask smooth = at(step.smooth[a], n) > 0.5;
      const Lanes push = pressure_slope_at(s, n, offset(w, a), smooth, 0.5 * gas.gravity[a] * h);
      ((-0.5 * dt / h) * push / density).store(s.half[HalfStep::velocity + a].data() + n);
      divergence += slope_at(s.primitive[Primitive::velocity + a], n, offset(w, a), smooth);
      whole &= smooth;
    }
    divergence *= 1.0 / h;
    if (round) {
      Lanes widening;
      for (int l = 0; l < 8; ++l) {
        const std::size_t cell = std::min(n + static_cast<std::size_t>(l), w.first + w.cells - 1);
        widening.set(l, gas.cells.metric.widening[static_cast<std::size_t>(w.index(cell)[0] - gas.cells.metric.first)]);
      }
      divergence += select(whole, widening * at(s.primitive[Primitive::velocity], n), Lanes(0.0));
    }
    (-0.5 * dt * density * sound * sound * divergence).store(s.half[HalfStep::pressure].data() + n);
    if (!gas.any_first_order) return;
    const LanesMask first_order = at(s.first_order, n) > 0.0;
    for (Column& half : s.half) select(first_order, Lanes(0.0), at(half, n)).store(half.data() + n);
  });
}

LanesMask first_order_face(const Gas& gas, std::size_t low, std::size_t high) {
  if (!gas.any_first_order) return LanesMask(false);
  return at(gas.bodies.fields.first_order, low) + at(gas.bodies.fields.first_order, high) > 0.0;
}

void find_faces(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const auto speed_at = [&](std::size_t n) {
    Lanes square(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const Lanes u = at(s.primitive[Primitive::velocity + a], n);
      square += u * u;
    }
    return square;
  };
  const int fluids = static_cast<int>(gas.fluids.size());
  const Column* impedance_ratio =
      fluids > 1 ? &s.primitive[static_cast<std::size_t>(Primitive::impedance_ratio(w.dimensions, fluids))] : nullptr;
  const double cells_per_speed = static_cast<double>(D) * dt / gas.cells.cell_size;
  for (std::size_t a = 0; a < D; ++a)
    for_each_eight(w, [&](std::size_t n) {
      const std::size_t l = n - offset(w, a);
      const LanesMask first_order = first_order_face(gas, l, n);
      const double half_head = 0.5 * gas.gravity[a] * gas.cells.cell_size;
      FaceSide L = face_side(s, w, step, l, a, 0.5, first_order, half_head),
               R = face_side(s, w, step, n, a, -0.5, first_order, half_head);
      Lanes sound_L = at(s.primitive[Primitive::sound_speed], l), sound_R = at(s.primitive[Primitive::sound_speed], n);
      // A cell that is only being opened has no state to send.
      const LanesMask gas_L = at(gas.bodies.space.volume, l) > 0.0, gas_R = at(gas.bodies.space.volume, n) > 0.0;
      const FaceSide from_L = L;
      L = chosen(gas_L, L, R), R = chosen(gas_R, R, from_L);
      const Lanes c_L = sound_L;
      sound_L = select(gas_L, sound_L, sound_R), sound_R = select(gas_R, sound_R, c_L);
      if (impedance_ratio) {  // impedances are made of densities
        const Lanes low = at(*impedance_ratio, l), high = at(*impedance_ratio, n);
        L.density *= impedance_ratio_in_step(select(gas_L, low, high), sound_L, cells_per_speed);
        R.density *= impedance_ratio_in_step(select(gas_R, high, low), sound_R, cells_per_speed);
      }
      const Lanes shock = 1.0 + 0.5 * max(at(s.primitive[Primitive::gruneisen], l), at(s.primitive[Primitive::gruneisen], n));
      const Star found = star(L, R, sound_L, sound_R, shock, sqrt(max(speed_at(l), speed_at(n))), least_mach_at(gas, a, n));
      // Gas at rest is so to the last bit.
      const LanesMask calm = (L.pressure == R.pressure) & (L.velocity == R.velocity);
      const Lanes velocity = select(calm, L.velocity, found.velocity);
      Lanes area = at(step.area[a], n);
      const LanesMask open = area > 0.0;
      if (a == 0 && is_round(gas.cells.geometry)) {
        const Lanes cut = area;
        area = area_on_the_way(gas.cells, area, dt * velocity);
        const LanesMask whole = (at(gas.bodies.space.area[0], n) == cut) & open;
        area = select(whole, area, cut);
      }
      select(open, area * velocity, Lanes(0.0)).store(s.flow[a].data() + n);
      // The face on the axis has no area, but a pressure.
      select(gas_L | gas_R, select(calm, L.pressure, found.pressure), Lanes(0.0)).store(s.pressure[a].data() + n);
    });
  // Nothing passes a wall, not even a rounding error.
  for (std::size_t side = 0; side < 2 * D; ++side) {
    const std::size_t a = side / 2;
    const int at_face = side % 2 == 0 ? gas.cells.lower[a] : gas.cells.upper[a];
    if (gas.edges[side].kind != EdgeKind::wall || at_face < w.lower[a] || at_face >= w.lower[a] + w.size[a]) continue;
    Part plane;
    for (std::size_t b = 0; b < 3; ++b) plane.lower[b] = w.lower[b], plane.upper[b] = w.lower[b] + w.size[b];
    plane.lower[a] = at_face, plane.upper[a] = at_face + 1;
    for_each_cell_of(plane, [&](const Index& cell) { s.flow[a][w.at(cell)] = 0.0; });
  }
}

void push_cells(Gas& gas, double dt) {
  const Window& w = gas.bodies.window;
  const CutCells& step = gas.bodies.step;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  for_each_eight(w, [&](std::size_t n) {
    Lanes growth(0.0), work(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const std::size_t next = n + offset(w, a);
      const Lanes low = at(s.pressure[a], n), high = at(s.pressure[a], next);
      const Lanes in = at(s.flow[a], n), out = at(s.flow[a], next);
      growth += out - in, work += high * out - low * in;
      // The impulse of the pressure on the sides of a widening cell is that of the mean of its two faces.
      (-dt * (0.5 * (at(step.area[a], n) + at(step.area[a], next))) * (high - low))
          .store(s.change[Content::momentum + a].data() + n);
    }
    (-dt * work).store(s.change[Content::energy].data() + n);
    (at(gas.bodies.next_space.volume, n) + dt * growth).store(s.volume.data() + n);
    for (std::size_t q = Content::momentum + D; q < s.change.size(); ++q) Lanes(0.0).store(s.change[q].data() + n);
  });
}

Lanes whole_mass(const Gas& gas, std::size_t n) {
  const StepFields& s = gas.bodies.fields;
  Lanes mass(0.0);
  for (int r = 0; r < static_cast<int>(gas.fluids.size()); ++r) {
    const int quantity = Content::of(gas.dimensions(), r, Content::mass);
    mass += at(s.content[static_cast<std::size_t>(quantity)], n);
  }
  return mass;
}

void pull_by_gravity(Gas& gas, double dt) {
  if (gas.gravity == Vector{}) return;
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  Column& work = s.rubbing;  // J; scratch until there is friction
  for_each_eight(w, [&](std::size_t n) {
    const Lanes open = at(bodies.space.volume, n) / whole_volumes(gas.cells, w, n);
    const Lanes mass = open * whole_mass(gas, n);
    Lanes free;
    for (std::size_t l = 0; l < 8; ++l)
      free.set(static_cast<int>(l), bodies.step.is_cut[std::min(n + l, w.length - 1)] ? 0.0 : 1.0);
    Lanes weight(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      const double g = gas.gravity[a];
      if (g == 0.0) continue;
      Column& change = s.change[Content::momentum + a];
      const Lanes pulled = at(change, n) + (dt * g) * free * mass;
      pulled.store(change.data() + n);
      weight += (dt * g) * (open * at(s.content[Content::momentum + a], n) + 0.5 * pulled);
    }
    weight = select(mass > 0.0, weight, Lanes(0.0));
    weight.store(work.data() + n);
    (at(s.change[Content::energy], n) + weight).store(s.change[Content::energy].data() + n);
  });
  for (Passage& pull : gas.passages) {
    if (pull.side != 2 * gas.dimensions()) continue;
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const auto block = static_cast<std::size_t>(pull.block);
      const Index index = gas.cells.index(block, c);
      if (!gas.cells.contains(index)) continue;
      const std::size_t n = w.at(index);
      const double mass = bodies.space.volume[n] / whole_cell(gas.cells, index[0]).volume * whole_mass(gas, n)[0];
      for (std::size_t a = 0; a < D; ++a) pull.step.momentum[a] += dt * gas.gravity[a] * mass;
      pull.step.energy += work[n];
    }
  }
}

void hold_rows_together(Gas& gas, double dt) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions);
  const bool several = gas.fluids.size() > 1;
  if (several) std::fill(s.heat.begin(), s.heat.end(), 0.0);
  const Column &density = s.primitive[Primitive::density], &sound = s.primitive[Primitive::sound_speed];
  const auto velocity = [&](std::size_t a) -> const Column& { return s.primitive[Primitive::velocity + a]; };
  const auto whole = [&](std::size_t n) {
    const Lanes volume = whole_volumes(gas.cells, w, n);
    return (at(bodies.space.volume, n) == volume) & (at(bodies.next_space.volume, n) == volume);
  };
  // What passes through the faces to the low side stands where the remap is to write what passes to the high side.
  const auto push = [&](std::size_t a, std::size_t b) -> Column& { return s.passing[a][Content::momentum + b]; };
  const auto energy = [&](std::size_t a) -> Column& { return s.passing[a][Content::energy]; };
  for (std::size_t a = 0; a < D; ++a) {
    const std::size_t next = offset(w, a);
    std::atomic<bool> any_shock = false;
    for_each_eight(w, [&](std::size_t n) {
      const LanesMask smooth = (at(bodies.step.smooth[a], n) > 0.5) & !first_order_face(gas, n, n);
      const Lanes closing = closing_in_shock(w.dimensions, gas.cells.cell_size, dt, at(density, n), at(sound, n),
                                             at(s.half[HalfStep::pressure], n), slope_at(velocity(a), n, next, smooth));
      const Lanes rubbing = rubbing_of(closing, at(density, n), at(sound, n));
      rubbing.store(s.rubbing.data() + n);
      if (any(rubbing > 0.0)) any_shock.store(true, std::memory_order_relaxed);
    });
    for (std::size_t q = Content::energy; q < Content::momentum + D && !any_shock; ++q)
      std::fill(s.passing[a][q].begin(), s.passing[a][q].end(), 0.0);
    if (!any_shock) continue;
    for_each_eight(w, [&](std::size_t n) {
      const std::size_t l = n - next;
      const Lanes open = select(whole(l) & whole(n), at(bodies.step.area[a], n), Lanes(0.0));
      const Lanes impedance = rubbing_impedance(at(density, l), at(density, n), at(s.rubbing, l), at(s.rubbing, n));
      Lanes work(0.0);
      for (std::size_t b = 0; b < D; ++b) {
        const Lanes low = at(velocity(b), l), high = at(velocity(b), n);
        const Lanes pushed = b == a ? Lanes(0.0) : select(open > 0.0, dt * open * impedance * (high - low), Lanes(0.0));
        pushed.store(push(a, b).data() + n);
        work += 0.5 * pushed * (low + high);
      }
      work.store(energy(a).data() + n);
    });
    for_each_eight(w, [&](std::size_t n) {
      // Nothing changes, to the last bit, where nothing is rubbed.
      const auto add = [&](Column& to, const Lanes& more) {
        select(more == 0.0, at(to, n), at(to, n) + more).store(to.data() + n);
      };
      add(s.change[Content::energy], at(energy(a), n + next) - at(energy(a), n));
      for (std::size_t b = 0; b < D; ++b) {
        if (b == a) continue;
        const Lanes low = at(push(a, b), n), high = at(push(a, b), n + next), u = at(velocity(b), n);
        add(s.change[Content::momentum + b], high - low);
        if (!several) continue;
        const Lanes mass = at(density, n) * at(bodies.space.volume, n), pushed = high - low;
        const Lanes warmed =
            low * (u - at(velocity(b), n - next)) + high * (at(velocity(b), n + next) - u) - pushed * pushed / mass;
        add(s.heat, select(mass > 0.0, 0.5 * warmed, Lanes(0.0)));
      }
    });
  }
  for_each_side_face(gas, [&](Passage& passage, double sign, std::size_t a, std::size_t n) {
    for (std::size_t b = 0; b < D; ++b) passage.step.momentum[b] -= sign * push(a, b)[n];
    passage.step.energy -= sign * energy(a)[n];
  });
}

/// Of eight cells of the window: those that share what they hold with a neighbourhood of their own.
LanesMask is_small(const Neighbourhoods& all, std::size_t n) {
  Lanes small(0.0);
  for (std::size_t l = 0; l < 8; ++l)
    if (n + l < all.number.size() && all.number[n + l] >= 0) small.set(static_cast<int>(l), 1.0);
  return small > 0.5;
}

void share_changes(Gas& gas) {
  const Bodies& bodies = gas.bodies;
  const Window& w = bodies.window;
  StepFields& s = gas.bodies.fields;
  const auto D = static_cast<std::size_t>(w.dimensions), fluids = gas.fluids.size();
  const auto first_share = static_cast<std::size_t>(Primitive::share(gas.dimensions(), 0));
  for_each_eight(w, [&](std::size_t n) {
    const Lanes volume = at(bodies.space.volume, n), open = volume / whole_volumes(gas.cells, w, n);
    Lanes mass(0.0), kinetic_before(0.0), kinetic(0.0), carried(0.0);
    for (std::size_t r = 0; r < fluids; ++r) mass += open * at(s.content[content_of(w, r, Content::mass)], n);
    for (std::size_t a = 0; a < D; ++a) {
      const Lanes before = open * at(s.content[Content::momentum + a], n), push = at(s.change[Content::momentum + a], n),
                  after = before + push;
      kinetic_before += before * before, kinetic += after * after, carried += before * push;
    }
    // What pushes a small cell pushes its neighbourhood: of the square of its push over its own mass, which may be a billionth
    // of that, nothing is motion. The neighbourhood's heat makes up for it (find_donors).
    const Lanes gained = select(is_small(bodies.small, n), carried, 0.5 * (kinetic - kinetic_before));
    const Lanes growth = at(s.volume, n) - volume;
    const Lanes heat = at(s.heat, n);
    const Lanes work = at(s.change[Content::energy], n) - gained / mass - heat;
    const LanesMask gas_here = volume > 0.0;
    Lanes rest(1.0), largest(0.0);
    for (std::size_t r = 0; r < fluids; ++r) largest = max(largest, at(s.content[content_of(w, r, Content::volume)], n));
    std::vector<Lanes> share(fluids);
    std::vector<LanesMask> majority(fluids);
    LanesMask given(false);
    for (std::size_t r = 0; r < fluids; ++r) {
      const Lanes own = at(s.content[content_of(w, r, Content::volume)], n);
      majority[r] = (own == largest) & !given;
      given |= majority[r];
      const Lanes wanted = at(s.primitive[first_share + r], n);
      share[r] = select(majority[r], Lanes(0.0), limited_share(wanted, growth, open * own));
      rest -= share[r];
    }
    for (std::size_t r = 0; r < fluids; ++r) {
      const Lanes part = select(gas_here, select(majority[r], rest, share[r]), Lanes(0.0));
      select(gas_here, part * growth, Lanes(0.0)).store(s.change[content_of(w, r, Content::volume)].data() + n);
      select(gas_here, part * work, Lanes(0.0)).store(s.change[content_of(w, r, Content::internal)].data() + n);
    }
    if (!any(heat != 0.0)) return;
    // All become warmer by the same.
    std::vector<Lanes> capacity(fluids);
    Lanes total(0.0);
    for (std::size_t r = 0; r < fluids; ++r) {
      const auto held = [&](int q) {
        return open * at(s.content[content_of(w, r, q)], n) + at(s.change[content_of(w, r, q)], n);
      };
      capacity[r] = heat_capacity(gas.fluids[r], held(Content::mass), held(Content::volume));
      total += capacity[r];
    }
    for (std::size_t r = 0; r < fluids; ++r) {
      Column& change = s.change[content_of(w, r, Content::internal)];
      select(heat != 0.0, at(change, n) + heat * capacity[r] / total, at(change, n)).store(change.data() + n);
    }
  });
}

}  // namespace brisance::simulator::gas::unsplit
