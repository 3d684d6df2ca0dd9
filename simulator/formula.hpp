#pragma once
// Formulas in case files: numbers that depend on place and time. The parser (muparser) stays inside formula.cpp.

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/vector.hpp"

namespace brisance::simulator {

/// A formula such as "(1 + t/r)^2", in SI units. It may use
///   x, y, z  coordinates (m), as many as the geometry has dimensions; x is the distance from the axis or centre in the round
///            geometries, and y runs along the axis in the axisymmetric one,
///   r        the distance from the origin (m): |x| in one dimension, sqrt(x^2 + y^2) in two, sqrt(x^2 + y^2 + z^2) in three,
///   t        the time (s), where there is one,
///   pi, and the operators and functions of muparser: + - * / ^, < > <= >= == !=, && ||, a ? b : c, sqrt, exp, ln, sin, ...
class Formula {
 public:
  /// Throws std::invalid_argument, which says what is wrong and what is allowed.
  Formula(std::string text, int dimensions, bool with_time);
  ~Formula();
  const std::string& text() const { return text_; }
  /// Threads may call it at the same time, and do not wait for each other. Not finite where the formula has no value.
  double operator()(const Vector& position, double time) const;

 private:
  struct Parsers;
  std::string text_;
  int dimensions_;
  bool with_time_;
  std::unique_ptr<Parsers> parsers_;
};

/// What a formula may speak of: "x, y, r, t and pi".
std::vector<std::string_view> formula_names(int dimensions, bool with_time);

/// The functions that it may call.
std::vector<std::string> formula_functions();

/// A number, or a formula that stands in its place.
struct Varying {
  double number = 0.0;                     // SI
  std::shared_ptr<const Formula> formula;  // null: the number

  Varying() = default;
  Varying(double value) : number(value) {}
  explicit Varying(std::shared_ptr<const Formula> given) : formula(std::move(given)) {}
  double at(const Vector& position, double time) const { return formula ? (*formula)(position, time) : number; }
};

struct VaryingVector {
  std::array<Varying, 3> components;

  VaryingVector() = default;
  VaryingVector(const Vector& v) : components{v[0], v[1], v[2]} {}
  bool varies() const { return components[0].formula || components[1].formula || components[2].formula; }
  /// Of components with a formula 0.
  Vector numbers() const { return {components[0].number, components[1].number, components[2].number}; }
  Vector at(const Vector& position, double time) const {
    return {components[0].at(position, time), components[1].at(position, time), components[2].at(position, time)};
  }
};

}  // namespace brisance::simulator
