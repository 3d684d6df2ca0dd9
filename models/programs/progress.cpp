#include "models/programs/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace brisance {
namespace {

volatile std::sig_atomic_t requested = 0;

void note_interrupt(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}
bool interrupt_requested() {
  return requested != 0;
}

void forget_interrupt() {
  requested = 0;
}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(const std::string& text) {
  static const bool terminal = isatty(fileno(stderr)) != 0;
  const auto now = std::chrono::steady_clock::now();
  if (!terminal || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
}

}  // namespace brisance
