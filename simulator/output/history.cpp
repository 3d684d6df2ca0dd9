#include "simulator/output/history.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "models/programs/files.hpp"
#include "simulator/gas/sums.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/solid/internal_energy.hpp"
#include "simulator/solid/motion.hpp"

namespace brisance::simulator {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(),
                                       error ? std::generic_category().message(error) : "unknown reason"));
}

constexpr std::string_view first_columns = "time [s],time_step [s]";

}  // namespace

gas::Totals GasBooks::residual() const {
  gas::Totals sum = state;
  const auto take = [&](const gas::Totals& t) {
    for (std::size_t r = 0; r < sum.mass.size(); ++r) sum.mass[r] -= t.mass[r];
    sum.momentum = sum.momentum - t.momentum, sum.energy -= t.energy;
  };
  take(initial);
  for (const auto& [name, through] : entries) take(through);
  for (const ReactionBook& reaction : reactions) take(reaction.made);
  return sum;
}

namespace {

/// The angle of a rotation with these rows; in the plane with its sign.
double angle_of(const std::array<Vector, 3>& turn) {
  const Vector axis = {turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]};  // 2 sin(angle) times a unit
  const double angle = std::atan2(magnitude(axis), turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
  return axis[2] < 0.0 && axis[0] == 0.0 && axis[1] == 0.0 ? -angle : angle;
}

GasBooks gas_books_of(const Simulation& s) {
  const double whole = whole_of(s.geometry);
  const auto scaled = [&](gas::Totals t) {
    for (double& mass : t.mass) mass *= whole;
    t.momentum = whole * t.momentum, t.energy *= whole, t.kinetic *= whole;
    return t;
  };
  GasBooks books;
  for (const gas::Fluid& fluid : s.gas.fluids) books.fluids.push_back(fluid.name);
  books.state = scaled(gas::totals(s.gas, *s.domain)), books.initial = scaled(s.gas.initial);
  books.gravity = s.gas.gravity != Vector{};
  const std::vector<double> counts =
      gas::sum_of_ranks({static_cast<double>(s.gas.first_order_cell_steps), static_cast<double>(s.gas.flattened),
                         static_cast<double>(s.gas.capped)},
                        3, *s.domain);
  books.first_order_cell_steps = static_cast<std::int64_t>(counts[0]), books.flattened = static_cast<std::int64_t>(counts[1]);
  books.capped = static_cast<std::int64_t>(counts[2]);
  const std::vector<gas::Totals> passed = gas::passed(s.gas, *s.domain);
  const std::size_t edges = s.gas.edges.size();
  const std::vector<gas::MovingBody>& bodies = s.gas.bodies.all;
  for (std::size_t e = 0; e < passed.size(); ++e)
    books.entries.emplace_back(e < edges                       ? s.gas.edges[e].name
                               : e == edges                    ? "gravity"
                               : e - edges - 1 < bodies.size() ? bodies[e - edges - 1].name
                                                               : "entrapped",
                               scaled(passed[e]));
  books.outside = gas::range_reports(s.gas, *s.domain);
  const std::vector<gas::Totals> burned = gas::burned(s.gas, *s.domain);
  for (std::size_t n = 0; n < burned.size(); ++n) {
    const gas::Burn& burn = s.gas.burns[n];
    const gas::Totals made = scaled(burned[n]);
    books.reactions.push_back({burn.name, -made.mass[static_cast<std::size_t>(burn.reactant)], made});
  }
  for (const gas::MovingBody& body : bodies) {
    const Vector impulse = {body.impulse[0].value(), body.impulse[1].value(), body.impulse[2].value()};
    const Vector velocity = body.mass > 0.0        ? body.state.velocity
                            : body.motion.velocity ? body.motion.velocity(s.gas.time)
                                                   : Vector{};
    books.bodies.push_back({body.name, body.state.displacement, velocity, whole * body.force, whole * impulse,
                            whole * body.work.value(), whole * body.kinetic_energy(), body.motion.radius, body.state.growth,
                            angle_of(body.state.turn)});
  }
  return books;
}

/// The columns of the gas. Along a radius momentum is no sum that could be kept.
std::vector<BookEntry> entries_of(const GasBooks& books, Geometry geometry) {
  const Unit mass = unit_of(Extensive::mass, geometry), energy = unit_of(Extensive::energy, geometry);
  std::vector<BookEntry> entries;
  const std::size_t first = is_round(geometry) ? 1 : 0, last = static_cast<std::size_t>(number_of_dimensions(geometry));
  const auto add = [&](const std::string& name, const gas::Totals& t, std::string_view momentum) {
    for (std::size_t r = 0; r < t.mass.size(); ++r)
      entries.push_back({name + "_mass" + (t.mass.size() > 1 ? "_" + books.fluids[r] : ""), mass, t.mass[r]});
    for (std::size_t a = first; a < last; ++a)
      entries.push_back(
          {fmt::format("{}_{}_{}", name, momentum, "xyz"[a]), unit_of(Extensive::momentum, geometry), t.momentum[a]});
    entries.push_back({name + "_energy", energy, t.energy});
  };
  add("gas", books.state, "momentum");
  entries.push_back({"gas_kinetic_energy", energy, books.state.kinetic});
  const std::size_t beyond = books.entries.size() - (books.bodies.empty() ? 0 : books.bodies.size() + 1);
  for (std::size_t e = 0; e < beyond; ++e) {
    const auto& [name, through] = books.entries[e];
    if (name != "gravity" || books.gravity) add(name, through, "impulse");
  }
  for (const ReactionBook& reaction : books.reactions) {
    entries.push_back({reaction.name + "_burned_mass", mass, reaction.burned});
    entries.push_back({reaction.name + "_heat", energy, reaction.made.energy});
  }
  for (const GasBodyBooks& body : books.bodies) {
    const auto vector = [&](std::string_view what, Unit unit, const Vector& v) {
      for (std::size_t a = first; a < last; ++a)
        entries.push_back({fmt::format("{}_{}_{}", body.name, what, "xyz"[a]), unit, v[a]});
    };
    vector("displacement", Unit::m, body.displacement), vector("velocity", Unit::m_per_s, body.velocity);
    vector("force", unit_of(Extensive::force, geometry), body.force),
        vector("impulse", unit_of(Extensive::momentum, geometry), body.impulse);
    entries.push_back({body.name + "_work", energy, body.work});
    entries.push_back({body.name + "_kinetic_energy", energy, body.kinetic});
  }
  if (!books.bodies.empty()) add("entrapped", books.entries.back().second, "momentum");
  add("gas_residual", books.residual(), "momentum");
  return entries;
}

}  // namespace

Books books_of(const Simulation& s) {
  const double whole = whole_of(s.geometry);
  const Ledger& ledger = s.ledger;
  Books books;
  books.geometry = s.geometry;
  books.initial_internal = whole * ledger.initial_internal, books.peak_kinetic = whole * ledger.peak_kinetic;
  books.outflow_mass = whole * ledger.outflow_mass;
  books.state = whole * ledger.state;
  books.internal_force = whole * ledger.internal_force.total(), books.external = whole * ledger.external.total();
  books.transfer = whole * ledger.transfer.total(), books.filter = whole * ledger.filter.total();
  books.advection = whole * ledger.advection.total(), books.outflow = whole * ledger.outflow.total();
  for (std::size_t i = 0; i < s.boundaries.size(); ++i) {
    books.boundaries.emplace_back(s.boundaries[i].name, whole * ledger.boundary[i].total());
    books.boundary += books.boundaries.back().second;
  }
  InternalEnergy all;
  for (const Body& body : s.bodies) {
    const InternalEnergy internal = internal_energy(s, body);
    all += internal;
    books.bodies.push_back({body.name, whole * motion_of(s, body), whole * internal});
  }
  books.balance = whole * balance(ledger, all);
  if (!s.gas.empty()) books.gas = gas_books_of(s);
  return books;
}

std::vector<BookEntry> entries_of(const Books& books) {
  if (books.gas) return entries_of(*books.gas, books.geometry);
  const Balance& b = books.balance;
  const Unit mass = unit_of(Extensive::mass, books.geometry), energy = unit_of(Extensive::energy, books.geometry);
  std::vector<BookEntry> entries = {{"kinetic_energy", energy, b.kinetic},
                                    {"internal_energy", energy, b.internal.total},
                                    {"internal_energy_change", energy, b.internal.total - books.initial_internal},
                                    {"thermal_energy", energy, b.internal.thermal},
                                    {"elastic_shear_energy", energy, b.internal.elastic},
                                    {"stored_cold_work", energy, b.internal.stored_cold_work()},
                                    {"cold_energy", energy, b.internal.cold()},
                                    {"stress_work", energy, b.internal.stress_work},
                                    {"plastic_work", energy, b.internal.plastic_work},
                                    {"plastic_heat", energy, b.internal.plastic_heat},
                                    {"viscous_work", energy, b.internal.viscous_work},
                                    {"external_work", energy, b.external},
                                    {"boundary_work", energy, b.boundary},
                                    {"friction_work", energy, b.friction},
                                    {"outflow_energy", energy, b.outflow},
                                    {"outflow_mass", mass, books.outflow_mass},
                                    {"transfer_energy", energy, b.transfer},
                                    {"filter_energy", energy, b.filter},
                                    {"filter_heat", energy, b.filter_heat},
                                    {"stress_timing_energy", energy, b.stress_timing},
                                    {"energy_residual", energy, b.residual},
                                    {"mass", mass, b.internal.mass}};
  const bool space = books.geometry == Geometry::three_dimensional;
  const auto add = [&](const std::string& name, Extensive quantity, const Vector& v, std::size_t first, std::size_t last) {
    for (std::size_t a = first; a <= last; ++a)
      entries.push_back({name + "_" + "xyz"[a], unit_of(quantity, books.geometry), v[a]});
  };
  const auto add_motion = [&](const std::string& momentum, const std::string& angular_momentum, const Change& c) {
    add(momentum, Extensive::momentum, c.momentum, 0, space ? 2 : 1);
    add(angular_momentum, Extensive::angular_momentum, c.angular_momentum, space ? 0 : 2, 2);
  };
  add_motion("momentum", "angular_momentum", books.state);
  const std::pair<const char*, const Change*> causes[] = {{"internal", &books.internal_force}, {"external", &books.external},
                                                          {"boundary", &books.boundary},       {"transfer", &books.transfer},
                                                          {"filter", &books.filter},           {"outflow", &books.outflow}};
  for (const auto& [cause, change] : causes)
    add_motion(cause + std::string("_impulse"), cause + std::string("_angular_impulse"), *change);
  add("advection_angular_impulse", Extensive::angular_momentum, books.advection.angular_momentum, space ? 0 : 2, 2);
  add_motion("momentum_residual", "angular_momentum_residual", {0.0, b.momentum_residual, b.angular_momentum_residual});
  for (const auto& [name, done] : books.boundaries) {
    add_motion(name + "_impulse", name + "_angular_impulse", done);
    entries.push_back({name + "_work", energy, done.energy});
  }
  for (const BodyBooks& body : books.bodies) {
    const std::string name = "body_" + body.name;
    entries.push_back({name + "_mass", mass, body.internal.mass});
    entries.push_back({name + "_kinetic_energy", energy, body.state.energy});
    entries.push_back({name + "_internal_energy", energy, body.internal.total});
    entries.push_back({name + "_thermal_energy", energy, body.internal.thermal});
    entries.push_back({name + "_plastic_work", energy, body.internal.plastic_work});
    add_motion(name + "_momentum", name + "_angular_momentum", body.state);
  }
  return entries;
}

double row_interval(const Case& c) {
  constexpr double rows = 500.0;
  return c.output.history_interval > 0.0 ? c.output.history_interval : c.end_time / rows;
}

History::History(std::filesystem::path path, const Books& books, const std::vector<HistoryColumn>& gauges,
                 std::int64_t rows_to_keep)
    : path_(std::move(path)) {
  std::string header(first_columns);
  for (const BookEntry& entry : entries_of(books)) header += fmt::format(",{} [{}]", entry.name, entry.unit.text);
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

void History::synchronise() const {
  try {
    brisance::synchronise(path_);
  } catch (const std::system_error& error) {
    fail(path_, error.code().value());
  }
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
