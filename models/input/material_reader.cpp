#include "models/input/material_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "models/input/material_folders.hpp"
#include "models/input/toml_tree.hpp"
#include "models/input/units.hpp"

namespace brisance {
namespace {

using Path = std::filesystem::path;

// The plastic strain is what a table of a parameter runs over.
constexpr std::string_view abscissa_name = "plastic_strain";
constexpr Quantity abscissa{Unit::one, non_negative, "knots of the table"};

template <class T>
struct is_array : std::false_type {};
template <std::size_t N>
struct is_array<std::array<double, N>> : std::true_type {};

template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {};

template <class Variant>
struct Laws;
template <class... Law>
struct Laws<std::variant<Law...>> {
  static constexpr std::array names = {Law::name...};
};

template <class Law>
std::vector<std::string_view> parameter_names() {
  std::vector<std::string_view> names;
  for_each_parameter<Law>([&](const auto& row) { names.push_back(row.name); });
  return names;
}

// --- Reading ----------------------------------------------------------------------------------------------------------

template <class Law, class T>
void read_parameter(TableReader& table, Law& law, const Parameter<Law, T>& row, std::optional<T> default_value) {
  const Quantity quantity{row.unit, row.interval, row.meaning};
  T& member = law.*row.member;
  if (default_value && !table.has(row.name)) {
    member = *default_value;
  } else if constexpr (std::is_same_v<T, double>) {
    member = table.number(row.name, quantity);
  } else if constexpr (std::is_same_v<T, bool>) {
    member = table.flag(row.name);
  } else if constexpr (std::is_same_v<T, Table>) {
    member = table.piecewise(row.name, quantity, abscissa_name, abscissa);
  } else if constexpr (is_array<T>::value) {
    const std::vector<double> values = table.numbers(row.name, quantity, exactly(member.size()));
    std::copy_n(values.begin(), std::min(values.size(), member.size()), member.begin());
  } else {
    static_assert(std::is_enum_v<T> && !choices<T>.empty(), "an enum parameter needs its names in choices<Enum>");
    member = table.choice<T>(row.name);
  }
}

/// The density of the material is the reference density of its equation of state unless that gives its own.
template <class Law, class T>
std::optional<T> default_of(const Parameter<Law, T>& row, [[maybe_unused]] std::optional<double> reference_density) {
  if constexpr (std::is_same_v<T, double>)
    if (row.name == "reference_density" && reference_density) return reference_density;
  return row.default_value;
}

void read_sources(TableReader& table, const std::string& component, std::span<const std::string_view> parameters, bool required,
                  MaterialFile& file) {
  if (required || table.has("source")) file.sources[component] = table.text("source", "citation of the values in this table");
  auto single = table.optional_table("sources");
  if (!single) return;
  for (const std::string& key : single->keys()) {
    const std::string citation = single->text(key);
    if (std::find(parameters.begin(), parameters.end(), key) != parameters.end())
      file.sources[component + '.' + key] = citation;
    else
      single->problem(key, "this law has no such parameter" + (parameters.empty() ? "" : "; it has " + listed(parameters)) +
                               did_you_mean(key, parameters));
  }
}

template <class Law>
Law read_law(TableReader& table, const std::string& component, std::optional<double> reference_density, bool source_required,
             MaterialFile& file) {
  Law law{};
  for_each_parameter<Law>([&](const auto& row) { read_parameter(table, law, row, default_of(row, reference_density)); });
  read_sources(table, component, parameter_names<Law>(), source_required, file);
  return law;
}

template <class Variant>
Variant read_component(TableReader table, const std::string& component, MaterialFile& file,
                       std::optional<double> reference_density = {}) {
  Variant result;
  const std::size_t before = table.problem_count();
  const std::size_t wanted = table.choice("law", Laws<Variant>::names);
  if (table.problem_count() > before) {
    table.ignore_rest();  // without a law the other keys mean nothing
    return result;
  }
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((I == wanted ? static_cast<void>(result.template emplace<I>(
                        read_law<std::variant_alternative_t<I, Variant>>(table, component, reference_density, true, file)))
                  : void()),
     ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
  return result;
}

template <class Variant>
void read_optional(TableReader& top, const std::string& component, std::optional<Variant>& result, MaterialFile& file) {
  if (const auto table = top.optional_table(component)) result = read_component<Variant>(*table, component, file);
}

template <class Variant>
void read_list(TableReader& top, const std::string& component, std::vector<Variant>& result, MaterialFile& file) {
  for (TableReader& table : top.tables(component))
    result.push_back(read_component<Variant>(table, component + '.' + std::to_string(result.size()), file));
}

void read_scalar_source(TableReader& top, const std::string& key, MaterialFile& file) {
  if (auto citation = top.optional_text(key + "_source")) file.sources[key] = std::move(*citation);
}

// --- Writing ----------------------------------------------------------------------------------------------------------

template <class Numbers>
std::string toml_numbers(const Numbers& values) {
  std::string result = "[";
  for (const double value : values) result += (result.size() > 1 ? ", " : "") + toml_number(value);
  return result + ']';
}

template <class T>
std::string toml_value(const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    return toml_number(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_same_v<T, Table>) {
    if (value.size <= 1 && value.x[0] == 0.0) return toml_number(value.y[0]);
    const std::span x(value.x.data(), static_cast<std::size_t>(value.size)),
        y(value.y.data(), static_cast<std::size_t>(value.size));
    return "{" + std::string(abscissa_name) + " = " + toml_numbers(x) + ", value = " + toml_numbers(y) + '}';
  } else if constexpr (is_array<T>::value) {
    return toml_numbers(value);
  } else {
    return toml_text(choices<T>[static_cast<std::size_t>(value)]);
  }
}

class MaterialWriter {
 public:
  explicit MaterialWriter(const MaterialFile& file) : file_(file) {}

  template <class T>
  void line(std::string_view key, const T& value, Unit unit = Unit::one, std::string_view meaning = {}) {
    text_ += std::string(key) + " = " + toml_value(value);
    if (unit.text != Unit::one.text || !meaning.empty()) text_ += "  #";
    if (unit.text != Unit::one.text) text_ += ' ' + std::string(unit.text) + (meaning.empty() ? "" : ";");
    if (!meaning.empty()) text_ += ' ' + std::string(meaning);
    text_ += '\n';
  }
  void text_line(std::string_view key, std::string_view value) { text_ += std::string(key) + " = " + toml_text(value) + '\n'; }

  void scalar(const std::string& key, double value, Unit unit) {
    line(key, value, unit);
    if (const auto source = file_.sources.find(key); source != file_.sources.end()) text_line(key + "_source", source->second);
  }

  template <class Law>
  void law(const std::string& header, const std::string& component, const Law& law, bool named) {
    text_ += '\n' + header + '\n';
    if (named) text_line("law", Law::name);
    const auto source = file_.sources.find(component);
    if (source != file_.sources.end()) text_line("source", source->second);
    std::string single;
    for (const std::string_view name : parameter_names<Law>()) {
      const auto citation = file_.sources.find(component + '.' + std::string(name));
      if (citation == file_.sources.end()) continue;
      single += (single.empty() ? "" : ", ") + std::string(name) + " = " + toml_text(citation->second);
    }
    if (!single.empty()) text_ += "sources = {" + single + "}\n";
    for_each_parameter<Law>([&](const auto& row) { line(row.name, law.*row.member, row.unit, row.meaning); });
  }

  template <class Variant>
  void component(const std::string& name, const Variant& variant) {
    std::visit([&](const auto& alternative) { law('[' + name + ']', name, alternative, true); }, variant);
  }
  template <class Variant>
  void component(const std::string& name, const std::optional<Variant>& variant) {
    if (variant) component(name, *variant);
  }
  template <class Variant>
  void component(const std::string& name, const std::vector<Variant>& list) {
    for (std::size_t i = 0; i < list.size(); ++i)
      std::visit([&](const auto& alternative) { law("[[" + name + "]]", name + '.' + std::to_string(i), alternative, true); },
                 list[i]);
  }

  std::string take() { return std::move(text_); }

 private:
  const MaterialFile& file_;
  std::string text_;
};

/// Calls f(name, component) for every component that is a choice of laws, in the order of the update.
template <class SomeMaterial, class F>
void for_each_component_of(SomeMaterial& m, F&& f) {
  f("shear_modulus", m.shear_modulus);
  f("melting", m.melting);
  f("specific_heat", m.specific_heat);
  f("flow_stress", m.flow_stress);
  f("yield", m.yield);
  f("viscoelastic", m.viscoelastic);
  f("porosity", m.porosity);
  f("initial_porosity", m.initial_porosity);
  f("damage", m.damage);
  f("initial_damage", m.initial_damage);
  f("stability", m.stability);
  f("failure", m.failure);
  f("reaction", m.reaction);
}

}  // namespace

MaterialFile read_material(TableReader& table) {
  MaterialFile file;
  file.path = table.file();
  Material& m = file.material;
  const std::size_t before = table.problem_count();

  m.name = table.text("name", "what the material is called in output");
  file.notes = table.text_or("notes", "");
  const std::size_t before_density = table.problem_count();
  m.density = table.number("density", {Unit::kg_per_m3, positive, "density of the undeformed material"});
  // Without a density the reference density is not missing as well: once is enough.
  const double reference_density = table.problem_count() > before_density ? 1.0 : m.density;
  m.bulk_modulus = table.optional_number("bulk_modulus", {Unit::Pa, positive, ""});
  m.thermal_conductivity = table.optional_number("thermal_conductivity", {Unit::W_per_m_K, non_negative, ""});
  for (const char* const key : {"density", "bulk_modulus", "thermal_conductivity"}) read_scalar_source(table, key, file);
  m.objective_rate = table.choice<ObjectiveRate>("objective_rate", m.objective_rate);

  m.equation_of_state =
      read_component<EquationOfState>(table.table("equation_of_state"), "equation_of_state", file, reference_density);
  for_each_component_of(m, [&]<class Component>(const std::string& name, Component& component) {
    if constexpr (is_vector<Component>::value)
      read_list(table, name, component, file);
    else
      read_optional(table, name, component, file);
  });
  if (auto heating = table.optional_table("heating")) m.heating = read_law<Heating>(*heating, "heating", {}, true, file);
  if (auto viscosity = table.optional_table("artificial_viscosity"))
    m.artificial_viscosity = read_law<ArtificialViscosity>(*viscosity, "artificial_viscosity", {}, false, file);

  if (table.problem_count() > before) return file;
  for (const std::string& reason : incompatibilities(m)) {
    const auto colon = reason.find(": ");
    const std::string key = reason.substr(0, std::min(colon, reason.size()));
    if (table.has(key))
      table.problem(key, reason.substr(colon + 2));
    else
      table.problem(reason);
  }
  return file;
}

MaterialFile read_material_file(const Path& path) {
  InputFile input = InputFile::load(path);
  TableReader top = input.top();
  MaterialFile file = read_material(top);
  input.finish();
  return file;
}

Material read_material(const Path& path) {
  return read_material_file(path).material;
}

MaterialFile resolve_material(TableReader& table, std::string_view key) {
  if (!table.is_text(key)) {
    TableReader embedded = table.table(key, "the material, or the name of its file");
    return read_material(embedded);
  }
  const std::string name = table.text(key);
  const std::vector<std::string> overrides = table.take_overrides(key);
  if (name.empty()) return {};  // reported
  const Path beside = table.file().parent_path();
  const auto path = find_material(name, beside);
  if (!path) {
    table.problem(key, no_material_named(name, beside));
    return {};
  }
  try {
    InputFile input = InputFile::load(*path);
    for (const std::string& assignment : overrides) input.set(assignment);
    TableReader top = input.top();
    MaterialFile file = read_material(top);
    table.add_problems(key, input.problems());
    return file;
  } catch (const InputError& error) {
    table.add_problems(key, error.problems());
    return {};
  }
}

std::string write_material(const MaterialFile& file) {
  const Material& m = file.material;
  MaterialWriter writer(file);
  writer.text_line("name", m.name);
  if (!file.notes.empty()) writer.text_line("notes", file.notes);
  writer.scalar("density", m.density, Unit::kg_per_m3);
  if (m.bulk_modulus) writer.scalar("bulk_modulus", *m.bulk_modulus, Unit::Pa);
  if (m.thermal_conductivity) writer.scalar("thermal_conductivity", *m.thermal_conductivity, Unit::W_per_m_K);
  writer.line("objective_rate", m.objective_rate);
  writer.component("equation_of_state", m.equation_of_state);
  for_each_component_of(m, [&](const std::string& name, const auto& component) { writer.component(name, component); });
  if (m.heating) writer.law("[heating]", "heating", *m.heating, false);
  writer.law("[artificial_viscosity]", "artificial_viscosity", m.artificial_viscosity, false);
  return writer.take();
}

std::string write_material(const Material& material, std::string_view source) {
  MaterialFile file{material, "", {}, {}};
  file.sources["equation_of_state"] = source;
  for_each_component_of(material, [&]<class Component>(const std::string& name, const Component& component) {
    if constexpr (is_vector<Component>::value) {
      for (std::size_t i = 0; i < component.size(); ++i) file.sources[name + '.' + std::to_string(i)] = source;
    } else {
      file.sources[name] = source;
    }
  });
  file.sources["heating"] = source;
  return write_material(file);
}

}  // namespace brisance
