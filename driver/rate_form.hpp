#pragma once
// The rate form of the constitutive laws, dy/dt = f(y, L(t)), integrated with error control. It shares the laws with the
// incremental update and nothing else (neither its kinematics, its return mapping nor the order of its phases), so the
// two check each other: the update must converge to it as the step shrinks.

#include <functional>
#include <span>

#include "models/material.hpp"
#include "models/state.hpp"

namespace brisance::driver {

/// The velocity gradient as a function of time (s -> 1/s).
using VelocityGradient = std::function<Tensor<double>(double)>;

/// A stretch of a path along which the velocity gradient is constant.
struct Segment {
  double duration;  // s
  Tensor<double> velocity_gradient;
};

struct RateFormOptions {
  double tolerance = 1e-10;  // local error of a step, relative to each variable or to its scale where that is larger
  long most_steps = 20'000'000;
};

/// The state at t1 that the laws lead to from `start` at t0. `start` is in equilibrium with its own stress: any state that the
/// update or this function returned, or an initial state. A material without `heating` keeps its temperature.
/// Failure and artificial viscosity are left out; above melting the shear modulus and the strength are zero.
/// Throws std::runtime_error when the error control needs more than `most_steps`.
State<double> integrate_rate_form(const Material& material, const State<double>& start,
                                  const VelocityGradient& velocity_gradient, double t0, double t1,
                                  const RateFormOptions& options = {});

/// The same along a path of segments, such as the steps that an incremental run has taken.
State<double> integrate_rate_form(const Material& material, const State<double>& start, std::span<const Segment> path,
                                  const RateFormOptions& options = {});

/// A component of the difference between two states of one point, relative to the larger one's size.
struct Difference {
  std::string_view quantity;
  double relative;
};
/// Stress (as a tensor), density, energy, temperature, plastic strain, porosity, damage and flow history; a quantity that is
/// zero in both does not appear.
std::vector<Difference> differences(const State<double>& a, const State<double>& b);

}  // namespace brisance::driver
