#pragma once
// Where the time of a run goes: seconds of wall time by phase of the step.

#include <array>
#include <chrono>
#include <string_view>

namespace brisance::simulator {

enum class Phase { particles_to_grid, sum_tiles, nodes, grid_to_particles, velocity_gradients, update_stress, order, count };
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Phase::count)> phase_names{
    "particles to grid", "sum of tiles",        "nodes", "grid to particles", "velocity gradients",
    "stress update",     "order, blocks, books"};

struct PhaseTimes {
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds{};
};

/// Adds the time of its life to a phase.
class Timed {
 public:
  Timed(PhaseTimes& times, Phase phase) : seconds_(times.seconds[static_cast<std::size_t>(phase)]) {}
  ~Timed() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace brisance::simulator
