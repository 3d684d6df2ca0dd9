#pragma once
// The keys of the point driver's files (paths, comparisons, calibrations): one table per struct, from which files are read and
// described. The structs are the tables as they stand in a file; what they mean together is the matter of who reads them.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "driver/calibrate.hpp"
#include "driver/compare.hpp"
#include "driver/loading_path.hpp"
#include "models/input/key_table.hpp"

namespace brisance::driver {

enum class Direction { x, y, z };
enum class Plane { xy, xz, yx, yz, zx, zy };
enum class TestDirection { compression, tension };
enum class Scale { linear, logarithmic };
enum class ModeName {
  uniaxial_stress,
  uniaxial_strain,
  plane_stress,
  biaxial_stress,
  simple_shear,
  hydrostatic,
  constant_triaxiality,
  hold
};

}  // namespace brisance::driver

namespace brisance {

using Words = std::string_view;
template <>
inline constexpr std::array choices<driver::Heat> = {Words{"adiabatic"}, Words{"isothermal"}, Words{"prescribed"}};
template <>
inline constexpr std::array choices<driver::OnFailure> = {Words{"stop"}, Words{"continue"}};
template <>
inline constexpr std::array choices<driver::Direction> = {Words{"x"}, Words{"y"}, Words{"z"}};
template <>
inline constexpr std::array choices<driver::Plane> = {Words{"xy"}, Words{"xz"}, Words{"yx"},
                                                      Words{"yz"}, Words{"zx"}, Words{"zy"}};
template <>
inline constexpr std::array choices<driver::TestDirection> = {Words{"compression"}, Words{"tension"}};
template <>
inline constexpr std::array choices<driver::Scale> = {Words{"linear"}, Words{"logarithmic"}};
template <>
inline constexpr std::array choices<driver::Residual> = {Words{"absolute"}, Words{"relative"}};
template <>
inline constexpr std::array choices<driver::ModeName> = {
    Words{"uniaxial_stress"}, Words{"uniaxial_strain"}, Words{"plane_stress"},         Words{"biaxial_stress"},
    Words{"simple_shear"},    Words{"hydrostatic"},     Words{"constant_triaxiality"}, Words{"hold"}};

}  // namespace brisance

namespace brisance::driver {

/// Specialised for each struct that stands in a file.
template <class File>
inline constexpr std::tuple<> keys{};

template <class File>
constexpr const auto& keys_of(std::type_identity<File>) {
  return keys<File>;
}

/// A table or a list of tables that is read by hand; the meaning of its key says what it holds.
using OpenTable = std::optional<TableReader>;
using OpenTables = std::vector<TableReader>;
/// A table of components of a tensor, read by hand: each a number of the key's unit.
struct SymmetricTable : OpenTable {};  // xx, yy, zz, yz, xz, xy
struct GeneralTable : OpenTable {};    // all nine

// Path files: [[segment]] ------------------------------------------------------------------------------------------------

/// What every segment may have.
struct SegmentKeys {
  std::optional<ModeName> mode;
  std::optional<double> duration, strain;
  OpenTable until;
  std::optional<double> temperature;
  double temperature_jump = 0.0, temperature_rate = 0.0;
};
template <>
inline constexpr auto keys<SegmentKeys> = std::tuple{
    Key{"mode", &SegmentKeys::mode, Unit::one,
        "how the point is driven; without it by components: strain_rate or velocity_gradient with stress, or "
        "deformation_gradient"},
    Key{"duration", &SegmentKeys::duration, Unit::s, "how long the segment lasts; stresses change linearly over it", positive},
    Key{"strain", &SegmentKeys::strain, Unit::one,
        "ends the segment: size of the change of strain, positive; its direction is that of the strain rate"},
    Key{"until", &SegmentKeys::until, Unit::one,
        "ends the segment: a column of the history and its value, as in { plastic_strain = 0.1 }; \"strain\" and \"stress\" "
        "are those that the mode drives"},
    Key{"temperature", &SegmentKeys::temperature, Unit::K, "temperature from the start of the segment", positive},
    Key{"temperature_jump", &SegmentKeys::temperature_jump, Unit::K,
        "added to the temperature at the start, at constant stress"},
    Key{"temperature_rate", &SegmentKeys::temperature_rate, Unit{"K/s"},
        "rate of the temperature; needs heat = \"prescribed\""}};

/// [[segment]] with `repeat`: a group.
struct GroupKeys {
  int repeat = 1;
  OpenTables segments;
};
template <>
inline constexpr auto keys<GroupKeys> = std::tuple{
    Key{"repeat", &GroupKeys::repeat, Unit::one, "how often the segments within this one are followed", between(1, 100000),
        required},
    Key{"segment", &GroupKeys::segments, Unit::one, "with `repeat`: the segments [[segment.segment]] that are repeated"}};

constexpr std::string_view driven_rate = "rate along the axis, positive in extension";
constexpr std::string_view driven_stress = "instead of strain_rate: stress along the axis at the end, positive in tension";

struct UniaxialStressKeys {
  Direction axis = Direction::x;
  std::optional<double> strain_rate, stress;
  double lateral_pressure = 0.0;
};
template <>
inline constexpr auto keys<UniaxialStressKeys> =
    std::tuple{Key{"axis", &UniaxialStressKeys::axis, Unit::one, "axis that is driven; the sides are free"},
               Key{"strain_rate", &UniaxialStressKeys::strain_rate, Unit::per_s, driven_rate},
               Key{"stress", &UniaxialStressKeys::stress, Unit::Pa, driven_stress},
               Key{"lateral_pressure", &UniaxialStressKeys::lateral_pressure, Unit::Pa, "pressure on the sides"}};

struct UniaxialStrainKeys {
  Direction axis = Direction::x;
  std::optional<double> strain_rate, stress;
};
template <>
inline constexpr auto keys<UniaxialStrainKeys> =
    std::tuple{Key{"axis", &UniaxialStrainKeys::axis, Unit::one, "axis that is driven; the sides do not move"},
               Key{"strain_rate", &UniaxialStrainKeys::strain_rate, Unit::per_s, driven_rate},
               Key{"stress", &UniaxialStrainKeys::stress, Unit::Pa, driven_stress}};

struct PlaneStressKeys {
  Direction normal = Direction::z;
  SymmetricTable strain_rate;
};
template <>
inline constexpr auto keys<PlaneStressKeys> =
    std::tuple{Key{"normal", &PlaneStressKeys::normal, Unit::one, "axis without stress"},
               Key{"strain_rate", &PlaneStressKeys::strain_rate, Unit::per_s, "rates in the plane", any_value, required}};

struct BiaxialStressKeys {
  double stress_ratio = 0.0;
  std::optional<double> strain_rate, stress;
};
template <>
inline constexpr auto keys<BiaxialStressKeys> = std::tuple{
    Key{"stress_ratio", &BiaxialStressKeys::stress_ratio, Unit::one, "stress along y over stress along x", any_value, required},
    Key{"strain_rate", &BiaxialStressKeys::strain_rate, Unit::per_s, "rate along x, positive in extension"},
    Key{"stress", &BiaxialStressKeys::stress, Unit::Pa, "instead of strain_rate: stress along x at the end"}};

struct SimpleShearKeys {
  Plane plane = Plane::xy;
  double shear_rate = 0.0;
};
template <>
inline constexpr auto keys<SimpleShearKeys> = std::tuple{
    Key{"plane", &SimpleShearKeys::plane, Unit::one, "direction of the velocity, then that of its gradient"},
    Key{"shear_rate", &SimpleShearKeys::shear_rate, Unit::per_s, "rate of the shear angle, d(gamma)/dt", any_value, required}};

struct HydrostaticKeys {
  std::optional<double> pressure, volume_strain_rate;
};
template <>
inline constexpr auto keys<HydrostaticKeys> =
    std::tuple{Key{"pressure", &HydrostaticKeys::pressure, Unit::Pa, "pressure at the end of the segment"},
               Key{"volume_strain_rate", &HydrostaticKeys::volume_strain_rate, Unit::per_s,
                   "instead of pressure: rate of ln(volume), negative in compression"}};

struct ConstantTriaxialityKeys {
  double triaxiality = 0.0, lode_angle = 0.0, strain_rate = 0.0;
};
template <>
inline constexpr auto keys<ConstantTriaxialityKeys> = std::tuple{
    Key{"triaxiality", &ConstantTriaxialityKeys::triaxiality, Unit::one, "mean stress over equivalent stress",
        between(-100.0, 100.0), required},
    Key{"lode_angle", &ConstantTriaxialityKeys::lode_angle, Unit{"degree"},
        "0 in axisymmetric tension, 30 in shear, 60 in axisymmetric compression", between(0.0, 60.0)},
    Key{"strain_rate", &ConstantTriaxialityKeys::strain_rate, Unit::per_s, "equivalent strain rate", positive, required}};

/// The present velocity gradient is zero.
struct HoldKeys {};

/// In the order of ModeName.
using ModeKeys = std::variant<UniaxialStressKeys, UniaxialStrainKeys, PlaneStressKeys, BiaxialStressKeys, SimpleShearKeys,
                              HydrostaticKeys, ConstantTriaxialityKeys, HoldKeys>;

/// A segment without mode.
struct ComponentKeys {
  SymmetricTable strain_rate, stress;
  GeneralTable velocity_gradient, deformation_gradient;
};
template <>
inline constexpr auto keys<ComponentKeys> =
    std::tuple{Key{"strain_rate", &ComponentKeys::strain_rate, Unit::per_s, "without mode: components, as in { xx = 1000 }"},
               Key{"velocity_gradient", &ComponentKeys::velocity_gradient, Unit::per_s, "without mode, instead of strain_rate"},
               Key{"deformation_gradient", &ComponentKeys::deformation_gradient, Unit::one,
                   "without mode: reached at the end of the duration; components not given are those of the identity"},
               Key{"stress", &ComponentKeys::stress, Unit::Pa,
                   "without mode: stresses at the end of the segment; these components of the rate are free"}};

// Path files: the rest ---------------------------------------------------------------------------------------------------

struct InitialKeys {
  double temperature = 0.0;
  std::optional<double> density;
  double plastic_strain = 0.0, porosity = 0.0, damage = 0.0;
  SymmetricTable stress;
};
template <>
inline constexpr auto keys<InitialKeys> = std::tuple{
    Key{"temperature", &InitialKeys::temperature, Unit::K, "initial temperature", positive, required},
    Key{"density", &InitialKeys::density, Unit::kg_per_m3, "initial density; that of no pressure if not given", positive},
    Key{"plastic_strain", &InitialKeys::plastic_strain, Unit::one, "initial plastic strain", non_negative},
    Key{"porosity", &InitialKeys::porosity, Unit::one, "initial porosity",
        Interval{.lower = 0.0, .upper = 1.0, .upper_open = true}},
    Key{"damage", &InitialKeys::damage, Unit::one, "initial damage", fraction},
    Key{"stress", &InitialKeys::stress, Unit::Pa, "initial stress, positive in tension"}};

struct OutputKeys {
  std::optional<int> every;
  std::optional<int> rows;
};
template <>
inline constexpr auto keys<OutputKeys> =
    std::tuple{Key{"every", &OutputKeys::every, Unit::one, "a row of the history every so many steps", between(1, 1'000'000)},
               Key{"rows", &OutputKeys::rows, Unit::one, "about so many rows, evenly spaced in steps; 1000 if neither is given",
                   between(2, 10'000'000)}};

struct PlotKeys {
  std::string x, y;
};
template <>
inline constexpr auto keys<PlotKeys> =
    std::tuple{Key{"x", &PlotKeys::x, Unit::one, "column of the history for the axis of abscissas", any_value, required},
               Key{"y", &PlotKeys::y, Unit::one, "column of the history for the axis of ordinates", any_value, required}};

struct PathKeys {
  std::string title;
  MaterialFile material;
  Heat heat = Heat::adiabatic;
  OnFailure on_failure = OnFailure::stop;
  double strain_increment = LoadingPath{}.strain_increment, tolerance = 0.0, cell_size = 0.0;
  InitialKeys initial;
  OutputKeys output;
  std::optional<PlotKeys> plot;
  OpenTables segments;
  OpenTable sweep;
};
template <>
inline constexpr auto keys<PathKeys> = std::tuple{
    Key{"title", &PathKeys::title, Unit::one, "one line; the name of the file if not given"},
    Key{"material", &PathKeys::material, Unit::one, "name of a material file, or the material itself", any_value, required},
    Key{"heat", &PathKeys::heat, Unit::one,
        "adiabatic: the temperature follows from work; isothermal: it is kept; prescribed: it follows temperature_rate",
        any_value, required},
    Key{"on_failure", &PathKeys::on_failure, Unit::one, "what happens when a failure criterion fires"},
    Key{"strain_increment", &PathKeys::strain_increment, Unit::one, "largest strain of a step",
        Interval{.lower = 0.0, .upper = 0.05, .lower_open = true}},
    Key{"tolerance", &PathKeys::tolerance, Unit::one,
        "largest relative difference, in stress, temperature and plastic strain, between one step and two of half its size, "
        "which are kept; 0: steps are not looked at",
        Interval{.lower = 0.0, .upper = 0.1}},
    Key{"cell_size", &PathKeys::cell_size, Unit::m, "length of the artificial viscosity; 0: none", non_negative},
    Key{"initial", &PathKeys::initial, Unit::one, "the state at the start", any_value, required},
    Key{"segment", &PathKeys::segments, Unit::one, "what is done to the point, one after the other", any_value, required},
    Key{"output", &PathKeys::output, Unit::one, "which steps the history keeps"},
    Key{"plot", &PathKeys::plot, Unit::one, "what the figure shows; strain and stress of the first segment if not given"},
    Key{"sweep", &PathKeys::sweep, Unit::one,
        "values that keys go through, every combination, as in \"initial.temperature\" = [77, 298]; a path such as "
        "\"material.flow_stress.A\" reaches into the material"}};

// Comparisons and calibrations -------------------------------------------------------------------------------------------

struct ExperimentKeys {
  std::string file, test, author, temperature, strain_rate, pressure, plastic_strain, stress;
  std::vector<std::string> tests;
  OpenTable where;
};
template <>
inline constexpr auto keys<ExperimentKeys> = std::tuple{
    Key{"file", &ExperimentKeys::file, Unit::one, "CSV file of the measured curves, beside this file", any_value, required},
    Key{"test", &ExperimentKeys::test, Unit::one, "column that tells the tests apart", any_value, required},
    Key{"author", &ExperimentKeys::author, Unit::one, "column of who measured; the tests' if not given"},
    Key{"temperature", &ExperimentKeys::temperature, Unit::one, "column of the initial temperature", any_value, required},
    Key{"strain_rate", &ExperimentKeys::strain_rate, Unit::one, "column of the strain rate", any_value, required},
    Key{"pressure", &ExperimentKeys::pressure, Unit::one, "column of the superposed pressure; none if not given"},
    Key{"plastic_strain", &ExperimentKeys::plastic_strain, Unit::one, "column of the plastic strain", any_value, required},
    Key{"stress", &ExperimentKeys::stress, Unit::one, "column of the true stress", any_value, required},
    Key{"tests", &ExperimentKeys::tests, Unit::one, "names of the tests that count; all if not given"},
    Key{"where", &ExperimentKeys::where, Unit::one, "columns and the text that rows must have in them to count"}};

struct ProtocolKeys {
  TestDirection direction = TestDirection::compression;
  double adiabatic_from = Protocol{}.adiabatic_from, smallest_plastic_strain = Protocol{}.smallest_plastic_strain;
};
template <>
inline constexpr auto keys<ProtocolKeys> =
    std::tuple{Key{"direction", &ProtocolKeys::direction, Unit::one, "of the tests"},
               Key{"adiabatic_from", &ProtocolKeys::adiabatic_from, Unit::per_s,
                   "strain rate from which a test keeps its heat; slower ones are isothermal", positive},
               Key{"smallest_plastic_strain", &ProtocolKeys::smallest_plastic_strain, Unit::one,
                   "points below it belong to elastic loading and do not count", non_negative}};

struct ComparisonProtocolKeys : ProtocolKeys {
  double strain_increment = Comparison{}.strain_increment;
  std::vector<double> summary_from = Comparison{}.summary_from;
};
template <>
inline constexpr auto keys<ComparisonProtocolKeys> =
    std::tuple_cat(keys<ProtocolKeys>,
                   std::tuple{Key{"strain_increment", &ComparisonProtocolKeys::strain_increment, Unit::one, "strain of a step",
                                  Interval{.lower = 0.0, .upper = 0.05, .lower_open = true}},
                              Key{"summary_from", &ComparisonProtocolKeys::summary_from, Unit::one,
                                  "the summary is made of the points from each of these plastic strains on", non_negative}});

template <>
inline constexpr auto keys<Model> = std::tuple{
    Key{"name", &Model::name, Unit::one, "what the table and the figure call it", any_value, required},
    Key{"material", &Model::file, Unit::one, "name of a material file, or the material itself", any_value, required}};

struct ComparisonKeys {
  std::string title;
  OpenTables experiments;
  ComparisonProtocolKeys protocol;
  std::vector<Model> models;
};
template <>
inline constexpr auto keys<ComparisonKeys> =
    std::tuple{Key{"title", &ComparisonKeys::title, Unit::one, "heading of the table and the figure", any_value, required},
               Key{"experiment", &ComparisonKeys::experiments, Unit::one, "a file of measured curves", any_value, required},
               Key{"protocol", &ComparisonKeys::protocol, Unit::one, "how the tests were made"},
               Key{"model", &ComparisonKeys::models, Unit::one, "a model to compare with", any_value, required}};

struct ParameterKeys {
  std::string key;
  double lower = 0.0, upper = 0.0;
  std::optional<double> start;
  Scale scale = Scale::linear;
};
template <>
inline constexpr auto keys<ParameterKeys> =
    std::tuple{Key{"key", &ParameterKeys::key, Unit::one, "value of the material file that is sought, such as flow_stress.A",
                   any_value, required},
               Key{"lower", &ParameterKeys::lower, Unit::one, "least value, in SI units", any_value, required},
               Key{"upper", &ParameterKeys::upper, Unit::one, "largest value, in SI units", any_value, required},
               Key{"start", &ParameterKeys::start, Unit::one, "value to start from, in SI units; the material's if not given"},
               Key{"scale", &ParameterKeys::scale, Unit::one, "on which it is searched and its interval given"}};

struct CalibrationKeys {
  std::string title;
  MaterialFile material;
  OpenTables experiments;
  ProtocolKeys protocol;
  Residual residual = Residual::relative;
  int starts = 1;
  std::uint64_t seed = 1;
  OpenTables parameters;
};
template <>
inline constexpr auto keys<CalibrationKeys> =
    std::tuple{Key{"title", &CalibrationKeys::title, Unit::one, "heading of the report and the figure", any_value, required},
               Key{"material", &CalibrationKeys::material, Unit::one,
                   "name of a material file, or the material itself: what is not sought", any_value, required},
               Key{"experiment", &CalibrationKeys::experiments, Unit::one, "a file of measured curves", any_value, required},
               Key{"protocol", &CalibrationKeys::protocol, Unit::one, "how the tests were made"},
               Key{"residual", &CalibrationKeys::residual, Unit::one,
                   "what is made small: differences of stress, or these over the measured stress"},
               Key{"starts", &CalibrationKeys::starts, Unit::one,
                   "searches: the first from `start`, others spread over the bounds", between(1, 10000)},
               Key{"seed", &CalibrationKeys::seed, Unit::one, "of the spread", between(0, 2147483647)},
               Key{"parameter", &CalibrationKeys::parameters, Unit::one, "a parameter that is sought", any_value, required}};

// Reading and describing -------------------------------------------------------------------------------------------------

/// Fills a struct from a table of a file, key by key; problems go to that file.
template <class File>
File read_keys(TableReader& in);

/// All keys of a kind of file.
struct FileKind {
  std::string_view name;  // "path file"
  std::string_view command;
  std::vector<KeyDescription> keys;
};
const std::vector<FileKind>& file_kinds();

class FileReader : public KeyReader<FileReader> {
 private:
  friend KeyReader<FileReader>;
  using KeyReader<FileReader>::read_value;

  template <class K>
  void read_value(TableReader& in, const K& key, OpenTable& value) {
    value = in.table(key.name, key.meaning);
  }
  template <class K>
  void read_value(TableReader& in, const K& key, OpenTables& value) {
    if (in.is_table(key.name))  // one table stands for a list of one
      value = {in.table(key.name)};
    else
      value = in.tables(key.name);
  }
  template <class K, class File>
  requires HasKeys<File>
  void read_value(TableReader& in, const K& key, std::vector<File>& value) {
    for (TableReader& table : in.tables(key.name)) read_keys(table, value.emplace_back());
  }
};

template <class File>
File read_keys(TableReader& in) {
  File file;
  FileReader().read_keys(in, file);
  return file;
}

}  // namespace brisance::driver
