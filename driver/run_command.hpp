#pragma once
// `pointdriver run`: one path, or every member of a sweep.

#include <filesystem>
#include <string>
#include <vector>

namespace brisance::driver {

struct RunOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::filesystem::path output;  // of the history: .csv, .h5; for a sweep a directory too. Empty: none
  std::filesystem::path figure;  // .png, .svg. Empty: none
  bool reference = false;        // integrate the rate form along the same path and report the differences
};

/// Returns the exit code.
int run(const RunOptions& options);

}  // namespace brisance::driver
