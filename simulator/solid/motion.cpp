#include "simulator/solid/motion.hpp"

#include <algorithm>
#include <numeric>

#include "simulator/domain/message.hpp"
#include "simulator/solid/internal_energy.hpp"

namespace brisance::simulator {
namespace {

Vector vector_at(const Particles& p, int particle, int first) {
  Vector v{};
  for (int a = 0; a < p.dimensions; ++a) v[static_cast<std::size_t>(a)] = p.motion.at(first + a, particle);
  return v;
}

/// Sums what every rank has listed, in the order of the list; ranks hold ranges in Morton order, so it is that of all.
template <class T>
T ordered_sum(Domain& domain, const std::vector<T>& mine) {
  T sum{};
  if (domain.size() == 1) {
    for (const T& t : mine) sum += t;
    return sum;
  }
  Message list;
  append(list, mine.data(), mine.size());
  for (const Message& m : all_gather(domain, list))
    for (MessageReader reader(m); !reader.at_end();) sum += reader.read<T>();
  return sum;
}

/// Removes particles (by number) from a body's columns.
void remove(Particles& p, std::vector<std::uint32_t> gone) {
  if (gone.empty()) return;
  std::sort(gone.begin(), gone.end());
  std::vector<std::uint32_t> keep;
  for (std::uint32_t i = 0, g = 0; i < static_cast<std::uint32_t>(p.size); ++i) {
    if (g < gone.size() && gone[g] == i)
      ++g;
    else
      keep.push_back(i);
  }
  p.reorder(keep);
  p.resize(static_cast<int>(keep.size()));
  p.pad();
}

/// Sends particles whose blocks belong to others; true if any came or went here.
bool migrate(Simulation& s, Body& body) {
  if (s.domain->size() == 1) return false;
  Particles& p = body.particles;
  const std::vector<Column> columns = p.columns();
  std::vector<Message> messages(static_cast<std::size_t>(s.domain->size()));
  std::vector<std::uint32_t> gone;
  for (int i = 0; i < p.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const int owner = s.partition.owner(p.block[k]);
    if (owner == s.domain->rank()) continue;
    Message& to = messages[static_cast<std::size_t>(owner)];
    append(to, p.id[k]), append(to, p.block[k]);
    if (!p.second_field.empty()) append(to, p.second_field[k]);
    for (const Column& c : columns) append(to, p.set(c.set).at(c.index, i));
    gone.push_back(static_cast<std::uint32_t>(i));
  }
  remove(p, gone);
  bool arrived = false;
  for (const Message& m : s.domain->exchange(std::move(messages)))
    for (MessageReader reader(m); !reader.at_end();) {
      const int i = p.size;
      const auto k = static_cast<std::size_t>(i);
      p.resize(i + 1);
      p.id[k] = reader.read<std::uint64_t>(), p.block[k] = reader.read<BlockKey>();
      if (!p.second_field.empty()) p.second_field[k] = reader.read<std::uint32_t>();
      for (const Column& c : columns) p.set(c.set).at(c.index, i) = reader.read<double>();
      arrived = true;
    }
  if (arrived) p.pad();
  return arrived || !gone.empty();
}

/// Books the particles that leave through an outflow and removes them.
bool let_leave(Simulation& s, Body& body, const std::vector<std::uint32_t>& left) {
  struct Leaving {
    Change motion;
    double internal, work, mass;
    Leaving& operator+=(const Leaving& b) {
      motion += b.motion, internal += b.internal, work += b.work, mass += b.mass;
      return *this;
    }
  };
  const Particles& p = body.particles;
  std::vector<Leaving> list;
  for (const std::uint32_t k : left) {  // in the order of the bins
    const int i = static_cast<int>(k);
    const auto rest = [&](int in_space, int in_plane) { return p.rest.at(p.dimensions == 3 ? in_space : in_plane, i); };
    const double energy = rest(Layout<3>::Rest::energy, Layout<2>::Rest::energy),
                 work = rest(Layout<3>::Rest::stress_work, Layout<2>::Rest::stress_work) +
                        rest(Layout<3>::Rest::viscous_work, Layout<2>::Rest::viscous_work);
    const double m = p.load.at(0, i);
    const Vector x = vector_at(p, i, 0), v = vector_at(p, i, p.dimensions);
    list.push_back({{0.5 * m * dot(v, v), m * v, m * cross(x, v)}, m * energy, m * work, m});
  }
  const Leaving sum = ordered_sum(*s.domain, list);
  if (sum.mass == 0.0) return false;
  s.ledger.outflow.add(sum.motion);
  s.ledger.outflow_internal += sum.internal, s.ledger.outflow_work += sum.work, s.ledger.outflow_mass += sum.mass;
  s.ledger.state = s.ledger.state - sum.motion;
  remove(body.particles, left);
  return true;
}

}  // namespace

BlockKey block_of(const Particles& p, int particle, const Grid& grid) {
  const Vector x = vector_at(p, particle, 0) - grid.origin;
  return p.dimensions == 3 ? block_at<3>(x.data(), 1, 1.0 / grid.cell_size) : block_at<2>(x.data(), 1, 1.0 / grid.cell_size);
}

void place_particles(Simulation& s) {
  place_grid(s.grid, s.boundaries, s.time);
  for (Body& body : s.bodies) {
    Particles& p = body.particles;
    for (int i = 0; i < p.size; ++i) p.block[static_cast<std::size_t>(i)] = block_of(p, i, s.grid);
    migrate(s, body);
    p.pad();
    body.bins.sort(p);
    p.reorder(body.bins.order);
    body.bins.sort(p);
  }
}

void activate_blocks(Simulation& s) {
  const Timed timed(s.times, Phase::order);
  std::vector<BlockKey> keys;
  for (const Body& body : s.bodies)
    for (const Bin& bin : body.bins.bins) keys.push_back(bin.block);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  activate(s.grid, keys, s.partition, *s.domain);
}

void accept_motion(Simulation& s, const ParticleResult& particles, const NodeResult& nodes, double dt) {
  const Timed timed(s.times, Phase::order);
  std::vector<BoundaryTally> boundaries;
  for (std::size_t b = 0; b < s.boundaries.size(); ++b) {
    std::vector<BoundaryTally> list;
    for (const auto& of_block : nodes.boundaries) list.push_back(of_block[b]);
    boundaries.push_back(ordered_sum(*s.domain, list));
  }
  s.ledger.book(ordered_sum(*s.domain, particles.tallies), ordered_sum(*s.domain, nodes.tallies), boundaries,
                s.has_external_forces());

  s.time += dt;
  s.last_time_step = dt;
  ++s.step;
  place_grid(s.grid, s.boundaries, s.time);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    Body& body = s.bodies[b];
    Particles& p = body.particles;
    std::swap(p.motion, p.next_motion);
    for (const std::uint32_t i : particles.moved[b]) p.block[i] = block_of(p, static_cast<int>(i), s.grid);
    const bool lost = let_leave(s, body, particles.left[b]);
    if (migrate(s, body) || lost) {
      body.bins.sort(p);
    } else {
      body.bins.move(p, particles.moved[b]);
      tidy(p, body.bins);
    }
  }
}

Change motion_of(const Simulation& s, const Body& body) {
  const Particles& p = body.particles;
  std::vector<Change> list;
  for (const Bin& bin : body.bins.bins) {
    Change sum;
    for (std::uint32_t k = bin.begin; k < bin.end; ++k) {
      const int i = static_cast<int>(body.bins.order[k]);
      const double m = p.load.at(0, i);
      const Vector x = vector_at(p, i, 0), v = vector_at(p, i, p.dimensions);
      sum += {0.5 * m * dot(v, v), m * v, m * cross(x, v)};
    }
    list.push_back(sum);
  }
  return ordered_sum(*s.domain, list);
}

void open_books(Simulation& s) {
  Change state;
  for (const Body& body : s.bodies) state += motion_of(s, body);
  Ledger& ledger = s.ledger;
  ledger = {};
  ledger.boundary.resize(s.boundaries.size()), ledger.friction.resize(s.boundaries.size());
  ledger.state = ledger.initial = state;
  ledger.peak_kinetic = ledger.state.energy;
  ledger.initial_internal = internal_energy(s).total;
}

}  // namespace brisance::simulator
