#pragma once
// What a step of a gas with bodies in it is made of: what lagrangian.cpp and remap.cpp do axis by axis is done for all axes at
// once, because the volumes between the sweeps of a split remap need not be positive in cells that a wall cuts. All of it works
// on the columns of the window (StepFields).

#include <limits>

#include "simulator/gas/window_lanes.hpp"

namespace brisance::simulator::gas::unsplit {

using Index = std::array<int, 3>;

// bodies_window.cpp

/// Takes the state at the start of the step into the window, from all ranks, and what lies beyond the box.
void take_state(Gas& gas, Domain& domain);

// bodies_lagrangian.cpp

/// Pressure and velocity at the middle of the step, from the slopes in each cell.
void half_step(Gas& gas, double dt);
/// Faces between two cells of which one does without slopes.
LanesMask first_order_face(const Gas& gas, std::size_t low, std::size_t high);
/// Pressure of each face, and the volume that flows through it.
void find_faces(Gas& gas, double dt);
/// What the faces do to each cell before anything is carried along: volume, momentum, energy.
void push_cells(Gas& gas, double dt);
/// Mass of the fluids of eight cells, kg, per whole cell.
Lanes whole_mass(const Gas& gas, std::size_t n);
/// The weight of the gas, after the walls have pushed: in cells that they cut they have held it up (push_by_walls), and what
/// remains of it here is its work.
void pull_by_gravity(Gas& gas, double dt);
/// Friction between the rows of whole cells that a shock runs along (friction.hpp), after the walls have pushed.
void hold_rows_together(Gas& gas, double dt);
/// The fluids of a cell share its change of volume and energy by their compressibility.
void share_changes(Gas& gas);

// bodies_walls.cpp

/// Pushes the cells that walls cut; returns what they give to the bodies, one of each cut cell.
std::vector<Received> push_by_walls(Gas& gas, double dt);
/// Sums what each body has received, and gives back to the gas what the work of the wall's pressure exceeds the work on a body
/// that the gas drives by: to each cell as it has pushed. Also sets the bodies' next velocities.
void push_bodies(Gas& gas, const std::vector<Received>& received, double dt, Domain& domain);

// bodies_meeting.cpp

/// A pair of things that are about to meet, the first pair of all: of two bodies, or of a body and a side of the box.
struct Meeting {
  static constexpr int none = std::numeric_limits<int>::max();
  std::pair<int, int> pair{none, none};  // a body, and another one or a side
  void note(const std::pair<int, int>& other) { pair = std::min(pair, other); }
  static int of_side(std::size_t side) { return -1 - static_cast<int>(side); }
};
/// Bodies that close in on a side of the box, and on each other.
void note_meetings(const Gas& gas, Meeting& meeting);
/// Two bodies that have closed a cell, with its gas in it, between them.
void note_bodies_around(const Bodies& bodies, const Index& cell, Meeting& meeting);
/// Ends the run on all ranks alike if something meets on one of them. True if it meets because the step is far too long: then
/// nothing is known.
bool bodies_meet(const Gas& gas, const Meeting& meeting, double dt, Domain& domain);
/// Whether the gas of some own cell has left through one face and come in through another while the wall passed: it would be
/// carried through a thin wall. In a shorter step the cell is closed in between.
bool gas_changes_sides(const Gas& gas);

// bodies_remap.cpp

/// The moved gas as it leaves through the faces: of each cell, or of the neighbourhood of a small one.
void find_donors(Gas& gas);
/// Whether no own cell gives more than it has. Marks those that do.
bool nothing_is_overdrawn(Gas& gas, double dt);
/// New contents of the window's cells, by whole cell; in cells without gas what they held. Returns how many slopes of own cells
/// have been taken back.
std::int64_t remap(Gas& gas, double dt);
/// Redistributes what small cells hold; adds what has been entrapped in own cells, and by which bodies.
void redistribute_all(Gas& gas, std::vector<double>& entrapped, Meeting& meeting);

// bodies_books.cpp

/// Calls f(passage, sign, axis, n) for the faces of own cells on the sides of the box: the sign is that of what enters along
/// the axis, n the number of the face's high cell.
template <class F>
void for_each_side_face(Gas& gas, F&& f) {
  const auto D = static_cast<std::size_t>(gas.dimensions());
  for (Passage& passage : gas.passages) {
    if (passage.side >= 2 * gas.dimensions()) continue;
    const auto a = static_cast<std::size_t>(passage.side / 2);
    const bool low = passage.side % 2 == 0;
    const Index corner = gas.cells.corner(static_cast<std::size_t>(passage.block));
    Part layer;
    for (std::size_t b = 0; b < 3; ++b) {
      layer.lower[b] = b < D ? std::max(corner[b], gas.cells.lower[b]) : 0;
      layer.upper[b] = b < D ? std::min(corner[b] + line, gas.cells.upper[b]) : 1;
    }
    layer.lower[a] = low ? gas.cells.lower[a] : gas.cells.upper[a], layer.upper[a] = layer.lower[a] + 1;
    for_each_cell_of(layer, [&](const Index& face) { f(passage, low ? 1.0 : -1.0, a, gas.bodies.window.at(face)); });
  }
}

/// Whether every own cell with gas has mass and more energy than the coldest gas. Marks those that have not.
bool all_is_well(Gas& gas);
/// Books what passes the sides of the box.
void book_sides(Gas& gas, double dt);
/// The cells as they are at the end of the step.
void keep(Gas& gas);

}  // namespace brisance::simulator::gas::unsplit
