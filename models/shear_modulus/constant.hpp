#pragma once

#include "models/shear_modulus/arguments.hpp"

namespace brisance::shear_modulus {

struct Constant {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view equation = "mu = mu0";
  static constexpr std::string_view source = "Hooke's law";

  double value;

  static constexpr auto parameters =
      std::tuple{Parameter{"value", &Constant::value, Unit::Pa, "mu0, shear modulus", non_negative}};

  template <class Real>
  Real operator()(const Arguments<Real>&) const {
    return Real(value);
  }
};

}  // namespace brisance::shear_modulus
