#pragma once
// A line of progress on a terminal, and a clean end on Ctrl-C or when the machine ends the program.

#include <chrono>
#include <string>

namespace brisance {

/// From now on SIGINT and SIGTERM ask a run to end after the step at work, instead of ending the program. A second one ends it.
void catch_interrupts();
bool interrupt_requested();
/// Forgets an interrupt, so that another run of this program can begin.
void forget_interrupt();

/// Rewrites one line of standard error, if that is a terminal, at most ten times a second.
class ProgressLine {
 public:
  ~ProgressLine();
  void show(const std::string& text);

 private:
  std::chrono::steady_clock::time_point last_{};
  bool shown_ = false;
};

}  // namespace brisance
