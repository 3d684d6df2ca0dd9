#pragma once
// The keys of an input file: one table per struct, from which the file is read, written and described.
//
//   struct Wall { double position = 0.0; Side side = Side::above; };
//   template <> inline constexpr auto keys<Wall> = std::tuple{
//       Key{"position", &Wall::position, Unit::m, "coordinate of the plane", any_value, required},
//       Key{"side", &Wall::side, Unit::one, "where the bodies are"}};
//
// A namespace that has such tables declares `keys` and keys_of(), which finds them for a type.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "models/input/material_reader.hpp"
#include "models/input/table_reader.hpp"
#include "models/input/units.hpp"

namespace brisance {

/// How many components a vector has in the file: those of the geometry, or always three.
enum class Components { of_geometry, three };

/// One key. If it may be left out, its default is what the member is in a new struct.
template <class Config, class T>
struct Key {
  std::string_view name;
  T Config::*member;
  Unit unit;
  std::string_view meaning;
  Interval interval = any_value;
  bool required = false;
  Components components = Components::of_geometry;
};
inline constexpr bool required = true;

/// A struct with a table of keys: keys_of(std::type_identity<Config>) in its namespace returns the table.
template <class Config>
concept HasKeys = requires {
  requires std::tuple_size_v<std::remove_cvref_t<decltype(keys_of(std::type_identity<Config>{}))>>
  != 0;
};

template <class Config, class F>
constexpr void for_each_key(F&& f) {
  std::apply([&](const auto&... key) { (f(key), ...); }, keys_of(std::type_identity<Config>{}));
}

// Reading ----------------------------------------------------------------------------------------------------------------

/// Reads structs by their keys. A reader of some file derives from it (Self) and adds `read_value` for the types of its own.
template <class Self>
class KeyReader {
 public:
  template <class Config>
  void read_keys(TableReader& in, Config& config) {
    for_each_key<Config>([&](const auto& key) {
      if (key.required || in.has(key.name)) self().read_value(in, key, config.*key.member);
    });
  }

 protected:
  Self& self() { return static_cast<Self&>(*this); }
  template <class K>
  static Quantity quantity(const K& key) {
    return {key.unit, key.interval, key.meaning};
  }

  template <class K>
  void read_value(TableReader& in, const K& key, double& value) {
    value = in.number(key.name, quantity(key));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<double>& value) {
    value = in.number(key.name, quantity(key));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, int& value) {
    value = in.integer(key.name, static_cast<int>(key.interval.lower), static_cast<int>(key.interval.upper));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::uint64_t& value) {
    value = static_cast<std::uint64_t>(
        in.integer(key.name, static_cast<int>(key.interval.lower), static_cast<int>(key.interval.upper)));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, bool& value) {
    value = in.flag(key.name);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::string& value) {
    value = in.text(key.name, key.meaning);
    if (value.find_first_of("\r\n") != std::string::npos) in.problem(key.name, "the text has a line break; give one line");
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::vector<std::string>& value) {
    value = in.texts(key.name);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::vector<double>& value) {
    value = in.numbers(key.name, quantity(key));
  }
  template <class K, class Enum>
  requires std::is_enum_v<Enum>
  void read_value(TableReader& in, const K& key, Enum& value) { value = in.choice<Enum>(key.name); }
  template <class K>
  void read_value(TableReader& in, const K& key, MaterialFile& value) {
    value = resolve_material(in, key.name);
  }
  template <class K, class Config>
  requires HasKeys<Config>
  void read_value(TableReader& in, const K& key, Config& value) {
    TableReader table = in.table(key.name, key.meaning);
    read_keys(table, value);
  }
  // What may be absent is read as what it is of; a word or number that is wrong counts as absent.
  template <class K, class Config>
  requires HasKeys<Config>
  void read_value(TableReader& in, const K& key, std::optional<Config>& value) { self().read_value(in, key, value.emplace()); }
  template <class K, class T>
  requires(std::is_enum_v<T> || std::is_integral_v<T>) void read_value(TableReader& in, const K& key, std::optional<T>& value) {
    const std::size_t before = in.problem_count();
    self().read_value(in, key, value.emplace());
    if (in.problem_count() > before) value.reset();
  }
};

// Describing -------------------------------------------------------------------------------------------------------------

struct KeyDescription {
  std::string path;           // "solid.velocity.translation"
  std::string values;         // what may be written
  std::string default_value;  // as TOML; "required" or empty
  std::string meaning;
  Unit unit = Unit::one;
  std::vector<std::string_view> choices{};  // the words that may be written, if it is one of a list
};

/// Describes structs by their keys. Derive from it (Self) and add `describe` for types of its own.
template <class Self>
class KeyDescriber {
 public:
  template <class Config>
  void describe_all(const std::string& above) {
    const Config fresh{};
    for_each_key<Config>([&](const auto& key) {
      const std::string path = above.empty() ? std::string(key.name) : above + '.' + std::string(key.name);
      self().describe(path, key, fresh.*key.member);
    });
  }
  std::vector<KeyDescription> take() { return std::move(rows_); }

 protected:
  Self& self() { return static_cast<Self&>(*this); }
  template <class K>
  void add(const std::string& path, const K& key, std::string values, std::string default_value = "",
           std::span<const std::string_view> words = {}) {
    rows_.push_back({path,
                     std::move(values),
                     key.required ? "required" : std::move(default_value),
                     std::string(key.meaning),
                     key.unit,
                     {words.begin(), words.end()}});
  }
  template <class K>
  static std::string numbers(const K& key) {
    const std::string range = brisance::describe(key.interval);
    return allowed_texts(key.unit) + (range == brisance::describe(any_value) ? "" : ", " + range);
  }

  template <class K>
  void describe(const std::string& path, const K& key, double fresh) {
    add(path, key, numbers(key), shortest_text(fresh));
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<double>&) {
    add(path, key, numbers(key));
  }
  template <class K, class Integer>
  requires(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>) void describe(const std::string& path, const K& key,
                                                                                        Integer fresh) {
    add(path, key, "a whole number, " + brisance::describe(key.interval), std::to_string(fresh));
  }
  template <class K, class Bool>
  requires std::is_same_v<Bool, bool>
  void describe(const std::string& path, const K& key, Bool fresh) {
    add(path, key, "true or false", fresh ? "true" : "false");
  }
  template <class K, class Enum>
  requires std::is_enum_v<Enum>
  void describe(const std::string& path, const K& key, Enum fresh) {
    add(path, key, "one of " + listed(choices<Enum>), std::string(choices<Enum>[static_cast<std::size_t>(fresh)]),
        choices<Enum>);
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::string& fresh) {
    add(path, key, "a text", fresh);
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::vector<std::string>&) {
    add(path, key, "a list of texts");
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::vector<double>& fresh) {
    std::string list;
    for (const double x : fresh) list += (list.empty() ? "" : ", ") + shortest_text(x);
    add(path, key, "a list, each " + numbers(key), '[' + list + ']');
  }
  template <class K>
  void describe(const std::string& path, const K& key, const MaterialFile&) {
    add(path, key, "a text, or a table with the keys of a material file");
  }
  template <class K, class Config>
  requires HasKeys<Config>
  void describe(const std::string& path, const K& key, const Config&) {
    add(path, key, "a table [" + path + ']');
    self().template describe_all<Config>(path);
  }
  template <class K, class Config>
  requires HasKeys<Config>
  void describe(const std::string& path, const K& key, const std::vector<Config>&) {
    add(path, key, "a list of tables [[" + path + "]]");
    self().template describe_all<Config>(path);
  }

  // What may be absent has no default.
  template <class K, class Config>
  requires HasKeys<Config>
  void describe(const std::string& path, const K& key, const std::optional<Config>&) { self().describe(path, key, Config{}); }
  template <class K, class T>
  requires(std::is_enum_v<T> || std::is_integral_v<T>) void describe(const std::string& path, const K& key,
                                                                     const std::optional<T>&) {
    self().describe(path, key, T{});
    rows_.back().default_value = "";
  }

  std::vector<KeyDescription> rows_;
};

/// The descriptions of the keys with this path and below it; else those with this last name; else those that may have this
/// value or, beside them, speak of it.
std::vector<KeyDescription> find_keys(std::span<const KeyDescription> all, std::string_view name);

/// Paths, last names and values: what find_keys may be asked for.
std::vector<std::string_view> names_of(std::span<const KeyDescription> all);

/// A description as a paragraph of a page, and one line of an overview of all keys.
std::string page_of(const KeyDescription& key);
std::string overview_of(std::span<const KeyDescription> all);

}  // namespace brisance
