#include "driver/path_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "driver/keys.hpp"
#include "models/equation_of_state/thermodynamics.hpp"

namespace brisance::driver {
namespace {

using T = Tensor<double>;
using S = SymmetricTensor<double>;

struct GeneralComponent {
  std::string_view name;
  double T::*member;
};
struct SymmetricComponent {
  std::string_view name;
  double S::*member;
  T direction;  // of L, without spin
  S weight;     // weight : sigma is the component
};
constexpr std::array<GeneralComponent, 9> general_components{{{"xx", &T::xx},
                                                              {"xy", &T::xy},
                                                              {"xz", &T::xz},
                                                              {"yx", &T::yx},
                                                              {"yy", &T::yy},
                                                              {"yz", &T::yz},
                                                              {"zx", &T::zx},
                                                              {"zy", &T::zy},
                                                              {"zz", &T::zz}}};

std::array<SymmetricComponent, 6> symmetric_components() {
  std::array<SymmetricComponent, 6> all{{{"xx", &S::xx, {}, {}},
                                         {"yy", &S::yy, {}, {}},
                                         {"zz", &S::zz, {}, {}},
                                         {"yz", &S::yz, {}, {}},
                                         {"xz", &S::xz, {}, {}},
                                         {"xy", &S::xy, {}, {}}}};
  for (SymmetricComponent& c : all) {
    c.weight.*c.member = c.name[0] == c.name[1] ? 1.0 : 0.5;  // a shear component stands twice in a double product
    S unit;
    unit.*c.member = 1.0;
    c.direction = to_tensor(unit);
  }
  return all;
}

const SymmetricComponent& diagonal(Direction axis) {
  static const auto all = symmetric_components();
  return all[static_cast<std::size_t>(axis)];
}
constexpr std::array all_directions{Direction::x, Direction::y, Direction::z};

const Quantity any_rate{Unit::per_s, any_value, "strain rate"};
const Quantity any_stress{Unit::Pa, any_value, "stress"};

/// What a mode leaves behind for the keys that every segment may have.
struct Driven {
  std::optional<double> rate;  // of the strain that `strain` measures
  std::string strain, stress;  // columns that the short names in `until` mean
};

/// The condition that holds a component of the stress at the end of the segment.
FreeDirection held(const SymmetricComponent& c, double target) {
  return {c.direction, c.weight, {}, target};
}

T general_tensor(TableReader table, const Quantity& quantity, T start = {}) {
  for (const GeneralComponent& c : general_components) start.*c.member = table.number_or(c.name, start.*c.member, quantity);
  return start;
}
S symmetric_tensor(TableReader table, const Quantity& quantity) {
  S result;
  for (const SymmetricComponent& c : symmetric_components()) result.*c.member = table.number_or(c.name, 0.0, quantity);
  return result;
}

void require_one_of(TableReader& in, std::string_view first, std::string_view second) {
  if (in.has(first) && in.has(second)) in.problem(first, fmt::format("`{}` is given as well; give one of the two", second));
  if (!in.has(first) && !in.has(second)) in.problem(fmt::format("nothing drives this segment; give {} or {}", first, second));
}

/// Either a rate along the component or its stress at the end of the segment.
void drive_along(TableReader& in, const SymmetricComponent& c, std::optional<double> rate, std::optional<double> stress,
                 PathSegment& segment, Driven& driven) {
  require_one_of(in, "strain_rate", "stress");
  if (stress) segment.free.push_back(held(c, *stress));
  if (rate) segment.velocity_gradient = segment.velocity_gradient + *rate * c.direction;
  driven = {rate, fmt::format("strain_{}", c.name), fmt::format("stress_{}", c.name)};
}

void drive(const ComponentKeys& keys, TableReader& in, PathSegment& segment, Driven& driven) {
  const auto& all = symmetric_components();
  std::vector<std::string> stress_components;
  if (auto stress = keys.stress)
    for (const SymmetricComponent& c : all)
      if (stress->has(c.name)) {
        segment.free.push_back(held(c, stress->number(c.name, any_stress)));
        stress_components.emplace_back(c.name);
      }
  const auto is_free = [&](char a, char b) {
    return std::any_of(stress_components.begin(), stress_components.end(), [&](const std::string& name) {
      return (name[0] == a && name[1] == b) || (name[0] == b && name[1] == a);
    });
  };
  const int ways = keys.strain_rate.has_value() + keys.velocity_gradient.has_value() + keys.deformation_gradient.has_value();
  if (ways > 1) in.problem("give one of strain_rate, velocity_gradient and deformation_gradient");
  if (ways == 0 && segment.free.empty())
    in.problem("nothing drives this segment; give a mode, or strain_rate, velocity_gradient, deformation_gradient or stress");
  if (auto table = keys.strain_rate) {
    for (const SymmetricComponent& c : all)
      if (table->has(c.name) && is_free(c.name[0], c.name[1]))
        table->problem(c.name, "its stress is prescribed as well; give one of the two");
    segment.velocity_gradient = to_tensor(symmetric_tensor(*table, any_rate));
  }
  if (auto table = keys.velocity_gradient) {
    for (const GeneralComponent& c : general_components)
      if (table->has(c.name) && c.name[0] == c.name[1] && is_free(c.name[0], c.name[1]))
        table->problem(c.name, "its stress is prescribed as well; give one of the two");
    segment.velocity_gradient = general_tensor(*table, any_rate);
  }
  if (auto table = keys.deformation_gradient) {
    segment.deformation_gradient = general_tensor(*table, {Unit::one, any_value, "deformation gradient"}, T::identity());
    if (determinant(*segment.deformation_gradient) <= 0.0)
      in.problem("deformation_gradient", "its determinant must be > 0: matter does not vanish or turn inside out");
    if (!in.has("duration")) in.problem("deformation_gradient", "it is reached at the end of a duration; give `duration`");
    if (!segment.free.empty())
      in.problem("deformation_gradient", "it leaves nothing free for a prescribed stress; remove `stress`");
  }
  double largest = 0.0;
  for (const SymmetricComponent& c : all) {
    const double rate = std::abs(symmetric_part(segment.velocity_gradient).*c.member);
    if (rate <= largest) continue;
    largest = rate;
    driven = {std::nullopt, fmt::format("strain_{}", c.name), fmt::format("stress_{}", c.name)};
  }
}

void drive(const UniaxialStressKeys& keys, TableReader& in, PathSegment& segment, Driven& driven) {
  drive_along(in, diagonal(keys.axis), keys.strain_rate, keys.stress, segment, driven);
  for (const Direction side : all_directions)
    if (side != keys.axis) segment.free.push_back(held(diagonal(side), -keys.lateral_pressure));
}

void drive(const UniaxialStrainKeys& keys, TableReader& in, PathSegment& segment, Driven& driven) {
  drive_along(in, diagonal(keys.axis), keys.strain_rate, keys.stress, segment, driven);
}

void drive(const PlaneStressKeys& keys, TableReader& in, PathSegment& segment, Driven& driven) {
  if (keys.strain_rate) segment.velocity_gradient = to_tensor(symmetric_tensor(*keys.strain_rate, any_rate));
  if (symmetric_part(segment.velocity_gradient).*diagonal(keys.normal).member != 0.0)
    in.problem("strain_rate", "the rate along the normal follows from its stress; remove it");
  segment.free.push_back(held(diagonal(keys.normal), 0.0));
  const std::string_view first = diagonal(keys.normal == Direction::x ? Direction::y : Direction::x).name;
  driven = {std::nullopt, fmt::format("strain_{}", first), fmt::format("stress_{}", first)};
}

void drive(const BiaxialStressKeys& keys, TableReader& in, PathSegment& segment, Driven& driven) {
  drive_along(in, diagonal(Direction::x), keys.strain_rate, keys.stress, segment, driven);
  S weight = diagonal(Direction::y).weight;
  weight.xx = -keys.stress_ratio;
  segment.free.push_back({diagonal(Direction::y).direction, weight, {}, 0.0});
  segment.free.push_back(held(diagonal(Direction::z), 0.0));
}

void drive(const SimpleShearKeys& keys, TableReader&, PathSegment& segment, Driven& driven) {
  const std::string_view plane = choices<Plane>[static_cast<std::size_t>(keys.plane)];
  for (const GeneralComponent& c : general_components)
    if (c.name == plane) segment.velocity_gradient.*c.member = keys.shear_rate;
  const std::string ordered = plane[0] < plane[1] ? std::string(plane) : std::string{plane[1], plane[0]};
  driven = {keys.shear_rate, fmt::format("F_{}", plane), fmt::format("stress_{}", ordered)};
}

void drive(const HydrostaticKeys& keys, TableReader& in, PathSegment& segment, Driven& driven) {
  require_one_of(in, "pressure", "volume_strain_rate");
  if (keys.pressure) segment.free.push_back({T::identity(), (-1.0 / 3.0) * S::identity(), {}, *keys.pressure});
  if (keys.volume_strain_rate) segment.velocity_gradient = (*keys.volume_strain_rate / 3.0) * T::identity();
  driven = {keys.volume_strain_rate, "density", "pressure"};
}

/// The stress keeps a direction in the space of principal stresses: mean stress = triaxiality times equivalent stress, and
/// a Lode angle of 0 in axisymmetric tension, 30 in shear, 60 in axisymmetric compression. The rate is the one conjugate to
/// the equivalent stress.
void drive(const ConstantTriaxialityKeys& keys, TableReader&, PathSegment& segment, Driven& driven) {
  constexpr double third = 2.0 * std::numbers::pi / 3.0;
  const double lode = keys.lode_angle * std::numbers::pi / 180.0;
  const S n{
      2.0 / 3.0 * std::cos(lode), 2.0 / 3.0 * std::cos(lode - third), 2.0 / 3.0 * std::cos(lode + third), 0, 0, 0};  // s/q
  // The stress is q (n + triaxiality I) when it has no part along two directions at right angles to that.
  const S m{n.yy - n.zz, n.zz - n.xx, n.xx - n.yy, 0, 0, 0};
  const S l = add_to_diagonal(keys.triaxiality * n, -double_dot(n, n) / 3.0);
  segment.free.push_back({diagonal(Direction::x).direction, m, {}, 0.0});
  segment.free.push_back({diagonal(Direction::y).direction, l, {}, 0.0});
  segment.free.push_back({diagonal(Direction::z).direction, {}, n, keys.strain_rate});
  driven = {keys.strain_rate, "accumulated_strain", "equivalent_stress"};
}

void drive(const HoldKeys&, TableReader&, PathSegment&, Driven&) {}

/// Reads the keys of a mode and drives the segment as they say.
void drive(ModeName mode, TableReader& in, PathSegment& segment, Driven& driven) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto chosen = static_cast<std::size_t>(mode);
    ((I == chosen ? drive(read_keys<std::variant_alternative_t<I, ModeKeys>>(in), in, segment, driven) : void()), ...);
  }
  (std::make_index_sequence<std::variant_size_v<ModeKeys>>());
}

void read_until(TableReader until, const std::vector<Column>& columns, const Driven& driven, PathSegment& segment) {
  const std::vector<std::string> keys = until.keys();
  if (keys.size() != 1) {
    until.problem(fmt::format("`until` names one column of the history and its value, as in {{ plastic_strain = 0.1 }}"));
    until.ignore_rest();
    return;
  }
  std::string name = keys.front();
  if (name == "strain" && !driven.strain.empty()) name = driven.strain;
  if (name == "stress" && !driven.stress.empty()) name = driven.stress;
  const auto column = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  if (column == columns.end()) {
    std::vector<std::string_view> names{"strain", "stress"};
    for (const Column& c : columns) names.push_back(c.name);
    until.problem(keys.front(), "is no column of the history" + did_you_mean(name, names));
    until.ignore_rest();
    return;
  }
  segment.until = Until{name, until.number(keys.front(), {Unit{column->unit}, any_value, "value that ends the segment"})};
}

/// The duration, given or that of the change of strain.
std::optional<double> duration_of(const SegmentKeys& keys, TableReader& in, const Driven& driven) {
  if (!keys.strain) return keys.duration;
  const auto refuse = [&](std::string what) {
    in.problem("strain", std::move(what));
    return std::nullopt;
  };
  if (keys.duration) return refuse("the duration is given as well; give one of the two");
  if (*keys.strain <= 0.0)
    return refuse(
        fmt::format("{:g} is out of range; it must be > 0: the size of the change, whose direction is the sign of the "
                    "strain rate",
                    *keys.strain));
  if (!driven.rate) return refuse("there is no single strain rate that would turn it into a duration; give `duration`");
  if (*driven.rate == 0.0) return refuse("it is never reached: the rate is zero; give a rate, or `duration`");
  return *keys.strain / std::abs(*driven.rate);
}

struct Reader {
  const std::vector<Column>& columns;
  LoadingPath& path;

  void segment(TableReader in, const std::string& where) {
    if (in.has("repeat")) return group(in, where);
    PathSegment segment;
    segment.where = where;
    Driven driven;
    const auto keys = read_keys<SegmentKeys>(in);
    if (keys.mode)
      drive(*keys.mode, in, segment, driven);
    else if (!in.has("mode"))
      drive(read_keys<ComponentKeys>(in), in, segment, driven);
    else
      in.ignore_rest();  // without a mode the other keys mean nothing
    segment.duration = duration_of(keys, in, driven);
    if (keys.until) read_until(*keys.until, columns, driven, segment);
    if (!in.has("duration") && !in.has("strain") && !in.has("until"))
      in.problem("the segment has no end; give duration, strain or until");
    segment.temperature = keys.temperature;
    segment.temperature_jump = keys.temperature_jump;
    segment.temperature_rate = keys.temperature_rate;
    if (in.has("temperature_rate") && path.heat != Heat::prescribed)
      in.problem("temperature_rate", "it needs heat = \"prescribed\"");
    drives(in, segment);
    if (path.x.empty()) path.x = driven.strain;
    if (path.y.empty()) path.y = driven.stress;
    path.segments.push_back(std::move(segment));
  }

  /// A segment that stands still needs a duration; one whose only end is `until` must be driven by a rate.
  void drives(TableReader& in, const PathSegment& segment) {
    bool by_rate = norm(segment.velocity_gradient) > 0.0 || segment.temperature_rate != 0.0;
    for (const FreeDirection& f : segment.free) by_rate = by_rate || (norm(f.rate_weight) > 0.0 && f.target != 0.0);
    if (!segment.duration && segment.until && !by_rate)
      in.problem("until", "nothing is driven by a rate, so the time to get there is unknown; give `duration` as well");
  }

  void group(TableReader& in, const std::string& where) {
    const auto keys = read_keys<GroupKeys>(in);
    const std::size_t first = path.segments.size();
    const OpenTables& inner = keys.segments;
    if (inner.empty()) in.problem("repeat", "there is nothing to repeat; add [[segment.segment]] tables");
    for (std::size_t i = 0; i < inner.size(); ++i) segment(inner[i], fmt::format("{}.{}", where, i + 1));
    const std::size_t size = path.segments.size() - first;
    for (int i = 1; i < keys.repeat; ++i)
      for (std::size_t k = 0; k < size; ++k) path.segments.push_back(path.segments[first + k]);
  }
};

void require_column(TableReader& top, std::string_view key, const std::string& name, const std::vector<Column>& columns) {
  if (name.empty()) return;  // not given, or reported
  TableReader in = top.table("plot");
  if (std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; })) return;
  std::vector<std::string_view> names;
  for (const Column& c : columns) names.push_back(c.name);
  in.problem(key, in_quotes(name) + " is no column of the history" + did_you_mean(name, names));
}

/// Where the temperature follows from the energy it cannot be ruled from outside.
void check_heat(TableReader& top, const Material& material, const LoadingPath& path) {
  if (equation_of_state::caloric(material.equation_of_state) != equation_of_state::Caloric::complete) return;
  const std::string why = "the equation of state derives the temperature from the energy";
  if (path.heat != Heat::adiabatic) top.problem("heat", why + "; only \"adiabatic\" is possible");
  const bool jumps = std::any_of(path.segments.begin(), path.segments.end(),
                                 [](const PathSegment& s) { return s.temperature || s.temperature_jump != 0.0; });
  if (jumps) top.problem("segment", why + "; it cannot jump");
}

}  // namespace

PointCase read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  InputFile input = InputFile::load(file);
  for (const std::string& assignment : overrides) input.set(assignment);
  TableReader top = input.top();
  const auto keys = read_keys<PathKeys>(top);
  const Material& material = keys.material.material;
  PointCase result{keys.material, {}};
  LoadingPath& path = result.path;
  path.title = keys.title.empty() ? file.stem().string() : keys.title;
  path.heat = keys.heat;
  path.on_failure = keys.on_failure;
  path.strain_increment = keys.strain_increment;
  path.tolerance = keys.tolerance;
  path.cell_size = keys.cell_size;
  path.temperature = keys.initial.temperature;
  path.density = keys.initial.density;
  path.plastic_strain = keys.initial.plastic_strain;
  path.porosity = keys.initial.porosity;
  path.damage = keys.initial.damage;
  if (keys.initial.stress) path.stress = symmetric_tensor(*keys.initial.stress, any_stress);
  if (keys.output.every && keys.output.rows)
    top.table("output").problem("rows", "`every` is given as well; give one of the two");
  path.output.every = keys.output.every.value_or(0);
  path.output.rows = keys.output.rows.value_or(path.output.rows);
  const std::vector<Column> columns = columns_of(material);
  if (keys.plot) {
    path.x = keys.plot->x;
    path.y = keys.plot->y;
    require_column(top, "x", path.x, columns);
    require_column(top, "y", path.y, columns);
  }
  const OpenTables& segments = keys.segments;
  if (segments.empty()) top.problem("there is no [[segment]]; a path has at least one");
  Reader reader{columns, path};
  for (std::size_t i = 0; i < segments.size(); ++i)
    reader.segment(segments[i], fmt::format("{}: segment {}", file.filename().string(), i + 1));
  if (path.x.empty()) path.x = "time";
  if (path.y.empty()) path.y = "equivalent_stress";
  check_heat(top, material, path);
  if (auto sweep = keys.sweep) sweep->ignore_rest();  // read_sweep reads it
  input.finish();
  return result;
}

}  // namespace brisance::driver
