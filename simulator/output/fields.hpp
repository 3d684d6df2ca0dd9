#pragma once
// What can be said about a particle: the vocabulary of gauges, snapshots and figures.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "models/tensor.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// One particle, whatever the number of dimensions; what does not exist in two is zero.
class ParticleView {
 public:
  ParticleView(const Particles& particles, int particle) : ps_(particles), p_(particle) {}

  Vector position() const { return vector(0); }
  Vector velocity() const { return vector(ps_.dimensions); }
  double mass() const;
  double density() const;
  double volume() const { return mass() / density(); }
  SymmetricTensor<double> stress() const;
  Tensor<double> deformation_gradient() const;
  double half_width() const;
  /// How far the body reaches beyond the particle's middle along a unit vector, if it ends there: half of the sub-cell it
  /// fills, stretched with the material; less, or less than nothing, where the surface cuts that.
  double reach(const Vector& direction, double whole_half_width) const;
  /// A column of Layout::Rest, given as that of two dimensions.
  double rest(int column) const;

 private:
  Vector vector(int first) const;
  const Particles& ps_;
  int p_;
};

/// Half of the width of a body's sub-cells: that of its particles that no surface cuts.
double whole_half_width(const Body& body);

/// A quantity of a particle with one or three components.
struct Field {
  std::string_view name, unit, meaning;
  int components;
  void (*read)(const ParticleView& particle, double* components);
};

std::span<const Field> all_fields();
/// nullptr if there is none of this name.
const Field* find_field(std::string_view name);

}  // namespace brisance::simulator
