#include "models/programs/laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/input/diagnostics.hpp"
#include "models/input/units.hpp"
#include "models/material.hpp"

namespace brisance {
namespace {

template <class T>
std::string as_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(choices<T>[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_same_v<T, Table>) {
    return value.size == 1 ? shortest_text(value.y[0]) : "table";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return shortest_text(value);
  } else {
    std::string text;
    for (const auto& element : value) text += fmt::format("{}{}", text.empty() ? "" : ", ", shortest_text(element));
    return fmt::format("[{}]", text);
  }
}

template <class T>
std::string range_of(const Interval& interval) {
  if constexpr (std::is_same_v<T, bool>) {
    return "true, false";
  } else if constexpr (std::is_enum_v<T>) {
    return listed(choices<T>);
  } else {
    const std::string words = std::isinf(interval.lower) && std::isinf(interval.upper) ? "any" : describe(interval);
    if constexpr (std::is_same_v<T, Table>)
      return words + ", or a table";
    else if constexpr (!std::is_arithmetic_v<T>)
      return fmt::format("{} numbers, {}", std::tuple_size_v<T>, words);
    else
      return words;
  }
}

template <class Law>
LawPage page_of(std::string_view folder) {
  LawPage page{std::string(folder), std::string(Law::name), std::string(Law::equation), std::string(Law::source), {}, {}};
  for_each_parameter<Law>([&]<class T>(const Parameter<Law, T>& row) {
    page.parameters.push_back({std::string(row.name), std::string(row.unit.text), range_of<T>(row.interval),
                               row.default_value ? as_text<T>(*row.default_value) : "required", std::string(row.meaning)});
  });
  const auto add_history = [&](const HistoryColumn& column) {
    page.history.push_back({std::string(column.name), std::string(column.unit.text), "", "", std::string(column.meaning)});
  };
  if constexpr (requires { add_history(Law::history); })
    add_history(Law::history);
  else if constexpr (requires { std::begin(Law::history); })
    for (const HistoryColumn& column : Law::history) add_history(column);
  return page;
}

template <class... Laws>
void add_folder(std::vector<LawPage>& pages, std::string_view folder, const std::variant<Laws...>*) {
  (pages.push_back(page_of<Laws>(folder)), ...);
}

std::string columns_text(const std::vector<ParameterRow>& rows, bool with_range) {
  std::size_t name = 0, unit = 0, range = 0, initial = 0;
  for (const ParameterRow& r : rows) {
    name = std::max(name, r.name.size());
    unit = std::max(unit, r.unit.size());
    range = std::max(range, r.range.size());
    initial = std::max(initial, r.default_value.size());
  }
  std::string text;
  for (const ParameterRow& r : rows)
    text += with_range ? fmt::format("    {:{}}  {:{}}  {:{}}  {:{}}  {}\n", r.name, name, r.unit, unit, r.range, range,
                                     r.default_value, initial, r.meaning)
                       : fmt::format("    {:{}}  {:{}}  {}\n", r.name, name, r.unit, unit, r.meaning);
  return text;
}

/// Text broken into lines of a width that fits a terminal.
std::string wrapped(std::string_view text, std::size_t indent) {
  constexpr std::size_t width = 110;
  std::string result, line;
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, space);
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
      result += fmt::format("{:{}}{}\n", "", indent, line);
      line.clear();
    }
    line += fmt::format("{}{}", line.empty() ? "" : " ", word);
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  return result + fmt::format("{:{}}{}\n", "", indent, line);
}

std::string page_text(const LawPage& page) {
  std::string text = fmt::format("{}/{}\n", page.folder, page.name);
  text += wrapped(page.equation, 4) + wrapped(fmt::format("Source: {}", page.source), 4);
  if (page.parameters.empty()) return text + "    no parameters\n";
  std::vector<ParameterRow> rows{{"parameter", "unit", "range", "default", "meaning"}};
  rows.insert(rows.end(), page.parameters.begin(), page.parameters.end());
  text += fmt::format("\n{}", columns_text(rows, true));
  if (!page.history.empty()) text += fmt::format("\n    history\n{}", columns_text(page.history, false));
  return text;
}

}  // namespace

std::vector<LawPage> all_laws() {
  std::vector<LawPage> pages;
  add_folder(pages, "equation_of_state", static_cast<EquationOfState*>(nullptr));
  add_folder(pages, "shear_modulus", static_cast<ShearModulus*>(nullptr));
  add_folder(pages, "melting", static_cast<Melting*>(nullptr));
  add_folder(pages, "specific_heat", static_cast<SpecificHeat*>(nullptr));
  add_folder(pages, "flow_stress", static_cast<FlowStress*>(nullptr));
  add_folder(pages, "yield", static_cast<Yield*>(nullptr));
  add_folder(pages, "viscoelastic", static_cast<Viscoelastic*>(nullptr));
  add_folder(pages, "porosity", static_cast<Porosity*>(nullptr));
  add_folder(pages, "initial_porosity", static_cast<InitialPorosity*>(nullptr));
  add_folder(pages, "damage", static_cast<Damage*>(nullptr));
  add_folder(pages, "initial_damage", static_cast<InitialDamage*>(nullptr));
  add_folder(pages, "stability", static_cast<Stability*>(nullptr));
  add_folder(pages, "failure", static_cast<Failure*>(nullptr));
  add_folder(pages, "reaction", static_cast<Reaction*>(nullptr));
  pages.push_back(page_of<Heating>("material"));
  pages.push_back(page_of<ArtificialViscosity>("material"));
  return pages;
}

std::string list_laws() {
  std::string text, folder;
  for (const LawPage& page : all_laws()) {
    if (page.folder != folder) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", page.folder);
    folder = page.folder;
    text += fmt::format("    {}\n", page.name);
  }
  return text;
}

std::optional<std::string> describe_laws(std::string_view name, std::string& suggestion) {
  const std::vector<LawPage> pages = all_laws();
  std::string text;
  for (const LawPage& page : pages)
    if (name == page.name || name == page.folder || name == page.folder + "/" + page.name)
      text += fmt::format("{}{}", text.empty() ? "" : "\n", page_text(page));
  if (!text.empty()) return text;
  std::vector<std::string_view> names;
  for (const LawPage& page : pages) names.push_back(page.name);
  suggestion = did_you_mean(name, names);
  return std::nullopt;
}

}  // namespace brisance
