#pragma once
// From the case to the gas.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// The gas of a case, filled and ready for its first step; empty if the case has none.
Gas make_gas(const Case& c, Domain& domain);

}  // namespace brisance::simulator::gas
