#include "simulator/output/line_out.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "models/input/csv.hpp"
#include "models/input/diagnostics.hpp"
#include "simulator/output/fields.hpp"

namespace brisance::simulator {
namespace {

struct Line {
  explicit Line(const FigureConfig& figure) : from(figure.from), direction(figure.to - figure.from) {
    length = std::sqrt(dot(direction, direction));
    direction = (1.0 / length) * direction;
    for (std::size_t a = 0; a < 3; ++a)
      if (std::abs(direction[a]) == 1.0) axis = static_cast<int>(a);
  }
  std::string coordinate() const { return axis < 0 ? "distance" : std::string(1, "xyz"[axis]); }

  Vector from, direction;
  double length;
  int axis = -1;  // along which it runs
};

}  // namespace

LineOut line_out(const Simulation& s, const FigureConfig& figure) {
  const Line line(figure);
  std::vector<const Field*> fields;
  for (const std::string& name : figure.fields) fields.push_back(find_field(name));
  std::vector<std::pair<double, std::vector<double>>> rows;
  for (const Body& body : s.bodies) {
    if (!figure.body.empty() && figure.body != body.name) continue;
    for (const std::uint32_t p : body.bins.order) {
      const ParticleView particle(body.particles, static_cast<int>(p));
      const Vector x = particle.position(), r = x - line.from;
      const double along = dot(r, line.direction);
      const Vector across = r - along * line.direction;
      if (along < 0.0 || along > line.length || dot(across, across) > 0.25 * s.grid.cell_size * s.grid.cell_size) continue;
      std::vector<double> values;
      for (const Field* field : fields) {
        Vector v{};
        field->read(particle, v.data());
        values.push_back(field->components == 1 ? v[0] : dot(v, line.direction));
      }
      rows.emplace_back(line.axis < 0 ? along : x[static_cast<std::size_t>(line.axis)], std::move(values));
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  LineOut result{line.coordinate(), {}, std::vector<std::vector<double>>(fields.size())};
  for (const auto& [place, values] : rows) {
    result.place.push_back(place);
    for (std::size_t f = 0; f < fields.size(); ++f) result.values[f].push_back(values[f]);
  }
  return result;
}

LineOut read_reference(const FigureConfig& figure) {
  const CsvFile csv = CsvFile::load(figure.reference);
  LineOut result{Line(figure).coordinate(), {}, {}};
  result.place = csv.numbers(result.coordinate, Unit::m);
  bool any = false;
  for (const std::string& name : figure.fields) {
    const bool given = csv.has(name);
    result.values.push_back(given ? csv.numbers(name, Unit{find_field(name)->unit}) : std::vector<double>{});
    any = any || given;
  }
  if (!any)
    throw InputError(
        {{csv.path().string(), 0, 0, "",
          fmt::format("none of its columns is drawn; at least one of {} is required", fmt::join(figure.fields, ", "))}});
  return result;
}

}  // namespace brisance::simulator
