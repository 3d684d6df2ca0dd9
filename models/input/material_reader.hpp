#pragma once
// Material files: one TOML table per component, every value with its source. The keys are those of the laws' parameter tables.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "models/input/table_reader.hpp"
#include "models/material.hpp"

namespace brisance {

/// A material and where its values come from.
struct MaterialFile {
  Material material;
  std::string notes;
  /// Citations by what they cover: "density", "flow_stress" (every value of the table), "flow_stress.n" (this value),
  /// "failure.0".
  std::map<std::string, std::string> sources;
  std::filesystem::path path;  // of the file it was read from
};

/// Reads a material file. Throws InputError with all problems.
MaterialFile read_material_file(const std::filesystem::path& path);
Material read_material(const std::filesystem::path& path);

/// Reads a material from a table of any file; problems go to that file.
MaterialFile read_material(TableReader& table);

/// Reads the material that a key of another file gives: a table, or the name of a material file, looked for beside that file
/// and then among the materials that come with the program. Problems go to that file.
MaterialFile resolve_material(TableReader& table, std::string_view key);

/// A complete material file, defaults included, that reads back to the same material bit for bit.
std::string write_material(const MaterialFile& file);
/// The same for a material whose sources are not known: each is given as `source`.
std::string write_material(const Material& material, std::string_view source = "not recorded");

}  // namespace brisance
