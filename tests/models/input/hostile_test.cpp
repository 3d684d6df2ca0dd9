// Every file in tests/hostile is refused with exactly the message in the file beside it that ends in .expected: the
// messages are part of the program, and these files say what a user should see.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "models/input/material_reader.hpp"

namespace brisance {
namespace {

const std::filesystem::path folder = std::filesystem::path(BRISANCE_SOURCE_DIR) / "tests/hostile";

std::vector<std::string> hostile_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The message with the folder taken from every file name.
std::string without_folder(std::string message) {
  const std::string prefix = folder.string() + '/';
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) message.erase(at, prefix.size());
  return message;
}

class HostileFile : public testing::TestWithParam<std::string> {};

TEST_P(HostileFile, IsRefusedWithTheMessageWrittenDown) {
  const std::filesystem::path path = folder / (GetParam() + ".toml");
  const std::string expected = content(folder / (GetParam() + ".expected"));
  ASSERT_FALSE(expected.empty()) << "there is no expected message for " << path;
  try {
    read_material(path);
    FAIL() << path << " was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(without_folder(error.what()) + '\n', expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Input, HostileFile, testing::ValuesIn(hostile_files()),
                         [](const testing::TestParamInfo<std::string>& file) { return file.param; });

TEST(HostileFiles, AreManyAndEachHasItsMessage) {
  constexpr std::size_t fewest = 100;
  EXPECT_GE(hostile_files().size(), fewest);
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_material(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HostileFiles, ThatAreNoFilesAreRefused) {
  EXPECT_EQ(refusal("no/such/file.toml"), "no/such/file.toml: there is no such file");
  EXPECT_EQ(refusal(folder), folder.string() + ": this is a folder; the name of a file is required");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: has more than 16 MB; input files are small");
  EXPECT_EQ(refusal(""), "there is no such file");
}

TEST(HostileFiles, OfAMillionBracketsOrDotsDoNotExhaustTheStack) {
  for (const std::string& piece : {std::string("a."), std::string("[["), std::string("{a="), std::string("[a.")}) {
    std::string text = piece == "a." ? "" : "x = ";
    for (int i = 0; i < 1'000'000; ++i) text += piece;
    EXPECT_THROW(InputFile::from_text(text + "a = 1\n", "deep.toml"), InputError) << piece;
  }
}

}  // namespace
}  // namespace brisance
