#pragma once
// Checkpoints: all that a simulation is, so that a run that continues from one gives the bits of a run that never stopped. Two
// files take turns; each is complete or is known not to be.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// What a run directory holds at the time of a checkpoint.
struct RunProgress {
  double wall_time = 0.0;  // s, spent so far
  std::int64_t history_rows = 0;
  double row_time = -1.0;              // s, of the last row
  std::vector<double> snapshot_times;  // s
  std::vector<double> measures{};      // as Measures keeps them
};

/// Writes a checkpoint in place of the older of the two in a directory and returns its path. If that fails, the newer one is as
/// it was. Throws std::runtime_error.
std::filesystem::path write_checkpoint(const std::filesystem::path& directory, const Simulation& s,
                                       const RunProgress& progress);

/// Gives a simulation, set up from the same case, the state of the newest checkpoint that is whole. `report` is told what is
/// wrong with one that is not. Throws std::runtime_error if there is none.
struct Restored {
  std::filesystem::path file;
  RunProgress progress;
};
Restored restore_newest(const std::filesystem::path& directory, Simulation& s,
                        const std::function<void(const std::string&)>& report = {});

/// The paths of the two checkpoints of a directory, whether they exist or not.
std::vector<std::filesystem::path> checkpoint_paths(const std::filesystem::path& directory);

/// Whether a run in this directory has come as far as its first checkpoint.
bool has_checkpoint(const std::filesystem::path& directory);

}  // namespace brisance::simulator
