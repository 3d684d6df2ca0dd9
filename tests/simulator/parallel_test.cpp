// Work shared by threads: all of it is done, and what goes wrong is told the same way whoever did it.

#include "simulator/parallel.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <set>
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

TEST_P(Parallel, LeavesAFewBlocksToTheThreadThatAsks) {
  const auto threads_for = [](std::size_t blocks) {
    std::vector<int> by(blocks, -1);
    parallel_for_blocks(blocks, [&](std::size_t i) { by[i] = omp_get_num_threads(); });
    return std::set<int>(by.begin(), by.end());
  };
  const auto enough = least_blocks_per_thread * static_cast<std::size_t>(GetParam());
  EXPECT_EQ(threads_for(enough - 1), std::set<int>{1});
  EXPECT_EQ(threads_for(enough), std::set<int>{GetParam()});
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 5));

/// What a child process that calls choose_for_libraries ends with: the code of the program it became, or `returned`.
constexpr int returned = 99, as_chosen = 42;
int outcome_in_a_child(const char* wait_policy, const char* tunables, const char* started_anew = nullptr) {
  const pid_t child = fork();
  if (child == 0) {
    unsetenv("GOMP_SPINCOUNT");
    started_anew ? setenv("BRISANCE_STARTED_ANEW", started_anew, 1) : unsetenv("BRISANCE_STARTED_ANEW");
    wait_policy ? setenv("OMP_WAIT_POLICY", wait_policy, 1) : unsetenv("OMP_WAIT_POLICY");
    tunables ? setenv("GLIBC_TUNABLES", tunables, 1) : unsetenv("GLIBC_TUNABLES");
    std::string words[] = {"a", "--gtest_also_run_disabled_tests", "--gtest_filter=*OfAProgramStartedAnew*"};
    char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    choose_for_libraries(argv);
    _exit(returned);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Runs in children of the test below.
TEST(ChosenForLibraries, DISABLED_OfAProgramStartedAnew) {
  ASSERT_NE(std::getenv("OMP_WAIT_POLICY"), nullptr);
  ASSERT_STREQ(std::getenv("OMP_WAIT_POLICY"), "passive");
  ASSERT_NE(std::getenv("GLIBC_TUNABLES"), nullptr);
  ASSERT_STREQ(std::getenv("GLIBC_TUNABLES"), "glibc.malloc.hugetlb=1");
  _exit(as_chosen);
}

TEST(ChosenForLibraries, IsWhatTheUserHasNot) {
  const char* huge_pages = "glibc.malloc.hugetlb=1";
  EXPECT_EQ(outcome_in_a_child(nullptr, nullptr), as_chosen) << "the program starts itself anew";
  EXPECT_EQ(outcome_in_a_child("passive", nullptr), as_chosen);
  EXPECT_EQ(outcome_in_a_child(nullptr, huge_pages), as_chosen);
  EXPECT_EQ(outcome_in_a_child("passive", huge_pages), returned);
  EXPECT_EQ(outcome_in_a_child("active", "glibc.malloc.hugetlb=0"), returned);
  EXPECT_EQ(outcome_in_a_child(nullptr, nullptr, "1"), returned) << "what is taken away again is not set for ever";
}

}  // namespace
}  // namespace brisance::simulator
