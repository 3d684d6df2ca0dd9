#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "models/input/toml_tree.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/keys.hpp"

namespace brisance::simulator {
namespace {

template <class List, class Text>
std::string toml_list(const List& list, Text&& text) {
  std::string result = "[";
  for (const auto& element : list) result += (result.size() > 1 ? ", " : "") + text(element);
  return result + ']';
}

/// What stands under a header of its own.
template <class T>
constexpr bool is_section =
    std::is_same_v<T, NumericsConfig> || std::is_same_v<T, OutputConfig> || std::is_same_v<T, GateConfig>;
template <class T>
constexpr bool is_optional_section = std::is_same_v<T, std::optional<GasConfig>>;
template <class T>
constexpr bool is_list_of_sections = false;
template <class T>
constexpr bool is_list_of_sections<std::vector<T>> = !std::is_same_v<T, std::string>;

class CaseWriter {
 public:
  explicit CaseWriter(const Case& c) : case_(c) {}

  std::string write() {
    lines(case_, "");
    return std::move(text_);
  }

 private:
  // --- Values on one line; empty where the key is left out ------------------------------------------------------------

  static std::string value(double x, Components) { return toml_number(x); }
  static std::string value(bool x, Components) { return x ? "true" : "false"; }
  static std::string value(int x, Components) { return std::to_string(x); }
  static std::string value(std::uint64_t x, Components) { return std::to_string(x); }
  static std::string value(const std::string& text, Components) { return text.empty() ? "" : toml_text(text); }
  static std::string value(const std::filesystem::path& path, Components) {
    return path.empty() ? "" : toml_text(path.generic_string());
  }
  static std::string value(const std::vector<std::string>& texts, Components) {
    return texts.empty() ? "" : toml_list(texts, toml_text);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  static std::string value(Enum x, Components) { return toml_text(choices<Enum>[static_cast<std::size_t>(x)]); }
  std::string value(const Vector& v, Components components) const {
    const int count = components == Components::three ? 3 : case_.dimensions();
    return toml_list(std::vector<double>(v.begin(), v.begin() + count), toml_number);
  }
  static std::string text_of(const Varying& x) { return x.formula ? toml_text(x.formula->text()) : toml_number(x.number); }
  static std::string value(const Varying& x, Components) { return text_of(x); }
  std::string value(const VaryingVector& v, Components) const {
    const auto begin = v.components.begin();
    return toml_list(std::vector<Varying>(begin, begin + case_.dimensions()), text_of);
  }
  static std::string value(const Table& table, Components) {
    if (table.size == 0) return "";
    if (table.size == 1 && table.x[0] == 0.0) return toml_number(table.y[0]);
    const auto knots = [&](const auto& numbers) {
      return toml_list(std::vector<double>(numbers.begin(), numbers.begin() + table.size), toml_number);
    };
    return "{time = " + knots(table.x) + ", value = " + knots(table.y) + '}';
  }
  template <class T>
  std::string value(const std::optional<T>& x, Components components) const {
    return x ? value(*x, components) : "";
  }
  std::string value(const InitialVelocity& velocity, Components) const { return inline_table(velocity); }
  std::string value(const StrengthDistribution& strength, Components) const { return inline_table(strength); }
  std::string value(const ProfileConfig& profile, Components) const { return inline_table(profile); }
  static std::string value(const InitialPorosity& porosity, Components) {
    return std::visit(
        []<class Law>(const Law& law) {
          std::string result = "{law = " + toml_text(Law::name);
          for_each_parameter<Law>(
              [&](const auto& row) { result += ", " + std::string(row.name) + " = " + toml_number(law.*row.member); });
          return result + '}';
        },
        porosity);
  }

  template <class Config>
  std::string inline_table(const Config& config) const {
    std::string result;
    for_each_key<Config>([&](const auto& key) {
      result += (result.empty() ? "{" : ", ") + std::string(key.name) + " = " + value(config.*key.member, key.components);
    });
    return result + '}';
  }

  std::string value(const ShapePointer& shape, Components) const {
    return shape ? std::visit([&](const auto& form) { return '{' + form_of(form) + '}'; }, shape->form) : "";
  }
  std::string form_of(const Box& box) const { return "box = " + inline_table(box); }
  std::string form_of(const Cone& cone) const { return "cone = " + inline_table(cone); }
  std::string form_of(const Sphere& sphere) const { return "sphere = " + inline_table(sphere); }
  std::string form_of(const Union& form) const { return "union = " + parts(form.parts); }
  std::string form_of(const Intersection& form) const { return "intersection = " + parts(form.parts); }
  std::string form_of(const Difference& form) const {
    return "difference = {from = " + value(form.from, {}) + ", without = " + parts(form.without) + '}';
  }
  std::string parts(const std::vector<ShapePointer>& shapes) const {
    return toml_list(shapes, [&](const ShapePointer& shape) { return value(shape, {}); });
  }

  // --- Tables ---------------------------------------------------------------------------------------------------------

  /// The lines of a table, then the tables within it.
  template <class Config>
  void lines(const Config& config, const std::string& path) {
    for_each_key<Config>([&]<class T>(const Key<Config, T>& key) {
      if constexpr (!is_section<T> && !is_optional_section<T> && !is_list_of_sections<T> && !std::is_same_v<T, MaterialFile>) {
        const std::string written = value(config.*key.member, key.components);
        if (!written.empty()) text_ += std::string(key.name) + " = " + written + comment(key.unit, key.meaning) + '\n';
      }
    });
    for_each_key<Config>([&]<class T>(const Key<Config, T>& key) {
      const std::string inner = (path.empty() ? "" : path + '.') + std::string(key.name);
      if constexpr (std::is_same_v<T, MaterialFile>) {
        material(config.*key.member, inner);
      } else if constexpr (is_section<T>) {
        text_ += "\n[" + inner + "]\n";
        lines(config.*key.member, inner);
      } else if constexpr (is_optional_section<T>) {
        if (config.*key.member) {
          text_ += "\n[" + inner + "]\n";
          lines(*(config.*key.member), inner);
        }
      } else if constexpr (is_list_of_sections<T>) {
        for (const auto& element : config.*key.member) {
          text_ += "\n[[" + inner + "]]\n";
          lines(element, inner);
        }
      }
    });
  }

  static std::string comment(Unit unit, std::string_view meaning) {
    return "  # " + (unit.text == Unit::one.text ? "" : std::string(unit.text) + "; ") + std::string(meaning);
  }

  /// A material file whose tables stand below `path`. Every line of it is a header or a key: texts have no line breaks.
  void material(const MaterialFile& file, const std::string& path) {
    text_ += "\n[" + path + "]\n";
    const std::string written = write_material(file);
    for (std::size_t begin = 0; begin < written.size();) {
      const std::size_t end = std::min(written.find('\n', begin), written.size());
      const std::string line = written.substr(begin, end - begin);
      const std::size_t brackets = line.starts_with("[[") ? 2 : line.starts_with('[') ? 1 : 0;
      text_ += line.substr(0, brackets) + (brackets > 0 ? path + '.' : "") + line.substr(brackets) + '\n';
      begin = end + 1;
    }
  }

  const Case& case_;
  std::string text_;
};

}  // namespace

std::string write_case(const Case& c) {
  return CaseWriter(c).write();
}

}  // namespace brisance::simulator
