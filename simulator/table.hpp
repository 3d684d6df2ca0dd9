#pragma once
// What tables over time need beyond their value.

#include <algorithm>
#include <cstddef>

#include "models/parameters.hpp"

namespace brisance::simulator {

/// Integral of a table, linear between its knots and constant outside, from 0 to x.
inline double integral(const Table& table, double x) {
  const auto from_first_knot = [&](double to) {
    if (to <= table.x[0]) return (to - table.x[0]) * table.y[0];
    double sum = 0.0, from = table.x[0];
    for (int i = 1; i < table.size && from < to; ++i) {
      const double end = std::min(to, table.x[static_cast<std::size_t>(i)]);
      sum += 0.5 * (table(from) + table(end)) * (end - from);
      from = end;
    }
    return sum + (to - from) * table(to);
  };
  return from_first_knot(x) - from_first_knot(0.0);
}

}  // namespace brisance::simulator
