#include "simulator/keys.hpp"

#include <algorithm>
#include <span>
#include <variant>

#include "simulator/gas/fields.hpp"

namespace brisance::simulator {
namespace {

class Describer : public KeyDescriber<Describer> {
 private:
  friend KeyDescriber<Describer>;
  using KeyDescriber<Describer>::describe;

  template <class K>
  void describe(const std::string& path, const K& key, const std::filesystem::path&) {
    add(path, key, "the name of a file");
  }
  /// Fields of solids, or of gas.
  template <class K>
  void describe_fields(const std::string& path, const K& key, std::string_view what, std::span<const std::string_view> fields,
                       std::string default_value = "") {
    std::vector<std::string_view> words(fields.begin(), fields.end());
    for (const std::string_view field : gas_field_names())
      if (std::find(words.begin(), words.end(), field) == words.end()) words.push_back(field);
    add(path, key,
        std::string(what) + " of " + listed(fields) + "; of gas " + listed(gas_field_names()) +
            " (its part of the volume, of several fluids)",
        std::move(default_value), words);
  }
  /// The only list of texts that names no fields.
  void describe(const std::string& path, const Key<Case, std::vector<std::string>>& key, const std::vector<std::string>&) {
    add(path, key, "a list of texts such as \"cell_size=1 mm\"");
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::vector<std::string>&) {
    const std::span all(gauge_fields);
    describe_fields(path, key, "a list of texts, each one",
                    std::is_same_v<K, Key<FigureConfig, std::vector<std::string>>> ? all.subspan(1) : all);
  }
  /// The only text of the output is figure_field.
  void describe(const std::string& path, const Key<OutputConfig, std::string>& key, const std::string& fresh) {
    describe_fields(path, key, "one", scalar_fields(), fresh + ", of gas density");
  }
  /// What was measured has the unit of its kind.
  void describe(const std::string& path, const Key<MeasureConfig, std::optional<double>>& key, const std::optional<double>&) {
    add(path, key,
        key.member == &MeasureConfig::measured
            ? "a number in the SI unit of the kind or a text such as \"9 mm\" or \"2 kPa\", > 0"
            : numbers(key));
  }
  template <class K>
  void describe(const std::string& path, const K& key, const Vector&) {
    const bool three = key.components == Components::three;
    add(path, key,
        std::string(three ? "a list of 3 components" : "a list of 1 to 3 components, by geometry") + ", each " + numbers(key),
        "0");
  }
  template <class Config, class T>
  static std::string formula_of(const Key<Config, T>&) {
    const bool edge = std::is_same_v<Config, EdgeConfig>;
    return std::string(", or a formula in SI units such as ") + (edge ? "\"1 + 0.1*sin(2*pi*t)\"" : "\"1 + exp(-x^2)\"") +
           " in x, y, z, r (distance from the origin)" + (edge ? ", t" : "") +
           " and pi, with + - * / ^, a ? b : c and functions such as sqrt, exp, ln, sin, cos (`brisance describe formula`)";
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<Varying>&) {
    add(path, key, numbers(key) + formula_of(key));
  }
  template <class K>
  void describe(const std::string& path, const K& key, const VaryingVector&) {
    add(path, key, "a list of 1 to 3 components, by geometry, each " + numbers(key) + formula_of(key), "0");
  }
  template <class K>
  void describe(const std::string& path, const K& key, const Table&) {
    add(path, key, numbers(key) + ", or { time = [...], value = [...] }");
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<Table>&) {
    describe(path, key, Table{});
  }
  template <class K>
  void describe(const std::string& path, const K& key, const MaterialFile&) {
    add(path, key, "a text, or a table with the keys of a material file");
    rows_.push_back({path + "_changes", "a list of texts such as \"flow_stress.A = 95 MPa\"", "",
                     "values that differ from those of the material file"});
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<InitialPorosity>&) {
    std::string laws;
    [&]<class... Law>(std::type_identity<std::variant<Law...>>) {
      ((laws += (laws.empty() ? "" : ", ") + std::string(Law::name)), ...);
    }(std::type_identity<InitialPorosity>{});
    add(path, key, "a table { law = ..., ... } of " + laws);
  }
  template <class K>
  void describe(const std::string& path, const K& key, const ShapePointer&) {
    add(path, key, "a table with one of " + listed(shape_forms));
    if (!key.required) return;  // once is enough
    describe_all<Box>(path + ".box");
    describe_all<Cylinder>(path + ".cylinder");
    describe_all<Cone>(path + ".cone");
    describe_all<Sphere>(path + ".sphere");
    describe_all<Tube>(path + ".tube");
    rows_.push_back({path + ".union", "a list of shapes", "required", "all that one of them fills"});
    rows_.push_back({path + ".intersection", "a list of shapes", "required", "all that each of them fills"});
    rows_.push_back({path + ".difference.from", "a shape", "required", "what is cut"});
    rows_.push_back({path + ".difference.without", "a list of shapes", "required", "what is taken away"});
  }
  template <class K>
  void describe(const std::string& path, const K& key, const InitialVelocity&) {
    add(path, key, "components, each " + numbers(key) + "; or a table", "0");
    describe_all<InitialVelocity>(path);
  }
};

}  // namespace

const std::vector<std::string_view>& gas_field_names() {
  static const std::vector<gas::Field> fields = gas::fields(1, {"FLUID", "..."});
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const gas::Field& field : std::span(fields).first(fields.size() - 1)) all.push_back(field.name);
    return all;
  }();
  return names;
}

std::vector<std::string_view> scalar_fields() {
  std::vector<std::string_view> scalars;
  for (const std::string_view name : gauge_fields)
    if (name != "position" && name != "velocity") scalars.push_back(name);
  return scalars;
}

const std::vector<KeyDescription>& all_keys() {
  static const std::vector<KeyDescription> rows = [] {
    Describer describer;
    describer.describe_all<Case>("");
    return describer.take();
  }();
  return rows;
}

}  // namespace brisance::simulator
