#pragma once

#include "models/melting/arguments.hpp"

namespace brisance::melting {

struct LinearInPressure {
  static constexpr std::string_view name = "linear_in_pressure";
  static constexpr std::string_view equation = "Tm = max(Tm0 + b p, 1 K)";
  static constexpr std::string_view source = "Clapeyron's slope at ambient pressure, continued as a line";

  double ambient_value, slope;

  static constexpr auto parameters = std::tuple{
      Parameter{"ambient_value", &LinearInPressure::ambient_value, Unit::K, "Tm0, melting point at no pressure", at_least(1.0)},
      Parameter{"slope", &LinearInPressure::slope, Unit::K_per_Pa, "b = dTm/dp"}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    return max(ambient_value + slope * at.pressure, Real(1.0));
  }
};

}  // namespace brisance::melting
