#pragma once

#include "models/melting/arguments.hpp"

namespace brisance::melting {

struct Constant {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view equation = "Tm = Tm0";
  static constexpr std::string_view source = "the value at ambient pressure, taken to hold at any";

  double value;

  static constexpr auto parameters =
      std::tuple{Parameter{"value", &Constant::value, Unit::K, "Tm0, melting temperature", positive}};

  template <class Real>
  Real operator()(const Arguments<Real>&) const {
    return Real(value);
  }
};

}  // namespace brisance::melting
