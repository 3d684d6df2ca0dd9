#include "simulator/ledger.hpp"

#include <algorithm>

namespace brisance::simulator {

void Ledger::book(const ParticleTally& particles, const NodeTally& nodes, const std::vector<BoundaryTally>& boundaries,
                  bool external_forces) {
  Change internal = nodes.force;
  if (external_forces) {
    internal.energy = particles.internal;
    internal.momentum = nodes.force.momentum - particles.external.momentum;
    internal.angular_momentum = nodes.force.angular_momentum - particles.external.angular_momentum;
  }
  const Change moved = particles.flip - nodes.change;
  internal_force.add(internal), external.add(particles.external);
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    boundary[b].add(boundaries[b].impulse), friction[b].add(boundaries[b].friction);
  transfer.add(moved), filter.add(particles.filter), filter_heat.add(particles.filter_heat), advection.add(particles.advection);
  state = particles.state;
  peak_kinetic = std::max(peak_kinetic, state.energy);
}

Balance balance(const Ledger& ledger, const InternalEnergy& internal) {
  Balance b;
  b.kinetic = ledger.state.energy, b.internal = internal;
  b.external = ledger.external.total().energy;
  Change outside = ledger.external.total() + ledger.internal_force.total();
  for (const Account& a : ledger.boundary) b.boundary += a.total().energy, outside += a.total();
  for (const CompensatedSum& f : ledger.friction) b.friction += f.value();
  b.transfer = ledger.transfer.total().energy, b.filter = ledger.filter.total().energy;
  b.filter_heat = ledger.filter_heat.value();
  const double work = internal.stress_work + internal.viscous_work + ledger.outflow_work;
  b.stress_timing = work + ledger.internal_force.total().energy;
  b.outflow = ledger.outflow.total().energy + ledger.outflow_internal;
  // Two closures: what the particles' motion changed by, and what their internal energy changed by.
  const Change motion = (ledger.state + ledger.outflow.total()) - ledger.initial - outside - ledger.transfer.total() -
                        ledger.filter.total() - ledger.advection.total();
  const double heat = (internal.total + ledger.outflow_internal) - ledger.initial_internal - work - b.filter_heat;
  b.residual = (motion.energy < 0 ? -motion.energy : motion.energy) + (heat < 0 ? -heat : heat);
  b.momentum_residual = motion.momentum, b.angular_momentum_residual = motion.angular_momentum;
  return b;
}

}  // namespace brisance::simulator
