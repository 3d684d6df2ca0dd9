// Gas through the programs: a case file is checked, run, stopped and gone on with, and draws its pictures.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "simulator/case_reader.hpp"
#include "simulator/commands.hpp"
#include "simulator/gates.hpp"
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

/// Two fluids, so that the volumes and energies that the equilibrium has shared out have to be kept as well.
TEST(GasRun, GoesOnFromACheckpointWithTheSameBits) {
  const Case c =
      read_case(shipped("water_air_shock_tube"), {"cell_size=10 mm", "output.figures=false", "output.snapshot_interval=50 us"});
  const InterruptedRun r = run_whole_and_in_parts(c, {17, 23});
  ASSERT_GT(r.whole.step, 60);
  for (const char* name : {"gas_000000.vti", "gas_000003.vti"})
    EXPECT_TRUE(text_of(r.parts_directory / name) == text_of(r.whole_directory / name)) << name;
}

/// With a body that the gas drives.
TEST(GasRun, WithABodyGoesOnFromACheckpointWithTheSameBits) {
  const Case c = read_case(shipped("gas_driven_projectile"), {"cell_size=20 mm", "output.figures=false", "end_time=0.2 ms"});
  const InterruptedRun r = run_whole_and_in_parts(c, {17});
  EXPECT_TRUE(contains(text_of(r.parts_directory / "history.csv"), "projectile_force_x [N/m]"));
  EXPECT_GT(r.parts.gas.bodies.all.at(0).state.velocity[0], 30.0);
}

/// What gravity brings has its columns from the first row on, and a body whose motion is given its velocity.
TEST(GasRun, HistoryHasTheSameColumnsFromTheFirstRowOn) {
  const fs::path directory = scratch();
  const Case c = read_case(shipped("hydrostatic_column"), {"output.figures=false"});
  prepare_directory(directory / "column", c, false);
  Simulation first = set_up(c), second = set_up(c);
  EXPECT_EQ(run(c, first, {directory / "column", {}, 5}).ending, Ending::interrupted);
  const RunResult resumed = resume(c, second, {directory / "column", {}, 5});
  EXPECT_EQ(resumed.ending, Ending::interrupted) << resumed.message;
  const std::string history = text_of(directory / "column" / "history.csv");
  std::istringstream rows(history);
  std::string header, row;
  std::getline(rows, header);
  EXPECT_TRUE(contains(header, "gravity_energy"));
  while (std::getline(rows, row))
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
}

/// It loses 0.4 % of the energy at Sod's tube: no gate is in its way but one that the case gives.
TEST(GasRun, OfTheClassicSchemeIsGatedButForItsEnergyAndSaysSo) {
  const auto run_classic = [](const fs::path& directory, std::vector<std::string> changes) {
    changes.insert(changes.end(), {"cell_size=10 mm", "output.figures=false", "gas.scheme=ice_classic"});
    const Case c = read_case(shipped("sod"), changes);
    prepare_directory(directory, c, false);
    Simulation s = set_up(read_case(directory / "case.toml"));  // what is not given is not given there either
    return run(read_case(directory / "case.toml"), s, {directory, {}});
  };
  const fs::path directory = scratch();
  const RunResult plain = run_classic(directory / "plain", {});
  EXPECT_EQ(plain.ending, Ending::done) << plain.message;
  const std::string words = "not gated: the energy of the gas: the classic scheme keeps it in no book";
  EXPECT_TRUE(contains(text_of(directory / "plain" / "log.txt"), words));
  EXPECT_TRUE(contains(in_words(plain.summary), words)) << in_words(plain.summary);
  EXPECT_TRUE(contains(text_of(directory / "plain" / "summary.json"), "\"not_gated\": \"the energy of the gas"));
  const RunResult gated = run_classic(directory / "gated", {"gates.residual=1e-3"});
  EXPECT_EQ(gated.ending, Ending::failed);
  EXPECT_TRUE(contains(gated.message, "gate residual: energy of gas that is in no book")) << gated.message;
  EXPECT_FALSE(contains(text_of(directory / "gated" / "log.txt"), "not gated"));
}

TEST(GasRun, OfTheClassicSchemeStopsWhereMassIsInNoBook) {
  Case c = read_case(shipped("sod"), {"cell_size=10 mm", "gas.scheme=ice_classic"});
  Simulation s = set_up(c);
  Books books = books_of(s);
  check_gates(c.gates, s, books);
  books.gas->state.mass[0] *= 1.0 + 1e-6;
  EXPECT_THROW(check_gates(c.gates, s, books), GateExceeded);
}

/// A block pushes into another one that it touches from the start.
TEST(GasRun, ThatEndsBecauseBodiesMeetEndsTheSameInPartsAndWhenResumed) {
  const fs::path directory = scratch();
  const Case c = read_case(write_text(directory / "blocks.toml", R"(
title = "Blocks"
geometry = "plane"
cell_size = 0.01
end_time = "2 ms"
[gas]
lower = [0, 0]
upper = [0.4, 0.2]
[[gas.fluid]]
name = "air"
material = "air.toml"
[[gas.fill]]
density = 1.2
pressure = 1e5
[[gas.body]]
name = "left"
shape = { box = { lower = [0.1, 0.05], upper = [0.2, 0.15] } }
[[gas.body]]
name = "right"
shape = { box = { lower = [0.2, 0.05], upper = [0.3, 0.15] } }
velocity = [-5, 0]
[output]
figures = false
)"));
  const auto sentence = [](const RunResult& result) { return result.message.substr(0, result.message.find('\n')); };
  Simulation whole = set_up(c), first = set_up(c), second = set_up(c), again = set_up(c);
  prepare_directory(directory / "whole", c, false), prepare_directory(directory / "parts", c, false);
  const RunResult in_one = run(c, whole, {directory / "whole", {}});
  EXPECT_EQ(in_one.ending, Ending::failed);
  EXPECT_TRUE(contains(in_one.message, "bodies left and right: they meet")) << in_one.message;
  ASSERT_GT(whole.step, 20);

  EXPECT_EQ(run(c, first, {directory / "parts", {}, 15}).ending, Ending::interrupted);
  const RunResult in_parts = resume(c, second, {directory / "parts", {}});
  EXPECT_EQ(sentence(in_parts), sentence(in_one));
  EXPECT_EQ(second.step, whole.step);
  EXPECT_TRUE(gas::numbers_of(second.gas) == gas::numbers_of(whole.gas));
  EXPECT_EQ(text_of(directory / "parts" / "history.csv"), text_of(directory / "whole" / "history.csv"));

  EXPECT_EQ(sentence(resume(c, again, {directory / "whole", {}})), sentence(in_one));
  EXPECT_EQ(again.step, whole.step);
  EXPECT_EQ(again.time, whole.time);
}

TEST(GasRun, TellsTheVelocityOfABodyWhoseMotionIsGiven) {
  Case c = read_case(shipped("gas_driven_projectile"), {"cell_size=20 mm", "output.figures=false"});
  c.gas->bodies.at(0).mass.reset();
  c.gas->bodies.at(0).velocity = {7.0, 0.0, 0.0};
  const Simulation s = set_up(c);
  EXPECT_EQ(books_of(s).gas->bodies.at(0).velocity, (Vector{7.0, 0.0, 0.0}));
}

TEST(GasRun, IsCheckedBeforeAndDrawnAfter) {
  const auto call = [](const std::vector<std::string>& words) {
    std::vector<std::string> all = {"brisance"};
    all.insert(all.end(), words.begin(), words.end());
    return call_program(run_command_line, all);
  };
  const fs::path directory = scratch() / "run";
  const std::string file = shipped("cylindrical_explosion").string();
  const Answer check = call({"check", file, "--set", "cell_size=0.05"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_TRUE(contains(check.out, "400 cells")) << check.out;
  for (const char* nonsense : {"inf", "nan", "warning", "0.0 MB"}) EXPECT_FALSE(contains(check.out, nonsense)) << check.out;
  const Answer ran = call({"run", file, "-o", directory.string(), "--set", "cell_size=0.05"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  for (const char* picture : {"energy.png", "gauges.png", "field.png", "line_along_x.png", "line_along_the_diagonal.png"})
    EXPECT_TRUE(fs::exists(directory / picture)) << picture;
  EXPECT_FALSE(contains(text_of(directory / "log.txt"), "missing")) << text_of(directory / "log.txt");
  EXPECT_TRUE(contains(text_of(directory / "summary.json"), "\"near_pressure\": {"));
  EXPECT_EQ(call({"report", directory.string()}).code, 0);
}

/// Bodies and reactions have figures of their own; gnuplot, whose words go to the same place as the program's, has nothing to
/// say even where nothing happens but rounding.
TEST(GasRun, DrawsBodiesReactionsAndNothingAtAllWithoutComplaints) {
  struct Drawn {
    const char* name;
    std::vector<std::string> changes;
    const char* picture;
  };
  for (const Drawn& drawn : {Drawn{"gas_driven_projectile", {"cell_size=20 mm", "end_time=0.1 ms"}, "bodies.png"},
                             {"closed_ring", {"end_time=3"}, "bodies.png"},
                             {"detonation_tnt", {"cell_size=1 mm", "end_time=1 us"}, "reactions.png"},
                             {"contact_at_rest", {}, "energy.png"}}) {
    const Case c = read_case(shipped(drawn.name), drawn.changes);
    const fs::path directory = scratch() / drawn.name;
    prepare_directory(directory, c, false);
    Simulation s = set_up(c);
    testing::internal::CaptureStderr();
    const RunResult result = run(c, s, {directory, {}});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << drawn.name;
    EXPECT_EQ(result.ending, Ending::done) << result.message;
    EXPECT_TRUE(fs::exists(directory / drawn.picture)) << drawn.name;
    EXPECT_FALSE(contains(text_of(directory / "log.txt"), "missing")) << text_of(directory / "log.txt");
  }
}

/// The profile comes along with the run: nothing of where the case was is needed to go on.
TEST(GasRun, FindsItsProfileWhereverItsDirectoryIs) {
  const fs::path directory = scratch(), elsewhere = directory / "elsewhere";
  fs::create_directories(elsewhere);
  for (const char* name : {"entropy_wave.toml", "entropy_wave.csv"})
    fs::copy_file(fs::path(BRISANCE_SOURCE_DIR) / "data/cases" / name, elsewhere / name);
  const auto call = [](const std::vector<std::string>& words) {
    std::vector<std::string> all = {"brisance"};
    all.insert(all.end(), words.begin(), words.end());
    return call_program(run_command_line, all);
  };
  const Answer check = call({"check", (elsewhere / "entropy_wave.toml").string()});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_TRUE(contains(check.out, "100 cells")) << check.out;
  // The reference of the figure is the same file, and stays where it is.
  const Answer ran =
      call({"run", (elsewhere / "entropy_wave.toml").string(), "-o", (directory / "run").string(), "--set", "cell_size=0.1",
            "--set", "figure.0.reference=" + (shipped("entropy_wave").parent_path() / "entropy_wave.csv").string()});
  ASSERT_EQ(ran.code, 0) << ran.err;
  fs::remove_all(elsewhere);
  fs::rename(directory / "run", directory / "moved");
  const Answer report = call({"report", (directory / "moved").string()});
  EXPECT_EQ(report.code, 0) << report.out << report.err;
}

}  // namespace
}  // namespace brisance::simulator
