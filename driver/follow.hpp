#pragma once
// A point follows a loading path.

#include <functional>
#include <stdexcept>

#include "driver/loading_path.hpp"
#include "driver/rate_form.hpp"

namespace brisance::driver {

/// A run that could not be carried on: where, the state of the point, what to try.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Ending { completed, failure, interrupted };

struct Outcome {
  Ending ending = Ending::completed;
  FailureCause failure = FailureCause::none;
  double failure_time = 0.0;  // s
  State<double> state;        // at the end
  double time = 0.0;          // s
  long steps = 0, updates = 0;
  long rejected = 0;           // steps whose halves came out otherwise than the tolerance of the path allows
  State<double> start;         // at the start of the first segment
  std::vector<Segment> taken;  // every step, if asked for
};

/// Called now and then with the number of the segment and of the step; returns false to interrupt the run.
using Watcher = std::function<bool(std::size_t segment, double time, long step)>;

struct FollowOptions {
  Watcher watcher;
  bool keep_steps = false;  // in Outcome::taken
};

/// Leads a point of this material along the path and records its history. Steps are limited by path.strain_increment and
/// path.tolerance, and halved where the update or the mixed control asks for it. Throws RunError if halving does not help; the
/// history then holds what was reached.
Outcome follow(const Material& material, const LoadingPath& path, History& history, const FollowOptions& options = {});

}  // namespace brisance::driver
