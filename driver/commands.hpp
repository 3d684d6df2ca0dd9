#pragma once
// The subcommands of pointdriver.

#include "models/programs/exit_code.hpp"

namespace brisance::driver {

/// Parses the command line, does what it says, and returns the exit code. Messages go to standard error.
int run_command_line(int argc, char** argv);

}  // namespace brisance::driver
