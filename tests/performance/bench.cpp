// Nanoseconds per point and update, on one core, everything in the update included: as doubles, in lanes, and in lanes with a
// material whose laws are fixed at compile time. Prints the environment beside the numbers, since they mean little without it.
//   bench [--json FILE]

#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "models/phases.hpp"
#include "models/update.hpp"
#include "tests/models/flow_stress_sets.hpp"
#include "tests/performance/environment.hpp"

namespace brisance {
namespace {

/// A material whose laws the compiler knows.
template <class Flow, class Eos, class Shear, class Surface, class DamageLaw>
struct StaticMaterial {
  double density;
  ObjectiveRate objective_rate;
  Eos equation_of_state;
  Shear shear_modulus;
  melting::Constant melting;
  specific_heat::Constant specific_heat;
  Flow flow_stress;
  Surface yield;
  DamageLaw damage;
  std::optional<Viscoelastic> viscoelastic;
  std::optional<Porosity> porosity;
  std::vector<Stability> stability;
  std::vector<Failure> failure;
  Heating heating;
  ArtificialViscosity artificial_viscosity;
};
/// The damage of a material that has none.
using NoDamage = std::optional<Damage>;

template <class Flow, class Eos, class Shear, class Surface, class DamageLaw>
Material dynamic(const StaticMaterial<Flow, Eos, Shear, Surface, DamageLaw>& m) {
  Material material;
  material.name = "benchmark", material.density = m.density;
  material.equation_of_state = m.equation_of_state, material.shear_modulus = m.shear_modulus;
  material.melting = m.melting, material.specific_heat = m.specific_heat;
  material.flow_stress = m.flow_stress, material.yield = m.yield;
  if constexpr (!std::is_same_v<DamageLaw, NoDamage>) material.damage = m.damage;
  material.porosity = m.porosity, material.stability = m.stability, material.failure = m.failure;
  material.heating = m.heating, material.artificial_viscosity = m.artificial_viscosity;
  return material;
}

Heating plastic_heating() {
  Heating heating{};
  heating.taylor_quinney.size = 1, heating.taylor_quinney.y[0] = 0.9;
  heating.viscous = true;
  return heating;
}

/// Points in the middle of plastic deformation: compressed, sheared and slowly expanded, no two in the same state.
template <class Real>
class Work {
 public:
  static constexpr int batches = 8;  // 512 points: half a megabyte, so that arithmetic is measured and not memory
  static constexpr double time_step = 2e-7;

  explicit Work(const Material& material) : data_(std::make_unique<std::array<Batch<Real>, batches>>()) {
    const State<double> start = initial_state(material, 300.0);
    for (int b = 0; b < batches; ++b)
      for (int k = 0; k < Batch<Real>::capacity; ++k) {
        Point<Real>& p = (*data_)[b].points[k];
        p.state.density = start.density, p.state.energy = start.energy, p.state.temperature = start.temperature;
        p.state.shear_modulus = start.shear_modulus;
        p.state.porosity = Real(0.005);
        p.cell_size = Real(1e-4);
        const double vary = 1.0 + 0.3 * ((b * 7 + k * 13) % 17) / 17.0;
        p.velocity_gradient.xx = Real(-4e3 * vary), p.velocity_gradient.yy = Real(2.5e3 * vary);
        p.velocity_gradient.zz = Real(1.6e3 * vary);
        p.velocity_gradient.xy = Real(2e3 * vary), p.velocity_gradient.zx = Real(-1e3 * vary);
      }
  }
  /// Of 25 steps after 25 others, which bring every point to yield.
  template <class Step>
  double nanoseconds_per_point(Step&& step) {
    constexpr int steps = 25;
    const auto loop = [&] {
      for (int i = 0; i < steps; ++i)
        for (Batch<Real>& batch : *data_) step(batch, time_step);
    };
    loop();
    const auto start = *data_;
    return 1e9 *
           fastest(
               20, [&] { *data_ = start; }, loop) /
           (steps * batches * 64.0);
  }
  /// The part of the points that flow, and whether any is in trouble.
  double plastic_part() const {
    int plastic = 0, points = 0;
    for (const Batch<Real>& batch : *data_)
      for (const Point<Real>& p : batch)
        for (int i = 0; i < width_of<Real>; ++i) {
          plastic += lane(p.plastic_strain_increment, i) > 0.0, ++points;
          if (lane(p.trouble, i) != 0.0) std::fprintf(stderr, "bench: %s\n", describe(Trouble(int(lane(p.trouble, i)))).data());
        }
    return double(plastic) / points;
  }

 private:
  std::unique_ptr<std::array<Batch<Real>, batches>> data_;
};

struct Row {
  std::string material;
  double doubles, lanes, fixed, plastic;
};

template <class M>
Row measure(const std::string& name, const M& fixed) {
  const Material material = dynamic(fixed);
  Row row{name, 0, 0, 0, 0};
  Work<double> doubles(material);
  row.doubles = doubles.nanoseconds_per_point([&](Batch<double>& b, double dt) { update(material, b, dt); });
  Work<Lanes> lanes(material);
  row.lanes = lanes.nanoseconds_per_point([&](Batch<Lanes>& b, double dt) { update(material, b, dt); });
  row.plastic = lanes.plastic_part();
  Work<Lanes> composed(material);
  row.fixed = composed.nanoseconds_per_point([&](Batch<Lanes>& b, double dt) { phases::advance(fixed, b, dt); });
  return row;
}

int run(const char* json) {
  const auto [flops, bandwidth] = print_environment();
  std::printf("%-42s %10s %10s %10s %8s %8s\n", "ns per point and update", "double", "lanes", "static", "speed-up", "plastic");

  const damage::JohnsonCook steel_damage{0.05, 3.44, -2.12, 0.002, 0.61, 1.0, 298.0, 0.01};
  using equation_of_state::MieGruneisenTemperature;
  const std::vector<Row> rows{
      measure("Johnson-Cook, Mie-Grueneisen, JC damage",
              StaticMaterial<flow_stress::JohnsonCook, MieGruneisenTemperature, shear_modulus::Constant, yield::VonMises,
                             damage::JohnsonCook>{7830.0,
                                                  {},
                                                  {7830.0, 4578.0, 1.33, 1.67, 477.0, 294.0},
                                                  {80e9},
                                                  {1793.0},
                                                  {477.0},
                                                  flow_stress::sets::steel_4340,
                                                  {},
                                                  steel_damage,
                                                  {},
                                                  {},
                                                  {},
                                                  {},
                                                  plastic_heating(),
                                                  {}}),
      measure("MTS, Mie-Grueneisen, porous (GTN)",
              StaticMaterial<flow_stress::MechanicalThresholdStress, MieGruneisenTemperature, shear_modulus::VarshniChenGray,
                             yield::GursonTvergaardNeedleman, NoDamage>{7860.0,
                                                                        {},
                                                                        {7860.0, 4578.0, 1.33, 1.67, 477.0, 294.0},
                                                                        {71.46e9, 2.9e9, 204.0},
                                                                        {1793.0},
                                                                        {477.0},
                                                                        flow_stress::sets::threshold_hy100,
                                                                        {1.5, 1.0, 2.25, 0.05, 4.0, {}},
                                                                        {},
                                                                        {},
                                                                        porosity::ChuNeedleman{0.1, 0.3, 0.1, false},
                                                                        {},
                                                                        {},
                                                                        plastic_heating(),
                                                                        {}}),
      measure("Preston-Tonks-Wallace, Mie-Grueneisen",
              StaticMaterial<flow_stress::PrestonTonksWallace, MieGruneisenTemperature, shear_modulus::Constant,
                             yield::VonMises, NoDamage>{8930.0,
                                                        {},
                                                        {8930.0, 3940.0, 1.489, 2.02, 383.0, 294.0},
                                                        {47.7e9},
                                                        {1356.0},
                                                        {383.0},
                                                        flow_stress::sets::preston_copper,
                                                        {},
                                                        {},
                                                        {},
                                                        {},
                                                        {},
                                                        {},
                                                        plastic_heating(),
                                                        {}})};
  for (const Row& r : rows)
    std::printf("%-42s %10.1f %10.1f %10.1f %7.1fx %7.0f%%\n", r.material.c_str(), r.doubles, r.lanes, r.fixed,
                r.doubles / r.lanes, 100.0 * r.plastic);
  if (json) {
    std::ofstream out(json);
    out << "{\"processor\": \"" << processor() << "\", \"vector_bits\": " << 64 * simd::register_width
        << ", \"compiler\": \"GCC " << __VERSION__ << "\", \"gflops\": " << flops << ", \"triad_gb_per_s\": " << bandwidth
        << ", \"ns_per_point\": [";
    for (std::size_t i = 0; i < rows.size(); ++i)
      out << (i ? ", " : "") << "{\"material\": \"" << rows[i].material << "\", \"double\": " << rows[i].doubles
          << ", \"lanes\": " << rows[i].lanes << ", \"static\": " << rows[i].fixed << "}";
    out << "]}\n";
  }
  return 0;
}

}  // namespace
}  // namespace brisance

int main(int argc, char** argv) {
  return brisance::run(argc > 2 && std::strcmp(argv[1], "--json") == 0 ? argv[2] : nullptr);
}
