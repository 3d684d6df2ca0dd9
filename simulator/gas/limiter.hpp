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

// Differences across a donor cell, in the direction of the flow, such that value + (1 - part)/2 difference is the mean of the
// part that leaves it. behind: the cell less the one it turns its back to; ahead: the next one less the cell; further: the one
// after that less the next one.

inline Lanes third_order_difference(const Lanes& behind, const Lanes& ahead, const Lanes& part) {
  return (1.0 / 3.0) * ((2.0 - part) * ahead + (1.0 + part) * behind);
}
/// What makes it one of fourth order.
inline Lanes fourth_order_change(const Lanes& behind, const Lanes& ahead, const Lanes& further, const Lanes& part) {
  return (-1.0 / 12.0) * (1.0 + part) * (2.0 - part) * (further - 2.0 * ahead + behind);
}

/// Contacts spread over ever more cells unless they are held together. 0 where a field changes by less than a part of itself
/// from cell to cell, as smooth things do, 1 from three times that on.
inline Lanes jump(const Lanes& value, const Lanes& behind, const Lanes& ahead, double least) {
  const Lanes larger = max(abs(ahead), abs(behind)), all = abs(value);
  const LanesMask jumps = larger > least * all;
  if (none(jumps)) return Lanes(0.0);  // nearly everywhere, and without a division
  return select(jumps, min(Lanes((0.5 / least) * larger / all - 0.5), Lanes(1.0)), Lanes(0.0));
}

inline constexpr double smallest_part = 0.1;  // against a division by nothing; there what stays is nearly everything

/// With so much (0 to 1) of the larger of the two differences as is `steepened`, such that neither what leaves nor what stays
/// makes a new extreme: twice behind/part and ahead/(1 - part) are the bounds (Arora & Roe, J. Comput. Phys. 132 (1997) 3).
inline Lanes steep_within_bounds(const Lanes& smooth, const Lanes& behind, const Lanes& ahead, const Lanes& steepened,
                                 const Lanes& half_bound) {
  const Lanes size = select(ahead < 0.0, -smooth, smooth), larger = max(abs(ahead), abs(behind));
  const Lanes wanted = size + steepened * max(Lanes(larger - size), Lanes(0.0));
  const Lanes bounded = min(max(wanted, Lanes(0.0)), Lanes(2.0 * half_bound));
  return select(behind * ahead > 0.0, select(ahead < 0.0, -bounded, bounded), Lanes(0.0));
}

}  // namespace brisance::simulator::gas
