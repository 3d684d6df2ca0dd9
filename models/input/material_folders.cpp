#include "models/input/material_folders.hpp"

#include <algorithm>

#include "models/input/diagnostics.hpp"

namespace brisance {
namespace {

using Path = std::filesystem::path;

std::vector<Path> files_in(const Path& folder) {
  std::vector<Path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string did_you_mean_one_of(const std::vector<Path>& files, const Path& name) {
  std::vector<std::string> names;
  for (const Path& file : files) names.push_back(file.filename().string());
  return did_you_mean(name.string(), std::vector<std::string_view>(names.begin(), names.end()));
}

std::string joined(std::span<const Path> folders) {
  std::string text;
  for (const Path& folder : folders) text += (text.empty() ? "" : ", ") + folder.string();
  return text;
}

}  // namespace

std::vector<Path> material_folders() {
  std::vector<Path> folders;
  std::error_code error;
  const Path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back((program.parent_path() / BRISANCE_MATERIALS_FROM_PROGRAM).lexically_normal());
  for (const Path folder : {BRISANCE_MATERIALS_SOURCE, BRISANCE_MATERIALS_INSTALLED})
    if (std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  return folders;
}

std::vector<Path> bundled_materials(std::span<const Path> folders) {
  for (const Path& folder : folders)
    if (std::vector<Path> files = files_in(folder); !files.empty()) return files;
  throw InputError({{"", 0, 0, "",
                     "the material files that come with the program are not there: looked in " + joined(folders) +
                         "; install them (cmake --install BUILD), or name files of your own"}});
}

std::vector<Path> bundled_materials() {
  return bundled_materials(material_folders());
}

std::vector<Path> bundled_cases() {
  std::vector<Path> folders = material_folders();
  for (Path& folder : folders) folder = folder.parent_path() / "cases";
  for (const Path& folder : folders)
    if (std::vector<Path> files = files_in(folder); !files.empty()) return files;
  throw InputError({{"", 0, 0, "",
                     "the cases that come with the program are not there: looked in " + joined(folders) +
                         "; install them (cmake --install BUILD)"}});
}

Path find_case(const Path& name) {
  std::error_code error;
  if (std::filesystem::is_directory(name, error))
    throw InputError({{name.string(), 0, 0, "", "it is a directory; the name of a case file is required"}});
  if (std::filesystem::exists(name, error)) return name;
  const auto fail = [&](const std::string& why) -> Path {
    throw InputError({{name.string(), 0, 0, "", "there is no such file" + why}});
  };
  const std::string guess = did_you_mean_one_of(files_in(name.has_parent_path() ? name.parent_path() : "."), name.filename());
  if (name.has_parent_path()) return fail(guess);
  std::vector<Path> files;
  try {
    files = bundled_cases();
  } catch (const InputError& none) {
    return fail(std::string("; ") + none.what());
  }
  std::vector<std::string> names;
  for (const Path& file : files) {
    if (name == file.filename() || name == file.stem()) return file;
    names.push_back(file.stem().string());
  }
  return fail(
      ", and no case of this name in " + files.front().parent_path().string() +
      (guess.empty() ? did_you_mean(name.stem().string(), std::vector<std::string_view>(names.begin(), names.end())) : guess));
}

std::optional<Path> find_material(const Path& name, const Path& beside) {
  std::error_code error;
  const Path own = beside / name;
  if (std::filesystem::exists(own, error)) return own;
  for (const Path& folder : material_folders())
    if (const Path bundled = folder / name; std::filesystem::exists(bundled, error)) return bundled;
  return std::nullopt;
}

std::string no_material_named(const Path& name, const Path& beside) {
  std::string what = "there is no material file " + in_quotes(name.string());
  std::vector<Path> present = files_in(beside.empty() ? "." : beside);
  if (name.is_relative()) {
    try {
      const std::vector<Path> bundled = bundled_materials();
      what += " beside this file or in " + bundled.front().parent_path().string();
      present.insert(present.end(), bundled.begin(), bundled.end());
    } catch (const InputError& error) {
      what += " beside this file; " + std::string(error.what());
    }
  }
  return what + did_you_mean_one_of(present, name);
}

}  // namespace brisance
