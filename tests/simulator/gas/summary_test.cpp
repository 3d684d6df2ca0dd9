// What the summary of a run tells of gas and of bodies in it.

#include "simulator/output/summary.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulator/case_reader.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/command_line.hpp"

namespace brisance::simulator {
namespace {

Simulation after_steps(const Case& c, int steps) {
  Simulation s = set_up(c);
  EXPECT_NE(run(c, s, {scratch(), {}, steps}).ending, Ending::failed);
  return s;
}
Summary summary_of(const Simulation& s) {
  Summary summary;
  summary.steps = s.step, summary.particles = count_points(s), summary.books = books_of(s);
  return summary;
}

TEST(TheSummaryOfARingThatWidens, TellsItsRadiusForItsCentreStays) {
  const Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/widening_ring.toml", {"output.figures=false"});
  const Simulation s = after_steps(c, 30);
  const GasBodyBooks ring = books_of(s).gas->bodies.at(0);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(ring.growth, 0.05 * s.time, rounding) << "at 0.05 m/s";
  EXPECT_EQ(ring.displacement, Vector{});
  const std::string words = in_words(summary_of(s));
  EXPECT_TRUE(contains(words, "its centre moved [m]    x            0  y            0")) << words;
  EXPECT_TRUE(contains(words, "it widened [m]") && contains(words, "from 0.25 to 0.25")) << words;
}

TEST(TheSummaryOfAPiston, TellsForceAndWayWithTheirSigns) {
  const Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/piston_in_gas.toml", {"output.figures=false"});
  const Simulation s = after_steps(c, 30);
  const GasBodyBooks piston = books_of(s).gas->bodies.at(0);
  ASSERT_LT(piston.displacement[0], 0.0) << "it moves to the left";
  ASSERT_GT(piston.force[0], 0.0) << "against what it compresses";
  const std::string words = in_words(summary_of(s));
  EXPECT_TRUE(contains(words, fmt::format("its centre moved [m]    x {:12.6g}", piston.displacement[0]))) << words;
  EXPECT_TRUE(contains(words, fmt::format("force of the gas [N/m]  x {:12.6g}", piston.force[0]))) << words;
}

TEST(TheSummaryOfABodyThatTurns, TellsTheAngle) {
  Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/disk_with_the_gas.toml", {"output.figures=false"});
  c.gas->bodies.at(0).rotation = {0.0, 0.0, -2.0};
  c.gas->bodies.at(0).centre = {};  // wherever: the angle is the same
  Simulation s = set_up(c);
  s.gas.bodies.all.at(0).state = gas::moved(s.gas.bodies.all.at(0), 0.0, 0.25);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(books_of(s).gas->bodies.at(0).turned, -0.5, rounding);
  EXPECT_TRUE(contains(in_words(summary_of(s)), "it turned [degrees]")) << in_words(summary_of(s));
}

/// Fluids meet in a cell that is far hotter than all that one fluid fills.
TEST(TheSummaryOfSeveralFluids, TellsTheHottestCellsWithAndWithoutThoseThatTheyShare) {
  Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/water_air_shock_tube.toml", {"output.figures=false"});
  Simulation s = set_up(c);
  const gas::Gas& gas = s.gas;
  const gas::Hottest pure = gas::hottest(gas);
  ASSERT_TRUE(pure.of_one_fluid);
  EXPECT_EQ(pure.of_all.temperature, pure.of_one_fluid->temperature);
  EXPECT_FALSE(gas::is_doubtful(pure));
  // A tenth of the volume of one cell is given to the other fluid, and all of its heat stays with the first.
  const gas::CellPlace at = *gas::find_cell(gas, pure.of_all.place);
  const bool of_first = gas.fluids[0].name == pure.of_all.fluid.fluid;
  const auto value = [&](bool one, int quantity) -> double& {
    return s.gas.content.cell(at.block, gas::Content::of(gas.dimensions(), one == of_first ? 0 : 1, quantity), at.cell);
  };
  value(false, gas::Content::volume) = 0.1 * value(true, gas::Content::volume);
  value(true, gas::Content::volume) *= 0.9, value(true, gas::Content::internal) *= 3.0;
  const gas::Hottest shared = gas::hottest(gas);
  EXPECT_GT(shared.of_all.temperature, 1.5 * pure.of_all.temperature);
  EXPECT_NEAR(shared.of_all.fluid.part, 0.9, 1e-6);
  EXPECT_LE(shared.of_one_fluid->temperature, pure.of_all.temperature);
  EXPECT_TRUE(gas::is_doubtful(shared));
  Summary summary = summary_of(s);
  summary.hottest = shared;
  EXPECT_TRUE(contains(in_words(summary), "hottest of one fluid [K]")) << in_words(summary);
  EXPECT_TRUE(contains(in_words(summary), "caution: the hottest cell is shared by fluids")) << in_words(summary);
  const fs::path file = scratch() / "summary.json";
  write_summary(summary, file);
  EXPECT_TRUE(contains(text_of(file), "\"hottest_cell\": {") && contains(text_of(file), "\"hottest_cell_of_one_fluid\": {"));
}

TEST(TheSummaryOfGasInCells, SaysWhatCautionMeansAndWhetherToAct) {
  const Case c = read_case(fs::path(BRISANCE_SOURCE_DIR) / "data/cases/sod.toml", {"output.figures=false"});
  Summary summary = summary_of(after_steps(c, 10));
  EXPECT_FALSE(contains(in_words(summary), "caution"));
  summary.books.gas->first_order_cell_steps = 4;  // of 4000
  EXPECT_TRUE(contains(in_words(summary), "4 times a cell took a step with first order (0.1 % of all cells and steps)"));
  EXPECT_TRUE(contains(in_words(summary), "needs no action")) << in_words(summary);
  summary.books.gas->first_order_cell_steps = 400;
  EXPECT_TRUE(contains(in_words(summary), "take smaller cells")) << in_words(summary);
}

}  // namespace
}  // namespace brisance::simulator
