#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::flow_stress {

/// What a flow stress may depend on. `plastic_strain` is that of the matrix (the metal between the pores).
template <class Real>
struct Arguments {
  Real plastic_strain{0.0};       // -
  Real plastic_strain_rate{0.0};  // 1/s
  Real temperature{0.0};          // K
  Real melting_temperature{0.0};  // K
  Real shear_modulus{0.0};        // Pa
  Real pressure{0.0};             // Pa, positive in compression
  Real density{0.0};              // kg/m^3
};

/// The nearest state at which every formula is finite. A solver asks for strains and temperatures that no metal reaches
/// before it settles on one that it does; `lowest_rate` is the law's quasi-static limit.
template <class Real>
Arguments<Real> bounded(const Arguments<Real>& at, double lowest_rate) {
  Arguments<Real> near = at;
  near.plastic_strain = clamp(at.plastic_strain, 0.0, 1e6);
  near.plastic_strain_rate = clamp(at.plastic_strain_rate, lowest_rate, 1e20);
  near.melting_temperature = clamp(at.melting_temperature, 1.0, 1e7);
  near.temperature = max(min(at.temperature, near.melting_temperature), Real(0.0));
  near.shear_modulus = clamp(at.shear_modulus, 1.0, 1e15);
  near.density = clamp(at.density, 1.0, 1e6);
  return near;
}

/// A number or a state as it is, without the derivatives it carries.
inline double without_derivatives(double x) {
  return x;
}
template <class Real>
requires(!std::is_arithmetic_v<Real>) const Real& without_derivatives(const Real& x) {
  return x;
}
template <class Base, int N>
const Base& without_derivatives(const Dual<Base, N>& x) {
  return x.value;
}
template <class Real>
auto without_derivatives(const Arguments<Real>& at) {
  return Arguments<std::remove_cvref_t<decltype(without_derivatives(at.density))>>{
      without_derivatives(at.plastic_strain), without_derivatives(at.plastic_strain_rate),
      without_derivatives(at.temperature),    without_derivatives(at.melting_temperature),
      without_derivatives(at.shear_modulus),  without_derivatives(at.pressure),
      without_derivatives(at.density)};
}

/// The strength of a solid; a liquid has none.
template <class Real>
Real if_solid(const Arguments<Real>& at, const Real& strength) {
  return select(at.temperature < at.melting_temperature, max(strength, Real(0.0)), Real(0.0));
}

}  // namespace brisance::flow_stress
