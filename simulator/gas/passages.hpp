#pragma once
// The books of the box's sides: what passes them, pencil by pencil.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Finds the faces of own blocks on the sides of the box.
void open_passages(Gas& gas);
/// Forgets what a step that was rejected has noted; books what one that is done has.
void clear_step(std::vector<Passage>& passages);
void book_step(std::vector<Passage>& passages);

/// Calls f(passage, sign, lanes) for the sides of the box that cross a pencil: the sign is that of what enters along the axis,
/// the bits of `lanes` tell the lines of the pencil that lie within the box.
template <class F>
void for_each_passage(Gas& gas, std::size_t block, int axis, int n, F&& f) {
  for (int s = 0; s < 2; ++s) {
    const std::int32_t p = gas.passage_of[block][static_cast<std::size_t>(2 * axis + s)];
    if (p < 0) continue;
    Passage& passage = gas.passages[static_cast<std::size_t>(p)];
    f(passage, s == 0 ? 1.0 : -1.0, passage.lanes[static_cast<std::size_t>(n)]);
  }
}

/// Impulse and work of the pressure on the sides of the box, by its force along the axis (N) and its power (W).
template <class FaceValues>
void book_pressure(Gas& gas, std::size_t block, int axis, int n, double dt, const FaceValues& force, const FaceValues& power) {
  for_each_passage(gas, block, axis, n, [&](Passage& passage, double sign, std::uint8_t lanes) {
    const auto f = static_cast<std::size_t>(passage.face);
    for (int l = 0; l < 8; ++l) {
      if (!(lanes >> l & 1)) continue;
      passage.step.momentum[static_cast<std::size_t>(axis)] += sign * dt * force[f][l];
      passage.step.energy += sign * dt * power[f][l];
    }
  });
}

}  // namespace brisance::simulator::gas
