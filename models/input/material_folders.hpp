#pragma once
// The material files that come with the programs: where they are, and what a name means.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brisance {

/// Where they may be, in the order in which they are looked for: where the running program was installed, the source tree it
/// was built from, where it was meant to be installed.
std::vector<std::filesystem::path> material_folders();

/// The files of the first folder that has any, by name. Throws InputError if there are none.
std::vector<std::filesystem::path> bundled_materials(std::span<const std::filesystem::path> folders);
std::vector<std::filesystem::path> bundled_materials();

/// The case files in the folder beside that of the materials, by name. Throws InputError if there are none.
std::vector<std::filesystem::path> bundled_cases();

/// The case file that a name means: a file of this name, else the one of those that come with the programs with this name, with
/// or without .toml. Throws InputError, with the nearest names, if there is none.
std::filesystem::path find_case(const std::filesystem::path& name);

/// The file that a name means: one in the folder `beside`, else one that comes with the programs.
std::optional<std::filesystem::path> find_material(const std::filesystem::path& name, const std::filesystem::path& beside);

/// What to say when there is none: "there is no material file ...", where it was looked for, and the nearest name.
std::string no_material_named(const std::filesystem::path& name, const std::filesystem::path& beside);

}  // namespace brisance
