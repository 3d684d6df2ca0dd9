#include "simulator/output/fields.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::simulator {
namespace {

using Rest = Layout<2>::Rest;
using View = ParticleView;

template <int column>
void read_rest(const View& p, double* to) {
  *to = p.rest(column);
}
template <double SymmetricTensor<double>::*component>
void read_stress(const View& p, double* to) {
  *to = p.stress().*component;
}
void read_vector(const Vector& v, double* to) {
  std::copy(v.begin(), v.end(), to);
}

constexpr std::array fields = {
    Field{"position", "m", "place", 3, [](const View& p, double* to) { read_vector(p.position(), to); }},
    Field{"velocity", "m/s", "velocity", 3, [](const View& p, double* to) { read_vector(p.velocity(), to); }},
    Field{"stress_xx", "Pa", "stress", 1, read_stress<&SymmetricTensor<double>::xx>},
    Field{"stress_yy", "Pa", "stress", 1, read_stress<&SymmetricTensor<double>::yy>},
    Field{"stress_zz", "Pa", "stress", 1, read_stress<&SymmetricTensor<double>::zz>},
    Field{"stress_yz", "Pa", "stress", 1, read_stress<&SymmetricTensor<double>::yz>},
    Field{"stress_xz", "Pa", "stress", 1, read_stress<&SymmetricTensor<double>::xz>},
    Field{"stress_xy", "Pa", "stress", 1, read_stress<&SymmetricTensor<double>::xy>},
    Field{"pressure", "Pa", "pressure, positive in compression", 1,
          [](const View& p, double* to) { *to = -trace(p.stress()) / 3.0; }},
    Field{"von_mises_stress", "Pa", "equivalent stress", 1,
          [](const View& p, double* to) { *to = equivalent_stress(deviator(p.stress())); }},
    Field{"temperature", "K", "temperature", 1, read_rest<Rest::temperature>},
    Field{"plastic_strain", "1", "equivalent plastic strain", 1, read_rest<Rest::plastic_strain>},
    Field{"plastic_strain_rate", "1/s", "equivalent plastic strain rate", 1, read_rest<Rest::plastic_strain_rate>},
    Field{"porosity", "1", "porosity", 1, read_rest<Rest::porosity>},
    Field{"damage", "1", "damage", 1, read_rest<Rest::damage>},
    Field{"energy", "J/kg", "internal energy per mass", 1, read_rest<Rest::energy>},
    Field{"density", "kg/m^3", "density", 1, [](const View& p, double* to) { *to = p.density(); }},
    Field{"failure_cause", "1", "number of the failure criterion, 0 if none", 1, read_rest<Rest::failure_cause>},
    Field{"failure_time", "s", "when it failed", 1, read_rest<Rest::failure_time>},
};

double load(const Particles& ps, int p, int column_2d, int column_3d) {
  return ps.load.at(ps.dimensions == 3 ? column_3d : column_2d, p);
}

}  // namespace

Vector ParticleView::vector(int first) const {
  Vector v{};
  for (int a = 0; a < ps_.dimensions; ++a) v[static_cast<std::size_t>(a)] = ps_.motion.at(first + a, p_);
  return v;
}

double ParticleView::mass() const {
  return load(ps_, p_, Layout<2>::Load::mass, Layout<3>::Load::mass);
}
double ParticleView::density() const {
  return load(ps_, p_, Layout<2>::Load::density, Layout<3>::Load::density);
}
double ParticleView::half_width() const {
  return load(ps_, p_, Layout<2>::Load::half_width, Layout<3>::Load::half_width);
}

SymmetricTensor<double> ParticleView::stress() const {
  const auto s = [&](int k) { return ps_.load.at(Layout<3>::Load::stress + k, p_); };
  static_assert(Layout<2>::Load::stress == Layout<3>::Load::stress);
  if (ps_.dimensions == 3) return {s(0), s(1), s(2), s(3), s(4), s(5)};
  return {s(0), s(1), s(2), 0.0, 0.0, s(3)};
}

Tensor<double> ParticleView::deformation_gradient() const {
  const auto f = [&](int k) { return ps_.rest.at(k, p_); };
  if (ps_.dimensions == 3) return {f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7), f(8)};
  Tensor<double> F;
  F.xx = f(0), F.xy = f(1), F.yx = f(2), F.yy = f(3), F.zz = f(4);
  return F;
}

double ParticleView::reach(const Vector& n, double whole) const {
  const Tensor<double> F = deformation_gradient();
  const double x = F.xx * n[0] + F.yx * n[1] + F.zx * n[2], y = F.xy * n[0] + F.yy * n[1] + F.zy * n[2],
               z = F.xz * n[0] + F.yz * n[1] + F.zz * n[2];
  const double stretch = std::sqrt(x * x + y * y + z * z), filled = std::pow(half_width() / whole, ps_.dimensions);
  return stretch * whole * (2.0 * filled - 1.0);
}

double whole_half_width(const Body& body) {
  double largest = 0.0;
  for (int p = 0; p < body.particles.size; ++p) largest = std::max(largest, ParticleView(body.particles, p).half_width());
  return largest;
}

double ParticleView::rest(int column) const {
  const int tensor = ps_.dimensions == 3 ? Layout<3>::tensor_components : Layout<2>::tensor_components;
  return ps_.rest.at(column - Layout<2>::tensor_components + tensor, p_);
}

std::span<const Field> all_fields() {
  return fields;
}

const Field* find_field(std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace brisance::simulator
