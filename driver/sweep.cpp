#include "driver/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "driver/hdf5_file.hpp"
#include "driver/keys.hpp"
#include "models/input/toml_tree.hpp"

namespace brisance::driver {
namespace {

struct SweepAxis {
  std::string key;
  std::vector<std::string> values;  // as text of TOML
};

std::vector<SweepAxis> read_axes(const std::filesystem::path& file) {
  TomlNode root = parse_toml(read_text_file(file), file.string());
  std::vector<SweepAxis> axes;
  TomlEntry* sweep = std::get<TomlTable>(root.value).find("sweep");
  if (!sweep) return axes;
  std::vector<Problem> problems;
  const auto wrong = [&](const TomlNode& node, const std::string& key, const std::string& what) {
    problems.push_back({file.string(), node.place.line, node.place.column, key, what});
  };
  auto* table = std::get_if<TomlTable>(&sweep->node.value);
  if (!table || table->entries.empty())
    wrong(sweep->node, "sweep", "must be a table of lists, as in \"initial.temperature\" = [77, 298]");
  for (const TomlEntry& entry : table ? table->entries : std::vector<TomlEntry>{}) {
    const auto* list = std::get_if<TomlList>(&entry.node.value);
    if (!list || list->empty()) {
      wrong(entry.node, entry.key, "must be a list of values; a dotted key stands in quotes, as in \"initial.temperature\"");
      continue;
    }
    SweepAxis axis{entry.key, {}};
    for (const TomlNode& value : *list) {
      if (const auto* number = std::get_if<double>(&value.value))
        axis.values.push_back(shortest_text(*number));
      else if (const auto* whole = std::get_if<std::int64_t>(&value.value))
        axis.values.push_back(fmt::format("{}", *whole));
      else if (const auto* text = std::get_if<std::string>(&value.value))
        axis.values.push_back(*text);
      else
        wrong(value, entry.key, "holds something that is neither a number nor a text");
    }
    axes.push_back(std::move(axis));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return axes;
}

/// "segment.0.strain_rate" to "segment.strain_rate".
std::string without_positions(const std::string& key) {
  std::string result;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const std::string part = key.substr(begin, end - begin);
    if (part.find_first_not_of("0123456789") != std::string::npos) result += (result.empty() ? "" : ".") + part;
    begin = end + 1;
  }
  return result;
}

std::optional<Unit> unit_of(const std::string& key, const Material& material) {
  constexpr std::string_view within = "material.";
  Unit unit;
  if (key.starts_with(within)) {
    Material copy = material;
    if (find_parameter(copy, std::string_view(key).substr(within.size()), nullptr, &unit)) return unit;
    return std::nullopt;
  }
  const std::string path = without_positions(key);
  for (const KeyDescription& known : file_kinds().front().keys)
    if (known.path == path || path.starts_with(known.path + '.')) unit = known.unit;  // the deepest comes last
  return unit;
}

void print_values(std::string& text, const SweptValues& values) {
  for (const SweptValue& v : values) text += ',' + (v.number ? shortest_text(*v.number) : v.text);
}

/// A table of the rows of members from `first_row` on: number and values of the member, then its columns.
template <class FirstRow>
void write_table(std::span<const SweepMember> members, const std::filesystem::path& path, FirstRow&& first_row) {
  std::string text = "member";
  for (const SweptValue& v : members.front().values) text += fmt::format(",{}", v.column());
  // Members of different materials may have different columns; the table has those of all.
  std::vector<Record::Series> columns;
  for (const SweepMember& member : members)
    for (const Record::Series& s : member.record.series)
      if (std::none_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == s.name; }))
        columns.push_back({s.name, s.unit, {}});
  for (const Record::Series& c : columns) text += fmt::format(",{} [{}]", c.name, c.unit);
  text += "\n";
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Record& record = members[m].record;
    for (std::size_t row = first_row(record); row < record.rows(); ++row) {
      text += fmt::format("{}", m + 1);
      print_values(text, members[m].values);
      for (const Record::Series& c : columns) {
        const Record::Series* own = record.find(c.name);
        text += fmt::format(",{}", own ? own->values[row] : std::numeric_limits<double>::quiet_NaN());
      }
      text += "\n";
    }
  }
  replace_file_by_text(path, text);
}

bool is_hdf5(const std::filesystem::path& path) {
  return path.extension() == ".h5" || path.extension() == ".hdf5";
}

}  // namespace

std::string SweptValue::name() const {
  const bool bare = number && text.find_first_not_of("0123456789.eE+-") == std::string::npos && !unit.empty() && unit != "1";
  return fmt::format("{} = {}{}", key.substr(key.rfind('.') + 1), text, bare ? " " + unit : "");
}

std::string SweptValue::column() const {
  return number ? fmt::format("{} [{}]", key, unit.empty() ? "1" : unit) : key;
}

std::vector<SweptValues> read_sweep(const std::filesystem::path& file) {
  const std::vector<SweepAxis> axes = read_axes(file);
  if (axes.empty()) return {};
  std::vector<SweptValues> members{{}};
  for (const SweepAxis& axis : axes) {
    std::vector<SweptValues> longer;
    for (const SweptValues& member : members)
      for (const std::string& value : axis.values) {
        longer.push_back(member);
        longer.back().push_back({axis.key, value, {}, ""});
      }
    members = std::move(longer);
  }
  return members;
}

void find_units(SweptValues& values, const Material& material) {
  for (SweptValue& v : values) {
    const std::optional<Unit> unit = unit_of(v.key, material);
    const bool plain = v.text.find_first_not_of("0123456789.eE+-") == std::string::npos;
    try {
      if (plain)
        v.number = UnitConversion("1", Unit::one)(v.text);
      else if (unit)
        v.number = to_si(v.text, *unit);
    } catch (const UnitError&) {
      continue;  // a word
    }
    if (unit) v.unit = unit->text;
  }
}

std::string name_of(const SweptValues& values) {
  std::string name;
  for (const SweptValue& v : values) name += (name.empty() ? "" : ", ") + v.name();
  return name;
}

void require_sweep_output(const std::filesystem::path& path) {
  require_folder_for(path);
  if (!path.empty() && path.has_extension() && path.extension() != ".csv" && !is_hdf5(path))
    throw std::invalid_argument(
        fmt::format("{}: the histories of a sweep go to a file that ends in .csv or .h5, or to a "
                    "directory, whose name has no ending",
                    path.string()));
}

void write_sweep(std::span<const SweepMember> members, const std::filesystem::path& path) {
  const auto every_row = [](const Record&) { return std::size_t{0}; };
  const auto last_row = [](const Record& record) { return record.rows() - 1; };
  if (path.extension() == ".csv") return write_table(members, path, every_row);
  if (is_hdf5(path)) return replace_file(path, [&](const std::filesystem::path& temporary) { write_hdf5(members, temporary); });
  for (std::size_t m = 0; m < members.size(); ++m) write_csv(members[m].record, path / fmt::format("member_{:03}.csv", m + 1));
  write_table(members, path / "sweep.csv", last_row);
}

}  // namespace brisance::driver
