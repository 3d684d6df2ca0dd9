#pragma once
// Simulations put together by hand, without a case file, and what tests ask of them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include "models/input/material_reader.hpp"
#include "simulator/setup.hpp"
#include "simulator/simulation.hpp"
#include "simulator/solid/stress.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator::by_hand {

// Cases ---------------------------------------------------------------------------------------------------------------

template <class Form>
ShapePointer shape(Form form) {
  auto s = std::make_shared<Shape>();
  s->form = std::move(form);
  return s;
}
inline ShapePointer box(const Vector& lower, const Vector& upper) {
  return shape(Box{lower, upper});
}

/// Isotropic elasticity with both parts of the stress from increments; without artificial viscosity, so that nothing
/// dissipates.
inline Material elastic_material(double density, double youngs_modulus, double poissons_ratio) {
  Material m;
  m.name = "elastic", m.density = density;
  constexpr double specific_heat = 1.0, temperature = 300.0;
  m.equation_of_state = equation_of_state::Hypoelastic{density, youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)),
                                                       specific_heat, temperature};
  m.shear_modulus = shear_modulus::Constant{youngs_modulus / (2.0 * (1.0 + poissons_ratio))};
  m.artificial_viscosity = {0.0, 0.0};
  return m;
}

/// That of data/materials.
inline const Material& copper() {
  static const Material read = read_material(BRISANCE_SOURCE_DIR "/data/materials/copper_ofhc_johnson_cook.toml");
  return read;
}

inline BodyConfig body(std::string name, const Material& material, ShapePointer shape, const Vector& velocity = {}) {
  BodyConfig b;
  b.name = std::move(name), b.material.material = material, b.shape = std::move(shape);
  b.velocity.translation = velocity, b.temperature = 300.0;
  return b;
}

inline BoundaryConfig plane(BoundaryKind kind, Axis axis, double position, Side side, double friction = 0.0) {
  BoundaryConfig b;
  b.kind = kind, b.axis = axis, b.position = position, b.side = side, b.friction = friction;
  return b;
}

inline Table table(std::initializer_list<std::pair<double, double>> points) {
  Table t;
  for (const auto& [x, y] : points) t.x[static_cast<std::size_t>(t.size)] = x, t.y[static_cast<std::size_t>(t.size++)] = y;
  return t;
}

// Running -------------------------------------------------------------------------------------------------------------

/// The step of a run of its own numerics, but for the courant number; 0: that of the run as well.
inline double stable_step(const Simulation& s, double end, double courant = 0.0) {
  NumericsConfig numerics;
  numerics.courant = courant;
  return next_step(s, numerics, end).dt;
}

/// Advances to a time; every step must be accepted. `after_step` sees the simulation after each.
inline void run_to(Simulation& s, double end, double courant, const std::function<void()>& after_step = {}) {
  while (s.time < end * (1.0 - 1e-12)) {
    if (advance(s, stable_step(s, end, courant)) != StepOutcome::done) throw std::runtime_error("a step was rejected");
    if (after_step) after_step();
  }
}

// Asking --------------------------------------------------------------------------------------------------------------

inline Vector at(const Particles& p, int particle, int first_column) {
  Vector v{};
  for (int a = 0; a < p.dimensions; ++a) v[static_cast<std::size_t>(a)] = p.motion.at(first_column + a, particle);
  return v;
}
inline Vector position(const Particles& p, int particle) {
  return at(p, particle, 0);
}
inline Vector velocity(const Particles& p, int particle) {
  return at(p, particle, p.dimensions);
}
inline double mass(const Particles& p, int particle) {
  return p.load.at(0, particle);
}
inline double volume(const Particles& p, int particle) {
  return mass(p, particle) / p.load.at(1, particle);
}
inline double mass(const Body& b) {
  double sum = 0.0;
  for (int p = 0; p < b.particles.size; ++p) sum += mass(b.particles, p);
  return sum;
}
/// Mean over a body's mass.
inline Vector mean(const Body& b, Vector (*what)(const Particles&, int)) {
  Vector sum{};
  for (int p = 0; p < b.particles.size; ++p) sum = sum + mass(b.particles, p) * what(b.particles, p);
  return (1.0 / mass(b)) * sum;
}
/// Stress in its order in memory: xx yy zz yz xz xy, or xx yy zz xy.
inline double stress(const Particles& p, int particle, int component) {
  return p.load.at(Layout<3>::Load::stress + component, particle);
}
inline int stress_components(const Particles& p) {
  return p.dimensions == 3 ? Layout<3>::stress_components : Layout<2>::stress_components;
}
inline double largest_stress(const Simulation& s) {
  double largest = 0.0;
  for (const Body& b : s.bodies)
    for (int p = 0; p < b.particles.size; ++p)
      for (int k = 0; k < stress_components(b.particles); ++k) largest = std::max(largest, std::abs(stress(b.particles, p, k)));
  return largest;
}

// Manufactured materials -----------------------------------------------------------------------------------------------

/// Neo-Hookean: stress = (lambda ln J 1 + mu (F F^T - 1))/J.
struct NeoHookean {
  double lambda, mu;

  template <int D>
  void operator()(Body& body, int particle) const {
    using L = Layout<D>;
    const double* c = body.particles.rest.particle(particle) + L::Rest::deformation_gradient * chunk_size;
    double F[3][3]{};
    if constexpr (D == 3) {
      for (int i = 0; i < 9; ++i) F[i / 3][i % 3] = c[i * chunk_size];
    } else {
      for (int i = 0; i < 4; ++i) F[i / 2][i % 2] = c[i * chunk_size];
      F[2][2] = c[4 * chunk_size];
    }
    double b[3][3]{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) b[i][j] += F[i][k] * F[j][k];
    const double J = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                     F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
    double* stress = body.particles.load.particle(particle) + L::Load::stress * chunk_size;
    for (int i = 0; i < 3; ++i) stress[i * chunk_size] = (lambda * std::log(J) + mu * (b[i][i] - 1.0)) / J;
    if constexpr (D == 3)
      stress[3 * chunk_size] = mu * b[1][2] / J, stress[4 * chunk_size] = mu * b[0][2] / J,
                 stress[5 * chunk_size] = mu * b[0][1] / J;
    else
      stress[3 * chunk_size] = mu * b[0][1] / J;
  }
};

/// A body of neo-Hookean particles, all alike and undeformed, at rest at the origin; the caller places them.
template <int D>
Body neo_hookean_body(const NeoHookean& law, double density, int particles, double spacing) {
  using L = Layout<D>;
  Body b;
  b.name = "neo-Hookean", b.material.density = density, b.material.bulk_modulus = law.lambda + 2.0 / 3.0 * law.mu;
  b.material.artificial_viscosity = {0.0, 0.0};
  b.stress = [law](Body& body, int p) { law.operator()<D>(body, p); };
  b.particles = Particles(D, 0, 0, false);
  b.particles.resize(particles);
  for (int p = 0; p < particles; ++p) {
    b.particles.id[static_cast<std::size_t>(p)] = static_cast<std::uint64_t>(p);
    b.particles.load.at(L::Load::mass, p) = density * std::pow(spacing, D);
    b.particles.load.at(L::Load::density, p) = density;
    b.particles.load.at(L::Load::half_width, p) = 0.5 * spacing;
    for (const int k : {0, D == 3 ? 4 : 3, D == 3 ? 8 : 4}) b.particles.rest.at(L::Rest::deformation_gradient + k, p) = 1.0;
    b.particles.rest.at(L::Rest::shear_modulus, p) = law.mu;
  }
  return b;
}

/// Gives every node of the grid a velocity.
template <int D>
void set_grid_velocity(Simulation& s, const std::function<Vector(const Vector&)>& velocity_at) {
  for (std::size_t b = 0; b < s.grid.blocks.size(); ++b) {
    const BlockPosition block = block_position(s.grid.blocks[b]);
    for (int n = 0; n < Block<D>::nodes; ++n) {
      constexpr int side = Block<D>::side;
      const int local[3] = {n % side, n / side % side, D == 3 ? n / (side * side) : 0};
      Vector x{};
      for (int a = 0; a < D; ++a)
        x[static_cast<std::size_t>(a)] = s.grid.cell_size * (block[static_cast<std::size_t>(a)] * side + local[a]);
      const Vector v = velocity_at(x);
      for (int field = 0; field < s.grid.fields; ++field) {
        Lanes node(0.0);
        node.set(Channel::mass, 1e3);  // of many particles
        for (int a = 0; a < D; ++a) node.set(Channel::velocity + a, v[static_cast<std::size_t>(a)]);
        s.grid.block_motion(b, field)[n] = node;
      }
    }
  }
}

}  // namespace brisance::simulator::by_hand
