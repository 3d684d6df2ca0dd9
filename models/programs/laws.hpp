#pragma once
// The laws that the library knows, read from the lists of the models' folders: names, equations, sources, parameters.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brisance {

struct ParameterRow {
  std::string name, unit, range, default_value, meaning;
};

struct LawPage {
  std::string folder, name, equation, source;
  std::vector<ParameterRow> parameters;
  std::vector<ParameterRow> history;  // columns the law adds; range and default are empty
};

/// All laws, folder by folder.
std::vector<LawPage> all_laws();

/// The folders with the names of their laws, as text.
std::string list_laws();

/// The pages of the laws called `name`, or `folder/name`, or all laws of the folder `name`. nullopt if there is none; then
/// `suggestion` ends the error message.
std::optional<std::string> describe_laws(std::string_view name, std::string& suggestion);

}  // namespace brisance
