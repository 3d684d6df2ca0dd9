#pragma once
// Directories in which tests write.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace brisance {

namespace fs = std::filesystem;

/// The directory of the tests of one program, gone when the program ends.
struct ScratchRoot {
  const pid_t owner = getpid();
  const fs::path path = fs::path(testing::TempDir()) / ("brisance_tests_" + std::to_string(owner));

  ScratchRoot() { fs::remove_all(path); }
  ~ScratchRoot() {
    std::error_code ignored;                               // what cannot be removed is no failure of a test
    if (getpid() == owner) fs::remove_all(path, ignored);  // a forked child leaves it to its parent
  }
  ScratchRoot(const ScratchRoot&) = delete;
  ScratchRoot& operator=(const ScratchRoot&) = delete;
};

/// A fresh directory of that name.
inline fs::path scratch(const std::string& name) {
  static const ScratchRoot root;
  const fs::path directory = root.path / name;
  fs::remove_all(directory);
  fs::create_directories(directory);
  return directory;
}

/// A fresh directory of this test.
inline fs::path scratch() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(info->test_suite_name()) + "_" + info->name();
  std::replace(name.begin(), name.end(), '/', '_');
  return scratch(name);
}

}  // namespace brisance
