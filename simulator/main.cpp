// brisance: bodies of metal under impact, by the material point method.

#include "simulator/commands.hpp"

int main(int argc, char** argv) {
  return brisance::simulator::run_command_line(argc, argv);
}
