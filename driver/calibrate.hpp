#pragma once
// `pointdriver calibrate`: parameters of a material from measured flow curves, by bounded least squares, with what the
// measurements leave uncertain.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "driver/experiment.hpp"
#include "models/input/material_reader.hpp"

namespace brisance::driver {

/// A parameter to be found, named as in the material file: "flow_stress.A".
struct FitParameter {
  std::string key;
  double lower = 0.0, upper = 0.0, start = 0.0;
  bool logarithmic = false;  // searched, and its interval given, on a logarithmic scale
};

/// What is made small: differences of stress, or these over the measured stress.
enum class Residual { absolute, relative };

struct Calibration {
  std::string title;
  MaterialFile file;  // everything that is not fitted
  std::vector<FitParameter> parameters;
  std::vector<Test> tests;
  std::string data;  // the files of the tests, for the record of sources
  Protocol protocol;
  Residual residual = Residual::relative;
  int starts = 1;          // the first from FitParameter::start, the rest spread over the bounds
  std::uint64_t seed = 1;  // of the spread
};

/// Reads a calibration file. Throws InputError.
Calibration read_calibration(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The value in the material that a key such as "flow_stress.A" names; nullptr if there is none. `interval` receives the values
/// that it may take, `unit` its unit.
double* find_parameter(Material& material, std::string_view key, Interval* interval = nullptr, Unit* unit = nullptr);

/// Stress (Pa, magnitude over the superposed pressure) at increasing plastic strains in a test of uniaxial stress. A
/// homogeneous specimen on its yield surface: the same laws as the update, in one dimension and without its elastic part, so
/// that the plastic strain rate is the rate of the test (the elastic part of it is one or two percent, and stress depends on
/// its logarithm). Isothermal or adiabatic as the protocol says. Some hundred times faster than following the path of the test.
std::vector<double> flow_curve(const Material& material, const Test& test, const Protocol& protocol,
                               std::span<const double> plastic_strain);

/// A parameter that was found.
struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;  // infinite where the measurements do not determine it
  double lower_95 = 0.0, upper_95 = 0.0;
  bool at_bound = false;  // kept there and not counted as uncertain
  bool identifiable = true;
};

struct FitOfTest {
  int points = 0;
  double rms = 0.0;  // Pa
  double relative_rms = 0.0, mean_relative = 0.0;
  std::vector<double> plastic_strain, stress;  // computed at the measured points that count
};

struct Fit {
  MaterialFile file;  // with the parameters found, and where they come from
  std::vector<Estimate> estimates;
  std::vector<std::vector<double>> correlation;
  double residual_deviation = 0.0;  // of one point: Pa, or a fraction for relative residuals
  int points = 0, degrees_of_freedom = 0;
  int evaluations = 0;  // of all flow curves
  bool converged = false;
  std::vector<FitOfTest> tests;
  std::vector<std::string> warnings;
};

/// Finds the parameters. Throws std::invalid_argument if there are fewer points than parameters, or the material has no flow
/// stress.
Fit calibrate(const Calibration& calibration);

struct CalibrateOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::filesystem::path output;                // material file; empty: none
  std::vector<std::filesystem::path> figures;  // .png, .svg
};

/// Prints the report and writes what was asked for; returns the exit code.
int run_calibration(const CalibrateOptions& options);

}  // namespace brisance::driver
