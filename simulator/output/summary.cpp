#include "simulator/output/summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "models/programs/files.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/output/json.hpp"

namespace brisance::simulator {
namespace {

std::string in_words(const GasBooks& books) {
  std::string text = fmt::format("  {:24} {:>14} {:>14}\n", "gas", "mass [kg]", "energy [J]");
  const auto row = [&](const std::string& name, const gas::Totals& t) {
    double mass = 0.0;
    for (const double m : t.mass) mass += m;
    text += fmt::format("  {:24} {:14.6g} {:14.6g}\n", name, mass, t.energy);
  };
  row("at the start", books.initial), row("now", books.state);
  for (const auto& [name, through] : books.entries)
    if (through.energy != 0.0) row("by " + name, through);
  row("in no book", books.residual());
  if (!books.bodies.empty())
    text += fmt::format("  {:24} {:>14} {:>14} {:>14}\n", "body", "force [N]", "work [J]", "moved [m]");
  for (const GasBodyBooks& body : books.bodies)
    text += fmt::format("  {:24} {:14.6g} {:14.6g} {:14.6g}\n", body.name, magnitude(body.force), body.work,
                        magnitude(body.displacement));
  return text;
}

}  // namespace

void write_summary(const Summary& s, const std::filesystem::path& path) {
  Json measures = Json::object(), comparison = Json::object(), energy = Json::object(), versions = Json::object();
  for (const MeasuredValue& m : s.measures) {
    measures.set(m.name, m.value);
    if (m.measured) comparison.set(m.name, Json::object().set("measured", *m.measured).set("deviation", *m.deviation()));
  }
  for (const BookEntry& entry : entries_of(s.books)) energy.set(entry.name, entry.value);
  if (!s.books.gas)
    energy.set("initial_internal_energy", s.books.initial_internal).set("peak_kinetic_energy", s.books.peak_kinetic);
  if (!s.books.gas)
    energy.set("numerical_over_peak_kinetic",
               s.books.peak_kinetic > 0.0 ? s.books.balance.numerical() / s.books.peak_kinetic : 0.0);
  versions.set("brisance", BRISANCE_VERSION).set("compiler", __VERSION__).set("hdf5", hdf5_version());
  versions.set("instruction_set", BRISANCE_INSTRUCTION_SET);
  Json all = Json::object();
  all.set("title", s.title).set("ending", s.ending).set("message", s.message).set("time", s.time).set("steps", s.steps);
  const std::string points = s.books.gas ? "cell" : "particle";
  all.set(points + "s", s.particles).set("measures", measures).set("comparison", comparison).set("energy", energy);
  all.set("wall_time", s.wall_time).set(points + "_steps_per_second", s.particle_steps_per_second).set("threads", s.threads);
  replace_file_by_text(path, all.set("versions", versions).text());
}

std::string in_words(const Summary& s) {
  std::string text = fmt::format("{}: {}{}{}\n  time {:.6g} s, {} steps, {} {}, {:.2f} s on the clock\n", s.title, s.ending,
                                 s.message.empty() ? "" : ": ", s.message, s.time, s.steps, s.particles,
                                 s.books.gas ? "cells" : "particles", s.wall_time);
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
  if (s.books.gas) return text + in_words(*s.books.gas);
  const Balance& b = s.books.balance;
  const double peak = s.books.peak_kinetic > 0.0 ? s.books.peak_kinetic : 1.0;
  text += fmt::format("  {:24} {:>14} {:>14}\n", "energy", "J", "of the peak");
  const auto row = [&](const char* name, double value) {
    text += fmt::format("  {:24} {:14.6g} {:12.4g} %\n", name, value, 100.0 * value / peak);
  };
  row("kinetic, peak", s.books.peak_kinetic), row("kinetic", b.kinetic),
      row("internal, change", b.internal.total - s.books.initial_internal), row("thermal, change", b.internal.thermal);
  row("plastic work", b.internal.plastic_work), row("work from outside", b.external + b.boundary), row("friction", b.friction);
  row("artificial viscosity", b.internal.viscous_work), row("transfer", b.transfer), row("filter", b.filter);
  row("stress timing", b.stress_timing), row("outflow", b.outflow), row("in no book", b.residual);
  return text;
}

}  // namespace brisance::simulator
