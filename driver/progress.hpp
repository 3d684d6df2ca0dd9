#pragma once
// A line of progress on a terminal, and a clean end on Ctrl-C.

#include <chrono>
#include <string>

namespace brisance::driver {

/// From now on SIGINT asks a run to end after the step at work, instead of ending the program. A second one ends it.
void catch_interrupts();
bool interrupt_requested();

/// Rewrites one line of standard error, if that is a terminal, at most ten times a second.
class ProgressLine {
 public:
  ~ProgressLine();
  void show(const std::string& text);

 private:
  std::chrono::steady_clock::time_point last_{};
  bool shown_ = false;
};

}  // namespace brisance::driver
