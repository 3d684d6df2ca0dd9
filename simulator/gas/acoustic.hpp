#pragma once
// What happens at a face: the states that its two cells send there, and the acoustic waves between them.

#include "simulator/gas/gas.hpp"
#include "simulator/gas/limiter.hpp"

namespace brisance::simulator::gas {

/// Whether waves are to pass a side of the box whole, between the gas and a state beyond that is not its own: at such faces the
/// damping is not cut down at low Mach numbers. What is taken from a wave that leaves comes back as another one, and of a jump
/// of pressure that runs in any part could.
constexpr bool passes_waves(EdgeKind kind) {
  return kind == EdgeKind::inflow || kind == EdgeKind::non_reflecting;
}

/// Slope of the pressure less its hydrostatic part.
inline Lanes pressure_slope(const Pencil& p, const Pencil& density, std::size_t c, double half_head) {
  if (half_head == 0.0) return slope(p, c);
  const Lanes below = p[c - 1] + half_head * (density[c - 1] + density[c]);
  const Lanes above = p[c + 1] - half_head * (density[c] + density[c + 1]);
  return monotonised_central(below, p[c], above);
}

/// The state that a cell sends to one of its faces.
struct FaceSide {
  Lanes velocity, pressure, density;
};
/// Where the extrapolation nearly empties the cell it is not to be trusted, and the cell sends its own state.
inline FaceSide trusted(const FaceSide& s, const Lanes& density, const Lanes& pressure, const Lanes& velocity,
                        const LanesMask& first_order = LanesMask(false)) {
  constexpr double least = 1e-3;
  const LanesMask bad = first_order | (s.density < least * density) | ((s.pressure < least * pressure) & (pressure > 0.0));
  return {select(bad, velocity, s.velocity), select(bad, pressure, s.pressure), select(bad, density, s.density)};
}
inline FaceSide face_side(const Pencil& density, const Pencil& pressure, const Pencil& velocity, const Pencil& half_pressure,
                          const Pencil& half_velocity, std::size_t c, double towards, double half_head,
                          const LanesMask& first_order = LanesMask(false)) {
  const Lanes head = Lanes(2.0 * half_head) * density[c];
  FaceSide s;
  s.density = density[c] + towards * slope(density, c);
  s.pressure = pressure[c] + towards * (pressure_slope(pressure, density, c, half_head) + head) + half_pressure[c];
  s.velocity = velocity[c] + towards * slope(velocity, c) + half_velocity[c];
  return trusted(s, density[c], pressure[c], velocity[c], first_order);
}

/// Part of the impedance of a cell that its waves have, from the mean of its fluids' impedances over its own. Drops in a gas,
/// or a gas that stands beside a liquid in a cell, are no foam: with the impedance of foam three cells at the edge of a liquid
/// would take hundreds of steps to come to the pressure about them. Their waves are those of the fluids, by their parts of the
/// compressibility. Softer waves even out pressures faster; faster than in a cell through which sound just passes in the step
/// they would overshoot. `cells_per_speed`: step over cell size, times the dimensions (s/m).
inline Lanes impedance_ratio_in_step(const Lanes& impedance_ratio, const Lanes& sound, double cells_per_speed) {
  return max(impedance_ratio, min(Lanes((2.0 * cells_per_speed) * sound), Lanes(1.0)));
}

/// The waves between two states.
struct FaceWaves {
  Lanes Z_L, Z_R, sum;  // impedances, kg/(m^2 s); 1/(Z_L + Z_R)
  Lanes damping;        // part of the pressure that the jump of velocity adds
};
/// With the impedance of a shock where the states approach. At low Mach numbers the velocity jump adds no more pressure than
/// the motion itself would: otherwise slow flow is damped (Dellacherie, J. Comput. Phys. 229 (2010) 978).
inline FaceWaves face_waves(const FaceSide& L, const FaceSide& R, const Lanes& sound_L, const Lanes& sound_R,
                            const Lanes& shock, const Lanes& speed, const Lanes& least_mach) {
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
  const Lanes mach = min(max(max(Lanes(speed / slower), least_mach), waves * waves), Lanes(1.0));
  return {Z_L, Z_R, sum, select(shocked, Lanes(1.0), mach)};
}

struct Star {
  Lanes velocity, pressure;
};
/// Acoustic solution between two states.
inline Star star(const FaceSide& L, const FaceSide& R, const Lanes& sound_L, const Lanes& sound_R, const Lanes& shock,
                 const Lanes& speed, const Lanes& least_mach) {
  const auto [Z_L, Z_R, sum, damping] = face_waves(L, R, sound_L, sound_R, shock, speed, least_mach);
  // In this order the mirror image of the two sides gives the mirror image of the face, to the last bit.
  return {((Z_L * L.velocity + Z_R * R.velocity) + (L.pressure - R.pressure)) * sum,
          ((Z_R * L.pressure + Z_L * R.pressure) - damping * (Z_L * Z_R) * (R.velocity - L.velocity)) * sum};
}

/// Square of the speed in the cells of a pencil, of which the velocity along it is known.
template <int D>
void load_squared_speed(const Gas& gas, std::size_t block, int axis, int n, const Pencil& along, Pencil& square) {
  for (std::size_t c = 0; c < reach; ++c) square[c] = along[c] * along[c];
  for (int a = 0; a < D; ++a) {
    if (a == axis) continue;
    Pencil across;
    load<D>(gas.cells, gas.primitive, block, Primitive::velocity + a, axis, n, across);
    for (std::size_t c = 0; c < reach; ++c) square[c] += across[c] * across[c];
  }
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
