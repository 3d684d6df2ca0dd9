#pragma once
// A run: steps until the end, with history, snapshots, checkpoints and gates on the way.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/output/summary.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

enum class Ending { done, failed, interrupted, nothing_left };
/// As summary.json tells it.
std::string word_of(Ending ending);

struct RunOptions {
  std::filesystem::path directory;  // as prepare_directory made it
  std::optional<double> until;      // s, instead of the case's end
  /// Steps of this run; after them it ends as if it had been interrupted.
  std::int64_t most_steps = std::numeric_limits<std::int64_t>::max();
  std::vector<std::string> warnings{};  // of the case, for the log
};

struct RunResult {
  Ending ending = Ending::done;
  std::string message;  // why it failed, with the checkpoint to go on from; why nothing was left to do
  Summary summary;
};

/// The particles of all bodies, or the cells of the gas: what the work of a step is proportional to. And their name, singular.
std::int64_t count_points(const Simulation& s);
std::string_view name_of_points(const Simulation& s);

/// As many threads as the user says; if he says nothing (0, and no OMP_NUM_THREADS) no more than pay.
void use_threads(int threads, const Simulation& s);
/// Runs a simulation that has been set up from the case.
RunResult run(const Case& c, Simulation& s, const RunOptions& options);
/// Goes on from the newest checkpoint in the directory; `s` has been set up from the case and gets its state. If it has come to
/// its end already (or to `until`), nothing is done: the ending is nothing_left and the directory stays as it is.
RunResult resume(const Case& c, Simulation& s, const RunOptions& options);
/// What the newest checkpoint in a directory says, with figures drawn again; `s` has been set up from the case. The message is
/// empty if every figure, snapshot and checkpoint is as it should be.
Summary report(const Case& c, Simulation& s, const std::filesystem::path& directory);

}  // namespace brisance::simulator
