// Nanoseconds per particle and step of a copper bar on a rigid wall, phase by phase, with everything on that is on by default.

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "models/input/material_reader.hpp"
#include "simulator/parallel.hpp"
#include "simulator/setup.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"
#include "tests/performance/environment.hpp"

namespace brisance::simulator {
namespace {

struct Setting {
  Geometry geometry;
  Basis basis;
  double particles;  // about as many
  int threads;
};

/// A bar of copper (Johnson-Cook) with an aspect ratio of 10/3, cut so that it has the wanted number of particles.
Case bar(const Setting& setting) {
  Case c;
  c.geometry = setting.geometry;
  c.numerics.basis = setting.basis, c.end_time = 1.0;
  BodyConfig body;
  body.name = "bar";
  body.material =
      read_material_file(std::filesystem::path(BRISANCE_SOURCE_DIR) / "data/materials/copper_ofhc_johnson_cook.toml");
  body.temperature = 295.0;
  body.velocity.translation = {0.0, -190.0, 0.0};
  const double R = 3.81e-3, L = 25.4e-3;
  // Particles: 4 R L/h^2 in two dimensions, 8 (pi/4 R^2 L)/h^3 for a quarter in three.
  const bool three = setting.geometry == Geometry::three_dimensional;
  const double pi = 3.14159265358979;
  c.cell_size = three ? std::cbrt(8.0 * pi / 4.0 * R * R * L / setting.particles) : std::sqrt(4.0 * R * L / setting.particles);
  auto shape = std::make_shared<Shape>();
  shape->form = Cone{{0, 0, 0}, {0, L, 0}, R, R};
  body.shape = shape;
  c.bodies.push_back(body);
  c.boundaries.push_back({.name = "wall", .kind = BoundaryKind::rigid_wall, .axis = Axis::y, .velocity = {}});
  if (three)
    for (const Axis axis : {Axis::x, Axis::z})
      c.boundaries.push_back(
          {.name = axis == Axis::x ? "x" : "z", .kind = BoundaryKind::symmetry, .axis = axis, .velocity = {}});
  if (three) {  // only the quarter that is kept
    auto quarter = std::make_shared<Shape>(), box = std::make_shared<Shape>();
    box->form = Box{{0, 0, 0}, {1, 1, 1}};
    quarter->form = Intersection{{body.shape, box}};
    c.bodies[0].shape = quarter;
  }
  return c;
}

void measure(const Setting& setting) {
  omp_set_num_threads(setting.threads);
  const Case c = bar(setting);
  Simulation s = set_up(c);
  const double particles = s.bodies[0].particles.size;
  const auto go = [&](int count) {
    for (int i = 0; i < count; ++i) {
      double dt = next_step(s, c.numerics, c.end_time).dt;
      while (advance(s, dt) != StepOutcome::done) dt *= 0.5;
    }
  };
  go(30);
  // The fastest of some parts: what the machine can do when nothing disturbs it.
  constexpr int parts = 5;
  const int steps = std::max(2, static_cast<int>(8e5 / particles));
  PhaseTimes phases;
  double seconds = 1e300;
  for (int part = 0; part < parts; ++part) {
    s.times = {};
    const auto start = Clock::now();
    go(steps);
    const double time = std::chrono::duration<double>(Clock::now() - start).count();
    if (time < seconds) seconds = time, phases = s.times;
  }
  const double per = 1e9 / (particles * steps);
  fmt::print("{:<8} {:<10} {:>9.0f} {:>8} {:>9.1f}", setting.geometry == Geometry::three_dimensional ? "3-D" : "2-D axi",
             setting.basis == Basis::ugimp ? "uGIMP" : "quadratic", particles, setting.threads, seconds * per);
  for (const double t : phases.seconds) fmt::print(" {:>9.1f}", t * per);
  fmt::print(
      " {:>9.0f}\n",
      static_cast<double>(s.bodies[0].particles.bytes() + s.bodies[0].bins.order.capacity() * 4 + s.grid.bytes()) / particles);
  std::fflush(stdout);
}

int run(bool quick) {
  const double flops = print_environment().flops;
  fmt::print(
      "Taylor bar of copper: Johnson-Cook, Mie-Grueneisen; MUSL, AFLIP, locking cure, artificial viscosity, books, order\n");
  fmt::print("goal for 3-D, quadratic, one thread: 200 ns on a core of 133 Gflop/s, here {:.0f}\n", 200.0 * 133.0 / flops);
  fmt::print("ns per particle-step\n{:<8} {:<10} {:>9} {:>8} {:>9}", "geometry", "basis", "particles", "threads", "total");
  for (const char* name : {"to grid", "sums", "nodes", "from grid", "gradients", "stress", "order"}) fmt::print(" {:>9}", name);
  fmt::print(" {:>9}\n", "bytes");
  for (const double particles : quick ? std::vector<double>{1e5} : std::vector<double>{1e5, 1e6})
    for (const Geometry g : {Geometry::axisymmetric, Geometry::three_dimensional})
      for (const Basis b : {Basis::quadratic_spline, Basis::ugimp})
        for (const int threads : {1, 2}) measure({g, b, particles, threads});
  return 0;
}

}  // namespace
}  // namespace brisance::simulator

int main(int argc, char** argv) {
  brisance::simulator::choose_for_libraries(argv);  // as brisance does
  return brisance::simulator::run(argc > 1 && std::string(argv[1]) == "--quick");
}
