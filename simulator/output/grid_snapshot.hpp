#pragma once
// Fields on the grid for ParaView: VTK XML image data, one file for each time, and a collection that lists them with their
// times. Format: VTK User's Guide, "VTK File Formats"; ImageData, version 1.0, raw appended data in blocks packed by zlib.

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Numbers at the nodes or in the cells of an image: x runs fastest, components stand side by side.
struct ImageField {
  std::string name;
  int components;
  std::vector<double> values;
};

/// A box of a uniform grid. Node (i, j, k), from `lower` to `upper` with both included, is at origin + (i, j, k) spacing; along
/// an axis with a single layer of nodes the image is flat, and cells are the faces or edges between the others.
struct ImageData {
  Vector origin{}, spacing{};  // m
  std::array<int, 3> lower{}, upper{};
  std::vector<ImageField> point_fields, cell_fields;

  std::size_t points() const;
  std::size_t cells() const;
  /// Where the numbers of node (i, j, k) stand in the point fields.
  std::size_t point(const std::array<int, 3>& index) const;
};

/// Writes an image with its time (s) as a sealed .vti file that appears complete or not at all. Throws std::invalid_argument if
/// a field has not as many numbers as the image has places, std::runtime_error if the file cannot be written.
void write_image(const std::filesystem::path& path, const ImageData& image, double time);

/// Writes the image of the last of `times` into a directory, and the collection of all so far: "NAME_000042.vti", "NAME.pvd".
void write_grid_snapshot(const std::filesystem::path& directory, const std::string& name, const ImageData& image,
                         const std::vector<double>& times);
std::string grid_snapshot_name(const std::string& name, std::size_t number);

/// What the particles give the nodes: mass (kg; in the plane geometry per m), velocity (m/s; half a step behind, as that of the
/// particles) and force (N, N/m) without that of boundaries, in the box of the nodes with mass. Where there is no mass all is
/// zero. If there are several velocity fields the names end in their number. Of the simulation only the grid's sums and motion
/// are overwritten, which every step makes anew. Throws std::runtime_error if the box is too large to be written.
ImageData solid_image(Simulation& s);

/// The fields of the gas in the cells of its box.
ImageData gas_image(const Simulation& s);

/// Under which the gas's image stands in the directory of a run.
inline const std::string gas_grid = "gas";
/// Under which the solid's image stands in the directory of a run.
inline const std::string solid_grid = "solid_grid";

}  // namespace brisance::simulator
