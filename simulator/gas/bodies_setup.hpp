#pragma once
// From the case to the bodies in the gas.

#include <cstddef>
#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/gas/bodies.hpp"

namespace brisance::simulator::gas {

/// The particles of a body and its motion. Throws std::runtime_error if it gets no particles.
MovingBody make_body(const Case& c, const GasBodyConfig& config);

/// Bodies that overlap: a sentence of each pair.
std::vector<std::string> overlaps_of_bodies(const Case& c);
/// Bodies so thin that the cells do not show them: a sentence of each.
std::vector<std::string> bodies_that_do_not_show(const Case& c);

/// Whether a side of the box is a wall.
bool is_wall(const Case& c, std::size_t side);

/// Of walls through which gas would leak.
std::vector<std::string> warnings_of_bodies(const Case& c);

}  // namespace brisance::simulator::gas
