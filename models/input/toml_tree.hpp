#pragma once
// The content of a TOML file as plain values that know where they stand. toml_tree.cpp is the only user of toml++.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace brisance {

/// Where a value stands: a line and column counted from 1, nowhere in particular, or on the command line.
struct Place {
  int line = 0;
  int column = 0;

  static constexpr int command_line = -1;
};

struct TomlEntry;
struct TomlNode;
using TomlList = std::vector<TomlNode>;

/// The entries of a table in the order of the file.
struct TomlTable {
  std::vector<TomlEntry> entries;
  std::vector<std::string> asked;  // the keys that the program knows here
  bool opened = false;             // entries that were not read are to be reported

  TomlEntry* find(std::string_view key);
};

struct TomlDate {};  // dates and times have no use here

struct TomlNode {
  std::variant<TomlTable, TomlList, bool, std::int64_t, double, std::string, TomlDate> value;
  Place place;
};

struct TomlEntry {
  std::string key;
  Place key_place;
  TomlNode node;
  bool read = false;
};

/// What a value is, for messages: "a list", "the number 3".
std::string kind_of(const TomlNode& node);

/// A key within a table as messages and overrides name it: "flow_stress.A".
std::string joined(const std::string& path, std::string_view key);

/// Parses TOML text. Throws InputError, naming the file, if it is not UTF-8 or not TOML.
TomlNode parse_toml(std::string_view text, const std::string& file_name);

/// The text of a file. Throws InputError if there is no such file, or it cannot be read, or it is empty or huge.
std::string read_text_file(const std::filesystem::path& path);

/// A text as TOML writes it, in quotes.
std::string toml_text(std::string_view text);
/// A TOML number that reads back to the same bits: never an integer, which would lose the sign of zero.
std::string toml_number(double value);

}  // namespace brisance
