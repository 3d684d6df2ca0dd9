#include "simulator/output/run_directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <regex>
#include <stdexcept>

#include "models/programs/files.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/grid_snapshot.hpp"
#include "simulator/output/history.hpp"
#include "simulator/output/summary.hpp"

namespace brisance::simulator {
namespace {

namespace fs = std::filesystem;

bool is_output_of_a_run(const std::string& name) {
  constexpr std::array whole = {"case.toml",       "log.txt",    "history.csv", "summary.json", "checkpoint_a.h5",
                                "checkpoint_b.h5", "energy.png", "field.png",   "gauges.png"};
  if (std::find(whole.begin(), whole.end(), name) != whole.end()) return true;
  return name.ends_with(".part") || name.ends_with("_particles.hdf.series") ||
         (name.ends_with(".hdf") && name.find("_particles_") != std::string::npos) || name == solid_grid + ".pvd" ||
         (name.starts_with(solid_grid + "_") && name.ends_with(".vti")) || name == gas_grid + ".pvd" ||
         (name.starts_with(gas_grid + "_") && name.ends_with(".vti")) ||
         ((name.starts_with("profile_") || name.starts_with("line_")) && name.ends_with(".png")) ||
         ((name.starts_with("measured_profile_") || name.starts_with("gas_profile_")) && name.ends_with(".csv"));
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_finished(const fs::path& directory) {
  const std::optional<ToldEnding> told = read_ending(directory / "summary.json");
  return told && told->ending == "done";
}

constexpr std::string_view after_time = " s  ";  // in a line of the log

using Files = std::vector<std::pair<std::string, std::string>>;  // name, content

bool holds(const fs::path& directory, const Files& files) {
  return std::all_of(files.begin(), files.end(),
                     [&](const auto& file) { return text_of(directory / file.first) == file.second; });
}

/// Calls f(path, stem of the name that it has in the directory of a run) for what a case reads and what comes along.
template <class F>
void for_each_profile(Case& c, F&& f) {
  for (MeasureConfig& measure : c.measures)
    if (!measure.profile.empty()) f(measure.profile, "measured_profile");
  if (!c.gas) return;
  for (FillConfig& fill : c.gas->fills)
    if (fill.profile) f(fill.profile->file, "gas_profile");
}

}  // namespace

void prepare_directory(const fs::path& directory, const Case& c, bool overwrite) {
  // What the case reads comes along, so that the directory can be moved and the run resumed.
  Case own = c;
  Files profiles;
  for_each_profile(own, [&](fs::path& profile, std::string_view stem) {
    profiles.emplace_back(fmt::format("{}_{}.csv", stem, profiles.size()), text_of(profile));
    profile = profiles.back().first;
  });
  const std::string text = write_case(own);
  if (fs::exists(directory) && !fs::is_directory(directory))
    throw std::invalid_argument(fmt::format("{}: is a file; a run needs a directory", directory.string()));
  if (fs::exists(directory) && !fs::is_empty(directory) && !overwrite) {
    const fs::path earlier = directory / "case.toml";
    const std::string why = !fs::exists(earlier)                                      ? "holds files that are no run"
                            : text_of(earlier) != text || !holds(directory, profiles) ? "holds a run of another case"
                            : is_finished(directory) ? "holds this run, finished (brisance report tells of it)"
                            : has_checkpoint(directory)
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
  for (const auto& [name, profile] : profiles) replace_file_by_text(directory / name, profile);
  replace_file_by_text(directory / "case.toml", text);
}

void set_end_time(const fs::path& directory, Case c, double end_time) {
  c.output.history_interval = row_interval(c);
  c.end_time = end_time;
  c.subtitle = std::regex_replace(c.subtitle, std::regex("\\bend_time=[^,]*"), fmt::format("end_time={:.6g} s", end_time));
  for_each_profile(c, [&](fs::path& profile, std::string_view) {  // what came along stays beside the case
    std::error_code elsewhere;
    if (fs::equivalent(profile.parent_path(), directory, elsewhere)) profile = profile.filename();
  });
  replace_file_by_text(directory / "case.toml", write_case(c));
}

std::vector<std::string> read_log(const fs::path& path) {
  std::vector<std::string> lines;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const auto time_ends = line.find(after_time);
    lines.push_back(time_ends == std::string::npos ? line : line.substr(time_ends + after_time.size()));
  }
  return lines;
}

Log::Log(const fs::path& path, double wall_time_before) : out_(path, std::ios::app), before_(wall_time_before) {}

double Log::wall_time() const {
  return before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Log::line(const std::string& text) {
  out_ << fmt::format("{:10.2f}{}{}\n", wall_time(), after_time, text) << std::flush;
}

}  // namespace brisance::simulator
