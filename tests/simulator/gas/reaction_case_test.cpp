// Reactions of the gas through case files: what they ask for, what they are told, runs and restarts.

#include <gtest/gtest.h>

#include <fstream>

#include "simulator/case_reader.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/command_line.hpp"
#include "tests/simulator/gas/interrupted_run.hpp"

namespace brisance::simulator {
namespace {

fs::path shipped(const std::string& name) {
  return fs::path(BRISANCE_SOURCE_DIR) / "data/cases" / (name + ".toml");
}

std::string problems_of(const std::vector<std::string>& changes, const std::string& name = "detonation_pbx_9501") {
  try {
    read_case(shipped(name), changes);
    return "";
  } catch (const InputError& error) {
    std::string all;
    for (const Problem& p : error.problems()) all += p.key + ": " + p.what + '\n';
    return all;
  }
}

TEST(ReactionCase, RunsStopsAndGoesOnWithTheSameBits) {
  const Case c = read_case(shipped("detonation_pbx_9501"), {"cell_size=0.5 mm", "gas.fill.1.shape.box.upper=[\"4 mm\"]",
                                                            "end_time=3 us", "output.figures=false"});
  const InterruptedRun r = run_whole_and_in_parts(c, {31});
  const std::string history = text_of(r.parts_directory / "history.csv");
  for (const char* column : {"detonation_burned_mass [kg/m^2]", "detonation_heat [J/m^2]"})
    EXPECT_TRUE(contains(history, column)) << column;
  EXPECT_TRUE(contains(in_words(r.uninterrupted.summary), "burned by detonation"));
}

TEST(ReactionCase, WritesWhatItReads) {
  const Case c = read_case(shipped("closed_bomb"), {});
  const fs::path file = scratch() / "copy.toml";
  std::ofstream(file) << write_case(c);
  const Case again = read_case(file, {});
  EXPECT_EQ(write_case(again), write_case(c));
  ASSERT_EQ(again.gas->reactions.size(), 1u);
  EXPECT_EQ(again.gas->reactions[0].ignitions.size(), c.gas->reactions[0].ignitions.size());
}

TEST(ReactionCase, IsToldWhatIsWrongWithIt) {
  const std::string key = "gas.reaction.0.";
  EXPECT_TRUE(contains(problems_of({key + "reactant=\"explosve\""}), "there is no fluid \"explosve\""));
  EXPECT_TRUE(contains(problems_of({key + "product=\"air\""}), "there is no fluid \"air\""));
  EXPECT_TRUE(contains(problems_of({key + "product=\"explosive\""}), "cannot burn to itself"));
  EXPECT_TRUE(contains(problems_of({key + "reactant=\"products\"", key + "product=\"explosive\""}), "has no [reaction] table"));
  EXPECT_TRUE(contains(problems_of({key + "ignition=[{time = 0.0}]"}), "burns by pressure alone"));
  EXPECT_TRUE(contains(problems_of({key + "rate=1"}), "unknown key"));
  // In a plane, with a body.
  const std::vector<std::string> with_body = {
      "geometry=\"plane\"", "gas.lower=[0, 0]", "gas.upper=[\"100 mm\", \"100 mm\"]",
      "gas.fill.1.shape={box = {lower = [0, 0], upper = [\"5 mm\", 1]}}",
      "gas.body=[{name = \"plug\", shape = {box = {lower = [\"50 mm\", 0], upper = [1, \"50 mm\"]}}}]"};
  EXPECT_TRUE(contains(problems_of(with_body, "closed_bomb"), "a reaction at a surface in a gas with bodies"));
  std::vector<std::string> with_bulk = with_body;
  with_bulk.insert(with_bulk.end(), {"gas.fill.1.velocity=[0, 0]", "gas.implicit=true"});
  EXPECT_FALSE(contains(problems_of(with_bulk), "a reaction at a surface"));
  EXPECT_TRUE(contains(problems_of(with_bulk), "the implicit option in a gas with bodies")) << "so far it was looked at";
  EXPECT_EQ(problems_of({}), "");
}

}  // namespace
}  // namespace brisance::simulator
