#pragma once
// What the command lines of the programs have in common.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "models/input/diagnostics.hpp"
#include "models/input/units.hpp"

namespace brisance {

/// The option that replaces values of an input file.
inline void add_set(CLI::App* command, std::vector<std::string>& overrides, const char* help) {
  command->add_option("--set", overrides, help)->type_name("KEY=VALUE")->allow_extra_args(false);
}

/// What is wrong with a word that the command does not take.
inline std::string unexpected(const CLI::App& command, const std::string& word, std::span<char* const> words) {
  if (word.starts_with('-')) {
    std::vector<std::string> options;
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    const std::vector<std::string_view> names(options.begin(), options.end());
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("{}: {} is no option; there are {}{}", command.get_name(), in_quotes(name), listed(names),
                       did_you_mean(name, names));
  }
  // A value in two words: option, word, word. The second is the stray one, or has taken the place of it: "k=8", "mm", "sod".
  const auto is_of_number = [](std::string_view next, std::string_view given) {
    return !given.empty() && given.back() >= '0' && given.back() <= '9' && is_unit(next);
  };
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::string_view name = words[i - 2], given = words[i - 1], next = words[i];
    const CLI::Option* option = name.starts_with('-') ? command.get_option_no_throw(std::string(name)) : nullptr;
    if (!option || option->get_expected_min() == 0 || given.starts_with('-') || next.starts_with('-')) continue;
    if (next == word || is_of_number(next, given))
      return fmt::format("{}: {} was not expected; a value with spaces stands in quotes: {} \"{} {}\"", command.get_name(),
                         in_quotes(next), name, given, next);
  }
  return fmt::format("{}: {} was not expected", command.get_name(), in_quotes(word));
}

/// Reads a command line and runs its command. False if it is a wrong one, about which the user has been told; throws
/// std::invalid_argument if it holds a word that is no command, no option or one too many.
inline bool parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::ParseError& error) {
    if (argc == 1) {
      fmt::print(stderr, "{}", app.help());
      return false;
    }
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
    const std::vector<std::string_view> names(commands.begin(), commands.end());
    if (argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end())
      throw std::invalid_argument(
          fmt::format("{} is no command; there are {}{}", in_quotes(argv[1]), listed(names), did_you_mean(argv[1], names)));
    if (const auto extra = app.remaining(true); !extra.empty() && error.get_exit_code() != 0) {
      const auto given = app.get_subcommands();
      throw std::invalid_argument(
          unexpected(given.empty() ? app : *given.front(), extra.front(), std::span(argv + 1, argv + argc)));
    }
    return app.exit(error) == 0;  // 0: help was asked for
  }
}

}  // namespace brisance
