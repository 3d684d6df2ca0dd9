#pragma once
// Each figure of a run by itself; those against time are drawn from the tables that the run has written into the directory.

#include <filesystem>

#include "simulator/config.hpp"
#include "simulator/output/figures.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator::figures {

using Path = std::filesystem::path;

/// energy.png: the books of the solids.
void draw_energy(const Case& c, const Path& directory);
/// energy.png: what has changed the energy of the gas since the start.
void draw_gas_energy(const Case& c, const Simulation& s, const Path& directory);
/// bodies.png: how bodies in the gas move, and what drives them.
void draw_gas_bodies(const Case& c, const Simulation& s, const Path& directory);
/// reactions.png: what has burned, and its heat.
void draw_reactions(const Case& c, const Simulation& s, const Path& directory);
/// gauges.png: a panel for each field that gauges have recorded: of those at points, all of them, and another of the places of
/// lines, as many of them, evenly, as there are colours.
void draw_gauges(const Case& c, const Path& directory);
/// field.png: the field of the case, in a plane, with the bodies and the planes that bound them.
void draw_field(const Case& c, const Simulation& s, const Path& directory, Of of);
/// line_<name>.png: the fields of a figure along its line, one below the other.
void draw_line(const Case& c, const Simulation& s, const FigureConfig& config, const Path& directory, Of of);
/// profile_<body>.png: the outline of a body about its axis, whole, with what experiments say.
void draw_profile(const Case& c, const Simulation& s, const MeasureConfig& measure, const Path& directory);

}  // namespace brisance::simulator::figures
