#pragma once
// The books of a run: energy, momentum and angular momentum, each change booked where it happens and by its own formula. The
// two numerical entries compare two such sums (what the grid gives with what the particles get); none is what is left over
// when the others have been taken away, so an impulse or a work that is forgotten shows as a residual.
//
//   kinetic energy    changes by the work of the grid's forces and boundaries, by the transfer between particles and grid, and
//                     by the filter of the particle velocities
//   internal energy   changes by the work of the stress and of the artificial viscosity on the particles, and by the heat of
//                     the filter
//   stress timing     is the difference between what the internal forces take from the grid and what the particles receive
//
// In the axisymmetric geometry everything is per radian.

#include <array>
#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator {

/// Something that acts over a step: energy (J), momentum (N s) and angular momentum about the origin (N m s).
struct Change {
  double energy = 0.0;
  Vector momentum{}, angular_momentum{};

  Change& operator+=(const Change& b) {
    energy += b.energy;
    momentum = momentum + b.momentum, angular_momentum = angular_momentum + b.angular_momentum;
    return *this;
  }
  friend Change operator+(Change a, const Change& b) { return a += b; }
  friend Change operator*(double f, const Change& a) { return {f * a.energy, f * a.momentum, f * a.angular_momentum}; }
  friend Change operator-(const Change& a, const Change& b) {
    return {a.energy - b.energy, a.momentum - b.momentum, a.angular_momentum - b.angular_momentum};
  }
};

/// What the particles do within a step.
struct ParticleTally {
  Change state;              // kinetic energy, momentum and angular momentum at the end of the step
  Change flip;               // by the change of the grid velocities
  Change filter;             // by the filter of the particle velocities
  Change external;           // by gravity, body forces and loads
  Change advection;          // angular momentum by the motion across itself; nothing else
  double internal = 0.0;     // J, work of the stress on the gradient of the grid velocity; only where external forces act
  double filter_heat = 0.0;  // J, what the filter turns to heat

  ParticleTally& operator+=(const ParticleTally& b) {
    state += b.state, flip += b.flip, filter += b.filter, external += b.external, advection += b.advection;
    internal += b.internal, filter_heat += b.filter_heat;
    return *this;
  }
};

/// What the nodes do within a step.
struct NodeTally {
  Change change;  // of the grid velocities
  Change force;   // by internal and external forces together
  NodeTally& operator+=(const NodeTally& b) {
    change += b.change, force += b.force;
    return *this;
  }
};

/// What one boundary does to the nodes.
struct BoundaryTally {
  Change impulse;         // friction included
  double friction = 0.0;  // J, of the impulse's energy
  BoundaryTally& operator+=(const BoundaryTally& b) {
    impulse += b.impulse, friction += b.friction;
    return *this;
  }
};

/// A sum that keeps what rounding drops (Neumaier).
class CompensatedSum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    lost_ += (sum_ < 0 ? -sum_ : sum_) >= (x < 0 ? -x : x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

/// A Change summed over many steps.
struct Account {
  CompensatedSum energy;
  std::array<CompensatedSum, 3> momentum, angular_momentum;

  void add(const Change& c) {
    energy.add(c.energy);
    for (std::size_t a = 0; a < 3; ++a) momentum[a].add(c.momentum[a]), angular_momentum[a].add(c.angular_momentum[a]);
  }
  Change total() const {
    return {energy.value(),
            {momentum[0].value(), momentum[1].value(), momentum[2].value()},
            {angular_momentum[0].value(), angular_momentum[1].value(), angular_momentum[2].value()}};
  }
};

struct Ledger {
  Change initial;                        // kinetic energy, momentum, angular momentum of the particles
  double initial_internal = 0.0;         // J
  Change state;                          // now
  double peak_kinetic = 0.0;             // J
  Account internal_force;                // work of the internal forces on the grid
  Account external;                      // gravity, body forces, loads
  std::vector<Account> boundary;         // impulses of each boundary
  std::vector<CompensatedSum> friction;  // J, of each boundary's energy
  Account transfer;                      // what the particles receive of a change of the grid velocities, less that change
  Account filter;                        // of the particle velocities
  CompensatedSum filter_heat;            // J, what the filter has turned to heat
  Account advection;                     // angular momentum only
  Account outflow;                       // carried away by particles that have left
  double outflow_internal = 0.0;         // J
  double outflow_work = 0.0;             // J, that stress and viscosity had done on them
  double outflow_mass = 0.0;             // kg

  /// Books an accepted step. `external_forces` tells whether any act, so that internal and external work are told apart.
  void book(const ParticleTally& particles, const NodeTally& nodes, const std::vector<BoundaryTally>& boundaries,
            bool external_forces);
};

/// The internal energy of particles, how it came about, and where it is; summed in the order of the bins.
struct InternalEnergy {
  double total = 0.0;         // J
  double gained = 0.0;        // J, since the start
  double stress_work = 0.0;   // J, of the stress on the particles since the start
  double viscous_work = 0.0;  // J, of the artificial viscosity
  double plastic_work = 0.0;  // J, part of the stress work
  double plastic_heat = 0.0;  // J, part of the plastic work that became heat; the other part is stored cold work
  double thermal = 0.0;       // J, heat that the change of temperature since the start stands for
  double elastic = 0.0;       // J, of the deviatoric stress: s:s/(4 mu)
  double mass = 0.0;          // kg
  InternalEnergy& operator+=(const InternalEnergy& b) {
    total += b.total, gained += b.gained, stress_work += b.stress_work, viscous_work += b.viscous_work;
    plastic_work += b.plastic_work, plastic_heat += b.plastic_heat, thermal += b.thermal;
    elastic += b.elastic, mass += b.mass;
    return *this;
  }
  friend InternalEnergy operator*(double f, const InternalEnergy& a) {
    return {f * a.total,        f * a.gained,  f * a.stress_work, f * a.viscous_work, f * a.plastic_work,
            f * a.plastic_heat, f * a.thermal, f * a.elastic,     f * a.mass};
  }
  double stored_cold_work() const { return plastic_work - plastic_heat; }
  /// What compression has stored without heat: what is left of the energy gained.
  double cold() const { return gained - thermal - elastic - stored_cold_work(); }
};

/// One look at the books.
struct Balance {
  double kinetic = 0.0;                                      // J
  InternalEnergy internal;                                   // of all bodies
  double external = 0.0, boundary = 0.0, friction = 0.0;     // J
  double transfer = 0.0, filter = 0.0, stress_timing = 0.0;  // J, numerical
  double filter_heat = 0.0;                                  // J, what of the filter's loss has become heat
  double outflow = 0.0;                                      // J
  double residual = 0.0;                                     // J, in no bin
  Vector momentum_residual{}, angular_momentum_residual{};
  double numerical() const { return transfer + filter + filter_heat + stress_timing; }
  friend Balance operator*(double f, const Balance& a) {
    return {f * a.kinetic,
            f * a.internal,
            f * a.external,
            f * a.boundary,
            f * a.friction,
            f * a.transfer,
            f * a.filter,
            f * a.stress_timing,
            f * a.filter_heat,
            f * a.outflow,
            f * a.residual,
            f * a.momentum_residual,
            f * a.angular_momentum_residual};
  }
};
Balance balance(const Ledger& ledger, const InternalEnergy& internal);

}  // namespace brisance::simulator
