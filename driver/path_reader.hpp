#pragma once
// Path files: TOML that reads like a problem statement, to a material and a loading path.

#include <filesystem>
#include <string>
#include <vector>

#include "driver/loading_path.hpp"
#include "models/input/material_reader.hpp"

namespace brisance::driver {

/// What a path file describes.
struct PointCase {
  MaterialFile file;
  LoadingPath path;
};

/// Reads a path file with overrides of the form key.0.key=value; "material.flow_stress.A=..." reaches into the material file.
/// Throws InputError with everything that is wrong in both files.
PointCase read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace brisance::driver
