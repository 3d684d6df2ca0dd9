#include "driver/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "driver/keys.hpp"
#include "models/input/csv.hpp"

namespace brisance::driver {
namespace {

void add_experiment(TableReader& table, Experiments& experiments) {
  const std::size_t before = table.problem_count();
  const auto keys = read_keys<ExperimentKeys>(table);
  std::map<std::string, std::string> where;
  if (auto columns = keys.where)
    for (const std::string& column : columns->keys()) where[column] = columns->text(column);
  if (table.problem_count() > before) return;
  experiments.files += (experiments.files.empty() ? "" : ", ") + std::filesystem::path(keys.file).lexically_normal().string();

  CsvColumns csv(table.file().parent_path() / keys.file);
  const auto tests = csv.texts(keys.test), authors = keys.author.empty() ? tests : csv.texts(keys.author);
  const auto T = csv.numbers(keys.temperature, Unit::K), rate = csv.numbers(keys.strain_rate, Unit::per_s),
             strain = csv.numbers(keys.plastic_strain, Unit::one), Y = csv.numbers(keys.stress, Unit::Pa);
  const auto p = keys.pressure.empty() ? std::vector<double>(csv.file().rows(), 0.0) : csv.numbers(keys.pressure, Unit::Pa);
  std::vector<std::pair<std::vector<std::string>, std::string>> filters;
  for (const auto& [column, value] : where) filters.emplace_back(csv.texts(column), value);
  if (!csv.problems().empty()) return table.add_problems("file", csv.problems());
  const auto wanted = [&](const std::string& test) {
    return keys.tests.empty() || std::find(keys.tests.begin(), keys.tests.end(), test) != keys.tests.end();
  };
  std::map<std::string, std::size_t> position;
  for (std::size_t row = 0; row < csv.file().rows(); ++row) {
    if (!wanted(tests[row])) continue;
    if (!std::all_of(filters.begin(), filters.end(), [&](const auto& f) { return f.first[row] == f.second; })) continue;
    const auto [found, fresh] = position.emplace(tests[row], experiments.tests.size());
    if (fresh) experiments.tests.push_back({tests[row], authors[row], T[row], rate[row], p[row], {}, {}});
    experiments.tests[found->second].plastic_strain.push_back(strain[row]);
    experiments.tests[found->second].stress.push_back(std::abs(Y[row]));
  }
  if (position.empty()) table.problem("file", "no row of " + keys.file + " is selected by tests and where");
  for (const std::string& name : keys.tests)
    if (!position.contains(name)) table.problem("tests", "there is no test \"" + name + "\" in " + keys.file);
}

}  // namespace

Experiments read_experiments(TableReader& top, std::span<const TableReader> tables) {
  Experiments experiments;
  for (TableReader table : tables) {
    try {
      add_experiment(table, experiments);
    } catch (const InputError& error) {  // the file cannot be read
      table.add_problems("file", error.problems());
    }
  }
  if (tables.empty() && !top.has("experiment")) top.problem("there is no [experiment], the measured curves");
  return experiments;
}

Protocol protocol_of(const ProtocolKeys& keys) {
  return {keys.direction == TestDirection::compression, keys.adiabatic_from, keys.smallest_plastic_strain};
}

bool counts(const Test& test, std::size_t point, const Protocol& protocol) {
  return test.plastic_strain[point] >= protocol.smallest_plastic_strain && test.stress[point] > 0.0;
}

std::string conditions(const Test& test) {
  std::string text = fmt::format("{:g} K, {:g} /s", test.temperature, test.strain_rate);
  if (test.pressure != 0.0) text += fmt::format(", {:g} MPa", test.pressure * 1e-6);
  return text;
}

std::string description(const Protocol& protocol) {
  return fmt::format("uniaxial {}, isothermal below {:g} /s, adiabatic from there",
                     protocol.compression ? "compression" : "tension", protocol.adiabatic_from);
}

}  // namespace brisance::driver
