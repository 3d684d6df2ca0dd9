#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"
#include "models/tensor.hpp"

namespace brisance::stability {

/// The tangent of a plastically loading point, with the strain rate frozen: Cep = Ce - (Ce:N)(N:Ce)/(N:Ce:N + Hd), where
/// N = a s + b I is normal to the yield surface and Ce isotropic. Any normalisation of N will do, if Hd has the same.
template <class Real>
struct Arguments {
  Real shear_modulus{0.0};                  // Pa
  Real bulk_modulus{0.0};                   // Pa, tangent
  SymmetricTensor<Real> deviatoric_stress;  // Pa, s
  Real mean_stress{0.0};                    // Pa, tension positive
  Real yield_stress{0.0};                   // Pa, of the matrix
  Real normal_deviatoric{0.0};              // a >= 0
  Real normal_volumetric{0.0};              // b
  Real plastic_modulus{0.0};                // Hd, adiabatic: hardening, thermal softening and porosity together
};

/// N:Ce:N
template <class Real>
Real elastic_stiffness_along_normal(const Arguments<Real>& at) {
  const Real a = at.normal_deviatoric, b = at.normal_volumetric;
  return 2.0 * at.shear_modulus * a * a * double_dot(at.deviatoric_stress, at.deviatoric_stress) +
         9.0 * at.bulk_modulus * b * b;
}

/// (Hd - critical)/(N:Ce:N): the margin that a law returns. A point without a normal is elastic, and stable.
template <class Real>
Real margin(const Arguments<Real>& at, const Real& critical_modulus) {
  const Real stiffness = elastic_stiffness_along_normal(at);
  const mask_of<Real> plastic = stiffness > 0.0;
  return select(plastic, (at.plastic_modulus - critical_modulus) / select(plastic, stiffness, Real(1.0)), Real(1.0));
}

}  // namespace brisance::stability
