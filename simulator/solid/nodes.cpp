#include "simulator/solid/nodes.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/parallel.hpp"

namespace brisance::simulator {
namespace {

/// A node with less than this part of a full cell's mass is empty. Its mass and momentum are sums of the same weights, so the
/// velocity of the lightest node is exact, and a body moves freely only if none is left out. Beside a plane whose ghosts are
/// subtracted, round-off may be all that is left of both.
constexpr double empty = 1e-30, empty_beside_plane = 1e-12;

double reference_mass(const Simulation& s) {
  double density = 0.0;
  for (const Body& b : s.bodies) density = std::max(density, b.material.density);
  const double h = s.grid.cell_size;
  return density * (s.dimensions() == 3 ? h * h * h : s.geometry == Geometry::axisymmetric ? h * h * h : h * h);
}

template <int D>
Vector read(const std::array<double, 8>& c, int first) {
  Vector v{};
  for (int a = 0; a < D; ++a) v[static_cast<std::size_t>(a)] = c[static_cast<std::size_t>(first + a)];
  return v;
}
template <int D>
void write(std::array<double, 8>& c, int first, const Vector& v) {
  for (int a = 0; a < D; ++a) c[static_cast<std::size_t>(first + a)] = v[static_cast<std::size_t>(a)];
}

/// The boundaries whose planes run through a block.
struct Crossing {
  std::size_t boundary;
  int axis, plane;
};
template <int D>
std::vector<Crossing> crossings(const Simulation& s, BlockKey key) {
  std::vector<Crossing> found;
  for (std::size_t b = 0; b < s.boundaries.size(); ++b)
    if (s.boundaries[b].kind != BoundaryKind::outflow)
      if (const int plane = local_plane<D>(s.boundaries[b], key); plane >= 0) found.push_back({b, s.boundaries[b].axis, plane});
  return found;
}

/// Which mass makes a node of a block one.
template <int D>
class LeastMass {
 public:
  LeastMass(const Simulation& s, BlockKey key, double reference) : reference_(reference) {
    for (const Boundary& b : s.boundaries) {
      if (!b.has_ghosts() || b.is_mirror()) continue;
      const int local = b.node + b.inward - block_position(key)[static_cast<std::size_t>(b.axis)] * Block<D>::side;
      if (local >= 0 && local < Block<D>::side) beside_.push_back({0, b.axis, local});
    }
  }
  double operator()(const std::array<int, 3>& local) const {
    for (const Crossing& c : beside_)
      if (local[static_cast<std::size_t>(c.axis)] == c.plane) return empty_beside_plane * reference_;
    return empty * reference_;
  }

 private:
  double reference_;
  std::vector<Crossing> beside_;
};

template <int D>
Vector place(const Grid& grid, const BlockPosition& block, const std::array<int, 3>& local) {
  Vector x = grid.origin;
  for (int a = 0; a < D; ++a) x[static_cast<std::size_t>(a)] += grid.cell_size * (block[a] * Block<D>::side + local[a]);
  return x;
}
template <int D>
std::array<int, 3> local_index(int node) {
  constexpr int side = Block<D>::side;
  return {node % side, node / side % side, D == 3 ? node / (side * side) : 0};
}

/// What a force or a jump of velocity does to a node: m dv at x, with the mean velocity over it.
Change act(const Vector& impulse, const Vector& x, const Vector& mean_velocity) {
  return {dot(impulse, mean_velocity), impulse, cross(x, impulse)};
}

/// The velocity after a boundary has acted, and the part of the impulse that is friction: Coulomb's law along a wall, at most
/// what stops the sliding.
Vector with_friction(const Boundary& b, const Vector& before, Vector after) {
  if (b.kind != BoundaryKind::rigid_wall || b.friction == 0.0) return after;
  const auto axis = static_cast<std::size_t>(b.axis);
  const double pressed = std::abs(after[axis] - before[axis]);
  Vector slip = after;
  slip[axis] = 0.0;
  const double size = magnitude(slip);
  if (pressed == 0.0 || size == 0.0) return after;
  return after - (std::min(b.friction * pressed, size) / size) * slip;
}

/// A node of a block as the boundaries see it.
struct Node {
  std::array<double, 8> sums;       // what the particles have added
  Vector position;                  // m
  std::vector<std::size_t> planes;  // the boundaries that it lies on
  double mass() const { return sums[Channel::mass]; }
};

/// Calls f(node, motion) for every node of a block that holds mass, to fill its motion; the others are at rest. `motion` comes
/// as it was.
template <int D, class F>
void for_each_node(Simulation& s, std::size_t number, double reference, F&& f) {
  const BlockKey key = s.grid.blocks[number];
  const BlockPosition block = block_position(key);
  const std::vector<Crossing> planes = crossings<D>(s, key);
  const LeastMass<D> least_mass(s, key, reference);
  Node node;
  for (int field = 0; field < s.grid.fields; ++field) {
    const Lanes* sums = s.grid.block_sums(number, field);
    Lanes* motion = s.grid.block_motion(number, field);
    for (int n = 0; n < Block<D>::nodes; ++n) {
      alignas(64) std::array<double, 8> in, out{};
      sums[n].store(in.data());
      const std::array<int, 3> local = local_index<D>(n);
      if (in[Channel::mass] > least_mass(local)) {
        motion[n].store(out.data());
        node.sums = in, node.position = place<D>(s.grid, block, local);
        node.planes.clear();
        for (const Crossing& c : planes)
          if (local[static_cast<std::size_t>(c.axis)] == c.plane) node.planes.push_back(c.boundary);
        f(node, out);
      }
      motion[n] = Lanes::load(out.data());
    }
  }
}

template <int D>
void accelerate_block(Simulation& s, std::size_t number, double dt, double reference, NodeTally& tally,
                      std::vector<BoundaryTally>& boundaries) {
  // Velocities lag half a step behind positions.
  const double start = s.time - 0.5 * s.last_time_step, end = start + dt;
  for_each_node<D>(s, number, reference, [&](const Node& node, std::array<double, 8>& motion) {
    const double m = node.mass();
    const auto held_by = [&](const Boundary& b, const Vector& velocity, double time) {
      return bounded(b, velocity, touches(node.sums[Channel::touch], b), time);
    };
    const Vector impulse = dt * read<D>(node.sums, Channel::force);
    Vector before = (1.0 / m) * read<D>(node.sums, Channel::momentum);
    for (const std::size_t b : node.planes) before = held_by(s.boundaries[b], before, start);
    const Vector free = before + (1.0 / m) * impulse;
    Vector after = free;
    for (const std::size_t b : node.planes) after = with_friction(s.boundaries[b], after, held_by(s.boundaries[b], after, end));
    // With the final velocity known, every impulse is booked with the same mean velocity.
    const Vector mean = 0.5 * (before + after);
    Vector velocity = free;
    for (const std::size_t b : node.planes) {
      const Vector held = held_by(s.boundaries[b], velocity, end), rubbed = with_friction(s.boundaries[b], velocity, held);
      boundaries[b].impulse += act(m * (rubbed - velocity), node.position, mean);
      boundaries[b].friction += dot(m * (rubbed - held), mean);
      velocity = rubbed;
    }
    tally.force += act(impulse, node.position, mean);
    tally.change += act(m * (after - before), node.position, mean);
    motion = {};
    motion[Channel::mass] = m, motion[Channel::touch] = node.sums[Channel::touch];
    write<D>(motion, Channel::velocity, after), write<D>(motion, Channel::change, after - before);
  });
}

template <int D>
void velocities_of_block(Simulation& s, std::size_t number, double reference, Touch touch, double time) {
  for_each_node<D>(s, number, reference, [&](const Node& node, std::array<double, 8>& motion) {
    const double touch_sum = (touch == Touch::as_accelerated ? motion : node.sums)[Channel::touch];
    Vector v = (1.0 / node.mass()) * read<D>(node.sums, Channel::momentum);
    for (const std::size_t b : node.planes) v = bounded(s.boundaries[b], v, touches(touch_sum, s.boundaries[b]), time);
    motion = {};
    motion[Channel::mass] = node.mass(), motion[Channel::touch] = touch_sum;
    write<D>(motion, Channel::velocity, v);
  });
}

/// Calls f.template operator()<D>(i, block) for the blocks of this rank.
template <class F>
void for_each_block(const Simulation& s, F&& f) {
  parallel_for_blocks(s.grid.my_blocks.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(s.grid.my_blocks[i]);
    s.dimensions() == 3 ? f.template operator()<3>(i, block) : f.template operator()<2>(i, block);
  });
}

}  // namespace

NodeResult accelerate(Simulation& s, double dt) {
  const Timed timed(s.times, Phase::nodes);
  NodeResult result;
  result.tallies.resize(s.grid.my_blocks.size());
  result.boundaries.assign(s.grid.my_blocks.size(), std::vector<BoundaryTally>(s.boundaries.size()));
  const double reference = reference_mass(s);
  for_each_block(s, [&]<int D>(std::size_t i, std::size_t block) {
    accelerate_block<D>(s, block, dt, reference, result.tallies[i], result.boundaries[i]);
  });
  return result;
}

void velocities_from_momentum(Simulation& s, Touch touch, double time) {
  const Timed timed(s.times, Phase::nodes);
  const double reference = reference_mass(s);
  for_each_block(s, [&]<int D>(std::size_t, std::size_t block) { velocities_of_block<D>(s, block, reference, touch, time); });
}

}  // namespace brisance::simulator
