#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::specific_heat {

struct Polynomial {
  static constexpr std::string_view name = "polynomial";
  static constexpr std::string_view equation =
      "cp = max(c0 + c1 T + c2 T^2 + c3 T^3, 1 J/(kg K)), T clamped to [lowest_temperature, highest_temperature]";
  static constexpr std::string_view source = "a fit; it is not continued outside the temperatures it was made for";

  std::array<double, 4> coefficients;
  double lowest_temperature, highest_temperature;

  static constexpr auto parameters =
      std::tuple{Parameter{"coefficients", &Polynomial::coefficients, Unit::J_per_kg_K, "c0, c1, c2, c3 for T in K", any_value},
                 Parameter{"lowest_temperature", &Polynomial::lowest_temperature, Unit::K, "below it cp stays constant",
                           non_negative, 0.0},
                 Parameter{"highest_temperature", &Polynomial::highest_temperature, Unit::K, "above it cp stays constant",
                           Interval{0.0, 1e5, true}, 1e5}};

  template <class Real>
  Real operator()(const Real& temperature) const {
    const Real T = clamp(temperature, lowest_temperature, highest_temperature);
    const auto& c = coefficients;
    return max(c[0] + T * (c[1] + T * (c[2] + T * c[3])), Real(1.0));
  }
};

}  // namespace brisance::specific_heat
