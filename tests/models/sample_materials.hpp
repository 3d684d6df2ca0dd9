#pragma once
// One sample of every law that is not a flow stress, and complete materials made of them, for tests that go over all.
// Values as in data/materials, SI.

#include <array>
#include <utility>
#include <vector>

#include "models/update.hpp"
#include "tests/models/sample_laws.hpp"

namespace brisance::samples {

inline constexpr double room_temperature = 298.0;  // K

/// A table that is one number everywhere.
inline Table constant_table(double value) {
  Table table;
  table.size = 1;
  table.y[0] = value;
  return table;
}

// Every alternative of each list, in its order ------------------------------------------------------------------------

inline std::vector<EquationOfState> equations_of_state() {
  using namespace equation_of_state;
  return {Hypoelastic{7830.0, 160e9, 477.0, 298.0},
          Logarithmic{7830.0, 160e9, 477.0, 298.0},
          Hyperelastic{7860.0, 150e9, 477.0, 298.0},
          MieGruneisenTemperature{7830.0, 4578.0, 1.33, 1.67, 477.0, 298.0},
          MieGruneisenEnergy{8930.0, 3940.0, 1.489, 2.02, 383.0, 298.0},
          JonesWilkinsLee{1838.0, 1668.9e9, 59.69e9, 5.9, 2.1, 0.45, 594.96, 9.499985e9},
          IdealGas{1.4, 716.0},
          Abel{1.25, 1500.0, 1e-3},
          StiffenedGas{4.4, 6e8, 1000.0},
          Murnaghan{1840.0, 36e9, 7.4, 1e5, 1000.0, 298.0},
          BirchMurnaghan{1840.0, 36e9, 7.4, 1e5, 1000.0, 298.0},
          Tillotson{2700.0, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5.0, 5.0, 896.0, 298.0},
          TwuSimTassone{1.63, 514.96, -260.1385968, 7.955153678e-4}};
}

inline std::vector<ShearModulus> shear_moduli() {
  using namespace shear_modulus;
  return {Constant{80e9}, VarshniChenGray{71.46e9, 2.9e9, 204.0}, SteinbergCochranGuinan{47.7e9, 28.3e-12, 3.77e-4, 300.0},
          NadalLePoac{50.7e9, 28e-12, 0.04, 0.057, 63.55}, PrestonTonksWallace{51.8e9, 28e-12, 0.20}};
}

inline std::vector<Melting> meltings() {
  using namespace melting;
  return {Constant{1793.0}, SteinbergCochranGuinan{1356.0, 2.02, 1.5},
          BurakovskyPrestonSilbar{.bulk_modulus = 137e9,
                                  .bulk_modulus_slope = 5.48,
                                  .shear_modulus = 47.7e9,
                                  .shear_modulus_slope = 1.4,
                                  .kappa = 1.25,
                                  .coordination_number = 12.0,
                                  .b2_rho_c = 0.64,
                                  .alpha = 2.9,
                                  .lambda = 1.41,
                                  .lattice_parameter = 3.6147e-10,
                                  .atoms_per_cell = 4.0},
          LinearInPressure{1356.0, 3.5e-8}};
}

inline std::vector<SpecificHeat> specific_heats() {
  using namespace specific_heat;
  return {Constant{477.0}, Polynomial{{300.0, 0.4, -2e-4, 1e-7}, 100.0, 1500.0}, SteelLambda{}, SteelGoto{}, Copper{}};
}

inline std::vector<Yield> yields() {
  using namespace yield;
  return {VonMises{}, GursonTvergaardNeedleman{1.5, 1.0, 2.25, 0.05, 4.0, ReturnTo::porous_surface}};
}

inline std::vector<Porosity> porosities() {
  using namespace porosity;
  return {Growth{}, ChuNeedleman{0.1, 0.3, 0.1, false}};
}

inline std::vector<InitialPorosity> initial_porosities() {
  using namespace porosity::initial;
  return {Constant{0.005}, Gaussian{0.005, 0.001, 0.1}, Weibull{0.005, 3.0, 0.1}};
}

inline std::vector<Damage> damages() {
  using namespace damage;
  return {JohnsonCook{0.05, 3.44, -2.12, 0.002, 0.61, 1.0, 298.0, 0.01}, HancockMackenzie{false}};
}

inline std::vector<Stability> stabilities() {
  using namespace stability;
  return {Drucker{0.0}, AcousticTensor{}};
}

inline std::vector<Failure> failures() {
  using namespace failure;
  return {failure::Melting{},      TeplaF{0.3},      CriticalDamage{1.0}, CriticalPorosity{0.3},
          Instability{0.01, true}, TensileLimit{2e9}};
}

inline std::vector<Reaction> reactions() {
  using namespace reaction;
  return {PressurePower{75.3, 0.778, 101325.0, 5e4, 450.0, 2e6},
          WardSonBrewster{1.637e15, 1.76e5, 1.6e-3, 4e5, 3.018e6, 0.2, 0.07, 1400.0, 0.0342, 5e4, 550.0, 8.314},
          JwlPlusPlus{3.5083e-7, 1.3, 1.0, 2e8, 5.558e6}, ProgramBurn{8800.0, 1e-6, 3.0, 5.5e6, {0.0, 0.0, 0.01}}};
}

inline std::vector<Viscoelastic> viscoelastics() {
  return {viscoelastic::ViscoScram{.shear_moduli = {3.5e8, 1.739e8, 5.212e8, 9.085e8, 6.875e8},
                                   .relaxation_rates = {0.0, 7.32e3, 7.32e4, 7.32e5, 2.0e6},
                                   .crack_scale = 1e-3,
                                   .initial_crack_radius = 3e-5,
                                   .crack_exponent = 10.0,
                                   .max_crack_speed = 300.0,
                                   .toughness = 5e5,
                                   .friction = 0.35,
                                   .tension_speed_factor = 12.0,
                                   .speed_exponent = 0.90564746,
                                   .speed_coefficient = -2.90178468}};
}

// Complete materials --------------------------------------------------------------------------------------------------

/// 4340 steel: Johnson-Cook flow and damage, Mie-Grueneisen in temperature.
inline Material steel_4340() {
  Material m;
  m.name = "4340 steel";
  m.density = 7830.0;
  m.equation_of_state = equation_of_state::MieGruneisenTemperature{7830.0, 4578.0, 1.33, 1.67, 477.0, room_temperature};
  m.shear_modulus = shear_modulus::SteinbergCochranGuinan{81.9e9, 21.98e-12, 4.725e-4, 300.0};
  m.melting = melting::Constant{1793.0};
  m.specific_heat = specific_heat::Constant{477.0};
  m.flow_stress = flow_stress::sets::steel_4340;
  m.yield = yield::VonMises{};
  m.damage = damages().front();
  m.failure = {failure::Melting{}, failure::CriticalDamage{1.0}};
  m.heating = Heating{constant_table(0.9), true, false};
  return m;
}

/// Copper: Johnson-Cook, Mie-Grueneisen in temperature, no failure.
inline Material copper_johnson_cook() {
  Material m;
  m.name = "copper";
  m.density = 8930.0;
  m.equation_of_state = equation_of_state::MieGruneisenTemperature{8930.0, 3940.0, 1.489, 2.02, 383.0, room_temperature};
  m.shear_modulus = shear_modulus::Constant{45e9};
  m.melting = melting::Constant{1356.0};
  m.specific_heat = specific_heat::Constant{383.0};
  m.flow_stress = flow_stress::sets::johnson_cook_copper;
  m.yield = yield::VonMises{};
  m.heating = Heating{constant_table(0.9), true, false};
  return m;
}

/// HY-100 steel: threshold stress, porous yield, nucleation, Tepla-F.
inline Material steel_hy100() {
  Material m;
  m.name = "HY-100 steel";
  m.density = 7860.0;
  m.equation_of_state = equation_of_state::Hyperelastic{7860.0, 150e9, 477.0, room_temperature};
  m.shear_modulus = shear_modulus::VarshniChenGray{71.46e9, 2.9e9, 204.0};
  m.melting = melting::Constant{1790.0};
  m.specific_heat = specific_heat::SteelGoto{};
  m.flow_stress = flow_stress::sets::threshold_hy100;
  m.yield = yields()[1];
  m.porosity = porosities()[1];
  m.initial_porosity = initial_porosities()[1];
  m.damage = damage::HancockMackenzie{false};
  m.stability = {stability::Drucker{0.0}};
  m.failure = {failure::Melting{}, failure::TeplaF{0.3}, failure::Instability{0.0, true}};
  m.heating = Heating{constant_table(0.9), true, false};
  return m;
}

namespace detail {
inline Material copper() {
  Material m;
  m.density = 8930.0;
  m.equation_of_state = equation_of_state::MieGruneisenEnergy{8930.0, 3940.0, 1.489, 2.02, 383.0, room_temperature};
  m.melting = meltings()[1];
  m.specific_heat = specific_heat::Constant{383.0};
  m.yield = yield::VonMises{};
  m.failure = {failure::Melting{}};
  m.heating = Heating{constant_table(0.9), true, true};
  return m;
}
}  // namespace detail

/// Copper: Preston-Tonks-Wallace, Mie-Grueneisen in energy.
inline Material copper_preston_tonks_wallace() {
  Material m = detail::copper();
  m.name = "copper (Preston-Tonks-Wallace)";
  m.shear_modulus = shear_modulus::PrestonTonksWallace{51.8e9, 28e-12, 0.20};
  m.flow_stress = flow_stress::sets::preston_copper;
  return m;
}

/// Copper: Steinberg-Cochran-Guinan-Lund, which solves an implicit law at every evaluation.
inline Material copper_steinberg_lund() {
  Material m = detail::copper();
  m.name = "copper (Steinberg-Lund)";
  m.shear_modulus = shear_modulus::SteinbergCochranGuinan{47.7e9, 28.3e-12, 3.77e-4, 300.0};
  m.flow_stress = flow_stress::sets::lund_copper;
  return m;
}

/// Elastic, its pressure from a stored energy.
inline Material elastic() {
  Material m;
  m.name = "elastic";
  m.density = 7860.0;
  m.equation_of_state = equation_of_state::Hyperelastic{7860.0, 160e9, 477.0, room_temperature};
  m.shear_modulus = shear_modulus::Constant{80e9};
  return m;
}

/// Elastic, its pressure and deviator both from increments: closed forms exist for every path.
inline Material hypoelastic() {
  Material m = elastic();
  m.name = "hypoelastic";
  m.equation_of_state = equation_of_state::Hypoelastic{7860.0, 160e9, 477.0, room_temperature};
  return m;
}

/// Explosive: viscoelastic with cracks, unreacted Jones-Wilkins-Lee.
inline Material pbx_9501() {
  Material m;
  m.name = "PBX 9501";
  m.density = 1832.0;
  m.equation_of_state = equation_of_state::JonesWilkinsLee{1832.0, 7.32e14, -5.2645e9, 14.1, 1.41, 0.8867, 1517.596, 0.0};
  m.viscoelastic = viscoelastics().front();
  m.reaction = reactions()[1];
  return m;
}

inline Material air() {
  Material m;
  m.name = "air";
  m.density = 1.1792946927374306;
  m.equation_of_state = equation_of_state::IdealGas{1.4, 716.0};
  return m;
}

inline std::vector<Material> materials() {
  return {steel_4340(), steel_hy100(), copper_preston_tonks_wallace(), copper_steinberg_lund(), elastic(), hypoelastic(),
          pbx_9501(),   air()};
}

// A point under test --------------------------------------------------------------------------------------------------

/// Every number of a state.
template <class Real>
auto numbers(State<Real>& s) {
  std::array<Real*, 27 + history_capacity> all;
  int n = 0;
  for_each_component([&](Real& x) { all[n++] = &x; }, s.stress);
  Tensor<Real>& F = s.deformation_gradient;
  for (Real* x : {&F.xx, &F.xy, &F.xz, &F.yx, &F.yy, &F.yz, &F.zx, &F.zy, &F.zz}) all[n++] = x;
  for (Real* x : {&s.density, &s.energy, &s.temperature, &s.plastic_strain, &s.plastic_strain_rate, &s.plastic_volume_strain,
                  &s.porosity, &s.damage, &s.shear_modulus, &s.flow_history, &s.failure_cause, &s.failure_time})
    all[n++] = x;
  for (Real& x : s.history) all[n++] = &x;
  return all;
}

inline void set_lane(double& x, int /*lane*/, double value) {
  x = value;
}
inline void set_lane(Lanes& x, int lane, double value) {
  x.set(lane, value);
}
template <class Real>
void set_velocity_gradient(Point<Real>& p, int lane, const Tensor<double>& L) {
  Tensor<Real>& to = p.velocity_gradient;
  set_lane(to.xx, lane, L.xx), set_lane(to.xy, lane, L.xy), set_lane(to.xz, lane, L.xz);
  set_lane(to.yx, lane, L.yx), set_lane(to.yy, lane, L.yy), set_lane(to.yz, lane, L.yz);
  set_lane(to.zx, lane, L.zx), set_lane(to.zy, lane, L.zy), set_lane(to.zz, lane, L.zz);
}
template <class Real>
State<double> state_of(State<Real> s, int of_lane) {
  State<double> result;
  const auto from = numbers(s);
  const auto to = numbers(result);
  for (std::size_t i = 0; i < to.size(); ++i) *to[i] = lane(*from[i], of_lane);
  return result;
}
template <class Real>
void set_state(State<Real>& s, int of_lane, State<double> value) {
  const auto from = numbers(value);
  const auto to = numbers(s);
  for (std::size_t i = 0; i < to.size(); ++i) set_lane(*to[i], of_lane, *from[i]);
}

/// One point under test, in the first lane. The other lanes, where there are any, take a smaller and smaller part in the
/// motion.
template <class Real>
class Specimen {
 public:
  explicit Specimen(Material m, double temperature = room_temperature) : Specimen(m, initial_state(m, temperature)) {}
  Specimen(Material m, const State<double>& start) : material(std::move(m)) {
    batch.size = 1;
    for (int i = 0; i < width_of<Real>; ++i) set_state(batch.points[0].state, i, start);
  }

  void step(const Tensor<double>& L, double dt) {
    for (int i = 0; i < width_of<Real>; ++i) set_velocity_gradient(batch.points[0], i, (1.0 - 0.1 * i) * L);
    batch.time += dt;
    update(material, batch, dt);
  }
  void steps(int count, const Tensor<double>& L, double dt) {
    for (int i = 0; i < count; ++i) step(L, dt);
  }

  State<double> state() const { return state_of(batch.points[0].state, 0); }
  /// A number that the phases leave in the point.
  double operator[](Real Point<Real>::*member) const { return lane(batch.points[0].*member, 0); }
  Trouble trouble() const { return static_cast<Trouble>(static_cast<int>((*this)[&Point<Real>::trouble])); }
  double equivalent_stress() const { return brisance::equivalent_stress(deviator(state().stress)); }
  double mean_stress() const { return trace(state().stress) / 3.0; }

  Material material;
  Batch<Real> batch;
};

}  // namespace brisance::samples
