#pragma once
// A loading path: what is done to a point, segment by segment. Every way to drive a point (uniaxial stress, simple shear,
// constant triaxiality, ...) is data in one form: a given velocity gradient, free directions, and conditions on the stress.

#include <optional>
#include <string>
#include <vector>

#include "driver/history.hpp"
#include "driver/mixed_control.hpp"

namespace brisance::driver {

enum class Heat {
  adiabatic,   // temperature follows the heat sources of the material
  isothermal,  // temperature is kept; what heats the point is taken away
  prescribed   // temperature follows temperature_rate
};
enum class OnFailure { stop, keep_going };

/// A free direction of the velocity gradient and the condition that determines it. The target of a condition on the stress
/// goes linearly from the value at the start of the segment to `target` at its end.
struct FreeDirection {
  Tensor<double> direction;
  SymmetricTensor<double> stress_weight;
  SymmetricTensor<double> rate_weight;
  double target = 0.0;
};

/// The segment ends when this column of the history reaches this value.
struct Until {
  std::string column;
  double value = 0.0;
};

struct PathSegment {
  std::string where;                 // where it stands in the input, for messages
  Tensor<double> velocity_gradient;  // 1/s
  std::vector<FreeDirection> free;
  std::optional<Tensor<double>> deformation_gradient;  // F at the end; overrides velocity_gradient
  std::optional<double> duration;                      // s
  std::optional<Until> until;
  std::optional<double> temperature;  // K, set at the start, at constant stress
  double temperature_jump = 0.0;      // K, added at the start
  double temperature_rate = 0.0;      // K/s, with Heat::prescribed
};

struct LoadingPath {
  std::string title;
  // Initial state.
  double temperature = 0.0;  // K
  std::optional<double> density;
  double plastic_strain = 0.0, porosity = 0.0, damage = 0.0;
  std::optional<SymmetricTensor<double>> stress;

  Heat heat = Heat::adiabatic;
  OnFailure on_failure = OnFailure::stop;
  double strain_increment = 2e-4;  // largest |dt L| of a step
  double tolerance = 0.0;          // largest relative difference of a step and its two halves; 0: not looked at
  double cell_size = 0.0;          // m, of the artificial viscosity
  std::vector<PathSegment> segments;
  OutputDensity output;
  // Figure: columns; empty means the choice of the first segment.
  std::string x, y;
};

}  // namespace brisance::driver
