#pragma once
// Artificial viscosity: a pressure q that spreads a shock over a few cells and supplies its entropy.

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance {

struct ArtificialViscosity {
  static constexpr std::string_view name = "artificial_viscosity";
  static constexpr std::string_view equation = "q = rho h |tr D| (C1 c + C2 h |tr D|) in compression, 0 in expansion";
  static constexpr std::string_view source =
      "von Neumann & Richtmyer, J. Appl. Phys. 21 (1950) 232-237; linear term: Landshoff, LA-1930 (1955)";

  double linear = 0.06;
  double quadratic = 1.5;

  static constexpr auto parameters =
      std::tuple{Parameter{"linear", &ArtificialViscosity::linear, Unit::one, "C1", non_negative, 0.06},
                 Parameter{"quadratic", &ArtificialViscosity::quadratic, Unit::one, "C2", non_negative, 1.5}};

  /// q in Pa, from density, cell size h (m), bulk sound speed c (m/s) and rate of volume change tr D (1/s).
  template <class Real>
  Real operator()(const Real& density, const Real& cell_size, const Real& sound_speed, const Real& volume_rate) const {
    const Real jump = cell_size * max(-volume_rate, Real(0.0));
    return density * jump * (linear * sound_speed + quadratic * jump);
  }
};

}  // namespace brisance
