// What a run writes: snapshots that ParaView reads, histories, summaries, measures.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

#include "models/input/csv.hpp"
#include "models/input/diagnostics.hpp"
#include "models/input/toml_tree.hpp"
#include "models/programs/files.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/output/checkpoint.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/figures.hpp"
#include "simulator/output/grid_snapshot.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/output/line_out.hpp"
#include "simulator/output/measures.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/output/snapshot.hpp"
#include "simulator/run.hpp"
#include "simulator/setup.hpp"
#include "simulator/step_size.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

Case small_case(const fs::path& directory, const std::string& more = "") {
  return read_case(write_text(directory / "bar.toml", small_bar(more)));
}

/// A run of the small bar, with more in its case, for so many steps.
struct SmallRun {
  Case c;
  fs::path directory;
  Simulation s;
  RunResult result;

  explicit SmallRun(const std::string& more, std::int64_t most_steps = std::numeric_limits<std::int64_t>::max(),
                    const std::function<void(Simulation&)>& spoil = {})
      : c(small_case(scratch(), more)), directory(c.file.parent_path() / "run"), s(set_up(c)) {
    if (spoil) spoil(s);
    prepare_directory(directory, c, false);
    result = run(c, s, {directory, {}, most_steps});
  }
};

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

/// What a reader says about a file, or nothing.
std::string complaint(const fs::path& path) {
  try {
    const Hdf5Reader reader(path);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Snapshot, OneThatWasCutOffAnywhereIsFoundOut) {
  const fs::path directory = scratch();
  write_snapshot(directory, set_up(small_case(directory)), {0.0});
  const fs::path whole = directory / "bar_particles_000000.hdf", part = directory / "part.hdf";
  EXPECT_EQ(complaint(whole), "");
  const std::uintmax_t size = fs::file_size(whole);
  for (const std::uintmax_t length : {std::uintmax_t{0}, std::uintmax_t{1}, std::uintmax_t{512}, size / 4, size / 2,
                                      3 * size / 4, size - 100, size - 34, size - 33, size - 2, size - 1}) {
    fs::copy_file(whole, part, fs::copy_options::overwrite_existing);
    fs::resize_file(part, length);
    EXPECT_NE(complaint(part).find("part.hdf: is damaged"), std::string::npos) << length << ": " << complaint(part);
  }
  EXPECT_NE(complaint(directory / "none.hdf").find("No such file"), std::string::npos) << complaint(directory / "none.hdf");
}

TEST(Snapshot, OneFlippedBitAnywhereIsFoundOut) {
  const fs::path directory = scratch();
  write_snapshot(directory, set_up(small_case(directory)), {0.0});
  const std::string bytes = text_of(directory / "bar_particles_000000.hdf");
  constexpr std::size_t places = 200;
  for (std::size_t i = 0; i < places; ++i) {
    std::string changed = bytes;
    char& byte = changed[i * (bytes.size() - 1) / (places - 1)];
    byte = static_cast<char>(byte ^ (1 << (i % 8)));
    std::ofstream(directory / "changed.hdf", std::ios::binary) << changed;
    ASSERT_NE(complaint(directory / "changed.hdf"), "") << i;
  }
}

TEST(Snapshot, AFullDiskIsReportedAndLeavesTheEarlierOneGood) {
  const fs::path directory = scratch();
  Simulation s = set_up(small_case(directory));
  write_snapshot(directory, s, {0.0});
  const fs::path file = directory / "bar_particles_000000.hdf";
  const std::string before = text_of(file);
  s.time = 1e-6;
  // The disk is full somewhere in the arrays, at the end of them, or only for the checksum.
  for (const std::uintmax_t bytes : {std::uintmax_t{1000}, std::uintmax_t{20000}, before.size() - 100, before.size() - 10}) {
    const std::string message = on_a_full_disk([&] { write_snapshot(directory, s, {1e-6}); }, bytes);
    EXPECT_NE(message.find("bar_particles_000000.hdf: cannot be written"), std::string::npos) << bytes << ": " << message;
    EXPECT_NE(message.find("File too large"), std::string::npos) << "the reason: " << message;
    EXPECT_TRUE(text_of(file) == before) << bytes;
  }
}

TEST(AText, ThatAFullDiskDoesNotTakeIsReportedWithTheReason) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const fs::path file = scratch() / "text";
  fs::create_symlink("/dev/full", file.string() + ".part");
  std::string message;
  try {
    replace_file_by_text(file, "rows");
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("text: cannot be written: No space left on device"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(file));
}

/// An image file read by the rules of VTK's file formats alone: every attribute must be there, and the packed arrays must
/// follow each other without a gap.
struct ReadImage {
  std::map<std::string, std::string> attributes;  // "ImageData.Spacing", "mass.NumberOfComponents"
  std::vector<std::string> point_fields, cell_fields;
  std::map<std::string, std::vector<double>> values;

  explicit ReadImage(const fs::path& path) {
    const std::string text = text_of(path), begin_of_data = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t data = text.find(begin_of_data) + begin_of_data.size();
    std::size_t end_of_arrays = data;
    bool cells = false;
    for (std::size_t at = text.find('<'); at < data; at = text.find('<', at + 1)) {
      std::istringstream element(text.substr(at + 1, text.find('>', at) - at - 1));
      std::string tag, name, value;
      element >> tag;
      std::map<std::string, std::string> of_element;
      while (std::getline(element >> std::ws, name, '=') && std::getline(element.ignore(), value, '"'))
        of_element[name] = value;
      const std::string owner = tag == "DataArray" ? of_element["Name"] : tag;
      for (const auto& [key, text_of_it] : of_element) attributes[owner + '.' + key] = text_of_it;
      cells = cells || tag == "CellData";
      if (of_element["format"] != "appended") continue;
      (cells ? cell_fields : point_fields).push_back(owner);
      EXPECT_EQ(data + std::stoul(of_element["offset"]), end_of_arrays) << owner;
      values[owner] = unpack(text, end_of_arrays);
    }
    EXPECT_EQ(text.substr(end_of_arrays, 28), "\n  </AppendedData>\n</VTKFile");
  }

 private:
  static std::vector<double> unpack(const std::string& text, std::size_t& at) {
    const auto number = [&] {
      std::uint64_t n = 0;
      std::memcpy(&n, text.data() + at, sizeof n);
      at += sizeof n;
      return n;
    };
    const std::uint64_t blocks = number(), size = number(), last = number();
    std::vector<std::uint64_t> lengths(blocks);
    for (std::uint64_t& length : lengths) length = number();
    std::vector<double> result;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      uLongf bytes = b + 1 == blocks && last > 0 ? last : size;
      const std::size_t before = result.size();
      result.resize(before + bytes / sizeof(double));
      const uLongf expected = bytes;
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(result.data() + before), &bytes,
                           reinterpret_cast<const Bytef*>(text.data() + at), lengths[b]),
                Z_OK);
      EXPECT_EQ(bytes, expected);
      at += lengths[b];
    }
    return result;
  }
};

std::vector<double> made_up(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = std::sin(static_cast<double>(i));
  return values;
}

TEST(GridSnapshot, HasWhatAVtkReaderAsksFor) {
  const fs::path file = scratch() / "image.vti";
  ImageData image{{0.5, 0.25, 0.0}, {0.1, 0.2, 0.4}, {-1, 2, 0}, {30, 17, 15}, {}, {}};  // 32 x 16 x 16 nodes
  constexpr std::size_t points = 32 * 16 * 16, cells = 31 * 15 * 15;
  ASSERT_EQ(image.points(), points);
  ASSERT_EQ(image.cells(), cells);
  // A block holds 8192 numbers: the points fill one to the end, their vectors three; the cells leave one unfilled.
  image.point_fields = {{"mass", 1, made_up(points)}, {"velocity", 3, made_up(3 * points)}};
  image.cell_fields = {{"pressure", 1, made_up(cells)}, {"flux", 3, made_up(3 * cells)}};
  write_image(file, image, 2.5e-6);
  require_seal(file);
  ReadImage read(file);
  EXPECT_EQ(read.attributes["VTKFile.type"], "ImageData");
  EXPECT_EQ(read.attributes["VTKFile.version"], "1.0");  // the first with UInt64 headers
  EXPECT_EQ(read.attributes["VTKFile.byte_order"], "LittleEndian");
  EXPECT_EQ(read.attributes["VTKFile.header_type"], "UInt64");
  EXPECT_EQ(read.attributes["VTKFile.compressor"], "vtkZLibDataCompressor");
  EXPECT_EQ(read.attributes["ImageData.WholeExtent"], "-1 30 2 17 0 15");
  EXPECT_EQ(read.attributes["Piece.Extent"], "-1 30 2 17 0 15");
  EXPECT_EQ(read.attributes["ImageData.Origin"], "0.5 0.25 0");
  EXPECT_EQ(read.attributes["ImageData.Spacing"], "0.1 0.2 0.4");
  EXPECT_EQ(read.point_fields, (std::vector<std::string>{"mass", "velocity"}));
  EXPECT_EQ(read.cell_fields, (std::vector<std::string>{"pressure", "flux"}));
  for (const auto* fields : {&image.point_fields, &image.cell_fields})
    for (const ImageField& field : *fields) {
      EXPECT_EQ(read.attributes[field.name + ".type"], "Float64");
      EXPECT_EQ(read.attributes[field.name + ".NumberOfComponents"], std::to_string(field.components));
      EXPECT_TRUE(read.values[field.name] == field.values) << field.name;
    }
  EXPECT_EQ(read.attributes["TimeValue.NumberOfTuples"], "1");
  EXPECT_NE(text_of(file).find("format=\"ascii\">2.5e-06</DataArray>\n    </FieldData>"), std::string::npos);
}

TEST(GridSnapshot, AFieldThatDoesNotFitTheBoxIsRefused) {
  const fs::path file = scratch() / "image.vti";
  ImageData image{{}, {1.0, 1.0, 1.0}, {0, 0, 0}, {2, 3, 0}, {{"mass", 1, made_up(12)}}, {{"pressure", 1, made_up(6)}}};
  EXPECT_NO_THROW(write_image(file, image, 0.0));
  image.cell_fields[0].values.push_back(0.0);
  EXPECT_THROW(write_image(file, image, 0.0), std::invalid_argument);
}

TEST(GridSnapshot, TheNodesHoldTheMassVelocityAndPlaceOfTheBar) {
  const fs::path directory = scratch();
  const Case c = small_case(directory);
  Simulation s = set_up(c);
  write_grid_snapshot(directory, solid_grid, solid_image(s), {0.0});
  ReadImage read(directory / "solid_grid_000000.vti");
  // 4 x 15 cells of 0.8 mm; splines reach half a cell beyond the particles, whose outermost ones are a quarter inside, and what
  // they add beyond the wall and the axis is folded back.
  EXPECT_EQ(read.attributes["ImageData.WholeExtent"], "0 5 0 16 0 0");
  EXPECT_EQ(read.attributes["ImageData.Spacing"], "0.0008 0.0008 0.0008");
  const double bar = c.bodies[0].material.material.density * std::numbers::pi * 3.2e-3 * 3.2e-3 * 12e-3;
  constexpr double rounding = 1e-12;
  double mass = 0.0;
  for (const double m : read.values["mass"]) mass += m;
  EXPECT_NEAR(mass / bar, 1.0, rounding);
  const std::vector<double>&velocity = read.values["velocity"], &force = read.values["force"];
  ASSERT_EQ(velocity.size(), 3 * 6 * 17u);
  for (std::size_t j = 0; j < 17; ++j)
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t n = i + 6 * j;
      EXPECT_NEAR(velocity[3 * n + 1], j == 0 ? 0.0 : -190.0, 190.0 * rounding) << i << ' ' << j;  // the wall holds its nodes
      for (const double none : {velocity[3 * n], velocity[3 * n + 2], force[3 * n], force[3 * n + 1], force[3 * n + 2]})
        EXPECT_EQ(none, 0.0);  // there is no stress yet
    }
}

TEST(GridSnapshot, TheNodesHaveTheMassCentreAndMomentumOfABodyInThreeDimensions) {
  const fs::path directory = scratch();
  const Case c = read_case(
      write_text(directory / "brick.toml",
                 "geometry = \"three_dimensional\"\ncell_size = \"1 mm\"\nend_time = \"1 us\"\n[[solid]]\nname = \"brick\"\n"
                 "shape = {box = {lower = [\"-7 mm\", \"1 mm\", \"20 mm\"], upper = [\"-3 mm\", \"8 mm\", \"22 mm\"]}}\n"
                 "temperature = \"298 K\"\nvelocity = [30, -20, 10]\nmaterial = \"copper_ofhc_johnson_cook.toml\"\n"));
  Simulation s = set_up(c);
  write_grid_snapshot(directory, solid_grid, solid_image(s), {0.0});
  ReadImage read(directory / "solid_grid_000000.vti");
  EXPECT_EQ(read.attributes["Piece.Extent"], "-8 -2 0 9 19 23");  // splines reach a node beyond the brick on every side
  const std::vector<double>&mass = read.values["mass"], &velocity = read.values["velocity"];
  ASSERT_EQ(mass.size(), 7u * 10u * 5u);
  double sum = 0.0;
  Vector moment{}, momentum{};
  for (std::size_t n = 0; n < mass.size(); ++n) {
    const std::size_t i = n % 7, j = n / 7 % 10, k = n / 70;
    const Vector x{1e-3 * (static_cast<double>(i) - 8.0), 1e-3 * static_cast<double>(j),
                   1e-3 * (static_cast<double>(k) + 19.0)};
    sum += mass[n], moment = moment + mass[n] * x;
    momentum = momentum + mass[n] * Vector{velocity[3 * n], velocity[3 * n + 1], velocity[3 * n + 2]};
  }
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(sum / (c.bodies[0].material.material.density * 56e-9), 1.0, rounding);
  const Vector centre{-5e-3, 4.5e-3, 21e-3}, speed{30.0, -20.0, 10.0};
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(moment[a] / sum / centre[a], 1.0, rounding);
    EXPECT_NEAR(momentum[a] / sum / speed[a], 1.0, rounding);
  }
}

TEST(GridSnapshot, TheCollectionListsEverySnapshotWithItsTime) {
  const fs::path directory = scratch();
  Simulation s = set_up(small_case(directory));
  write_grid_snapshot(directory, solid_grid, solid_image(s), {0.0, 2.5e-6});
  EXPECT_EQ(
      text_of(directory / "solid_grid.pvd"),
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n"
      "    <DataSet timestep=\"0\" part=\"0\" file=\"solid_grid_000000.vti\"/>\n"
      "    <DataSet timestep=\"2.5e-06\" part=\"0\" file=\"solid_grid_000001.vti\"/>\n"
      "  </Collection>\n</VTKFile>\n");
  EXPECT_TRUE(fs::exists(directory / "solid_grid_000001.vti"));
}

TEST(GridSnapshot, DamageAnywhereIsFoundOutAndAFullDiskLeavesTheEarlierOneGood) {
  const fs::path directory = scratch(), file = directory / "solid_grid_000000.vti", part = directory / "part.vti";
  Simulation s = set_up(small_case(directory));
  const ImageData image = solid_image(s);
  write_image(file, image, 0.0);
  const std::string bytes = text_of(file);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 50) {
    write_text(part, bytes.substr(0, length));
    EXPECT_THROW(require_seal(part), std::runtime_error) << length;
    std::string changed = bytes;
    changed[length] = static_cast<char>(changed[length] ^ 4);
    write_text(part, changed);
    EXPECT_THROW(require_seal(part), std::runtime_error) << length;
  }
  for (const std::size_t room : {std::size_t{100}, bytes.size() / 2, bytes.size() - 10}) {
    const std::string message = on_a_full_disk([&] { write_image(file, image, 1e-6); }, room);
    EXPECT_NE(message.find("solid_grid_000000.vti: cannot be written"), std::string::npos) << message;
    EXPECT_TRUE(text_of(file) == bytes) << room;
  }
}

TEST(GridSnapshot, ChangesNothingOfTheRunAndIsTheSameAfterARestart) {
  const fs::path directory = scratch();
  const std::string output = "[output]\nfigures = false\nsnapshot_interval = \"2 us\"\n";
  const Case without = small_case(directory, output), with = small_case(directory, output + "grid = true\n");
  for (const char* name : {"without", "whole", "parts"}) prepare_directory(directory / name, with, false);
  Simulation plain = set_up(without), whole = set_up(with), first = set_up(with), second = set_up(with);
  ASSERT_EQ(run(without, plain, {directory / "without", {}}).ending, Ending::done);
  ASSERT_EQ(run(with, whole, {directory / "whole", {}}).ending, Ending::done);
  EXPECT_TRUE(bits_of(plain) == bits_of(whole));
  EXPECT_FALSE(fs::exists(directory / "without" / "solid_grid.pvd"));
  ASSERT_EQ(run(with, first, {directory / "parts", {}, 30}).ending, Ending::interrupted);
  ASSERT_EQ(resume(with, second, {directory / "parts", {}}).ending, Ending::done);
  for (const char* name : {"solid_grid.pvd", "solid_grid_000000.vti", "solid_grid_000002.vti", "solid_grid_000004.vti"}) {
    ASSERT_TRUE(fs::exists(directory / "whole" / name)) << name;
    EXPECT_TRUE(text_of(directory / "parts" / name) == text_of(directory / "whole" / name)) << name;
  }
}

TEST(Report, TellsWhichSnapshotsAreDamagedOrMissing) {
  SmallRun r("[output]\nfigures = false\ngrid = true\nsnapshot_interval = \"2 us\"\n");
  ASSERT_EQ(r.result.ending, Ending::done);
  EXPECT_EQ(report(r.c, r.s, r.directory).message, "");
  fs::resize_file(r.directory / "bar_particles_000001.hdf", 5000);
  fs::remove(r.directory / "bar_particles_000002.hdf");
  fs::resize_file(r.directory / "solid_grid_000003.vti", 2000);
  const std::string message = report(r.c, r.s, r.directory).message;
  EXPECT_NE(message.find("bar_particles_000001.hdf: is damaged"), std::string::npos) << message;
  EXPECT_NE(message.find("bar_particles_000002.hdf: cannot be read"), std::string::npos) << message;
  EXPECT_NE(message.find("solid_grid_000003.vti: is damaged"), std::string::npos) << message;
  EXPECT_EQ(message.find("bar_particles_000003"), std::string::npos) << message;
}

TEST(History, TellsTheEnergiesOfTheWholeBarAndNotOfARadian) {
  const SmallRun r("[output]\nfigures = false\n", 5);
  ASSERT_EQ(r.result.ending, Ending::interrupted);
  const CsvFile history = CsvFile::load(r.directory / "history.csv");
  const double volume = std::numbers::pi * 3.2e-3 * 3.2e-3 * 12e-3, mass = r.c.bodies[0].material.material.density * volume;
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
      "[[gauge]]\nname = \"slab\"\nkind = \"plane\"\nmoves = false\nfields = [\"temperature\"]\nfrom = [0, \"4 "
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

std::string line_figure(const std::string& more) {
  return "[[figure]]\nname = \"a\"\nkind = \"line\"\n" + more;
}

TEST(LineOut, HoldsTheParticlesBesideTheLineInOrder) {
  const fs::path directory = scratch();
  const Case c = small_case(
      directory,
      line_figure("fields = [\"velocity\", \"temperature\"]\nfrom = [\"1.1 mm\", \"2 mm\"]\nto = [\"1.1 mm\", \"10 mm\"]\n"));
  Simulation s = set_up(c);
  Particles& ps = s.bodies[0].particles;
  for (int p = 0; p < ps.size; ++p) ps.motion.at(2, p) = 7.0, ps.motion.at(3, p) = 5e4 * ps.motion.at(1, p);
  const LineOut line = line_out(s, c.figures[0]);
  EXPECT_EQ(line.coordinate, "y");
  // Particles are 0.4 mm apart; half a cell about r = 1.1 mm holds the columns at 1.0 and 1.4 mm, and 2 to 10 mm 20 rows.
  ASSERT_EQ(line.place.size(), 40u);
  for (std::size_t i = 0; i < line.place.size(); ++i) {
    EXPECT_NEAR(line.place[i], 2.2e-3 + 0.4e-3 * static_cast<double>(i / 2), 1e-15);
    EXPECT_DOUBLE_EQ(line.values[0][i], 5e4 * line.place[i]);
    EXPECT_EQ(line.values[1][i], 298.0);
  }
}

TEST(LineOut, OfAnObliqueLineIsOverTheDistanceWithTheComponentAlongIt) {
  const fs::path directory = scratch();
  const Case c =
      small_case(directory, line_figure("fields = [\"velocity\"]\nfrom = [0, \"2 mm\"]\nto = [\"3 mm\", \"6 mm\"]\n"));
  Simulation s = set_up(c);
  Particles& ps = s.bodies[0].particles;
  for (int p = 0; p < ps.size; ++p) ps.motion.at(2, p) = 10.0, ps.motion.at(3, p) = 20.0;
  const LineOut line = line_out(s, c.figures[0]);
  EXPECT_EQ(line.coordinate, "distance");
  ASSERT_GT(line.place.size(), 10u);
  EXPECT_TRUE(std::is_sorted(line.place.begin(), line.place.end()));
  EXPECT_GE(line.place.front(), 0.0);
  EXPECT_LE(line.place.back(), 5e-3);
  for (const double v : line.values[0]) EXPECT_NEAR(v, 0.6 * 10.0 + 0.8 * 20.0, 1e-12);
}

TEST(LineOut, TheReferenceIsReadInItsUnitsAndMustHoldSomethingThatIsDrawn) {
  const fs::path directory = scratch();
  const std::string keys =
      "fields = [\"pressure\", \"velocity\"]\nfrom = [0, 0]\nto = [0, \"9 mm\"]\nreference = \"reference.csv\"\n";
  write_text(directory / "reference.csv", "y [mm],velocity [km/s]\n0,-0.19\n9,0.5\n");
  const LineOut reference = read_reference(small_case(directory, line_figure(keys)).figures[0]);
  EXPECT_DOUBLE_EQ(reference.place[1], 9e-3);
  EXPECT_TRUE(reference.values[0].empty());
  EXPECT_DOUBLE_EQ(reference.values[1][0], -190.0);
  for (const char* useless : {"x [mm],velocity [m/s]\n0,1\n", "y [mm],speed [m/s]\n0,1\n", "y [mm],velocity [GPa]\n0,1\n"}) {
    write_text(directory / "reference.csv", useless);
    EXPECT_THROW(small_case(directory, line_figure(keys)), InputError) << useless;
  }
}

TEST(Figures, AreDrawnAndTheCasesOwnAmongThem) {
  const SmallRun r(
      "[[measure]]\nkind = \"final_length\"\n" + line_figure("fields = [\"velocity\", \"stress_yy\"]\nfrom = [\"1 mm\", 0]\n"
                                                             "to = [\"1 mm\", \"12 mm\"]\n"),
      5);
  EXPECT_EQ(draw_figures(r.c, r.s, r.directory), std::vector<std::string>{});
  for (const char* name : {"energy.png", "field.png", "profile_bar.png", "line_a.png"})
    EXPECT_TRUE(text_of(r.directory / name).starts_with("\x89PNG")) << name;
}

TEST(Gates, ARunThatExceedsOneStopsAndSaysWhich) {
  const SmallRun r("[gates]\nfastest = \"150 m/s\"\n[output]\nfigures = false\n");
  EXPECT_EQ(r.result.ending, Ending::failed);
  EXPECT_NE(r.result.message.find("gate fastest"), std::string::npos) << r.result.message;
  EXPECT_NE(r.result.message.find("190"), std::string::npos) << r.result.message;
  EXPECT_NE(text_of(r.directory / "summary.json").find("\"ending\": \"failed\""), std::string::npos);
  const std::optional<ToldEnding> told = read_ending(r.directory / "summary.json");
  ASSERT_TRUE(told);
  EXPECT_EQ(told->ending, "failed");
  EXPECT_EQ(told->message, r.result.message);
  EXPECT_EQ(told->time, r.s.time);
  EXPECT_EQ(read_ending(SmallRun("[output]\nfigures = false\n", 2).directory / "summary.json")->ending, "interrupted");
  EXPECT_FALSE(read_ending(r.directory / "no summary"));
}

TEST(Gates, NumericalEnergyBeyondItsLimitStopsTheRunAfterACheckpoint) {
  const SmallRun r(
      "[gates]\nnumerical = 1e-6\n[output]\nfigures = false\ncheckpoint_steps = 1\nhistory_interval = \"0.2 us\"\n");
  EXPECT_EQ(r.result.ending, Ending::failed);
  EXPECT_NE(r.result.message.find("gate numerical"), std::string::npos) << r.result.message;
  EXPECT_NE(r.result.message.find("last checkpoint: " + r.directory.string()), std::string::npos) << r.result.message;
}

TEST(Run, ATimeStepBelowTheLeastOneStopsIt) {
  const SmallRun r("[numerics]\nleast_step = \"0.5 us\"\n[output]\nfigures = false\n");
  EXPECT_EQ(r.result.ending, Ending::failed);
  EXPECT_NE(r.result.message.find("less than 5e-07 s"), std::string::npos) << r.result.message;
  EXPECT_NE(r.result.message.find("the speed of waves"), std::string::npos) << r.result.message;
}

TEST(Run, AStepThatCannotBeTakenNamesTheParticleAndLeavesTheLastGoodState) {
  constexpr int spoilt = 100;
  std::string name;
  const SmallRun r("[output]\nfigures = false\n", 1000, [&](Simulation& s) {
    Particles& ps = s.bodies[0].particles;
    name = "particle " + std::to_string(ps.id[spoilt]) + " of bar at (";
    ps.load.at(Layout<2>::Load::stress, spoilt) = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_EQ(r.result.ending, Ending::failed);
  EXPECT_EQ(r.s.step, 0) << "a state that is not a number is never accepted";
  for (const char* fact :
       {"larger ones were rejected", "|L| is inf", name.c_str(), "temperature 298", "plastic strain 0", "kg/m^3"})
    EXPECT_NE(r.result.message.find(fact), std::string::npos) << fact << " in " << r.result.message;
  EXPECT_TRUE(has_checkpoint(r.directory));
  EXPECT_NE(r.result.message.find("last checkpoint: "), std::string::npos) << r.result.message;
  EXPECT_TRUE(fs::exists(r.directory / "bar_particles_000000.hdf"));
}

/// What fails within a step, before the first checkpoint, leaves a state to look at; it is none to go on from.
TEST(Run, AFailureOfAnyKindLeavesAStateToLookAtAndSaysWhere) {
  const SmallRun within("[output]\nfigures = false\n", 1000, [&](Simulation& s) {
    s.bodies[0].particles.rest.at(Layout<2>::Rest::temperature, 100) = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_EQ(within.result.ending, Ending::failed);
  EXPECT_NE(within.result.message.find("64 parts"), std::string::npos) << within.result.message;
  EXPECT_NE(within.result.message.find("is in snapshot 000000 of " + within.directory.string()), std::string::npos)
      << within.result.message;
  EXPECT_TRUE(fs::exists(within.directory / "bar_particles_000000.hdf"));
  EXPECT_FALSE(has_checkpoint(within.directory));
  EXPECT_NE(text_of(within.directory / "log.txt").find("64 parts"), std::string::npos);

  const SmallRun between("[gates]\nfastest = \"150 m/s\"\n[output]\nfigures = false\n");
  EXPECT_TRUE(fs::exists(between.directory / "bar_particles_000000.hdf")) << between.result.message;
  EXPECT_TRUE(has_checkpoint(between.directory)) << "the state between two steps is whole";
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
  const SmallRun r("[[measure]]\nkind = \"final_length\"\nmeasured = \"10 mm\"\n[output]\nfigures = false\n", 2);
  const std::string text = text_of(r.directory / "summary.json");
  EXPECT_NE(text.find("\"measures\": {\n    \"final_length\": 0.01"), std::string::npos) << text;
  EXPECT_NE(text.find("\"measured\": 0.01,\n      \"deviation\": 0."), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
}

TEST(Summary, CountsTheParticlesThatHaveFailed) {
  const std::string no_figures = "[output]\nfigures = false\n";
  const auto told = [&](const std::function<void(Simulation&)>& spoil) {
    const SmallRun r(no_figures, 1, spoil);
    return in_words(r.result.summary) + text_of(r.directory / "summary.json");
  };
  EXPECT_FALSE(contains(told({}), "failed"));
  const std::string broken = told([](Simulation& s) {
    for (const int p : {3, 100, 239}) s.bodies[0].particles.rest.at(Layout<2>::Rest::failure_cause, p) = 1.0;
  });
  EXPECT_TRUE(contains(broken, "\n  failed: 3 of 240 particles of bar\n")) << broken;
  EXPECT_TRUE(contains(broken, "\"failed_particles\": {\n    \"bar\": 3\n  }")) << broken;
}

}  // namespace
}  // namespace brisance::simulator
