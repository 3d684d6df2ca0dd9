#include "simulator/solid/transfer.hpp"

#include "simulator/parallel.hpp"
#include "simulator/solid/eight.hpp"
#include "simulator/solid/stencil.hpp"

namespace brisance::simulator {
namespace {

template <Geometry G>
inline constexpr int dimensions_of = G == Geometry::three_dimensional ? 3 : 2;

/// Calls f.template operator()<geometry, basis>() for those of the run.
template <class F>
auto with_kernel(const Simulation& s, F&& f) {
  const auto basis = [&]<Geometry G>() {
    return s.numerics.basis == Basis::ugimp ? f.template operator()<G, Basis::ugimp>()
                                            : f.template operator()<G, Basis::quadratic_spline>();
  };
  switch (s.geometry) {
    case Geometry::plane:
      return basis.template operator()<Geometry::plane>();
    case Geometry::axisymmetric:
      return basis.template operator()<Geometry::axisymmetric>();
    default:
      return basis.template operator()<Geometry::three_dimensional>();
  }
}

/// The bin of a body in a block, if it has particles there.
const Bin* find_bin(const Body& body, BlockKey block) {
  const auto& bins = body.bins.bins;
  const auto at = std::lower_bound(bins.begin(), bins.end(), block, [](const Bin& b, BlockKey key) { return b.block < key; });
  return at != bins.end() && at->block == block ? &*at : nullptr;
}

/// Tile of the grid with what the kernels need around it.
struct TileView {
  BlockKey key;
  BlockPosition position;
  std::size_t number;
};
TileView view(const Grid& grid, std::size_t i) {
  const auto t = static_cast<std::size_t>(grid.my_tiles[i]);
  return {grid.tile_block[t], block_position(grid.tile_block[t]), t};
}

template <class F>
void for_each_share(Simulation& s, const TileView& tile, F&& f) {
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    if (const Bin* bin = find_bin(s.bodies[b], tile.key)) f(b, s.bodies[b], *bin);
}

/// Positions with respect to the grid's origin, m.
template <std::size_t D>
std::array<Lanes, D> on_grid(const Grid& grid, std::array<Lanes, D> position) {
  for (std::size_t a = 0; a < D; ++a) position[a] -= grid.origin[a];
  return position;
}

/// The nodes that each of eight particles sees, from the first of the fields of their tile.
template <std::size_t D>
auto nodes_of(const Body& body, const Eight& eight, Lanes* fields) {
  return [&body, &eight, first = fields + body.field * Block<D>::tile_nodes](std::size_t i) {
    const auto& second = body.particles.second_field;
    return TwoFields{first, Block<D>::tile_nodes, second.empty() ? 0u : second[eight.particle[i]]};
  };
}

/// The motion of a tile's nodes, ghosts included: [field][node].
template <int D>
std::vector<Lanes> motion_of(const Simulation& s, const TileView& tile) {
  std::vector<Lanes> motion(static_cast<std::size_t>(s.grid.fields) * Block<D>::tile_nodes);
  for (int f = 0; f < s.grid.fields; ++f) {
    Lanes* nodes = motion.data() + f * Block<D>::tile_nodes;
    load_tile(s.grid, tile.number, f, nodes);
    unfold<D>(s.boundaries, tile.key, nodes);
  }
  return motion;
}

/// Means over the cells of a block, weighted by volume. A cell is what is nearest to one node: there the gradient of a
/// quadratic spline is linear, so a constant is the space below it.
template <std::size_t D>
class CellMeans {
 public:
  using Cells = std::array<int, 8>;  // of eight particles
  static Cells cells(const std::array<Lanes, D>& nearest) { return node_numbers(nearest, Block<D>::side); }

  void add(const Eight& eight, const Cells& cells, const Lanes& volume, const Lanes& value) {
    const StoredPack of_volume = volume, sum = volume * value;
    for (std::size_t i = 0; i < static_cast<std::size_t>(eight.used); ++i) {
      const auto cell = static_cast<std::size_t>(cells[i]);
      volume_[cell] += of_volume[i], sum_[cell] += sum[i];
    }
  }
  Lanes operator()(const Cells& cells) const {
    StoredPack volume, sum;
    for (std::size_t i = 0; i < 8; ++i) {
      const auto cell = static_cast<std::size_t>(cells[i]);
      volume.element[i] = volume_[cell], sum.element[i] = sum_[cell];
    }
    return Lanes(sum) / Lanes(volume);
  }

 private:
  std::array<double, 64> volume_{}, sum_{};
};

template <int D>
SymmetricTensor<Lanes> read_stress(const Columns& load) {
  const auto at = [&](int k) { return load[Layout<D>::Load::stress + k]; };
  if constexpr (D == 3)
    return {at(0), at(1), at(2), at(3), at(4), at(5)};
  else
    return {at(0), at(1), at(2), Lanes(0.0), Lanes(0.0), at(3)};
}

/// The pressure with artificial viscosity (Pa) of each cell of a tile, if the body wants pressures averaged.
template <int D>
CellMeans<D> cell_pressures(const Grid& grid, const Body& body, const Bin& bin, const BlockPosition& block) {
  using L = Layout<D>;
  CellMeans<D> means;
  if (!body.locking_cure) return means;
  for_each_eight(body.bins, bin,
                 {{body.particles.motion, L::Motion::position, D}, {body.particles.load, 0, L::Load::half_width}},
                 [&](const Eight& eight) {
                   const Columns motion(body.particles.motion, eight), load(body.particles.load, eight);
                   const Lanes pressure = load[L::Load::artificial_viscosity] - trace(read_stress<D>(load)) / 3.0;
                   const auto nearest =
                       nearest_in_block(on_grid(grid, read_vector<D>(motion, L::Motion::position)), block, grid.cell_size);
                   means.add(eight, CellMeans<D>::cells(nearest), load[L::Load::mass] / load[L::Load::density], pressure);
                 });
  return means;
}

/// The stress that pushes the grid (Pa): with artificial viscosity, and with the pressure of its cell if the body wants that.
template <int D>
SymmetricTensor<Lanes> pushing_stress(const Body& body, const Columns& load, const CellMeans<D>& pressures,
                                      const Weights<D>& w) {
  const SymmetricTensor<Lanes> sigma = read_stress<D>(load);
  const Lanes q = load[Layout<D>::Load::artificial_viscosity];
  if (!body.locking_cure) return add_to_diagonal(sigma, -q);
  const Lanes pressure = q - trace(sigma) / 3.0;
  return add_to_diagonal(sigma, pressure - q - pressures(CellMeans<D>::cells(w.nearest)));
}

/// Force per mass (m/s^2) at eight places.
template <std::size_t D>
std::array<Lanes, D> acceleration_fields(const Simulation& s, const std::array<Lanes, D>& position) {
  std::array<Lanes, D> b;
  for (std::size_t a = 0; a < D; ++a) b[a] = Lanes(s.gravity[a]);
  if (!s.body_force) return b;
  for (int i = 0; i < 8; ++i) {
    Vector x{};
    for (std::size_t a = 0; a < D; ++a) x[a] = position[a][i];
    const Vector of_one = acceleration_field(s, x);
    for (std::size_t a = 0; a < D; ++a) b[a].set(i, of_one[a]);
  }
  return b;
}

/// Where a loaded particle's surface is, and the force on it (N; per radian in the axisymmetric geometry).
struct LoadedPoint {
  Vector position{}, force{};
};
template <int D>
LoadedPoint loaded_point(const Simulation& s, const Body& body, int p, std::size_t load) {
  using L = Layout<D>;
  const double* motion = body.particles.motion.particle(p);
  const double* rest = body.particles.rest.particle(p);
  const double* F = rest + L::Rest::deformation_gradient * chunk_size;
  Tensor<double> f = Tensor<double>::identity();
  if constexpr (D == 3)
    f = {F[0], F[8], F[16], F[24], F[32], F[40], F[48], F[56], F[64]};
  else
    f.xx = F[0], f.xy = F[8], f.yx = F[16], f.yy = F[24], f.zz = F[32];
  Vector area0{};
  for (int a = 0; a < D; ++a)
    area0[static_cast<std::size_t>(a)] = rest[(body.particles.area() + static_cast<int>(load) * D + a) * chunk_size];
  // Nanson: da = J F^-T dA
  const Tensor<double> inv = inverse(f);
  const double J = determinant(f);
  const Vector area{J * (inv.xx * area0[0] + inv.yx * area0[1] + inv.zx * area0[2]),
                    J * (inv.xy * area0[0] + inv.yy * area0[1] + inv.zy * area0[2]),
                    J * (inv.xz * area0[0] + inv.yz * area0[1] + inv.zz * area0[2])};
  const double size0 = std::sqrt(dot(area0, area0));
  LoadedPoint point;
  for (int a = 0; a < D; ++a) point.position[static_cast<std::size_t>(a)] = motion[(L::Motion::position + a) * chunk_size];
  if (size0 == 0.0) return point;
  // The face lies half a particle away, along what was its normal.
  const Vector n = (body.particles.load.at(L::Load::half_width, p) / size0) * area0;
  point.position = point.position + Vector{f.xx * n[0] + f.xy * n[1] + f.xz * n[2], f.yx * n[0] + f.yy * n[1] + f.yz * n[2],
                                           f.zx * n[0] + f.zy * n[1] + f.zz * n[2]};
  const SurfaceLoad& l = body.loads[load];
  if (l.pressure) point.force = point.force - (*l.pressure)(s.time) * area;
  const double factor = l.amplitude ? (*l.amplitude)(s.time) : 1.0;  // a traction is per undeformed area
  point.force = point.force + (factor * size0) * l.traction;
  return point;
}

/// Weights of a point of a particle's surface at the nodes of the particle: a force on any other might find no mass there.
template <Geometry G, Basis basis, std::size_t D = dimensions_of<G>>
Weights<D> surface_weights(const Grid& grid, const Particles& ps, const Eight& one, const Vector& point,
                           const BlockPosition& block) {
  using L = Layout<D>;
  const double h = grid.cell_size;
  const Lanes half_width = Columns(ps.load, one)[L::Load::half_width];
  const auto particle = on_grid(grid, read_vector<D>(Columns(ps.motion, one), L::Motion::position));
  Weights<D> w = find_weights<G, basis>(particle, half_width, block, h);
  for (std::size_t a = 0; a < D; ++a) {
    // What uGIMP knows of a particle has its undeformed width.
    Lanes x(point[a] - grid.origin[a]);
    if (basis == Basis::ugimp) x = min(max(x, particle[a] - half_width), particle[a] + half_width);
    const Lanes xi = x / h - (w.nearest[a] + Lanes(block[a] * Block<D>::side));
    constexpr double no_width = 1e-9;
    w.along[a] = basis == Basis::quadratic_spline ? quadratic_spline(xi, h) : ugimp(xi, h, Lanes(no_width));
  }
  return w;
}

/// Calls f(force, place, weights, particle as an eight) for every force on the surface of a body's particles in a tile.
template <Geometry G, Basis basis, class F>
void for_each_load(const Simulation& s, const Body& body, const Bin& bin, const BlockPosition& block, F&& f) {
  constexpr int D = dimensions_of<G>;
  for (std::size_t l = 0; l < body.loads.size(); ++l)
    for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
      const Eight one(body.bins.order[i]);
      const LoadedPoint point = loaded_point<D>(s, body, static_cast<int>(body.bins.order[i]), l);
      if (dot(point.force, point.force) == 0.0) continue;
      f(point, surface_weights<G, basis>(s.grid, body.particles, one, point.position, block), one);
    }
}

/// The particles that reach a wall within a step of dt (s): the half axis of their deformed shape is not less than their
/// distance at the end. One that is flat and fast would otherwise be beyond the wall before it has touched it.
template <int D>
LanesMask reaching(const Simulation& s, const Body& body, const Eight& eight, const std::array<Lanes, D>& position,
                   const std::array<Lanes, D>& velocity, double dt, const Lanes& half_width, const Boundary& wall) {
  using L = Layout<D>;
  const double h = s.grid.cell_size;
  const auto axis = static_cast<std::size_t>(wall.axis);
  const Lanes approach = dt * max((velocity_of(wall, s.time) - velocity[axis]) * wall.inward, Lanes(0.0));
  const Lanes distance = (position[axis] - s.grid.origin[axis] - wall.position) * wall.inward - approach;
  const LanesMask near = distance <= 2.0 * h;
  if (none(near)) return near;
  const Columns rest(body.particles.rest, eight);
  Lanes stretch(0.0);  // of the row of F that belongs to the normal
  for (int a = 0; a < D; ++a) {
    const Lanes F = rest[L::Rest::deformation_gradient + wall.axis * D + a];
    stretch += F * F;
  }
  constexpr double round_off = 1e-9;
  return near & (distance <= half_width * sqrt(stretch) + round_off * h);
}

/// Tells the nodes on the planes of the rigid walls that particles reach that they do.
template <int D, class FieldOf>
void touch_walls(const Simulation& s, const Body& body, const Eight& eight, const std::array<Lanes, D>& position,
                 const std::array<Lanes, D>& velocity, double dt, const Lanes& half_width, const Weights<D>& w,
                 const BlockPosition& block, const FieldOf& to) {
  using B = Block<D>;
  for (const Boundary& wall : s.boundaries) {
    if (wall.kind != BoundaryKind::rigid_wall) continue;
    const auto axis = static_cast<std::size_t>(wall.axis);
    const LanesMask reached = reaching<D>(s, body, eight, position, velocity, dt, half_width, wall);
    if (none(reached)) continue;
    for (std::size_t p = 0; p < static_cast<std::size_t>(eight.used); ++p) {
      if (!reached[static_cast<int>(p)]) continue;
      // The wall's place in the stencil.
      const int plane = wall.node - block[axis] * B::side - static_cast<int>(w.nearest[axis][static_cast<int>(p)]) + 1;
      const TwoFields fields = to(p);
      for (int k = 0; k < (D == 3 ? 3 : 1); ++k)
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) {
            const int at[3] = {i, j, k};
            if (at[axis] != plane) continue;
            double weight = 1.0;
            for (std::size_t a = 0; a < D; ++a) weight *= w.along[a].value[static_cast<std::size_t>(at[a])][p];
            if (weight == 0.0) continue;
            Lanes& node = fields.at(i + 3 * (j + 3 * k))[w.corner[p] + B::tile_node(i, j, k)];
            if (!touches(node[Channel::touch], wall)) node.set(Channel::touch, node[Channel::touch] + touch_number(wall));
          }
    }
  }
}

/// A plane with ghosts as a tile sees it: the ghosts are among the nodes of a particle whose nearest node is on the plane.
struct GhostPlane {
  std::size_t axis;
  int plane, inward;  // plane: index in the block
  bool mirror;
};
template <int D>
std::vector<GhostPlane> ghost_planes(const Simulation& s, BlockKey block) {
  std::vector<GhostPlane> planes;
  for (const Boundary& b : s.boundaries)
    if (const int plane = b.has_ghosts() ? local_plane<D>(b, block) : -1; plane >= 0)
      planes.push_back({static_cast<std::size_t>(b.axis), plane, b.inward, b.is_mirror()});
  return planes;
}

/// Lever arms that, folded, are those of the folded weights, N (x_i - x): then a particle's affine motion arrives at the nodes
/// as the linear field that it is. With the arms of the ghosts, a particle at distance y from the plane would leave the node
/// inside with the velocity v + C h^2/(4 y), whatever the step: near the plane its gradient would grow from step to step.
template <std::size_t D>
void reach_inside(const std::vector<GhostPlane>& planes, double h, Weights<D>& w) {
  for (const GhostPlane& p : planes) {
    if (p.mirror) continue;  // what a mirror adds is the motion of the mirrored particle
    const LanesMask beside = w.nearest[p.axis] == static_cast<double>(p.plane);
    if (none(beside)) continue;
    const auto ghost = static_cast<std::size_t>(1 - p.inward), inside = static_cast<std::size_t>(1 + p.inward);
    LineWeights& along = w.along[p.axis];
    const Lanes moved = select(beside, (p.inward * h) * Lanes(along.value[ghost]), Lanes(0.0));
    along.lever[ghost] = Lanes(along.lever[ghost]) + moved, along.lever[inside] = Lanes(along.lever[inside]) - moved;
  }
}

/// Sums of the squares of particles' folded weights: what each sees of a field that it alone has made with mass one.
template <std::size_t D>
Lanes own_weights(const std::vector<GhostPlane>& planes, const Weights<D>& w) {
  Lanes product(1.0);
  for (std::size_t a = 0; a < D; ++a) {
    std::array<Lanes, 3> N{Lanes(w.along[a].value[0]), Lanes(w.along[a].value[1]), Lanes(w.along[a].value[2])};
    for (const GhostPlane& p : planes) {
      if (p.axis != a) continue;
      Lanes& of_ghost = N[static_cast<std::size_t>(1 - p.inward)];
      const Lanes ghost = select(w.nearest[a] == static_cast<double>(p.plane), of_ghost, Lanes(0.0));
      N[1] += (p.mirror ? 0.0 : 2.0) * ghost;
      N[static_cast<std::size_t>(1 + p.inward)] += (p.mirror ? 1.0 : -1.0) * ghost;
      of_ghost -= ghost;
    }
    product *= N[0] * N[0] + N[1] * N[1] + N[2] * N[2];
  }
  return product;
}

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
  const Lanes momentum_channels = pack(0, 1, 1, 1, 0, 0, 0, 0), force_channels = pack(0, 0, 0, 0, 1, 1, 1, 0);
  const std::vector<GhostPlane> planes = ghost_planes<D>(s, tile.key);
  Lanes* nodes = s.grid.tile(tile.number, 0);
  std::fill_n(nodes, s.grid.fields * Block<D>::tile_nodes, Lanes(0.0));
  for_each_share(s, tile, [&](std::size_t, const Body& body, const Bin& bin) {
    const Particles& ps = body.particles;
    CellMeans<D> pressures;
    if (force) pressures = cell_pressures<D>(s.grid, body, bin, tile.position);
    for_each_eight(body.bins, bin, {{ps.motion, 0, L::Motion::count}}, [&](const Eight& eight) {
      const Columns from(ps.motion, eight), load(ps.load, eight);
      const auto x = read_vector<D>(from, L::Motion::position), v = read_vector<D>(from, L::Motion::velocity);
      const Lanes m = load[L::Load::mass], half_width = load[L::Load::half_width];
      Weights<D> w = find_weights<G, basis>(on_grid(s.grid, x), half_width, tile.position, h);
      reach_inside(planes, h, w);

      // By channel: what is carried by S, and what by its slope along each direction, affine momentum m C and stress -V sigma.
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
        for (std::size_t b = 0; b < D; ++b) {
          const Lanes A = momentum_channels * slope[b][i], S = force_channels * slope[b][i];
          for (std::size_t k = 0; k < 3; ++k)
            along[b][k] = multiply_add(w.along[b].lever[k][i], A, Lanes(w.along[b].gradient[k][i]) * S);
        }
        if constexpr (G == Geometry::axisymmetric) {
          const Lanes f = pack(0.0, 0.0, 0.0, 0.0, hoop_force[i]);
          for (std::size_t k = 0; k < 3; ++k) along[0][k] = multiply_add(w.hoop[k][i], f, along[0][k]);
        }
        return along;
      };
      scatter<D>(w, static_cast<std::size_t>(eight.used), value, slopes, to);
      if (walls) touch_walls<D>(s, body, eight, x, v, dt, half_width, w, tile.position, to);
    });
    if (force)
      for_each_load<G, basis>(s, body, bin, tile.position,
                              [&](const LoadedPoint& point, const Weights<D>& w, const Eight& one) {
                                Square value;
                                value[0] = pack(0.0, 0.0, 0.0, 0.0, point.force[0], point.force[1], point.force[2]);
                                const auto no_slopes = [&](std::size_t) { return Slopes<D>{}; };
                                scatter<D>(w, 1, value, no_slopes, nodes_of<D>(body, one, nodes));
                              });
  });
  for (int field = 0; field < s.grid.fields; ++field) fold<D>(s.boundaries, tile.key, s.grid.tile(tile.number, field));
}

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

/// A velocity gradient with respect to places x as one with respect to x + t v(x). Its components as the columns of tensors; an
/// affine field in the plane has none across it.
template <int D, std::size_t components>
[[gnu::flatten]] std::array<Lanes, components> referred(const std::array<Lanes, components>& l, double t) {
  Tensor<Lanes> L;
  if constexpr (D == 3) {
    L = {l[0], l[1], l[2], l[3], l[4], l[5], l[6], l[7], l[8]};
  } else {
    L.xx = l[0], L.xy = l[1], L.yx = l[2], L.yy = l[3];
    if constexpr (components == 5) L.zz = l[4];
  }
  L = L * inverse(Tensor<Lanes>::identity() + Lanes(t) * L);
  if constexpr (D == 3)
    return {L.xx, L.xy, L.xz, L.yx, L.yy, L.yz, L.zx, L.zy, L.zz};
  else if constexpr (components == 5)
    return {L.xx, L.xy, L.yx, L.yy, L.zz};
  else
    return {L.xx, L.xy, L.yx, L.yy};
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
        body.bins, bin,
        {{ps.motion, L::Motion::position, 2 * D},
         {ps.load, L::Load::mass, 1},
         {ps.load, L::Load::half_width, 1},
         {ps.next_motion, 0, L::Motion::count},
         {ps.filter_heat, 0, 1}},
        [&](const Eight& eight) {
          const Columns from(ps.motion, eight), load(ps.load, eight);
          Columns to(ps.next_motion, eight);
          const Vec x = read_vector<D>(from, L::Motion::position), v = read_vector<D>(from, L::Motion::velocity);
          const Lanes m = load[L::Load::mass];
          Weights<D> w = find_weights<G, basis>(on_grid(s.grid, x), load[L::Load::half_width], tile.position, h);
          const GatheredByChannel<D> grid = gather<Slope::lever, false>(w, nodes_of<D>(body, eight, motion.data()));

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
            const auto slopes = gather<Slope::gradient, ring>(w, nodes_of<D>(body, eight, motion.data()));
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
            scatter<D>(w, static_cast<std::size_t>(eight.used), momentum, slopes, nodes);
          }
          list_leavers<D>(s, origin_later, eight, x_new, tile.position, moved[number], left[number]);
        });
    if (external)
      for_each_load<G, basis>(
          s, body, bin, tile.position, [&](const LoadedPoint& point, const Weights<D>& w, const Eight& one) {
            const auto value = gather<Slope::gradient, false>(w, nodes_of<D>(body, one, motion.data())).value;
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

template <Geometry G, Basis basis>
double gradients(Simulation& s, const TileView& tile, double later) {
  constexpr int D = dimensions_of<G>;
  constexpr bool ring = G == Geometry::axisymmetric;
  constexpr int diagonal[] = {0, D == 3 ? 4 : 3, D == 3 ? 8 : 4};
  using L = Layout<D>;
  using Gradient = std::array<Lanes, L::tensor_components>;
  struct OfEight {
    Gradient gradient;
    std::array<int, 8> cells;
  };
  const auto trace_of = [&](const Gradient& l) { return l[diagonal[0]] + l[diagonal[1]] + l[diagonal[2]]; };
  const double h = s.grid.cell_size;
  std::vector<Lanes> motion = motion_of<D>(s, tile);
  std::vector<OfEight> found;
  Lanes largest_square(0.0);
  for_each_share(s, tile, [&](std::size_t, Body& body, const Bin& bin) {
    Particles& ps = body.particles;
    CellMeans<D> rates;
    found.clear(), found.reserve((bin.end - bin.begin + 7) / 8);
    for_each_eight(body.bins, bin,
                   {{ps.motion, L::Motion::position, D},
                    {ps.load, L::Load::mass, 2},
                    {ps.load, L::Load::half_width, 1},
                    {ps.gradient, 0, L::tensor_components}},
                   [&](const Eight& eight) {
                     const Columns load(ps.load, eight);
                     const auto x = on_grid(s.grid, read_vector<D>(Columns(ps.motion, eight), L::Motion::position));
                     const Weights<D> w = find_weights<G, basis>(x, load[L::Load::half_width], tile.position, h);
                     const auto grid = VelocityGradients<D>::template gather<ring>(w, nodes_of<D>(body, eight, motion.data()));
                     OfEight& of = found.emplace_back();
                     of.cells = CellMeans<D>::cells(w.nearest);
                     for (std::size_t a = 0; a < D; ++a)
                       for (std::size_t b = 0; b < D; ++b) of.gradient[D * a + b] = grid(a, b);
                     if constexpr (ring) of.gradient[4] = grid.hoop();
                     if (later != 0.0) of.gradient = referred<D>(of.gradient, later);
                     if (body.locking_cure)
                       rates.add(eight, of.cells, load[L::Load::mass] / load[L::Load::density], trace_of(of.gradient));
                   });
    const OfEight* of = found.data();
    for_each_eight(body.bins, bin, {}, [&](const Eight& eight) {
      Gradient l = of->gradient;
      if (body.locking_cure) {
        const Lanes correction = (rates(of->cells) - trace_of(l)) / 3.0;
        for (const int k : diagonal) l[k] += correction;
      }
      Columns to(ps.gradient, eight);
      Lanes square(0.0);
      for (std::size_t k = 0; k < l.size(); ++k) square += l[k] * l[k], to.write(static_cast<int>(k), l[k]);
      constexpr double not_a_number = 1e300;  // is the largest of all
      largest_square = max(largest_square, select(square < not_a_number, square, Lanes(not_a_number)));
      ++of;
    });
  });
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) largest = std::max(largest, std::sqrt(largest_square[i]));
  return largest;
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

double velocity_gradients(Simulation& s, double later) {
  const Timed timed(s.times, Phase::velocity_gradients);
  std::vector<double> largest(s.grid.my_tiles.size());
  with_kernel(s, [&]<Geometry G, Basis basis>() {
    parallel_for_blocks(largest.size(), [&](std::size_t i) { largest[i] = gradients<G, basis>(s, view(s.grid, i), later); });
  });
  return s.domain->maximum(largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end()));
}

}  // namespace brisance::simulator
