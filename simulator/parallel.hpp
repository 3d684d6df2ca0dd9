#pragma once
// The one way in which work is shared by threads. Which thread does which block has no influence on any result: every block
// writes only what is its own.

#include <cstddef>

namespace brisance::simulator {

/// Calls f(i) for i in [0, count), in any order and at the same time.
template <class F>
void parallel_for_blocks(std::size_t count, F&& f) {
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < count; ++i) f(i);
}

}  // namespace brisance::simulator
