#pragma once
// `pointdriver check`: material files against the analytical limits of their laws.

#include <filesystem>
#include <string>
#include <vector>

namespace brisance::driver {

enum class Verdict { ok, warning, error };

struct Finding {
  Verdict verdict = Verdict::ok;
  std::string subject;  // "flow_stress"
  std::string text;
};

/// Everything that was looked at in one file. Throws InputError.
std::vector<Finding> check_material(const std::filesystem::path& file);

/// Checks these files, or all that come with the program, and prints a table. Returns 0 without errors, 2 if a file cannot be
/// read or used, else 1.
int run_check(const std::vector<std::filesystem::path>& files);

}  // namespace brisance::driver
