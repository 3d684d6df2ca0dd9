#include "driver/point.hpp"

#include <fmt/format.h>

#include "models/update.hpp"

namespace brisance::driver {

PointUpdate::PointUpdate(const Material& material, double cell_size) : material_(&material), cell_size_(cell_size) {
  batch_.size = 1;
}

const Point<double>& PointUpdate::operator()(const State<double>& before, const Tensor<double>& L, double dt, double time) {
  Point<double>& point = batch_.points.front();
  point = {};
  point.state = before;
  point.velocity_gradient = L;
  point.cell_size = cell_size_;
  batch_.time = time;
  update(*material_, batch_, dt);
  ++calls_;
  return point;
}

Trouble trouble_of(const Point<double>& point) {
  return static_cast<Trouble>(static_cast<int>(point.trouble));
}

std::string_view describe(FailureCause cause) {
  switch (cause) {
    case FailureCause::none:
      return "none";
    case FailureCause::melting:
      return "melting";
    case FailureCause::tepla_f:
      return "tepla_f";
    case FailureCause::critical_damage:
      return "critical_damage";
    case FailureCause::critical_porosity:
      return "critical_porosity";
    case FailureCause::instability:
      return "instability";
    case FailureCause::tensile_limit:
      return "tensile_limit";
  }
  return "unknown";
}

std::string facts(const State<double>& state, double time) {
  const SymmetricTensor<double>& s = state.stress;
  const double pressure = -trace(s) / 3.0;
  return fmt::format(
      "time {:.6g} s, T = {:.5g} K, rho = {:.6g} kg/m^3, p = {:.5g} Pa, q = {:.5g} Pa, plastic strain {:.5g}, porosity {:.4g}, "
      "damage {:.4g}, det F = {:.6g}",
      time, state.temperature, state.density, pressure, equivalent_stress(deviator(s)), state.plastic_strain, state.porosity,
      state.damage, determinant(state.deformation_gradient));
}

}  // namespace brisance::driver
