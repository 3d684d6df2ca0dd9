#include "driver/mixed_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brisance::driver {
namespace {

constexpr int capacity = Control::capacity;
using Vector = std::array<double, capacity>;
using Matrix = std::array<double, capacity * capacity>;  // by rows

double largest(const Vector& v, int n) {
  double result = 0.0;
  for (int i = 0; i < n; ++i) result = std::max(result, std::abs(v[i]));
  return result;
}

Vector sum(const Vector& a, double f, const Vector& b) {
  Vector result;
  for (int i = 0; i < capacity; ++i) result[i] = a[i] + f * b[i];
  return result;
}

/// A x = b by Gaussian elimination with row pivoting; false if A is singular.
bool solve(Matrix A, Vector b, int n, Vector& x) {
  const auto at = [&](int i, int j) -> double& { return A[i * capacity + j]; };
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    if (!(std::abs(at(pivot, k)) > 0.0)) return false;
    for (int j = 0; j < n; ++j) std::swap(at(k, j), at(pivot, j));
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double factor = at(i, k) / at(k, k);
      for (int j = k; j < n; ++j) at(i, j) -= factor * at(k, j);
      b[i] -= factor * b[k];
    }
  }
  x = {};
  for (int i = n - 1; i >= 0; --i) {
    x[i] = b[i];
    for (int j = i + 1; j < n; ++j) x[i] -= at(i, j) * x[j];
    x[i] /= at(i, i);
  }
  return true;
}

/// The conditions as a function of the unknowns.
struct Problem {
  PointUpdate& update;
  const State<double>& before;
  const Control& control;
  double dt, time;
  double stress_scale = 0.0, rate_scale = 0.0;

  struct Value {
    Vector residual{};
    Tensor<double> L;
    Point<double> point;
    double size = std::numeric_limits<double>::infinity();  // largest residual; infinite if the update is in trouble
    bool valid() const { return size < std::numeric_limits<double>::infinity(); }
  };

  Value operator()(const Vector& x) {
    Value value;
    value.L = control.velocity_gradient;
    for (int k = 0; k < control.size; ++k) value.L = value.L + x[k] * control.free[k];
    value.point = update(before, value.L, dt, time);
    if (trouble_of(value.point) != Trouble::none) return value;
    const SymmetricTensor<double>& stress = value.point.state.stress;
    const SymmetricTensor<double> D = symmetric_part(value.L);
    set_scales(value.point, D);
    for (int k = 0; k < control.size; ++k) {
      const Condition& c = control.conditions[k];
      const double on_stress = norm(c.stress_weight), on_rate = norm(c.rate_weight);
      const double scale = on_stress > 0.0 ? on_stress * stress_scale : on_rate * rate_scale;
      value.residual[k] = (double_dot(c.stress_weight, stress) + double_dot(c.rate_weight, D) - c.target) / scale;
    }
    value.size = largest(value.residual, control.size);
    return value;
  }

  /// Only ever grown, and before the residual is formed, so that a poor iterate cannot hide behind its own large stress.
  void set_scales(const Point<double>& point, const SymmetricTensor<double>& D) {
    if (stress_scale > 0.0) return;
    stress_scale = std::max(norm(before.stress), 1e-6 * std::max(point.bulk_modulus, point.state.shear_modulus));
    rate_scale = std::max(norm(D), 1e-300);
    for (int k = 0; k < control.size; ++k) {
      const Condition& c = control.conditions[k];
      if (const double weight = norm(c.stress_weight); weight > 0.0)
        stress_scale = std::max(stress_scale, std::abs(c.target) / weight);
      if (const double weight = norm(c.rate_weight); weight > 0.0)
        rate_scale = std::max(rate_scale, std::abs(c.target) / weight);
    }
    if (!(stress_scale > 0.0)) stress_scale = 1.0;
  }
};

/// d(residual)/d(strain) by forward differences; false if the update is in trouble nearby on both sides.
bool differences(Problem& f, const Vector& x, const Problem::Value& at, Matrix& jacobian) {
  const double strain = norm(at.L) * f.dt;
  const double h = std::clamp(1e-3 * strain, 1e-9, 1e-7);  // far above round-off, far below the strain of yield
  for (int k = 0; k < f.control.size; ++k) {
    Vector moved = x;
    moved[k] += h / f.dt;
    Problem::Value there = f(moved);
    double step = h;
    if (!there.valid()) {
      moved[k] = x[k] - h / f.dt;
      there = f(moved);
      step = -h;
    }
    if (!there.valid()) return false;
    for (int i = 0; i < f.control.size; ++i) jacobian[i * capacity + k] = (there.residual[i] - at.residual[i]) / step;
  }
  return true;
}

/// Broyden's rank-one correction: the least change of the Jacobian that explains how the residual changed along `moved`.
void correct(Matrix& jacobian, const Vector& moved, const Vector& change, int n) {
  double squared = 0.0;
  for (int j = 0; j < n; ++j) squared += moved[j] * moved[j];
  if (squared == 0.0) return;
  for (int i = 0; i < n; ++i) {
    double unexplained = change[i];
    for (int j = 0; j < n; ++j) unexplained -= jacobian[i * capacity + j] * moved[j];
    for (int j = 0; j < n; ++j) jacobian[i * capacity + j] += unexplained * moved[j] / squared;
  }
}

}  // namespace

ControlledStep controlled_step(PointUpdate& update, const State<double>& before, const Control& control, double dt, double time,
                               WarmStart& warm) {
  const int n = control.size;
  Problem f{update, before, control, dt, time};
  Vector x = warm.x;
  Problem::Value at = f(x);
  if (!at.valid() && n > 0) {
    x = {};
    at = f(x);
  }

  bool fresh = false;
  constexpr int most_iterations = 60;
  for (int iteration = 0; at.valid() && at.size > control_tolerance && iteration < most_iterations; ++iteration) {
    if (!fresh && (!warm.has_jacobian || iteration % 8 == 7)) {
      if (!differences(f, x, at, warm.jacobian)) break;
      fresh = warm.has_jacobian = true;
    }
    Vector step;
    bool descends = solve(warm.jacobian, at.residual, n, step);
    double damping = 1.0;
    Problem::Value next;
    for (int halving = 0; descends && halving < (fresh ? 12 : 1); ++halving, damping *= 0.5) {
      next = f(sum(x, -damping / dt, step));
      if (next.size < (1.0 - 1e-4 * damping) * at.size) break;
    }
    descends = next.size < at.size;
    if (!descends && fresh) break;  // not even along the true Jacobian
    fresh = false;
    if (!descends) {
      warm.has_jacobian = false;  // the remembered one has grown old
      continue;
    }
    correct(warm.jacobian, sum({}, -damping, step), sum(next.residual, -1.0, at.residual), n);
    x = sum(x, -damping / dt, step);
    at = next;
  }

  ControlledStep result;
  result.trouble = trouble_of(at.point);
  result.converged = at.size <= control_tolerance;
  result.residual = at.size;
  result.velocity_gradient = at.L;
  result.point = at.point;
  if (result.converged)
    warm.x = x;
  else
    warm = {};
  return result;
}

}  // namespace brisance::driver
