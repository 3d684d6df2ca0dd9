// Which arithmetic should carry eight points side by side? Compares, in nanoseconds per double and in the bits of the
// results: the mathematics library, Eigen arrays, xsimd, and the Lanes of models/real.hpp. Not a test; how to build and
// what came out is in docs/decisions/lanes.md.

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "models/dual.hpp"
#include "models/equation_of_state/mie_gruneisen_temperature.hpp"
#include "models/flow_stress/johnson_cook.hpp"
#include "models/tensor.hpp"

namespace brisance {

// Gives a library's vector type the interface the laws expect.
template <class Library>
struct Wrapped {
  static constexpr int width = Library::width;
  typename Library::Values values;

  Wrapped() : Wrapped(0.0) {}
  Wrapped(double every_lane) : values(Library::broadcast(every_lane)) {}
  struct FromValues {};
  Wrapped(FromValues, const typename Library::Values& v) : values(v) {}

  static Wrapped load(const double* from) { return {FromValues{}, Library::load(from)}; }
  void store(double* to) const { Library::store(values, to); }

  friend Wrapped operator+(const Wrapped& a, const Wrapped& b) { return {FromValues{}, a.values + b.values}; }
  friend Wrapped operator-(const Wrapped& a, const Wrapped& b) { return {FromValues{}, a.values - b.values}; }
  friend Wrapped operator*(const Wrapped& a, const Wrapped& b) { return {FromValues{}, a.values * b.values}; }
  friend Wrapped operator/(const Wrapped& a, const Wrapped& b) { return {FromValues{}, a.values / b.values}; }
  friend Wrapped operator-(const Wrapped& a) { return {FromValues{}, -a.values}; }
  friend typename Library::Mask operator<(const Wrapped& a, const Wrapped& b) { return a.values < b.values; }
  friend typename Library::Mask operator<=(const Wrapped& a, const Wrapped& b) { return a.values <= b.values; }
  friend typename Library::Mask operator>(const Wrapped& a, const Wrapped& b) { return a.values > b.values; }
  friend typename Library::Mask operator>=(const Wrapped& a, const Wrapped& b) { return a.values >= b.values; }
  friend Wrapped select(const typename Library::Mask& m, const Wrapped& a, const Wrapped& b) {
    return {FromValues{}, Library::select(m, a.values, b.values)};
  }
  friend Wrapped min(const Wrapped& a, const Wrapped& b) { return {FromValues{}, Library::min(a.values, b.values)}; }
  friend Wrapped max(const Wrapped& a, const Wrapped& b) { return {FromValues{}, Library::max(a.values, b.values)}; }
  friend Wrapped sqrt(const Wrapped& a) { return {FromValues{}, Library::sqrt(a.values)}; }
  friend Wrapped exp(const Wrapped& a) { return {FromValues{}, Library::exp(a.values)}; }
  friend Wrapped log(const Wrapped& a) { return {FromValues{}, Library::log(a.values)}; }
  friend Wrapped pow(const Wrapped& a, double n) { return {FromValues{}, Library::pow(a.values, n)}; }
};
template <class Library>
struct mask_type<Wrapped<Library>> {
  using type = typename Library::Mask;
};

struct EigenArray {
  static constexpr int width = 8;
  using Values = Eigen::Array<double, 8, 1>;
  using Mask = Eigen::Array<bool, 8, 1>;
  static Values broadcast(double x) { return Values::Constant(x); }
  static Values load(const double* from) { return Eigen::Map<const Values>(from); }
  static void store(const Values& v, double* to) { Eigen::Map<Values>{to} = v; }
  static Values select(const Mask& m, const Values& a, const Values& b) { return m.select(a, b); }
  static Values min(const Values& a, const Values& b) { return a.min(b); }
  static Values max(const Values& a, const Values& b) { return a.max(b); }
  static Values sqrt(const Values& a) { return a.sqrt(); }
  static Values exp(const Values& a) { return a.exp(); }
  static Values log(const Values& a) { return a.log(); }
  static Values pow(const Values& a, double n) { return (n * a.log()).exp(); }
};

template <class Architecture>
struct Xsimd {
  using Values = xsimd::batch<double, Architecture>;
  using Mask = xsimd::batch_bool<double, Architecture>;
  static constexpr int width = static_cast<int>(Values::size);
  static Values broadcast(double x) { return Values(x); }
  static Values load(const double* from) { return Values::load_unaligned(from); }
  static void store(const Values& v, double* to) { v.store_unaligned(to); }
  static Values select(const Mask& m, const Values& a, const Values& b) { return xsimd::select(m, a, b); }
  static Values min(const Values& a, const Values& b) { return xsimd::min(a, b); }
  static Values max(const Values& a, const Values& b) { return xsimd::max(a, b); }
  static Values sqrt(const Values& a) { return xsimd::sqrt(a); }
  static Values exp(const Values& a) { return xsimd::exp(a); }
  static Values log(const Values& a) { return xsimd::log(a); }
  static Values pow(const Values& a, double n) { return xsimd::exp(n * xsimd::log(a)); }
};

template <class Real>
constexpr int points_in() {
  if constexpr (std::is_same_v<Real, double>)
    return 1;
  else
    return Real::width;
}
template <class Real>
Real load(const double* from) {
  if constexpr (std::is_same_v<Real, double>)
    return *from;
  else
    return Real::load(from);
}
template <class Real>
void store(const Real& x, double* to) {
  if constexpr (std::is_same_v<Real, double>)
    *to = x;
  else
    x.store(to);
}

// Columns of a batch: density, energy, temperature, plastic strain, six components of the deviatoric trial stress.
constexpr int points = 512, columns = 10;
using Columns = std::vector<double>;

// Johnson-Cook, Mie-Grueneisen and von Mises: radial return by four Newton steps with the derivative from a dual number.
template <class Real>
void return_to_yield(const Columns& in, Columns& out) {
  constexpr flow_stress::JohnsonCook copper{90e6, 292e6, 0.31, 0.025, 1.09, 1.0, 298.0};
  constexpr equation_of_state::MieGruneisenTemperature gruneisen{8930.0, 3940.0, 1.489, 1.96, 385.0, 298.0};
  constexpr double shear_modulus = 47.7e9, melting_temperature = 1356.0, dt = 1e-8;
  constexpr int width = points_in<Real>();
  for (int p = 0; p < points; p += width) {
    const auto column = [&](int c) { return load<Real>(&in[c * points + p]); };
    const Real density = column(0), energy = column(1), temperature = column(2), strain = column(3);
    const SymmetricTensor<Real> trial{column(4), column(5), column(6), column(7), column(8), column(9)};
    const Real q = equivalent_stress(trial);
    const Real limit = q * (1.0 / (3.0 * shear_modulus));
    Real increment = 0.5 * limit;
    for (int i = 0; i < 4; ++i) {
      using D = Dual<Real, 1>;
      const D d = D::variable(increment);
      const D yield = copper(flow_stress::Arguments<D>{.plastic_strain = strain + d,
                                                       .plastic_strain_rate = d * (1.0 / dt),
                                                       .temperature = D(temperature),
                                                       .melting_temperature = D(melting_temperature)});
      const D residual = q - 3.0 * shear_modulus * d - yield;
      increment = clamp(increment - residual.value / residual.derivative[0], 0.0, 1.0);
      increment = min(increment, limit);
    }
    const Real ratio = 1.0 - increment / max(limit, Real(1e-30));
    const Real pressure = gruneisen.pressure(density, energy);
    const auto stress = add_to_diagonal(ratio * trial, Real(-pressure));
    int c = 0;
    for_each_component([&](const Real& s) { store(s, &out[c++ * points + p]); }, stress);
    store(Real(strain + increment), &out[6 * points + p]);
    store(Real(temperature + 0.9 * q * ratio * increment / (density * 385.0)), &out[7 * points + p]);
  }
}

template <class Real, class F>
void apply(F f, const double* in, double* out, int count) {
  for (int i = 0; i < count; i += points_in<Real>()) store(f(load<Real>(in + i)), out + i);
}

// Nanoseconds per double or point.
template <class F>
double time_of(F run, int count) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int repeat = 0; repeat < 4; ++repeat) {
    const auto start = Clock::now();
    for (int i = 0; i < 10; ++i) {
      run();
      asm volatile("" ::: "memory");
    }
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count() / (10.0 * count));
  }
  return best;
}

std::uint64_t hash(const std::vector<double>& values) {
  std::uint64_t h = 14695981039346656037u;
  for (double x : values) h = (h ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211u;
  return h;
}

struct Row {
  const char* name;
  void (*measure)(Row&);
  double best[4] = {1e300, 1e300, 1e300, 1e300};
  std::uint64_t bits[4] = {};
};

template <class Real>
void measure(Row& row) {
  std::mt19937_64 generator(20240229);
  const auto uniform = [&](double a, double b) { return a + (b - a) * 0x1p-53 * static_cast<double>(generator() >> 11); };
  constexpr int count = 1024;
  std::vector<double> exponents(count), positives(count), result(count);
  for (double& x : exponents) x = uniform(-20.0, 20.0);
  for (double& x : positives) x = 1e-6 + uniform(0.0, 2.0);

  Columns in(columns * points), out(8 * points);
  for (int p = 0; p < points; ++p) {
    in[p] = 8930.0 * uniform(0.95, 1.2), in[points + p] = uniform(0.0, 2e5), in[2 * points + p] = uniform(300.0, 1200.0);
    in[3 * points + p] = uniform(1e-4, 1.0);
    for (int c = 4; c < columns; ++c) in[c * points + p] = uniform(-8e8, 8e8);
  }

  const auto report = [&](int kernel, double ns, const std::vector<double>& values) {
    row.best[kernel] = std::min(row.best[kernel], ns);
    row.bits[kernel] = hash(values);
  };
  double ns =
      time_of([&] { apply<Real>([](const Real& x) { return exp(x); }, exponents.data(), result.data(), count); }, count);
  report(0, ns, result);
  ns = time_of([&] { apply<Real>([](const Real& x) { return log(x); }, positives.data(), result.data(), count); }, count);
  report(1, ns, result);
  ns = time_of([&] { apply<Real>([](const Real& x) { return pow(x, 0.31); }, positives.data(), result.data(), count); }, count);
  report(2, ns, result);
  ns = time_of([&] { return_to_yield<Real>(in, out); }, points);
  report(3, ns, out);
}

}  // namespace brisance

int main() {
  using namespace brisance;
  std::vector<Row> rows {
    {"mathematics library", measure<double>}, {"Eigen", measure<Wrapped<EigenArray>>},
#if defined(__AVX512F__)
        {"xsimd avx512bw", measure<Wrapped<Xsimd<xsimd::avx512bw>>>},
#endif
#if defined(__AVX2__)
        {"xsimd fma3<avx2>", measure<Wrapped<Xsimd<xsimd::fma3<xsimd::avx2>>>>},
        {"xsimd avx2", measure<Wrapped<Xsimd<xsimd::avx2>>>},
#endif
        {"xsimd sse2", measure<Wrapped<Xsimd<xsimd::sse2>>>}, {"Lanes", measure<Lanes>},
  };
  // The machine may be busy: candidates take turns and the fastest of many turns counts.
  for (int turn = 0; turn < 60; ++turn)
    for (Row& row : rows) row.measure(row);
  std::printf("ns per double, hash    |       exp       |       log       |       pow       | return to yield\n");
  for (const Row& row : rows) {
    std::printf("%-22s", row.name);
    for (int k = 0; k < 4; ++k) std::printf(" | %6.2f %08x", row.best[k], static_cast<unsigned>(row.bits[k] >> 32));
    std::printf("\n");
  }
}
