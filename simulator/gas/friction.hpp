#pragma once
// Friction between the rows of cells that a shock runs along: rows that exchange nothing but volume let it run ahead in one
// and fall back in the next, and the gas behind it is hot and cold in turn (the carbuncle: Quirk, Int. J. Numer. Meth. Fluids
// 18 (1994) 555). A viscosity of the size of the shock's own holds them together (Rodionov, J. Comput. Phys. 345 (2017) 308).
// It acts where the gas is compressed, and more along a face than across it: a shock that is oblique to the grid would be
// widened, and neither a rarefaction nor a strain that keeps the volume is a shock. How the strength was chosen is in
// docs/decisions/gas.md. The formulas that the steps with and without bodies have in common (lagrangian.cpp,
// bodies_lagrangian.cpp).

#include "simulator/gas/cells.hpp"

namespace brisance::simulator::gas {

/// kg/(m^2 s) m/s: bulk modulus times the closing across a cell along an axis, beyond the threshold below which it is no shock.
/// From what half a step of dt/2 changes the pressure, - rho c^2 div u dt/2 (Pa), and from the change of the velocity along the
/// axis over the cell (m/s).
inline Lanes closing_in_shock(int dimensions, double cell_size, double dt, const Lanes& density, const Lanes& sound,
                              const Lanes& half_pressure, const Lanes& stretch) {
  constexpr double threshold = 0.05;  // of the speed of sound
  constexpr double most = 4.0;        // times the compression, however much faster the gas closes in one direction
  const Lanes modulus = density * sound * sound, compression = (2.0 * cell_size / dt) * half_pressure;
  return min(Lanes(most * compression), compression + modulus * (dimensions * stretch)) - modulus * (threshold * sound);
}
/// m/s: friction over density and jump of the velocity.
inline Lanes rubbing_of(const Lanes& closing, const Lanes& density, const Lanes& sound) {
  constexpr double strength = 0.45;  // of the impedance that belongs to the closing
  return max(Lanes(strength * closing / (density * sound * sound)), Lanes(0.0));
}
/// Friction over the jump of the velocity at a face between two cells, kg/(m^2 s).
inline Lanes rubbing_impedance(const Lanes& density_L, const Lanes& density_R, const Lanes& rubbing_L, const Lanes& rubbing_R) {
  return min(density_L, density_R) * max(rubbing_L, rubbing_R);
}

}  // namespace brisance::simulator::gas
