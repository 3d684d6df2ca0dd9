#pragma once

#include "models/stability/arguments.hpp"

namespace brisance::stability {

struct Drucker {
  static constexpr std::string_view name = "drucker";
  static constexpr std::string_view equation = "unstable when Hd <= tolerance N:Ce:N  (stress rate : plastic strain rate <= 0)";
  static constexpr std::string_view source =
      "Drucker, J. Appl. Mech. 26 (1959) 101-106; Hd is the adiabatic modulus at frozen strain rate";

  double tolerance;

  static constexpr auto parameters = std::tuple{
      Parameter{"tolerance", &Drucker::tolerance, Unit::one,
                "plastic modulus, as a part of N:Ce:N, at and below which the point counts as unstable", any_value, 0.0}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    return margin(at, Real(0.0)) - tolerance;
  }
};

}  // namespace brisance::stability
