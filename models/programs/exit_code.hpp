#pragma once
// How the programs end.

#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <stdexcept>

#include "models/input/diagnostics.hpp"

namespace brisance {

/// Exit codes of the programs.
enum ExitCode : int { done = 0, failed_while_running = 1, bad_input = 2, interrupted = 3 };

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
