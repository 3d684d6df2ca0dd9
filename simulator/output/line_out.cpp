#include "simulator/output/line_out.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "models/input/csv.hpp"
#include "models/input/diagnostics.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/output/fields.hpp"

namespace brisance::simulator {
namespace {

struct Line {
  explicit Line(const FigureConfig& figure) : from(figure.from), direction(figure.to - figure.from) {
    length = std::sqrt(dot(direction, direction));
    for (double& d : direction) d /= length;  // exactly 1 along an axis
    for (std::size_t a = 0; a < 3; ++a)
      if (std::abs(direction[a]) == 1.0) axis = static_cast<int>(a);
  }
  std::string coordinate() const { return axis < 0 ? "distance" : std::string(1, "xyz"[axis]); }

  Vector from, direction;
  double length;
  int axis = -1;  // along which it runs
};

using Rows = std::vector<std::pair<double, std::vector<double>>>;

/// Where along the line something is, if it is within half a cell of it.
std::optional<double> place_on(const Line& line, const Vector& x, double cell_size) {
  const Vector r = x - line.from;
  const double along = dot(r, line.direction);
  const Vector across = r - along * line.direction;
  constexpr double rounding = 1.0 + 1e-9;  // cells stand half a cell beside a line on their edges
  if (along < 0.0 || along > line.length || dot(across, across) > 0.25 * cell_size * cell_size * rounding) return std::nullopt;
  return line.axis < 0 ? along : x[static_cast<std::size_t>(line.axis)];
}

Rows rows_of_gas(const gas::Gas& gas, const FigureConfig& figure, const Line& line) {
  std::vector<gas::Field> fields;
  const std::vector<gas::Field> known = gas::fields_of(gas);
  for (const std::string& name : figure.fields)
    fields.push_back(*std::find_if(known.begin(), known.end(), [&](const gas::Field& f) { return f.name == name; }));
  Rows rows;
  gas::for_each_cell(gas, [&](const gas::CellPlace& at) {
    const std::optional<double> place = place_on(line, gas.cells.centre(at.block, at.cell), gas.cells.cell_size);
    if (!place) return;
    std::vector<double> values;
    for (const gas::Field& field : fields) {
      double value = 0.0;
      for (int a = 0; a < field.components; ++a)
        value += field.read(gas, at, a) * (field.name == "velocity" ? line.direction[static_cast<std::size_t>(a)] : 1.0);
      values.push_back(value);
    }
    rows.emplace_back(*place, std::move(values));
  });
  return rows;
}

Rows rows_of_solids(const Simulation& s, const FigureConfig& figure, const Line& line) {
  std::vector<const Field*> fields;
  for (const std::string& name : figure.fields) fields.push_back(find_field(name));
  Rows rows;
  for (const Body& body : s.bodies) {
    if (!figure.body.empty() && figure.body != body.name) continue;
    for (const std::uint32_t p : body.bins.order) {
      const ParticleView particle(body.particles, static_cast<int>(p));
      const std::optional<double> place = place_on(line, particle.position(), s.grid.cell_size);
      if (!place) continue;
      std::vector<double> values;
      for (const Field* field : fields) {
        Vector v{};
        field->read(particle, v.data());
        values.push_back(field->components == 1 ? v[0] : dot(v, line.direction));
      }
      rows.emplace_back(*place, std::move(values));
    }
  }
  return rows;
}

}  // namespace

LineOut line_out(const Simulation& s, const FigureConfig& figure) {
  const Line line(figure);
  Rows rows = s.gas.empty() ? rows_of_solids(s, figure, line) : rows_of_gas(s.gas, figure, line);
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  LineOut result{line.coordinate(), {}, std::vector<std::vector<double>>(figure.fields.size())};
  for (const auto& [place, values] : rows) {
    result.place.push_back(place);
    for (std::size_t f = 0; f < values.size(); ++f) result.values[f].push_back(values[f]);
  }
  return result;
}

std::string unit_of_field(const std::string& name) {
  if (const Field* field = find_field(name)) return std::string(field->unit);
  for (const gas::Field& field : gas::fields(1, {}))
    if (field.name == name) return field.unit;
  return "1";  // a fraction of a fluid
}

LineOut read_reference(const FigureConfig& figure) {
  CsvColumns csv(figure.reference);
  LineOut result{Line(figure).coordinate(), {}, {}};
  result.place = csv.numbers(result.coordinate, Unit::m);
  bool any = false;
  for (const std::string& name : figure.fields) {
    const bool given = csv.file().has(name);
    const std::string unit = unit_of_field(name);
    result.values.push_back(given ? csv.numbers(name, Unit{unit}) : std::vector<double>{});
    any = any || given;
  }
  if (!any)
    csv.problem(fmt::format("none of its columns is drawn; at least one of {} is required", fmt::join(figure.fields, ", ")));
  csv.finish();
  return result;
}

LineOut outside_bodies(const LineOut& reference, const LineOut& computed, double cell_size) {
  LineOut result{reference.coordinate, {}, std::vector<std::vector<double>>(reference.values.size())};
  const std::vector<double>& place = reference.place;
  const auto add = [&](double x, auto&& value_of) {
    result.place.push_back(x);
    for (std::size_t f = 0; f < reference.values.size(); ++f)
      if (!reference.values[f].empty()) result.values[f].push_back(value_of(reference.values[f]));
  };
  const auto add_at = [&](double x, std::size_t i) {  // between rows i and i + 1
    add(x, [&](const std::vector<double>& column) {
      return std::lerp(column[i], column[i + 1], (x - place[i]) / (place[i + 1] - place[i]));
    });
  };
  const auto interrupt = [&] {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!result.place.empty() && !std::isnan(result.place.back())) add(none, [](const auto&) { return none; });
  };
  // Where a body begins and ends a row of the reference says, if there is one about there; the cells do if not.
  const auto face = [&](double cell, double outermost) {
    const auto nearest = std::min_element(
        place.begin(), place.end(), [&](double a, double b) { return std::abs(a - outermost) < std::abs(b - outermost); });
    return nearest != place.end() && std::abs(*nearest - outermost) < cell_size ? *nearest : cell;
  };
  std::vector<std::pair<double, double>> gaps;
  for (std::size_t n = 0; n + 1 < computed.place.size(); ++n) {
    const double before = computed.place[n], after = computed.place[n + 1];
    if (after - before > 1.5 * cell_size)
      gaps.emplace_back(face(before, before + 0.5 * cell_size), face(after, after - 0.5 * cell_size));
  }
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto inside = [&](const auto& gap) { return place[i] > gap.first && place[i] < gap.second; };
    if (std::none_of(gaps.begin(), gaps.end(), inside)) add(place[i], [&](const auto& column) { return column[i]; });
    if (i + 1 == place.size()) break;
    for (const auto& [from, to] : gaps) {
      if (from >= place[i + 1] || to <= place[i]) continue;
      if (from > place[i]) add_at(from, i);
      interrupt();
      if (to < place[i + 1]) add_at(to, i);
    }
  }
  return result;
}

}  // namespace brisance::simulator
