#pragma once
// Files that appear complete or not at all.

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string_view>

namespace brisance {

/// What a user names for output goes into a folder that is there: a slip of the keyboard makes no new ones. Throws
/// std::invalid_argument otherwise, before anything has been computed. An empty path stands for no output.
void require_folder_for(const std::filesystem::path& path);
/// The same for a file that must have one of these endings.
void require_place_for(const std::filesystem::path& path, std::initializer_list<std::string_view> endings);

/// Calls write_to(temporary path), then moves the result to its name. Throws std::runtime_error, naming the file, if either
/// fails.
void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write_to);

/// The same, on disk before it gets its name, so that a loss of power leaves the old file or the new one.
void replace_file_durably(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write_to);

/// Waits until what has been written to a file is on disk. Throws std::system_error.
void synchronise(const std::filesystem::path& path);

/// A text as a whole file, complete or not at all.
void replace_file_by_text(const std::filesystem::path& path, std::string_view text);

/// Appends a checksum of all that a file holds, as an XML comment: XML allows it there, and HDF5 does not look beyond its own
/// end. Throws std::runtime_error.
void seal_file(const std::filesystem::path& path);
/// Throws std::runtime_error if the file is not as it was sealed: it was cut off, changed, or never finished.
void require_seal(const std::filesystem::path& path);

}  // namespace brisance
