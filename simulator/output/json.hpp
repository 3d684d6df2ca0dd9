#pragma once
// JSON as text: objects and lists in the order in which they are filled.

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brisance::simulator {

/// The text that a quoted one of this file's makes begins with; empty if it begins with none.
inline std::string unquoted(std::string_view json) {
  std::string text;
  if (json.empty() || json.front() != '"') return text;
  for (std::size_t i = 1; i < json.size() && json[i] != '"'; ++i) {
    if (json[i] != '\\' || i + 1 == json.size())
      text += json[i];
    else if (json[++i] != 'u')
      text += json[i];
    else
      text += static_cast<char>(std::strtol(std::string(json.substr(i + 1, 4)).c_str(), nullptr, 16)), i += 4;
  }
  return text;
}

class Json {
 public:
  static Json object() { return Json('{', '}'); }
  static Json list() { return Json('[', ']'); }
  Json(double number) : scalar_(std::isfinite(number) ? fmt::format("{}", number) : "null") {}
  template <std::integral Integer>
  Json(Integer number) : scalar_(fmt::format("{}", number)) {}
  Json(bool flag) : scalar_(flag ? "true" : "false") {}
  Json(const std::string& text) : scalar_(quoted(text)) {}
  Json(const char* text) : scalar_(quoted(text)) {}

  Json& set(const std::string& key, const Json& value) {
    entries_.emplace_back(quoted(key) + ": ", value);
    return *this;
  }
  Json& append(const Json& value) {
    entries_.emplace_back("", value);
    return *this;
  }
  std::string text() const { return text_at(0) + '\n'; }

 private:
  Json(char open, char close) : open_(open), close_(close) {}

  static std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\')
        result += '\\', result += c;
      else if (static_cast<unsigned char>(c) < 0x20)
        result += fmt::format("\\u{:04x}", static_cast<int>(c));
      else
        result += c;
    }
    return result + '"';
  }
  std::string text_at(int depth) const {
    if (open_ == '\0') return scalar_;
    if (entries_.empty()) return {open_, close_};
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    std::string result(1, open_);
    for (std::size_t i = 0; i < entries_.size(); ++i)
      result += (i ? ",\n  " : "\n  ") + indent + entries_[i].first + entries_[i].second.text_at(depth + 1);
    return result + '\n' + indent + close_;
  }

  char open_ = '\0', close_ = '\0';
  std::string scalar_;
  std::vector<std::pair<std::string, Json>> entries_;
};

}  // namespace brisance::simulator
