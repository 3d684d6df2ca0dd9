#include "simulator/keys.hpp"

#include <cstdint>
#include <type_traits>

#include "models/input/diagnostics.hpp"
#include "models/input/units.hpp"

namespace brisance::simulator {
namespace {

template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {};

template <class Config>
constexpr bool has_keys = std::tuple_size_v<decltype(keys<Config>)> > 0;

class Describer {
 public:
  template <class Config>
  void describe_all(const std::string& above) {
    const Config fresh{};
    for_each_key<Config>([&](const auto& key) {
      const std::string path = above.empty() ? std::string(key.name) : above + '.' + std::string(key.name);
      describe(path, key, fresh.*key.member);
    });
  }
  std::vector<KeyDescription> take() { return std::move(rows_); }

 private:
  template <class K>
  void add(const std::string& path, const K& key, std::string values, std::string default_value = "") {
    rows_.push_back({path, std::move(values), key.required ? "required" : std::move(default_value), std::string(key.meaning)});
  }
  template <class K>
  static std::string numbers(const K& key) {
    const std::string range = brisance::describe(key.interval);
    return allowed_texts(key.unit) + (range == brisance::describe(any_value) ? "" : ", " + range);
  }

  template <class K>
  void describe(const std::string& path, const K& key, double fresh) {
    add(path, key, numbers(key), shortest_text(fresh));
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<double>&) {
    add(path, key, numbers(key));
  }
  template <class K, class Integer>
  requires(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>) void describe(const std::string& path, const K& key,
                                                                                        Integer fresh) {
    add(path, key, "a whole number, " + brisance::describe(key.interval), std::to_string(fresh));
  }
  template <class K, class Bool>
  requires std::is_same_v<Bool, bool>
  void describe(const std::string& path, const K& key, Bool fresh) {
    add(path, key, "true or false", fresh ? "true" : "false");
  }
  template <class K, class Enum>
  requires std::is_enum_v<Enum>
  void describe(const std::string& path, const K& key, Enum fresh) {
    add(path, key, "one of " + listed(choices<Enum>), std::string(choices<Enum>[static_cast<std::size_t>(fresh)]));
  }
  template <class K, class T>
  requires(std::is_enum_v<T> || std::is_same_v<T, bool>) void describe(const std::string& path, const K& key,
                                                                       const std::optional<T>&) {
    describe(path, key, T{});
    rows_.back().default_value = "";
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::string& fresh) {
    add(path, key, "a text", fresh);
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::filesystem::path&) {
    add(path, key, "the name of a file");
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::vector<std::string>&) {
    add(path, key, "a list of texts, each one of " + listed(gauge_fields));
  }
  template <class K>
  void describe(const std::string& path, const K& key, const Vector&) {
    const bool three = key.components == Components::three;
    add(path, key,
        std::string(three ? "a list of 3 components" : "a list of 1 to 3 components, by geometry") + ", each " + numbers(key),
        "0");
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
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<StrengthDistribution>&) {
    add(path, key, "a table");
    describe_all<StrengthDistribution>(path);
  }
  template <class K>
  void describe(const std::string& path, const K& key, const std::optional<GasConfig>&) {
    describe(path, key, GasConfig{});
  }
  template <class K, class Config>
  requires has_keys<Config>
  void describe(const std::string& path, const K& key, const Config&) {
    add(path, key, "a table [" + path + ']');
    describe_all<Config>(path);
  }
  template <class K, class Config>
  void describe(const std::string& path, const K& key, const std::vector<Config>&) {
    add(path, key, "a list of tables [[" + path + "]]");
    describe_all<Config>(path);
  }

  std::vector<KeyDescription> rows_;
};

}  // namespace

const std::vector<KeyDescription>& all_keys() {
  static const std::vector<KeyDescription> rows = [] {
    Describer describer;
    describer.describe_all<Case>("");
    return describer.take();
  }();
  return rows;
}

std::vector<KeyDescription> describe_key(std::string_view path, std::string& suggestion) {
  std::vector<KeyDescription> found;
  const std::string below = std::string(path) + '.', last = '.' + std::string(path);
  for (const KeyDescription& row : all_keys())
    if (row.path == path || row.path.starts_with(below)) found.push_back(row);
  if (found.empty())
    for (const KeyDescription& row : all_keys())
      if (row.path.ends_with(last)) found.push_back(row);
  if (!found.empty()) return found;
  std::vector<std::string_view> names;
  for (const KeyDescription& row : all_keys()) {
    names.push_back(row.path);
    names.push_back(std::string_view(row.path).substr(row.path.rfind('.') + 1));
  }
  suggestion = did_you_mean(path, names);
  return found;
}

}  // namespace brisance::simulator
