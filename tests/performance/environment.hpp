#pragma once
// How fast the machine is: times mean little without it.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "models/real.hpp"

namespace brisance {

using Clock = std::chrono::steady_clock;

/// Seconds of the fastest of `repeats` calls, each after a preparation that does not count: what the machine can do when
/// nothing disturbs it.
template <class Prepare, class F>
double fastest(int repeats, Prepare&& prepare, F&& f) {
  double best = 1e300;
  for (int i = 0; i < repeats; ++i) {
    prepare();
    const auto start = Clock::now();
    f();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}
template <class F>
double fastest(int repeats, F&& f) {
  return fastest(
      repeats, [] {}, f);
}

/// Gflop/s of one core.
inline double fused_multiply_add_rate() {
  constexpr int chains = 12, length = 2'000'000;
  Lanes sums[chains];
  for (int i = 0; i < chains; ++i) sums[i] = Lanes(1.0 + i);
  simd::Register factor = simd::Register{} + 0.999999, term = simd::Register{} + 1e-6;
  const double seconds = fastest(5, [&] {
    for (int k = 0; k < length; ++k)
      for (auto& s : sums)
        for (auto& part : s.part) part = simd::fma(part, factor, term);
  });
  volatile double keep = 0.0;
  for (auto& s : sums) keep = keep + s[0];
  return 2.0 * chains * Lanes::width * length / seconds * 1e-9;
}

/// GB/s of one core.
inline double triad_bandwidth() {
  constexpr std::size_t n = 8'000'000;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  const double seconds = fastest(5, [&] {
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
  });
  volatile double keep = a[n / 2];
  (void)keep;
  return 3.0 * 8.0 * n / seconds * 1e-9;
}

inline std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

struct Environment {
  double flops, bandwidth;  // of one core: Gflop/s of fused multiply-add, GB/s of a triad
};
/// Measures the machine and prints what it is.
inline Environment print_environment() {
  const Environment e{fused_multiply_add_rate(), triad_bandwidth()};
  std::printf("%s, %d-bit vectors, GCC %s\n", processor().c_str(), 64 * simd::register_width, __VERSION__);
  std::printf("one core: %.0f Gflop/s fused multiply-add, %.1f GB/s triad\n\n", e.flops, e.bandwidth);
  return e;
}

}  // namespace brisance
