#include "simulator/output/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "models/programs/files.hpp"

namespace brisance::simulator {
namespace {

/// The library's own words are switched off: the system knows better why a disk takes no more.
[[noreturn]] void fail(std::string_view what) {
  throw std::runtime_error(fmt::format("HDF5: {} failed{}", what, errno ? ": " + std::generic_category().message(errno) : ""));
}

/// Owns an HDF5 identifier and closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close_it)(hid_t), std::string_view what) : id_(id), close_(close_it) {
    if (id < 0) fail(what);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closing writes what the library has kept; it may fail.
  void close(std::string_view what) {
    if (close_(std::exchange(id_, -1)) < 0) fail(what);
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, std::string_view what) {
  if (status < 0) fail(what);
}

/// The library prints its own error stack unless told not to; errors are raised by `require` and Handle. Files are closed by
/// their handles: at the end of the program the library would only try again to write to a disk that was full, and crash.
void silence() {
  static const herr_t no_cleanup_at_exit = H5dont_atexit();
  (void)no_cleanup_at_exit;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  errno = 0;  // of what went wrong before
}

template <class T>
hid_t native() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

template <class T>
void write_array(hid_t file, Packing packing, const std::string& name, std::span<const T> values, int columns) {
  hsize_t size[2] = {values.size() / static_cast<std::size_t>(std::max(1, columns)), static_cast<hsize_t>(columns)};
  const int rank = columns > 0 ? 2 : 1;
  const Handle space(H5Screate_simple(rank, size, nullptr), H5Sclose, "making a dataspace");
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "making dataset properties");
  require(H5Pset_obj_track_times(properties, false), "leaving out times");  // the same data give the same file
  constexpr hsize_t chunk_rows = 16384, least = 1024;
  if (packing == Packing::deflate && size[0] >= least) {
    hsize_t chunk[2] = {std::min(size[0], chunk_rows), size[1]};
    require(H5Pset_chunk(properties, rank, chunk), "setting chunks");
    require(H5Pset_shuffle(properties), "setting the shuffle filter");
    require(H5Pset_deflate(properties, 1), "setting the deflate filter");
  }
  Handle data(H5Dcreate2(file, name.c_str(), native<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
              "creating " + name);
  if (!values.empty()) require(H5Dwrite(data, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "writing " + name);
  data.close("closing " + name);
}

template <class T>
std::vector<T> read_array(hid_t file, const std::string& name) {
  const Handle data(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "opening " + name);
  const Handle space(H5Dget_space(data), H5Sclose, "reading the size of " + name);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (!values.empty()) require(H5Dread(data, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading " + name);
  return values;
}

void write_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type, hid_t space,
                     const void* values) {
  const Handle owner(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose, "opening " + object);
  Handle attribute(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                   "creating attribute " + name);
  require(H5Awrite(attribute, type, values), "writing attribute " + name);
  attribute.close("closing attribute " + name);
}

}  // namespace

struct Hdf5Writer::File {
  std::filesystem::path path;
  Handle id;
  Packing packing;
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, Packing packing) {
  silence();
  file_.reset(new File{
      path, Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "creating the file"), packing});
}
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::group(const std::string& name) {
  Handle(H5Gcreate2(file_->id, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "creating group " + name);
}
void Hdf5Writer::array(const std::string& name, std::span<const double> values, int columns) {
  write_array(file_->id, file_->packing, name, values, columns);
}
void Hdf5Writer::array(const std::string& name, std::span<const std::int64_t> values) {
  write_array(file_->id, file_->packing, name, values, 0);
}
void Hdf5Writer::array(const std::string& name, std::span<const std::uint64_t> values) {
  write_array(file_->id, file_->packing, name, values, 0);
}
void Hdf5Writer::array(const std::string& name, std::span<const std::uint32_t> values) {
  write_array(file_->id, file_->packing, name, values, 0);
}
void Hdf5Writer::array(const std::string& name, std::span<const std::uint8_t> values) {
  write_array(file_->id, file_->packing, name, values, 0);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::string_view text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "making a text type");
  require(H5Tset_size(type, std::max<std::size_t>(1, text.size())), "sizing a text type");
  require(H5Tset_strpad(type, H5T_STR_NULLPAD), "padding a text type");
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "making a scalar space");
  write_attribute(file_->id, object, name, type, scalar, text.empty() ? "\0" : text.data());
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "making a dataspace");
  write_attribute(file_->id, object, name, H5T_NATIVE_INT64, space, values.data());
}
void Hdf5Writer::finish() {
  require(H5Fflush(file_->id, H5F_SCOPE_GLOBAL), "writing the file");
  file_->id.close("closing the file");
  seal_file(file_->path);
}

struct Hdf5Reader::File {
  Handle id;
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) {
  require_seal(path);
  silence();
  file_.reset(new File{Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening " + path.string())});
}
Hdf5Reader::~Hdf5Reader() = default;

bool Hdf5Reader::has(const std::string& name) const {
  return H5Lexists(file_->id, name.c_str(), H5P_DEFAULT) > 0;
}
std::vector<std::uint64_t> Hdf5Reader::shape(const std::string& name) const {
  const Handle data(H5Dopen2(file_->id, name.c_str(), H5P_DEFAULT), H5Dclose, "opening " + name);
  const Handle space(H5Dget_space(data), H5Sclose, "reading the size of " + name);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  require(H5Sget_simple_extent_dims(space, sizes.data(), nullptr), "reading the size of " + name);
  return {sizes.begin(), sizes.end()};
}
std::vector<double> Hdf5Reader::doubles(const std::string& name) const {
  return read_array<double>(file_->id, name);
}
std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name) const {
  return read_array<std::int64_t>(file_->id, name);
}
std::vector<std::uint64_t> Hdf5Reader::unsigned_integers(const std::string& name) const {
  return read_array<std::uint64_t>(file_->id, name);
}
std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute(H5Aopen_by_name(file_->id, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "opening attribute " + name);
  const Handle type(H5Aget_type(attribute), H5Tclose, "reading the type of " + name);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw std::runtime_error(fmt::format("HDF5: attribute {} is no text of fixed length", name));
  std::string text(H5Tget_size(type), '\0');
  require(H5Aread(attribute, type, text.data()), "reading attribute " + name);
  return text.substr(0, text.find('\0'));
}
std::vector<std::int64_t> Hdf5Reader::integers_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute(H5Aopen_by_name(file_->id, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "opening attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "reading the size of " + name);
  std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  require(H5Aread(attribute, H5T_NATIVE_INT64, values.data()), "reading attribute " + name);
  return values;
}

std::string hdf5_version() {
  return H5_VERS_INFO;
}

}  // namespace brisance::simulator
