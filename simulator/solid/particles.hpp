#pragma once
// The particles of one body: columns of doubles in chunks of eight particles, so that a chunk's column is one pack of lanes.
// Where a particle stands in memory has no meaning; the order of sums is that of the bins (bins.hpp).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "models/material.hpp"
#include "models/parameters.hpp"
#include "simulator/grid/morton.hpp"
#include "simulator/solid/packs.hpp"

namespace brisance::simulator {

inline constexpr int chunk_size = 8;

/// Columns that are used together. Element (column, particle) stands in the particle's chunk.
class ColumnSet {
 public:
  ColumnSet() = default;
  explicit ColumnSet(int columns) : columns_(columns) {}

  int columns() const { return columns_; }
  /// New elements, and those that pad the last chunk, are zero.
  void resize(int particles) {
    const std::size_t chunks = (static_cast<std::size_t>(particles) + chunk_size - 1) / chunk_size;
    data_.resize(chunks * static_cast<std::size_t>(columns_));
  }
  /// Where column 0 of a particle stands, counted from chunk 0.
  std::int64_t offset(std::uint32_t p) const { return std::int64_t{p / chunk_size} * (columns_ * chunk_size) + p % chunk_size; }
  double* chunk(int c) {
    return reinterpret_cast<double*>(data_.data() + static_cast<std::size_t>(c) * static_cast<std::size_t>(columns_));
  }
  const double* chunk(int c) const { return const_cast<ColumnSet*>(this)->chunk(c); }
  /// Column 0 of a particle; its column k is k * chunk_size further on.
  double* particle(int p) { return chunk(p / chunk_size) + p % chunk_size; }
  const double* particle(int p) const { return const_cast<ColumnSet*>(this)->particle(p); }
  double& at(int column, int p) { return particle(p)[column * chunk_size]; }
  double at(int column, int p) const { return particle(p)[column * chunk_size]; }
  /// Particle i of the new order is particle order[i] of the old.
  void reorder(std::span<const std::uint32_t> order);
  std::size_t bytes() const { return data_.capacity() * sizeof(StoredPack); }

 private:
  int columns_ = 0;
  std::vector<StoredPack> data_;  // [chunk][column]
};

/// Where the columns stand in their sets, in D dimensions. In two dimensions the third direction keeps only its diagonal
/// components: stress xx yy zz xy, tensors xx xy yx yy zz.
template <int D>
struct Layout {
  static constexpr int stress_components = D == 3 ? 6 : 4, tensor_components = D == 3 ? 9 : 5;
  struct Motion {
    static constexpr int position = 0, velocity = D, affine = 2 * D, count = 2 * D + D * D;
  };
  struct Load {  // what pushes the grid
    static constexpr int mass = 0, density = 1, stress = 2, artificial_viscosity = 2 + stress_components,
                         half_width = artificial_viscosity + 1, count = half_width + 1;
  };
  struct Rest {
    static constexpr int deformation_gradient = 0, energy = tensor_components, temperature = energy + 1,
                         plastic_strain = energy + 2, plastic_strain_rate = energy + 3, plastic_volume_strain = energy + 4,
                         porosity = energy + 5, damage = energy + 6, shear_modulus = energy + 7, flow_history = energy + 8,
                         failure_cause = energy + 9, failure_time = energy + 10, stress_work = energy + 11,
                         viscous_work = energy + 12, plastic_work = energy + 13, count = energy + 14;
  };
};

/// A column as sorting, migration, checkpoints and output see it.
struct Column {
  std::string name;
  std::string_view unit;
  int set;    // 0 motion, 1 load, 2 rest
  int index;  // in its set
};

struct Particles {
  int dimensions = 3;
  int size = 0;
  int history_columns = 0;    // of the material's laws, at the end of `rest`
  int area_columns = 0;       // of a loaded surface, after them: the area vector (m^2) of the undeformed body
  bool has_strength = false;  // a factor on the flow stress, after them
  ColumnSet motion;           // at the start of the step
  ColumnSet next_motion;      // at its end, until the step is accepted
  ColumnSet load, rest;
  ColumnSet gradient;                       // velocity gradient of the step, 1/s
  ColumnSet filter_heat;                    // what AFLIP's filter makes of motion in the step, J/kg
  std::vector<std::uint64_t> id;            // from the creation lattice
  std::vector<BlockKey> block;              // that holds the nearest node
  std::vector<std::uint32_t> second_field;  // bit n: at node n of its stencil the particle is in the body's second field

  Particles() = default;
  Particles(int dimensions, int history_columns, int area_columns, bool has_strength);
  int chunks() const { return (size + chunk_size - 1) / chunk_size; }
  int history() const;   // first history column of `rest`
  int area() const;      // first area column
  int strength() const;  // column of the strength factor
  void resize(int particles);
  /// Every column that belongs to the state, in a fixed order; scratch is not among them.
  std::vector<Column> columns() const;
  ColumnSet& set(int number) { return number == 0 ? motion : number == 1 ? load : rest; }
  const ColumnSet& set(int number) const { return const_cast<Particles*>(this)->set(number); }
  void reorder(std::span<const std::uint32_t> order);
  /// Lanes beyond the last particle repeat the last particle, so that every lane holds a state that can be updated.
  void pad();
  std::size_t bytes() const;
};

/// Columns of history that a material's laws use.
int history_columns(const Material& material);

}  // namespace brisance::simulator
