#pragma once
// What the fills of a case say about a cell: which of them hold how much of it, and in what state.

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
/// A column at a place: linear between the rows, constant beyond them.
double interpolate(const std::vector<double>& place, const std::vector<double>& column, double x);

/// Places in a cell along each direction that are asked what fills them: a cell that a shape cuts is filled in proportion, to
/// about a part in a hundred.
constexpr int places_per_direction(int dimensions) {
  return dimensions == 1 ? 64 : 8;
}

class InitialState {
 public:
  /// Throws std::runtime_error when a fill with an energy holds none of the box.
  InitialState(const GasConfig& config, const std::vector<Fluid>& fluids, const Cells& cells);

  /// What a cell of the box holds, by the position of its middle. A cell in one state is one portion of part 1.
  std::vector<Portion> in_cell(const Vector& middle) const;

 private:
  struct Fill {
    const FillConfig* config;
    Filling filling;  // where it has no profile
    StateProfile profile;
    Vector lower, upper;  // it lies within them
    const EquationOfState* law = nullptr;

    Filling at(const Vector& x, int dimensions) const;
  };
  /// Calls f(number of the fill, place, volume) for the places in a cell that is not of one fill alone; returns the number of
  /// that fill if it is.
  template <class F>
  int visit(const Vector& middle, F&& f) const;
  double volume_of(std::size_t fill) const;

  std::vector<Fill> fills_;
  const Cells* cells_;
};

/// Which of the fluids has a name.
int number_of(const GasConfig& config, const std::string& fluid);
/// A state as the case gives it; `fluids` are those of the gas.
Filling filling_of(const GasConfig& config, const std::vector<Fluid>& fluids, const GasStateConfig& state);

}  // namespace brisance::simulator::gas
