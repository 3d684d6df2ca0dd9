// What gauges have seen, back from history.csv.

#include "simulator/output/gauge_history.hpp"

#include <gtest/gtest.h>

#include "tests/command_line.hpp"

namespace brisance::simulator {
namespace {

GaugeConfig gauge(const std::string& name, const std::vector<std::string>& fields) {
  GaugeConfig config;
  config.name = name, config.fields = fields;
  return config;
}

TEST(GaugeHistory, FindsTheColumnsOfEveryGaugeAndTheirPeaks) {
  const fs::path directory = scratch();
  write_text(
      directory / "history.csv",
      "time [s],energy [J],gauge_wall_pressure [Pa],gauge_wall_plastic_strain [1],gauge_wall_plastic_strain_rate [1/s],"
      "gauge_wall_2_velocity_x [m/s],gauge_wall_2_velocity_y [m/s],gauge_ray_pressure_00 [Pa],gauge_ray_pressure_01 [Pa]\n"
      "0,9,1,0,0,0,0,nan,nan\n"
      "1,9,5,0.1,7,-3,1,2,nan\n"
      "2,9,-4,0.2,3,2,2,8,nan\n");
  Case c;
  c.gauges = {gauge("wall", {"pressure", "plastic_strain"}), gauge("wall_2", {"velocity"}), gauge("ray", {"pressure"})};
  const std::vector<GaugeSeries> all = read_gauges(c, directory);
  ASSERT_EQ(all.size(), 6u);  // the rate was not asked for
  EXPECT_EQ(all[0].gauge, "wall");
  EXPECT_EQ(all[0].unit, "Pa");
  EXPECT_EQ(all[2].gauge, "wall_2");
  EXPECT_EQ(all[2].field, "velocity_x");
  EXPECT_EQ(all[4].gauge, "ray");
  EXPECT_EQ(all[4].place, 0u);
  EXPECT_EQ(all[5].place, 1u);
  EXPECT_FALSE(all[0].place);
  EXPECT_EQ(all[4].time, (std::vector<double>{1.0, 2.0})) << "rows without material are left out";
  const std::vector<GaugePeak> peaks = peaks_of(all);
  ASSERT_EQ(peaks.size(), 5u) << "where there never was material there is no peak";
  EXPECT_EQ(peaks[0].name, "wall_pressure");
  EXPECT_EQ(peaks[0].value, 5.0);
  EXPECT_EQ(peaks[0].time, 1.0);
  EXPECT_EQ(peaks[2].name, "wall_2_velocity_x");
  EXPECT_EQ(peaks[2].value, -3.0) << "of largest magnitude, with its sign";
  EXPECT_EQ(peaks[4].value, 8.0);
  EXPECT_EQ(peaks[4].time, 2.0);
}

TEST(GaugeHistory, IsNotReadWithoutGauges) {
  EXPECT_TRUE(read_gauges(Case{}, scratch()).empty());
}

}  // namespace
}  // namespace brisance::simulator
