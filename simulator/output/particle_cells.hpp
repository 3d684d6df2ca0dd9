#pragma once
// What particles fill, for pictures.

#include <vector>

#include "simulator/config.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Corners (m) of what a particle fills in the plane of x and y: the sub-cell it was made in, as far as the shape of its body
/// fills that, deformed with the material. No part is longer than a cell to either side: particles farther apart do not feel
/// each other. Empty where, in three dimensions, the plane does not cut the particle. The case is that of the body.
std::vector<Vector> cell_of_particle(const Case& c, const Body& body, int particle);

}  // namespace brisance::simulator
