#pragma once
// `pointdriver compare`: measured stress-strain curves against material models, test by test.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "driver/experiment.hpp"
#include "models/input/material_reader.hpp"

namespace brisance::driver {

/// A model that the tests are compared with.
struct Model {
  std::string name;
  MaterialFile file;
};

struct Comparison {
  std::string title;
  std::vector<Test> tests;
  std::vector<Model> models;
  Protocol protocol;
  double strain_increment = 2e-4;
  std::vector<double> summary_from{0.002};  // the summary is made of the points from each of these plastic strains on
};

/// Reads a comparison file. Throws InputError.
Comparison read_comparison(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// A measured point that counts, and what a model gives at its plastic strain.
struct ComparedPoint {
  double plastic_strain, measured, computed;  // -, Pa, Pa
};

/// One model on one test.
struct TestResult {
  std::vector<double> plastic_strain, stress;  // the computed curve
  std::vector<ComparedPoint> points;
  std::string note;  // why a test has no result, or which failure criterion fired
};

/// results[model][test]
using Results = std::vector<std::vector<TestResult>>;
Results compare(const Comparison& comparison);

/// Errors over a set of points. Relative errors are those of each point, (computed - measured)/measured; the normalised RMS is
/// rms over the mean of the measured stress, which a few weak points at the foot of a curve do not rule.
struct Errors {
  int points = 0;
  double rms = 0.0;  // Pa
  double normalised_rms = 0.0;
  double relative_rms = 0.0;
  double relative_mean = 0.0;  // positive where the model is too strong
};
Errors errors_of(const std::vector<ComparedPoint>& points);

/// Errors over tests that a group has in common, from a plastic strain on.
struct GroupErrors {
  int tests = 0;
  Errors all_points;
  double rms_of_tests = 0.0;  // of each test's normalised RMS
  double median_of_tests = 0.0;
  int within_10_percent = 0;  // tests
};
GroupErrors errors_of_group(const std::vector<Test>& tests, const std::vector<TestResult>& results,
                            const std::function<bool(const Test&)>& belongs, double smallest_plastic_strain);

struct CompareOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::filesystem::path output;                // NAME.csv of the tests; NAME_points.csv goes beside it. Empty: none
  std::vector<std::filesystem::path> figures;  // .png, .svg
};

/// Prints the table and writes what was asked for; returns the exit code.
int run_comparison(const CompareOptions& options);

}  // namespace brisance::driver
