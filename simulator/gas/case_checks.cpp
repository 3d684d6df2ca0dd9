#include "simulator/gas/case_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/case_checks.hpp"
#include "simulator/gas/bodies_setup.hpp"
#include "simulator/gas/classic.hpp"
#include "simulator/gas/cut_cells.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/gas/initial_state.hpp"
#include "simulator/gas/reaction.hpp"
#include "simulator/gas/transport.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator::gas {
namespace {

std::size_t dimensions_of(const Case& c) {
  return static_cast<std::size_t>(c.dimensions());
}

constexpr double least_cells = 4.0;  // across the box

/// Whether geometry and box are known.
bool box_known(const TableReader& in) {
  return in.valid_in_file({"geometry", "cell_size", "gas.lower", "gas.upper"});
}
/// Whether the box is one; check_gas says so if not.
bool holds_cells(const TableReader& in, const Case& c) {
  if (!box_known(in)) return false;
  for (std::size_t a = 0; a < dimensions_of(c); ++a)
    if (!(c.gas->upper[a] - c.gas->lower[a] > (least_cells - 0.5) * c.cell_size)) return false;
  return true;
}

/// Whether names of fluids can be looked up.
bool fluids_named(const Case& c) {
  return !c.gas->fluids.empty() &&
         std::none_of(c.gas->fluids.begin(), c.gas->fluids.end(), [](const FluidConfig& fluid) { return fluid.name.empty(); });
}
/// Whether a key is valid in all tables of a list within [gas].
bool valid_in_all(const TableReader& in, std::string_view list, std::size_t count, std::string_view key) {
  for (std::size_t n = 0; n < count; ++n)
    if (!in.valid_in_file({fmt::format("gas.{}.{}.{}", list, n, key)})) return false;
  return true;
}
/// The fluid of this name; null if there is none, or if its material is wrong.
const FluidConfig* find_fluid(const TableReader& in, const Case& c, std::string_view name) {
  for (std::size_t n = 0; n < c.gas->fluids.size(); ++n)
    if (c.gas->fluids[n].name == name)
      return in.valid_in_file({fmt::format("gas.fluid.{}.material", n)}) ? &c.gas->fluids[n] : nullptr;
  return nullptr;
}

std::string why_not(const FluidConfig& fluid, double pressure, std::optional<double> density,
                    std::optional<double> temperature) {
  return why_no_state(fluid.name, fluid.material.material.equation_of_state, pressure, density, temperature);
}
std::optional<double> number_of(const std::optional<Varying>& value) {
  return value ? std::optional(value->number) : std::nullopt;
}

/// Where else density and pressure come from; empty: nowhere.
struct Elsewhere {
  std::string density, pressure;
  bool needs_density = false;  // what stands in the place of the pressure cannot do with a temperature
};

/// The fluid of a state: the only one if none is named.
template <class State>
void check_fluid_of(TableReader& in, State& state, const Case& c) {
  if (state.fluid.empty() && c.gas->fluids.size() == 1) {
    state.fluid = c.gas->fluids.front().name;
  } else if (in.valid({"fluid"}) && fluids_named(c)) {
    std::vector<std::string_view> names;
    for (const FluidConfig& fluid : c.gas->fluids) names.push_back(fluid.name);
    if (state.fluid.empty())
      in.problem("which fluid it is is unknown; give `fluid`, " + listed(names));
    else if (std::find(names.begin(), names.end(), state.fluid) == names.end())
      in.problem("fluid", "there is no fluid " + in_quotes(state.fluid) + "; there is " + listed(names) +
                              did_you_mean(state.fluid, names));
  }
}

/// Words that a density and a temperature say the same.
constexpr const char* two_densities = "there are a density and a temperature; give one of the two";

/// A state that the fluid does not have.
template <class State>
void check_existence(TableReader& in, const State& state, const Case& c) {
  if (state.density.has_value() == state.temperature.has_value() || !state.pressure || varies(state)) return;
  const FluidConfig* fluid = find_fluid(in, c, state.fluid);
  if (!fluid || !in.valid({"density", "temperature", "pressure"})) return;
  const std::string why = why_not(*fluid, state.pressure->number, number_of(state.density), number_of(state.temperature));
  if (!why.empty()) in.problem("pressure", why);
}

template <class State>
void check_gas_state(TableReader& in, State& state, const Case& c, const Elsewhere& elsewhere = {}) {
  check_fluid_of(in, state, c);
  // In a fill an energy may stand in the place of the pressure.
  const bool may_be_energy = std::is_same_v<State, FillConfig>, no_pressure = !in.has("pressure") && elsewhere.pressure.empty();
  if (no_pressure && state.density && state.temperature && may_be_energy && elsewhere.density.empty())
    return in.problem(
        "there are a density and a temperature; give one of the two and a pressure, or the density and an energy");
  if (no_pressure)
    in.problem("pressure", fmt::format("missing: the pressure of the gas{}",
                                       may_be_energy ? ", or instead of it the density and an energy" : ""));
  if (in.has("pressure") && !elsewhere.pressure.empty())
    in.problem("pressure", "it follows from " + elsewhere.pressure + "; give one of the two");
  if (elsewhere.needs_density && !in.has("density"))
    in.problem("density", fmt::format("missing: {} needs it{}", elsewhere.pressure,
                                      in.has("temperature") ? ", instead of the temperature" : ""));
  else if (!elsewhere.density.empty()) {
    if (state.density || state.temperature)
      in.problem(state.density ? "density" : "temperature", "the density is in " + elsewhere.density + "; give one of the two");
  } else if (state.density.has_value() == state.temperature.has_value())
    in.problem(state.density ? two_densities : "neither density nor temperature is given; give one of the two");
  else
    check_existence(in, state, c);
}

/// The profile of a fill; nothing if it cannot be read.
std::optional<StateProfile> check_profile(TableReader& in, const ProfileConfig& profile, const Case& c, Elsewhere& elsewhere) {
  const auto unknown = [&]() -> std::optional<StateProfile> {  // what may stand in it is not missing
    if (!in.has("pressure")) elsewhere.pressure = "the profile";
    if (!in.has("density") && !in.has("temperature")) elsewhere.density = "the profile";
    return {};
  };
  if (!in.valid({"profile"})) return unknown();
  const bool radius = profile.along == ProfileAlong::radius;
  if (geometry_known(in) && !radius && static_cast<std::size_t>(profile.along) >= dimensions_of(c))
    in.problem("profile", fmt::format("there is no {} in this geometry; give a coordinate that it has, or radius",
                                      choices<ProfileAlong>[static_cast<std::size_t>(profile.along)]));
  if (!radius && profile.centre != Vector{}) in.problem("profile", "its centre would be ignored: it is not along radius");
  if (geometry_known(in) && is_round(c.geometry) && profile.centre[0] != 0.0)
    in.problem("profile", "its centre lies on the axis; give x = 0");
  try {
    const StateProfile read = read_state_profile(profile);
    if (geometry_known(in) && !read.velocity_around.empty() && !(radius && c.geometry == Geometry::plane))
      in.problem("profile", "velocity_around needs the plane geometry and along = \"radius\"");
    if (!read.density.empty()) elsewhere.density = "the profile";
    if (!read.pressure.empty()) elsewhere.pressure = "the profile";
    return read;
  } catch (const InputError& error) {
    in.problem_of_file("profile", error.problems());
    return unknown();
  }
}

/// The first row of a profile that makes a state which the fluid does not have.
void check_rows(TableReader& in, const FillConfig& fill, const StateProfile& profile, const Case& c) {
  const FluidConfig* fluid = find_fluid(in, c, fill.fluid);
  if (!fluid || !in.valid({"density", "temperature", "pressure"}) || (profile.pressure.empty() && !fill.pressure) ||
      (profile.density.empty() && fill.density.has_value() == fill.temperature.has_value()))
    return;
  for (std::size_t row = 0; row < profile.place.size(); ++row) {
    const double pressure = profile.pressure.empty() ? fill.pressure->number : profile.pressure[row];
    const std::optional<double> density = profile.density.empty() ? number_of(fill.density) : profile.density[row];
    const std::string why = why_not(*fluid, pressure, density, number_of(fill.temperature));
    if (why.empty()) continue;
    in.problem("profile", fmt::format("row {}, at {:.6g} m: {}", row + 1, profile.place[row], why));
    return;
  }
}

/// Nothing is said of viscosity and heat that would go unheard.
void check_transport(TableReader& in, const GasConfig& gas) {
  const auto any_fluid = [&](double FluidConfig::*property) {
    return std::any_of(gas.fluids.begin(), gas.fluids.end(), [&](const FluidConfig& f) { return f.*property > 0.0; });
  };
  if (gas.heat_exchange > 0.0 && gas.fluids.size() == 1)
    in.problem("heat_exchange", "it would be ignored: there is one fluid; remove it");
  const bool viscosities_known = valid_in_all(in, "fluid", gas.fluids.size(), "viscosity");
  const bool conductivities_known = valid_in_all(in, "fluid", gas.fluids.size(), "conductivity");
  for (const EdgeConfig& edge : gas.edges) {
    if (edge.kind != EdgeKind::no_slip) continue;
    const std::string_view side = choices<BoxSide>[static_cast<std::size_t>(edge.side)];
    if (viscosities_known && !any_fluid(&FluidConfig::viscosity))
      in.problem("edge",
                 fmt::format("{}: nothing sticks to a wall without viscosity; give a fluid one, or leave the edge out", side));
    if (edge.temperature && conductivities_known && !any_fluid(&FluidConfig::conductivity))
      in.problem("edge", fmt::format("{}: its temperature would be ignored: no fluid conducts; give one a conductivity", side));
  }
}

/// The box begins and ends on planes of nodes, and holds some cells.
void check_box(TableReader& in, const Case& c) {
  const GasConfig& gas = *c.gas;
  for (std::size_t k = 0, count = box_known(in) ? dimensions_of(c) : 0; k < count; ++k) {
    if (!(gas.lower[k] < gas.upper[k]))
      in.problem("upper", fmt::format("along {} the box ends before it begins", axis_names[k]));
    const double across = (gas.upper[k] - gas.lower[k]) / c.cell_size;
    if (across < least_cells - round_off) {
      in.problem("upper", fmt::format("along {} the box is {:.3g} cells of {} wide; {:g} at least", axis_names[k], across,
                                      in_metres(c.cell_size), least_cells));
      continue;
    }
    for (const auto& [name, corner] : {std::pair{"lower", gas.lower[k]}, std::pair{"upper", gas.upper[k]}}) {
      const double cells = corner / c.cell_size;
      if (std::abs(cells - std::round(cells)) > round_off * std::max(1.0, std::abs(cells)))
        in.problem(name, fmt::format("along {} {} is on no plane of nodes; the nearest are {} and {}", axis_names[k],
                                     in_metres(corner), in_metres(std::floor(cells) * c.cell_size),
                                     in_metres(std::ceil(cells) * c.cell_size)));
    }
  }
}

/// Nothing is said of the length of steps that would go unheard.
void check_step(TableReader& in, const GasConfig& gas) {
  if (gas.acoustic_courant != GasConfig{}.acoustic_courant && in.valid({"implicit"}) && !gas.implicit)
    in.problem("acoustic_courant", "it would be ignored: it is the Courant number of implicit = true");
  if (gas.courant != 0.0 && gas.implicit)
    in.problem("courant", "it would be ignored: the steps of implicit = true are those of acoustic_courant");
  if (gas.momentum_exchange != GasConfig{}.momentum_exchange && in.valid({"scheme"}) && gas.scheme != GasScheme::ice_classic)
    in.problem("momentum_exchange",
               "it would be ignored: fluids of a cell have one velocity but with scheme = \"ice_classic\"");
}

/// What sides ask of each other, and of the geometry.
void check_edges_together(TableReader& in, const Case& c) {
  const GasConfig& gas = *c.gas;
  const bool round = is_round(c.geometry);
  for (const EdgeConfig& edge : gas.edges) {
    const auto number = static_cast<std::size_t>(edge.side);
    const auto opposite = static_cast<BoxSide>(number ^ 1);
    const bool both = std::any_of(gas.edges.begin(), gas.edges.end(), [&](const EdgeConfig& other) {
      return other.side == opposite && other.kind == EdgeKind::periodic;
    });
    if (edge.kind == EdgeKind::periodic && !both)
      in.problem("edge",
                 fmt::format("{} is periodic, {} is not; give both", choices<BoxSide>[number], choices<BoxSide>[number ^ 1]));
    if (edge.kind == EdgeKind::periodic && round && number < 2) in.problem("edge", "along the radius x nothing is periodic");
    if (round && edge.side == BoxSide::low_x && gas.lower[0] == 0.0 && edge.kind != EdgeKind::wall)
      in.problem("edge", "low_x is the axis; it can be nothing else");
  }
}

/// The limits of simulator/gas/bodies.hpp.
void check_with_bodies(TableReader& in, const Case& c) {
  const GasConfig& gas = *c.gas;
  const auto refuse = [&](bool when, std::string_view what) {
    if (when) in.problem("body", std::string(what) + " in a gas with bodies is not possible; remove one of the two");
  };
  refuse(gas.implicit, "the implicit option");
  refuse(gas.scheme == GasScheme::ice_classic, "the classic scheme");
  const auto at_a_surface = [&](const ReactionConfig& reaction) {
    const FluidConfig* reactant = find_fluid(in, c, reaction.reactant);
    const auto* law = reactant ? &reactant->material.material.reaction : nullptr;
    return law && law->has_value() && has_surface(**law);
  };
  refuse(std::any_of(gas.reactions.begin(), gas.reactions.end(), at_a_surface), "a reaction at a surface");
  refuse(gas.heat_exchange > 0.0 || has_transport(gas.fluids), "viscosity or conduction");
  if (!geometry_known(in) || !(c.cell_size > 0.0) || c.dimensions() == 1) return;
  Case drawn = c;  // with the bodies alone whose shapes are known
  std::erase_if(drawn.gas->bodies, [](const GasBodyConfig& body) { return !body.shape; });
  for (const std::string& fault : overlaps_of_bodies(drawn)) in.problem("body", fault);
  if (!holds_cells(in, c) || !valid_in_all(in, "edge", gas.edges.size(), "kind")) return;
  for (const std::string& fault : bodies_that_do_not_show(drawn)) in.problem("body", fault);
}

/// The limits of classic.hpp.
void check_classic(TableReader& in, const Case& c) {
  const ClassicDemands demands = demands_of(*c.gas, c.geometry, c.gravity, !c.gas->reactions.empty());
  for (const std::string& reason : classic_limits(demands)) in.problem("scheme", reason);
}

bool is_zero(const VaryingVector& velocity) {
  return !velocity.varies() && velocity.numbers() == Vector{};
}

/// Of what a state is, as far as it is valid: no fluid where only values can be judged.
std::optional<Fluid> fluid_of_state(const TableReader& in, const GasStateConfig& state, const Case& c) {
  const FluidConfig* fluid = find_fluid(in, c, state.fluid);
  const bool complete = state.pressure && state.density.has_value() != state.temperature.has_value() &&
                        in.valid({"density", "temperature", "pressure"});
  return fluid && complete ? std::optional(Fluid{fluid->name, fluid->material.material.equation_of_state}) : std::nullopt;
}
/// Cells of a lattice, the last ones exclusive; no number of cells is too large for a double.
struct CellRange {
  std::array<double, 3> first{0.0, 0.0, 0.0}, last{1.0, 1.0, 1.0};
};
/// The cells of the box; nothing if it is wrong, which is reported elsewhere.
std::optional<CellRange> cells_of_box(const TableReader& in, const Case& c) {
  if (!box_known(in)) return {};
  CellRange cells;
  for (std::size_t a = 0; a < dimensions_of(c); ++a) {
    if (!(c.gas->lower[a] < c.gas->upper[a])) return {};
    cells.first[a] = std::round(c.gas->lower[a] / c.cell_size), cells.last[a] = std::round(c.gas->upper[a] / c.cell_size);
  }
  return cells;
}

/// Reports of each key the first place of some, in the middles of cells, where its formula makes no state at a time (s). Of
/// very many cells it looks at some alone. Returns whether there is one.
bool check_formulas_at(TableReader& in, const GasStateConfig& state, bool pressure_alone, const Case& c, const CellRange& cells,
                       const Shape* shape, double time = 0.0, double most_places = 1e5) {
  const auto& [first, last] = cells;
  const std::optional<Fluid> fluid = pressure_alone ? std::nullopt : fluid_of_state(in, state, c);
  std::vector<std::string> refused;
  const auto refuse = [&](const std::string& key, const std::string& what) {
    if (std::find(refused.begin(), refused.end(), key) != refused.end()) return;
    in.problem(key, what);
    refused.push_back(key);
  };
  std::array<double, 3> step{1.0, 1.0, 1.0};  // cells
  const double dimensions = c.dimensions();
  for (std::size_t a = 0; a < dimensions_of(c); ++a)
    step[a] = std::max(1.0, std::floor((last[a] - first[a]) / std::pow(most_places, 1.0 / dimensions)));
  for (double k = first[2]; k < last[2]; k += step[2])
    for (double j = first[1]; j < last[1]; j += step[1])
      for (double i = first[0]; i < last[0]; i += step[0]) {
        Vector x{};
        const std::array<double, 3> index{i, j, k};
        for (std::size_t a = 0; a < dimensions_of(c); ++a) x[a] = (index[a] + 0.5) * c.cell_size;
        if (shape && !contains(*shape, x)) continue;
        static_cast<void>(values_at(state, pressure_alone, x, time, c.dimensions(), refuse));
        if (!fluid || !refused.empty()) continue;
        try {
          static_cast<void>(state_at(state, 0, &*fluid, x, time, c.dimensions()));
        } catch (const FormulaError& error) {
          refuse(error.key, error.what());
        }
      }
  return !refused.empty();
}
void check_formulas(TableReader& in, const FillConfig& fill, const Case& c) {
  if (!varies(fill) || fill.profile || fill.energy) return;
  if (const std::optional<CellRange> box = cells_of_box(in, c)) check_formulas_at(in, fill, false, c, *box, fill.shape.get());
}
void check_formulas(TableReader& in, const EdgeConfig& edge, const Case& c) {
  const std::size_t axis = static_cast<std::size_t>(edge.side) / 2;
  std::optional<CellRange> beyond = cells_of_box(in, c);
  if (!varies(edge) || !beyond || axis >= dimensions_of(c)) return;
  const double depth = c.gas->bodies.empty() ? ring : Window::depth;  // with bodies their neighbourhoods reach farther
  const bool pressure_alone = in.valid({"kind"}) && edge.kind == EdgeKind::pressure;
  if (static_cast<std::size_t>(edge.side) % 2 == 0)
    beyond->last[axis] = beyond->first[axis], beyond->first[axis] -= depth;
  else
    beyond->first[axis] = beyond->last[axis], beyond->last[axis] += depth;
  if (check_formulas_at(in, edge, pressure_alone, c, *beyond, nullptr)) return;
  // A formula that is fine at these times may still fail between them, and ends the run then.
  constexpr int times = 100;
  constexpr double places = 1000.0;  // so that all of it takes a part of a second
  for (int n = 1; n <= times; ++n)
    if (check_formulas_at(in, edge, pressure_alone, c, *beyond, nullptr, c.end_time * n / times, places)) return;
}

}  // namespace

void check(TableReader& in, FluidConfig& fluid, const std::vector<FluidConfig>& others, const Case&) {
  require_own_name(in, fluid, others);
  if (in.valid({"material"}) &&
      equation_of_state::caloric(fluid.material.material.equation_of_state) == equation_of_state::Caloric::incremental)
    in.problem("material", "its equation of state gives differences of pressure only; a fluid needs p(rho, e)");
}

void check(TableReader& in, FillConfig& fill, const std::vector<FillConfig>& others, const Case& c) {
  Elsewhere elsewhere;
  std::optional<StateProfile> profile;
  if (fill.profile) profile = check_profile(in, *fill.profile, c, elsewhere);
  if (fill.energy) {
    if (!elsewhere.pressure.empty()) in.problem("energy", "the pressure is in the profile; give one of the two");
    if (!in.has("shape")) in.problem("shape", "missing: the region that the energy is put into");
    if (varies(fill)) in.problem("energy", "it is spread over one state; a formula cannot be beside it");
    elsewhere.pressure = "the energy", elsewhere.needs_density = true;
  }
  if (profile && varies(fill)) in.problem("profile", "a state varies by a profile or by formulas; give one of the two");
  check_gas_state(in, fill, c, elsewhere);
  if (in.valid({"shape"})) check_formulas(in, fill, c);
  if (profile && !fill.energy && !varies(fill)) check_rows(in, fill, *profile, c);
  if (others.empty() && in.has("shape")) in.problem("shape", "the first [[gas.fill]] fills all of the box; leave it out");
  if (!others.empty() && !in.has("shape") && !fill.energy)
    in.problem(
        "without a `shape` it fills all of the box, and nothing is left of those before it; give it one, or put it first");
  if (fill.shape && holds_cells(in, c) &&
      !may_fill(*fill.shape, c.dimensions(), {c.gas->lower, c.gas->upper}, c.cell_size / places_per_direction(c.dimensions())))
    in.problem("shape",
               fmt::format("it fills nothing: no part of it lies in the box of the gas, from ({:.6g}) to ({:.6g}) m, or it "
                           "is too small for cells of {}; move it, make it larger, or take smaller cells",
                           fmt::join(std::span(c.gas->lower).first(dimensions_of(c)), ", "),
                           fmt::join(std::span(c.gas->upper).first(dimensions_of(c)), ", "), in_metres(c.cell_size)));
}

void check(TableReader& in, EdgeConfig& edge, const std::vector<EdgeConfig>& others, const Case& c) {
  const bool side_known = in.valid({"side"});
  bool taken = false;
  for (std::size_t n = 0; n < others.size(); ++n)
    taken = taken || (others[n].side == edge.side && in.valid_in_file({fmt::format("gas.edge.{}.side", n)}));
  if (side_known && taken) in.problem("side", "this side is given twice; give each once");
  if (side_known && geometry_known(in) && static_cast<std::size_t>(edge.side) / 2 >= dimensions_of(c))
    in.problem("side", fmt::format("in {} dimension{} there is no such side", c.dimensions(), c.dimensions() == 1 ? "" : "s"));
  if (!in.valid({"kind"})) {  // what is wrong whatever the kind is meant to be
    if (in.has("fluid") || c.gas->fluids.size() == 1) check_fluid_of(in, edge, c);
    if (edge.density && edge.temperature) in.problem(two_densities);
    check_existence(in, edge, c);
    if (side_known) check_formulas(in, edge, c);
    return;
  }
  // A velocity of zero says nothing: a case that a run has written holds one at every edge.
  const bool more = in.has("density") || in.has("temperature") || !is_zero(edge.velocity) || in.has("fluid");
  if (edge.kind == EdgeKind::inflow || edge.kind == EdgeKind::non_reflecting) {
    check_gas_state(in, edge, c);
  } else if (edge.kind == EdgeKind::pressure) {
    if (!in.has("pressure")) in.problem("pressure", "missing: the pressure beyond");
    if (edge.pressure && edge.pressure->number < 0.0)
      in.problem("pressure", fmt::format("{:.6g} Pa; nothing outside pulls; it must be non-negative", edge.pressure->number));
    if (more) in.problem("only the pressure counts beyond an edge of this kind; remove the rest, or make it non_reflecting");
  } else if (edge.kind == EdgeKind::no_slip) {
    if (in.has("pressure") || in.has("density") || in.has("fluid"))
      in.problem("of a wall only its velocity and temperature count; remove the rest");
    if (varies(edge)) in.problem("a formula would be ignored: a wall keeps its velocity and temperature; give numbers");
    if (side_known && edge.velocity.numbers()[static_cast<std::size_t>(edge.side) / 2] != 0.0)
      in.problem("velocity", "a wall moves along itself only; make the component across it 0");
  } else if (more || in.has("pressure")) {
    in.problem("a state would be ignored: nothing comes through a wall or from beyond a period");
  }
  const bool is_judged =
      edge.kind == EdgeKind::inflow || edge.kind == EdgeKind::non_reflecting || edge.kind == EdgeKind::pressure;
  if (side_known && is_judged) check_formulas(in, edge, c);
}

void check(TableReader&, IgnitionConfig&, const std::vector<IgnitionConfig>&, const Case&) {}

void check(TableReader& in, ReactionConfig& reaction, const std::vector<ReactionConfig>& others, const Case& c) {
  require_own_name(in, reaction, others);
  std::vector<std::string_view> names;
  for (const FluidConfig& fluid : c.gas->fluids) names.push_back(fluid.name);
  for (const auto& [key, name] : {std::pair{"reactant", reaction.reactant}, {"product", reaction.product}})
    if (!name.empty() && fluids_named(c) && std::find(names.begin(), names.end(), name) == names.end())
      in.problem(key, "there is no fluid " + in_quotes(name) + "; there is " + listed(names) + did_you_mean(name, names));
  const FluidConfig* reactant = find_fluid(in, c, reaction.reactant);
  if (!reaction.product.empty() && reaction.reactant == reaction.product)
    in.problem("product", "a fluid cannot burn to itself; name another fluid");
  const auto burns_too = [&](const ReactionConfig& other) {
    return !other.reactant.empty() && other.reactant == reaction.reactant;
  };
  if (std::any_of(others.begin(), others.end(), burns_too))
    in.problem("reactant", in_quotes(reaction.reactant) + " burns in another [[gas.reaction]] already; each fluid has one law");
  if (!reactant) return;
  const std::optional<Reaction>& law = reactant->material.material.reaction;
  if (!law)
    return in.problem("reactant", "the material of " + in_quotes(reactant->name) +
                                      " has no [reaction] table, so how it burns is unknown; give it one");
  if (std::holds_alternative<reaction::JwlPlusPlus>(*law) && !reaction.ignitions.empty())
    in.problem("ignition",
               "it would be ignored: jwl_plus_plus burns by pressure alone; start it by a [[gas.fill]] of product "
               "at high pressure");
  if (!std::holds_alternative<reaction::ProgramBurn>(*law)) return;
  for (const IgnitionConfig& ignition : reaction.ignitions)
    if (ignition.shape && !distance(*ignition.shape, {}))
      in.problem("ignition",
                 "a programmed detonation starts from boxes, spheres and unions of them; distances to other shapes "
                 "are not known");
}

void check(TableReader& in, GasBodyConfig& body, const std::vector<GasBodyConfig>& others, const Case& c) {
  require_own_name(in, body, others);
  require_file_name(in, body.name);
  if (!geometry_known(in)) return;
  if (c.dimensions() == 1) return in.problem("in one dimension there are no bodies in the gas; take plane");
  if (in.valid({"axis"})) require_component_in_geometry(in, body.axis, c);
  const bool round = is_round(c.geometry);
  const bool motion_known = in.valid({"velocity", "rotation", "radial_velocity"});
  if (body.mass) {
    if (body.velocity != Vector{} || body.rotation != Vector{} || body.radial_velocity != 0.0 || body.amplitude)
      in.problem("mass", "the gas drives a body with a mass from rest: a motion would be ignored; remove one of the two");
    if (round && in.valid({"axis"}) && body.axis != Axis::y)
      in.problem("axis", "about an axis of symmetry a body can only move along it: y");
  } else {
    if (body.axis != Axis::x) in.problem("axis", "it would be ignored: only a body with a mass is driven along it");
    const bool turns = body.rotation != Vector{} || body.radial_velocity != 0.0;
    if (motion_known && body.centre != Vector{} && !turns)
      in.problem("centre", "it would be ignored: the body neither turns nor grows");
    if (motion_known && body.amplitude && !turns && body.velocity == Vector{})
      in.problem("amplitude", "it would be ignored: there is no velocity that it is a factor on");
    if (round && body.velocity[0] != 0.0) in.problem("velocity", "about an axis of symmetry a body can only move along it");
    if (round && body.rotation != Vector{}) in.problem("rotation", "about an axis of symmetry a body cannot turn");
    if (!round && c.dimensions() == 2 && (body.rotation[0] != 0.0 || body.rotation[1] != 0.0))
      in.problem("rotation", "in the plane a body can only turn about z; give [0, 0, ...]");
  }
  if (round && body.radial_velocity != 0.0 && body.centre[0] != 0.0)
    in.problem("centre", "about an axis of symmetry the centre of a radial motion lies on it: x = 0");
  if (in.valid({"radial_velocity", "radius"}) && (body.radial_velocity != 0.0) != (body.radius > 0.0))
    in.problem(body.radius > 0.0 ? "radius" : "radial_velocity", body.radius > 0.0
                                                                     ? "it would be ignored: there is no radial velocity"
                                                                     : "give `radius` as well: where it is so");
}

void check_gas(TableReader& in, const Case& c) {
  const GasConfig& gas = *c.gas;
  check_box(in, c);
  check_step(in, gas);
  check_transport(in, gas);
  if (!geometry_known(in)) return;
  if (gas.scheme == GasScheme::ice_classic) check_classic(in, c);
  if (is_round(c.geometry) && gas.lower[0] < 0.0)
    in.problem("lower", "x = " + in_metres(gas.lower[0]) + "; a radius is not negative");
  if (is_round(c.geometry) && c.gravity[0] != 0.0) in.problem("lower", "gravity along the radius x is not possible");
  if (!gas.bodies.empty()) check_with_bodies(in, c);
  if (valid_in_all(in, "edge", gas.edges.size(), "side") && valid_in_all(in, "edge", gas.edges.size(), "kind"))
    check_edges_together(in, c);
}

void check_gauge(TableReader& in, GaugeConfig& gauge, const Case& c) {
  const bool kind_known = in.valid({"kind"});
  if (kind_known && gauge.kind != GaugeKind::point && gauge.kind != GaugeKind::line)
    in.problem("kind", "in gas a gauge is a point or a line");
  if (gauge.moves.value_or(false)) in.problem("moves", "in gas a gauge stands still");
  if (!gauge.body.empty()) in.problem("body", "it would be ignored: in gas a gauge watches the gas alone");
  gauge.moves = false;
  check_fields(in, gauge.fields, c);
  check_in_box(in, gauge.from, kind_known && gauge.kind == GaugeKind::line ? gauge.to : gauge.from, c);
}

void check_fields(TableReader& in, const std::vector<std::string>& wanted, const Case& c, std::string_view key) {
  if (!fluids_named(c)) return;
  std::vector<std::string> fluids, names;
  for (const FluidConfig& fluid : c.gas->fluids) fluids.push_back(fluid.name);
  for (const Field& field : fields(c.dimensions(), fluids)) names.push_back(field.name);
  require_words(in, key, wanted, std::vector<std::string_view>(names.begin(), names.end()), "is not known of gas");
}

void check_in_box(TableReader& in, const Vector& from, const Vector& to, const Case& c) {
  if (!in.valid_in_file({"geometry", "gas.lower", "gas.upper"}) || !in.valid({"from", "to"})) return;
  for (std::size_t k = 0; k < dimensions_of(c); ++k)
    for (const auto& [key, place] : {std::pair{"from", from[k]}, {"to", to[k]}})
      if (c.gas->lower[k] < c.gas->upper[k] && (place < c.gas->lower[k] || place > c.gas->upper[k]))
        return in.problem(key, fmt::format("along {} {} is outside the box of the gas, which goes from {} to {}", axis_names[k],
                                           in_metres(place), in_metres(c.gas->lower[k]), in_metres(c.gas->upper[k])));
}

}  // namespace brisance::simulator::gas
