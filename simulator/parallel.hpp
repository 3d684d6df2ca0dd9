#pragma once
// The one way in which work is shared by threads. Which thread does which block has no influence on any result: every block
// writes only what is its own.

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>

namespace brisance::simulator {

/// Fewer blocks than this for each thread are done by one: to wake the others, and to wait until the last of them was given a
/// core, takes longer.
inline constexpr std::size_t least_blocks_per_thread = 2;
/// Threads take blocks in as many shares each: many, for blocks differ in work, but not block by block, for blocks of gas in
/// one and two dimensions take less time than to agree on who does the next.
inline constexpr std::size_t shares_per_thread = 16;

/// Calls f(i) for i in [0, count), in any order and at the same time. What f throws is rethrown when all are done: that of the
/// lowest i, so that it does not depend on the threads either.
template <class F>
void parallel_for_blocks(std::size_t count, F&& f) {
  std::exception_ptr first;
  std::size_t thrower = count;
  const auto attempt = [&](std::size_t i) {
    try {
      f(i);
    } catch (...) {
#pragma omp critical(brisance_first_exception)
      if (i < thrower) thrower = i, first = std::current_exception();
    }
  };
  const auto threads = static_cast<std::size_t>(omp_get_max_threads());
  if (threads == 1 || count < least_blocks_per_thread * threads) {
    // Even a team of one takes a microsecond to call together: as long as ten cells of gas.
    for (std::size_t i = 0; i < count; ++i) attempt(i);
  } else {
    const std::size_t share = std::max(count / (shares_per_thread * threads), std::size_t{1});
#pragma omp parallel for schedule(dynamic, share)
    for (std::size_t i = 0; i < count; ++i) attempt(i);
  }
  if (first) std::rethrow_exception(first);
}

/// Starts the program itself anew with what its libraries read before main() begins, unless the user has chosen:
/// OMP_WAIT_POLICY=passive, so that threads that wait sleep (where there are more threads than free cores, those that spin keep
/// those that work from their core); GLIBC_TUNABLES=glibc.malloc.hugetlb=1, so that large arrays stand in huge pages where the
/// system has them. Once: BRISANCE_STARTED_ANEW says that it has. To be called first in main(); returns if all is well, or if
/// nothing can be done about it.
void choose_for_libraries(char** argv);

}  // namespace brisance::simulator
