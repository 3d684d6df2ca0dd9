#pragma once
// Finite kinematics of one step: the increment of deformation dF = exp(dt L), its rotation and its logarithmic strain.

#include <array>
#include <cstddef>

#include "models/tensor.hpp"

namespace brisance {

namespace detail {

/// The first coefficients of a power series, from the ratio of one to the next.
template <std::size_t count, class Ratio>
constexpr std::array<double, count> series(double first, Ratio&& ratio) {
  std::array<double, count> c{};
  c[0] = first;
  for (std::size_t k = 1; k < count; ++k) c[k] = c[k - 1] * ratio(static_cast<double>(k));
  return c;
}
inline constexpr auto exponential_series = series<15>(1.0, [](double k) { return 1.0 / k; });
inline constexpr auto inverse_root_series = series<31>(1.0, [](double k) { return -(2.0 * k - 1.0) / (2.0 * k); });
inline constexpr auto half_logarithm_series = [] {
  std::array<double, 31> c{};
  for (std::size_t k = 1; k < c.size(); ++k) c[k] = (k % 2 ? 0.5 : -0.5) / static_cast<double>(k);
  return c;
}();

/// The powers of a tensor by its invariants (Cayley-Hamilton): A^k = a A^2 + b A + c I.
template <class Real>
struct Powers {
  Real I1, minus_I2, I3;
  Real a{1.0}, b{0.0}, c{0.0};  // of A^2
  void next() {
    const Real a_next = multiply_add(a, I1, b), b_next = multiply_add(a, minus_I2, c), c_next = a * I3;
    a = a_next, b = b_next, c = c_next;
  }
};

/// A power series from its second power on, in the basis A^2, A, I.
template <class Real>
struct Sum {
  Real a, b{0.0}, c{0.0};
};

/// Sums a series up to the power `least`; where the tensor is not `small` up to the power `last`, and where it is `large` up to
/// the last coefficient: each lane as far as it needs, whatever its neighbours do.
template <std::size_t least, std::size_t last, class Real, std::size_t count>
Sum<Real> sum_series(const std::array<double, count>& coefficients, Powers<Real> power, const mask_of<Real>& small,
                     const mask_of<Real>& large) {
  Sum<Real> sum{Real(coefficients[2])};
  const auto add = [&](std::size_t k) {
    power.next();
    const Real factor(coefficients[k]);
    sum.a = multiply_add(factor, power.a, sum.a), sum.b = multiply_add(factor, power.b, sum.b);
    sum.c = multiply_add(factor, power.c, sum.c);
  };
  const auto keep = [&](const mask_of<Real>& where, const Sum<Real>& shorter) {
    sum = {select(where, shorter.a, sum.a), select(where, shorter.b, sum.b), select(where, shorter.c, sum.c)};
  };
  for (std::size_t k = 3; k <= least; ++k) add(k);
  if (all(small)) return sum;
  const Sum<Real> of_small = sum;
  for (std::size_t k = least + 1; k <= last; ++k) add(k);
  const Sum<Real> of_middle = sum;
  if (any(large)) {
    for (std::size_t k = last + 1; k < count; ++k) add(k);
    keep(!large, of_middle);
  }
  keep(small, of_small);
  return sum;
}

}  // namespace detail

/// exp(A) - I by its power series, of which only A^2 is formed, the rest are scalars. Exact to round-off for |A| <= 0.5;
/// beyond, the error grows (1e-9 at |A| = 1.2).
template <class Real>
Tensor<Real> exponential_minus_identity(const Tensor<Real>& A) {
  const Tensor<Real> A2 = A * A;
  const Real I1 = trace(A), I2 = 0.5 * (I1 * I1 - trace(A2)), I3 = determinant(A);
  const Real size2 = double_dot(A, A);
  const auto sum = detail::sum_series<5, 8>(detail::exponential_series, detail::Powers<Real>{I1, -I2, I3},
                                            size2 <= 0.0015 * 0.0015, size2 > 0.03 * 0.03);
  return add_to_diagonal(combine(sum.a, A2, Real(1.0 + sum.b), A), sum.c);
}

template <class Real>
Tensor<Real> exponential(const Tensor<Real>& A) {
  return Tensor<Real>::identity() + exponential_minus_identity(A);
}

/// I + B = V R with V symmetric: the rotation R and the logarithmic strain ln V.
template <class Real>
struct PolarIncrement {
  Tensor<Real> rotation;
  SymmetricTensor<Real> strain;
  Real size;  // |V^2 - I|; the series below are exact to round-off up to 0.3
};

/// Of the increment of deformation dF = I + B. It is B that is given because 1 + B would round the strain of a small step.
template <class Real>
PolarIncrement<Real> polar_increment(const Tensor<Real>& B) {
  const Tensor<Real> dF = Tensor<Real>::identity() + B;
  const SymmetricTensor<Real> E = Real(2.0) * symmetric_part(B) + times_own_transpose(B);  // V^2 - I
  const SymmetricTensor<Real> E2 = square(E);
  const Real I1 = trace(E), I2 = 0.5 * (I1 * I1 - trace(E2)), I3 = determinant(E);
  PolarIncrement<Real> result;
  const Real size2 = trace(E2);
  result.size = sqrt(size2);
  const mask_of<Real> small = size2 <= 0.0025 * 0.0025, large = size2 > 0.004 * 0.004;
  const detail::Powers<Real> powers{I1, -I2, I3};
  const auto root = detail::sum_series<6, 7>(detail::inverse_root_series, powers, small, large);
  const auto logarithm = detail::sum_series<6, 7>(detail::half_logarithm_series, powers, small, large);
  const SymmetricTensor<Real> inverse_V = add_to_diagonal(combine(root.a, E2, Real(root.b - 0.5), E), Real(1.0 + root.c));
  result.strain = add_to_diagonal(combine(logarithm.a, E2, Real(logarithm.b + 0.5), E), logarithm.c);
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
