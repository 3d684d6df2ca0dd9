#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"
#include "models/state.hpp"

namespace brisance::failure {

/// What a failure criterion may look at, at the end of a step.
template <class Real>
struct Arguments {
  Real temperature{0.0};          // K
  Real melting_temperature{0.0};  // K
  Real plastic_strain{0.0};       // -, of the matrix
  Real damage{0.0};               // -
  Real porosity{0.0};             // -
  Real capacity_used{0.0};        // -, f*/fu of a porous yield surface: 1 when it has shrunk to a point; 0 without one
  Real stability_margin{1.0};     // -, the least of the material's stability laws; <= 0 is unstable
  Real mean_stress{0.0};          // Pa, positive in tension
};

/// A point counts as without strength when this part of the yield surface is gone. f* is kept just below fu, where
/// the surface is a point and no longer has a normal.
inline constexpr double exhausted_capacity = 1.0 - 1e-3;

}  // namespace brisance::failure
