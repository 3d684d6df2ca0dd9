#include "driver/path_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/input/table_reader.hpp"

namespace brisance {

template <>
inline constexpr std::array choices<driver::Heat> = {std::string_view{"adiabatic"}, std::string_view{"isothermal"},
                                                     std::string_view{"prescribed"}};
template <>
inline constexpr std::array choices<driver::OnFailure> = {std::string_view{"stop"}, std::string_view{"continue"}};

}  // namespace brisance

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

const SymmetricComponent& diagonal(std::size_t axis) {
  static const auto all = symmetric_components();
  return all[axis];
}

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
constexpr std::array<std::string_view, 6> planes{"xy", "xz", "yx", "yz", "zx", "zy"};

const Quantity any_rate{Unit::per_s, any_value, "strain rate, positive in extension"};
const Quantity any_stress{Unit::Pa, any_value, "stress, positive in tension"};
constexpr Unit degree{"degree"};

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

/// Either a rate along the component or its stress at the end of the segment.
void drive_along(TableReader& in, const SymmetricComponent& c, PathSegment& segment, Driven& driven) {
  if (in.has("stress")) {
    segment.free.push_back(held(c, in.number("stress", any_stress)));
    if (in.has("strain_rate")) in.problem("strain_rate", "the segment is driven by `stress`; give one of the two");
  } else {
    const double rate = in.number("strain_rate", any_rate);
    segment.velocity_gradient = segment.velocity_gradient + rate * c.direction;
    driven.rate = rate;
  }
  driven.strain = fmt::format("strain_{}", c.name);
  driven.stress = fmt::format("stress_{}", c.name);
}

void read_components(TableReader& in, PathSegment& segment, Driven& driven) {
  const auto& all = symmetric_components();
  std::vector<std::string> stress_components;
  if (auto stress = in.optional_table("stress"))
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
  const int ways = in.has("strain_rate") + in.has("velocity_gradient") + in.has("deformation_gradient");
  if (ways > 1) in.problem("give one of strain_rate, velocity_gradient and deformation_gradient");
  if (ways == 0 && segment.free.empty())
    in.problem("nothing drives this segment; give a mode, or strain_rate, velocity_gradient, deformation_gradient or stress");
  if (auto table = in.optional_table("strain_rate")) {
    for (const SymmetricComponent& c : all)
      if (table->has(c.name) && is_free(c.name[0], c.name[1]))
        table->problem(c.name, "its stress is prescribed as well; give one of the two");
    segment.velocity_gradient = to_tensor(symmetric_tensor(*table, any_rate));
  }
  if (auto table = in.optional_table("velocity_gradient")) {
    for (const GeneralComponent& c : general_components)
      if (table->has(c.name) && c.name[0] == c.name[1] && is_free(c.name[0], c.name[1]))
        table->problem(c.name, "its stress is prescribed as well; give one of the two");
    segment.velocity_gradient = general_tensor(*table, {Unit::per_s, any_value, "velocity gradient"});
  }
  if (auto table = in.optional_table("deformation_gradient")) {
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

void read_uniaxial_stress(TableReader& in, PathSegment& segment, Driven& driven) {
  const std::size_t axis = in.choice("axis", axes, 0);
  const double pressure = in.number_or("lateral_pressure", 0.0, {Unit::Pa, any_value, "pressure on the sides"});
  drive_along(in, diagonal(axis), segment, driven);
  for (std::size_t side = 0; side < 3; ++side)
    if (side != axis) segment.free.push_back(held(diagonal(side), -pressure));
}

void read_uniaxial_strain(TableReader& in, PathSegment& segment, Driven& driven) {
  drive_along(in, diagonal(in.choice("axis", axes, 0)), segment, driven);
}

void read_plane_stress(TableReader& in, PathSegment& segment, Driven& driven) {
  const std::size_t normal = in.choice("normal", axes, 2);
  segment.velocity_gradient = to_tensor(symmetric_tensor(in.table("strain_rate", "rates in the plane"), any_rate));
  if (symmetric_part(segment.velocity_gradient).*diagonal(normal).member != 0.0)
    in.problem("strain_rate", "the rate along the normal follows from its stress; remove it");
  segment.free.push_back(held(diagonal(normal), 0.0));
  const std::size_t first = normal == 0 ? 1 : 0;
  driven = {std::nullopt, fmt::format("strain_{0}{0}", axes[first]), fmt::format("stress_{0}{0}", axes[first])};
}

void read_biaxial_stress(TableReader& in, PathSegment& segment, Driven& driven) {
  const double ratio = in.number("stress_ratio", {Unit::one, any_value, "stress along y over stress along x"});
  drive_along(in, diagonal(0), segment, driven);
  S weight = diagonal(1).weight;
  weight.xx = -ratio;
  segment.free.push_back({diagonal(1).direction, weight, {}, 0.0});
  segment.free.push_back(held(diagonal(2), 0.0));
}

void read_simple_shear(TableReader& in, PathSegment& segment, Driven& driven) {
  const std::string_view plane = planes[in.choice("plane", planes, 0)];
  const double rate = in.number("shear_rate", {Unit::per_s, any_value, "rate of the shear angle, d(gamma)/dt"});
  for (const GeneralComponent& c : general_components)
    if (c.name == plane) segment.velocity_gradient.*c.member = rate;
  const std::string ordered = plane[0] < plane[1] ? std::string(plane) : std::string{plane[1], plane[0]};
  driven = {rate, fmt::format("F_{}", plane), fmt::format("stress_{}", ordered)};
}

void read_hydrostatic(TableReader& in, PathSegment& segment, Driven& driven) {
  if (in.has("pressure")) {
    FreeDirection all{
        T::identity(), (-1.0 / 3.0) * S::identity(), {}, in.number("pressure", {Unit::Pa, any_value, "pressure"})};
    segment.free.push_back(all);
  } else {
    const double rate =
        in.number("volume_strain_rate", {Unit::per_s, any_value, "rate of ln(volume), negative in compression"});
    segment.velocity_gradient = (rate / 3.0) * T::identity();
    driven.rate = rate;
  }
  driven.strain = "density";
  driven.stress = "pressure";
}

/// The stress keeps a direction in the space of principal stresses: mean stress = triaxiality times equivalent stress, and
/// a Lode angle of 0 in axisymmetric tension, 30 in shear, 60 in axisymmetric compression. The rate is the one conjugate to
/// the equivalent stress.
void read_constant_triaxiality(TableReader& in, PathSegment& segment, Driven& driven) {
  const double triaxiality =
      in.number("triaxiality", {Unit::one, between(-100.0, 100.0), "mean stress over equivalent stress"});
  const double lode = in.number_or("lode_angle", 0.0, {degree, between(0.0, 60.0), "Lode angle"}) * std::numbers::pi / 180.0;
  const double rate = in.number("strain_rate", {Unit::per_s, positive, "equivalent strain rate"});
  constexpr double third = 2.0 * std::numbers::pi / 3.0;
  const S n{
      2.0 / 3.0 * std::cos(lode), 2.0 / 3.0 * std::cos(lode - third), 2.0 / 3.0 * std::cos(lode + third), 0, 0, 0};  // s/q
  // The stress is q (n + triaxiality I) when it has no part along two directions at right angles to that.
  const S m{n.yy - n.zz, n.zz - n.xx, n.xx - n.yy, 0, 0, 0};
  const S l = add_to_diagonal(triaxiality * n, -double_dot(n, n) / 3.0);
  segment.free.push_back({diagonal(0).direction, m, {}, 0.0});
  segment.free.push_back({diagonal(1).direction, l, {}, 0.0});
  segment.free.push_back({diagonal(2).direction, {}, n, rate});
  driven = {rate, "accumulated_strain", "equivalent_stress"};
}

struct Mode {
  std::string_view name;
  void (*read)(TableReader&, PathSegment&, Driven&);
};
constexpr std::array<Mode, 8> modes{{{"uniaxial_stress", read_uniaxial_stress},
                                     {"uniaxial_strain", read_uniaxial_strain},
                                     {"plane_stress", read_plane_stress},
                                     {"biaxial_stress", read_biaxial_stress},
                                     {"simple_shear", read_simple_shear},
                                     {"hydrostatic", read_hydrostatic},
                                     {"constant_triaxiality", read_constant_triaxiality},
                                     {"hold", [](TableReader&, PathSegment&, Driven&) {}}}};

void read_until(TableReader& in, const std::vector<Column>& columns, const Driven& driven, PathSegment& segment) {
  TableReader until = in.table("until");
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

void read_duration(TableReader& in, const Driven& driven, PathSegment& segment) {
  segment.duration = in.optional_number("duration", {Unit::s, positive, "duration"});
  if (!in.has("strain")) return;
  const double strain = in.number("strain", {Unit::one, positive, "size of the change of strain"});
  if (segment.duration) in.problem("strain", "the duration is given as well; give one of the two");
  if (!driven.rate || *driven.rate == 0.0)
    in.problem("strain", "there is no single strain rate that would turn it into a duration; give `duration`");
  else
    segment.duration = strain / std::abs(*driven.rate);
}

struct Reader {
  const std::vector<Column>& columns;
  LoadingPath& path;

  void segment(TableReader in, const std::string& where) {
    if (in.has("repeat")) return group(in, where);
    PathSegment segment;
    segment.where = where;
    Driven driven;
    if (in.has("mode")) {
      std::vector<std::string_view> names;
      for (const Mode& mode : modes) names.push_back(mode.name);
      const std::size_t chosen = in.choice("mode", names);
      modes[chosen].read(in, segment, driven);
    } else {
      read_components(in, segment, driven);
    }
    read_duration(in, driven, segment);
    if (in.has("until")) read_until(in, columns, driven, segment);
    if (!segment.duration && !segment.until) in.problem("the segment has no end; give duration, strain or until");
    segment.temperature = in.optional_number("temperature", {Unit::K, positive, "temperature from the start of the segment"});
    segment.temperature_jump =
        in.number_or("temperature_jump", 0.0, {Unit::K, any_value, "jump of the temperature at the start"});
    if (in.has("temperature_rate")) {
      segment.temperature_rate = in.number("temperature_rate", {Unit{"K/s"}, any_value, "rate of the temperature"});
      if (path.heat != Heat::prescribed) in.problem("temperature_rate", "it needs heat = \"prescribed\"");
    }
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
    const int count = in.integer("repeat", 1, 100000);
    const std::size_t first = path.segments.size();
    std::vector<TableReader> inner = in.tables("segment");
    if (inner.empty()) in.problem("repeat", "there is nothing to repeat; add [[segment.segment]] tables");
    for (std::size_t i = 0; i < inner.size(); ++i) segment(inner[i], fmt::format("{}.{}", where, i + 1));
    const std::size_t size = path.segments.size() - first;
    for (int i = 1; i < count; ++i)
      for (std::size_t k = 0; k < size; ++k) path.segments.push_back(path.segments[first + k]);
  }
};

void read_initial(TableReader in, LoadingPath& path) {
  path.temperature = in.number("temperature", {Unit::K, positive, "initial temperature"});
  path.density = in.optional_number("density", {Unit::kg_per_m3, positive, "initial density, if not the material's"});
  path.plastic_strain = in.number_or("plastic_strain", 0.0, {Unit::one, non_negative, "initial plastic strain"});
  path.porosity =
      in.number_or("porosity", 0.0, {Unit::one, {.lower = 0.0, .upper = 1.0, .upper_open = true}, "initial porosity"});
  path.damage = in.number_or("damage", 0.0, {Unit::one, fraction, "initial damage"});
  if (auto stress = in.optional_table("stress")) path.stress = symmetric_tensor(*stress, any_stress);
}

void require_column(TableReader& in, std::string_view key, const std::string& name, const std::vector<Column>& columns) {
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
  PointCase result;
  LoadingPath& path = result.path;
  path.title = top.text_or("title", file.stem().string());
  result.file = resolve_material(top, "material");
  const Material& material = result.file.material;
  path.heat = top.choice<Heat>("heat");
  path.on_failure = top.choice<OnFailure>("on_failure", OnFailure::stop);
  path.strain_increment =
      top.number_or("strain_increment", path.strain_increment,
                    {Unit::one, {.lower = 0.0, .upper = 0.05, .lower_open = true}, "largest strain of a step"});
  path.cell_size = top.number_or("cell_size", 0.0, {Unit::m, non_negative, "length of the artificial viscosity; 0: none"});
  read_initial(top.table("initial", "the state at the start"), path);
  const std::vector<Column> columns = columns_of(material);
  if (auto output = top.optional_table("output")) {
    path.output.every = output->integer_or("every", 0, 1, 1'000'000);
    path.output.rows = output->integer_or("rows", path.output.rows, 2, 10'000'000);
    if (output->has("every") && output->has("rows")) output->problem("rows", "`every` is given as well; give one of the two");
  }
  std::vector<TableReader> segments = top.tables("segment");
  if (segments.empty()) top.problem("there is no [[segment]]; a path has at least one");
  if (auto plot = top.optional_table("plot")) {
    path.x = plot->text("x", "column for the axis of abscissas");
    path.y = plot->text("y", "column for the axis of ordinates");
    require_column(*plot, "x", path.x, columns);
    require_column(*plot, "y", path.y, columns);
  }
  Reader reader{columns, path};
  for (std::size_t i = 0; i < segments.size(); ++i)
    reader.segment(segments[i], fmt::format("{}: segment {}", file.filename().string(), i + 1));
  if (path.x.empty()) path.x = "time";
  if (path.y.empty()) path.y = "equivalent_stress";
  check_heat(top, material, path);
  if (auto sweep = top.optional_table("sweep")) sweep->ignore_rest();  // read_sweep reads it
  input.finish();
  return result;
}

std::vector<SweepAxis> read_sweep(const std::filesystem::path& file) {
  TomlNode root = parse_toml(read_text_file(file), file.string());
  std::vector<SweepAxis> axes_found;
  TomlEntry* sweep = std::get<TomlTable>(root.value).find("sweep");
  if (!sweep) return axes_found;
  std::vector<Problem> problems;
  const auto wrong = [&](const TomlNode& node, const std::string& key, const std::string& what) {
    problems.push_back({file.string(), node.place.line, node.place.column, key, what});
  };
  auto* table = std::get_if<TomlTable>(&sweep->node.value);
  if (!table || table->entries.empty())
    wrong(sweep->node, "sweep", "must be a table of lists, as in \"initial.temperature\" = [77, 298]");
  for (const TomlEntry& entry : table ? table->entries : std::vector<TomlEntry>{}) {
    const auto* list = std::get_if<TomlList>(&entry.node.value);
    if (!list || list->empty()) {
      wrong(entry.node, entry.key, "must be a list of values; a dotted key stands in quotes, as in \"initial.temperature\"");
      continue;
    }
    SweepAxis axis{entry.key, {}};
    for (const TomlNode& value : *list) {
      if (const auto* number = std::get_if<double>(&value.value))
        axis.values.push_back(shortest_text(*number));
      else if (const auto* whole = std::get_if<std::int64_t>(&value.value))
        axis.values.push_back(fmt::format("{}", *whole));
      else if (const auto* text = std::get_if<std::string>(&value.value))
        axis.values.push_back(*text);
      else
        wrong(value, entry.key, "holds something that is neither a number nor a text");
    }
    axes_found.push_back(std::move(axis));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return axes_found;
}

}  // namespace brisance::driver
