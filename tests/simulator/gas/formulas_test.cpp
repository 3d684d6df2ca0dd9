// Formulas of place and time in case files: what they mean, what is refused, and the gas that comes in by them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "models/input/diagnostics.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/formula.hpp"
#include "simulator/gas/gas_setup.hpp"
#include "tests/simulator/gas/interrupted_run.hpp"
#include "tests/simulator/gas/set_up.hpp"

namespace brisance::simulator {
namespace {

constexpr double round_off = 1e-15;

TEST(Formula, KnowsPlaceRadiusAndTime) {
  const Vector x{3.0, 4.0, 12.0};
  const auto of = [&](const std::string& text, int dimensions) { return Formula(text, dimensions, true)(x, 10.0); };
  EXPECT_EQ(of("(1 + t/r)^2", 2), 9.0);
  EXPECT_EQ(of("z/r", 3), 12.0 / 13.0);
  EXPECT_EQ(Formula("r", 1, true)({-3.0, 0.0, 0.0}, 0.0), 3.0);
  EXPECT_NEAR(of("sin(pi/6)*exp(ln(y))", 2), 2.0, 4.0 * round_off);
  EXPECT_EQ(of("t < 10 ? 1 : 2", 1), 2.0);
  EXPECT_FALSE(std::isfinite(Formula("1/x", 1, true)({}, 0.0)));
}

std::string refusal(const std::string& text, int dimensions = 2, bool with_time = true) {
  try {
    const Formula formula(text, dimensions, with_time);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Formula, SaysWhatIsWrongAndWhatIsAllowed) {
  EXPECT_TRUE(contains(refusal("(1 + t/r"), "\"(1 + t/r\" is no formula: ")) << refusal("(1 + t/r");
  EXPECT_TRUE(contains(refusal("1 + sqr(t)"), "\"sqr\" is unknown")) << refusal("1 + sqr(t)");
  EXPECT_TRUE(contains(refusal("1 + sqr(t)"), "did you mean \"sqrt\"?")) << refusal("1 + sqr(t)");
  EXPECT_TRUE(contains(refusal("1 + z", 2), "\"z\" is unknown")) << refusal("1 + z", 2);
  EXPECT_TRUE(contains(refusal("1 + t", 2, false), "\"t\" is unknown")) << refusal("1 + t", 2, false);
  for (const char* text : {"x = 2", "1, 2", "\"a\"", "1 +", "", "x y", "2 x"}) EXPECT_NE(refusal(text), "") << text;
  EXPECT_EQ(refusal("x >= 1 && y != 2 ? 1 : 2"), "");
}

TEST(Formula, IsTheSameForThreadsThatUseItTogether) {
  const Formula formula("x^2 + t*y/r", 2, true);
  const auto sum = [&](double scale) {
    double all = 0.0;
    for (int n = 1; n < 20000; ++n) all += formula({scale * n, 2.0 / n, 0.0}, n);
    return all;
  };
  const double alone[] = {sum(1.0), sum(2.0)};
  double together[2];
  std::thread first([&] { together[0] = sum(1.0); }), second([&] { together[1] = sum(2.0); });
  first.join(), second.join();
  EXPECT_EQ(together[0], alone[0]);
  EXPECT_EQ(together[1], alone[1]);
}

// In case files ----------------------------------------------------------------------------------------------------------

/// Gas of pressure 1 with waves of density, carried through a box by what comes in from all sides.
std::string carried(int cells) {
  const std::string density = "1 + 0.2*sin(2*pi*(x - ";
  const auto edge = [&](const std::string& side) {
    return "[[gas.edge]]\nside = \"" + side + "\"\nkind = \"inflow\"\npressure = 1\ndensity = \"" + density +
           "t))\"\nvelocity = [1, \"0*x\"]\n";
  };
  return "geometry = \"plane\"\nend_time = 0.5\ncell_size = " + std::to_string(1.0 / cells) + R"(
[output]
figures = false
[gas]
lower = [0, 0]
upper = [1, 0.2]
[[gas.fluid]]
name = "gas"
[gas.fluid.material]
name = "ideal gas"
density = 1
density_source = "that of the start"
[gas.fluid.material.equation_of_state]
law = "ideal_gas"
source = "a textbook gas"
gamma = 1.4
specific_heat = 718
[[gas.fill]]
density = ")" +
         density + "0))\"\npressure = 1\nvelocity = [1, 0]\n" + edge("low_x") + edge("high_x") + edge("high_y");
}

Case case_of(const std::string& text) {
  return read_case(write_text(scratch() / "case.toml", text));
}

TEST(FormulasBeyondAnEdge, BringWavesInWithSecondOrder) {
  double before = 0.0;
  for (const int cells : {25, 50, 100}) {
    const Case c = case_of(carried(cells));
    const auto domain = single_process();
    gas::Gas gas = gas::make_gas(c, *domain);
    gas::set_up::Stepper().to(gas, c.end_time, *domain);
    double error = 0.0, volume = 0.0;
    gas::set_up::for_each_cell(gas, [&](const gas::set_up::Cell& at) {
      const double k = 2.0 * std::numbers::pi, h = 1.0 / cells, x = at.centre[0] - gas.time;
      const double exact = 1.0 + 0.2 * (std::cos(k * (x - 0.5 * h)) - std::cos(k * (x + 0.5 * h))) / (k * h);
      error += at.volume * std::abs(at.density - exact), volume += at.volume;
    });
    error /= volume;
    if (before > 0.0) {
      constexpr double second_order = 1.9;
      EXPECT_GT(std::log2(before / error), second_order) << cells << " cells";
    }
    RecordProperty("error_" + std::to_string(cells), std::to_string(1e6 * error) + "e-6");
    before = error;
  }
}

TEST(FormulasBeyondAnEdge, GoOnFromACheckpointWithTheSameBits) {
  const Case c = case_of(carried(20));
  const InterruptedRun r = run_whole_and_in_parts(c, {7, 5});
  EXPECT_GT(r.whole.step, 20);
  // The copy of the case that a run keeps says the same.
  const Case kept = read_case(r.whole_directory / "case.toml");
  ASSERT_TRUE(kept.gas->edges.at(0).density->formula);
  EXPECT_EQ(kept.gas->edges.at(0).density->formula->text(), "1 + 0.2*sin(2*pi*(x - t))");
  EXPECT_EQ(kept.gas->edges.at(0).velocity.components[1].formula->text(), "0*x");
}

std::string problems_of(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  if (at == std::string::npos) return "the case does not hold " + from;
  text.replace(at, from.size(), to);
  try {
    case_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(FormulasBeyondAnEdge, AreRefusedWithTheLineAndWhatIsAllowed) {
  struct Wrong {
    std::string from, to, says;
  };
  for (const Wrong& wrong : {
           Wrong{"(x - t)", "(x - time)", "gas.edge.2.density: "},
           Wrong{"(x - t)", "(x - time)", "\"time\" is unknown; it may speak of x, y, r, t, pi; or give a number in kg/m^3"},
           Wrong{"(x - t)", "(x - time)", "case.toml:40:11: "},
           Wrong{"(x - t)", "(x - t", "is no formula"},
           Wrong{"1 + 0.2*sin", "0.1 + 0.2*sin", "it must be > 0"},
           Wrong{"\"0*x\"", "\"1/(y - y)\"", "gas.edge.2.velocity: \"1/(y - y)\" is inf at ("},
           Wrong{"pressure = 1\n", "pressure = \"-1 + 0*t\"\n", "gas.edge.2.pressure: at ("},
           Wrong{"\"inflow\"", "\"pressure\"", "only the pressure counts beyond an edge of this kind"},
           Wrong{"[[gas.edge]]",
                 "[[gas.fill]]\nshape = { sphere = { centre = [0, 0], radius = 0.1 } }\npressure = 1\n"
                 "density = \"1 + t\"\n[[gas.edge]]",
                 "\"t\" is unknown"},
           Wrong{"[[gas.edge]]",
                 "[[gas.fill]]\nshape = { sphere = { centre = [0, 0], radius = 0.1 } }\npressure = 1\n"
                 "density = \"r - 0.05\"\n[[gas.edge]]",
                 "gas.fill.1.density: \"r - 0.05\" is "},
       }) {
    const std::string problems = problems_of(carried(20), wrong.from, wrong.to);
    EXPECT_TRUE(contains(problems, wrong.says)) << problems;
  }
}

/// Each for itself: whatever else is wrong with the state, and where it is.
TEST(FormulasBeyondAnEdge, AreJudgedWhateverElseIsWrong) {
  for (const auto& [from, to, also] :
       {std::tuple{"density = \"1 + 0.2*sin(2*pi*(x - t))\"\nvelocity = [1, \"0*x\"]", "velocity = [\"1/(x-x)\", 0]",
                   "neither density nor temperature is given"},
        {"density = \"1 + 0.2*sin(2*pi*(x - t))\"\nvelocity = [1, \"0*x\"]",
         "density = \"-2 + x\"\nvelocity = [\"1/(x-x)\", 0]", "gas.edge.2.density: \"-2 + x\" is "},
        {"side = \"high_y\"\nkind = \"inflow\"\npressure = 1\ndensity = \"1 + 0.2*sin(2*pi*(x - t))\"\nvelocity = [1, \"0*x\"]",
         "side = \"high_x\"\nkind = \"inflow\"\npressure = 1\ndensity = 1\nvelocity = [\"1/(x-x)\", 0]",
         "this side is given twice"},
        {"side = \"high_y\"\nkind = \"inflow\"\npressure = 1\ndensity = \"1 + 0.2*sin(2*pi*(x - t))\"\nvelocity = [1, \"0*x\"]",
         "side = \"high_y\"\nkind = \"inflo\"\npressure = 1\ndensity = 1\nvelocity = [\"1/(x-x)\", 0]",
         "\"inflo\" is unknown"}}) {
    const std::string problems = problems_of(carried(20), from, to);
    EXPECT_TRUE(contains(problems, "gas.edge.2.velocity: \"1/(x-x)\" is ") && contains(problems, also)) << problems;
  }
}

/// With bodies the gas asks for eight rings of cells beyond a side, without for two.
TEST(FormulasBeyondAnEdge, AreTriedAsFarAsTheGasWillAsk) {
  const std::string body = "[[gas.body]]\nname = \"disk\"\nshape = { sphere = { centre = [0.5, 0], radius = 0.11 } }\n";
  const auto problems = [&](const std::string& text) {
    return problems_of(text, "pressure = 1\ndensity", "pressure = \"y > 0.45 ? -1 : 1\"\ndensity");
  };
  EXPECT_EQ(problems(carried(20)), "none");
  EXPECT_TRUE(contains(problems(carried(20) + body), "gas.edge.2.pressure: at (")) << problems(carried(20) + body);
}

/// A pressure that falls to zero after a fifth of the time: known before the first step, with place and time.
TEST(FormulasBeyondAnEdge, AreTriedThroughAllOfTheTimeBeforeARun) {
  const std::string problems = problems_of(carried(20), "pressure = 1\ndensity", "pressure = \"1 - 9.9*t\"\ndensity");
  EXPECT_TRUE(contains(problems, "case.toml:")) << problems;
  // The first of a hundredth after another of 0.5 s that is later than 0.1 s.
  EXPECT_TRUE(contains(problems, "pressure: at (0.025, 0.225) m, t = 0.105 s")) << problems;
}

/// Waves that are carried through a box, until the formula of a pressure beyond its upper side fails at 0.1 s: later than the
/// end of the case that was checked. With a body, and with a pressure alone beyond that side.
Case failing_on_the_way(const std::string& kind, bool with_body) {
  std::string text = carried(20);
  const auto replace = [&](const std::string& from, const std::string& to) { text.replace(text.rfind(from), from.size(), to); };
  const std::string low_to_high = "density = \"1 + 0.2*sin(2*pi*(x - t))\"\nvelocity = [1, \"0*x\"]\n";
  replace("pressure = 1\ndensity", "pressure = \"1 - 10*t\"\ndensity");
  if (kind == "pressure") replace(low_to_high, "");
  replace("kind = \"inflow\"", "kind = \"" + kind + "\"");
  replace("end_time = 0.5", "end_time = 0.05");
  if (with_body)
    text += "[[gas.body]]\nname = \"disk\"\nshape = { sphere = { centre = [0.5, 0], radius = 0.11 } }\nvelocity = [0.1, 0]\n";
  return case_of(text);
}

TEST(FormulasBeyondAnEdge, ThatFailOnTheWayLeaveTheGasAsItWasBeforeTheStep) {
  for (const std::string kind : {"inflow", "non_reflecting", "pressure"})
    for (const bool with_body : {false, true}) {
      const Case c = failing_on_the_way(kind, with_body);
      const auto domain = single_process();
      gas::Gas gas = gas::make_gas(c, *domain);
      std::vector<double> before;
      const auto step_until_it_fails = [&] {
        for (;;) before = numbers_of(gas), gas::set_up::Stepper().steps(gas, 1, *domain);
      };
      EXPECT_THROW(step_until_it_fails(), StepFailure) << kind;
      EXPECT_TRUE(numbers_of(gas) == before) << kind << (with_body ? " with a body" : "");
      EXPECT_GT(gas.time, 0.05) << kind;
    }
}

TEST(FormulasBeyondAnEdge, EndARunWithASentenceAndACheckpointWhereTheyFailOnTheWay) {
  const Case c = failing_on_the_way("inflow", false);
  Simulation s = set_up(c);
  const fs::path directory = scratch() / "run";
  prepare_directory(directory, c, false);
  const RunResult result = run(c, s, {directory, 0.5});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_TRUE(contains(result.message, "gas.edge high_y: pressure: at (")) << result.message;
  EXPECT_TRUE(contains(result.message, "last checkpoint: ")) << result.message;
  Simulation again = set_up(c);
  EXPECT_EQ(report(c, again, directory).steps, s.step);
  EXPECT_TRUE(gas::numbers_of(again.gas) == gas::numbers_of(s.gas));
}

TEST(FormulasOfAFill, AreRefusedWhereTheyFailBesideTheMiddleOfACell) {
  std::string text = carried(20);
  const std::string from = "1 + 0.2*sin(2*pi*(x - 0))";
  text.replace(text.find(from), from.size(), "x - 0.01");
  const auto domain = single_process();
  try {
    static_cast<void>(gas::make_gas(case_of(text), *domain));
    FAIL() << "a density below 0";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(contains(error.what(), "gas.fill: density: \"x - 0.01\" is -0.00375 at (0.00625, ")) << error.what();
  }
}

TEST(FormulasOfAFill, HoldWhatTheySayInTheMeanOfACell) {
  const Case c = case_of(carried(20));
  const auto domain = single_process();
  const gas::Gas gas = gas::make_gas(c, *domain);
  constexpr double by_places = 1e-4;  // of 8 along each direction
  gas::set_up::for_each_cell(gas, [&](const gas::set_up::Cell& at) {
    const double k = 2.0 * std::numbers::pi, h = 0.05, x = at.centre[0];
    EXPECT_NEAR(at.density, 1.0 + 0.2 * (std::cos(k * (x - 0.5 * h)) - std::cos(k * (x + 0.5 * h))) / (k * h), by_places);
    EXPECT_EQ(at.velocity[1], 0.0);
  });
}

}  // namespace
}  // namespace brisance::simulator
