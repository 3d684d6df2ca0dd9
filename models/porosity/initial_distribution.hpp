#pragma once
// How the porosity or the damage of the new material varies from point to point. A law is the inverse of a cumulative
// distribution: it turns one number uniform in (0, 1) into a value. Truncated distributions are the full ones on the condition
// of lying inside the bounds; nothing is folded or piled up at an end.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <variant>

#include "models/parameters.hpp"

namespace brisance::porosity::initial {

struct Constant {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view equation = "f = f0";
  static constexpr std::string_view source = "the same everywhere";

  double value;

  static constexpr auto parameters =
      std::tuple{Parameter{"value", &Constant::value, Unit::one, "f0, porosity or damage", Interval{0.0, 1.0, false, true}}};

  double operator()(double /*uniform*/) const { return value; }
};

struct Gaussian {
  static constexpr std::string_view name = "gaussian";
  static constexpr std::string_view equation =
      "density of f ~ exp(-((f - mean)/standard_deviation)^2/2) on [0, upper], 0 elsewhere";
  static constexpr std::string_view source = "normal distribution truncated to [0, upper]; mean and deviation are those before";

  double mean, standard_deviation, upper;

  static constexpr auto parameters =
      std::tuple{Parameter{"mean", &Gaussian::mean, Unit::one, "mean of the normal distribution before truncation", fraction},
                 Parameter{"standard_deviation", &Gaussian::standard_deviation, Unit::one, "its standard deviation", positive},
                 Parameter{"upper", &Gaussian::upper, Unit::one, "largest value; half of that at failure is a usual choice",
                           Interval{0.0, 1.0, true, true}}};

  /// The f for which the probability of [0, f] is `uniform` times that of [0, upper].
  double operator()(double uniform) const {
    const double wanted = uniform * probability(0.0, upper);
    if (!(wanted > 0.0)) return std::clamp(mean, 0.0, upper);  // all of the distribution lies too far outside the bounds
    // The cumulative distribution is convex below the mean and concave above, so Newton's method from the mean, or from the
    // bound next to it, comes nearer from one side only; the bracket is there for round-off.
    double low = 0.0, high = upper, f = std::clamp(mean, 0.0, upper);
    for (int i = 0; i < 200; ++i) {
      const double excess = probability(0.0, f) - wanted;
      (excess > 0.0 ? high : low) = f;
      const double newton = f - excess / density(f);
      const double next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
      if (std::abs(next - f) <= 1e-15 * upper) return next;
      f = next;
    }
    return f;
  }

 private:
  static constexpr double sqrt_half = 0.70710678118654752440;

  double density(double f) const {
    constexpr double one_over_sqrt_two_pi = 0.39894228040143267794;
    const double z = (f - mean) / standard_deviation;
    return one_over_sqrt_two_pi / standard_deviation * std::exp(-0.5 * z * z);
  }

  /// Of [from, to], by the tail that does not cancel.
  double probability(double from, double to) const {
    const double a = (from - mean) * (sqrt_half / standard_deviation), b = (to - mean) * (sqrt_half / standard_deviation);
    if (a > 0.0) return 0.5 * (std::erfc(a) - std::erfc(b));
    if (b < 0.0) return 0.5 * (std::erfc(-b) - std::erfc(-a));
    return 0.5 * (std::erf(b) - std::erf(a));
  }
};

struct Weibull {
  static constexpr std::string_view name = "weibull";
  static constexpr std::string_view equation =
      "probability of less than f = (1 - exp(-(f/scale)^shape))/(1 - exp(-(upper/scale)^shape))";
  static constexpr std::string_view source = "Weibull, J. Appl. Mech. 18 (1951) 293-297, truncated to [0, upper]";

  double scale, shape, upper;

  static constexpr auto parameters = std::tuple{
      Parameter{"scale", &Weibull::scale, Unit::one, "value that 63 % of the points lie below", positive},
      Parameter{"shape", &Weibull::shape, Unit::one, "exponent: the larger, the narrower the distribution", positive},
      Parameter{"upper", &Weibull::upper, Unit::one, "largest value", Interval{0.0, 1.0, true, true}}};

  double operator()(double uniform) const {
    const double inside = -std::expm1(-std::pow(upper / scale, shape));
    return std::min(scale * std::pow(-std::log1p(-uniform * inside), 1.0 / shape), upper);
  }
};

}  // namespace brisance::porosity::initial

namespace brisance {

using InitialPorosity = std::variant<porosity::initial::Constant, porosity::initial::Gaussian, porosity::initial::Weibull>;
using InitialDamage = InitialPorosity;

}  // namespace brisance
