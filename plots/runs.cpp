#include "runs.hpp"

#include <algorithm>
#include <cmath>

#include "models/input/material_reader.hpp"

namespace brisance::plots {

using driver::FreeDirection;
using driver::LoadingPath;
using driver::PathSegment;
using S = SymmetricTensor<double>;

namespace {

FreeDirection stress_free(double S::*component) {
  S unit;
  unit.*component = 1.0;
  return {to_tensor(unit), unit, {}, 0.0};
}

LoadingPath path_to(double plastic_strain, double temperature, PathSegment segment, std::string where) {
  segment.where = std::move(where);
  segment.until = driver::Until{"plastic_strain", plastic_strain};
  LoadingPath path;
  path.temperature = temperature;
  path.on_failure = driver::OnFailure::keep_going;
  path.strain_increment = 5e-4;
  path.segments.push_back(std::move(segment));
  return path;
}

}  // namespace

std::filesystem::path data_folder() {
  return BRISANCE_DATA;
}

Material read(std::string_view name) {
  Material material = read_material(data_folder() / "materials" / (std::string(name) + ".toml"));
  material.failure.clear();
  material.damage.reset();
  return material;
}

LoadingPath uniaxial_stress(double strain_rate, double temperature, double plastic_strain) {
  PathSegment segment;
  segment.velocity_gradient.xx = strain_rate;
  segment.free = {stress_free(&S::yy), stress_free(&S::zz)};
  return path_to(plastic_strain, temperature, segment, "uniaxial stress");
}

LoadingPath constant_volume(double strain_rate, double temperature, double plastic_strain) {
  PathSegment segment;
  segment.velocity_gradient.xx = strain_rate;
  segment.velocity_gradient.yy = segment.velocity_gradient.zz = -0.5 * strain_rate;
  return path_to(plastic_strain, temperature, segment, "constant volume");
}

LoadingPath constant_triaxiality(double triaxiality, double lode_angle, double strain_rate, double temperature,
                                 double plastic_strain) {
  PathSegment segment;
  const double angle = lode_angle / degrees, third = 120.0 / degrees;
  const S direction{
      2.0 / 3.0 * std::cos(angle), 2.0 / 3.0 * std::cos(angle - third), 2.0 / 3.0 * std::cos(angle + third), 0, 0, 0};
  // The stress is q (direction + triaxiality I) when it has no part along two tensors at right angles to that.
  const S across{direction.yy - direction.zz, direction.zz - direction.xx, direction.xx - direction.yy, 0, 0, 0};
  const S balance = add_to_diagonal(triaxiality * direction, -double_dot(direction, direction) / 3.0);
  const auto along = [](double S::*component) {
    S unit;
    unit.*component = 1.0;
    return to_tensor(unit);
  };
  segment.free = {
      {along(&S::xx), across, {}, 0.0}, {along(&S::yy), balance, {}, 0.0}, {along(&S::zz), {}, direction, strain_rate}};
  return path_to(plastic_strain, temperature, segment, "constant triaxiality");
}

const std::vector<double>& Run::operator[](std::string_view column) const {
  const driver::Record::Series* series = record.find(column);
  if (!series) throw std::logic_error(std::string(column) + ": there is no such column in the history of this material");
  return series->values;
}

Run follow(const Material& material, const LoadingPath& path) {
  driver::History history(material, {.every = 1});
  driver::Outcome outcome = driver::follow(material, path, history, {.watcher = {}, .keep_steps = true});
  return {history.record(), std::move(outcome)};
}

Curve curve(std::string title, const std::vector<double>& x, const std::vector<double>& y, double x_factor, double y_factor,
            Mark mark, int colour, std::size_t most) {
  Curve result{std::move(title), {}, {}, mark, colour};
  const std::size_t n = std::min(x.size(), most);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = n == x.size() ? i : i * (x.size() - 1) / (n - 1);
    result.x.push_back(x_factor * x[row]);
    result.y.push_back(y_factor * y[row]);
  }
  return result;
}

std::vector<double> evenly(double first, double last, int n) {
  std::vector<double> result;
  for (int i = 0; i <= n; ++i) result.push_back(first + (last - first) * i / n);
  return result;
}

}  // namespace brisance::plots
