#pragma once
// HDF5 files: arrays, attributes and groups. The only user of the HDF5 library in the simulator.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brisance::simulator {

/// Whether a file is small or quick to write.
enum class Packing { none, deflate };

class Hdf5Writer {
 public:
  /// Makes a new file in place of any of this name. Everything throws std::runtime_error when it fails.
  explicit Hdf5Writer(const std::filesystem::path& path, Packing packing = Packing::none);
  ~Hdf5Writer();

  /// Groups and arrays are named by their path, "VTKHDF/PointData/velocity"; groups on the way must exist.
  void group(const std::string& name);
  /// An array of rows of `columns` numbers: one-dimensional if that is 0.
  void array(const std::string& name, std::span<const double> values, int columns = 0);
  void array(const std::string& name, std::span<const std::int64_t> values);
  void array(const std::string& name, std::span<const std::uint64_t> values);
  void array(const std::string& name, std::span<const std::uint32_t> values);
  void array(const std::string& name, std::span<const std::uint8_t> values);
  /// A text of fixed length, without a terminating zero.
  void attribute(const std::string& object, const std::string& name, std::string_view text);
  void attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values);
  /// Writes what is left in memory, and seals the file: without it no reader takes it for whole.
  void finish();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class Hdf5Reader {
 public:
  /// Opens a file that an Hdf5Writer has finished. Throws std::runtime_error if it was cut off or changed since: the library
  /// itself notices only some damage, and may crash on the rest.
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();

  bool has(const std::string& name) const;
  /// Sizes of an array along each direction.
  std::vector<std::uint64_t> shape(const std::string& name) const;
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::vector<std::uint64_t> unsigned_integers(const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::int64_t> integers_attribute(const std::string& object, const std::string& name) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

std::string hdf5_version();

}  // namespace brisance::simulator
