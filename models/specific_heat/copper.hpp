#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::specific_heat {

struct Copper {
  static constexpr std::string_view name = "copper";
  static constexpr std::string_view equation =
      "cp = max(4.16e-5 T^3 - 0.027 T^2 + 6.21 T - 142.6, 20) below 270 K;  cp = 0.1009 T + 358.4 above;  cp in J/(kg K)";
  static constexpr std::string_view source =
      "Fit to handbook data of MacDonald & MacDonald, Phys. Rev. B 24 (1981) 1715-1724, and Osborne & Kirby (1977). The two "
      "parts differ by 1 J/(kg K) where they meet; the floor is our choice, the cubic is negative below 26 K.";

  static constexpr auto parameters = std::tuple{};

  template <class Real>
  Real operator()(const Real& temperature) const {
    constexpr double joint = 270.0;
    const Real T = clamp(temperature, 0.0, 1e5);
    const Real cold = min(T, Real(joint));
    const Real cubic = -142.6 + cold * (6.21 + cold * (-0.027 + cold * 4.16e-5));
    return select(T < joint, max(cubic, Real(20.0)), 0.1009 * T + 358.4);
  }
};

}  // namespace brisance::specific_heat
