#pragma once
// What the fills of a case say about a cell: which of them hold how much of it, and in what state.

#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// The columns of a profile; those that the file does not have are empty.
struct StateProfile {
  std::vector<double> place;  // m, rising; two alike make a jump
  std::vector<double> density, pressure, velocity_along, velocity_around;
};
/// Throws InputError if the file cannot be read, has other columns, or says something impossible.
StateProfile read_state_profile(const ProfileConfig& config);

/// Places in a cell along each direction that are asked what fills them: a cell that a shape cuts is filled in proportion, to
/// about a part in a hundred.
constexpr int places_per_direction(int dimensions) {
  return dimensions == 1 ? 64 : 8;
}

/// Whether formulas say of it what it is.
bool varies(const GasStateConfig& state);

/// The part of a cell of the box that bodies leave to the gas; none: all.
using OpenParts = std::function<double(const std::array<int, 3>& cell)>;

/// What a fill holds of the box: mass and volume per whole cell, radian or steradian (see Metric), and its state, which varies
/// with a profile or formulas.
struct FillContent {
  struct Range {
    double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  };
  double mass = 0.0, volume = 0.0;                            // kg, m^3
  Range density, pressure, temperature, energy, sound_speed;  // kg/m^3, Pa, K, J/kg, m/s
};

class InitialState {
 public:
  /// Throws std::runtime_error when a fill with an energy holds none of the box.
  InitialState(const GasConfig& config, const std::vector<Fluid>& fluids, const Cells& cells, const OpenParts& open = {});

  /// What a cell of the box holds, by the position of its middle. A cell in one state is one portion of part 1.
  std::vector<Portion> in_cell(const Vector& middle) const;
  /// What the fill of this number holds, where later ones do not lie over it.
  FillContent content_of(std::size_t fill, const OpenParts& open = {}) const;

 private:
  struct Fill {
    const FillConfig* config;
    Filling filling;  // where it has no profile
    StateProfile profile;
    Vector lower, upper;  // it lies within them
    const Fluid* fluid = nullptr;

    bool is_uniform() const { return !config->profile && !varies(*config); }
    Filling at(const Vector& x, int dimensions) const;
  };
  /// Calls f(number of the fill, place, volume) for the places in a cell that is not of one fill alone; returns the number of
  /// that fill if it is.
  template <class F>
  int visit(const Vector& middle, F&& f) const;
  /// Calls f(place, volume) for what a fill holds of each cell of the box: once if its state is the same everywhere.
  template <class F>
  void visit_fill(std::size_t fill, const OpenParts& open, F&& f) const;
  double volume_of(std::size_t fill, const OpenParts& open) const;

  std::vector<Fill> fills_;
  const Cells* cells_;
};

/// Which of the fluids has a name.
int number_of(const GasConfig& config, const std::string& fluid);
/// A state as the case gives it, without what formulas say; `fluids` are those of the gas.
Filling filling_of(const GasConfig& config, const std::vector<Fluid>& fluids, const GasStateConfig& state);

/// Why a fluid has no state with a pressure (Pa) and a density (kg/m^3) or, where that is not given, a temperature (K); empty:
/// it has.
std::string why_no_state(const std::string& fluid, const EquationOfState& law, double pressure, std::optional<double> density,
                         std::optional<double> temperature);
/// A formula has come to what no gas can be; the message says where, when and what is allowed.
struct FormulaError : std::runtime_error {
  FormulaError(std::string at_key, const std::string& what) : std::runtime_error(what), key(std::move(at_key)) {}
  std::string key;
};
/// What the values of a state are at a place and a time (s). Calls refuse(key, what) for each formula that comes to what no gas
/// can have; `pressure_alone`: that of an edge beyond which nothing else counts.
using Refusal = std::function<void(const std::string& key, const std::string& what)>;
Filling values_at(const GasStateConfig& state, bool pressure_alone, const Vector& position, double time, int dimensions,
                  const Refusal& refuse);
/// The state at a place and a time (s), of the fluid with this number; `fluid` is null where only a pressure counts. Throws
/// FormulaError.
Filling state_at(const GasStateConfig& state, int number, const Fluid* fluid, const Vector& position, double time,
                 int dimensions);
/// What lies beyond an open side. What it gives throws StepFailure where a formula fails, with the name of the side.
FillingFunction state_beyond(const GasConfig& config, const std::vector<Fluid>& fluids, const EdgeConfig& edge, int dimensions);

}  // namespace brisance::simulator::gas
