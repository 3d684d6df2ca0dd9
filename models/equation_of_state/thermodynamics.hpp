#pragma once
// What follows from p(rho, e) and e(rho, T) for every law, on any Real.

#include "models/bracketed_root.hpp"
#include "models/equation_of_state/equation_of_state.hpp"

namespace brisance::equation_of_state {

/// One of the laws, not the variant of them.
template <class T>
concept AnyLaw = requires {
  T::caloric;
};

template <AnyLaw Law>
inline constexpr bool is_barotropic = Law::caloric == Caloric::barotropic || Law::caloric == Caloric::incremental;

/// Derivatives of the pressure at constant energy and at constant density.
template <class Real>
struct PressureSlopes {
  Real pressure;     // Pa
  Real per_density;  // Pa m^3/kg
  Real per_energy;   // kg/m^3
};
template <AnyLaw Law, class Real>
PressureSlopes<Real> pressure_slopes(const Law& law, const Real& rho, const Real& e) {
  using Derived = Dual<Real, 2>;
  const Derived p = law.pressure(Derived::variable(rho, 0), Derived::variable(e, 1));
  return {p.value, p.derivative[0], p.derivative[1]};
}

/// p(rho, T), Pa.
template <AnyLaw Law, class Real>
Real pressure_at(const Law& law, const Real& rho, const Real& temperature) {
  return law.pressure(rho, law.energy(rho, temperature));
}

/// cv = (de/dT) at constant density, J/(kg K).
template <AnyLaw Law, class Real>
Real specific_heat_at_constant_volume(const Law& law, const Real& rho) {
  return law.energy(Dual<Real>(rho), Dual<Real>::variable(Real(0.0))).derivative[0];
}

/// T(rho, e), K. Exact: every law's energy is linear in T.
template <AnyLaw Law, class Real>
Real temperature(const Law& law, const Real& rho, const Real& e) {
  const Dual<Real> at_zero = law.energy(Dual<Real>(rho), Dual<Real>::variable(Real(0.0)));
  return (e - at_zero.value) / at_zero.derivative[0];
}

/// e(rho, p), J/kg, not below the energy at T = 0 for a complete law. A law whose pressure ignores the energy gives the
/// energy at its reference temperature.
template <AnyLaw Law, class Real>
Real energy_at_pressure(const Law& law, const Real& rho, const Real& p) {
  if constexpr (is_barotropic<Law>) {
    return law.energy(rho, Real(law.reference_temperature));
  } else {
    constexpr double beyond_any_energy = 1e10;  // J/kg; a thousand times what explosives and fast impacts hold
    constexpr double negligible_energy = 1.0;   // J/kg
    const Real cold = law.energy(rho, Real(0.0));
    const Real lowest = Law::caloric == Caloric::complete ? cold : Real(cold - beyond_any_energy);
    const auto excess = [&](const Dual<Real>& e) { return law.pressure(Dual<Real>(rho), e) - Dual<Real>(p); };
    const Real start = law.energy(rho, Real(300.0));
    return increasing_root<Real>(excess, lowest, Real(cold + beyond_any_energy), start, negligible_energy);
  }
}

/// rho(p, T), kg/m^3, within the law's range; its end where the pressure is out of reach.
template <AnyLaw Law, class Real>
Real density_at(const Law& law, const Real& p, const Real& temperature) {
  if constexpr (requires { law.density(p, temperature); }) {
    return law.density(p, temperature);
  } else {
    const DensityRange range = law.range();
    const auto excess = [&](const Dual<Real>& rho) { return pressure_at(law, rho, Dual<Real>(temperature)) - Dual<Real>(p); };
    double start = 0.5 * (range.lowest + range.highest);
    if constexpr (requires { law.reference_density; }) start = law.reference_density;
    return increasing_root<Real>(excess, Real(range.lowest), Real(range.highest), Real(start));
  }
}

/// c^2 = (dp/drho)_e + (p/rho^2) (dp/de)_rho, m^2/s^2, not below the square of the law's lowest sound speed. For a thermal law
/// e is taken to receive the work of compression, as in the Mie-Grueneisen law that it shortens, so that c(rho0, T0) = c0.
template <AnyLaw Law, class Real>
Real sound_speed_squared(const Law& law, const Real& rho, const Real& e) {
  const PressureSlopes<Real> at = pressure_slopes(law, rho, e);
  const double lowest = law.lowest_sound_speed();
  return max(Real(at.per_density + at.pressure * at.per_energy / (rho * rho)), Real(lowest * lowest));
}

/// Isentropic bulk modulus rho c^2, Pa.
template <AnyLaw Law, class Real>
Real bulk_modulus(const Law& law, const Real& rho, const Real& e) {
  return rho * sound_speed_squared(law, rho, e);
}

/// Gamma = (1/rho) (dp/de)_rho.
template <AnyLaw Law, class Real>
Real gruneisen_coefficient(const Law& law, const Real& rho, const Real& e) {
  return law.pressure(Dual<Real>(rho), Dual<Real>::variable(e)).derivative[0] / rho;
}

/// Volumetric expansion coefficient beta = -(1/rho) (drho/dT)_p = (dp/dT)_rho/(rho (dp/drho)_T), 1/K.
template <AnyLaw Law, class Real>
Real expansion_coefficient(const Law& law, const Real& rho, const Real& temperature) {
  using Derived = Dual<Real, 2>;
  const Derived p = pressure_at(law, Derived::variable(rho, 0), Derived::variable(temperature, 1));
  return p.derivative[1] / (rho * p.derivative[0]);
}

// The same for a law chosen at run time.
inline double pressure(const EquationOfState& law, double rho, double e) {
  return std::visit([&](const auto& l) { return l.pressure(rho, e); }, law);
}
inline double energy(const EquationOfState& law, double rho, double temperature) {
  return std::visit([&](const auto& l) { return l.energy(rho, temperature); }, law);
}
inline DensityRange range(const EquationOfState& law) {
  return std::visit([](const auto& l) { return l.range(); }, law);
}
inline Caloric caloric(const EquationOfState& law) {
  return std::visit([](const auto& l) { return l.caloric; }, law);
}
inline double temperature(const EquationOfState& law, double rho, double e) {
  return std::visit([&](const auto& l) { return temperature(l, rho, e); }, law);
}
inline double energy_at_pressure(const EquationOfState& law, double rho, double p) {
  return std::visit([&](const auto& l) { return energy_at_pressure(l, rho, p); }, law);
}
inline double density_at(const EquationOfState& law, double p, double temperature) {
  return std::visit([&](const auto& l) { return density_at(l, p, temperature); }, law);
}
inline double sound_speed_squared(const EquationOfState& law, double rho, double e) {
  return std::visit([&](const auto& l) { return sound_speed_squared(l, rho, e); }, law);
}
inline double bulk_modulus(const EquationOfState& law, double rho, double e) {
  return std::visit([&](const auto& l) { return bulk_modulus(l, rho, e); }, law);
}
inline double gruneisen_coefficient(const EquationOfState& law, double rho, double e) {
  return std::visit([&](const auto& l) { return gruneisen_coefficient(l, rho, e); }, law);
}
inline double expansion_coefficient(const EquationOfState& law, double rho, double temperature) {
  return std::visit([&](const auto& l) { return expansion_coefficient(l, rho, temperature); }, law);
}

}  // namespace brisance::equation_of_state
