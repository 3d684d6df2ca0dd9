#include "validation.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "simulator/case_reader.hpp"
#include "simulator/output/run_directory.hpp"
#include "simulator/setup.hpp"

namespace brisance::simulator {

Ran run_case(const std::string& file, const std::vector<std::string>& changes, const std::filesystem::path& directory) {
  Ran ran{read_case(std::filesystem::path(BRISANCE_DATA) / "cases" / (file + ".toml"), changes), {}, {}};
  ran.simulation = set_up(ran.config);
  prepare_directory(directory, ran.config, true);
  RunOptions options;
  options.directory = directory;
  ran.result = run(ran.config, ran.simulation, options);
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
