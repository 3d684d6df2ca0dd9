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

/// The sub-cell that the particle with this number was made in, in the undeformed body. Throws std::out_of_range for a body
/// that the case does not have.
struct SubCell {
  Vector centre;
  double width;
};
SubCell sub_cell_of(const Case& c, std::uint64_t id);

}  // namespace brisance::simulator
