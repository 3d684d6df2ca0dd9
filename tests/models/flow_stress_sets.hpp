#pragma once
// Published parameter sets of flow stresses, for all tests. Values as in data/materials, SI.

#include "models/flow_stress/flow_stress.hpp"

namespace brisance::flow_stress::sets {

inline constexpr double electron_volt = 1.602176634e-19;  // J

inline const JohnsonCook steel_4340{
    .A = 792e6, .B = 510e6, .n = 0.26, .C = 0.014, .m = 1.03, .reference_strain_rate = 1.0, .reference_temperature = 298.0};

inline const JohnsonCook johnson_cook_copper{
    .A = 90e6, .B = 292e6, .n = 0.31, .C = 0.025, .m = 1.09, .reference_strain_rate = 1.0, .reference_temperature = 298.0};

inline const MechanicalThresholdStress threshold_hy100{.athermal_stress = 40e6,
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
                                                       .a0 = 6e9,
                                                       .a1 = 0.0,
                                                       .a2 = 0.0,
                                                       .a3 = 2.0758e6,
                                                       .stage_four_hardening = 200e6,
                                                       .hardening_form = HardeningForm::tanh,
                                                       .alpha = 3.0,
                                                       .saturation_stress = 822e6,
                                                       .saturation_barrier = 0.112,
                                                       .saturation_rate = 1e7};

inline const MechanicalThresholdStress threshold_copper{.athermal_stress = 40e6,
                                                        .k_over_b3 = 0.823e6,
                                                        .reference_shear_modulus = 47.7e9,
                                                        .intrinsic_stress = 0.0,
                                                        .intrinsic_barrier = 0.0,
                                                        .intrinsic_rate = 0.0,
                                                        .intrinsic_p = 0.0,
                                                        .intrinsic_q = 0.0,
                                                        .evolving_barrier = 1.6,
                                                        .evolving_rate = 1e7,
                                                        .evolving_p = 2.0 / 3.0,
                                                        .evolving_q = 1.0,
                                                        .a0 = 2390e6,
                                                        .a1 = 12e6,
                                                        .a2 = 1.696e6,
                                                        .a3 = 0.0,
                                                        .stage_four_hardening = 0.0,
                                                        .hardening_form = HardeningForm::tanh,
                                                        .alpha = 2.0,
                                                        .saturation_stress = 770e6,
                                                        .saturation_barrier = 0.2625,
                                                        .saturation_rate = 1e7};

inline const MechanicalThresholdStress threshold_al6061{.athermal_stress = 363.7e6,
                                                        .k_over_b3 = 0.823e6,
                                                        .reference_shear_modulus = 28e9,
                                                        .intrinsic_stress = 0.0,
                                                        .intrinsic_barrier = 0.0,
                                                        .intrinsic_rate = 0.0,
                                                        .intrinsic_p = 0.0,
                                                        .intrinsic_q = 0.0,
                                                        .evolving_barrier = 0.71,
                                                        .evolving_rate = 2.79e9,
                                                        .evolving_p = 1.0,
                                                        .evolving_q = 2.0,
                                                        .a0 = 211.8e6,
                                                        .a1 = 0.0,
                                                        .a2 = 0.0,
                                                        .a3 = 0.0,
                                                        .stage_four_hardening = 0.0,
                                                        .hardening_form = HardeningForm::tanh,
                                                        .alpha = 2.0,
                                                        .saturation_stress = 1679.3e6,
                                                        .saturation_barrier = 0.15,
                                                        .saturation_rate = 3.42e8};

inline const SteinbergCochranGuinan steinberg_al6061{.initial_yield_stress = 0.29e9,
                                                     .beta = 125.0,
                                                     .n = 0.10,
                                                     .initial_plastic_strain = 0.0,
                                                     .largest_yield_stress = 0.68e9,
                                                     .reference_shear_modulus = 27.6e9};

inline const SteinbergCochranGuinan steinberg_copper{.initial_yield_stress = 0.12e9,
                                                     .beta = 36.0,
                                                     .n = 0.45,
                                                     .initial_plastic_strain = 0.0,
                                                     .largest_yield_stress = 0.64e9,
                                                     .reference_shear_modulus = 47.7e9};

inline const SteinbergCochranGuinanLund lund_4340{.initial_yield_stress = 1.15e9,
                                                  .beta = 2.0,
                                                  .n = 0.5,
                                                  .initial_plastic_strain = 0.0,
                                                  .largest_yield_stress = 2.5e9,
                                                  .reference_shear_modulus = 81.8e9,
                                                  .attempt_rate = 3.1e6,
                                                  .drag_coefficient = 2.4e4,
                                                  .kink_energy = 0.31 * electron_volt,
                                                  .peierls_stress = 7e8};

inline const SteinbergCochranGuinanLund lund_copper{.initial_yield_stress = 0.12e9,
                                                    .beta = 36.0,
                                                    .n = 0.45,
                                                    .initial_plastic_strain = 0.0,
                                                    .largest_yield_stress = 0.64e9,
                                                    .reference_shear_modulus = 47.7e9,
                                                    .attempt_rate = 7.1e5,
                                                    .drag_coefficient = 1.2e4,
                                                    .kink_energy = 0.31 * electron_volt,
                                                    .peierls_stress = 20e6};

inline const ZerilliArmstrong zerilli_copper{.athermal_stress = 46.5e6,
                                             .hall_petch_slope = 1.58e5,
                                             .grain_size = 7.3e-5,
                                             .B = 0.0,
                                             .beta0 = 0.0,
                                             .beta1 = 0.0,
                                             .B0 = 890e6,
                                             .alpha0 = 0.0028,
                                             .alpha1 = 0.000115,
                                             .K = 0.0,
                                             .n = 0.5};

inline const ZerilliArmstrong zerilli_iron{.athermal_stress = 0.0,
                                           .hall_petch_slope = 0.0,
                                           .grain_size = 1.0,
                                           .B = 1033e6,
                                           .beta0 = 0.00698,
                                           .beta1 = 0.000415,
                                           .B0 = 0.0,
                                           .alpha0 = 0.0,
                                           .alpha1 = 0.0,
                                           .K = 266e6,
                                           .n = 0.289};

inline const PrestonTonksWallace preston_copper{.theta = 0.025,
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
                                                .atomic_mass = 63.546};

inline const PrestonTonksWallace preston_tantalum{.theta = 0.02,
                                                  .p = 0.0,
                                                  .s0 = 0.012,
                                                  .s_inf = 0.00325,
                                                  .kappa = 0.6,
                                                  .gamma = 4e-5,
                                                  .y0 = 0.01,
                                                  .y_inf = 0.00125,
                                                  .y1 = 0.012,
                                                  .y2 = 0.4,
                                                  .beta = 0.23,
                                                  .atomic_mass = 180.948};

inline const LinearHardening linear{.yield_stress = 300e6, .hardening_modulus = 1e9};
inline const Voce voce{.yield_stress = 90e6, .saturation_increment = 250e6, .saturation_exponent = 8.0};

inline MechanicalThresholdStress with_voce_hardening(MechanicalThresholdStress law) {
  law.hardening_form = HardeningForm::voce;
  law.stage_four_hardening = 0.0;
  return law;
}

inline MechanicalThresholdStress with_voce_exponent(double kappa, MechanicalThresholdStress law) {
  law = with_voce_hardening(law);
  law.voce_exponent = kappa;
  return law;
}

/// Calls f(law, name) for every flow stress in the list, some of them with more than one metal.
template <class F>
void for_each(F&& f) {
  f(steel_4340, "Johnson-Cook, 4340");
  f(johnson_cook_copper, "Johnson-Cook, copper");
  f(threshold_hy100, "mechanical threshold stress, HY-100");
  f(threshold_copper, "mechanical threshold stress, copper");
  f(threshold_al6061, "mechanical threshold stress, 6061-T6");
  f(with_voce_hardening(threshold_copper), "mechanical threshold stress, Voce hardening");
  f(with_voce_exponent(2.5, threshold_copper), "mechanical threshold stress, Voce hardening with exponent 2.5");
  f(steinberg_al6061, "Steinberg-Cochran-Guinan, 6061-T6");
  f(steinberg_copper, "Steinberg-Cochran-Guinan, copper");
  f(lund_4340, "Steinberg-Cochran-Guinan-Lund, 4340");
  f(lund_copper, "Steinberg-Cochran-Guinan-Lund, copper");
  f(zerilli_copper, "Zerilli-Armstrong, copper");
  f(zerilli_iron, "Zerilli-Armstrong, iron");
  f(preston_copper, "Preston-Tonks-Wallace, copper");
  f(preston_tantalum, "Preston-Tonks-Wallace, tantalum");
  f(linear, "linear hardening");
  f(voce, "Voce");
}

}  // namespace brisance::flow_stress::sets
