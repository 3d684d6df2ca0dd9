#pragma once
// Gauges: fields at places, watched over time.

#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/output/fields.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// A column of history.csv.
struct HistoryColumn {
  std::string name, unit;
};

/// Where a point, or a line about a cell apart, looks.
std::vector<Vector> places_of(const GaugeConfig& gauge, double cell_size);

class Gauges {
 public:
  /// Finds the particles that moving gauges follow, in a simulation as set up.
  Gauges(const Case& c, const Simulation& start);

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  /// One number per column; NaN where there is no material.
  std::vector<double> read(const Simulation& s) const;

 private:
  struct Followed {
    std::size_t body;
    std::uint64_t id;
  };
  struct Gauge {
    GaugeConfig config;
    std::vector<const Field*> fields;
    std::vector<gas::Field> gas_fields;
    std::vector<Vector> places;      // of a point or of the samples along a line
    std::vector<Followed> followed;  // one for each place, or all of a moving plane
  };
  /// Adds a gauge of the gas, with its columns.
  void watch_gas(Gauge gauge, const Simulation& start);
  /// Visits the particles a gauge may see: f(body number, particle number).
  template <class F>
  static void for_each_particle(const Simulation& s, const GaugeConfig& config, F&& f);
  using Values = std::vector<double>;  // of a gauge's fields, component by component
  Values of_particle(const Gauge& gauge, const Simulation& s, const Followed& followed) const;
  Values around(const Gauge& gauge, const Simulation& s, const Vector& place) const;
  Values over_plane(const Gauge& gauge, const Simulation& s) const;
  Values at_surface(const Gauge& gauge, const Simulation& s) const;
  std::size_t components(const Gauge& gauge) const;
  Values of_gas(const Gauge& gauge, const Simulation& s, const Vector& place) const;
  Values all_fields_of(const Gauge& gauge, const ParticleView& particle) const;

  int dimensions_;
  std::vector<Gauge> gauges_;
  std::vector<HistoryColumn> columns_;
};

}  // namespace brisance::simulator
