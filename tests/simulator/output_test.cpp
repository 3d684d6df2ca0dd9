// What a run writes: snapshots that ParaView reads, histories, summaries, measures.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/input/csv.hpp"
#include "models/input/toml_tree.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/output/measures.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/output/snapshot.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

Case small_case(const fs::path& directory, const std::string& more = "") {
  return read_case(write_text(directory / "bar.toml", small_bar(more)));
}

TEST(Snapshot, HasWhatAVtkhdfReaderAsksFor) {
  const fs::path directory = scratch();
  const Simulation s = set_up(small_case(directory));
  write_snapshot(directory, s, {0.0});
  const Hdf5Reader file(directory / "bar_particles_000000.hdf");
  const std::uint64_t n = static_cast<std::uint64_t>(s.bodies[0].particles.size);
  EXPECT_EQ(file.text_attribute("VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_EQ(file.integers_attribute("VTKHDF", "Version"), (std::vector<std::int64_t>{1, 0}));
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    EXPECT_EQ(file.integers(std::string("VTKHDF/") + name), std::vector<std::int64_t>{static_cast<std::int64_t>(n)}) << name;
  EXPECT_EQ(file.shape("VTKHDF/Points"), (std::vector<std::uint64_t>{n, 3}));
  const std::vector<std::int64_t> offsets = file.integers("VTKHDF/Offsets"),
                                  connectivity = file.integers("VTKHDF/Connectivity");
  ASSERT_EQ(offsets.size(), n + 1);
  ASSERT_EQ(connectivity.size(), n);
  for (std::size_t i = 0; i < n; ++i) ASSERT_TRUE(offsets[i] == static_cast<std::int64_t>(i) && connectivity[i] == offsets[i]);
  EXPECT_EQ(offsets[n], static_cast<std::int64_t>(n));
  EXPECT_EQ(file.unsigned_integers("VTKHDF/Types"), std::vector<std::uint64_t>(n, 1));
  EXPECT_EQ(file.shape("VTKHDF/PointData/velocity"), (std::vector<std::uint64_t>{n, 3}));
  for (const char* name : {"pressure", "von_mises_stress", "temperature", "plastic_strain", "plastic_strain_rate", "porosity",
                           "damage", "density", "energy", "failure_cause", "id"})
    EXPECT_EQ(file.shape(std::string("VTKHDF/PointData/") + name), std::vector<std::uint64_t>{n}) << name;
}

TEST(Snapshot, HoldsTheParticlesInThreeDimensionsWhateverTheGeometry) {
  const fs::path directory = scratch();
  const Simulation s = set_up(small_case(directory));
  write_snapshot(directory, s, {0.0});
  const Hdf5Reader file(directory / "bar_particles_000000.hdf");
  const std::vector<double> points = file.doubles("VTKHDF/Points"), velocity = file.doubles("VTKHDF/PointData/velocity");
  const Particles& ps = s.bodies[0].particles;
  for (int p = 0; p < ps.size; ++p) {
    const auto i = 3 * static_cast<std::size_t>(p);
    const int q = static_cast<int>(s.bodies[0].bins.order[static_cast<std::size_t>(p)]);
    EXPECT_EQ(points[i], ps.motion.at(0, q));
    EXPECT_EQ(points[i + 1], ps.motion.at(1, q));
    EXPECT_EQ(points[i + 2], 0.0);
    EXPECT_EQ(velocity[i + 1], -190.0);
  }
}

TEST(Snapshot, TheSeriesListsEverySnapshotWithItsTime) {
  const fs::path directory = scratch();
  const Simulation s = set_up(small_case(directory));
  write_snapshot(directory, s, {0.0});
  write_snapshot(directory, s, {0.0, 2.5e-6});
  const std::string text = text_of(directory / "bar_particles.hdf.series");
  EXPECT_NE(text.find("\"file-series-version\": \"1.0\""), std::string::npos);
  EXPECT_NE(text.find("\"name\": \"bar_particles_000001.hdf\",\n      \"time\": 2.5e-06"), std::string::npos) << text;
}

TEST(History, TellsTheEnergiesOfTheWholeBarAndNotOfARadian) {
  const fs::path directory = scratch();
  const Case c = small_case(directory, "[output]\nfigures = false\n");
  Simulation s = set_up(c);
  prepare_directory(directory / "run", c, false);
  ASSERT_EQ(run(c, s, {directory / "run", {}, 5}).ending, Ending::interrupted);
  const CsvFile history = CsvFile::load(directory / "run" / "history.csv");
  const double volume = std::numbers::pi * 3.2e-3 * 3.2e-3 * 12e-3, mass = c.bodies[0].material.material.density * volume;
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(history.numbers("mass", Unit::kg)[0] / mass, 1.0, rounding);
  EXPECT_NEAR(history.numbers("kinetic_energy", Unit::J)[0] / (0.5 * mass * 190.0 * 190.0), 1.0, rounding);
  EXPECT_NEAR(history.numbers("momentum_y", Unit{"kg m/s"})[0] / (-190.0 * mass), 1.0, rounding);
}

TEST(History, SchedulesDoNotChangeTheSteps) {
  const fs::path directory = scratch();
  Simulation dense = set_up(small_case(directory)), sparse = set_up(small_case(directory));
  const Case often = small_case(directory,
                                "[output]\nfigures = false\nhistory_interval = \"0.03 us\"\nsnapshot_interval = \"0.7 us\"\n"
                                "checkpoint_steps = 7\ncheckpoint_interval = \"0.3 us\"\n");
  const Case seldom = small_case(directory, "[output]\nfigures = false\nhistory_interval = \"5 us\"\n");
  prepare_directory(directory / "often", often, false);
  prepare_directory(directory / "seldom", seldom, false);
  ASSERT_EQ(run(often, dense, {directory / "often", {}}).ending, Ending::done);
  ASSERT_EQ(run(seldom, sparse, {directory / "seldom", {}}).ending, Ending::done);
  EXPECT_EQ(dense.step, sparse.step);
  EXPECT_TRUE(bits_of(dense) == bits_of(sparse));
}

TEST(Measures, TellTheSizeOfTheUndeformedBar) {
  const fs::path directory = scratch();
  const Case c =
      small_case(directory,
                 "[[measure]]\nkind = \"final_length\"\n[[measure]]\nkind = \"mushroom_diameter\"\n"
                 "[[measure]]\nname = \"d\"\nkind = \"diameter_at\"\nat = 0.3\n[[measure]]\nkind = \"undeformed_length\"\n");
  const Simulation s = set_up(c);
  const std::vector<MeasuredValue> values = Measures(c, s).read(s);
  constexpr double rounding = 1e-12;
  const double expected[] = {12e-3, 6.4e-3, 6.4e-3, 12e-3};
  ASSERT_EQ(values.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(values[i].value, expected[i], rounding) << values[i].name;
}

/// Stretches the bar along its axis by `stretch` and widens its lower half by `widening`.
void deform(Simulation& s, double stretch, double widening) {
  Particles& ps = s.bodies[0].particles;
  using F = Layout<2>::Rest;
  for (int p = 0; p < ps.size; ++p) {
    const double w = ps.motion.at(1, p) < 6e-3 ? widening : 1.0;
    ps.motion.at(0, p) *= w, ps.motion.at(1, p) *= stretch;
    ps.rest.at(F::deformation_gradient, p) = w, ps.rest.at(F::deformation_gradient + 3, p) = stretch;
  }
}

TEST(Measures, FollowAKnownDeformationWithTheHalfWidthsOfParticles) {
  const fs::path directory = scratch();
  write_text(directory / "measured.csv", "# made up\nradius [mm],height [mm]\n4.0,2\n3.2,9\n");
  const Case c =
      small_case(directory,
                 "[[measure]]\nkind = \"final_length\"\n[[measure]]\nkind = \"mushroom_diameter\"\nmeasured = \"6 mm\"\n"
                 "[[measure]]\nname = \"low\"\nkind = \"diameter_at\"\nat = 0.2\n"
                 "[[measure]]\nname = \"high\"\nkind = \"diameter_at\"\nat = 0.8\n"
                 "[[measure]]\nkind = \"profile_error\"\nprofile = \"measured.csv\"\n");
  Simulation s = set_up(c);
  const Measures measures(c, s);
  deform(s, 0.9, 1.5);
  const std::vector<MeasuredValue> values = measures.read(s);
  constexpr double rounding = 1e-12;
  ASSERT_EQ(values.size(), 5u);
  EXPECT_NEAR(values[0].value, 0.9 * 12e-3, rounding);
  EXPECT_NEAR(values[1].value, 1.5 * 6.4e-3, rounding);
  EXPECT_NEAR(*values[1].deviation(), 0.6, rounding * 1e3);
  EXPECT_NEAR(values[2].value, 1.5 * 6.4e-3, rounding);
  EXPECT_NEAR(values[3].value, 6.4e-3, rounding);
  EXPECT_NEAR(values[4].value, 0.5 * 0.8 / 3.2, 1e-9);  // 4.8 mm instead of 4.0, and the rear as measured
}

TEST(Profile, OfAQuarterBarInThreeDimensionsIsThatOfTheBar) {
  const fs::path directory = scratch();
  const Case c = read_case(
      write_text(directory / "bar.toml",
                 "geometry = \"three_dimensional\"\ncell_size = \"0.5 mm\"\nend_time = \"1 us\"\n[[solid]]\nname = \"bar\"\n"
                 "shape = {intersection = [{cylinder = {start = [0, 0, 0], end = [0, \"6 mm\", 0], radius = \"3.2 mm\"}}, "
                 "{box = {lower = [0, 0, 0], upper = [\"4 mm\", \"6 mm\", \"4 mm\"]}}]}\n"
                 "temperature = \"298 K\"\nmaterial = \"copper_ofhc_johnson_cook.toml\"\n"
                 "[[boundary]]\nkind = \"symmetry\"\naxis = \"x\"\nposition = 0\nside = \"above\"\n"
                 "[[boundary]]\nkind = \"symmetry\"\naxis = \"z\"\nposition = 0\nside = \"above\"\n"));
  const Simulation s = set_up(c);
  const Profile profile = profile_of(s, s.bodies[0], Axis::y);
  EXPECT_NEAR(profile.length, 6e-3, 1e-12);
  ASSERT_EQ(profile.radius.size(), 12u);
  // Particles that the surface cuts tell how much of them is filled, not where: the mean around the axis is right to a small
  // part of their width.
  for (const double r : profile.radius) EXPECT_NEAR(r, 3.2e-3, 0.02 * 0.25e-3);
}

/// Gauges on a bar with a pressure that grows linearly with height.
TEST(Gauges, SeeALinearFieldWhereTheyAre) {
  const fs::path directory = scratch();
  const Case c = small_case(
      directory,
      "[[gauge]]\nname = \"fixed\"\nkind = \"point\"\nmoves = false\nfields = [\"temperature\"]\nfrom = [\"1.6 mm\", \"6 "
      "mm\"]\n"
      "[[gauge]]\nname = \"slab\"\nkind = \"plane\"\naxis = \"y\"\nmoves = false\nfields = [\"temperature\"]\nfrom = [0, \"4 "
      "mm\"]\n"
      "to = [\"4 mm\", \"5.6 mm\"]\n"
      "[[gauge]]\nname = \"top\"\nkind = \"surface\"\naxis = \"y\"\nside = \"below\"\nfields = [\"position\"]\nfrom = [0, 0]\n"
      "to = [\"4 mm\", \"12 mm\"]\n"
      "[[gauge]]\nname = \"nowhere\"\nkind = \"point\"\nmoves = false\nfields = [\"pressure\"]\nfrom = [0, \"50 mm\"]\n");
  Simulation s = set_up(c);
  const Gauges gauges(c, s);
  Particles& ps = s.bodies[0].particles;
  for (int p = 0; p < ps.size; ++p) ps.rest.at(Layout<2>::Rest::temperature, p) = 300.0 + 1e4 * ps.motion.at(1, p);
  const std::vector<double> row = gauges.read(s);
  std::vector<std::string> names;
  for (const HistoryColumn& column : gauges.columns()) names.push_back(column.name);
  EXPECT_EQ(names, (std::vector<std::string>{"gauge_fixed_temperature", "gauge_slab_temperature", "gauge_top_position_x",
                                             "gauge_top_position_y", "gauge_nowhere_pressure"}));
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(row[0], 360.0, rounding);
  EXPECT_NEAR(row[1], 348.0, rounding);
  EXPECT_NEAR(row[3], 0.0, 1e-15);
  EXPECT_TRUE(std::isnan(row[4]));
}

TEST(Gates, ARunThatExceedsOneStopsAndSaysWhich) {
  const fs::path directory = scratch();
  const Case c = small_case(directory, "[gates]\nfastest = \"150 m/s\"\n[output]\nfigures = false\n");
  Simulation s = set_up(c);
  prepare_directory(directory / "run", c, false);
  const RunResult result = run(c, s, {directory / "run", {}});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_NE(result.message.find("gate fastest"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("190"), std::string::npos) << result.message;
  EXPECT_NE(text_of(directory / "run" / "summary.json").find("\"ending\": \"failed\""), std::string::npos);
}

TEST(Gates, NumericalEnergyBeyondItsLimitStopsTheRunAfterACheckpoint) {
  const fs::path directory = scratch();
  const Case c = small_case(
      directory, "[gates]\nnumerical = 1e-6\n[output]\nfigures = false\ncheckpoint_steps = 1\nhistory_interval = \"0.2 us\"\n");
  Simulation s = set_up(c);
  prepare_directory(directory / "run", c, false);
  const RunResult result = run(c, s, {directory / "run", {}});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_NE(result.message.find("gate numerical"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("last checkpoint: " + (directory / "run").string()), std::string::npos) << result.message;
}

TEST(Run, ATimeStepBelowTheLeastOneStopsIt) {
  const fs::path directory = scratch();
  const Case c = small_case(directory, "[numerics]\nleast_step = \"0.5 us\"\n[output]\nfigures = false\n");
  Simulation s = set_up(c);
  prepare_directory(directory / "run", c, false);
  const RunResult result = run(c, s, {directory / "run", {}});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_NE(result.message.find("less than 5e-07 s"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("the speed of waves"), std::string::npos) << result.message;
}

TEST(Run, AStepThatCannotBeTakenNamesTheParticleAndLeavesTheLastGoodState) {
  const fs::path directory = scratch();
  const Case c = small_case(directory, "[output]\nfigures = false\n");
  Simulation s = set_up(c);
  constexpr int spoilt = 100;
  Particles& ps = s.bodies[0].particles;
  const std::string name = "particle " + std::to_string(ps.id[spoilt]) + " of bar at (";
  ps.load.at(Layout<2>::Load::stress, spoilt) = std::numeric_limits<double>::quiet_NaN();
  prepare_directory(directory / "run", c, false);
  const RunResult result = run(c, s, {directory / "run", {}});
  EXPECT_EQ(result.ending, Ending::failed);
  EXPECT_EQ(s.step, 0) << "a state that is not a number is never accepted";
  for (const char* fact : {"rejected 21 times", "|L| is inf", name.c_str(), "temperature 298", "plastic strain 0", "kg/m^3"})
    EXPECT_NE(result.message.find(fact), std::string::npos) << fact << " in " << result.message;
  EXPECT_TRUE(has_checkpoint(directory / "run"));
  EXPECT_NE(result.message.find("last checkpoint: "), std::string::npos) << result.message;
  EXPECT_TRUE(fs::exists(directory / "run" / "bar_particles_000000.hdf"));
}

TEST(StepSize, IsThePartOfACellThatAWaveTakes) {
  const fs::path directory = scratch();
  Simulation s = set_up(small_case(directory));
  NumericsConfig numerics;
  constexpr double later = 1.0;
  s.extremes = {5000.0, 5200.0, 200.0, 0.0};
  EXPECT_DOUBLE_EQ(next_step(s, numerics, later).dt, 0.5 * 0.8e-3 / 5200.0);
  numerics.stress_timing = StressTiming::usl;
  EXPECT_DOUBLE_EQ(next_step(s, numerics, later).dt, 0.3 * 0.8e-3 / 5200.0);
  numerics.courant = 0.2;
  EXPECT_DOUBLE_EQ(next_step(s, numerics, later).dt, 0.2 * 0.8e-3 / 5200.0);
  s.extremes.volume_rate = 1e8;
  EXPECT_DOUBLE_EQ(next_step(s, numerics, later).dt, 0.1 / 1e8);
  s.extremes = {50.0, 1.0, 6000.0, 0.0};
  EXPECT_DOUBLE_EQ(next_step(s, numerics, later).dt, 0.5 * 0.8e-3 / 6000.0);
  s.last_time_step = 1e-8;
  EXPECT_DOUBLE_EQ(next_step(s, numerics, later).dt, 1.1e-8);
  EXPECT_DOUBLE_EQ(next_step(s, numerics, 1e-9).dt, 1e-9);
  EXPECT_DOUBLE_EQ(next_step(s, numerics, 1.2e-8).dt, 0.6e-8);  // two equal steps instead of a long and a very short one
}

TEST(Summary, IsWellFormedAndTellsMeasuresByName) {
  const fs::path directory = scratch();
  const Case c =
      small_case(directory, "[[measure]]\nkind = \"final_length\"\nmeasured = \"10 mm\"\n[output]\nfigures = false\n");
  Simulation s = set_up(c);
  prepare_directory(directory / "run", c, false);
  run(c, s, {directory / "run", {}, 2});
  const std::string text = text_of(directory / "run" / "summary.json");
  EXPECT_NE(text.find("\"measures\": {\n    \"final_length\": 0.01"), std::string::npos) << text;
  EXPECT_NE(text.find("\"measured\": 0.01,\n      \"deviation\": 0."), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
}

}  // namespace
}  // namespace brisance::simulator
