#include "simulator/step_size.hpp"

#include <limits>

namespace brisance::simulator {
namespace {

double courant_number(const Simulation& s, const NumericsConfig& n) {
  if (n.courant > 0.0) return n.courant;
  if (n.stress_timing == StressTiming::usl) return 0.3;
  return s.dimensions() == 3 ? 0.4 : 0.5;
}

}  // namespace

double gas_courant(const gas::Gas& gas) {
  constexpr double part = 0.5;
  return gas.courant > 0.0 ? gas.courant : part;
}

StepSize next_step(const Simulation& s, const NumericsConfig& numerics, double end_time) {
  const double h = s.grid.cell_size;
  const Extremes& e = s.extremes;
  StepSize size{std::numeric_limits<double>::infinity(), "nothing"};
  const auto limit = [&](double dt, std::string_view reason) {
    if (!(dt >= size.dt)) size = {dt, reason};
  };
  constexpr double farthest = 0.5;  // cells a particle may move
  if (e.wave_and_motion > 0.0) limit(courant_number(s, numerics) * h / e.wave_and_motion, "the speed of waves");
  if (e.speed > 0.0) limit(farthest * h / e.speed, "the speed of particles");
  if (e.volume_rate > 0.0) limit(numerics.most_volume_change / e.volume_rate, "the rate of volume change");
  if (!s.gas.empty()) {
    // A jump at the start sends out waves that nobody knows of yet.
    constexpr double first = 0.1;
    const double step = gas::largest_step(s.gas, gas_courant(s.gas));
    limit(s.last_time_step > 0.0 ? step : first * step, "the speed of waves in the gas");
  }
  if (s.last_time_step > 0.0)
    limit(numerics.growth * s.last_time_step, "growth from the step before");
  else if (numerics.first_step > 0.0)
    limit(numerics.first_step, "numerics.first_step");
  const double left = end_time - s.time;
  // Two steps of equal size instead of a very small last one.
  if (size.dt >= left)
    size = {left, last_steps};
  else if (2.0 * size.dt > left)
    size = {0.5 * left, last_steps};
  return size;
}

}  // namespace brisance::simulator
