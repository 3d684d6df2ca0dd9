#pragma once
// Measured flow curves as the [experiment] tables of case files name them, and how such tests are computed.

#include <span>
#include <string>
#include <vector>

#include "models/input/table_reader.hpp"

namespace brisance::driver {

/// One measured curve and the conditions of its test.
struct Test {
  std::string name, author;
  double temperature = 0.0;            // K
  double strain_rate = 0.0;            // 1/s
  double pressure = 0.0;               // Pa, superposed
  std::vector<double> plastic_strain;  // measured points, in the order of the file
  std::vector<double> stress;          // Pa, magnitude of the true stress over the superposed pressure
};

/// How a test was made, and which of its points count.
struct Protocol {
  bool compression = true;
  double adiabatic_from = 1.0;             // 1/s; below, a test is isothermal
  double smallest_plastic_strain = 0.002;  // below, a measurement is elastic loading, not flow
};

struct Experiments {
  std::vector<Test> tests;
  std::string files;  // of the measurements, with commas between them
};

/// Reads every [[experiment]] of a case file: a file of measurements beside it, which of its columns is what, and which rows
/// and tests count. All problems go to the case file.
Experiments read_experiments(TableReader& top, std::span<const TableReader> tables);

struct ProtocolKeys;
Protocol protocol_of(const ProtocolKeys& keys);

/// Whether a point of a test is one of flow.
bool counts(const Test& test, std::size_t point, const Protocol& protocol);

/// "298 K, 1000 /s, 300 MPa"; a pressure of zero is left out.
std::string conditions(const Test& test);

/// "uniaxial compression, isothermal below 1 /s, adiabatic from there"
std::string description(const Protocol& protocol);

}  // namespace brisance::driver
