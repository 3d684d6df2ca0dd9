#pragma once
// Tables of measurements: comments begun by #, one line of column names with units, then rows.
//
//   # Aluminium melting temperature against pressure: Boehler & Ross 1997
//   pressure [GPa],temperature [K]
//   0.024895,934.807

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/input/diagnostics.hpp"
#include "models/parameters.hpp"

namespace brisance {

/// A CSV file as text; columns are checked and converted when they are asked for.
class CsvFile {
 public:
  /// Throws InputError if the file cannot be read, has no header, or has rows of different lengths.
  static CsvFile load(const std::filesystem::path& path);
  static CsvFile from_text(std::string_view text, std::filesystem::path name);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::string>& comments() const { return comments_; }
  std::vector<std::string> column_names() const;
  std::size_t rows() const { return rows_.size(); }
  bool has(std::string_view column) const;

  /// The numbers of a column in the SI unit. The header must give a unit of this quantity ("[GPa]"; none for a number without
  /// unit). Throws InputError with every cell that is not a finite number.
  std::vector<double> numbers(std::string_view column, Unit unit) const;
  std::vector<std::string> texts(std::string_view column) const;

 private:
  struct Column {
    std::string name, unit;
    int position;  // of its first character in the line
  };
  struct Row {
    int line;
    std::vector<std::string> cells;
  };
  std::size_t find(std::string_view column) const;

  std::filesystem::path path_;
  std::vector<std::string> comments_;
  std::vector<Column> columns_;
  std::vector<Row> rows_;
  int header_line_ = 0;
};

/// The columns of a file as they are asked for; what is wrong with any of them is collected.
class CsvColumns {
 public:
  /// Throws InputError as CsvFile::load.
  explicit CsvColumns(const std::filesystem::path& path) : file_(CsvFile::load(path)) {}

  const CsvFile& file() const { return file_; }
  // Empty where something is wrong.
  std::vector<double> numbers(std::string_view column, Unit unit);
  std::vector<std::string> texts(std::string_view column);
  /// Something is wrong with the file as a whole.
  void problem(std::string what) { problems_.push_back({file_.path().string(), 0, 0, "", std::move(what)}); }

  const std::vector<Problem>& problems() const { return problems_; }
  /// Throws InputError if there is any problem.
  void finish() const;

 private:
  template <class Read>
  auto or_problems(Read&& read) -> decltype(read());

  CsvFile file_;
  std::vector<Problem> problems_;
};

}  // namespace brisance
