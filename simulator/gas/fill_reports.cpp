#include "simulator/gas/fill_reports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <variant>

#include "simulator/gas/initial_state.hpp"
#include "simulator/output/extensive.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator::gas {
namespace {

/// How a shape lies in the box along one axis.
struct Reach {
  double width = 0.0;              // m, of what lies in the box
  std::optional<BoxSide> touched;  // the side at which it ends, if it ends at one alone
  bool across = false;             // from side to side
};
Reach reach_of(const Case& c, const Shape& shape, std::size_t axis) {
  const Bounds box = bounds(shape);
  const double low = c.gas->lower[axis], high = c.gas->upper[axis], margin = 1e-9 * c.cell_size;
  const bool at_low = box.lower[axis] <= low + margin, at_high = box.upper[axis] >= high - margin;
  Reach reach{std::min(high, box.upper[axis]) - std::max(low, box.lower[axis]), {}, at_low && at_high};
  if (at_low != at_high) reach.touched = static_cast<BoxSide>(2 * axis + (at_high ? 1 : 0));
  return reach;
}
/// Whether a side mirrors what touches it: a wall may stand for a plane of symmetry, the axis is one.
bool mirrors(const Case& c, BoxSide side) {
  return std::all_of(c.gas->edges.begin(), c.gas->edges.end(),
                     [&](const EdgeConfig& edge) { return edge.side != side || is_wall(edge.kind); });
}
bool is_axis(const Case& c, BoxSide side) {
  return is_round(c.geometry) && side == BoxSide::low_x && c.gas->lower[0] == 0.0;
}
std::size_t dimensions_of(const Case& c) {
  return static_cast<std::size_t>(c.dimensions());
}

/// Thickness of the wall of a hollow sphere or tube, m; none of other shapes.
std::optional<double> wall_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.form); sphere && sphere->inner_radius > 0.0)
    return sphere->radius - sphere->inner_radius;
  const auto* tube = std::get_if<Cone>(&shape.form);
  if (!tube || (tube->inner_start_radius == 0.0 && tube->inner_end_radius == 0.0)) return {};
  return std::max(tube->start_radius - tube->inner_start_radius, tube->end_radius - tube->inner_end_radius);
}

/// How many cells are across a fill where its extent along an axis is least, mirror images included; none if it fills the box.
std::optional<double> cells_across(const Case& c, const FillConfig& fill) {
  if (!fill.shape) return {};
  std::optional<double> least = wall_of(*fill.shape);
  for (std::size_t axis = 0; axis < dimensions_of(c); ++axis) {
    const Reach reach = reach_of(c, *fill.shape, axis);
    if (reach.across) continue;
    const double width = reach.touched && mirrors(c, *reach.touched) ? 2.0 * reach.width : reach.width;
    least = std::min(least.value_or(width), width);
  }
  return least ? std::optional(*least / c.cell_size) : std::nullopt;
}

/// The walls that would make more of it than lies in the box; the axis has made its turn already.
std::vector<std::string_view> mirrors_of(const Case& c, const FillConfig& fill) {
  std::vector<std::string_view> sides;
  for (std::size_t axis = 0; fill.shape && axis < dimensions_of(c); ++axis) {
    const std::optional<BoxSide> side = reach_of(c, *fill.shape, axis).touched;
    if (side && mirrors(c, *side) && !is_axis(c, *side)) sides.push_back(choices<BoxSide>[static_cast<std::size_t>(*side)]);
  }
  return sides;
}

std::string_view whole_in_words(Geometry geometry) {
  switch (geometry) {
    case Geometry::axisymmetric:
    case Geometry::cylindrical_1d:
      return " (the whole turn)";
    case Geometry::spherical_1d:
      return " (the whole sphere)";
    default:
      return "";
  }
}

std::string text_of(const FillContent::Range& range, std::string_view unit) {
  const std::string lowest = fmt::format("{:.6g}", range.lowest), highest = fmt::format("{:.6g}", range.highest);
  return fmt::format("{}{} {}", lowest, lowest == highest ? "" : " to " + highest, unit);
}

std::string in_words(const Case& c, const FillConfig& fill, const FillContent& content) {
  if (content.volume == 0.0) return "nothing: later fills or bodies lie over all of it";
  const double whole = whole_of(c.geometry), mass = whole * content.mass;
  const std::string_view kg = unit_of(Extensive::mass, c.geometry).text;
  std::string text = fmt::format("{:.6g} {} in {:.6g} {}{}", mass, kg, whole * content.volume,
                                 unit_of(Extensive::volume, c.geometry).text, whole_in_words(c.geometry));
  if (const auto sides = mirrors_of(c, fill); !sides.empty())
    text += fmt::format(", with the mirror image{} beyond {} {:.6g} {}", sides.size() > 1 ? "s" : "", fmt::join(sides, ", "),
                        std::ldexp(mass, static_cast<int>(sides.size())), kg);
  text += fmt::format("; {}, {}, {}, {}, sound {}", text_of(content.density, "kg/m^3"), text_of(content.pressure, "Pa"),
                      text_of(content.temperature, "K"), text_of(content.energy, "J/kg"), text_of(content.sound_speed, "m/s"));
  if (const auto cells = cells_across(c, fill)) text += fmt::format("; {:.3g} cells across", *cells);
  return text;
}

}  // namespace

std::vector<FillReport> fill_reports(const Case& c, const Gas& gas) {
  OpenParts open;
  if (!gas.bodies.empty())
    open = [&](const std::array<int, 3>& cell) {
      const CellPlace place = gas.cells.find(cell).value();
      return open_part(gas, place.block, place.cell);
    };
  const InitialState start(*c.gas, gas.fluids, gas.cells, open);
  std::vector<FillReport> reports;
  for (std::size_t n = 0; n < c.gas->fills.size(); ++n) {
    const FillConfig& fill = c.gas->fills[n];
    reports.push_back({fmt::format("fill {}, {}", n, fill.fluid), in_words(c, fill, start.content_of(n, open))});
  }
  return reports;
}

std::vector<std::string> warnings_of_fills(const Case& c) {
  constexpr double least_cells = 5.0;
  std::vector<std::string> warnings;
  for (std::size_t n = 0; n < c.gas->fills.size(); ++n) {
    const std::optional<double> cells = cells_across(c, c.gas->fills[n]);
    if (cells && *cells < least_cells * (1.0 - 1e-9))
      warnings.push_back(
          fmt::format("fill {}, {}: {:.2g} cells are across it, fewer than {:g}: its mass is there, but waves "
                      "within it are not resolved; take smaller cells",
                      n, c.gas->fills[n].fluid, *cells, least_cells));
  }
  return warnings;
}

}  // namespace brisance::simulator::gas
