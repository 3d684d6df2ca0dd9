#pragma once
// Finite kinematics of one step: the increment of deformation dF = exp(dt L), its rotation and its logarithmic strain.

#include "models/tensor.hpp"

namespace brisance {

/// exp(A) by its power series, summed through the Cayley-Hamilton theorem: only A^2 is formed, the rest are scalars.
/// Exact to round-off for |A| <= 0.5; `error` grows beyond (1e-9 at |A| = 1.2).
template <class Real>
Tensor<Real> exponential(const Tensor<Real>& A) {
  const Tensor<Real> A2 = A * A;
  const Real I1 = trace(A), I2 = 0.5 * (I1 * I1 - trace(A2)), I3 = determinant(A);
  // A^k = a A^2 + b A + c I, starting at k = 2.
  Real a(1.0), b(0.0), c(0.0);
  Real sum_a(0.5), sum_b(1.0), sum_c(1.0);
  double reciprocal_factorial = 0.5;
  for (int k = 3; k <= 14; ++k) {
    const Real next_a = a * I1 + b, next_b = c - a * I2, next_c = a * I3;
    a = next_a, b = next_b, c = next_c;
    reciprocal_factorial /= k;
    sum_a = sum_a + reciprocal_factorial * a;
    sum_b = sum_b + reciprocal_factorial * b;
    sum_c = sum_c + reciprocal_factorial * c;
  }
  Tensor<Real> result = sum_a * A2 + sum_b * A;
  result.xx = result.xx + sum_c, result.yy = result.yy + sum_c, result.zz = result.zz + sum_c;
  return result;
}

/// dF = V R with V symmetric: the rotation R and the logarithmic strain ln V.
template <class Real>
struct PolarIncrement {
  Tensor<Real> rotation;
  SymmetricTensor<Real> strain;
  Real size;  // |V^2 - I|; the series below are exact to round-off up to 0.3
};

namespace detail {
/// f(E) = f0 I + f1 E + f2 E^2 + ... for two power series at once, summed through the Cayley-Hamilton theorem.
/// next(k, a, b) turns the k-th coefficients of both series into the (k+1)-th.
template <class Real, class Next>
void isotropic_series(const SymmetricTensor<Real>& E, int terms, double first_0, double first_1, double second_0, double second_1,
                      Next&& next, SymmetricTensor<Real>& first, SymmetricTensor<Real>& second) {
  const SymmetricTensor<Real> E2 = square(E);
  const Real I1 = trace(E), I2 = 0.5 * (I1 * I1 - trace(E2)), I3 = determinant(E);
  Real a(0.0), b(1.0), c(0.0);
  Real fa(0.0), fb(first_1), fc(first_0), ga(0.0), gb(second_1), gc(second_0);
  double f = first_1, g = second_1;
  for (int k = 1; k < terms; ++k) {
    const Real next_a = a * I1 + b, next_b = c - a * I2, next_c = a * I3;
    a = next_a, b = next_b, c = next_c;
    next(k, f, g);
    fa = fa + f * a, fb = fb + f * b, fc = fc + f * c;
    ga = ga + g * a, gb = gb + g * b, gc = gc + g * c;
  }
  first = add_to_diagonal(fa * E2 + fb * E, fc);
  second = add_to_diagonal(ga * E2 + gb * E, gc);
}
}  // namespace detail

template <class Real>
PolarIncrement<Real> polar_increment(const Tensor<Real>& dF) {
  const SymmetricTensor<Real> E = add_to_diagonal(times_own_transpose(dF), Real(-1.0));  // V^2 - I
  PolarIncrement<Real> result;
  result.size = norm(E);
  SymmetricTensor<Real> inverse_V;
  // (1 + E)^(-1/2) and ln(1 + E)/2. A lane that needs the long sum takes it whatever its neighbours do.
  const auto next = [](int k, double& f, double& g) {
    f *= -(2.0 * k + 1.0) / (2.0 * k + 2.0);
    g *= -static_cast<double>(k) / (k + 1.0);
  };
  detail::isotropic_series(E, 10, 1.0, -0.5, 0.0, 0.5, next, inverse_V, result.strain);
  const auto large = result.size > 0.03;
  if (any(large)) {
    SymmetricTensor<Real> inverse_V_long, strain_long;
    detail::isotropic_series(E, 30, 1.0, -0.5, 0.0, 0.5, next, inverse_V_long, strain_long);
    inverse_V = select(large, inverse_V_long, inverse_V);
    result.strain = select(large, strain_long, result.strain);
  }
  result.rotation = to_tensor(inverse_V) * dF;
  return result;
}

/// R of F = R U, by Higham's scaled Newton iteration (SIAM J. Sci. Stat. Comput. 7 (1986) 1160-1174). det F > 0.
template <class Real>
Tensor<Real> polar_rotation(const Tensor<Real>& F) {
  Tensor<Real> R = F;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Tensor<Real> inverse_transpose = transpose(inverse(R));
    const Real gamma = sqrt(norm(inverse_transpose) / norm(R));
    const Tensor<Real> next = Real(0.5) * (gamma * R + (1.0 / gamma) * inverse_transpose);
    const auto done = norm(next - R) < 1e-15 * norm(R);
    R = select(done, R, next);
    if (all(done)) break;
  }
  return R;
}

}  // namespace brisance
