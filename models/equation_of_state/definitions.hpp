#pragma once

#include <limits>
#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::equation_of_state {

/// What the energy argument of a law means.
enum class Caloric {
  complete,    // p(rho, e) and e(rho, T) are one thermodynamic potential: T follows from rho and e (gases, products)
  energy,      // p(rho, e) with the specific internal energy e; T is evolved by the heat sources (solids)
  thermal,     // p(rho, e) with e standing for the thermal energy e(rho, T) alone; T is evolved (Zocher's form)
  barotropic,  // p(rho); the energy has no influence
  incremental  // barotropic, but only differences of p between two densities count (hypoelastic)
};

/// Densities between which a law holds, kg/m^3.
struct DensityRange {
  double lowest = 0.0;
  double highest = std::numeric_limits<double>::infinity();
};

}  // namespace brisance::equation_of_state
