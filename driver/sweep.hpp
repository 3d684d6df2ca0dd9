#pragma once
// Sweeps: a path followed for every combination of values of some of its keys.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/history.hpp"

namespace brisance::driver {

/// A value that a key of a path file takes in a sweep.
struct SweptValue {
  std::string key;               // as an override names it: "segment.0.strain_rate"
  std::string text;              // as written in the file
  std::optional<double> number;  // in the SI unit; none for a word
  std::string unit;              // the SI unit, if the key has one that is known

  std::string name() const;    // "strain_rate = -1000 1/s"
  std::string column() const;  // "segment.0.strain_rate [1/s]"
};
using SweptValues = std::vector<SweptValue>;

/// The members of the [sweep] of a path file, the last key running fastest; none without a sweep. Throws InputError.
std::vector<SweptValues> read_sweep(const std::filesystem::path& file);

/// The numbers and units of values that a path file takes, for what is a quantity of its material.
void find_units(SweptValues& values, const Material& material);

/// "strain_rate = -1000 1/s, temperature = 298 K"
std::string name_of(const SweptValues& values);

/// A member that was followed.
struct SweepMember {
  SweptValues values;
  Record record;
};

/// What `-o` of a sweep may name: .csv, all histories in one table, the values first; .h5 or .hdf5, one group for each member;
/// or, without ending, a directory with a table for each member and sweep.csv, the states they ended in.
/// Throws std::invalid_argument for anything else.
void require_sweep_output(const std::filesystem::path& path);
void write_sweep(std::span<const SweepMember> members, const std::filesystem::path& path);

}  // namespace brisance::driver
