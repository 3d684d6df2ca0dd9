// A metal above its melting temperature: it bears pressure and nothing else, step after step.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "models/update.hpp"

namespace brisance {
namespace {

Material copper() {
  Material m;
  m.name = "copper", m.density = 8930.0;
  m.equation_of_state = equation_of_state::MieGruneisenTemperature{.reference_density = 8930.0,
                                                                   .sound_speed = 3940.0,
                                                                   .slope = 1.489,
                                                                   .gruneisen = 2.02,
                                                                   .specific_heat = 383.0,
                                                                   .reference_temperature = 298.0};
  m.flow_stress = flow_stress::JohnsonCook{
      .A = 90e6, .B = 292e6, .n = 0.31, .C = 0.025, .m = 1.09, .reference_strain_rate = 1.0, .reference_temperature = 298.0};
  m.shear_modulus = shear_modulus::Constant{.value = 46e9};
  m.melting = melting::Constant{.value = 1356.0};
  m.specific_heat = specific_heat::Constant{.value = 383.0};
  m.yield = yield::VonMises{};
  Table chi;
  chi.size = 1, chi.y[0] = 0.9;
  m.heating = Heating{.taylor_quinney = chi, .viscous = true, .thermoelastic = false};
  return m;
}

TEST(Melt, BearsNoDeviatorHoweverItIsCompressed) {
  const Material m = copper();
  const auto batch = std::make_unique<Batch<double>>();
  batch->size = 1;
  Point<double>& p = batch->points[0];
  p.state = initial_state(m, 2000.0);
  constexpr double dt = 1e-8, round_off = 1e-15;
  for (int step = 0; step < 20; ++step) {
    p.velocity_gradient.xx = step % 2 ? 1e5 : 3e5, p.velocity_gradient.yy = -1e6, p.velocity_gradient.xy = 2e5;
    update(m, *batch, dt);
    ASSERT_EQ(p.trouble, 0.0);
    ASSERT_EQ(p.state.plastic_strain, 0.0) << "step " << step;
    ASSERT_LT(p.state.temperature, 3000.0);
    const double pressure = -trace(p.state.stress) / 3.0;
    ASSERT_NEAR(p.state.stress.xx, -pressure, round_off * pressure);
    ASSERT_EQ(p.state.stress.xy, 0.0);
  }
  EXPECT_GT(-trace(p.state.stress) / 3.0, 10e9);
}

}  // namespace
}  // namespace brisance
