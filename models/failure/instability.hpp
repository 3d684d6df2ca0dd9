#pragma once

#include "models/failure/arguments.hpp"

namespace brisance::failure {

struct Instability {
  static constexpr std::string_view name = "instability";
  static constexpr std::string_view equation = "stability margin <= 0 and ep >= ep_min (and sm > 0 with tension_only)";
  static constexpr std::string_view source =
      "the material's stability laws; in compression any adiabatic softening is unstable, hence the two restrictions";
  static constexpr FailureCause cause = FailureCause::instability;
  static constexpr bool needs_stability = true;

  double min_plastic_strain;
  bool tension_only;

  static constexpr auto parameters =
      std::tuple{Parameter{"min_plastic_strain", &Instability::min_plastic_strain, Unit::one,
                           "ep_min, plastic strain below which the point is not judged", non_negative, 0.0},
                 Parameter{"tension_only", &Instability::tension_only, Unit::one,
                           "judge only points whose mean stress is tensile", any_value, false}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real excess = min(-at.stability_margin, at.plastic_strain - min_plastic_strain);
    if (!tension_only) return excess;
    return select(at.mean_stress > 0.0, excess, min(excess, Real(-1.0)));
  }
};

}  // namespace brisance::failure
