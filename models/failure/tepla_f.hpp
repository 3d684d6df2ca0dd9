#pragma once

#include "models/failure/arguments.hpp"

namespace brisance::failure {

struct TeplaF {
  static constexpr std::string_view name = "tepla_f";
  static constexpr std::string_view equation = "(f/fF)^2 + D^2 >= 1,  or no strength left: f* >= (1 - 1e-3) fu";
  static constexpr std::string_view source =
      "Johnson & Addessio, J. Appl. Phys. 64 (1988) 6699-6712, with the path-dependent D in the place of ep/ef. The second "
      "condition is ours: with coalescence the porous surface can vanish well below fF.";
  static constexpr FailureCause cause = FailureCause::tepla_f;
  static constexpr bool needs_damage = true;
  static constexpr bool needs_porosity = true;

  double failure_porosity;

  static constexpr auto parameters =
      std::tuple{Parameter{"failure_porosity", &TeplaF::failure_porosity, Unit::one,
                           "fF, porosity at which an undamaged matrix comes apart", Interval{0.0, 1.0, true}}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real f = at.porosity * (1.0 / failure_porosity);
    return max(f * f + at.damage * at.damage - 1.0, at.capacity_used - exhausted_capacity);
  }
};

}  // namespace brisance::failure
