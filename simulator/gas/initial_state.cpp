#include "simulator/gas/initial_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/input/csv.hpp"
#include "models/input/diagnostics.hpp"
#include "models/input/units.hpp"
#include "models/interpolate.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/solid/shapes.hpp"
#include "simulator/step_failure.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Volume of the part of a cell between two values of x, over what a part of a straight cell has.
double widened(Geometry geometry, double low, double high) {
  const double middle = 0.5 * (low + high);
  if (!is_round(geometry)) return 1.0;
  return geometry == Geometry::spherical_1d ? middle * middle + (high - low) * (high - low) / 12.0 : middle;
}

}  // namespace

int number_of(const GasConfig& config, const std::string& fluid) {
  int number = 0;
  while (config.fluids[static_cast<std::size_t>(number)].name != fluid) ++number;
  return number;
}

Filling filling_of(const GasConfig& config, const std::vector<Fluid>& fluids, const GasStateConfig& state) {
  Filling filling;
  filling.fluid = number_of(config, state.fluid);
  const auto number = [](const std::optional<Varying>& value) { return value ? value->number : 0.0; };
  const auto is_number = [](const std::optional<Varying>& value) { return value && !value->formula; };
  filling.pressure = number(state.pressure), filling.velocity = state.velocity.numbers();
  filling.temperature = number(state.temperature), filling.density = number(state.density);
  if (is_number(state.temperature) && is_number(state.pressure))
    filling.density = equation_of_state::density_at(fluids[static_cast<std::size_t>(filling.fluid)].equation_of_state,
                                                    filling.pressure, filling.temperature);
  return filling;
}

bool varies(const GasStateConfig& state) {
  const auto by_formula = [](const std::optional<Varying>& value) { return value && value->formula; };
  return by_formula(state.density) || by_formula(state.pressure) || by_formula(state.temperature) || state.velocity.varies();
}

std::string why_no_state(const std::string& fluid, const EquationOfState& law, double pressure, std::optional<double> given,
                         std::optional<double> temperature) {
  namespace eos = equation_of_state;
  if (eos::caloric(law) != eos::Caloric::complete) return "";
  const double density = given ? *given : eos::density_at(law, pressure, *temperature);
  if (!(density > 0.0))
    return fmt::format("{} has no state with {:.6g} Pa and {:.6g} K", in_quotes(fluid), pressure, *temperature);
  const double energy = eos::energy_at_pressure(law, density, pressure), p = eos::pressure(law, density, energy);
  constexpr double close = 1e-3;
  if (!(std::abs(p - pressure) <= close * std::abs(pressure)))
    return fmt::format("at {:.6g} kg/m^3 {} has no state with {:.6g} Pa; the nearest is {:.6g} Pa", density, in_quotes(fluid),
                       pressure, p);
  if (!(eos::sound_speed_squared(law, density, energy) > 0.0))
    return fmt::format("at {:.6g} kg/m^3 and {:.6g} Pa {} carries no sound", density, pressure, in_quotes(fluid));
  return "";
}

namespace {

std::string place_in_words(const Vector& position, double time, int dimensions) {
  return fmt::format("at ({:.6g}) m, t = {:.6g} s",
                     fmt::join(std::span(position).first(static_cast<std::size_t>(dimensions)), ", "), time);
}

}  // namespace

Filling values_at(const GasStateConfig& state, bool pressure_alone, const Vector& position, double time, int dimensions,
                  const Refusal& refuse) {
  const auto value = [&](const char* key, const Varying& given, const Interval& interval) {
    const double x = given.at(position, time);
    if (given.formula && !(std::isfinite(x) && interval.contains(x)))
      refuse(key, fmt::format("{} is {:.6g} {}; it must be {}", in_quotes(given.formula->text()), x,
                              place_in_words(position, time, dimensions), describe(interval)));
    return x;
  };
  Filling filling;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a)
    filling.velocity[a] = value("velocity", state.velocity.components[a], any_value);
  if (state.pressure) filling.pressure = value("pressure", *state.pressure, pressure_alone ? non_negative : any_value);
  if (state.density) filling.density = value("density", *state.density, positive);
  if (state.temperature) filling.temperature = value("temperature", *state.temperature, positive);
  return filling;
}

Filling state_at(const GasStateConfig& state, int number, const Fluid* fluid, const Vector& position, double time,
                 int dimensions) {
  Filling filling = values_at(state, !fluid, position, time, dimensions,
                              [](const std::string& key, const std::string& what) { throw FormulaError(key, what); });
  filling.fluid = number;
  if (!fluid) return filling;
  if (state.temperature)
    filling.density = equation_of_state::density_at(fluid->equation_of_state, filling.pressure, filling.temperature);
  const std::string why =
      why_no_state(fluid->name, fluid->equation_of_state, filling.pressure, filling.density, filling.temperature);
  if (!why.empty()) throw FormulaError("pressure", place_in_words(position, time, dimensions) + ": " + why);
  return filling;
}

FillingFunction state_beyond(const GasConfig& config, const std::vector<Fluid>& fluids, const EdgeConfig& edge,
                             int dimensions) {
  const bool pressure_alone = edge.kind == EdgeKind::pressure;
  Filling fixed;
  if (pressure_alone)
    fixed.pressure = edge.pressure->number;
  else
    fixed = filling_of(config, fluids, edge);
  if (!varies(edge)) return [fixed](const Vector&, double) { return fixed; };
  std::optional<Fluid> fluid;
  if (!pressure_alone) fluid = fluids[static_cast<std::size_t>(fixed.fluid)];
  return [edge, number = fixed.fluid, fluid, dimensions](const Vector& position, double time) {
    try {
      return state_at(edge, number, fluid ? &*fluid : nullptr, position, time, dimensions);
    } catch (const FormulaError& error) {
      throw StepFailure(
          fmt::format("gas.edge {}: {}: {}", choices<BoxSide>[static_cast<std::size_t>(edge.side)], error.key, error.what()));
    }
  };
}

StateProfile read_state_profile(const ProfileConfig& config) {
  CsvColumns csv(config.file);
  StateProfile profile;
  const std::string_view along = choices<ProfileAlong>[static_cast<std::size_t>(config.along)];
  profile.place = csv.numbers(along, Unit::m);
  struct Column {
    std::string_view name;
    std::vector<double>& values;
    Unit unit;
  };
  const Column columns[] = {{"density", profile.density, Unit::kg_per_m3},
                            {"pressure", profile.pressure, Unit::Pa},
                            {"velocity_along", profile.velocity_along, Unit::m_per_s},
                            {"velocity_around", profile.velocity_around, Unit::m_per_s}};
  std::vector<std::string_view> known = {along};
  bool any = false;
  for (const Column& column : columns) {
    known.push_back(column.name);
    if (csv.file().has(column.name)) column.values = csv.numbers(column.name, column.unit), any = true;
  }
  for (const std::string& name : csv.file().column_names())
    if (csv.file().has(along) && std::find(known.begin(), known.end(), name) == known.end())
      csv.problem(fmt::format("the column \"{}\" says nothing of a gas; there may be {}", name, listed(known)));
  if (!any) csv.problem("it holds no state; one column at least of " + listed(std::span(known).subspan(1)) + " is required");
  if (csv.file().rows() == 0) csv.problem("it has no rows; one is required");
  if (!std::is_sorted(profile.place.begin(), profile.place.end()))
    csv.problem(fmt::format("{} must rise from row to row; two rows of one place make a jump", along));
  if (std::any_of(profile.density.begin(), profile.density.end(), [](double rho) { return !(rho > 0.0); }))
    csv.problem("a density is not above 0");
  csv.finish();
  return profile;
}

InitialState::InitialState(const GasConfig& config, const std::vector<Fluid>& fluids, const Cells& cells, const OpenParts& open)
    : cells_(&cells) {
  for (const FillConfig& fill : config.fills) {
    Fill made{&fill, filling_of(config, fluids, fill), {}, {-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    made.fluid = &fluids[static_cast<std::size_t>(made.filling.fluid)];
    if (fill.profile) made.profile = read_state_profile(*fill.profile);
    if (fill.shape) {
      const Bounds box = bounds(*fill.shape);
      made.lower = box.lower, made.upper = box.upper;
    }
    fills_.push_back(std::move(made));
  }
  for (std::size_t f = 0; f < fills_.size(); ++f) {
    Fill& fill = fills_[f];
    if (!fill.config->energy) continue;
    const double volume = whole_of(cells.geometry) * volume_of(f, open), density = fill.filling.density;
    if (!(volume > 0.0))
      throw std::runtime_error(
          fmt::format("gas.fill.{}: its energy goes nowhere; its shape must hold a part of the box that no body covers", f));
    fill.filling.pressure =
        equation_of_state::pressure(fill.fluid->equation_of_state, density, *fill.config->energy / (volume * density));
  }
}

Filling InitialState::Fill::at(const Vector& x, int dimensions) const {
  const auto& p = config->profile;
  if (!p && !varies(*config)) return filling;
  if (!p) {
    try {
      return state_at(*config, filling.fluid, fluid, x, 0.0, dimensions);
    } catch (const FormulaError& error) {  // not in the middle of a cell, where the case was checked
      throw std::runtime_error("gas.fill: " + error.key + ": " + error.what());
    }
  }
  Filling result = filling;
  Vector direction{};
  double place = 0.0;
  if (p->along == ProfileAlong::radius) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a) direction[a] = x[a] - p->centre[a];
    place = std::sqrt(dot(direction, direction));
    direction = place > 0.0 ? (1.0 / place) * direction : Vector{};
  } else {
    direction[static_cast<std::size_t>(p->along)] = 1.0;
    place = x[static_cast<std::size_t>(p->along)];
  }
  const auto value = [&](const std::vector<double>& column, double otherwise) {
    return column.empty() ? otherwise : interpolate(profile.place, column, place);
  };
  result.pressure = value(profile.pressure, filling.pressure);
  if (config->temperature)
    result.density = equation_of_state::density_at(fluid->equation_of_state, result.pressure, filling.temperature);
  result.density = value(profile.density, result.density);
  result.velocity = result.velocity + value(profile.velocity_along, 0.0) * direction +
                    value(profile.velocity_around, 0.0) * Vector{-direction[1], direction[0], 0.0};
  return result;
}

template <class F>
int InitialState::visit(const Vector& middle, F&& f) const {
  const Cells& cells = *cells_;
  const int D = cells.dimensions;
  // Of the fills that reach the cell, those below the last that is everywhere do not matter.
  const double half = 0.5 * cells.cell_size;
  const auto reaches = [&](const Fill& fill) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a)
      if (middle[a] + half < fill.lower[a] || middle[a] - half > fill.upper[a]) return false;
    return true;
  };
  std::vector<int> candidates;
  for (int n = static_cast<int>(fills_.size()) - 1; n >= 0; --n) {
    if (!reaches(fills_[static_cast<std::size_t>(n)])) continue;
    candidates.push_back(n);
    if (!fills_[static_cast<std::size_t>(n)].config->shape) break;
  }
  const auto uniform = [&](int n) { return fills_[static_cast<std::size_t>(n)].is_uniform(); };
  if (candidates.size() == 1 && uniform(candidates[0])) return candidates[0];

  struct Place {
    int fill;
    Vector x;
    double volume;
  };
  // A formula that no shape cuts is taken for smooth.
  constexpr int by_formula = 4;
  const bool smooth = candidates.size() == 1 && !fills_[static_cast<std::size_t>(candidates[0])].config->profile;
  const int n = smooth ? by_formula : places_per_direction(D);
  const double width = cells.cell_size / n;
  double straight = 1.0;
  for (int a = 0; a < D; ++a) straight *= width;
  std::vector<Place> places;
  for (int k = 0; k < (D > 2 ? n : 1); ++k)
    for (int j = 0; j < (D > 1 ? n : 1); ++j)
      for (int i = 0; i < n; ++i) {
        const std::array<int, 3> index{i, j, k};
        Vector x{};
        for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) x[a] = middle[a] - half + (index[a] + 0.5) * width;
        const auto here = std::find_if(candidates.begin(), candidates.end(), [&](int c) {
          const ShapePointer& shape = fills_[static_cast<std::size_t>(c)].config->shape;
          return !shape || contains(*shape, x);
        });
        places.push_back({*here, x, straight * widened(cells.geometry, x[0] - 0.5 * width, x[0] + 0.5 * width)});
      }
  const int first = places.front().fill;
  const bool one = std::all_of(places.begin(), places.end(), [&](const Place& p) { return p.fill == first; });
  if (one && uniform(first)) return first;
  for (const Place& place : places) f(place.fill, place.x, place.volume);
  return -1;
}

std::vector<Portion> InitialState::in_cell(const Vector& middle) const {
  std::vector<Portion> portions;
  std::vector<int> fills;  // that the portions are of
  double volume = 0.0;
  const int all = visit(middle, [&](int fill, const Vector& x, double part) {
    volume += part;
    const Fill& here = fills_[static_cast<std::size_t>(fill)];
    const auto known = !here.is_uniform() ? fills.end() : std::find(fills.begin(), fills.end(), fill);
    if (known != fills.end()) {
      portions[static_cast<std::size_t>(known - fills.begin())].part += part;
    } else {
      portions.push_back({part, here.at(x, cells_->dimensions)});
      fills.push_back(fill);
    }
  });
  if (all >= 0) return {{1.0, fills_[static_cast<std::size_t>(all)].filling}};
  for (Portion& portion : portions) portion.part /= volume;
  return portions;
}

template <class F>
void InitialState::visit_fill(std::size_t fill, const OpenParts& open, F&& f) const {
  const Cells& cells = *cells_;
  const Fill& sought = fills_[fill];
  std::array<int, 3> first{}, last{1, 1, 1};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cells.dimensions); ++a) {
    const double lowest = cells.lower[a], highest = cells.upper[a];
    first[a] = static_cast<int>(std::clamp(std::floor(sought.lower[a] / cells.cell_size) - 1.0, lowest, highest));
    last[a] = static_cast<int>(std::clamp(std::ceil(sought.upper[a] / cells.cell_size) + 1.0, lowest, highest));
  }
  std::vector<std::pair<Vector, double>> parts;
  for (int k = first[2]; k < last[2]; ++k)
    for (int j = first[1]; j < last[1]; ++j)
      for (int i = first[0]; i < last[0]; ++i) {
        Vector middle{};
        const std::array<int, 3> index{i, j, k};
        for (std::size_t a = 0; a < static_cast<std::size_t>(cells.dimensions); ++a)
          middle[a] = (index[a] + 0.5) * cells.cell_size;
        double part = 0.0, whole = 0.0;
        parts.clear();
        const int all = visit(middle, [&](int here, const Vector& x, double volume) {
          whole += volume;
          if (here != static_cast<int>(fill)) return;
          part += volume;
          if (!sought.is_uniform()) parts.emplace_back(x, volume);
        });
        if (all >= 0 ? all != static_cast<int>(fill) : part == 0.0) continue;
        const double whole_cell = cells.metric.volume[static_cast<std::size_t>(i - cells.metric.first)];
        const double volume = open ? open(index) * whole_cell : whole_cell;
        if (all >= 0 || sought.is_uniform()) f(middle, all >= 0 ? volume : volume * (part / whole));
        for (const auto& [x, of_place] : parts) f(x, volume * (of_place / whole));
      }
}

double InitialState::volume_of(std::size_t fill, const OpenParts& open) const {
  double sum = 0.0;
  visit_fill(fill, open, [&](const Vector&, double volume) { sum += volume; });
  return sum;
}

FillContent InitialState::content_of(std::size_t fill, const OpenParts& open) const {
  const Fill& sought = fills_[fill];
  const EquationOfState& law = sought.fluid->equation_of_state;
  FillContent content;
  const auto add = [&](const Filling& state) {
    const double energy = internal_energy_of(law, state);
    const auto extend = [](FillContent::Range& range, double value) {
      range = {std::min(range.lowest, value), std::max(range.highest, value)};
    };
    extend(content.density, state.density), extend(content.pressure, state.pressure), extend(content.energy, energy);
    extend(content.temperature, equation_of_state::temperature(law, state.density, energy));
    extend(content.sound_speed, std::sqrt(equation_of_state::sound_speed_squared(law, state.density, energy)));
  };
  if (sought.is_uniform()) add(sought.filling);
  visit_fill(fill, open, [&](const Vector& x, double volume) {
    const Filling state = sought.at(x, cells_->dimensions);
    content.mass += state.density * volume, content.volume += volume;
    if (!sought.is_uniform()) add(state);
  });
  return content;
}

}  // namespace brisance::simulator::gas
