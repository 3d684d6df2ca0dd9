#include "simulator/gas/lagrangian.hpp"

#include <algorithm>
#include <vector>

#include "simulator/gas/acoustic.hpp"
#include "simulator/gas/donor.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/friction.hpp"
#include "simulator/gas/implicit.hpp"
#include "simulator/gas/moving_faces.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/gas/passages.hpp"
#include "simulator/gas/transport.hpp"

namespace brisance::simulator::gas {
namespace {

template <int D>
void half_step_of(Gas& gas, std::size_t block, double dt) {
  using Shape = BlockShape<D>;
  const Cells& cells = gas.cells;
  const double h = cells.cell_size;
  Lanes divergence[Shape::packs];
  const bool curved = is_round(cells.geometry);
  for (int axis = 0; axis < D; ++axis) {
    const double half_head = 0.5 * gas.gravity[static_cast<std::size_t>(axis)] * h;
    for (int n = 0; n < Shape::pencils; ++n) {
      Pencil density, pressure, velocity, change;
      load<D>(cells, gas.primitive, block, Primitive::density, axis, n, density);
      load<D>(cells, gas.primitive, block, Primitive::pressure, axis, n, pressure);
      load<D>(cells, gas.primitive, block, Primitive::velocity + axis, axis, n, velocity);
      const NextPencil<D> next(gas.cells, block, axis, n);
      for (std::size_t c = ring; c < ring + line; ++c) {
        next.fetch(gas.primitive, Primitive::density, 1, c - ring);
        next.fetch(gas.primitive, Primitive::pressure, 1, c - ring);
        next.fetch(gas.primitive, Primitive::velocity + axis, 1, c - ring);
        next.fetch_to_write(gas.half_step, HalfStep::pressure, 1, c - ring);
        next.fetch_to_write(gas.half_step, HalfStep::velocity + axis, 1, c - ring);
        if constexpr (D > 1) ask_for_gains<D>(gas, next, axis, c - ring);
        change[c] = (-0.5 * dt / h) * pressure_slope(pressure, density, c, half_head) / density[c];
      }
      store<D>(gas.half_step, block, HalfStep::velocity + axis, axis, n, change);
      if constexpr (D > 1) note_gains<D>(gas, block, axis, n, dt);
      for (std::size_t c = ring; c < ring + line; ++c) change[c] = slope(velocity, c);
      // The sum over the axes, in the order of the axes; through the pressure's place.
      if (axis == 0) {
        store<D>(gas.half_step, block, HalfStep::pressure, axis, n, change);
      } else {
        Pencil before;
        load_own<D>(gas.half_step, block, HalfStep::pressure, axis, n, before);
        for (std::size_t c = ring; c < ring + line; ++c) change[c] += before[c];
        store<D>(gas.half_step, block, HalfStep::pressure, axis, n, change);
      }
    }
  }
  for (int k = 0; k < Shape::packs; ++k) {
    const Lanes rho = gas.primitive.at(block, Primitive::density)[k], c = gas.primitive.at(block, Primitive::sound_speed)[k];
    divergence[k] = gas.half_step.at(block, HalfStep::pressure)[k] * (1.0 / h);
    if (curved) {
      const int first = cells.corner(block)[0] - cells.metric.first + (D == 1 ? 8 * k : 0);
      divergence[k] += Lanes::load(cells.metric.widening.data() + first) * gas.primitive.at(block, Primitive::velocity)[k];
    }
    gas.half_step.at(block, HalfStep::pressure)[k] = -0.5 * dt * rho * c * c * divergence[k];
    if constexpr (D > 1) find_gains<D>(gas, block, k, -cells.cell_size * divergence[k] / max(c, Lanes(1e-300)));
  }
}

/// What the faces of a pencil are made of.
template <int D>
struct FaceStates {
  Pencil density, pressure, sound, gruneisen, velocity[D], half_pressure, half_velocity, first_order;
  // These acoustic_faces finds.
  Pencil impedance_ratio;                  // see load_impedance_ratio
  Pencil stretch;                          // change of the velocity along the pencil over a cell
  Unset<FaceSide, reach> to_low, to_high;  // what the cells send to their faces
};
template <int D>
void load_states(const Gas& gas, std::size_t block, int axis, int n, FaceStates<D>& s) {
  if (gas.any_first_order) load<D>(gas.cells, gas.half_step, block, HalfStep::first_order(D), axis, n, s.first_order);
  load<D>(gas.cells, gas.primitive, block, Primitive::density, axis, n, s.density);
  load<D>(gas.cells, gas.primitive, block, Primitive::pressure, axis, n, s.pressure);
  load<D>(gas.cells, gas.primitive, block, Primitive::sound_speed, axis, n, s.sound);
  load<D>(gas.cells, gas.primitive, block, Primitive::gruneisen, axis, n, s.gruneisen);
  for (int a = 0; a < D; ++a) load<D>(gas.cells, gas.primitive, block, Primitive::velocity + a, axis, n, s.velocity[a]);
  load<D>(gas.cells, gas.half_step, block, HalfStep::pressure, axis, n, s.half_pressure);
  load<D>(gas.cells, gas.half_step, block, HalfStep::velocity + axis, axis, n, s.half_velocity);
}

/// Part of the impedances of a pencil's cells that their waves have.
template <int D>
void load_impedance_ratio(const Gas& gas, std::size_t block, int axis, int n, double dt, FaceStates<D>& s) {
  load<D>(gas.cells, gas.primitive, block, Primitive::impedance_ratio(D, static_cast<int>(gas.fluids.size())), axis, n,
          s.impedance_ratio);
  for (std::size_t c = ring - 1; c <= ring + line; ++c)
    s.impedance_ratio[c] = impedance_ratio_in_step(s.impedance_ratio[c], s.sound[c], D * dt / gas.cells.cell_size);
}

/// Velocity and pressure of the faces of a pencil, by the waves between its cells.
template <int D>
void acoustic_faces(Gas& gas, std::size_t block, int axis, int n, double dt, FaceStates<D>& s, FacePencil& face_velocity,
                    FacePencil& face_pressure) {
  const double half_head = 0.5 * gas.gravity[static_cast<std::size_t>(axis)] * gas.cells.cell_size;
  const Pencil& velocity = s.velocity[axis];
  Unset<FaceSide, reach>&to_low = s.to_low, &to_high = s.to_high;
  Pencil speed;
  for (std::size_t c = ring - 1; c <= ring + line; ++c) {
    const LanesMask first_order = gas.any_first_order ? s.first_order[c] > 0.0 : LanesMask(false);
    const auto side = [&](double towards) {
      return face_side(s.density, s.pressure, velocity, s.half_pressure, s.half_velocity, c, towards, half_head, first_order);
    };
    to_low[c] = side(-0.5), to_high[c] = side(0.5);
    s.stretch[c] = to_high[c].velocity - to_low[c].velocity;
    Lanes square = velocity[c] * velocity[c];
    for (int a = 0; a < D; ++a)
      if (a != axis) square += s.velocity[a][c] * s.velocity[a][c];
    speed[c] = square;
  }
  const bool several = gas.fluids.size() > 1;
  if (several) load_impedance_ratio<D>(gas, block, axis, n, dt, s);
  const auto face = [&](std::size_t f, double least_mach) {
    const std::size_t l = ring + f - 1, r = ring + f;
    FaceSide L = to_high[l], R = to_low[r];
    if (gas.any_first_order) {  // a cell that does without slopes makes its neighbour's side of the face do so
      L = trusted(L, s.density[l], s.pressure[l], velocity[l], s.first_order[r] > 0.0);
      R = trusted(R, s.density[r], s.pressure[r], velocity[r], s.first_order[l] > 0.0);
    }
    if (several) L.density *= s.impedance_ratio[l], R.density *= s.impedance_ratio[r];  // which the impedances are made of
    const Lanes shock = 1.0 + 0.5 * max(s.gruneisen[l], s.gruneisen[r]);
    return star(L, R, s.sound[l], s.sound[r], shock, sqrt(max(speed[l], speed[r])), least_mach);
  };
  const NextPencil<D> next(gas.cells, block, axis, n);
  for (std::size_t f = 0; f < line_faces; ++f) {
    if (f < line) {
      next.fetch(gas.primitive, 0, Primitive::count(D), f);
      next.fetch(gas.half_step, HalfStep::pressure, 1, f);
      next.fetch(gas.half_step, HalfStep::velocity + axis, 1, f);
      if constexpr (D > 1) next.fetch(gas.half_step, HalfStep::area(D, axis, 0), D, f);
    }
    const Star found = face(f, gas.least_mach);
    face_velocity[f] = found.velocity, face_pressure[f] = found.pressure;
  }
  for_each_passage(gas, block, axis, n, [&](const Passage& passage, double, std::uint8_t lanes) {
    if (!passes_waves(gas.edges[static_cast<std::size_t>(passage.side)].kind)) return;
    const auto f = static_cast<std::size_t>(passage.face);
    const Star found = face(f, 1.0);
    for (int l = 0; l < 8; ++l)
      if (lanes >> l & 1) face_velocity[f].set(l, found.velocity[l]), face_pressure[f].set(l, found.pressure[l]);
  });
}

/// Keeps the states of the faces at which fans may open, for the remap.
template <int D>
void note_fans(Gas& gas, std::size_t block, int axis, int n, double dt, const FaceStates<D>& s, const PencilMetric& metric,
               const FacePencil& face_velocity, const FacePencil& face_pressure) {
  // Beyond a side of prescribed pressure that pressure stands beside the density of the cell inside: a state from which no
  // fan opens.
  const auto enters_by_pressure = [&](std::size_t f) {
    LanesMask enters(false);
    for_each_passage(gas, block, axis, n, [&](const Passage& passage, double sign, std::uint8_t lanes) {
      if (static_cast<std::size_t>(passage.face) == f &&
          gas.edges[static_cast<std::size_t>(passage.side)].kind == EdgeKind::pressure)
        enters |= lanes_of(lanes) & (sign * face_velocity[f] > 0.0);
    });
    return enters;
  };
  for (std::size_t f = 0; f < line_faces; ++f) {
    const std::size_t l = ring + f - 1, r = ring + f;
    const LanesMask up = face_velocity[f] > 0.0;
    const auto donor = [&](const Pencil& field) { return select(up, field[l], field[r]); };
    const Lanes pressure = select(up, s.to_high[l].pressure, s.to_low[r].pressure);
    const Lanes density = donor(s.density), sound = donor(s.sound), bulk = density * sound * sound;
    LanesMask opens = may_open_fan(pressure, face_pressure[f], bulk);
    if (none(opens)) continue;
    if (gas.any_first_order) opens &= !(s.first_order[l] + s.first_order[r] > 0.0);
    opens &= !enters_by_pressure(f);
    const Lanes gamma = 1.0 + donor(s.gruneisen);
    gas.fans[block].push_back({axis, n, static_cast<int>(f), opens, select(up, s.to_high[l].density, s.to_low[r].density),
                               select(up, s.to_high[l].velocity, s.to_low[r].velocity), pressure, gamma,
                               bulk / gamma - donor(s.pressure), face_pressure[f], dt * metric.area[f]});
  }
}

/// J, of the fluids of a cell together, at Content::energy: in what the remap is to write only later.
CellSet& heat_of_friction(Gas& gas) {
  return gas.next;
}

/// Adds what comes through the faces of a pencil from their high sides to a quantity of its cells.
template <int D>
void add_through(Gas& gas, std::size_t block, int axis, int n, int quantity, const FacePencil& through) {
  Pencil values;
  load_own<D>(gas.moved, block, quantity, axis, n, values);
  for (std::size_t f = 0; f < line; ++f) values[ring + f] += through[f + 1] - through[f];
  store<D>(gas.moved, block, quantity, axis, n, values);
}
/// The same with impulses (N s) along the faces, which are booked.
template <int D>
void push_along_faces(Gas& gas, std::size_t block, int axis, int n, const FacePencil (&push)[D]) {
  for (int a = 0; a < D; ++a) {
    if (a == axis) continue;
    add_through<D>(gas, block, axis, n, Content::momentum + a, push[a]);
  }
  for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
    const auto f = static_cast<std::size_t>(passage.face);
    for (int l = 0; l < 8; ++l)
      for (int a = 0; a < D && (lanes >> l & 1); ++a)
        if (a != axis) passage.step.momentum[static_cast<std::size_t>(a)] -= sign * push[a][f][l];
  });
}

/// Friction between the rows of cells that a shock runs along.
template <int D>
void hold_rows_together(Gas& gas, std::size_t block, int axis, int n, double dt, const FaceStates<D>& s,
                        const PencilMetric& metric) {
  Pencil closing;
  LanesMask any_shock(false);
  for (std::size_t c = ring - 1; c <= ring + line; ++c) {
    closing[c] = closing_in_shock(D, gas.cells.cell_size, dt, s.density[c], s.sound[c], s.half_pressure[c], s.stretch[c]);
    any_shock |= closing[c] > 0.0;
  }
  if (none(any_shock)) return;
  Pencil rubbing;
  for (std::size_t c = ring - 1; c <= ring + line; ++c) rubbing[c] = rubbing_of(closing[c], s.density[c], s.sound[c]);
  FacePencil push[D], energy;  // N s, J: through the faces to the low side
  energy.fill(Lanes(0.0));
  const bool several = gas.fluids.size() > 1;
  Pencil heat;  // J
  if (several) load_own<D>(heat_of_friction(gas), block, Content::energy, axis, n, heat);
  for (int a = 0; a < D; ++a) {
    if (a == axis) continue;
    const Pencil& u = s.velocity[a];
    for (std::size_t f = 0; f < line_faces; ++f) {
      const std::size_t l = ring + f - 1, r = ring + f;
      const Lanes impedance = rubbing_impedance(s.density[l], s.density[r], rubbing[l], rubbing[r]);
      push[a][f] = dt * metric.area[f] * impedance * (u[r] - u[l]);
      energy[f] += 0.5 * push[a][f] * (u[l] + u[r]);
    }
    if (!several) continue;
    for (std::size_t f = 0; f < line; ++f) {
      const std::size_t c = ring + f;
      const Lanes pushed = push[a][f + 1] - push[a][f], mass = s.density[c] * metric.volume[c];
      heat[c] += 0.5 * (push[a][f] * (u[c] - u[c - 1]) + push[a][f + 1] * (u[c + 1] - u[c]) - pushed * pushed / mass);
    }
  }
  if (several) store<D>(heat_of_friction(gas), block, Content::energy, axis, n, heat);
  add_through<D>(gas, block, axis, n, Content::energy, energy);
  push_along_faces<D>(gas, block, axis, n, push);
  for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
    for (int l = 0; l < 8; ++l)
      if (lanes >> l & 1) passage.step.energy -= sign * energy[static_cast<std::size_t>(passage.face)][l];
  });
}

/// What the faces of a pencil gain on their way: none next to cells that do without slopes, nor where a fan opens, which lets
/// out what passes the old place of its face.
template <int D>
FaceGain<D> gain_of_faces(const Gas& gas, std::size_t block, int axis, int n, const FaceStates<D>& s) {
  FaceGain<D> gain(gas, block, axis, n);
  for (std::size_t f = 0; gas.any_first_order && f < line_faces; ++f)
    gain.forget(f, s.first_order[ring + f - 1] + s.first_order[ring + f] > 0.0);
  for (auto fan = gas.fans[block].rbegin(); fan != gas.fans[block].rend() && fan->axis == axis && fan->pencil == n; ++fan)
    gain.forget(static_cast<std::size_t>(fan->face), fan->opens);
  return gain;
}

/// Impulse (N s) of the pressure along a pencil. That on the sides of a widening cell is that of the mean of its two faces.
void push_on_sides(const FacePencil& area, const FacePencil& pressure, double dt, Pencil& momentum) {
  for (std::size_t f = 0; f < line; ++f)
    momentum[ring + f] -= dt * (0.5 * (area[f] + area[f + 1])) * (pressure[f + 1] - pressure[f]);
}

/// What faces that grow and tilt on their way add to what they sweep (m^3/s), to the force on them along the pencil (N) and to
/// the momentum of the cells (N s).
template <int D>
void grow_faces(Gas& gas, std::size_t block, int axis, int n, double dt, const FaceStates<D>& s, const PencilMetric& metric,
                const FacePencil& face_velocity, const FacePencil& face_pressure, FacePencil& flow, FacePencil& force,
                Pencil& momentum) {
  const FaceGain<D> gain = gain_of_faces<D>(gas, block, axis, n, s);
  FacePencil grown, along[D];  // Pa, N s
  for (std::size_t f = 0; f < line_faces; ++f) {
    const std::size_t l = ring + f - 1, r = ring + f;
    grown[f] = gain.along[axis][f] * face_pressure[f], force[f] += metric.area[f] * grown[f];
    Lanes faster = gain.along[axis][f] * face_velocity[f];
    for (int b = 0; b < D; ++b) {
      if (b == axis) continue;
      faster += gain.along[b][f] * (0.5 * (s.velocity[b][l] + s.velocity[b][r]));
      along[b][f] = (-dt * metric.area[f]) * (gain.along[b][f] * face_pressure[f]);
    }
    flow[f] += metric.area[f] * faster;
  }
  push_on_sides(metric.area, grown, dt, momentum);
  push_along_faces<D>(gas, block, axis, n, along);
}

/// What the velocities and pressures of the faces of a pencil do to its cells.
template <int D>
void move_pencil(Gas& gas, std::size_t block, int axis, int n, double dt, bool rubs) {
  FaceStates<D> states;
  FacePencil face_velocity, face_pressure, flow;  // flow: volume per time
  if (rubs) load_states<D>(gas, block, axis, n, states);
  if (gas.implicit)
    solved_faces<D>(gas, block, axis, n, dt, face_velocity, face_pressure);
  else
    acoustic_faces<D>(gas, block, axis, n, dt, states, face_velocity, face_pressure);
  for (std::size_t c = ring - 1; gas.implicit && rubs && c <= ring + line; ++c)
    states.stretch[c] = slope(states.velocity[axis], c);
  PencilMetric metric;
  load_metric<D>(gas.cells, block, axis, n, metric);
  if (!gas.implicit) note_fans<D>(gas, block, axis, n, dt, states, metric, face_velocity, face_pressure);
  FacePencil area, force, power;  // m^2, N, W: area on the way; what the pressure does along the axis
  for (std::size_t f = 0; f < line_faces; ++f) {
    area[f] = axis == 0 ? area_on_the_way(gas.cells, metric.area[f], dt * face_velocity[f]) : metric.area[f];
    flow[f] = area[f] * face_velocity[f], force[f] = area[f] * face_pressure[f];
  }
  Pencil cell_volume, momentum, energy;
  load_own<D>(gas.moved, block, Content::cell_volume, axis, n, cell_volume);
  load_own<D>(gas.moved, block, Content::energy, axis, n, energy);
  load_own<D>(gas.moved, block, Content::momentum + axis, axis, n, momentum);
  push_on_sides(area, face_pressure, dt, momentum);
  if constexpr (D > 1)
    if (!gas.implicit)
      grow_faces<D>(gas, block, axis, n, dt, states, metric, face_velocity, face_pressure, flow, force, momentum);
  Lanes* swept = gas.swept_faces(block, axis, n);
  for (std::size_t f = 0; f < line_faces; ++f) swept[f] = dt * flow[f], power[f] = face_pressure[f] * flow[f];
  for (std::size_t f = 0; f < line; ++f) {
    cell_volume[ring + f] += dt * (flow[f + 1] - flow[f]);
    energy[ring + f] -= dt * (power[f + 1] - power[f]);
  }
  store<D>(gas.moved, block, Content::cell_volume, axis, n, cell_volume);
  store<D>(gas.moved, block, Content::momentum + axis, axis, n, momentum);
  store<D>(gas.moved, block, Content::energy, axis, n, energy);
  book_pressure(gas, block, axis, n, dt, force, power);
  if constexpr (D > 1)
    if (rubs) hold_rows_together<D>(gas, block, axis, n, dt, states, metric);
}

/// The weight of the gas of some cells (kg), and its work, which are booked.
template <int D>
void pull_by_gravity(Gas& gas, std::size_t block, int k, double dt, const Lanes& mass) {
  if (gas.gravity == Vector{}) return;
  const std::uint8_t inside = cells_inside(gas.cells, block, k);
  auto& pull = gas.passages[static_cast<std::size_t>(gas.passage_of[block].back())].step;
  Lanes work(0.0);
  for (int a = 0; a < D; ++a) {
    const double g = gas.gravity[static_cast<std::size_t>(a)];
    if (g == 0.0) continue;
    Lanes& momentum = gas.moved.at(block, Content::momentum + a)[k];
    momentum += (dt * g) * mass;
    work += (0.5 * dt * g) * (gas.content.at(block, Content::momentum + a)[k] + momentum);
    for (int l = 0; l < 8; ++l)
      if (inside >> l & 1) pull.momentum[static_cast<std::size_t>(a)] += dt * g * mass[l];
  }
  gas.moved.at(block, Content::energy)[k] += work;
  for (int l = 0; l < 8; ++l)
    if (inside >> l & 1) pull.energy += work[l];
}

/// Several fluids of some cells share the growth of these (m^3) and the work (J) by their compressibility. What the limits
/// leave over goes to the fluid with most volume.
template <int D>
void share_change(Gas& gas, std::size_t block, int k, const Lanes& growth, const Lanes& work) {
  const int fluids = static_cast<int>(gas.fluids.size());
  const auto of = [&](int r, int quantity) -> Lanes& { return gas.moved.at(block, Content::of(D, r, quantity))[k]; };
  Lanes rest(1.0), largest(0.0);
  for (int r = 0; r < fluids; ++r) largest = max(largest, of(r, Content::volume));
  LanesMask given(false);
  for (int r = 0; r < fluids; ++r) {
    Lanes& volume = of(r, Content::volume);
    const LanesMask most_of_it = (volume == largest) & !given;
    given |= most_of_it;
    const Lanes wanted = gas.primitive.at(block, Primitive::share(D, r))[k];
    const Lanes share = select(most_of_it, Lanes(0.0), limited_share(wanted, growth, volume));
    rest -= share;
    volume += share * growth, of(r, Content::internal) += share * work;
  }
  given = LanesMask(false);
  for (int r = 0; r < fluids; ++r) {
    const Lanes before = gas.content.at(block, Content::of(D, r, Content::volume))[k];
    const LanesMask most_of_it = (before == largest) & !given;
    given |= most_of_it;
    of(r, Content::volume) += select(most_of_it, rest * growth, Lanes(0.0));
    of(r, Content::internal) += select(most_of_it, rest * work, Lanes(0.0));
  }
}

/// What several moved fluids of some cells have beyond their energies at T = 0, J.
template <int D>
Lanes heat_of_fluids(const Gas& gas, std::size_t block, int k) {
  Lanes heat(0.0);
  for (std::size_t r = 0; r < gas.fluids.size(); ++r) {
    const auto of = [&](int quantity) { return gas.moved.at(block, Content::of(D, r, quantity))[k]; };
    const Lanes mass = of(Content::mass), volume = of(Content::volume);
    const Lanes density = select(volume > 0.0, mass / volume, Lanes(gas.fluids[r].usual_density));
    heat += of(Content::internal) - mass * coldest_energy(gas.fluids[r], density);
  }
  return heat;
}

/// The fluids of some cells after their faces have moved. Returns which cells bear it, and marks the others.
template <int D>
LanesMask move_fluids(Gas& gas, std::size_t block, int k, double dt) {
  const auto at = [&](CellSet& set, int quantity) -> Lanes& { return set.at(block, quantity)[k]; };
  Lanes mass(0.0);
  for (std::size_t r = 0; r < gas.fluids.size(); ++r) mass += at(gas.content, Content::of(D, r, Content::mass));
  for (int q = Content::fluids(D); q < gas.contents(); ++q) at(gas.moved, q) = at(gas.content, q);
  pull_by_gravity<D>(gas, block, k, dt, mass);
  const auto internal_energy = [&](CellSet& set) {
    Lanes square(0.0);
    for (int a = 0; a < D; ++a) square += at(set, Content::momentum + a) * at(set, Content::momentum + a);
    return Lanes(at(set, Content::energy) - 0.5 * square / mass);
  };
  const Lanes before = at(gas.content, Content::cell_volume), volume = at(gas.moved, Content::cell_volume);
  const Lanes internal = internal_energy(gas.moved);
  Lanes heat;
  if (gas.fluids.size() == 1) {
    heat = internal - mass * coldest_energy(gas.fluids[0], Lanes(mass / volume));
  } else {
    const Lanes of_friction = at(heat_of_friction(gas), Content::energy);
    share_change<D>(gas, block, k, volume - before, internal - internal_energy(gas.content) - of_friction);
    if (any(abs(of_friction) > 0.0)) warm_alike(gas, gas.moved, block, k, of_friction);
    heat = heat_of_fluids<D>(gas, block, k);
  }
  const LanesMask active = lanes_of(cells_inside(gas.cells, block, k));
  const LanesMask bears = ((volume > least_volume_ratio * before) & (heat > 0.0)) | !active;
  if (!all(bears)) at(gas.marks, 0) = select(bears, at(gas.marks, 0), Lanes(1.0));
  return bears;
}

template <int D>
bool move(Gas& gas, std::size_t block, double dt) {
  using Shape = BlockShape<D>;
  for (int q = Content::cell_volume; q < Content::fluids(D); ++q)
    std::copy_n(gas.content.at(block, q), Shape::packs, gas.moved.at(block, q));
  if (gas.fluids.size() > 1) std::fill_n(heat_of_friction(gas).at(block, Content::energy), Shape::packs, Lanes(0.0));
  // Friction is explicit: implicit steps bear it where they are no longer than those of waves.
  constexpr double longest = 0.51;  // Courant number, and rounding
  const bool rubs = !gas.implicit || dt * gas.wave_rate <= longest;
  gas.fans[block].clear();
  for (int axis = 0; axis < D; ++axis)
    for (int n = 0; n < Shape::pencils; ++n) move_pencil<D>(gas, block, axis, n, dt, rubs);
  LanesMask good(true);
  for (int k = 0; k < Shape::packs; ++k) good &= move_fluids<D>(gas, block, k, dt);
  return all(good);
}

}  // namespace

void advance_half_step(Gas& gas, double dt) {
  for_each_own_block(gas, [&](auto D, std::size_t, std::size_t block) { half_step_of<D()>(gas, block, dt); });
}

bool lagrangian_phase(Gas& gas, double dt) {
  std::vector<char> good(gas.cells.mine.size());
  for_each_own_block(gas, [&](auto D, std::size_t i, std::size_t block) { good[i] = move<D()>(gas, block, dt); });
  return std::all_of(good.begin(), good.end(), [](char g) { return g != 0; });
}

}  // namespace brisance::simulator::gas
