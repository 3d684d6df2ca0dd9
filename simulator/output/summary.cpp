#include "simulator/output/summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "models/programs/files.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/output/json.hpp"

namespace brisance::simulator {
namespace {

std::string unit(Extensive quantity, const Books& books) {
  return std::string(unit_of(quantity, books.geometry).text);
}

std::string gas_in_words(const Books& all) {
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
    text += fmt::format("  {} times a cell wanted to burn more than a fifth of itself in a step\n", books.capped);
  row("in no book", books.residual());
  if (books.plain + books.flattened > 0)
    text += fmt::format("  for the sake of positive energies {} cell-steps were first order, {} slopes flatter\n", books.plain,
                        books.flattened);
  for (const gas::RangeReport& report : books.outside)
    text += fmt::format("  warning: {}\n", in_words(report, number_of_dimensions(all.geometry)));
  if (!books.bodies.empty())
    text += fmt::format("  {:24} {:>14} {:>14} {:>14}\n", "body", "force [" + unit(Extensive::force, all) + "]",
                        "work [" + unit(Extensive::energy, all) + "]", "moved [m]");
  for (const GasBodyBooks& body : books.bodies)
    text += fmt::format("  {:24} {:14.6g} {:14.6g} {:14.6g}\n", body.name, magnitude(body.force), body.work,
                        magnitude(body.displacement));
  return text;
}

/// Where a fluid was farthest outside of the densities that its equation of state declares.
Json json_of(const gas::RangeReport& report) {
  const gas::OutsideRange& o = report.outside;
  Json place = Json::object();
  for (std::size_t a = 0; a < 3; ++a) place.set(std::string(1, "xyz"[a]), o.place[a]);
  const bool above = o.density > report.range.highest;
  return Json::object()
      .set("cell_steps", o.cell_steps)
      .set("density", o.density)
      .set(above ? "highest" : "lowest", above ? report.range.highest : report.range.lowest)
      .set("time", o.time)
      .set("place", place);
}

}  // namespace

void write_summary(const Summary& s, const std::filesystem::path& path) {
  Json gauges = Json::object(), measures = Json::object(), comparison = Json::object(), energy = Json::object(),
       units = Json::object(), versions = Json::object();
  for (const MeasuredValue& m : s.measures) {
    measures.set(m.name, m.value);
    if (m.measured) comparison.set(m.name, Json::object().set("measured", *m.measured).set("deviation", *m.deviation()));
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
  all.set("title", s.title).set("ending", s.ending).set("message", s.message).set("time", s.time).set("steps", s.steps);
  const std::string points = s.books.gas ? "cell" : "particle";
  all.set(points + "s", s.particles)
      .set("measures", measures)
      .set("comparison", comparison)
      .set("gauges", gauges)
      .set("energy", energy)
      .set("units", units);
  if (s.books.gas) {
    all.set("first_order_cell_steps", s.books.gas->plain).set("flattened_slopes", s.books.gas->flattened);
    Json outside = Json::object();
    for (const gas::RangeReport& report : s.books.gas->outside) outside.set(report.fluid, json_of(report));
    all.set("outside_declared_densities", outside);
  }
  all.set("wall_time", s.wall_time).set(points + "_steps_per_second", s.particle_steps_per_second).set("threads", s.threads);
  replace_file_by_text(path, all.set("versions", versions).text());
}

std::string in_words(const Summary& s) {
  std::string text = fmt::format("{}: {}\n  time {:.6g} s, {} steps, {} {}, {:.2f} s on the clock\n", s.title, s.ending, s.time,
                                 s.steps, s.particles, s.books.gas ? "cells" : "particles", s.wall_time);
  if (!s.measures.empty())
    text += fmt::format("  {:24} {:>14} {:>14} {:>10}\n", "measure", "computed", "measured", "deviation");
  for (const MeasuredValue& m : s.measures) {
    const bool length = m.unit == "m";
    // Relative to next to nothing a deviation says nothing.
    const auto difference = [&](const MeasuredValue& v) {
      return std::abs(*v.deviation()) < 1.0 || !length ? fmt::format("{:+.2f} %", 100.0 * *v.deviation())
                                                       : fmt::format("{:+.3f} mm", 1e3 * (v.value - *v.measured));
    };
    const auto shown = [&](double x) { return length ? fmt::format("{:.4f} mm", 1e3 * x) : fmt::format("{:.5f}", x); };
    text += fmt::format("  {:24} {:>14} {:>14} {:>10}\n", m.name, shown(m.value), m.measured ? shown(*m.measured) : "",
                        m.measured ? difference(m) : "");
  }
  if (s.books.gas) return text + gas_in_words(s.books);
  const Balance& b = s.books.balance;
  const double peak = s.books.peak_kinetic > 0.0 ? s.books.peak_kinetic : 1.0;
  text += fmt::format("  {:24} {:>14} {:>14}\n", "energy", unit(Extensive::energy, s.books), "of the peak");
  const auto row = [&](const char* name, double value) {
    text += fmt::format("  {:24} {:14.6g} {:12.4g} %\n", name, value, 100.0 * value / peak);
  };
  row("kinetic, peak", s.books.peak_kinetic), row("kinetic", b.kinetic),
      row("internal, change", b.internal.total - s.books.initial_internal), row("thermal, change", b.internal.thermal);
  row("plastic work", b.internal.plastic_work), row("work from outside", b.external + b.boundary), row("friction", b.friction);
  row("artificial viscosity", b.internal.viscous_work), row("transfer", b.transfer), row("filter", b.filter);
  row("heat of the filter", b.filter_heat), row("stress timing", b.stress_timing), row("outflow", b.outflow),
      row("in no book", b.residual);
  return text;
}

}  // namespace brisance::simulator
