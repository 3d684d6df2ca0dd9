#pragma once
// Heat: rho cp dT/dt = chi (plastic power) + (power of the artificial viscosity) - rho cp T Gamma tr D.

#include <string_view>
#include <tuple>

#include "models/parameters.hpp"

namespace brisance {

/// Which work becomes heat.
struct Heating {
  static constexpr std::string_view name = "heating";
  static constexpr std::string_view equation =
      "rho cp dT/dt = chi (1 - f) Y dep/dt + q tr(-D) [viscous] - rho cp Gamma T tr D [thermoelastic]";
  static constexpr std::string_view source = "Taylor & Quinney, Proc. R. Soc. A 143 (1934) 307-326";

  Table taylor_quinney;
  bool viscous;
  bool thermoelastic;

  static constexpr auto parameters = std::tuple{
      Parameter{"taylor_quinney", &Heating::taylor_quinney, Unit::one,
                "chi, fraction of the plastic work that becomes heat: a number, or a table against plastic strain", fraction},
      Parameter{"viscous", &Heating::viscous, Unit::one, "heat by the artificial viscosity", any_value, true},
      Parameter{"thermoelastic", &Heating::thermoelastic, Unit::one, "heat by reversible compression", any_value, false}};
};

}  // namespace brisance
