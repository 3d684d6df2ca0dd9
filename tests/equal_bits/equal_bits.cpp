// Prints a fingerprint of every function of Lanes on a million arguments. Built once per instruction set; the outputs
// must be the same (compare.cmake). The arguments come from integer arithmetic alone.

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "models/dual.hpp"
#include "models/flow_stress/johnson_cook.hpp"

using namespace brisance;

namespace {

constexpr int packs = 125'000;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array special{0.0,    -0.0,    1.0,    -1.0,    infinity, -infinity, nan,    5e-324, -5e-324, 2.3e-308,
                             1e-300, 1e300,   -1e300, 709.78,  709.79,   710.47,    710.48, -708.4, -745.1,  -745.2,
                             0.5,    1.41421, 6.0,    0.34657, -0.34658, 20.0,      1e-17,  -1e-17, 2.0,     1e-8};

std::uint64_t mixed(std::uint64_t counter) {  // the finaliser of SplitMix64
  std::uint64_t z = counter * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

// Uniform in [lower, upper].
struct Uniform {
  double lower, upper;
  double operator()(std::uint64_t counter) const {
    return lower + (upper - lower) * (0x1p-53 * static_cast<double>(mixed(counter) >> 11));
  }
};
// Nearly uniform in the logarithm: positive doubles are ordered as their bits are.
struct Logarithmic {
  double lower, upper;
  double operator()(std::uint64_t counter) const {
    const auto low = std::bit_cast<std::uint64_t>(lower), high = std::bit_cast<std::uint64_t>(upper);
    return std::bit_cast<double>(low + mixed(counter) % (high - low));
  }
};

class Fingerprint {
 public:
  void add(const Lanes& x) {
    for (int i = 0; i < Lanes::width; ++i) {
      // the sign and the payload of a NaN mean nothing
      const auto bits = x[i] == x[i] ? std::bit_cast<std::uint64_t>(x[i]) : 0x7ff8000000000000;
      sum_ = std::rotl(sum_ ^ bits, 23) * 0x9e3779b97f4a7c15;
    }
  }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 1;
};

template <class Range, class F>
void print(const char* name, Range range, F f) {
  Fingerprint fingerprint;
  std::uint64_t counter = 0;
  for (int p = 0; p < packs; ++p) {
    Lanes x, y;
    for (int i = 0; i < Lanes::width; ++i) x.set(i, range(++counter)), y.set(i, range(++counter));
    fingerprint.add(f(x, y));
  }
  for (double a : special)
    for (double b : special) fingerprint.add(f(Lanes(a), Lanes(b)));
  std::printf("%-32s %016llx\n", name, static_cast<unsigned long long>(fingerprint.value()));
}

}  // namespace

int main() {
#if defined(__AVX512F__)
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl") || !__builtin_cpu_supports("avx512dq")) {
#elif defined(__AVX2__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
#else
  if (false) {
#endif
    std::printf("this processor lacks the instruction set\n");
    return 0;
  }

  const Uniform plain{-1e3, 1e3}, unit{-1.0, 1.0};
  const Logarithmic wide{1e-300, 1e300}, strain{1e-15, 1e3};
  print("a + b", plain, [](Lanes a, Lanes b) { return a + b; });
  print("a - b", plain, [](Lanes a, Lanes b) { return a - b; });
  print("a * b", plain, [](Lanes a, Lanes b) { return a * b; });
  print("a / b", plain, [](Lanes a, Lanes b) { return a / b; });
  print("a * b + c", plain, [](Lanes a, Lanes b) { return a * b + 0.1; });
  print("min", plain, [](Lanes a, Lanes b) { return min(a, b); });
  print("max", plain, [](Lanes a, Lanes b) { return max(a, b); });
  print("abs", plain, [](Lanes a, Lanes) { return abs(a); });
  print("select", plain, [](Lanes a, Lanes b) { return select((a < b) | !(a * b >= 1.0), a, b); });
  print("is_finite", plain, [](Lanes a, Lanes b) { return select(is_finite(a / b), a, b); });
  print("sqrt", wide, [](Lanes a, Lanes) { return sqrt(a); });
  print("exp", Uniform{-750.0, 715.0}, [](Lanes a, Lanes) { return exp(a); });
  print("exp near 0", unit, [](Lanes a, Lanes) { return exp(a); });
  print("expm1", Uniform{-50.0, 50.0}, [](Lanes a, Lanes) { return expm1(a); });
  print("expm1 near 0", unit, [](Lanes a, Lanes) { return expm1(a); });
  print("log", wide, [](Lanes a, Lanes) { return log(a); });
  print("log near 1", Uniform{0.5, 2.0}, [](Lanes a, Lanes) { return log(a); });
  print("log of subnormals", Logarithmic{5e-324, 1e-300}, [](Lanes a, Lanes) { return log(a); });
  print("log1p", wide, [](Lanes a, Lanes) { return log1p(a); });
  print("log1p near 0", unit, [](Lanes a, Lanes) { return log1p(a); });
  for (double n : {0.0, 0.01, 0.26, 0.5, 1.0, 1.09, 2.0, 7.0, -0.5, 100.0}) {
    char name[32];
    std::snprintf(name, sizeof name, "pow %g", n);
    print(name, strain, [n](Lanes a, Lanes) { return pow(a, n); });
  }
  print("pow", Uniform{0.0, 20.0}, [](Lanes a, Lanes b) { return pow(a, b - 10.0); });
  print("tanh", Uniform{-25.0, 25.0}, [](Lanes a, Lanes) { return tanh(a); });
  print("tanh near 0", unit, [](Lanes a, Lanes) { return tanh(a); });
  print("sinh", Uniform{-715.0, 715.0}, [](Lanes a, Lanes) { return sinh(a); });
  print("sinh near 0", unit, [](Lanes a, Lanes) { return sinh(a); });
  print("cosh", Uniform{-715.0, 715.0}, [](Lanes a, Lanes) { return cosh(a); });
  print("cosh near 0", unit, [](Lanes a, Lanes) { return cosh(a); });
  print("erf", Uniform{-7.0, 7.0}, [](Lanes a, Lanes) { return erf(a); });
  print("erf near 0", unit, [](Lanes a, Lanes) { return erf(a); });

  using D = Dual<Lanes, 2>;
  constexpr flow_stress::JohnsonCook copper{90e6, 292e6, 0.31, 0.025, 1.09, 1.0, 298.0};
  const auto yield = [&](Lanes a, Lanes b) {
    return copper(flow_stress::Arguments<D>{.plastic_strain = D::variable(a, 0),
                                            .plastic_strain_rate = D(1e4 * b),
                                            .temperature = D::variable(300.0 + 100.0 * b, 1),
                                            .melting_temperature = D(1356.0)});
  };
  print("Johnson-Cook", strain, [&](Lanes a, Lanes b) { return yield(a, b).value; });
  print("Johnson-Cook, d/d strain", strain, [&](Lanes a, Lanes b) { return yield(a, b).derivative[0]; });
  print("Johnson-Cook, d/d temperature", strain, [&](Lanes a, Lanes b) { return yield(a, b).derivative[1]; });
}
