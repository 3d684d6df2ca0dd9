#pragma once
// Forces from outside on particles: per mass, and on their surface.

#include "simulator/solid/transfer.hpp"
#include "simulator/solid/transfer/tile.hpp"

namespace brisance::simulator {

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

}  // namespace brisance::simulator
