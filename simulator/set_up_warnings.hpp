#pragma once
// What looks wrong with the way a case starts.

#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator {

/// One sentence each: bodies that start molten, moving ones with nothing in their way, reactions that nothing starts, fills of
/// few cells, bodies in a gas that it leaks through or that it does not meet, more output than anyone reads.
std::vector<std::string> set_up_warnings(const Case& c);

}  // namespace brisance::simulator
