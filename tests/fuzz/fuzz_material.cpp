// libFuzzer target: any bytes as a material file, with overrides before it. Whatever they are, the reader either refuses them
// with InputError, or accepts a material that is written and read back unchanged. Anything else is a defect.
//
// The input is  key=value LF key=value LF ... NUL material file,  or a material file alone.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "models/input/material_reader.hpp"

namespace {

void set_all(brisance::InputFile& file, std::string_view assignments) {
  while (!assignments.empty()) {
    const auto end = std::min(assignments.find('\n'), assignments.size());
    file.set(assignments.substr(0, end));
    assignments.remove_prefix(std::min(end + 1, assignments.size()));
  }
}

brisance::MaterialFile read(std::string_view text, std::string_view overrides) {
  brisance::InputFile file = brisance::InputFile::from_text(text, "fuzz.toml");
  set_all(file, overrides);
  brisance::TableReader top = file.top();
  brisance::MaterialFile material = brisance::read_material(top);
  file.finish();
  return material;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto nul = input.find('\0');
  const bool with_overrides = nul != std::string_view::npos;
  brisance::MaterialFile material;
  try {
    material = read(with_overrides ? input.substr(nul + 1) : input, with_overrides ? input.substr(0, nul) : "");
  } catch (const brisance::InputError&) {
    return 0;
  }
  // From here on nothing may be refused: an exception ends the program.
  const std::string once = brisance::write_material(material);
  const std::string twice = brisance::write_material(read(once, ""));
  if (once != twice) {
    std::fprintf(stderr, "written:\n%s\nwritten, read and written:\n%s\n", once.c_str(), twice.c_str());
    std::abort();
  }
  return 0;
}
