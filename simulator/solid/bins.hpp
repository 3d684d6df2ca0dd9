#pragma once
// Which particles are in which block, in the order in which they are summed: by block, then by id.

#include <span>

#include "simulator/solid/particles.hpp"

namespace brisance::simulator {

/// The particles of one block: positions [begin, end) of Bins::order.
struct Bin {
  BlockKey block;
  std::uint32_t begin, end;
};

struct Bins {
  std::vector<std::uint32_t> order;  // particle numbers
  std::vector<Bin> bins;             // in Morton order of the blocks
  std::size_t strayed = 0;           // particles that have changed their block since they were last put in order in memory

  /// From the particles' blocks and ids.
  void sort(const Particles& particles);
  /// The same result as sort(), given which particles (by number, any order) may stand in the wrong bin.
  void move(const Particles& particles, std::span<const std::uint32_t> movers);
};

/// Puts the particles in memory in the order of their bins, if enough have strayed.
void tidy(Particles& particles, Bins& bins);

}  // namespace brisance::simulator
