// What the prescribed motion of a body says beforehand of its end at a side of the box.

#include "simulator/gas/foreseen_meetings.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "simulator/case_reader.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator::gas {
namespace {

using Kind = ForeseenMeeting::Kind;

constexpr double h = 5e-3, speed = 300.0;

/// A tube of 1 m by 50 mm with a piston between two places that moves at 300 m/s for 0.8 ms: by 0.24 m.
Case tube(const std::string& lower, const std::string& upper, const std::string& velocity, const std::string& more = "") {
  return read_case(write_text(scratch() / "tube.toml", box_of_air("5 mm", "0.8 ms", "[0, 0]", "[1, 0.05]") + R"([[gas.body]]
name = "piston"
shape = { box = { lower = )" + lower + ", upper = " + upper +
                                                           " } }\nvelocity = " + velocity + '\n' + more));
}

TEST(APistonInATube, EndsAtTheWallItRunsInto) {
  const auto met = foreseen_meetings(tube("[0.7, -0.05]", "[0.9, 0.1]", "[300, 0]"));
  ASSERT_EQ(met.size(), 1u);
  EXPECT_EQ(met[0].kind, Kind::runs_into_wall);
  EXPECT_EQ(met[0].body + " " + met[0].side, "piston high_x");
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(met[0].time, (0.1 - 0.5 * h) / speed, rounding);
  EXPECT_TRUE(contains(in_words(met[0]), "piston: at 0.000325 s it is within half a cell of the wall high_x"));
}

TEST(APistonInATube, LetsGoOfTheWallWhereItsEndLeavesIt) {
  // As long as it starts beyond the wall it takes to come inside.
  const auto later = foreseen_meetings(tube("[-0.05, -0.05]", "[0.1, 0.1]", "[300, 0]"));
  ASSERT_EQ(later.size(), 1u);
  EXPECT_EQ(later[0].kind, Kind::lets_go_of_wall);
  EXPECT_EQ(later[0].side, "low_x");
  constexpr double one_look = 1e-6;  // s
  EXPECT_NEAR(later[0].time, 0.05 / speed, one_look);
  EXPECT_NEAR(later[0].missing, 0.24 - 0.05 + h, 1e-9) << "and a cell to be sure";
  const auto at_once = foreseen_meetings(tube("[0, 0]", "[0.1, 0.05]", "[300, 0]"));
  ASSERT_EQ(at_once.size(), 1u);
  EXPECT_EQ(at_once[0].kind, Kind::lets_go_of_wall);
  EXPECT_EQ(at_once[0].time, 0.0);
  // Nor can gas widen that starts as less than half a cell.
  const auto near = foreseen_meetings(tube("[0.0025, 0]", "[0.1, 0.05]", "[300, 0]"));
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].kind, Kind::lets_go_of_wall);
}

TEST(APistonInATube, LeavesThroughAnOpenSide) {
  const auto met = foreseen_meetings(
      tube("[0.7, -0.05]", "[0.9, 0.1]", "[300, 0]", "[[gas.edge]]\nside = \"high_x\"\nkind = \"pressure\"\npressure = 1e5\n"));
  EXPECT_TRUE(met.empty());
}

TEST(APistonInATube, ThatReachesFarEnoughSlidesOrStopsMeetsNothing) {
  EXPECT_TRUE(foreseen_meetings(tube("[-0.3, -0.05]", "[0.1, 0.1]", "[300, 0]")).empty());
  EXPECT_TRUE(foreseen_meetings(tube("[0.3, 0]", "[0.5, 0.05]", "[300, 0]")).empty()) << "flush with the walls along it";
  EXPECT_TRUE(foreseen_meetings(tube("[0.3, 0]", "[0.5, 0.025]", "[300, 0]")).empty()) << "on one of them";
  EXPECT_TRUE(foreseen_meetings(tube("[0.7, -0.05]", "[0.9, 0.1]", "[300, 0]",
                                     "amplitude = { time = [0, \"0.2 ms\", \"0.2001 ms\"], value = [1, 1, 0] }\n"))
                  .empty())
      << "after 60 of 100 mm";
}

/// A second body in the tube, without a motion unless `more` gives one.
std::string body(const std::string& shape, const std::string& more = "") {
  return "[[gas.body]]\nname = \"other\"\nshape = " + shape + "\n" + more;
}

TEST(TwoBodiesInATube, MeetWhereTheirWaysCross) {
  // 100 mm between them.
  const std::string block = "{ box = { lower = [0.5, 0], upper = [0.6, 0.025] } }";
  const auto stands = foreseen_meetings(tube("[0.3, 0]", "[0.4, 0.05]", "[300, 0]", body(block)));
  ASSERT_EQ(stands.size(), 1u);
  EXPECT_EQ(stands[0].kind, Kind::runs_into_body);
  EXPECT_EQ(stands[0].body + " " + stands[0].side, "piston other");
  constexpr double two_looks = 2 * 0.8e-3 / 400;  // s
  EXPECT_NEAR(stands[0].time, 0.1 / speed, two_looks);
  EXPECT_TRUE(contains(in_words(stands[0]), "piston and other: from 0.00033")) << in_words(stands[0]);
  const auto comes = foreseen_meetings(tube("[0.3, 0]", "[0.4, 0.05]", "[300, 0]", body(block, "velocity = [-300, 0]")));
  ASSERT_EQ(comes.size(), 1u);
  EXPECT_NEAR(comes[0].time, 0.05 / speed, two_looks);
  EXPECT_TRUE(foreseen_meetings(tube("[0.3, 0]", "[0.4, 0.05]", "[300, 0]", body(block, "velocity = [200, 0]"))).empty())
      << "it runs away: 20 mm are left";
}

const std::string ring_of_tube =
    "[[gas.edge]]\nside = \"low_x\"\nkind = \"periodic\"\n[[gas.edge]]\nside = \"high_x\"\nkind = \"periodic\"\n";

/// The tube is 1 m long: from the end of the piston at 0.9 m there are 100 mm to the side, and so many beyond it as the block
/// begins at.
TEST(TwoBodiesInATube, MeetRoundItsPeriod) {
  const auto met = [&](const std::string& from, const std::string& to) {
    return foreseen_meetings(tube("[0.8, 0]", "[0.9, 0.05]", "[300, 0]",
                                  ring_of_tube + body("{ box = { lower = [" + from + ", 0], upper = [" + to + ", 0.025] } }")));
  };
  const auto beyond = met("0.05", "0.15");
  ASSERT_EQ(beyond.size(), 1u);
  EXPECT_EQ(beyond[0].kind, Kind::runs_into_body);
  constexpr double two_looks = 2 * 0.8e-3 / 400;  // s
  EXPECT_NEAR(beyond[0].time, 0.15 / speed, two_looks);
  const auto at_the_side = met("0", "0.1");
  ASSERT_EQ(at_the_side.size(), 1u);
  EXPECT_NEAR(at_the_side[0].time, 0.1 / speed, two_looks) << "only images beyond the side are near it";
  EXPECT_TRUE(met("0.2", "0.3").empty()) << "60 mm are left";
  const auto touching = foreseen_meetings(
      tube("[0.9, 0]", "[1, 0.05]", "[-300, 0]", ring_of_tube + body("{ box = { lower = [0, 0], upper = [0.1, 0.025] } }")));
  ASSERT_EQ(touching.size(), 1u);
  EXPECT_EQ(touching[0].kind, Kind::slides_along_body) << "flush round the period";
}

/// It leaves the box on one side before it comes to the wall above, which it does within it again.
TEST(ABodyThatGoesRoundThePeriod, MeetsTheWallItThenRunsInto) {
  const auto met = foreseen_meetings(tube("[0.9, 0.01]", "[0.95, 0.02]", "[300, 50]", ring_of_tube));
  ASSERT_EQ(met.size(), 1u);
  EXPECT_EQ(met[0].body + " " + met[0].side, "piston high_y");
  EXPECT_NEAR(met[0].time, (0.03 - 0.5 * h) / 50.0, 1e-9);
}

TEST(TwoBodiesInATube, ThatPassEachOtherDoNotMeet) {
  const auto passing = [&](const std::string& lower, const std::string& upper, const std::string& more = "") {
    return foreseen_meetings(
        tube("[0.3, 0]", "[0.4, 0.025]", "[300, 0]", body("{ box = { lower = " + lower + ", upper = " + upper + " } }", more)));
  };
  EXPECT_TRUE(passing("[0.5, 0.035]", "[0.6, 0.05]").empty()) << "two cells beside it";
  for (const std::string more : {"", "particles_per_direction = 8"}) {
    const auto flush = passing("[0.4, 0.025]", "[0.6, 0.05]", more);
    ASSERT_EQ(flush.size(), 1u) << more;
    EXPECT_EQ(flush[0].kind, Kind::slides_along_body) << more;
    EXPECT_TRUE(contains(in_words(flush[0]), "piston and other: there is less than half a cell between them")) << more;
  }
  EXPECT_EQ(passing("[0.5, 0.02]", "[0.6, 0.05]").size(), 1u) << "a cell in its way";
}

/// A bar that turns about its middle: 60 mm from there it comes by.
TEST(ABarThatTurns, MeetsWhatItsEndsReach) {
  const auto turning = [&](const std::string& radius) {
    return foreseen_meetings(
        read_case(write_text(scratch() / "bar.toml", box_of_air("5 mm", "1 ms", "[-0.2, -0.2]", "[0.2, 0.2]") + R"([[gas.body]]
name = "bar"
shape = { box = { lower = [-0.06, -0.01], upper = [0.06, 0.01] } }
rotation = [0, 0, 2000]
[[gas.body]]
name = "ball"
shape = { sphere = { centre = [0, 0.1], radius = )" + radius +
                                                         " } }\n")));
  };
  const auto met = turning("0.06");
  ASSERT_EQ(met.size(), 1u);
  EXPECT_EQ(met[0].kind, Kind::runs_into_body);
  EXPECT_LT(met[0].time, 0.25 * 3.1416e-3) << "before it stands upright";
  EXPECT_GT(met[0].time, 0.1 * 3.1416e-3);
  EXPECT_TRUE(turning("0.02").empty());
}

/// They run to their ends: nothing is to be foreseen of them.
TEST(TheCasesWithBodies, AreNotWarnedOf) {
  int with_bodies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BRISANCE_SOURCE_DIR "/data/cases")) {
    if (entry.path().extension() != ".toml" || !contains(text_of(entry.path()), "[[gas.body]]")) continue;
    ++with_bodies;
    for (const ForeseenMeeting& meeting : foreseen_meetings(read_case(entry.path())))
      ADD_FAILURE() << entry.path() << ": " << in_words(meeting);
  }
  EXPECT_GT(with_bodies, 8);
}

}  // namespace
}  // namespace brisance::simulator::gas
