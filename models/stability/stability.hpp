#pragma once
// Stability of the material at a point: does the tangent still resist every increment (drucker), or every plane band of
// deformation (acoustic_tensor)? A law gives a margin, a number relative to the elastic stiffness: unstable at and below 0.
// The tangent is the inviscid one, rate frozen, for a rate-dependent material strictly never loses ellipticity. Flow is
// associated, so the acoustic tensor never fires before Drucker's postulate is violated, unless it counts finite stress.

#include <variant>

#include "models/stability/acoustic_tensor.hpp"
#include "models/stability/drucker.hpp"

namespace brisance {

using Stability = std::variant<stability::Drucker, stability::AcousticTensor>;

}  // namespace brisance
