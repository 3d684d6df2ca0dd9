#pragma once
// The parameter table of a law: one description with many readers (strict input, `describe`, provenance, tests).

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "models/real.hpp"

namespace brisance {

/// A unit of measurement, by the text udunits understands. Values in the program are always in this unit.
struct Unit {
  std::string_view text;
  static const Unit one, Pa, K, kg_per_m3, m, s, per_s, per_K, per_Pa, K_per_Pa, m_per_s, J_per_kg, J_per_kg_K, m3_per_kg, Pa_s,
      Pa_per_K, J, kg, Pa_sqrt_m, W_per_m_K, J_per_m3, J_per_mol, m2, kg_per_m2_s, kg_per_mol, J_per_mol_K;
};
inline constexpr Unit Unit::one{"1"}, Unit::Pa{"Pa"}, Unit::K{"K"}, Unit::kg_per_m3{"kg/m^3"}, Unit::m{"m"}, Unit::s{"s"},
    Unit::per_s{"1/s"}, Unit::per_K{"1/K"}, Unit::per_Pa{"1/Pa"}, Unit::K_per_Pa{"K/Pa"}, Unit::m_per_s{"m/s"},
    Unit::J_per_kg{"J/kg"}, Unit::J_per_kg_K{"J/(kg K)"}, Unit::m3_per_kg{"m^3/kg"}, Unit::Pa_s{"Pa s"}, Unit::Pa_per_K{"Pa/K"},
    Unit::J{"J"}, Unit::kg{"kg"}, Unit::Pa_sqrt_m{"Pa m^0.5"}, Unit::W_per_m_K{"W/(m K)"}, Unit::J_per_m3{"J/m^3"},
    Unit::J_per_mol{"J/mol"}, Unit::m2{"m^2"}, Unit::kg_per_m2_s{"kg/(m^2 s)"}, Unit::kg_per_mol{"kg/mol"},
    Unit::J_per_mol_K{"J/(mol K)"};

/// The values a parameter may take: between lower and upper, ends included unless open.
struct Interval {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  /// Finite and inside; NaN and infinities never are.
  constexpr bool contains(double x) const {
    const bool above = lower_open ? x > lower : x >= lower;
    const bool below = upper_open ? x < upper : x <= upper;
    const double largest = std::numeric_limits<double>::max();
    return above && below && x <= largest && x >= -largest;
  }
};
inline constexpr Interval any_value{};
inline constexpr Interval positive{.lower = 0.0, .lower_open = true};
inline constexpr Interval non_negative{.lower = 0.0};
inline constexpr Interval negative{.upper = 0.0, .upper_open = true};
inline constexpr Interval fraction{.lower = 0.0, .upper = 1.0};
constexpr Interval between(double lower, double upper) {
  return {.lower = lower, .upper = upper};
}
constexpr Interval at_least(double lower) {
  return {.lower = lower};
}

/// A quantity given by a table: piecewise linear between its knots, constant outside. x increases strictly.
struct Table {
  static constexpr int capacity = 16;
  int size = 0;
  std::array<double, capacity> x{}, y{};

  template <class Real>
  Real operator()(const Real& at) const {
    Real result(y[0]);
    for (int i = 1; i < size; ++i) {
      const double slope = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
      result = select(at > x[i - 1], Real(y[i - 1] + slope * (min(at, Real(x[i])) - x[i - 1])), result);
    }
    return result;
  }
};

/// One row of a law's table. T is double, bool, std::array<double, N>, Table, or an enum with `choices`.
/// A parameter without a default must be given in the input.
template <class Law, class T>
struct Parameter {
  std::string_view name;
  T Law::*member;
  Unit unit;
  std::string_view meaning;
  Interval interval = any_value;
  std::optional<T> default_value = std::nullopt;
};
template <class Law, class T>
Parameter(std::string_view, T Law::*, Unit, std::string_view) -> Parameter<Law, T>;
template <class Law, class T>
Parameter(std::string_view, T Law::*, Unit, std::string_view, Interval) -> Parameter<Law, T>;
template <class Law, class T, class D>
Parameter(std::string_view, T Law::*, Unit, std::string_view, Interval, D) -> Parameter<Law, T>;

/// Names of the values of an enum parameter, in the order of the enumerators (which count from 0).
/// Specialise as: template <> inline constexpr std::array choices<MyEnum> = {std::string_view{"first"}, ...};
template <class Enum>
inline constexpr std::array<std::string_view, 0> choices{};

/// Calls f(parameter) for each row of the law's table.
template <class Law, class F>
constexpr void for_each_parameter(F&& f) {
  std::apply([&](const auto&... row) { (f(row), ...); }, Law::parameters);
}

/// A history column that a law adds to the state of its material's points.
struct HistoryColumn {
  std::string_view name;
  Unit unit;
  std::string_view meaning;
};

}  // namespace brisance
