#include "models/programs/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace brisance {

using Path = std::filesystem::path;

void synchronise(const Path& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!done) throw std::system_error(error, std::generic_category());
}

namespace {

void replace(const Path& path, const std::function<void(const Path&)>& write_to, bool durably) {
  const Path temporary = path.string() + ".part";
  try {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    write_to(temporary);
    if (durably) synchronise(temporary);
    std::filesystem::rename(temporary, path);
    if (durably) synchronise(path.has_parent_path() ? path.parent_path() : Path("."));
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
}

/// A number that almost surely changes when any bit of the first `size` bytes of a stream does.
std::uint64_t checksum(std::istream& in, std::uint64_t size) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  std::uint64_t sum = odd ^ size;
  std::vector<char> buffer(1 << 20);
  while (size > 0) {
    const std::uint64_t count = std::min<std::uint64_t>(size, buffer.size());
    if (!in.read(buffer.data(), static_cast<std::streamsize>(count))) throw std::runtime_error("it cannot be read");
    std::fill(buffer.begin() + static_cast<std::ptrdiff_t>(count), buffer.end(), '\0');
    for (std::uint64_t at = 0; at < count; at += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, buffer.data() + at, sizeof word);
      sum = (std::rotl(sum, 29) ^ word) * odd;
      sum ^= sum >> 32;
    }
    size -= count;
  }
  return sum;
}

constexpr std::string_view before_seal = "\n<!-- checksum ", after_seal = " -->\n";
constexpr std::size_t seal_length = before_seal.size() + 16 + after_seal.size();

std::string seal_text(std::uint64_t sum) {
  return fmt::format("{}{:016x}{}", before_seal, sum, after_seal);
}

}  // namespace

void require_folder_for(const Path& path) {
  const Path folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw std::invalid_argument(fmt::format("{}: there is no folder {}; make it first", path.string(), folder.string()));
}

void require_place_for(const Path& path, std::initializer_list<std::string_view> endings) {
  require_folder_for(path);
  if (!path.empty() && std::find(endings.begin(), endings.end(), path.extension().string()) == endings.end())
    throw std::invalid_argument(fmt::format("{}: the file name must end in {}", path.string(), fmt::join(endings, " or ")));
}

void replace_file(const Path& path, const std::function<void(const Path&)>& write_to) {
  replace(path, write_to, false);
}

void replace_file_durably(const Path& path, const std::function<void(const Path&)>& write_to) {
  replace(path, write_to, true);
}

void replace_file_by_text(const Path& path, std::string_view text) {
  replace_file(path, [&](const Path& temporary) {
    // Not fmt::output_file: on a full disk it throws once more while it is destroyed, which ends the program.
    errno = 0;
    std::ofstream out(temporary, std::ios::binary);
    if (!(out << text << std::flush)) throw std::system_error(errno, std::generic_category());
  });
}

void seal_file(const Path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string seal = seal_text(checksum(in, std::filesystem::file_size(path)));
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::app);
  if (!(out << seal << std::flush))
    throw std::runtime_error(fmt::format("the checksum cannot be written: {}", std::generic_category().message(errno)));
}

void require_seal(const Path& path) {
  const auto damaged = [&](std::string_view how) {
    throw std::runtime_error(fmt::format("{}: is damaged: {}", path.string(), how));
  };
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error(fmt::format("{}: cannot be read: {}", path.string(), std::generic_category().message(errno)));
  const std::uint64_t size = std::filesystem::file_size(path);
  if (size < seal_length) damaged("the checksum at its end is missing; it was cut off");
  const std::string expected = seal_text(checksum(in, size - seal_length));
  std::string found(seal_length, '\0');
  in.read(found.data(), static_cast<std::streamsize>(seal_length));
  if (!found.starts_with(before_seal) || !found.ends_with(after_seal))
    damaged("the checksum at its end is missing; it was cut off");
  if (found != expected) damaged("its checksum does not match");
}

}  // namespace brisance
