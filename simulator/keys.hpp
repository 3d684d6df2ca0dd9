#pragma once
// The keys of a case file: one table per struct of config.hpp, from which the file is read, written and described.

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "models/input/key_table.hpp"
#include "simulator/config.hpp"

namespace brisance::simulator {

/// Specialised for each struct that stands in a case file.
template <class Config>
inline constexpr std::tuple<> keys{};

template <class Config>
constexpr const auto& keys_of(std::type_identity<Config>) {
  return keys<Config>;
}

/// What a gauge may record.
inline constexpr std::array<std::string_view, 19> gauge_fields = {
    "position",  "velocity", "stress_xx",     "stress_yy",      "stress_zz",           "stress_yz", "stress_xz",
    "stress_xy", "pressure", "temperature",   "plastic_strain", "plastic_strain_rate", "porosity",  "damage",
    "energy",    "density",  "failure_cause", "failure_time",   "von_mises_stress"};

// Shapes: { <form> = {...} } ---------------------------------------------------------------------------------------------

/// Forms of the file that become a Cone.
struct Cylinder {
  Vector start, end;
  double radius;
};
struct Tube {
  Vector start, end;
  double radius, inner_radius;
};
/// In the order of the alternatives that read_shape knows.
inline constexpr std::array<std::string_view, 8> shape_forms = {"box",  "cylinder", "cone",         "sphere",
                                                                "tube", "union",    "intersection", "difference"};

constexpr Unit m_per_s2{"m/s^2"}, Pa_s{"Pa s"}, W_per_m_K{"W/(m K)"}, W_per_m3_K{"W/(m^3 K)"}, kg_per_m3_s{"kg/(m^3 s)"};

template <>
inline constexpr auto keys<Box> =
    std::tuple{Key{"lower", &Box::lower, Unit::m, "corner with the smallest coordinates", any_value, required},
               Key{"upper", &Box::upper, Unit::m, "corner with the largest coordinates", any_value, required}};

template <>
inline constexpr auto keys<Cylinder> =
    std::tuple{Key{"start", &Cylinder::start, Unit::m, "middle of one end", any_value, required},
               Key{"end", &Cylinder::end, Unit::m, "middle of the other end", any_value, required},
               Key{"radius", &Cylinder::radius, Unit::m, "radius", positive, required}};

template <>
inline constexpr auto keys<Tube> =
    std::tuple{Key{"start", &Tube::start, Unit::m, "middle of one end", any_value, required},
               Key{"end", &Tube::end, Unit::m, "middle of the other end", any_value, required},
               Key{"radius", &Tube::radius, Unit::m, "outer radius", positive, required},
               Key{"inner_radius", &Tube::inner_radius, Unit::m, "inner radius", positive, required}};

template <>
inline constexpr auto keys<Cone> =
    std::tuple{Key{"start", &Cone::start, Unit::m, "middle of one end", any_value, required},
               Key{"end", &Cone::end, Unit::m, "middle of the other end", any_value, required},
               Key{"start_radius", &Cone::start_radius, Unit::m, "radius at the start", non_negative, required},
               Key{"end_radius", &Cone::end_radius, Unit::m, "radius at the end", non_negative, required},
               Key{"inner_start_radius", &Cone::inner_start_radius, Unit::m, "radius of the hole at the start", non_negative},
               Key{"inner_end_radius", &Cone::inner_end_radius, Unit::m, "radius of the hole at the end", non_negative}};

template <>
inline constexpr auto keys<Sphere> =
    std::tuple{Key{"centre", &Sphere::centre, Unit::m, "centre; in the plane geometry that of a disk", any_value, required},
               Key{"radius", &Sphere::radius, Unit::m, "radius", positive, required},
               Key{"inner_radius", &Sphere::inner_radius, Unit::m, "radius of the hollow", non_negative}};

// Bodies: [[solid]] ------------------------------------------------------------------------------------------------------

template <>
inline constexpr auto keys<InitialVelocity> = std::tuple{
    Key{"translation", &InitialVelocity::translation, Unit::m_per_s, "velocity of the whole body"},
    Key{"rotation", &InitialVelocity::rotation, Unit::per_s, "angular velocity about x, y and z, in rad/s", any_value, false,
        Components::three},
    Key{"centre", &InitialVelocity::centre, Unit::m, "a point that the rotation and the radial velocity leave at rest"},
    Key{"radial", &InitialVelocity::radial, Unit::m_per_s, "away from the centre, or from the axis of symmetry"},
    Key{"radial_rate", &InitialVelocity::radial_rate, Unit::per_s, "radial velocity per distance"}};

template <>
inline constexpr auto keys<StrengthDistribution> = std::tuple{
    Key{"median", &StrengthDistribution::median, Unit::one, "factor on the strength, median in the reference volume", positive},
    Key{"weibull_modulus", &StrengthDistribution::weibull_modulus, Unit::one,
        "the smaller, the more the factor varies from particle to particle; 0: not at all", non_negative},
    Key{"reference_volume", &StrengthDistribution::reference_volume, Unit{"m^3"}, "volume that the median belongs to",
        non_negative}};

template <>
inline constexpr auto keys<BodyConfig> = std::tuple{
    Key{"name", &BodyConfig::name, Unit::one, "what the body is called here and in output", any_value, required},
    Key{"shape", &BodyConfig::shape, Unit::one, "what it fills", any_value, required},
    Key{"temperature", &BodyConfig::temperature, Unit::K, "initial temperature", positive, required},
    Key{"velocity", &BodyConfig::velocity, Unit::m_per_s, "initial velocity: components, or a table"},
    Key{"particles_per_direction", &BodyConfig::particles_per_direction, Unit::one, "particles in a cell along each direction",
        between(1, 8)},
    Key{"porosity", &BodyConfig::porosity, Unit::one, "initial porosity instead of the material's: a table with its law"},
    Key{"damage", &BodyConfig::damage, Unit::one, "initial damage instead of the material's: a table with its law"},
    Key{"strength", &BodyConfig::strength, Unit::one, "factor on the strength of each particle"},
    Key{"locking_cure", &BodyConfig::locking_cure, Unit::one,
        "averages the volume change over each cell where the material flows plastically"},
    Key{"material", &BodyConfig::material, Unit::one, "name of a material file, or the material itself", any_value, required}};

// Boundaries and loads: [[boundary]], [[load]] ---------------------------------------------------------------------------

template <>
inline constexpr auto keys<BoundaryConfig> = std::tuple{
    Key{"kind", &BoundaryConfig::kind, Unit::one,
        "symmetry: nothing passes; fixed: sticks; velocity: gives what is on its plane a velocity; rigid_wall: bodies may "
        "leave it and slide; outflow: bodies leave through it",
        any_value, required},
    Key{"axis", &BoundaryConfig::axis, Unit::one, "axis that the plane is normal to", any_value, required},
    Key{"position", &BoundaryConfig::position, Unit::m, "coordinate of the plane, a multiple of cell_size", any_value,
        required},
    Key{"side", &BoundaryConfig::side, Unit::one, "where the bodies are", any_value, required},
    Key{"name", &BoundaryConfig::name, Unit::one, "what it is called in output; from kind, axis and side if not given"},
    Key{"velocity", &BoundaryConfig::velocity, Unit::m_per_s,
        "velocity along the axis, of kinds velocity and rigid_wall; a table over time; the grid travels with the plane, which "
        "for more than half a cell must be the only one across its axis"},
    Key{"friction", &BoundaryConfig::friction, Unit::one, "Coulomb's coefficient, of kind rigid_wall", non_negative}};

template <>
inline constexpr auto keys<LoadConfig> = std::tuple{
    Key{"body", &LoadConfig::body, Unit::one, "the body it acts on; the only one if not given"},
    Key{"region", &LoadConfig::region, Unit::one, "part of the surface that lies in this shape; all of it if not given"},
    Key{"pressure", &LoadConfig::pressure, Unit::Pa, "pressure; a table over time"},
    Key{"traction", &LoadConfig::traction, Unit::Pa, "force per area of the undeformed surface"},
    Key{"amplitude", &LoadConfig::amplitude, Unit::one, "factor on the traction; a table over time"}};

// Gas: [gas], [[gas.fluid]], [[gas.fill]], [[gas.edge]], [[gas.reaction]] --------------------------------------------------

template <>
inline constexpr auto keys<FluidConfig> = std::tuple{
    Key{"name", &FluidConfig::name, Unit::one, "what the fluid is called here and in output", any_value, required},
    Key{"material", &FluidConfig::material, Unit::one,
        "name of a material file, or the material itself; its equation of state counts", any_value, required},
    Key{"viscosity", &FluidConfig::viscosity, Pa_s, "dynamic viscosity, constant", non_negative},
    Key{"bulk_viscosity", &FluidConfig::bulk_viscosity, Pa_s, "resistance to a change of volume, constant", non_negative},
    Key{"conductivity", &FluidConfig::conductivity, W_per_m_K, "of heat, constant", non_negative}};

/// The keys of a state of gas, of a region or an edge.
template <class Config>
inline constexpr auto gas_state_keys =
    std::tuple{Key<Config, std::string>{"fluid", &Config::fluid, Unit::one, "which fluid it is; the only one if not given"},
               Key<Config, std::optional<Varying>>{"pressure", &Config::pressure, Unit::Pa, "its pressure"},
               Key<Config, std::optional<Varying>>{"density", &Config::density, Unit::kg_per_m3,
                                                   "its density, or else the temperature", positive},
               Key<Config, std::optional<Varying>>{"temperature", &Config::temperature, Unit::K, "its temperature", positive},
               Key<Config, VaryingVector>{"velocity", &Config::velocity, Unit::m_per_s, "its velocity"}};

template <>
inline constexpr auto keys<ProfileConfig> = std::tuple{
    Key{"file", &ProfileConfig::file, Unit::one,
        "CSV beside this file: a column named as `along`, rising (two rows of one place make a jump), and one or more of "
        "density, pressure, velocity_along (in the direction of `along`) and velocity_around (the centre, in the plane)",
        any_value, required},
    Key{"along", &ProfileConfig::along, Unit::one, "a coordinate, or the distance from the centre", any_value, required},
    Key{"centre", &ProfileConfig::centre, Unit::m, "where the radius begins"}};

template <>
inline constexpr auto keys<FillConfig> = std::tuple_cat(
    std::tuple{Key{"shape", &FillConfig::shape, Unit::one, "the region it fills at the start; all of the box if not given"}},
    gas_state_keys<FillConfig>,
    std::tuple{Key{"profile", &FillConfig::profile, Unit::one,
                   "a file with states along a line, instead of a density or pressure that it holds; its velocity is added"},
               Key{"energy", &FillConfig::energy, Unit{"J"},
                   "internal energy of all that the region holds within the box, instead of the pressure: of a whole turn or "
                   "sphere in the round geometries, per m or m^2 in one and two straight dimensions",
                   positive}});

template <>
inline constexpr auto keys<EdgeConfig> = std::tuple_cat(
    std::tuple{Key{"side", &EdgeConfig::side, Unit::one, "side of the box", any_value, required},
               Key{"kind", &EdgeConfig::kind, Unit::one,
                   "wall: reflects; inflow: the state beyond is given; pressure: the pressure beyond is given; non_reflecting: "
                   "waves leave into a given state; periodic: continues at the opposite side; no_slip: a wall that viscous "
                   "fluids stick to",
                   any_value, required}},
    gas_state_keys<EdgeConfig>);

template <>
inline constexpr auto keys<IgnitionConfig> =
    std::tuple{Key{"shape", &IgnitionConfig::shape, Unit::one, "the region that is lit; all of the box if not given"},
               Key{"time", &IgnitionConfig::time, Unit::s, "from when on", non_negative}};

template <>
inline constexpr auto keys<ReactionConfig> =
    std::tuple{Key{"name", &ReactionConfig::name, Unit::one, "what the reaction is called in output"},
               Key{"reactant", &ReactionConfig::reactant, Unit::one, "fluid that burns, by the [reaction] of its material",
                   any_value, required},
               Key{"product", &ReactionConfig::product, Unit::one, "fluid that it burns to", any_value, required},
               Key{"ignition", &ReactionConfig::ignitions, Unit::one,
                   "what is lit: a surface, however cold it is; where a programmed detonation starts"}};

template <>
inline constexpr auto keys<GasBodyConfig> = std::tuple{
    Key{"name", &GasBodyConfig::name, Unit::one, "what the body is called in output", any_value, required},
    Key{"shape", &GasBodyConfig::shape, Unit::one,
        "what it fills at the start; 2 cells thick at least, or gas leaks through it", any_value, required},
    Key{"particles_per_direction", &GasBodyConfig::particles_per_direction, Unit::one,
        "particles in a cell along each direction", between(1, 8)},
    Key{"velocity", &GasBodyConfig::velocity, Unit::m_per_s, "its velocity"},
    Key{"rotation", &GasBodyConfig::rotation, Unit::per_s, "angular velocity about x, y and z, in rad/s", any_value, false,
        Components::three},
    Key{"centre", &GasBodyConfig::centre, Unit::m, "centre of the rotation and the radial motion at the start; moves along"},
    Key{"radial_velocity", &GasBodyConfig::radial_velocity, Unit::m_per_s,
        "away from the centre, of what is at `radius` at the start; every part keeps its volume"},
    Key{"radius", &GasBodyConfig::radius, Unit::m, "where the radial velocity is given", non_negative},
    Key{"amplitude", &GasBodyConfig::amplitude, Unit::one, "factor on all velocities; a table over time"},
    Key{"mass", &GasBodyConfig::mass, Unit::kg,
        "of a body that starts at rest and that the gas drives along `axis`, instead of velocities; per metre in the plane",
        positive},
    Key{"axis", &GasBodyConfig::axis, Unit::one, "direction in which the gas drives it"}};

template <>
inline constexpr auto keys<GasConfig> = std::tuple{
    Key{"lower", &GasConfig::lower, Unit::m, "lower corner of the box, a multiple of cell_size", any_value, required},
    Key{"upper", &GasConfig::upper, Unit::m, "upper corner of the box, a multiple of cell_size", any_value, required},
    Key{"courant", &GasConfig::courant, Unit::one, "part of the stable step; 0: 0.5", fraction},
    Key{"least_mach", &GasConfig::least_mach, Unit::one,
        "Mach number below which the damping of slow flow falls no further; 1: always that of a shock", fraction},
    Key{"scheme", &GasConfig::scheme, Unit::one,
        "ice, or to compare with it the classic form of 1993, ice_classic, whose energy is in no book, so that no gate "
        "watches it unless gates.residual is given"},
    Key{"implicit", &GasConfig::implicit, Unit::one,
        "solve for the pressure of each step, so that steps may be longer than sound takes from cell to cell"},
    Key{"acoustic_courant", &GasConfig::acoustic_courant, Unit::one,
        "with implicit, instead of courant: step over the time that sound takes through a cell", positive},
    Key{"momentum_exchange", &GasConfig::momentum_exchange, kg_per_m3_s,
        "with ice_classic: drag between each two fluids, times the product of their fractions and the difference of their "
        "velocities",
        non_negative},
    Key{"heat_exchange", &GasConfig::heat_exchange, W_per_m3_K,
        "heat between each two fluids of a cell, times the product of their fractions and the difference of their temperatures",
        non_negative},
    Key{"fluid", &GasConfig::fluids, Unit::one, "a gas or liquid", any_value, required},
    Key{"fill", &GasConfig::fills, Unit::one, "what a region holds at the start; later ones lie over earlier ones", any_value,
        required},
    Key{"body", &GasConfig::bodies, Unit::one, "a rigid body in the gas"},  // with bodies edges are asked for farther beyond
    Key{"edge", &GasConfig::edges, Unit::one, "a side of the box that is no wall"},
    Key{"reaction", &GasConfig::reactions, Unit::one, "a fluid burns to another"}};

// Observation: [[gauge]], [[measure]], [[figure]], [output], [gates] -----------------------------------------------------

template <>
inline constexpr auto keys<GaugeConfig> = std::tuple{
    Key{"name", &GaugeConfig::name, Unit::one, "what it is called in output", any_value, required},
    Key{"kind", &GaugeConfig::kind, Unit::one, "point, line from one point to another, plane, or surface; in gas point or line",
        any_value, required},
    Key{"fields", &GaugeConfig::fields, Unit::one, "what it records", any_value, required},
    Key{"from", &GaugeConfig::from, Unit::m,
        "the point; first end of the line; a corner of the box of a plane, or across which a surface is sought", any_value,
        required},
    Key{"to", &GaugeConfig::to, Unit::m, "last end of the line; the opposite corner"},
    Key{"moves", &GaugeConfig::moves, Unit::one, "with the material, if not given; or fixed in space; not of kind surface"},
    Key{"body", &GaugeConfig::body, Unit::one, "the body it watches; any if not given"},
    Key{"axis", &GaugeConfig::axis, Unit::one, "direction in which a surface is sought, of kind surface"},
    Key{"side", &GaugeConfig::side, Unit::one, "which surface along that axis, of kind surface; the upper one if not given"}};

template <>
inline constexpr auto keys<MeasureConfig> = std::tuple{
    Key{"kind", &MeasureConfig::kind, Unit::one,
        "final_length, mushroom_diameter, diameter_at (a part of the initial length from the impact face), "
        "undeformed_length, or profile_error; of gas at a gauge, of the time above the ambient pressure in which "
        "it is highest: peak_overpressure, arrival_time (of half the peak), positive_duration (from then on), "
        "positive_impulse (per area)",
        any_value, required},
    Key{"name", &MeasureConfig::name, Unit::one,
        "under which it stands in summary.json; if not given the kind, of gas GAUGE_KIND"},
    Key{"body", &MeasureConfig::body, Unit::one, "the body it is of; the only one if not given"},
    Key{"axis", &MeasureConfig::axis, Unit::one, "axis of the body; the impact face is at its lower end"},
    Key{"at", &MeasureConfig::at, Unit::one, "distance from the impact face over the initial length, of kind diameter_at",
        fraction},
    Key{"gauge", &MeasureConfig::gauge, Unit::one, "the gauge at whose point it is measured, of kinds of gas"},
    Key{"ambient", &MeasureConfig::ambient, Unit::Pa, "the pressure before the wave, of kinds of gas", positive},
    Key{"measured", &MeasureConfig::measured, Unit::one, "what an experiment gave, in the unit of the kind", positive},
    Key{"profile", &MeasureConfig::profile, Unit::one,
        "measured profile: CSV with columns radius and height, beside this file; of kind profile_error"}};

template <>
inline constexpr auto keys<OutputConfig> = std::tuple{
    Key{"history_interval", &OutputConfig::history_interval, Unit::s,
        "time between rows of history.csv; 0: 500 rows to the end", non_negative},
    Key{"snapshot_interval", &OutputConfig::snapshot_interval, Unit::s, "time between snapshots; 0: only the last",
        non_negative},
    Key{"checkpoint_interval", &OutputConfig::checkpoint_interval, Unit::s, "simulated time between checkpoints; 0: none",
        non_negative},
    Key{"checkpoint_steps", &OutputConfig::checkpoint_steps, Unit::one, "steps between checkpoints; 0: none",
        between(0, 1'000'000'000)},
    Key{"checkpoint_wall", &OutputConfig::checkpoint_wall, Unit::s, "time on the clock between checkpoints", positive},
    Key{"figure_field", &OutputConfig::figure_field, Unit::one, "what the figures show in colours"},
    Key{"figures", &OutputConfig::figures, Unit::one, "draw figures at the end"},
    Key{"grid", &OutputConfig::grid, Unit::one,
        "with each snapshot of the particles one of the grid: mass, velocity and force of its nodes, for ParaView"}};

template <>
inline constexpr auto keys<FigureConfig> =
    std::tuple{Key{"name", &FigureConfig::name, Unit::one, "names the file: KIND_NAME.png", any_value, required},
               Key{"kind", &FigureConfig::kind, Unit::one,
                   "line: fields at the end along a line; of a vector its component along it", any_value, required},
               Key{"fields", &FigureConfig::fields, Unit::one, "what is drawn, each in its own panel", any_value, required},
               Key{"from", &FigureConfig::from, Unit::m, "first end of the line", any_value, required},
               Key{"to", &FigureConfig::to, Unit::m, "last end of the line", any_value, required},
               Key{"body", &FigureConfig::body, Unit::one, "the body it shows; any if not given"},
               Key{"reference", &FigureConfig::reference, Unit::one,
                   "drawn beside it: CSV beside this file, with a column x, y or z, for an oblique line distance (from its "
                   "first end), and "
                   "columns named as the fields"}};

template <>
inline constexpr auto keys<GateConfig> = std::tuple{
    Key{"residual", &GateConfig::residual, Unit::one,
        "largest part of energy, momentum and angular momentum that no book holds, over the peak; 1e-10 if not given, but "
        "for the energy of scheme ice_classic none",
        positive},
    Key{"numerical", &GateConfig::numerical, Unit::one,
        "largest energy in numerical books over the peak kinetic energy; no limit if not given", positive},
    Key{"fastest", &GateConfig::fastest, Unit::m_per_s, "no particle may be faster; no limit if not given", positive}};

// The whole: top level, [numerics] ---------------------------------------------------------------------------------------

template <>
inline constexpr auto keys<NumericsConfig> = std::tuple{
    Key{"basis", &NumericsConfig::basis, Unit::one, "functions of the grid"},
    Key{"stress_timing", &NumericsConfig::stress_timing, Unit::one,
        "stress from velocities mapped back after the motion (musl), from the new ones (usl), or before the forces (usf)"},
    Key{"particle_velocity", &NumericsConfig::particle_velocity, Unit::one,
        "how particles take the grid's velocity: its change (flip), or with an affine part and a slow filter (aflip)"},
    Key{"filter_time", &NumericsConfig::filter_time, Unit::one,
        "time constant of aflip's filter, in cell_size over sound speed", positive},
    Key{"courant", &NumericsConfig::courant, Unit::one,
        "part of the stable step; 0: 0.5 in two dimensions, 0.4 in three, 0.3 with usl", fraction},
    Key{"most_volume_change", &NumericsConfig::most_volume_change, Unit::one, "of a particle in one step",
        Interval{0.0, 0.5, true, false}},
    Key{"growth", &NumericsConfig::growth, Unit::one, "largest ratio of a step to the one before",
        Interval{1.0, 2.0, true, false}},
    Key{"first_step", &NumericsConfig::first_step, Unit::s, "0: from the initial state", non_negative},
    Key{"least_step", &NumericsConfig::least_step, Unit::s, "a smaller step stops the run", non_negative},
    Key{"trimming", &NumericsConfig::trimming, Unit::one,
        "parts of a cell that are filled less than this get no particle; 0.05 in three dimensions and 0 in two if not given",
        Interval{0.0, 0.5}},
    Key{"seed", &NumericsConfig::seed, Unit::one, "of the random numbers", between(0, 2147483647)}};

template <>
inline constexpr auto keys<Case> =
    std::tuple{Key{"title", &Case::title, Unit::one, "one line; the name of the file if not given"},
               Key{"subtitle", &Case::subtitle, Unit::one,
                   "stands below the title in summary and figures; a run adds what --set has changed"},
               Key{"set", &Case::set, Unit::one, "what --set has changed: a run writes it, and tells it below the title"},
               Key{"geometry", &Case::geometry, Unit::one,
                   "plane: x, y; axisymmetric: x is the radius, y along the axis; three_dimensional: x, y, z; of gas "
                   "alone: planar_1d: x; cylindrical_1d, spherical_1d: x is the radius",
                   any_value, required},
               Key{"cell_size", &Case::cell_size, Unit::m, "width of a cell of the grid", positive, required},
               Key{"end_time", &Case::end_time, Unit::s, "simulated time at the end", positive, required},
               Key{"gravity", &Case::gravity, m_per_s2, "acceleration of all bodies"},
               Key{"numerics", &Case::numerics, Unit::one, "how it is computed"},
               Key{"solid", &Case::bodies, Unit::one, "a body"},
               Key{"boundary", &Case::boundaries, Unit::one, "a plane that bounds the bodies"},
               Key{"load", &Case::loads, Unit::one, "pressure or traction on a surface"},
               Key{"gas", &Case::gas, Unit::one, "gas in a box of cells"},
               Key{"gauge", &Case::gauges, Unit::one, "a place that is watched over time"},
               Key{"measure", &Case::measures, Unit::one, "a number that an experiment gave as well"},
               Key{"figure", &Case::figures, Unit::one, "a picture that is drawn at the end"},
               Key{"output", &Case::output, Unit::one, "what is written, and when"},
               Key{"gates", &Case::gates, Unit::one, "limits on what may go wrong"}};

// Description ------------------------------------------------------------------------------------------------------------

/// What gauges and figures may show of gas, and what `figure_field` may be of solids.
const std::vector<std::string_view>& gas_field_names();
std::vector<std::string_view> scalar_fields();

/// Every key of a case file, in the order of the tables above.
const std::vector<KeyDescription>& all_keys();

}  // namespace brisance::simulator
