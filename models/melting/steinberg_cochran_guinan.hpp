#pragma once

#include "models/melting/arguments.hpp"

namespace brisance::melting {

struct SteinbergCochranGuinan {
  static constexpr std::string_view name = "steinberg_cochran_guinan";
  static constexpr std::string_view equation = "Tm = Tm0 exp[2 a (1 - 1/eta)] eta^(2 (Gamma0 - a - 1/3)),  eta = rho/rho0";
  static constexpr std::string_view source =
      "Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498-1504: Lindemann's law with Gamma = Gamma0 - a (1 - 1/eta). "
      "Tm0 is fitted over compression and need not be the melting point at ambient pressure.";

  double ambient_value, gruneisen, a;

  using Self = SteinbergCochranGuinan;
  static constexpr auto parameters =
      std::tuple{Parameter{"ambient_value", &Self::ambient_value, Unit::K, "Tm0, at the reference density", positive},
                 Parameter{"gruneisen", &Self::gruneisen, Unit::one, "Gamma0, Grueneisen coefficient", between(0.0, 10.0)},
                 Parameter{"a", &Self::a, Unit::one, "its first-order volume correction", between(0.0, 10.0)}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real eta = clamp(at.compression, 0.1, 10.0);
    return ambient_value * exp(2.0 * a * (1.0 - 1.0 / eta)) * pow(eta, 2.0 * (gruneisen - a - 1.0 / 3.0));
  }
};

}  // namespace brisance::melting
