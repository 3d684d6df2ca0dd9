#pragma once
// Reaction: a fluid of the gas burns to another one. What burns brings its mass, its volume and its internal energy along and
// sets its heat free. In a bulk burn it stays in its cell, which keeps its mass and momentum. What a surface sets free goes to
// the gas in front of it, with its momentum: gas in a cell that is nearly solid could not leave it without carrying the solid
// away, for they share one velocity. The heat of the reaction has a book of its own.

#include <optional>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Whether it burns at the surface of the reactant, not in all of it.
inline bool has_surface(const Reaction& law) {
  return std::visit([](const auto& l) { return l.kind == reaction::Kind::surface; }, law);
}

/// From a place to a region, m, 0 inside; none of shapes other than boxes, spheres and unions of them.
std::optional<double> distance(const Shape& region, const Vector& place);

/// Opens the books of the reactions, and makes room for the burning area if one of them has a surface.
void prepare_burns(Gas& gas);
/// Lets the cells burn for a step of dt (s), between its Lagrangian phase and its remap: what burns is then still in the cell
/// whose pressure is known.
void react(Gas& gas, double dt, Domain& domain);
/// The same of bulk reactions around bodies, after the step and before its time is booked: of what the cells hold then, at its
/// pressure, for the remap of a step with bodies leaves no cell to burn in between.
void react_around_bodies(Gas& gas, double dt, Domain& domain);
/// The same of one reaction, of a surface as large as gas.burning_area says.
void burn_cells(Gas& gas, std::size_t number, double dt, Domain& domain);

/// Area (m^2) of the surface of a fluid in each cell that holds some of it, into gas.burning_area: the gradient of its smoothed
/// fraction of the volume, times the volume. The sum over a front is its area, however many cells it is spread over.
void find_burning_area(Gas& gas, int fluid, Domain& domain);

}  // namespace brisance::simulator::gas
