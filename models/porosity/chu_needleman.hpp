#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::porosity {

struct ChuNeedleman {
  static constexpr std::string_view name = "chu_needleman";
  static constexpr std::string_view equation =
      "df/dt = (1 - f) tr Dp + A dep/dt,  A = fN/(sN sqrt(2 pi)) exp(-((ep - eN)/sN)^2/2) in tension, 0 in compression";
  static constexpr std::string_view source = "Chu & Needleman, J. Eng. Mater. Technol. 102 (1980) 249-256";

  double volume_fraction, mean_strain, standard_deviation;
  bool nucleates_in_compression;

  static constexpr auto parameters = std::tuple{
      Parameter{"volume_fraction", &ChuNeedleman::volume_fraction, Unit::one,
                "fN, void volume fraction of all nucleating particles", between(0.0, 0.5)},
      Parameter{"mean_strain", &ChuNeedleman::mean_strain, Unit::one, "eN, mean nucleation strain", non_negative},
      Parameter{"standard_deviation", &ChuNeedleman::standard_deviation, Unit::one, "sN, its standard deviation", positive},
      Parameter{"nucleates_in_compression", &ChuNeedleman::nucleates_in_compression, Unit::one,
                "nucleate under negative mean stress too", any_value, false}};

  /// The integral of A from minus infinity to the plastic strain.
  template <class Real>
  Real nucleated(const Real& plastic_strain) const {
    constexpr double sqrt_half = 0.70710678118654752440;
    return 0.5 * volume_fraction * (1.0 + erf((plastic_strain - mean_strain) * (sqrt_half / standard_deviation)));
  }
};

}  // namespace brisance::porosity
