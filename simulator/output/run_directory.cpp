#include "simulator/output/run_directory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <span>
#include <stdexcept>

#include "models/input/diagnostics.hpp"
#include "models/input/toml_tree.hpp"
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

/// The values of a file by their paths, as --set names them.
using Values = std::map<std::string, std::string>;
std::string value_text(const TomlNode& node) {
  if (const auto* const number = std::get_if<double>(&node.value)) return shortest_text(*number);
  if (const auto* const integer = std::get_if<std::int64_t>(&node.value)) return std::to_string(*integer);
  if (const auto* const flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
  if (const auto* const text = std::get_if<std::string>(&node.value)) return in_quotes(*text);
  const auto* const list = std::get_if<TomlList>(&node.value);
  if (!list) return kind_of(node);  // which no case that has been run holds
  std::string elements;
  for (const TomlNode& element : *list) elements += (elements.empty() ? "" : ", ") + value_text(element);
  return '[' + elements + ']';
}
void collect(const TomlNode& node, const std::string& path, Values& values) {
  const auto* const list = std::get_if<TomlList>(&node.value);
  if (const auto* const table = std::get_if<TomlTable>(&node.value)) {
    for (const TomlEntry& entry : table->entries) collect(entry.node, joined(path, entry.key), values);
  } else if (list && !list->empty() && std::holds_alternative<TomlTable>(list->front().value)) {
    for (std::size_t i = 0; i < list->size(); ++i) collect((*list)[i], joined(path, std::to_string(i)), values);
  } else {
    values[path] = value_text(node);
  }
}
Values values_of(const std::string& text, const fs::path& file) {
  Values values;
  collect(parse_toml(text, file.string()), "", values);
  values.erase("set");  // it says what led to the values
  return values;
}

/// What differs between two cases, and by what: "cell_size is 0.001 there, not 0.002". Empty if nothing does.
std::vector<std::string> differences(const Values& there, const Values& here) {
  std::vector<std::string> all;
  const auto in = [](const Values& values, const std::string& path) {
    const auto found = values.find(path);
    return found == values.end() ? "missing" : found->second;
  };
  Values paths = there;
  paths.insert(here.begin(), here.end());
  for (const auto& [path, value] : paths)
    if (in(there, path) != in(here, path))
      all.push_back(fmt::format("{} is {} there, not {}", path, in(there, path), in(here, path)));
  return all;
}

/// Why the directory of an earlier run is not to be used for this case; empty if nothing in it is worth anything.
std::string why_kept(const fs::path& directory, const std::string& text, const Files& profiles) {
  const fs::path earlier = directory / "case.toml";
  if (!fs::exists(earlier)) return "holds files that are no run";
  std::vector<std::string> different;
  std::string ends;  // until another time it is the same run
  try {
    Values there = values_of(text_of(earlier), earlier), here = values_of(text, "case.toml");
    if (there["end_time"] != here["end_time"])
      ends = fmt::format(" with its end at {} s, not {} s", there["end_time"], here["end_time"]);
    there.erase("end_time"), here.erase("end_time");
    different = differences(there, here);
  } catch (const InputError& error) {
    return fmt::format("holds a run whose case cannot be read ({})", error.what());
  }
  for (const auto& [name, content] : profiles)
    if (text_of(directory / name) != content) different.push_back(name + " holds something else there");
  if (!different.empty()) {
    constexpr std::size_t most_told = 5;
    const std::size_t told = std::min(different.size(), most_told);
    return fmt::format("holds a run of another case: {}{}", fmt::join(std::span(different).first(told), "; "),
                       different.size() > told ? fmt::format("; and {} more", different.size() - told) : "");
  }
  const bool finished = is_finished(directory);
  if (!finished && !has_checkpoint(directory)) return "";
  if (!ends.empty()) return "holds this run" + ends + " (brisance resume --until goes on with it to a later time)";
  return finished ? "holds this run, finished (brisance report tells of it)"
                  : "holds a run that has not come to its end (brisance resume goes on with it)";
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
    if (const std::string why = why_kept(directory, text, profiles); !why.empty())
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

Case lasting(Case c, double end_time) {
  if (!(end_time > c.end_time)) return c;
  c.end_time = end_time;
  for (std::string& change : c.set)
    if (change.starts_with("end_time=")) change = fmt::format("end_time={:.6g} s", end_time);
  return c;
}

void replace_case(const fs::path& directory, Case c) {
  for_each_profile(c, [&](fs::path& profile, std::string_view) {  // what came along stays beside the case
    std::error_code elsewhere;
    if (fs::equivalent(profile.parent_path(), directory, elsewhere)) profile = profile.filename();
  });
  replace_file_by_text(directory / "case.toml", write_case(c));
}

/// The time of the last line of a log, s; 0 if there is none.
double last_time_in(const fs::path& path) {
  double time = 0.0;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    if (const auto time_ends = line.find(after_time); time_ends != std::string::npos)
      time = std::max(time, std::strtod(line.c_str(), nullptr));
  return time;
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

Log::Log(const fs::path& path) : before_(last_time_in(path)), out_(path, std::ios::app) {}

double Log::wall_time() const {
  return before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Log::line(const std::string& text) {
  out_ << fmt::format("{:10.2f}{}{}\n", wall_time(), after_time, text) << std::flush;
}

}  // namespace brisance::simulator
