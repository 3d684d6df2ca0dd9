#pragma once
// What the particles of bodies hold of internal energy, and what it consists of.

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// The internal energy of a body's particles, or of all, summed in the order of the bins.
InternalEnergy internal_energy(const Simulation& s, const Body& body);
InternalEnergy internal_energy(const Simulation& s);

}  // namespace brisance::simulator
