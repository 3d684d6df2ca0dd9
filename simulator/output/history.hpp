#pragma once
// history.csv: energies, momenta and gauges against time. Rows are appended and flushed, so that they survive a kill.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "simulator/output/gauges.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// Energies as a user sees them: of the whole body, whatever the geometry.
struct Books {
  Balance balance;
  Change state;  // kinetic energy, momentum, angular momentum
  double initial_internal = 0.0, peak_kinetic = 0.0, mass = 0.0;
  double outflow_mass = 0.0;  // kg, that has left
  Vector outflow_momentum{};  // kg m/s, that it carried
  Vector boundary_momentum{}, external_momentum{};
  std::vector<std::pair<std::string, Change>> boundaries;  // what each has done since the start, by name
};
Books books_of(const Simulation& s);

/// A name, unit and value of every number in the books.
struct BookEntry {
  std::string name, unit;
  double value;
};
std::vector<BookEntry> entries_of(const Books& books);

class History {
 public:
  /// Begins the file with a column for each entry of the books, or continues it after so many rows. Throws std::runtime_error.
  History(std::filesystem::path path, const Books& books, const std::vector<HistoryColumn>& gauges, std::int64_t rows_to_keep);

  void add_row(const Simulation& s, const Books& books, const std::vector<double>& gauges);
  std::int64_t rows() const { return rows_; }

 private:
  void keep(const std::string& header, std::int64_t rows);

  std::filesystem::path path_;
  std::ofstream out_;
  std::int64_t rows_ = 0;
};

}  // namespace brisance::simulator
