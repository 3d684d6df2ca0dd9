#include "simulator/gas/step_estimate.hpp"

#include <algorithm>

#include "simulator/gas/acoustic.hpp"
#include "simulator/gas/own_blocks.hpp"

namespace brisance::simulator::gas {
namespace {

/// The speed of sound behind a shock that changes the velocity by du; without one, of what there is.
Lanes sound_behind(const Lanes& sound, const Lanes& gruneisen, const Lanes& du) {
  const Lanes jump = max(du, Lanes(0.0));
  return sqrt(sound * sound + (1.0 + gruneisen) * jump * (sound + 0.5 * gruneisen * jump));
}

struct Rates {
  double wave = 0.0, motion = 0.0;  // 1/s, as in Gas
};

template <int D>
Rates rates_of(const Gas& gas, std::size_t block, double body_speed) {
  const Cells& cells = gas.cells;
  Rates rates;
  const auto note = [&](const LanesMask& here, const Lanes& speed, const Lanes& sound) {
    for (int l = 0; l < 8; ++l) {
      if (!here[l]) continue;
      rates.wave = std::max(rates.wave, (speed[l] + D * sound[l]) / cells.cell_size);
      rates.motion = std::max(rates.motion, speed[l] / cells.cell_size);
    }
  };
  for (int axis = 0; axis < D; ++axis)
    for (int n = 0; n < BlockShape<D>::pencils; ++n) {
      Pencil density, pressure, sound, gruneisen, velocity, square;
      load<D>(cells, gas.primitive, block, Primitive::density, axis, n, density);
      load<D>(cells, gas.primitive, block, Primitive::pressure, axis, n, pressure);
      load<D>(cells, gas.primitive, block, Primitive::sound_speed, axis, n, sound);
      load<D>(cells, gas.primitive, block, Primitive::gruneisen, axis, n, gruneisen);
      load<D>(cells, gas.primitive, block, Primitive::velocity + axis, axis, n, velocity);
      load_squared_speed<D>(gas, block, axis, n, velocity, square);
      for (int m = 0; m < line; ++m) {
        const LanesMask inside = lanes_inside<D>(cells, block, axis, n, m);
        const auto c = static_cast<std::size_t>(ring + m);
        for (const std::size_t l : {c - 1, c}) {
          const std::size_t r = l + 1;
          const FaceSide L = {velocity[l], pressure[l], density[l]}, R = {velocity[r], pressure[r], density[r]};
          const Lanes shock = 1.0 + 0.5 * max(gruneisen[l], gruneisen[r]);
          const Lanes u = star(L, R, sound[l], sound[r], shock, Lanes(0.0), 1.0).velocity;
          const Lanes behind =
              max(sound_behind(sound[l], gruneisen[l], velocity[l] - u), sound_behind(sound[r], gruneisen[r], u - velocity[r]));
          note(inside, abs(u), behind);
        }
        if (gas.bodies.empty()) continue;
        const Lanes closing = body_speed + sqrt(square[c]);
        note(inside, Lanes(body_speed), sound_behind(sound[c], gruneisen[c], closing));
      }
    }
  return rates;
}

}  // namespace

double step_after_jumps(Gas& gas, double courant) {
  const double body_speed = gas.bodies.empty() ? 0.0 : fastest(gas);
  std::vector<Rates> of_block(gas.cells.mine.size());
  for_each_own_block(gas,
                     [&](auto D, std::size_t i, std::size_t block) { of_block[i] = rates_of<D()>(gas, block, body_speed); });
  const Rates now = {gas.wave_rate, gas.motion_rate};
  for (const Rates& rates : of_block)
    gas.wave_rate = std::max(gas.wave_rate, rates.wave), gas.motion_rate = std::max(gas.motion_rate, rates.motion);
  const double step = largest_step(gas, courant);
  gas.wave_rate = now.wave, gas.motion_rate = now.motion;
  return step;
}

}  // namespace brisance::simulator::gas
