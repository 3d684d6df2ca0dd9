#pragma once
// Texts such as "25.4 mm" to numbers in the unit the program works in. The only user of udunits2.

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "models/parameters.hpp"

namespace brisance {

/// A text that is not the quantity asked for: what() says why, `hint` what may have been meant ("; did you mean ...?").
struct UnitError : std::runtime_error {
  explicit UnitError(const std::string& what, std::string hint_text = {})
      : std::runtime_error(what), hint(std::move(hint_text)) {}
  std::string hint;
};

/// The way from one unit of measurement to another of the same quantity.
class UnitConversion {
 public:
  /// `from` must measure the same quantity as `to`: seconds are not accepted for 1/s, nor Pa for 1/Pa. Temperatures with
  /// another zero (degC) are accepted where `to` is a plain temperature; they are read as temperatures, not differences.
  /// Throws UnitError.
  UnitConversion(std::string_view from, Unit to);

  /// A decimal number to the other unit, rounded once: "7.83" g/cm^3 is 7830 kg/m^3. Throws UnitError for anything else.
  double operator()(std::string_view number) const;

 private:
  Unit to_;
  long double factor_ = 1.0L;
  long double offset_ = 0.0L;
  bool power_of_ten_ = true;
  int exponent_ = 0;
};

/// "77 GPa" -> 7.7e10 for Unit::Pa. The text is one decimal number and one unit. Throws UnitError.
double to_si(std::string_view text, Unit expected);
/// Whether a text is written as a number with a unit: a number, then nothing or a word. Others may be formulas.
bool is_number_with_unit(std::string_view text);
/// Whether a text is a unit: "GPa", "kg/m^3".
bool is_unit(std::string_view text);

/// The quantity a unit measures, for messages: "a pressure", or "a quantity in J/(kg K)".
std::string quantity_of(Unit unit);

/// What may be written for it: `a number in Pa or a text such as "1 MPa"`.
std::string allowed_texts(Unit unit);

/// The interval in words: "> 0", "between 0 and 1".
std::string describe(const Interval& interval);

}  // namespace brisance
