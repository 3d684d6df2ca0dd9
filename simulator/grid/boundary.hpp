#pragma once
// Planes of nodes that bound the bodies. Nodes one cell beyond a plane are ghosts: what particles add to them is folded onto
// the nodes inside, and what particles read from them is made from the nodes inside, by the transposed rule.

#include <string>

#include "models/parameters.hpp"
#include "simulator/config.hpp"
#include "simulator/grid/grid.hpp"
#include "simulator/ledger.hpp"

namespace brisance::simulator {

struct Boundary {
  std::string name;
  BoundaryKind kind = BoundaryKind::symmetry;
  int axis = 0;
  int node = 0;           // index of the plane
  int inward = 1;         // +1: the bodies are above
  double position = 0.0;  // m, from the grid's origin; of an outflow in space
  double friction = 0.0;
  Table velocity;             // m/s against s, along the axis; empty: it stands
  bool carries_grid = false;  // the plane travels, and the grid with it

  /// A mirror continues even and odd fields; other planes continue the values linearly, which makes the weights of the plane
  /// interpolate.
  bool is_mirror() const { return kind == BoundaryKind::symmetry; }
  bool has_ghosts() const { return kind != BoundaryKind::outflow; }
};

/// Which rigid walls particles touch at a node is one number, a sum in which every wall has eight bits, by axis and side: it is
/// exact in a double, and no carry reaches the next wall's, because a tile says it once and a node has eight tiles at most,
/// each with its three ghosts folded.
double touch_number(const Boundary& wall);
bool touches(double sum, const Boundary& wall);

/// Folds the ghosts of a tile onto its nodes: what was added to them is added inside.
template <int D>
void fold(const std::vector<Boundary>& boundaries, BlockKey block, Lanes* tile);
/// Gives the ghosts of a tile the velocities that continue those inside.
template <int D>
void unfold(const std::vector<Boundary>& boundaries, BlockKey block, Lanes* tile);

/// Whether a plane runs through the nodes of a block, and where: its local index along the axis, or -1.
template <int D>
int local_plane(const Boundary& boundary, BlockKey block);

/// Along its axis, m/s.
double velocity_of(const Boundary& boundary, double time);

/// Where the boundaries that carry the grid have its origin at a time (s), m.
Vector grid_origin(const std::vector<Boundary>& boundaries, double time);
void place_grid(Grid& grid, const std::vector<Boundary>& boundaries, double time);

/// The velocity of a node on the plane as the boundary wants it.
Vector bounded(const Boundary& boundary, Vector velocity, bool touched, double time);

}  // namespace brisance::simulator
