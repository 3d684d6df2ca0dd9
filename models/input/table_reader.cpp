#include "models/input/table_reader.hpp"

#include <algorithm>
#include <cmath>

#include "models/input/units.hpp"

namespace brisance {
namespace {

constexpr std::size_t most_elements_reported = 5;  // of one list

std::string in_unit(double value, Unit unit) {
  return shortest_text(value) + (unit.text == Unit::one.text ? "" : ' ' + std::string(unit.text));
}

/// The texts that may be written for a quantity, with its interval if that says more than "finite".
std::string allowed_for(const Quantity& quantity) {
  const bool bounded = std::isfinite(quantity.interval.lower) || std::isfinite(quantity.interval.upper);
  return allowed_texts(quantity.unit) + (bounded ? ", " + describe(quantity.interval) : "");
}

/// For what is never written as a text.
std::string without_quotes(const TomlNode& node) {
  return std::holds_alternative<std::string>(node.value) ? ", without quotes" : "";
}

std::string describe(Length length) {
  const std::string noun = length.most == 1 ? " element" : " elements";
  if (length.least == length.most) return std::to_string(length.least) + noun;
  if (length.most == Length{}.most)
    return "at least " + std::to_string(length.least) + (length.least == 1 ? " element" : " elements");
  return std::to_string(length.least) + " to " + std::to_string(length.most) + noun;
}

}  // namespace

// --- Reporting --------------------------------------------------------------------------------------------------------

void TableReader::note(Place place, const std::string& path, std::string what) {
  if (place.line == Place::command_line)
    owner_->problems_.push_back({"--set " + path, 0, 0, "", std::move(what)});
  else
    owner_->problems_.push_back({owner_->path_.string(), place.line, place.column, path, std::move(what)});
}

void TableReader::report(Place place, const std::string& path, std::string what) {
  note(place, path, std::move(what));
  owner_->unreadable_.push_back(path);
}

void TableReader::refuse(Place place, const std::string& path, std::string what) {
  note(place, path, std::move(what));
  owner_->refused_.push_back(path);
}

void TableReader::wrong_type(const TomlNode& node, const std::string& path, const std::string& required,
                             const std::string& hint) {
  report(node.place, path, "this is " + kind_of(node) + "; " + required + " is required" + hint);
}

void TableReader::problem(std::string_view key, std::string what) {
  const TomlEntry* const entry = table_ ? table_->find(key) : nullptr;
  refuse(entry ? entry->node.place : place_, path_of(key), std::move(what));
}

void TableReader::problem(std::string what) {
  refuse(place_, path_, std::move(what));
}

void TableReader::add_problems(std::string_view key, std::span<const Problem> problems) {
  owner_->other_problems_.insert(owner_->other_problems_.end(), problems.begin(), problems.end());
  if (!problems.empty()) owner_->refused_.push_back(path_of(key));
}

void TableReader::problem_of_file(std::string_view key, std::span<const Problem> problems) {
  if (problems.size() == 1 && problems.front().line == 0)
    return problem(key, "its file cannot be used: " + problems.front().text());
  problem(key, "its file cannot be used");
  add_problems(key, problems);
}

void TableReader::ignore_rest() {
  if (table_) table_->opened = false;
  const std::string within = path_.empty() ? "" : path_ + '.';
  std::erase_if(owner_->pending_, [&](const InputFile::Override& pending) { return pending.path.starts_with(within); });
}

std::size_t TableReader::problem_count() const {
  return owner_->problems_.size() + owner_->other_problems_.size();
}

bool TableReader::valid(std::initializer_list<std::string_view> keys) const {
  return table_ && std::all_of(keys.begin(), keys.end(), [&](std::string_view key) { return owner_->is_valid(path_of(key)); });
}

bool TableReader::valid_in_file(std::initializer_list<std::string_view> paths) const {
  return std::all_of(paths.begin(), paths.end(), [&](std::string_view path) { return owner_->is_valid(path); });
}

std::string TableReader::path_of(std::string_view key) const {
  return joined(path_, key);
}

const std::filesystem::path& TableReader::file() const {
  return owner_->path_;
}

// --- Finding keys -----------------------------------------------------------------------------------------------------

TomlEntry* TableReader::ask(std::string_view key) {
  if (!table_) return nullptr;
  if (std::find(table_->asked.begin(), table_->asked.end(), key) == table_->asked.end()) table_->asked.emplace_back(key);
  return table_->find(key);
}

TomlNode* TableReader::read(std::string_view key) {
  TomlEntry* const entry = ask(key);
  if (!entry) return nullptr;
  entry->read = true;
  return &entry->node;
}

TomlNode* TableReader::require(std::string_view key, std::string_view meaning, const std::string& allowed) {
  TomlNode* const node = read(key);
  if (!node && table_)
    report(place_, path_of(key), "missing" + (meaning.empty() ? "" : ": " + std::string(meaning)) + "; give " + allowed);
  return node;
}

bool TableReader::has(std::string_view key) {
  return ask(key) != nullptr;
}

bool TableReader::is_text(std::string_view key) {
  const TomlEntry* const entry = ask(key);
  return entry && std::holds_alternative<std::string>(entry->node.value);
}

bool TableReader::is_table(std::string_view key) {
  const TomlEntry* const entry = ask(key);
  return entry && std::holds_alternative<TomlTable>(entry->node.value);
}

bool TableReader::is_list(std::string_view key) {
  const TomlEntry* const entry = ask(key);
  return entry && std::holds_alternative<TomlList>(entry->node.value);
}

std::vector<std::string> TableReader::keys() {
  std::vector<std::string> result;
  if (table_)
    for (const TomlEntry& entry : table_->entries) result.push_back(entry.key);
  return result;
}

// --- Numbers ----------------------------------------------------------------------------------------------------------

std::optional<double> TableReader::number_in(const TomlNode& node, const std::string& path, const Quantity& quantity) {
  double value;
  std::string written;
  if (const auto* const real = std::get_if<double>(&node.value)) {
    value = *real, written = in_unit(value, quantity.unit);
  } else if (const auto* const integer = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*integer), written = in_unit(value, quantity.unit);
  } else if (const auto* const text = std::get_if<std::string>(&node.value)) {
    try {
      value = to_si(*text, quantity.unit), written = in_quotes(*text);
    } catch (const UnitError& error) {
      report(node.place, path, error.what());
      return std::nullopt;
    }
  } else {
    report(node.place, path,
           "this is " + kind_of(node) + ", not " + quantity_of(quantity.unit) + "; give " + allowed_for(quantity));
    return std::nullopt;
  }
  if (!std::isfinite(value)) {
    report(node.place, path, shortest_text(value) + " is not a finite number; give " + allowed_for(quantity));
    return std::nullopt;
  }
  if (!quantity.interval.contains(value)) {
    const std::string unit = quantity.unit.text == Unit::one.text ? "" : " (in " + std::string(quantity.unit.text) + ')';
    report(node.place, path, written + " is out of range; it must be " + describe(quantity.interval) + unit);
    return std::nullopt;
  }
  return value;
}

double TableReader::number(std::string_view key, const Quantity& quantity) {
  const TomlNode* const node = require(key, quantity.meaning, allowed_for(quantity));
  return node ? number_in(*node, path_of(key), quantity).value_or(0.0) : 0.0;
}

std::optional<double> TableReader::optional_number(std::string_view key, const Quantity& quantity) {
  const TomlNode* const node = read(key);
  return node ? number_in(*node, path_of(key), quantity) : std::nullopt;
}

double TableReader::number_or(std::string_view key, double default_value, const Quantity& quantity) {
  return optional_number(key, quantity).value_or(default_value);
}

NumberOrText TableReader::number_or_text_in(const TomlNode& node, const std::string& path, const Quantity& quantity) {
  const auto* const text = std::get_if<std::string>(&node.value);
  if (text && !is_number_with_unit(*text)) return {0.0, *text};
  if (text && (text->find(" + ") != std::string::npos || text->find(" - ") != std::string::npos)) {
    report(node.place, path,
           in_quotes(*text) +
               " is neither a number with a unit nor a formula: in a formula numbers have no units; write them in SI");
    return {};
  }
  return {number_in(node, path, quantity).value_or(0.0), ""};
}

NumberOrText TableReader::number_or_text(std::string_view key, const Quantity& quantity) {
  const TomlNode* const node = require(key, quantity.meaning, allowed_for(quantity) + ", or a formula");
  return node ? number_or_text_in(*node, path_of(key), quantity) : NumberOrText{};
}

std::vector<NumberOrText> TableReader::numbers_or_texts(std::string_view key, const Quantity& quantity, Length length) {
  const std::string elements = allowed_for(quantity) + ", or a formula";
  const TomlNode* const node = require(key, quantity.meaning, "a list of " + describe(length) + ", each " + elements);
  const TomlList* const list = node ? list_in(*node, path_of(key), length, elements) : nullptr;
  std::vector<NumberOrText> result;
  for (std::size_t i = 0; list && i < list->size(); ++i)
    result.push_back(number_or_text_in((*list)[i], joined(path_of(key), std::to_string(i)), quantity));
  return result;
}

int TableReader::integer_or(std::string_view key, int default_value, int lowest, int highest) {
  const TomlNode* const node = read(key);
  if (!node) return default_value;
  const auto* const value = std::get_if<std::int64_t>(&node->value);
  const std::string allowed = "a whole number between " + std::to_string(lowest) + " and " + std::to_string(highest);
  if (!value) {
    wrong_type(*node, path_of(key), allowed, without_quotes(*node));
    return default_value;
  }
  if (*value < lowest || *value > highest) {
    report(node->place, path_of(key), std::to_string(*value) + " is out of range; it must be " + allowed);
    return default_value;
  }
  return static_cast<int>(*value);
}

int TableReader::integer(std::string_view key, int lowest, int highest) {
  require(key, "", "a whole number between " + std::to_string(lowest) + " and " + std::to_string(highest));
  return integer_or(key, lowest, lowest, highest);
}

bool TableReader::flag_or(std::string_view key, bool default_value) {
  const TomlNode* const node = read(key);
  if (!node) return default_value;
  const bool* const value = std::get_if<bool>(&node->value);
  if (!value) wrong_type(*node, path_of(key), "true or false", without_quotes(*node));
  return value ? *value : default_value;
}

bool TableReader::flag(std::string_view key) {
  require(key, "", "true or false");
  return flag_or(key, false);
}

// --- Texts ------------------------------------------------------------------------------------------------------------

std::optional<std::string> TableReader::optional_text(std::string_view key) {
  const TomlNode* const node = read(key);
  if (!node) return std::nullopt;
  const auto* const value = std::get_if<std::string>(&node->value);
  if (!value) {
    wrong_type(*node, path_of(key), "a text in quotes");
    return std::nullopt;
  }
  if (value->find_first_not_of(" \t\r\n") == std::string::npos) {
    report(node->place, path_of(key), "the text is empty");
    return std::nullopt;
  }
  return *value;
}

std::string TableReader::text(std::string_view key, std::string_view meaning) {
  require(key, meaning, "a text in quotes");
  return optional_text(key).value_or("");
}

std::string TableReader::text_or(std::string_view key, std::string_view default_value) {
  return optional_text(key).value_or(std::string(default_value));
}

std::size_t TableReader::choice(std::string_view key, std::span<const std::string_view> names,
                                std::optional<std::size_t> default_value) {
  const std::string allowed = (names.size() == 1 ? "" : "one of ") + listed(names);
  const TomlNode* const node = default_value ? read(key) : require(key, "", allowed);
  const std::size_t otherwise = default_value.value_or(0);
  if (!node) return otherwise;
  const auto* const value = std::get_if<std::string>(&node->value);
  if (!value) {
    wrong_type(*node, path_of(key), allowed + " (in quotes)");
    return otherwise;
  }
  const auto found = std::find(names.begin(), names.end(), *value);
  if (found == names.end()) {
    report(node->place, path_of(key), in_quotes(*value) + " is unknown; it must be " + allowed + did_you_mean(*value, names));
    return otherwise;
  }
  return static_cast<std::size_t>(found - names.begin());
}

// --- Lists ------------------------------------------------------------------------------------------------------------

const TomlList* TableReader::list_in(const TomlNode& node, const std::string& path, Length length,
                                     const std::string& elements) {
  const auto* const list = std::get_if<TomlList>(&node.value);
  const std::string allowed = "a list of " + describe(length) + ", each " + elements;
  if (!list) {
    wrong_type(node, path, allowed);
    return nullptr;
  }
  if (list->size() < length.least || list->size() > length.most)
    report(node.place, path,
           (list->empty() ? std::string("the list is empty")
                          : "the list has " + std::to_string(list->size()) + (list->size() == 1 ? " element" : " elements")) +
               "; give " + allowed);
  return list;
}

std::vector<double> TableReader::numbers_in(const TomlNode& node, const std::string& path, const Quantity& quantity,
                                            Length length) {
  const TomlList* const list = list_in(node, path, length, allowed_for(quantity));
  std::vector<double> result(std::clamp(list ? list->size() : 0, length.least, length.most), 0.0);
  std::size_t reported = 0;
  for (std::size_t i = 0; list && i < list->size() && reported < most_elements_reported; ++i) {
    const auto value = number_in((*list)[i], joined(path, std::to_string(i)), quantity);
    if (!value)
      ++reported;
    else if (i < result.size())
      result[i] = *value;
  }
  return result;
}

std::vector<double> TableReader::numbers(std::string_view key, const Quantity& quantity, Length length) {
  const TomlNode* const node =
      require(key, quantity.meaning, "a list of " + describe(length) + ", each " + allowed_for(quantity));
  return node ? numbers_in(*node, path_of(key), quantity, length) : std::vector<double>(length.least, 0.0);
}

std::optional<std::vector<double>> TableReader::optional_numbers(std::string_view key, const Quantity& quantity,
                                                                 Length length) {
  const TomlNode* const node = read(key);
  if (!node) return std::nullopt;
  return numbers_in(*node, path_of(key), quantity, length);
}

std::vector<std::vector<double>> TableReader::rows(std::string_view key, const Quantity& quantity, Length rows,
                                                   std::size_t columns) {
  const std::string elements = "a list of " + describe(exactly(columns));
  const TomlNode* const node = require(key, quantity.meaning, "a list of " + describe(rows) + ", each " + elements);
  const TomlList* const list = node ? list_in(*node, path_of(key), rows, elements) : nullptr;
  if (!list) return std::vector(rows.least, std::vector<double>(columns, 0.0));
  std::vector<std::vector<double>> result;
  for (std::size_t i = 0; i < list->size(); ++i)
    result.push_back(numbers_in((*list)[i], joined(path_of(key), std::to_string(i)), quantity, exactly(columns)));
  result.resize(std::clamp(result.size(), rows.least, rows.most), std::vector<double>(columns, 0.0));
  return result;
}

std::vector<std::string> TableReader::texts_in(const TomlNode& node, const std::string& path, Length length) {
  const TomlList* const list = list_in(node, path, length, "a text in quotes");
  std::vector<std::string> result;
  std::size_t reported = 0;
  for (std::size_t i = 0; list && i < list->size() && reported < most_elements_reported; ++i) {
    const auto* const value = std::get_if<std::string>(&(*list)[i].value);
    if (!value) wrong_type((*list)[i], joined(path, std::to_string(i)), "a text in quotes"), ++reported;
    result.push_back(value ? *value : "");
  }
  return result;
}

std::vector<std::string> TableReader::texts(std::string_view key, Length length) {
  const TomlNode* const node = require(key, "", "a list of " + describe(length) + ", each a text in quotes");
  return node ? texts_in(*node, path_of(key), length) : std::vector<std::string>(length.least);
}

std::optional<std::vector<std::string>> TableReader::optional_texts(std::string_view key, Length length) {
  const TomlNode* const node = read(key);
  if (!node) return std::nullopt;
  return texts_in(*node, path_of(key), length);
}

// --- Tables -----------------------------------------------------------------------------------------------------------

TableReader TableReader::open(TomlNode& node, std::string path) {
  auto* const table = std::get_if<TomlTable>(&node.value);
  if (table) table->opened = true;
  return TableReader(owner_, table, std::move(path), node.place);
}

std::optional<TableReader> TableReader::optional_table(std::string_view key) {
  TomlNode* const node = read(key);
  if (!node) return std::nullopt;
  if (!std::holds_alternative<TomlTable>(node->value)) wrong_type(*node, path_of(key), "a table [" + path_of(key) + ']');
  return open(*node, path_of(key));
}

TableReader TableReader::table(std::string_view key, std::string_view meaning) {
  require(key, meaning, "a table [" + path_of(key) + ']');
  const auto found = optional_table(key);
  return found ? *found : TableReader(owner_, nullptr, path_of(key), place_);
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  std::vector<TableReader> result;
  TomlNode* const node = read(key);
  if (!node) return result;
  const std::string required = "a list of tables, each begun by [[" + path_of(key) + "]],";
  auto* const list = std::get_if<TomlList>(&node->value);
  if (!list) wrong_type(*node, path_of(key), required);
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const std::string path = joined(path_of(key), std::to_string(i));
    if (std::holds_alternative<TomlTable>((*list)[i].value)) {
      result.push_back(open((*list)[i], path));
    } else {
      wrong_type((*list)[i], path, "a table");
      if (result.size() + most_elements_reported <= i) break;
    }
  }
  return result;
}

Table TableReader::piecewise(std::string_view key, const Quantity& value, std::string_view abscissa_name,
                             const Quantity& abscissa) {
  Table result;
  result.size = 1;
  if (!is_table(key)) {
    const std::string table = " or a table { " + std::string(abscissa_name) + " = [...], value = [...] }";
    TomlNode* const node = require(key, value.meaning, allowed_for(value) + table);
    if (node && std::holds_alternative<TomlList>(node->value))
      wrong_type(*node, path_of(key), quantity_of(value.unit) + table);
    else if (node)
      result.y[0] = number_in(*node, path_of(key), value).value_or(0.0);
    return result;
  }
  TableReader knots = table(key);
  const std::size_t before = problem_count();
  const Length length{1, Table::capacity};
  const std::vector<double> x = knots.numbers(abscissa_name, abscissa, length), y = knots.numbers("value", value, length);
  if (problem_count() > before) return result;
  if (x.size() != y.size()) {
    knots.problem("value", "the list has " + std::to_string(y.size()) + " elements; as many as in " +
                               std::string(abscissa_name) + " are required, " + std::to_string(x.size()));
    return result;
  }
  std::size_t reported = 0;
  for (std::size_t i = 1; i < x.size() && reported < most_elements_reported; ++i) {
    if (x[i] > x[i - 1]) continue;
    knots.problem(abscissa_name, "element " + std::to_string(i) + " is " + shortest_text(x[i]) + " after " +
                                     shortest_text(x[i - 1]) + "; each element must be larger than the one before");
    ++reported;
  }
  if (reported > 0) return result;
  result.size = static_cast<int>(x.size());
  std::copy(x.begin(), x.end(), result.x.begin());
  std::copy(y.begin(), y.end(), result.y.begin());
  return result;
}

}  // namespace brisance
