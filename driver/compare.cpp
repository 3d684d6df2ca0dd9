#include "driver/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "driver/commands.hpp"
#include "driver/follow.hpp"
#include "driver/keys.hpp"
#include "driver/plot.hpp"
#include "models/interpolate.hpp"
#include "models/programs/progress.hpp"

namespace brisance::driver {
namespace {

/// The path of a test: superposed pressure, then uniaxial stress at the measured rate.
LoadingPath path_of(const Test& test, const Comparison& comparison, double largest_plastic_strain) {
  const Protocol& protocol = comparison.protocol;
  LoadingPath path;
  path.title = test.name;
  path.temperature = test.temperature;
  path.heat = test.strain_rate >= protocol.adiabatic_from ? Heat::adiabatic : Heat::isothermal;
  path.on_failure = OnFailure::keep_going;  // a criterion that fires does not end the measured curve
  path.strain_increment = comparison.strain_increment;
  path.output.every = 1;
  const auto hold = [](double SymmetricTensor<double>::*component, double stress) {
    SymmetricTensor<double> unit;
    unit.*component = 1.0;
    return FreeDirection{to_tensor(unit), unit, {}, stress};
  };
  using S = SymmetricTensor<double>;
  if (test.pressure != 0.0) {
    PathSegment squeeze;
    squeeze.where = test.name + ": superposed pressure";
    squeeze.free.push_back({Tensor<double>::identity(), (-1.0 / 3.0) * S::identity(), {}, test.pressure});
    squeeze.duration = 0.01 / test.strain_rate;
    path.segments.push_back(squeeze);
  }
  PathSegment load;
  load.where = test.name;
  load.velocity_gradient.xx = protocol.compression ? -test.strain_rate : test.strain_rate;
  load.free = {hold(&S::yy, -test.pressure), hold(&S::zz, -test.pressure)};
  load.until = Until{"plastic_strain", largest_plastic_strain};
  path.segments.push_back(load);
  return path;
}

TestResult compare_one(const Test& test, const Material& material, const Comparison& comparison) {
  const Protocol& protocol = comparison.protocol;
  TestResult result;
  double largest = 0.0;
  for (std::size_t i = 0; i < test.plastic_strain.size(); ++i)
    if (counts(test, i, protocol)) largest = std::max(largest, test.plastic_strain[i]);
  if (largest == 0.0) {
    result.note = "no point beyond the smallest plastic strain";
    return result;
  }
  const LoadingPath path = path_of(test, comparison, largest);
  History history(material, path.output);
  Outcome outcome;
  try {
    outcome = follow(material, path, history);
  } catch (const RunError& error) {
    result.note = error.what();
    return result;
  }
  if (outcome.failure != FailureCause::none) result.note = fmt::format("{} criterion fired", describe(outcome.failure));
  const Record& record = history.record();
  const std::vector<double>&plastic = record.find("plastic_strain")->values, &axial = record.find("stress_xx")->values,
        &lateral = record.find("stress_yy")->values;
  for (std::size_t row = 0; row < record.rows(); ++row) {
    // The elastic part has plastic strain zero all along; its last point is where flow begins.
    if (!result.plastic_strain.empty() && plastic[row] <= result.plastic_strain.back()) {
      result.plastic_strain.pop_back();
      result.stress.pop_back();
    }
    result.plastic_strain.push_back(plastic[row]);
    result.stress.push_back(std::abs(axial[row] - lateral[row]));
  }
  for (std::size_t i = 0; i < test.stress.size(); ++i)
    if (counts(test, i, protocol))
      result.points.push_back(
          {test.plastic_strain[i], test.stress[i], interpolate(result.plastic_strain, result.stress, test.plastic_strain[i])});
  return result;
}

struct Group {
  std::string name;
  std::function<bool(const Test&)> belongs;
};
std::vector<Group> groups() {
  constexpr double warm = 350.0, fast = 100.0;  // K, 1/s
  return {{"all tests", [](const Test&) { return true; }},
          {"up to 350 K, below 100 /s", [](const Test& t) { return t.temperature <= warm && t.strain_rate < fast; }},
          {"up to 350 K, from 100 /s", [](const Test& t) { return t.temperature <= warm && t.strain_rate >= fast; }},
          {"above 350 K, below 100 /s", [](const Test& t) { return t.temperature > warm && t.strain_rate < fast; }},
          {"above 350 K, from 100 /s", [](const Test& t) { return t.temperature > warm && t.strain_rate >= fast; }}};
}

/// Width of a column of names under a heading.
template <class Names>
int width_of(std::string_view heading, const Names& names) {
  std::size_t width = heading.size();
  for (const std::string& name : names) width = std::max(width, name.size());
  return static_cast<int>(width);
}

void print_tests(const Comparison& comparison, const Results& results) {
  std::vector<std::string> authors;
  for (const Test& test : comparison.tests) authors.push_back(test.author);
  const int author = width_of("author", authors), errors = 29;
  fmt::print("{:>4}  {:{}} {:>6} {:>9} {:>7} {:>7}", "test", "author", author, "T, K", "rate, 1/s", "p, MPa", "points");
  for (const Model& model : comparison.models) fmt::print("   {:>{}}", model.name, errors);
  fmt::print("\n{:{}}", "", author + 39);
  for (std::size_t m = 0; m < comparison.models.size(); ++m)
    fmt::print("   {:>7} {:>6} {:>7} {:>6}", "RMS,MPa", "norm.%", "RMS,%", "mean,%");
  fmt::print("\n");
  for (std::size_t t = 0; t < comparison.tests.size(); ++t) {
    const Test& test = comparison.tests[t];
    fmt::print("{:4}  {:{}} {:6g} {:9g} {:7g} {:7}", t + 1, test.author, author, test.temperature, test.strain_rate,
               test.pressure * 1e-6, results.front()[t].points.size());
    std::string notes;
    for (std::size_t m = 0; m < results.size(); ++m) {
      const Errors e = errors_of(results[m][t].points);
      if (e.points > 0)
        fmt::print("   {:7.1f} {:6.1f} {:7.1f} {:+6.1f}", e.rms * 1e-6, 100.0 * e.normalised_rms, 100.0 * e.relative_rms,
                   100.0 * e.relative_mean);
      else
        fmt::print("   {:>{}}", "none", errors);
      const std::string& note = results[m][t].note;
      if (!note.empty() && notes.find(note) == std::string::npos)
        notes += fmt::format("  {}: {}", comparison.models[m].name, note);
    }
    fmt::print("{}\n", notes);
  }
}

void print_groups(const Comparison& comparison, const Results& results) {
  const std::vector<Group> all_groups = groups();
  std::vector<std::string> group_names, model_names;
  for (const Group& group : all_groups) group_names.push_back("  " + group.name);
  for (const Model& model : comparison.models) model_names.push_back(model.name);
  const int group_width = width_of("tests", group_names), model_width = width_of("model", model_names);
  fmt::print("{:{}} {:{}} {:>9} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>11}\n", "tests", group_width, "model", model_width,
             "tests", "points", "RMS,MPa", "norm.,%", "RMS,%", "mean,%", "tests,%", "median,%", "within 10 %");
  const std::size_t of_all = comparison.tests.size();
  for (const double from : comparison.summary_from) {
    const auto with_points = errors_of_group(comparison.tests, results.front(), all_groups.front().belongs, from).tests;
    const std::size_t without = of_all - static_cast<std::size_t>(with_points);
    fmt::print("from a plastic strain of {:g}", from);
    if (without > 0) fmt::print(": {} of {} tests ({} without points)", with_points, of_all, without);
    fmt::print("\n");
    for (const Group& group : all_groups)
      for (std::size_t m = 0; m < results.size(); ++m) {
        const GroupErrors e = errors_of_group(comparison.tests, results[m], group.belongs, from);
        if (e.tests == 0) continue;
        fmt::print("{:{}} {:{}} {:9} {:7} {:8.1f} {:8.1f} {:8.1f} {:+8.1f} {:9.1f} {:9.1f} {:>11}\n", "  " + group.name,
                   group_width, comparison.models[m].name, model_width, e.tests, e.all_points.points, e.all_points.rms * 1e-6,
                   100.0 * e.all_points.normalised_rms, 100.0 * e.all_points.relative_rms, 100.0 * e.all_points.relative_mean,
                   100.0 * e.rms_of_tests, 100.0 * e.median_of_tests, fmt::format("{}/{}", e.within_10_percent, e.tests));
      }
  }
}

void print_report(const Comparison& comparison, const Results& results, double wall_time) {
  const Protocol& protocol = comparison.protocol;
  fmt::print("{}\n", comparison.title);
  fmt::print("{}; stress at equal plastic strain, from {:g} on\n", description(protocol), protocol.smallest_plastic_strain);
  fmt::print(
      "norm.: RMS over the test's mean stress; RMS and mean: of (computed - measured)/measured; tests: RMS of the tests' "
      "norm.\n\n");
  print_tests(comparison, results);
  fmt::print("\n");
  print_groups(comparison, results);
  fmt::print("{} curves in {:.2f} s\n", comparison.tests.size() * comparison.models.size(), wall_time);
}

std::filesystem::path points_path(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format("{}_points.csv", path.stem().string());
}

void write_results(const Comparison& comparison, const Results& results, const std::filesystem::path& path) {
  std::string text = "test,author,temperature [K],strain_rate [1/s],pressure [Pa],points";
  for (const Model& model : comparison.models)
    text += fmt::format(",{0}: rms [Pa],{0}: normalised_rms,{0}: relative_rms,{0}: relative_mean,{0}: note", model.name);
  text += "\n";
  for (std::size_t t = 0; t < comparison.tests.size(); ++t) {
    const Test& test = comparison.tests[t];
    text += fmt::format("{},{},{},{},{},{}", test.name, test.author, test.temperature, test.strain_rate, test.pressure,
                        results.front()[t].points.size());
    for (const auto& model : results) {
      const Errors e = errors_of(model[t].points);
      if (e.points > 0)
        text += fmt::format(",{},{},{},{},\"{}\"", e.rms, e.normalised_rms, e.relative_rms, e.relative_mean, model[t].note);
      else
        text += fmt::format(",,,,,\"{}\"", model[t].note);
    }
    text += "\n";
  }
  replace_file_by_text(path, text);
  std::string points = "test,plastic_strain,measured [Pa],counts";
  for (const Model& model : comparison.models) points += fmt::format(",{} [Pa]", model.name);
  points += "\n";
  for (std::size_t t = 0; t < comparison.tests.size(); ++t) {
    const Test& test = comparison.tests[t];
    for (std::size_t i = 0; i < test.stress.size(); ++i) {
      points += fmt::format("{},{},{},{}", test.name, test.plastic_strain[i], test.stress[i],
                            counts(test, i, comparison.protocol) ? 1 : 0);
      for (const auto& model : results)
        if (!model[t].stress.empty())
          points += fmt::format(",{}", interpolate(model[t].plastic_strain, model[t].stress, test.plastic_strain[i]));
        else
          points += ",";
      points += "\n";
    }
  }
  replace_file_by_text(points_path(path), points);
}

/// Tests for a panel of the figure: those with the most points among equal conditions, so that curves can be told apart.
struct Choice {
  std::string title;
  std::vector<std::size_t> tests;
};

template <class Key, class Wanted>
Choice choose(const std::vector<Test>& tests, std::string title, std::size_t most, Wanted&& wanted, Key&& key) {
  std::map<double, std::size_t> best;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (!wanted(tests[t])) continue;
    const auto [found, inserted] = best.emplace(key(tests[t]), t);
    if (!inserted && tests[found->second].stress.size() < tests[t].stress.size()) found->second = t;
  }
  std::vector<std::size_t> all;
  for (const auto& [k, t] : best) all.push_back(t);
  Choice choice{std::move(title), {}};
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    choice.tests.push_back(all[all.size() <= most ? i : i * (all.size() - 1) / (most - 1)]);
  return choice;
}

std::vector<Choice> choices_for_figure(const Comparison& comparison) {
  const std::vector<Test>& tests = comparison.tests;
  const auto slow = [](const Test& t) { return t.strain_rate < 0.1 && t.pressure == 0.0 && t.stress.size() > 5; };
  const auto fast = [](const Test& t) { return t.strain_rate >= 900.0 && t.pressure == 0.0 && t.stress.size() > 5; };
  const auto by_temperature = [](const Test& t) { return std::round(t.temperature / 25.0); };
  const auto by_rate = [](const Test& t) { return std::floor(std::log10(t.strain_rate) + 1e-9); };
  const auto room = [](const Test& t) {
    return std::abs(t.temperature - 297.0) < 5.0 && t.pressure == 0.0 && t.stress.size() > 5;
  };
  const auto pressed = [&](const Test& t) {
    const bool author = std::any_of(tests.begin(), tests.end(),
                                    [&](const Test& other) { return other.author == t.author && other.pressure > 0.0; });
    return author && std::abs(t.temperature - 300.0) < 5.0;
  };
  const auto by_pressure = [](const Test& t) { return t.pressure; };
  std::vector<Choice> all{choose(tests, "below 0.1 /s: temperature", 5, slow, by_temperature),
                          choose(tests, "from 900 /s: temperature", 5, fast, by_temperature),
                          choose(tests, "room temperature: strain rate", 5, room, by_rate),
                          choose(tests, "room temperature: superposed pressure", 4, pressed, by_pressure)};
  std::erase_if(all, [](const Choice& c) { return c.tests.empty(); });
  if (all.empty())
    all.push_back(choose(
        tests, "temperature", 7, [](const Test&) { return true; }, by_temperature));
  return all;
}

/// The error of every test, by its number in the table.
Panel error_panel(const Comparison& comparison, const Results& results) {
  Panel panel{.title = "RMS error of each test over its mean stress",
              .x_label = "number of the test in the table, by temperature and then rate",
              .y_label = "error (%)"};
  panel.wide = true;
  panel.logarithmic_y = true;
  panel.legend = "inside left top horizontal";
  const double end = static_cast<double>(comparison.tests.size()) + 1.0;
  for (std::size_t m = 0; m < results.size(); ++m) {
    Curve curve{comparison.models[m].name, {}, {}, m == 0 ? Mark::points : Mark::squares, static_cast<int>(m)};
    for (std::size_t t = 0; t < results[m].size(); ++t) {
      const Errors e = errors_of(results[m][t].points);
      if (e.points == 0) continue;
      curve.x.push_back(static_cast<double>(t + 1));
      curve.y.push_back(100.0 * e.normalised_rms);
    }
    panel.curves.push_back(std::move(curve));
  }
  panel.curves.push_back({"10 %", {0.0, end}, {10.0, 10.0}, Mark::dashed, 6});
  panel.x_range = {0.0, end};
  return panel;
}

/// Measured points and computed curves of some tests; one test shows its models in colours, several show each test in one.
Panel panel_of(const Comparison& comparison, const Results& results, const Choice& choice) {
  Panel panel{.title = choice.title, .x_label = "plastic strain", .y_label = "true stress (MPa)"};
  panel.legend = "below horizontal";
  const bool alone = choice.tests.size() == 1;
  const auto line_of = [](std::size_t m) { return m == 0 ? Mark::line : Mark::dashed; };
  double strain = 0.0, stress = 0.0;
  for (std::size_t i = 0; i < choice.tests.size(); ++i) {
    const std::size_t t = choice.tests[i];
    const Test& test = comparison.tests[t];
    const int colour = static_cast<int>(i);
    Curve measured{alone ? "measured" : conditions(test), {}, {}, Mark::points, alone ? 6 : colour};
    for (std::size_t k = 0; k < test.stress.size(); ++k) {
      if (test.plastic_strain[k] < 0.0) continue;
      measured.x.push_back(test.plastic_strain[k]);
      measured.y.push_back(test.stress[k] * 1e-6);
      strain = std::max(strain, test.plastic_strain[k]);
      stress = std::max(stress, measured.y.back());
    }
    panel.curves.push_back(std::move(measured));
    for (std::size_t m = 0; m < results.size(); ++m) {
      Curve computed{alone ? comparison.models[m].name : "",
                     results[m][t].plastic_strain,
                     {},
                     line_of(m),
                     alone ? static_cast<int>(m) : colour};
      for (const double s : results[m][t].stress) {
        computed.y.push_back(s * 1e-6);
        stress = std::max(stress, s * 1e-6);
      }
      panel.curves.push_back(std::move(computed));
    }
  }
  for (std::size_t m = 0; m < results.size() && !alone; ++m)  // entries of the legend without data of their own
    panel.curves.push_back({comparison.models[m].name, {0.0, 0.0}, {-1.0, -1.0}, line_of(m), 6});
  panel.x_range = {0.0, strain > 0.0 ? 1.03 * strain : 1.0};
  panel.y_range = {0.0, 1.05 * stress};
  return panel;
}

/// Few tests have a panel each; of many, representatives share panels.
Figure figure_of(const Comparison& comparison, const Results& results) {
  constexpr std::size_t few = 8;
  Figure figure;
  figure.title = comparison.title;
  figure.columns = 2;
  figure.panel_width = 640;
  figure.panel_height = 430;
  std::vector<Choice> choices;
  if (comparison.tests.size() > few) choices = choices_for_figure(comparison);
  for (std::size_t t = 0; t < comparison.tests.size() && comparison.tests.size() <= few; ++t) {
    const Test& test = comparison.tests[t];
    choices.push_back({fmt::format("{}: {}, {}", t + 1, test.author, conditions(test)), {t}});
  }
  for (const Choice& choice : choices) figure.panels.push_back(panel_of(comparison, results, choice));
  if (comparison.tests.size() > few) figure.panels.push_back(error_panel(comparison, results));
  return figure;
}

}  // namespace

Comparison read_comparison(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  InputFile input = InputFile::load(file);
  for (const std::string& assignment : overrides) input.set(assignment);
  TableReader top = input.top();
  auto keys = read_keys<ComparisonKeys>(top);
  Comparison comparison;
  comparison.title = keys.title;
  comparison.tests = read_experiments(top, keys.experiments).tests;
  std::stable_sort(comparison.tests.begin(), comparison.tests.end(), [](const Test& a, const Test& b) {
    return std::tuple(a.temperature, a.strain_rate, a.pressure) < std::tuple(b.temperature, b.strain_rate, b.pressure);
  });
  comparison.models = std::move(keys.models);
  comparison.protocol = protocol_of(keys.protocol);
  comparison.strain_increment = keys.protocol.strain_increment;
  comparison.summary_from = keys.protocol.summary_from;
  if (!top.has("model")) top.problem("there is no [[model]] to compare with");
  input.finish();
  return comparison;
}

Results compare(const Comparison& comparison) {
  ProgressLine progress;
  Results results;
  for (const Model& model : comparison.models) {
    results.emplace_back();
    for (const Test& test : comparison.tests) {
      progress.show(fmt::format("{}: {}", model.name, conditions(test)));
      results.back().push_back(compare_one(test, model.file.material, comparison));
    }
  }
  return results;
}

Errors errors_of(const std::vector<ComparedPoint>& points) {
  Errors e;
  e.points = static_cast<int>(points.size());
  if (points.empty()) return e;
  double squares = 0.0, relative_squares = 0.0, relative = 0.0, measured = 0.0;
  for (const ComparedPoint& p : points) {
    const double error = p.computed - p.measured;
    squares += error * error;
    relative += error / p.measured;
    relative_squares += error / p.measured * (error / p.measured);
    measured += p.measured;
  }
  const double n = e.points;
  e.rms = std::sqrt(squares / n);
  e.normalised_rms = e.rms / (measured / n);
  e.relative_rms = std::sqrt(relative_squares / n);
  e.relative_mean = relative / n;
  return e;
}

GroupErrors errors_of_group(const std::vector<Test>& tests, const std::vector<TestResult>& results,
                            const std::function<bool(const Test&)>& belongs, double smallest_plastic_strain) {
  GroupErrors group;
  std::vector<ComparedPoint> all;
  std::vector<double> errors;
  double squares = 0.0;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (!belongs(tests[t])) continue;
    std::vector<ComparedPoint> points = results[t].points;
    std::erase_if(points, [&](const ComparedPoint& p) { return p.plastic_strain < smallest_plastic_strain; });
    if (points.empty()) continue;
    all.insert(all.end(), points.begin(), points.end());
    errors.push_back(errors_of(points).normalised_rms);
    squares += errors.back() * errors.back();
    group.within_10_percent += errors.back() <= 0.1;
  }
  if (errors.empty()) return group;
  group.tests = static_cast<int>(errors.size());
  group.all_points = errors_of(all);
  group.rms_of_tests = std::sqrt(squares / group.tests);
  std::sort(errors.begin(), errors.end());
  const std::size_t half = errors.size() / 2;
  group.median_of_tests = errors.size() % 2 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
  return group;
}

int run_comparison(const CompareOptions& options) {
  require_place_for(options.output, {".csv"});
  for (const std::filesystem::path& figure : options.figures) require_place_for(figure, {".png", ".svg"});
  const Comparison comparison = read_comparison(options.file, options.overrides);
  const auto begin = std::chrono::steady_clock::now();
  const Results results = compare(comparison);
  print_report(comparison, results, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  if (!options.output.empty()) {
    write_results(comparison, results, options.output);
    fmt::print("tests: {}\npoints: {}\n", options.output.string(), points_path(options.output).string());
  }
  std::string figures;
  for (const std::filesystem::path& path : options.figures) {
    draw(figure_of(comparison, results), path);
    figures += (figures.empty() ? "" : ", ") + path.string();
  }
  if (!figures.empty()) fmt::print("figure: {}\n", figures);
  return done;
}

}  // namespace brisance::driver
