// Bars far from the speeds and temperatures of the gallery: molten at rest, and so fast that the rim flies off in particles
// that melt and part from the others. They run to their end with closed books.

#include <gtest/gtest.h>

#include "tests/simulator/running.hpp"
#include "tests/simulator/small_bar.hpp"

namespace brisance::simulator {
namespace {

TEST(MoltenBar, AtRestStaysAtRest) {
  for (const char* metal : {"steel_4340.toml", "copper_ofhc_johnson_cook.toml", "copper_ofhc_mts.toml", "tungsten.toml"}) {
    SCOPED_TRACE(metal);
    Simulation s = set_up(shipped_case("taylor_4340_208_johnson_cook",
                                       {"cell_size=1.27 mm", "solid.0.velocity=[0,0]", "solid.0.temperature=4000 K",
                                        std::string("solid.0.material=../materials/") + metal}));
    run_until(s, 1e-6);  // what round-off has left of the pressure moves it in the first steps
    const Particles& ps = s.bodies[0].particles;
    std::vector<double> temperature, density, plastic_strain;
    for (int p = 0; p < ps.size; ++p) {
      ASSERT_EQ(ps.rest.at(Columns::Rest::shear_modulus, p), 0.0) << "it is molten";
      EXPECT_EQ(ps.rest.at(Columns::Rest::plastic_strain, p), 0.0);
      EXPECT_EQ(ps.rest.at(Columns::Rest::plastic_work, p), 0.0);
      constexpr double warmth = 1e-9;  // K: the pressure of round-off, 1e-4 Pa, over density and specific heat
      EXPECT_NEAR(ps.rest.at(Columns::Rest::temperature, p), 4000.0, warmth);
      for (int a = 0; a < 2; ++a) {
        constexpr double at_rest = 1e-9;  // m/s: the pressure of round-off, 1e-4 Pa, over density and cell size for 1 us
        EXPECT_LT(std::abs(ps.motion.at(2 + a, p)), at_rest);
      }
    }
  }
}

struct Fast : testing::TestWithParam<std::tuple<std::string, double>> {};

std::string name_of_bar(const testing::TestParamInfo<Fast::ParamType>& info) {
  const auto& [bar, speed] = info.param;
  return bar + "_at_" + std::to_string(static_cast<int>(speed)) + "_m_per_s";
}

/// Runs a bar to its end and returns what the numerical books hold, in parts of the kinetic energy at the start.
double numerical_part(const std::string& name, double speed, const std::string& cell_size) {
  Simulation s = set_up(shipped_case(name, {"cell_size=" + cell_size, "solid.0.velocity=[0,-" + std::to_string(speed) + "]"}));
  const double energy = s.ledger.initial.energy;
  run_until(s, 40e-6);
  expect_closed_books(s);
  EXPECT_LT(s.ledger.state.energy, energy);
  const Particles& ps = s.bodies[0].particles;
  double fastest = 0.0;
  for (int p = 0; p < ps.size; ++p) {
    for (const Column& c : ps.columns()) EXPECT_TRUE(std::isfinite(ps.set(c.set).at(c.index, p))) << c.name;
    fastest = std::max({fastest, std::abs(ps.motion.at(2, p)), std::abs(ps.motion.at(3, p))});
    EXPECT_GT(ps.motion.at(1, p), 0.0) << "no particle goes through the wall";
  }
  // A steady jet leaves at the speed at which it came; the first contact squirts faster.
  EXPECT_GT(fastest, 0.1 * speed);
  EXPECT_LT(fastest, 4.0 * speed);
  return balance(s.ledger, internal_energy(s)).numerical() / energy;
}

TEST_P(Fast, BarRunsToItsEndOnAWall) {
  const auto [name, speed] = GetParam();
  const double coarse = numerical_part(name, speed, "1.27 mm"), fine = numerical_part(name, speed, "0.635 mm");
  std::printf("%s at %.0f m/s: numerical books %.2f %% of the kinetic energy on three cells in the radius, %.2f %% on six\n",
              name.c_str(), speed, 100.0 * coarse, 100.0 * fine);
  // The metal leaves in a sheet along the wall that is thinner than a cell. The node inside then carries the normal motion of
  // all of it with a mass that is too large by the cell over the thickness, and what the sheet keeps of it too long becomes
  // energy. Of second order from three to six cells: a quarter is left, and half as much more is allowed for.
  constexpr double thin_sheet = 0.09, on_six_cells = 0.03, unresolved = 0.01;
  EXPECT_LT(std::abs(coarse), thin_sheet);
  EXPECT_LT(std::abs(fine), std::min(on_six_cells, 1.5 * 0.25 * std::max(std::abs(coarse), unresolved)));
}

INSTANTIATE_TEST_SUITE_P(Metals, Fast,
                         testing::Combine(testing::Values("taylor_copper_190_mts", "taylor_4340_208_johnson_cook"),
                                          testing::Values(500.0, 1000.0, 2000.0)),
                         name_of_bar);

}  // namespace
}  // namespace brisance::simulator
