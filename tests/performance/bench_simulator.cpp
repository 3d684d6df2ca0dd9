// Nanoseconds per particle and step of a copper bar on a rigid wall, phase by phase, with everything on that is on by default.

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "models/input/material_reader.hpp"
#include "simulator/setup.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"

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
  const int warm = 30, steps = std::max(10, static_cast<int>(4e6 / particles));
  const auto go = [&](int count) {
    for (int i = 0; i < count; ++i) {
      double dt = next_step(s, c.numerics, c.end_time).dt;
      while (advance(s, dt) != StepOutcome::done) dt *= 0.5;
    }
  };
  go(warm);
  s.times = {};
  const auto start = std::chrono::steady_clock::now();
  go(steps);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double per = 1e9 / (particles * steps);
  fmt::print("{:<8} {:<10} {:>9.0f} {:>8} {:>9.1f}", setting.geometry == Geometry::three_dimensional ? "3-D" : "2-D axi",
             setting.basis == Basis::ugimp ? "uGIMP" : "quadratic", particles, setting.threads, seconds * per);
  for (const double t : s.times.seconds) fmt::print(" {:>9.1f}", t * per);
  fmt::print(
      " {:>9.0f}\n",
      static_cast<double>(s.bodies[0].particles.bytes() + s.bodies[0].bins.order.capacity() * 4 + s.grid.bytes()) / particles);
  std::fflush(stdout);
}

int run(bool quick) {
  fmt::print(
      "Taylor bar of copper: Johnson-Cook, Mie-Grueneisen; MUSL, AFLIP, locking cure, artificial viscosity, books, order\n");
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
  return brisance::simulator::run(argc > 1 && std::string(argv[1]) == "--quick");
}
