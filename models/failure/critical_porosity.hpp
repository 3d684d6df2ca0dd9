#pragma once

#include "models/failure/arguments.hpp"

namespace brisance::failure {

struct CriticalPorosity {
  static constexpr std::string_view name = "critical_porosity";
  static constexpr std::string_view equation = "f >= f_max,  or no strength left: f* >= (1 - 1e-3) fu";
  static constexpr std::string_view source = "Tvergaard & Needleman, Acta Metall. 32 (1984) 157-169";
  static constexpr FailureCause cause = FailureCause::critical_porosity;
  static constexpr bool needs_porosity = true;

  double porosity;

  static constexpr auto parameters = std::tuple{
      Parameter{"porosity", &CriticalPorosity::porosity, Unit::one, "f_max, porosity at failure", Interval{0.0, 1.0, true}}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    return max(at.porosity - porosity, at.capacity_used - exhausted_capacity);
  }
};

}  // namespace brisance::failure
