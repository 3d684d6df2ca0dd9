#pragma once
// Slopes that make no new extremes.

#include "simulator/gas/cells.hpp"

namespace brisance::simulator::gas {

/// Monotonised central slope per cell: van Leer, J. Comput. Phys. 23 (1977) 276.
inline Lanes monotonised_central(const Lanes& below, const Lanes& at, const Lanes& above) {
  const Lanes a = at - below, b = above - at;
  const Lanes centre = 0.5 * (a + b);
  const Lanes size = min(abs(centre), 2.0 * min(abs(a), abs(b)));
  return select(a * b > 0.0, select(centre < 0.0, -size, size), Lanes(0.0));
}
inline Lanes slope(const Pencil& q, std::size_t cell) {
  return monotonised_central(q[cell - 1], q[cell], q[cell + 1]);
}

/// Difference across a donor cell, in the direction of the flow, such that value + (1 - part)/2 difference is the mean of the
/// part that leaves it: third order where the field is smooth, steep where it jumps; neither what leaves nor what stays makes a
/// new extreme (Arora & Roe, J. Comput. Phys. 132 (1997) 3). behind: the cell less the one it turns its back to; ahead: the
/// next one less the cell.
inline Lanes upwind_difference(const Lanes& value, const Lanes& behind, const Lanes& ahead, const Lanes& part) {
  const Lanes third_order = abs((1.0 / 3.0) * ((2.0 - part) * ahead + (1.0 + part) * behind));
  const Lanes larger = max(abs(ahead), abs(behind));
  // Contacts spread over ever more cells unless they are held together. What changes by a tenth from cell to cell is none of
  // the smooth things that steepening would spoil.
  const Lanes jump = min(max(Lanes(10.0 * larger / abs(value) - 0.5), Lanes(0.0)), Lanes(1.0));
  const Lanes wanted = third_order + jump * max(Lanes(larger - third_order), Lanes(0.0));
  constexpr double smallest_part = 0.1;  // against a division by nothing; there what stays is nearly everything
  const Lanes bound = 2.0 * min(abs(behind) / max(part, Lanes(smallest_part)), abs(ahead) / (1.0 - part));
  const Lanes size = min(wanted, bound);
  return select(behind * ahead > 0.0, select(ahead < 0.0, -size, size), Lanes(0.0));
}

}  // namespace brisance::simulator::gas
