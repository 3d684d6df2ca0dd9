#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::melting {

/// What a melting temperature may depend on.
template <class Real>
struct Arguments {
  Real pressure{0.0};     // Pa, positive in compression
  Real compression{1.0};  // density over reference density
};

}  // namespace brisance::melting
