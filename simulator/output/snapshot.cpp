#include "simulator/output/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>

#include "models/programs/files.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/grid_snapshot.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/output/json.hpp"

namespace brisance::simulator {
namespace {

/// A body's name as part of a file's.
std::string file_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; }, '_');
  return name;
}

/// In the order of the bins: where a particle stands in memory depends on when a run was resumed.
/// ParaView 5.11 wants the attribute Type as a text of fixed length, and the ending .hdf.
void write(const std::filesystem::path& path, const Simulation& s, const Body& body) {
  const Particles& ps = body.particles;
  const std::vector<std::uint32_t>& order = body.bins.order;
  const std::size_t count = order.size();
  Hdf5Writer file(path, Packing::deflate);
  file.group("VTKHDF");
  file.attribute("VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  file.attribute("VTKHDF", "Type", "UnstructuredGrid");
  const std::array<std::int64_t, 1> number{ps.size};
  file.array("VTKHDF/NumberOfPoints", number);
  file.array("VTKHDF/NumberOfCells", number);
  file.array("VTKHDF/NumberOfConnectivityIds", number);
  std::vector<std::int64_t> numbers(count + 1);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.array("VTKHDF/Offsets", std::span<const std::int64_t>(numbers));
  file.array("VTKHDF/Connectivity", std::span<const std::int64_t>(numbers).first(count));
  constexpr std::uint8_t vertex = 1;
  const std::vector<std::uint8_t> types(count, vertex);
  file.array("VTKHDF/Types", std::span<const std::uint8_t>(types));
  file.group("VTKHDF/PointData");
  for (const Field& field : all_fields()) {
    const auto components = static_cast<std::size_t>(field.components);
    std::vector<double> values(components * count);
    for (std::size_t i = 0; i < count; ++i)
      field.read(ParticleView(ps, static_cast<int>(order[i])), values.data() + components * i);
    const std::string name = field.name == "position" ? "VTKHDF/Points" : "VTKHDF/PointData/" + std::string(field.name);
    file.array(name, values, field.components == 1 ? 0 : field.components);
  }
  std::vector<std::uint64_t> ids;
  for (const std::uint32_t p : order) ids.push_back(ps.id[p]);
  file.array("VTKHDF/PointData/id", std::span<const std::uint64_t>(ids));
  file.group("run");
  file.array("run/time", std::array<double, 1>{s.time});
  file.array("run/step", std::array<std::int64_t, 1>{s.step});
  file.finish();
}

}  // namespace

std::string snapshot_name(const std::string& body, std::size_t number) {
  return fmt::format("{}_particles_{:06}.hdf", file_name(body), number);
}
std::string series_name(const std::string& body) {
  return file_name(body) + "_particles.hdf.series";
}

void write_snapshot(const std::filesystem::path& directory, const Simulation& s, const std::vector<double>& times) {
  for (const Body& body : s.bodies) {
    replace_file(directory / snapshot_name(body.name, times.size() - 1),
                 [&](const std::filesystem::path& temporary) { write(temporary, s, body); });
    Json files = Json::list();
    for (std::size_t i = 0; i < times.size(); ++i)
      files.append(Json::object().set("name", snapshot_name(body.name, i)).set("time", times[i]));
    replace_file_by_text(directory / series_name(body.name),
                         Json::object().set("file-series-version", "1.0").set("files", files).text());
  }
}

std::vector<std::string> damaged_snapshots(const std::filesystem::path& directory, const Case& c, std::size_t count) {
  std::vector<std::string> names, troubles;
  for (std::size_t i = 0; i < count; ++i) {
    for (const BodyConfig& body : c.bodies) names.push_back(snapshot_name(body.name, i));
    if (c.gas) names.push_back(grid_snapshot_name(gas_grid, i));
    if (c.output.grid && !c.bodies.empty()) names.push_back(grid_snapshot_name(solid_grid, i));
  }
  for (const std::string& name : names) try {
      require_seal(directory / name);
    } catch (const std::exception& error) {
      troubles.push_back(error.what());
    }
  return troubles;
}

}  // namespace brisance::simulator
