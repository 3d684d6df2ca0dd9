#pragma once
// Mixed control of one step: some components of the velocity gradient are given, the others are free and follow from
// conditions on the stress at the end of the step (uniaxial stress, plane stress, constant triaxiality, ...).

#include <array>

#include "driver/point.hpp"

namespace brisance::driver {

/// A linear condition at the end of a step: stress_weight : sigma = target (Pa), or rate_weight : D = target (1/s).
struct Condition {
  SymmetricTensor<double> stress_weight;
  SymmetricTensor<double> rate_weight;
  double target = 0.0;
};

/// What drives one step: L = velocity_gradient + sum of x_k free_k, with one condition for each unknown x_k.
struct Control {
  static constexpr int capacity = 6;
  Tensor<double> velocity_gradient;  // 1/s, the given part
  int size = 0;                      // number of free directions and of conditions
  std::array<Tensor<double>, capacity> free;
  std::array<Condition, capacity> conditions;
};

/// What the solver remembers from step to step: it starts from the last solution and the last Jacobian.
struct WarmStart {
  std::array<double, Control::capacity> x{};                             // 1/s
  std::array<double, Control::capacity * Control::capacity> jacobian{};  // residual per strain
  bool has_jacobian = false;
};

/// The outcome of a controlled step.
struct ControlledStep {
  bool converged = false;
  Trouble trouble = Trouble::none;   // of the update, when that is the reason
  double residual = 0.0;             // largest violated condition over the stress scale
  Tensor<double> velocity_gradient;  // 1/s
  Point<double> point;               // after the step
};

/// Conditions on the stress hold to this fraction of the stress scale: the largest of |sigma|, the targets, and 1e-6 K.
inline constexpr double control_tolerance = 1e-8;

/// Finds the free part of the velocity gradient so that every condition holds at the end of the step.
/// Broyden's method started from the last step, renewed by finite differences of the update, damped when it does not descend.
ControlledStep controlled_step(PointUpdate& update, const State<double>& before, const Control& control, double dt, double time,
                               WarmStart& warm);

}  // namespace brisance::driver
