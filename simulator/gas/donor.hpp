#pragma once
// What leaves a cell through a face, and how its fluids share a change of volume: the formulas that the steps with and without
// bodies have in common (remap.cpp, lagrangian.cpp, bodies_remap.cpp, bodies_lagrangian.cpp).

#include "simulator/gas/limiter.hpp"

namespace brisance::simulator::gas {

/// Of its volume a cell keeps more than this part in the Lagrangian phase, or the step is too long for it.
inline constexpr double least_volume_ratio = 0.2;

/// Difference across the donor of a face, of the values in the two cells on either side of it (before, low, high, after); `up`:
/// the low one gives. Third order where the field is smooth, steep where it jumps; see limiter.hpp.
inline Lanes difference_across_donor(const LanesMask& up, const Lanes& before, const Lanes& low, const Lanes& high,
                                     const Lanes& after, const Lanes& part) {
  constexpr double least_jump = 0.05;
  const Lanes ahead = select(up, high - low, low - high), behind = select(up, low - before, high - after);
  const Lanes half_bound = min(abs(behind) / max(part, Lanes(smallest_part)), abs(ahead) / (1.0 - part));
  return steep_within_bounds(third_order_difference(behind, ahead, part), behind, ahead,
                             jump(select(up, low, high), behind, ahead, least_jump), half_bound);
}
/// The same for what is one fluid everywhere, with so much (0 to 1) of what makes it fourth order; jumps are made steep to the
/// part `steepening`. Waves of short length are smooth here that would become stairs there.
inline Lanes difference_across_donor(const LanesMask& up, const Lanes& before, const Lanes& low, const Lanes& high,
                                     const Lanes& after, const Lanes& part, const Lanes& fourth_order,
                                     const Lanes& steepening) {
  constexpr double least_jump = 1.0 / 12.0;
  const Lanes ahead = select(up, high - low, low - high), behind = select(up, low - before, high - after);
  const Lanes further = select(up, after - high, before - low);
  const Lanes smooth =
      third_order_difference(behind, ahead, part) + fourth_order * fourth_order_change(behind, ahead, further, part);
  const Lanes half_bound = min(abs(behind) * (1.0 / max(part, Lanes(smallest_part))), abs(ahead) * (1.0 / (1.0 - part)));
  return steep_within_bounds(smooth, behind, ahead, steepening * jump(select(up, low, high), behind, ahead, least_jump),
                             half_bound);
}

/// A fluid with more than this part of a cell fills it.
inline constexpr double nearly_all = 1.0 - 1e-6;

/// Whether a fluid has slopes in a donor, by its parts of the volumes of the cell behind, of the donor and of the cell ahead:
/// it fills the donor, or there is about as much of it on both sides. At its edge a fluid is alike in all that a cell has of
/// it. With slopes there, the front of products that expand into air grew thinner from cell to cell, at the pressure of the
/// cell, to 1e-12 kg/m^3 and millions of kelvins, and the steps shorter without end.
inline LanesMask has_slopes(const Lanes& behind, const Lanes& here, const Lanes& ahead) {
  constexpr double least = 0.3;  // change of its part from cell to cell, of the part itself, that makes an edge
  return (here > nearly_all) | (max(abs(behind - here), abs(ahead - here)) <= least * here);
}

/// 0 in shocks, 1 away from them, by the internal energies (J/m^3) about a face: a shock is where these change by two to four
/// tenths of the donor's from cell to cell, and the cells beside the face approach each other: `approach`, density times the
/// square of the velocity's jump (J/m^3; 0 where they part), is then more than a hundredth of that change. Contacts are none.
inline Lanes away_from_shocks(const LanesMask& up, const Lanes& before, const Lanes& low, const Lanes& high, const Lanes& after,
                              const Lanes& approach) {
  constexpr double least = 0.2, most = 0.4, least_approach = 0.01;
  const Lanes largest = max(Lanes(max(abs(high - low), max(abs(low - before), abs(after - high)))), Lanes(1e-300));
  const Lanes donor = max(Lanes(abs(select(up, low, high))), Lanes(1e-300));
  const LanesMask shocks = (largest > least * donor) & (approach > 0.0);
  if (none(shocks)) return Lanes(1.0);
  const Lanes jump = min(Lanes((1.0 / (most - least)) * (largest / donor - least)), Lanes(1.0));
  return select(shocks, 1.0 - jump * min(Lanes((1.0 / least_approach) * (approach / largest)), Lanes(1.0)), Lanes(1.0));
}

/// How a part of a cell's mass leaves with its momentum.
struct Leaving {
  Lanes offset;         // cells from the middle, along the axis: where its velocity is taken
  Lanes heat_kept;      // part of the heat
  LanesMask too_steep;  // the slopes have been taken back
};
/// The parts of a cell move with different velocities, and their kinetic energies together exceed that of the whole. The heat
/// of both parts pays for it. Where that would be more than half of it the slopes are taken back. `steepness`: sum of the
/// squares of the velocity's slopes; `heat`: internal energy, J/m^3; `order`: 0 without slopes, 1 with them.
inline Leaving leaving_with_momentum(const LanesMask& up, const Lanes& part, const Lanes& density, const Lanes& steepness,
                                     const Lanes& heat, const Lanes& order) {
  constexpr double most = 0.5;
  const Lanes cost = 0.125 * part * (1.0 - part) * density * steepness, held = max(heat, Lanes(0.0));
  const LanesMask too_steep = cost > most * held;
  Lanes offset = order * select(up, Lanes(0.5 * (1.0 - part)), Lanes(-0.5 * (1.0 - part)));
  if (any(too_steep)) offset = select(too_steep, offset * sqrt(most * held / max(cost, Lanes(1e-300))), offset);
  return {offset, 1.0 - min(cost, Lanes(most * held)) / max(held, Lanes(1e-300)), too_steep};
}

/// Whether slopes that have been taken back could be noticed, and are counted: not where the velocity changes by less than a
/// thousandth of the speed of sound (m/s) from cell to cell. What has no heat to begin with, as an explosive whose energy
/// counts from its state at rest, pays for no slope, however small: the least sound in it would be counted.
inline LanesMask noticeable(const Lanes& steepness, const Lanes& sound_speed) {
  constexpr double least = 1e-3;
  return steepness > least * least * sound_speed * sound_speed;
}

/// The part of its cell's growth in volume that a fluid takes, beside that with most volume. A little gas in a liquid would
/// take all of it, more than it has: it takes no more than its half or double, and the rest goes to the fluid with most volume;
/// the next equilibrium finds what is right.
inline Lanes limited_share(const Lanes& wanted, const Lanes& growth, const Lanes& volume) {
  const Lanes most = select(growth < 0.0, Lanes(0.5), Lanes(1.0)) * volume / max(abs(growth), Lanes(1e-300));
  return min(wanted, max(most, Lanes(0.0)));
}

}  // namespace brisance::simulator::gas
