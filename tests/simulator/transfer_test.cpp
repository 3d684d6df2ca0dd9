// Between particles and grid: what is carried is neither lost nor made, and motions that the weights can represent come back
// exactly.

#include "simulator/solid/transfer.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "simulator/solid/basis.hpp"
#include "simulator/solid/motion.hpp"
#include "tests/simulator/by_hand.hpp"

namespace brisance::simulator {
namespace {

using by_hand::NeoHookean;

constexpr double round_off = 1e-13;  // of sums of a few hundred terms, relative to the sum of their sizes
constexpr double h = 0.1, density = 1000.0;
constexpr Geometry geometries[] = {Geometry::plane, Geometry::axisymmetric, Geometry::three_dimensional};
constexpr Basis bases[] = {Basis::quadratic_spline, Basis::ugimp};

std::string name_of(Geometry g, Basis b) {
  return std::string(choices<Geometry>[static_cast<std::size_t>(g)]) + ", " +
         std::string(choices<Basis>[static_cast<std::size_t>(b)]);
}

/// Particles of random place, mass, velocity and affine motion over a few blocks, those at the origin among them; nowhere near
/// an axis or a boundary when `away`.
template <int D>
Simulation random_particles(Geometry geometry, Basis basis, ParticleVelocity particle_velocity, int count, bool away = true) {
  using L = Layout<D>;
  Simulation s;
  s.geometry = geometry;
  s.numerics = {basis, StressTiming::musl, particle_velocity, 30.0};
  s.grid.dimensions = D, s.grid.cell_size = h;
  if (geometry == Geometry::axisymmetric) s.boundaries.push_back({});  // the axis
  std::mt19937 random(7);
  std::uniform_real_distribution<double> symmetric(-1.0, 1.0);
  Body body = by_hand::neo_hookean_body<D>(NeoHookean{1e6, 1e6}, density, count, 0.5 * h);
  Particles& ps = body.particles;
  for (int p = 0; p < count; ++p) {
    ps.load.at(L::Load::mass, p) *= 1.0 + 0.9 * symmetric(random);
    ps.load.at(L::Load::half_width, p) *= 1.0 + 0.5 * symmetric(random);
    for (int a = 0; a < D; ++a) {
      double& x = ps.motion.at(L::Motion::position + a, p);
      x = (D == 3 ? 6.0 : 12.0) * h * symmetric(random);
      if (geometry == Geometry::axisymmetric && a == 0) x = std::abs(x) + (away ? 2.0 * h : ps.load.at(L::Load::half_width, p));
      ps.motion.at(L::Motion::velocity + a, p) = symmetric(random);
      for (int b = 0; b < D; ++b)
        ps.motion.at(L::Motion::affine + D * a + b, p) =
            particle_velocity == ParticleVelocity::aflip ? 10.0 * symmetric(random) : 0.0;
    }
  }
  s.bodies.push_back(std::move(body));
  begin(s);
  return s;
}
Simulation random_particles(Geometry g, Basis b, ParticleVelocity v, int count, bool away = true) {
  return g == Geometry::three_dimensional ? random_particles<3>(g, b, v, count, away)
                                          : random_particles<2>(g, b, v, count, away);
}

/// Mass, momentum and angular momentum.
struct Carried {
  double mass = 0.0;
  Vector momentum{}, angular_momentum{};
  double mass_size = 0.0, momentum_size = 0.0;  // sums of the sizes of the terms
  void add(double m, const Vector& p, const Vector& x) {
    mass += m, momentum = momentum + p, angular_momentum = angular_momentum + cross(x, p);
    mass_size += std::abs(m), momentum_size += magnitude(p);
  }
};
/// Calls f(position, mass, momentum) for the nodes of a field.
template <int D, class F>
void for_each_node(const Simulation& s, int field, F&& f) {
  Grid& grid = const_cast<Simulation&>(s).grid;
  for (std::size_t b = 0; b < grid.blocks.size(); ++b)
    for (int n = 0; n < Block<D>::nodes; ++n) {
      constexpr int side = Block<D>::side;
      const BlockPosition block = block_position(grid.blocks[b]);
      const int local[3] = {n % side, n / side % side, n / (side * side)};
      const Lanes& node = grid.block_sums(b, field)[n];
      Vector x{}, p{};
      for (int a = 0; a < D; ++a) {
        const auto k = static_cast<std::size_t>(a);
        x[k] = h * (block[k] * side + local[a]), p[k] = node[Channel::momentum + a];
      }
      f(x, node[Channel::mass], p);
    }
}
template <class F>
void for_each_node(const Simulation& s, F&& f, int field = 0) {
  s.dimensions() == 3 ? for_each_node<3>(s, field, f) : for_each_node<2>(s, field, f);
}
Carried on_grid(const Simulation& s, int field = 0) {
  Carried sum;
  for_each_node(
      s, [&](const Vector& x, double m, const Vector& p) { sum.add(m, p, x); }, field);
  return sum;
}
Carried on_particles(const Simulation& s) {
  Carried sum;
  const Particles& ps = s.bodies[0].particles;
  for (int p = 0; p < ps.size; ++p) {
    const double m = by_hand::mass(ps, p);
    sum.add(m, m * by_hand::velocity(ps, p), by_hand::position(ps, p));
  }
  return sum;
}
void to_grid(Simulation& s, Carry carry = Carry::motion) {
  activate_blocks(s);
  particles_to_grid(s, carry, 0.0);
  gather_tiles(s.grid, *s.domain);
  sum_tiles(s.grid);
}

void expect_same_mass_and_momentum(const Carried& grid, const Carried& particles) {
  EXPECT_NEAR(grid.mass, particles.mass, round_off * grid.mass_size);
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(grid.momentum[a], particles.momentum[a], round_off * grid.momentum_size);
}

TEST(ParticlesToGrid, CarryMassAndMomentum) {
  for (const Geometry g : geometries)
    for (const Basis b : bases)
      for (const ParticleVelocity v : {ParticleVelocity::flip, ParticleVelocity::aflip}) {
        SCOPED_TRACE(name_of(g, b));
        Simulation s = random_particles(g, b, v, 500);
        ASSERT_GT(s.grid.my_tiles.size(), 4u) << "there are edges of blocks between the particles";
        to_grid(s);
        expect_same_mass_and_momentum(on_grid(s), on_particles(s));
      }
}

TEST(ParticlesToGrid, CarryForcesThatSumToZero) {
  for (const Geometry g : {Geometry::plane, Geometry::three_dimensional})
    for (const Basis b : bases) {
      SCOPED_TRACE(name_of(g, b));
      Simulation s = random_particles(g, b, ParticleVelocity::flip, 500);
      Particles& ps = s.bodies[0].particles;
      for (int p = 0; p < ps.size; ++p)
        for (int k = 0; k < by_hand::stress_components(ps); ++k) ps.load.at(2 + k, p) = 1e6 * std::sin(p + 10.0 * k);
      to_grid(s, Carry::motion_and_force);
      Vector sum{};
      double size = 0.0;
      for (std::size_t block = 0; block < s.grid.blocks.size(); ++block)
        for (int n = 0; n < 64; ++n)
          for (int a = 0; a < s.dimensions(); ++a) {
            const double f = s.grid.block_sums(block, 0)[n][Channel::force + a];
            sum[static_cast<std::size_t>(a)] += f, size += std::abs(f);
          }
      ASSERT_GT(size, 0.0);
      for (const double f : sum) EXPECT_LT(std::abs(f), round_off * size);
    }
}

/// The axis turns the radial momentum of its ghosts round, which is what a pressure on the axis does; nothing else is lost.
TEST(ParticlesToGrid, CarryMassAndAxialMomentumAtTheAxis) {
  for (const Basis b : bases) {
    SCOPED_TRACE(name_of(Geometry::axisymmetric, b));
    Simulation s = random_particles(Geometry::axisymmetric, b, ParticleVelocity::aflip, 500, false);
    to_grid(s);
    const Carried grid = on_grid(s), particles = on_particles(s);
    EXPECT_NEAR(grid.mass, particles.mass, round_off * grid.mass_size);
    EXPECT_NEAR(grid.momentum[1], particles.momentum[1], round_off * grid.momentum_size);
  }
}

/// Jiang, Schroeder & Teran, J. Comput. Phys. 338 (2017) 137-164: a particle's own angular momentum is m (h^2/4) (C21 - C12).
TEST(ParticlesToGrid, CarryAngularMomentumWithTheAffineMotion) {
  Simulation s = random_particles(Geometry::plane, Basis::quadratic_spline, ParticleVelocity::aflip, 500);
  to_grid(s);
  const Particles& ps = s.bodies[0].particles;
  double expected = on_particles(s).angular_momentum[2];
  for (int p = 0; p < ps.size; ++p)
    expected += by_hand::mass(ps, p) * 0.25 * h * h *
                (ps.motion.at(Layout<2>::Motion::affine + 2, p) - ps.motion.at(Layout<2>::Motion::affine + 1, p));
  const Carried grid = on_grid(s);
  EXPECT_NEAR(grid.angular_momentum[2], expected, round_off * grid.momentum_size * 12.0 * h);
}

TEST(ParticlesToGrid, CarryMassAndMomentumOverTwoFields) {
  for (const Geometry g : geometries)
    for (const Basis b : bases) {
      SCOPED_TRACE(name_of(g, b));
      Simulation s = random_particles(g, b, ParticleVelocity::aflip, 500);
      s.grid = Grid{};
      s.grid.dimensions = s.dimensions(), s.grid.cell_size = h, s.grid.fields = 2;
      Particles& ps = s.bodies[0].particles;
      std::mt19937 random(3);
      for (int p = 0; p < ps.size; ++p) ps.second_field.push_back(random() & ((1u << 27) - 1));
      to_grid(s);
      const Carried first = on_grid(s, 0), second = on_grid(s, 1);
      EXPECT_GT(first.mass, 0.2 * second.mass);
      EXPECT_GT(second.mass, 0.2 * first.mass);
      Carried sum = first;
      sum.mass += second.mass, sum.momentum = sum.momentum + second.momentum;
      sum.mass_size += second.mass_size, sum.momentum_size += second.momentum_size;
      expect_same_mass_and_momentum(sum, on_particles(s));
    }
}

TEST(ParticlesToGrid, MaskOfZeroGivesTheBitsOfNoMask) {
  for (const Geometry g : geometries)
    for (const Basis b : bases) {
      SCOPED_TRACE(name_of(g, b));
      Simulation one = random_particles(g, b, ParticleVelocity::aflip, 300),
                 two = random_particles(g, b, ParticleVelocity::aflip, 300);
      two.grid = Grid{};
      two.grid.dimensions = two.dimensions(), two.grid.cell_size = h, two.grid.fields = 2;
      two.bodies[0].particles.second_field.assign(300, 0u);
      for (Simulation* s : {&one, &two})
        for (int i = 0; i < 5; ++i) ASSERT_EQ(advance(*s, 1e-4), StepOutcome::done);
      const Particles &p1 = one.bodies[0].particles, &p2 = two.bodies[0].particles;
      for (const Column& c : p1.columns())
        for (int p = 0; p < p1.size; ++p) {
          const double x = p1.set(c.set).at(c.index, p), y = p2.set(c.set).at(c.index, p);
          ASSERT_EQ(std::memcmp(&x, &y, sizeof(double)), 0) << c.name << " of particle " << p;
        }
      EXPECT_EQ(on_grid(two, 1).mass_size, 0.0);
    }
}

/// v = v0 + L x
struct LinearField {
  Vector v0{0.3, -0.7, 0.2};
  double L[3][3] = {{0.5, -1.1, 0.4}, {0.9, 0.2, -0.6}, {-0.3, 0.8, 0.7}};
  Vector operator()(const Vector& x, int D) const {
    Vector v{};
    for (int a = 0; a < D; ++a) {
      const auto i = static_cast<std::size_t>(a);
      v[i] = v0[i];
      for (int b = 0; b < D; ++b) v[i] += L[a][b] * x[static_cast<std::size_t>(b)];
    }
    return v;
  }
};

TEST(ParticlesToGrid, GiveALinearFieldToTheNodesBesideAPlane) {
  const LinearField field;
  for (const Geometry g : geometries)
    for (const Basis basis : bases)
      for (const int inward : {1, -1}) {
        if (g == Geometry::axisymmetric && basis == Basis::ugimp) continue;  // carries the velocity of its ring's centroid
        SCOPED_TRACE(name_of(g, basis));
        Simulation s = random_particles(g, basis, ParticleVelocity::aflip, 300);
        Boundary wall;
        wall.kind = BoundaryKind::rigid_wall, wall.axis = 1, wall.inward = inward;
        s.boundaries.push_back(wall);
        const int D = s.dimensions();
        Particles& ps = s.bodies[0].particles;
        for (int p = 0; p < ps.size; ++p) {
          double& y = ps.motion.at(1, p);
          y = inward * (std::abs(y) / 4.0 + 1e-6 * h);  // many within half a cell of the plane
          const Vector v = field(by_hand::position(ps, p), D);
          for (int a = 0; a < D; ++a) {
            ps.motion.at(D + a, p) = v[static_cast<std::size_t>(a)];
            for (int b = 0; b < D; ++b) ps.motion.at(2 * D + D * a + b, p) = field.L[a][b];
          }
        }
        begin(s);
        to_grid(s);
        int nodes = 0;
        for_each_node(s, [&](const Vector& x, double m, const Vector& momentum) {
          if (m == 0.0) return;
          ++nodes;
          const Vector v = field(x, D);
          const double mass_of_a_cell = density * std::pow(h, D);
          for (std::size_t a = 0; a < 3; ++a) ASSERT_NEAR(momentum[a], m * v[a], round_off * 10.0 * mass_of_a_cell);
        });
        EXPECT_GT(nodes, 50);
      }
}

// Back --------------------------------------------------------------------------------------------------------------------

/// Where the mass of a ring of uniform density between r - l and r + l has its centre: uGIMP gives the velocity there.
double centre_of_ring(double r, double l) {
  return r + l * l / (3.0 * r);
}

TEST(GridToParticles, ReproducesLinearFields) {
  const LinearField field;
  for (const Geometry g : geometries)
    for (const Basis basis : bases) {
      SCOPED_TRACE(name_of(g, basis));
      Simulation s = random_particles(g, basis, ParticleVelocity::aflip, 300);
      s.numerics.filter_time = 1e-12;  // all of the particles' velocity comes from the grid
      to_grid(s);
      const int D = s.dimensions();
      const auto at = [&](const Vector& x) { return field(x, D); };
      D == 3 ? by_hand::set_grid_velocity<3>(s, at) : by_hand::set_grid_velocity<2>(s, at);
      const double dt = 1e-3;
      grid_to_particles(s, {dt, dt, false});
      velocity_gradients(s);
      const Particles& ps = s.bodies[0].particles;
      for (int p = 0; p < ps.size; ++p) {
        Vector x = by_hand::position(ps, p);
        if (g == Geometry::axisymmetric && basis == Basis::ugimp)
          x[0] = centre_of_ring(x[0], ps.load.at(Layout<2>::Load::half_width, p));
        const Vector v = field(x, D);
        constexpr double small = 1e-13;  // relative to the velocities and gradients, of the order of one
        for (int a = 0; a < D; ++a) {
          const auto k = static_cast<std::size_t>(a);
          ASSERT_NEAR(ps.next_motion.at(D + a, p), v[k], small);
          ASSERT_NEAR(ps.next_motion.at(a, p), by_hand::position(ps, p)[k] + dt * v[k], small);
          for (int b = 0; b < D; ++b) {
            double C = ps.next_motion.at(2 * D + D * a + b, p);  // at places x + dt v: C (1 + dt L) = L
            for (int c = 0; c < D; ++c) C += dt * ps.next_motion.at(2 * D + D * a + c, p) * field.L[c][b];
            ASSERT_NEAR(C, field.L[a][b], 1e-11) << "affine motion";
            ASSERT_NEAR(ps.gradient.at(D * a + b, p), field.L[a][b], 1e-11) << "velocity gradient";
          }
        }
        if (g == Geometry::plane) {
          ASSERT_EQ(ps.gradient.at(4, p), 0.0);
        }
      }
    }
}

TEST(GridToParticles, BringAParticleAloneToRestInItselfInTheTimeOfSound) {
  // Anywhere, and beside a wall and a mirror.
  for (const Geometry g : {Geometry::plane, Geometry::three_dimensional})
    for (const BoundaryKind kind : {BoundaryKind::outflow, BoundaryKind::rigid_wall, BoundaryKind::symmetry})
      for (const double y : {0.05, 0.3, 0.49, 0.51, 1.2})
        for (const double apart : {10.0, 1.0}) {
          Simulation s = random_particles(g, Basis::quadratic_spline, ParticleVelocity::aflip, 2);
          const int D = s.dimensions();
          Boundary plane;
          plane.kind = kind, plane.axis = 1, plane.position = kind == BoundaryKind::outflow ? -10.0 : 0.0;
          s.boundaries.push_back(plane);
          s.bodies[0].stress = [](Body&, int) {};  // none
          Particles& ps = s.bodies[0].particles;
          constexpr double C = 10.0, v = 20.0;  // 1/s, m/s
          for (int p = 0; p < 2; ++p) {         // both in the field v + C x
            const double place = (0.3 + apart * p) * h;
            ps.motion.at(0, p) = place, ps.motion.at(1, p) = y * h;
            for (int k = 0; k < D + D * D; ++k) ps.motion.at(D + k, p) = 0.0;
            ps.motion.at(D, p) = v + C * place, ps.motion.at(2 * D, p) = C;
            if (D == 3) ps.motion.at(2, p) = 0.0;
          }
          begin(s);
          const std::array<double, 2> x{ps.motion.at(0, 0), ps.motion.at(0, 1)};
          constexpr double dt = 1e-4;
          const double kept = apart > 3.0 ? std::exp(-dt * s.extremes.wave_speed / h) : 1.0;
          ASSERT_LT(std::exp(-dt * s.extremes.wave_speed / h), 0.99);
          ASSERT_EQ(advance(s, dt), StepOutcome::done);
          for (int p = 0; p < 2; ++p) {
            SCOPED_TRACE("y = " + std::to_string(y) + ", " + std::to_string(apart) + " cells apart");
            EXPECT_NEAR(ps.motion.at(D, p), v + C * x[static_cast<std::size_t>(p)], 1e-10);
            // With respect to the places at the end of the step, and in its middle.
            EXPECT_NEAR(ps.motion.at(2 * D, p), kept * C / (1.0 + dt * kept * C), 1e-10) << "affine motion";
            EXPECT_NEAR(ps.gradient.at(0, p), kept * C / (1.0 + 0.5 * dt * kept * C), 1e-10) << "velocity gradient";
          }
        }
}

/// v_r = a r, v_z = 0: the same stretching in both directions, on the axis as elsewhere.
TEST(GridToParticles, GivesUniformExpansionUpToTheAxis) {
  constexpr double a = 3.0;
  for (const Basis basis : bases) {
    SCOPED_TRACE(name_of(Geometry::axisymmetric, basis));
    Simulation s;
    s.geometry = Geometry::axisymmetric, s.numerics.basis = basis;
    s.grid.dimensions = 2, s.grid.cell_size = h;
    s.boundaries.push_back({});
    constexpr int across = 20, along = 6;
    const double spacing = 0.5 * h;
    Body body = by_hand::neo_hookean_body<2>(NeoHookean{1e6, 1e6}, density, across * along, spacing);
    for (int p = 0; p < across * along; ++p) {
      body.particles.motion.at(0, p) = (p % across + 0.5) * spacing,
                                  body.particles.motion.at(1, p) = (p / across + 0.5) * spacing;
      body.particles.load.at(0, p) *= body.particles.motion.at(0, p);
    }
    s.bodies.push_back(std::move(body));
    begin(s);
    by_hand::set_grid_velocity<2>(s, [](const Vector& x) { return Vector{a * x[0], 0.0, 0.0}; });
    velocity_gradients(s);
    const Particles& ps = s.bodies[0].particles;
    for (int p = 0; p < ps.size; ++p) {
      ASSERT_NEAR(ps.gradient.at(0, p), a, 1e-12) << "L_rr at r = " << ps.motion.at(0, p);
      ASSERT_NEAR(ps.gradient.at(4, p), a, 1e-12) << "L_theta theta at r = " << ps.motion.at(0, p);
      for (const int k : {1, 2, 3}) ASSERT_NEAR(ps.gradient.at(k, p), 0.0, 1e-12);
    }
  }
}

// Weights -----------------------------------------------------------------------------------------------------------------

/// What the weights of a particle (lane) along one direction have in common.
void expect_partition_of_unity(const LineWeights& w, std::size_t lane) {
  const auto sum = [&](const std::array<StoredPack, 3>& rows) { return rows[0][lane] + rows[1][lane] + rows[2][lane]; };
  EXPECT_NEAR(sum(w.value), 1.0, 1e-12);
  EXPECT_NEAR(sum(w.gradient), 0.0, 1e-12 / h);
  EXPECT_NEAR(sum(w.lever), 0.0, 1e-12 * h);
  for (const StoredPack& S : w.value) EXPECT_GE(S[lane], 0.0);
  EXPECT_GT(w.spread[lane], 0.0);
}

TEST(Weights, SumToOneAndTheirGradientsToZero) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 3.5 * h), width(0.05 * h, 0.5 * h);
  for (int i = 0; i < 125; ++i) {
    std::array<Lanes, 3> x;
    Lanes l;
    for (int lane = 0; lane < 8; ++lane) {
      l.set(lane, width(random));
      for (Lanes& component : x) component.set(lane, place(random));
    }
    const auto spline = find_weights<Geometry::three_dimensional, Basis::quadratic_spline>(x, l, {0, 0, 0}, h);
    const auto wide = find_weights<Geometry::three_dimensional, Basis::ugimp>(x, l, {0, 0, 0}, h);
    for (std::size_t lane = 0; lane < 8; ++lane)
      for (std::size_t a = 0; a < 3; ++a)
        expect_partition_of_unity(spline.along[a], lane), expect_partition_of_unity(wide.along[a], lane);
  }
}

/// Of the velocity v_r = r the hoop weights make one; of a constant velocity the mean of 1/r over a ring, which is 1/r.
TEST(Weights, OfRingsGiveHoopStretching) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> width(0.05 * h, 0.5 * h), radius(0.0, 7.0 * h);
  for (int i = 0; i < 125; ++i) {
    Lanes l, r;
    for (int lane = 0; lane < 8; ++lane) l.set(lane, width(random)), r.set(lane, l[lane] + radius(random));
    for (const Basis basis : bases) {
      const std::array<Lanes, 2> x{r, Lanes(0.2 * h)};
      const Weights<2> w = basis == Basis::ugimp
                               ? find_weights<Geometry::axisymmetric, Basis::ugimp>(x, l, {0, 0, 0}, h)
                               : find_weights<Geometry::axisymmetric, Basis::quadratic_spline>(x, l, {0, 0, 0}, h);
      for (std::size_t lane = 0; lane < 8; ++lane) {
        for (const LineWeights& line : w.along) expect_partition_of_unity(line, lane);
        const double radius_of_lane = r[static_cast<int>(lane)], n = nearest_node(radius_of_lane, 1.0 / h).node;
        const double below = w.hoop[0][lane], middle = w.hoop[1][lane], above = w.hoop[2][lane];
        EXPECT_NEAR((below + middle + above) * radius_of_lane, 1.0, 1e-12);
        EXPECT_NEAR(below * (n - 1.0) * h + middle * n * h + above * (n + 1.0) * h, 1.0, 1e-12);
      }
    }
  }
}

// Ghosts ------------------------------------------------------------------------------------------------------------------

template <int D>
void expect_transposed(const std::vector<Boundary>& boundaries, BlockKey block) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> symmetric(-1.0, 1.0);
  constexpr auto nodes = static_cast<std::size_t>(Block<D>::tile_nodes);
  const auto any = [&] {
    std::vector<Lanes> tile(nodes);
    for (Lanes& n : tile)
      for (int c = 0; c < Channel::touch; ++c) n.set(c, symmetric(random));
    return tile;
  };
  const std::vector<Lanes> added = any(), motion = any();
  std::vector<Lanes> folded = added, continued = motion;
  fold<D>(boundaries, block, folded.data());
  unfold<D>(boundaries, block, continued.data());
  for (int c = 0; c < Channel::touch; ++c) {
    double before = 0.0, after = 0.0, changed = 0.0;
    for (std::size_t n = 0; n < nodes; ++n) {
      after += folded[n][c] * motion[n][c], before += added[n][c] * continued[n][c];
      changed += std::abs(folded[n][c] - added[n][c]);
    }
    EXPECT_NEAR(before, after, 1e-12 * static_cast<double>(nodes)) << "channel " << c;
    EXPECT_GT(changed, 0.1);
  }
}

TEST(Ghosts, AreFoldedByTheTransposeOfWhatContinuesThem) {
  const auto plane = [](BoundaryKind kind, int axis, int node, int inward) {
    Boundary b;
    b.kind = kind, b.axis = axis, b.node = node, b.inward = inward;
    return b;
  };
  const BlockKey origin = block_key({0, 0, 0});
  for (const BoundaryKind kind :
       {BoundaryKind::symmetry, BoundaryKind::fixed, BoundaryKind::velocity, BoundaryKind::rigid_wall})
    for (int axis = 0; axis < 3; ++axis)
      for (const int inward : {1, -1})
        for (int node = 0; node < 4; ++node) {
          expect_transposed<3>({plane(kind, axis, node, inward)}, origin);
          if (axis < 2) expect_transposed<2>({plane(kind, axis, node, inward)}, origin);
        }
  // Edges and corners, and planes on both sides of a body as thin as three cells.
  expect_transposed<3>(
      {plane(BoundaryKind::symmetry, 0, 0, 1), plane(BoundaryKind::rigid_wall, 1, 0, 1), plane(BoundaryKind::fixed, 2, 3, -1)},
      origin);
  expect_transposed<3>({plane(BoundaryKind::rigid_wall, 0, 0, 1), plane(BoundaryKind::symmetry, 0, 3, -1)}, origin);
  expect_transposed<2>(
      {plane(BoundaryKind::fixed, 0, 0, 1), plane(BoundaryKind::symmetry, 1, 0, 1), plane(BoundaryKind::rigid_wall, 1, 3, -1)},
      origin);
}

TEST(Ghosts, ContinueWhatTheirPlaneAllows) {
  // A mirror continues an odd normal and an even tangential velocity, other planes continue linear fields.
  const BlockKey origin = block_key({0, 0, 0});
  for (const BoundaryKind kind : {BoundaryKind::symmetry, BoundaryKind::rigid_wall}) {
    Boundary b;
    b.kind = kind, b.axis = 1, b.node = 0;
    std::vector<Lanes> tile(static_cast<std::size_t>(Block<2>::tile_nodes));
    const bool mirror = kind == BoundaryKind::symmetry;
    const auto field = [&](int i, int j) {
      Lanes v(0.0);
      v.set(Channel::velocity, mirror ? 2.0 + 0.1 * i + std::abs(j) : 2.0 + 0.1 * i + 3.0 * j);
      v.set(Channel::velocity + 1, mirror ? 3.0 * j : 1.0 + 3.0 * j);
      return v;
    };
    for (int j = 1; j < Block<2>::tile_side; ++j)
      for (int i = 0; i < Block<2>::tile_side; ++i)
        tile[static_cast<std::size_t>(Block<2>::tile_node(i, j, 0))] = field(i - 1, j - 1);
    unfold<2>({b}, origin, tile.data());
    for (int i = 0; i < Block<2>::tile_side; ++i)
      for (const int c : {Channel::velocity, Channel::velocity + 1})
        EXPECT_NEAR(tile[static_cast<std::size_t>(Block<2>::tile_node(i, 0, 0))][c], field(i - 1, -1)[c], 1e-14);
  }
}

}  // namespace
}  // namespace brisance::simulator
