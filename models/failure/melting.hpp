#pragma once

#include "models/failure/arguments.hpp"

namespace brisance::failure {

struct Melting {
  static constexpr std::string_view name = "melting";
  static constexpr std::string_view equation = "T >= Tm";
  static constexpr std::string_view source = "definition; Tm from the material's melting law at the point's pressure";
  static constexpr FailureCause cause = FailureCause::melting;
  static constexpr bool needs_melting_temperature = true;

  static constexpr auto parameters = std::tuple{};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    return at.temperature / at.melting_temperature - 1.0;
  }
};

}  // namespace brisance::failure
