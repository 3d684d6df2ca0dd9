#pragma once
// summary.json and the same for people to read.

#include <filesystem>
#include <string>
#include <vector>

#include "simulator/output/gauge_history.hpp"
#include "simulator/output/history.hpp"
#include "simulator/output/measures.hpp"

namespace brisance::simulator {

struct Summary {
  std::string title, subtitle, ending, message;
  double time = 0.0;                      // s
  std::int64_t steps = 0, particles = 0;  // or cells, of gas
  double wall_time = 0.0;                 // s
  double particle_steps_per_second = 0.0;
  int threads = 1;
  Books books;
  std::vector<MeasuredValue> measures;
  std::vector<GaugePeak> peaks{};  // of the gauges
  std::string not_gated{};         // what no gate watches
};

/// Whether a summary that was written tells of a run that failed; not if there is none.
bool tells_of_failure(const std::filesystem::path& path);
void write_summary(const Summary& summary, const std::filesystem::path& path);
/// A table of the measures and the energies; without the message.
std::string in_words(const Summary& summary);

}  // namespace brisance::simulator
