#pragma once
// summary.json and the same for people to read.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulator/gas/hottest.hpp"
#include "simulator/output/gauge_history.hpp"
#include "simulator/output/history.hpp"
#include "simulator/output/measures.hpp"

namespace brisance::simulator {

/// How many particles of a body a failure criterion has met.
struct FailedParticles {
  std::string body;
  std::int64_t failed, all;
};
/// Of the bodies that have any.
std::vector<FailedParticles> failed_particles(const Simulation& s);

/// Pairs of solids that have particles in one cell or in neighbouring ones: they move each other.
std::vector<std::array<std::string, 2>> in_contact(const Simulation& s);

struct Summary {
  std::string title, subtitle, ending, message;
  double time = 0.0;                      // s
  std::int64_t steps = 0, particles = 0;  // or cells, of gas
  double wall_time = 0.0;                 // s
  double particle_steps_per_second = 0.0;
  int threads = 1;
  Books books;
  std::vector<MeasuredValue> measures;
  std::vector<GaugePeak> peaks{};               // of the gauges
  std::string not_gated{};                      // what no gate watches
  std::vector<std::string> resumed_after{};     // gates that had ended it before
  std::vector<std::string> other_experiment{};  // what --set has changed of the one that its measures are compared with
  std::vector<FailedParticles> failed{};
  std::vector<std::array<std::string, 2>> in_contact{};  // solids
  std::optional<gas::Hottest> hottest{};                 // of gas
};

/// How a run came to its end, as the summary that it wrote tells it; nothing if there is none.
struct ToldEnding {
  std::string ending, message;
  double time = 0.0;  // s, simulated
};
std::optional<ToldEnding> read_ending(const std::filesystem::path& path);
void write_summary(const Summary& summary, const std::filesystem::path& path);
/// A table of the measures and the energies; without the message.
std::string in_words(const Summary& summary);

}  // namespace brisance::simulator
