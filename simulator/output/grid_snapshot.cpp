#include "simulator/output/grid_snapshot.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "models/programs/files.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/solid/motion.hpp"
#include "simulator/solid/nodes.hpp"
#include "simulator/solid/transfer.hpp"

namespace brisance::simulator {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// An array as VTK's zlib compressor stores it: number of blocks, size of a block, size of the last one if it is not full,
/// packed size of each block; then the blocks.
std::string packed(const std::vector<double>& values) {
  constexpr std::size_t block = 1 << 16;
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  const std::size_t size = values.size() * sizeof(double);
  std::vector<std::uint64_t> header{(size + block - 1) / block, block, size % block};
  std::string blocks;
  std::vector<unsigned char> buffer(compressBound(block));
  for (std::size_t at = 0; at < size; at += block) {
    uLongf length = buffer.size();
    if (compress2(buffer.data(), &length, bytes + at, std::min(block, size - at), Z_BEST_SPEED) != Z_OK)
      throw std::runtime_error("zlib: packing failed");
    header.push_back(length);
    blocks.append(reinterpret_cast<const char*>(buffer.data()), length);
  }
  return std::string(reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t)) + blocks;
}

/// The elements of one group of fields; their numbers go to `appended`.
std::string arrays(const std::vector<ImageField>& fields, std::size_t places, std::string& appended) {
  std::string text;
  for (const ImageField& field : fields) {
    if (field.values.size() != places * static_cast<std::size_t>(field.components))
      throw std::invalid_argument(fmt::format("field {}: {} numbers for {} places with {} components each", field.name,
                                              field.values.size(), places, field.components));
    text += fmt::format(
        "        <DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        field.name, field.components, appended.size());
    appended += packed(field.values);
  }
  return text;
}

std::string file_text(const ImageData& image, double time) {
  const auto &lower = image.lower, &upper = image.upper;
  const std::string extent = fmt::format("{} {} {} {} {} {}", lower[0], upper[0], lower[1], upper[1], lower[2], upper[2]);
  const auto numbers = [](const Vector& v) { return fmt::format("{} {} {}", v[0], v[1], v[2]); };
  std::string appended;
  const std::string points = arrays(image.point_fields, image.points(), appended),
                    cells = arrays(image.cell_fields, image.cells(), appended);
  return fmt::format(
             "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
             "compressor=\"vtkZLibDataCompressor\">\n"
             "  <ImageData WholeExtent=\"{0}\" Origin=\"{1}\" Spacing=\"{2}\">\n"
             "    <FieldData>\n"
             "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{3}</DataArray>\n"
             "    </FieldData>\n"
             "    <Piece Extent=\"{0}\">\n"
             "      <PointData>\n{4}      </PointData>\n"
             "      <CellData>\n{5}      </CellData>\n"
             "    </Piece>\n"
             "  </ImageData>\n"
             "  <AppendedData encoding=\"raw\">\n_",
             extent, numbers(image.origin), numbers(image.spacing), time, points, cells) +
         appended + "\n  </AppendedData>\n</VTKFile>";
}

/// Calls f(block's number, node's number in the block, its index in the grid) for every node of this rank.
template <class F>
void for_each_node(const Grid& grid, F&& f) {
  const int side = grid.dimensions == 3 ? Block<3>::side : Block<2>::side;
  for (const std::int32_t b : grid.my_blocks) {
    const BlockPosition block = block_position(grid.blocks[static_cast<std::size_t>(b)]);
    for (int n = 0; n < 64; ++n) {
      std::array<int, 3> index{side * block[0] + n % side, side * block[1] + n / side % side, 0};
      if (grid.dimensions == 3) index[2] = side * block[2] + n / (side * side);
      f(static_cast<std::size_t>(b), n, index);
    }
  }
}

}  // namespace

std::size_t ImageData::points() const {
  return point(upper) + 1;
}
std::size_t ImageData::cells() const {
  std::size_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) count *= static_cast<std::size_t>(std::max(1, upper[a] - lower[a]));
  return count;
}
std::size_t ImageData::point(const std::array<int, 3>& index) const {
  std::size_t place = 0;
  for (std::size_t a = 3; a-- > 0;)
    place = place * static_cast<std::size_t>(upper[a] - lower[a] + 1) + static_cast<std::size_t>(index[a] - lower[a]);
  return place;
}

void write_image(const std::filesystem::path& path, const ImageData& image, double time) {
  const std::string text = file_text(image, time);
  replace_file(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream out(temporary, std::ios::binary);
    if (!(out << text << std::flush)) throw std::system_error(errno, std::generic_category());
    out.close();
    seal_file(temporary);
  });
}

std::string grid_snapshot_name(const std::string& name, std::size_t number) {
  return fmt::format("{}_{:06}.vti", name, number);
}

void write_grid_snapshot(const std::filesystem::path& directory, const std::string& name, const ImageData& image,
                         const std::vector<double>& times) {
  write_image(directory / grid_snapshot_name(name, times.size() - 1), image, times.back());
  std::string list =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t i = 0; i < times.size(); ++i)
    list += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[i], grid_snapshot_name(name, i));
  replace_file_by_text(directory / (name + ".pvd"), list + "  </Collection>\n</VTKFile>\n");
}

ImageData solid_image(Simulation& s) {
  activate_blocks(s);
  particles_to_grid(s, Carry::motion_and_force, 0.0);
  gather_tiles(s.grid, *s.domain);
  sum_tiles(s.grid);
  velocities_from_momentum(s, Touch::in_sums, s.time - 0.5 * s.last_time_step);

  const Grid& grid = s.grid;
  const double h = grid.cell_size;
  ImageData image{grid.origin, {h, h, h}, {}, {}, {}, {}};
  constexpr int none = std::numeric_limits<int>::max();
  image.lower.fill(none), image.upper.fill(-none);
  const auto mass = [&](std::size_t block, int field, int node) {
    return grid.block_motion(block, field)[node][Channel::mass];
  };
  for_each_node(grid, [&](std::size_t block, int node, const std::array<int, 3>& index) {
    for (int field = 0; field < grid.fields; ++field)
      for (std::size_t a = 0; a < 3 && mass(block, field, node) > 0.0; ++a)
        image.lower[a] = std::min(image.lower[a], index[a]), image.upper[a] = std::max(image.upper[a], index[a]);
  });
  if (image.lower[0] == none) image.lower.fill(0), image.upper.fill(0);  // all has left
  constexpr double most_points = 1e8;
  double points = 1.0;
  for (std::size_t a = 0; a < 3; ++a) points *= 1.0 + image.upper[a] - image.lower[a];
  if (points > most_points)
    throw std::runtime_error(
        fmt::format("output.grid: the box around the bodies has {:.3g} nodes; {:.3g} at most are written; set it to false",
                    points, most_points));

  const double whole = whole_of(s.geometry);
  for (int field = 0; field < grid.fields; ++field) {
    const std::string suffix = grid.fields > 1 ? fmt::format("_{}", field) : "";
    ImageField masses{"mass" + suffix, 1, std::vector<double>(image.points())},
        velocities{"velocity" + suffix, 3, std::vector<double>(3 * image.points())},
        forces{"force" + suffix, 3, std::vector<double>(3 * image.points())};
    for_each_node(grid, [&](std::size_t block, int node, const std::array<int, 3>& index) {
      if (!(mass(block, field, node) > 0.0)) return;
      const std::size_t place = image.point(index);
      const Lanes &sums = s.grid.block_sums(block, field)[node], &motion = grid.block_motion(block, field)[node];
      masses.values[place] = whole * motion[Channel::mass];
      for (int a = 0; a < grid.dimensions; ++a) {
        velocities.values[3 * place + static_cast<std::size_t>(a)] = motion[Channel::velocity + a];
        forces.values[3 * place + static_cast<std::size_t>(a)] = whole * sums[Channel::force + a];
      }
    });
    for (ImageField* f : {&masses, &velocities, &forces}) image.point_fields.push_back(std::move(*f));
  }
  return image;
}

ImageData gas_image(const Simulation& s) {
  const gas::Cells& cells = s.gas.cells;
  ImageData image;
  image.spacing = {cells.cell_size, cells.cell_size, cells.cell_size};
  std::array<std::size_t, 3> count{1, 1, 1};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cells.dimensions); ++a) {
    image.lower[a] = cells.lower[a], image.upper[a] = cells.upper[a];
    count[a] = static_cast<std::size_t>(cells.upper[a] - cells.lower[a]);
  }
  for (const gas::Field& field : gas::fields_of(s.gas)) {
    const std::size_t components = field.components > 1 ? 3 : 1;  // a vector has three for ParaView
    ImageField out{field.name, static_cast<int>(components), std::vector<double>(components * image.cells(), 0.0)};
    gas::for_each_cell(s.gas, [&](const gas::CellPlace& at) {
      std::array<int, 3> i = cells.index(at.block, at.cell);
      std::size_t number = 0;
      for (std::size_t a = 3; a-- > 0;) number = number * count[a] + static_cast<std::size_t>(i[a] - image.lower[a]);
      for (int a = 0; a < field.components; ++a)
        out.values[components * number + static_cast<std::size_t>(a)] = field.read(s.gas, at, a);
    });
    image.cell_fields.push_back(std::move(out));
  }
  return image;
}

}  // namespace brisance::simulator
