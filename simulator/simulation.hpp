#pragma once
// A simulation as it stands between two steps.

#include <functional>
#include <memory>

#include "models/material.hpp"
#include "simulator/config.hpp"
#include "simulator/domain/domain.hpp"
#include "simulator/gas/gas.hpp"
#include "simulator/grid/boundary.hpp"
#include "simulator/grid/grid.hpp"
#include "simulator/ledger.hpp"
#include "simulator/phase_times.hpp"
#include "simulator/solid/bins.hpp"
#include "simulator/solid/particles.hpp"

namespace brisance::simulator {

struct Body;

/// Replaces a body's material: stress from deformation gradient, for manufactured solutions. Sees one chunk of particles whose
/// deformation gradient and density are those of the end of the step; writes their stress (column set `load`).
using StressFunction = std::function<void(Body& body, int particle)>;
/// Force per mass (m/s^2) at a place and time.
using BodyForce = std::function<Vector(const Vector& position, double time)>;

/// Pressure and traction on the part of a body's surface that its area columns describe.
struct SurfaceLoad {
  std::optional<Table> pressure;  // Pa against s
  Vector traction{};              // Pa
  std::optional<Table> amplitude;
};

struct Body {
  std::string name;
  Material material;
  int field = 0;  // the velocity field its particles move in; a second one, for particles that choose it, is the next
  bool locking_cure = false;
  double initial_temperature = 0.0, initial_energy = 0.0;  // K, J/kg: where the books of heat start
  Particles particles;
  Bins bins;
  std::vector<SurfaceLoad> loads;  // one for each three (two) area columns
  StressFunction stress;           // empty: the material's own update
};

/// How the step goes about things; does not change during a run.
struct Numerics {
  Basis basis = Basis::quadratic_spline;
  StressTiming stress_timing = StressTiming::musl;
  ParticleVelocity particle_velocity = ParticleVelocity::aflip;
  double filter_time = 30.0;  // cell size over sound speed
};

/// The largest values over the particles, for the size of the next step. Exact, whatever the order.
struct Extremes {
  double wave_speed = 0.0;       // m/s, of the material with its artificial viscosity
  double wave_and_motion = 0.0;  // m/s, the same plus the largest component of the velocity across the grid
  double speed = 0.0;            // m/s, largest component across the grid
  double volume_rate = 0.0;      // 1/s, |tr L|
  double filling = 0.0;          // density over the highest, or the lowest over it, that the equation of state holds for
};

struct Simulation {
  Geometry geometry = Geometry::three_dimensional;
  Numerics numerics;
  std::vector<Body> bodies;
  gas::Gas gas;
  std::vector<Boundary> boundaries;
  Vector gravity{};
  BodyForce body_force;  // empty: none
  Grid grid;
  Partition partition;
  std::shared_ptr<Domain> domain = single_process();

  double time = 0.0;            // s
  std::int64_t step = 0;        // steps done
  double last_time_step = 0.0;  // s, 0 before the first
  Extremes extremes;
  Ledger ledger;
  PhaseTimes times;  // of this process, since the start or restart

  int dimensions() const { return number_of_dimensions(geometry); }
  bool has_external_forces() const {
    if (body_force || dot(gravity, gravity) > 0.0) return true;
    for (const Body& b : bodies)
      if (!b.loads.empty()) return true;
    return false;
  }
};

}  // namespace brisance::simulator
