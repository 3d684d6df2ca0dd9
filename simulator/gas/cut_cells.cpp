#include "simulator/gas/cut_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/gas/contour.hpp"
#include "simulator/gas/node_spline.hpp"

namespace brisance::simulator::gas {
namespace {

using Index = std::array<int, 3>;

Part united(const Part& a, const Part& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  Part c;
  for (std::size_t k = 0; k < 3; ++k)
    c.lower[k] = std::min(a.lower[k], b.lower[k]), c.upper[k] = std::max(a.upper[k], b.upper[k]);
  return c;
}
/// Cells of the window that have so many others on all sides.
Part inner(const Window& w, int margin) {
  Part p;
  for (std::size_t a = 0; a < 3; ++a) {
    const int m = static_cast<int>(a) < w.dimensions ? margin : 0;
    p.lower[a] = w.lower[a] + m, p.upper[a] = w.lower[a] + w.size[a] - m;
  }
  return p;
}
Part common(const Part& a, const Part& b) {
  Part c;
  for (std::size_t k = 0; k < 3; ++k) {
    c.lower[k] = std::max(a.lower[k], b.lower[k]), c.upper[k] = std::min(a.upper[k], b.upper[k]);
    if (c.lower[k] >= c.upper[k]) return {};
  }
  return c;
}

template <std::size_t corners>
std::array<double, corners> depths(const Window& w, const std::vector<double>& fraction, std::size_t n) {
  std::array<double, corners> f;
  for (std::size_t i = 0; i < corners; ++i) {
    std::ptrdiff_t step = 0;
    for (std::size_t a = 0; a < 3; ++a)
      if (i >> a & 1) step += w.stride[a];
    f[i] = depth_of(fraction[n + static_cast<std::size_t>(step)]);
  }
  return f;
}
/// The corners of the low face across an axis.
std::array<double, 4> low_face(const std::array<double, 8>& f, int axis) {
  if (axis == 0) return {f[0], f[2], f[4], f[6]};
  return axis == 1 ? std::array{f[0], f[1], f[4], f[5]} : std::array{f[0], f[1], f[2], f[3]};
}
template <std::size_t n>
bool all_below(const std::array<double, n>& f) {
  return std::all_of(f.begin(), f.end(), [](double x) { return x < 0.0; });
}

void open_all(const Window& w, const Cells& cells, const Part& part, OpenSpace& s) {
  for_each_cell_of(part, [&](const Index& cell) {
    const std::size_t n = w.at(cell);
    const WholeCell whole = whole_cell(cells, cell[0]);
    s.volume[n] = whole.volume, s.side[n] = whole.side;
    for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a) s.area[a][n] = whole.area[a];
  });
}

void cut_square(const Cells& cells, const Index& cell, const std::array<double, 4>& f, std::size_t n, OpenSpace& s) {
  const double h = cells.cell_size;
  const WholeCell whole = whole_cell(cells, cell[0]);
  const bool round = cells.geometry == Geometry::axisymmetric;
  const double r0 = std::abs(cell[0]) * h, r1 = std::abs(cell[0] + 1) * h;
  s.area[0][n] = whole.area[0] * open_part(f[0], f[2]);
  const double low = open_part(f[0], f[1]);
  s.area[1][n] = low == 1.0 ? whole.area[1] : round ? h * open_moment(f[0], f[1], r0, r1) : whole.area[1] * low;
  if (all_below(f)) return;
  const double part = gas_is_connected(f) ? open_part(f) : 0.0;
  s.side[n] = round ? part * h * h : 0.0;
  s.volume[n] = !round ? part * whole.volume : part > 0.0 ? h * h * open_moment(f, r0, r1) : 0.0;
}
void cut_cube(const Cells& cells, const Index& cell, const std::array<double, 8>& f, std::size_t n, OpenSpace& s) {
  const WholeCell whole = whole_cell(cells, cell[0]);
  for (int a = 0; a < 3; ++a) {
    const std::array<double, 4> face = low_face(f, a);
    if (!all_below(face)) s.area[static_cast<std::size_t>(a)][n] = whole.area[static_cast<std::size_t>(a)] * open_part(face);
  }
  if (!all_below(f)) s.volume[n] = gas_is_connected(f) ? whole.volume * open_part(f) : 0.0;
}

/// Where a coordinate and its images lie, as far as the window may see them.
struct Image {
  double x, sign;  // of the velocity
};
void images_along(int axis, double x, const Cells& cells, const BoxImages& images, std::vector<Image>& all) {
  const auto a = static_cast<std::size_t>(axis);
  const double h = cells.cell_size, low = cells.lower[a] * h, high = cells.upper[a] * h, far = (Window::depth + 2) * h;
  all.clear();
  if (images.repeat[a]) {
    const double period = high - low, inside = x - period * std::floor((x - low) / period);
    all.push_back({inside, 1.0});
    if (inside > high - far) all.push_back({inside - period, 1.0});
    if (inside < low + far) all.push_back({inside + period, 1.0});
    return;
  }
  if ((images.mirror[2 * a] && x < low) || (images.mirror[2 * a + 1] && x > high)) return;  // beyond a wall
  all.push_back({x, 1.0});
  if (images.mirror[2 * a] && x < low + far) all.push_back({2.0 * low - x, -1.0});
  if (images.mirror[2 * a + 1] && x > high - far) all.push_back({2.0 * high - x, -1.0});
}

/// Mean over the nodes of a cell, and of so many rings around them, that a body touches.
struct Wall {
  double weight = 0.0, share = 0.0;
  Vector momentum{};
  int body = -1;
};
Wall wall_at(const Window& w, const BodyNodes& nodes, const Index& cell, int rings) {
  Wall wall;
  Part around;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool used = static_cast<int>(a) < w.dimensions;
    around.lower[a] = used ? cell[a] - rings : 0, around.upper[a] = used ? cell[a] + 2 + rings : 1;
  }
  for_each_cell_of(around, [&](const Index& node) {
    if (!w.holds(node)) return;
    const std::size_t n = w.at(node);
    wall.weight += nodes.fraction[n];
    for (std::size_t a = 0; a < static_cast<std::size_t>(w.dimensions); ++a) wall.momentum[a] += nodes.momentum[a][n];
    if (nodes.share[n] > wall.share) wall.share = nodes.share[n], wall.body = nodes.body[n];
  });
  return wall;
}

}  // namespace

std::array<int, 3> Window::index(std::size_t n) const {
  const auto k = static_cast<int>(n - first);
  return {lower[0] + k % size[0], lower[1] + k / size[0] % size[1], lower[2] + k / (size[0] * size[1])};
}

bool Window::holds(const std::array<int, 3>& cell, int margin) const {
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a)
    if (cell[a] < lower[a] + margin || cell[a] >= lower[a] + size[a] - margin) return false;
  return true;
}

Window make_window(const Cells& cells) {
  Window w;
  w.dimensions = cells.dimensions;
  if (cells.mine.empty()) return w;
  constexpr int far = std::numeric_limits<int>::max();
  Index lower{far, far, far}, upper{-far, -far, -far};
  for (const std::int32_t b : cells.mine) {
    const Index corner = cells.corner(static_cast<std::size_t>(b));
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], std::max(corner[a], cells.lower[a]));
      upper[a] = std::max(upper[a], std::min(corner[a] + line, cells.upper[a]));
    }
  }
  w.cells = 1;
  std::ptrdiff_t step = 1, widest = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool used = static_cast<int>(a) < w.dimensions;
    w.lower[a] = used ? lower[a] - Window::depth : 0;
    w.size[a] = used ? upper[a] - lower[a] + 2 * Window::depth : 1;
    w.stride[a] = used ? step : 0;
    if (used) widest = step;
    step *= w.size[a], w.cells *= static_cast<std::size_t>(w.size[a]);
  }
  w.first = static_cast<std::size_t>(2 * widest + Lanes::width);
  w.length = 2 * w.first + w.cells + Lanes::width;
  return w;
}

WholeCell whole_cell(const Cells& cells, int x) {
  const auto i = static_cast<std::size_t>(x - cells.metric.first);
  const double area = cells.metric.area[i];
  const double side = cells.geometry == Geometry::axisymmetric ? cells.cell_size * cells.cell_size : 0.0;
  return {cells.metric.volume[i], side, {cells.metric.area_x[i], area, area}};
}

void put_on_nodes(const Window& w, const Cells& cells, const BoxImages& images, std::span<const BodyPoints> bodies,
                  BodyNodes& nodes) {
  const auto D = static_cast<std::size_t>(w.dimensions);
  if (nodes.fraction.size() != w.length) {
    nodes.fraction.assign(w.length, 0.0), nodes.share.assign(w.length, 0.0), nodes.body.assign(w.length, -1);
    for (std::size_t a = 0; a < D; ++a) nodes.momentum[a].assign(w.length, 0.0);
    if (bodies.size() > 1) nodes.second_share.assign(w.length, 0.0), nodes.other.assign(w.length, -1);
    nodes.touched = {};
  }
  for_each_cell_of(nodes.touched, [&](const Index& node) {
    const std::size_t n = w.at(node);
    nodes.fraction[n] = nodes.share[n] = 0.0, nodes.body[n] = -1;
    if (bodies.size() > 1) nodes.second_share[n] = 0.0, nodes.other[n] = -1;
    for (std::size_t a = 0; a < D; ++a) nodes.momentum[a][n] = 0.0;
  });
  nodes.touched = {};
  const double h = cells.cell_size;
  const bool round = cells.geometry == Geometry::axisymmetric;
  std::vector<double> own;  // of one body
  std::array<std::vector<Image>, 3> along;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyPoints& points = bodies[b];
    Part touched;
    if (bodies.size() > 1) own.assign(w.length, 0.0);
    for (std::size_t p = 0; p < points.position.size(); ++p) {
      const Vector& x = points.position[p];
      const double area = round ? points.volume[p] / x[0] / (h * h) : points.volume[p] / (D == 3 ? h * h * h : h * h);
      for (std::size_t a = 0; a < 3; ++a)
        if (a < D)
          images_along(static_cast<int>(a), x[a], cells, images, along[a]);
        else
          along[a].assign(1, {0.0, 1.0});
      for (const Image& iz : along[2])
        for (const Image& iy : along[1])
          for (const Image& ix : along[0]) {
            const std::array<Image, 3> image = {ix, iy, iz};
            std::array<NodesOnLine, 3> s;
            Part stencil;
            for (std::size_t a = 0; a < 3; ++a) {
              s[a] = a < D ? spline_at(image[a].x, h) : NodesOnLine{0, {1.0, 0.0, 0.0}};
              stencil.lower[a] = s[a].first, stencil.upper[a] = s[a].first + (a < D ? 3 : 1);
            }
            const Part seen = common(stencil, inner(w, 0));
            if (seen.empty()) continue;
            touched = united(touched, seen);
            for_each_cell_of(seen, [&](const Index& node) {
              double value = area;
              for (std::size_t a = 0; a < D; ++a) value *= s[a].value[static_cast<std::size_t>(node[a] - s[a].first)];
              const std::size_t n = w.at(node);
              nodes.fraction[n] += value;
              if (!own.empty()) own[n] += value;
              for (std::size_t a = 0; a < D; ++a) nodes.momentum[a][n] += value * image[a].sign * points.velocity[p][a];
            });
          }
    }
    for_each_cell_of(touched, [&](const Index& node) {
      const std::size_t n = w.at(node);
      const double share = own.empty() ? nodes.fraction[n] : own[n];
      if (share > nodes.share[n]) {
        if (!own.empty()) nodes.second_share[n] = nodes.share[n], nodes.other[n] = nodes.body[n];
        nodes.share[n] = share, nodes.body[n] = static_cast<std::int16_t>(b);
      } else if (share > 0.0 && share > nodes.second_share[n]) {
        nodes.second_share[n] = share, nodes.other[n] = static_cast<std::int16_t>(b);
      }
    });
    nodes.touched = united(nodes.touched, touched);
  }
}

void find_open_space(const Window& w, const Cells& cells, const BodyNodes& nodes, OpenSpace& s) {
  const auto D = static_cast<std::size_t>(w.dimensions);
  if (s.volume.size() != w.length) {
    s.volume.assign(w.length, 0.0), s.side.assign(w.length, 0.0);
    for (std::size_t a = 0; a < D; ++a) s.area[a].assign(w.length, 0.0);
    open_all(w, cells, inner(w, 0), s);
  } else {
    open_all(w, cells, s.cut, s);
  }
  s.cut = {};
  if (nodes.touched.empty()) return;
  Part cut = nodes.touched;  // cells with a node that is touched, and those beyond their high faces
  for (std::size_t a = 0; a < D; ++a) --cut.lower[a], ++cut.upper[a];
  Part known = inner(w, 0);
  for (std::size_t a = 0; a < D; ++a) --known.upper[a];
  s.cut = cut = common(cut, known);
  for_each_cell_of(cut, [&](const Index& cell) {
    const std::size_t n = w.at(cell);
    if (D == 2)
      cut_square(cells, cell, depths<4>(w, nodes.fraction, n), n, s);
    else
      cut_cube(cells, cell, depths<8>(w, nodes.fraction, n), n, s);
    constexpr double least = 1e-9;
    if (s.volume[n] < least * whole_cell(cells, cell[0]).volume) s.volume[n] = 0.0;
  });
  // Nothing goes in or out where there is no gas.
  for_each_cell_of(cut, [&](const Index& cell) {
    const std::size_t n = w.at(cell);
    for (std::size_t a = 0; a < D; ++a)
      if (s.volume[n] == 0.0 || s.volume[n - static_cast<std::size_t>(w.stride[a])] == 0.0) s.area[a][n] = 0.0;
    if (s.volume[n] == 0.0) s.side[n] = 0.0;
  });
}

void find_cut_cells(const Window& w, const Cells& cells, const OpenSpace& before, const OpenSpace& after,
                    const BodyNodes& nodes, CutCells& step) {
  const auto D = static_cast<std::size_t>(w.dimensions);
  const auto stride = [&](std::size_t a) { return static_cast<std::size_t>(w.stride[a]); };
  if (step.is_cut.size() != w.length) {
    step.is_cut.assign(w.length, 0);
    for (std::size_t a = 0; a < D; ++a) step.area[a].assign(w.length, 0.0), step.smooth[a].assign(w.length, 1.0);
    step.touched = inner(w, 0);
  }
  const auto margin = [&](Part part, int m) {
    for (std::size_t a = 0; a < D; ++a) part.lower[a] -= m, part.upper[a] += m;
    return common(part, inner(w, 0));
  };
  Part now = united(before.cut, after.cut);
  if (!now.empty()) now = margin(now, 2);
  const Part changed = united(step.touched, now);
  step.touched = now;
  for_each_cell_of(changed, [&](const Index& cell) {
    const std::size_t n = w.at(cell);
    step.is_cut[n] = 0;
    for (std::size_t a = 0; a < D; ++a) {
      step.smooth[a][n] = 1.0;
      const bool gas = before.volume[n] > 0.0 || before.volume[n - stride(a)] > 0.0;
      step.area[a][n] = gas ? 0.5 * (before.area[a][n] + after.area[a][n]) : 0.0;
    }
  });
  step.cut.clear();
  if (now.empty()) return;
  for_each_cell_of(common(now, inner(w, 1)), [&](const Index& cell) {
    const std::size_t n = w.at(cell);
    const WholeCell whole = whole_cell(cells, cell[0]), next = whole_cell(cells, cell[0] + 1);
    const double half = 0.5 * whole.volume;
    bool is_cut = false;
    for (std::size_t a = 0; a < D; ++a) {
      const double low = whole.area[a], high = a == 0 ? next.area[a] : low;
      const double open_low = step.area[a][n], open_high = step.area[a][n + stride(a)];
      is_cut = is_cut || open_low != low || open_high != high;
      const auto gas = [&](std::size_t m) { return before.volume[m] > 0.0 && after.volume[m] > 0.0; };
      const bool smooth = before.volume[n] >= half && after.volume[n] >= half && open_low >= 0.5 * low &&
                          open_high >= 0.5 * high && gas(n - stride(a)) && gas(n + stride(a));
      step.smooth[a][n] = smooth ? 1.0 : 0.0;
    }
    const double growth = after.volume[n] - before.volume[n];
    is_cut = is_cut || growth != 0.0;
    if (!is_cut || (before.volume[n] == 0.0 && after.volume[n] == 0.0)) return;
    CutCell c{n, {}, growth, {}, -1};
    for (std::size_t a = 0; a < D; ++a) c.wall[a] = -(step.area[a][n + stride(a)] - step.area[a][n]);
    if (cells.geometry == Geometry::axisymmetric) c.wall[0] += (cell[0] < 0 ? -0.5 : 0.5) * (before.side[n] + after.side[n]);
    constexpr double rounding = 1e-12;
    for (std::size_t a = 0; a < D; ++a)
      if (std::abs(c.wall[a]) < rounding * next.area[D - 1]) c.wall[a] = 0.0;
    Wall wall = wall_at(w, nodes, cell, 0);
    for (int rings = 1; wall.weight == 0.0 && rings <= 2; ++rings) wall = wall_at(w, nodes, cell, rings);
    if (wall.weight > 0.0) c.velocity = (1.0 / wall.weight) * wall.momentum;
    c.body = wall.body;
    step.is_cut[n] = 1;
    step.cut.push_back(c);
  });
}

}  // namespace brisance::simulator::gas
