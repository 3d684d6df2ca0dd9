#pragma once
// Faces between cells that move with the gas.

#include "simulator/gas/cells.hpp"

namespace brisance::simulator::gas {

/// The state that a cell sends to one of its faces.
struct FaceSide {
  Lanes velocity, pressure, density;
};
/// Where the extrapolation nearly empties the cell it is not to be trusted.
inline FaceSide trusted(const FaceSide& s, const Lanes& density, const Lanes& pressure, const Lanes& velocity) {
  constexpr double least = 1e-3;
  const LanesMask bad = (s.density < least * density) | ((s.pressure < least * pressure) & (pressure > 0.0));
  return {select(bad, velocity, s.velocity), select(bad, pressure, s.pressure), select(bad, density, s.density)};
}

struct Star {
  Lanes velocity, pressure;
};
/// Acoustic solution between two states, with the impedance of a shock where they approach. At low Mach numbers the velocity
/// jump adds no more pressure than the motion itself would: otherwise slow flow is damped (Dellacherie, J. Comput. Phys. 229
/// (2010) 978).
inline Star star(const FaceSide& L, const FaceSide& R, const Lanes& sound_L, const Lanes& sound_R, const Lanes& shock,
                 const Lanes& speed, double least_mach) {
  const Lanes closing = max(Lanes(L.velocity - R.velocity), Lanes(0.0));
  const Lanes stiffening = shock * closing;
  const Lanes Z_L = L.density * (sound_L + stiffening), Z_R = R.density * (sound_R + stiffening);
  const Lanes sum = 1.0 / (Z_L + Z_R);
  const Lanes slower = min(sound_L, sound_R);
  const LanesMask shocked =
      (abs(R.pressure - L.pressure) > 0.1 * min(abs(L.pressure), abs(R.pressure))) | (closing > 0.1 * slower);
  // A wave of sound brings as much pressure as its velocity times the impedance; in slow flow that bends around there is next
  // to none. Waves keep their damping, or their fronts become steps; the square, because of the flow a part of its Mach number
  // stays.
  const Lanes waves =
      abs(R.pressure - L.pressure) / max(Lanes(2.0 * (Z_L * Z_R) * sum * abs(R.velocity - L.velocity)), Lanes(1e-300));
  const Lanes mach = min(max(max(Lanes(speed / slower), Lanes(least_mach)), waves * waves), Lanes(1.0));
  const Lanes damping = select(shocked, Lanes(1.0), mach);
  // In this order the mirror image of the two sides gives the mirror image of the face, to the last bit.
  return {((Z_L * L.velocity + Z_R * R.velocity) + (L.pressure - R.pressure)) * sum,
          ((Z_R * L.pressure + Z_L * R.pressure) - damping * (Z_L * Z_R) * (R.velocity - L.velocity)) * sum};
}

/// Mean area of a face across x that moves along x: where the area widens with x, the face does so on its way.
inline Lanes area_on_the_way(const Cells& cells, const Lanes& area, const Lanes& way) {
  switch (cells.geometry) {
    case Geometry::cylindrical_1d:
      return area + 0.5 * way;
    case Geometry::axisymmetric:
      return area + (0.5 * cells.cell_size) * way;
    case Geometry::spherical_1d:
      return area + sqrt(area) * way + (1.0 / 3.0) * way * way;
    default:
      return area;
  }
}

}  // namespace brisance::simulator::gas
