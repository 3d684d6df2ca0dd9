#include "simulator/parallel.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace brisance::simulator {

void choose_for_libraries(char** argv) {
  const auto set = [](const char* name) { return std::getenv(name) != nullptr; };
  constexpr const char* once = "BRISANCE_STARTED_ANEW";  // whoever takes a choice away again does not keep it starting for ever
  if (set(once)) return;
  bool chosen = false;
  const auto choose = [&](const char* name, const char* value) { chosen |= !set(name) && setenv(name, value, 0) == 0; };
  if (!set("GOMP_SPINCOUNT")) choose("OMP_WAIT_POLICY", "passive");
  choose("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");
  if (!chosen) return;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error && setenv(once, "1", 1) == 0) execv(program.c_str(), argv);
}

}  // namespace brisance::simulator
