#pragma once
// Flow stress: the equivalent stress Y (Pa) at which the matrix flows.
//
// A law is a struct with name, equation, source, parameters and
//   Y = law(arguments)                     for laws of the instantaneous state, or
//   Y = law(arguments, history)            with one history variable and its hardening
//   d(history)/d(plastic strain) = law.hardening(arguments)(history), also callable as law.hardening(arguments, history)
// Every law gives a finite Y >= 0 for any finite arguments, non-decreasing in the rate, 0 at and above melting (a law with
// no melting temperature in it excepted: there the update takes the strength of a melt away). At no plastic strain rate it
// gives its quasi-static limit, which the yield check uses.
// To add a law: write its file, add its name to the list below, add its test.

#include <variant>

#include "models/flow_stress/arguments.hpp"
#include "models/flow_stress/johnson_cook.hpp"
#include "models/flow_stress/linear_hardening.hpp"
#include "models/flow_stress/mechanical_threshold_stress.hpp"
#include "models/flow_stress/preston_tonks_wallace.hpp"
#include "models/flow_stress/steinberg_cochran_guinan.hpp"
#include "models/flow_stress/steinberg_cochran_guinan_lund.hpp"
#include "models/flow_stress/voce.hpp"
#include "models/flow_stress/zerilli_armstrong.hpp"

namespace brisance {

using FlowStress =
    std::variant<flow_stress::JohnsonCook, flow_stress::MechanicalThresholdStress, flow_stress::SteinbergCochranGuinan,
                 flow_stress::SteinbergCochranGuinanLund, flow_stress::ZerilliArmstrong, flow_stress::PrestonTonksWallace,
                 flow_stress::LinearHardening, flow_stress::Voce>;

namespace flow_stress {

/// Laws that carry a history variable.
template <class Law>
concept WithHistory = requires {
  Law::history;
};

template <class Real>
struct Flow {
  Real flow_stress{0.0};  // Pa
  Real history{0.0};      // at the end of the increment, in the law's unit
};

/// The history variable after a plastic strain increment at the rate and temperature in `at`: the implicit midpoint rule
///   h1 = h0 + increment * hardening((h0 + h1)/2),  h1 >= 0
/// Newton's method starts from h0; hardening that goes out convexly makes it climb to the root without passing it.
template <WithHistory Law, class Real>
Real advance_history(const Law& law, const Arguments<Real>& at, const Real& start, const Real& increment) {
  constexpr int most_steps = 25;
  constexpr double settled = 1e-9;  // the step after this one, the last, squares it
  const auto hardening_of = law.hardening(without_derivatives(at));
  const auto h0 = without_derivatives(start), x = without_derivatives(increment);
  using Value = std::remove_cvref_t<decltype(h0)>;
  Value end = h0, slope(1.0);
  mask_of<Value> active(true);
  for (int i = 0; i < most_steps && any(active); ++i) {
    const auto hardening = hardening_of(Dual<Value>::variable(0.5 * (h0 + end)));
    slope = select(active, 1.0 - 0.5 * x * hardening.derivative[0], slope);
    const Value next = max(end - (end - h0 - x * hardening.value) / slope, Value(0.0));
    const auto moved = abs(next - end) > settled * next;
    end = select(active, next, end);
    active = active & moved;
  }
  // One step more in Real: it moves the value by round-off and gives it the derivatives of the implicit function.
  const Real residual = Real(end) - start - increment * law.hardening(at, Real(0.5 * (start + Real(end))));
  return max(Real(end) - residual / Real(slope), Real(0.0));
}

/// A law at the temperature of a step: what only depends on that is computed once, where the law offers it.
template <class Law, class Real>
decltype(auto) isothermal(const Law& law, const Arguments<Real>& at) {
  if constexpr (requires { law.isothermal(at); })
    return law.isothermal(at);
  else
    return (law);
}

/// Flow stress at the end of a plastic strain increment that `at` describes, and the history it leaves. Laws without
/// history hand it through.
template <class Law, class Real>
Flow<Real> evaluate(const Law& law, const Arguments<Real>& at, const Real& history_start, const Real& increment) {
  if constexpr (WithHistory<Law>) {
    const Real history = advance_history(law, at, history_start, increment);
    return {law(at, history), history};
  } else {
    return {law(at), history_start};
  }
}

}  // namespace flow_stress

}  // namespace brisance
