// Draws the figures that verify the library and writes the table of their numbers.
//   gallery [NAME...] [--list] [-o DIR]
// Ends with 1 when a number is outside its tolerance, 2 when it was called wrongly.

#include "gallery.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <exception>

namespace brisance::plots {
namespace {

struct Entry {
  std::string_view name, shows;
  Picture (*make)();
};
constexpr std::array<Entry, 8> entries{
    {{"stress_strain", "five flow stress laws of copper against strain, rate and temperature", stress_strain},
     {"radial_return", "the return to von Mises' circle in the deviatoric plane", radial_return},
     {"adiabatic_temperature", "temperature rise by plastic work", adiabatic_temperature},
     {"porosity", "growth and nucleation of voids, and the porous yield surface", porosity},
     {"stability", "onset of instability by Drucker's postulate and by the acoustic tensor", stability},
     {"hugoniot", "shock states of aluminium against data, expansion of detonation products", hugoniot},
     {"aluminium", "isotherm, melting, moduli and specific heat of aluminium against data", aluminium},
     {"flow_stress_6061", "6061-T6 against 95 measured curves", flow_stress_6061}}};

struct Row {
  std::string_view figure;
  Check check;

  std::string value() const { return with_unit(check.measured); }
  std::string limit() const { return check.tolerance ? with_unit(*check.tolerance) : "none"; }
  std::string_view verdict() const { return !check.tolerance ? "reported" : (check.passes() ? "pass" : "FAIL"); }

 private:
  std::string with_unit(double x) const { return fmt::format("{:.3g}{}", x, check.unit == "1" ? "" : " " + check.unit); }
};

std::vector<Row> draw(const Entry& entry, const std::filesystem::path& directory) {
  const auto begin = std::chrono::steady_clock::now();
  const Picture picture = entry.make();
  for (const std::string_view ending : {".png", ".svg"})
    draw(picture.figure, directory / (std::string(entry.name) + std::string(ending)));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print("{} ({:.1f} s): {}\n", entry.name, seconds, (directory / entry.name).string() + ".png");
  std::vector<Row> rows;
  for (const Check& check : picture.checks) {
    rows.push_back({entry.name, check});
    fmt::print("  {:58} {:44} {:>11} of {:>9}  {}\n", check.quantity, check.reference, rows.back().value(), rows.back().limit(),
               rows.back().verdict());
  }
  return rows;
}

/// Text within a cell of a table, where a bar would end the cell.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

void write_table(const std::vector<Row>& rows, const std::filesystem::path& path) {
  std::string text = "# What the figures of the gallery verify\n\nWritten by `./bootstrap.sh validate`.\n\n";
  text += "| figure | quantity | reference | measured | tolerance | result |\n|---|---|---|---|---|---|\n";
  for (const Row& row : rows)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.figure, cell(row.check.quantity), cell(row.check.reference),
                        row.value(), row.limit(), row.verdict());
  replace_file_by_text(path, text);
  fmt::print("table: {}\n", path.string());
}

/// The entries of these names, all for no names. Throws CLI::ValidationError.
std::vector<Entry> chosen(const std::vector<std::string>& names) {
  if (names.empty()) return {entries.begin(), entries.end()};
  std::vector<Entry> result;
  for (const std::string& name : names) {
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; });
    if (found == entries.end()) throw CLI::ValidationError(name, "is no figure; --list names them");
    result.push_back(*found);
  }
  return result;
}

int run(const std::vector<Entry>& figures, const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  std::vector<Row> rows;
  for (const Entry& entry : figures)
    for (const Row& row : draw(entry, directory)) rows.push_back(row);
  if (figures.size() == entries.size()) write_table(rows, directory / "validation.md");
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.check.passes(); });
  if (failed > 0) fmt::print("{} of {} numbers are outside their tolerance\n", failed, rows.size());
  return failed > 0 ? 1 : 0;
}

}  // namespace
}  // namespace brisance::plots

int main(int count, char** words) {
  using namespace brisance::plots;
  CLI::App app{"Draws the figures that verify the library, and the table of their numbers."};
  std::vector<std::string> names;
  std::string directory = "plots/gallery";
  bool list = false;
  app.add_option("name", names, "figures; all if none is named");
  app.add_option("-o", directory, "folder for figures and table")->capture_default_str();
  app.add_flag("--list", list, "names the figures");
  try {
    app.parse(count, words);
    if (!list) return run(chosen(names), directory);
    for (const Entry& entry : entries) fmt::print("{:22} {}\n", entry.name, entry.shows);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gallery: {}\n", error.what());
    return 1;
  }
}
