#pragma once
// What the validations share: running a case, statements that must hold, and the version they hold for.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/run.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// A case that has been run.
struct Ran {
  Case config;
  Simulation simulation;  // at the end
  RunResult result;
};
/// Runs data/cases/<file>.toml with changes ("cell_size=1 mm") into a directory, over what is there.
Ran run_case(const std::string& file, const std::vector<std::string>& changes, const std::filesystem::path& directory);
/// The same in so many parts of equal time; `look` sees the simulation at the start and after each of them.
Ran run_case(const std::string& file, const std::vector<std::string>& changes, const std::filesystem::path& directory,
             int parts, const std::function<void(const Simulation&)>& look);

/// A statement that must hold, with the number it rests on.
struct Check {
  std::string text;
  double value, limit;
  bool at_least = false;  // otherwise at most
  bool holds() const { return at_least ? value >= limit : value <= limit; }
};
std::string table(const std::vector<Check>& all);

/// Of the working copy, shortened; "unknown" outside one.
std::string commit_hash();

}  // namespace brisance::simulator
