#pragma once
// A run as its input file states it, in plain structs and SI units. Written by case_reader, read by setup and run.

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "models/input/material_reader.hpp"
#include "models/parameters.hpp"
#include "simulator/formula.hpp"
#include "simulator/vector.hpp"

namespace brisance::simulator {

/// The first three hold solids and gas, those of one dimension gas alone.
enum class Geometry { plane, axisymmetric, three_dimensional, planar_1d, cylindrical_1d, spherical_1d };
constexpr int number_of_dimensions(Geometry g) {
  return g == Geometry::three_dimensional ? 3 : g == Geometry::plane || g == Geometry::axisymmetric ? 2 : 1;
}
/// Whether x is a radius.
constexpr bool is_round(Geometry g) {
  return g == Geometry::axisymmetric || g == Geometry::cylindrical_1d || g == Geometry::spherical_1d;
}
/// The whole over what books per radian or steradian hold; in one and two straight dimensions the whole is 1 m^2 or 1 m deep.
constexpr double whole_of(Geometry g) {
  return g == Geometry::axisymmetric || g == Geometry::cylindrical_1d ? 2.0 * std::numbers::pi
         : g == Geometry::spherical_1d                                ? 4.0 * std::numbers::pi
                                                                      : 1.0;
}
enum class Basis { quadratic_spline, ugimp };
/// When the stress is updated within the step: from the velocities mapped back after the particles have moved (musl), from the
/// new grid velocities (usl), or from the grid velocities before the forces act (usf).
enum class StressTiming { musl, usl, usf };
enum class ParticleVelocity { flip, aflip };
enum class Axis { x, y, z };
/// The side of a boundary plane on which the bodies are.
enum class Side { above, below };
enum class BoundaryKind { symmetry, fixed, velocity, rigid_wall, outflow };

// Shapes: what a body fills ------------------------------------------------------------------------------------------

struct Shape;
using ShapePointer = std::shared_ptr<const Shape>;

struct Box {
  Vector lower, upper;
};
/// Solid of revolution about the line from `start` to `end`; the radii are at the ends. A cylinder has both alike, a tube has
/// inner radii as well. In the axisymmetric geometry the line lies on the axis; in the plane a disk is a `Sphere`.
struct Cone {
  Vector start, end;
  double start_radius, end_radius;
  double inner_start_radius = 0.0, inner_end_radius = 0.0;
};
struct Sphere {
  Vector centre;
  double radius;
  double inner_radius = 0.0;
};
struct Union {
  std::vector<ShapePointer> parts;
};
struct Intersection {
  std::vector<ShapePointer> parts;
};
struct Difference {
  ShapePointer from;
  std::vector<ShapePointer> without;
};
struct Shape {
  std::variant<Box, Cone, Sphere, Union, Intersection, Difference> form;
};

// Bodies -------------------------------------------------------------------------------------------------------------

/// Velocity at a point x: translation + rotation x (x - centre) + radial (direction away from the centre, or from the axis).
struct InitialVelocity {
  Vector translation{};
  Vector rotation{};  // rad/s
  Vector centre{};
  double radial = 0.0;       // m/s, of the unit vector away from the centre (2-D and 3-D) or from the axis (axisymmetric)
  double radial_rate = 0.0;  // 1/s, velocity per distance from the centre or axis
};

/// A factor on the strength of each particle: constant, or Weibull by weakest link with the size effect of its volume.
struct StrengthDistribution {
  double median = 1.0;            // of the factor at the reference volume
  double weibull_modulus = 0.0;   // 0: the same everywhere
  double reference_volume = 0.0;  // m^3
};

struct BodyConfig {
  std::string name;
  MaterialFile material;
  ShapePointer shape;
  int particles_per_direction = 2;
  InitialVelocity velocity;
  double temperature = 0.0;                 // K
  std::optional<InitialPorosity> porosity;  // instead of the material's
  std::optional<InitialDamage> damage;      // instead of the material's
  std::optional<StrengthDistribution> strength;
  bool locking_cure = true;  // averaging of the volume change over each cell; only where the material flows plastically
};

// Boundaries and loads -----------------------------------------------------------------------------------------------

/// A plane across an axis. Nothing passes it but through an outflow.
struct BoundaryConfig {
  std::string name;
  BoundaryKind kind = BoundaryKind::symmetry;
  Axis axis = Axis::x;
  double position = 0.0;  // m, on a plane of nodes
  Side side = Side::above;
  Table velocity;         // m/s against s, normal to the plane: kinds velocity and rigid_wall
  double friction = 0.0;  // Coulomb's coefficient: kind rigid_wall
};

/// Pressure or traction on the part of a body's surface that lies in a region and faces a direction.
struct LoadConfig {
  std::string body;
  ShapePointer region;             // absent: the whole surface
  std::optional<Table> pressure;   // Pa against s
  Vector traction{};               // Pa
  std::optional<Table> amplitude;  // of the traction, against s
};

// Gas ----------------------------------------------------------------------------------------------------------------

enum class EdgeKind {
  wall,            // reflects; also a plane of symmetry and the axis
  inflow,          // the state beyond is given
  pressure,        // the pressure beyond is given, the rest follows the gas inside
  non_reflecting,  // waves leave into a given state beyond
  periodic,        // the other side of the box
  no_slip          // a wall that viscous fluids stick to
};
enum class BoxSide { low_x, high_x, low_y, high_y, low_z, high_z };

struct FluidConfig {
  std::string name;
  MaterialFile material;                         // of which the equation of state counts
  double viscosity = 0.0, bulk_viscosity = 0.0;  // Pa s
  double conductivity = 0.0;                     // W/(m K)
};

/// What advances the gas: conservative ICE, or the classic ICE of 1993 to compare with.
enum class GasScheme { ice, ice_classic };

/// A state of gas: what fills a region at the start, or what lies beyond an edge.
struct GasStateConfig {
  std::string fluid;                   // empty: the only one
  std::optional<Varying> density;      // kg/m^3; this or the temperature
  std::optional<Varying> temperature;  // K
  std::optional<Varying> pressure;     // Pa
  VaryingVector velocity{};            // m/s
};
/// Along what the columns of a profile are given: a coordinate, or the distance from a centre.
enum class ProfileAlong { x, y, z, radius };
/// Density, pressure and velocity that vary along a line, from a CSV file.
struct ProfileConfig {
  std::filesystem::path file;
  ProfileAlong along = ProfileAlong::x;
  Vector centre{};  // m; along radius
};
struct FillConfig : GasStateConfig {
  ShapePointer shape;                    // absent: everywhere
  std::optional<ProfileConfig> profile;  // its columns instead of the values above; its velocity is added
  std::optional<double> energy;          // J, internal, of all that the region holds; instead of the pressure
};
struct EdgeConfig : GasStateConfig {
  BoxSide side = BoxSide::low_x;
  EdgeKind kind = EdgeKind::wall;
};

/// Where, and from when on, something burns that would not by itself, or a programmed detonation starts.
struct IgnitionConfig {
  ShapePointer shape;  // absent: everywhere
  double time = 0.0;   // s
};
/// A fluid burns to another one, by the law of its material.
struct ReactionConfig {
  std::string name = "reaction";
  std::string reactant, product;  // fluids
  std::vector<IgnitionConfig> ignitions;
};
/// A rigid body of particles in the gas. Its motion is prescribed, or the gas drives it along an axis.
struct GasBodyConfig {
  std::string name;
  ShapePointer shape;
  int particles_per_direction = 2;
  Vector velocity{};               // m/s
  Vector rotation{};               // rad/s, about `centre`
  Vector centre{};                 // m, at the start; moves along
  double radial_velocity = 0.0;    // m/s, of what is at `radius` from the centre at the start; every part keeps its volume
  double radius = 0.0;             // m
  std::optional<Table> amplitude;  // of all three, against s
  std::optional<double> mass;      // kg: the gas drives it
  Axis axis = Axis::x;             // along which
};

/// Gas in a box of cells, with walls where no edge says otherwise. Later fills lie over earlier ones.
struct GasConfig {
  Vector lower{}, upper{};  // m, on planes of nodes
  double courant = 0.0;     // 0: 0.5
  double least_mach = 0.001;
  GasScheme scheme = GasScheme::ice;
  bool implicit = false;            // acoustic waves by a solve for the pressure
  double acoustic_courant = 20.0;   // of their steps
  double momentum_exchange = 1e15;  // kg/(m^3 s), between fluids: scheme ice_classic
  double heat_exchange = 0.0;       // W/(m^3 K), between fluids
  std::vector<FluidConfig> fluids;
  std::vector<FillConfig> fills;
  std::vector<EdgeConfig> edges;
  std::vector<ReactionConfig> reactions;
  std::vector<GasBodyConfig> bodies;
};

// Observation --------------------------------------------------------------------------------------------------------

enum class GaugeKind { point, line, plane, surface };
struct GaugeConfig {
  std::string name;
  GaugeKind kind = GaugeKind::point;
  std::optional<bool> moves;  // with the material (if not given), or fixed in space; not of kind surface
  std::string body;           // empty: any
  Vector from{}, to{};        // a point is `from`; a line runs from one to the other; a plane is the box between them
  std::optional<Axis> axis;   // direction in which a surface is sought: kind surface
  std::optional<Side> side;   // which surface along that axis, the upper one if not given: kind surface
  std::vector<std::string> fields;
};

enum class MeasureKind {
  final_length,       // extent of the body along the axis
  mushroom_diameter,  // largest diameter
  diameter_at,        // diameter at a distance from the impact face, given as a part of the initial length
  undeformed_length,  // from the rear face to where the radius exceeds the initial one by a tolerance
  profile_error,      // mean of |computed - measured radius|, over the initial radius
  // of the gas at a gauge, in its positive phase: the time above the ambient pressure in which it is highest
  peak_overpressure,
  arrival_time,       // when half of the peak is reached
  positive_duration,  // from then on
  positive_impulse    // integral of the overpressure over the phase, per area
};
constexpr bool is_of_gas(MeasureKind kind) {
  return kind >= MeasureKind::peak_overpressure;
}
constexpr Unit unit_of(MeasureKind kind) {
  switch (kind) {
    case MeasureKind::profile_error:
      return Unit::one;
    case MeasureKind::peak_overpressure:
      return Unit::Pa;
    case MeasureKind::arrival_time:
    case MeasureKind::positive_duration:
      return Unit::s;
    case MeasureKind::positive_impulse:
      return Unit::Pa_s;
    default:
      return Unit::m;
  }
}
struct MeasureConfig {
  std::string name;  // under which it stands in summary.json
  MeasureKind kind = MeasureKind::final_length;
  std::string body;
  Axis axis = Axis::y;
  double at = 0.0;                 // see kind
  std::string gauge;               // of kind point: kinds of gas
  std::optional<double> ambient;   // Pa, before the wave: kinds of gas
  std::optional<double> measured;  // by experiment, SI
  std::filesystem::path profile;   // CSV of an experiment's profile
};

/// A picture that is drawn at the end.
enum class FigureKind {
  line  // fields along a line
};
struct FigureConfig {
  std::string name;
  FigureKind kind = FigureKind::line;
  std::string body;  // empty: any
  std::vector<std::string> fields;
  Vector from{}, to{};
  std::filesystem::path reference;  // CSV, drawn beside what was computed
};

struct OutputConfig {
  double history_interval = 0.0;     // s; 0: 500 rows over the run
  double snapshot_interval = 0.0;    // s; 0: none but the last
  double checkpoint_interval = 0.0;  // s of simulated time; 0: none
  int checkpoint_steps = 0;          // steps; 0: none
  double checkpoint_wall = 600.0;    // s of wall time
  std::string figure_field = "plastic_strain";
  bool figures = true;
  bool grid = false;  // snapshots of the nodes beside those of the particles
};

/// Limits on the books; a run that exceeds one stops with a report.
struct GateConfig {
  static constexpr double usual_residual = 1e-10;
  std::optional<double> residual;   // energy, momentum and angular momentum in no bin, part of the peak; the usual if not given
  std::optional<double> numerical;  // sum of the numerical bins over the peak kinetic energy
  std::optional<double> fastest;    // m/s: no particle is faster
};

struct NumericsConfig {
  Basis basis = Basis::quadratic_spline;
  StressTiming stress_timing = StressTiming::musl;
  ParticleVelocity particle_velocity = ParticleVelocity::aflip;
  double filter_time = 30.0;        // of AFLIP, in cell size over sound speed
  double courant = 0.0;             // 0: 0.4 in three dimensions, 0.5 in two; 0.3 with usl
  double most_volume_change = 0.1;  // per step
  double growth = 1.1;              // of the step, per step
  double first_step = 0.0;          // s; 0: from the initial state
  double least_step = 0.0;          // s; a smaller one stops the run
  std::optional<double> trimming;   // sub-cells filled less than this get no particle; 0.05 in three dimensions, 0 in two
  std::uint64_t seed = 1;
};

struct Case {
  std::string title;
  std::string subtitle;
  std::vector<std::string> set;  // "cell_size=1 mm": what --set has changed in the file of this title
  std::filesystem::path file;
  Geometry geometry = Geometry::three_dimensional;
  double cell_size = 0.0;  // m
  double end_time = 0.0;   // s
  Vector gravity{};        // m/s^2
  NumericsConfig numerics;
  std::vector<BodyConfig> bodies;
  std::vector<BoundaryConfig> boundaries;
  std::vector<LoadConfig> loads;
  std::optional<GasConfig> gas;
  std::vector<GaugeConfig> gauges;
  std::vector<MeasureConfig> measures;
  std::vector<FigureConfig> figures;
  OutputConfig output;
  GateConfig gates;

  int dimensions() const { return number_of_dimensions(geometry); }
  /// The line below the title: its subtitle, and "with cell_size=1 mm", what differs from the file. Gates change nothing that
  /// is computed, and are raised by hand later.
  std::string below_title() const {
    std::string text = subtitle;
    for (const std::string& change : set)
      if (!change.starts_with("gates")) text += (text.empty() ? "with " : ", ") + change;
    return text;
  }
};

/// Whether a plane goes where its velocity leads, and the grid with it: only if no other plane of nodes lies across its axis.
inline bool travels(const Case& c, const BoundaryConfig& boundary) {
  int planes = c.geometry == Geometry::axisymmetric && boundary.axis == Axis::x ? 1 : 0;
  for (const BoundaryConfig& b : c.boundaries) planes += b.axis == boundary.axis && b.kind != BoundaryKind::outflow ? 1 : 0;
  return boundary.velocity.size > 0 && planes == 1;
}

}  // namespace brisance::simulator

namespace brisance {

template <>
inline constexpr std::array choices<simulator::Geometry> = {
    std::string_view{"plane"},     std::string_view{"axisymmetric"},   std::string_view{"three_dimensional"},
    std::string_view{"planar_1d"}, std::string_view{"cylindrical_1d"}, std::string_view{"spherical_1d"}};
template <>
inline constexpr std::array choices<simulator::Basis> = {std::string_view{"quadratic_spline"}, std::string_view{"ugimp"}};
template <>
inline constexpr std::array choices<simulator::StressTiming> = {std::string_view{"musl"}, std::string_view{"usl"},
                                                                std::string_view{"usf"}};
template <>
inline constexpr std::array choices<simulator::ParticleVelocity> = {std::string_view{"flip"}, std::string_view{"aflip"}};
template <>
inline constexpr std::array choices<simulator::Axis> = {std::string_view{"x"}, std::string_view{"y"}, std::string_view{"z"}};
template <>
inline constexpr std::array choices<simulator::Side> = {std::string_view{"above"}, std::string_view{"below"}};
template <>
inline constexpr std::array choices<simulator::BoundaryKind> = {std::string_view{"symmetry"}, std::string_view{"fixed"},
                                                                std::string_view{"velocity"}, std::string_view{"rigid_wall"},
                                                                std::string_view{"outflow"}};
template <>
inline constexpr std::array choices<simulator::EdgeKind> = {std::string_view{"wall"},     std::string_view{"inflow"},
                                                            std::string_view{"pressure"}, std::string_view{"non_reflecting"},
                                                            std::string_view{"periodic"}, std::string_view{"no_slip"}};
template <>
inline constexpr std::array choices<simulator::GasScheme> = {std::string_view{"ice"}, std::string_view{"ice_classic"}};
template <>
inline constexpr std::array choices<simulator::ProfileAlong> = {std::string_view{"x"}, std::string_view{"y"},
                                                                std::string_view{"z"}, std::string_view{"radius"}};
template <>
inline constexpr std::array choices<simulator::BoxSide> = {std::string_view{"low_x"}, std::string_view{"high_x"},
                                                           std::string_view{"low_y"}, std::string_view{"high_y"},
                                                           std::string_view{"low_z"}, std::string_view{"high_z"}};
template <>
inline constexpr std::array choices<simulator::GaugeKind> = {std::string_view{"point"}, std::string_view{"line"},
                                                             std::string_view{"plane"}, std::string_view{"surface"}};
template <>
inline constexpr std::array choices<simulator::FigureKind> = {std::string_view{"line"}};
template <>
inline constexpr std::array choices<simulator::MeasureKind> = {
    std::string_view{"final_length"},      std::string_view{"mushroom_diameter"}, std::string_view{"diameter_at"},
    std::string_view{"undeformed_length"}, std::string_view{"profile_error"},     std::string_view{"peak_overpressure"},
    std::string_view{"arrival_time"},      std::string_view{"positive_duration"}, std::string_view{"positive_impulse"}};

}  // namespace brisance
