#include "simulator/output/history.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <numbers>
#include <stdexcept>
#include <system_error>

#include "models/programs/files.hpp"
#include "simulator/solid/stress.hpp"

namespace brisance::simulator {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(),
                                       error ? std::generic_category().message(error) : "unknown reason"));
}

constexpr std::string_view first_columns = "time [s],time_step [s]";

}  // namespace

Books books_of(const Simulation& s) {
  const InternalEnergy internal = internal_energy(s);
  // The books of the axisymmetric geometry are per radian.
  const double whole = s.geometry == Geometry::axisymmetric ? 2.0 * std::numbers::pi : 1.0;
  Books books;
  books.balance = balance(s.ledger, internal);
  books.state = s.ledger.state;
  books.initial_internal = whole * s.ledger.initial_internal, books.peak_kinetic = whole * s.ledger.peak_kinetic;
  books.mass = whole * internal.mass;
  books.outflow_mass = whole * s.ledger.outflow_mass, books.outflow_momentum = s.ledger.outflow.total().momentum;
  for (const Account& a : s.ledger.boundary) books.boundary_momentum = books.boundary_momentum + a.total().momentum;
  books.external_momentum = s.ledger.external.total().momentum;
  for (std::size_t i = 0; i < s.boundaries.size(); ++i) {
    Change done = s.ledger.boundary[i].total();
    done.energy *= whole, done.momentum = whole * done.momentum;
    books.boundaries.emplace_back(s.boundaries[i].name, done);
  }
  Balance& b = books.balance;
  for (double* energy :
       {&b.kinetic, &b.internal, &b.stress_work, &b.viscous_work, &b.plastic_work, &b.elastic, &b.external, &b.boundary,
        &b.friction, &b.transfer, &b.filter, &b.stress_timing, &b.outflow, &b.residual, &books.state.energy})
    *energy *= whole;
  for (Vector* v : {&b.momentum_residual, &b.angular_momentum_residual, &books.state.momentum, &books.state.angular_momentum,
                    &books.boundary_momentum, &books.external_momentum, &books.outflow_momentum})
    *v = whole * *v;
  return books;
}

std::vector<BookEntry> entries_of(const Books& books) {
  const Balance& b = books.balance;
  std::vector<BookEntry> entries = {{"kinetic_energy", "J", b.kinetic},
                                    {"internal_energy", "J", b.internal},
                                    {"internal_energy_change", "J", b.internal - books.initial_internal},
                                    {"stress_work", "J", b.stress_work},
                                    {"plastic_work", "J", b.plastic_work},
                                    {"viscous_work", "J", b.viscous_work},
                                    {"elastic_shear_energy", "J", b.elastic},
                                    {"external_work", "J", b.external},
                                    {"boundary_work", "J", b.boundary},
                                    {"friction_work", "J", b.friction},
                                    {"outflow_energy", "J", b.outflow},
                                    {"outflow_mass", "kg", books.outflow_mass},
                                    {"transfer_energy", "J", b.transfer},
                                    {"filter_energy", "J", b.filter},
                                    {"stress_timing_energy", "J", b.stress_timing},
                                    {"energy_residual", "J", b.residual},
                                    {"mass", "kg", books.mass}};
  const auto add = [&](const char* name, const char* unit, const Vector& v) {
    for (std::size_t a = 0; a < 3; ++a) entries.push_back({std::string(name) + "_" + "xyz"[a], unit, v[a]});
  };
  add("momentum", "kg m/s", books.state.momentum);
  add("boundary_impulse", "kg m/s", books.boundary_momentum);
  add("external_impulse", "kg m/s", books.external_momentum);
  add("angular_momentum", "kg m^2/s", books.state.angular_momentum);
  for (const auto& [name, done] : books.boundaries) {
    add((name + "_impulse").c_str(), "kg m/s", done.momentum);
    entries.push_back({name + "_work", "J", done.energy});
  }
  return entries;
}

History::History(std::filesystem::path path, const Books& books, const std::vector<HistoryColumn>& gauges,
                 std::int64_t rows_to_keep)
    : path_(std::move(path)) {
  std::string header(first_columns);
  for (const BookEntry& entry : entries_of(books)) header += fmt::format(",{} [{}]", entry.name, entry.unit);
  for (const HistoryColumn& column : gauges) header += fmt::format(",{} [{}]", column.name, column.unit);
  header += '\n';
  rows_to_keep > 0 ? keep(header, rows_to_keep) : replace_file_by_text(path_, header);
  rows_ = rows_to_keep;
  errno = 0;
  out_.open(path_, std::ios::app);
  if (!out_) fail(path_, errno);
}

/// Drops the rows that were written after the checkpoint from which the run goes on: it will write them again.
void History::keep(const std::string& header, std::int64_t rows) {
  std::ifstream in(path_);
  std::string text, line;
  std::int64_t lines = 0;
  while (lines <= rows && std::getline(in, line)) text += line + '\n', ++lines;
  if (lines <= rows || !text.starts_with(header))
    throw std::runtime_error(
        fmt::format("{}: is not the history that the checkpoint belongs to; {} rows are required", path_.string(), rows));
  in.close();
  replace_file_by_text(path_, text);
}

void History::add_row(const Simulation& s, const Books& books, const std::vector<double>& gauges) {
  std::string row = fmt::format("{},{}", s.time, s.last_time_step);
  for (const BookEntry& entry : entries_of(books)) row += fmt::format(",{}", entry.value);
  for (const double value : gauges) row += fmt::format(",{}", value);
  row += '\n';
  errno = 0;
  out_ << row << std::flush;
  if (!out_) fail(path_, errno);
  ++rows_;
}

}  // namespace brisance::simulator
