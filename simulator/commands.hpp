#pragma once
// The subcommands of brisance.

namespace brisance::simulator {

/// Exit codes of the program.
enum ExitCode : int { done = 0, failed_while_running = 1, bad_input = 2, interrupted = 3 };

/// Parses the command line, does what it says, and returns the exit code. Messages go to standard error.
int run_command_line(int argc, char** argv);

}  // namespace brisance::simulator
