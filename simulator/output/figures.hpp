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
/// Of a run that has failed field.png and lines show the range of most values, and say so, if a few are ten times as large.
enum class Of { good_run, failed_run };
std::vector<std::string> draw_figures(const Case& c, const Simulation& s, const std::filesystem::path& directory,
                                      Of of = Of::good_run);

}  // namespace brisance::simulator
