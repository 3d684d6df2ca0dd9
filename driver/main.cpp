// pointdriver: one material point along a loading path.

#include "driver/commands.hpp"

int main(int argc, char** argv) {
  return brisance::driver::run_command_line(argc, argv);
}
