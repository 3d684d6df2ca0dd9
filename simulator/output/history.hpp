#pragma once
// history.csv: energies, momenta and gauges against time. Rows are appended and flushed, so that they survive a kill; and what
// a checkpoint counts on, a loss of power.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/gas/range_watch.hpp"
#include "simulator/output/gauges.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// What one body holds.
struct BodyBooks {
  std::string name;
  Change state;  // kinetic energy, momentum, angular momentum
  InternalEnergy internal;
};

/// What a reaction has done since the start.
struct ReactionBook {
  std::string name;
  double burned = 0.0;  // kg
  gas::Totals made;     // of each fluid, and the heat that it has set free
};
/// What a body in the gas does and has received from the gas.
struct GasBodyBooks {
  std::string name;
  Vector displacement{}, velocity{}, force{}, impulse{};  // m, m/s of a driven body, N over the last step, N s
  double work = 0.0;                                      // J
  double kinetic = 0.0;                                   // J, of a driven body
  double radius = 0.0, growth = 0.0;  // m: of a body that widens or shrinks, where its radial velocity is given, and its change
  double turned = 0.0;                // rad, within half a turn either way
};

/// What the gas holds, and what has come in since the start: through each edge and by gravity.
struct GasBooks {
  std::vector<std::string> fluids;
  gas::Totals state, initial;
  std::vector<std::pair<std::string, gas::Totals>> entries;
  bool gravity = false;                                    // acts
  std::int64_t first_order_cell_steps = 0, flattened = 0;  // as in Gas, of all processes
  std::vector<ReactionBook> reactions;
  std::int64_t capped = 0;  // times that a cell wanted to burn more in a step than it may
  std::vector<GasBodyBooks> bodies;
  std::vector<gas::RangeReport> outside;  // fluids beyond what their equations of state declare

  /// What the gas holds now that it neither held at the start nor received, nor made by reaction.
  gas::Totals residual() const;
};

/// The books as a user sees them: of the whole bodies, or per metre of depth (see extensive.hpp).
struct Books {
  Geometry geometry = Geometry::three_dimensional;
  Balance balance;
  double initial_internal = 0.0, peak_kinetic = 0.0;
  double outflow_mass = 0.0;  // that has left
  Change state;               // kinetic energy, momentum, angular momentum of all bodies
  // What has changed it since the start; `boundary` is the sum over the boundaries.
  Change internal_force, external, boundary, transfer, filter, advection, outflow;
  std::vector<std::pair<std::string, Change>> boundaries;  // by name
  std::vector<BodyBooks> bodies;
  std::optional<GasBooks> gas;
};
Books books_of(const Simulation& s);

/// A name, unit and value of every number in the books.
struct BookEntry {
  std::string name;
  Unit unit;
  double value;
};
std::vector<BookEntry> entries_of(const Books& books);

/// Time between rows, s.
double row_interval(const Case& c);

class History {
 public:
  /// Begins the file with a column for each entry of the books, or continues it after so many rows. Throws std::runtime_error.
  History(std::filesystem::path path, const Books& books, const std::vector<HistoryColumn>& gauges, std::int64_t rows_to_keep);

  void add_row(const Simulation& s, const Books& books, const std::vector<double>& gauges);
  std::int64_t rows() const { return rows_; }
  /// The rows are on disk afterwards: a checkpoint may count on them. Throws std::runtime_error.
  void synchronise() const;

 private:
  void keep(const std::string& header, std::int64_t rows);

  std::filesystem::path path_;
  std::ofstream out_;
  std::int64_t rows_ = 0;
};

}  // namespace brisance::simulator
