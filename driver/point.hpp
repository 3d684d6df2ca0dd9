#pragma once
// One material point under the library's own update: the same code that a simulation runs, on a batch of size one.

#include <string>

#include "models/batch.hpp"
#include "models/material.hpp"

namespace brisance::driver {

/// The update of one point as a pure function: the old state is not changed, calling twice gives the same answer twice.
class PointUpdate {
 public:
  /// cell_size (m) drives the artificial viscosity; 0 switches it off.
  explicit PointUpdate(const Material& material, double cell_size = 0.0);

  /// The point a time dt (s) after `before`, deformed along the velocity gradient L (1/s). `time` (s) is that of the end of
  /// the step. Trouble is reported in the result, which is valid until the next call.
  const Point<double>& operator()(const State<double>& before, const Tensor<double>& L, double dt, double time);

  const Material& material() const { return *material_; }
  long calls() const { return calls_; }

 private:
  const Material* material_;
  Batch<double> batch_;
  double cell_size_;
  long calls_ = 0;
};

/// The Trouble of a point after an update.
Trouble trouble_of(const Point<double>& point);

/// The words of a FailureCause.
std::string_view describe(FailureCause cause);

/// The state of a point in one line, for messages.
std::string facts(const State<double>& state, double time);

}  // namespace brisance::driver
