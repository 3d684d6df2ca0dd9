#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"
#include "models/state.hpp"
#include "models/tensor.hpp"

namespace brisance::viscoelastic {

/// What ViscoScram remembers; also, per second, how fast it changes.
template <class Real>
struct ScramHistory {
  Real crack_radius{0.0};                               // m
  std::array<SymmetricTensor<Real>, 5> partial_stress;  // Pa, deviators of the Maxwell elements; their sum is the stress

  static ScramHistory from_columns(const std::array<Real, history_capacity>& columns) {
    ScramHistory history;
    history.crack_radius = columns[0];
    int at = 1;
    for (auto& s : history.partial_stress) for_each_component([&](Real& x) { x = columns[at++]; }, s);
    return history;
  }
  void to_columns(std::array<Real, history_capacity>& columns) const {
    columns[0] = crack_radius;
    int at = 1;
    for (const auto& s : partial_stress) for_each_component([&](const Real& x) { columns[at++] = x; }, s);
  }
};

template <class Real>
SymmetricTensor<Real> total(const ScramHistory<Real>& history) {
  const auto& s = history.partial_stress;
  return s[0] + s[1] + s[2] + s[3] + s[4];
}
template <class Real>
ScramHistory<Real> rotate(const Tensor<Real>& R, ScramHistory<Real> history) {
  for (auto& s : history.partial_stress) s = rotate(R, s);
  return history;
}
/// Five Maxwell elements side by side, in series with a solid full of penny cracks: with g = (c/a)^3 and the crack strain
/// ec = g s/(2G), element i sees the rest of the strain, ds_i/dt = 2 G_i (D' - dec/dt) - s_i/tau_i.
struct ViscoScram {
  static constexpr std::string_view name = "visco_scram";
  static constexpr std::string_view equation =
      "s = sum s_i,  ds_i/dt = 2 G_i (D' - d(g s)/dt/(2G)) - s_i/tau_i,  g = (c/a)^3,  G = sum G_i;  dc/dt = v (K/K1)^m below "
      "K', v (1 - (K0m/K)^2) above;  K^2 = 3/2 pi c (s:s + 3 max(sm, 0)^2),  K' = K0m sqrt(1 + 2/m),  "
      "K1 = K' (1 + m/2)^(1/m),  K0m^2 = K0^2 (1 + pi x (1 + x)),  x = sqrt(45/(6 - 4 mu^2)) mu max(-sm, 0) sqrt(c)/K0;  "
      "v = min(exp(A ln e + B) [times w in tension], v_max),  e = sqrt(3/2 D':D')";
  static constexpr std::string_view source =
      "Bennett, Haberman, Johnson, Asay & Henson, J. Mech. Phys. Solids 46 (1998) 2303-2322; Hackett & Bennett, Int. J. Numer. "
      "Meth. Eng. 49 (2000) 1191-1209. Without hot spots and without the time-temperature shift.";
  static constexpr int elements = 5;

  /// Cracks grow up to this many times a. A solid with a billionth of its stiffness is rubble; much beyond, the
  /// round-off of the sum s, times g, would be as large as the partial stresses.
  static constexpr double largest_crack = 1e3;

  std::array<double, elements> shear_moduli, relaxation_rates;
  double crack_scale, initial_crack_radius, crack_exponent, max_crack_speed, toughness, friction, tension_speed_factor;
  double speed_exponent, speed_coefficient;

  static constexpr auto parameters = std::tuple{
      Parameter{"shear_moduli", &ViscoScram::shear_moduli, Unit::Pa, "G_i, of the Maxwell elements", positive},
      Parameter{"relaxation_rates", &ViscoScram::relaxation_rates, Unit::per_s,
                "1/tau_i, of the Maxwell elements; 0 is a spring", non_negative},
      Parameter{"crack_scale", &ViscoScram::crack_scale, Unit::m, "a, crack radius that halves the stiffness", positive},
      Parameter{"initial_crack_radius", &ViscoScram::initial_crack_radius, Unit::m, "c0; 0 is a solid without cracks",
                non_negative},
      Parameter{"crack_exponent", &ViscoScram::crack_exponent, Unit::one, "m, of the stress intensity in slow growth",
                positive},
      Parameter{"max_crack_speed", &ViscoScram::max_crack_speed, Unit::m_per_s, "v_max", non_negative},
      Parameter{"toughness", &ViscoScram::toughness, Unit::Pa_sqrt_m, "K0, threshold stress intensity without friction",
                positive},
      Parameter{"friction", &ViscoScram::friction, Unit::one, "mu, static friction of the crack faces", between(0.0, 1.2)},
      Parameter{"tension_speed_factor", &ViscoScram::tension_speed_factor, Unit::one, "w, cracks open faster than they slide",
                positive},
      Parameter{"speed_exponent", &ViscoScram::speed_exponent, Unit::one, "A, of the strain rate in the crack speed",
                Interval{0.0, 2.0, true}},
      Parameter{"speed_coefficient", &ViscoScram::speed_coefficient, Unit::one,
                "B, logarithm of the crack speed (m/s) at a strain rate of 1/s", between(-50.0, 50.0)}};

  static constexpr std::array history = {HistoryColumn{"crack_radius", Unit::m, "c, mean radius of the cracks"},
                                         HistoryColumn{"s1_xx", Unit::Pa, "element 1"},
                                         HistoryColumn{"s1_yy", Unit::Pa, "element 1"},
                                         HistoryColumn{"s1_zz", Unit::Pa, "element 1"},
                                         HistoryColumn{"s1_yz", Unit::Pa, "element 1"},
                                         HistoryColumn{"s1_xz", Unit::Pa, "element 1"},
                                         HistoryColumn{"s1_xy", Unit::Pa, "element 1"},
                                         HistoryColumn{"s2_xx", Unit::Pa, "element 2"},
                                         HistoryColumn{"s2_yy", Unit::Pa, "element 2"},
                                         HistoryColumn{"s2_zz", Unit::Pa, "element 2"},
                                         HistoryColumn{"s2_yz", Unit::Pa, "element 2"},
                                         HistoryColumn{"s2_xz", Unit::Pa, "element 2"},
                                         HistoryColumn{"s2_xy", Unit::Pa, "element 2"},
                                         HistoryColumn{"s3_xx", Unit::Pa, "element 3"},
                                         HistoryColumn{"s3_yy", Unit::Pa, "element 3"},
                                         HistoryColumn{"s3_zz", Unit::Pa, "element 3"},
                                         HistoryColumn{"s3_yz", Unit::Pa, "element 3"},
                                         HistoryColumn{"s3_xz", Unit::Pa, "element 3"},
                                         HistoryColumn{"s3_xy", Unit::Pa, "element 3"},
                                         HistoryColumn{"s4_xx", Unit::Pa, "element 4"},
                                         HistoryColumn{"s4_yy", Unit::Pa, "element 4"},
                                         HistoryColumn{"s4_zz", Unit::Pa, "element 4"},
                                         HistoryColumn{"s4_yz", Unit::Pa, "element 4"},
                                         HistoryColumn{"s4_xz", Unit::Pa, "element 4"},
                                         HistoryColumn{"s4_xy", Unit::Pa, "element 4"},
                                         HistoryColumn{"s5_xx", Unit::Pa, "element 5"},
                                         HistoryColumn{"s5_yy", Unit::Pa, "element 5"},
                                         HistoryColumn{"s5_zz", Unit::Pa, "element 5"},
                                         HistoryColumn{"s5_yz", Unit::Pa, "element 5"},
                                         HistoryColumn{"s5_xz", Unit::Pa, "element 5"},
                                         HistoryColumn{"s5_xy", Unit::Pa, "element 5"}};
  static_assert(history.size() == 1 + 6 * elements && history.size() <= history_capacity);

  template <class Real = double>
  ScramHistory<Real> initial_history() const {
    ScramHistory<Real> h;
    h.crack_radius = Real(initial_crack_radius);
    return h;
  }

  /// G, of the solid without cracks.
  double shear_modulus() const {
    double G = 0.0;
    for (double Gi : shear_moduli) G += Gi;
    return G;
  }

  /// Elastic energy per volume (J/m^3) that springs and cracks give back; the rest of the work on the deviator is heat.
  template <class Real>
  Real stored_energy(const ScramHistory<Real>& h) const {
    const SymmetricTensor<Real> s = total(h);
    Real energy = crack_compliance(h.crack_radius) * double_dot(s, s) * (0.25 / shear_modulus());
    for (int i = 0; i < elements; ++i)
      energy += double_dot(h.partial_stress[i], h.partial_stress[i]) * (0.25 / shear_moduli[i]);
    return energy;
  }

  /// Time derivative of the history under a deviatoric strain rate D' (1/s) and a mean stress (Pa, positive in tension).
  template <class Real>
  ScramHistory<Real> rate(const SymmetricTensor<Real>& strain_rate, const Real& mean_stress,
                          const ScramHistory<Real>& h) const {
    const SymmetricTensor<Real> s = total(h);
    const Real c = h.crack_radius;
    ScramHistory<Real> result;
    result.crack_radius = crack_speed(c, double_dot(s, s), mean_stress, terminal_speed(strain_rate, mean_stress));
    const Real g = crack_compliance(c);
    const Real g_rate = 3.0 * c * c * result.crack_radius * (1.0 / (crack_scale * crack_scale * crack_scale));
    const double G = shear_modulus();

    SymmetricTensor<Real> uncracked = Real(2.0 * G) * strain_rate;  // 2 G D' - sum s_i/tau_i
    for (int i = 0; i < elements; ++i) uncracked = uncracked - Real(relaxation_rates[i]) * h.partial_stress[i];
    const SymmetricTensor<Real> s_rate = Real(1.0 / (1.0 + g)) * (uncracked - g_rate * s);
    const SymmetricTensor<Real> crack_strain_rate = Real(0.5 / G) * (g_rate * s + g * s_rate);
    for (int i = 0; i < elements; ++i)
      result.partial_stress[i] =
          Real(2.0 * shear_moduli[i]) * (strain_rate - crack_strain_rate) - Real(relaxation_rates[i]) * h.partial_stress[i];
    return result;
  }

  /// The history after dt seconds of constant strain rate and mean stress; second order in dt, stable for any. The stress
  /// at a given final crack radius is exact for a constant rate of crack strain; the radius follows by Heun's method, in
  /// so many equal parts of the step that the crack grows by no more than an eighth in each (as far as 64 parts allow).
  template <class Real>
  ScramHistory<Real> advance(ScramHistory<Real> h, const SymmetricTensor<Real>& strain_rate, const Real& mean_stress,
                             double dt) const {
    constexpr int halvings = 6;
    const double G = shear_modulus();
    const Real v = terminal_speed(strain_rate, mean_stress);

    const SymmetricTensor<Real> s_before = total(h);
    const Real stress_bound = double_dot(s_before, s_before) + 4.0 * G * G * dt * dt * double_dot(strain_rate, strain_rate);
    const Real speed_bound = crack_speed(2.0 * h.crack_radius, 2.0 * stress_bound, mean_stress, v);
    Real step(dt);
    for (int i = 0; i < halvings; ++i) step = select(step * speed_bound > 0.125 * h.crack_radius, 0.5 * step, step);

    // Over one part: s_i -> decay_i s_i + 2 spring_i (strain of the part, cracks apart).
    std::array<Real, elements> decay, spring;
    Real G_step(0.0);
    for (int i = 0; i < elements; ++i) {
      const Real x = max(step * relaxation_rates[i], Real(1e-200));
      decay[i] = exp(-x);
      spring[i] = shear_moduli[i] * (expm1(-x) / -x);
      G_step += spring[i];
    }
    const Real softening = G_step * (1.0 / G);

    const Real c_limit = max(h.crack_radius, Real(largest_crack * crack_scale));
    Real done(0.0);
    for (int part = 0; part < (1 << halvings); ++part) {
      const mask_of<Real> active = done < (1.0 - 1e-9) * dt;
      if (none(active)) break;
      const SymmetricTensor<Real> s = total(h);
      const Real c = h.crack_radius, g = crack_compliance(c);
      SymmetricTensor<Real> uncracked = (2.0 * step * G_step) * strain_rate + (softening * g) * s;
      for (int i = 0; i < elements; ++i) uncracked = uncracked + decay[i] * h.partial_stress[i];

      const Real start = crack_speed(c, double_dot(s, s), mean_stress, v);
      const Real predicted = min(c + step * start, c_limit);
      const Real shrink = 1.0 / (1.0 + softening * crack_compliance(predicted));
      const Real end = crack_speed(predicted, double_dot(uncracked, uncracked) * shrink * shrink, mean_stress, v);

      const Real c_next = min(c + 0.5 * step * (start + end), c_limit), g_next = crack_compliance(c_next);
      const SymmetricTensor<Real> s_next = Real(1.0 / (1.0 + softening * g_next)) * uncracked;
      const SymmetricTensor<Real> strain = step * strain_rate - Real(0.5 / G) * (g_next * s_next - g * s);
      h.crack_radius = select(active, c_next, c);
      for (int i = 0; i < elements; ++i) {
        SymmetricTensor<Real>& si = h.partial_stress[i];
        si = select(active, decay[i] * si + (2.0 * spring[i]) * strain, si);
      }
      done += step;
    }
    return h;
  }

 private:
  /// g = (c/a)^3
  template <class Real>
  Real crack_compliance(const Real& c) const {
    const Real ratio = c * (1.0 / crack_scale);
    return ratio * ratio * ratio;
  }

  /// v: what the crack speed tends to as the stress intensity grows.
  template <class Real>
  Real terminal_speed(const SymmetricTensor<Real>& strain_rate, const Real& mean_stress) const {
    const Real v = exp(Real(speed_coefficient)) * pow(1.5 * double_dot(strain_rate, strain_rate), 0.5 * speed_exponent);
    return min(select(mean_stress > 0.0, tension_speed_factor * v, v), Real(max_crack_speed));
  }

  /// dc/dt
  template <class Real>
  Real crack_speed(const Real& c, const Real& s_colon_s, const Real& mean_stress, const Real& v) const {
    const Real tension = max(mean_stress, Real(0.0)), compression = max(-mean_stress, Real(0.0));
    const double slip = std::sqrt(45.0 / (6.0 - 4.0 * friction * friction)) * friction;
    const Real x = slip * compression * sqrt(max(c, Real(1e-200))) * (1.0 / toughness);
    const Real threshold = toughness * toughness * (1.0 + std::numbers::pi * x * (1.0 + x));                // K0m^2
    const Real intensity = 1.5 * std::numbers::pi * c * (s_colon_s + 3.0 * tension * tension) / threshold;  // (K/K0m)^2

    const double transition = 1.0 + 2.0 / crack_exponent;                                               // (K'/K0m)^2
    const double slow_scale = transition * std::pow(1.0 + 0.5 * crack_exponent, 2.0 / crack_exponent);  // (K1/K0m)^2
    const Real slow = pow(min(intensity, Real(transition)) * (1.0 / slow_scale), 0.5 * crack_exponent);
    const Real fast = 1.0 - 1.0 / max(intensity, Real(transition));
    return v * select(c < largest_crack * crack_scale, select(intensity < transition, slow, fast), Real(0.0));
  }
};

}  // namespace brisance::viscoelastic
