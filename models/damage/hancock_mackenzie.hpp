#pragma once

#include "models/damage/arguments.hpp"

namespace brisance::damage {

struct HancockMackenzie {
  static constexpr std::string_view name = "hancock_mackenzie";
  static constexpr std::string_view equation = "dD/dep = 1/ef,  ef = 1.65 exp(-1.5 t),  t = sm/q within [-3, 3]";
  static constexpr std::string_view source =
      "Hancock & Mackenzie, J. Mech. Phys. Solids 24 (1976) 147-169, after Rice & Tracey's growth of a void, "
      "J. Mech. Phys. Solids 17 (1969) 201-217. The bounds on t and the option tension_only are ours.";

  bool tension_only;

  static constexpr auto parameters = std::tuple{Parameter{"tension_only", &HancockMackenzie::tension_only, Unit::one,
                                                          "no damage unless the mean stress is tensile", any_value, false}};

  /// Stands for infinity where nothing is damaged, so that no lane meets inf/inf.
  static constexpr double never = 1e30;

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real fracture_strain = 1.65 * exp(-1.5 * clamp(at.triaxiality, -3.0, 3.0));
    if (!tension_only) return fracture_strain;
    return select(at.triaxiality > 0.0, fracture_strain, Real(never));
  }
};

}  // namespace brisance::damage
