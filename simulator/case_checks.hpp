#pragma once
// What the parts of a case have in common when they are checked beyond the single value.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "models/input/table_reader.hpp"
#include "simulator/config.hpp"

namespace brisance::simulator {

inline constexpr std::array<std::string_view, 3> axis_names = {"x", "y", "z"};
inline constexpr double round_off = 1e-9;  // in cells: positions are decimal numbers in the file

inline std::string in_metres(double x) {
  return fmt::format("{:.9g} m", x == 0.0 ? 0.0 : x);
}

/// What else is wrong is judged without a geometry as far as it does not depend on it.
inline bool geometry_known(const TableReader& in) {
  return in.valid_in_file({"geometry"});
}

/// What has no name, as that is wrong, takes none.
template <class Config>
void require_own_name(TableReader& in, const Config& config, const std::vector<Config>& others) {
  const bool taken = std::any_of(others.begin(), others.end(), [&](const Config& other) { return other.name == config.name; });
  if (taken && !config.name.empty())
    in.problem("name", "the name " + in_quotes(config.name) + " is given twice; give each its own");
}

/// Words that must be among some. These are told once, with the first word that is not.
inline void require_words(TableReader& in, std::string_view key, std::span<const std::string> words,
                          std::span<const std::string_view> allowed, std::string_view what_if_not) {
  std::string told = "; it must be one of " + listed(allowed);
  for (const std::string& word : words) {
    if (word.empty() || std::find(allowed.begin(), allowed.end(), word) != allowed.end()) continue;
    in.problem(key, fmt::format("{} {}{}{}", in_quotes(word), what_if_not, told, did_you_mean(word, allowed)));
    told.clear();
  }
}

/// Names that become part of the names of files.
inline void require_file_name(TableReader& in, const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!plain) in.problem("name", in_quotes(name) + ": it becomes part of file names; give letters, digits, _ and -");
}

inline void require_component_in_geometry(TableReader& in, Axis axis, const Case& c) {
  if (geometry_known(in) && static_cast<int>(axis) >= c.dimensions())
    in.problem("axis", "there is no z in two dimensions; give x or y");
}

}  // namespace brisance::simulator
