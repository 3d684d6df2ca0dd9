#pragma once
// Flow stress laws with published parameters, one of each kind, for tests that go over all of them.

#include <vector>

#include "models/flow_stress/flow_stress.hpp"

namespace brisance::samples {

struct Sample {
  FlowStress law;
  double shear_modulus, bulk_modulus, melting_temperature, density;
};

inline const flow_stress::JohnsonCook steel_johnson_cook{792e6, 510e6, 0.26, 0.014, 1.03, 1.0, 298.0};

inline const flow_stress::MechanicalThresholdStress hy100_threshold{.athermal_stress = 40e6,
                                                                    .k_over_b3 = 0.905e6,
                                                                    .reference_shear_modulus = 71.46e9,
                                                                    .intrinsic_stress = 1341e6,
                                                                    .intrinsic_barrier = 1.161,
                                                                    .intrinsic_rate = 1e13,
                                                                    .intrinsic_p = 0.5,
                                                                    .intrinsic_q = 1.5,
                                                                    .evolving_barrier = 1.6,
                                                                    .evolving_rate = 1e7,
                                                                    .evolving_p = 2.0 / 3.0,
                                                                    .evolving_q = 1.0,
                                                                    .a0 = 6.0e9,
                                                                    .a1 = 0.0,
                                                                    .a2 = 0.0,
                                                                    .a3 = 2.0758e6,
                                                                    .stage_four_hardening = 200e6,
                                                                    .hardening_form = {},
                                                                    .alpha = 3.0,
                                                                    .saturation_stress = 822e6,
                                                                    .saturation_barrier = 0.112,
                                                                    .saturation_rate = 1e7};

/// Every alternative of the list, in its order.
inline std::vector<Sample> flow_stresses() {
  using namespace flow_stress;
  return {{steel_johnson_cook, 80e9, 164e9, 1793.0, 7830.0},
          {hy100_threshold, 69e9, 150e9, 2000.0, 7860.0},
          {SteinbergCochranGuinan{.initial_yield_stress = 0.12e9,
                                  .beta = 36.0,
                                  .n = 0.45,
                                  .initial_plastic_strain = 0.0,
                                  .largest_yield_stress = 0.64e9,
                                  .reference_shear_modulus = 47.7e9},
           47.7e9, 137e9, 1790.0, 8930.0},
          {SteinbergCochranGuinanLund{.initial_yield_stress = 0.12e9,
                                      .beta = 36.0,
                                      .n = 0.45,
                                      .initial_plastic_strain = 0.0,
                                      .largest_yield_stress = 0.64e9,
                                      .reference_shear_modulus = 47.7e9,
                                      .attempt_rate = 7.1e5,
                                      .drag_coefficient = 1.2e4,
                                      .kink_energy = 0.31 * 1.602176634e-19,
                                      .peierls_stress = 20e6},
           47.7e9, 137e9, 1790.0, 8930.0},
          {ZerilliArmstrong{.athermal_stress = 46.5e6,
                            .hall_petch_slope = 5.0e6,
                            .grain_size = 0.073046,
                            .B = 0.0,
                            .beta0 = 0.0,
                            .beta1 = 0.0,
                            .B0 = 890e6,
                            .alpha0 = 0.0028,
                            .alpha1 = 0.000115,
                            .K = 0.0,
                            .n = 0.5},
           47.7e9, 137e9, 1356.0, 8930.0},
          {PrestonTonksWallace{.theta = 0.025,
                               .p = 2.0,
                               .s0 = 0.0085,
                               .s_inf = 0.00055,
                               .kappa = 0.11,
                               .gamma = 1e-5,
                               .y0 = 0.0001,
                               .y_inf = 0.0001,
                               .y1 = 0.094,
                               .y2 = 0.575,
                               .beta = 0.25,
                               .atomic_mass = 63.546},
           47.7e9, 137e9, 1356.0, 8930.0},
          {LinearHardening{.yield_stress = 400e6, .hardening_modulus = 100e6}, 47.7e9, 137e9, 1e30, 8930.0},
          {Voce{.yield_stress = 200e6, .saturation_increment = 150e6, .saturation_exponent = 8.0}, 26e9, 70e9, 1e30, 2700.0}};
}

}  // namespace brisance::samples
