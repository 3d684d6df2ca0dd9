#include "simulator/parallel.hpp"
#include "simulator/solid/transfer.hpp"
#include "simulator/solid/transfer/ghost_planes.hpp"
#include "simulator/solid/transfer/loads.hpp"
#include "simulator/solid/transfer/pushing_stress.hpp"
#include "simulator/solid/transfer/referred.hpp"

namespace brisance::simulator {

namespace {

/// A Change summed over particles, eight side by side.
template <std::size_t D>
class Changes {
 public:
  using Vec = std::array<Lanes, D>;
  /// An impulse at a place, and the mean velocity while it acts.
  void add(const Vec& impulse, const Vec& x, const Vec& mean_velocity) {
    for (std::size_t a = 0; a < D; ++a) energy_ += impulse[a] * mean_velocity[a], momentum_[a] += impulse[a];
    angular_[2] += x[0] * impulse[1] - x[1] * impulse[0];
    if constexpr (D == 3) {
      angular_[0] += x[1] * impulse[2] - x[2] * impulse[1];
      angular_[1] += x[2] * impulse[0] - x[0] * impulse[2];
    }
  }
  Change total() const {
    Change sum;
    for (int i = 0; i < 8; ++i)
      sum +=
          {energy_[i], {momentum_[0][i], momentum_[1][i], momentum_[2][i]}, {angular_[0][i], angular_[1][i], angular_[2][i]}};
    return sum;
  }

 private:
  Lanes energy_{0.0};
  std::array<Lanes, 3> momentum_{}, angular_{};
};

/// Power of a stress on the mean velocity gradient over a change of the grid's velocities (W/m^3).
template <Geometry G, std::size_t D>
Lanes stress_power(const SymmetricTensor<Lanes>& sigma, const GatheredByChannel<D>& grid) {
  const auto mean = [](const Square& slope, int a) {
    return Lanes(slope[Channel::velocity + a]) - 0.5 * Lanes(slope[Channel::change + a]);
  };
  const auto L = [&](int a, int b) { return mean(grid.slope[b], a); };
  Lanes power = sigma.xx * L(0, 0) + sigma.yy * L(1, 1) + sigma.xy * (L(1, 0) + L(0, 1));
  if constexpr (D == 3) power += sigma.zz * L(2, 2) + sigma.xz * (L(2, 0) + L(0, 2)) + sigma.yz * (L(2, 1) + L(1, 2));
  if constexpr (G == Geometry::axisymmetric) power += sigma.zz * mean(grid.hoop, 0);
  return power;
}

/// Lists those of eight particles that leave their block, with the grid's origin as it is then, and those that are beyond an
/// outflow.
template <std::size_t D>
void list_leavers(const Simulation& s, const Vector& origin, const Eight& eight, const std::array<Lanes, D>& x,
                  const BlockPosition& block, std::vector<std::uint32_t>& moved, std::vector<std::uint32_t>& left) {
  const auto list = [&](const LanesMask& which, std::vector<std::uint32_t>& to) {
    if (none(which)) return;
    for (int i = 0; i < eight.used; ++i)
      if (which[i]) to.push_back(eight.particle[static_cast<std::size_t>(i)]);
  };
  LanesMask stays(true), out(false);
  for (std::size_t a = 0; a < D; ++a) {
    const Lanes node = nearest_node(x[a] - origin[a], 1.0 / s.grid.cell_size);
    stays &= (node >= block[a] * Block<D>::side) & (node < (block[a] + 1) * Block<D>::side);
  }
  for (const Boundary& b : s.boundaries)
    if (b.kind == BoundaryKind::outflow) out |= (x[static_cast<std::size_t>(b.axis)] - b.position) * b.inward < 0.0;
  list(!stays, moved), list(out, left);
}

/// Whether the velocity that AFLIP's filter takes from a body's particles, relative to the grid, becomes heat in them. With usf
/// the stress has been updated before the filter acts.
bool filter_heats(const Simulation& s, const Body& body) {
  return s.numerics.particle_velocity == ParticleVelocity::aflip && s.numerics.stress_timing != StressTiming::usf &&
         !body.stress;
}

template <Geometry G, Basis basis>
void from_tile(Simulation& s, const TileView& tile, const ParticleStep& step, ParticleTally& tally,
               std::vector<std::vector<std::uint32_t>>& moved, std::vector<std::vector<std::uint32_t>>& left) {
  constexpr int D = dimensions_of<G>;
  constexpr bool ring = G == Geometry::axisymmetric;
  using L = Layout<D>;
  using Vec = std::array<Lanes, D>;
  const double h = s.grid.cell_size;
  const bool aflip = s.numerics.particle_velocity == ParticleVelocity::aflip;
  const double filter_time = s.numerics.filter_time * h / s.extremes.wave_speed;
  const double beta = aflip ? -std::expm1(-step.dt / filter_time) : 0.0;
  const bool external = s.has_external_forces();
  constexpr double anothers_mass = 1e-3;  // relative to its own, that a particle alone may see
  const double kept_alone = std::exp(-step.dt * s.extremes.wave_speed / h);
  const std::vector<GhostPlane> planes = ghost_planes<D>(s, tile.key);
  const Vector origin_later = grid_origin(s.boundaries, s.time + step.dt);
  std::vector<Lanes> motion = motion_of<D>(s, tile);
  Lanes* remapped = s.grid.tile(tile.number, 0);
  if (step.remap) std::fill_n(remapped, motion.size(), Lanes(0.0));
  Changes<D> flip, filter, state, advection, field_forces;
  Lanes internal(0.0), filter_heat(0.0);

  for_each_share(s, tile, [&](std::size_t number, Body& body, const Bin& bin) {
    Particles& ps = body.particles;
    const double into_heat =
        filter_heats(s, body) ? 0.5 * beta * (2.0 - beta) : 0.0;  // of the square of what is relative to the grid
    CellMeans<D> pressures;
    if (external) pressures = cell_pressures<D>(s.grid, body, bin, tile.position);
    for_each_eight(
        body.bins, bin, after_the_next_eight,
        {{ps.motion, L::Motion::position, 2 * D},
         {ps.load, L::Load::mass, 1},
         {ps.load, L::Load::half_width, 1},
         {ps.next_motion, 0, L::Motion::count},
         {ps.filter_heat, 0, 1}},
        [&](const Eight& eight, Requests& requests) {
          const Columns from(ps.motion, eight), load(ps.load, eight);
          Columns to(ps.next_motion, eight);
          const Vec x = read_vector<D>(from, L::Motion::position), v = read_vector<D>(from, L::Motion::velocity);
          const Lanes m = load[L::Load::mass];
          Weights<D> w = find_weights<G, basis>(on_grid(s.grid, x), load[L::Load::half_width], tile.position, h);
          const GatheredByChannel<D> grid = gather<Slope::lever, false>(w, nodes_of<D>(body, eight, motion.data()), requests);

          Vec v_new, x_new;
          Vec by_grid, by_filter, in_all, mean_by_grid, mean_by_filter, mean_in_all,
              way;  // impulses, mean velocities
          Lanes heat(0.0);
          const Lanes booked = eight.only_used(m);
          for (int a = 0; a < D; ++a) {
            const Lanes v_grid = grid.value[Channel::velocity + a], dv = grid.value[Channel::change + a];
            const Lanes v_flip = v[a] + dv, relative = v_flip - v_grid, filtered = -beta * relative;
            v_new[a] = v_flip + filtered;
            x_new[a] = x[a] + step.dt * v_grid;
            to.write(L::Motion::position + a, x_new[a]), to.write(L::Motion::velocity + a, v_new[a]);
            by_grid[a] = booked * dv, mean_by_grid[a] = v[a] + 0.5 * dv;
            by_filter[a] = booked * filtered, mean_by_filter[a] = v_flip + 0.5 * filtered;
            in_all[a] = booked * v_new[a], mean_in_all[a] = 0.5 * v_new[a];
            way[a] = x_new[a] - x[a];
            heat += into_heat * relative * relative;
          }
          Columns(ps.filter_heat, eight).write(0, heat);
          filter_heat += booked * heat;
          flip.add(by_grid, x, mean_by_grid), filter.add(by_filter, x, mean_by_filter);
          state.add(in_all, x_new, mean_in_all), advection.add(in_all, way, Vec{});
          // A particle that has its nodes to itself learns nothing about a velocity gradient from them: it would get
          // back the one that it gave, for ever, and a melt would stretch exponentially. A fragment comes to rest in
          // itself while sound crosses it.
          const LanesMask alone = Lanes(grid.value[Channel::mass]) <= (1.0 + anothers_mass) * m * own_weights<D>(planes, w);
          const Lanes kept = select(alone, Lanes(kept_alone), Lanes(1.0));
          std::array<Square, D> affine_momentum;
          for (Square& along : affine_momentum) along.fill(Lanes(0.0));
          std::array<Lanes, D * D> affine;
          for (int b = 0; b < D; ++b) {
            const Lanes per_spread = aflip ? kept / w.along[b].spread : Lanes(0.0);
            for (int a = 0; a < D; ++a) {
              const Lanes C = per_spread * Lanes(grid.slope[b][Channel::velocity + a]);
              affine_momentum[b][Channel::momentum + a] = m * C;
              affine[static_cast<std::size_t>(D * a + b)] = C;
            }
          }
          // It lasts into the next step, in which the particles are elsewhere.
          affine = referred<D>(affine, step.dt);
          for (int k = 0; k < D * D; ++k) to.write(L::Motion::affine + k, affine[static_cast<std::size_t>(k)]);

          if (external) {
            const Vec g = acceleration_fields(s, x);
            Vec impulse, mean;
            for (int a = 0; a < D; ++a) {
              impulse[a] = step.dt_velocity * booked * g[a];
              mean[a] = Lanes(grid.value[Channel::velocity + a]) - 0.5 * Lanes(grid.value[Channel::change + a]);
            }
            field_forces.add(impulse, x, mean);
            const auto slopes = gather<Slope::gradient, ring>(w, nodes_of<D>(body, eight, motion.data()), requests);
            internal -= step.dt_velocity * booked / load[L::Load::density] *
                        stress_power<G>(pushing_stress<D>(body, load, pressures, w), slopes);
          }

          if (step.remap) {
            reach_inside(planes, h, w);
            Square momentum;
            momentum.fill(Lanes(0.0));
            momentum[Channel::mass] = m;
            for (int a = 0; a < D; ++a) momentum[Channel::momentum + a] = m * v_new[a];
            momentum = transposed(momentum);
            for (Square& along : affine_momentum) along = transposed(along);
            const auto nodes = nodes_of<D>(body, eight, remapped);
            const auto slopes = [&](std::size_t i) {
              Slopes<D> slope;
              for (std::size_t a = 0; a < D; ++a)
                for (std::size_t k = 0; k < 3; ++k) slope[a][k] = Lanes(w.along[a].lever[k][i]) * affine_momentum[a][i];
              return slope;
            };
            scatter<D>(w, static_cast<std::size_t>(eight.used), momentum, slopes, nodes, requests);
          }
          list_leavers<D>(s, origin_later, eight, x_new, tile.position, moved[number], left[number]);
        });
    if (external)
      for_each_load<G, basis>(
          s, body, bin, tile.position, [&](const LoadedPoint& point, const Weights<D>& w, const Eight& one) {
            Requests none;
            const auto value = gather<Slope::gradient, false>(w, nodes_of<D>(body, one, motion.data()), none).value;
            Vector mean{};
            for (int a = 0; a < D; ++a)
              mean[static_cast<std::size_t>(a)] = value[Channel::velocity + a][0] - 0.5 * value[Channel::change + a][0];
            const Vector impulse = step.dt_velocity * point.force;
            tally.external += {dot(impulse, mean), impulse, cross(point.position, impulse)};
          });
  });
  tally.flip += flip.total(), tally.filter += filter.total(), tally.state += state.total();
  tally.external += field_forces.total();
  tally.advection.angular_momentum = advection.total().angular_momentum;
  for (int i = 0; i < 8; ++i) tally.internal += internal[i], tally.filter_heat += filter_heat[i];
  if (step.remap)
    for (int f = 0; f < s.grid.fields; ++f) fold<D>(s.boundaries, tile.key, s.grid.tile(tile.number, f));
}

}  // namespace

ParticleResult grid_to_particles(Simulation& s, const ParticleStep& step) {
  const Timed timed(s.times, Phase::grid_to_particles);
  const std::size_t count = s.grid.my_tiles.size(), bodies = s.bodies.size();
  ParticleResult result;
  result.tallies.resize(count);
  using Lists = std::vector<std::vector<std::uint32_t>>;
  std::vector<Lists> moved(count, Lists(bodies)), left(count, Lists(bodies));
  with_kernel(s, [&]<Geometry G, Basis basis>() {
    parallel_for_blocks(
        count, [&](std::size_t i) { from_tile<G, basis>(s, view(s.grid, i), step, result.tallies[i], moved[i], left[i]); });
  });
  result.moved.resize(bodies), result.left.resize(bodies);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t b = 0; b < bodies; ++b) {
      result.moved[b].insert(result.moved[b].end(), moved[i][b].begin(), moved[i][b].end());
      result.left[b].insert(result.left[b].end(), left[i][b].begin(), left[i][b].end());
    }
  return result;
}

}  // namespace brisance::simulator
