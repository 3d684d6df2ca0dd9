#pragma once
// How the programs end.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "models/input/diagnostics.hpp"

namespace brisance {

/// Exit codes of the programs.
enum ExitCode : int { done = 0, failed_while_running = 1, bad_input = 2, interrupted = 3 };

/// What to say when the first word of a command line is none of the commands; empty if it is one, or an option, or missing.
inline std::string no_such_command(int argc, char** argv, const std::vector<std::string>& commands) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::vector<std::string_view> names(commands.begin(), commands.end());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return "";
  return fmt::format("{} is no command; there are {}{}", in_quotes(argv[1]), listed(names), did_you_mean(argv[1], names));
}

/// The exit code that f returns, or the one that belongs to what it throws, which is printed to standard error.
template <class F>
int exit_code_of(F&& f) {
  try {
    return f();
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "there is not enough memory for this; take a coarser case, or a machine with more\n");
    return failed_while_running;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return failed_while_running;
  }
}

}  // namespace brisance
