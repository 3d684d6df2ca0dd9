#pragma once
// What the gauges of a run have seen, as history.csv keeps it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator {

/// One number of a gauge over time.
struct GaugeSeries {
  std::string name;  // of its column, without the first word: GAUGE_FIELD, of a vector with _x, of a line with _00
  std::string gauge;
  std::optional<std::size_t> place;  // of a line: which of its places, from 0 on
  std::string field;                 // FIELD, of a vector with _x
  std::string unit;
  std::vector<double> time, value;  // s, SI; rows without material are left out
};

/// The series of all gauges of the case in a directory's history.csv. Throws InputError if it cannot be read.
std::vector<GaugeSeries> read_gauges(const Case& c, const std::filesystem::path& directory);

/// The value of largest magnitude among the rows, with its sign.
struct GaugePeak {
  std::string name, unit;
  double value = 0.0, time = 0.0;
};
/// In the order of the series; those without a row are left out.
std::vector<GaugePeak> peaks_of(const std::vector<GaugeSeries>& series);

}  // namespace brisance::simulator
