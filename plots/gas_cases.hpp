#pragma once
// The cases that are compared with exact solutions, and what each must reach.

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gas_measures.hpp"

namespace brisance::simulator {

struct Goal {
  std::string text;
  double limit;
  Measure measure;
  bool at_least = false;
};
/// Numbers that are read on the way, so many times; the first is drawn over time, with what it should be.
struct Watch {
  int parts = 1;
  std::string label;
  std::function<std::vector<double>(const Simulation&)> read;
  std::function<double(const Watched&, double time)> exact;
  double per_si = 1.0;  // of what is drawn
};
struct Entry {
  std::string name, file;
  std::vector<std::string> changes;
  std::string field;  // that the figure of all shows, of the first of the case's figures
  std::vector<Goal> goals;
  std::optional<Watch> watch{};
};

inline constexpr double reported = std::numeric_limits<double>::infinity();  // a limit of what is on record without a goal

// Numbers of one run that are compared with those of another.
inline constexpr const char *front_radius = "radius of the front", *peak_density = "peak of the density";

/// All runs, in the order of the table.
std::vector<Entry> entries();

}  // namespace brisance::simulator
