#include "simulator/gas/lagrangian.hpp"

#include <algorithm>
#include <vector>

#include "simulator/gas/acoustic.hpp"
#include "simulator/gas/donor.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/implicit.hpp"
#include "simulator/gas/passages.hpp"
#include "simulator/parallel.hpp"

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
      for (std::size_t c = ring; c < ring + line; ++c)
        change[c] = (-0.5 * dt / h) * pressure_slope(pressure, density, c, half_head) / density[c];
      store<D>(gas.half_step, block, HalfStep::velocity + axis, axis, n, change);
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
  }
}

/// Velocity and pressure of the faces of a pencil, by the waves between its cells.
template <int D>
void acoustic_faces(Gas& gas, std::size_t block, int axis, int n, FacePencil& face_velocity, FacePencil& face_pressure) {
  const Cells& cells = gas.cells;
  const double half_head = 0.5 * gas.gravity[static_cast<std::size_t>(axis)] * cells.cell_size;
  Pencil density, pressure, sound, gruneisen, velocity, half_pressure, half_velocity, speed, plain;
  if (gas.careful) load<D>(cells, gas.half_step, block, HalfStep::plain(D), axis, n, plain);
  load<D>(cells, gas.primitive, block, Primitive::density, axis, n, density);
  load<D>(cells, gas.primitive, block, Primitive::pressure, axis, n, pressure);
  load<D>(cells, gas.primitive, block, Primitive::sound_speed, axis, n, sound);
  load<D>(cells, gas.primitive, block, Primitive::gruneisen, axis, n, gruneisen);
  load<D>(cells, gas.primitive, block, Primitive::velocity + axis, axis, n, velocity);
  load<D>(cells, gas.half_step, block, HalfStep::pressure, axis, n, half_pressure);
  load<D>(cells, gas.half_step, block, HalfStep::velocity + axis, axis, n, half_velocity);
  load_squared_speed<D>(gas, block, axis, n, velocity, speed);
  const auto face = [&](std::size_t f, double least_mach) {
    const std::size_t l = ring + f - 1, r = ring + f;
    const LanesMask first_order = gas.careful ? plain[l] + plain[r] > 0.0 : LanesMask(false);
    const FaceSide L = face_side(density, pressure, velocity, half_pressure, half_velocity, l, 0.5, half_head, first_order);
    const FaceSide R = face_side(density, pressure, velocity, half_pressure, half_velocity, r, -0.5, half_head, first_order);
    const Lanes shock = 1.0 + 0.5 * max(gruneisen[l], gruneisen[r]);
    return star(L, R, sound[l], sound[r], shock, sqrt(max(speed[l], speed[r])), least_mach);
  };
  for (std::size_t f = 0; f < line_faces; ++f) {
    const Star s = face(f, gas.least_mach);
    face_velocity[f] = s.velocity, face_pressure[f] = s.pressure;
  }
  // What is taken from the waves at a side where they are to leave, comes back as another wave.
  for_each_passage(gas, block, axis, n, [&](const Passage& passage, double, std::uint8_t lanes) {
    if (gas.edges[static_cast<std::size_t>(passage.side)].kind != EdgeKind::non_reflecting) return;
    const auto f = static_cast<std::size_t>(passage.face);
    const Star s = face(f, 1.0);
    for (int l = 0; l < 8; ++l)
      if (lanes >> l & 1) face_velocity[f].set(l, s.velocity[l]), face_pressure[f].set(l, s.pressure[l]);
  });
}

template <int D>
bool move(Gas& gas, std::size_t block, double dt) {
  using Shape = BlockShape<D>;
  const Cells& cells = gas.cells;
  for (int axis = 0; axis < D; ++axis) {
    for (int n = 0; n < Shape::pencils; ++n) {
      FacePencil face_velocity, face_pressure, flow;  // flow: volume per time
      if (gas.implicit)
        solved_faces<D>(gas, block, axis, n, dt, face_velocity, face_pressure);
      else
        acoustic_faces<D>(gas, block, axis, n, face_velocity, face_pressure);
      PencilMetric metric;
      load_metric<D>(cells, block, axis, n, metric);
      Lanes* swept = gas.swept_faces(block, axis, n);
      for (std::size_t f = 0; f < line_faces; ++f) {
        if (axis == 0) metric.area[f] = area_on_the_way(cells, metric.area[f], dt * face_velocity[f]);
        flow[f] = metric.area[f] * face_velocity[f];
        swept[f] = dt * flow[f];
      }
      // The impulse of the pressure on the sides of a widening cell is that of the mean of its two faces.
      Pencil room, momentum, energy;
      const CellSet& before = axis == 0 ? gas.content : gas.moved;
      load_own<D>(before, block, Content::room, axis, n, room);
      load_own<D>(axis == 0 ? gas.content : gas.moved, block, Content::energy, axis, n, energy);
      load_own<D>(gas.content, block, Content::momentum + axis, axis, n, momentum);
      for (std::size_t f = 0; f < line; ++f) {
        const std::size_t c = ring + f;
        room[c] += dt * (flow[f + 1] - flow[f]);
        momentum[c] -= dt * (0.5 * (metric.area[f] + metric.area[f + 1])) * (face_pressure[f + 1] - face_pressure[f]);
        energy[c] -= dt * (face_pressure[f + 1] * flow[f + 1] - face_pressure[f] * flow[f]);
      }
      store<D>(gas.moved, block, Content::room, axis, n, room);
      store<D>(gas.moved, block, Content::momentum + axis, axis, n, momentum);
      store<D>(gas.moved, block, Content::energy, axis, n, energy);
      book_pressure(gas, block, axis, n, dt, face_pressure, flow, metric);
    }
  }

  LanesMask good(true);
  const int fluids = static_cast<int>(gas.fluids.size());
  for (int k = 0; k < Shape::packs; ++k) {
    const std::uint8_t inside = cells_inside(cells, block, k);
    const LanesMask active = lanes_of(inside);
    const auto at = [&](CellSet& set, int quantity) -> Lanes& { return set.at(block, quantity)[k]; };
    Lanes mass(0.0);
    for (int r = 0; r < fluids; ++r) {
      const int first = Content::fluids(D) + r * gas.fluid_quantities();
      mass += at(gas.content, first + Content::mass);
      for (int q = 0; q < gas.fluid_quantities(); ++q) at(gas.moved, first + q) = at(gas.content, first + q);
    }
    Lanes kinetic_before(0.0), kinetic(0.0), weight(0.0);
    for (int a = 0; a < D; ++a) {
      const double g = gas.gravity[static_cast<std::size_t>(a)];
      Lanes& momentum = at(gas.moved, Content::momentum + a);
      const Lanes before = at(gas.content, Content::momentum + a);
      if (g != 0.0) {
        momentum += (dt * g) * mass;
        weight += (0.5 * dt * g) * (before + momentum);
        Passage& pull = gas.passages[static_cast<std::size_t>(gas.passage_of[block].back())];
        for (int l = 0; l < 8; ++l)
          if (inside >> l & 1) pull.step.momentum[static_cast<std::size_t>(a)] += dt * g * mass[l];
      }
      kinetic_before += before * before, kinetic += momentum * momentum;
    }
    at(gas.moved, Content::energy) += weight;
    if (gas.gravity != Vector{})
      for (int l = 0; l < 8; ++l)
        if (inside >> l & 1) gas.passages[static_cast<std::size_t>(gas.passage_of[block].back())].step.energy += weight[l];
    const Lanes room = at(gas.content, Content::room), moved = at(gas.moved, Content::room);
    const Lanes internal_before = at(gas.content, Content::energy) - 0.5 * kinetic_before / mass;
    const Lanes internal = at(gas.moved, Content::energy) - 0.5 * kinetic / mass;
    Lanes thermal(0.0);
    if (fluids == 1) {
      thermal = internal - mass * coldest_energy(gas.fluids[0], Lanes(mass / moved));
    } else {
      Lanes rest(1.0), largest(0.0);
      const auto of = [&](int r, int quantity) -> Lanes& { return at(gas.moved, Content::fluids(D) + 3 * r + quantity); };
      const Lanes growth = moved - room, work = internal - internal_before;
      for (int r = 0; r < fluids; ++r) largest = max(largest, of(r, Content::volume));
      LanesMask given(false);
      for (int r = 0; r < fluids; ++r) {
        Lanes& volume = of(r, Content::volume);
        const LanesMask most_of_it = (volume == largest) & !given;
        given |= most_of_it;
        const Lanes wanted = gas.primitive.at(block, Primitive::count(D) + r)[k];
        const Lanes share = select(most_of_it, Lanes(0.0), limited_share(wanted, growth, volume));
        rest -= share;
        volume += share * growth, of(r, Content::internal) += share * work;
      }
      given = LanesMask(false);
      for (int r = 0; r < fluids; ++r) {
        Lanes &volume = of(r, Content::volume), &energy = of(r, Content::internal);
        const Lanes before = at(gas.content, Content::fluids(D) + 3 * r + Content::volume);
        const LanesMask most_of_it = (before == largest) & !given;
        given |= most_of_it;
        volume += select(most_of_it, rest * growth, Lanes(0.0)), energy += select(most_of_it, rest * work, Lanes(0.0));
        const Fluid& fluid = gas.fluids[static_cast<std::size_t>(r)];
        const Lanes own_mass = of(r, Content::mass);
        const Lanes density = select(volume > 0.0, own_mass / volume, Lanes(fluid.usual_density));
        thermal += energy - own_mass * coldest_energy(fluid, density);
      }
    }
    const LanesMask bears = ((moved > least_room * room) & (thermal > 0.0)) | !active;
    at(gas.marks, 0) = select(bears, at(gas.marks, 0), Lanes(1.0));
    good &= bears;
  }
  return all(good);
}

}  // namespace

void advance_half_step(Gas& gas, double dt) {
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    gas.dimensions() == 1   ? half_step_of<1>(gas, block, dt)
    : gas.dimensions() == 2 ? half_step_of<2>(gas, block, dt)
                            : half_step_of<3>(gas, block, dt);
  });
}

bool lagrangian_phase(Gas& gas, double dt) {
  std::vector<char> good(gas.cells.mine.size());
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    good[i] = gas.dimensions() == 1   ? move<1>(gas, block, dt)
              : gas.dimensions() == 2 ? move<2>(gas, block, dt)
                                      : move<3>(gas, block, dt);
  });
  return std::all_of(good.begin(), good.end(), [](char g) { return g != 0; });
}

}  // namespace brisance::simulator::gas
