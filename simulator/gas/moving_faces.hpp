#pragma once
// Faces that move with the gas grow and tilt on their way. In the middle of a step the area of the face across axis a is, as a
// vector,
//
//     A_a (1 + dt/2 sum over b != a of du_b/dx_b)   along a,     - A_a dt/2 du_a/dx_b   along b,
//
// and what it sweeps in the step is dt u . A. Without these terms the volume that a cell has after the Lagrangian phase lacks
// dt^2 (the second invariant of grad u), and the pressure pushes where the faces were: errors of first order in the step.
// Tests: MovingFaces in tests/simulator/gas/smooth_flow_verification.cpp.
//
// The derivatives are central differences, not limited, so that the areas of a cell sum up to nothing: a pressure that is the
// same everywhere does not push.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// What the faces of a pencil have gained in the middle of the step, in parts of their areas: means of what their cells have.
template <int D>
struct FaceGain {
  FacePencil along[D];  // the pencil's own axis: growth; the others: tilt

  FaceGain(const Gas& gas, std::size_t block, int axis, int n) {
    for (int b = 0; b < D; ++b) {
      Pencil gain;
      load<D>(gas.cells, gas.half_step, block, HalfStep::area(D, axis, b), axis, n, gain);
      for (std::size_t f = 0; f < line_faces; ++f) along[b][f] = 0.5 * (gain[ring + f - 1] + gain[ring + f]);
    }
  }
  void forget(std::size_t face, const LanesMask& where) {
    for (FacePencil& gain : along) gain[face] = select(where, Lanes(0.0), gain[face]);
  }
};

/// Differences of the velocities along an axis over the cells of a pencil, for half a step (s): the part by which the cells
/// grow along it, and for each other component how far faces across that component's axis tilt.
template <int D>
void note_gains(Gas& gas, std::size_t block, int axis, int n, double dt) {
  const double factor = 0.5 * dt / gas.cells.cell_size;
  for (int a = 0; a < D; ++a) {
    Pencil u, gain;
    load<D>(gas.cells, gas.primitive, block, Primitive::velocity + a, axis, n, u);
    if (a == axis && axis == 0 && is_round(gas.cells.geometry)) {
      PencilMetric metric;
      load_metric<D>(gas.cells, block, axis, n, metric);
      for (std::size_t f = 0; f < line; ++f) {
        const std::size_t c = ring + f;
        gain[c] =
            (0.25 * dt) * (metric.area[f + 1] * (u[c] + u[c + 1]) - metric.area[f] * (u[c - 1] + u[c])) / metric.volume[c];
      }
    } else {
      const double sign = a == axis ? 0.5 * factor : -0.5 * factor;
      for (std::size_t c = ring; c < ring + line; ++c) gain[c] = sign * (u[c + 1] - u[c - 1]);
    }
    store<D>(gas.half_step, block, HalfStep::area(D, a, axis), axis, n, gain);
  }
}
/// Asks the memory for what that reads and writes of the next pencil.
template <int D>
[[gnu::always_inline]] inline void ask_for_gains(const Gas& gas, const NextPencil<D>& next, int axis, std::size_t part) {
  for (int a = 0; a < D; ++a) {
    if (a != axis) next.fetch(gas.primitive, Primitive::velocity + a, 1, part);
    next.fetch_to_write(gas.half_step, HalfStep::area(D, a, axis), 1, part);
  }
}
/// Gains of the cells of a pack from the differences along all axes. A face grows by what its cells grow along the other axes.
/// A shock is of first order anyway, and with the gain it is less round: where the gas closes by more than 5 % of the speed of
/// sound over a cell the gain falls, to none at 10 %. `closing`: that over the sound speed, negative where gas parts.
template <int D>
void find_gains(Gas& gas, std::size_t block, int pack, const Lanes& closing) {
  const auto at = [&](int across, int towards) -> Lanes& {
    return gas.half_step.at(block, HalfStep::area(D, across, towards))[pack];
  };
  if constexpr (D == 2) {
    std::swap(at(0, 0), at(1, 1));
  } else {
    const Lanes x = at(0, 0), y = at(1, 1), z = at(2, 2);
    at(0, 0) = y + z, at(1, 1) = z + x, at(2, 2) = x + y;
  }
  constexpr double least = 0.05, most = 0.1;
  if (!any(closing > least)) return;
  const Lanes part = min(max(Lanes((most - closing) * (1.0 / (most - least))), Lanes(0.0)), Lanes(1.0));
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) at(a, b) *= part;
}

}  // namespace brisance::simulator::gas
