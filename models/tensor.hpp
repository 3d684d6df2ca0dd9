#pragma once
// Second-order tensors in three dimensions with named components, on any Real.

#include <type_traits>

#include "models/real.hpp"

namespace brisance {

/// a1 b1 + a2 b2 + a3 b3
template <class Real>
Real dot(const Real& a1, const Real& b1, const Real& a2, const Real& b2, const Real& a3, const Real& b3) {
  return multiply_add(a3, b3, multiply_add(a2, b2, Real(a1 * b1)));
}

/// A general second-order tensor; `xy` is row x, column y.
template <class Real>
struct Tensor {
  Real xx{0.0}, xy{0.0}, xz{0.0};
  Real yx{0.0}, yy{0.0}, yz{0.0};
  Real zx{0.0}, zy{0.0}, zz{0.0};

  static Tensor identity() {
    Tensor I;
    I.xx = I.yy = I.zz = Real(1.0);
    return I;
  }
};

/// A symmetric second-order tensor. Shear components are tensor components, not engineering strains.
template <class Real>
struct SymmetricTensor {
  Real xx{0.0}, yy{0.0}, zz{0.0}, yz{0.0}, xz{0.0}, xy{0.0};

  static SymmetricTensor identity() {
    SymmetricTensor I;
    I.xx = I.yy = I.zz = Real(1.0);
    return I;
  }
};

/// Calls f(component of a, component of b, ...) for the six independent components.
template <class F, class... S>
void for_each_component(F&& f, S&&... s) {
  f(s.xx...), f(s.yy...), f(s.zz...), f(s.yz...), f(s.xz...), f(s.xy...);
}

// Symmetric tensors --------------------------------------------------------------------------------------------------

template <class Real>
SymmetricTensor<Real> operator+(const SymmetricTensor<Real>& a, const SymmetricTensor<Real>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
}
template <class Real>
SymmetricTensor<Real> operator-(const SymmetricTensor<Real>& a, const SymmetricTensor<Real>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.yz - b.yz, a.xz - b.xz, a.xy - b.xy};
}
template <class Real>
SymmetricTensor<Real> operator*(const std::type_identity_t<Real>& f, const SymmetricTensor<Real>& a) {
  return {f * a.xx, f * a.yy, f * a.zz, f * a.yz, f * a.xz, f * a.xy};
}
/// f a + g b
template <class Real>
SymmetricTensor<Real> combine(const Real& f, const SymmetricTensor<Real>& a, const Real& g, const SymmetricTensor<Real>& b) {
  const auto sum = [&](const Real& x, const Real& y) { return multiply_add(f, x, Real(g * y)); };
  return {sum(a.xx, b.xx), sum(a.yy, b.yy), sum(a.zz, b.zz), sum(a.yz, b.yz), sum(a.xz, b.xz), sum(a.xy, b.xy)};
}
template <class Real>
Real trace(const SymmetricTensor<Real>& a) {
  return a.xx + a.yy + a.zz;
}
/// a + f I
template <class Real>
SymmetricTensor<Real> add_to_diagonal(SymmetricTensor<Real> a, const Real& f) {
  a.xx = a.xx + f, a.yy = a.yy + f, a.zz = a.zz + f;
  return a;
}
template <class Real>
SymmetricTensor<Real> deviator(const SymmetricTensor<Real>& a) {
  return add_to_diagonal(a, Real(-(1.0 / 3.0) * trace(a)));
}
/// a : b
template <class Real>
Real double_dot(const SymmetricTensor<Real>& a, const SymmetricTensor<Real>& b) {
  return dot(a.xx, b.xx, a.yy, b.yy, a.zz, b.zz) + 2.0 * dot(a.yz, b.yz, a.xz, b.xz, a.xy, b.xy);
}
/// |a| = sqrt(a : a)
template <class Real>
Real norm(const SymmetricTensor<Real>& a) {
  return sqrt(double_dot(a, a));
}
/// q = sqrt(3/2 s : s) of the deviator s.
template <class Real>
Real equivalent_stress(const SymmetricTensor<Real>& deviatoric_stress) {
  return sqrt(1.5 * double_dot(deviatoric_stress, deviatoric_stress));
}
template <class Real>
Real determinant(const SymmetricTensor<Real>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) + a.xz * (a.xy * a.yz - a.yy * a.xz);
}
/// a a, which is symmetric.
template <class Real>
SymmetricTensor<Real> square(const SymmetricTensor<Real>& a) {
  return {dot(a.xx, a.xx, a.xy, a.xy, a.xz, a.xz), dot(a.xy, a.xy, a.yy, a.yy, a.yz, a.yz),
          dot(a.xz, a.xz, a.yz, a.yz, a.zz, a.zz), dot(a.xy, a.xz, a.yy, a.yz, a.yz, a.zz),
          dot(a.xx, a.xz, a.xy, a.yz, a.xz, a.zz), dot(a.xx, a.xy, a.xy, a.yy, a.xz, a.yz)};
}
template <class Real>
SymmetricTensor<Real> select(const mask_of<Real>& m, const SymmetricTensor<Real>& a, const SymmetricTensor<Real>& b) {
  return {select(m, a.xx, b.xx), select(m, a.yy, b.yy), select(m, a.zz, b.zz),
          select(m, a.yz, b.yz), select(m, a.xz, b.xz), select(m, a.xy, b.xy)};
}

// General tensors ----------------------------------------------------------------------------------------------------

template <class Real>
Tensor<Real> operator+(const Tensor<Real>& a, const Tensor<Real>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy, a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
template <class Real>
Tensor<Real> operator-(const Tensor<Real>& a, const Tensor<Real>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yx - b.yx, a.yy - b.yy, a.yz - b.yz, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}
template <class Real>
Tensor<Real> operator*(const std::type_identity_t<Real>& f, const Tensor<Real>& a) {
  return {f * a.xx, f * a.xy, f * a.xz, f * a.yx, f * a.yy, f * a.yz, f * a.zx, f * a.zy, f * a.zz};
}
/// f a + g b
template <class Real>
Tensor<Real> combine(const Real& f, const Tensor<Real>& a, const Real& g, const Tensor<Real>& b) {
  const auto sum = [&](const Real& x, const Real& y) { return multiply_add(f, x, Real(g * y)); };
  return {sum(a.xx, b.xx), sum(a.xy, b.xy), sum(a.xz, b.xz), sum(a.yx, b.yx), sum(a.yy, b.yy),
          sum(a.yz, b.yz), sum(a.zx, b.zx), sum(a.zy, b.zy), sum(a.zz, b.zz)};
}
/// a + f I
template <class Real>
Tensor<Real> add_to_diagonal(Tensor<Real> a, const Real& f) {
  a.xx = a.xx + f, a.yy = a.yy + f, a.zz = a.zz + f;
  return a;
}
template <class Real>
Tensor<Real> operator*(const Tensor<Real>& a, const Tensor<Real>& b) {
  return {dot(a.xx, b.xx, a.xy, b.yx, a.xz, b.zx), dot(a.xx, b.xy, a.xy, b.yy, a.xz, b.zy),
          dot(a.xx, b.xz, a.xy, b.yz, a.xz, b.zz), dot(a.yx, b.xx, a.yy, b.yx, a.yz, b.zx),
          dot(a.yx, b.xy, a.yy, b.yy, a.yz, b.zy), dot(a.yx, b.xz, a.yy, b.yz, a.yz, b.zz),
          dot(a.zx, b.xx, a.zy, b.yx, a.zz, b.zx), dot(a.zx, b.xy, a.zy, b.yy, a.zz, b.zy),
          dot(a.zx, b.xz, a.zy, b.yz, a.zz, b.zz)};
}
template <class Real>
Tensor<Real> transpose(const Tensor<Real>& a) {
  return {a.xx, a.yx, a.zx, a.xy, a.yy, a.zy, a.xz, a.yz, a.zz};
}
template <class Real>
Tensor<Real> to_tensor(const SymmetricTensor<Real>& a) {
  return {a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz};
}
template <class Real>
SymmetricTensor<Real> symmetric_part(const Tensor<Real>& a) {
  return {a.xx, a.yy, a.zz, 0.5 * (a.yz + a.zy), 0.5 * (a.xz + a.zx), 0.5 * (a.xy + a.yx)};
}
template <class Real>
Tensor<Real> skew_part(const Tensor<Real>& a) {
  const Real xy = 0.5 * (a.xy - a.yx), xz = 0.5 * (a.xz - a.zx), yz = 0.5 * (a.yz - a.zy);
  return {Real(0.0), xy, xz, -xy, Real(0.0), yz, -xz, -yz, Real(0.0)};
}
template <class Real>
Real trace(const Tensor<Real>& a) {
  return a.xx + a.yy + a.zz;
}
template <class Real>
Real determinant(const Tensor<Real>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.zy) - a.xy * (a.yx * a.zz - a.yz * a.zx) + a.xz * (a.yx * a.zy - a.yy * a.zx);
}
template <class Real>
Tensor<Real> inverse(const Tensor<Real>& a) {
  const Real r = 1.0 / determinant(a);
  return {r * (a.yy * a.zz - a.yz * a.zy), r * (a.xz * a.zy - a.xy * a.zz), r * (a.xy * a.yz - a.xz * a.yy),
          r * (a.yz * a.zx - a.yx * a.zz), r * (a.xx * a.zz - a.xz * a.zx), r * (a.xz * a.yx - a.xx * a.yz),
          r * (a.yx * a.zy - a.yy * a.zx), r * (a.xy * a.zx - a.xx * a.zy), r * (a.xx * a.yy - a.xy * a.yx)};
}
/// a : b
template <class Real>
Real double_dot(const Tensor<Real>& a, const Tensor<Real>& b) {
  return dot(a.xx, b.xx, a.xy, b.xy, a.xz, b.xz) + dot(a.yx, b.yx, a.yy, b.yy, a.yz, b.yz) +
         dot(a.zx, b.zx, a.zy, b.zy, a.zz, b.zz);
}
/// |a| = sqrt(a : a)
template <class Real>
Real norm(const Tensor<Real>& a) {
  return sqrt(double_dot(a, a));
}
/// a a^T
template <class Real>
SymmetricTensor<Real> times_own_transpose(const Tensor<Real>& a) {
  return {dot(a.xx, a.xx, a.xy, a.xy, a.xz, a.xz), dot(a.yx, a.yx, a.yy, a.yy, a.yz, a.yz),
          dot(a.zx, a.zx, a.zy, a.zy, a.zz, a.zz), dot(a.yx, a.zx, a.yy, a.zy, a.yz, a.zz),
          dot(a.xx, a.zx, a.xy, a.zy, a.xz, a.zz), dot(a.xx, a.yx, a.xy, a.yy, a.xz, a.yz)};
}
/// R s R^T
template <class Real>
SymmetricTensor<Real> rotate(const Tensor<Real>& R, const SymmetricTensor<Real>& s) {
  const Tensor<Real> Rs = R * to_tensor(s);
  return {dot(Rs.xx, R.xx, Rs.xy, R.xy, Rs.xz, R.xz), dot(Rs.yx, R.yx, Rs.yy, R.yy, Rs.yz, R.yz),
          dot(Rs.zx, R.zx, Rs.zy, R.zy, Rs.zz, R.zz), dot(Rs.yx, R.zx, Rs.yy, R.zy, Rs.yz, R.zz),
          dot(Rs.xx, R.zx, Rs.xy, R.zy, Rs.xz, R.zz), dot(Rs.xx, R.yx, Rs.xy, R.yy, Rs.xz, R.yz)};
}
template <class Real>
Tensor<Real> select(const mask_of<Real>& m, const Tensor<Real>& a, const Tensor<Real>& b) {
  return {select(m, a.xx, b.xx), select(m, a.xy, b.xy), select(m, a.xz, b.xz), select(m, a.yx, b.yx), select(m, a.yy, b.yy),
          select(m, a.yz, b.yz), select(m, a.zx, b.zx), select(m, a.zy, b.zy), select(m, a.zz, b.zz)};
}

}  // namespace brisance
