// brisance as its users meet it: commands, files, messages and exit codes.

#include <gtest/gtest.h>
#include <omp.h>
#include <signal.h>

#include <cstdlib>

#include "models/programs/progress.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/commands.hpp"
#include "simulator/describe.hpp"
#include "simulator/dry_run.hpp"
#include "simulator/formula.hpp"
#include "simulator/keys.hpp"
#include "simulator/memory_need.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

Answer call(std::vector<std::string> words) {
  words.insert(words.begin(), "brisance");
  return call_program(run_command_line, std::move(words));
}

const std::string no_figures = "[output]\nfigures = false\n";

TEST(RunCommand, LeavesACompleteDirectoryAndSaysWhatCameOut) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "bar.toml", small_bar("[[measure]]\nkind = \"final_length\"\n"));
  const Answer a = call({"run", file.string(), "-o", (directory / "run").string(), "--threads", "1", "--set", "end_time=1 us"});
  EXPECT_EQ(a.code, done) << a.err;
  EXPECT_TRUE(contains(a.out, "final_length")) << a.out;
  for (const char* name : {"case.toml", "log.txt", "history.csv", "summary.json", "bar_particles_000000.hdf",
                           "bar_particles.hdf.series", "checkpoint_a.h5", "energy.png", "field.png", "profile_bar.png"})
    EXPECT_TRUE(fs::exists(directory / "run" / name)) << name << "\n" << text_of(directory / "run" / "log.txt");
}

/// What was computed is not what the title says: a line below it tells the difference, then and later.
TEST(RunCommand, NamesWhatWasSet) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string(), said = "with end_time=0.2 us, numerics.courant=0.3";
  const std::vector<std::string> set = {"--set", "end_time = 0.2 us", "--set", "title = Bar", "--set", "numerics.courant=0.3"};
  std::vector<std::string> words = {"run", file, "-o", run};
  words.insert(words.end(), set.begin(), set.end());
  EXPECT_TRUE(contains(call(words).out, "Bar: done\n  " + said + '\n'));
  EXPECT_TRUE(contains(text_of(directory / "run" / "summary.json"), "\"subtitle\": \"" + said + '"'));
  EXPECT_TRUE(contains(text_of(directory / "run" / "log.txt"), "Bar, " + said));
  EXPECT_TRUE(contains(call({"report", run}).out, said));
  EXPECT_FALSE(contains(call({"check", file}).out, "Small bar\n  with "));
  EXPECT_FALSE(contains(call({"check", file, "--set", "gates.fastest=200"}).out, "Small bar\n  with "))
      << "a gate changes nothing that is computed, and is raised by hand later";
}

/// Deviations from an experiment that was another one are not left without a remark.
TEST(RunCommand, SaysThatTheExperimentOfItsMeasuresIsAnother) {
  const fs::path directory = scratch();
  const std::string measure = no_figures + "[[measure]]\nkind = \"final_length\"\n",
                    compared = write_text(directory / "bar.toml", small_bar(measure + "measured = \"11 mm\"\n")).string(),
                    alone = write_text(directory / "alone.toml", small_bar(measure)).string(),
                    run = (directory / "run").string(),
                    caution = "caution: measured is the experiment of the case as its file states it; --set has changed ";
  const auto told = [&](const std::string& file, const std::string& set) {
    return call({"run", file, "-o", run, "--overwrite", "--set", "end_time=0.1 us", "--set", set}).out;
  };
  const std::string velocity = "solid.0.velocity=[0, \"-210 m/s\"]";
  EXPECT_TRUE(contains(told(compared, velocity), caution + velocity + '\n'));
  EXPECT_TRUE(contains(call({"report", run}).out, caution + velocity + '\n')) << "later as well";
  EXPECT_TRUE(contains(text_of(directory / "run" / "summary.json"), "\"other_experiment\": [\n    \"solid.0.velocity=["));
  for (const char* model : {"cell_size=0.4 mm", "solid.0.material.flow_stress.A=95 MPa", "solid.0.particles_per_direction=3"})
    EXPECT_FALSE(contains(told(compared, model), caution)) << model;
  EXPECT_FALSE(contains(told(alone, velocity), caution)) << "nothing is compared";
}

TEST(RunCommand, ACaseWithMistakesIsBadInput) {
  const fs::path directory = scratch();
  const Answer a = call({"run", write_text(directory / "bar.toml", small_bar("[numerics]\ncourrant = 0.3\n")).string()});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_TRUE(contains(a.err, "courant")) << a.err;
  const Answer missing = call({"run", (directory / "bat.toml").string()});
  EXPECT_EQ(missing.code, bad_input);
  EXPECT_TRUE(contains(missing.err, "bat.toml: there is no such file; did you mean \"bar.toml\"?")) << missing.err;
  EXPECT_EQ(call({"fly"}).code, bad_input);
  EXPECT_EQ(call({"--help"}).code, done);
}

/// Kilojoules for megajoules: dense products with less energy than they have when cold.
TEST(CommandLine, ChecksThatTheFirstStepCanBeTaken) {
  const fs::path directory = scratch();
  const std::string materials = std::string(BRISANCE_SOURCE_DIR) + "/data/materials/";
  const auto charge = [&](const std::string& energy) {
    return write_text(directory / "charge.toml", R"(geometry = "spherical_1d"
cell_size = "5 mm"
end_time = "1 ms"
[gas]
lower = [0]
upper = ["0.5 m"]
[[gas.fluid]]
name = "air"
material = ")" + materials + R"(air.toml"
[[gas.fluid]]
name = "products"
material = ")" + materials + R"(tnt_products.toml"
[[gas.fill]]
fluid = "air"
density = "1.2 kg/m^3"
pressure = "1e5 Pa"
[[gas.fill]]
fluid = "products"
shape = { sphere = { centre = [0], radius = "52.7 mm" } }
density = "1630 kg/m^3"
energy = ")" + energy + "\"\n")
        .string();
  };
  const Answer cold = call({"check", charge("4.3 kJ")}), hot = call({"check", charge("4.3 MJ")});
  EXPECT_EQ(cold.code, done);
  EXPECT_TRUE(contains(cold.out, "warning: its first step fails, however short")) << cold.out;
  EXPECT_FALSE(contains(cold.out, "ns per cell")) << cold.out;
  EXPECT_FALSE(contains(hot.out, "warning")) << hot.out;
  EXPECT_TRUE(contains(hot.out, "ns per cell")) << hot.out;
}

TEST(CommandLine, SaysWhatIsMeantByAWordThatItDoesNotTake) {
  EXPECT_TRUE(contains(call({"run", "sod", "--set", "end_time=12", "us", "--overwrite"}).err,
                       "run: \"us\" was not expected; a value with spaces stands in quotes: --set \"end_time=12 us\"\n"));
  EXPECT_TRUE(contains(call({"run", "--set", "end_time=12", "us", "sod"}).err,
                       "run: \"us\" was not expected; a value with spaces stands in quotes: --set \"end_time=12 us\"\n"))
      << "it stands where the case would";
  EXPECT_EQ(call({"check", "sod", "foo"}).err, "check: \"foo\" was not expected\n") << "it follows no option";
  EXPECT_EQ(call({"run", "--overwrite", "sod", "foo"}).err, "run: \"foo\" was not expected\n") << "a flag has no value";
  EXPECT_EQ(call({"run", "--set", "end_time=1", "sod", "foo"}).err, "run: \"foo\" was not expected\n") << "it has its value";
  const Answer a = call({"resume", "bar_run", "--untli=3", "us"});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_EQ(a.err, "resume: \"--untli\" is no option; there are --help, --until, --threads; did you mean \"--until\"?\n");
  EXPECT_TRUE(contains(call({"--versoin"}).err, "did you mean \"--version\"?"));
}

TEST(CommandLine, ListsTheCommandsWhereNoneIsGiven) {
  const Answer a = call({});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_EQ(a.out, "");
  for (const char* command : {"run", "check", "resume", "report", "list", "describe"})
    EXPECT_TRUE(contains(a.err, std::string("\n  ") + command + "  ")) << command;
}

TEST(CommandLine, NamesWhatItsOptionsTake) {
  EXPECT_TRUE(contains(call({"run", "--help"}).out, "--set KEY=VALUE ..."));
  EXPECT_TRUE(contains(call({"resume", "--help"}).out, "--until TIME"));
  for (const char* command : {"run", "check", "resume", "report", "list", "describe"})
    EXPECT_FALSE(contains(call({command, "--help"}).out, "TEXT")) << command;
}

TEST(RunCommand, TakesAsManyThreadsAsPay) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string();
  const auto threads_of = [&](const std::vector<std::string>& given) {
    std::vector<std::string> words = {"run",        file, "-o", (directory / "run").string(), "--set", "end_time=0.1 us",
                                      "--overwrite"};
    words.insert(words.end(), given.begin(), given.end());
    omp_set_num_threads(3);
    EXPECT_EQ(call(words).code, done);
    const std::string log = text_of(directory / "run" / "log.txt");
    return log.substr(log.find(" thread") - 1, 1);
  };
  const int as_before = omp_get_max_threads();
  setenv("OMP_NUM_THREADS", "3", 1);
  EXPECT_EQ(threads_of({}), "3") << "as the user says";
  EXPECT_EQ(threads_of({"--threads", "2"}), "2");
  unsetenv("OMP_NUM_THREADS");
  EXPECT_EQ(threads_of({"--threads", "2"}), "2");
  EXPECT_EQ(threads_of({}), "1") << "few particles";
  setenv("OMP_NUM_THREADS", "1", 1);
  omp_set_num_threads(as_before);
}

TEST(RunCommand, RefusesADirectoryThatHoldsSomethingElse) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  fs::create_directories(run);
  write_text(directory / "run" / "thesis.tex", "years of work");
  const Answer foreign = call({"run", file, "-o", run, "--set", "end_time=0.2 us"});
  EXPECT_EQ(foreign.code, bad_input);
  EXPECT_TRUE(contains(foreign.err, "holds files that are no run")) << foreign.err;
  EXPECT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.2 us", "--overwrite"}).code, done);
  EXPECT_EQ(text_of(directory / "run" / "thesis.tex"), "years of work");
  const std::string finished = text_of(directory / "run" / "history.csv");
  const Answer again = call({"run", file, "-o", run, "--set", "end_time=0.2 us"});
  EXPECT_EQ(again.code, bad_input) << "the same case again";
  EXPECT_TRUE(contains(again.err, "holds this run, finished")) << again.err;
  EXPECT_EQ(text_of(directory / "run" / "history.csv"), finished);
  EXPECT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.2 us", "--overwrite"}).code, done);
  const Answer other = call({"run", file, "-o", run, "--set", "cell_size=0.4 mm", "--set", "gates.fastest=300"});
  EXPECT_EQ(other.code, bad_input);
  EXPECT_TRUE(contains(other.err,
                       "holds a run of another case: cell_size is 8e-04 there, not 4e-04; gates.fastest is missing "
                       "there, not 300; choose another directory"))
      << other.err;
  const Answer longer = call({"run", file, "-o", run, "--set", "end_time=0.3 us"});
  EXPECT_EQ(longer.code, bad_input);
  EXPECT_TRUE(contains(longer.err, "holds this run with its end at 2e-07 s, not 3e-07 s")) << longer.err;
  EXPECT_EQ(call({"run", file, "-o", file}).code, bad_input) << "a file is no directory";
}

/// Whatever it holds: dates, and tables in lists of something else, are in no case that has been run.
TEST(RunCommand, SaysHowAnyOtherFileDiffers) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string();
  write_text(directory / "case.toml", "day = 1979-05-27\nmixed = [1, { a = 1 }]\n");
  const Answer a = call({"run", file, "-o", directory.string()});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_TRUE(contains(a.err, "holds a run of another case: ")) << a.err;
}

/// However its values were set, and to whatever end it has been resumed.
TEST(RunCommand, KnowsTheSameCaseAgain) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string(), courant = "numerics.courant=0.3", end = "end_time=0.2 us";
  ASSERT_EQ(call({"run", file, "-o", run, "--set", courant, "--set", end}).code, done);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{end, courant, "cell_size=0.8 mm"}, {courant, end, end}}) {
    std::vector<std::string> all = {"run", file, "-o", run};
    for (const std::string& set : words) all.insert(all.end(), {"--set", set});
    EXPECT_TRUE(contains(call(all).err, "holds this run, finished")) << call(all).err;
  }
  ASSERT_EQ(call({"resume", run, "--until", "0.4 us"}).code, done);
  const Answer a = call({"run", file, "-o", run, "--set", courant, "--set", end});
  EXPECT_TRUE(contains(a.err, "holds this run with its end at 4e-07 s, not 2e-07 s")) << a.err;
}

TEST(RunCommand, ADirectoryThatCannotBeMadeIsNamed) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string();
  const Answer a = call({"run", file, "-o", "/proc/brisance/run"});
  EXPECT_EQ(a.code, failed_while_running);
  EXPECT_TRUE(contains(a.err, "/proc/brisance/run: cannot be made")) << a.err;
}

TEST(RunCommand, AFullDiskEndsTheRunAndNamesTheFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.2 us"}).code, done);
  fs::remove(directory / "run" / "log.txt");
  fs::rename(directory / "run" / "history.csv", directory / "run" / "kept.csv");
  // Rows go to a device that is always full.
  fs::create_symlink("/dev/full", directory / "run" / "history.csv.part");
  const Answer a = call({"resume", run, "--until", "4e-7"});
  EXPECT_EQ(a.code, failed_while_running);
  EXPECT_TRUE(contains(a.err, "history.csv")) << a.err;
  EXPECT_TRUE(contains(a.err, "last checkpoint: ")) << a.err;
}

TEST(RunCommand, BooksThatDoNotCloseEndTheRunWithAReport) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  // Nothing closes better than to round-off.
  const Answer a = call({"run", file, "-o", run, "--set", "gates.residual=1e-30", "--set", "output.checkpoint_steps=1", "--set",
                         "output.history_interval=0.5 us"});
  EXPECT_EQ(a.code, failed_while_running);
  EXPECT_TRUE(contains(a.err, "gate residual: ")) << a.err;
  EXPECT_TRUE(contains(a.err, "last checkpoint: " + run)) << a.err;
  EXPECT_TRUE(contains(a.out, "in no book")) << a.out;
  const std::string summary = text_of(directory / "run" / "summary.json");
  EXPECT_TRUE(contains(summary, "\"ending\": \"failed\"") && contains(summary, "gate residual: ")) << summary;

  const Answer report = call({"report", run});
  EXPECT_EQ(report.code, failed_while_running);
  EXPECT_TRUE(report.err.starts_with("this run failed at 5")) << report.err;
  EXPECT_TRUE(contains(report.err, " s\nthe results up to the row")) << "a line of its own: " << report.err;
  EXPECT_TRUE(contains(report.err, a.err.substr(0, a.err.find("\npictures of")))) << report.err;
  EXPECT_TRUE(report.out.starts_with("Small bar: failed, as of checkpoint_")) << report.out;
}

/// The bar is slower than the gate's limit by the second row; that the first one was beyond it is not forgotten.
TEST(ResumeCommand, DoesNotPassAGateUnlessItsLimitIsRaisedAndTellsOfIt) {
  const fs::path directory = scratch();
  const std::string file = write_text(
                               directory / "bar.toml",
                               small_bar("[gates]\nfastest = 189\n[output]\nfigures = false\nhistory_interval = \"6.9 us\"\n"))
                               .string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run}).code, failed_while_running);
  const Answer again = call({"resume", run});
  EXPECT_EQ(again.code, failed_while_running) << again.out;
  EXPECT_TRUE(contains(again.err, "gate fastest: ") && contains(again.err, "time 0 s")) << again.err;
  EXPECT_TRUE(contains(again.err, "raise the limit under [gates] in " + run + "/case.toml and resume")) << again.err;

  std::string text = text_of(directory / "run" / "case.toml");
  text.replace(text.find("fastest = 189"), 13, "fastest = 191");
  write_text(directory / "run" / "case.toml", text);
  const Answer on = call({"resume", run});
  EXPECT_EQ(on.code, done) << on.err;
  const std::string told = "resumed after gate fastest: a particle of bar";
  const auto first = on.out.find(told);
  EXPECT_NE(first, std::string::npos) << on.out;
  EXPECT_EQ(on.out.find(told, first + 1), std::string::npos) << "once: " << on.out;
  EXPECT_TRUE(contains(text_of(directory / "run" / "log.txt"), told));
  EXPECT_TRUE(contains(text_of(directory / "run" / "summary.json"), "\"resumed_after\": [\n    \"gate fastest: "));
  EXPECT_TRUE(contains(call({"report", run}).out, told));
}

/// At --until a row of its own is judged. It is not forgotten, though a plain `resume` has none there.
TEST(ResumeCommand, MeetsAGateAgainThatARowOfItsOwnHadMet) {
  const fs::path directory = scratch();
  const fs::path run_directory = directory / "run";
  const Case c = read_case(write_text(
      directory / "bar.toml", small_bar("[output]\nfigures = false\nhistory_interval = \"6.9 us\"\n[gates]\nfastest = 191\n")));
  Simulation s = set_up(c);
  prepare_directory(run_directory, c, false);
  ASSERT_EQ(run(c, s, {run_directory, {}, 3}).ending, Ending::interrupted);
  std::string text = text_of(run_directory / "case.toml");
  text.replace(text.find("fastest = 191"), 13, "fastest = 100");
  write_text(run_directory / "case.toml", text);
  const Answer first = call({"resume", run_directory.string(), "--until", "0.3 us"});
  EXPECT_TRUE(contains(first.err, "gate fastest: ") && contains(first.err, "time 3e-07 s")) << first.err;
  const Case gated = read_case(run_directory / "case.toml");
  Simulation before = set_up(gated);
  ASSERT_EQ(resume(gated, before, {run_directory, {}, 0}).ending, Ending::interrupted) << "nor if it does not come as far";
  fs::remove(run_directory / "summary.json");  // as if it had been killed
  const Answer again = call({"resume", run_directory.string()});
  EXPECT_EQ(again.code, failed_while_running) << again.out;
  const std::size_t at = again.err.find(", time ");
  ASSERT_NE(at, std::string::npos) << again.err;
  EXPECT_NEAR(std::stod(again.err.substr(at + 7)), 3e-7, 1e-7) << "not at the row of 6.9 us";
}

/// So that a plain `resume` after an interrupt goes as far; there are as many rows as of a case that ends then.
TEST(ResumeCommand, RemembersALaterTimeAndKeepsWhatCameAlongBesideTheCase) {
  const fs::path directory = scratch();
  const std::string profile = write_text(directory / "profile.csv", "height [mm],radius [mm]\n1,3.3\n2,3.2\n").string();
  const std::string file = write_text(directory / "bar.toml",
                                      small_bar(no_figures + "[[measure]]\nkind = \"profile_error\"\naxis = "
                                                             "\"y\"\nprofile = \"profile.csv\"\n"))
                               .string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.5 us"}).code, done);
  EXPECT_EQ(call({"resume", run, "--until", "-1"}).code, bad_input);
  const Answer later = call({"resume", run, "--until", "1 us"});
  ASSERT_EQ(later.code, done);
  EXPECT_FALSE(contains(later.err, "counts seconds"));
  fs::remove(profile);
  fs::rename(directory / "run", directory / "moved");
  const Case c = read_case(directory / "moved" / "case.toml");
  EXPECT_EQ(c.end_time, 1e-6);
  EXPECT_EQ(c.below_title(), "with end_time=1e-06 s");
  EXPECT_DOUBLE_EQ(row_interval(c), 1e-6 / 500);
  const Answer a = call({"resume", (directory / "moved").string()});
  EXPECT_TRUE(contains(a.out, "come to 1e-06 s, and its end is at 1e-06 s")) << a.out << a.err;
}

/// What cannot be restored does not become longer either.
TEST(ResumeCommand, RemembersALaterTimeOnlyOnceTheRunIsRestored) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.2 us"}).code, done);
  const std::string text = text_of(directory / "run" / "case.toml");
  for (const char* name : {"checkpoint_a.h5", "checkpoint_b.h5"}) write_text(directory / "run" / name, "no checkpoint");
  EXPECT_EQ(call({"resume", run, "--until", "0.4 us"}).code, failed_while_running);
  EXPECT_EQ(text_of(directory / "run" / "case.toml"), text);
}

/// A failed run has not come to a good end because a time before the failure is named.
TEST(ResumeCommand, OfAFailedRunUntilAnEarlierTimeSaysThatItIsBeyond) {
  const fs::path directory = scratch();
  const std::string file = write_text(
                               directory / "bar.toml",
                               small_bar("[output]\nfigures = false\ncheckpoint_steps = 1\nhistory_interval = \"0.5 us\"\n"))
                               .string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "gates.residual=1e-30"}).code, failed_while_running);
  const Answer a = call({"resume", run, "--until", "0.1 us"});
  EXPECT_TRUE(contains(a.out, "and --until is at 1e-07 s, before that")) << a.out << a.err;
  EXPECT_TRUE(contains(text_of(directory / "run" / "summary.json"), "\"ending\": \"failed\""));
}

/// An earlier time is a stop on the way.
TEST(ResumeCommand, GoesOnToTheEndOfTheCaseAfterAnEarlierTime) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "gates.fastest=1", "--set", "end_time=0.5 us"}).code, failed_while_running);
  std::string text = text_of(directory / "run" / "case.toml");
  text.replace(text.find("fastest = 1"), 11, "fastest = 999");
  write_text(directory / "run" / "case.toml", text);
  EXPECT_TRUE(contains(call({"resume", run, "--until", "0.2 us"}).out, "time 2e-07 s"));
  EXPECT_TRUE(contains(call({"resume", run}).out, "time 5e-07 s"));
}

TEST(ResumeCommand, GoesOnUntilALaterTimeAndReportTellsTheSame) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures + "[[measure]]\nkind = \"final_length\"\n"))
                               .string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.5 us"}).code, done);
  const Answer resumed = call({"resume", run, "--until", "1e-6"});
  EXPECT_EQ(resumed.code, done) << resumed.err;
  const Answer report = call({"report", run});
  EXPECT_EQ(report.code, done) << report.err;
  const auto line = [](const std::string& text) { return text.substr(text.find("final_length"), 60); };
  EXPECT_EQ(line(report.out), line(resumed.out));
  EXPECT_TRUE(fs::exists(directory / "run" / "energy.png"));
  EXPECT_EQ(call({"resume", directory.string()}).code, bad_input);
}

/// Two walls along an axis: the grid cannot go with the one that moves, at 100 m/s, by half a cell of 0.8 mm in 4 us.
TEST(ResumeCommand, RefusesALaterTimeThatTheCaseCouldNotHave) {
  const fs::path directory = scratch();
  const std::string walls =
      "[[boundary]]\nkind = \"rigid_wall\"\naxis = \"y\"\nposition = \"16 mm\"\nside = \"below\"\n"
      "velocity = \"-100 m/s\"\n";
  const std::string file = write_text(directory / "bar.toml", small_bar(walls + no_figures)).string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.5 us"}).code, done);
  const std::string summary = text_of(directory / "run" / "summary.json");
  const Answer refused = call({"resume", run, "--until", "5 us"});
  EXPECT_EQ(refused.code, bad_input);
  EXPECT_TRUE(contains(refused.err, "case.toml:") && contains(refused.err, "may move half a cell")) << refused.err;
  EXPECT_EQ(text_of(directory / "run" / "summary.json"), summary);
  EXPECT_EQ(call({"resume", run, "--until", "1 us"}).code, done);
}

/// What is foreseen of the longer time is said before it begins, and that of a run stands in its log as well.
TEST(ResumeCommand, WarnsOfWhatALaterTimeBrings) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "tube.toml",
                                      box_of_air("10 mm", "20 us", "[0, 0]", "[0.2, 0.05]") + R"([[gas.body]]
name = "piston"
shape = { box = { lower = [-0.1, -0.1], upper = [0.1, 0.1] } }
velocity = [300, 0]
)" + no_figures)
                               .string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run}).err, "");
  const Answer resumed = call({"resume", run, "--until", "400 us"});
  EXPECT_TRUE(contains(resumed.err, "warning: piston: at 0.00031")) << resumed.err;
  const std::string longer = (directory / "longer").string();
  EXPECT_TRUE(contains(call({"run", file, "-o", longer, "--set", "end_time=400 us"}).err, "warning: piston: at 0.00031"));
  EXPECT_TRUE(contains(text_of(directory / "longer" / "log.txt"), "warning: piston: at 0.00031"));
}

TEST(ResumeCommand, OfARunThatHasComeToItsEndSaysSoAndTouchesNothing) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  ASSERT_EQ(call({"run", file, "-o", run, "--set", "end_time=0.5 us"}).code, done);
  const std::string summary = text_of(directory / "run" / "summary.json"), log = text_of(directory / "run" / "log.txt");
  for (const std::vector<std::string>& until : {std::vector<std::string>{}, {"--until", "0.3 us"}}) {
    std::vector<std::string> words = {"resume", run};
    words.insert(words.end(), until.begin(), until.end());
    const Answer a = call(words);
    EXPECT_EQ(a.code, done) << a.err;
    EXPECT_TRUE(
        contains(a.out, "nothing was left to do: the run has come to 5e-07 s, and " +
                            std::string(until.empty() ? "its end is at 5e-07 s. " : "--until is at 3e-07 s, before that")))
        << a.out;
    EXPECT_TRUE(contains(a.out, "brisance resume " + run + " --until")) << a.out;
    EXPECT_FALSE(contains(a.out, ": done")) << a.out;
  }
  EXPECT_EQ(text_of(directory / "run" / "summary.json"), summary);
  EXPECT_EQ(text_of(directory / "run" / "log.txt"), log);
}

TEST(RunCommand, AnInterruptedRunWritesACheckpointAndGoesOn) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar(no_figures)).string(),
                    run = (directory / "run").string();
  catch_interrupts();
  raise(SIGTERM);
  const Answer a = call({"run", file, "-o", run});
  forget_interrupt();
  EXPECT_EQ(a.code, interrupted);
  EXPECT_TRUE(contains(a.err, "brisance resume " + run)) << a.err;
  EXPECT_EQ(call({"resume", run, "--until", "2e-7"}).code, done);
}

TEST(CheckCommand, TellsSizeAndTimeAndWarnsOfThinBodies) {
  const fs::path directory = scratch();
  const std::string file = write_text(directory / "bar.toml", small_bar()).string();
  const Answer fine = call({"check", file});
  EXPECT_EQ(fine.code, done) << fine.err;
  EXPECT_TRUE(contains(fine.out, "240 particles")) << fine.out;
  EXPECT_FALSE(contains(fine.out, "warning")) << fine.out;
  EXPECT_TRUE(contains(fine.out, "limited by the speed of waves")) << fine.out;
  EXPECT_TRUE(contains(call({"check", file, "--set", "numerics.first_step=1 ns"}).out, "limited by numerics.first_step"));
  const Answer coarse = call({"check", file, "--set", "cell_size=3.2 mm", "--set", "solid.0.velocity=[0, -9000]"});
  EXPECT_TRUE(contains(coarse.out, "it is 2 cells thick, fewer than 4")) << coarse.out;
  EXPECT_TRUE(contains(coarse.out, "faster than sound")) << coarse.out;
  const Answer wordy = call({"check", file, "--set", "output.history_interval=1 ps"});
  EXPECT_TRUE(contains(wordy.out, "output.history_interval gives 7e+06 rows of history.csv")) << wordy.out;
  const Answer endless = call({"check", file, "--set", "end_time=1 h"});
  EXPECT_TRUE(contains(endless.out, " days; cells twice as large take 8 times less")) << endless.out;
}

TEST(CheckCommand, ForeseesTheStepsOfAGasAndCallsBodiesParticles) {
  const std::string cases = BRISANCE_SOURCE_DIR "/data/cases/";
  const auto steps = [&](const std::string& name) {
    const std::string out = call({"check", cases + name + ".toml"}).out;
    const std::size_t at = out.find("steps, an estimate");
    return at == std::string::npos ? 0.0 : std::stod(out.substr(at + 18));
  };
  // As the runs took them: a shock tube; gas that is driven at a wall.
  EXPECT_NEAR(steps("sod"), 364.0, 0.1 * 364.0);
  EXPECT_NEAR(steps("noh_spherical_1d"), 517.0, 0.25 * 517.0);
  const std::string gun = call({"check", cases + "gas_driven_projectile.toml"}).out;
  EXPECT_TRUE(contains(gun, "2640 cells") && contains(gun, " particles")) << gun;
}

TEST(RunCommand, AFailureIsToldOnce) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "ball.toml",
                                   "geometry = \"plane\"\ncell_size = \"10 mm\"\nend_time = \"1 ms\"\n"
                                   "[gas]\nlower = [0, 0]\nupper = [\"0.3 m\", \"0.2 m\"]\n"
                                   "[[gas.fluid]]\nname = \"air\"\nmaterial = \"air.toml\"\n"
                                   "[[gas.fill]]\ntemperature = \"300 K\"\npressure = \"1 atm\"\n"
                                   "[[gas.body]]\nname = \"ball\"\nvelocity = [\"300 m/s\", 0]\n"
                                   "shape = { sphere = { centre = [\"0.2 m\", \"0.1 m\"], radius = \"50 mm\" } }\n" +
                                       no_figures);
  const Answer a = call({"run", file.string(), "-o", (directory / "run").string()});
  EXPECT_EQ(a.code, failed_while_running);
  EXPECT_TRUE(contains(a.err, "body ball: it runs into the wall high_x")) << a.err;
  EXPECT_TRUE(contains(a.err, "last checkpoint: ")) << "of the state before";
  EXPECT_FALSE(contains(a.out, "it runs into")) << a.out;
  EXPECT_TRUE(contains(text_of(directory / "run" / "log.txt"), "it runs into the wall"));
  EXPECT_TRUE(contains(text_of(directory / "run" / "summary.json"), "it runs into the wall"));
}

TEST(CheckCommand, RefusesWhatDoesNotFitIntoMemoryBeforeItIsAllocated) {
  const std::string bar = write_text(scratch() / "bar.toml", small_bar()).string();
  for (const std::vector<std::string>& huge : {std::vector<std::string>{"cylindrical_explosion", "cell_size=1e-8"},
                                               {"sedov_three_dimensional", "cell_size=1e-5"},
                                               {bar, "cell_size=1e-10"}})
    for (const char* command : {"check", "run"}) {
      const Answer a = call({command, huge[0], "--set", huge[1]});
      EXPECT_EQ(a.code, bad_input) << a.out;
      EXPECT_TRUE(contains(a.err, "which need about ") && contains(a.err, " GB are free. Take larger cells, of ")) << a.err;
      EXPECT_TRUE(contains(a.err, huge[0] == bar ? "particles" : "cells,")) << a.err;
    }
}

/// What is foreseen, from numbers alone, against what is there after some steps.
TEST(MemoryNeed, IsWhatIsTaken) {
  for (const auto& [name, cell_size] : {std::pair{"sod", "5e-5"},
                                        {"water_air_shock_tube", "5e-5"},
                                        {"cylindrical_explosion", "4e-3"},
                                        {"sedov_three_dimensional", "0.02"},
                                        {"piston_in_gas", "0.0025"},
                                        {"taylor_copper_130_mts", "0.1 mm"}}) {
    const Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases" / (std::string(name) + ".toml"),
                             {std::string("cell_size=") + cell_size});
    const MemoryNeed need = memory_need(c);
    Simulation s = set_up(c);
    constexpr double about = 0.35;  // small boxes have more ghosts
    constexpr double cut = 0.05;    // particles that the surface of a body cuts
    EXPECT_NEAR(need.points, static_cast<double>(count_points(s)), cut * need.points) << name;
    EXPECT_NEAR(1e-6 * need.bytes / dry_run(c, s).megabytes, 1.0, about) << name;
  }
}

TEST(Cases, AreFoundByTheirNames) {
  const Answer a = call({"check", "sod"});
  EXPECT_EQ(a.code, done) << a.err;
  EXPECT_TRUE(contains(a.out, "Shock tube of Sod")) << a.out;
  EXPECT_EQ(call({"check", "sod.toml"}).code, done);
  const Answer wrong = call({"run", "sodd"});
  EXPECT_EQ(wrong.code, bad_input);
  EXPECT_TRUE(contains(wrong.err, "sodd: there is no such file") && contains(wrong.err, "did you mean \"sod\"?")) << wrong.err;
  EXPECT_TRUE(contains(call({"check", BRISANCE_SOURCE_DIR "/data/cases"}).err, "it is a directory"));
  const Answer point = call({"check", "point_cycle"});
  EXPECT_EQ(point.code, bad_input);
  EXPECT_TRUE(contains(point.err, "it is a file of the point driver")) << point.err;
  EXPECT_EQ(std::count(point.err.begin(), point.err.end(), '\n'), 1) << "nothing else is wrong with it";
}

TEST(CommandLine, NamesTheNearestCommandAndTheVersion) {
  const Answer wrong = call({"descibe", "sod"});
  EXPECT_EQ(wrong.code, bad_input);
  EXPECT_TRUE(contains(wrong.err, "\"descibe\" is no command; there are run, check,") &&
              contains(wrong.err, "did you mean \"describe\"?"))
      << wrong.err;
  const Answer version = call({"--version"});
  EXPECT_EQ(version.code, done);
  EXPECT_TRUE(version.out.starts_with("brisance ")) << version.out;
}

TEST(DescribeCommand, ShowsNoLimitThatIsNone) {
  const Answer a = call({"describe", "gates"});
  EXPECT_TRUE(contains(a.out, "no limit if not given")) << a.out;
  EXPECT_FALSE(contains(a.out, "e+300")) << a.out;
}

TEST(DescribeCommand, ExplainsShapesByExamplesThatCanBeRead) {
  for (const std::string_view form : shape_forms) {
    const Answer a = call({"describe", std::string(form)});
    EXPECT_EQ(a.code, done) << a.err;
    const std::string example(example_of_shape(form));
    EXPECT_TRUE(contains(a.out, "example: shape = " + example)) << a.out;
    std::string bar = small_bar();
    const std::size_t at = bar.find("shape = ");
    bar.replace(at, bar.find('\n', at) - at, "shape = " + example);
    EXPECT_NO_THROW(static_cast<void>(read_case(write_text(scratch() / "bar.toml", bar)))) << form;
  }
  EXPECT_TRUE(contains(call({"describe", "sphere"}).out, "inner_radius"));
  EXPECT_TRUE(contains(call({"describe", "spere"}).err, "did you mean \"sphere\"?"));
}

/// Each kind of edge with the keys that are said to be needed can be read, and `pressure` refuses more.
TEST(DescribeCommand, TellsWhichKeysEachKindOfEdgeTakes) {
  for (const char* asked : {"gas.edge", "gas.edge.kind", "non_reflecting"}) {
    const std::string out = call({"describe", asked}).out;
    for (const char* line :
         {"  inflow           pressure, and density or temperature; velocity", "  pressure         pressure alone"})
      EXPECT_TRUE(contains(out, line)) << asked << "\n" << out;
  }
  const auto problems_with = [](const std::string& kind, const std::string& state) {
    const std::string edge = "[[gas.edge]]\nside = \"high_x\"\nkind = \"" + kind + "\"\n" + state;
    return call({"check",
                 write_text(scratch() / "box.toml", box_of_air("10 mm", "20 us", "[0, 0]", "[0.2, 0.05]") + edge).string()})
        .err;
  };
  EXPECT_EQ(problems_with("wall", ""), "");
  EXPECT_EQ(problems_with("inflow", "pressure = 1e5\ntemperature = 300\n"), "");
  EXPECT_EQ(problems_with("non_reflecting", "pressure = 1e5\ndensity = 1.2\n"), "");
  EXPECT_EQ(problems_with("pressure", "pressure = 1e5\n"), "");
  EXPECT_NE(problems_with("pressure", "pressure = 1e5\ntemperature = 300\n"), "");
}

/// Everything that it names can be used: a formula of all functions and variables is one.
TEST(DescribeCommand, ExplainsFormulas) {
  const Answer a = call({"describe", "formula"});
  EXPECT_EQ(a.code, done) << a.err;
  for (const char* part : {"gas.edge.density", "gas.fill.velocity", "sqrt", "x, y, z", "a ? b : c", "example"})
    EXPECT_TRUE(contains(a.out, part)) << part << "\n" << a.out;
  EXPECT_FALSE(contains(a.out, "cell_size")) << "no formula may stand there";
  const std::string begins = "density = \"";
  const std::size_t at = a.out.find(begins) + begins.size();
  EXPECT_NO_THROW(Formula(a.out.substr(at, a.out.find('"', at) - at), 1, true)) << "the example";
  EXPECT_TRUE(contains(call({"describe", "formulla"}).err, "did you mean \"formula\"?"));
}

TEST(DescribeCommand, TellsWhatACaseIs) {
  const Answer a = call({"describe", "sod"});
  EXPECT_EQ(a.code, done) << a.err;
  EXPECT_TRUE(contains(a.out, "Shock tube of Sod") && contains(a.out, "brisance run sod\n")) << a.out;
}

TEST(DescribeCommand, ExplainsMaterials) {
  for (const char* name : {"air", "air.toml"}) {
    const Answer a = call({"describe", name});
    EXPECT_EQ(a.code, done) << a.err;
    EXPECT_TRUE(contains(a.out, "equation_of_state/ideal_gas") && contains(a.out, "material = \"air.toml\"")) << a.out;
  }
  EXPECT_TRUE(contains(call({"describe", "copper_ofhc_mts"}).out, "example of a solid"));
  EXPECT_TRUE(contains(call({"describe", "copper_ofhc_mtx"}).err, "did you mean \"copper_ofhc_mts\"?"));
}

TEST(DescribeCommand, ExplainsKeysAndSuggestsNearOnes) {
  const Answer a = call({"describe", "cell_size"});
  EXPECT_EQ(a.code, done);
  EXPECT_TRUE(contains(a.out, "must be given")) << a.out;
  const Answer wrong = call({"describe", "cel_size"});
  EXPECT_EQ(wrong.code, bad_input);
  EXPECT_TRUE(contains(wrong.err, "did you mean \"cell_size\"?")) << wrong.err;
}

TEST(DescribeCommand, ExplainsValuesAndListsAllKeysWithoutOne) {
  const Answer wall = call({"describe", "rigid_wall"});
  EXPECT_EQ(wall.code, done);
  EXPECT_TRUE(contains(wall.out, "boundary.kind")) << wall.out;
  EXPECT_TRUE(contains(wall.out, "boundary.friction")) << wall.out;
  const Answer all = call({"describe"});
  EXPECT_EQ(all.code, done);
  for (const char* key : {"cell_size ", "solid.velocity.rotation ", "numerics.courant ", "gates.residual "})
    EXPECT_TRUE(contains(all.out, key)) << key;
}

TEST(ListCommand, NamesMaterialsAndMeasures) {
  const Answer a = call({"list"});
  EXPECT_EQ(a.code, done);
  for (const char* name : {"rigid_wall", "mushroom_diameter", "copper_ofhc_johnson_cook.toml", "cylinder"})
    EXPECT_TRUE(contains(a.out, name)) << name;
}

TEST(ListCommand, NamesWhatGasMayHaveAndTheCases) {
  const Answer a = call({"list"});
  for (const char* name : {"non_reflecting", "high_y", "sound_speed", "fraction_FLUID", "jwl_plus_plus", "ice_classic"})
    EXPECT_TRUE(contains(a.out, name)) << name;
  const Answer cases = call({"list", "cases"});
  EXPECT_EQ(cases.code, done) << cases.err;
  EXPECT_TRUE(contains(cases.out, "\nsod ") && contains(cases.out, " Shock tube of Sod\n")) << cases.out;
  EXPECT_FALSE(contains(cases.out, "point_cycle.toml")) << "of the point driver";
  EXPECT_EQ(call({"list", "case"}).code, bad_input);
}

TEST(DescribeCommand, ExplainsFieldsOfGasAndLawsOfReactions) {
  const std::string fields = call({"describe", "figure.fields"}).out, colours = call({"describe", "figure_field"}).out;
  for (const std::string& text : {fields, colours})
    EXPECT_TRUE(contains(text, "of gas density, pressure, velocity") && contains(text, "von_mises_stress")) << text;
  EXPECT_FALSE(contains(fields, "position")) << "a position cannot be drawn";
  EXPECT_TRUE(contains(call({"describe", "sound_speed"}).out, "gauge.fields"));
  EXPECT_TRUE(contains(call({"describe", "no_slip"}).out, "a wall that viscous fluids stick to"));
  const Answer burn = call({"describe", "jwl_plus_plus"});
  EXPECT_EQ(burn.code, done) << burn.err;
  EXPECT_TRUE(contains(burn.out, "reaction/jwl_plus_plus") && contains(burn.out, "parameter")) << burn.out;
  const std::string both = call({"describe", "reaction"}).out;
  EXPECT_TRUE(contains(both, "gas.reaction\n") && contains(both, "reaction/program_burn")) << both;
  EXPECT_TRUE(contains(call({"describe", "jwl_plus_plu"}).err, "did you mean \"jwl_plus_plus\"?"));
}

}  // namespace
}  // namespace brisance::simulator
