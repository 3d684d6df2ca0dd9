#pragma once
// Fields along a line: as they are in a simulation, and as a file says they should be.

#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

struct LineOut {
  std::string coordinate;                   // x, y or z along an axis; else the distance from the first end
  std::vector<double> place;                // m
  std::vector<std::vector<double>> values;  // SI, of each field of the figure at each place; empty if there are none
};

/// The particles no farther than half a cell from the line, or the cells of gas that it crosses, in the order of their places.
/// Of a vector the component along the line.
LineOut line_out(const Simulation& s, const FigureConfig& figure);

/// The unit of a field of solids or gas.
std::string unit_of_field(const std::string& name);

/// The columns of the figure's reference that are named as the coordinate and as its fields. Throws InputError if the file
/// cannot be read, or has no coordinate or none of the fields.
LineOut read_reference(const FigureConfig& figure);

/// A reference without what lies inside bodies in the gas: where two neighbouring cells of what was computed are farther apart
/// than 1.5 cells, the reference is interrupted by a place that is no number. Its places rise.
LineOut outside_bodies(const LineOut& reference, const LineOut& computed, double cell_size);

}  // namespace brisance::simulator
