#pragma once
// HDF5 files of histories: one dataset per column, with its unit as attribute `unit`.

#include <filesystem>
#include <span>
#include <string>

#include "driver/history.hpp"
#include "driver/sweep.hpp"

namespace brisance::driver {

void write_hdf5(const Record& record, const std::filesystem::path& path);
/// One group for each member of a sweep, member_001 and on; its values are attributes of the group, "name [unit]".
void write_hdf5(std::span<const SweepMember> members, const std::filesystem::path& path);

/// The history of a file, or of a group of it.
Record read_hdf5(const std::filesystem::path& path, const std::string& group = "/");
/// A value of a member of a sweep, by the name of its attribute.
double read_hdf5_value(const std::filesystem::path& path, const std::string& group, const std::string& name);

}  // namespace brisance::driver
