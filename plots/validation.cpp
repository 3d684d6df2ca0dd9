#include "validation.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "simulator/case_reader.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/setup.hpp"

namespace brisance::simulator {

Ran run_case(const std::string& file, const std::vector<std::string>& changes, const std::filesystem::path& directory) {
  return run_case(file, changes, directory, 1, [](const Simulation&) {});
}

Ran run_case(const std::string& file, const std::vector<std::string>& changes, const std::filesystem::path& directory,
             int parts, const std::function<void(const Simulation&)>& look) {
  Ran ran{read_case(std::filesystem::path(BRISANCE_DATA) / "cases" / (file + ".toml"), changes), {}, {}};
  ran.simulation = set_up(ran.config);
  use_threads(0, ran.simulation);
  prepare_directory(directory, ran.config, true);
  look(ran.simulation);
  RunOptions options;
  options.directory = directory;
  Case quiet = ran.config;  // figures at the end alone
  quiet.output.figures = false;
  for (int part = 1; part <= parts; ++part) {
    const bool last = part == parts;
    const Case& c = last ? ran.config : quiet;
    options.until = last ? c.end_time : c.end_time * part / parts;
    if (part > 1) ran.simulation = set_up(c);
    ran.result = part > 1 ? resume(c, ran.simulation, options) : run(c, ran.simulation, options);
    if (ran.result.ending != Ending::done) break;
    look(ran.simulation);
  }
  return ran;
}

std::string table(const std::vector<Check>& all) {
  std::string text = "\n| check | measured | limit | |\n|---|---|---|---|\n";
  for (const Check& c : all)
    text += fmt::format("| {} | {:.4f} | {} | {} |\n", c.text, c.value, c.limit, c.holds() ? "holds" : "MISSED");
  return text;
}

std::string commit_hash() {
  std::string hash = "unknown";
  if (FILE* pipe = popen("git rev-parse --short HEAD 2>/dev/null", "r")) {
    char text[64] = {};
    if (fgets(text, sizeof text, pipe)) hash = std::string(text).substr(0, std::string(text).find('\n'));
    pclose(pipe);
  }
  return hash;
}

}  // namespace brisance::simulator
