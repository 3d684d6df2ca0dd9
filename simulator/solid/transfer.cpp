#include "simulator/solid/transfer.hpp"

#include "simulator/parallel.hpp"
#include "simulator/solid/basis.hpp"
#include "simulator/solid/packs.hpp"

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

Vector padded(const auto& v) {
  Vector r{};
  std::copy(v.begin(), v.end(), r.begin());
  return r;
}

/// Eight numbers by channel, to be read and written one at a time.
struct alignas(64) Channels {
  std::array<double, 8> c{};
  Lanes lanes() const { return Lanes::load(c.data()); }
  static Channels of(const Lanes& a) {
    Channels r;
    a.store(r.c.data());
    return r;
  }
};

template <int D>
std::array<double, D> read_vector(const double* columns) {
  std::array<double, D> v;
  for (int a = 0; a < D; ++a) v[a] = columns[a * chunk_size];
  return v;
}

/// The nodes a particle sees: those of its field's tile, or, where its bit of the mask is set, of the next field's.
struct OneField {
  Lanes* first;
  Lanes* at(int /*n*/) const { return first; }
};
struct TwoFields {
  Lanes* first;
  std::ptrdiff_t to_second;
  std::uint32_t second;  // bit n: node n of the stencil (27 or 9 nodes, x fastest)
  Lanes* at(int n) const { return first + ((second >> n) & 1u) * to_second; }
};

/// Adds value S + sum_a slope[a]_i to the nodes, where slope[a] varies along direction a and carries S along the others.
template <int D, class Field>
[[gnu::always_inline]] inline void scatter_to(const Weights& w, const Lanes& value,
                                              const std::array<std::array<Lanes, 3>, D>& slope, const Field& to) {
  using B = Block<D>;
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    Lanes in_plane = value;
    double Sz = 1.0;
    if constexpr (D == 3) {
      Sz = w.value[k][2];
      in_plane = multiply_add(Sz, value, slope[2][k]);
    }
    for (int j = 0; j < 3; ++j) {
      const double Sy = w.value[j][1], SySz = Sy * Sz;
      const Lanes in_row = multiply_add(Sy, in_plane, Lanes(Sz) * slope[1][j]);
      const int row = B::tile_node(w.base[0], w.base[1] + j, D == 3 ? w.base[2] + k : 0);
      for (int i = 0; i < 3; ++i) {
        Lanes& node = to.at(i + 3 * (j + 3 * k))[row + i];
        node = multiply_add(w.value[i][0], in_row, multiply_add(SySz, slope[0][i], node));
      }
    }
  }
}
template <int D>
[[gnu::always_inline]] inline void scatter(const Weights& w, const Lanes& value,
                                           const std::array<std::array<Lanes, 3>, D>& slope, const TwoFields& to) {
  if (to.second == 0)
    scatter_to<D>(w, value, slope, OneField{to.first});
  else
    scatter_to<D>(w, value, slope, to);
}

/// A sum over the nodes with the weights S, and with S along all directions but one, where another weight stands.
template <int D>
struct Gathered {
  Lanes value;
  std::array<Lanes, D> slope;
  Lanes hoop;
};
enum class Slope { lever, gradient };

template <Slope kind, bool hoop, int D, class Field>
[[gnu::always_inline]] inline Gathered<D> gather_from(const Weights& w, const Field& from) {
  using B = Block<D>;
  const auto& along = kind == Slope::lever ? w.lever : w.gradient;
  Gathered<D> sum;
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    Lanes plane(0.0), plane_x(0.0), plane_y(0.0), plane_hoop(0.0);
    for (int j = 0; j < 3; ++j) {
      const int row = B::tile_node(w.base[0], w.base[1] + j, D == 3 ? w.base[2] + k : 0);
      Lanes in_row(0.0), in_row_x(0.0), in_row_hoop(0.0);
      for (int i = 0; i < 3; ++i) {
        const Lanes& node = from.at(i + 3 * (j + 3 * k))[row + i];
        in_row = multiply_add(w.value[i][0], node, in_row);
        in_row_x = multiply_add(along[i][0], node, in_row_x);
        if constexpr (hoop) in_row_hoop = multiply_add(w.hoop[i], node, in_row_hoop);
      }
      const double Sy = w.value[j][1];
      plane = multiply_add(Sy, in_row, plane), plane_x = multiply_add(Sy, in_row_x, plane_x);
      plane_y = multiply_add(along[j][1], in_row, plane_y);
      if constexpr (hoop) plane_hoop = multiply_add(Sy, in_row_hoop, plane_hoop);
    }
    if constexpr (D == 3) {
      const double Sz = w.value[k][2];
      sum.value = multiply_add(Sz, plane, sum.value), sum.slope[0] = multiply_add(Sz, plane_x, sum.slope[0]);
      sum.slope[1] = multiply_add(Sz, plane_y, sum.slope[1]), sum.slope[2] = multiply_add(along[k][2], plane, sum.slope[2]);
    } else {
      sum.value = plane, sum.slope[0] = plane_x, sum.slope[1] = plane_y, sum.hoop = plane_hoop;
    }
  }
  return sum;
}
template <Slope kind, bool hoop, int D>
[[gnu::always_inline]] inline Gathered<D> gather(const Weights& w, const TwoFields& from) {
  return from.second == 0 ? gather_from<kind, hoop, D>(w, OneField{from.first}) : gather_from<kind, hoop, D>(w, from);
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

std::uint32_t second_field(const Particles& p, std::uint32_t i) {
  return p.second_field.empty() ? 0u : p.second_field[i];
}

/// Means over the cells of a block, weighted by volume. A cell is what is nearest to one node: there the gradient of a
/// quadratic spline is linear, so a constant is the space below it.
template <int D>
class CellMeans {
 public:
  /// The cell of a particle whose stencil in the tile is known.
  static int cell(const std::array<int, 3>& base) { return Block<D>::node(base[0], base[1], D == 3 ? base[2] : 0); }
  static int cell(const std::array<double, D>& position, const BlockPosition& block, double inverse_h) {
    std::array<int, 3> n{};
    for (int a = 0; a < D; ++a) n[a] = nearest_node(position[a], inverse_h).node - block[a] * Block<D>::side;
    return Block<D>::node(n[0], n[1], n[2]);
  }
  void add(int cell, double volume, double value) { volume_[cell] += volume, sum_[cell] += volume * value; }
  double operator()(int cell) const { return sum_[cell] / volume_[cell]; }

 private:
  std::array<double, 64> volume_{}, sum_{};
};

/// Pressure with artificial viscosity (Pa), from the columns of `load`.
template <int D>
double total_pressure(const double* load) {
  using L = typename Layout<D>::Load;
  const double* sigma = load + L::stress * chunk_size;
  return load[L::artificial_viscosity * chunk_size] - (sigma[0] + sigma[chunk_size] + sigma[2 * chunk_size]) / 3.0;
}

template <int D>
CellMeans<D> cell_pressures(const Body& body, const Bin& bin, const BlockPosition& block, double inverse_h) {
  using L = Layout<D>;
  CellMeans<D> means;
  for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
    const int p = static_cast<int>(body.bins.order[i]);
    const double* load = body.particles.load.particle(p);
    const double volume = load[L::Load::mass * chunk_size] / load[L::Load::density * chunk_size];
    means.add(CellMeans<D>::cell(read_vector<D>(body.particles.motion.particle(p)), block, inverse_h), volume,
              total_pressure<D>(load));
  }
  return means;
}

/// The stress that pushes the grid (Pa): with artificial viscosity, and with the pressure of its cell where `pressure` is
/// given.
template <int D>
SymmetricTensor<double> pushing_stress(const double* load, const double* pressure) {
  using L = typename Layout<D>::Load;
  const auto at = [&](int k) { return load[(L::stress + k) * chunk_size]; };
  SymmetricTensor<double> sigma{at(0), at(1), at(2), D == 3 ? at(3) : 0.0, D == 3 ? at(4) : 0.0, D == 3 ? at(5) : at(3)};
  const double q = load[L::artificial_viscosity * chunk_size];
  return add_to_diagonal(sigma, pressure ? total_pressure<D>(load) - q - *pressure : -q);
}

/// Where a loaded particle's surface is, and the force on it (N; per radian in the axisymmetric geometry).
template <int D>
struct LoadedPoint {
  std::array<double, D> position;
  Vector force;
};
template <int D>
LoadedPoint<D> loaded_point(const Simulation& s, const Body& body, int p, std::size_t load) {
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
  LoadedPoint<D> point{read_vector<D>(motion), {}};
  if (size0 == 0.0) return point;
  // The face lies half a particle away, along what was its normal.
  const Vector n = (body.particles.load.at(L::Load::half_width, p) / size0) * area0;
  const Vector step{f.xx * n[0] + f.xy * n[1] + f.xz * n[2], f.yx * n[0] + f.yy * n[1] + f.yz * n[2],
                    f.zx * n[0] + f.zy * n[1] + f.zz * n[2]};
  for (int a = 0; a < D; ++a) point.position[a] += step[static_cast<std::size_t>(a)];
  const SurfaceLoad& l = body.loads[load];
  if (l.pressure) point.force = point.force - (*l.pressure)(s.time) * area;
  const double factor = l.amplitude ? (*l.amplitude)(s.time) : 1.0;  // a traction is per undeformed area
  point.force = point.force + (factor * size0) * l.traction;
  return point;
}

/// Weights of a point of a particle's surface at the nodes of the particle: a force on any other might find no mass there.
template <Geometry G, Basis basis, std::size_t D = dimensions_of<G>>
void find_surface_weights(const Particles& ps, int p, const std::array<double, D>& point, const BlockPosition& block, double h,
                          Weights& w) {
  using L = Layout<D>;
  const double half_width = ps.load.at(L::Load::half_width, p);
  const auto particle = read_vector<D>(ps.motion.particle(p));
  find_weights<G, basis>(particle, half_width, block, h, w);
  std::array<double, 3> xi{};
  for (std::size_t a = 0; a < D; ++a) {
    // What uGIMP knows of a particle has its undeformed width.
    const double x =
        basis == Basis::ugimp ? std::clamp(point[a], particle[a] - half_width, particle[a] + half_width) : point[a];
    xi[a] = x / h - (block[a] * Block<D>::side + w.base[a]);
  }
  const Lanes offsets = pack(xi[0], xi[1], xi[2], 0.0);
  constexpr double no_width = 1e-9;
  if constexpr (basis == Basis::quadratic_spline)
    quadratic_spline(offsets, h, w);
  else
    ugimp(offsets, h, no_width, w);
}

/// Whether a particle reaches a rigid wall within a step of dt (s): the half axis of its deformed shape is not less than its
/// distance at the end. One that is flat and fast would otherwise be beyond the wall before it has touched it.
template <int D>
bool touches_wall(const Simulation& s, const Body& body, int p, const std::array<double, D>& position,
                  const std::array<double, D>& velocity, double dt) {
  using L = Layout<D>;
  for (const Boundary& b : s.boundaries) {
    if (b.kind != BoundaryKind::rigid_wall) continue;
    const double approach = std::max(-velocity[b.axis] * b.inward, 0.0) * dt;
    const double distance = (position[b.axis] - b.position) * b.inward - approach;
    if (distance > 2.0 * s.grid.cell_size) continue;
    const double* F = body.particles.rest.particle(p) + L::Rest::deformation_gradient * chunk_size + b.axis * D * chunk_size;
    double stretch = 0.0;  // of the row of F that belongs to the normal
    for (int a = 0; a < D; ++a) stretch += F[a * chunk_size] * F[a * chunk_size];
    constexpr double round_off = 1e-9;
    if (distance <= body.particles.load.at(L::Load::half_width, p) * std::sqrt(stretch) + round_off * s.grid.cell_size)
      return true;
  }
  return false;
}

/// A plane with ghosts as a tile sees it: the ghosts are among the nodes of a particle whose nearest node is on the plane.
struct GhostPlane {
  std::size_t axis;
  int plane, inward;  // plane: local index, as the base of a stencil
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
void reach_inside(const std::vector<GhostPlane>& planes, double h, Weights& w) {
  for (const GhostPlane& p : planes) {
    if (p.mirror || w.base[p.axis] != p.plane) continue;  // what a mirror adds is the motion of the mirrored particle
    const auto ghost = static_cast<std::size_t>(1 - p.inward), inside = static_cast<std::size_t>(1 + p.inward);
    const double moved = w.value[ghost][p.axis] * p.inward * h;
    w.lever[ghost][p.axis] += moved, w.lever[inside][p.axis] -= moved;
  }
}

/// Sum of the squares of a particle's folded weights: what it sees of a field that it alone has made with mass one.
template <int D>
double own_weight(const std::vector<GhostPlane>& planes, const Weights& w) {
  double product = 1.0;
  for (std::size_t a = 0; a < D; ++a) {
    std::array<double, 3> N{w.value[0][a], w.value[1][a], w.value[2][a]};
    for (const GhostPlane& p : planes) {
      if (p.axis != a || w.base[a] != p.plane) continue;
      double& ghost = N[static_cast<std::size_t>(1 - p.inward)];
      N[1] += p.mirror ? 0.0 : 2.0 * ghost;
      N[static_cast<std::size_t>(1 + p.inward)] += p.mirror ? ghost : -ghost;
      ghost = 0.0;
    }
    product *= N[0] * N[0] + N[1] * N[1] + N[2] * N[2];
  }
  return product;
}

template <Geometry G, Basis basis>
void to_tile(Simulation& s, const TileView& tile, Carry carry, double dt) {
  constexpr int D = dimensions_of<G>;
  using L = Layout<D>;
  const double h = s.grid.cell_size, inverse_h = 1.0 / h;
  const bool motion = carry != Carry::force, force = carry != Carry::motion;
  const bool affine = s.numerics.particle_velocity == ParticleVelocity::aflip;
  const bool walls = std::any_of(s.boundaries.begin(), s.boundaries.end(),
                                 [](const Boundary& b) { return b.kind == BoundaryKind::rigid_wall; });
  const bool has_field_force = s.body_force || dot(s.gravity, s.gravity) > 0.0;
  const Lanes momentum_channels = pack(0, 1, 1, 1, 0, 0, 0, 0), force_channels = pack(0, 0, 0, 0, 1, 1, 1, 0);
  const std::size_t length = static_cast<std::size_t>(s.grid.fields) * Block<D>::tile_nodes;
  const std::vector<GhostPlane> planes = ghost_planes<D>(s, tile.key);
  Weights w;
  Lanes* nodes = s.grid.tile(tile.number, 0);
  std::fill(nodes, nodes + length, Lanes(0.0));
  for_each_share(s, tile, [&](std::size_t, const Body& body, const Bin& bin) {
    const Particles& ps = body.particles;
    CellMeans<D> pressures;
    if (force && body.locking_cure) pressures = cell_pressures<D>(body, bin, tile.position, inverse_h);
    for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
      const std::uint32_t p = body.bins.order[i];
      const double* from = ps.motion.particle(static_cast<int>(p));
      const double* load = ps.load.particle(static_cast<int>(p));
      const auto x = read_vector<D>(from), v = read_vector<D>(from + L::Motion::velocity * chunk_size);
      const double m = load[L::Load::mass * chunk_size];
      find_weights<G, basis>(x, load[L::Load::half_width * chunk_size], tile.position, h, w);
      const TwoFields to{s.grid.tile(tile.number, body.field), Block<D>::tile_nodes, second_field(ps, p)};

      // Channels of momentum and force, by direction: affine momentum m C and stress -V sigma.
      std::array<double, 3> field_force{}, mv{};
      double touch = 0.0;
      for (int a = 0; a < D; ++a) mv[a] = motion ? m * v[a] : 0.0;
      SymmetricTensor<double> f;  // -V sigma
      if (force) {
        double pressure = 0.0;
        if (body.locking_cure) pressure = pressures(CellMeans<D>::cell(w.base));
        f = (-m / load[L::Load::density * chunk_size]) * pushing_stress<D>(load, body.locking_cure ? &pressure : nullptr);
        if (has_field_force) {
          const Vector b = acceleration_field(s, padded(x));
          for (std::size_t a = 0; a < D; ++a) field_force[a] = m * b[a];
        }
      }
      if (walls && touches_wall<D>(s, body, static_cast<int>(p), x, v, dt)) touch = 1.0;
      const double mC = motion && affine ? m : 0.0;
      const auto C = [&](int a, int b) { return mC * from[(L::Motion::affine + D * a + b) * chunk_size]; };
      const Lanes value = pack(m, mv[0], mv[1], mv[2], field_force[0], field_force[1], field_force[2], touch);
      std::array<Lanes, D> both;
      if constexpr (D == 3)
        both = {pack(0.0, C(0, 0), C(1, 0), C(2, 0), f.xx, f.xy, f.xz), pack(0.0, C(0, 1), C(1, 1), C(2, 1), f.xy, f.yy, f.yz),
                pack(0.0, C(0, 2), C(1, 2), C(2, 2), f.xz, f.yz, f.zz)};
      else
        both = {pack(0.0, C(0, 0), C(1, 0), 0.0, f.xx, f.xy), pack(0.0, C(0, 1), C(1, 1), 0.0, f.xy, f.yy)};
      reach_inside(planes, h, w);
      std::array<std::array<Lanes, 3>, D> slope;
      for (int a = 0; a < D; ++a) {
        const Lanes A = momentum_channels * both[a], S = force_channels * both[a];
        for (int k = 0; k < 3; ++k) slope[a][k] = multiply_add(w.lever[k][a], A, Lanes(w.gradient[k][a]) * S);
      }
      if constexpr (G == Geometry::axisymmetric)
        for (int k = 0; k < 3; ++k) slope[0][k] = multiply_add(w.hoop[k], pack(0.0, 0.0, 0.0, 0.0, f.zz), slope[0][k]);
      scatter<D>(w, value, slope, to);
    }
    if (!force) return;
    for (std::size_t l = 0; l < body.loads.size(); ++l)
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
        const std::uint32_t p = body.bins.order[i];
        const LoadedPoint<D> point = loaded_point<D>(s, body, static_cast<int>(p), l);
        if (dot(point.force, point.force) == 0.0) continue;
        const Lanes value = pack(0.0, 0.0, 0.0, 0.0, point.force[0], point.force[1], point.force[2]);
        find_surface_weights<G, basis>(ps, static_cast<int>(p), point.position, tile.position, h, w);
        scatter<D>(w, value, {}, {s.grid.tile(tile.number, body.field), Block<D>::tile_nodes, second_field(ps, p)});
      }
  });
  for (int field = 0; field < s.grid.fields; ++field) fold<D>(s.boundaries, tile.key, s.grid.tile(tile.number, field));
}

/// The books of the particles of a tile. Four accounts stand side by side in lanes: change by the grid, by the filter, the
/// state at the end, and the motion across itself.
template <std::size_t D>
class ParticleBooks {
 public:
  using Vec = std::array<double, D>;
  void add(double m, const Vec& x, const Vec& x_new, const Vec& v, const Vec& dv, const Vec& v_flip, const Vec& filtered,
           const Vec& v_new) {
    std::array<Lanes, D> X, P;
    Lanes energy(0.0);
    for (std::size_t a = 0; a < D; ++a) {
      X[a] = pack(x[a], x[a], x_new[a], x_new[a] - x[a]);
      P[a] = m * pack(dv[a], filtered[a], v_new[a], v_new[a]);
      energy = energy + P[a] * pack(v[a] + 0.5 * dv[a], v_flip[a] + 0.5 * filtered[a], 0.5 * v_new[a], 0.0);
      momentum_[a] += P[a];
    }
    energy_ += energy;
    angular_[2] += X[0] * P[1] - X[1] * P[0];
    if constexpr (D == 3) {
      angular_[0] += X[1] * P[2] - X[2] * P[1];
      angular_[1] += X[2] * P[0] - X[0] * P[2];
    }
  }
  void close(ParticleTally& tally) const {
    const auto account = [&](int lane) {
      return Change{energy_[lane],
                    {momentum_[0][lane], momentum_[1][lane], momentum_[2][lane]},
                    {angular_[0][lane], angular_[1][lane], angular_[2][lane]}};
    };
    tally.flip += account(0), tally.filter += account(1), tally.state += account(2);
    tally.advection.angular_momentum = tally.advection.angular_momentum + account(3).angular_momentum;
  }

 private:
  Lanes energy_{0.0};
  std::array<Lanes, 3> momentum_{}, angular_{};
};

template <Geometry G, Basis basis>
void from_tile(Simulation& s, const TileView& tile, const ParticleStep& step, ParticleTally& tally,
               std::vector<std::vector<std::uint32_t>>& moved, std::vector<std::vector<std::uint32_t>>& left) {
  constexpr int D = dimensions_of<G>;
  using L = Layout<D>;
  using Vec = std::array<double, D>;
  const double h = s.grid.cell_size, inverse_h = 1.0 / h;
  const bool aflip = s.numerics.particle_velocity == ParticleVelocity::aflip;
  const double filter_time = s.numerics.filter_time * h / s.extremes.wave_speed;
  const double beta = aflip ? -std::expm1(-step.dt / filter_time) : 0.0;
  const bool external = s.has_external_forces();
  const bool outflow =
      std::any_of(s.boundaries.begin(), s.boundaries.end(), [](const Boundary& b) { return b.kind == BoundaryKind::outflow; });
  const int fields = s.grid.fields;
  constexpr double anothers_mass = 1e-3;  // relative to its own, that a particle alone may see
  const double kept_alone = std::exp(-step.dt * s.extremes.wave_speed / h);
  const std::vector<GhostPlane> planes = ghost_planes<D>(s, tile.key);
  Weights w;
  std::vector<Lanes> motion(static_cast<std::size_t>(fields) * Block<D>::tile_nodes);
  for (int f = 0; f < fields; ++f) {
    Lanes* nodes = motion.data() + f * Block<D>::tile_nodes;
    load_tile(s.grid, tile.number, f, nodes);
    unfold<D>(s.boundaries, tile.key, nodes);
  }
  Lanes* remapped = s.grid.tile(tile.number, 0);
  if (step.remap) std::fill(remapped, remapped + motion.size(), Lanes(0.0));
  ParticleBooks<D> books;

  for_each_share(s, tile, [&](std::size_t number, Body& body, const Bin& bin) {
    Particles& ps = body.particles;
    CellMeans<D> pressures;
    if (external && body.locking_cure) pressures = cell_pressures<D>(body, bin, tile.position, inverse_h);
    for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
      const std::uint32_t p = body.bins.order[i];
      const double* from = ps.motion.particle(static_cast<int>(p));
      const double* load = ps.load.particle(static_cast<int>(p));
      double* to = ps.next_motion.particle(static_cast<int>(p));
      const Vec x = read_vector<D>(from), v = read_vector<D>(from + L::Motion::velocity * chunk_size);
      const double m = load[L::Load::mass * chunk_size];
      find_weights<G, basis>(x, load[L::Load::half_width * chunk_size], tile.position, h, w);
      const TwoFields field{motion.data() + body.field * Block<D>::tile_nodes, Block<D>::tile_nodes, second_field(ps, p)};
      const Gathered<D> grid = gather<Slope::lever, false, D>(w, field);
      const Channels value = Channels::of(grid.value);

      Vec v_flip, v_new, x_new, filtered, dv, v_grid;
      for (int a = 0; a < D; ++a) {
        v_grid[a] = value.c[Channel::velocity + a], dv[a] = value.c[Channel::change + a];
        v_flip[a] = v[a] + dv[a];
        filtered[a] = beta * (v_grid[a] - v_flip[a]);
        v_new[a] = v_flip[a] + filtered[a];
        x_new[a] = x[a] + step.dt * v_grid[a];
        to[a * chunk_size] = x_new[a], to[(L::Motion::velocity + a) * chunk_size] = v_new[a];
      }
      // A particle that has its nodes to itself learns nothing about a velocity gradient from them: it would get back the one
      // that it gave, for ever, and a melt would stretch exponentially. A fragment comes to rest in itself while sound crosses
      // it.
      const bool alone = value.c[Channel::mass] <= (1.0 + anothers_mass) * m * own_weight<D>(planes, w);
      const double kept = alone ? kept_alone : 1.0;
      std::array<Lanes, D> affine_momentum;
      for (int b = 0; b < D; ++b) {
        std::array<double, 3> mC{};
        const Channels moment = Channels::of(grid.slope[b]);
        for (int a = 0; a < D; ++a) {
          const double C = aflip ? kept * moment.c[Channel::velocity + a] / w.spread[b] : 0.0;
          to[(L::Motion::affine + D * a + b) * chunk_size] = C;
          mC[a] = m * C;
        }
        affine_momentum[b] = pack(0.0, mC[0], mC[1], mC[2]);
      }

      books.add(m, x, x_new, v, dv, v_flip, filtered, v_new);
      if (external) {
        const Vector X = padded(x), mean = padded(v_grid) - 0.5 * padded(dv);
        const Vector impulse = (step.dt_velocity * m) * acceleration_field(s, X);
        tally.external += {dot(impulse, mean), impulse, cross(X, impulse)};
        double pressure = 0.0;
        if (body.locking_cure) pressure = pressures(CellMeans<D>::cell(w.base));
        const SymmetricTensor<double> sigma = pushing_stress<D>(load, body.locking_cure ? &pressure : nullptr);
        const Gathered<D> g = gather<Slope::gradient, G == Geometry::axisymmetric, D>(w, field);
        double power = 0.0;
        const auto rate = [](const Lanes& slope, int a) {
          return slope[Channel::velocity + a] - 0.5 * slope[Channel::change + a];
        };
        power += sigma.xx * rate(g.slope[0], 0) + sigma.yy * rate(g.slope[1], 1) +
                 sigma.xy * (rate(g.slope[0], 1) + rate(g.slope[1], 0));
        if constexpr (D == 3)
          power += sigma.zz * rate(g.slope[2], 2) + sigma.xz * (rate(g.slope[0], 2) + rate(g.slope[2], 0)) +
                   sigma.yz * (rate(g.slope[1], 2) + rate(g.slope[2], 1));
        if constexpr (G == Geometry::axisymmetric) power += sigma.zz * rate(g.hoop, 0);
        tally.internal -= step.dt_velocity * m / load[L::Load::density * chunk_size] * power;
      }

      if (step.remap) {
        const Vector mv = m * padded(v_new);
        reach_inside(planes, h, w);
        std::array<std::array<Lanes, 3>, D> slope;
        for (int a = 0; a < D; ++a)
          for (int k = 0; k < 3; ++k) slope[a][k] = Lanes(w.lever[k][a]) * affine_momentum[a];
        scatter<D>(w, pack(m, mv[0], mv[1], mv[2]), slope,
                   {s.grid.tile(tile.number, body.field), Block<D>::tile_nodes, second_field(ps, p)});
      }
      bool stays = true;
      for (int a = 0; a < D; ++a) stays = stays && block_of_node<D>(nearest_node(x_new[a], inverse_h).node) == tile.position[a];
      if (!stays) moved[number].push_back(p);
      if (outflow)
        for (const Boundary& b : s.boundaries)
          if (b.kind == BoundaryKind::outflow && (x_new[b.axis] - b.position) * b.inward < 0.0) {
            left[number].push_back(p);
            break;
          }
    }
    if (!external) return;
    for (std::size_t l = 0; l < body.loads.size(); ++l)
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
        const std::uint32_t p = body.bins.order[i];
        const LoadedPoint<D> point = loaded_point<D>(s, body, static_cast<int>(p), l);
        if (dot(point.force, point.force) == 0.0) continue;
        find_surface_weights<G, basis>(ps, static_cast<int>(p), point.position, tile.position, h, w);
        const TwoFields field{motion.data() + body.field * Block<D>::tile_nodes, Block<D>::tile_nodes, second_field(ps, p)};
        const Channels value = Channels::of(gather<Slope::gradient, false, D>(w, field).value);
        Vector mean{};
        for (int a = 0; a < D; ++a)
          mean[static_cast<std::size_t>(a)] = value.c[Channel::velocity + a] - 0.5 * value.c[Channel::change + a];
        const Vector impulse = step.dt_velocity * point.force;
        tally.external += {dot(impulse, mean), impulse, cross(padded(point.position), impulse)};
      }
  });
  books.close(tally);
  if (step.remap)
    for (int f = 0; f < fields; ++f) fold<D>(s.boundaries, tile.key, s.grid.tile(tile.number, f));
}

template <Geometry G, Basis basis>
LargestGradient gradients(Simulation& s, const TileView& tile) {
  constexpr int D = dimensions_of<G>;
  using L = Layout<D>;
  const double h = s.grid.cell_size, inverse_h = 1.0 / h;
  Weights w;
  std::vector<Lanes> motion(static_cast<std::size_t>(s.grid.fields) * Block<D>::tile_nodes);
  for (int f = 0; f < s.grid.fields; ++f) {
    Lanes* nodes = motion.data() + f * Block<D>::tile_nodes;
    load_tile(s.grid, tile.number, f, nodes);
    unfold<D>(s.boundaries, tile.key, nodes);
  }
  double largest_square = 0.0, largest_trace = 0.0;
  for_each_share(s, tile, [&](std::size_t, Body& body, const Bin& bin) {
    Particles& ps = body.particles;
    CellMeans<D> rates;
    const auto trace_of = [](const double* l) {
      return dimensions_of<G> == 3 ? l[0] + l[4 * chunk_size] + l[8 * chunk_size]
                                   : l[0] + l[3 * chunk_size] + l[4 * chunk_size];
    };
    for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
      const std::uint32_t p = body.bins.order[i];
      const double* load = ps.load.particle(static_cast<int>(p));
      const auto x = read_vector<D>(ps.motion.particle(static_cast<int>(p)));
      find_weights<G, basis>(x, load[L::Load::half_width * chunk_size], tile.position, h, w);
      const TwoFields field{motion.data() + body.field * Block<D>::tile_nodes, Block<D>::tile_nodes, second_field(ps, p)};
      const Gathered<D> grid = gather<Slope::gradient, G == Geometry::axisymmetric, D>(w, field);
      double* l = ps.gradient.particle(static_cast<int>(p));
      for (int b = 0; b < D; ++b) {
        const Channels slope = Channels::of(grid.slope[b]);
        for (int a = 0; a < D; ++a) l[(D * a + b) * chunk_size] = slope.c[Channel::velocity + a];
      }
      if constexpr (D == 2) l[4 * chunk_size] = G == Geometry::axisymmetric ? grid.hoop[Channel::velocity] : 0.0;
      if (body.locking_cure)
        rates.add(CellMeans<D>::cell(w.base), load[L::Load::mass * chunk_size] / load[L::Load::density * chunk_size],
                  trace_of(l));
    }
    for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
      const int p = static_cast<int>(body.bins.order[i]);
      double* l = ps.gradient.particle(p);
      if (body.locking_cure) {
        const int cell = CellMeans<D>::cell(read_vector<D>(ps.motion.particle(p)), tile.position, inverse_h);
        const double correction = (rates(cell) - trace_of(l)) / 3.0;
        for (const int k : {0, D == 3 ? 4 : 3, D == 3 ? 8 : 4}) l[k * chunk_size] += correction;
      }
      double square = 0.0;
      for (int k = 0; k < L::tensor_components; ++k) square += l[k * chunk_size] * l[k * chunk_size];
      largest_square = std::max(largest_square, square);
      largest_trace = std::max(largest_trace, std::abs(trace_of(l)));
      if (!(square < 1e300)) largest_square = 1e300;  // not a number is the largest of all
    }
  });
  return {std::sqrt(largest_square), largest_trace};
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

LargestGradient velocity_gradients(Simulation& s) {
  const Timed timed(s.times, Phase::velocity_gradients);
  std::vector<LargestGradient> largest(s.grid.my_tiles.size());
  with_kernel(s, [&]<Geometry G, Basis basis>() {
    parallel_for_blocks(largest.size(), [&](std::size_t i) { largest[i] = gradients<G, basis>(s, view(s.grid, i)); });
  });
  LargestGradient all;
  for (const LargestGradient& l : largest) all.norm = std::max(all.norm, l.norm), all.trace = std::max(all.trace, l.trace);
  return {s.domain->maximum(all.norm), s.domain->maximum(all.trace)};
}

}  // namespace brisance::simulator
