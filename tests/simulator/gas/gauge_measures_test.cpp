// What is measured at gauges of the gas: a shock tube against its exact solution, in one run and in parts; what is wrong with a
// measure.

#include <gtest/gtest.h>

#include <algorithm>

#include "simulator/commands.hpp"
#include "simulator/run.hpp"
#include "tests/simulator/case_files.hpp"
#include "tests/simulator/gas/exact_riemann.hpp"
#include "tests/simulator/gas/interrupted_run.hpp"

namespace brisance::simulator {
namespace {

/// Sod's tube, 3 m long: its rarefaction comes back from the wall at 0 and ends the phase at 2 m.
const std::string tube = R"(title = "Tube with a gauge"
geometry = "planar_1d"
cell_size = 0.005
end_time = 0.8
[gas]
lower = [0]
upper = [3]
[[gas.fluid]]
name = "gas"
[gas.fluid.material]
name = "ideal gas"
density = 1
density_source = "Sod"
[gas.fluid.material.equation_of_state]
law = "ideal_gas"
source = "Sod"
gamma = 1.4
specific_heat = 1
[[gas.fill]]
density = 0.125
pressure = 0.1
[[gas.fill]]
shape = { box = { lower = [0], upper = [1] } }
density = 1
pressure = 1
[[gauge]]
name = "far"
kind = "point"
from = [2.0025]
fields = ["density"]
[[gauge]]
name = "line"
kind = "line"
from = [1]
to = [2]
fields = ["density"]
[output]
figures = false
)";
std::string measure(const std::string& kind, const std::string& more = "gauge = \"far\"\nambient = \"0.1 Pa\"\n") {
  return "[[measure]]\nkind = \"" + kind + "\"\n" + more;
}
const std::string all_measures =
    measure("peak_overpressure") + measure("arrival_time") + measure("positive_duration") + measure("positive_impulse");

MeasuredValue find(const Summary& summary, const std::string& name) {
  return *std::find_if(summary.measures.begin(), summary.measures.end(),
                       [&](const MeasuredValue& m) { return m.name == name; });
}

TEST(MeasuresAtAGauge, AreThoseOfTheExactShockTubeAndOfARunInParts) {
  const Case c = read_case(written(tube + all_measures));
  const InterruptedRun r = run_whole_and_in_parts(c, {40, 540, 20});
  ASSERT_GT(r.whole.step, 600);
  const Summary& whole = r.uninterrupted.summary;
  const gas::ExactRiemann exact({1.0, 0.0, 1.0}, {0.125, 0.0, 0.1});
  const double p = exact.star_pressure(), sound = std::sqrt(1.4 * 0.1 / 0.125);
  const double shock = sound * std::sqrt(1.0 + 6.0 / 7.0 * (p / 0.1 - 1.0));  // (gamma + 1)/(2 gamma)
  EXPECT_NEAR(find(whole, "far_peak_overpressure").value, p - 0.1, 0.005 * (p - 0.1));
  EXPECT_NEAR(find(whole, "far_arrival_time").value, 1.0025 / shock, 0.5 * 0.005 / shock);
  EXPECT_LT(find(whole, "far_arrival_time").value, 580.0 / static_cast<double>(r.whole.step) * c.end_time)
      << "parts on either side of it";
  EXPECT_EQ(find(whole, "far_peak_overpressure").unit, "Pa");
  // Not over yet at 0.8 s.
  EXPECT_TRUE(contains(find(whole, "far_positive_impulse").missing, "the positive phase has not ended"));
  const std::string summary = text_of(r.whole_directory / "summary.json"), words = in_words(whole);
  EXPECT_TRUE(contains(summary, "\"far_positive_duration\": null")) << summary;
  EXPECT_TRUE(contains(words, "caution: far_positive_duration: the positive phase has not ended")) << words;
  const auto measures_in = [](const std::string& text) {
    return text.substr(text.find("\"measures\""), text.find("\"comparison\"") - text.find("\"measures\""));
  };
  EXPECT_EQ(measures_in(summary), measures_in(text_of(r.parts_directory / "summary.json")));
  // A report reads them from the checkpoint.
  Simulation s = set_up(c);
  const Summary again = report(c, s, r.parts_directory);
  for (const char* name : {"far_peak_overpressure", "far_arrival_time"})
    EXPECT_EQ(find(again, name).value, find(whole, name).value) << name;
}

/// A wave of sound: its velocity is its overpressure over rho c, so it passes as it is, half a wave above and half a wave
/// below.
TEST(MeasuresAtAGauge, IntegrateEveryStepHoweverFewRowsThereAre) {
  std::string text = tube;
  const std::string driver = "shape = { box = { lower = [0], upper = [1] } }\ndensity = 1\npressure = 1\n";
  text.replace(
      text.find(driver), driver.size(),
      "shape = { box = { lower = [0], upper = [1] } }\ndensity = \"1.25e-1*(1 + 1e-4*sin(2*pi*(x - 0.5))/1.4)\"\n"
      "pressure = \"0.1*(1 + 1e-4*sin(2*pi*(x - 0.5)))\"\nvelocity = [\"1e-4*sin(2*pi*(x - 0.5))*sqrt(1.4*0.8)/1.4\"]\n");
  const Case c = read_case(written(text + all_measures), {"end_time=1.8", "output.history_interval=1.8"});
  const fs::path directory = scratch();
  prepare_directory(directory / "run", c, false);
  Simulation s = set_up(c);
  const Summary summary = run(c, s, {directory / "run", {}}).summary;
  const double sound = std::sqrt(1.4 * 0.1 / 0.125), half_a_wave = 0.5 / sound, height = 1e-5;
  EXPECT_NEAR(find(summary, "far_peak_overpressure").value, height, 0.01 * height);
  EXPECT_NEAR(find(summary, "far_positive_impulse").value, height * half_a_wave * 2.0 / std::acos(-1.0),
              0.005 * height * half_a_wave);
  // Half of the height is reached a sixth of the half wave after the front.
  EXPECT_NEAR(find(summary, "far_arrival_time").value, 1.0025 / sound + half_a_wave / 6.0, 0.01 * half_a_wave);
  EXPECT_NEAR(find(summary, "far_positive_duration").value, half_a_wave * 5.0 / 6.0, 0.02 * half_a_wave);
}

TEST(MeasuresAtAGauge, ThatNoWaveReachesHaveNoValue) {
  const Case c = read_case(written(tube + all_measures), {"end_time=0.1"});
  const fs::path directory = scratch();
  prepare_directory(directory / "run", c, false);
  Simulation s = set_up(c);
  for (const MeasuredValue& m : run(c, s, {directory / "run", {}}).summary.measures)
    EXPECT_TRUE(contains(m.missing, "has not risen above the ambient one")) << m.name;
}

TEST(MeasuresAtAGauge, AreReadStrictly) {
  const auto problem = [](const std::string& text) { return problems_of(tube + text); };
  const auto expect = [](const std::string& what, const std::string& part) { EXPECT_TRUE(contains(what, part)) << what; };
  EXPECT_EQ(problem(all_measures), "none");
  expect(problem(measure("peak_overpressure", "gauge = \"far\"\n")), "measure.0.ambient: missing");
  expect(problem(measure("peak_overpressure", "ambient = 1\n")), "measure.0.gauge: missing");
  expect(problem(measure("arrival_time", "gauge = \"fat\"\nambient = 1\n")),
         "measure.0.gauge: there is no gauge \"fat\" of kind point; there is far; did you mean \"far\"?");
  expect(problem(measure("arrival_time", "gauge = \"line\"\nambient = 1\n")), "there is no gauge \"line\" of kind point");
  expect(problem(measure("arrival_time", "gauge = \"far\"\nambient = \"1 s\"\n")),
         "measure.0.ambient: \"1 s\" is not a pressure");
  expect(problem(measure("arrival_time", "gauge = \"far\"\nambient = 1\nmeasured = \"1 MPa\"\n")),
         "measure.0.measured: \"1 MPa\" is not a time");
  expect(problem(measure("arrival_time", "gauge = \"far\"\nambient = 1\nbody = \"far\"\naxis = \"x\"\nat = 1\n")),
         "measure.0.body: it would be ignored: the kind is one of gas");
  expect(problem(measure("arival_time")), "did you mean \"arrival_time\"?");
  expect(problem(measure("final_length", "")), "measure.0.kind: it is measured of solids alone, and this case is one of gas");
  expect(problem(all_measures + measure("arrival_time")), "the name \"far_arrival_time\" is given twice");
  expect(problems_of(bar + measure("arrival_time", "")),
         "measure.0.kind: it is measured of gas alone, and this case is one of");
  expect(problems_of(bar + measure("final_length", "ambient = 1\n")), "measure.0.ambient: it would be ignored");
  EXPECT_EQ(read_case(written(tube + measure("peak_overpressure", "gauge = \"far\"\nambient = 1\nmeasured = \"2 kPa\"\n")))
                .measures.at(0)
                .measured,
            2000.0);
}

/// What a run writes as its case.toml is read back as it was.
TEST(MeasuresAtAGauge, AreWrittenAsTheyAreRead) {
  const Case c = read_case(written(tube + all_measures));
  const fs::path directory = scratch();
  prepare_directory(directory / "run", c, false);
  const Case again = read_case(directory / "run" / "case.toml");
  ASSERT_EQ(again.measures.size(), 4u);
  EXPECT_EQ(again.measures[3].name, "far_positive_impulse");
  EXPECT_EQ(again.measures[3].ambient, 0.1);
}

}  // namespace
}  // namespace brisance::simulator
