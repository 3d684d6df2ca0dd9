#pragma once
// The same flow along many rays: how far fronts have come in every direction.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "simulator/gas/fields.hpp"
#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Density along rays from the origin, the corner of a box of cells.
class Rays {
 public:
  explicit Rays(const Gas& gas) : h_(gas.cells.cell_size), dimensions_(gas.dimensions()) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions_); ++a) cells_[a] = gas.cells.upper[a] - gas.cells.lower[a];
    density_.resize(static_cast<std::size_t>(gas.cells.count()));
    for_each_cell(gas, [&](const CellPlace& at) {
      density_[number(gas.cells.index(at.block, at.cell))] = gas.primitive.cell(at.block, Primitive::density, at.cell);
    });
  }
  /// Linear between the middles of the cells; nearer to a side as there.
  double density(const Vector& x) const {
    double sum = 0.0;
    for (int corner = 0; corner < 1 << dimensions_; ++corner) {
      std::array<int, 3> i{};
      double weight = 1.0;
      for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions_); ++a) {
        const double u = x[a] / h_ - 0.5, low = std::floor(u), part = u - low;
        const int high = corner >> a & 1;
        i[a] = std::clamp(static_cast<int>(low) + high, 0, cells_[a] - 1);
        weight *= high ? part : 1.0 - part;
      }
      sum += weight * density_[number(i)];
    }
    return sum;
  }
  /// Of the quadrant or octant, a right angle over `parts` from each other.
  std::vector<Vector> directions(int parts) const {
    if (dimensions_ == 1) return {{1.0, 0.0, 0.0}};
    std::vector<Vector> result;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; j <= (dimensions_ == 3 ? parts : 0); ++j) {
        const double a = 0.5 * std::numbers::pi * i / parts, b = 0.5 * std::numbers::pi * j / parts;
        result.push_back({std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)});
      }
    return result;
  }
  double cell_size() const { return h_; }
  int dimensions() const { return dimensions_; }

 private:
  std::size_t number(const std::array<int, 3>& i) const {
    const int j = dimensions_ > 1 ? i[1] : 0, k = dimensions_ > 2 ? i[2] : 0;
    return static_cast<std::size_t>(i[0] + cells_[0] * (j + cells_[1] * k));
  }
  double h_;
  int dimensions_;
  std::array<int, 3> cells_{1, 1, 1};
  std::vector<double> density_;
};

}  // namespace brisance::simulator::gas
