#include "simulator/case_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "models/input/table_reader.hpp"
#include "simulator/case_checks.hpp"
#include "simulator/gas/case_checks.hpp"
#include "simulator/keys.hpp"
#include "simulator/output/gauges.hpp"
#include "simulator/output/line_out.hpp"
#include "simulator/output/measures.hpp"
#include "simulator/solid/shapes.hpp"
#include "simulator/table.hpp"

namespace brisance::simulator {
namespace {

using Path = std::filesystem::path;

template <class Form>
ShapePointer make_shape(Form form) {
  return std::make_shared<const Shape>(Shape{std::move(form)});
}

class CaseReader : public KeyReader<CaseReader> {
 public:
  Case read(TableReader& top) {
    if (!top.has("geometry") && (top.has("segment") || top.has("experiment"))) {
      top.problem("it is a file of the point driver, not a case of the simulator; `pointdriver` reads it");
      top.ignore_rest();
      return std::move(case_);
    }
    if (top.has("solid") && top.is_table("gas")) {  // what each of the two refuses would be said of the other
      top.problem("gas", "a case holds either solids or gas, not yet both; rigid bodies in a gas are [[gas.body]]");
      top.ignore_rest();
      return std::move(case_);
    }
    read_keys(top, case_);
    if (case_.title.empty()) case_.title = top.file().stem().string();
    if (case_.gas && case_.output.figure_field == OutputConfig{}.figure_field) case_.output.figure_field = "density";
    if (case_.bodies.empty() && !case_.gas && (!top.has("solid") || top.problem_count() == 0))
      top.problem("there is no [[solid]] and no [gas]; a case has one of them");
    if (!case_.bodies.empty() && geometry_known(top) && dimensions() == 1)
      top.problem("geometry", "in one dimension there is gas alone; solids need plane, axisymmetric or three_dimensional");
    if (top.valid({"geometry", "cell_size", "boundary"})) {
      std::vector<TableReader> tables = top.tables("boundary");
      for (std::size_t b = 0; b < case_.boundaries.size(); ++b) check_stroke(tables[b], case_.boundaries[b]);
    }
    if (case_.gas) {
      for (const char* key : {"boundary", "load"})
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
  template <class K>
  void read_value(TableReader& in, const K& key, Vector& value) {
    // Without a geometry two components are as good as three.
    const Length length = key.components == Components::three ? exactly(3)
                          : geometry_known(in)                ? exactly(dimensions())
                                                              : Length{1, 3};
    const std::vector<double> numbers = in.numbers(key.name, quantity(key), length);
    std::copy_n(numbers.begin(), std::min(numbers.size(), value.size()), value.begin());
  }
  /// Of what lies beyond an edge, formulas may speak of the time.
  template <class Config, class T>
  Varying varying(TableReader& in, const Key<Config, T>& key, const NumberOrText& given) {
    if (given.text.empty()) return given.number;
    try {
      const int all = 3;  // without a geometry
      return Varying(std::make_shared<const Formula>(given.text, geometry_known(in) ? case_.dimensions() : all,
                                                     std::is_same_v<Config, EdgeConfig>));
    } catch (const std::invalid_argument& error) {
      in.problem(key.name, std::string(error.what()) + "; or give " + allowed_texts(key.unit));
      return {};
    }
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<Varying>& value) {
    value = varying(in, key, in.number_or_text(key.name, quantity(key)));
  }
  template <class K>
  void read_value(TableReader& in, const K& key, VaryingVector& value) {
    const Length length = geometry_known(in) ? exactly(dimensions()) : Length{1, 3};
    const std::vector<NumberOrText> given = in.numbers_or_texts(key.name, quantity(key), length);
    for (std::size_t a = 0; a < std::min(given.size(), value.components.size()); ++a)
      value.components[a] = varying(in, key, given[a]);
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
    const std::size_t before = in.problem_count();
    value = read_shape(in, key.name, key.meaning);
    if (in.problem_count() > before) value = nullptr;  // what it fills is unknown
  }
  template <class K>
  void read_value(TableReader& in, const K& key, InitialVelocity& value) {
    if (in.is_table(key.name))
      value = read_struct<InitialVelocity>(in.table(key.name));
    else
      read_value(in, key, value.translation);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<InitialPorosity>& value) {
    TableReader table = in.table(key.name);
    read_law(table, value.emplace());
  }
  /// What was measured has the unit of the kind, which stands before it among the keys.
  void read_value(TableReader& in, const Key<MeasureConfig, std::optional<double>>& key, std::optional<double>& value) {
    Quantity wanted = quantity(key);
    if (key.member == &MeasureConfig::measured) {
      if (!in.valid({"kind"})) return;
      wanted.unit = unit_of(in.choice<MeasureKind>("kind"));
    }
    value = in.number(key.name, wanted);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, std::optional<GasConfig>& value) {
    TableReader table = in.table(key.name);
    read_keys(table, value.emplace());
    gas::check_gas(table, case_);
  }
  template <class K, class Config>
  void read_value(TableReader& in, const K& key, std::vector<Config>& value) {
    std::vector<TableReader> tables = in.tables(key.name);
    if (key.required && tables.empty() && in.valid({key.name}))
      in.problem(key.name, fmt::format("missing: {}; begin one by [[{}]]", key.meaning, in.path_of(key.name)));
    for (TableReader& table : tables) {
      if constexpr (std::is_same_v<Config, BodyConfig> || std::is_same_v<Config, FluidConfig>)
        table.optional_texts("material_changes");  // read_case applied them
      Config config{};
      read_keys(table, config);
      check(table, config, value);
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
    if (form == "difference") {
      Difference difference{read_shape(table, "from", "what is cut"), read_parts(table, "without")};
      return make_shape(std::move(difference));
    }
    if (form == "box") return read_simple_shape<Box>(table);
    if (form == "sphere") return read_simple_shape<Sphere>(table);
    if (form == "cylinder") return read_simple_shape<Cylinder>(table);
    if (form == "tube") return read_simple_shape<Tube>(table);
    return read_simple_shape<Cone>(table);
  }

  /// A shape of numbers alone. What it is as a whole is judged if each number is valid.
  template <class Form>
  ShapePointer read_simple_shape(TableReader& table) {
    const std::size_t before = table.problem_count();
    const Form form = read_struct<Form>(table);
    if (table.problem_count() == before) check_form(table, form);
    return make_shape(as_drawn(form));
  }
  static const Box& as_drawn(const Box& box) { return box; }
  static const Sphere& as_drawn(const Sphere& sphere) { return sphere; }
  static const Cone& as_drawn(const Cone& cone) { return cone; }
  static Cone as_drawn(const Cylinder& c) { return {c.start, c.end, c.radius, c.radius}; }
  static Cone as_drawn(const Tube& t) { return {t.start, t.end, t.radius, t.radius, t.inner_radius, t.inner_radius}; }

  void check_form(TableReader& table, const Box& box) {
    const std::size_t before = table.problem_count();
    for (std::size_t k = 0; geometry_known(table) && k < dimensions() && table.problem_count() == before; ++k)
      if (!(box.lower[k] < box.upper[k]))
        table.problem("upper", fmt::format("along {} it is {}, not above the lower corner's {}", axis_names[k],
                                           in_metres(box.upper[k]), in_metres(box.lower[k])));
    if (table.problem_count() == before && case_.geometry == Geometry::axisymmetric && box.lower[0] < 0.0)
      table.problem("lower", "x = " + in_metres(box.lower[0]) + "; a radius is not negative");
  }
  void check_form(TableReader& table, const Sphere& sphere) {
    if (sphere.inner_radius >= sphere.radius)
      table.problem("inner_radius", "it must be less than the radius");
    else if (case_.geometry == Geometry::axisymmetric && sphere.centre[0] != 0.0)
      table.problem("centre", "in the axisymmetric geometry it lies on the axis; give x = 0");
  }
  void check_form(TableReader& table, const Cylinder& cylinder) { check_axis(table, cylinder.start, cylinder.end); }
  void check_form(TableReader& table, const Tube& tube) {
    const std::size_t before = table.problem_count();
    check_axis(table, tube.start, tube.end);
    if (table.problem_count() == before && tube.inner_radius >= tube.radius)
      table.problem("inner_radius", "it must be less than the radius");
  }
  void check_form(TableReader& table, const Cone& cone) {
    const std::size_t before = table.problem_count();
    check_axis(table, cone.start, cone.end);
    if (table.problem_count() > before) return;
    if (cone.start_radius == 0.0 && cone.end_radius == 0.0)
      table.problem("end_radius", "both radii are zero; one may be");
    else if (cone.inner_start_radius > cone.start_radius || cone.inner_end_radius > cone.end_radius)
      table.problem("the hole is wider than the cone");
  }
  void check_axis(TableReader& table, const Vector& start, const Vector& end) {
    if (start == end) table.problem("end", "it is where the start is; a solid of revolution has a length");
    if (case_.geometry == Geometry::axisymmetric && (start[0] != 0.0 || end[0] != 0.0))
      table.problem(start[0] != 0.0 ? "start" : "end", "in the axisymmetric geometry it lies on the axis; give x = 0");
  }

  std::vector<ShapePointer> read_parts(TableReader& in, std::string_view key) {
    std::vector<ShapePointer> parts;
    const std::size_t before = in.problem_count();
    for (const TableReader& part : in.tables(key)) parts.push_back(read_shape(part));
    if (parts.empty() && in.problem_count() == before) in.problem(key, "a list of shapes is required, with at least one");
    return parts;
  }

  // --- What must hold beyond the single value -------------------------------------------------------------------------

  /// The tables of the gas.
  template <class Config>
  void check(TableReader& in, Config& config, const std::vector<Config>& others) {
    gas::check(in, config, others, case_);
  }

  /// Each check below is done if what it rests on is valid, whatever else is wrong: all problems are reported at once.

  /// Whether names of bodies can be looked up.
  bool names_known() const {
    return !case_.bodies.empty() &&
           std::none_of(case_.bodies.begin(), case_.bodies.end(), [](const BodyConfig& body) { return body.name.empty(); });
  }
  /// The body that is meant: the only one if none is named.
  void resolve_body(TableReader& in, std::string& name, std::string_view whose) {
    if (name.empty() && case_.bodies.size() == 1) {
      name = case_.bodies.front().name;
    } else if (name.empty() && names_known() && in.valid({"body"})) {
      in.problem(fmt::format("which body {} is of is unknown; give `body`", whose));
    } else {
      require_body(in, name);
    }
  }
  void require_body(TableReader& in, const std::string& name) {
    if (!names_known() || !in.valid({"body"})) return;
    std::vector<std::string_view> names;
    for (const BodyConfig& body : case_.bodies) names.push_back(body.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      in.problem("body", "there is no solid " + in_quotes(name) + "; there is " + listed(names) + did_you_mean(name, names));
  }

  void check(TableReader& in, BodyConfig& body, const std::vector<BodyConfig>& others) {
    require_own_name(in, body, others);
    require_file_name(in, body.name);
    if (body.shape && geometry_known(in)) {
      if (in.valid({"particles_per_direction"})) check_extent(in, body);
      for (const BodyConfig& other : others) check_overlap(in, body, other);
    }
    if (geometry_known(in) && in.valid({"velocity"})) check_velocity(in, body.velocity);
    const bool material_known = in.valid({"material"});
    if (body.porosity && material_known && !body.material.material.porosity)
      in.problem("porosity", "it would be ignored: the material has no [porosity] table");
    if (body.damage && material_known && !body.material.material.damage)
      in.problem("damage", "it would be ignored: the material has no [damage] table");
    if (body.strength && in.valid({"strength"}) && body.strength->weibull_modulus > 0.0 &&
        body.strength->reference_volume == 0.0)
      in.problem("strength", "a Weibull distribution needs the volume its median belongs to; give reference_volume");
  }

  void check_extent(TableReader& in, const BodyConfig& body) {
    const Bounds extent = bounds(*body.shape, case_.geometry);
    for (std::size_t k = 0; k < dimensions(); ++k) {
      const double width = extent.upper[k] - extent.lower[k];
      if (!(width > 0.0)) return in.problem("shape", "it fills nothing: its parts do not meet");
      const double spacing = case_.cell_size / (body.particles_per_direction * samples_per_direction);
      if (k == 0 && spacing > 0.0 && !may_fill(*body.shape, case_.dimensions(), extent, spacing))
        return in.problem("shape", fmt::format("it fills nothing: it leaves no part that could hold a particle of cells of {}",
                                               in_metres(case_.cell_size)));
      if (width < case_.cell_size * (1.0 - round_off))
        return in.problem("shape", fmt::format("along {} it is {} wide, less than one cell of {}", axis_names[k],
                                               in_metres(width), in_metres(case_.cell_size)));
    }
  }

  /// What is filled twice would weigh twice and push itself apart.
  void check_overlap(TableReader& in, const BodyConfig& body, const BodyConfig& other) {
    if (!other.shape || !(case_.cell_size > 0.0)) return;
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
      in.problem("velocity", "in the axisymmetric geometry no body moves along the radius x as a whole; give 0, or `radial`");
  }

  void check(TableReader& in, BoundaryConfig& boundary, const std::vector<BoundaryConfig>& others) {
    const std::size_t axis = static_cast<std::size_t>(boundary.axis);
    const bool kind_known = in.valid({"kind"}), axis_known = geometry_known(in) && in.valid({"axis"});
    if (axis_known) require_component_in_geometry(in, boundary.axis, case_);
    if (boundary.name.empty() && in.valid({"name", "kind", "axis", "side"}))
      boundary.name = fmt::format("{}_{}_{}", choices<BoundaryKind>[static_cast<std::size_t>(boundary.kind)], axis_names[axis],
                                  choices<Side>[static_cast<std::size_t>(boundary.side)]);
    require_own_name(in, boundary, others);
    if (kind_known && boundary.kind == BoundaryKind::velocity && boundary.velocity.size == 0)
      in.problem("velocity", "missing: how the boundary moves, for its kind is velocity");
    if (kind_known && boundary.kind != BoundaryKind::velocity && boundary.kind != BoundaryKind::rigid_wall &&
        boundary.velocity.size > 0)
      in.problem("velocity", "it would be ignored: the kind is neither velocity nor rigid_wall");
    if (kind_known && boundary.kind != BoundaryKind::rigid_wall && boundary.friction > 0.0)
      in.problem("friction", "it would be ignored: the kind is not rigid_wall");
    if (!axis_known || axis >= dimensions() || !in.valid({"position"}) || !(case_.cell_size > 0.0)) return;
    const double cells = boundary.position / case_.cell_size;
    if (std::abs(cells - std::round(cells)) > round_off * std::max(1.0, std::abs(cells)))
      in.problem("position",
                 fmt::format("{} is on no plane of nodes; the nearest are {} and {}", in_metres(boundary.position),
                             in_metres(std::floor(cells) * case_.cell_size), in_metres(std::ceil(cells) * case_.cell_size)));
    if (!in.valid({"side"})) return;
    for (const BodyConfig& body : case_.bodies) check_side(in, boundary, axis, body);
  }

  /// In two dimensions the filled part of a sub-cell is known in sixteenths.
  void check_trimming(TableReader& in, const NumericsConfig& numerics) {
    constexpr double least = 1.0 / (samples_per_direction * samples_per_direction);
    if (geometry_known(in) && dimensions() == 2 && numerics.trimming && *numerics.trimming > 0.0 && *numerics.trimming < least)
      in.problem("trimming",
                 fmt::format("it would be ignored: in two dimensions a sub-cell is sampled in {} places; give 0, or "
                             "{} and more",
                             samples_per_direction * samples_per_direction, least));
  }

  /// Figures are coloured by one number of each particle.
  void check_figure_field(TableReader& in, const std::string& field) {
    if (!in.valid({"figure_field"})) return;
    if (case_.gas) {
      if (in.has("figure_field")) gas::check_fields(in, {field}, case_, "figure_field");
      return;
    }
    require_words(in, "figure_field", std::span(&field, 1), scalar_fields(), "cannot be drawn");
  }

  /// A plane with a velocity that the grid cannot follow stays where its nodes are, so what it moves must stay near.
  void check_stroke(TableReader& in, const BoundaryConfig& boundary) {
    if (boundary.velocity.size == 0 || travels(case_, boundary)) return;
    constexpr int parts = 1000;
    constexpr double most_cells = 0.5;
    double farthest = 0.0;
    for (int i = 1; i <= parts; ++i)
      farthest = std::max(farthest, std::abs(integral(boundary.velocity, case_.end_time * i / parts)));
    if (farthest > most_cells * case_.cell_size * (1.0 + round_off))
      in.problem(
          "velocity",
          fmt::format("it moves {}; the grid travels with the only plane across an axis, and here {} has others: this one may "
                      "move half a cell, {}, at most; leave out the others, or let the body move instead",
                      in_metres(farthest), axis_names[static_cast<std::size_t>(boundary.axis)],
                      in_metres(most_cells * case_.cell_size)));
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

  void check(TableReader& in, LoadConfig& load, const std::vector<LoadConfig>&) {
    resolve_body(in, load.body, "the load");
    if (!in.valid({"pressure", "traction"})) return;
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
    if (case_.gas) return gas::check_gauge(in, gauge, case_);
    const bool kind_known = in.valid({"kind"}), places_known = geometry_known(in) && in.valid({"from", "to"});
    if (kind_known && places_known && in.valid({"axis"})) check_place(in, gauge);
    require_words(in, "fields", gauge.fields, gauge_fields, "cannot be recorded");
    if (!kind_known || !places_known) return;
    if (gauge.kind == GaugeKind::plane)
      for (std::size_t k = 0; k < dimensions(); ++k)
        if (!(gauge.from[k] < gauge.to[k]))
          in.problem("to",
                     fmt::format("along {} the box ends before it begins; give it a thickness of about a cell", axis_names[k]));
    for (std::size_t k = 0; gauge.kind == GaugeKind::surface && gauge.axis && k < dimensions(); ++k)
      if (static_cast<std::size_t>(*gauge.axis) != k && std::abs(gauge.to[k] - gauge.from[k]) < case_.cell_size)
        in.problem("to",
                   fmt::format("along {} the surface is sought between {} and {}, which is less than a cell: there may be "
                               "no particle",
                               axis_names[k], in_metres(gauge.from[k]), in_metres(gauge.to[k])));
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
      return in.problem("from", "x = " + in_metres(place.upper[0]) + "; a radius is not negative");
    for (std::size_t n = 0; n < case_.boundaries.size(); ++n) {
      const BoundaryConfig& b = case_.boundaries[n];
      const auto axis = static_cast<std::size_t>(b.axis);
      if (!in.valid_in_file({fmt::format("boundary.{}", n)}) || travels(case_, b)) continue;
      if (b.side == Side::above ? place.upper[axis] >= b.position : place.lower[axis] <= b.position) continue;
      if (!sought_along(axis))
        return in.problem("from", fmt::format("it lies beyond the boundary {} at {} = {}, where there is never any material",
                                              in_quotes(b.name), axis_names[axis], in_metres(b.position)));
    }
    if (!gauge.moves.value_or(true) || gauge.kind == GaugeKind::surface || !in.valid({"moves", "body"})) return;
    if (!names_known() || !(case_.cell_size > 0.0)) return;
    for (const BodyConfig& body : case_.bodies)
      if (!body.shape) return;
    const bool starts_in_material = std::any_of(case_.bodies.begin(), case_.bodies.end(), [&](const BodyConfig& body) {
      return (gauge.body.empty() || body.name == gauge.body) && is_near(*body.shape, gauge, place);
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

  /// A surface is sought along an axis and goes with the material; the other kinds know neither axis nor side.
  void check_surface(TableReader& in, const GaugeConfig& gauge) {
    if (gauge.axis) require_component_in_geometry(in, *gauge.axis, case_);
    if (!in.valid({"kind"})) return;
    const bool surface = gauge.kind == GaugeKind::surface;
    if (surface && !in.has("axis")) in.problem("axis", "missing: the direction in which the surface is sought");
    if (surface && gauge.moves) in.problem("moves", "it would be ignored: a surface is where the material ends");
    if (!surface && gauge.axis) in.problem("axis", "it would be ignored: the kind is not surface");
    if (!surface && gauge.side) in.problem("side", "it would be ignored: the kind is not surface");
  }

  /// The point gauge of a measure of gas; nothing that is said of solids.
  void check_gas_measure(TableReader& in, const MeasureConfig& measure) {
    const auto ignored = [&](const char* key, bool given) {
      if (given) in.problem(key, "it would be ignored: the kind is one of gas");
    };
    ignored("body", !measure.body.empty()), ignored("axis", measure.axis != MeasureConfig{}.axis);
    if (!in.has("ambient")) in.problem("ambient", "missing: the pressure before the wave, from which overpressures count");
    if (!in.has("gauge")) return in.problem("gauge", "missing: the gauge, of kind point, at which it is measured");
    std::vector<std::string_view> points;
    for (std::size_t n = 0; n < case_.gauges.size(); ++n) {
      if (!in.valid_in_file({fmt::format("gauge.{}.name", n), fmt::format("gauge.{}.kind", n)})) return;
      if (case_.gauges[n].kind == GaugeKind::point) points.push_back(case_.gauges[n].name);
    }
    if (in.valid({"gauge"}) && std::find(points.begin(), points.end(), measure.gauge) == points.end())
      in.problem("gauge", "there is no gauge " + in_quotes(measure.gauge) + " of kind point" +
                              (points.empty() ? "" : "; there is " + listed(points) + did_you_mean(measure.gauge, points)));
  }

  void check(TableReader& in, MeasureConfig& measure, const std::vector<MeasureConfig>& others) {
    const bool kind_known = in.valid({"kind"}), of_gas = kind_known && is_of_gas(measure.kind);
    if (kind_known && of_gas != case_.gas.has_value())
      return in.problem("kind", fmt::format("it is measured of {} alone, and this case is one of {}", of_gas ? "gas" : "solids",
                                            of_gas ? "solids" : "gas"));
    if (of_gas) {
      check_gas_measure(in, measure);
    } else if (!case_.gas) {
      resolve_body(in, measure.body, "the measure");
      if (in.valid({"axis"})) require_component_in_geometry(in, measure.axis, case_);
      for (const char* key : {"gauge", "ambient"})
        if (kind_known && in.has(key)) in.problem(key, "it would be ignored: the kind is none of gas");
    }
    if (measure.name.empty() && kind_known && in.valid({"name", "at", "gauge"})) {
      measure.name = choices<MeasureKind>[static_cast<std::size_t>(measure.kind)];
      if (measure.kind == MeasureKind::diameter_at) measure.name += fmt::format("_{}", measure.at);
      if (of_gas) measure.name = measure.gauge + '_' + measure.name;
    }
    require_own_name(in, measure, others);
    if (kind_known && in.valid({"at"}) && (measure.kind == MeasureKind::diameter_at) != (measure.at > 0.0))
      in.problem("at", measure.at > 0.0 ? "it would be ignored: the kind is not diameter_at"
                                        : "missing: where along the initial length, > 0 and up to 1");
    if (kind_known && in.valid({"profile"}) && (measure.kind == MeasureKind::profile_error) == measure.profile.empty())
      in.problem("profile", measure.profile.empty() ? "missing: the CSV file of the measured profile"
                                                    : "it would be ignored: the kind is not profile_error");
    if (kind_known && measure.kind == MeasureKind::profile_error && measure.measured)
      in.problem("measured", "the error against the measured profile would be zero; remove it");
    if (!measure.profile.empty() && in.valid({"profile"})) {
      try {
        static_cast<void>(read_profile(measure.profile));
      } catch (const InputError& error) {
        in.problem_of_file("profile", error.problems());
      }
    }
  }

  void check(TableReader& in, FigureConfig& figure, const std::vector<FigureConfig>& others) {
    require_own_name(in, figure, others);
    require_file_name(in, figure.name);
    if (!figure.body.empty() && case_.gas) in.problem("body", "it would be ignored: it is a figure of the gas");
    if (!figure.body.empty() && !case_.gas) require_body(in, figure.body);
    if (case_.gas) gas::check_fields(in, figure.fields, case_), gas::check_in_box(in, figure.from, figure.to, case_);
    const std::span drawable = std::span(gauge_fields).subspan(1);  // all but the position
    if (!case_.gas) require_words(in, "fields", figure.fields, drawable, "cannot be drawn");
    if (figure.fields.empty() && in.valid({"fields"}))
      in.problem("fields", "there is nothing to draw; give one or more of " + listed(drawable));
    if (in.valid({"from", "to"}) && figure.from == figure.to) in.problem("to", "it is where `from` is; a line has a length");
    if (figure.reference.empty() || !in.valid({"fields", "from", "to", "reference"})) return;
    try {
      static_cast<void>(read_reference(figure));
    } catch (const InputError& error) {
      in.problem_of_file("reference", error.problems());
    }
  }

  Case case_;
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

/// Adds what --set has changed: "key=value", each key once. Title and subtitle show themselves; the memory itself is not to be
/// set.
void remember(std::vector<std::string>& set, const std::vector<std::string>& overrides, std::vector<Problem>& problems) {
  const auto trimmed = [](std::string text) {
    text.erase(0, text.find_first_not_of(" \t"));
    text.erase(text.find_last_not_of(" \t") + 1);
    return text;
  };
  for (const std::string& assignment : overrides) {
    const auto equals = assignment.find('=');
    if (equals == std::string::npos) continue;  // a problem already
    const std::string key = trimmed(assignment.substr(0, equals));
    if (key == "title" || key == "subtitle") continue;
    if (key == "set") {
      problems.push_back({"--set set", 0, 0, "", "a run writes it itself; set the keys that it would name"});
      continue;
    }
    std::erase_if(set, [&](const std::string& earlier) { return earlier.starts_with(key + '='); });
    set.push_back(key + '=' + trimmed(assignment.substr(equals + 1)));
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
  remember(result.set, overrides, problems);
  place_in_file(problems, changes, file);
  if (!problems.empty()) throw InputError(std::move(problems));
  return result;
}

}  // namespace brisance::simulator
