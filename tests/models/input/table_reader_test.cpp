#include "models/input/table_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace brisance {
namespace {

constexpr Quantity length{Unit::m, positive, "length of the rod"};

/// Reads a text and returns the message of what was wrong with it.
template <class Read>
std::string problems_of(const std::string& text, Read&& read, const std::vector<std::string>& overrides = {}) {
  try {
    InputFile file = InputFile::from_text(text, "case.toml");
    for (const std::string& assignment : overrides) file.set(assignment);
    TableReader top = file.top();
    read(top);
    file.finish();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(TableReader, KnowsWhatIsSound) {
  InputFile file = InputFile::from_text(
      "wrong = -1\nright = 1\nnumber = 3\n[inner]\nwrong = -1\nright = 1\n[[list]]\n[[list]]\n", "case.toml");
  TableReader top = file.top();
  TableReader inner = top.table("inner"), number = top.table("number");
  for (TableReader* table : {&top, &inner})
    for (const char* key : {"wrong", "right", "missing"}) static_cast<void>(table->number(key, length));
  EXPECT_TRUE(top.valid({"right"}) && inner.valid({"right"}) && top.valid({"list", "never_asked_for"}));
  for (const char* key : {"wrong", "missing"}) EXPECT_FALSE(top.valid({key}) || inner.valid({key, "right"})) << key;
  EXPECT_FALSE(top.valid({"inner"})) << "what is within it is not";
  EXPECT_FALSE(number.valid({"right"}) || top.valid_in_file({"number.right"})) << "there is nothing within it";
  std::vector<TableReader> list = top.tables("list");
  list[1].problem("it is refused");
  EXPECT_TRUE(top.valid({"list.0"}));
  EXPECT_FALSE(top.valid({"list"}) || top.valid_in_file({"list.1"}));
  EXPECT_TRUE(list[1].valid({"depth"})) << "the table is refused, not what it holds";
  list[0].add_problems("file", std::vector<Problem>{{"other.csv", 0, 0, "", "it is empty"}});
  EXPECT_FALSE(list[0].valid({"file"}));
}

TEST(TableReader, GivesTheValuesOfTheFile) {
  InputFile file = InputFile::from_text(R"(
title = "Taylor bar"
length = "25.4 mm"
width = 7
count = 12
steel = true
scheme = "b"
velocity = ["0 m/s", 0, "-190 m/s"]
gauges = ["tip", "foot"]
gradient = [[1, 0, 0], [0, "2 1/s", 0], [0, 0, 3]]
[box]
inner.depth = 0.5
[[segment]]
duration = "20 us"
[[segment]]
duration = 1.0
)",
                                        "case.toml");
  TableReader top = file.top();
  EXPECT_EQ(top.text("title"), "Taylor bar");
  EXPECT_EQ(top.number("length", length), 0.0254);
  EXPECT_EQ(top.number("width", length), 7.0);
  EXPECT_EQ(top.number_or("height", 3.0, length), 3.0);
  EXPECT_EQ(top.optional_number("depth", length), std::nullopt);
  EXPECT_EQ(top.integer("count", 1, 20), 12);
  EXPECT_EQ(top.integer_or("threads", 4, 1, 20), 4);
  EXPECT_TRUE(top.flag("steel"));
  EXPECT_FALSE(top.flag_or("copper", false));
  constexpr std::array<std::string_view, 3> schemes = {"a", "b", "c"};
  EXPECT_EQ(top.choice("scheme", schemes), 1u);
  EXPECT_EQ(top.choice("limiter", schemes, 2), 2u);
  EXPECT_EQ(top.numbers("velocity", {Unit::m_per_s}, exactly(3)), (std::vector<double>{0.0, 0.0, -190.0}));
  EXPECT_EQ(top.texts("gauges"), (std::vector<std::string>{"tip", "foot"}));
  EXPECT_EQ(top.rows("gradient", {Unit::per_s}, exactly(3), 3),
            (std::vector<std::vector<double>>{{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 3.0}}));
  EXPECT_EQ(top.table("box").table("inner").number("depth", length), 0.5);
  std::vector<double> durations;
  for (TableReader segment : top.tables("segment")) durations.push_back(segment.number("duration", {Unit::s, positive}));
  EXPECT_EQ(durations, (std::vector<double>{20e-6, 1.0}));
  EXPECT_TRUE(top.tables("gauge").empty());
  EXPECT_NO_THROW(file.finish());
}

// The traps of toml++ are looked for before it sees the file; what only resembles them is fine.
TEST(TableReader, ReadsAllOfToml) {
  const std::string dots(100, '.');
  InputFile file =
      InputFile::from_text("\xEF\xBB\xBF# [=] " + dots + "\r\na = \"\"\"\n[=]\n" + dots + "\\\" \"\"\"\"\"\nb = '''" + dots +
                               "''''\nc = [ [1.0], # }\n [ 3.0, ], ]\n  [ \"x y\" . 'z' ]\nd = {e = [{f = 1}], g.h = '['}\n" +
                               "i = 0x1F\nj = 1_000\nk = \"\\u00E9\"\n",
                           "case.toml");
  TableReader top = file.top();
  EXPECT_EQ(top.text("a"), "[=]\n" + dots + "\" \"\"");
  EXPECT_EQ(top.text("b"), dots + "'");
  EXPECT_EQ(top.rows("c", {}, exactly(2), 1).size(), 2u);
  TableReader z = top.table("x y").table("z");
  EXPECT_EQ(z.table("d").tables("e").at(0).integer("f", 0, 9), 1);
  EXPECT_EQ(z.table("d").table("g").text("h"), "[");
  EXPECT_EQ(z.integer("i", 0, 99), 31);
  EXPECT_EQ(z.integer("j", 0, 9999), 1000);
  EXPECT_EQ(z.text("k"), "\u00E9");
  EXPECT_NO_THROW(file.finish());
}

TEST(TableReader, ReportsAllProblemsInTheOrderOfTheFile) {
  const std::string message = problems_of(
      "lenght = 1.0\n[box]\ndepth = true\n[[segment]]\nduration = \"3 m\"\ncolour = 1\n[[segment]]\n", [](TableReader& top) {
        for (TableReader segment : top.tables("segment")) segment.number("duration", {Unit::s, positive, "of the segment"});
        top.table("box").number("depth", length);
        top.number("length", length);
      });
  EXPECT_EQ(message,
            "case.toml: length: missing: length of the rod; give a number in m or a text such as \"25.4 mm\", > 0\n"
            "case.toml:1:1: lenght: unknown key; did you mean \"length\"?\n"
            "case.toml:3:9: box.depth: this is true, not a length; give a number in m or a text such as \"25.4 mm\", > 0\n"
            "case.toml:5:12: segment.0.duration: \"3 m\" is not a time: \"m\" measures a length; give a number in s or a text "
            "such as "
            "\"20 us\"\n"
            "case.toml:6:1: segment.0.colour: unknown key; the keys known here are duration\n"
            "case.toml:7:1: segment.1.duration: missing: of the segment; give a number in s or a text such as \"20 us\", > 0");
}

TEST(TableReader, ReportsAMissingTableOnceAndNotItsContent) {
  EXPECT_EQ(problems_of("a = 1\n",
                        [](TableReader& top) {
                          top.integer("a", 0, 9);
                          TableReader box = top.table("box", "where the gas is");
                          box.number("depth", length);
                          box.table("inner").text("name");
                        }),
            "case.toml: box: missing: where the gas is; give a table [box]");
}

TEST(TableReader, AValueThatNobodyReadsIsUnknownEvenInsideALessKnownTable) {
  EXPECT_EQ(problems_of("[a]\nb = 1\n[a.c]\nd = 2\n", [](TableReader& top) { top.table("a").table("c"); }),
            "case.toml:2:1: a.b: unknown key; the keys known here are c\n"
            "case.toml:4:1: a.c.d: unknown key; no keys are known here");
}

TEST(TableReader, ListsMustHaveTheLengthAskedFor) {
  const auto read = [](TableReader& top) {
    top.numbers("velocity", {Unit::m_per_s}, exactly(3));
    top.rows("gradient", {Unit::per_s}, exactly(2), 2);
    top.texts("gauges", {1, 2});
  };
  EXPECT_EQ(
      problems_of("velocity = [1, 2]\ngradient = [[1], [2, 3, 4]]\ngauges = []\n", read),
      "case.toml:1:12: velocity: the list has 2 elements; give a list of 3 elements, each a number in m/s or a text such as "
      "\"4.5 "
      "km/s\"\n"
      "case.toml:2:13: gradient.0: the list has 1 element; give a list of 2 elements, each a number in 1/s or a text such as "
      "\"1000 1/s\"\n"
      "case.toml:2:18: gradient.1: the list has 3 elements; give a list of 2 elements, each a number in 1/s or a text such as "
      "\"1000 1/s\"\n"
      "case.toml:3:10: gauges: the list is empty; give a list of 1 to 2 elements, each a text in quotes");
}

TEST(TableReader, ElementsAreJudgedEvenWhereThereAreTooMany) {
  const std::string message = problems_of(
      "x = [true, 1, \"2 s\"]\n", [](TableReader& top) { EXPECT_EQ(top.numbers("x", {Unit::m}, exactly(2)).size(), 2u); });
  for (const char* problem : {"x: the list has 3 elements", "x.0: this is true", "x.2: \"2 s\" is not a length"})
    EXPECT_NE(message.find(problem), std::string::npos) << message;
}

TEST(TableReader, AllKnotsOfATableThatDoNotRiseAreReported) {
  const std::string message = problems_of("x = {time = [0, 2, 1, 1], value = [1, 2, 3, 4]}\n", [](TableReader& top) {
    static_cast<void>(top.piecewise("x", {Unit::m}, "time", {Unit::s}));
  });
  for (const char* problem : {"element 2 is 1 after 2", "element 3 is 1 after 1"})
    EXPECT_NE(message.find(problem), std::string::npos) << message;
}

TEST(TableReader, LongListsOfWrongElementsAreReportedInPart) {
  std::string text = "x = [";
  for (int i = 0; i < 1000; ++i) text += "true, ";
  const std::string message = problems_of(text + "]\n", [](TableReader& top) { top.numbers("x", {}); });
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n') + 1, 5);
}

TEST(TableReader, WholeNumbersAreNotRounded) {
  const auto read = [](TableReader& top) { top.integer("n", 1, 10); };
  EXPECT_EQ(problems_of("n = 2.0\n", read),
            "case.toml:1:5: n: this is the number 2; a whole number between 1 and 10 is required");
  EXPECT_EQ(problems_of("n = 11\n", read), "case.toml:1:5: n: 11 is out of range; it must be a whole number between 1 and 10");
  EXPECT_EQ(problems_of("n = 4294967297\n", read),
            "case.toml:1:5: n: 4294967297 is out of range; it must be a whole number between 1 and 10");
}

TEST(TableReader, AProgramCanReportItsOwnProblems) {
  EXPECT_EQ(problems_of("a = 1\n[b]\n",
                        [](TableReader& top) {
                          top.integer("a", 0, 9);
                          top.problem("a", "too small for b");
                          TableReader b = top.table("b");
                          b.problem("b is not needed");
                          b.problem("c", "c would be");
                        }),
            "case.toml:1:5: a: too small for b\n"
            "case.toml:2:1: b: b is not needed\n"
            "case.toml:2:1: b.c: c would be");
}

// --- Overrides --------------------------------------------------------------------------------------------------------

struct Values {
  double duration = 0.0;
  std::string name;
  std::vector<double> velocity;
};
Values with_overrides(const std::vector<std::string>& overrides) {
  InputFile file = InputFile::from_text("name = \"a\"\nvelocity = [1, 2, 3]\n[[segment]]\nduration = 1.0\n", "case.toml");
  for (const std::string& assignment : overrides) file.set(assignment);
  TableReader top = file.top();
  Values values;
  values.name = top.text("name");
  values.velocity = top.numbers("velocity", {Unit::m_per_s}, exactly(3));
  for (TableReader segment : top.tables("segment")) values.duration = segment.number("duration", {Unit::s, positive});
  file.finish();
  return values;
}
std::string refused(const std::vector<std::string>& overrides) {
  try {
    with_overrides(overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Override, ReplacesAValueOfTheFile) {
  EXPECT_EQ(with_overrides({"segment.0.duration=20 us"}).duration, 20e-6);
  EXPECT_EQ(with_overrides({"segment.0.duration = \"20 us\""}).duration, 20e-6);
  EXPECT_EQ(with_overrides({"segment.0.duration=2e-3"}).duration, 2e-3);
  EXPECT_EQ(with_overrides({"segment.0={duration = 5}"}).duration, 5.0);
  EXPECT_EQ(with_overrides({"segment=[{duration = 5}, {duration = 6}]"}).duration, 6.0);
  EXPECT_EQ(with_overrides({"velocity=[0,0,-190]"}).velocity, (std::vector<double>{0.0, 0.0, -190.0}));
  EXPECT_EQ(with_overrides({"velocity.2=-190 m/s"}).velocity, (std::vector<double>{1.0, 2.0, -190.0}));
  EXPECT_EQ(with_overrides({"name=Taylor bar"}).name, "Taylor bar");
  EXPECT_EQ(with_overrides({"name=a=b"}).name, "a=b");
  EXPECT_EQ(with_overrides({"name=one", "name=two"}).name, "two");
}

TEST(Override, ThatCannotBeAppliedIsReportedByItsKey) {
  EXPECT_EQ(refused({"segment.0.duration=20 m"}),
            "--set segment.0.duration: \"20 m\" is not a time: \"m\" measures a length; give a number in s or a text such as "
            "\"20 us\"");
  EXPECT_EQ(refused({"segment.0.duratoin=1"}), "--set segment.0.duratoin: unknown key; did you mean \"duration\"?");
  EXPECT_EQ(refused({"segment.1.duration=1"}),
            "--set segment.1.duration: segment is a list of 1 elements, counted from 0; it has no element \"1\"");
  EXPECT_EQ(refused({"velocity.x=1"}),
            "--set velocity.x: velocity is a list of 3 elements, counted from 0; it has no element \"x\"");
  EXPECT_EQ(refused({"velocity.0.x=1"}), "--set velocity.0.x: velocity.0 is the number 1, which has no parts");
  EXPECT_EQ(refused({"name.x=1"}), "--set name.x: name is a text, which has no parts");
  const std::string without_quotes = refused({"velocity=[0, -210 m/s]"});
  EXPECT_NE(without_quotes.find("single quotes"), std::string::npos) << without_quotes;
  EXPECT_EQ(refused({"name"}), "--set name: the value is missing; key=value is required");
  EXPECT_EQ(refused({"name="}), "--set name: the value is missing after \"=\"");
  EXPECT_EQ(refused({"=1"}), "--set \"\": the key has an empty part; table.key or list.0.key is required");
  EXPECT_EQ(refused({"segment..duration=1"}),
            "--set segment..duration: the key has an empty part; table.key or list.0.key is required");
  EXPECT_EQ(refused({"velocity=[1, 2"}),
            "--set velocity: not valid TOML: in this array: encountered end-of-file; the slip may stand before this place");
  EXPECT_EQ(refused({"name=\"a\"\nvelocity=[0, 0, 0]"}), "--set name: one value is required");
  EXPECT_EQ(refused({"segment.0={duration = true}"}),
            "--set segment.0.duration: this is true, not a time; give a number in s or a text such as \"20 us\", > 0");
  EXPECT_EQ(refused({"new.table.key=1"}), "--set new: unknown key; the keys known here are name, velocity, segment");
}

// --- Messages ---------------------------------------------------------------------------------------------------------

TEST(Nearest, InitialsStandForAName) {
  constexpr std::array<std::string_view, 3> laws = {"jones_wilkins_lee", "jwl_plus_plus", "johnson_cook"};
  EXPECT_EQ(did_you_mean("jwl", laws), "; did you mean \"jones_wilkins_lee\" or \"jwl_plus_plus\"?");
  EXPECT_EQ(did_you_mean("JWL", laws), did_you_mean("jwl", laws));
  EXPECT_EQ(did_you_mean("jwm", laws), "");
}

TEST(Nearest, WordIsFoundThroughOneSlip) {
  constexpr std::array<std::string_view, 4> words = {"length", "width", "A", "reference_temperature"};
  for (const char* slip : {"lenght", "legth", "lengthh", "Length", "lemgth", "LENGTH"})
    EXPECT_EQ(nearest(slip, words), "length") << slip;
  EXPECT_EQ(nearest("a", words), "A");
  EXPECT_EQ(nearest("refrence_temprature", words), "reference_temperature");
  constexpr std::array<std::string_view, 4> short_words = {"C", "n", "s0", "y1"};
  EXPECT_EQ(nearest("CC", short_words), "C");
  EXPECT_EQ(nearest("cc", short_words), "C");
  EXPECT_EQ(nearest("S0", short_words), "s0");
  EXPECT_EQ(nearest("s", short_words), "s0");
  EXPECT_EQ(nearest("s00", short_words), "s0");
  EXPECT_EQ(nearest("sp", std::array<std::string_view, 2>{"s", "up"}), "up") << "of two as near, the one that is as long";
  for (const char* other : {"m", "y2", "x3", "xyz"}) EXPECT_EQ(nearest(other, short_words), std::nullopt) << other;
  for (const char* other : {"", "x", "colour", "height_of_the_rod"}) EXPECT_EQ(nearest(other, words), std::nullopt) << other;
  EXPECT_EQ(nearest(std::string(1'000'000, 'a'), words), std::nullopt);
}

TEST(InputError, ShowsNoMoreProblemsThanAnyoneReads) {
  const std::string message = InputError(std::vector<Problem>(150, Problem{"f", 1, 2, "k", "w"})).what();
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 100);
  EXPECT_TRUE(message.ends_with("\n... and 50 more problems")) << message.substr(message.size() - 40);
}

}  // namespace
}  // namespace brisance
