// 6061-T6 against the 95 measured curves of data/experiments, through the same comparison that `pointdriver compare` makes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/compare.hpp"
#include "gallery.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using driver::Comparison;
using driver::Test;

Mark mark_of(std::size_t model) {
  return model == 0 ? Mark::points : Mark::squares;
}

/// Of the tests that are wanted, those with the most points in each class of temperature or rate.
template <class Wanted, class Class>
std::vector<std::size_t> representatives(const std::vector<Test>& tests, Wanted&& wanted, Class&& class_of) {
  std::vector<std::size_t> chosen;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (!wanted(tests[t])) continue;
    const auto same =
        std::find_if(chosen.begin(), chosen.end(), [&](std::size_t c) { return class_of(tests[c]) == class_of(tests[t]); });
    if (same == chosen.end())
      chosen.push_back(t);
    else if (tests[*same].stress.size() < tests[t].stress.size())
      *same = t;
  }
  std::sort(chosen.begin(), chosen.end(),
            [&](std::size_t a, std::size_t b) { return class_of(tests[a]) < class_of(tests[b]); });
  return chosen;
}

template <class Name>
Panel curves_of(const Comparison& comparison, const driver::Results& results, std::string title,
                const std::vector<std::size_t>& chosen, Name&& name) {
  Panel panel{.title = std::move(title), .x_label = "plastic strain", .y_label = "true stress (MPa)"};
  panel.legend = "outside right top";
  panel.x_range = {0.0, 0.28};
  panel.y_range = {0.0, 620.0};
  int colour = 0;
  for (const std::size_t t : chosen) {
    const Test& test = comparison.tests[t];
    panel.curves.push_back(curve(name(test), test.plastic_strain, test.stress, 1.0, 1e-6, Mark::points, colour));
    for (std::size_t m = 0; m < results.size(); ++m)
      panel.curves.push_back(curve("", results[m][t].plastic_strain, results[m][t].stress, 1.0, 1e-6,
                                   m == 0 ? Mark::line : Mark::dashed, colour, 150));
    ++colour;
  }
  return panel;
}

/// Every measured point against the computed one.
Panel parity(const Comparison& comparison, const driver::Results& results) {
  Panel panel{.title = "every measured point", .x_label = "measured stress (MPa)", .y_label = "computed stress (MPa)"};
  panel.x_range = panel.y_range = {0.0, 650.0};
  panel.legend = "inside bottom right";
  for (std::size_t m = 0; m < results.size(); ++m) {
    Curve dots{comparison.models[m].name, {}, {}, mark_of(m), static_cast<int>(m)};
    for (const driver::TestResult& result : results[m])
      for (const driver::ComparedPoint& point : result.points)
        dots.x.push_back(1e-6 * point.measured), dots.y.push_back(1e-6 * point.computed);
    panel.curves.push_back(std::move(dots));
  }
  panel.curves.push_back({"equal", {0.0, 650.0}, {0.0, 650.0}, Mark::line, 6});
  panel.curves.push_back({"± 10 %", {0.0, 650.0}, {0.0, 715.0}, Mark::dashed, 6});
  panel.curves.push_back({"", {0.0, 650.0}, {0.0, 585.0}, Mark::dashed, 6});
  return panel;
}

Panel ratios(const Comparison& comparison, const driver::Results& results) {
  Panel panel{.title = "every test", .x_label = "temperature (K)", .y_label = "computed / measured stress (mean)"};
  panel.legend = "inside top left";
  panel.logarithmic_y = true;
  panel.y_range = {0.5, 15.0};
  for (std::size_t m = 0; m < results.size(); ++m) {
    Curve dots{comparison.models[m].name, {}, {}, mark_of(m), static_cast<int>(m)};
    for (std::size_t t = 0; t < comparison.tests.size(); ++t)
      if (!results[m][t].points.empty())
        dots.x.push_back(comparison.tests[t].temperature),
            dots.y.push_back(1.0 + driver::errors_of(results[m][t].points).relative_mean);
    panel.curves.push_back(std::move(dots));
  }
  panel.curves.push_back({"", {50.0, 680.0}, {1.0, 1.0}, Mark::line, 6});
  panel.x_range = {50.0, 680.0};
  return panel;
}

}  // namespace

Picture flow_stress_6061() {
  const Comparison comparison = driver::read_comparison(data_folder() / "cases" / "point_6061_t6.toml");
  const driver::Results results = driver::compare(comparison);
  Picture picture;
  picture.figure = {.title = "6061-T6 aluminium: " + std::to_string(comparison.tests.size()) +
                             " measured curves (points), Johnson-Cook (solid), threshold stress (dashed)",
                    .panels = {},
                    .columns = 2,
                    .panel_width = 640,
                    .panel_height = 440};
  const auto slow = [](const Test& t) { return t.strain_rate < 0.1 && t.pressure == 0.0 && t.stress.size() > 5; };
  const auto fast = [](const Test& t) { return t.strain_rate >= 900.0 && t.pressure == 0.0 && t.stress.size() > 5; };
  const auto hundred = [](const Test& t) { return std::round(t.temperature / 75.0); };
  const auto name = [](const Test& t) { return fmt::format("{:g} K, {:g} /s", t.temperature, t.strain_rate); };
  picture.figure.panels = {curves_of(comparison, results, "slow tests", representatives(comparison.tests, slow, hundred), name),
                           curves_of(comparison, results, "fast tests", representatives(comparison.tests, fast, hundred), name),
                           parity(comparison, results), ratios(comparison, results)};
  // Lots of the alloy differ: at room temperature the laboratories scatter by 18 % around their mean.
  constexpr double scatter = 18.0;
  const auto all = [](const Test&) { return true; };
  const auto cold = [](const Test& t) { return t.temperature <= 350.0; };
  const auto hot = [](const Test& t) { return t.temperature > 350.0; };
  constexpr double settled = 0.02;  // plastic strain from which the bars of fast tests are in equilibrium
  for (std::size_t m = 0; m < results.size(); ++m) {
    const std::string& model = comparison.models[m].name;
    const auto add = [&](std::string_view group, const driver::GroupErrors& e, std::optional<double> tolerance) {
      picture.checks.push_back({fmt::format("{}: RMS error, {}", model, group),
                                fmt::format("{} curves, {} points", e.tests, e.all_points.points), 100.0 * e.rms_of_tests,
                                tolerance, "%"});
    };
    add("all, from ep = 0.002",
        driver::errors_of_group(comparison.tests, results[m], all, comparison.protocol.smallest_plastic_strain), {});
    add("all, from ep = 0.02", driver::errors_of_group(comparison.tests, results[m], all, settled), {});
    add("up to 350 K, from ep = 0.02", driver::errors_of_group(comparison.tests, results[m], cold, settled), scatter);
    add("above 350 K, from ep = 0.02", driver::errors_of_group(comparison.tests, results[m], hot, settled), {});
  }
  return picture;
}

}  // namespace brisance::plots
