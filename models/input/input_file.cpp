// InputFile of table_reader.hpp: overrides from the command line, unread keys, the list of problems.

#include <algorithm>
#include <charconv>
#include <tuple>
#include <utility>

#include "models/input/table_reader.hpp"

namespace brisance {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

/// Marks a value and all within it as coming from the command line.
void mark_overridden(TomlNode& node) {
  node.place = {Place::command_line, 0};
  if (auto* const table = std::get_if<TomlTable>(&node.value))
    for (TomlEntry& entry : table->entries) entry.key_place = node.place, mark_overridden(entry.node);
  if (auto* const list = std::get_if<TomlList>(&node.value))
    for (TomlNode& element : *list) mark_overridden(element);
}

/// The value of an override: TOML, or a plain text without quotes such as  20 us  or  green_naghdi .
TomlNode override_value(std::string_view text) {
  TomlNode result;
  try {
    TomlNode parsed = parse_toml("value = " + std::string(text), "");
    auto& entries = std::get<TomlTable>(parsed.value).entries;
    if (entries.size() != 1) throw InputError({{"", 0, 0, "", "one value is required"}});
    result = std::move(entries.front().node);
  } catch (const InputError& error) {
    if (text.empty()) throw InputError({{"", 0, 0, "", "the value is missing after \"=\""}});
    if (text.find_first_of("\"'[]{}\n") != std::string_view::npos) {
      const bool list = text.front() == '[' && text.back() == ']' && text.find_first_of("\"'") == std::string_view::npos;
      throw InputError(
          {{"", 0, 0, "",
            error.problems().front().what +
                (list ? "; the shell takes quotes away: write the whole in single quotes, as in --set 'key=[0, \"1 "
                        "mm\"]'"
                      : "")}});
    }
    result.value = std::string(text);
  }
  mark_overridden(result);
  return result;
}

}  // namespace

InputFile InputFile::load(const std::filesystem::path& path) {
  return from_text(read_text_file(path), path);
}

InputFile InputFile::from_text(std::string_view text, std::filesystem::path name) {
  TomlNode root = parse_toml(text, name.string());
  root.place = {};
  return InputFile(std::move(root), std::move(name));
}

TableReader InputFile::top() {
  auto& table = std::get<TomlTable>(root_.value);
  table.opened = true;
  return TableReader(this, &table, "", root_.place);
}

bool InputFile::is_valid(std::string_view path) const {
  const auto within = [](std::string_view inner, std::string_view outer) {
    return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
  };
  const auto any = [](const std::vector<std::string>& paths, auto&& concerns) {
    return std::any_of(paths.begin(), paths.end(), concerns);
  };
  return !any(unreadable_, [&](const std::string& wrong) { return within(wrong, path) || within(path, wrong); }) &&
         !any(refused_, [&](const std::string& wrong) { return within(wrong, path); });
}

void InputFile::report_override(std::string_view key, std::string what) {
  problems_.push_back({"--set " + printable(key), 0, 0, "", std::move(what)});
}

void InputFile::set(std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos) return report_override(assignment, "the value is missing; key=value is required");
  const std::string_view path = trimmed(assignment.substr(0, equals));
  TomlNode value;
  try {
    value = override_value(trimmed(assignment.substr(equals + 1)));
  } catch (const InputError& error) {
    return report_override(path, error.problems().front().what);
  }

  TomlNode* node = &root_;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string_view key = path.substr(begin, end - begin);
    const std::string_view so_far = path.substr(0, begin == 0 ? 0 : begin - 1);
    if (key.empty()) return report_override(path, "the key has an empty part; table.key or list.0.key is required");
    if (auto* const table = std::get_if<TomlTable>(&node->value)) {
      TomlEntry* entry = table->find(key);
      if (!entry) {
        constexpr Place here{Place::command_line, 0};
        table->entries.push_back({std::string(key), here, TomlNode{TomlTable{}, here}, false});
        entry = &table->entries.back();
      }
      if (end == path.size()) entry->key_place = {Place::command_line, 0};
      node = &entry->node;
    } else if (auto* const list = std::get_if<TomlList>(&node->value)) {
      std::size_t index = 0;
      const auto [last, error] = std::from_chars(key.data(), key.data() + key.size(), index);
      if (error != std::errc() || last != key.data() + key.size() || index >= list->size())
        return report_override(path, std::string(so_far) + " is a list of " + std::to_string(list->size()) +
                                         " elements, counted from 0; it has no element " + in_quotes(key));
      node = &(*list)[index];
    } else if (std::holds_alternative<std::string>(node->value) && !so_far.empty()) {
      pending_.push_back({std::string(so_far), std::string(path.substr(begin)) + std::string(assignment.substr(equals))});
      return;
    } else {
      return report_override(path, std::string(so_far) + " is " + kind_of(*node) + ", which has no parts");
    }
    begin = end + 1;
  }
  *node = std::move(value);
}

std::vector<std::string> TableReader::take_overrides(std::string_view key) {
  std::vector<std::string> result;
  const std::string path = path_of(key);
  std::erase_if(owner_->pending_, [&](const InputFile::Override& pending) {
    if (pending.path == path) result.push_back(pending.assignment);
    return pending.path == path;
  });
  return result;
}

void InputFile::report_unread(const TomlTable& table, const std::string& path) {
  const std::vector<std::string_view> known(table.asked.begin(), table.asked.end());
  for (const TomlEntry& entry : table.entries) {
    const std::string entry_path = joined(path, entry.key);
    if (!entry.read && table.opened) {
      std::string what = "unknown key";
      if (const std::string guess = did_you_mean(entry.key, known); !guess.empty())
        what += guess;
      else
        what += known.empty() ? "; no keys are known here" : "; the keys known here are " + listed(known);
      if (entry.key_place.line == Place::command_line)
        report_override(entry_path, what);
      else
        problems_.push_back({path_.string(), entry.key_place.line, entry.key_place.column, entry_path, what});
    } else if (const auto* const inner = std::get_if<TomlTable>(&entry.node.value)) {
      report_unread(*inner, entry_path);
    } else if (const auto* const list = std::get_if<TomlList>(&entry.node.value)) {
      for (std::size_t i = 0; i < list->size(); ++i)
        if (const auto* const element = std::get_if<TomlTable>(&(*list)[i].value))
          report_unread(*element, joined(entry_path, std::to_string(i)));
    }
  }
}

std::vector<Problem> InputFile::problems() {
  report_unread(std::get<TomlTable>(root_.value), "");
  for (const Override& pending : pending_)
    report_override(pending.path + '.' + pending.assignment.substr(0, pending.assignment.find('=')),
                    pending.path + " is a text, which has no parts");
  pending_.clear();
  // In the order of the file; what has no line comes first, the command line last.
  std::stable_sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
    const auto order = [](const Problem& p) { return std::tuple(p.file.starts_with("--set "), p.line, p.column); };
    return order(a) < order(b);
  });
  std::vector<Problem> all = std::exchange(problems_, {});
  all.insert(all.end(), other_problems_.begin(), other_problems_.end());
  other_problems_.clear();
  return all;
}

void InputFile::finish() {
  std::vector<Problem> all = problems();
  if (!all.empty()) throw InputError(std::move(all));
}

}  // namespace brisance
