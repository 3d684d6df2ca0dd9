#include "models/input/csv.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "models/input/toml_tree.hpp"
#include "models/input/units.hpp"

namespace brisance {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string_view::npos ? text.substr(text.size())
                                         : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return cells;
    begin = comma + 1;
  }
}

}  // namespace

CsvFile CsvFile::load(const std::filesystem::path& path) {
  return from_text(read_text_file(path), path);
}

CsvFile CsvFile::from_text(std::string_view text, std::filesystem::path name) {
  CsvFile file;
  file.path_ = std::move(name);
  std::vector<Problem> problems;
  const auto report = [&](int line, int column, std::string what) {
    problems.push_back({file.path_.string(), line, column, "", std::move(what)});
  };

  int line_number = 0;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (trimmed(line).empty()) continue;
    if (line.starts_with('#')) {
      file.comments_.emplace_back(trimmed(line.substr(1)));
      continue;
    }
    const std::vector<std::string_view> cells = split(line);
    if (file.columns_.empty()) {
      file.header_line_ = line_number;
      std::set<std::string_view> names;
      for (const std::string_view cell : cells) {
        const int position = static_cast<int>(cell.data() - line.data()) + 1;
        const std::size_t bracket = cell.find('[');
        const std::string_view column = trimmed(cell.substr(0, bracket));
        std::string_view unit = bracket == std::string_view::npos ? "" : cell.substr(bracket);
        if (!unit.empty() && (unit.size() < 3 || unit.back() != ']')) {
          report(line_number, position,
                 "column " + in_quotes(cell) + ": the unit must stand in brackets, as in \"pressure [GPa]\"");
        } else if (!unit.empty()) {
          unit = unit.substr(1, unit.size() - 2);
        }
        if (column.empty())
          report(line_number, position, "a column has no name");
        else if (!names.insert(column).second)
          report(line_number, position, "column " + in_quotes(column) + " is given twice");
        file.columns_.push_back({std::string(column), std::string(unit), position});
      }
      continue;
    }
    if (cells.size() != file.columns_.size())
      report(line_number, 1,
             "this row has " + std::to_string(cells.size()) + " cells; the header in line " +
                 std::to_string(file.header_line_) + " has " + std::to_string(file.columns_.size()));
    file.rows_.push_back({line_number, std::vector<std::string>(cells.begin(), cells.end())});
  }
  if (file.columns_.empty())
    report(0, 0, "there is no line of column names");
  else if (file.rows_.empty())
    report(0, 0, "there are no rows below the header");
  if (!problems.empty()) throw InputError(std::move(problems));
  return file;
}

std::vector<std::string> CsvFile::column_names() const {
  std::vector<std::string> names;
  for (const Column& column : columns_) names.push_back(column.name);
  return names;
}

bool CsvFile::has(std::string_view column) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == column; });
}

std::size_t CsvFile::find(std::string_view column) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == column; });
  if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
  std::vector<std::string_view> names;
  for (const Column& c : columns_) names.push_back(c.name);
  throw InputError(
      {{path_.string(), header_line_, 1, "",
        "there is no column " + in_quotes(column) + "; there are " + listed(names) + did_you_mean(column, names)}});
}

std::vector<double> CsvFile::numbers(std::string_view column, Unit unit) const {
  const std::size_t index = find(column);
  const Column& header = columns_[index];
  std::vector<Problem> problems;
  std::vector<double> result;
  try {
    const UnitConversion conversion(header.unit.empty() ? Unit::one.text : std::string_view(header.unit), unit);
    for (const Row& row : rows_) {
      try {
        result.push_back(conversion(row.cells[index]));
      } catch (const UnitError& error) {
        problems.push_back({path_.string(), row.line, 1, "", std::string("column ") + header.name + ": " + error.what()});
      }
    }
  } catch (const UnitError& error) {
    const std::string what = header.unit.empty() ? std::string("no unit is given") : error.what() + error.hint;
    problems.push_back({path_.string(), header_line_, header.position, "",
                        "column " + header.name + ": " + what + "; " + quantity_of(unit) + " is required, as in \"" +
                            header.name + " [" + std::string(unit.text) + "]\""});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return result;
}

std::vector<std::string> CsvFile::texts(std::string_view column) const {
  const std::size_t index = find(column);
  std::vector<std::string> result;
  for (const Row& row : rows_) result.push_back(row.cells[index]);
  return result;
}

template <class Read>
auto CsvColumns::or_problems(Read&& read) -> decltype(read()) {
  try {
    return read();
  } catch (const InputError& error) {
    problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    return {};
  }
}

std::vector<double> CsvColumns::numbers(std::string_view column, Unit unit) {
  return or_problems([&] { return file_.numbers(column, unit); });
}

std::vector<std::string> CsvColumns::texts(std::string_view column) {
  return or_problems([&] { return file_.texts(column); });
}

void CsvColumns::finish() const {
  if (!problems_.empty()) throw InputError(problems_);
}

}  // namespace brisance
