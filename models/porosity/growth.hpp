#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::porosity {

struct Growth {
  static constexpr std::string_view name = "growth";
  static constexpr std::string_view equation = "df/dt = (1 - f) tr Dp";
  static constexpr std::string_view source = "Gurson, J. Eng. Mater. Technol. 99 (1977) 2-15: mass balance of a rigid matrix";
  static constexpr bool nucleates_in_compression = false;

  static constexpr auto parameters = std::tuple{};

  template <class Real>
  Real nucleated(const Real& /*plastic_strain*/) const {
    return Real(0.0);
  }
};

}  // namespace brisance::porosity
