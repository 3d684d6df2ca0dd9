#pragma once
// Mass, energy, momentum, volume: of the whole where the geometry knows it, else per metre of depth or length, or per square
// metre of cross-section.

#include <string_view>

#include "models/parameters.hpp"
#include "simulator/config.hpp"

namespace brisance::simulator {

enum class Extensive { mass, energy, momentum, angular_momentum, force, volume };

/// The unit of what is shown, "J/m".
Unit unit_of(Extensive quantity, Geometry geometry);

}  // namespace brisance::simulator
