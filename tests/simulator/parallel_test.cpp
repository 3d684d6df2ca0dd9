// Work shared by threads: all of it is done, and what goes wrong is told the same way whoever did it.

#include "simulator/parallel.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace brisance::simulator {
namespace {

class Parallel : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { omp_set_num_threads(GetParam()); }
  void TearDown() override { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

TEST_P(Parallel, DoesEveryBlockOnce) {
  std::vector<int> times(1000, 0);
  parallel_for_blocks(times.size(), [&](std::size_t i) { ++times[i]; });
  EXPECT_EQ(times, std::vector<int>(1000, 1));
}

TEST_P(Parallel, RethrowsWhatTheLowestBlockThrewAfterAllAreDone) {
  for (int repetition = 0; repetition < 50; ++repetition) {
    std::atomic<int> done = 0;
    std::string message;
    try {
      parallel_for_blocks(200, [&](std::size_t i) {
        ++done;
        if (i >= 20 && i % 7 == 0) throw std::runtime_error("block " + std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    ASSERT_EQ(message, "block 21");
    ASSERT_EQ(done, 200);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 5));

}  // namespace
}  // namespace brisance::simulator
