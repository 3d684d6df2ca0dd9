#include "models/input/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "models/input/diagnostics.hpp"

namespace brisance {
namespace {

constexpr std::size_t longest_unit = 100;
constexpr std::size_t longest_number = 400;

// --- Single unit names: the part that udunits does ------------------------------------------------------------------

/// A unit of measurement: factor times base units to powers, and its zero above that of the base unit.
struct Measure {
  static constexpr std::array<std::string_view, 7> base_names = {"m", "kg", "s", "A", "K", "mol", "cd"};
  std::array<double, base_names.size()> powers{};
  long double factor = 1.0L;
  long double offset = 0.0L;

  bool same_quantity(const Measure& other) const { return powers == other.powers; }
};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitHandle = std::unique_ptr<ut_unit, FreeUnit>;

const ut_system* unit_system() {
  static const ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return static_cast<const ut_system*>(ut_read_xml(nullptr));
  }();
  if (system == nullptr)
    throw UnitError("the table of units of udunits2 is missing; install its data files (libudunits2-data)");
  return system;
}

/// Finds the base units below a unit: udunits visits the alternatives, this keeps the product at the bottom.
struct BaseFinder {
  Measure measure;
  UnitHandle base;

  static ut_status basic(const ut_unit* unit, void* self) {
    const double one = 1.0;
    return static_cast<BaseFinder*>(self)->keep(unit, &unit, &one, 1);
  }
  static ut_status product(const ut_unit* unit, int count, const ut_unit* const* units, const int* powers, void* self) {
    const std::vector<double> as_doubles(powers, powers + count);
    return static_cast<BaseFinder*>(self)->keep(unit, units, as_doubles.data(), count);
  }
  static ut_status galilean(const ut_unit*, double, const ut_unit* underlying, double, void* self) {
    return ut_accept_visitor(underlying, &visitor, self);
  }
  static ut_status timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_MEANINGLESS; }
  static ut_status logarithmic(const ut_unit*, double, const ut_unit*, void*) { return UT_MEANINGLESS; }
  static const ut_visitor visitor;

  ut_status keep(const ut_unit* unit, const ut_unit* const* units, const double* powers, int count) {
    base.reset(ut_clone(unit));
    for (int i = 0; i < count; ++i) {
      const char* const symbol = ut_get_symbol(units[i], UT_ASCII);
      const auto found = std::find(Measure::base_names.begin(), Measure::base_names.end(), symbol ? symbol : "");
      // The radian is the only other base unit: a number as far as we are concerned.
      if (found != Measure::base_names.end()) measure.powers[found - Measure::base_names.begin()] = powers[i];
    }
    return UT_SUCCESS;
  }
};
const ut_visitor BaseFinder::visitor = {basic, product, galilean, timestamp, logarithmic};

/// Names whose value in udunits is out of date: CODATA 2018, exact or to all digits known.
std::optional<Measure> newer_than_udunits(std::string_view name) {
  constexpr std::array<double, 7> energy = {2.0, 1.0, -2.0, 0.0, 0.0, 0.0, 0.0}, mass = {0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  if (name == "eV") return Measure{energy, 1.602176634e-19L};
  if (name == "meV") return Measure{energy, 1.602176634e-22L};
  if (name == "keV") return Measure{energy, 1.602176634e-16L};
  if (name == "u" || name == "amu") return Measure{mass, 1.66053906660e-27L};
  return std::nullopt;
}

/// The number with at most 12 digits that x is up to round-off, or x: undoes what factors such as 0.001/0.01^3 lost.
long double without_round_off(long double x) {
  constexpr long double round_off = 4e-16L;
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.11Le", x);
  const long double decimal = std::strtold(text.data(), nullptr);
  return std::fabs(decimal - x) <= round_off * std::fabs(x) ? decimal : x;
}

/// A unit name with its prefix, if any: "GPa", "mm", "degC".
Measure measure_of_name(const std::string& name) {
  constexpr std::array<std::string_view, 48> known = {
      "Pa", "kPa", "MPa", "GPa", "TPa", "bar",  "kbar", "Mbar",  "m",    "mm",     "cm",     "um",
      "nm", "km",  "in",  "ft",  "s",   "ms",   "us",   "ns",    "min",  "K",      "degC",   "degF",
      "kg", "g",   "mg",  "cc",  "mol", "J",    "kJ",   "MJ",    "erg",  "eV",     "W",      "N",
      "kN", "psi", "ksi", "atm", "%",   "inch", "dyne", "poise", "watt", "pascal", "degree", "radian"};
  if (name == "cal" || name == "kcal" || name == "Mcal")
    throw UnitError("\"" + name +
                    "\" may be the thermochemical calorie (4.184 J) or the international one (4.1868 J): write joules");
  if (const auto newer = newer_than_udunits(name)) return *newer;
  thread_local std::map<std::string, Measure> found_before;  // files use the same few units again and again
  if (const auto known_measure = found_before.find(name); known_measure != found_before.end()) return known_measure->second;
  static std::mutex one_at_a_time;  // udunits has one scanner for all threads
  const std::lock_guard lock(one_at_a_time);
  const UnitHandle unit(ut_parse(unit_system(), name.c_str(), UT_ASCII));
  BaseFinder finder;
  if (!unit || ut_accept_visitor(unit.get(), &BaseFinder::visitor, &finder) != UT_SUCCESS)
    throw UnitError("unknown unit " + in_quotes(name), did_you_mean(name, known));
  const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(unit.get(), finder.base.get()), &cv_free);
  if (!converter) throw UnitError("unknown unit " + in_quotes(name), did_you_mean(name, known));
  const double zero = cv_convert_double(converter.get(), 0.0), one = cv_convert_double(converter.get(), 1.0);
  finder.measure.offset = without_round_off(zero);
  finder.measure.factor = without_round_off(zero == 0.0 ? one : cv_convert_double(converter.get(), 1e6) / 1e6L - zero / 1e6L);
  return found_before[name] = finder.measure;
}

// --- Products, quotients and powers of names ------------------------------------------------------------------------
// udunits would read these too, but takes "m^0.5" for m^0 times 5, "s" for 1/s and "s since 1970" for a date.

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Measure parse() {
    const Measure result = product();
    if (position_ != text_.size()) throw UnitError("unexpected " + in_quotes(text_.substr(position_)) + " in the unit");
    return result;
  }

 private:
  char peek(std::size_t ahead = 0) const { return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0'; }
  bool take(std::string_view token) {
    if (text_.substr(position_, token.size()) != token) return false;
    position_ += token.size();
    return true;
  }
  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t') ++position_;
  }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%'; }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  static Measure combine(const Measure& a, const Measure& b, double power) {
    if (a.offset != 0.0L || b.offset != 0.0L)
      throw UnitError("a temperature scale with its own zero cannot be part of a product; write K for differences");
    Measure result = a;
    for (std::size_t i = 0; i < result.powers.size(); ++i) result.powers[i] += power * b.powers[i];
    result.factor *= std::pow(b.factor, static_cast<long double>(power));
    return result;
  }

  Measure product() {
    skip_spaces();
    Measure result;
    if (peek() != '/') result = factor();
    for (;;) {
      skip_spaces();
      if (peek() == '\0' || peek() == ')') return result;
      const bool divides = take("/");
      if (!divides && !take("*")) take(".");  // a space alone is a product too
      skip_spaces();
      result = combine(result, factor(), divides ? -1.0 : 1.0);
    }
  }

  Measure factor() {
    Measure result;
    if (take("(")) {
      result = product();
      if (!take(")")) throw UnitError("a closing parenthesis is missing in the unit");
    } else if (take("sqrt(")) {
      result = combine({}, product(), 0.5);
      if (!take(")")) throw UnitError("a closing parenthesis is missing in the unit");
    } else if (is_letter(peek())) {
      const std::size_t begin = position_;
      while (is_letter(peek())) ++position_;
      result = measure_of_name(std::string(text_.substr(begin, position_ - begin)));
    } else if (peek() == '1' && !is_digit(peek(1))) {
      ++position_;
    } else if (is_digit(peek())) {
      throw UnitError("a second number " + in_quotes(text_.substr(position_)) + " stands where a unit was expected");
    } else if (peek() == ',') {
      throw UnitError("unexpected \",\": the decimal sign is a point");
    } else {
      throw UnitError(position_ < text_.size() ? "unexpected " + in_quotes(text_.substr(position_)) + " in the unit"
                                               : "a unit name is missing at its end");
    }
    if (take("^") || take("**")) return combine({}, result, exponent());
    if (is_digit(peek()) || (peek() == '-' && is_letter(text_[position_ - 1]))) return combine({}, result, exponent());
    return result;
  }

  /// 2, -1, 0.5 or (1/2).
  double exponent() {
    constexpr double largest = 12.0;
    const bool parenthesis = take("(");
    double value = number();
    if (parenthesis && take("/")) value /= number();
    if (parenthesis && !take(")")) throw UnitError("a closing parenthesis is missing in the unit");
    if (!(std::fabs(value) <= largest)) throw UnitError("an exponent in the unit is not between -12 and 12");
    return value;
  }
  double number() {
    double value = 0.0;
    const char* const begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value, std::chars_format::fixed);
    if (error != std::errc() || !(is_digit(*begin) || *begin == '-'))
      throw UnitError("an exponent in the unit is not a number");
    position_ += end - begin;
    return value;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

/// Signs of the printed page to those of the grammar.
std::string plain_signs(std::string_view text) {
  constexpr std::array<std::array<std::string_view, 2>, 7> signs = {{{"\u00B0C", "degC"},
                                                                     {"\u00B5", "u"},
                                                                     {"\u03BC", "u"},
                                                                     {"\u00B7", " "},
                                                                     {"\u00B2", "^2"},
                                                                     {"\u00B3", "^3"},
                                                                     {"\u221A(", "sqrt("}}};
  std::string result(text);
  for (const auto& [sign, plain] : signs)
    for (auto at = result.find(sign); at != std::string::npos; at = result.find(sign, at + plain.size()))
      result.replace(at, sign.size(), plain);
  return result;
}

Measure measure_of(std::string_view text) {
  if (text.size() > longest_unit) throw UnitError("a unit of more than 100 characters");
  return UnitParser(plain_signs(text)).parse();
}

// --- Words for messages ---------------------------------------------------------------------------------------------

struct NamedQuantity {
  Unit unit;
  std::string_view article_and_name;
  std::string_view example;
};
constexpr std::array quantities = {NamedQuantity{Unit::one, "a plain number", "90 %"},
                                   NamedQuantity{Unit::Pa, "a pressure", "792 MPa"},
                                   NamedQuantity{Unit::K, "a temperature", "300 K"},
                                   NamedQuantity{Unit::kg_per_m3, "a density", "7.83 g/cm^3"},
                                   NamedQuantity{Unit::m, "a length", "25.4 mm"},
                                   NamedQuantity{Unit::s, "a time", "20 us"},
                                   NamedQuantity{Unit::per_s, "a rate", "1000 1/s"},
                                   NamedQuantity{Unit::per_K, "an inverse temperature", "1e-5 1/K"},
                                   NamedQuantity{Unit::per_Pa, "an inverse pressure", "0.03 1/GPa"},
                                   NamedQuantity{Unit::K_per_Pa, "a temperature per pressure", "30 K/GPa"},
                                   NamedQuantity{Unit::m_per_s, "a velocity", "4.5 km/s"},
                                   NamedQuantity{Unit::J_per_kg, "a specific energy", "4.3 MJ/kg"},
                                   NamedQuantity{Unit::J_per_kg_K, "a specific heat", "477 J/(kg K)"},
                                   NamedQuantity{Unit::m3_per_kg, "a specific volume", "0.13 cm^3/g"},
                                   NamedQuantity{Unit::Pa_s, "a viscosity", "10 Pa s"},
                                   NamedQuantity{Unit::Pa_per_K, "a pressure per temperature", "-30 MPa/K"},
                                   NamedQuantity{Unit::J, "an energy", "1.2 eV"},
                                   NamedQuantity{Unit::kg, "a mass", "55.8 g"},
                                   NamedQuantity{Unit::Pa_sqrt_m, "a fracture toughness", "50 MPa m^0.5"},
                                   NamedQuantity{Unit::W_per_m_K, "a thermal conductivity", "38 W/(m K)"},
                                   NamedQuantity{Unit::J_per_m3, "an energy per volume", "7 GJ/m^3"},
                                   NamedQuantity{Unit::J_per_mol, "an energy per amount", "150 kJ/mol"},
                                   NamedQuantity{Unit::m2, "an area", "2 cm^2"},
                                   NamedQuantity{Unit::kg_per_m2_s, "a mass flux", "10 kg/(m^2 s)"},
                                   NamedQuantity{Unit::kg_per_mol, "a molar mass", "55.8 g/mol"},
                                   NamedQuantity{Unit::J_per_mol_K, "a molar heat capacity", "25 J/(mol K)"}};

const NamedQuantity* find_quantity(Unit unit) {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedQuantity& q) { return q.unit.text == unit.text; });
  return found == quantities.end() ? nullptr : &*found;
}

std::string example_of(Unit unit) {
  const NamedQuantity* const known = find_quantity(unit);
  return known ? std::string(known->example) : "1 " + std::string(unit.text);
}

/// What a unit that was not the expected one does measure.
std::string meaning_of(const Measure& measure) {
  for (const NamedQuantity& quantity : quantities)
    if (measure_of(quantity.unit.text).same_quantity(measure)) return std::string(quantity.article_and_name);
  std::string bases;
  for (std::size_t i = 0; i < measure.powers.size(); ++i) {
    if (measure.powers[i] == 0.0) continue;
    if (!bases.empty()) bases += ' ';
    bases += Measure::base_names[i];
    if (measure.powers[i] != 1.0) bases += '^' + shortest_text(measure.powers[i]);
  }
  return "a quantity in " + bases;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Length of the decimal number that a text begins with; 0 if it does not.
std::size_t length_of_number(std::string_view text) {
  const bool sign = !text.empty() && (text[0] == '+' || text[0] == '-');
  const std::size_t begin = sign ? 1 : 0;
  const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  if (!is_digit(begin) && !(begin < text.size() && text[begin] == '.' && is_digit(begin + 1))) return 0;
  double ignored;
  return std::from_chars(text.data() + begin, text.data() + text.size(), ignored).ptr - text.data();
}

}  // namespace

UnitConversion::UnitConversion(std::string_view from, Unit to) : to_(to) {
  const Measure source = measure_of(from), target = measure_of(to.text);
  if (!source.same_quantity(target)) {
    const bool degrees = to.text == Unit::K.text && (from == "C" || from == "F");  // coulomb and farad
    throw UnitError("\"" + std::string(from) + "\" measures " + meaning_of(source),
                    degrees ? "; did you mean \"deg" + std::string(from) + "\"?" : "");
  }
  factor_ = without_round_off(source.factor / target.factor);
  offset_ = source.offset / target.factor;
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.11Le", factor_);
  power_of_ten_ =
      offset_ == 0.0L && std::strncmp(text.data(), "1.00000000000e", 14) == 0 && std::strtold(text.data(), nullptr) == factor_;
  exponent_ = power_of_ten_ ? std::atoi(text.data() + 14) : 0;
}

double UnitConversion::operator()(std::string_view number) const {
  std::string digits(trimmed(number));
  if (digits.empty() || digits.size() > longest_number || length_of_number(digits) != digits.size())
    throw UnitError(in_quotes(number) + " is not a decimal number");
  if (digits[0] == '+') digits.erase(0, 1);
  // A power of ten moves the decimal point, which is exact; anything else is one product in extended precision.
  if (power_of_ten_) {
    const auto e = digits.find_first_of("eE");
    int written = 0;
    if (e != std::string::npos) {
      const std::size_t begin = digits[e + 1] == '+' ? e + 2 : e + 1;
      const auto error = std::from_chars(digits.data() + begin, digits.data() + digits.size(), written).ec;
      if (error != std::errc() || std::abs(written) > 100000)
        throw UnitError(in_quotes(number) + " is beyond the range of numbers");
    }
    digits = digits.substr(0, e) + 'e' + std::to_string(written + exponent_);
  }
  double value = 0.0;
  if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc())
    throw UnitError(in_quotes(number) + " is beyond the range of numbers");
  if (!power_of_ten_) value = static_cast<double>(std::strtold(digits.c_str(), nullptr) * factor_ + offset_);
  if (!std::isfinite(value)) throw UnitError(in_quotes(number) + " is beyond the range of numbers");
  return value;
}

double to_si(std::string_view text, Unit expected) {
  const std::string_view trimmed_text = trimmed(text);
  const std::size_t length = length_of_number(trimmed_text);
  const std::string_view unit = trimmed(trimmed_text.substr(length));
  if (length > 0 && unit.empty()) {
    const bool plain = expected.text == Unit::one.text;
    throw UnitError(in_quotes(text) + " is not " + quantity_of(expected) + (plain ? "" : ": the unit is missing") + "; give " +
                    std::string(trimmed_text) + " without quotes" + (plain ? "" : ", in " + std::string(expected.text)) +
                    ", or a text such as \"" + example_of(expected) + '"');
  }
  try {
    if (length == 0) throw UnitError("it does not begin with a decimal number");
    return UnitConversion(unit, expected)(trimmed_text.substr(0, length));
  } catch (const UnitError& error) {
    throw UnitError(in_quotes(text) + " is not " + quantity_of(expected) + ": " + error.what() + "; give " +
                    allowed_texts(expected) + error.hint);
  }
}

bool is_number_with_unit(std::string_view text) {
  const std::string_view trimmed_text = trimmed(text);
  const std::size_t length = length_of_number(trimmed_text);
  const std::string_view unit = trimmed(trimmed_text.substr(length));
  if (trimmed_text.empty()) return true;
  const auto begins_word = [](unsigned char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c >= 0x80; };
  return length > 0 && (unit.empty() || begins_word(static_cast<unsigned char>(unit.front())));
}

bool is_unit(std::string_view text) {
  try {
    static_cast<void>(measure_of(text));
    return true;
  } catch (const UnitError&) {
    return false;
  }
}

std::string quantity_of(Unit unit) {
  const NamedQuantity* const known = find_quantity(unit);
  return known ? std::string(known->article_and_name) : "a quantity in " + std::string(unit.text);
}

std::string allowed_texts(Unit unit) {
  return (unit.text == Unit::one.text ? "a number" : "a number in " + std::string(unit.text)) + " or a text such as \"" +
         example_of(unit) + '"';
}

std::string describe(const Interval& interval) {
  const bool below = std::isfinite(interval.upper), above = std::isfinite(interval.lower);
  if (!above && !below) return "any finite number";
  if (above && below && !interval.lower_open && !interval.upper_open)
    return "between " + shortest_text(interval.lower) + " and " + shortest_text(interval.upper);
  std::string words;
  if (above) words += (interval.lower_open ? "> " : ">= ") + shortest_text(interval.lower);
  if (above && below) words += " and ";
  if (below) words += (interval.upper_open ? "< " : "<= ") + shortest_text(interval.upper);
  return words;
}

}  // namespace brisance
