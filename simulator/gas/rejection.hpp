#pragma once
// Why a step of the gas was rejected.

#include <string>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// What the last step, which was rejected, failed at, and in which of this process's cells: in words.
std::string why_rejected(const Gas& gas);

}  // namespace brisance::simulator::gas
