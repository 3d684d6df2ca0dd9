#include "models/programs/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/os.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace brisance {
namespace {

using Path = std::filesystem::path;

void synchronise(const Path& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!done) throw std::system_error(error, std::generic_category());
}

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
    auto out = fmt::output_file(temporary.string());
    out.print("{}", text);
    out.close();
  });
}

}  // namespace brisance
