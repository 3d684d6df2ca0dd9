#pragma once
// What the figures of a simulation tell gnuplot.

#include <cstdlib>
#include <string>

#include "simulator/output/figures.hpp"
#include "tests/command_line.hpp"

namespace brisance::simulator {

/// Draws with a program in the place of gnuplot that keeps what it is told, and returns that.
inline std::string told_to_gnuplot(const Case& c, const Simulation& s, const fs::path& directory, Of of = Of::good_run) {
  fs::create_directories(directory / "bin");
  const fs::path told = directory / "told.txt", program = directory / "bin" / "gnuplot";
  write_text(program, "#!/bin/sh\ntee -a '" + told.string() +
                          "' | sed -n 's/^set output \"\\(.*\\)\"$/\\1/p' | while read -r name; do echo x > \"$name\"; done\n");
  fs::permissions(program, fs::perms::owner_all);
  const std::string before = std::getenv("PATH");
  setenv("PATH", ((directory / "bin").string() + ":" + before).c_str(), 1);
  static_cast<void>(draw_figures(c, s, directory, of));
  setenv("PATH", before.c_str(), 1);
  return text_of(told);
}

}  // namespace brisance::simulator
