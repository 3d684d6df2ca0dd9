#include "simulator/output/particle_cells.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/output/fields.hpp"
#include "simulator/setup.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator {
namespace {

/// Between a point that a shape holds and one that it does not, its surface.
Vector surface_between(const Shape& shape, Vector inside, Vector outside) {
  constexpr int halvings = 12;  // fine enough for pictures
  for (int i = 0; i < halvings; ++i) {
    const Vector middle = 0.5 * (inside + outside);
    (contains(shape, middle) ? inside : outside) = middle;
  }
  return inside;
}

/// Corners of the part of a square about `centre` that a shape fills; the whole square if it holds none of its corners.
std::vector<Vector> cut_square(const Shape& shape, const Vector& centre, double half_width) {
  constexpr double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  constexpr double within = 1.0 - 1e-6;  // faces may lie on the surface of the shape
  std::vector<Vector> square;
  for (const auto& [x, y] : signs) square.push_back(centre + within * half_width * Vector{x, y, 0.0});
  std::vector<Vector> part;
  for (std::size_t k = 0; k < square.size(); ++k) {
    const Vector &from = square[k], &to = square[(k + 1) % square.size()];
    const bool holds_from = contains(shape, from), holds_to = contains(shape, to);
    if (holds_from) part.push_back(from);
    if (holds_from != holds_to)
      part.push_back(holds_from ? surface_between(shape, from, to) : surface_between(shape, to, from));
  }
  return part.empty() ? square : part;
}

/// At most so long.
Vector shortened(const Vector& v, double longest) {
  const double length = magnitude(v);
  return length > longest ? longest / length * v : v;
}

}  // namespace

std::vector<Vector> cell_of_particle(const Case& c, const Body& body, int particle) {
  const ParticleView view(body.particles, particle);
  const std::uint64_t id = body.particles.id[static_cast<std::size_t>(particle)];
  const auto [centre, width] = sub_cell_of(c, id);
  const double half_width = 0.5 * width;
  const Tensor<double> F = view.deformation_gradient();
  constexpr double margin = 1.1;  // neighbours may leave a gap between them
  if (c.dimensions() == 3 && std::abs(view.position()[2]) > margin * half_width * std::abs(F.zz)) return {};
  const auto config = std::find_if(c.bodies.begin(), c.bodies.end(), [&](const BodyConfig& b) { return b.name == body.name; });
  const Vector along_x = shortened(half_width * Vector{F.xx, F.yx, 0.0}, c.cell_size);
  const Vector along_y = shortened(half_width * Vector{F.xy, F.yy, 0.0}, c.cell_size);
  std::vector<Vector> corners = cut_square(*config->shape, centre, half_width);
  for (Vector& x : corners) {
    const Vector from_centre = (1.0 / half_width) * (x - centre);
    x = view.position() + from_centre[0] * along_x + from_centre[1] * along_y;
  }
  return corners;
}

}  // namespace brisance::simulator
