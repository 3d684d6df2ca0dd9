// pointdriver as its users meet it: commands, files, messages and exit codes.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "driver/check.hpp"
#include "driver/commands.hpp"
#include "driver/hdf5_file.hpp"
#include "driver/history.hpp"
#include "models/input/csv.hpp"
#include "tests/command_line.hpp"

namespace brisance::driver {
namespace {

const fs::path source = BRISANCE_SOURCE_DIR;

Answer call(std::vector<std::string> words) {
  words.insert(words.begin(), "pointdriver");
  return call_program(run_command_line, std::move(words));
}

std::string path_file(const std::string& segments, const std::string& top = "") {
  return "material = \"steel_4340.toml\"\nheat = \"adiabatic\"\n" + top + "[initial]\ntemperature = \"298 K\"\n" + segments;
}
const std::string pull = "[[segment]]\nmode = \"uniaxial_stress\"\nstrain_rate = 1000\nstrain = 0.02\n";

TEST(List, NamesEveryFolderAndLaw) {
  const Answer a = call({"list"});
  EXPECT_EQ(a.code, done);
  for (const char* name : {"flow_stress", "johnson_cook", "mechanical_threshold_stress", "gurson_tvergaard_needleman",
                           "tepla_f", "varshni_chen_gray", "jones_wilkins_lee", "drucker"})
    EXPECT_TRUE(contains(a.out, name)) << name;
}

TEST(Describe, ShowsAllLawsOfAName) {
  const Answer a = call({"describe", "johnson_cook"});
  EXPECT_EQ(a.code, done);
  EXPECT_TRUE(contains(a.out, "flow_stress/johnson_cook"));
  EXPECT_TRUE(contains(a.out, "damage/johnson_cook"));
  EXPECT_TRUE(contains(a.out, "Source:"));
  EXPECT_FALSE(contains(call({"describe", "damage/johnson_cook"}).out, "flow_stress/johnson_cook"));
}

TEST(Describe, SuggestsWhatWasMeant) {
  const Answer a = call({"describe", "jonson_cook"});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_TRUE(contains(a.err, "did you mean \"johnson_cook\"")) << a.err;
}

TEST(Run, FindsItsCasesAndCommandsByName) {
  const Answer a = call({"run", "point_simple_shear", "-o", (scratch() / "history.csv").string()});
  EXPECT_EQ(a.code, done) << a.err;
  EXPECT_TRUE(contains(call({"run", "point_simple_sheer"}).err, "did you mean \"point_simple_shear\"?"));
  EXPECT_TRUE(contains(call({"rum", "point_simple_shear"}).err, "did you mean \"run\"?"));
}

TEST(CommandLine, SaysWhatItTakes) {
  EXPECT_TRUE(contains(call({"run", "point_simple_shear", "--plto", "a.png"}).err, "did you mean \"--plot\"?"));
  for (const char* command : {"run", "compare", "list", "calibrate", "check", "describe"}) {
    EXPECT_FALSE(contains(call({command, "--help"}).out, "TEXT")) << command;
    EXPECT_TRUE(contains(call({}).err, std::string("\n  ") + command + "  ")) << command;
  }
  EXPECT_EQ(call({}).code, bad_input);
}

TEST(List, NamesEveryKeyOfEveryFile) {
  const Answer a = call({"list"});
  for (const char* key : {"segment.strain_rate", "segment.until", "segment.repeat", "initial.porosity", "output.every",
                          "plot.x", "sweep", "experiment.where", "protocol.adiabatic_from", "protocol.summary_from",
                          "model.material", "parameter.lower", "residual"})
    EXPECT_TRUE(contains(a.out, std::string("  ") + key + " ")) << key;
  EXPECT_EQ(call({"describe"}).out, a.out);
}

TEST(Describe, TellsAKeyWithItsUnitDefaultAndValues) {
  const Answer rate = call({"describe", "segment.lateral_pressure"});
  EXPECT_EQ(rate.code, done);
  EXPECT_TRUE(contains(rate.out, "number in Pa")) << rate.out;
  EXPECT_TRUE(contains(rate.out, "default: 0")) << rate.out;
  EXPECT_TRUE(contains(call({"describe", "experiment.file"}).out, "must be given"));
  EXPECT_TRUE(contains(call({"describe", "on_failure"}).out, "one of stop, continue"));
}

TEST(Describe, TellsAValueWithTheKeysThatBelongToIt) {
  const Answer a = call({"describe", "simple_shear"});
  EXPECT_EQ(a.code, done);
  EXPECT_TRUE(contains(a.out, "segment.mode")) << a.out;
  EXPECT_TRUE(contains(a.out, "segment.shear_rate")) << a.out;
  EXPECT_FALSE(contains(a.out, "segment.triaxiality")) << a.out;
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(call({"dance"}).code, bad_input);
  EXPECT_EQ(call({}).code, bad_input);
  EXPECT_EQ(call({"run"}).code, bad_input);
  EXPECT_EQ(call({"--help"}).code, done);
}

TEST(Run, WritesTheSameHistoryToCsvAndHdf5) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "pull.toml", path_file(pull));
  ASSERT_EQ(call({"run", file, "-o", directory / "a.csv"}).code, done);
  ASSERT_EQ(call({"run", file, "-o", directory / "a.h5"}).code, done);
  const Record record = read_hdf5(directory / "a.h5");
  const CsvFile csv = CsvFile::load(directory / "a.csv");
  ASSERT_EQ(csv.column_names().size(), record.series.size());
  ASSERT_GT(csv.rows(), 50u);
  for (const Record::Series& series : record.series)
    EXPECT_EQ(csv.numbers(series.name, Unit{series.unit}), series.values) << series.name;  // to the last bit
  for (const auto& entry : fs::directory_iterator(directory)) EXPECT_NE(entry.path().extension(), ".part");
}

TEST(Run, KeepsAboutAsManyRowsAsAskedForAndTheEnds) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "pull.toml", path_file(pull, "") + "[output]\nrows = 20\n");
  ASSERT_EQ(call({"run", file, "-o", directory / "a.csv"}).code, done);
  const CsvFile csv = CsvFile::load(directory / "a.csv");
  EXPECT_GE(csv.rows(), 20u);
  EXPECT_LE(csv.rows(), 40u);
  const std::vector<double> strain = csv.numbers("strain_xx", Unit::one);
  EXPECT_EQ(strain.front(), 0.0);
  EXPECT_NEAR(strain.back(), 0.02, 1e-12);
}

TEST(Run, TakesOverridesOfThePathAndOfTheMaterial) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "pull.toml", path_file(pull));
  const auto end = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", file, "-o", directory / "a.csv"});
    const Answer a = call(words);
    EXPECT_EQ(a.code, done) << a.err;
    return CsvFile::load(directory / "a.csv").numbers("stress_xx", Unit::Pa).back();
  };
  const double as_given = end({});
  EXPECT_LT(end({"--set", "initial.temperature=600 K"}), 0.9 * as_given);
  EXPECT_GT(end({"--set", "material.flow_stress.A=1.2 GPa"}), 1.2 * as_given);
  EXPECT_NE(end({"--set", "segment.0.strain=0.01"}), as_given);
}

TEST(Run, ReportsEveryMistakeAtOnceWithItsPlace) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "bad.toml",
                                   "material = \"steel_4340.toml\"\nheat = \"adiabatik\"\n[initial]\ntemperature = \"298 s\"\n"
                                   "[[segment]]\nmode = \"uniaxial_stress\"\nstrain_rat = 1000\nstrain = 0.02\n");
  const Answer a = call({"run", file});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_TRUE(contains(a.err, "bad.toml:2:")) << a.err;
  EXPECT_TRUE(contains(a.err, "did you mean \"adiabatic\"")) << a.err;
  EXPECT_TRUE(contains(a.err, "bad.toml:4:")) << a.err;
  EXPECT_TRUE(contains(a.err, "strain_rat")) << a.err;
  EXPECT_EQ(a.out, "");
}

TEST(Run, RefusesPathsThatMakeNoSense) {
  const fs::path directory = scratch();
  const auto error = [&](const std::string& segment) {
    const Answer a = call({"run", write_text(directory / "bad.toml", path_file(segment))});
    EXPECT_EQ(a.code, bad_input) << segment;
    return a.err;
  };
  EXPECT_TRUE(contains(error(""), "[[segment]]"));
  EXPECT_TRUE(contains(error("[[segment]]\nmode = \"hold\"\n"), "no end"));
  EXPECT_TRUE(contains(error("[[segment]]\nduration = 1\n"), "nothing drives"));
  EXPECT_TRUE(
      contains(error("[[segment]]\nmode = \"uniaxial_strain\"\nstrain_rate = 1\nuntil = { stres = 0 }\n"), "did you mean"));
  EXPECT_TRUE(
      contains(error("[[segment]]\nstrain_rate = { xx = 1 }\nstress = { xx = 0 }\nduration = 1\n"), "prescribed as well"));
  EXPECT_TRUE(contains(error("[[segment]]\ndeformation_gradient = { xx = -1 }\nduration = 1\n"), "determinant"));
  EXPECT_TRUE(
      contains(error("[[segment]]\nmode = \"hydrostatic\"\npressure = \"1 GPa\"\nuntil = { pressure = 1 }\n"), "duration"));
  EXPECT_TRUE(contains(error(pull + "temperature_rate = 5\n"), "prescribed"));
  EXPECT_TRUE(
      contains(error("[[segment]]\nmode = \"uniaxial_stress\"\nstrain_rate = 1\nstrain = -0.3\n"), "sign of the strain rate"));
  const std::string standing = error("[[segment]]\nmode = \"uniaxial_stress\"\nstrain_rate = 0\nstrain = 0.3\n");
  EXPECT_TRUE(contains(standing, "the rate is zero"));
  EXPECT_EQ(std::count(standing.begin(), standing.end(), '\n'), 1) << standing;
  const std::string list = error(pull + "[plot]\nx = \"time\"\ny = [\"stress_xx\"]\n");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 1) << list;
  EXPECT_TRUE(contains(error(pull + "temperature = \"298 C\"\n"), "did you mean \"degC\"?"));
}

TEST(Run, SaysWhatIsMissing) {
  const Answer a = call({"run", "there_is_no_such.toml"});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_TRUE(contains(a.err, "there_is_no_such.toml")) << a.err;
  EXPECT_EQ(call({"run", (source / "data/cases/point_cycle.toml").string(), "-o", scratch() / "a.txt"}).code, bad_input);
}

TEST(Run, FailsWithTheFactsAndKeepsTheHistory) {
  const fs::path directory = scratch();
  const fs::path file = write_text(
      directory / "pull.toml", path_file("[[segment]]\nmode = \"uniaxial_stress\"\nstress = \"5 GPa\"\nduration = \"1 ms\"\n",
                                         "on_failure = \"continue\"\n"));
  const Answer a = call({"run", file, "-o", directory / "a.csv"});
  EXPECT_EQ(a.code, failed_while_running);
  EXPECT_TRUE(contains(a.err, "segment 1")) << a.err;
  EXPECT_GT(CsvFile::load(directory / "a.csv").rows(), 5u);
}

TEST(Run, StopsAtFailureOrGoesOnAsAsked) {
  const fs::path directory = scratch();
  const std::string far = "[[segment]]\nmode = \"uniaxial_stress\"\nstrain_rate = 1000\nstrain = 3.0\n";
  const fs::path file = write_text(directory / "pull.toml", path_file(far));
  const Answer stopped = call({"run", file, "-o", directory / "stopped.csv"});
  EXPECT_EQ(stopped.code, done) << stopped.err;
  EXPECT_TRUE(contains(stopped.out, "failed by")) << stopped.out;
  const Answer went_on = call({"run", file, "--set", "on_failure=continue", "-o", directory / "went_on.csv"});
  EXPECT_EQ(went_on.code, done) << went_on.err;
  EXPECT_TRUE(contains(went_on.out, "failed by")) << went_on.out;
  const auto end = [&](const char* name) { return CsvFile::load(directory / name).numbers("strain_xx", Unit::one).back(); };
  EXPECT_LT(end("stopped.csv"), 2.9);
  EXPECT_NEAR(end("went_on.csv"), 3.0, 1e-9);
}

TEST(Run, ComparesWithTheRateForm) {
  const fs::path directory = scratch();
  const Answer a = call({"run", write_text(directory / "pull.toml", path_file(pull)), "--reference"});
  EXPECT_EQ(a.code, done) << a.err;
  EXPECT_TRUE(contains(a.out, "rate form")) << a.out;
}

TEST(Run, KeepsTheHistoryWhenInterrupted) {
  const fs::path directory = scratch();
  const fs::path file = write_text(
      directory / "long.toml",
      path_file("[[segment]]\nmode = \"simple_shear\"\nshear_rate = 1\nduration = 1e6\n", "strain_increment = 1e-6\n") +
          "[output]\nrows = 100\n");
  const fs::path history = directory / "a.csv";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::string words[] = {"pointdriver", "run", file, "-o", history};
    char* argv[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), words[4].data()};
    if (!std::freopen("/dev/null", "w", stdout)) _exit(99);
    const int code = run_command_line(5, argv);
    _exit(code);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), interrupted);
  EXPECT_GT(CsvFile::load(history).rows(), 10u);
}

TEST(Sweep, RunsTheFullProductAndWritesATable) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "sweep.toml", path_file(pull) +
                                                                 "[sweep]\n\"initial.temperature\" = [200, 298, 500]\n"
                                                                 "\"material.flow_stress.A\" = [\"700 MPa\", 8e8]\n");
  const Answer a = call({"run", file, "-o", directory / "out", "--plot", directory / "sweep.png"});
  EXPECT_EQ(a.code, done) << a.err;
  const CsvFile table = CsvFile::load(directory / "out/sweep.csv");
  EXPECT_EQ(table.rows(), 6u);
  EXPECT_TRUE(fs::exists(directory / "out/member_006.csv"));
  EXPECT_GT(fs::file_size(directory / "sweep.png"), 1000u);
  const std::vector<double> stress = table.numbers("equivalent_stress", Unit::Pa);
  EXPECT_LT(stress[0], stress[1]);  // the last key runs fastest: 700 MPa, then 800
  EXPECT_GT(stress[0], stress[4]);  // 200 K, then 500 K
}

TEST(Sweep, WritesOneTableOrOneGroupForEachMember) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "sweep.toml", path_file(pull) +
                                                                 "[sweep]\n\"segment.0.strain_rate\" = [1, 1000]\n"
                                                                 "\"material.flow_stress.A\" = [\"700 MPa\", 8e8]\n");
  ASSERT_EQ(call({"run", file, "-o", directory / "all.csv"}).code, done);
  ASSERT_EQ(call({"run", file, "-o", directory / "all.h5"}).code, done);
  const CsvFile csv = CsvFile::load(directory / "all.csv");
  const std::vector<std::string> names = csv.column_names();
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.begin() + 4),
            (std::vector<std::string>{"member", "segment.0.strain_rate", "material.flow_stress.A", "time"}));
  const std::vector<double> A = csv.numbers("material.flow_stress.A", Unit::Pa),
                            rate = csv.numbers("segment.0.strain_rate", Unit::per_s);
  EXPECT_EQ(A.front(), 7e8);
  EXPECT_EQ(A.back(), 8e8);
  EXPECT_EQ(rate.front(), 1.0);
  EXPECT_EQ(rate.back(), 1000.0);
  const Record last = read_hdf5(directory / "all.h5", "member_004");
  const std::vector<double> stress = csv.numbers("stress_xx", Unit::Pa), own = last.find("stress_xx")->values;
  ASSERT_GT(own.size(), 50u);
  EXPECT_TRUE(std::equal(own.begin(), own.end(), stress.end() - static_cast<std::ptrdiff_t>(own.size())));
  EXPECT_EQ(read_hdf5_value(directory / "all.h5", "member_003", "material.flow_stress.A [Pa]"), 7e8);
  EXPECT_EQ(call({"run", file, "-o", directory / "all.txt"}).code, bad_input);
  EXPECT_FALSE(fs::exists(directory / "all.txt"));
}

TEST(Run, MakesNoFolderForAFileInAMistypedOne) {
  const fs::path directory = scratch();
  const fs::path file = write_text(directory / "pull.toml", path_file(pull));
  const Answer a = call({"run", file, "-o", directory / "none/a.csv"});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_TRUE(contains(a.err, "there is no folder")) << a.err;
  EXPECT_FALSE(fs::exists(directory / "none"));
}

TEST(Sweep, FindsAMistakeInTheLastMemberBeforeTheFirstRuns) {
  const fs::path directory = scratch();
  const fs::path file =
      write_text(directory / "sweep.toml", path_file(pull) + "[sweep]\n\"initial.temperature\" = [200, -5]\n");
  const Answer a = call({"run", file});
  EXPECT_EQ(a.code, bad_input);
  EXPECT_EQ(a.out, "");
}

TEST(Check, FindsNoErrorInTheMaterialsOfTheProgram) {
  for (const auto& entry : fs::directory_iterator(source / "data/materials"))
    for (const Finding& finding : check_material(entry.path()))
      EXPECT_NE(finding.verdict, Verdict::error) << entry.path().filename() << ": " << finding.subject << ": " << finding.text;
}

TEST(Check, FindsABulkModulusThatDoesNotBelong) {
  const fs::path directory = scratch();
  std::ifstream in(source / "data/materials/aluminium_6061_t6_johnson_cook.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string stated = "bulk_modulus = \"76.1 GPa\"";
  ASSERT_TRUE(contains(text, stated));
  text.replace(text.find(stated), stated.size(), "bulk_modulus = \"52 GPa\"");
  const auto findings = check_material(write_text(directory / "wrong.toml", text));
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return f.verdict == Verdict::warning && f.subject == "equation_of_state" && contains(f.text, "bulk modulus");
  }));
}

TEST(Check, TellsUnusableFilesFromUnphysicalMaterials) {
  const fs::path directory = scratch();
  const std::string sound = source / "data/materials/steel_4340.toml";
  const std::string broken = write_text(directory / "broken.toml", "density = 1\n");
  for (const std::string& file : {broken, std::string(directory / "absent.toml"), directory.string()}) {
    EXPECT_EQ(call({"check", file}).code, bad_input) << file;
    const Answer both = call({"check", file, sound});  // the others are still looked at
    EXPECT_EQ(both.code, bad_input) << file;
    EXPECT_TRUE(contains(both.out, "steel_4340.toml")) << file;
  }
  std::ifstream in(sound);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string stated = "value = \"1793 K\"";
  ASSERT_TRUE(contains(text, stated));
  text.replace(text.find(stated), stated.size(), "value = \"7931 K\"");
  EXPECT_EQ(call({"check", write_text(directory / "unphysical.toml", text)}).code, failed_while_running);
}

TEST(Check, FindsMaterialsOfTheProgramByName) {
  const Answer a = call({"check", "steel_4340.toml"});
  EXPECT_EQ(a.code, done);
  EXPECT_TRUE(contains(a.out, "1 files: ")) << a.out;
}

class EveryCase : public testing::TestWithParam<fs::path> {};

TEST_P(EveryCase, Runs) {
  const fs::path directory = scratch();
  std::ifstream in(GetParam());
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const bool is_comparison = contains(text, "[experiment]"), is_sweep = contains(text, "[sweep]");
  const fs::path output = is_sweep ? directory / "out" : directory / "history.csv";
  const Answer a = call({is_comparison ? "compare" : "run", GetParam(), "-o", output, "--plot", directory / "figure.svg"});
  EXPECT_EQ(a.code, done) << a.err;
  EXPECT_TRUE(fs::exists(output));
  EXPECT_GT(fs::file_size(directory / "figure.svg"), 1000u);
}

std::vector<fs::path> point_cases() {
  std::vector<fs::path> cases;
  for (const auto& entry : fs::directory_iterator(source / "data/cases")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("point_") && name.ends_with(".toml")) cases.push_back(entry.path());
  }
  std::sort(cases.begin(), cases.end());
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Cases, EveryCase, testing::ValuesIn(point_cases()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace brisance::driver
