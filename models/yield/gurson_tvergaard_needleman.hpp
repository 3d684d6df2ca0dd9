#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::yield {

/// Where a stress outside the surface is brought back to.
enum class ReturnTo { porous_surface, matrix_stress };

}  // namespace brisance::yield

namespace brisance {
template <>
inline constexpr std::array choices<yield::ReturnTo> = {std::string_view{"porous_surface"}, std::string_view{"matrix_stress"}};
}

namespace brisance::yield {

struct GursonTvergaardNeedleman {
  static constexpr std::string_view name = "gurson_tvergaard_needleman";
  static constexpr std::string_view equation =
      "(q/Y)^2 + 2 q1 f* cosh(3 q2 sm/(2 Y)) - 1 - q3 f*^2 = 0,  f* = f + (kc - 1) max(f - fc, 0), below its value fu at which "
      "no strength is left";
  static constexpr std::string_view source =
      "Gurson, J. Eng. Mater. Technol. 99 (1977) 2-15; Tvergaard & Needleman, Acta Metall. 32 (1984) 157-169. "
      "return_to = matrix_stress tests yield with this surface but returns to q = Y without dilatancy, as codes of 2005 did.";

  double q1, q2, q3, coalescence_porosity, coalescence_slope;
  ReturnTo return_to;

  static constexpr auto parameters = std::tuple{
      Parameter{"q1", &GursonTvergaardNeedleman::q1, Unit::one, "weight of the porosity", positive},
      Parameter{"q2", &GursonTvergaardNeedleman::q2, Unit::one, "weight of the mean stress", positive},
      Parameter{"q3", &GursonTvergaardNeedleman::q3, Unit::one, "weight of the porosity squared, at most q1^2", positive},
      Parameter{"coalescence_porosity", &GursonTvergaardNeedleman::coalescence_porosity, Unit::one,
                "fc, porosity from which voids coalesce", fraction},
      Parameter{"coalescence_slope", &GursonTvergaardNeedleman::coalescence_slope, Unit::one, "kc, slope of f* beyond fc",
                at_least(1.0)},
      Parameter{"return_to", &GursonTvergaardNeedleman::return_to, Unit::one, "surface that the return mapping ends on",
                any_value, ReturnTo::porous_surface}};

  /// The f* at which the surface has shrunk to a point: the smaller root of 1 - 2 q1 f* + q3 f*^2.
  double ultimate_porosity() const { return 1.0 / (q1 + std::sqrt(std::max(q1 * q1 - q3, 0.0))); }

  /// f*, kept just below its ultimate value.
  template <class Real>
  Real effective_porosity(const Real& f) const {
    const Real f_star = f + (coalescence_slope - 1.0) * max(f - coalescence_porosity, Real(0.0));
    return min(f_star, Real(ultimate_porosity() * (1.0 - 1e-6)));
  }

  /// Phi of stresses in units of the matrix flow stress: q/Y and sm/Y.
  template <class Real>
  Real operator()(const Real& q_over_Y, const Real& mean_over_Y, const Real& f_star) const {
    return q_over_Y * q_over_Y + 2.0 * q1 * f_star * cosh(1.5 * q2 * mean_over_Y) - 1.0 - q3 * f_star * f_star;
  }
};

}  // namespace brisance::yield
