#include "driver/history.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "driver/hdf5_file.hpp"
#include "models/update.hpp"

namespace brisance::driver {
namespace {

/// ln V of F = V R.
SymmetricTensor<double> logarithmic_strain(const Tensor<double>& F) {
  const SymmetricTensor<double> B = times_own_transpose(F);
  Eigen::Matrix3d matrix;
  matrix << B.xx, B.xy, B.xz, B.xy, B.yy, B.yz, B.xz, B.yz, B.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const Eigen::Matrix3d strain = solver.eigenvectors() * (0.5 * solver.eigenvalues().array().log()).matrix().asDiagonal() *
                                 solver.eigenvectors().transpose();
  return {strain(0, 0), strain(1, 1), strain(2, 2), strain(1, 2), strain(0, 2), strain(0, 1)};
}

template <class T>
void add_components(std::vector<Column>& columns, std::string_view name, std::string_view unit, T&& tensor_of) {
  using S = SymmetricTensor<double>;
  constexpr std::pair<std::string_view, double S::*> components[] = {{"xx", &S::xx}, {"yy", &S::yy}, {"zz", &S::zz},
                                                                     {"yz", &S::yz}, {"xz", &S::xz}, {"xy", &S::xy}};
  for (const auto& [suffix, member] : components)
    columns.push_back({fmt::format("{}_{}", name, suffix), std::string(unit),
                       [tensor_of, m = member](const Sample& s) { return tensor_of(s.point).*m; }});
}

double pressure_of(const Point<double>& p) {
  return -trace(p.state.stress) / 3.0;
}
double equivalent_of(const Point<double>& p) {
  return equivalent_stress(deviator(p.state.stress));
}

/// The history columns that the laws of this material declare.
void add_law_columns(std::vector<Column>& columns, const Material& material) {
  if (material.flow_stress)
    std::visit(
        [&]<class Law>(const Law&) {
          if constexpr (flow_stress::WithHistory<Law>)
            columns.push_back({std::string(Law::history.name), std::string(Law::history.unit.text),
                               [](const Sample& s) { return s.point.state.flow_history; }});
        },
        *material.flow_stress);
  if (material.viscoelastic)
    std::visit(
        [&]<class Law>(const Law&) {
          for (std::size_t i = 0; i < Law::history.size(); ++i)
            columns.push_back({std::string(Law::history[i].name), std::string(Law::history[i].unit.text),
                               [i](const Sample& s) { return s.point.state.history[i]; }});
        },
        *material.viscoelastic);
}

}  // namespace

std::vector<Column> columns_of(const Material& material) {
  using S = Sample;
  using F = Tensor<double>;
  std::vector<Column> columns;
  const auto add = [&](std::string name, std::string unit, std::function<double(const Sample&)> value) {
    columns.push_back({std::move(name), std::move(unit), std::move(value)});
  };
  add("time", "s", [](const S& s) { return s.time; });
  add("segment", "1", [](const S& s) { return s.segment; });
  add_components(columns, "stress", "Pa", [](const Point<double>& p) { return p.state.stress; });
  add("mean_stress", "Pa", [](const S& s) { return -pressure_of(s.point); });
  add("pressure", "Pa", [](const S& s) { return pressure_of(s.point); });
  add("equivalent_stress", "Pa", [](const S& s) { return equivalent_of(s.point); });
  add("triaxiality", "1", [](const S& s) {
    const double q = equivalent_of(s.point);
    return q > 0.0 ? -pressure_of(s.point) / q : 0.0;
  });
  add_components(columns, "strain", "1",
                 [](const Point<double>& p) { return logarithmic_strain(p.state.deformation_gradient); });
  add("accumulated_strain", "1", [](const S& s) { return s.accumulated_strain; });
  constexpr std::pair<std::string_view, double F::*> components[] = {{"xx", &F::xx}, {"xy", &F::xy}, {"xz", &F::xz},
                                                                     {"yx", &F::yx}, {"yy", &F::yy}, {"yz", &F::yz},
                                                                     {"zx", &F::zx}, {"zy", &F::zy}, {"zz", &F::zz}};
  for (const auto& [suffix, member] : components)
    add(fmt::format("F_{}", suffix), "1", [m = member](const S& s) { return s.point.state.deformation_gradient.*m; });
  add("density", "kg/m^3", [](const S& s) { return s.point.state.density; });
  add("temperature", "K", [](const S& s) { return s.point.state.temperature; });
  add("energy", "J/kg", [](const S& s) { return s.point.state.energy; });
  add("plastic_strain", "1", [](const S& s) { return s.point.state.plastic_strain; });
  add("plastic_strain_rate", "1/s", [](const S& s) { return s.point.state.plastic_strain_rate; });
  add("plastic_volume_strain", "1", [](const S& s) { return s.point.state.plastic_volume_strain; });
  add("flow_stress", "Pa", [](const S& s) { return s.point.flow_stress; });
  add("porosity", "1", [](const S& s) { return s.point.state.porosity; });
  add("damage", "1", [](const S& s) { return s.point.state.damage; });
  add_law_columns(columns, material);
  add("shear_modulus", "Pa", [](const S& s) { return s.point.state.shear_modulus; });
  add("bulk_modulus", "Pa", [](const S& s) { return s.point.bulk_modulus; });
  add("sound_speed", "m/s", [](const S& s) { return longitudinal_sound_speed(s.point); });
  if (material.melting) add("melting_temperature", "K", [](const S& s) { return s.point.melting_temperature; });
  add("artificial_viscosity", "Pa", [](const S& s) { return s.point.artificial_viscosity; });
  if (!material.stability.empty()) add("stability_margin", "1", [](const S& s) { return s.point.stability_margin; });
  add("failure_cause", "1", [](const S& s) { return s.point.state.failure_cause; });
  add("failure_time", "s", [](const S& s) { return s.point.state.failure_time; });
  return columns;
}

const Record::Series* Record::find(std::string_view name) const {
  for (const Series& s : series)
    if (s.name == name) return &s;
  return nullptr;
}

History::History(const Material& material, OutputDensity density) : columns_(columns_of(material)), density_(density) {
  for (const Column& column : columns_) record_.series.push_back({column.name, column.unit, {}});
}

void History::record(const Sample& sample, bool keep_always) {
  const long every = density_.every > 0 ? density_.every : stride_;
  const bool keep = keep_always || step_ % every == 0;
  ++step_;
  if (!keep) return;
  for (std::size_t i = 0; i < columns_.size(); ++i) record_.series[i].values.push_back(columns_[i].value(sample));
  kept_always_.push_back(keep_always);
  if (density_.every == 0 && record_.rows() >= 2 * static_cast<std::size_t>(density_.rows)) drop_every_other();
}

void History::drop_every_other() {
  std::vector<std::size_t> kept;
  bool odd = false;
  for (std::size_t row = 0; row < record_.rows(); ++row) {
    if (kept_always_[row] || !odd) kept.push_back(row);
    if (!kept_always_[row]) odd = !odd;
  }
  std::vector<bool> flags;
  for (const std::size_t row : kept) flags.push_back(kept_always_[row]);
  kept_always_ = std::move(flags);
  for (Record::Series& s : record_.series) {
    for (std::size_t i = 0; i < kept.size(); ++i) s.values[i] = s.values[kept[i]];
    s.values.resize(kept.size());
  }
  stride_ *= 2;
}

void write_csv(const Record& record, const std::filesystem::path& path) {
  std::string text;
  for (std::size_t i = 0; i < record.series.size(); ++i)
    text += fmt::format("{}{} [{}]", i ? "," : "", record.series[i].name, record.series[i].unit);
  text += "\n";
  for (std::size_t row = 0; row < record.rows(); ++row) {
    for (std::size_t i = 0; i < record.series.size(); ++i)
      text += fmt::format("{}{}", i ? "," : "", record.series[i].values[row]);
    text += "\n";
  }
  replace_file_by_text(path, text);
}

void write(const Record& record, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".csv") return write_csv(record, path);
  if (ending == ".h5" || ending == ".hdf5")
    return replace_file(path, [&](const std::filesystem::path& temporary) { write_hdf5(record, temporary); });
  throw std::invalid_argument(fmt::format("{}: the ending of a history file is .csv, .h5 or .hdf5", path.string()));
}

}  // namespace brisance::driver
