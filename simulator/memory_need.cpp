#include "simulator/memory_need.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "simulator/gas/cut_cells.hpp"
#include "simulator/solid/particles.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bytes of a cell: of one fluid, of each further one, and for bodies, of which fewer if none moves; by the number of
/// dimensions, measured.
struct CellBytes {
  double one_fluid, another, bodies_at_rest, bodies;
};
constexpr CellBytes cell_bytes[] = {{177.0, 137.0, 0.0, 0.0}, {281.0, 180.0, 245.0, 570.0}, {590.0, 300.0, 400.0, 700.0}};

MemoryNeed need_of_gas(const Case& c) {
  const GasConfig& gas = *c.gas;
  MemoryNeed need{1.0, 0.0, "cells"};
  double window = 1.0;  // with the cells around the box that bodies are computed with
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a) {
    const double cells = std::max(gas.upper[a] - gas.lower[a], 0.0) / c.cell_size;
    need.points *= cells, window *= cells + 2.0 * gas::Window::depth;
  }
  const CellBytes& each = cell_bytes[c.dimensions() - 1];
  need.bytes = need.points * (each.one_fluid + static_cast<double>(gas.fluids.size() - 1) * each.another);
  const bool moves = std::any_of(gas.bodies.begin(), gas.bodies.end(), [](const GasBodyConfig& b) {
    return b.mass || b.velocity != Vector{} || b.rotation != Vector{} || b.radial_velocity != 0.0;
  });
  if (!gas.bodies.empty()) need.bytes += window * (moves ? each.bodies : each.bodies_at_rest);
  return need;
}

/// Sub-cells that a shape fills, each of which gets a particle.
double particles_in(const Case& c, const BodyConfig& body) {
  const double spacing = c.cell_size / body.particles_per_direction;
  const Bounds box = bounds(*body.shape, c.geometry);
  Vector lower = box.lower, upper = box.upper;
  double of_box = 1.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a)
    of_box *= std::max(upper[a] - lower[a], 0.0) / spacing;
  if (of_box == 0.0) return 0.0;
  constexpr int samples = 32;  // along each direction
  // Particles about an axis are as many as in the plane.
  const Geometry straight = c.geometry == Geometry::axisymmetric ? Geometry::plane : c.geometry;
  return of_box * filled_fraction(*body.shape, straight, lower, upper, samples);
}

MemoryNeed need_of_solids(const Case& c) {
  MemoryNeed need{0.0, 0.0, "particles"};
  for (const BodyConfig& body : c.bodies) {
    const auto loads = std::count_if(c.loads.begin(), c.loads.end(), [&](const LoadConfig& l) { return l.body == body.name; });
    constexpr int some = 8 * chunk_size;
    Particles few(c.dimensions(), history_columns(body.material.material), static_cast<int>(loads) * c.dimensions(),
                  body.strength.has_value());
    few.resize(some);
    constexpr double of_grid[] = {90.0, 160.0};  // bytes of the nodes around a cell's particles, measured for two per direction
    const double particles = particles_in(c, body);
    need.points += particles;
    need.bytes += particles * (static_cast<double>(few.bytes()) / some + of_grid[c.dimensions() - 2]);
  }
  return need;
}

/// The number in a file of the system, in bytes; infinite if there is none ("max").
double number_in(const char* path) {
  std::ifstream in(path);
  double bytes = 0.0;
  return in >> bytes ? bytes : infinity;
}

}  // namespace

MemoryNeed memory_need(const Case& c) {
  return c.gas ? need_of_gas(c) : need_of_solids(c);
}

double available_memory() {
  double available = infinity;
  std::ifstream meminfo("/proc/meminfo");
  for (std::string word; meminfo >> word;)
    if (double kilobytes = 0.0; word == "MemAvailable:" && meminfo >> kilobytes) available = 1024.0 * kilobytes;
  // Files that are kept in memory for later make room when it is needed.
  double files = 0.0;
  std::ifstream statistics("/sys/fs/cgroup/memory.stat");
  for (std::string word; statistics >> word;)
    if (double bytes = 0.0; (word == "active_file" || word == "inactive_file") && statistics >> bytes) files += bytes;
  const double limit = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current") - files;
  if (std::isfinite(limit) && std::isfinite(used)) available = std::min(available, std::max(limit - used, 0.0));
  rlimit own{};
  if (getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
    available = std::min(available, static_cast<double>(own.rlim_cur));
  return available;
}

void require_memory(const Case& c, double available) {
  const MemoryNeed need = memory_need(c);
  if (!(need.bytes > available)) return;
  constexpr double part = 0.7;  // of what there is: room for checkpoints, pictures and the estimate's error
  const double coarser = std::pow(need.bytes / (part * available), 1.0 / c.dimensions());
  const double decade = std::pow(10.0, std::floor(std::log10(c.cell_size * coarser)) - 1.0);  // two digits
  throw std::invalid_argument(fmt::format(
      "{}: cell_size: with cells of {:.4g} m there are about {:.3g} {}, which need about {:.3g} GB of memory; {:.3g} GB are "
      "free. Take larger cells, of {:.3g} m and more, or less to fill with them",
      c.file.string(), c.cell_size, need.points, need.name, 1e-9 * need.bytes, 1e-9 * available,
      decade * std::ceil(c.cell_size * coarser / decade)));
}

}  // namespace brisance::simulator
