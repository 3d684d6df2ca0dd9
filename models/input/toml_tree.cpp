#include "models/input/toml_tree.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "models/input/diagnostics.hpp"

namespace brisance {
namespace {

constexpr std::size_t largest_file = 16'000'000;  // bytes; an input file is written by hand
constexpr int deepest_key = 32;                   // dotted parts; toml++ itself bounds lists and inline tables, not these

[[noreturn]] void fail(const std::string& file, Place place, std::string what) {
  throw InputError({{file, place.line, place.column, "", std::move(what)}});
}

Place place_of(std::string_view text, std::size_t offset) {
  Place place{1, 1};
  for (const char c : text.substr(0, offset)) {
    if (c == '\n') {
      ++place.line, place.column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) {
      ++place.column;
    }
  }
  return place;
}

/// Is this place the end of its line?
bool ends_line(std::string_view text, Place place) {
  for (int line = 1; line < place.line; ++line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return place_of(text, std::min(text.find_first_of("\r\n"), text.size())).column == place.column;
}

/// Offset of the first byte that is not part of well-formed UTF-8 (Unicode 15, table 3-7), if any.
std::optional<std::size_t> first_byte_outside_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  for (std::size_t i = 0; i < text.size();) {
    const unsigned head = byte(i);
    const std::size_t tail = head < 0x80 ? 0 : head < 0xC2 ? 9 : head < 0xE0 ? 1 : head < 0xF0 ? 2 : head < 0xF5 ? 3 : 9;
    if (tail == 9) return i;
    const unsigned lowest = head == 0xE0 ? 0xA0 : head == 0xF0 ? 0x90 : 0x80;
    const unsigned highest = head == 0xED ? 0x9F : head == 0xF4 ? 0x8F : 0xBF;
    for (std::size_t k = 1; k <= tail; ++k) {
      const unsigned low = k == 1 ? lowest : 0x80, high = k == 1 ? highest : 0xBF;
      if (byte(i + k) < low || byte(i + k) > high) return i;
    }
    i += tail + 1;
  }
  return std::nullopt;
}

struct Trap {
  std::size_t offset;
  std::string_view what;
};

/// What toml++ 3.3 does not survive, if there is any of it:
/// - a key of very many dotted parts: each part is a table in a table, and taking the chain apart again exhausts the stack;
/// - a table header that does not begin with a key, or a brace where an element of a list should be: it only asserts that
///   there is none, which is undefined behaviour in release builds.
std::optional<Trap> first_trap(std::string_view text) {
  const auto is_one_of = [](char c, std::string_view set) { return set.find(c) != std::string_view::npos; };
  const auto is_key_character = [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || is_one_of(c, "-_\"']");
  };
  int dots = 0;
  std::string open;  // brackets around this place within a value
  bool line_begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const bool triple = text.substr(i, 3) == std::string(3, c);
      const std::string_view end = text.substr(i, triple ? 3 : 1);
      for (i += end.size(); i < text.size() && text.substr(i, end.size()) != end; ++i) {
        if (c == '"' && text[i] == '\\') ++i;
        if (!triple && i < text.size() && text[i] == '\n') break;
      }
      i += end.size() - 1;
      for (int extra = 0; triple && extra < 2 && text.substr(i + 1, 1) == end.substr(0, 1); ++extra) ++i;  // part of the text
      line_begins = false;
      continue;
    }
    if (c == '#') {
      while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
    } else if (c == '.') {
      if (++dots > deepest_key) return Trap{i, "a key of more than 32 dotted parts"};
    } else if (is_one_of(c, "=,[]{}\n")) {
      dots = 0;
    }
    if (c == '[' && line_begins && open.empty()) {
      i = text.find_first_not_of(" \t", i + (text.substr(i, 2) == "[[" ? 2 : 1));
      if (i == std::string_view::npos) return std::nullopt;
      if (!is_key_character(text[i])) return Trap{i, "in this table header: the name of the table must follow the bracket"};
      --i;
    } else if (c == '[' || c == '{') {
      open += c;
    } else if ((c == ']' || c == '}') && !open.empty()) {
      if (c == '}' && open.back() == '[') return Trap{i, "in this list: expected closing ']', saw '}'"};
      open.pop_back();
    }
    line_begins = c == '\n' || (line_begins && is_one_of(c, " \t\r"));
  }
  return std::nullopt;
}

/// The message of toml++ in words that fit ours.
std::string reworded(std::string_view description) {
  std::string what(description);
  const auto redefinition = what.find("cannot redefine existing ");
  if (redefinition != std::string::npos) {
    const auto begin = what.find('\'', redefinition), end = what.find('\'', begin + 1);
    if (begin != std::string::npos && end != std::string::npos)
      return in_quotes(std::string_view(what).substr(begin + 1, end - begin - 1)) + " is given twice; keep one of the two";
  }
  constexpr std::string_view prefix = "Error while parsing ";
  if (what.starts_with(prefix))
    what = "in this " + what.substr(prefix.size());
  else if (!what.empty() && what[0] >= 'A' && what[0] <= 'Z')
    what[0] = static_cast<char>(what[0] - 'A' + 'a');
  what = what.substr(0, what.find(" (TOML_MAX"));
  const bool surprised = what.find("expected") != std::string::npos || what.find("end-of-file") != std::string::npos;
  return "not valid TOML: " + what + (surprised ? "; the slip may stand before this place" : "");
}

Place place_of(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

TomlNode converted(const toml::node& from) {
  TomlNode result;
  result.place = place_of(from.source());
  if (const auto* const table = from.as_table()) {
    TomlTable members;
    for (const auto& [key, node] : *table)
      members.entries.push_back({std::string(key.str()), place_of(key.source()), converted(node), false});
    // toml++ sorts by key; messages follow the file.
    std::stable_sort(members.entries.begin(), members.entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
      return std::pair(a.key_place.line, a.key_place.column) < std::pair(b.key_place.line, b.key_place.column);
    });
    result.value = std::move(members);
  } else if (const auto* const list = from.as_array()) {
    TomlList elements;
    elements.reserve(list->size());
    for (const auto& node : *list) elements.push_back(converted(node));
    result.value = std::move(elements);
  } else if (const auto* const boolean = from.as_boolean()) {
    result.value = boolean->get();
  } else if (const auto* const integer = from.as_integer()) {
    result.value = integer->get();
  } else if (const auto* const real = from.as_floating_point()) {
    result.value = real->get();
  } else if (const auto* const text = from.as_string()) {
    result.value = text->get();
  } else {
    result.value = TomlDate{};
  }
  return result;
}

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace

TomlEntry* TomlTable::find(std::string_view key) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::string kind_of(const TomlNode& node) {
  return std::visit(
      Overloaded{[](const TomlTable&) { return std::string("a table"); }, [](const TomlList&) { return std::string("a list"); },
                 [](const TomlDate&) { return std::string("a date or time"); },
                 [](bool value) { return std::string(value ? "true" : "false"); },
                 [](std::int64_t value) { return "the number " + std::to_string(value); },
                 [](double value) { return "the number " + shortest_text(value); },
                 [](const std::string& value) { return "the text " + in_quotes(value); }},
      node.value);
}

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? printable(key) : path + '.' + printable(key);
}

TomlNode parse_toml(std::string_view text, const std::string& file_name) {
  if (const auto bad = first_byte_outside_utf8(text)) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(text[*bad]);
    fail(file_name, place_of(text, *bad),
         std::string("byte 0x") + digits[byte / 16] + digits[byte % 16] + " is not UTF-8 text; save the file as UTF-8");
  }
  if (const auto trap = first_trap(text))
    fail(file_name, place_of(text, trap->offset), "not valid TOML: " + std::string(trap->what));
  try {
    return converted(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    // toml++ sees a line break where a quote is missing as a forbidden character.
    const bool unclosed = error.description().find("control characters") != std::string_view::npos && ends_line(text, place);
    fail(file_name, place,
         unclosed ? "not valid TOML: the text is not closed before the end of the line" : reworded(error.description()));
  }
}

std::string read_text_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) fail(name, {}, "there is no such file");
  if (std::filesystem::is_directory(status)) fail(name, {}, "this is a folder; the name of a file is required");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(name, {}, std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  std::array<char, 65536> block;
  while (text.size() <= largest_file && file) {
    file.read(block.data(), block.size());
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) fail(name, {}, "cannot be read");
  if (text.size() > largest_file)
    fail(name, {}, "has more than " + std::to_string(largest_file / 1'000'000) + " MB; input files are small");
  if (text.empty()) fail(name, {}, "the file is empty");
  return text;
}

}  // namespace brisance
