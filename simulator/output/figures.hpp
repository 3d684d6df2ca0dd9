#pragma once
// Figures of a run, drawn into its directory: the books and the gauges against time, a field, deformed profiles against
// measured ones, fields along lines.

#include <filesystem>
#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Draws energy.png and gauges.png from history.csv, field.png, profile_<body>.png for every body with measures, and
/// line_<name>.png for every figure of the case. A figure that fails is no reason to fail: returns one line for each of those.
std::vector<std::string> draw_figures(const Case& c, const Simulation& s, const std::filesystem::path& directory);

}  // namespace brisance::simulator
