#pragma once
// The one way in which work is shared by threads. Which thread does which block has no influence on any result: every block
// writes only what is its own.

#include <cstddef>
#include <exception>

namespace brisance::simulator {

/// Calls f(i) for i in [0, count), in any order and at the same time. What f throws is rethrown when all are done: that of the
/// lowest i, so that it does not depend on the threads either.
template <class F>
void parallel_for_blocks(std::size_t count, F&& f) {
  std::exception_ptr first;
  std::size_t thrower = count;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      f(i);
    } catch (...) {
#pragma omp critical(brisance_first_exception)
      if (i < thrower) thrower = i, first = std::current_exception();
    }
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace brisance::simulator
