#pragma once
// The number types a formula can run on. Every law is one formula templated on Real, where Real is
//   double          point driver, rate form, tests
//   Lanes           8 doubles side by side: the simulator
//   Dual<Real, N>   value and derivatives (dual.hpp)
// and uses only the functions declared here, found through this namespace. Branches are written with select().

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace brisance {

/// The result of comparing two Reals: bool, or one bool per lane.
template <class Real>
struct mask_type {
  using type = bool;
};
template <class Real>
using mask_of = typename mask_type<Real>::type;

inline double value_of(double x) {
  return x;
}
inline double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}
inline bool any(bool m) {
  return m;
}
inline bool all(bool m) {
  return m;
}
inline bool none(bool m) {
  return !m;
}

inline double min(double a, double b) {
  return b < a ? b : a;
}
inline double max(double a, double b) {
  return a < b ? b : a;
}
/// a b + c, rounded once for doubles and lanes alike.
template <class Real>
Real multiply_add(const Real& a, const Real& b, const Real& c) {
  return a * b + c;
}
inline double multiply_add(double a, double b, double c) {
  return std::fma(a, b, c);
}
inline double abs(double a) {
  return std::fabs(a);
}
inline double sqrt(double a) {
  return std::sqrt(a);
}
inline double exp(double a) {
  return std::exp(a);
}
inline double expm1(double a) {
  return std::expm1(a);
}
inline double log(double a) {
  return std::log(a);
}
inline double log1p(double a) {
  return std::log1p(a);
}
/// base^exponent for base >= 0.
inline double pow(double base, double exponent) {
  return std::pow(base, exponent);
}
inline double tanh(double a) {
  return std::tanh(a);
}
inline double sinh(double a) {
  return std::sinh(a);
}
inline double cosh(double a) {
  return std::cosh(a);
}
inline double erf(double a) {
  return std::erf(a);
}
inline bool is_finite(double a) {
  return std::isfinite(a);
}

// Lanes --------------------------------------------------------------------------------------------------------------
//
// Results must not depend on the machine. The width is therefore eight on every instruction set: one AVX-512 register,
// two of AVX2, four of SSE2. The functions are built only from operations that IEEE 754 defines to the last bit (+ - * /,
// square root, fused multiply-add, comparison, integer arithmetic on the bits), in an order written down here and never
// contracted by the compiler, so every instruction set gives equal bits. exp, log and the like of the mathematics
// library are not called: their results differ from machine to machine. Measurements: docs/decisions/lanes.md.

namespace simd {

#if defined(__AVX512F__)
inline constexpr int register_width = 8;
#elif defined(__AVX2__) && defined(__FMA__)
inline constexpr int register_width = 4;
#else
inline constexpr int register_width = 2;
#endif

using Register = double __attribute__((vector_size(8 * register_width)));
using Bits = std::uint64_t __attribute__((vector_size(8 * register_width)));
using Truth = std::int64_t __attribute__((vector_size(8 * register_width)));  // of a comparison: 0 or -1

// a * b + c, rounded once.
inline Register fma(Register a, Register b, Register c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_pd(a, b, c);
#elif defined(__AVX2__) && defined(__FMA__)
  return _mm256_fmadd_pd(a, b, c);
#else
  return Register{std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1])};  // the same bits, slowly
#endif
}
inline Register sqrt(Register a) {
#if defined(__AVX512F__)
  return _mm512_maskz_sqrt_pd(0xff, a);  // the unmasked form draws a false warning from GCC 12
#elif defined(__AVX2__) && defined(__FMA__)
  return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(a);
#else
  return Register{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}
inline bool any(Truth m) {
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(m), reinterpret_cast<__m512i>(m)) != 0;
#elif defined(__AVX2__) && defined(__FMA__)
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(m)) != 0;
#else
  return (m[0] | m[1]) != 0;
#endif
}

inline Bits bits_of(Register a) {
  return reinterpret_cast<Bits>(a);
}
inline Register from_bits(Bits a) {
  return reinterpret_cast<Register>(a);
}
// Minus zero, because plus zero would lose the sign of a negative zero.
inline Register broadcast(double a) {
  return a - Register{};
}
inline Register fma(Register a, double b, Register c) {
  return fma(a, broadcast(b), c);
}
inline Register fma(Register a, double b, double c) {
  return fma(a, broadcast(b), broadcast(c));
}
inline Register fma(Register a, Register b, double c) {
  return fma(a, b, broadcast(c));
}
// b < a ? b : a and a < b ? b : a: of a NaN and a number, the first argument.
inline Register min(Register a, Register b) {
#if defined(__AVX512F__)
  return _mm512_maskz_min_pd(0xff, b, a);
#elif defined(__AVX2__) && defined(__FMA__)
  return _mm256_min_pd(b, a);
#else
  return b < a ? b : a;
#endif
}
inline Register max(Register a, Register b) {
#if defined(__AVX512F__)
  return _mm512_maskz_max_pd(0xff, b, a);
#elif defined(__AVX2__) && defined(__FMA__)
  return _mm256_max_pd(b, a);
#else
  return a < b ? b : a;
#endif
}

inline constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;
inline Register abs(Register a) {
  return from_bits(bits_of(a) & ~sign_bit);
}
inline Register with_sign_of(Register sign, Register magnitude) {
  return from_bits(bits_of(magnitude) | (bits_of(sign) & sign_bit));
}

// c[0] + c[1] x + c[2] x^2 + ..., from both halves at once (Estrin): the chain of dependent operations, which is what takes the
// time, grows with the logarithm of the degree. powers: x, x^2, x^4, x^8.
template <std::size_t first, std::size_t count, std::size_t size>
Register polynomial(const Register (&powers)[4], const double (&c)[size]) {
  if constexpr (count == 1) {
    return broadcast(c[first]);
  } else {
    constexpr std::size_t half = std::bit_floor(count - 1);
    return fma(polynomial<first + half, count - half>(powers, c), powers[std::countr_zero(half)],
               polynomial<first, half>(powers, c));
  }
}
template <std::size_t size>
Register polynomial(Register x, const double (&c)[size]) {
  static_assert(size <= 16);
  const Register x2 = x * x, x4 = x2 * x2;
  return polynomial<0, size>({x, x2, x4, x4 * x4}, c);
}

// ln 2 in two parts; the high one has so few bits that its product with an exponent is exact.
inline constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
// Added to a number, leaves the nearest integer in the low bits of the sum.
inline constexpr double shifter = 0x1.8p52;

// 2^n, where shifted = n + shifter.
inline Register power_of_two(Register shifted) {
  return from_bits((bits_of(shifted) << 52) + (std::uint64_t{1023} << 52));
}
// y 2^n for y of order one, rounded once even where the result is subnormal.
inline Register scale(Register y, Register shifted) {
  const Register n = shifted - shifter;
  const Register half = fma(n, 0.5, shifter);
  return y * power_of_two(half) * power_of_two(n - (half - shifter) + shifter);
}

// e^(x + x_low) = 2^n (1 + q) with |q| < 0.42. Needs |x| < 1400 or NaN, and |x_low| of the last bit of x.
struct Exponential {
  Register q, shifted;
};
inline Exponential exponential(Register x, Register x_low = Register{}) {
  constexpr double one_over_ln2 = 0x1.71547652b82fep+0;
  const Register shifted = fma(x, one_over_ln2, shifter);
  const Register n = shifted - shifter;
  const Register r = fma(n, -ln2_low, fma(n, -ln2_high, x)) + x_low;
  // (e^r - 1 - r) / r^2 on |r| < ln(2)/2, Chebyshev interpolation, error 1.2e-16
  constexpr double c[] = {0.5000000000000001,     0.16666666666666669,    0.04166666666662413,    0.008333333333330062,
                          0.0013888888917213717,  0.00019841269863053618, 2.4801521295954376e-05, 2.7557268459997064e-06,
                          2.7620088445409746e-07, 2.510038549551032e-08};
  return {fma(r * r, polynomial(r, c), r), shifted};
}
// Beyond these the result is 0 or infinity anyway.
inline Register limit_exponent(Register x) {
  return max(min(x, broadcast(711.0)), broadcast(-746.0));
}

inline Register exp(Register x) {
  const Exponential e = exponential(limit_exponent(x));
  return scale(1.0 + e.q, e.shifted);
}
inline Register expm1(Register x) {
  const Exponential e = exponential(limit_exponent(x));
  return e.shifted == shifter ? e.q : scale(1.0 + e.q, e.shifted) - 1.0;
}

// x = 2^k m with m in [sqrt(1/2), sqrt(2)), for a positive x.
struct Normalised {
  Register k, m;
};
inline Normalised normalise(Register x) {
  constexpr std::uint64_t sqrt_half = 0x3fe6a09e667f3bcd, one = std::uint64_t{1023} << 52;
  constexpr std::uint64_t mantissa = (std::uint64_t{1} << 52) - 1, two_to_52 = std::uint64_t{1075} << 52;
  const Truth subnormal = x < 0x1p-1022;
  const Bits shifted = bits_of(subnormal ? x * 0x1p54 : x) + (one - sqrt_half);
  const Register offset = subnormal ? broadcast(0x1p52 + 1077.0) : broadcast(0x1p52 + 1023.0);
  return {from_bits((shifted >> 52) | two_to_52) - offset, from_bits((shifted & mantissa) + sqrt_half)};
}

// ln x = high + low, known to about 2^-60: the powers need more than the 53 bits of one double.
struct Logarithm {
  Register high, low;
};
// x = 2^k (1 + f)
inline Logarithm logarithm(Register x, Register k, Register f) {
  // ln(1 + f) = 2 artanh(s), s = f/(2 + f), the quotient corrected by its remainder
  const Register d = 2.0 + f;
  const Register d_low = (2.0 - d) + f;
  const Register reciprocal = 1.0 / d;
  const Register s = f * reciprocal;
  const Register s_low = (fma(-s, d, f) - s * d_low) * reciprocal;
  const Register z = s * s;
  // (2 artanh(s) - 2 s) / s^3 in z = s^2, Chebyshev interpolation, error 3.2e-16
  constexpr double c[] = {0.666666666666667,   0.39999999999899444, 0.2857142862600327, 0.22222211130259878,
                          0.18182889455674947, 0.15331710618210773, 0.14616585424888623};
  const Register exponent = k * ln2_high;
  const Register high = fma(s, 2.0, exponent);
  const Register low = fma(s, 2.0, exponent - high) + fma(z * s, polynomial(z, c), fma(k, ln2_low, 2.0 * s_low));
  // ln 0 = -infinity, ln infinity = infinity, NaN for what is negative or NaN
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Truth ordinary = (x > 0.0) & (x < infinity);
  const Register invalid = broadcast(std::numeric_limits<double>::quiet_NaN());
  const Register limit = x == 0.0 ? broadcast(-infinity) : (x > 0.0 ? x : invalid);
  return {ordinary ? high : limit, ordinary ? low : Register{}};
}
inline Logarithm logarithm(Register x) {
  const auto [k, m] = normalise(x);
  return logarithm(x, k, m - 1.0);
}
inline Register log(Register x) {
  const Logarithm l = logarithm(x);
  return l.high + l.low;
}
inline Register log1p(Register x) {
  const Register sum = 1.0 + x;
  const auto [k, m] = normalise(sum);
  const Logarithm l = logarithm(sum, k, k == 0.0 ? x : m - 1.0);  // the sum has lost digits of a small x
  return l.high + l.low;
}

// base^y = e^(y ln base), the product kept in two parts.
inline Register pow(Register base, Register y) {
  const Logarithm l = logarithm(base);
  const Register product = y * l.high;
  const Register rest = fma(y, l.low, fma(y, l.high, -product));
  const Truth ordinary = abs(product) < 800.0;  // beyond, the power is 0 or infinity
  const Register x = ordinary ? product + rest : limit_exponent(product);
  const Exponential e = exponential(x, ordinary ? (product - x) + rest : Register{});
  return y == 0.0 ? broadcast(1.0) : scale(1.0 + e.q, e.shifted);
}

inline Register tanh(Register x) {
  const Register e = expm1(2.0 * min(abs(x), broadcast(20.0)));
  return with_sign_of(x, e / (e + 2.0));
}
inline Register sinh(Register x) {
  const Exponential e = exponential(limit_exponent(abs(x)));
  const Truth small = e.shifted == shifter;
  const Register half = scale(1.0 + e.q, e.shifted - 1.0);  // e^|x| / 2, which overflows later than e^|x|
  const Register ratio = (small ? 0.5 * e.q : broadcast(0.25)) / (small ? 1.0 + e.q : half);
  return with_sign_of(x, small ? 0.5 * e.q + ratio : half - ratio);
}
inline Register cosh(Register x) {
  const Exponential e = exponential(limit_exponent(abs(x)));
  const Register half = scale(1.0 + e.q, e.shifted - 1.0);
  return half + 0.25 / half;
}

inline Register erf(Register x) {
  const Register a = min(abs(x), broadcast(6.0));  // 1 - erf(6) = 2e-17
  // below one: erf(x)/x - 1 in x^2, Chebyshev interpolation, error 3.7e-17
  constexpr double near[] = {0.12837916709551256,    -0.37612638903183543,    0.11283791670945006,    -0.02686617064323777,
                             0.0052239776071164225,  -0.0008548325975389692,  0.00012055294904839707, -1.492473690741966e-05,
                             1.6447424703317362e-06, -1.6208483801871705e-07, 1.3720064546777686e-08, -7.795898827002142e-10};
  // above one: (1 - erf(x)) e^(x^2) in t = (x - 3)/(x + 3), Chebyshev interpolation on [1, 6], error 3e-17
  constexpr double far[] = {0.17900115118138996,    -0.32623356004303716,  0.24560380171233195,   -0.15011593650078744,
                            0.07166583719774874,    -0.024392499318273194, 0.004269136347508256,  0.0007077464443901538,
                            -0.0005970623517093284, 4.525472635483354e-05, 6.406182073530546e-05, -1.284889451252353e-05,
                            -8.008021319412685e-06, 2.023603179641757e-06, 1.2801900862962662e-06};
  const Register small = fma(a, polynomial(a * a, near), a);
  const Register large = 1.0 - exp(-(a * a)) * polynomial((a - 3.0) / (a + 3.0), far);
  return with_sign_of(x, a < 1.0 ? small : large);
}

}  // namespace simd

/// One truth value per lane.
struct LanesMask {
  static constexpr int parts = 8 / simd::register_width;
  simd::Truth part[parts] = {};

  LanesMask() = default;
  LanesMask(bool every_lane) {
    for (auto& p : part) p = simd::Truth{} - static_cast<std::int64_t>(every_lane);
  }
  bool operator[](int i) const { return part[i / simd::register_width][i % simd::register_width] != 0; }

  LanesMask& operator&=(const LanesMask& b) {
    for (int i = 0; i < parts; ++i) part[i] &= b.part[i];
    return *this;
  }
  LanesMask& operator|=(const LanesMask& b) {
    for (int i = 0; i < parts; ++i) part[i] |= b.part[i];
    return *this;
  }
  friend LanesMask operator&(LanesMask a, const LanesMask& b) { return a &= b; }
  friend LanesMask operator|(LanesMask a, const LanesMask& b) { return a |= b; }
  friend LanesMask operator!(LanesMask a) {
    for (auto& p : a.part) p = ~p;
    return a;
  }
};

/// Eight doubles side by side. No lane ever looks at another.
struct Lanes {
  static constexpr int width = 8;
  static constexpr int parts = width / simd::register_width;
  simd::Register part[parts] = {};

  Lanes() = default;
  Lanes(double every_lane) {
    for (auto& p : part) p = simd::broadcast(every_lane);
  }

  /// Eight consecutive doubles, at any address that suits a double.
  static Lanes load(const double* from) {
    Lanes a;
    for (int i = 0; i < parts; ++i) std::memcpy(&a.part[i], from + i * simd::register_width, sizeof(simd::Register));
    return a;
  }
  void store(double* to) const {
    for (int i = 0; i < parts; ++i) std::memcpy(to + i * simd::register_width, &part[i], sizeof(simd::Register));
  }

  double operator[](int i) const { return part[i / simd::register_width][i % simd::register_width]; }
  void set(int i, double x) { part[i / simd::register_width][i % simd::register_width] = x; }

  Lanes& operator+=(const Lanes& b) {
    for (int i = 0; i < parts; ++i) part[i] += b.part[i];
    return *this;
  }
  Lanes& operator-=(const Lanes& b) {
    for (int i = 0; i < parts; ++i) part[i] -= b.part[i];
    return *this;
  }
  Lanes& operator*=(const Lanes& b) {
    for (int i = 0; i < parts; ++i) part[i] *= b.part[i];
    return *this;
  }
  Lanes& operator/=(const Lanes& b) {
    for (int i = 0; i < parts; ++i) part[i] /= b.part[i];
    return *this;
  }
  friend Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
  friend Lanes operator-(Lanes a, const Lanes& b) { return a -= b; }
  friend Lanes operator*(Lanes a, const Lanes& b) { return a *= b; }
  friend Lanes operator/(Lanes a, const Lanes& b) { return a /= b; }
  friend Lanes operator-(Lanes a) {
    for (auto& p : a.part) p = -p;
    return a;
  }

  friend LanesMask operator<(const Lanes& a, const Lanes& b) {
    LanesMask m;
    for (int i = 0; i < parts; ++i) m.part[i] = a.part[i] < b.part[i];
    return m;
  }
  friend LanesMask operator<=(const Lanes& a, const Lanes& b) {
    LanesMask m;
    for (int i = 0; i < parts; ++i) m.part[i] = a.part[i] <= b.part[i];
    return m;
  }
  friend LanesMask operator==(const Lanes& a, const Lanes& b) {
    LanesMask m;
    for (int i = 0; i < parts; ++i) m.part[i] = a.part[i] == b.part[i];
    return m;
  }
  friend LanesMask operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend LanesMask operator>=(const Lanes& a, const Lanes& b) { return b <= a; }
  friend LanesMask operator!=(const Lanes& a, const Lanes& b) { return !(a == b); }

  /// f of every part.
  template <class F, class... L>
  static Lanes map(F f, const L&... a) {
    Lanes result;
    for (int i = 0; i < parts; ++i) result.part[i] = f(a.part[i]...);
    return result;
  }
};

template <>
struct mask_type<Lanes> {
  using type = LanesMask;
};

inline Lanes select(const LanesMask& condition, const Lanes& yes, const Lanes& no) {
  Lanes a;
  for (int i = 0; i < Lanes::parts; ++i) a.part[i] = condition.part[i] ? yes.part[i] : no.part[i];
  return a;
}
inline bool any(const LanesMask& m) {
  simd::Truth sum = m.part[0];
  for (int i = 1; i < LanesMask::parts; ++i) sum |= m.part[i];
  return simd::any(sum);
}
inline bool all(const LanesMask& m) {
  return !any(!m);
}
inline bool none(const LanesMask& m) {
  return !any(m);
}

inline Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c) {
  Lanes sum;
  for (int i = 0; i < Lanes::parts; ++i) sum.part[i] = simd::fma(a.part[i], b.part[i], c.part[i]);
  return sum;
}
inline Lanes min(const Lanes& a, const Lanes& b) {
  return Lanes::map(simd::min, a, b);
}
inline Lanes max(const Lanes& a, const Lanes& b) {
  return Lanes::map(simd::max, a, b);
}
inline Lanes abs(const Lanes& a) {
  return Lanes::map(simd::abs, a);
}
inline Lanes sqrt(const Lanes& a) {
  return Lanes::map(simd::sqrt, a);
}
inline Lanes exp(const Lanes& a) {
  return Lanes::map(simd::exp, a);
}
inline Lanes expm1(const Lanes& a) {
  return Lanes::map(simd::expm1, a);
}
inline Lanes log(const Lanes& a) {
  return Lanes::map(simd::log, a);
}
inline Lanes log1p(const Lanes& a) {
  return Lanes::map(simd::log1p, a);
}
/// base^exponent for base >= 0.
inline Lanes pow(const Lanes& base, const Lanes& exponent) {
  return Lanes::map(simd::pow, base, exponent);
}
inline Lanes tanh(const Lanes& a) {
  return Lanes::map(simd::tanh, a);
}
inline Lanes sinh(const Lanes& a) {
  return Lanes::map(simd::sinh, a);
}
inline Lanes cosh(const Lanes& a) {
  return Lanes::map(simd::cosh, a);
}
inline Lanes erf(const Lanes& a) {
  return Lanes::map(simd::erf, a);
}
inline LanesMask is_finite(const Lanes& a) {
  return abs(a) < std::numeric_limits<double>::infinity();
}

// For every Real -----------------------------------------------------------------------------------------------------

/// How many points one Real holds: 1 or Lanes::width.
template <class Real>
constexpr int width_of = std::is_same_v<mask_of<Real>, LanesMask> ? Lanes::width : 1;

/// The value of one lane. A double and a bool are the same in every lane.
inline double lane(double x, int /*i*/) {
  return x;
}
inline double lane(const Lanes& x, int i) {
  return x[i];
}
inline bool lane(bool m, int /*i*/) {
  return m;
}
inline bool lane(const LanesMask& m, int i) {
  return m[i];
}

/// x limited to [lower, upper].
template <class Real>
Real clamp(const Real& x, double lower, double upper) {
  return min(max(x, Real(lower)), Real(upper));
}

}  // namespace brisance
