// A run that was interrupted ends as one that was not, bit for bit; a damaged checkpoint is found out.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <limits>
#include <sstream>

#include "simulator/case_reader.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

const std::string gauges =
    "[[gauge]]\nname = \"rear\"\nkind = \"point\"\nfields = [\"velocity\", \"temperature\"]\nfrom = [0, \"11 mm\"]\n"
    "[[measure]]\nkind = \"final_length\"\n"
    "[output]\nfigures = false\nsnapshot_interval = \"2 us\"\n";

struct Fixture {
  fs::path directory = scratch();
  Case c;
  explicit Fixture(const std::string& more = gauges) { c = read_case(write_text(directory / "bar.toml", small_bar(more))); }
  fs::path fresh(const std::string& name) const {
    prepare_directory(directory / name, c, false);
    return directory / name;
  }
};

/// What was done after the last checkpoint has taken time as well.
TEST(Restart, LetsTheClockOfTheLogGoOn) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation first = set_up(f.c);
  ASSERT_EQ(run(f.c, first, {directory, {}, 17}).ending, Ending::interrupted);
  Log(directory / "log.txt").line("an hour later");
  std::string log = text_of(directory / "log.txt");
  log.replace(log.rfind("an hour later") - 14, 10, "   3600.00");
  write_text(directory / "log.txt", log);
  Simulation second = set_up(f.c);
  const RunResult resumed = resume(f.c, second, {directory, {}});
  ASSERT_EQ(resumed.ending, Ending::done) << resumed.message;
  EXPECT_GE(resumed.summary.wall_time, 3600.0);
  double last = 0.0;
  std::istringstream lines(text_of(directory / "log.txt"));
  for (std::string line; std::getline(lines, line); last = std::stod(line)) EXPECT_GE(std::stod(line), last) << line;
}

TEST(Restart, GivesTheBitsOfARunThatNeverStopped) {
  const Fixture f;
  Simulation whole = set_up(f.c);
  const RunResult uninterrupted = run(f.c, whole, {f.fresh("whole"), {}});
  ASSERT_EQ(uninterrupted.ending, Ending::done) << uninterrupted.message;
  ASSERT_GT(whole.step, 60);

  const fs::path parts = f.fresh("parts");
  Simulation first = set_up(f.c);
  EXPECT_EQ(run(f.c, first, {parts, {}, 17}).ending, Ending::interrupted);
  EXPECT_EQ(first.step, 17);
  Simulation second = set_up(f.c);
  EXPECT_EQ(resume(f.c, second, {parts, {}, 23}).ending, Ending::interrupted);
  Simulation third = set_up(f.c);
  const RunResult resumed = resume(f.c, third, {parts, {}});
  ASSERT_EQ(resumed.ending, Ending::done) << resumed.message;

  EXPECT_EQ(third.step, whole.step);
  EXPECT_EQ(third.time, whole.time);
  EXPECT_TRUE(bits_of(third) == bits_of(whole));
  // Books, rows and measures go on where they were as well.
  EXPECT_EQ(text_of(parts / "history.csv"), text_of(f.directory / "whole" / "history.csv"));
  EXPECT_EQ(text_of(parts / "bar_particles.hdf.series"), text_of(f.directory / "whole" / "bar_particles.hdf.series"));
  for (const char* name : {"bar_particles_000000.hdf", "bar_particles_000002.hdf", "bar_particles_000004.hdf"})
    EXPECT_TRUE(text_of(parts / name) == text_of(f.directory / "whole" / name)) << name;
  EXPECT_EQ(resumed.summary.measures.at(0).value, uninterrupted.summary.measures.at(0).value);
}

TEST(Restart, FindsAWallThatTravelsWhereItWas) {
  const Fixture f("velocity = {time = [0, \"2 us\", \"5 us\"], value = [0, \"150 m/s\", \"60 m/s\"]}\n" + gauges);
  Simulation whole = set_up(f.c);
  ASSERT_EQ(run(f.c, whole, {f.fresh("whole"), {}}).ending, Ending::done);
  EXPECT_GT(whole.grid.origin[1], 0.5 * f.c.cell_size) << "it has gone too short a way to matter";
  const fs::path parts = f.fresh("parts");
  Simulation first = set_up(f.c), second = set_up(f.c);
  EXPECT_EQ(run(f.c, first, {parts, {}, 37}).ending, Ending::interrupted);
  ASSERT_EQ(resume(f.c, second, {parts, {}}).ending, Ending::done);
  EXPECT_TRUE(bits_of(second) == bits_of(whole));
  EXPECT_EQ(text_of(parts / "history.csv"), text_of(f.directory / "whole" / "history.csv"));
}

TEST(Restart, WorksAfterAKillAtAnyMoment) {
  const Fixture f("[output]\nfigures = false\ncheckpoint_steps = 2\n");
  Simulation whole = set_up(f.c);
  ASSERT_EQ(run(f.c, whole, {f.fresh("whole"), {}}).ending, Ending::done);

  const fs::path directory = f.fresh("killed");
  const auto is_finished = [&] { return fs::exists(directory / "summary.json"); };
  unsigned random = 12345;
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    if (is_finished()) fs::remove_all(directory), f.fresh("killed");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      Simulation s = set_up(f.c);
      resume(f.c, s, {directory, {}});
      for (;;) pause();  // until it is killed
    }
    random = random * 1664525u + 1013904223u;
    usleep(2000 + random % 60000);
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    killed += WIFSIGNALED(status);
  }
  EXPECT_EQ(killed, 20);
  Simulation last = set_up(f.c);
  const Ending expected = is_finished() ? Ending::nothing_left : Ending::done;
  const RunResult result = resume(f.c, last, {directory, {}});
  ASSERT_EQ(result.ending, expected) << result.message;
  EXPECT_EQ(last.step, whole.step);
  EXPECT_TRUE(bits_of(last) == bits_of(whole));
  EXPECT_EQ(text_of(directory / "history.csv"), text_of(f.directory / "whole" / "history.csv"));
}

TEST(Restart, RowsBeyondTheCheckpointAreWrittenAgainAndNotTwice) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  run(f.c, s, {directory, {}, 20});
  const std::string history = text_of(directory / "history.csv");
  std::ofstream(directory / "history.csv", std::ios::app) << "1,2,3\nhalf a ro";  // as if killed while it went on
  Simulation again = set_up(f.c);
  ASSERT_EQ(resume(f.c, again, {directory, {}, 0}).ending, Ending::interrupted);
  EXPECT_EQ(text_of(directory / "history.csv"), history);
}

TEST(Restart, AFinishedRunGoesOnUntilALaterTime) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  ASSERT_EQ(run(f.c, s, {directory, {}}).ending, Ending::done);
  const std::string history = text_of(directory / "history.csv");
  Simulation same = set_up(f.c);
  ASSERT_EQ(resume(f.c, same, {directory, {}}).ending, Ending::nothing_left);
  EXPECT_EQ(text_of(directory / "history.csv"), history) << "there was nothing left to do";
  const double later = 1.2 * f.c.end_time;
  Simulation longer = set_up(f.c);
  ASSERT_EQ(resume(f.c, longer, {directory, later}).ending, Ending::done);
  EXPECT_NEAR(longer.time, later, 1e-12 * later);
}

/// What the case reads has come along with it.
TEST(Restart, WorksInADirectoryThatWasMoved) {
  const fs::path directory = scratch();
  write_text(directory / "measured.csv", "radius [mm],height [mm]\n3.2,1\n3.2,9\n");
  const fs::path file =
      write_text(directory / "bar.toml",
                 small_bar("[[measure]]\nkind = \"profile_error\"\nprofile = \"measured.csv\"\n[output]\nfigures = false\n"));
  const Case c = read_case(file);
  prepare_directory(directory / "run", c, false);
  Simulation s = set_up(c);
  ASSERT_EQ(run(c, s, {directory / "run", {}, 10}).ending, Ending::interrupted);
  const fs::path elsewhere = directory.string() + "_moved";
  fs::remove_all(elsewhere);
  fs::rename(directory / "run", elsewhere);
  fs::remove_all(directory);
  const Case moved = read_case(elsewhere / "case.toml");
  Simulation again = set_up(moved);
  const RunResult result = resume(moved, again, {elsewhere, {}, 10});
  EXPECT_EQ(result.ending, Ending::interrupted) << result.message;
  EXPECT_EQ(again.step, 20);
  EXPECT_EQ(result.summary.measures.at(0).name, "profile_error");
}

/// Of a run that goes on after its end and is killed, no summary says that it is done.
TEST(Restart, ASummaryTellsOfNoOtherRun) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  ASSERT_EQ(run(f.c, s, {directory, {}, 5}).ending, Ending::interrupted);
  ASSERT_TRUE(fs::exists(directory / "summary.json"));
  fs::remove(directory / "history.csv");
  fs::create_directory(directory / "summary.json.part");  // it cannot be written
  Simulation again = set_up(f.c);
  const RunResult result = resume(f.c, again, {directory, {}, 5});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_NE(result.message.find("history.csv"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("summary.json: cannot be written"), std::string::npos) << result.message;
  EXPECT_EQ(result.summary.ending, "failed");
  EXPECT_FALSE(fs::exists(directory / "summary.json"));
}

TEST(Checkpoint, ATruncatedOneIsFoundOutAndTheOlderIsUsed) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  run(f.c, s, {directory, {}, 10});
  const std::vector<std::uint64_t> at_10 = bits_of(s);
  Simulation later = set_up(f.c);
  resume(f.c, later, {directory, {}, 10});
  Restored newest;
  {
    Simulation probe = set_up(f.c);
    newest = restore_newest(directory, probe);
    EXPECT_EQ(probe.step, 20);
  }
  fs::resize_file(newest.file, fs::file_size(newest.file) / 2);
  Simulation fallen_back = set_up(f.c);
  std::string report;
  const Restored older = restore_newest(directory, fallen_back, [&](const std::string& text) { report = text; });
  EXPECT_NE(older.file, newest.file);
  EXPECT_EQ(fallen_back.step, 10);
  EXPECT_TRUE(bits_of(fallen_back) == at_10);
  EXPECT_NE(report.find(newest.file.string() + ": is damaged"), std::string::npos) << report;
}

TEST(Checkpoint, OneFlippedBitIsFoundOut) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  run(f.c, s, {directory, {}, 3});
  Simulation probe = set_up(f.c);
  const Restored newest = restore_newest(directory, probe);
  // A bit of some particle's number: find the bytes of one in the file.
  const double x = s.bodies[0].particles.motion.at(0, 100);
  std::string bytes = text_of(newest.file);
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&x), sizeof x));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  std::ofstream(newest.file, std::ios::binary) << bytes;
  Simulation victim = set_up(f.c);
  try {
    restore_newest(directory, victim);
    FAIL() << "the flipped bit was not noticed";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("checksum"), std::string::npos) << error.what();
  }
}

TEST(Checkpoint, OneOfAnotherCaseIsRefused) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  run(f.c, s, {directory, {}, 1});
  Case other = f.c;
  other.bodies[0].name = "rod";
  Simulation rod = set_up(other);
  EXPECT_THROW(restore_newest(directory, rod), std::runtime_error);
}

TEST(Checkpoint, AFullDiskIsReportedAndLeavesTheOlderOneGood) {
  const Fixture f;
  const fs::path directory = f.fresh("run");
  Simulation s = set_up(f.c);
  run(f.c, s, {directory, {}, 5});
  const std::string message = on_a_full_disk([&] { write_checkpoint(directory, s, {}); });
  EXPECT_NE(message.find("checkpoint_"), std::string::npos) << message;
  EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
  Simulation good = set_up(f.c);
  EXPECT_NO_THROW(restore_newest(directory, good));
  EXPECT_EQ(good.step, 5);
}

}  // namespace
}  // namespace brisance::simulator
