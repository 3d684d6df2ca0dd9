#pragma once
// The memory that a case will take, from its numbers alone: said before anything is allocated.

#include <string_view>

#include "simulator/config.hpp"

namespace brisance::simulator {

struct MemoryNeed {
  double points = 0.0;         // particles of all bodies, or cells of the gas
  double bytes = 0.0;          // an estimate, to a quarter; a run has checkpoints and pictures beside it
  std::string_view name = "";  // of the points: "particles", "cells"
};
MemoryNeed memory_need(const Case& c);

/// Memory in bytes that this process may still take: what the machine has free and what the limits of the process and of its
/// control group leave. Infinite where nothing is known.
double available_memory();

/// Throws std::invalid_argument, with numbers and a cell size that would fit, if a case needs more than `available` bytes.
void require_memory(const Case& c, double available);

}  // namespace brisance::simulator
