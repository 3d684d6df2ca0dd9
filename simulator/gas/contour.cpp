#include "simulator/gas/contour.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::simulator::gas {
namespace {

/// Where the line from a to b changes sign, from a.
double crossing(double a, double b) {
  return a / (a - b);
}

/// The corners of a square in a row around it, and the edges of a cube, by their number with x fastest.
constexpr std::array<int, 4> around = {0, 1, 3, 2};
constexpr int faces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};

double mean(double a, double b, double c, double d) {
  return 0.25 * ((a + b) + (c + d));
}

/// Part of a triangle that is gas times the mean of r over that part.
double open_moment(double a, double b, double c, double r_a, double r_b, double r_c) {
  const double whole = (r_a + r_b + r_c) / 3.0;
  const int gas = (a < 0.0) + (b < 0.0) + (c < 0.0);
  if (gas == 0 || gas == 3) return gas == 0 ? 0.0 : whole;
  // The corner that is alone on its side cuts off a triangle.
  const auto cut = [](double x, double y, double z, double r_x, double r_y, double r_z) {
    const double t = crossing(x, y), s = crossing(x, z);
    return t * s * (r_x + (t * (r_y - r_x) + s * (r_z - r_x)) / 3.0);
  };
  const bool alone = gas == 1;
  const double corner = (a < 0.0) == alone && (b < 0.0) != alone && (c < 0.0) != alone ? cut(a, b, c, r_a, r_b, r_c)
                        : (b < 0.0) == alone && (a < 0.0) != alone                     ? cut(b, c, a, r_b, r_c, r_a)
                                                                                       : cut(c, a, b, r_c, r_a, r_b);
  return alone ? corner : whole - corner;
}

}  // namespace

double depth_of(double fraction) {
  constexpr double deepest = 1.5, least = 1e-9;
  const double theta = std::clamp(fraction, 0.0, 1.0), solid = std::max(theta, 1.0 - theta);
  double s;
  if (solid >= 5.0 / 6.0) {
    s = deepest - std::cbrt(6.0 * (1.0 - solid));
  } else {
    s = (solid - 0.5) / 0.75;
    for (int n = 0; n < 5; ++n) s -= (0.5 + 0.75 * s - s * s * s / 3.0 - solid) / (0.75 - s * s);
  }
  s = std::max(s, least);
  return theta < 0.5 ? -s : s;
}

double open_part(double a, double b) {
  if ((a < 0.0) == (b < 0.0)) return a < 0.0 ? 1.0 : 0.0;
  return a < 0.0 ? crossing(a, b) : crossing(b, a);
}

double open_part(double a, double b, double c) {
  const int gas = (a < 0.0) + (b < 0.0) + (c < 0.0);
  if (gas == 0 || gas == 3) return gas == 0 ? 0.0 : 1.0;
  const bool alone = gas == 1;
  const double corner = (a < 0.0) == alone && (b < 0.0) != alone && (c < 0.0) != alone ? crossing(a, b) * crossing(a, c)
                        : (b < 0.0) == alone && (a < 0.0) != alone                     ? crossing(b, c) * crossing(b, a)
                                                                                       : crossing(c, a) * crossing(c, b);
  return alone ? corner : 1.0 - corner;
}

double open_part(double a, double b, double c, double d) {
  const double value[4] = {a, b, c, d};
  int below[4], above[4], gas = 0, solid = 0;
  for (int i = 0; i < 4; ++i) (value[i] < 0.0 ? below[gas++] : above[solid++]) = i;
  const auto r = [&](int x, int y) { return crossing(value[x], value[y]); };
  switch (gas) {
    case 0:
      return 0.0;
    case 1:
      return r(below[0], above[0]) * r(below[0], above[1]) * r(below[0], above[2]);
    case 2: {
      const double ac = r(below[0], above[0]), ad = r(below[0], above[1]), bc = r(below[1], above[0]),
                   bd = r(below[1], above[1]);
      return ac * ad + bc * bd * (1.0 - ad) + bc * ad * (1.0 - ac);
    }
    case 3:
      return 1.0 - r(above[0], below[0]) * r(above[0], below[1]) * r(above[0], below[2]);
    default:
      return 1.0;
  }
}

double open_part(const std::array<double, 4>& f) {
  const double centre = mean(f[0], f[1], f[2], f[3]);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    sum += open_part(f[static_cast<std::size_t>(around[k])], f[static_cast<std::size_t>(around[(k + 1) % 4])], centre);
  return 0.25 * sum;
}

double open_moment(const std::array<double, 4>& f, double r0, double r1) {
  const double centre = mean(f[0], f[1], f[2], f[3]);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(around[k]), j = static_cast<std::size_t>(around[(k + 1) % 4]);
    sum += open_moment(f[i], f[j], centre, i & 1 ? r1 : r0, j & 1 ? r1 : r0, 0.5 * (r0 + r1));
  }
  return 0.25 * sum;
}

double open_moment(double a, double b, double r_a, double r_b) {
  if ((a < 0.0) == (b < 0.0)) return a < 0.0 ? 0.5 * (r_a + r_b) : 0.0;
  if (a >= 0.0) return open_moment(b, a, r_b, r_a);
  const double t = crossing(a, b);
  return t * (r_a + 0.5 * t * (r_b - r_a));
}

double open_part(const std::array<double, 8>& f) {
  const double centre = 0.5 * (mean(f[0], f[1], f[2], f[3]) + mean(f[4], f[5], f[6], f[7]));
  double sum = 0.0;
  for (const auto& face : faces) {
    const auto at = [&](std::size_t k) { return f[static_cast<std::size_t>(face[k % 4])]; };
    const double middle = mean(at(0), at(1), at(2), at(3));
    for (std::size_t k = 0; k < 4; ++k) sum += open_part(at(k), at(k + 1), middle, centre);
  }
  return sum / 24.0;
}

bool gas_is_connected(const std::array<double, 4>& f) {
  const bool diagonal = (f[0] < 0.0) == (f[3] < 0.0) && (f[1] < 0.0) == (f[2] < 0.0) && (f[0] < 0.0) != (f[1] < 0.0);
  return !diagonal || mean(f[0], f[1], f[2], f[3]) < 0.0;
}

bool gas_is_connected(const std::array<double, 8>& f) {
  unsigned gas = 0;
  for (unsigned i = 0; i < 8; ++i) gas |= (f[i] < 0.0 ? 1u : 0u) << i;
  unsigned reached = gas & (~gas + 1);
  for (unsigned before = 0; before != reached;) {
    before = reached;
    for (unsigned i = 0; i < 8; ++i)
      if (before >> i & 1)
        for (const unsigned step : {1u, 2u, 4u}) reached |= gas & 1u << (i ^ step);
  }
  return reached == gas;
}

}  // namespace brisance::simulator::gas
