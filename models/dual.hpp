#pragma once
// Dual numbers: a value and its first derivatives with respect to N variables. The formula of a law evaluated on duals
// gives its derivatives to round-off, so nobody writes a derivative by hand. The base may be a double, a pack of lanes,
// or another dual (second derivatives).

#include <array>
#include <type_traits>

#include "models/real.hpp"

namespace brisance {

template <class Base, int N = 1>
struct Dual {
  Base value{0.0};
  std::array<Base, N> derivative{};

  Dual() { derivative.fill(Base(0.0)); }
  Dual(double constant) : value(constant) { derivative.fill(Base(0.0)); }
  Dual(const Base& constant) requires(!std::is_same_v<Base, double>) : value(constant) { derivative.fill(Base(0.0)); }
  Dual(const Base& f, const std::array<Base, N>& slopes) : value(f), derivative(slopes) {}

  /// The independent variable number `index`: derivative one with respect to itself.
  static Dual variable(const Base& at, int index = 0) {
    Dual x;
    x.value = at;
    x.derivative[index] = Base(1.0);
    return x;
  }

  /// f(x) from its value and its derivative df/dx at x.
  Dual chain(const Base& f, const Base& slope) const {
    Dual result;
    result.value = f;
    for (int i = 0; i < N; ++i) result.derivative[i] = slope * derivative[i];
    return result;
  }

  friend Dual operator-(const Dual& a) { return a.chain(-a.value, Base(-1.0)); }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual c;
    c.value = a.value + b.value;
    for (int i = 0; i < N; ++i) c.derivative[i] = a.derivative[i] + b.derivative[i];
    return c;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual c;
    c.value = a.value - b.value;
    for (int i = 0; i < N; ++i) c.derivative[i] = a.derivative[i] - b.derivative[i];
    return c;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual c;
    c.value = a.value * b.value;
    for (int i = 0; i < N; ++i) c.derivative[i] = a.derivative[i] * b.value + a.value * b.derivative[i];
    return c;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual c;
    const Base reciprocal = 1.0 / b.value;
    c.value = a.value / b.value;  // to the same bits as without derivatives
    for (int i = 0; i < N; ++i) c.derivative[i] = (a.derivative[i] - c.value * b.derivative[i]) * reciprocal;
    return c;
  }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend auto operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend auto operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend auto operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend auto operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
};

template <class Base, int N>
struct mask_type<Dual<Base, N>> : mask_type<Base> {};

template <class Base, int N>
auto value_of(const Dual<Base, N>& x) {
  return value_of(x.value);
}

template <class Base, int N>
Dual<Base, N> select(const mask_of<Base>& condition, const Dual<Base, N>& yes, const Dual<Base, N>& no) {
  Dual<Base, N> c;
  c.value = select(condition, yes.value, no.value);
  for (int i = 0; i < N; ++i) c.derivative[i] = select(condition, yes.derivative[i], no.derivative[i]);
  return c;
}

template <class Base, int N>
Dual<Base, N> min(const Dual<Base, N>& a, const std::type_identity_t<Dual<Base, N>>& b) {
  return select(a.value <= b.value, a, b);
}
template <class Base, int N>
Dual<Base, N> max(const Dual<Base, N>& a, const std::type_identity_t<Dual<Base, N>>& b) {
  return select(a.value >= b.value, a, b);
}
template <class Base, int N>
Dual<Base, N> abs(const Dual<Base, N>& a) {
  return select(a.value < 0.0, -a, a);
}

template <class Base, int N>
Dual<Base, N> sqrt(const Dual<Base, N>& a) {
  const Base root = sqrt(a.value);
  return a.chain(root, 0.5 / root);
}
template <class Base, int N>
Dual<Base, N> exp(const Dual<Base, N>& a) {
  const Base e = exp(a.value);
  return a.chain(e, e);
}
template <class Base, int N>
Dual<Base, N> expm1(const Dual<Base, N>& a) {
  const Base e = expm1(a.value);
  return a.chain(e, e + 1.0);
}
template <class Base, int N>
Dual<Base, N> log(const Dual<Base, N>& a) {
  return a.chain(log(a.value), 1.0 / a.value);
}
template <class Base, int N>
Dual<Base, N> log1p(const Dual<Base, N>& a) {
  return a.chain(log1p(a.value), 1.0 / (1.0 + a.value));
}
/// base^exponent for base > 0; exact 0 at base = 0 (with derivative 0) for positive exponents.
template <class Base, int N>
Dual<Base, N> pow(const Dual<Base, N>& base, double exponent) {
  const Base power = pow(base.value, exponent);
  const Base slope = select(base.value > 0.0, exponent * power / max(base.value, Base(1e-300)), Base(0.0));
  return base.chain(power, slope);
}
template <class Base, int N>
Dual<Base, N> tanh(const Dual<Base, N>& a) {
  const Base t = tanh(a.value);
  return a.chain(t, 1.0 - t * t);
}
template <class Base, int N>
Dual<Base, N> sinh(const Dual<Base, N>& a) {
  return a.chain(sinh(a.value), cosh(a.value));
}
template <class Base, int N>
Dual<Base, N> cosh(const Dual<Base, N>& a) {
  return a.chain(cosh(a.value), sinh(a.value));
}
template <class Base, int N>
Dual<Base, N> erf(const Dual<Base, N>& a) {
  constexpr double two_over_sqrt_pi = 1.1283791670955126;
  return a.chain(erf(a.value), two_over_sqrt_pi * exp(-(a.value * a.value)));
}

}  // namespace brisance
