#pragma once

namespace brisance::simulator::gas {

/// A gas at a point of a line, in primitive variables: kg/m^3, m/s along the line, Pa.
struct GasState {
  double density, velocity, pressure;
};

}  // namespace brisance::simulator::gas
