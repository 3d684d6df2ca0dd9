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
///   there is none, which is undefined behaviour in release builds;
/// - letters and blanks beyond ASCII outside texts: its table of blanks has holes that it takes for unreachable.
class TrapFinder {
 public:
  explicit TrapFinder(std::string_view text) : text_(text) {}

  std::optional<Trap> find() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark
    for (; at_ < text_.size() && !trap_; ++at_) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        skip_text(c);
      else if (c == '#')
        skip_comment();
      else if (c == '[' && before_ == '\n' && open_.empty())
        skip_header_bracket();
      else
        look_at(c);
    }
    return trap_;
  }

 private:
  static bool is_one_of(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }
  void report(std::string_view what) { trap_ = Trap{at_, what}; }

  void skip_text(char quote) {
    const bool may_begin_here = is_one_of(before_, "\n=,[{") || (before_ == '.' && !in_value_);
    if (!may_begin_here) return report("a text cannot begin here; is an equals sign or a comma missing before it?");
    const bool triple = text_.substr(at_, 3) == std::string(3, quote);
    const std::string_view end = text_.substr(at_, triple ? 3 : 1);
    for (at_ += end.size(); at_ < text_.size() && text_.substr(at_, end.size()) != end; ++at_) {
      if (quote == '"' && text_[at_] == '\\') ++at_;
      if (!triple && at_ < text_.size() && text_[at_] == '\n') break;
    }
    at_ += end.size() - 1;
    // One or two quotes before the closing three are part of the text.
    for (int extra = 0; triple && extra < 2 && at_ + 1 < text_.size() && text_[at_ + 1] == quote; ++extra) ++at_;
    before_ = quote;
  }

  void skip_comment() {
    while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
  }

  void skip_header_bracket() {
    if (text_.substr(at_, 2) == "[[") ++at_;
    while (at_ + 1 < text_.size() && is_one_of(text_[at_ + 1], " \t")) ++at_;
    before_ = '[';
    if (at_ + 1 == text_.size()) return;
    const char c = text_[at_ + 1];
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || is_one_of(c, "-_\"']")) return;
    ++at_;
    report("in this table header: the name of the table must follow the bracket");
  }

  void look_at(char c) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) return report("letters and blanks beyond ASCII can stand in texts and comments only");
    if ((byte < 0x20 && !is_one_of(c, "\t\r\n")) || byte == 0x7F) return report("a control character outside a text");
    if (c == '.' && ++dots_ > deepest_key) return report("a key of more than 32 dotted parts");
    if (is_one_of(c, "=,[]{}\n")) dots_ = 0;

    if (c == '=') in_value_ = true;
    if ((c == '\n' && open_.empty()) || (c == ',' && open_.ends_with('{')) || c == '{') in_value_ = false;
    if (c == '[' || c == '{') open_ += c;
    if ((c == ']' || c == '}') && !open_.empty()) {
      if (c == '}' && open_.back() == '[') return report("in this list: expected closing ']', saw '}'");
      open_.pop_back();
      in_value_ = true;
    }
    if (!is_one_of(c, " \t\r")) before_ = c;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::optional<Trap> trap_;
  char before_ = '\n';     // the last character that is no blank
  std::string open_;       // brackets around this place within a value
  bool in_value_ = false;  // behind an equals sign
  int dots_ = 0;           // in this key
};

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
  if (const auto trap = TrapFinder(text).find())
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

std::string toml_text(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += '\\', result += c;
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (byte < 0x20 || byte == 0x7F)
      result += std::string("\\u00") + digits[byte / 16] + digits[byte % 16];
    else
      result += c;
  }
  return result + '"';
}

std::string toml_number(double value) {
  const std::string digits = shortest_text(value);
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

}  // namespace brisance
