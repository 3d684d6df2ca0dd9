#include "driver/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "models/input/csv.hpp"

namespace brisance::driver {
namespace {

void add_experiment(TableReader& table, const std::filesystem::path& folder, Experiments& experiments) {
  const std::string name = table.text("file", "CSV file, beside this file");
  const std::string test = table.text("test", "column that tells the tests apart"), author = table.text_or("author", test),
                    temperature = table.text("temperature", "column"), strain_rate = table.text("strain_rate", "column"),
                    pressure = table.text_or("pressure", ""), plastic_strain = table.text("plastic_strain", "column"),
                    stress = table.text("stress", "column of the true stress");
  const std::vector<std::string> only = table.optional_texts("tests").value_or(std::vector<std::string>{});
  std::map<std::string, std::string> where;
  if (auto filter = table.optional_table("where"))
    for (const std::string& column : filter->keys()) where[column] = filter->text(column);
  if (table.problem_count() > 0) return;
  experiments.files += (experiments.files.empty() ? "" : ", ") + std::filesystem::path(name).lexically_normal().string();

  const CsvFile csv = CsvFile::load(folder / name);
  const auto tests = csv.texts(test), authors = csv.texts(author);
  const auto T = csv.numbers(temperature, Unit::K), rate = csv.numbers(strain_rate, Unit::per_s),
             strain = csv.numbers(plastic_strain, Unit::one), Y = csv.numbers(stress, Unit::Pa);
  const auto p = pressure.empty() ? std::vector<double>(csv.rows(), 0.0) : csv.numbers(pressure, Unit::Pa);
  std::vector<std::pair<std::vector<std::string>, std::string>> filters;
  for (const auto& [column, value] : where) filters.emplace_back(csv.texts(column), value);
  std::map<std::string, std::size_t> position;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    if (!only.empty() && std::find(only.begin(), only.end(), tests[row]) == only.end()) continue;
    if (!std::all_of(filters.begin(), filters.end(), [&](const auto& f) { return f.first[row] == f.second; })) continue;
    const auto [found, fresh] = position.emplace(tests[row], experiments.tests.size());
    if (fresh) experiments.tests.push_back({tests[row], authors[row], T[row], rate[row], p[row], {}, {}});
    experiments.tests[found->second].plastic_strain.push_back(strain[row]);
    experiments.tests[found->second].stress.push_back(std::abs(Y[row]));
  }
  if (position.empty()) table.problem("file", "no row of " + name + " is selected by tests and where");
  for (const std::string& wanted : only)
    if (!position.contains(wanted)) table.problem("tests", "there is no test \"" + wanted + "\" in " + name);
}

void read_experiment(TableReader& table, const std::filesystem::path& folder, Experiments& experiments) {
  try {
    add_experiment(table, folder, experiments);
  } catch (const InputError& error) {
    table.add_problems(error.problems());
  }
}

}  // namespace

Experiments read_experiments(TableReader& top, const std::filesystem::path& folder) {
  Experiments experiments;
  if (top.is_table("experiment")) {
    TableReader experiment = top.table("experiment");
    read_experiment(experiment, folder, experiments);
  } else {
    std::vector<TableReader> tables = top.tables("experiment");
    for (TableReader& table : tables) read_experiment(table, folder, experiments);
    if (tables.empty()) top.problem("there is no [experiment], the measured curves");
  }
  return experiments;
}

void read_protocol(TableReader& table, Protocol& protocol) {
  constexpr std::array<std::string_view, 2> directions{"compression", "tension"};
  protocol.compression = table.choice("direction", directions, 0) == 0;
  protocol.adiabatic_from = table.number_or("adiabatic_from", protocol.adiabatic_from, {Unit::per_s, positive, "strain rate"});
  protocol.smallest_plastic_strain =
      table.number_or("smallest_plastic_strain", protocol.smallest_plastic_strain, {Unit::one, non_negative, "plastic strain"});
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
