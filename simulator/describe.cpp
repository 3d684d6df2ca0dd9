#include "simulator/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/input/material_folders.hpp"
#include "models/input/material_reader.hpp"
#include "models/input/table_reader.hpp"
#include "simulator/config.hpp"
#include "simulator/formula.hpp"
#include "simulator/keys.hpp"

namespace brisance::simulator {
namespace {

constexpr std::pair<std::string_view, std::string_view> examples[] = {
    {"box", R"({ box = { lower = [0, 0], upper = ["10 mm", "25 mm"] } })"},
    {"cylinder", R"({ cylinder = { start = [0, 0], end = [0, "25.4 mm"], radius = "3.81 mm" } })"},
    {"cone", R"({ cone = { start = [0, 0], end = [0, "30 mm"], start_radius = "10 mm", end_radius = 0 } })"},
    {"sphere", R"({ sphere = { centre = [0, "5 mm"], radius = "5 mm" } })"},
    {"tube", R"({ tube = { start = [0, 0], end = [0, "50 mm"], radius = "10 mm", inner_radius = "8 mm" } })"},
    {"union", R"({ union = [{ box = { lower = [0, 0], upper = ["10 mm", "5 mm"] } }, )"
              R"({ sphere = { centre = [0, "5 mm"], radius = "4 mm" } }] })"},
    {"intersection", R"({ intersection = [{ sphere = { centre = [0, 0], radius = "5 mm" } }, )"
                     R"({ box = { lower = [0, 0], upper = ["5 mm", "5 mm"] } }] })"},
    {"difference", R"({ difference = { from = { box = { lower = [0, 0], upper = ["10 mm", "10 mm"] } }, )"
                   R"(without = [{ sphere = { centre = [0, "10 mm"], radius = "6 mm" } }] } })"}};

/// The keys that each kind of edge takes, in the order of EdgeKind.
constexpr std::array<std::string_view, choices<EdgeKind>.size()> keys_of_edges = {
    "no other",
    "pressure, and density or temperature; velocity, 0 if not given; fluid, the only one if not given",
    "pressure alone",
    "as inflow",
    "no other; the opposite side is periodic, too",
    "velocity along itself, 0 if not given; temperature, if heat shall pass; a fluid needs a viscosity, or conductivity"};

/// The laws that a material file names, "folder/law".
std::vector<std::string> laws_in(const std::filesystem::path& file) {
  InputFile input = InputFile::load(file);
  TableReader top = input.top();
  std::vector<std::string> laws;
  for (const std::string& folder : top.keys()) {
    const auto note = [&](TableReader table) {
      if (table.has("law")) laws.push_back(folder + "/" + table.text("law", "a law"));
    };
    if (top.is_table(folder)) note(top.table(folder));
    if (folder == "stability" || folder == "failure")
      for (const TableReader& table : top.tables(folder)) note(table);
  }
  return laws;
}

}  // namespace

std::string_view example_of_shape(std::string_view form) {
  for (const auto& [name, example] : examples)
    if (name == form) return example;
  return {};
}

std::optional<std::string> describe_shape(std::string_view form) {
  if (std::find(shape_forms.begin(), shape_forms.end(), form) == shape_forms.end()) return std::nullopt;
  std::string text = fmt::format("{}, a shape: what a solid, a [[gas.fill]], a [[gas.body]] or a load's region fills\n", form);
  const std::string path = fmt::format("solid.shape.{}", form);
  for (const KeyDescription& key : all_keys()) {
    if (key.path != path && !key.path.starts_with(path + '.')) continue;
    const std::string name = key.path == path ? std::string(form) : key.path.substr(path.size() + 1);
    const bool must = key.default_value == "required";
    text += fmt::format("  {:18} {}; {}{}\n", name, key.meaning, key.values,
                        must                        ? ""
                        : key.default_value.empty() ? "; may be left out"
                                                    : "; " + key.default_value + " if not given");
  }
  return text + fmt::format(
                    "  example: shape = {}\n  in three dimensions every point has three coordinates; in the axisymmetric "
                    "geometry x is the radius\n",
                    example_of_shape(form));
}

std::string describe_edges() {
  std::string text = "kinds of [[gas.edge]], and the keys that each takes beside side and kind\n";
  for (std::size_t kind = 0; kind < keys_of_edges.size(); ++kind)
    text += fmt::format("  {:16} {}\n", choices<EdgeKind>[kind], keys_of_edges[kind]);
  return text;
}

std::optional<std::string> describe_formula(std::string_view name) {
  if (name != "formula" && name != "formulas") return std::nullopt;
  std::string text =
      "formula, a text in the place of a number: what it says changes with place and time, in SI units\n"
      "  variables\n"
      "    x, y, z            m, coordinates, as many as the geometry has dimensions; x is the distance from the axis or the\n"
      "                       centre in the round geometries, and y runs along the axis in the axisymmetric one\n"
      "    r                  m, distance from the origin\n"
      "    t                  s, time; of what lies beyond an edge, not of what fills the box at the start\n"
      "    pi                 3.14159...\n"
      "  operators            + - * / ^, < > <= >= == !=, && ||, a ? b : c\n";
  std::vector<std::string> keys;
  for (const KeyDescription& key : all_keys())
    if (key.values.find("or a formula") != std::string::npos) keys.push_back(key.path);
  return text +
         fmt::format("  functions            {}\n  where it may stand   {}\n", fmt::join(formula_functions(), ", "),
                     fmt::join(keys, ", ")) +
         "  A text that is a number with a unit, such as \"1.2 kg/m^3\", is that number.\n"
         "  example: a wave of sound comes in\n"
         "    [[gas.edge]]\n    side = \"low_x\"\n    kind = \"inflow\"\n    density = \"1.2 + 0.001*sin(2*pi*1000*t)\"\n"
         "    pressure = \"1e5 + 118*sin(2*pi*1000*t)\"\n    velocity = [\"0.284*sin(2*pi*1000*t)\"]\n"
         "  one that changes from place to place: pressure = \"x < 0.5 ? 2e5 : 1e5\"\n";
}

std::optional<std::string> describe_case(std::string_view name) {
  for (const std::filesystem::path& file : bundled_cases()) {
    const std::string stem = file.stem().string();
    if (name != stem && name != file.filename().string()) continue;
    InputFile input = InputFile::load(file);
    TableReader top = input.top();
    const std::string_view command = top.has("geometry")    ? "brisance run"
                                     : top.has("segment")   ? "pointdriver run"
                                     : top.has("parameter") ? "pointdriver calibrate"
                                                            : "pointdriver compare";
    return fmt::format("{}, a case: {}\n  {} {}\n  its file, to copy and change: {}\n", stem, top.text_or("title", stem),
                       command, stem, file.string());
  }
  return std::nullopt;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : bundled_materials())
    names.push_back(file.filename().string()), names.push_back(file.stem().string());
  return names;
}

std::optional<std::string> describe_material(std::string_view name) {
  for (const std::filesystem::path& file : bundled_materials()) {
    const std::string whole = file.filename().string(), stem = file.stem().string();
    if (name != whole && name != stem) continue;
    const MaterialFile read = read_material_file(file);
    const Material& m = read.material;
    std::string text = fmt::format("{}: {}, {:.6g} kg/m^3\n", whole, m.name, m.density);
    std::string notes = read.notes;
    while (!notes.empty() && notes.back() == '\n') notes.pop_back();
    for (std::size_t at = 0; at < notes.size();) {
      const std::size_t end = std::min(notes.find('\n', at), notes.size());
      text += fmt::format("  {}\n", notes.substr(at, end - at));
      at = end + 1;
    }
    text += "  laws (`brisance describe LAW` explains one):\n";
    for (const std::string& law : laws_in(file)) text += fmt::format("    {}\n", law);
    const bool fluid = equation_of_state::caloric(m.equation_of_state) != equation_of_state::Caloric::incremental;
    const bool solid = m.shear_modulus || m.viscoelastic || m.flow_stress;
    if (fluid) text += fmt::format("  example of a fluid: [[gas.fluid]] name = \"{}\", material = \"{}\"\n", stem, whole);
    if (solid)
      text += fmt::format(
          "  example of a solid: [[solid]] name = \"body\", material = \"{}\", shape = ..., temperature = ...\n", whole);
    return text + fmt::format("  values, each with its source: {}\n", file.string());
  }
  return std::nullopt;
}

}  // namespace brisance::simulator
