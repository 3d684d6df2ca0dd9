#pragma once
// The history of a point: a table of named columns with units, kept in memory and written to CSV or HDF5 when a run ends.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "driver/point.hpp"
#include "models/programs/files.hpp"

namespace brisance::driver {

/// What a column of the history is computed from.
struct Sample {
  const Point<double>& point;
  double time = 0.0;                // s
  double segment = 0.0;             // number of the segment, from 1
  double accumulated_strain = 0.0;  // integral of sqrt(2/3 D':D') dt
};

/// A column: `name [unit]` in the header of a file.
struct Column {
  std::string name;
  std::string unit;
  std::function<double(const Sample&)> value;
};

/// Every quantity known about a point of this material; the vocabulary of histories, `until` and figures.
std::vector<Column> columns_of(const Material& material);

/// A table of numbers, stored by column.
struct Record {
  struct Series {
    std::string name;
    std::string unit;
    std::vector<double> values;
  };
  std::vector<Series> series;

  std::size_t rows() const { return series.empty() ? 0 : series.front().values.size(); }
  /// The column of this name; nullptr if there is none.
  const Series* find(std::string_view name) const;
};

/// Which steps of a run are kept. `every` = n keeps every n-th step; 0 keeps about `rows` rows, evenly spaced in steps. The
/// first and last step of every segment are always kept.
struct OutputDensity {
  int every = 0;
  int rows = 1000;
};

/// Collects the samples of a run.
class History {
 public:
  explicit History(const Material& material, OutputDensity density = {});

  void record(const Sample& sample, bool keep_always);
  const std::vector<Column>& columns() const { return columns_; }
  const Record& record() const { return record_; }

 private:
  void drop_every_other();

  std::vector<Column> columns_;
  OutputDensity density_;
  Record record_;
  std::vector<bool> kept_always_;
  long step_ = 0;
  long stride_ = 1;
};

/// Writes a table to PATH, whose ending chooses the format: .csv, .h5 or .hdf5. The file appears complete or not at all.
void write(const Record& table, const std::filesystem::path& path);
void write_csv(const Record& table, const std::filesystem::path& path);

}  // namespace brisance::driver
