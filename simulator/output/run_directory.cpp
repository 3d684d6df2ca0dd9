#include "simulator/output/run_directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "models/programs/files.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/grid_snapshot.hpp"

namespace brisance::simulator {
namespace {

namespace fs = std::filesystem;

bool is_output_of_a_run(const std::string& name) {
  constexpr std::array whole = {"case.toml",       "log.txt",         "history.csv", "summary.json",
                                "checkpoint_a.h5", "checkpoint_b.h5", "energy.png",  "field.png"};
  if (std::find(whole.begin(), whole.end(), name) != whole.end()) return true;
  return name.ends_with(".part") || name.ends_with("_particles.hdf.series") ||
         (name.ends_with(".hdf") && name.find("_particles_") != std::string::npos) || name == solid_grid + ".pvd" ||
         (name.starts_with(solid_grid + "_") && name.ends_with(".vti")) ||
         ((name.starts_with("profile_") || name.starts_with("line_")) && name.ends_with(".png"));
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A run that was interrupted, killed or stopped by an error, and has something to go on from.
bool is_unfinished(const fs::path& directory) {
  const fs::path summary = directory / "summary.json";
  const bool ended = fs::exists(summary) && text_of(summary).find("\"ending\": \"done\"") != std::string::npos;
  return has_checkpoint(directory) && !ended;
}

}  // namespace

void prepare_directory(const fs::path& directory, const Case& c, bool overwrite) {
  const std::string text = write_case(c);
  if (fs::exists(directory) && !fs::is_directory(directory))
    throw std::invalid_argument(fmt::format("{}: is a file; a run needs a directory", directory.string()));
  if (fs::exists(directory) && !fs::is_empty(directory) && !overwrite) {
    const fs::path earlier = directory / "case.toml";
    const std::string why = !fs::exists(earlier)       ? "holds files that are no run"
                            : text_of(earlier) != text ? "holds a run of another case"
                            : is_unfinished(directory)
                                ? "holds a run that has not come to its end (brisance resume goes on with it)"
                                : "";
    if (!why.empty())
      throw std::invalid_argument(fmt::format(
          "{}: {}; choose another directory with -o, or replace the run there with --overwrite", directory.string(), why));
  }
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    if (entry.is_regular_file() && is_output_of_a_run(entry.path().filename().string())) fs::remove(entry.path());
  replace_file_by_text(directory / "case.toml", text);
}

Log::Log(const fs::path& path, double wall_time_before) : out_(path, std::ios::app), before_(wall_time_before) {}

double Log::wall_time() const {
  return before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Log::line(const std::string& text) {
  out_ << fmt::format("{:10.2f} s  {}\n", wall_time(), text) << std::flush;
}

}  // namespace brisance::simulator
