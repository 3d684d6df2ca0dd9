#include "simulator/parallel.hpp"
#include "simulator/solid/transfer.hpp"
#include "simulator/solid/transfer/ghost_planes.hpp"
#include "simulator/solid/transfer/loads.hpp"
#include "simulator/solid/transfer/pushing_stress.hpp"
#include "simulator/solid/transfer/wall_contact.hpp"

namespace brisance::simulator {

namespace {

template <Geometry G, Basis basis>
void to_tile(Simulation& s, const TileView& tile, Carry carry, double dt) {
  constexpr int D = dimensions_of<G>;
  using L = Layout<D>;
  const double h = s.grid.cell_size;
  const bool force = carry != Carry::motion;
  const bool affine = s.numerics.particle_velocity == ParticleVelocity::aflip;
  const bool walls = std::any_of(s.boundaries.begin(), s.boundaries.end(),
                                 [](const Boundary& b) { return b.kind == BoundaryKind::rigid_wall; });
  const bool has_field_force = s.body_force || dot(s.gravity, s.gravity) > 0.0;
  const std::vector<GhostPlane> planes = ghost_planes<D>(s, tile.key);
  Lanes* nodes = s.grid.tile(tile.number, 0);
  std::fill_n(nodes, s.grid.fields * Block<D>::tile_nodes, Lanes(0.0));
  for_each_share(s, tile, [&](std::size_t, const Body& body, const Bin& bin) {
    const Particles& ps = body.particles;
    CellMeans<D> pressures;
    if (force) pressures = cell_pressures<D>(s.grid, body, bin, tile.position);
    // Of the bin that comes next: already for the pressures all of its particles are read.
    for_each_eight(
        body.bins, bin, bin.end - bin.begin, {{ps.motion, 0, L::Motion::count}, {ps.load, 0, L::Load::count}},
        [&](const Eight& eight, Requests& requests) {
          const Columns from(ps.motion, eight), load(ps.load, eight);
          const auto x = read_vector<D>(from, L::Motion::position), v = read_vector<D>(from, L::Motion::velocity);
          const Lanes m = load[L::Load::mass], half_width = load[L::Load::half_width];
          Weights<D> w = find_weights<G, basis>(on_grid(s.grid, x), half_width, tile.position, h);
          reach_inside(planes, h, w);

          // By channel: what is carried by S, and what by its slope along each direction, affine momentum m C and stress -V
          // sigma.
          Square value;
          std::array<Square, D> slope;
          StoredPack hoop_force;
          value.fill(Lanes(0.0));
          for (Square& along : slope) along.fill(Lanes(0.0));
          value[Channel::mass] = m;
          for (int a = 0; a < D; ++a) value[Channel::momentum + a] = m * v[static_cast<std::size_t>(a)];
          if (affine)
            for (int a = 0; a < D; ++a)
              for (int b = 0; b < D; ++b) slope[b][Channel::momentum + a] = m * from[L::Motion::affine + D * a + b];
          if (force) {
            const SymmetricTensor<Lanes> f = (-m / load[L::Load::density]) * pushing_stress<D>(body, load, pressures, w);
            const std::array<std::array<Lanes, 3>, 3> columns = {{{f.xx, f.xy, f.xz}, {f.xy, f.yy, f.yz}, {f.xz, f.yz, f.zz}}};
            for (int b = 0; b < D; ++b)
              for (int a = 0; a < D; ++a) slope[b][Channel::force + a] = columns[b][a];
            hoop_force = f.zz;
          }
          if (force && has_field_force) {
            const auto g = acceleration_fields(s, x);
            for (int a = 0; a < D; ++a) value[Channel::force + a] = m * g[a];
          }

          value = transposed(value);
          for (Square& along : slope) along = transposed(along);
          const auto to = nodes_of<D>(body, eight, nodes);
          const auto slopes = [&](std::size_t i) {
            Slopes<D> along;
            for (std::size_t b = 0; b < D; ++b)
              for (std::size_t k = 0; k < 3; ++k)
                along[b][k] = halves(Lanes(w.along[b].lever[k][i]), Lanes(w.along[b].gradient[k][i])) * slope[b][i];
            if constexpr (G == Geometry::axisymmetric) {
              const Lanes f = pack(0.0, 0.0, 0.0, 0.0, hoop_force[i]);
              for (std::size_t k = 0; k < 3; ++k) along[0][k] = multiply_add(w.hoop[k][i], f, along[0][k]);
            }
            return along;
          };
          scatter<D>(w, static_cast<std::size_t>(eight.used), value, slopes, to, requests);
          if (walls) touch_walls<D>(s, body, eight, x, v, dt, half_width, w, tile.position, to);
        });
    if (force)
      for_each_load<G, basis>(s, body, bin, tile.position,
                              [&](const LoadedPoint& point, const Weights<D>& w, const Eight& one) {
                                Square value;
                                value[0] = pack(0.0, 0.0, 0.0, 0.0, point.force[0], point.force[1], point.force[2]);
                                const auto no_slopes = [&](std::size_t) { return Slopes<D>{}; };
                                Requests none;
                                scatter<D>(w, 1, value, no_slopes, nodes_of<D>(body, one, nodes), none);
                              });
  });
  for (int field = 0; field < s.grid.fields; ++field) fold<D>(s.boundaries, tile.key, s.grid.tile(tile.number, field));
}

}  // namespace

Vector acceleration_field(const Simulation& s, const Vector& position) {
  return s.body_force ? s.gravity + s.body_force(position, s.time) : s.gravity;
}

void particles_to_grid(Simulation& s, Carry carry, double dt) {
  const Timed timed(s.times, Phase::particles_to_grid);
  with_kernel(s, [&]<Geometry G, Basis basis>() {
    parallel_for_blocks(s.grid.my_tiles.size(), [&](std::size_t i) { to_tile<G, basis>(s, view(s.grid, i), carry, dt); });
  });
}

}  // namespace brisance::simulator
