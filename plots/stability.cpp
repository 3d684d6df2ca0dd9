// Onset of instability along a path. The margins of the stability laws are compared with the tangent of the update itself,
// found by small strain increments in all directions, and with the peak of the adiabatic curve.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "driver/point.hpp"
#include "gallery.hpp"
#include "models/update.hpp"
#include "runs.hpp"

namespace brisance::plots {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using S = SymmetricTensor<double>;
using Stiffness = Eigen::Matrix<double, 6, 6>;  // column c: stress components of the strain that is one in component c

constexpr double shear_modulus = 80e9, bulk_modulus = 165e9;

/// Elastic constants that do not change, so that the tangent has no part but Ce and the plastic one; a flow stress without
/// rate, because the laws judge the tangent at a frozen rate.
Material idealised(std::string_view name) {
  Material material = read(name);
  material.shear_modulus = shear_modulus::Constant{shear_modulus};
  material.equation_of_state = equation_of_state::Logarithmic{material.density, bulk_modulus, 477.0, 298.0};
  return material;
}
Material rate_independent_4340() {
  Material material = idealised("steel_4340");
  std::get<flow_stress::JohnsonCook>(*material.flow_stress).C = 0.0;
  return material;
}
Material porous_4340() {
  Material material = rate_independent_4340();
  const Material hy100 = read("steel_hy100");
  material.yield = hy100.yield;
  material.porosity = hy100.porosity;
  return material;
}

// The tangent by differences ------------------------------------------------------------------------------------------

std::array<double S::*, 6> components{&S::xx, &S::yy, &S::zz, &S::yz, &S::xz, &S::xy};

/// Stress increment over the second of two equal strain increments: the first brings in the heat of its own work.
S stress_increment(driver::PointUpdate& update, const State<double>& state, const S& strain) {
  constexpr double dt = 1e-9;
  const Tensor<double> L = to_tensor((1.0 / dt) * strain);
  const State<double> first = update(state, L, dt, dt).state;
  return update(first, L, dt, dt).state.stress - first.stress;
}

/// Cep by differences around the direction that the point is being strained in.
Stiffness tangent(driver::PointUpdate& update, const State<double>& state, const S& direction) {
  constexpr double size = 2e-7, turn = 0.2;
  const S along = (size / norm(direction)) * direction;
  Stiffness C;
  for (int c = 0; c < 6; ++c) {
    S plus = along, minus = along;
    plus.*components[c] += turn * size;
    minus.*components[c] -= turn * size;
    const S change = stress_increment(update, state, plus) - stress_increment(update, state, minus);
    for (int r = 0; r < 6; ++r) C(r, c) = change.*components[r] / (2.0 * turn * size);
  }
  return C;
}
Stiffness elastic() {
  Stiffness C = Stiffness::Zero();
  C.topLeftCorner<3, 3>().setConstant(bulk_modulus - 2.0 / 3.0 * shear_modulus);
  C.diagonal().array() += 2.0 * shear_modulus;
  return C;
}

/// det of m.C.m
double acoustic_determinant(const Stiffness& C, const Vector3d& m) {
  Matrix3d Q;
  for (int k = 0; k < 3; ++k) {
    const Matrix3d e = 0.5 * (Vector3d::Unit(k) * m.transpose() + m * Vector3d::Unit(k).transpose());
    Eigen::Matrix<double, 6, 1> strain, stress;
    strain << e(0, 0), e(1, 1), e(2, 2), e(1, 2), e(0, 2), e(0, 1);
    stress = C * strain;
    Matrix3d s;
    s << stress[0], stress[5], stress[4], stress[5], stress[1], stress[3], stress[4], stress[3], stress[2];
    Q.col(k) = s * m;
  }
  return Q.determinant();
}
/// Least det(m.C.m)/det(m.Ce.m) over all directions m: a search on the hemisphere, then ever finer around the best.
double least_determinant(const Stiffness& C) {
  const double whole = shear_modulus * shear_modulus * (bulk_modulus + 4.0 / 3.0 * shear_modulus);
  const auto direction = [](double polar, double azimuth) {
    return Vector3d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
  };
  double best = 1e300, polar = 0.0, azimuth = 0.0;
  const auto look = [&](double a, double b) {
    const double value = acoustic_determinant(C, direction(a, b)) / whole;
    if (value < best) best = value, polar = a, azimuth = b;
  };
  constexpr double coarse = 4.0 / degrees;
  for (double a = 0.0; a <= 0.5 * std::numbers::pi; a += coarse)
    for (double b = 0.0; b < 2.0 * std::numbers::pi; b += coarse) look(a, b);
  for (double span = coarse; span > 1e-7; span *= 0.5) {
    const double a = polar, b = azimuth;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) look(a + 0.5 * i * span, b + 0.5 * j * span);
  }
  return best;
}

// Margins along a path -------------------------------------------------------------------------------------------------

struct Margins {
  Run run{};
  std::vector<double> drucker{}, acoustic{};                            // the laws' own, step by step
  std::vector<double> stations{}, drucker_search{}, acoustic_search{};  // from the tangent by differences
  double disagreement = 0.0;
};

/// With x = Hd/(N:Ce:N), the determinants of Cep and of the acoustic tensor over the elastic ones are x/(1 + x) and
/// (margin of the acoustic law)/(1 + x).
Margins margins(Material material, const driver::LoadingPath& path) {
  material.stability = {stability::AcousticTensor{}};
  Margins result{.run = follow(material, path)};
  result.acoustic = result.run["stability_margin"];
  material.stability = {stability::Drucker{0.0}};
  result.drucker = follow(material, path)["stability_margin"];
  driver::PointUpdate update(material);
  State<double> state = result.run.outcome.start;
  const auto& taken = result.run.outcome.taken;
  constexpr std::size_t stations = 14;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Tensor<double>& L = taken[i].velocity_gradient;
    state = update(state, L, taken[i].duration, 0.0).state;
    if ((i + 1) % (taken.size() / stations) != 0 || !(result.run["plastic_strain"][i] > 0.0)) continue;
    const Stiffness C = tangent(update, state, symmetric_part(L));
    const double x = result.drucker[i + 1], of_tangent = C.determinant() / elastic().determinant();
    result.stations.push_back(state.plastic_strain);
    result.drucker_search.push_back(of_tangent * (1.0 + x));
    result.acoustic_search.push_back(least_determinant(C) * (1.0 + x));
    result.disagreement = std::max({result.disagreement, std::abs(result.drucker_search.back() - x),
                                    std::abs(result.acoustic_search.back() - result.acoustic[i + 1])});
  }
  return result;
}

/// Where a falling margin passes zero; none if it does not.
std::optional<double> onset(const std::vector<double>& strain, const std::vector<double>& margin) {
  for (std::size_t i = 1; i < margin.size(); ++i)
    if (strain[i] > 0.0 && margin[i] <= 0.0 && margin[i - 1] > 0.0)
      return strain[i - 1] + (strain[i] - strain[i - 1]) * margin[i - 1] / (margin[i - 1] - margin[i]);
  return std::nullopt;
}
void mark(Panel& panel, std::string title, std::optional<double> at, double bottom, double top, int colour) {
  if (at) panel.curves.push_back({std::move(title), {*at, *at}, {bottom, top}, Mark::dashed, colour});
}
Curve without_elastic_part(std::string title, const Margins& m, const std::vector<double>& margin, Mark style, int colour) {
  Curve result{std::move(title), {}, {}, style, colour};
  for (std::size_t i = 0; i < margin.size(); ++i)
    if (m.run["plastic_strain"][i] > 0.004 && (i % 4 == 0 || i < 40))
      result.x.push_back(m.run["plastic_strain"][i]), result.y.push_back(margin[i]);
  return result;
}

driver::LoadingPath pure_shear(double strain_rate, double temperature, double plastic_strain) {
  driver::LoadingPath path = constant_volume(strain_rate, temperature, plastic_strain);
  path.segments[0].velocity_gradient.yy = -strain_rate;
  path.segments[0].velocity_gradient.zz = 0.0;
  return path;
}
void von_mises(std::vector<Panel>& panels, std::vector<Check>& checks) {
  Panel stress{.title = "4340 steel, von Mises: adiabatic curve in shear",
               .x_label = "plastic strain",
               .y_label = "equivalent stress (MPa)"};
  stress.legend = "bottom left";
  stress.x_range = {0.0, 0.6}, stress.y_range = {600.0, 1400.0};
  Panel margin{.title = "margins at 298 K coincide; points: tangent by differences",
               .x_label = "plastic strain",
               .y_label = "margin (unstable below 0)"};
  margin.legend = "top right";
  margin.x_range = {0.0, 0.6}, margin.y_range = {-0.005, 0.03};
  const Material steel = rate_independent_4340();
  double late = 0.0;
  int colour = 0;
  for (const double T0 : {298.0, 500.0}) {
    const Margins m = margins(steel, pure_shear(1e3, T0, 0.6));
    const std::vector<double>&strain = m.run["plastic_strain"], &q = m.run["equivalent_stress"];
    const auto first = onset(strain, m.drucker);
    const double peak = strain[static_cast<std::size_t>(std::max_element(q.begin(), q.end()) - q.begin())];
    late = std::max(late, std::abs(first.value_or(1e3) - peak));
    stress.curves.push_back(curve(fmt::format("{:g} K", T0), strain, q, 1.0, 1e-6, Mark::line, colour));
    mark(stress, fmt::format("Drucker, ep = {:.3f}", first.value_or(0.0)), first, 600.0,
         1e-6 * *std::max_element(q.begin(), q.end()), colour);
    ++colour;
    if (T0 > 300.0) continue;
    checks.push_back({"von Mises in shear: largest difference of a margin", "determinants of the tangent by differences",
                      m.disagreement, 1e-3});
    margin.curves.push_back(without_elastic_part("shear: Drucker", m, m.drucker, Mark::line, 0));
    margin.curves.push_back(without_elastic_part("shear: acoustic", m, m.acoustic, Mark::dashed, 4));
    margin.curves.push_back({"", m.stations, m.acoustic_search, Mark::points, 4});
  }
  driver::LoadingPath cold = pure_shear(1e3, 298.0, 0.6);
  cold.heat = driver::Heat::isothermal;
  const Run run = follow(steel, cold);
  stress.curves.push_back(
      curve("298 K, isothermal", run["plastic_strain"], run["equivalent_stress"], 1.0, 1e-6, Mark::line, 6));
  const Margins tension = margins(steel, constant_volume(1e3, 298.0, 0.6));
  checks.push_back({"von Mises in tension: largest difference of a margin", "determinants of the tangent by differences",
                    tension.disagreement, 1e-3});
  margin.curves.push_back({"", {0.0, 0.6}, {0.0, 0.0}, Mark::line, 6});
  // Two steps of the run.
  checks.push_back({"von Mises: strain at Drucker's onset less strain at the peak", "peak of the adiabatic curve", late, 1e-3});
  panels.push_back(std::move(stress)), panels.push_back(std::move(margin));
}

void porous(std::vector<Panel>& panels, std::vector<Check>& checks) {
  driver::LoadingPath path = constant_triaxiality(0.8, 24.0, 1e3, 298.0, 1.0);
  path.segments[0].until = driver::Until{"porosity", 0.12};
  const Margins m = margins(porous_4340(), path);
  const std::vector<double>& strain = m.run["plastic_strain"];
  const auto first = onset(strain, m.drucker), second = onset(strain, m.acoustic);
  Panel stress{.title = "4340 steel with voids: triaxiality 0.8, Lode angle 24°",
               .x_label = "plastic strain of the matrix",
               .y_label = "equivalent stress (MPa)"};
  stress.y_range = {0.0, 1800.0};
  stress.legend = "top right";
  stress.curves.push_back(curve("equivalent stress", strain, m.run["equivalent_stress"], 1.0, 1e-6, Mark::line, 0));
  stress.curves.push_back(curve("10000 × porosity", strain, m.run["porosity"], 1.0, 1e4, Mark::line, 2));
  mark(stress, fmt::format("Drucker, ep = {:.3f}", first.value_or(0.0)), first, 0.0, 1250.0, 1);
  mark(stress, fmt::format("acoustic tensor, ep = {:.3f}", second.value_or(0.0)), second, 0.0, 1250.0, 3);
  Panel margin{.title = "margins; points: tangent by differences",
               .x_label = "plastic strain of the matrix",
               .y_label = "margin (unstable below 0)"};
  margin.legend = "top right";
  margin.x_range = stress.x_range = {0.0, 0.4}, margin.y_range = {-0.05, 0.06};
  margin.curves = {without_elastic_part("Drucker", m, m.drucker, Mark::line, 1),
                   {"", m.stations, m.drucker_search, Mark::points, 1},
                   without_elastic_part("acoustic tensor", m, m.acoustic, Mark::line, 3),
                   {"", m.stations, m.acoustic_search, Mark::points, 3},
                   {"", {0.0, 0.4}, {0.0, 0.0}, Mark::line, 6}};
  checks.push_back(
      {"porous: largest difference of a margin", "determinants of the tangent by differences", m.disagreement, 1e-3});
  checks.push_back({"porous: strain from Drucker's onset to the acoustic one",
                    "not negative for associated flow",
                    second.value_or(1e3) - first.value_or(0.0),
                    {}});
  panels.push_back(std::move(stress)), panels.push_back(std::move(margin));
}

}  // namespace

Picture stability() {
  Picture picture;
  picture.figure = {.title = "Onset of instability (Johnson-Cook 4340, rate frozen): 1000 /s, adiabatic",
                    .panels = {},
                    .columns = 2,
                    .panel_width = 600,
                    .panel_height = 430};
  von_mises(picture.figure.panels, picture.checks);
  porous(picture.figure.panels, picture.checks);
  return picture;
}

}  // namespace brisance::plots
