#pragma once
// What the command lines of the programs have in common.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "models/input/diagnostics.hpp"

namespace brisance {

/// Reads a command line and runs its command. False if it is a wrong one, about which the user has been told; throws
/// std::invalid_argument if its first word is no command.
inline bool parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::ParseError& error) {
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
    const std::vector<std::string_view> names(commands.begin(), commands.end());
    const bool is_word = argc > 1 && argv[1][0] != '-';
    if (is_word && std::find(names.begin(), names.end(), argv[1]) == names.end())
      throw std::invalid_argument(
          fmt::format("{} is no command; there are {}{}", in_quotes(argv[1]), listed(names), did_you_mean(argv[1], names)));
    return app.exit(error) == 0;  // 0: help was asked for
  }
}

}  // namespace brisance
