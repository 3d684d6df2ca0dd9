#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::specific_heat {

struct SteelLambda {
  static constexpr std::string_view name = "steel_lambda";
  static constexpr std::string_view equation =
      "cp = 190.14 - 273.75 t + 418.30 t^-0.2, t = 1 - T/1040 K below 1040 K;  "
      "cp = 465.21 + 267.52 t + 58.16 t^-0.35, t = T/1040 K - 1 above;  t >= 0.001, cp in J/(kg K)";
  static constexpr std::string_view source =
      "Form of Lederman, Salamon & Shacklette, Phys. Rev. B 9 (1974) 2981-2988, for the lambda peak of iron at the Curie "
      "point, where it is infinite; the floor of t bounds it at 1.86 kJ/(kg K).";

  static constexpr auto parameters = std::tuple{};

  template <class Real>
  Real operator()(const Real& temperature) const {
    constexpr double curie = 1040.0, closest = 1e-3;
    const Real reduced = clamp(temperature, 0.0, 1e5) * (1.0 / curie) - 1.0;
    const Real t = max(abs(reduced), Real(closest));
    const Real below = 190.14 - 273.75 * t + 418.30 * pow(t, -0.2);
    const Real above = 465.21 + 267.52 * t + 58.16 * pow(t, -0.35);
    return select(reduced < 0.0, below, above);
  }
};

}  // namespace brisance::specific_heat
