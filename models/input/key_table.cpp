#include "models/input/key_table.hpp"

#include <algorithm>
#include <cctype>

namespace brisance {
namespace {

std::string_view last_name(std::string_view path) {
  return path.substr(path.rfind('.') + 1);
}

std::string_view table_of(std::string_view path) {
  const auto dot = path.rfind('.');
  return path.substr(0, dot == std::string_view::npos ? 0 : dot);
}

bool has_word(std::string_view text, std::string_view word) {
  const auto part_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !part_of_word(text[at - 1])) && (end == text.size() || !part_of_word(text[end]))) return true;
  }
  return false;
}

}  // namespace

std::vector<KeyDescription> find_keys(std::span<const KeyDescription> all, std::string_view name) {
  std::vector<KeyDescription> found;
  const std::string below = std::string(name) + '.';
  const auto keep = [&](auto&& wanted) {
    if (found.empty()) std::copy_if(all.begin(), all.end(), std::back_inserter(found), wanted);
  };
  keep([&](const KeyDescription& key) { return key.path == name || key.path.starts_with(below); });
  keep([&](const KeyDescription& key) { return last_name(key.path) == name; });
  if (!found.empty()) return found;
  // A value: the keys that may have it, and those beside them that speak of it.
  for (const KeyDescription& chosen : all) {
    if (std::find(chosen.choices.begin(), chosen.choices.end(), name) == chosen.choices.end()) continue;
    found.push_back(chosen);
    for (const KeyDescription& key : all)
      if (&key != &chosen && table_of(key.path) == table_of(chosen.path) && has_word(key.meaning, name)) found.push_back(key);
  }
  return found;
}

std::vector<std::string_view> names_of(std::span<const KeyDescription> all) {
  std::vector<std::string_view> names;
  for (const KeyDescription& key : all) {
    names.push_back(key.path);
    names.push_back(last_name(key.path));
    names.insert(names.end(), key.choices.begin(), key.choices.end());
  }
  return names;
}

std::string page_of(const KeyDescription& key) {
  std::string text = key.path + "\n  " + key.meaning + "\n  values: " + key.values + '\n';
  if (key.default_value == "required")
    text += "  must be given\n";
  else if (!key.default_value.empty())
    text += "  default: " + key.default_value + '\n';
  return text;
}

std::string overview_of(std::span<const KeyDescription> all) {
  std::size_t width = 0;
  for (const KeyDescription& key : all) width = std::max(width, key.path.size());
  std::string text;
  for (const KeyDescription& key : all)
    text += "  " + key.path + std::string(width + 2 - key.path.size(), ' ') + key.meaning + '\n';
  return text;
}

}  // namespace brisance
