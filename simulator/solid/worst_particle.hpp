#pragma once
// What a report says of the particle that keeps a step from being taken.

#include <string>

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// A particle's body, id, place, velocity and state in words.
std::string facts(const Simulation& s, const Body& body, int particle);

/// What one rank has to say of one of its particles; nothing if the text is empty.
struct Remark {
  double rating = 0.0;
  std::uint64_t id = 0;  // of the particle
  std::string text;
};
/// The text with the highest rating of all ranks, of equal ones that of the lowest id; empty if none says anything. The same on
/// every rank; all have to ask.
std::string highest_rated(Domain& domain, const Remark& mine);

/// The same of a particle whose motion or stress is not finite, or else of the one with the largest velocity gradient, after
/// velocity_gradients; of equal ones that of the lowest id. The same on every rank.
std::string fastest_deforming(const Simulation& s);

}  // namespace brisance::simulator
