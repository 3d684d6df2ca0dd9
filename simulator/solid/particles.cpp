#include "simulator/solid/particles.hpp"

#include <algorithm>
#include <array>

#include "models/state.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator {

void ColumnSet::reorder(std::span<const std::uint32_t> order) {
  // Eight columns at a time, which stand side by side: scratch for those of each thread instead of a second set.
  constexpr int at_once = 8;
  const int groups = (columns_ + at_once - 1) / at_once;
  parallel_for_blocks(static_cast<std::size_t>(groups), [&](std::size_t group) {
    const int first = static_cast<int>(group) * at_once, count = std::min(at_once, columns_ - first);
    std::vector<std::array<double, at_once>> scratch(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int k = 0; k < count; ++k) scratch[i][static_cast<std::size_t>(k)] = at(first + k, static_cast<int>(order[i]));
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int k = 0; k < count; ++k) at(first + k, static_cast<int>(i)) = scratch[i][static_cast<std::size_t>(k)];
  });
}

namespace {

template <int D>
void make_sets(Particles& p) {
  using L = Layout<D>;
  p.motion = p.next_motion = ColumnSet(L::Motion::count);
  p.load = ColumnSet(L::Load::count);
  p.rest = ColumnSet(L::Rest::count + p.history_columns + p.area_columns + (p.has_strength ? 1 : 0));
  p.gradient = ColumnSet(L::tensor_components);
  p.filter_heat = ColumnSet(1);
}

template <int D>
std::vector<Column> list(const Particles& p) {
  using L = Layout<D>;
  constexpr const char* axes[] = {"x", "y", "z"};
  const std::vector<std::string> tensor = D == 3
                                              ? std::vector<std::string>{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}
                                              : std::vector<std::string>{"xx", "xy", "yx", "yy", "zz"};
  const std::vector<std::string> symmetric =
      D == 3 ? std::vector<std::string>{"xx", "yy", "zz", "yz", "xz", "xy"} : std::vector<std::string>{"xx", "yy", "zz", "xy"};
  std::vector<Column> columns;
  for (int a = 0; a < D; ++a) columns.push_back({std::string("position_") + axes[a], "m", 0, L::Motion::position + a});
  for (int a = 0; a < D; ++a) columns.push_back({std::string("velocity_") + axes[a], "m/s", 0, L::Motion::velocity + a});
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b)
      columns.push_back({std::string("affine_") + axes[a] + axes[b], "1/s", 0, L::Motion::affine + D * a + b});
  columns.push_back({"mass", "kg", 1, L::Load::mass});
  columns.push_back({"density", "kg/m^3", 1, L::Load::density});
  for (int k = 0; k < L::stress_components; ++k) columns.push_back({"stress_" + symmetric[k], "Pa", 1, L::Load::stress + k});
  columns.push_back({"artificial_viscosity", "Pa", 1, L::Load::artificial_viscosity});
  columns.push_back({"half_width", "m", 1, L::Load::half_width});
  for (int k = 0; k < L::tensor_components; ++k)
    columns.push_back({"deformation_gradient_" + tensor[k], "1", 2, L::Rest::deformation_gradient + k});
  using R = typename L::Rest;
  const std::pair<const char*, std::string_view> rest[] = {{"energy", "J/kg"},
                                                           {"temperature", "K"},
                                                           {"plastic_strain", "1"},
                                                           {"plastic_strain_rate", "1/s"},
                                                           {"plastic_volume_strain", "1"},
                                                           {"porosity", "1"},
                                                           {"damage", "1"},
                                                           {"shear_modulus", "Pa"},
                                                           {"flow_history", "1"},
                                                           {"failure_cause", "1"},
                                                           {"failure_time", "s"},
                                                           {"stress_work", "J/kg"},
                                                           {"viscous_work", "J/kg"},
                                                           {"plastic_work", "J/kg"}};
  for (int k = 0; k < R::count - R::energy; ++k) columns.push_back({rest[k].first, rest[k].second, 2, R::energy + k});
  for (int k = 0; k < p.history_columns; ++k) columns.push_back({"history_" + std::to_string(k), "1", 2, p.history() + k});
  for (int k = 0; k < p.area_columns; ++k)
    columns.push_back({"area_" + std::to_string(k / D) + "_" + axes[k % D], "m^2", 2, p.area() + k});
  if (p.has_strength) columns.push_back({"strength", "1", 2, p.strength()});
  return columns;
}

}  // namespace

Particles::Particles(int dimensions_, int history_columns_, int area_columns_, bool has_strength_)
    : dimensions(dimensions_), history_columns(history_columns_), area_columns(area_columns_), has_strength(has_strength_) {
  dimensions == 3 ? make_sets<3>(*this) : make_sets<2>(*this);
}

int Particles::history() const {
  return dimensions == 3 ? Layout<3>::Rest::count : Layout<2>::Rest::count;
}
int Particles::area() const {
  return history() + history_columns;
}
int Particles::strength() const {
  return area() + area_columns;
}

void Particles::resize(int particles) {
  size = particles;
  for (ColumnSet* s : {&motion, &next_motion, &load, &rest, &gradient, &filter_heat}) s->resize(particles);
  id.resize(static_cast<std::size_t>(particles));
  block.resize(static_cast<std::size_t>(particles));
  if (!second_field.empty()) second_field.resize(static_cast<std::size_t>(particles));
}

std::vector<Column> Particles::columns() const {
  return dimensions == 3 ? list<3>(*this) : list<2>(*this);
}

void Particles::reorder(std::span<const std::uint32_t> order) {
  for (int s = 0; s < 3; ++s) set(s).reorder(order);
  const auto permute = [&](auto& column) {
    auto old = column;
    for (std::size_t i = 0; i < order.size(); ++i) column[i] = old[order[i]];
  };
  permute(id), permute(block);
  if (!second_field.empty()) permute(second_field);
  pad();
}

void Particles::pad() {
  if (size == 0) return;
  for (int p = size; p < chunks() * chunk_size; ++p)
    for (ColumnSet* s : {&motion, &load, &rest})
      for (int c = 0; c < s->columns(); ++c) s->at(c, p) = s->at(c, size - 1);
}

std::size_t Particles::bytes() const {
  std::size_t sum =
      id.capacity() * sizeof(id[0]) + block.capacity() * sizeof(block[0]) + second_field.capacity() * sizeof(second_field[0]);
  for (const ColumnSet* s : {&motion, &next_motion, &load, &rest, &gradient, &filter_heat}) sum += s->bytes();
  return sum;
}

int history_columns(const Material& material) {
  return material.viscoelastic ? history_capacity : 0;
}

}  // namespace brisance::simulator
