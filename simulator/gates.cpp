#include "simulator/gates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/output/extensive.hpp"
#include "simulator/output/fields.hpp"

namespace brisance::simulator {
namespace {

template <class F>
void for_each_particle(const Simulation& s, F&& f) {
  for (const Body& body : s.bodies)
    for (int p = 0; p < body.particles.size; ++p) f(body, ParticleView(body.particles, p));
}

/// The farthest place that angular momentum is counted from, m.
double reach(const Simulation& s) {
  double farthest = 0.0;
  for (const Boundary& b : s.boundaries)  // what has left was booked there
    if (b.kind == BoundaryKind::outflow) farthest = std::max(farthest, std::abs(b.position));
  for_each_particle(s, [&](const Body&, const ParticleView& p) { farthest = std::max(farthest, magnitude(p.position())); });
  return farthest + s.grid.cell_size;
}

/// The components of a momentum along which action has to be reaction: a mirror or the axis takes what is normal to it.
Vector unmirrored(const Simulation& s, Vector momentum) {
  for (const Boundary& b : s.boundaries)
    if (b.is_mirror()) momentum[static_cast<std::size_t>(b.axis)] = 0.0;
  return momentum;
}

void check_fastest(double limit, const Simulation& s) {
  for_each_particle(s, [&](const Body& body, const ParticleView& p) {
    const double speed = magnitude(p.velocity());
    if (speed <= limit) return;
    const Vector x = p.position();
    throw GateExceeded(
        fmt::format("gate fastest: a particle of {} at ({:.6g}, {:.6g}, {:.6g}) m moves at {:.6g} m/s, {:.6g} m/s at most is "
                    "allowed; step {}, time {:.6g} s",
                    body.name, x[0], x[1], x[2], speed, limit, s.step, s.time));
  });
}

/// Sums of very many cells, each of which rounds.
template <class Require>
void check_gas(const GateConfig& limits, const GasBooks& books, const Simulation& s, const Require& require) {
  const gas::Totals residual = books.residual();
  const double wanted = limits.residual.value_or(GateConfig::usual_residual);
  // What is asked of the classic scheme is asked of its energy: mass and momentum it keeps.
  const double part = s.gas.classic ? std::min(wanted, GateConfig::usual_residual) : wanted;
  double mass = 0.0, energy = std::abs(books.state.energy) + std::abs(books.initial.energy);
  for (std::size_t r = 0; r < residual.mass.size(); ++r) mass += books.state.mass[r] + books.initial.mass[r];
  for (const auto& [name, through] : books.entries) {
    energy += std::abs(through.energy);
    for (const double m : through.mass) mass += std::abs(m);
  }
  for (const ReactionBook& reaction : books.reactions) mass += reaction.burned, energy += std::abs(reaction.made.energy);
  for (const double m : residual.mass)
    require("residual", "mass of gas that is in no book", std::abs(m), part * mass, Extensive::mass);
  if (not_gated(limits, s).empty())
    require("residual", "energy of gas that is in no book", std::abs(residual.energy), wanted * energy, Extensive::energy);
  if (is_round(s.geometry)) return;
  require("residual", "momentum of gas that is in no book", magnitude(residual.momentum), part * std::sqrt(2.0 * mass * energy),
          Extensive::momentum);
}

}  // namespace

std::string not_gated(const GateConfig& limits, const Simulation& s) {
  if (!s.gas.classic || limits.residual) return "";
  return "the energy of the gas: the classic scheme keeps it in no book; a gates.residual of 0.1, say, would watch it";
}

void check_gates(const GateConfig& limits, const Simulation& s, const Books& books) {
  const auto require = [&](std::string_view gate, std::string_view what, double value, double limit, Extensive quantity) {
    if (value <= limit) return;
    const std::string_view unit = unit_of(quantity, s.geometry).text;
    throw GateExceeded(fmt::format(
        "gate {}: {} is {:.6g} {}, {:.6g} {} at most is allowed; step {}, time {:.6g} s\nthe results up to the row of "
        "history.csv before this one met the limit, this one does not: it has gone wrong in between",
        gate, what, value, unit, limit, unit, s.step, s.time));
  };
  if (books.gas) return check_gas(limits, *books.gas, s, require);
  const Balance& b = books.balance;
  const double part = limits.residual.value_or(GateConfig::usual_residual);
  // A body at rest that is loaded has no kinetic energy to speak of, but takes up energy all the same.
  const double energy = std::max(books.peak_kinetic, std::abs(b.internal.total - books.initial_internal));
  // Energies of the particles are kept as totals: every step rounds them. Their sum is rounded another way whenever they are
  // summed in other blocks: by up to 16 units in the last place where a wall comes near to 240 to 15360 particles at rest.
  constexpr double of_the_sum = 32.0;
  const double rounding = std::numeric_limits<double>::epsilon() * std::abs(b.internal.total) *
                          (of_the_sum + std::sqrt(static_cast<double>(s.step + 1)));
  require("residual", "energy that is in no book", b.residual, part * energy + rounding, Extensive::energy);
  double momentum = std::sqrt(2.0 * (b.internal.mass + books.outflow_mass) * energy) + magnitude(books.external.momentum);
  for (const auto& [name, done] : books.boundaries) momentum += magnitude(done.momentum);
  require("residual", "momentum that is in no book", magnitude(b.momentum_residual), part * momentum, Extensive::momentum);
  require("residual", "angular momentum that is in no book", magnitude(b.angular_momentum_residual), part * momentum * reach(s),
          Extensive::angular_momentum);
  require("residual", "momentum that the way between particles and grid has made",
          magnitude(unmirrored(s, books.transfer.momentum)), part * momentum, Extensive::momentum);
  require("residual", "momentum that internal forces have made", magnitude(unmirrored(s, books.internal_force.momentum)),
          part * momentum, Extensive::momentum);
  if (limits.numerical)
    require("numerical", "energy in numerical books", std::abs(b.numerical()), *limits.numerical * energy, Extensive::energy);
  if (limits.fastest) check_fastest(*limits.fastest, s);
}

}  // namespace brisance::simulator
