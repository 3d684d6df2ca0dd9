#pragma once
// The positive phase of a wave of pressure at a place, of every step of a run: the stretch of time above the ambient pressure
// that has the highest peak.

#include <span>
#include <vector>

namespace brisance::simulator {

class PositivePhase {
 public:
  /// Overpressure (Pa) at a time (s), which rises from call to call. In between it is taken as linear.
  void add(double time, double overpressure);

  struct Result {
    double peak = 0.0;     // Pa
    double arrival = 0.0;  // s, when half of the peak is reached first: fronts of computed shocks are a few cells wide
    double end = 0.0;      // s
    double impulse = 0.0;  // Pa s
    bool ended = false;    // or the overpressure is still positive
  };
  Result result() const;

  /// All that it keeps, and back: `take_from` shortens the numbers by its own. Throws std::runtime_error.
  void append_to(std::vector<double>& numbers) const;
  void take_from(std::span<const double>& numbers);

 private:
  struct Sample {
    double time = 0.0, overpressure = 0.0;
  };
  struct Phase {
    double peak = 0.0, end = 0.0, impulse = 0.0;
    std::vector<Sample> rise{};  // highest so far: the last up to half of the peak, and all above it
  };
  Sample last_;
  bool begun_ = false;
  Phase now_, highest_;  // that goes on, and the highest of those that have ended; of peak 0: none
};

}  // namespace brisance::simulator
