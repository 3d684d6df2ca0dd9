#pragma once
// What a material point remembers between steps. Conventions of the whole library: SI units; stresses positive in tension,
// pressure positive in compression; Cauchy stress in the current frame.

#include <array>

#include "models/tensor.hpp"

namespace brisance {

/// Why a point failed; the first criterion that fired is kept.
enum class FailureCause { none, melting, tepla_f, critical_damage, critical_porosity, instability, tensile_limit };

/// Columns available to laws with a memory of their own (threshold stress, partial stresses and crack radius, ...).
inline constexpr int history_capacity = 32;

template <class Real>
struct State {
  SymmetricTensor<Real> stress;                                  // Pa
  Tensor<Real> deformation_gradient = Tensor<Real>::identity();  // -
  Real density{0.0};                                             // kg/m^3
  Real energy{0.0};                                              // J/kg, specific internal energy
  Real temperature{0.0};                                         // K
  Real plastic_strain{0.0};                                      // -, of the matrix
  Real plastic_strain_rate{0.0};                                 // 1/s, of the matrix
  Real plastic_volume_strain{0.0};                               // -, logarithmic, voids of dilatant flow or a melt
  Real porosity{0.0};                                            // -
  Real damage{0.0};                                              // -
  Real shear_modulus{0.0};                                       // Pa, the one the stress was computed with
  Real strength{1.0};                                            // -, factor on the flow stress, of this point's flaws
  Real flow_history{0.0};                                        // history variable of the flow stress, in its own unit
  Real failure_cause{0.0};                                       // FailureCause as a number: lanes hold only numbers
  Real failure_time{0.0};                                        // s
  std::array<Real, history_capacity> history{};                  // further columns of the material's laws
};

}  // namespace brisance
