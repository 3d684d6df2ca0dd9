#pragma once
// The directory of a run and its log.

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator {

/// Makes the directory of a new run and writes case.toml, with the profiles that it names beside it. Throws
/// std::invalid_argument if it holds anything that is worth something, unless that may be overwritten: files that are no run, a
/// run of another case (it says what differs), this run, whatever its end, if it has finished or left a checkpoint. What does
/// not look like the output of a run is never removed.
void prepare_directory(const std::filesystem::path& directory, const Case& c, bool overwrite);

/// log.txt: lines with the time since the start. Where a log is there already, its clock goes on. It never throws: what the log
/// cannot hold is no reason to end a run.
class Log {
 public:
  explicit Log(const std::filesystem::path& path);
  void line(const std::string& text);
  double wall_time() const;  // s, of this run and of those it goes on from

 private:
  double before_;  // s, of the runs that this one goes on from
  std::ofstream out_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The lines of a log without their times; none if there is no log.
std::vector<std::string> read_log(const std::filesystem::path& path);

/// A case that lasts until a later time, s; the case itself if that is not later.
Case lasting(Case c, double end_time);
/// Writes a case that was read from the directory of a run, and changed since, back to it.
void replace_case(const std::filesystem::path& directory, Case c);

}  // namespace brisance::simulator
