// Rate sticks of ANFO against experiment: runs sticks of several radii, writes the table and the figure of the velocities.
//   detonation [--radius MM]... [--cell-size MM]... [-o DIR]
// Cells of 0.5 mm unless others are given: at 0.25 mm the velocities change by 1 % and less.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

#include "models/input/csv.hpp"
#include "models/programs/figure.hpp"
#include "simulator/case_reader.hpp"
#include "simulator/gas/fields.hpp"
#include "simulator/setup.hpp"
#include "simulator/step_size.hpp"
#include "simulator/time_step.hpp"

namespace brisance::simulator {
namespace {

const std::filesystem::path data = BRISANCE_DATA;
constexpr double infinite = 1.0;  // m

/// A stick to run, and what came of it.
struct Stick {
  double radius;  // m
  double length;  // m
  double velocity = 0.0;
  double seconds = 0.0;
};
std::vector<Stick> sticks() {
  // Long enough for the front to forget how it was lit.
  return {{6e-3, 60e-3}, {8e-3, 80e-3}, {12.5e-3, 100e-3}, {20e-3, 120e-3}, {infinite, 100e-3}};
}
std::string name_of(const Stick& stick) {
  return stick.radius == infinite ? "infinite" : fmt::format("{:g} mm", 1e3 * stick.radius);
}

Simulation set_up_stick(const Stick& stick, double cell_size) {
  const auto whole = [&](double x) { return std::ceil(x / cell_size - 1e-9) * cell_size; };
  const bool plane = stick.radius == infinite;
  // In a box of 1.6 radii the sticks of 6 and 12.5 mm run 0.7 and 0.8 % faster.
  const double width = plane ? 8.0 * cell_size : whole(3.0 * stick.radius);
  Case c = read_case(data / "cases" / "anfo_rate_stick.toml",
                     {fmt::format("cell_size = {}", cell_size), fmt::format("gas.upper = [{}, {}]", width, whole(stick.length)),
                      fmt::format("gas.fill.1.shape.cylinder.radius = {}", stick.radius),
                      fmt::format("gas.fill.1.shape.cylinder.end = [0, {}]", 2.0 * stick.length),
                      fmt::format("gas.fill.2.shape.cylinder.radius = {}", stick.radius),
                      fmt::format("figure.0.to = [0, {}]", whole(stick.length))});
  if (plane) std::erase_if(c.gas->edges, [](const EdgeConfig& edge) { return edge.side == BoxSide::high_x; });
  return set_up(c);
}

/// Where on the axis the pressure falls through half a gigapascal.
double front(const Simulation& s) {
  constexpr double level = 0.5e9;
  const double h = s.gas.cells.cell_size;
  double above = 0.0;
  for (int j = s.gas.cells.upper[1] - 1; j >= 0; --j) {
    const auto at = s.gas.cells.find({0, j, 0});
    const double p = s.gas.primitive.cell(at->block, gas::Primitive::pressure, at->cell);
    if (p > level) return h * (j + 0.5 + (p - level) / (p - above));
    above = p;
  }
  return 0.0;
}

/// Runs a stick; its velocity is that over the last third but the end.
void detonate(Stick& stick, double cell_size) {
  const auto start = std::chrono::steady_clock::now();
  Simulation s = set_up_stick(stick, cell_size);
  const auto reach = [&](double place) {
    constexpr int look_every = 4;
    double x = front(s);
    for (int n = 0; x < place; ++n) {
      StepSize size = next_step(s, {}, 1.0);
      while (advance(s, size.dt) == StepOutcome::rejected) size.dt *= 0.5;
      if (n % look_every == 0) x = front(s);
      if (s.time > 10.0 * stick.length / 5890.0) throw std::runtime_error(name_of(stick) + ": the detonation has died");
    }
    return std::pair{x, s.time};
  };
  const auto [x0, t0] = reach(0.6 * stick.length);
  const auto [x1, t1] = reach(0.9 * stick.length);
  stick.velocity = (x1 - x0) / (t1 - t0);
  stick.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Velocities {
  std::vector<double> inverse_radius, velocity;  // 1/mm, km/s
};
Velocities read(const std::string& name) {
  std::ifstream in(data / "experiments" / "souers_2000_anfo" / (name + ".csv"));
  Velocities v;
  for (std::string line; std::getline(in, line);) {
    double x = 0.0, D = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &x, &D) == 2) v.inverse_radius.push_back(x), v.velocity.push_back(1e-3 * D);
  }
  if (v.velocity.empty()) throw std::runtime_error(name + ".csv: nothing to read");
  return v;
}

/// The measured points scatter: what is compared with is the parabola that fits them best.
struct Parabola {
  double a = 0.0, b = 0.0, c = 0.0;
  double operator()(double x) const { return a + x * (b + x * c); }
};
Parabola fit(const Velocities& v) {
  double S[5] = {}, T[3] = {};
  for (std::size_t i = 0; i < v.velocity.size(); ++i) {
    double power = 1.0;
    for (int n = 0; n < 5; ++n, power *= v.inverse_radius[i]) {
      S[n] += power;
      if (n < 3) T[n] += power * v.velocity[i];
    }
  }
  const auto det = [](double a, double b, double c, double d, double e, double f, double g, double h, double i) {
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  };
  const double all = det(S[0], S[1], S[2], S[1], S[2], S[3], S[2], S[3], S[4]);
  return {det(T[0], S[1], S[2], T[1], S[2], S[3], T[2], S[3], S[4]) / all,
          det(S[0], T[0], S[2], S[1], T[1], S[3], S[2], T[2], S[4]) / all,
          det(S[0], S[1], T[0], S[1], S[2], T[1], S[2], S[3], T[2]) / all};
}
std::optional<double> at(const Velocities& v, double inverse_radius) {
  for (std::size_t i = 0; i < v.velocity.size(); ++i)
    if (std::abs(v.inverse_radius[i] - inverse_radius) < 1e-3) return v.velocity[i];
  return std::nullopt;
}

int run_all(const std::vector<double>& radii, const std::vector<double>& cell_sizes, const std::filesystem::path& output) {
  std::map<double, std::vector<Stick>, std::greater<>> all;
  for (const double h : cell_sizes)
    for (Stick stick : sticks()) {
      const auto is_it = [&](double radius) { return std::abs(1e-3 * radius - stick.radius) < 1e-6; };
      if (!radii.empty() && std::none_of(radii.begin(), radii.end(), is_it)) continue;
      detonate(stick, 1e-3 * h);
      fmt::print("radius {:9} cells of {:5} mm: {:.0f} m/s, {:.1f} s\n", name_of(stick), h, stick.velocity, stick.seconds);
      std::fflush(stdout);
      all[h].push_back(stick);
    }
  if (all.empty()) throw std::invalid_argument("detonation: no stick of that radius; there are 6, 8, 12.5, 20 and 1000 mm");
  const Velocities measured = read("experiment"), guilkey = read("guilkey_2007"), blastfoam = read("blastfoam");
  const Parabola parabola = fit(measured);
  std::string text =
      "# ANFO rate sticks against experiment\n\nWritten by `./bootstrap.sh validate`. Velocities in m/s; measured: "
      "the parabola in 1/R that fits all points, whose largest 1/R is that of 6.5 mm.\n\n| radius |";
  std::string line = "|---|";
  for (const auto& [h, made] : all) text += fmt::format(" cells of {:g} mm | s |", h), line += "---|---|";
  text += " measured | deviation | limit | | Guilkey et al. 2007 | blastFoam |\n" + line + "---|---|---|---|---|---|\n";
  bool good = true;
  const std::vector<Stick>& finest = all.rbegin()->second;
  for (std::size_t i = 0; i < finest.size(); ++i) {
    const Stick& stick = finest[i];
    const double x = stick.radius == infinite ? 0.0 : 1e-3 / stick.radius, D = 1e3 * parabola(x);
    const double deviation = stick.velocity / D - 1.0, limit = stick.radius < 7e-3 ? 0.08 : 0.05;
    const bool holds = std::abs(deviation) <= limit;
    good = good && holds;
    text += fmt::format("| {} |", name_of(stick));
    for (const auto& [h, made] : all) text += fmt::format(" {:.0f} | {:.0f} |", made[i].velocity, made[i].seconds);
    const auto peer = [&](const Velocities& v) {
      const std::optional<double> value = at(v, x);
      return value ? fmt::format("{:.0f}", 1e3 * *value) : std::string("-");
    };
    text += fmt::format(" {:.0f} | {:+.1f} % | {:.0f} % | {} | {} | {} |\n", D, 100.0 * deviation, 100.0 * limit,
                        holds ? "holds" : "MISSED", peer(guilkey), peer(blastfoam));
  }
  fmt::print("\n{}", text);
  std::filesystem::create_directories(output);
  std::ofstream(output / "rate_sticks.md") << text;
  Panel panel;
  panel.x_label = "1/radius (1/mm)", panel.y_label = "detonation velocity (km/s)", panel.legend = "bottom left";
  panel.x_range = {0.0, 0.18}, panel.y_range = {3.0, 6.2};
  panel.curves.push_back({"measured, LLNL (Souers et al. 2000)", measured.inverse_radius, measured.velocity, Mark::points, 7});
  Curve fitted{"parabola through them", {}, {}, Mark::dashed, 7};
  for (double x = 0.0; x <= 0.16; x += 0.005) fitted.x.push_back(x), fitted.y.push_back(parabola(x));
  panel.curves.push_back(fitted);
  Curve computed{fmt::format("computed, cells of {:g} mm", all.rbegin()->first), {}, {}, Mark::squares, 0};
  for (const Stick& stick : finest)
    computed.x.push_back(stick.radius == infinite ? 0.0 : 1e-3 / stick.radius), computed.y.push_back(1e-3 * stick.velocity);
  computed.size = 1.2;
  panel.curves.push_back(computed);
  panel.curves.push_back({"Guilkey, Harman & Banerjee 2007", guilkey.inverse_radius, guilkey.velocity, Mark::squares, 3});
  panel.curves.push_back({"blastFoam", blastfoam.inverse_radius, blastfoam.velocity, Mark::squares, 2});
  draw({"ANFO rate sticks", {panel}, 1, 760, 520}, output / "rate_sticks.png");
  fmt::print("\nfigure: {}\n", (output / "rate_sticks.png").string());
  return good ? 0 : 1;
}

}  // namespace
}  // namespace brisance::simulator

int main(int argc, char** argv) {
  CLI::App app{"Rate sticks of ANFO against experiment."};
  std::vector<double> radii, cell_sizes{0.5};
  std::string output = "out/validation";
  app.add_option("--radius", radii, "mm, some of 6, 8, 12.5, 20 and 1000, which stands for infinite; all if none is given");
  app.add_option("--cell-size", cell_sizes, "mm, one or several");
  app.add_option("-o,--output", output, "directory for table and figure");
  CLI11_PARSE(app, argc, argv);
  try {
    return brisance::simulator::run_all(radii, cell_sizes, output);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
