#pragma once
// Figures of histories.

#include <string>
#include <utility>
#include <vector>

#include "driver/history.hpp"
#include "models/programs/figure.hpp"

namespace brisance::driver {

/// A column of a history in units and words for an axis: MPa and microseconds instead of Pa and seconds.
struct Axis {
  std::string label;
  double per_si = 1.0;
};
Axis axis_for(const Record::Series& series);

/// What a run looks like: y against x, and temperature, pressure, porosity and damage where they change.
Figure figure_of(const std::string& title, const std::vector<std::pair<std::string, const Record*>>& runs, const std::string& x,
                 const std::string& y);

}  // namespace brisance::driver
