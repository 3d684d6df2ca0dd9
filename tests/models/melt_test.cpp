// A metal above its melting temperature: it bears pressure and nothing else, step after step.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "models/update.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance {
namespace {

TEST(Melt, BearsNoDeviatorHoweverItIsCompressed) {
  const Material m = samples::copper_johnson_cook();
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
