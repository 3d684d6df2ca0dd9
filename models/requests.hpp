#pragma once
// Requests to the memory that are sent a few at a time.

#include <array>

namespace brisance {

/// Lines of memory (64 bytes) that will be read soon. A processor has some ten requests under way at once, and whatever asks
/// for more waits: so they are sent in the middle of other work.
class Requests {
 public:
  /// Lines from one on, to be asked for after those before. What finds no place here is read without notice.
  void add(const double* first, int lines) {
    if (ranges_ < most_ranges) range_[ranges_++] = {first, lines};
  }
  /// Inlined, or GCC 12 takes a function that does nothing else for one without effect, and leaves it out.
  [[gnu::always_inline]] void send(int lines) {
    constexpr int line = 8;  // doubles
    for (; now_ < ranges_; ++now_) {
      Range& range = range_[now_];
      for (; range.lines > 0; --range.lines, range.next += line) {
        if (lines-- == 0) return;
        __builtin_prefetch(range.next);
      }
    }
  }

 private:
  struct Range {
    const double* next = nullptr;
    int lines = 0;
  };
  static constexpr unsigned most_ranges = 16;
  std::array<Range, most_ranges> range_;
  unsigned ranges_ = 0, now_ = 0;
};

}  // namespace brisance
