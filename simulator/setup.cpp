#include "simulator/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unordered_map>

#include "models/random.hpp"
#include "models/update.hpp"
#include "models/visit.hpp"
#include "simulator/gas/gas_setup.hpp"
#include "simulator/solid/motion.hpp"
#include "simulator/solid/shapes.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator {
namespace {

/// A particle's number is that of its body above that of its site.
constexpr int site_bits = 48;

/// One sub-cell of the creation lattice: where it is and how full.
struct Site {
  std::array<int, 3> index;
  Vector centre;
  double filled;
};

/// The creation lattice of a body: sub-cells of the grid, counted from the corner of the body's bounds.
struct Lattice {
  double spacing;
  std::array<int, 3> first{}, count{1, 1, 1};

  Lattice(const Case& c, const BodyConfig& body) : spacing(c.cell_size / body.particles_per_direction) {
    const Bounds box = bounds(*body.shape, c.geometry);
    constexpr double round_off = 1e-9;
    for (int a = 0; a < c.dimensions(); ++a) {
      const auto k = static_cast<std::size_t>(a);
      first[k] = static_cast<int>(std::floor(box.lower[k] / spacing + round_off));
      count[k] = std::max(static_cast<int>(std::ceil(box.upper[k] / spacing - round_off)) - first[k], 0);
    }
  }
  Vector lower(const std::array<int, 3>& index, int dimensions) const {
    Vector x{};
    for (int a = 0; a < dimensions; ++a)
      x[static_cast<std::size_t>(a)] = spacing * (first[static_cast<std::size_t>(a)] + index[static_cast<std::size_t>(a)]);
    return x;
  }
  std::uint64_t number(const std::array<int, 3>& i) const {
    return static_cast<std::uint64_t>(i[0]) +
           static_cast<std::uint64_t>(count[0]) *
               (static_cast<std::uint64_t>(i[1]) + static_cast<std::uint64_t>(count[1]) * static_cast<std::uint64_t>(i[2]));
  }
  std::array<int, 3> index(std::uint64_t number) const {
    const auto nx = static_cast<std::uint64_t>(count[0]), ny = static_cast<std::uint64_t>(count[1]);
    return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny), static_cast<int>(number / nx / ny)};
  }
  bool holds(const std::array<int, 3>& i) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (i[a] < 0 || i[a] >= count[a]) return false;
    return true;
  }
};

/// The part of a sub-cell below which it gets no particle.
double trimming(const Case& c) {
  return c.numerics.trimming.value_or(c.dimensions() == 3 ? 0.05 : 0.0);
}

std::vector<Site> fill(const Case& c, const BodyConfig& body, const Lattice& lattice) {
  std::vector<Site> sites;
  const int D = c.dimensions();
  for (int k = 0; k < lattice.count[2]; ++k)
    for (int j = 0; j < lattice.count[1]; ++j)
      for (int i = 0; i < lattice.count[0]; ++i) {
        const std::array<int, 3> index{i, j, k};
        const Vector lower = lattice.lower(index, D);
        Vector upper = lower, centre = lower;
        for (int a = 0; a < D; ++a) {
          upper[static_cast<std::size_t>(a)] += lattice.spacing;
          centre[static_cast<std::size_t>(a)] += 0.5 * lattice.spacing;
        }
        const double filled = filled_fraction(*body.shape, c.geometry, lower, upper, samples_per_direction);
        if (filled > trimming(c)) sites.push_back({index, centre, filled});
      }
  return sites;
}

Vector initial_velocity(const Case& c, const InitialVelocity& v, const Vector& x) {
  Vector from_centre = x - v.centre;
  if (c.geometry == Geometry::axisymmetric) from_centre[1] = 0.0;
  const double distance = std::sqrt(dot(from_centre, from_centre));
  Vector result = v.translation + cross(v.rotation, x - v.centre) + v.radial_rate * from_centre;
  if (distance > 0.0) result = result + (v.radial / distance) * from_centre;
  return result;
}

/// Weakest-link strength: of a volume V it is below s with probability 1 - exp(-(V/V0) ln 2 (s/median)^m).
double strength_factor(const StrengthDistribution& d, double volume, double uniform_number) {
  if (d.weibull_modulus == 0.0) return d.median;
  constexpr double highest = 5.0;  // of the median: no flaw at all
  const double ratio = d.reference_volume / volume * -std::log1p(-uniform_number) / std::numbers::ln2;
  return d.median * std::min(std::pow(ratio, 1.0 / d.weibull_modulus), highest);
}

template <int D>
void write_state(Particles& ps, int p, const State<double>& s) {
  using L = Layout<D>;
  double *load = ps.load.particle(p), *rest = ps.rest.particle(p);
  const double sigma[6] = {s.stress.xx, s.stress.yy, s.stress.zz, D == 3 ? s.stress.yz : s.stress.xy, s.stress.xz, s.stress.xy};
  for (int k = 0; k < L::stress_components; ++k) load[(L::Load::stress + k) * chunk_size] = sigma[k];
  load[L::Load::density * chunk_size] = s.density;
  for (const int k : {0, D == 3 ? 4 : 3, D == 3 ? 8 : 4}) rest[(L::Rest::deformation_gradient + k) * chunk_size] = 1.0;
  rest[L::Rest::energy * chunk_size] = s.energy, rest[L::Rest::temperature * chunk_size] = s.temperature;
  rest[L::Rest::porosity * chunk_size] = s.porosity, rest[L::Rest::damage * chunk_size] = s.damage;
  rest[L::Rest::shear_modulus * chunk_size] = s.shear_modulus;
  for (int k = 0; k < ps.history_columns; ++k) rest[(ps.history() + k) * chunk_size] = s.history[static_cast<std::size_t>(k)];
}

/// The affine field that belongs to the initial velocity: its gradient.
Tensor<double> initial_gradient(const Case& c, const InitialVelocity& v, const Vector& x, double step) {
  Tensor<double> g;
  const auto slope = [&](std::size_t axis) {
    Vector plus = x, minus = x;
    plus[axis] += step, minus[axis] -= step;
    return (0.5 / step) * (initial_velocity(c, v, plus) - initial_velocity(c, v, minus));
  };
  const Vector dx = slope(0), dy = slope(1), dz = slope(2);
  g.xx = dx[0], g.yx = dx[1], g.zx = dx[2], g.xy = dy[0], g.yy = dy[1], g.zy = dy[2], g.xz = dz[0], g.yz = dz[1], g.zz = dz[2];
  return g;
}

/// A face on a plane of symmetry, or at the axis, is inside the body.
bool lies_on_mirror(const Case& c, int axis, double position) {
  const double round_off = 1e-6 * c.cell_size;
  if (c.geometry == Geometry::axisymmetric && axis == 0 && std::abs(position) < round_off) return true;
  return std::any_of(c.boundaries.begin(), c.boundaries.end(), [&](const BoundaryConfig& b) {
    return b.kind == BoundaryKind::symmetry && static_cast<int>(b.axis) == axis && std::abs(b.position - position) < round_off;
  });
}

template <int D>
Body build(const Case& c, std::size_t number) {
  using L = Layout<D>;
  const BodyConfig& config = c.bodies[number];
  Body body;
  body.name = config.name, body.material = config.material.material;
  if (config.porosity) body.material.initial_porosity = config.porosity;
  if (config.damage) body.material.initial_damage = config.damage;
  body.locking_cure = config.locking_cure && body.material.flow_stress.has_value();
  std::vector<const LoadConfig*> loads;
  for (const LoadConfig& l : c.loads)
    if (l.body == config.name) {
      loads.push_back(&l);
      body.loads.push_back({l.pressure, l.traction, l.amplitude});
    }

  const Lattice lattice(c, config);
  const std::vector<Site> sites = fill(c, config, lattice);
  if (sites.empty())
    throw std::runtime_error(
        fmt::format("{}: the body gets no particles; its shape must fill at least {:.0f} % of a sub-cell of {:.4g} m",
                    config.name, 100.0 * trimming(c), lattice.spacing));
  body.particles =
      Particles(D, history_columns(body.material), static_cast<int>(loads.size()) * D, config.strength.has_value());
  Particles& ps = body.particles;
  ps.resize(static_cast<int>(sites.size()));
  std::vector<bool> occupied;
  if (!loads.empty()) {
    occupied.assign(static_cast<std::size_t>(lattice.count[0]) * static_cast<std::size_t>(lattice.count[1]) *
                        static_cast<std::size_t>(lattice.count[2]),
                    false);
    for (const Site& site : sites) occupied[lattice.number(site.index)] = true;
  }

  State<double> state = stress_free_state(body.material, config.temperature);
  body.initial_temperature = state.temperature, body.initial_energy = state.energy;
  for (int p = 0; p < ps.size; ++p) {
    const Site& site = sites[static_cast<std::size_t>(p)];
    const std::uint64_t id = static_cast<std::uint64_t>(number) << site_bits | lattice.number(site.index);
    ps.id[static_cast<std::size_t>(p)] = id;
    const auto draw = [&](const std::optional<InitialPorosity>& any_law, RandomProperty property, double& value) {
      if (any_law) std::visit([&](const auto& law) { value = law(uniform(c.numerics.seed, id, property)); }, *any_law);
    };
    draw(body.material.initial_porosity, RandomProperty::porosity, state.porosity);
    draw(body.material.initial_damage, RandomProperty::damage, state.damage);
    write_state<D>(ps, p, state);
    double volume = site.filled;
    for (int a = 0; a < D; ++a) volume *= lattice.spacing;
    if (c.geometry == Geometry::axisymmetric) volume *= site.centre[0];
    ps.load.at(L::Load::mass, p) = state.density * volume;
    ps.load.at(L::Load::density, p) = state.density;
    ps.load.at(L::Load::half_width, p) = 0.5 * lattice.spacing * std::pow(site.filled, 1.0 / D);
    const Vector v = initial_velocity(c, config.velocity, site.centre);
    const Tensor<double> g = initial_gradient(c, config.velocity, site.centre, 1e-3 * lattice.spacing);
    const double affine[3][3] = {{g.xx, g.xy, g.xz}, {g.yx, g.yy, g.yz}, {g.zx, g.zy, g.zz}};
    for (int a = 0; a < D; ++a) {
      ps.motion.at(L::Motion::position + a, p) = site.centre[static_cast<std::size_t>(a)];
      ps.motion.at(L::Motion::velocity + a, p) = v[static_cast<std::size_t>(a)];
      for (int b = 0; b < D; ++b)
        ps.motion.at(L::Motion::affine + D * a + b, p) =
            c.numerics.particle_velocity == ParticleVelocity::aflip ? affine[a][b] : 0.0;
    }
    if (config.strength) {
      // In two dimensions the body is one unit deep, or a whole turn.
      const double whole = c.geometry == Geometry::axisymmetric ? 2.0 * std::numbers::pi * volume : volume;
      ps.rest.at(ps.strength(), p) =
          strength_factor(*config.strength, whole, uniform(c.numerics.seed, id, RandomProperty::strength));
    }
    for (std::size_t l = 0; l < loads.size(); ++l)
      for (int a = 0; a < D; ++a) {
        double area = 0.0;
        for (const int side : {-1, 1}) {
          std::array<int, 3> next = site.index;
          next[static_cast<std::size_t>(a)] += side;
          if (lattice.holds(next) && occupied[lattice.number(next)]) continue;
          Vector face = site.centre;
          face[static_cast<std::size_t>(a)] += side * 0.5 * lattice.spacing;
          if (lies_on_mirror(c, a, face[static_cast<std::size_t>(a)])) continue;
          // The region is asked half-way into the particle: a face lies on the border of many a region.
          Vector inside = site.centre;
          inside[static_cast<std::size_t>(a)] += side * 0.25 * lattice.spacing;
          if (loads[l]->region && !contains(*loads[l]->region, inside)) continue;
          double size = side;
          for (int b = 1; b < D; ++b) size *= lattice.spacing;
          if (c.geometry == Geometry::axisymmetric) size *= face[0];
          area += size;
        }
        ps.rest.at(ps.area() + static_cast<int>(l) * D + a, p) = area;
      }
  }
  return body;
}

/// Cuts the blocks that hold particles into ranges of nearly equal numbers of particles.
Partition partition_of(const std::vector<Body>& bodies, const Grid& grid, int ranks) {
  Partition result;
  if (ranks == 1 || bodies.empty()) return result;
  std::vector<BlockKey> keys;
  for (const Body& body : bodies)
    for (int p = 0; p < body.particles.size; ++p) keys.push_back(block_of(body.particles, p, grid));
  std::sort(keys.begin(), keys.end());
  for (int r = 1; r < ranks; ++r) {
    const BlockKey key = keys[keys.size() * static_cast<std::size_t>(r) / static_cast<std::size_t>(ranks)];
    result.first.push_back(std::max(key, result.first.back()));
  }
  return result;
}

/// Keeps the particles of the blocks that this rank owns.
void keep_own(Simulation& s, Body& body) {
  if (s.domain->size() == 1) return;
  Particles& ps = body.particles;
  std::vector<std::uint32_t> own;
  for (int p = 0; p < ps.size; ++p)
    if (s.partition.owner(block_of(ps, p, s.grid)) == s.domain->rank()) own.push_back(static_cast<std::uint32_t>(p));
  ps.reorder(own);
  ps.resize(static_cast<int>(own.size()));
}

Boundary make_boundary(const Case& c, const BoundaryConfig& b) {
  Boundary result;
  result.name = b.name, result.kind = b.kind, result.axis = static_cast<int>(b.axis);
  result.node = static_cast<int>(std::lround(b.position / c.cell_size));
  result.inward = b.side == Side::above ? 1 : -1;
  result.position = result.node * c.cell_size, result.friction = b.friction, result.velocity = b.velocity;
  result.carries_grid = travels(c, b);
  return result;
}

}  // namespace

Body make_body(const Case& c, std::size_t number) {
  return c.dimensions() == 3 ? build<3>(c, number) : build<2>(c, number);
}

SubCell sub_cell_of(const Case& c, std::uint64_t id) {
  const Lattice lattice(c, c.bodies.at(static_cast<std::size_t>(id >> site_bits)));
  Vector x = lattice.lower(lattice.index(id & ((std::uint64_t{1} << site_bits) - 1)), c.dimensions());
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a) x[a] += 0.5 * lattice.spacing;
  return {x, lattice.spacing};
}

Simulation set_up(const Case& c, std::shared_ptr<Domain> domain) {
  Simulation s;
  s.geometry = c.geometry;
  s.numerics = {c.numerics.basis, c.numerics.stress_timing, c.numerics.particle_velocity, c.numerics.filter_time};
  s.gravity = c.gravity;
  s.domain = std::move(domain);
  s.grid.dimensions = c.dimensions(), s.grid.cell_size = c.cell_size;
  if (c.geometry == Geometry::axisymmetric && !c.bodies.empty()) {
    Boundary axis;
    axis.name = "axis", axis.kind = BoundaryKind::symmetry;
    s.boundaries.push_back(axis);
  }
  for (const BoundaryConfig& b : c.boundaries) s.boundaries.push_back(make_boundary(c, b));
  for (std::size_t b = 0; b < c.bodies.size(); ++b) s.bodies.push_back(make_body(c, b));
  s.partition = partition_of(s.bodies, s.grid, s.domain->size());
  for (Body& body : s.bodies) keep_own(s, body);
  s.gas = gas::make_gas(c, *s.domain);
  begin(s);
  return s;
}

}  // namespace brisance::simulator
