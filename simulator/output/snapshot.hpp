#pragma once
// Snapshots of the particles for ParaView: VTKHDF 1.0, an unstructured grid of vertices, one file per body and time, and a
// series file that lists them with their times.

#include <filesystem>
#include <string>
#include <vector>

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Writes the snapshot of this number for every body into a directory. `times` are those of all snapshots so far, this one
/// last.
void write_snapshot(const std::filesystem::path& directory, const Simulation& s, const std::vector<double>& times);

/// What is wrong with the first `count` snapshots of a case, those of the grid included: one line for each file that is
/// missing, cut off or changed.
std::vector<std::string> damaged_snapshots(const std::filesystem::path& directory, const Case& c, std::size_t count);

/// The files of a body: "bar_particles_000042.hdf" and "bar_particles.hdf.series".
std::string snapshot_name(const std::string& body, std::size_t number);
std::string series_name(const std::string& body);

}  // namespace brisance::simulator
