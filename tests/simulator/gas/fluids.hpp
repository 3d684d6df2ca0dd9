#pragma once
// Fluids that several tests have in common.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas::set_up {

inline const Fluid air = {"air", equation_of_state::IdealGas{1.4, 718.0}};
inline const Fluid water = {"water", equation_of_state::StiffenedGas{4.4, 6e8, 1000.0}};
/// Of PBX 9501.
inline const Fluid products = {"products",
                               equation_of_state::JonesWilkinsLee{1838.0, 1668.9e9, 59.69e9, 5.9, 2.1, 0.45, 594.96, 10.2e9}};

}  // namespace brisance::simulator::gas::set_up
