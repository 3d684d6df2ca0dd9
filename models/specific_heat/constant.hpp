#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::specific_heat {

struct Constant {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view equation = "cp = cp0";
  static constexpr std::string_view source = "a single value for the temperature range of interest";

  double value;

  static constexpr auto parameters =
      std::tuple{Parameter{"value", &Constant::value, Unit::J_per_kg_K, "cp0, specific heat", positive}};

  template <class Real>
  Real operator()(const Real& /*temperature*/) const {
    return Real(value);
  }
};

}  // namespace brisance::specific_heat
