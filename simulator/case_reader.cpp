#include "simulator/case_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/input/csv.hpp"
#include "models/input/table_reader.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/gas/initial_state.hpp"
#include "simulator/gas/reaction.hpp"
#include "simulator/keys.hpp"
#include "simulator/output/gauges.hpp"
#include "simulator/output/line_out.hpp"
#include "simulator/solid/shapes.hpp"
#include "simulator/table.hpp"

namespace brisance::simulator {
namespace {

using Path = std::filesystem::path;

constexpr std::array<std::string_view, 3> axis_names = {"x", "y", "z"};
constexpr double round_off = 1e-9;  // in cells: positions are decimal numbers in the file

std::string in_metres(double x) {
  return fmt::format("{:.9g} m", x == 0.0 ? 0.0 : x);
}

template <class Form>
ShapePointer make_shape(Form form) {
  return std::make_shared<const Shape>(Shape{std::move(form)});
}

class CaseReader : public KeyReader<CaseReader> {
 public:
  Case read(TableReader& top) {
    read_keys(top, case_);
    if (case_.title.empty()) case_.title = top.file().stem().string();
    if (case_.gas && case_.output.figure_field == OutputConfig{}.figure_field) case_.output.figure_field = "density";
    if (case_.bodies.empty() && !case_.gas && (!top.has("solid") || top.problem_count() == 0))
      top.problem("there is no [[solid]] and no [gas]; a case has one of them");
    if (!case_.bodies.empty() && case_.gas) top.problem("gas", "a case holds either solids or gas, not yet both");
    if (!case_.bodies.empty() && geometry_known_ && dimensions() == 1)
      top.problem("geometry", "in one dimension there is gas alone; solids need plane, axisymmetric or three_dimensional");
    if (case_.gas) {
      for (const char* key : {"boundary", "load", "measure"})
        if (top.has(key)) top.problem(key, "it would be ignored: there are no solids; the sides of the gas are [[gas.edge]]");
    }
    return std::move(case_);
  }

 private:
  friend KeyReader<CaseReader>;
  using KeyReader<CaseReader>::read_value;

  std::size_t dimensions() const { return static_cast<std::size_t>(case_.dimensions()); }

  template <class Config>
  Config read_struct(TableReader in) {
    Config config{};
    read_keys(in, config);
    return config;
  }

  // --- Values ---------------------------------------------------------------------------------------------------------

  template <class K>
  void read_value(TableReader& in, const K& key, Path& value) {
    const Path name = in.text(key.name, key.meaning);
    value = std::filesystem::absolute(in.file().parent_path() / name).lexically_normal();
  }
  template <class K, class Enum>
  requires std::is_enum_v<Enum>
  void read_value(TableReader& in, const K& key, Enum& value) {
    const std::size_t before = in.problem_count();
    value = in.choice<Enum>(key.name);
    if constexpr (std::is_same_v<Enum, Geometry>) geometry_known_ = in.problem_count() == before;
  }
  template <class K, class T>
  requires(std::is_enum_v<T> || std::is_same_v<T, bool>) void read_value(TableReader& in, const K& key,
                                                                         std::optional<T>& value) {
    read_value(in, key, value.emplace());
  }
  template <class K>
  void read_value(TableReader& in, const K& key, Vector& value) {
    // Without a geometry two components are as good as three.
    const Length length = key.components == Components::three ? exactly(3)
                          : geometry_known_                   ? exactly(dimensions())
                                                              : Length{1, 3};
    const std::vector<double> numbers = in.numbers(key.name, quantity(key), length);
    std::copy_n(numbers.begin(), std::min(numbers.size(), value.size()), value.begin());
  }
  template <class K>
  void read_value(TableReader& in, const K& key, Table& value) {
    value = in.piecewise(key.name, quantity(key), "time", {Unit::s, non_negative, "times of the table"});
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<Table>& value) {
    read_value(in, key, value.emplace());
  }
  template <class K>
  void read_value(TableReader& in, const K& key, ShapePointer& value) {
    value = read_shape(in, key.name, key.meaning);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, InitialVelocity& value) {
    if (in.is_table(key.name))
      value = read_struct<InitialVelocity>(in.table(key.name));
    else
      read_value(in, key, value.translation);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<StrengthDistribution>& value) {
    value = read_struct<StrengthDistribution>(in.table(key.name));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<InitialPorosity>& value) {
    TableReader table = in.table(key.name);
    read_law(table, value.emplace());
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<ProfileConfig>& value) {
    value = read_struct<ProfileConfig>(in.table(key.name));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<GasConfig>& value) {
    TableReader table = in.table(key.name);
    const std::size_t before = in.problem_count();
    gas_ = &value.emplace();
    read_keys(table, *gas_);
    if (in.problem_count() == before && geometry_known_) check_box(table, *gas_);
    gas_ = nullptr;
  }
  template <class K, class Config>
  void read_value(TableReader& in, const K& key, std::vector<Config>& value) {
    for (TableReader& table : in.tables(key.name)) {
      const std::size_t before = in.problem_count();
      if constexpr (std::is_same_v<Config, BodyConfig> || std::is_same_v<Config, FluidConfig>)
        table.optional_texts("material_changes");  // read_case applied them
      Config config{};
      read_keys(table, config);
      if (in.problem_count() == before && geometry_known_) check(table, config, value);
      value.push_back(std::move(config));
    }
  }
  template <class K>
  void read_value(TableReader& in, const K& key, OutputConfig& value) {
    TableReader table = in.table(key.name);
    read_keys(table, value);
    check_figure_field(table, value.figure_field);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, NumericsConfig& value) {
    TableReader table = in.table(key.name);
    read_keys(table, value);
    check_trimming(table, value);
  }

  template <class... Law>
  static void read_law(TableReader& table, std::variant<Law...>& result) {
    constexpr std::array names = {Law::name...};
    const std::size_t before = table.problem_count();
    const std::size_t wanted = table.choice("law", names);
    if (table.problem_count() > before) return table.ignore_rest();  // without a law the other keys mean nothing
    const auto read_as = [&]<class L>(L law) {
      for_each_parameter<L>([&](const auto& row) {
        law.*row.member = table.number(row.name, {row.unit, row.interval, row.meaning});
      });
      result = law;
    };
    std::size_t i = 0;
    ((i++ == wanted ? read_as(Law{}) : void()), ...);
  }

  // --- Shapes ---------------------------------------------------------------------------------------------------------

  ShapePointer read_shape(TableReader& above, std::string_view key, std::string_view meaning) {
    if (above.is_table(key)) return read_shape(above.table(key, meaning));
    above.table(key, meaning);  // says what is wrong
    return make_shape(Box{});
  }

  ShapePointer read_shape(TableReader in) {
    const std::vector<std::string> given = in.keys();
    const auto none = [&] {
      in.ignore_rest();
      return make_shape(Box{});
    };
    const std::string allowed = "one of " + listed(shape_forms);
    if (given.size() != 1) {
      in.problem("a shape has one form, such as { box = {...} }; give " + allowed);
      return none();
    }
    const std::string& form = given.front();
    if (std::find(shape_forms.begin(), shape_forms.end(), form) == shape_forms.end()) {
      in.problem(form, in_quotes(form) + " is no shape; it must be " + allowed + did_you_mean(form, shape_forms));
      return none();
    }
    if (form == "union") return make_shape(Union{read_parts(in, "union")});
    if (form == "intersection") return make_shape(Intersection{read_parts(in, "intersection")});
    const std::size_t before = in.problem_count();
    TableReader table = in.table(form);
    if (in.problem_count() > before) return make_shape(Box{});
    const auto check_axis = [&](const Cone& cone) {
      if (in.problem_count() > before) return;
      if (cone.start == cone.end) table.problem("end", "it is where the start is; a solid of revolution has a length");
      if (case_.geometry == Geometry::axisymmetric && (cone.start[0] != 0.0 || cone.end[0] != 0.0))
        table.problem(cone.start[0] != 0.0 ? "start" : "end", "in the axisymmetric geometry it lies on the axis; give r = 0");
    };
    if (form == "difference") {
      Difference difference{read_shape(table, "from", "what is cut"), read_parts(table, "without")};
      return make_shape(std::move(difference));
    }
    if (form == "box") {
      const auto box = read_struct<Box>(table);
      for (std::size_t k = 0; k < dimensions() && in.problem_count() == before; ++k)
        if (!(box.lower[k] < box.upper[k]))
          table.problem("upper", fmt::format("along {} it is {}, not above the lower corner's {}", axis_names[k],
                                             in_metres(box.upper[k]), in_metres(box.lower[k])));
      if (in.problem_count() == before && case_.geometry == Geometry::axisymmetric && box.lower[0] < 0.0)
        table.problem("lower", "r = " + in_metres(box.lower[0]) + "; a radius is not negative");
      return make_shape(box);
    }
    if (form == "sphere") {
      const auto sphere = read_struct<Sphere>(table);
      if (in.problem_count() == before && sphere.inner_radius >= sphere.radius)
        table.problem("inner_radius", "it must be less than the radius");
      if (in.problem_count() == before && case_.geometry == Geometry::axisymmetric && sphere.centre[0] != 0.0)
        table.problem("centre", "in the axisymmetric geometry it lies on the axis; give r = 0");
      return make_shape(sphere);
    }
    if (form == "cylinder") {
      const auto cylinder = read_struct<Cylinder>(table);
      const Cone cone{cylinder.start, cylinder.end, cylinder.radius, cylinder.radius};
      check_axis(cone);
      return make_shape(cone);
    }
    if (form == "tube") {
      const auto tube = read_struct<Tube>(table);
      const Cone cone{tube.start, tube.end, tube.radius, tube.radius, tube.inner_radius, tube.inner_radius};
      check_axis(cone);
      if (in.problem_count() == before && tube.inner_radius >= tube.radius)
        table.problem("inner_radius", "it must be less than the radius");
      return make_shape(cone);
    }
    const auto cone = read_struct<Cone>(table);
    check_axis(cone);
    if (in.problem_count() == before && cone.start_radius == 0.0 && cone.end_radius == 0.0)
      table.problem("end_radius", "both radii are zero; one may be");
    if (in.problem_count() == before &&
        (cone.inner_start_radius > cone.start_radius || cone.inner_end_radius > cone.end_radius))
      table.problem("the hole is wider than the cone");
    return make_shape(cone);
  }

  std::vector<ShapePointer> read_parts(TableReader& in, std::string_view key) {
    std::vector<ShapePointer> parts;
    const std::size_t before = in.problem_count();
    for (const TableReader& part : in.tables(key)) parts.push_back(read_shape(part));
    if (parts.empty() && in.problem_count() == before) in.problem(key, "a list of shapes is required, with at least one");
    return parts;
  }

  // --- What must hold beyond the single value -------------------------------------------------------------------------

  template <class Config>
  void require_own_name(TableReader& in, const Config& config, const std::vector<Config>& others) {
    const bool taken =
        std::any_of(others.begin(), others.end(), [&](const Config& other) { return other.name == config.name; });
    if (taken) in.problem("name", "the name " + in_quotes(config.name) + " is given twice; give each its own");
  }

  /// Names that become part of the names of files.
  static void require_file_name(TableReader& in, const std::string& name) {
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    if (!plain) in.problem("name", in_quotes(name) + ": it becomes part of file names; give letters, digits, _ and -");
  }

  void require_component_in_geometry(TableReader& in, Axis axis) {
    if (static_cast<std::size_t>(axis) >= dimensions()) in.problem("axis", "there is no z in two dimensions; give x or y");
  }

  /// The body that is meant: the only one if none is named.
  void resolve_body(TableReader& in, std::string& name, std::string_view whose) {
    if (name.empty() && case_.bodies.size() == 1) {
      name = case_.bodies.front().name;
    } else if (name.empty()) {
      in.problem(fmt::format("which body {} is of is unknown; give `body`", whose));
    } else {
      require_body(in, name);
    }
  }
  void require_body(TableReader& in, const std::string& name) {
    std::vector<std::string_view> names;
    for (const BodyConfig& body : case_.bodies) names.push_back(body.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      in.problem("body", "there is no solid " + in_quotes(name) + "; there is " + listed(names) + did_you_mean(name, names));
  }

  void check(TableReader& in, BodyConfig& body, const std::vector<BodyConfig>& others) {
    require_own_name(in, body, others);
    require_file_name(in, body.name);
    check_extent(in, body);
    for (const BodyConfig& other : others) check_overlap(in, body, other);
    check_velocity(in, body.velocity);
    if (body.porosity && !body.material.material.porosity)
      in.problem("porosity", "it would be ignored: the material has no [porosity] table");
    if (body.damage && !body.material.material.damage)
      in.problem("damage", "it would be ignored: the material has no [damage] table");
    if (body.strength && body.strength->weibull_modulus > 0.0 && body.strength->reference_volume == 0.0)
      in.problem("strength", "a Weibull distribution needs the volume its median belongs to; give reference_volume");
  }

  void check_extent(TableReader& in, const BodyConfig& body) {
    const Bounds extent = bounds(*body.shape, case_.geometry);
    for (std::size_t k = 0; k < dimensions(); ++k) {
      const double width = extent.upper[k] - extent.lower[k];
      if (!(width > 0.0)) return in.problem("shape", "it fills nothing: its parts do not meet");
      if (width < case_.cell_size * (1.0 - round_off))
        return in.problem("shape", fmt::format("along {} it is {} wide, less than one cell of {}", axis_names[k],
                                               in_metres(width), in_metres(case_.cell_size)));
    }
  }

  /// What is filled twice would weigh twice and push itself apart.
  void check_overlap(TableReader& in, const BodyConfig& body, const BodyConfig& other) {
    if (!body.shape || !other.shape || !(case_.cell_size > 0.0)) return;
    const Shape both{Intersection{{body.shape, other.shape}}};
    const int particles = std::max(body.particles_per_direction, other.particles_per_direction);
    const double spacing = case_.cell_size / (particles * samples_per_direction);
    const double shared = volume(both, case_.geometry, spacing);
    if (shared == 0.0) return;
    const Bounds where = bounds(both, case_.geometry);
    const auto corner = [&](const Vector& x) {
      return fmt::format("({:.6g})", fmt::join(std::span(x).first(dimensions()), ", "));
    };
    in.problem("shape",
               fmt::format("it fills about {:.2g} % of solid {} as well, between {} and {} m; two bodies are not in one "
                           "place: move one, or cut it by a difference",
                           100.0 * shared / volume(*other.shape, case_.geometry, spacing), in_quotes(other.name),
                           corner(where.lower), corner(where.upper)));
  }

  void check_velocity(TableReader& in, const InitialVelocity& velocity) {
    const Vector& spin = velocity.rotation;
    if (case_.geometry == Geometry::plane && (spin[0] != 0.0 || spin[1] != 0.0))
      in.problem("velocity", "in the plane geometry a body rotates about z alone");
    if (case_.geometry == Geometry::axisymmetric && spin != Vector{})
      in.problem("velocity", "in the axisymmetric geometry nothing rotates");
    if (case_.geometry == Geometry::axisymmetric && velocity.translation[0] != 0.0)
      in.problem("velocity", "in the axisymmetric geometry no body moves along r as a whole; give 0, or `radial`");
  }

  void check(TableReader& in, BoundaryConfig& boundary, const std::vector<BoundaryConfig>& others) {
    const std::size_t axis = static_cast<std::size_t>(boundary.axis);
    require_component_in_geometry(in, boundary.axis);
    if (boundary.name.empty())
      boundary.name = fmt::format("{}_{}_{}", choices<BoundaryKind>[static_cast<std::size_t>(boundary.kind)], axis_names[axis],
                                  choices<Side>[static_cast<std::size_t>(boundary.side)]);
    require_own_name(in, boundary, others);
    if ((boundary.kind == BoundaryKind::velocity) != (boundary.velocity.size > 0))
      in.problem("velocity", boundary.velocity.size > 0 ? "it would be ignored: the kind is not velocity"
                                                        : "missing: how the boundary moves, for its kind is velocity");
    if (boundary.kind != BoundaryKind::rigid_wall && boundary.friction > 0.0)
      in.problem("friction", "it would be ignored: the kind is not rigid_wall");
    if (axis >= dimensions() || !(case_.cell_size > 0.0)) return;
    const double cells = boundary.position / case_.cell_size;
    if (std::abs(cells - std::round(cells)) > round_off * std::max(1.0, std::abs(cells)))
      in.problem("position",
                 fmt::format("{} is on no plane of nodes; the nearest are {} and {}", in_metres(boundary.position),
                             in_metres(std::floor(cells) * case_.cell_size), in_metres(std::ceil(cells) * case_.cell_size)));
    if (boundary.velocity.size > 0) check_stroke(in, boundary);
    for (const BodyConfig& body : case_.bodies) check_side(in, boundary, axis, body);
  }

  /// In two dimensions the filled part of a sub-cell is known in sixteenths.
  void check_trimming(TableReader& in, const NumericsConfig& numerics) {
    constexpr double least = 1.0 / (samples_per_direction * samples_per_direction);
    if (geometry_known_ && dimensions() == 2 && numerics.trimming && *numerics.trimming > 0.0 && *numerics.trimming < least)
      in.problem("trimming",
                 fmt::format("it would be ignored: in two dimensions a sub-cell is sampled in {} places; give 0, or "
                             "{} and more",
                             samples_per_direction * samples_per_direction, least));
  }

  /// Figures are coloured by one number of each particle.
  void check_figure_field(TableReader& in, const std::string& field) {
    if (case_.gas) {
      if (in.has("figure_field")) check_gas_fields(in, {field}, "figure_field");
      return;
    }
    std::vector<std::string_view> scalars;
    for (const std::string_view name : gauge_fields)
      if (name != "position" && name != "velocity") scalars.push_back(name);
    if (std::find(scalars.begin(), scalars.end(), field) == scalars.end())
      in.problem("figure_field",
                 in_quotes(field) + " cannot be drawn; it must be one of " + listed(scalars) + did_you_mean(field, scalars));
  }

  /// The plane of a boundary with a velocity stays where its nodes are, so what it moves must stay near.
  void check_stroke(TableReader& in, const BoundaryConfig& boundary) {
    constexpr int parts = 1000;
    constexpr double most_cells = 0.5;
    double farthest = 0.0;
    for (int i = 1; i <= parts; ++i)
      farthest = std::max(farthest, std::abs(integral(boundary.velocity, case_.end_time * i / parts)));
    if (farthest > most_cells * case_.cell_size * (1.0 + round_off))
      in.problem(
          "velocity",
          fmt::format("it moves {}; the nodes it acts on stay where they are, so it may move half a cell, {}, at most; let the "
                      "body move against a rigid_wall or a plane of symmetry instead",
                      in_metres(farthest), in_metres(most_cells * case_.cell_size)));
  }

  /// Whether a shape fills any part of a box that lies within its bounds: those of a shape that was cut may be too wide.
  bool fills_part_of(const Shape& shape, const Bounds& box) {
    constexpr int samples = 24;
    return filled_fraction(shape, case_.geometry, box.lower, box.upper, samples) > 0.0;
  }

  /// Reports if a body reaches beyond the boundary.
  void check_side(TableReader& in, const BoundaryConfig& boundary, std::size_t axis, const BodyConfig& body) {
    if (!body.shape) return;
    const bool above = boundary.side == Side::above;
    const Bounds extent = bounds(*body.shape, case_.geometry);
    Bounds beyond = extent;
    const double least = round_off * case_.cell_size;
    if (above)
      beyond.upper[axis] = std::min(beyond.upper[axis], boundary.position - least);
    else
      beyond.lower[axis] = std::max(beyond.lower[axis], boundary.position + least);
    if (!(beyond.lower[axis] < beyond.upper[axis]) || !fills_part_of(*body.shape, beyond)) return;
    in.problem("side", fmt::format("solid \"{}\" reaches to {} = {}, {} the boundary at {}; the bodies must be {} it",
                                   body.name, axis_names[axis], in_metres((above ? extent.lower : extent.upper)[axis]),
                                   above ? "below" : "above", in_metres(boundary.position), above ? "above" : "below"));
  }

  void check(TableReader& in, FluidConfig& fluid, const std::vector<FluidConfig>& others) {
    require_own_name(in, fluid, others);
    if (equation_of_state::caloric(fluid.material.material.equation_of_state) == equation_of_state::Caloric::incremental)
      in.problem("material", "its equation of state gives differences of pressure only; a fluid needs p(rho, e)");
  }

  /// `elsewhere`: where else density and pressure come from; empty: nowhere.
  struct Elsewhere {
    std::string density, pressure;
  };
  template <class State>
  void check_gas_state(TableReader& in, State& state, const Elsewhere& elsewhere = {}) {
    if (state.fluid.empty() && gas_->fluids.size() == 1) {
      state.fluid = gas_->fluids.front().name;
    } else {
      std::vector<std::string_view> names;
      for (const FluidConfig& fluid : gas_->fluids) names.push_back(fluid.name);
      if (state.fluid.empty())
        in.problem("which fluid it is is unknown; give `fluid`, " + listed(names));
      else if (std::find(names.begin(), names.end(), state.fluid) == names.end())
        in.problem("fluid", "there is no fluid " + in_quotes(state.fluid) + "; there is " + listed(names) +
                                did_you_mean(state.fluid, names));
    }
    if (!in.has("pressure") && elsewhere.pressure.empty()) in.problem("pressure", "missing: the pressure of the gas");
    if (in.has("pressure") && !elsewhere.pressure.empty())
      in.problem("pressure", "it follows from " + elsewhere.pressure + "; give one of the two");
    if (!elsewhere.density.empty()) {
      if (state.density || state.temperature)
        in.problem(state.density ? "density" : "temperature",
                   "the density is in " + elsewhere.density + "; give one of the two");
    } else if (state.density.has_value() == state.temperature.has_value())
      in.problem(state.density ? "there are a density and a temperature; give one of the two"
                               : "neither density nor temperature is given; give one of the two");
    else if (state.pressure)
      check_exists(in, state);
  }
  void check(TableReader& in, FillConfig& fill, const std::vector<FillConfig>& others) {
    Elsewhere elsewhere;
    if (fill.profile) check_profile(in, *fill.profile, elsewhere);
    if (fill.energy) {
      if (!elsewhere.pressure.empty()) in.problem("energy", "the pressure is in the profile; give one of the two");
      if (!fill.shape) in.problem("shape", "missing: the region that the energy is put into");
      if (!fill.density) in.problem("density", "missing: an energy needs it");
      elsewhere.pressure = "the energy";
    }
    check_gas_state(in, fill, elsewhere);
    if (others.empty() && fill.shape) in.problem("shape", "the first [[gas.fill]] fills all of the box; leave it out");
  }
  void check_profile(TableReader& in, const ProfileConfig& profile, Elsewhere& elsewhere) {
    const bool radius = profile.along == ProfileAlong::radius;
    if (!radius && static_cast<std::size_t>(profile.along) >= dimensions())
      in.problem("profile", fmt::format("there is no {} in this geometry; give a coordinate that it has, or radius",
                                        choices<ProfileAlong>[static_cast<std::size_t>(profile.along)]));
    if (!radius && profile.centre != Vector{}) in.problem("profile", "its centre would be ignored: it is not along radius");
    if (is_round(case_.geometry) && profile.centre[0] != 0.0) in.problem("profile", "its centre lies on the axis; give r = 0");
    try {
      const gas::StateProfile read = gas::read_state_profile(profile);
      if (!read.velocity_around.empty() && !(radius && case_.geometry == Geometry::plane))
        in.problem("profile", "velocity_around needs the plane geometry and along = \"radius\"");
      if (!read.density.empty()) elsewhere.density = "the profile";
      if (!read.pressure.empty()) elsewhere.pressure = "the profile";
    } catch (const InputError& error) {
      in.add_problems(error.problems());
    }
  }
  void check(TableReader& in, EdgeConfig& edge, const std::vector<EdgeConfig>& others) {
    const auto same_side = [&](const EdgeConfig& other) { return other.side == edge.side; };
    if (std::any_of(others.begin(), others.end(), same_side)) in.problem("side", "this side is given twice; give each once");
    if (static_cast<std::size_t>(edge.side) / 2 >= dimensions())
      in.problem("side", fmt::format("in {} dimension{} there is no such side", dimensions(), dimensions() == 1 ? "" : "s"));
    // A velocity of zero says nothing: a case that a run has written holds one at every edge.
    const bool more = in.has("density") || in.has("temperature") || edge.velocity != Vector{} || in.has("fluid");
    if (edge.kind == EdgeKind::inflow || edge.kind == EdgeKind::non_reflecting) {
      check_gas_state(in, edge);
    } else if (edge.kind == EdgeKind::pressure) {
      if (!in.has("pressure")) in.problem("pressure", "missing: the pressure beyond");
      if (more) in.problem("only the pressure counts beyond an edge of this kind; remove the rest, or make it non_reflecting");
    } else if (edge.kind == EdgeKind::no_slip) {
      if (in.has("pressure") || in.has("density") || in.has("fluid"))
        in.problem("of a wall only its velocity and temperature count; remove the rest");
      if (edge.velocity[static_cast<std::size_t>(edge.side) / 2] != 0.0)
        in.problem("velocity", "a wall moves along itself only; make the component across it 0");
    } else if (more || in.has("pressure")) {
      in.problem("a state would be ignored: nothing comes through a wall or from beyond a period");
    }
  }
  /// Nothing is said of viscosity and heat that would go unheard.
  void check_transport(TableReader& in, const GasConfig& gas) {
    const auto any_fluid = [&](double FluidConfig::*property) {
      return std::any_of(gas.fluids.begin(), gas.fluids.end(), [&](const FluidConfig& f) { return f.*property > 0.0; });
    };
    if (gas.heat_exchange > 0.0 && gas.fluids.size() == 1)
      in.problem("heat_exchange", "it would be ignored: there is one fluid; remove it");
    for (const EdgeConfig& edge : gas.edges) {
      if (edge.kind != EdgeKind::no_slip) continue;
      const std::string_view side = choices<BoxSide>[static_cast<std::size_t>(edge.side)];
      if (!any_fluid(&FluidConfig::viscosity))
        in.problem(
            "edge",
            fmt::format("{}: nothing sticks to a wall without viscosity; give a fluid one, or leave the edge out", side));
      if (edge.temperature && !any_fluid(&FluidConfig::conductivity))
        in.problem("edge",
                   fmt::format("{}: its temperature would be ignored: no fluid conducts; give one a conductivity", side));
    }
  }
  /// The limits of simulator/gas/bodies.hpp.
  void check_with_bodies(TableReader& in, const GasConfig& gas) {
    const auto refuse = [&](bool when, std::string_view what) {
      if (when) in.problem("body", std::string(what) + " in a gas with bodies is not possible; remove one of the two");
    };
    refuse(case_.gravity != Vector{}, "gravity");
    refuse(gas.implicit, "the implicit option");
    refuse(gas.scheme == GasScheme::ice_classic, "the classic scheme");
    refuse(!gas.reactions.empty(), "a reaction");
    refuse(gas.heat_exchange > 0.0 || std::any_of(gas.fluids.begin(), gas.fluids.end(),
                                                  [](const FluidConfig& f) {
                                                    return f.viscosity > 0.0 || f.bulk_viscosity > 0.0 || f.conductivity > 0.0;
                                                  }),
           "viscosity or conduction");
    refuse(std::any_of(gas.fills.begin(), gas.fills.end(), [](const FillConfig& f) { return f.energy.has_value(); }),
           "the energy of a fill");
  }
  /// The limits of simulator/gas/classic.hpp.
  void check_classic(TableReader& in, const GasConfig& gas) {
    const auto refuse = [&](bool when, std::string_view reason) {
      if (when) in.problem("scheme", "ice_classic " + std::string(reason));
    };
    refuse(is_round(case_.geometry), "has no round geometries; use planar_1d, plane or three_dimensional, or scheme = \"ice\"");
    refuse(std::any_of(gas.edges.begin(), gas.edges.end(),
                       [](const EdgeConfig& e) { return e.kind != EdgeKind::wall && e.kind != EdgeKind::periodic; }),
           "has walls and periodic sides only; remove the other edges, or use scheme = \"ice\"");
    refuse(case_.gravity != Vector{}, "has no gravity; remove it, or use scheme = \"ice\"");
    refuse(gas.least_mach != GasConfig{}.least_mach, "has no dissipation of faces; remove least_mach, or use scheme = \"ice\"");
    refuse(gas.implicit, "is explicit; remove implicit, or use scheme = \"ice\"");
    refuse(
        std::any_of(gas.fluids.begin(), gas.fluids.end(),
                    [](const FluidConfig& f) { return f.viscosity > 0.0 || f.bulk_viscosity > 0.0 || f.conductivity > 0.0; }),
        "has no viscosity or conduction; remove them, or use scheme = \"ice\"");
    refuse(!gas.reactions.empty(), "has no reactions; remove them, or use scheme = \"ice\"");
  }
  static void check(TableReader&, IgnitionConfig&, const std::vector<IgnitionConfig>&) {}
  void check(TableReader& in, ReactionConfig& reaction, const std::vector<ReactionConfig>& others) {
    require_own_name(in, reaction, others);
    std::vector<std::string_view> names;
    for (const FluidConfig& fluid : gas_->fluids) names.push_back(fluid.name);
    const auto find = [&](std::string_view key, const std::string& name) -> const FluidConfig* {
      for (const FluidConfig& fluid : gas_->fluids)
        if (fluid.name == name) return &fluid;
      in.problem(key, "there is no fluid " + in_quotes(name) + "; there is " + listed(names) + did_you_mean(name, names));
      return nullptr;
    };
    const FluidConfig* reactant = find("reactant", reaction.reactant);
    find("product", reaction.product);
    if (reaction.reactant == reaction.product) in.problem("product", "a fluid cannot burn to itself; name another fluid");
    const auto burns_too = [&](const ReactionConfig& other) { return other.reactant == reaction.reactant; };
    if (std::any_of(others.begin(), others.end(), burns_too))
      in.problem("reactant",
                 in_quotes(reaction.reactant) + " burns in another [[gas.reaction]] already; each fluid has one law");
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
      if (ignition.shape && !gas::distance(*ignition.shape, {}))
        in.problem("ignition",
                   "a programmed detonation starts from boxes, spheres and unions of them; distances to other shapes "
                   "are not known");
  }
  void check(TableReader& in, GasBodyConfig& body, const std::vector<GasBodyConfig>& others) {
    require_own_name(in, body, others);
    require_file_name(in, body.name);
    if (!geometry_known_) return;
    if (dimensions() == 1) return in.problem("in one dimension there are no bodies in the gas; take plane");
    require_component_in_geometry(in, body.axis);
    const bool round = is_round(case_.geometry);
    if (body.mass) {
      if (body.velocity != Vector{} || body.rotation != Vector{} || body.radial_velocity != 0.0 || body.amplitude)
        in.problem("mass", "the gas drives a body with a mass from rest: a motion would be ignored; remove one of the two");
      if (round && body.axis != Axis::y) in.problem("axis", "about an axis of symmetry a body can only move along it: y");
    } else {
      if (body.axis != Axis::x) in.problem("axis", "it would be ignored: only a body with a mass is driven along it");
      const bool turns = body.rotation != Vector{} || body.radial_velocity != 0.0;
      if (body.centre != Vector{} && !turns) in.problem("centre", "it would be ignored: the body neither turns nor grows");
      if (body.amplitude && !turns && body.velocity == Vector{})
        in.problem("amplitude", "it would be ignored: there is no velocity that it is a factor on");
      if (round && body.velocity[0] != 0.0) in.problem("velocity", "about an axis of symmetry a body can only move along it");
      if (round && body.rotation != Vector{}) in.problem("rotation", "about an axis of symmetry a body cannot turn");
      if (!round && dimensions() == 2 && (body.rotation[0] != 0.0 || body.rotation[1] != 0.0))
        in.problem("rotation", "in the plane a body can only turn about z; give [0, 0, ...]");
    }
    if (round && body.radial_velocity != 0.0 && body.centre[0] != 0.0)
      in.problem("centre", "about an axis of symmetry the centre of a radial motion lies on it: x = 0");
    if ((body.radial_velocity != 0.0) != (body.radius > 0.0))
      in.problem(body.radius > 0.0 ? "radius" : "radial_velocity", body.radius > 0.0
                                                                       ? "it would be ignored: there is no radial velocity"
                                                                       : "give `radius` as well: where it is so");
  }
  /// A state that the fluid's law does not have.
  void check_exists(TableReader& in, const GasStateConfig& state) {
    for (const FluidConfig& fluid : gas_->fluids) {
      if (fluid.name != state.fluid) continue;
      namespace eos = equation_of_state;
      const EquationOfState& law = fluid.material.material.equation_of_state;
      if (eos::caloric(law) != eos::Caloric::complete) continue;
      const double density = state.density ? *state.density : eos::density_at(law, *state.pressure, *state.temperature);
      constexpr double close = 1e-3;
      if (density > 0.0) {
        const double energy = eos::energy_at_pressure(law, density, *state.pressure), p = eos::pressure(law, density, energy);
        if (std::abs(p - *state.pressure) <= close * std::abs(*state.pressure)) continue;
        in.problem("pressure", fmt::format("at {:.6g} kg/m^3 {} has no state with {:.6g} Pa; the nearest is {:.6g} Pa", density,
                                           in_quotes(fluid.name), *state.pressure, p));
      } else {
        in.problem("pressure", fmt::format("{} has no state with {:.6g} Pa and {:.6g} K", in_quotes(fluid.name),
                                           *state.pressure, *state.temperature));
      }
    }
  }
  void check_box(TableReader& in, GasConfig& gas) {
    for (std::size_t k = 0; k < dimensions() && case_.cell_size > 0.0; ++k) {
      if (!(gas.lower[k] < gas.upper[k]))
        in.problem("upper", fmt::format("along {} the box ends before it begins", axis_names[k]));
      for (const auto& [name, corner] : {std::pair{"lower", gas.lower[k]}, std::pair{"upper", gas.upper[k]}}) {
        const double cells = corner / case_.cell_size;
        if (std::abs(cells - std::round(cells)) > round_off * std::max(1.0, std::abs(cells)))
          in.problem(name, fmt::format("along {} {} is on no plane of nodes; the nearest are {} and {}", axis_names[k],
                                       in_metres(corner), in_metres(std::floor(cells) * case_.cell_size),
                                       in_metres(std::ceil(cells) * case_.cell_size)));
      }
      const double cells = (gas.upper[k] - gas.lower[k]) / case_.cell_size;
      constexpr double least = 4.0;
      if (cells < least - round_off)
        in.problem("upper", fmt::format("along {} the box is {:.3g} cells wide; {:g} at least", axis_names[k], cells, least));
    }
    if (gas.acoustic_courant != GasConfig{}.acoustic_courant && !gas.implicit)
      in.problem("acoustic_courant", "it would be ignored: it is the Courant number of implicit = true");
    if (gas.courant != 0.0 && gas.implicit)
      in.problem("courant", "it would be ignored: the steps of implicit = true are those of acoustic_courant");
    if (gas.momentum_exchange != GasConfig{}.momentum_exchange && gas.scheme != GasScheme::ice_classic)
      in.problem("momentum_exchange",
                 "it would be ignored: fluids of a cell have one velocity but with scheme = \"ice_classic\"");
    if (gas.scheme == GasScheme::ice_classic) check_classic(in, gas);
    check_transport(in, gas);
    const bool round = is_round(case_.geometry);
    if (round && gas.lower[0] < 0.0) in.problem("lower", "r = " + in_metres(gas.lower[0]) + "; a radius is not negative");
    if (round && case_.gravity[0] != 0.0) in.problem("lower", "gravity along r is not possible");
    if (!gas.bodies.empty()) check_with_bodies(in, gas);
    for (const EdgeConfig& edge : gas.edges) {
      const auto number = static_cast<std::size_t>(edge.side);
      const auto opposite = static_cast<BoxSide>(number ^ 1);
      const bool both = std::any_of(gas.edges.begin(), gas.edges.end(), [&](const EdgeConfig& other) {
        return other.side == opposite && other.kind == EdgeKind::periodic;
      });
      if (edge.kind == EdgeKind::periodic && !both)
        in.problem("edge",
                   fmt::format("{} is periodic, {} is not; give both", choices<BoxSide>[number], choices<BoxSide>[number ^ 1]));
      if (edge.kind == EdgeKind::periodic && round && number < 2) in.problem("edge", "along r nothing is periodic");
      if (round && edge.side == BoxSide::low_x && gas.lower[0] == 0.0 && edge.kind != EdgeKind::wall)
        in.problem("edge", "low_x is the axis; it can be nothing else");
    }
  }

  void check(TableReader& in, LoadConfig& load, const std::vector<LoadConfig>&) {
    resolve_body(in, load.body, "the load");
    const bool traction = load.traction != Vector{};
    if (load.pressure.has_value() == traction)
      in.problem(traction ? "there are a pressure and a traction; give one of the two in each [[load]]"
                          : "nothing acts; give pressure or traction");
    else if (load.amplitude && !traction)
      in.problem("amplitude", "it would be ignored: it is a factor on the traction");
  }

  void check(TableReader& in, GaugeConfig& gauge, const std::vector<GaugeConfig>& others) {
    require_own_name(in, gauge, others);
    check_surface(in, gauge);
    if (!gauge.body.empty()) require_body(in, gauge.body);
    if (case_.gas) return check_gas_gauge(in, gauge);
    check_place(in, gauge);
    for (const std::string& field : gauge.fields)
      if (std::find(gauge_fields.begin(), gauge_fields.end(), field) == gauge_fields.end())
        in.problem("fields", in_quotes(field) + " cannot be recorded; it must be one of " + listed(gauge_fields) +
                                 did_you_mean(field, gauge_fields));
    if (gauge.kind == GaugeKind::plane)
      for (std::size_t k = 0; k < dimensions(); ++k)
        if (!(gauge.from[k] < gauge.to[k]))
          in.problem("to",
                     fmt::format("along {} the box ends before it begins; give it a thickness of about a cell", axis_names[k]));
    if (gauge.kind == GaugeKind::point) {
      if (gauge.to != Vector{}) in.problem("to", "it would be ignored: a point is where `from` says");
    } else if (gauge.from == gauge.to) {
      in.problem("to", "it is where `from` is; only a point has no extent");
    }
  }

  /// A gauge that would never see any material.
  void check_place(TableReader& in, const GaugeConfig& gauge) {
    const bool extended = gauge.kind != GaugeKind::point;
    Bounds place{gauge.from, gauge.from};
    for (std::size_t k = 0; extended && k < dimensions(); ++k)
      place.lower[k] = std::min(gauge.from[k], gauge.to[k]), place.upper[k] = std::max(gauge.from[k], gauge.to[k]);
    const auto sought_along = [&](std::size_t axis) {
      return gauge.kind == GaugeKind::surface && gauge.axis && static_cast<std::size_t>(*gauge.axis) == axis;
    };
    if (case_.geometry == Geometry::axisymmetric && place.upper[0] < 0.0 && !sought_along(0))
      return in.problem("from", "r = " + in_metres(place.upper[0]) + "; a radius is not negative");
    for (const BoundaryConfig& b : case_.boundaries) {
      const auto axis = static_cast<std::size_t>(b.axis);
      if (b.side == Side::above ? place.upper[axis] >= b.position : place.lower[axis] <= b.position) continue;
      if (!sought_along(axis))
        return in.problem("from", fmt::format("it lies beyond the boundary {} at {} = {}, where there is never any material",
                                              in_quotes(b.name), axis_names[axis], in_metres(b.position)));
    }
    if (!gauge.moves.value_or(true) || gauge.kind == GaugeKind::surface || case_.bodies.empty()) return;
    const bool starts_in_material = std::any_of(case_.bodies.begin(), case_.bodies.end(), [&](const BodyConfig& body) {
      return body.shape && (gauge.body.empty() || body.name == gauge.body) && is_near(*body.shape, gauge, place);
    });
    if (!starts_in_material)
      in.problem("from", fmt::format("{} is more than a cell away from {}; what moves with the material starts in it: give "
                                     "another place, or moves = false",
                                     extended ? "all of it" : "it",
                                     gauge.body.empty() ? "all solids" : "solid " + in_quotes(gauge.body)));
  }

  /// Whether a shape fills anything within a cell of a gauge's place.
  bool is_near(const Shape& shape, const GaugeConfig& gauge, const Bounds& place) {
    const Bounds extent = bounds(shape, case_.geometry);
    const auto near = [&](Bounds box) {
      for (std::size_t k = 0; k < dimensions(); ++k) {
        box.lower[k] = std::max(box.lower[k] - case_.cell_size, extent.lower[k]);
        box.upper[k] = std::min(box.upper[k] + case_.cell_size, extent.upper[k]);
        if (!(box.lower[k] < box.upper[k])) return false;
      }
      return fills_part_of(shape, box);
    };
    if (gauge.kind == GaugeKind::plane) return near(place);
    const std::vector<Vector> places = places_of(gauge, case_.cell_size);
    return std::any_of(places.begin(), places.end(), [&](const Vector& x) { return near({x, x}); });
  }

  void check_gas_gauge(TableReader& in, GaugeConfig& gauge) {
    if (gauge.kind != GaugeKind::point && gauge.kind != GaugeKind::line)
      in.problem("kind", "in gas a gauge is a point or a line");
    if (gauge.moves.value_or(false)) in.problem("moves", "in gas a gauge stands still");
    if (!gauge.body.empty()) in.problem("body", "it would be ignored: in gas a gauge watches the gas alone");
    gauge.moves = false;
    check_gas_fields(in, gauge.fields);
    check_in_box(in, gauge.from, gauge.kind == GaugeKind::line ? gauge.to : gauge.from);
  }
  void check_gas_fields(TableReader& in, const std::vector<std::string>& fields, std::string_view key = "fields") {
    std::vector<std::string> fluids, names;
    for (const FluidConfig& fluid : case_.gas->fluids) fluids.push_back(fluid.name);
    for (const gas::Field& field : gas::fields(case_.dimensions(), fluids)) names.push_back(field.name);
    const std::vector<std::string_view> allowed(names.begin(), names.end());
    for (const std::string& field : fields)
      if (std::find(names.begin(), names.end(), field) == names.end())
        in.problem(key, in_quotes(field) + " is not known of gas; it must be one of " + listed(allowed) +
                            did_you_mean(field, allowed));
  }
  void check_in_box(TableReader& in, const Vector& from, const Vector& to) {
    for (std::size_t k = 0; k < dimensions(); ++k)
      for (const Vector& place : {from, to})
        if (place[k] < case_.gas->lower[k] || place[k] > case_.gas->upper[k])
          return in.problem("from", fmt::format("along {} it leaves the box of the gas", axis_names[k]));
  }

  /// A surface is sought along an axis and goes with the material; the other kinds know neither axis nor side.
  void check_surface(TableReader& in, const GaugeConfig& gauge) {
    if (gauge.axis) require_component_in_geometry(in, *gauge.axis);
    const bool surface = gauge.kind == GaugeKind::surface;
    if (surface && !gauge.axis) in.problem("axis", "missing: the direction in which the surface is sought");
    if (surface && gauge.moves) in.problem("moves", "it would be ignored: a surface is where the material ends");
    if (!surface && gauge.axis) in.problem("axis", "it would be ignored: the kind is not surface");
    if (!surface && gauge.side) in.problem("side", "it would be ignored: the kind is not surface");
  }

  void check(TableReader& in, MeasureConfig& measure, const std::vector<MeasureConfig>& others) {
    resolve_body(in, measure.body, "the measure");
    require_component_in_geometry(in, measure.axis);
    if (measure.name.empty()) {
      measure.name = choices<MeasureKind>[static_cast<std::size_t>(measure.kind)];
      if (measure.kind == MeasureKind::diameter_at) measure.name += fmt::format("_{}", measure.at);
    }
    require_own_name(in, measure, others);
    if ((measure.kind == MeasureKind::diameter_at) != (measure.at > 0.0))
      in.problem("at", measure.at > 0.0 ? "it would be ignored: the kind is not diameter_at"
                                        : "missing: where along the initial length, > 0 and up to 1");
    if ((measure.kind == MeasureKind::profile_error) == measure.profile.empty())
      in.problem("profile", measure.profile.empty() ? "missing: the CSV file of the measured profile"
                                                    : "it would be ignored: the kind is not profile_error");
    if (measure.kind == MeasureKind::profile_error && measure.measured)
      in.problem("measured", "the error against the measured profile would be zero; remove it");
    if (!measure.profile.empty()) {
      try {
        const CsvFile csv = CsvFile::load(measure.profile);
        static_cast<void>(csv.numbers("radius", Unit::m)), static_cast<void>(csv.numbers("height", Unit::m));
      } catch (const InputError& error) {
        in.add_problems(error.problems());
      }
    }
  }

  void check(TableReader& in, FigureConfig& figure, const std::vector<FigureConfig>& others) {
    require_own_name(in, figure, others);
    require_file_name(in, figure.name);
    if (!figure.body.empty() && case_.gas) in.problem("body", "it would be ignored: it is a figure of the gas");
    if (!figure.body.empty() && !case_.gas) require_body(in, figure.body);
    const std::size_t before = in.problem_count();
    if (case_.gas) check_gas_fields(in, figure.fields), check_in_box(in, figure.from, figure.to);
    const std::span drawable = std::span(gauge_fields).subspan(1);  // all but the position
    for (const std::string& field : figure.fields)
      if (!case_.gas && std::find(drawable.begin(), drawable.end(), field) == drawable.end())
        in.problem("fields", in_quotes(field) + " cannot be drawn; it must be one of " + listed(drawable) +
                                 did_you_mean(field, drawable));
    if (figure.fields.empty()) in.problem("fields", "there is nothing to draw; give one or more of " + listed(drawable));
    if (figure.from == figure.to) in.problem("to", "it is where `from` is; a line has a length");
    if (in.problem_count() > before || figure.reference.empty()) return;
    try {
      static_cast<void>(read_reference(figure));
    } catch (const InputError& error) {
      in.add_problems(error.problems());
    }
  }

  Case case_;
  GasConfig* gas_ = nullptr;  // that is being read
  bool geometry_known_ = true;
};

/// A change of a value of a material file that a body asks for.
struct MaterialChange {
  std::string material;    // path of the key that names the file: "solid.0.material"
  std::string assignment;  // within the file: "flow_stress.A = 95 MPa"

  std::string path() const { return assignment.substr(0, assignment.find_last_not_of(" =", assignment.find('=')) + 1); }
};

std::vector<MaterialChange> changes_in(const Path& file, const std::vector<std::string>& overrides) {
  InputFile input = InputFile::load(file);
  for (const std::string& assignment : overrides) input.set(assignment);
  std::vector<MaterialChange> changes;
  const auto look = [&](std::vector<TableReader> tables) {
    for (TableReader& table : tables)
      for (const std::string& change : table.optional_texts("material_changes").value_or(std::vector<std::string>{}))
        changes.push_back({table.path_of("material"), change});
  };
  TableReader top = input.top();
  look(top.tables("solid"));
  if (top.is_table("gas")) look(top.table("gas").tables("fluid"));
  return changes;
}

/// A wrong change is reported like an override from the command line; the user wrote it in the file.
void place_in_file(std::vector<Problem>& problems, const std::vector<MaterialChange>& changes, const Path& file) {
  for (Problem& problem : problems)
    for (const MaterialChange& change : changes)
      if (problem.file == "--set " + change.path() || problem.file == "--set " + change.material + '.' + change.path()) {
        problem.file = file.string();
        problem.key = change.material + "_changes: " + change.path();
      }
}

}  // namespace

Case read_case(const Path& file, const std::vector<std::string>& overrides) {
  const std::vector<MaterialChange> changes = changes_in(file, overrides);
  InputFile input = InputFile::load(file);
  for (const MaterialChange& change : changes) input.set(change.material + '.' + change.assignment);
  for (const std::string& assignment : overrides) input.set(assignment);
  TableReader top = input.top();
  Case result = CaseReader().read(top);
  result.file = file;
  std::vector<Problem> problems = input.problems();
  place_in_file(problems, changes, file);
  if (!problems.empty()) throw InputError(std::move(problems));
  return result;
}

}  // namespace brisance::simulator
