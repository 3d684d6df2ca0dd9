// brisance: bodies of metal under impact, by the material point method.

#include "simulator/commands.hpp"
#include "simulator/parallel.hpp"

int main(int argc, char** argv) {
  brisance::simulator::choose_for_libraries(argv);
  return brisance::simulator::run_command_line(argc, argv);
}
