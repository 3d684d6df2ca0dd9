#include "simulator/gas/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "simulator/domain/message.hpp"
#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {
namespace {

Vector turned(const std::array<Vector, 3>& rotation, const Vector& x) {
  return {dot(rotation[0], x), dot(rotation[1], x), dot(rotation[2], x)};
}
/// A rotation by a vector (rad) after another: Rodrigues' formula.
std::array<Vector, 3> turn_on(const std::array<Vector, 3>& before, const Vector& by) {
  const double angle = magnitude(by);
  if (angle == 0.0) return before;
  const Vector n = (1.0 / angle) * by;
  std::array<Vector, 3> columns, result;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector x = {before[0][c], before[1][c], before[2][c]};
    columns[c] = std::cos(angle) * x + std::sin(angle) * cross(n, x) + ((1.0 - std::cos(angle)) * dot(n, x)) * n;
  }
  for (std::size_t r = 0; r < 3; ++r) result[r] = {columns[0][r], columns[1][r], columns[2][r]};
  return result;
}

Vector position(const MovingBody& body, Geometry geometry, const MovingBody::State& s, Vector place) {
  if (s.growth != 0.0) {
    // What lies within stays within: r^d grows by as much everywhere.
    const double d = geometry == Geometry::plane ? 2.0 : 3.0, r = magnitude(place), R = body.motion.radius;
    const double power = std::pow(r, d) + (std::pow(R + s.growth, d) - std::pow(R, d));
    place = (std::pow(std::max(power, 0.0), 1.0 / d) / r) * place;
  }
  return body.centre + s.displacement + turned(s.turn, place);
}

/// The bodies in the states that `state_of` tells.
template <class F>
void put_on_nodes(Gas& gas, F&& state_of) {
  std::vector<BodyPoints> points;
  for (const MovingBody& body : gas.bodies.all)
    points.push_back(points_of(body, gas.cells.geometry, state_of(body), state_of(body), 0.0));
  put_on_nodes(gas.bodies.window, gas.cells, images_of(gas), points, gas.bodies.nodes);
}

/// After a restart as at the start: from where the bodies were then.
void find_built_in(Gas& gas, Domain& domain) {
  struct Sharing {
    int first, second;
    double fraction;
  };
  Bodies& bodies = gas.bodies;
  const auto note = [&](const Sharing& s) {
    double& most = bodies.built_in[{s.first, s.second}];
    most = std::max(most, s.fraction);
  };
  bodies.built_in.clear();
  if (bodies.all.size() < 2) return;
  if (!bodies.window.empty()) {
    put_on_nodes(gas, [](const MovingBody&) { return MovingBody::State{}; });
    for_each_cell_of(bodies.nodes.touched, [&](const std::array<int, 3>& node) {
      const std::size_t n = bodies.window.at(node);
      const auto [first, second] = sharing_bodies(bodies.nodes, n);
      const double fraction = shared_fraction(bodies.nodes, n);
      if (fraction > 1.0) note({first, second, fraction});
    });
  }
  Message mine;
  for (const auto& [pair, fraction] : bodies.built_in) append(mine, Sharing{pair.first, pair.second, fraction});
  for (const Message& message : all_gather(domain, mine))
    for (MessageReader reader(message); !reader.at_end();) note(reader.read<Sharing>());
}

bool same(const MovingBody::State& a, const MovingBody::State& b) {
  return a.displacement == b.displacement && a.turn == b.turn && a.growth == b.growth;
}

}  // namespace

BodyPoints points_of(const MovingBody& body, Geometry geometry, const MovingBody::State& from, const MovingBody::State& to,
                     double dt) {
  BodyPoints points;
  points.volume = body.volumes;
  points.velocity.assign(body.places.size(), Vector{});
  for (std::size_t p = 0; p < body.places.size(); ++p) {
    points.position.push_back(position(body, geometry, to, body.places[p]));
    if (dt > 0.0 && !same(from, to))
      points.velocity[p] = (1.0 / dt) * (points.position[p] - position(body, geometry, from, body.places[p]));
  }
  return points;
}

MovingBody::State moved(const MovingBody& body, double time, double dt) {
  MovingBody::State s = body.state;
  const double middle = time + 0.5 * dt;
  if (body.mass > 0.0) {
    s.displacement = s.displacement + dt * (s.velocity + (0.5 * dt) * s.acceleration);
    return s;
  }
  if (body.motion.velocity) s.displacement = s.displacement + dt * body.motion.velocity(middle);
  if (body.motion.rotation) s.turn = turn_on(s.turn, dt * body.motion.rotation(middle));
  if (body.motion.radial_velocity) s.growth += dt * body.motion.radial_velocity(middle);
  return s;
}

double fastest(const Gas& gas) {
  double speed = 0.0;
  for (const MovingBody& body : gas.bodies.all) {
    double farthest = 0.0, nearest = 1e300;
    for (const Vector& place : body.places)
      farthest = std::max(farthest, magnitude(place)), nearest = std::min(nearest, magnitude(place));
    double own = magnitude(body.state.velocity);
    if (body.motion.velocity) own += magnitude(body.motion.velocity(gas.time));
    if (body.motion.rotation) own += magnitude(body.motion.rotation(gas.time)) * farthest;
    if (body.motion.radial_velocity) {
      const double d = gas.cells.geometry == Geometry::plane ? 2.0 : 3.0, R = body.motion.radius + body.state.growth;
      own += std::abs(body.motion.radial_velocity(gas.time)) * std::pow(R / std::min(nearest, R), d - 1.0);
    }
    speed = std::max(speed, own);
  }
  return speed;
}

void place_bodies(Gas& gas, Domain& domain) {
  Bodies& bodies = gas.bodies;
  if (bodies.empty()) return;
  bodies.window = make_window(gas.cells);
  bodies.entrapped.resize(gas.fluids.size() + static_cast<std::size_t>(gas.dimensions()) + 1);
  Message mine;
  Part box;
  for (std::size_t a = 0; a < 3; ++a)
    box.lower[a] = bodies.window.lower[a], box.upper[a] = box.lower[a] + bodies.window.size[a];
  append(mine, bodies.window.empty() ? Part{} : box);
  bodies.windows.clear();
  for (const Message& message : all_gather(domain, mine)) bodies.windows.push_back(MessageReader(message).read<Part>());
  bodies.still = false;
  bodies.open = CellSet(1, gas.cells.packs());
  bodies.open.resize(gas.cells.blocks.size());
  for (std::size_t block = 0; block < gas.cells.blocks.size(); ++block)
    std::fill_n(bodies.open.at(block, 0), gas.cells.packs(), Lanes(1.0));
  find_built_in(gas, domain);
  if (bodies.window.empty()) return;
  put_on_nodes(gas, [](const MovingBody& body) { return body.state; });
  find_open_space(bodies.window, gas.cells, bodies.nodes, bodies.space);
  keep_open_parts(gas);
}

std::size_t bytes_of(const Bodies& bodies) {
  std::size_t sum = bodies.open.bytes();
  const auto add = [&](const auto&... lists) { ((sum += lists.capacity() * sizeof(lists[0])), ...); };
  const auto add_all = [&](const auto&... lists) {
    for (const auto* of : {&lists...})
      for (const auto& list : *of) add(list);
  };
  for (const OpenSpace* space : {&bodies.space, &bodies.next_space}) add(space->volume, space->side), add_all(space->area);
  const BodyNodes& nodes = bodies.nodes;
  add(nodes.fraction, nodes.share, nodes.body, nodes.second_share, nodes.other), add_all(nodes.momentum);
  add(bodies.step.cut, bodies.step.is_cut), add_all(bodies.step.area, bodies.step.smooth);
  add(bodies.small.small, bodies.small.number, bodies.small.overlaps, bodies.small.shared);
  const StepFields& s = bodies.fields;
  add_all(s.primitive, s.content, s.change, s.half, s.part, s.fluid_density, s.fluid_energy);
  add_all(s.flow, s.pressure, s.velocity);
  for (const auto& of_axis : s.passing) add_all(of_axis);
  add(s.volume, s.density, s.energy, s.covered, s.mean, s.rubbing, s.heat, s.first_order);
  for (const MovingBody& body : bodies.all) add(body.places, body.volumes);
  return sum;
}

BoxImages images_of(const Gas& gas) {
  BoxImages images;
  for (std::size_t side = 0; side < gas.edges.size(); ++side) {
    if (gas.edges[side].kind == EdgeKind::wall) images.mirror[side] = true;
    if (gas.edges[side].kind == EdgeKind::periodic) images.repeat[side / 2] = true;
  }
  return images;
}

void keep_open_parts(Gas& gas) {
  Bodies& bodies = gas.bodies;
  for (const std::int32_t b : gas.cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      const std::array<int, 3> index = gas.cells.index(block, c);
      if (gas.cells.contains(index))
        bodies.open.cell(block, 0, c) = bodies.space.volume[bodies.window.at(index)] / whole_cell(gas.cells, index[0]).volume;
    }
  }
}

double open_part(const Gas& gas, std::size_t block, int cell) {
  return gas.bodies.empty() ? 1.0 : gas.bodies.open.cell(block, 0, cell);
}

std::vector<double> numbers_of(const Bodies& bodies) {
  std::vector<double> numbers;
  const auto keep = [&](const auto& value) {
    static_assert(sizeof(value) % sizeof(double) == 0);
    const std::size_t at = numbers.size();
    numbers.resize(at + sizeof(value) / sizeof(double));
    std::memcpy(numbers.data() + at, &value, sizeof(value));
  };
  for (const MovingBody& body : bodies.all) keep(body.state), keep(body.force), keep(body.impulse), keep(body.work);
  for (const CompensatedSum& sum : bodies.entrapped) keep(sum);
  return numbers;
}

void restore(Bodies& bodies, const double* numbers) {
  const auto take = [&](auto& value) {
    std::memcpy(static_cast<void*>(&value), numbers, sizeof(value));
    numbers += sizeof(value) / sizeof(double);
  };
  for (MovingBody& body : bodies.all) take(body.state), take(body.force), take(body.impulse), take(body.work);
  for (CompensatedSum& sum : bodies.entrapped) take(sum);
}

}  // namespace brisance::simulator::gas
