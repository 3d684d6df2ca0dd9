#include "simulator/solid/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/kinematics.hpp"
#include "models/update.hpp"
#include "simulator/parallel.hpp"
#include "simulator/solid/packs.hpp"
#include "simulator/solid/worst_particle.hpp"

namespace brisance::simulator {
namespace {

using Pack = Point<Lanes>;

Lanes read(const double* columns, int k) {
  return Lanes::load(columns + k * chunk_size);
}
void write(double* columns, int k, const Lanes& value) {
  value.store(columns + k * chunk_size);
}

template <int D>
Tensor<Lanes> read_tensor(const double* c) {
  if constexpr (D == 3)
    return {read(c, 0), read(c, 1), read(c, 2), read(c, 3), read(c, 4), read(c, 5), read(c, 6), read(c, 7), read(c, 8)};
  Tensor<Lanes> t;
  t.xx = read(c, 0), t.xy = read(c, 1), t.yx = read(c, 2), t.yy = read(c, 3), t.zz = read(c, 4);
  return t;
}
template <int D>
void write_tensor(double* c, const Tensor<Lanes>& t) {
  if constexpr (D == 3) {
    write(c, 0, t.xx), write(c, 1, t.xy), write(c, 2, t.xz), write(c, 3, t.yx), write(c, 4, t.yy), write(c, 5, t.yz);
    write(c, 6, t.zx), write(c, 7, t.zy), write(c, 8, t.zz);
  } else {
    write(c, 0, t.xx), write(c, 1, t.xy), write(c, 2, t.yx), write(c, 3, t.yy), write(c, 4, t.zz);
  }
}
template <int D>
SymmetricTensor<Lanes> read_stress(const double* c) {
  SymmetricTensor<Lanes> t;
  t.xx = read(c, 0), t.yy = read(c, 1), t.zz = read(c, 2);
  if constexpr (D == 3)
    t.yz = read(c, 3), t.xz = read(c, 4), t.xy = read(c, 5);
  else
    t.xy = read(c, 3);
  return t;
}
template <int D>
void write_stress(double* c, const SymmetricTensor<Lanes>& t) {
  write(c, 0, t.xx), write(c, 1, t.yy), write(c, 2, t.zz);
  if constexpr (D == 3)
    write(c, 3, t.yz), write(c, 4, t.xz), write(c, 5, t.xy);
  else
    write(c, 3, t.xy);
}

/// The columns of `rest` that are members of the state, with them.
template <class Layout, class State, class F>
void for_each_scalar(State& s, F&& f) {
  using R = typename Layout::Rest;
  f(R::energy, s.energy), f(R::temperature, s.temperature), f(R::plastic_strain, s.plastic_strain);
  f(R::plastic_strain_rate, s.plastic_strain_rate), f(R::plastic_volume_strain, s.plastic_volume_strain);
  f(R::porosity, s.porosity), f(R::damage, s.damage), f(R::shear_modulus, s.shear_modulus), f(R::flow_history, s.flow_history);
  f(R::failure_cause, s.failure_cause), f(R::failure_time, s.failure_time);
}

template <int D>
void read_point(const Particles& ps, int chunk, double cell_size, Pack& p) {
  using L = Layout<D>;
  const double *load = ps.load.chunk(chunk), *rest = ps.rest.chunk(chunk);
  p.velocity_gradient = read_tensor<D>(ps.gradient.chunk(chunk));
  p.cell_size = Lanes(cell_size);
  p.heat = read(ps.filter_heat.chunk(chunk), 0);
  p.artificial_viscosity = read(load, L::Load::artificial_viscosity);
  p.state.stress = read_stress<D>(load + L::Load::stress * chunk_size);
  p.state.density = read(load, L::Load::density);
  p.state.deformation_gradient = read_tensor<D>(rest + L::Rest::deformation_gradient * chunk_size);
  if constexpr (D == 2) {
    Tensor<Lanes>& F = p.state.deformation_gradient;
    F.xz = F.yz = F.zx = F.zy = Lanes(0.0);
  }
  for_each_scalar<L>(p.state, [&](int column, Lanes& value) { value = read(rest, column); });
  for (int k = 0; k < ps.history_columns; ++k) p.state.history[static_cast<std::size_t>(k)] = read(rest, ps.history() + k);
  p.state.strength = ps.has_strength ? read(rest, ps.strength()) : Lanes(1.0);
}

/// What the update of some chunks reads.
template <int D>
Requests requests_for(const Particles& ps, const ColumnSet& velocities, int first, int end) {
  Requests requests;
  if (first >= end) return requests;
  for (const ColumnSet* set : {&ps.gradient, &ps.load, &ps.rest, &ps.filter_heat})
    requests.add(set->chunk(first), (end - first) * set->columns());
  for (int c = first; c < end; ++c) requests.add(velocities.chunk(c) + Layout<D>::Motion::velocity * chunk_size, D);
  return requests;
}

template <int D>
void write_point(Particles& ps, int chunk, const Pack& p) {
  using L = Layout<D>;
  double *load = ps.load.chunk(chunk), *rest = ps.rest.chunk(chunk);
  write_stress<D>(load + L::Load::stress * chunk_size, p.state.stress);
  write(load, L::Load::density, p.state.density);
  write(load, L::Load::artificial_viscosity, p.artificial_viscosity);
  write_tensor<D>(rest + L::Rest::deformation_gradient * chunk_size, p.state.deformation_gradient);
  for_each_scalar<L>(p.state, [&](int column, const Lanes& value) { write(rest, column, value); });
  for (int k = 0; k < ps.history_columns; ++k) write(rest, ps.history() + k, p.state.history[static_cast<std::size_t>(k)]);
  // Work per mass, computed from the stresses at both ends of the step and not from the energy, which it has to account for.
  const Lanes volume_change = 1.0 / p.state.density - 1.0 / p.density_before;
  const Lanes shape = double_dot(p.deviator_before + p.deviator, p.strain_increment) / (p.state.density + p.density_before);
  const Lanes bulk = -0.5 * (p.pressure_before + p.pressure) * volume_change;
  write(rest, L::Rest::stress_work, read(rest, L::Rest::stress_work) + shape + bulk);
  write(rest, L::Rest::viscous_work,
        read(rest, L::Rest::viscous_work) - 0.5 * (p.artificial_viscosity_before + p.artificial_viscosity) * volume_change);
  write(rest, L::Rest::plastic_work, read(rest, L::Rest::plastic_work) + p.plastic_work / p.state.density);
}

/// How near densities (kg/m^3, of the metal itself) are to the ends of what an equation of state holds for: 1 is an end.
Lanes filling(const equation_of_state::DensityRange& range, const Lanes& density) {
  return max(density * (1.0 / range.highest), range.lowest / density);
}

double largest(const Lanes& a) {
  double m = a[0];
  for (int i = 1; i < chunk_size; ++i) m = std::max(m, a[i]);
  return m;
}

/// Lanes that hold particles; those beyond the last one of a body hold nothing that counts.
LanesMask in_use(const Particles& ps, int chunk) {
  return pack(0, 1, 2, 3, 4, 5, 6, 7) < static_cast<double>(ps.size - chunk * chunk_size);
}
/// A number that is not negative joins the largest ones of its lanes.
void raise(Lanes& most, const LanesMask& counts, const Lanes& value) {
  most = max(most, select(counts, value, Lanes(0.0)));
}

/// Extremes of eight particles side by side.
struct LaneExtremes {
  Lanes wave_speed{0.0}, wave_and_motion{0.0}, speed{0.0}, volume_rate{0.0}, filling{0.0};

  Extremes over_lanes() const {
    return {largest(wave_speed), largest(wave_and_motion), largest(speed), largest(volume_rate), largest(filling)};
  }
};

/// Speeds that limit the step, from sound speed, artificial viscosity and velocity.
template <int D>
void look(const Simulation& s, const Body& body, int chunk, const Lanes& density, const Lanes& bulk_modulus,
          const Lanes& shear_modulus, const ColumnSet& motion, LaneExtremes& e) {
  using L = Layout<D>;
  const Lanes c = sqrt((bulk_modulus + (4.0 / 3.0) * shear_modulus) / density);
  Lanes trace(0.0);
  const double* l = body.particles.gradient.chunk(chunk);
  for (const int k : {0, D == 3 ? 4 : 3, D == 3 ? 8 : 4}) trace = trace + read(l, k);
  const Lanes jump = s.grid.cell_size * max(-trace, Lanes(0.0));
  const ArtificialViscosity& viscosity = body.material.artificial_viscosity;
  const Lanes Q = select(jump > 0.0, viscosity.linear * c + viscosity.quadratic * jump, Lanes(0.0));
  const Lanes wave = Q + sqrt(Q * Q + c * c);
  Lanes speed(0.0);
  for (int a = 0; a < D; ++a)
    speed = max(speed, abs(read(motion.chunk(chunk), L::Motion::velocity + a) - s.grid.velocity[static_cast<std::size_t>(a)]));
  const LanesMask counts = in_use(body.particles, chunk);
  raise(e.wave_speed, counts, wave), raise(e.wave_and_motion, counts, wave + speed);
  raise(e.speed, counts, speed), raise(e.volume_rate, counts, abs(trace));
}

/// The same of densities that an equation of state has to hold for.
void look_at_filling(const Body& body, int chunk, const Lanes& metal_density, LaneExtremes& e) {
  const equation_of_state::DensityRange range = equation_of_state::range(body.material.equation_of_state);
  raise(e.filling, in_use(body.particles, chunk), filling(range, metal_density));
}

Extremes& operator|=(Extremes& a, const Extremes& b) {
  a.wave_speed = std::max(a.wave_speed, b.wave_speed), a.wave_and_motion = std::max(a.wave_and_motion, b.wave_and_motion);
  a.speed = std::max(a.speed, b.speed), a.volume_rate = std::max(a.volume_rate, b.volume_rate);
  a.filling = std::max(a.filling, b.filling);
  return a;
}
Extremes over_all_ranks(Domain& domain, const Extremes& e) {
  return {domain.maximum(e.wave_speed), domain.maximum(e.wave_and_motion), domain.maximum(e.speed),
          domain.maximum(e.volume_rate), domain.maximum(e.filling)};
}

/// The particle that a material could not advance.
struct Failing {
  Trouble trouble = Trouble::none;
  const Body* body = nullptr;
  int particle = -1;
  std::uint64_t id = ~std::uint64_t{0};
  friend bool operator<(const Failing& a, const Failing& b) { return a.id < b.id; }
};

/// What an update overwrites, of the particles of one chunk.
struct ChunkState {
  std::vector<double> load, rest;

  ChunkState(const Particles& ps, int chunk)
      : load(ps.load.chunk(chunk), ps.load.chunk(chunk) + ps.load.columns() * chunk_size),
        rest(ps.rest.chunk(chunk), ps.rest.chunk(chunk) + ps.rest.columns() * chunk_size) {}
  void restore(Particles& ps, int chunk) const {
    std::copy(load.begin(), load.end(), ps.load.chunk(chunk));
    std::copy(rest.begin(), rest.end(), ps.rest.chunk(chunk));
  }
  void take(int lane, const ChunkState& from) {
    for (std::size_t i = static_cast<std::size_t>(lane); i < load.size(); i += chunk_size) load[i] = from.load[i];
    for (std::size_t i = static_cast<std::size_t>(lane); i < rest.size(); i += chunk_size) rest[i] = from.rest[i];
  }
};

constexpr int most_parts = 64;

/// Particles that the whole step has brought into trouble take it in 2, 4, ... equal parts along the same velocity gradient,
/// and keep what the fewest parts gave that went well; whoever finds no way stays as it was. `whole` comes as the update has
/// left it, and leaves with what is new.
template <int D>
void advance_in_parts(const Simulation& s, Body& body, int chunk, double dt, Pack& whole) {
  Particles& ps = body.particles;
  const ChunkState before(ps, chunk);
  write_point<D>(ps, chunk, whole);
  ChunkState result(ps, chunk);
  for (int i = 0; i < chunk_size; ++i)
    if (whole.trouble[i] != 0.0) result.take(i, before);
  const auto batch = std::make_unique<Batch<Lanes>>();
  batch->size = 1;
  Pack& part = batch->points[0];
  const Lanes heat = whole.heat;
  for (int parts = 2; parts <= most_parts && any(whole.trouble != 0.0); parts *= 2) {
    before.restore(ps, chunk);
    Lanes trouble(0.0);
    for (int i = 1; i <= parts; ++i) {
      batch->time = s.time + dt * i / parts;
      read_point<D>(ps, chunk, s.grid.cell_size, part);
      part.heat = heat / parts;
      update(body.material, *batch, dt / parts);
      write_point<D>(ps, chunk, part);
      trouble = max(trouble, part.trouble);
    }
    const ChunkState after(ps, chunk);
    const auto cured = (whole.trouble != 0.0) & (trouble == 0.0);
    for (int i = 0; i < chunk_size; ++i)
      if (whole.trouble[i] != 0.0 && trouble[i] == 0.0) result.take(i, after);
    whole.state.density = select(cured, part.state.density, whole.state.density);
    whole.state.shear_modulus = select(cured, part.state.shear_modulus, whole.state.shear_modulus);
    whole.metal_density = select(cured, part.metal_density, whole.metal_density);
    whole.bulk_modulus = select(cured, part.bulk_modulus, whole.bulk_modulus);
    whole.trouble = select(cured, Lanes(0.0), whole.trouble);
  }
  result.restore(ps, chunk);
}

/// The material's own update of the particles of one batch.
template <int D>
void advance_batch(const Simulation& s, Body& body, int first_chunk, int chunks, double dt, const ColumnSet& velocities,
                   Batch<Lanes>& batch, LaneExtremes& extremes, Failing& failing) {
  Particles& ps = body.particles;
  batch.size = chunks, batch.time = s.time + dt;
  for (int c = 0; c < chunks; ++c)
    read_point<D>(ps, first_chunk + c, s.grid.cell_size, batch.points[static_cast<std::size_t>(c)]);
  const int next = first_chunk + chunks;
  batch.ahead = requests_for<D>(ps, velocities, next, std::min(next + chunks, ps.chunks()));
  update(body.material, batch, dt);
  for (int c = 0; c < chunks; ++c) {
    Pack& p = batch.points[static_cast<std::size_t>(c)];
    const int chunk = first_chunk + c;
    p.trouble = select(in_use(ps, chunk), p.trouble, Lanes(0.0));
    if (none(p.trouble != 0.0))
      write_point<D>(ps, chunk, p);
    else
      advance_in_parts<D>(s, body, chunk, dt, p);
    if (any(p.trouble != 0.0))
      for (int i = 0; i < chunk_size; ++i) {
        const auto trouble = static_cast<Trouble>(static_cast<int>(p.trouble[i]));
        const int particle = chunk * chunk_size + i;
        if (trouble == Trouble::none) continue;
        const std::uint64_t id = ps.id[static_cast<std::size_t>(particle)];
        if (id < failing.id) failing = {trouble, &body, particle, id};
      }
    look<D>(s, body, chunk, p.state.density, p.bulk_modulus, p.state.shear_modulus, velocities, extremes);
    look_at_filling(body, chunk, p.metal_density, extremes);
  }
}

/// Deformation gradient and density of a body whose stress is a given function, then that function.
template <int D>
void advance_prescribed(const Simulation& s, Body& body, double dt, const ColumnSet& velocities, LaneExtremes& extremes) {
  using L = Layout<D>;
  Particles& ps = body.particles;
  for (int c = 0; c < ps.chunks(); ++c) {
    const Tensor<Lanes> A = Lanes(dt) * read_tensor<D>(ps.gradient.chunk(c));
    double* F = ps.rest.chunk(c) + L::Rest::deformation_gradient * chunk_size;
    write_tensor<D>(F, exponential(A) * read_tensor<D>(F));
    double* load = ps.load.chunk(c);
    write(load, L::Load::density, read(load, L::Load::density) * exp(-trace(A)));
  }
  for (int p = 0; p < ps.size; ++p) body.stress(body, p);
  for (int c = 0; c < ps.chunks(); ++c) {
    const Lanes rho = read(ps.load.chunk(c), L::Load::density), mu = read(ps.rest.chunk(c), L::Rest::shear_modulus);
    look<D>(s, body, c, rho, Lanes(*body.material.bulk_modulus), mu, velocities, extremes);
  }
}

/// Every rank says the same of the first particle of all of them.
[[noreturn]] void fail_together(const Simulation& s, const Failing& mine, double dt) {
  Remark remark{0.0, mine.id, {}};
  if (mine.body)
    remark.text = fmt::format("{}; {}; neither a whole step of {:.4g} s nor {} parts of it go well",
                              facts(s, *mine.body, mine.particle), describe(mine.trouble), dt, most_parts);
  throw std::runtime_error(highest_rated(*s.domain, remark));
}

template <int D>
void advance_all(Simulation& s, double dt, ColumnSet Particles::*velocities) {
  Extremes all;
  Failing first;
  for (Body& body : s.bodies) {
    if (body.stress) {
      LaneExtremes extremes;
      advance_prescribed<D>(s, body, dt, body.particles.*velocities, extremes);
      all |= extremes.over_lanes();
      continue;
    }
    constexpr int batch_chunks = Batch<Lanes>::capacity / 2;  // what fits into the first-level cache
    const int chunks = body.particles.chunks(), batches = (chunks + batch_chunks - 1) / batch_chunks;
    // A few batches per piece of work, so that the scratch batch is made once for them.
    constexpr int per_piece = 16;
    const int pieces = (batches + per_piece - 1) / per_piece;
    std::vector<LaneExtremes> extremes(static_cast<std::size_t>(pieces));
    std::vector<Failing> failing(static_cast<std::size_t>(pieces));
    parallel_for_blocks(static_cast<std::size_t>(pieces), [&](std::size_t piece) {
      const auto batch = std::make_unique<Batch<Lanes>>();
      const int end = std::min(batches, (static_cast<int>(piece) + 1) * per_piece);
      for (int b = static_cast<int>(piece) * per_piece; b < end; ++b)
        advance_batch<D>(s, body, b * batch_chunks, std::min(batch_chunks, chunks - b * batch_chunks), dt,
                         body.particles.*velocities, *batch, extremes[piece], failing[piece]);
    });
    for (const LaneExtremes& e : extremes) all |= e.over_lanes();
    for (const Failing& f : failing) first = std::min(first, f);
  }
  if (s.domain->maximum(first.body ? 1.0 : 0.0) > 0.0) fail_together(s, first, dt);
  s.extremes = over_all_ranks(*s.domain, all);
}

/// A batch that does not move tells its moduli; what the update makes of it is thrown away.
template <int D>
Extremes look_at_all(const Simulation& s) {
  LaneExtremes all;
  const auto batch = std::make_unique<Batch<Lanes>>();
  for (const Body& body : s.bodies)
    for (int c = 0; c < body.particles.chunks(); ++c) {
      if (body.stress) {
        const Lanes rho = read(body.particles.load.chunk(c), Layout<D>::Load::density);
        look<D>(s, body, c, rho, Lanes(*body.material.bulk_modulus),
                read(body.particles.rest.chunk(c), Layout<D>::Rest::shear_modulus), body.particles.motion, all);
        continue;
      }
      Pack& p = batch->points[0];
      batch->size = 1, batch->time = s.time;
      read_point<D>(body.particles, c, s.grid.cell_size, p);
      p.velocity_gradient = {}, p.heat = Lanes(0.0);
      constexpr double any_time = 1e-9;
      update(body.material, *batch, any_time);
      look<D>(s, body, c, p.state.density, p.bulk_modulus, p.state.shear_modulus, body.particles.motion, all);
      look_at_filling(body, c, p.metal_density, all);
    }
  return all.over_lanes();
}

/// Calls f(body, chunk, filling at the end of a step of dt seconds) for all particles that have an equation of state.
template <int D, class F>
void for_each_filling(const Simulation& s, double dt, F&& f) {
  using L = Layout<D>;
  for (const Body& body : s.bodies) {
    if (body.stress) continue;
    const equation_of_state::DensityRange range = equation_of_state::range(body.material.equation_of_state);
    for (int c = 0; c < body.particles.chunks(); ++c) {
      const Lanes voids = read(body.particles.rest.chunk(c), L::Rest::plastic_volume_strain),
                  volume_change = dt * trace(read_tensor<D>(body.particles.gradient.chunk(c)));
      f(body, c, filling(range, read(body.particles.load.chunk(c), L::Load::density) * exp(voids - volume_change)));
    }
  }
}

template <int D>
std::string worst_point(const Simulation& s, double dt) {
  const Body* body = nullptr;
  int particle = 0;
  Remark fullest{1.0, 0, {}};
  for_each_filling<D>(s, dt, [&](const Body& b, int chunk, const Lanes& filling_of) {
    for (int i = 0; i < std::min(chunk_size, b.particles.size - chunk * chunk_size); ++i) {
      const int p = chunk * chunk_size + i;
      const std::uint64_t id = b.particles.id[static_cast<std::size_t>(p)];
      if (filling_of[i] > fullest.rating || (body && filling_of[i] == fullest.rating && id < fullest.id))
        fullest.rating = filling_of[i], fullest.id = id, body = &b, particle = p;
    }
  });
  if (body) fullest.text = facts(s, *body, particle) + ": its density would leave the range of the equation of state";
  const std::string of_all = highest_rated(*s.domain, fullest);
  return of_all.empty() ? fastest_deforming(s) + ": it would be deformed too much" : of_all;
}

}  // namespace

Extremes extremes_of(const Simulation& s) {
  return over_all_ranks(*s.domain, s.dimensions() == 3 ? look_at_all<3>(s) : look_at_all<2>(s));
}

bool densities_stay_in_range(const Simulation& s, double largest_gradient, double dt) {
  // No volume changes faster than sqrt(3) |L|: mostly that is all that has to be known.
  if (s.extremes.filling * std::exp(std::sqrt(3.0) * largest_gradient * dt) <= 1.0) return true;
  Lanes fullest(0.0);
  const auto look = [&](const Body& body, int chunk, const Lanes& filling_of) {
    raise(fullest, in_use(body.particles, chunk), filling_of);
  };
  s.dimensions() == 3 ? for_each_filling<3>(s, dt, look) : for_each_filling<2>(s, dt, look);
  return s.domain->maximum(largest(fullest)) <= 1.0;
}

std::string worst_point(const Simulation& s, double dt) {
  return s.dimensions() == 3 ? worst_point<3>(s, dt) : worst_point<2>(s, dt);
}

void update_stress(Simulation& s, double dt, ColumnSet Particles::*velocities) {
  const Timed timed(s.times, Phase::update_stress);
  s.dimensions() == 3 ? advance_all<3>(s, dt, velocities) : advance_all<2>(s, dt, velocities);
}

}  // namespace brisance::simulator
