#pragma once
// `pointdriver compare`: measured stress-strain curves against material models, test by test.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "models/input/material_reader.hpp"

namespace brisance::driver {

/// One measured curve and the conditions of its test.
struct Test {
  std::string name, author;
  double temperature = 0.0;                  // K
  double strain_rate = 0.0;                  // 1/s
  double pressure = 0.0;                     // Pa, superposed
  std::vector<double> plastic_strain;        // measured points, in the order of the file
  std::vector<double> stress;                // Pa, magnitude of the true stress over the superposed pressure
};

/// A model that the tests are compared with.
struct Model {
  std::string name;
  MaterialFile file;
};

/// How the tests are computed and which points count.
struct Protocol {
  bool compression = true;
  double adiabatic_from = 1.0;            // 1/s; below, a test is isothermal
  double smallest_plastic_strain = 0.002; // below, a measurement is elastic loading, not flow
  double strain_increment = 2e-4;
};

struct Comparison {
  std::string title;
  std::vector<Test> tests;
  std::vector<Model> models;
  Protocol protocol;
  std::vector<std::string> panels;  // names of the tests that the figure shows; empty: chosen evenly
};

/// Reads a comparison file. Throws InputError.
Comparison read_comparison(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// One model on one test.
struct TestResult {
  std::vector<double> plastic_strain, stress;  // the computed curve
  int points = 0;                              // that count
  double rms = 0.0;                            // Pa, of computed - measured
  double relative_rms = 0.0;                   // of (computed - measured)/measured
  double mean_relative = 0.0;                  // its mean: positive where the model is too strong
  std::string note;                            // why a test has no result, or how it ended
};

/// results[model][test]
using Results = std::vector<std::vector<TestResult>>;
Results compare(const Comparison& comparison);

/// Errors over all tests of one model.
struct Overall {
  int tests = 0, points = 0;
  double of_points = 0.0;       // RMS of the relative error over all points
  double of_tests = 0.0;        // RMS over the tests of each test's relative RMS
  double median_of_tests = 0.0;
  double mean = 0.0;            // mean over the points of the relative error
  double rms = 0.0;             // Pa, over all points
  int within_10_percent = 0;    // tests
};
Overall overall(const std::vector<TestResult>& results);

struct CompareOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::filesystem::path output;                // directory of results.csv; empty: none
  std::vector<std::filesystem::path> figures;  // .png, .svg
};

/// Prints the table and writes what was asked for; returns the exit code.
int run_comparison(const CompareOptions& options);

}  // namespace brisance::driver
