#pragma once
// HDF5 files of histories: one dataset per column, with its unit as attribute `unit`.

#include <filesystem>

#include "driver/history.hpp"

namespace brisance::driver {

void write_hdf5(const Record& record, const std::filesystem::path& path);
Record read_hdf5(const std::filesystem::path& path);

}  // namespace brisance::driver
