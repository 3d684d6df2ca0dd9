#pragma once
// Strict reading of TOML files: every key of the file must be asked for, every value must be what was asked for, and all
// problems are reported together.
//
//   InputFile file = InputFile::load("path.toml");     // throws InputError if the file is no TOML
//   file.set("segment.0.duration=20 us");              // overrides from the command line, before reading
//   TableReader top = file.top();
//   const double T = top.number("temperature", {Unit::K, positive, "initial temperature"});
//   for (TableReader segment : top.tables("segment")) ...
//   file.finish();                                     // throws InputError with everything that was wrong
//
// A value that is missing or wrong is reported, and the reading goes on with a harmless stand-in; so nothing that was read
// may be relied on before finish() has returned.

#include <array>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "models/input/diagnostics.hpp"
#include "models/input/toml_tree.hpp"
#include "models/parameters.hpp"

namespace brisance {

/// What a number must be. The meaning is shown when it is missing.
struct Quantity {
  Unit unit = Unit::one;
  Interval interval = any_value;
  std::string_view meaning = {};
};

/// A number, or if the text is not empty, a text.
struct NumberOrText {
  double number = 0.0;
  std::string text;
};

/// How many elements a list must have.
struct Length {
  std::size_t least = 1;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};
constexpr Length exactly(std::size_t count) {
  return {count, count};
}

class InputFile;

/// One table of a file. A light handle: it must not outlive its InputFile.
class TableReader {
 public:
  /// Is the key there? Counts as asking for it, not as reading it.
  bool has(std::string_view key);
  bool is_text(std::string_view key);
  bool is_table(std::string_view key);
  bool is_list(std::string_view key);

  // A number is a TOML number in the SI unit, or a text with a unit. Without a default the key must be there.
  double number(std::string_view key, const Quantity& quantity);
  double number_or(std::string_view key, double default_value, const Quantity& quantity);
  std::optional<double> optional_number(std::string_view key, const Quantity& quantity);

  /// A number, or a text that is not written as a number with a unit: a formula.
  NumberOrText number_or_text(std::string_view key, const Quantity& quantity);
  std::vector<NumberOrText> numbers_or_texts(std::string_view key, const Quantity& quantity, Length length = {});

  int integer(std::string_view key, int lowest, int highest);
  int integer_or(std::string_view key, int default_value, int lowest, int highest);

  bool flag(std::string_view key);
  bool flag_or(std::string_view key, bool default_value);

  std::string text(std::string_view key, std::string_view meaning = {});
  std::string text_or(std::string_view key, std::string_view default_value);
  std::optional<std::string> optional_text(std::string_view key);

  /// The position of the text in `names`.
  std::size_t choice(std::string_view key, std::span<const std::string_view> names,
                     std::optional<std::size_t> default_value = {});
  /// An enum whose names are in choices<Enum>.
  template <class Enum>
  Enum choice(std::string_view key, std::optional<Enum> default_value = {}) {
    std::optional<std::size_t> position;
    if (default_value) position = static_cast<std::size_t>(*default_value);
    return static_cast<Enum>(choice(key, choices<Enum>, position));
  }

  std::vector<double> numbers(std::string_view key, const Quantity& quantity, Length length = {});
  std::optional<std::vector<double>> optional_numbers(std::string_view key, const Quantity& quantity, Length length = {});
  /// A list of lists of equal, given length: the rows of a matrix.
  std::vector<std::vector<double>> rows(std::string_view key, const Quantity& quantity, Length rows, std::size_t columns);
  std::vector<std::string> texts(std::string_view key, Length length = {});
  std::optional<std::vector<std::string>> optional_texts(std::string_view key, Length length = {});

  /// A number, or a table { <abscissa> = [...], value = [...] } of up to Table::capacity knots, abscissa increasing.
  Table piecewise(std::string_view key, const Quantity& value, std::string_view abscissa_name, const Quantity& abscissa);

  /// A table within this one. A required one that is missing is reported once, and then reads silently as empty.
  std::optional<TableReader> optional_table(std::string_view key);
  TableReader table(std::string_view key, std::string_view meaning = {});
  /// An array of tables; empty if the key is absent.
  std::vector<TableReader> tables(std::string_view key);
  /// The keys of this table in the order of the file, for tables whose keys are names chosen by the user.
  std::vector<std::string> keys();

  /// Reports a problem with a key that is there, or with this table.
  void problem(std::string_view key, std::string what);
  void problem(std::string what);
  /// Adds the problems of another file that this key names.
  void add_problems(std::string_view key, std::span<const Problem> problems);
  /// The same, and says at the key that its file cannot be used; why in the same line if that has no place in the file.
  void problem_of_file(std::string_view key, std::span<const Problem> problems);
  /// Do not report keys of this table that nobody asked for, nor overrides within: what they mean is unknown since something
  /// else went wrong.
  void ignore_rest();
  /// How many problems have been reported in this file so far.
  std::size_t problem_count() const;
  /// Whether nothing has been found wrong so far with these keys of this table, nor with what is within them. A check rests on
  /// some keys, and is done if they are valid, whatever else is wrong.
  bool valid(std::initializer_list<std::string_view> keys) const;
  /// The same of keys of the file, by their paths: "gas.fluid.0".
  bool valid_in_file(std::initializer_list<std::string_view> paths) const;

  /// The place of a key as overrides name it: "flow_stress.A".
  std::string path_of(std::string_view key) const;
  /// The file this table stands in.
  const std::filesystem::path& file() const;
  /// The overrides whose path leads through the text at this key into another file, with that path removed.
  std::vector<std::string> take_overrides(std::string_view key);

 private:
  friend class InputFile;
  TableReader(InputFile* owner, TomlTable* table, std::string path, Place place)
      : owner_(owner), table_(table), path_(std::move(path)), place_(place) {}

  TomlEntry* ask(std::string_view key);
  TomlNode* read(std::string_view key);
  TomlNode* require(std::string_view key, std::string_view meaning, const std::string& allowed);
  void report(Place place, const std::string& path, std::string what);
  void refuse(Place place, const std::string& path, std::string what);
  void note(Place place, const std::string& path, std::string what);
  void wrong_type(const TomlNode& node, const std::string& path, const std::string& required, const std::string& hint = "");
  std::optional<double> number_in(const TomlNode& node, const std::string& path, const Quantity& quantity);
  NumberOrText number_or_text_in(const TomlNode& node, const std::string& path, const Quantity& quantity);
  std::vector<double> numbers_in(const TomlNode& node, const std::string& path, const Quantity& quantity, Length length);
  std::vector<std::string> texts_in(const TomlNode& node, const std::string& path, Length length);
  /// The elements are judged even where there are too few or too many of them, which is reported.
  const TomlList* list_in(const TomlNode& node, const std::string& path, Length length, const std::string& elements);
  TableReader open(TomlNode& node, std::string path);

  InputFile* owner_;
  TomlTable* table_;  // null: missing, and reported as such
  std::string path_;
  Place place_;
};

/// One TOML file: its values, which of them were read, and what is wrong with it.
class InputFile {
 public:
  static InputFile load(const std::filesystem::path& path);
  static InputFile from_text(std::string_view text, std::filesystem::path name);

  InputFile(InputFile&&) = delete;
  InputFile& operator=(InputFile&&) = delete;

  /// "key.0.key=value": replaces or adds one value. The value is TOML, or a plain text. Problems are reported as --set key.
  void set(std::string_view assignment);

  TableReader top();

  /// Reports the keys that nobody asked for, and throws InputError if there is any problem.
  void finish();
  /// The same without throwing: all problems in the order of the file.
  std::vector<Problem> problems();

 private:
  friend class TableReader;
  InputFile(TomlNode root, std::filesystem::path path) : root_(std::move(root)), path_(std::move(path)) {}

  struct Override {
    std::string path;        // up to a text that names another file
    std::string assignment;  // within that file
  };
  void report_unread(const TomlTable& table, const std::string& path);
  void report_override(std::string_view key, std::string what);
  bool is_valid(std::string_view path) const;

  TomlNode root_;
  std::filesystem::path path_;
  std::vector<Problem> problems_;
  std::vector<Problem> other_problems_;  // of files that this one names
  std::vector<std::string> unreadable_;  // paths of values that are missing or not what they must be, so nothing is within them
  std::vector<std::string> refused_;     // paths of values, or of tables, that a check refused
  std::vector<Override> pending_;        // overrides that lead into files that this one names
};

}  // namespace brisance
