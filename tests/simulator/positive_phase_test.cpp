// Pulses of pressure with closed forms, given sample by sample as a run gives its steps.

#include "simulator/output/positive_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace brisance::simulator {
namespace {

/// Samples from 0 on, every `step` s, of steps that are not all alike.
PositivePhase sampled(const std::function<double(double)>& pulse, double end, double step) {
  PositivePhase phase;
  for (int n = 0; n * step <= end; ++n) {
    const double time = step * (n + 0.25 * std::sin(n));
    phase.add(time, pulse(time));
  }
  return phase;
}

/// From 1 s on: up to 6 Pa in 1 s, down through 0 at 5 s to -3 Pa.
double triangle(double t) {
  return t < 1.0 ? 0.0 : t < 2.0 ? 6.0 * (t - 1.0) : std::fmax(-3.0, 6.0 - 2.0 * (t - 2.0));
}

TEST(PositivePhaseOfATriangle, IsThatOfTheTriangle) {
  PositivePhase phase;
  for (const double t : {0.0, 0.5, 1.0, 1.25, 2.0, 3.5, 4.5, 7.0}) phase.add(t, triangle(t));
  const PositivePhase::Result result = phase.result();
  EXPECT_DOUBLE_EQ(result.peak, 6.0);
  EXPECT_DOUBLE_EQ(result.arrival, 1.5);
  EXPECT_TRUE(result.ended);
  // Between 4.5 s, 1 Pa, and 7 s, -3 Pa, a line: it ends where that is 0.
  EXPECT_DOUBLE_EQ(result.end, 4.5 + 2.5 / 4.0);
  EXPECT_DOUBLE_EQ(result.impulse, 3.0 + 0.5 * (6.0 + 3.0) * 1.5 + 0.5 * (3.0 + 1.0) + 0.5 * 0.625);
}

TEST(PositivePhaseOfABlast, ComesToItsIntegralWithSecondOrder) {
  constexpr double peak = 1e5, start = 0.2, duration = 1.0, b = 2.0;  // Friedlander's wave
  const auto blast = [](double t) {
    const double s = (t - start) / duration;
    return s < 0.0 ? 0.0 : peak * (1.0 - s) * std::exp(-b * s);
  };
  const double exact = peak * duration * (1.0 / b - (1.0 - std::exp(-b)) / (b * b));
  // A jump is spread over a step: of that part the impulse is known to half a step of the peak.
  for (const double step : {1e-2, 1e-3}) {
    const PositivePhase::Result result = sampled(blast, 3.0, step).result();
    EXPECT_TRUE(result.ended);
    EXPECT_NEAR(result.impulse, exact, 0.75 * step * peak);
    EXPECT_NEAR(result.peak, peak, 1.5 * step / duration * (1.0 + b) * peak);
    EXPECT_NEAR(result.arrival, start, 1.5 * step);
    EXPECT_NEAR(result.end, start + duration, step * step);
  }
  // Without a jump the error falls with the square of the step.
  const auto smooth = [](double t) { return std::sin(t) * std::exp(-t); };
  const double whole = 0.5 * (1.0 + std::exp(-std::acos(-1.0)));
  const double coarse = sampled(smooth, 4.0, 0.02).result().impulse - whole,
               fine = sampled(smooth, 4.0, 0.01).result().impulse - whole;
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << coarse << ' ' << fine;
}

TEST(PositivePhase, IsTheHighestOfSeveralAndPerhapsNotAtItsEnd) {
  PositivePhase phase;
  EXPECT_EQ(phase.result().peak, 0.0);
  for (const auto& [t, p] : {std::pair{0.0, -1.0}, {1.0, 1.0}, {2.0, -1.0}, {3.0, 5.0}, {4.0, -5.0}, {5.0, 2.0}})
    phase.add(t, p);
  PositivePhase::Result result = phase.result();
  EXPECT_EQ(result.peak, 5.0);
  EXPECT_TRUE(result.ended);
  EXPECT_DOUBLE_EQ(result.end, 3.5);
  phase.add(6.0, 8.0);  // the third is higher now, and goes on
  result = phase.result();
  EXPECT_EQ(result.peak, 8.0);
  EXPECT_FALSE(result.ended);
  EXPECT_DOUBLE_EQ(result.arrival, 5.0 + 2.0 / 6.0);
}

TEST(PositivePhase, GoesOnFromItsNumbersWithTheSameBits) {
  PositivePhase whole, part;
  const auto pulse = [](double t) { return std::sin(3.0 * t) + 0.3 * std::sin(17.0 * t) - 0.2; };
  std::vector<double> numbers;
  for (int n = 0; n < 300; ++n) {
    const double t = 0.02 * n;
    whole.add(t, pulse(t)), part.add(t, pulse(t));
    if (n % 37 != 0) continue;
    numbers = {7.0};
    part.append_to(numbers);
    std::span<const double> rest(numbers);
    rest = rest.subspan(1);
    part = {};
    part.take_from(rest);
    EXPECT_TRUE(rest.empty());
  }
  std::vector<double> a, b;
  whole.append_to(a), part.append_to(b);
  EXPECT_EQ(a, b);
  std::span<const double> cut = std::span<const double>(a).first(a.size() - 1);
  EXPECT_THROW(part.take_from(cut), std::runtime_error);
}

}  // namespace
}  // namespace brisance::simulator
