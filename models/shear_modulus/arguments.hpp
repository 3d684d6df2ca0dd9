#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::shear_modulus {

/// What a shear modulus may depend on.
template <class Real>
struct Arguments {
  Real temperature{0.0};          // K
  Real melting_temperature{0.0};  // K
  Real pressure{0.0};             // Pa, positive in compression
  Real density{0.0};              // kg/m^3
  Real compression{1.0};          // density over reference density
};

/// max(1 + A p/eta^(1/3), 1/2): stiffening by pressure. It is a line fitted in compression; in tension it stops at one half.
template <class Real>
Real pressure_factor(const Arguments<Real>& at, double A) {
  return max(1.0 + A * at.pressure / pow(max(at.compression, Real(1e-3)), 1.0 / 3.0), Real(0.5));
}

}  // namespace brisance::shear_modulus
