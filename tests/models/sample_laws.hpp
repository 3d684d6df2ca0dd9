#pragma once
// Flow stress laws with published parameters, one of each kind, for tests that go over all of them.

#include <vector>

#include "tests/models/flow_stress_sets.hpp"

namespace brisance::samples {

struct Sample {
  FlowStress law;
  double shear_modulus, bulk_modulus, melting_temperature, density;
};

/// Every alternative of the list, in its order.
inline std::vector<Sample> flow_stresses() {
  using namespace flow_stress;
  return {{sets::steel_4340, 80e9, 164e9, 1793.0, 7830.0},
          {sets::threshold_hy100, 69e9, 150e9, 2000.0, 7860.0},
          {sets::steinberg_copper, 47.7e9, 137e9, 1790.0, 8930.0},
          {sets::lund_copper, 47.7e9, 137e9, 1790.0, 8930.0},
          {sets::zerilli_copper, 47.7e9, 137e9, 1356.0, 8930.0},
          {sets::preston_copper, 47.7e9, 137e9, 1356.0, 8930.0},
          {LinearHardening{.yield_stress = 400e6, .hardening_modulus = 100e6}, 47.7e9, 137e9, 1e30, 8930.0},
          {Voce{.yield_stress = 200e6, .saturation_increment = 150e6, .saturation_exponent = 8.0}, 26e9, 70e9, 1e30, 2700.0}};
}

}  // namespace brisance::samples
