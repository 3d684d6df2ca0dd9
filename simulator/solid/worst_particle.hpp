#pragma once
// What a report says of the particle that keeps a step from being taken.

#include <string>

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// A particle's body, id, place, velocity and state in words.
std::string facts(const Simulation& s, const Body& body, int particle);

/// The same of a particle whose motion or stress is not finite, or else of the one with the largest velocity gradient, after
/// velocity_gradients; of equal ones that of the lowest id. The same on every rank.
std::string fastest_deforming(const Simulation& s);

}  // namespace brisance::simulator
