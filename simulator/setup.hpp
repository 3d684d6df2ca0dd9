#pragma once
// From a case to a simulation ready for its first step.

#include "simulator/config.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Fills the bodies with particles, places boundaries and loads, opens the books. On several ranks each keeps the particles of
/// its own blocks. Throws std::runtime_error when a body gets no particles.
Simulation set_up(const Case& c, std::shared_ptr<Domain> domain = single_process());

/// The particles of one body of a case, not yet sorted into blocks.
Body make_body(const Case& c, std::size_t number);

}  // namespace brisance::simulator
