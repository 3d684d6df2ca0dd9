#include "simulator/set_up_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/update.hpp"
#include "models/visit.hpp"
#include "simulator/gas/bodies_setup.hpp"
#include "simulator/gas/fill_reports.hpp"
#include "simulator/gas/foreseen_meetings.hpp"
#include "simulator/gas/initial_state.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator {
namespace {

/// Without pressure, at the density that the body starts with.
std::optional<double> melting_temperature(const Material& material, double temperature) {
  std::optional<double> result;
  visit_law(material.melting, [&](const auto& law) {
    const double density = stress_free_state(material, temperature).density;
    result = law(melting::Arguments<double>{0.0, density / material.density});
  });
  return result;
}

/// Whether a body keeps its shape and velocity until it meets something.
bool flies_freely(const Case& c, const BodyConfig& body) {
  const InitialVelocity& v = body.velocity;
  return c.gravity == Vector{} && v.rotation == Vector{} && v.radial == 0.0 && v.radial_rate == 0.0 &&
         std::none_of(c.loads.begin(), c.loads.end(), [&](const LoadConfig& load) { return load.body == body.name; });
}

/// Whether two boxes come within a margin of each other before a time; the first moves.
bool meet(const Bounds& moving, const Vector& velocity, const Bounds& box, double margin, double time, int dimensions) {
  double first = 0.0, last = time;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) {
    // The boxes overlap along this axis while `nearest` <= v t <= `farthest`.
    const double nearest = box.lower[a] - margin - moving.upper[a], farthest = box.upper[a] + margin - moving.lower[a];
    if (velocity[a] == 0.0) {
      if (nearest > 0.0 || farthest < 0.0) return false;
      continue;
    }
    const auto [enters, leaves] = std::minmax({nearest / velocity[a], farthest / velocity[a]});
    first = std::max(first, enters), last = std::min(last, leaves);
  }
  return first <= last;
}

bool meets(const Case& c, const BodyConfig& body, const BoundaryConfig& boundary) {
  const auto axis = static_cast<std::size_t>(boundary.axis);
  const Bounds extent = bounds(*body.shape);
  const double inward = boundary.side == Side::above ? 1.0 : -1.0;
  const double distance =
      boundary.side == Side::above ? extent.lower[axis] - boundary.position : boundary.position - extent.upper[axis];
  const double approach = -inward * body.velocity.translation[axis];
  if (boundary.velocity.size > 0 && boundary.kind == BoundaryKind::rigid_wall) return true;
  const bool holds_what_touches = boundary.kind == BoundaryKind::fixed || boundary.kind == BoundaryKind::velocity;
  return (holds_what_touches && distance <= c.cell_size) || (approach > 0.0 && distance - approach * c.end_time <= c.cell_size);
}

/// Only if there is no doubt: what is in doubt counts as met.
bool meets_nothing(const Case& c, const BodyConfig& body) {
  return flies_freely(c, body) &&
         std::none_of(c.boundaries.begin(), c.boundaries.end(), [&](const BoundaryConfig& b) { return meets(c, body, b); }) &&
         std::none_of(c.bodies.begin(), c.bodies.end(), [&](const BodyConfig& other) {
           return &other != &body &&
                  (!flies_freely(c, other) || meet(bounds(*body.shape), body.velocity.translation - other.velocity.translation,
                                                   bounds(*other.shape), c.cell_size, c.end_time, c.dimensions()));
         });
}

/// What has to happen before a reaction starts, if neither an ignition nor a state of the case does it.
std::optional<std::string> what_does_not_start(const Case& c, const ReactionConfig& reaction) {
  const auto lit = [&](const IgnitionConfig& i) { return i.time < c.end_time; };
  if (std::any_of(reaction.ignitions.begin(), reaction.ignitions.end(), lit)) return {};
  const FluidConfig* reactant = nullptr;
  for (const FluidConfig& fluid : c.gas->fluids)
    if (fluid.name == reaction.reactant) reactant = &fluid;
  double hottest = 0.0, highest = 0.0;  // K of the reactant, Pa of all
  const auto look = [&](const GasStateConfig& state) {
    const bool by_formula = gas::varies(state);
    highest = std::max(highest, state.pressure && !by_formula ? state.pressure->number : 1e300);
    if (state.fluid != reaction.reactant) return;
    const EquationOfState& law = reactant->material.material.equation_of_state;
    if (by_formula)
      hottest = 1e300;
    else if (state.temperature)
      hottest = std::max(hottest, state.temperature->number);
    else if (state.density && state.pressure)
      hottest = std::max(hottest, equation_of_state::temperature(law, state.density->number,
                                                                 equation_of_state::energy_at_pressure(
                                                                     law, state.density->number, state.pressure->number)));
    else
      hottest = 1e300;  // a profile
  };
  for (const FillConfig& fill : c.gas->fills) look(fill);
  for (const EdgeConfig& edge : c.gas->edges)
    if (edge.kind == EdgeKind::inflow || edge.kind == EdgeKind::pressure) look(edge);
  return std::visit(
      [&]<class Law>(const Law& law) -> std::optional<std::string> {
        if constexpr (requires { law.temperature_threshold; })
          if (hottest < law.temperature_threshold)
            return fmt::format("is at {:.4g} K at most and burns from {:.4g} K on", hottest, law.temperature_threshold);
        if constexpr (std::is_same_v<Law, reaction::JwlPlusPlus>)
          if (highest < law.pressure_threshold)
            return fmt::format("burns from {:.4g} Pa on, and no state has more than {:.4g} Pa", law.pressure_threshold,
                               highest);
        return {};
      },
      *reactant->material.material.reaction);
}

/// A temperature that was perhaps meant in degrees Celsius.
std::optional<std::string> very_cold(const std::string& name, double temperature) {
  constexpr double cold = 60.0;  // K; nitrogen boils at 77
  if (temperature >= cold) return {};
  return fmt::format("{}: it starts at {:.6g} K; degrees Celsius are given as a text, such as \"{:.6g} degC\"", name,
                     temperature, temperature);
}

}  // namespace

std::vector<std::string> set_up_warnings(const Case& c) {
  std::vector<std::string> warnings;
  for (const BodyConfig& body : c.bodies)
    if (auto cold = very_cold(body.name, body.temperature)) warnings.push_back(std::move(*cold));
  if (c.gas)
    for (const FillConfig& fill : c.gas->fills)
      if (fill.temperature && !fill.temperature->formula)
        if (auto cold = very_cold(fill.fluid, fill.temperature->number)) warnings.push_back(std::move(*cold));
  for (const BodyConfig& body : c.bodies) {
    const std::optional<double> melting = melting_temperature(body.material.material, body.temperature);
    if (melting && body.temperature >= *melting)
      warnings.push_back(
          fmt::format("{}: it starts at {:.6g} K, not below the melting temperature of {}, {:.6g} K: it has no strength",
                      body.name, body.temperature, body.material.material.name, *melting));
    const double speed = std::sqrt(dot(body.velocity.translation, body.velocity.translation));
    if (speed > 0.0 && meets_nothing(c, body))
      warnings.push_back(
          fmt::format("{}: it flies at {:.4g} m/s and meets no boundary and no other body before the end at {:.4g} s; look at "
                      "its direction and at end_time",
                      body.name, speed, c.end_time));
  }
  const auto too_many = [&](std::string_view key, double interval, std::string_view what, double most) {
    if (interval > 0.0 && c.end_time / interval > most)
      warnings.push_back(fmt::format("output.{} gives {:.3g} {}", key, c.end_time / interval, what));
  };
  too_many("snapshot_interval", c.output.snapshot_interval, "snapshots", 1e3);
  too_many("history_interval", c.output.history_interval, "rows of history.csv", 1e5);
  if (!c.gas) return warnings;
  for (std::string& warning : gas::warnings_of_fills(c)) warnings.push_back(std::move(warning));
  for (const ReactionConfig& reaction : c.gas->reactions)
    if (const auto reason = what_does_not_start(c, reaction))
      warnings.push_back(
          fmt::format("{}: {} {}; nothing lights it ([[gas.reaction.ignition]])", reaction.name, reaction.reactant, *reason));
  for (std::string& warning : gas::warnings_of_bodies(c)) warnings.push_back(std::move(warning));
  for (const gas::ForeseenMeeting& meeting : gas::foreseen_meetings(c)) warnings.push_back(in_words(meeting));
  return warnings;
}

}  // namespace brisance::simulator
