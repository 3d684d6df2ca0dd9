#pragma once
// Measures: numbers that an experiment gives as well, of bodies as they end, of pressures in the gas over time.

#include <optional>
#include <string>
#include <vector>

#include "simulator/config.hpp"
#include "simulator/output/positive_phase.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

/// The outer surface of a body about its axis, through the origin along a coordinate: radius against distance from the lower
/// end, where it hits. In the plane geometry the radius is half the width; in three dimensions it is the mean around the axis.
struct Profile {
  std::vector<double> height, radius;  // m
  double lower = 0.0, length = 0.0;    // m, coordinate of the lower end, distance of the upper one from it
  double largest = 0.0;                // m, largest radius of all

  /// Linear between its points, constant outside.
  double radius_at(double height) const;
};
Profile profile_of(const Simulation& s, const Body& body, Axis axis);

/// A measured profile, CSV with columns radius and height.
struct MeasuredProfile {
  std::vector<double> height, radius;  // m
};
MeasuredProfile read_profile(const std::filesystem::path& path);

/// What a measure needs to know of the undeformed body.
struct Undeformed {
  double length = 0.0, radius = 0.0;  // m
};

struct MeasuredValue {
  std::string name, unit;
  double value = 0.0;
  std::optional<double> measured;
  std::string missing{};  // why there is no value, which is not a number then
  /// (value - measured) / measured
  std::optional<double> deviation() const { return measured ? std::optional((value - *measured) / *measured) : std::nullopt; }
};

/// What --set has changed of the experiment that the case's measures are compared with: its bodies, planes and loads. Materials
/// are the model of it.
std::vector<std::string> other_experiment(const Case& c);

class Measures {
 public:
  /// Looks at the bodies as set up, and reads measured profiles.
  Measures(const Case& c, const Simulation& start);
  /// Adds the state after a step, or at the start, to what is measured over time.
  void observe(const Simulation& s);
  std::vector<MeasuredValue> read(const Simulation& s) const;

  /// What has been measured over time, for a checkpoint, and back. `restore` throws std::runtime_error if it is of other
  /// measures.
  std::vector<double> numbers() const;
  void restore(const std::vector<double>& numbers);

 private:
  struct Measure {
    MeasureConfig config;
    std::size_t body = 0;
    Undeformed undeformed{};
    MeasuredProfile profile{};
    Vector place{};         // of a gauge in the gas
    PositivePhase phase{};  // of the pressure there
  };
  std::vector<Measure> measures_;
};

/// The body of a measure: the one it names or the only one. Throws std::invalid_argument.
std::size_t body_of(const MeasureConfig& measure, const Simulation& s);

}  // namespace brisance::simulator
