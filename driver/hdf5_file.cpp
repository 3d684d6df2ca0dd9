#include "driver/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <stdexcept>

namespace brisance::driver {
namespace {

/// Owns an HDF5 identifier and closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), std::string_view what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error(fmt::format("HDF5: {} failed", what));
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_(id_); }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, std::string_view what) {
  if (status < 0) throw std::runtime_error(fmt::format("HDF5: {} failed", what));
}

/// The library prints its own error stack unless told not to; errors are raised by `require` and Handle.
void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

void write_text_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "making a text type");
  require(H5Tset_size(type, text.size() + 1), "sizing a text type");
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "making a scalar space");
  const Handle attribute(H5Acreate2(object, name.c_str(), type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "creating attribute " + name);
  require(H5Awrite(attribute, type, text.c_str()), "writing attribute " + name);
}

void write_number_attribute(hid_t object, const std::string& name, double number) {
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "making a scalar space");
  const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_DOUBLE, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "creating attribute " + name);
  require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &number), "writing attribute " + name);
}

void write_columns(hid_t group, const Record& record) {
  for (const Record::Series& column : record.series) {
    const hsize_t rows = column.values.size();
    const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, "making a dataspace");
    const Handle data(H5Dcreate2(group, column.name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                      H5Dclose, "creating dataset " + column.name);
    require(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()), "writing " + column.name);
    write_text_attribute(data, "unit", column.unit);
  }
}

/// Links keep the order of creation, so that a reader finds the columns in the order of the CSV file.
template <class Write>
void write_file(const std::filesystem::path& path, Write&& write_to) {
  silence();
  const Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "making file properties");
  require(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "asking for link order");
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties, H5P_DEFAULT), H5Fclose, "creating the file");
  write_to(file);
}

}  // namespace

void write_hdf5(const Record& record, const std::filesystem::path& path) {
  write_file(path, [&](hid_t file) { write_columns(file, record); });
}

void write_hdf5(std::span<const SweepMember> members, const std::filesystem::path& path) {
  write_file(path, [&](hid_t file) {
    const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "making group properties");
    require(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "asking for link order");
    for (std::size_t m = 0; m < members.size(); ++m) {
      const std::string name = fmt::format("member_{:03}", m + 1);
      const Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose,
                         "creating group " + name);
      for (const SweptValue& v : members[m].values) {
        if (v.number)
          write_number_attribute(group, v.column(), *v.number);
        else
          write_text_attribute(group, v.column(), v.text);
      }
      write_columns(group, members[m].record);
    }
  });
}

double read_hdf5_value(const std::filesystem::path& path, const std::string& group, const std::string& name) {
  silence();
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening " + path.string());
  const Handle object(H5Oopen(file, group.c_str(), H5P_DEFAULT), H5Oclose, "opening " + group);
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "opening attribute " + name);
  double number = 0.0;
  require(H5Aread(attribute, H5T_NATIVE_DOUBLE, &number), "reading attribute " + name);
  return number;
}

Record read_hdf5(const std::filesystem::path& path, const std::string& group) {
  silence();
  const Handle whole(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening " + path.string());
  const Handle file(H5Oopen(whole, group.c_str(), H5P_DEFAULT), H5Oclose, "opening " + group);
  std::vector<std::string> names;
  require(H5Literate(file, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, collect_name, &names), "listing the datasets");
  Record record;
  for (const std::string& name : names) {
    const Handle data(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "opening " + name);
    const Handle space(H5Dget_space(data), H5Sclose, "reading the size of " + name);
    Record::Series column{name, "", std::vector<double>(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)))};
    require(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()), "reading " + name);
    const Handle unit(H5Aopen(data, "unit", H5P_DEFAULT), H5Aclose, "opening the unit of " + name);
    const Handle type(H5Aget_type(unit), H5Tclose, "reading the type of a unit");
    column.unit.resize(H5Tget_size(type));
    require(H5Aread(unit, type, column.unit.data()), "reading the unit of " + name);
    column.unit.resize(column.unit.find('\0'));
    record.series.push_back(std::move(column));
  }
  return record;
}

}  // namespace brisance::driver
