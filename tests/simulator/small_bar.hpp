#pragma once
// A small copper bar against a rigid wall and a box of air, as case files in a directory of the test's own.

#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <csignal>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

#include "simulator/simulation.hpp"
#include "tests/command_line.hpp"

/// HDF5 keeps what it could not write when a file on a full disk is closed; that is the library's memory, not ours.
extern "C" [[gnu::used]] inline const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}

namespace brisance::simulator {

/// Does something while no file may grow beyond `bytes`, which the system says as it says that a disk is full. Returns the
/// error.
template <class F>
std::string on_a_full_disk(F&& write, rlim_t bytes = 20000) {
  struct sigaction before {};
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, &before);
  rlimit limits{};
  getrlimit(RLIMIT_FSIZE, &limits);
  rlimit small = limits;
  small.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    write();
  } catch (const std::exception& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limits);
  sigaction(SIGXFSZ, &before, nullptr);
  return message;
}

/// 240 particles for about 90 steps.
inline std::string small_bar(const std::string& more = "") {
  return "title = \"Small bar\"\ngeometry = \"axisymmetric\"\ncell_size = \"0.8 mm\"\nend_time = \"7 us\"\n"
         "[[solid]]\nname = \"bar\"\nshape = {cylinder = {start = [0, 0], end = [0, \"12 mm\"], radius = \"3.2 mm\"}}\n"
         "temperature = \"298 K\"\nvelocity = [0, \"-190 m/s\"]\nmaterial = \"copper_ofhc_johnson_cook.toml\"\n"
         "[[boundary]]\nkind = \"rigid_wall\"\naxis = \"y\"\nposition = 0\nside = \"above\"\n" +
         more;
}

/// A plane box of air at 300 K and 1 atm, to which bodies are added; all as in a case file, corners as lists.
inline std::string box_of_air(const std::string& cell_size, const std::string& end_time, const std::string& lower,
                              const std::string& upper) {
  return "geometry = \"plane\"\ncell_size = \"" + cell_size + "\"\nend_time = \"" + end_time + "\"\n[gas]\nlower = " + lower +
         "\nupper = " + upper +
         "\n[[gas.fluid]]\nname = \"air\"\nmaterial = \"air.toml\"\n"
         "[[gas.fill]]\ntemperature = \"300 K\"\npressure = \"1 atm\"\n";
}

/// Every bit of the particles' state, in the order of their ids: where they stand in memory has no meaning.
inline std::vector<std::uint64_t> bits_of(const Simulation& s) {
  std::vector<std::uint64_t> bits;
  for (const Body& body : s.bodies) {
    const Particles& ps = body.particles;
    std::vector<int> order(static_cast<std::size_t>(ps.size));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return ps.id[static_cast<std::size_t>(a)] < ps.id[static_cast<std::size_t>(b)]; });
    for (const int p : order) {
      bits.push_back(ps.id[static_cast<std::size_t>(p)]);
      for (const Column& c : ps.columns()) bits.push_back(std::bit_cast<std::uint64_t>(ps.set(c.set).at(c.index, p)));
    }
  }
  return bits;
}

}  // namespace brisance::simulator
