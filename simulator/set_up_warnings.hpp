#pragma once
// What looks wrong with the way the bodies of a case start.

#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator {

/// One sentence each: bodies that start molten, and moving ones with nothing in their way.
std::vector<std::string> set_up_warnings(const Case& c);

}  // namespace brisance::simulator
