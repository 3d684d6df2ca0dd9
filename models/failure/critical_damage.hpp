#pragma once

#include "models/failure/arguments.hpp"

namespace brisance::failure {

struct CriticalDamage {
  static constexpr std::string_view name = "critical_damage";
  static constexpr std::string_view equation = "D >= Dc";
  static constexpr std::string_view source =
      "Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31-48: D reaches 1 when the fracture strain is used up";
  static constexpr FailureCause cause = FailureCause::critical_damage;
  static constexpr bool needs_damage = true;

  double damage;

  static constexpr auto parameters = std::tuple{
      Parameter{"damage", &CriticalDamage::damage, Unit::one, "Dc, damage at failure", Interval{0.0, 1.0, true}, 1.0}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    return at.damage - damage;
  }
};

}  // namespace brisance::failure
