#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::damage {

/// What a fracture strain may depend on.
template <class Real>
struct Arguments {
  Real triaxiality{0.0};          // mean stress over equivalent stress, positive in tension
  Real plastic_strain_rate{0.0};  // 1/s
  Real temperature{0.0};          // K
  Real melting_temperature{0.0};  // K
};

}  // namespace brisance::damage
