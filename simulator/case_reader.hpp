#pragma once
// Case files: what a run simulates. The keys are those of keys.hpp.

#include <filesystem>
#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator {

/// Reads a case with its materials; overrides are texts such as "solid.0.material.flow_stress.A=95 MPa", and
/// the case remembers them. Throws InputError with all problems. What it returns is consistent: every name refers to something,
/// and every body and boundary is where it can be.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// A complete case file in SI units, materials and defaults included, that reads back to the same case bit for bit. Paths stand
/// in it as they are: read_case makes them absolute, and takes one that is not as beside the file.
std::string write_case(const Case& c);

}  // namespace brisance::simulator
