#pragma once
// What follows a step: particles take their new places, change blocks and ranks, leave through outflows; the books are kept.

#include "simulator/solid/nodes.hpp"
#include "simulator/solid/transfer.hpp"

namespace brisance::simulator {

/// The block whose node is nearest to a particle.
BlockKey block_of(const Particles& particles, int particle, const Grid& grid);
/// Blocks and bins of all particles from their positions; particles go to the ranks that own their blocks.
void place_particles(Simulation& s);
/// The blocks of the grid that the particles need.
void activate_blocks(Simulation& s);
/// Makes the motion that a step has prepared the state, and books what it did.
void accept_motion(Simulation& s, const ParticleResult& particles, const NodeResult& nodes, double dt);
/// Kinetic energy, momentum and angular momentum of a body's particles, summed in the order of the bins.
Change motion_of(const Simulation& s, const Body& body);
/// Opening entries of the ledger, from the state of the particles.
void open_books(Simulation& s);

}  // namespace brisance::simulator
