#include "simulator/output/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <span>

#include "models/programs/files.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/output/json.hpp"

namespace brisance::simulator {
namespace {

std::string unit(Extensive quantity, const Books& books) {
  return std::string(unit_of(quantity, books.geometry).text);
}

/// What moves a body in the gas and how it has moved: components along the axes, and what its centre does not show.
std::string in_words(const GasBodyBooks& body, const Books& all) {
  const bool round = is_round(all.geometry);
  const auto components = [&](const char* name, const std::string& unit, const Vector& v) {
    std::string text = fmt::format("    {:22}", name + (" [" + unit + "]"));
    for (std::size_t a = round ? 1 : 0; a < static_cast<std::size_t>(number_of_dimensions(all.geometry)); ++a)
      text += fmt::format("  {} {:12.6g}", "xyz"[a], v[a] + 0.0);  // no -0
    return text + '\n';
  };
  std::string text = fmt::format("  {}\n", body.name);
  text += components("force of the gas", unit(Extensive::force, all), body.force);
  text += fmt::format("    {:22}    {:12.6g}\n", "work of the gas [" + unit(Extensive::energy, all) + "]", body.work + 0.0);
  text += components("its velocity", "m/s", body.velocity);
  text += components("its centre moved", "m", body.displacement);
  if (body.growth != 0.0)
    text +=
        fmt::format("    {:22}    {:12.6g}, from {:.6g} to {:.6g}\n", body.growth > 0.0 ? "it widened [m]" : "it shrank [m]",
                    body.growth, body.radius, body.radius + body.growth);
  constexpr double degree = std::numbers::pi / 180.0;
  if (body.turned != 0.0)
    text += fmt::format("    {:22}    {:12.6g}, and perhaps whole turns\n", "it turned [degrees]", body.turned / degree);
  return text;
}

/// Words on what the scheme did less exactly than it could; empty if it never had to.
std::string caution_in_words(const GasBooks& books, double cells_times_steps) {
  if (books.first_order_cell_steps + books.flattened == 0) return "";
  constexpr double few = 0.01;
  const auto part_of_all = [&](std::int64_t count) { return static_cast<double>(count) / std::max(cells_times_steps, 1.0); };
  std::string text = "  caution: ";
  if (books.first_order_cell_steps > 0)
    text += fmt::format("{} times a cell took a step with first order ({:.2g} % of all cells and steps)",
                        books.first_order_cell_steps, 100.0 * part_of_all(books.first_order_cell_steps));
  if (books.flattened > 0)
    text += fmt::format("{}{} times a change of velocity within a cell was made gentler",
                        books.first_order_cell_steps > 0 ? ", " : "", books.flattened);
  text += ", or a cell would have lost more energy than it has. There the result is smeared, not wrong; ";
  return text +
         (part_of_all(books.first_order_cell_steps + books.flattened) > few
              ? "so much of it may show: look where the gas is nearly empty, take smaller cells or steps (gas.courant)"
              : "so little of it needs no action") +
         '\n';
}

std::string gas_in_words(const Books& all, double cells_times_steps) {
  const GasBooks& books = *all.gas;
  std::string text = fmt::format("  {:24} {:>14} {:>14}\n", "gas", "mass [" + unit(Extensive::mass, all) + "]",
                                 "energy [" + unit(Extensive::energy, all) + "]");
  const auto row = [&](const std::string& name, const gas::Totals& t) {
    double mass = 0.0;
    for (const double m : t.mass) mass += m;
    text += fmt::format("  {:24} {:14.6g} {:14.6g}\n", name, mass, t.energy);
  };
  row("at the start", books.initial), row("now", books.state);
  for (const auto& [name, through] : books.entries)
    if (through.energy != 0.0) row("by " + name, through);
  for (const ReactionBook& reaction : books.reactions)
    text += fmt::format("  {:24} {:14.6g} {:14.6g}\n", "burned by " + reaction.name, reaction.burned + 0.0,
                        reaction.made.energy);  // no -0
  if (books.capped > 0)
    text += fmt::format(
        "  caution: {} times a cell was not let burn as fast as its law says, for a fifth of a cell may burn in a step at "
        "most; where that delays the front, take a smaller gas.courant\n",
        books.capped);
  row("in no book", books.residual());
  text += caution_in_words(books, cells_times_steps);
  for (const gas::RangeReport& report : books.outside)
    text += fmt::format("  warning: {}\n", in_words(report, number_of_dimensions(all.geometry)));
  for (const GasBodyBooks& body : books.bodies) text += in_words(body, all);
  return text;
}

Json json_of_place(const Vector& x) {
  Json place = Json::object();
  for (std::size_t a = 0; a < 3; ++a) place.set(std::string(1, "xyz"[a]), x[a]);
  return place;
}

/// Where a fluid was farthest outside of the densities that its equation of state declares.
Json json_of(const gas::RangeReport& report) {
  const gas::OutsideRange& o = report.outside;
  const bool above = o.density > report.range.highest;
  return Json::object()
      .set("cell_steps", o.cell_steps)
      .set("density", o.density)
      .set(above ? "highest" : "lowest", above ? report.range.highest : report.range.lowest)
      .set("time", o.time)
      .set("place", json_of_place(o.place));
}

std::string in_words(const gas::Hottest& hottest, int dimensions) {
  std::string text;
  const auto row = [&](const char* name, const gas::HotCell& cell) {
    text +=
        fmt::format("  {:24} {:14.6g}  at ({:.6g}) m, of {}\n", name, cell.temperature,
                    fmt::join(std::span(cell.place).first(static_cast<std::size_t>(dimensions)), ", "), in_words(cell.fluid));
  };
  row("hottest cell now [K]", hottest.of_all);
  if (hottest.of_one_fluid && hottest.of_one_fluid->place != hottest.of_all.place)
    row("hottest of one fluid [K]", *hottest.of_one_fluid);
  if (is_doubtful(hottest))
    text +=
        "  caution: the hottest cell is shared by fluids; the temperature of little of a fluid at a contact is often none that "
        "it would have: trust that of the cells of one fluid\n";
  return text;
}

Json json_of(const gas::HotCell& cell) {
  return Json::object()
      .set("temperature", cell.temperature)
      .set("place", json_of_place(cell.place))
      .set("fluid", cell.fluid.fluid)
      .set("part", cell.fluid.part);
}

}  // namespace

std::vector<FailedParticles> failed_particles(const Simulation& s) {
  std::vector<FailedParticles> bodies;
  for (const Body& body : s.bodies) {
    std::int64_t failed = 0;
    for (int p = 0; p < body.particles.size; ++p)
      failed += ParticleView(body.particles, p).rest(Layout<2>::Rest::failure_cause) != 0.0;
    if (failed > 0) bodies.push_back({body.name, failed, body.particles.size});
  }
  return bodies;
}

std::vector<std::array<std::string, 2>> in_contact(const Simulation& s) {
  using Cell = std::array<int, 3>;
  std::vector<std::set<Cell>> cells(s.bodies.size());  // that hold particles of each body
  for (std::size_t b = 0; b < s.bodies.size() && s.bodies.size() > 1; ++b)
    for (int p = 0; p < s.bodies[b].particles.size; ++p) {
      const Vector x = (1.0 / s.grid.cell_size) * (ParticleView(s.bodies[b].particles, p).position() - s.grid.origin);
      Cell cell{};
      for (std::size_t a = 0; a < static_cast<std::size_t>(s.dimensions()); ++a) cell[a] = static_cast<int>(std::floor(x[a]));
      cells[b].insert(cell);
    }
  const auto beside = [](const std::set<Cell>& all, const Cell& cell) {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (all.contains({cell[0] + i, cell[1] + j, cell[2] + k})) return true;
    return false;
  };
  std::vector<std::array<std::string, 2>> pairs;
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b)
      if (std::any_of(cells[a].begin(), cells[a].end(), [&](const Cell& cell) { return beside(cells[b], cell); }))
        pairs.push_back({s.bodies[a].name, s.bodies[b].name});
  return pairs;
}

void write_summary(const Summary& s, const std::filesystem::path& path) {
  Json gauges = Json::object(), measures = Json::object(), comparison = Json::object(), energy = Json::object(),
       units = Json::object(), versions = Json::object();
  for (const MeasuredValue& m : s.measures) {
    measures.set(m.name, m.value);
    if (m.measured && m.missing.empty())
      comparison.set(m.name, Json::object().set("measured", *m.measured).set("deviation", *m.deviation()));
  }
  for (const GaugePeak& p : s.peaks)
    gauges.set(p.name, Json::object().set("peak", p.value).set("unit", p.unit).set("time", p.time));
  for (const BookEntry& entry : entries_of(s.books)) energy.set(entry.name, entry.value);
  if (!s.books.gas)
    energy.set("initial_internal_energy", s.books.initial_internal).set("peak_kinetic_energy", s.books.peak_kinetic);
  if (!s.books.gas)
    energy.set("numerical_over_peak_kinetic",
               s.books.peak_kinetic > 0.0 ? s.books.balance.numerical() / s.books.peak_kinetic : 0.0);
  units.set("mass", unit(Extensive::mass, s.books)).set("energy", unit(Extensive::energy, s.books));
  units.set("momentum", unit(Extensive::momentum, s.books));
  units.set("angular_momentum", unit(Extensive::angular_momentum, s.books));
  versions.set("brisance", BRISANCE_VERSION).set("compiler", __VERSION__).set("hdf5", hdf5_version());
  versions.set("instruction_set", BRISANCE_INSTRUCTION_SET);
  Json all = Json::object();
  all.set("title", s.title)
      .set("subtitle", s.subtitle)
      .set("ending", s.ending)
      .set("message", s.message)
      .set("time", s.time)
      .set("steps", s.steps);
  const std::string points = s.books.gas ? "cell" : "particle";
  all.set(points + "s", s.particles)
      .set("measures", measures)
      .set("comparison", comparison)
      .set("gauges", gauges)
      .set("energy", energy)
      .set("units", units);
  if (!s.failed.empty()) {
    Json failed = Json::object();
    for (const FailedParticles& f : s.failed) failed.set(f.body, f.failed);
    all.set("failed_particles", failed);
  }
  if (s.books.gas) {
    all.set("first_order_cell_steps", s.books.gas->first_order_cell_steps).set("flattened_slopes", s.books.gas->flattened);
    Json outside = Json::object();
    for (const gas::RangeReport& report : s.books.gas->outside) outside.set(report.fluid, json_of(report));
    all.set("outside_declared_densities", outside).set("not_gated", s.not_gated);
  }
  if (!s.in_contact.empty()) {
    Json pairs = Json::list();
    for (const auto& [a, b] : s.in_contact) pairs.append(Json::list().append(a).append(b));
    all.set("in_contact", pairs);
  }
  if (s.hottest) {
    all.set("hottest_cell", json_of(s.hottest->of_all));
    if (s.hottest->of_one_fluid) all.set("hottest_cell_of_one_fluid", json_of(*s.hottest->of_one_fluid));
  }
  Json resumed_after = Json::list();
  for (const std::string& gate : s.resumed_after) resumed_after.append(gate);
  Json other_experiment = Json::list();
  for (const std::string& change : s.other_experiment) other_experiment.append(change);
  all.set("resumed_after", resumed_after).set("other_experiment", other_experiment);
  all.set("wall_time", s.wall_time).set(points + "_steps_per_second", s.particle_steps_per_second).set("threads", s.threads);
  replace_file_by_text(path, all.set("versions", versions).text());
}

std::optional<ToldEnding> read_ending(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto after = [&](const std::string& key) {
    const std::string before = "\n  \"" + key + "\": ";  // of the outermost object
    const auto at = text.find(before);
    return at == std::string::npos ? "" : text.substr(at + before.size());
  };
  return ToldEnding{unquoted(after("ending")), unquoted(after("message")), std::strtod(after("time").c_str(), nullptr)};
}

std::string in_words(const Summary& s) {
  std::string text = fmt::format("{}: {}\n{}  time {:.6g} s, {} steps, {} {}, {:.2f} s on the clock\n", s.title, s.ending,
                                 s.subtitle.empty() ? "" : "  " + s.subtitle + '\n', s.time, s.steps, s.particles,
                                 s.books.gas ? "cells" : "particles", s.wall_time);
  for (const std::string& gate : s.resumed_after) text += fmt::format("  caution: resumed after {}\n", gate);
  for (const FailedParticles& f : s.failed)
    text += fmt::format("  failed: {} of {} particles of {}\n", f.failed, f.all, f.body);
  for (const auto& [a, b] : s.in_contact)
    text += fmt::format("  in contact: {} and {}; bodies that have met stick together, where real ones may fly off\n", a, b);
  if (!s.measures.empty())
    text += fmt::format("  {:24} {:>14} {:>14} {:>10}\n", "measure", "computed", "measured", "deviation");
  for (const MeasuredValue& m : s.measures) {
    const bool length = m.unit == "m";
    // Relative to next to nothing a deviation says nothing.
    const auto difference = [&](const MeasuredValue& v) {
      return std::abs(*v.deviation()) < 1.0 || !length ? fmt::format("{:+.2f} %", 100.0 * *v.deviation())
                                                       : fmt::format("{:+.3f} mm", 1e3 * (v.value - *v.measured));
    };
    const auto shown = [&](double x) {
      return length          ? fmt::format("{:.4f} mm", 1e3 * x)
             : m.unit == "1" ? fmt::format("{:.5f}", x)
                             : fmt::format("{:.5g} {}", x, m.unit);
    };
    const bool there = m.missing.empty();
    text += fmt::format("  {:24} {:>14} {:>14} {:>10}\n", m.name, there ? shown(m.value) : "none",
                        m.measured ? shown(*m.measured) : "", m.measured && there ? difference(m) : "");
  }
  for (const MeasuredValue& m : s.measures)
    if (!m.missing.empty()) text += fmt::format("  caution: {}: {}\n", m.name, m.missing);
  if (!s.other_experiment.empty())
    text += fmt::format("  caution: measured is the experiment of the case as its file states it; --set has changed {}\n",
                        fmt::join(s.other_experiment, ", "));
  if (s.hottest) text += in_words(*s.hottest, number_of_dimensions(s.books.geometry));
  if (s.books.gas) {
    text += gas_in_words(s.books, static_cast<double>(s.steps) * static_cast<double>(s.particles));
    return text + (s.not_gated.empty() ? "" : fmt::format("  not gated: {}\n", s.not_gated));
  }
  const Balance& b = s.books.balance;
  const double peak = s.books.peak_kinetic > 0.0 ? s.books.peak_kinetic : 1.0;
  text += fmt::format("  {:24} {:>14} {:>14}\n", "energy", unit(Extensive::energy, s.books), "of the peak");
  const auto row = [&](const char* name, double value) {
    text += fmt::format("  {:24} {:14.6g} {:12.4g} %\n", name, value, 100.0 * value / peak);
  };
  row("kinetic, peak", s.books.peak_kinetic), row("kinetic", b.kinetic),
      row("internal, change", b.internal.total - s.books.initial_internal), row("thermal, change", b.internal.thermal);
  row("plastic work", b.internal.plastic_work), row("work from outside", b.external + b.boundary), row("friction", b.friction);
  row("artificial viscosity", b.internal.viscous_work), row("outflow", b.outflow);
  // Errors of the method; docs/simulator.md says of which kind.
  row("numerical: transfer", b.transfer), row("numerical: filter", b.filter), row("  of it to heat", b.filter_heat),
      row("numerical: stress timing", b.stress_timing), row("in no book", b.residual);
  return text;
}

}  // namespace brisance::simulator
