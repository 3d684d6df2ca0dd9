// GCC 12 mistakes the undefined lanes of its own AVX-512 header for ours (GCC bug 105593).
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#include "driver/calibrate.hpp"

// Ceres, because the problem is a sum of squares: its trust region with bounds uses the Jacobian of all residuals, where
// NLopt's algorithms would see one number. The same Jacobian then gives the confidence intervals.
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "driver/commands.hpp"
#include "driver/keys.hpp"
#include "driver/plot.hpp"
#include "models/equation_of_state/thermodynamics.hpp"
#include "models/visit.hpp"

namespace brisance::driver {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// The flow curve ------------------------------------------------------------------------------------------------------

/// A specimen in uniaxial stress that flows at a steady rate.
template <class Law>
class Specimen {
 public:
  Specimen(const Material& material, const Law& law, const Test& test, const Protocol& protocol)
      : material_(material), law_(law), test_(test), protocol_(protocol), temperature_(test.temperature) {
    adiabatic_ = test.strain_rate >= protocol.adiabatic_from && material.heating && material.specific_heat;
    visit_law(material.equation_of_state, [&](const auto& equation) {
      const double rho = material.density;
      bulk_modulus_ = rho * equation_of_state::sound_speed_squared(equation, rho, equation.energy(rho, test.temperature));
    });
    stress_ = flow_stress(temperature_, 0.0, 0.0, history_);
  }

  /// The stress at a plastic strain beyond the last one.
  double at(double plastic_strain) {
    constexpr double largest_step = 5e-3;
    const bool evolves = adiabatic_ || flow_stress::WithHistory<Law>;
    const int steps = evolves ? std::max(1, static_cast<int>(std::ceil((plastic_strain - strain_) / largest_step))) : 1;
    const double step = (plastic_strain - strain_) / steps;
    if (step > 0.0)
      for (int i = 0; i < steps; ++i) advance(step);
    return stress_;
  }

 private:
  const Material& material_;
  const Law& law_;
  const Test& test_;
  const Protocol& protocol_;
  bool adiabatic_ = false;
  double bulk_modulus_ = 0.0;
  double temperature_, strain_ = 0.0, stress_ = 0.0, history_ = 0.0;

  flow_stress::Arguments<double> arguments(double T, double strain, double stress) const {
    const double mean = stress / 3.0, p = test_.pressure + (protocol_.compression ? mean : -mean);
    const double compression = 1.0 + p / bulk_modulus_;
    double melting = 1e30, mu = 0.0;
    visit_law(material_.melting, [&](const auto& law) { melting = law(melting::Arguments<double>{p, compression}); });
    visit_law(material_.shear_modulus, [&](const auto& law) {
      mu = law(shear_modulus::Arguments<double>{T, melting, p, compression * material_.density, compression});
    });
    return {strain, test_.strain_rate, T, melting, mu, p, compression * material_.density};
  }
  double flow_stress(double T, double strain, double stress, double history) const {
    if constexpr (flow_stress::WithHistory<Law>)
      return law_(arguments(T, strain, stress), history);
    else
      return law_(arguments(T, strain, stress));
  }

  /// Second order in the step. The history takes an exponential step, exact for hardening linear in it and stable for any; at
  /// the temperature of the middle. The number of steps depends on the data alone, so the curve is smooth in all parameters.
  void advance(double step) {
    const double T0 = temperature_, Y0 = stress_;
    double heating = 0.0;  // K per Pa of stress over the step
    if (adiabatic_)
      visit_law(material_.specific_heat, [&](const auto& law) {
        heating = material_.heating->taylor_quinney(strain_ + 0.5 * step) * step / (material_.density * law(T0));
      });
    if constexpr (flow_stress::WithHistory<Law>) {
      const auto middle = arguments(T0 + 0.5 * heating * Y0, strain_ + 0.5 * step, Y0);
      const auto hardening = law_.hardening(middle)(Dual<double>::variable(history_));
      const double x = step * hardening.derivative[0];
      history_ += step * hardening.value * (std::fabs(x) > 1e-12 ? std::expm1(x) / x : 1.0);
      history_ = std::max(history_, 0.0);
    }
    strain_ += step;
    const double predicted = flow_stress(T0 + heating * Y0, strain_, Y0, history_);
    temperature_ = T0 + heating * 0.5 * (Y0 + predicted);
    stress_ = flow_stress(temperature_, strain_, predicted, history_);
  }
};

/// The measured points of a test that count, by increasing plastic strain.
std::vector<std::size_t> points_of(const Test& test, const Protocol& protocol) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < test.stress.size(); ++i)
    if (counts(test, i, protocol)) points.push_back(i);
  std::stable_sort(points.begin(), points.end(),
                   [&](std::size_t a, std::size_t b) { return test.plastic_strain[a] < test.plastic_strain[b]; });
  return points;
}

// Least squares -------------------------------------------------------------------------------------------------------

/// The way from a parameter to the number that is searched: 1 at the lower bound and 2 at the upper, so that all are of one
/// size and none is zero.
double to_unit(const FitParameter& p, double value) {
  return 1.0 +
         (p.logarithmic ? std::log(value / p.lower) / std::log(p.upper / p.lower) : (value - p.lower) / (p.upper - p.lower));
}
double from_unit(const FitParameter& p, double u) {
  return p.logarithmic ? p.lower * std::pow(p.upper / p.lower, u - 1.0) : p.lower + (u - 1.0) * (p.upper - p.lower);
}

class FlowCurves {
 public:
  explicit FlowCurves(const Calibration& calibration) : calibration_(calibration), material_(calibration.file.material) {
    for (const FitParameter& p : calibration.parameters) values_.push_back(find_parameter(material_, p.key));
    for (const Test& test : calibration.tests) {
      const auto points = points_of(test, calibration.protocol);
      std::vector<double> strain, stress;
      for (const std::size_t i : points) strain.push_back(test.plastic_strain[i]), stress.push_back(test.stress[i]);
      size_ += static_cast<int>(points.size());
      strains_.push_back(std::move(strain)), measured_.push_back(std::move(stress));
    }
  }

  int size() const { return size_; }
  int evaluations() const { return evaluations_; }
  const Material& material() const { return material_; }

  void set(const double* unit) {
    for (std::size_t i = 0; i < values_.size(); ++i) *values_[i] = from_unit(calibration_.parameters[i], unit[i]);
  }
  /// Residuals in MPa, or as fractions.
  void residuals(const double* unit, double* result) {
    set(unit);
    ++evaluations_;
    for (std::size_t t = 0; t < calibration_.tests.size(); ++t) {
      const auto computed = flow_curve(material_, calibration_.tests[t], calibration_.protocol, strains_[t]);
      for (std::size_t i = 0; i < computed.size(); ++i) {
        const double scale = calibration_.residual == Residual::absolute ? 1e6 : measured_[t][i];
        *result++ = (computed[i] - measured_[t][i]) / scale;
      }
    }
  }
  /// Central differences; one-sided ones at a bound, since laws are not defined beyond.
  Matrix jacobian(const double* unit) {
    constexpr double step = 1e-6;
    const Eigen::Index n = static_cast<Eigen::Index>(values_.size());
    Matrix J(size_, n);
    Vector at = Eigen::Map<const Vector>(unit, n), above(size_), below(size_);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double up = std::min(at[k] + step, 2.0), down = std::max(at[k] - step, 1.0), here = at[k];
      at[k] = up, residuals(at.data(), above.data());
      at[k] = down, residuals(at.data(), below.data());
      at[k] = here;
      J.col(k) = (above - below) / (up - down);
    }
    return J;
  }

  FitOfTest fit_of(std::size_t t) const {
    FitOfTest fit;
    fit.plastic_strain = strains_[t];
    fit.stress = flow_curve(material_, calibration_.tests[t], calibration_.protocol, strains_[t]);
    fit.points = static_cast<int>(fit.stress.size());
    for (std::size_t i = 0; i < fit.stress.size(); ++i) {
      const double error = fit.stress[i] - measured_[t][i], relative = error / measured_[t][i];
      fit.rms += error * error, fit.relative_rms += relative * relative, fit.mean_relative += relative;
    }
    if (fit.points == 0) return fit;
    fit.rms = std::sqrt(fit.rms / fit.points), fit.relative_rms = std::sqrt(fit.relative_rms / fit.points);
    fit.mean_relative /= fit.points;
    return fit;
  }

 private:
  const Calibration& calibration_;
  Material material_;
  std::vector<double*> values_;
  std::vector<std::vector<double>> strains_, measured_;
  int size_ = 0, evaluations_ = 0;
};

class Cost : public ceres::CostFunction {
 public:
  Cost(FlowCurves& curves, int parameters) : curves_(curves) {
    set_num_residuals(curves.size());
    mutable_parameter_block_sizes()->push_back(parameters);
  }
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    curves_.residuals(parameters[0], residuals);
    if (jacobians && jacobians[0]) {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      const Matrix J = curves_.jacobian(parameters[0]);
      Eigen::Map<RowMajor>(jacobians[0], J.rows(), J.cols()) = J;
    }
    return std::all_of(residuals, residuals + num_residuals(), [](double r) { return std::isfinite(r); });
  }

 private:
  FlowCurves& curves_;
};

struct Minimum {
  std::vector<double> unit;
  double cost = std::numeric_limits<double>::infinity();
  bool converged = false;
};

Minimum minimise(FlowCurves& curves, std::vector<double> unit) {
  const int n = static_cast<int>(unit.size());
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(curves, n), nullptr, unit.data());  // the problem owns it
  for (int k = 0; k < n; ++k) {
    problem.SetParameterLowerBound(unit.data(), k, 1.0);
    problem.SetParameterUpperBound(unit.data(), k, 2.0);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-9;
  options.gradient_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {unit, summary.final_cost, summary.termination_type == ceres::CONVERGENCE};
}

/// Starts after the first are spread over the bounds.
Minimum minimise_from_all_starts(const Calibration& calibration, FlowCurves& curves) {
  std::mt19937_64 random(calibration.seed);
  Minimum best;
  for (int start = 0; start < std::max(calibration.starts, 1); ++start) {
    std::vector<double> unit;
    for (const FitParameter& p : calibration.parameters)
      unit.push_back(start == 0 ? to_unit(p, p.start) : 1.0 + static_cast<double>(random() >> 11) * 0x1p-53);
    const Minimum found = minimise(curves, unit);
    if (found.cost < best.cost) best = found;
  }
  return best;
}

/// Covariance s^2 (J^T J)^-1 of the free parameters, by the singular values of J with its columns scaled to one length. Where
/// some combination of parameters leaves all residuals as they are, the parameters in it are not identifiable.
void estimate_uncertainty(const Calibration& calibration, const Minimum& minimum, FlowCurves& curves, Fit& fit) {
  constexpr double at_bound = 1e-7, singular = 1e-6, involved = 0.1;
  const Eigen::Index n = static_cast<Eigen::Index>(minimum.unit.size());
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double u = minimum.unit[static_cast<std::size_t>(k)];
    Estimate& estimate = fit.estimates[static_cast<std::size_t>(k)];
    estimate.at_bound = u - 1.0 < at_bound || 2.0 - u < at_bound;
    if (!estimate.at_bound) free.push_back(k);
  }
  const Eigen::Index m = static_cast<Eigen::Index>(free.size());
  fit.degrees_of_freedom = fit.points - static_cast<int>(m);
  const double s = std::sqrt(2.0 * minimum.cost / fit.degrees_of_freedom);
  fit.residual_deviation = calibration.residual == Residual::absolute ? 1e6 * s : s;
  fit.correlation.assign(static_cast<std::size_t>(n), std::vector<double>(static_cast<std::size_t>(n), 0.0));
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) fit.correlation[k][k] = 1.0;
  if (m == 0) return;

  const Matrix J = curves.jacobian(minimum.unit.data());
  Vector length(m);
  Matrix scaled(J.rows(), m);
  for (Eigen::Index i = 0; i < m; ++i) {
    length[i] = J.col(free[static_cast<std::size_t>(i)]).norm();
    scaled.col(i) = J.col(free[static_cast<std::size_t>(i)]) / std::max(length[i], 1e-300);
  }
  const Eigen::JacobiSVD<Matrix> svd(scaled, Eigen::ComputeThinV);
  const Vector sigma = svd.singularValues();
  const Matrix& V = svd.matrixV();
  Matrix covariance = Matrix::Zero(m, m);
  std::vector<bool> lost(static_cast<std::size_t>(m), false);
  for (Eigen::Index j = 0; j < m; ++j) {
    if (sigma[j] > singular * sigma[0]) {
      covariance += V.col(j) * V.col(j).transpose() / (sigma[j] * sigma[j]);
      continue;
    }
    for (Eigen::Index i = 0; i < m; ++i)
      if (std::fabs(V(i, j)) > involved) lost[static_cast<std::size_t>(i)] = true;
  }
  const double t = boost::math::quantile(boost::math::students_t(fit.degrees_of_freedom), 0.975);
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t k = static_cast<std::size_t>(free[static_cast<std::size_t>(i)]);
    const FitParameter& p = calibration.parameters[k];
    Estimate& estimate = fit.estimates[k];
    const double u = minimum.unit[k];
    if (lost[static_cast<std::size_t>(i)]) {
      estimate.identifiable = false;
      estimate.standard_error = std::numeric_limits<double>::infinity();
      estimate.lower_95 = p.lower, estimate.upper_95 = p.upper;
      continue;
    }
    const double error = s * std::sqrt(covariance(i, i)) / length[i];
    const double per_unit = p.logarithmic ? estimate.value * std::log(p.upper / p.lower) : p.upper - p.lower;
    estimate.standard_error = per_unit * error;
    estimate.lower_95 = from_unit(p, u - t * error), estimate.upper_95 = from_unit(p, u + t * error);
    for (Eigen::Index j = 0; j < m; ++j)
      fit.correlation[k][static_cast<std::size_t>(free[static_cast<std::size_t>(j)])] =
          covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
  }
}

void add_warnings(const Calibration& calibration, Fit& fit) {
  if (!fit.converged) fit.warnings.push_back("the search ended before it converged: what follows may not be the minimum");
  std::string unknown;
  for (std::size_t k = 0; k < fit.estimates.size(); ++k) {
    const FitParameter& p = calibration.parameters[k];
    const Estimate& e = fit.estimates[k];
    if (e.at_bound)
      fit.warnings.push_back(
          fmt::format("{} is at its {} bound, {:g}: the measurements ask for more; widen the bound or fix the value", p.key,
                      e.value - p.lower < p.upper - e.value ? "lower" : "upper", e.value));
    if (!e.identifiable) unknown += (unknown.empty() ? "" : ", ") + p.key;
  }
  if (!unknown.empty())
    fit.warnings.push_back(fmt::format(
        "the measurements do not tell {} (they change no residual, or only together): fix one, or add other tests", unknown));
  for (std::size_t i = 0; i < fit.estimates.size(); ++i)
    for (std::size_t j = i + 1; j < fit.estimates.size(); ++j)
      if (std::fabs(fit.correlation[i][j]) > 0.98)
        fit.warnings.push_back(fmt::format("{} and {} are known only together: their correlation is {:+.3f}",
                                           calibration.parameters[i].key, calibration.parameters[j].key,
                                           fit.correlation[i][j]));
}

}  // namespace

double* find_parameter(Material& material, std::string_view key, Interval* interval, Unit* unit) {
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return nullptr;
  const std::string_view folder = key.substr(0, dot), name = key.substr(dot + 1);
  double* found = nullptr;
  const auto look_in_law = [&](auto& law) {
    for_each_parameter<std::remove_cvref_t<decltype(law)>>([&](const auto& row) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(law.*(row.member))>, double>)
        if (row.name == name) {
          found = &(law.*(row.member));
          if (interval) *interval = row.interval;
          if (unit) *unit = row.unit;
        }
    });
  };
  const auto look_in = [&](std::string_view component_name, auto* component) {
    if (folder == component_name && component) std::visit(look_in_law, *component);
  };
  look_in("equation_of_state", &material.equation_of_state);
  look_in("flow_stress", material.flow_stress ? &*material.flow_stress : nullptr);
  look_in("shear_modulus", material.shear_modulus ? &*material.shear_modulus : nullptr);
  look_in("melting", material.melting ? &*material.melting : nullptr);
  look_in("specific_heat", material.specific_heat ? &*material.specific_heat : nullptr);
  return found;
}

std::vector<double> flow_curve(const Material& material, const Test& test, const Protocol& protocol,
                               std::span<const double> plastic_strain) {
  std::vector<double> stress;
  stress.reserve(plastic_strain.size());
  visit_law(material.flow_stress, [&](const auto& law) {
    Specimen<std::remove_cvref_t<decltype(law)>> specimen(material, law, test, protocol);
    for (const double strain : plastic_strain) stress.push_back(specimen.at(strain));
  });
  return stress;
}

Fit calibrate(const Calibration& calibration) {
  if (!calibration.file.material.flow_stress)
    throw std::invalid_argument("calibrate: the material has no flow_stress to calibrate");
  FlowCurves curves(calibration);
  const int n = static_cast<int>(calibration.parameters.size());
  if (curves.size() <= n)
    throw std::invalid_argument(
        fmt::format("calibrate: {} points cannot determine {} parameters; points below a plastic strain of {:g} "
                    "do not count (protocol.smallest_plastic_strain)",
                    curves.size(), n, calibration.protocol.smallest_plastic_strain));
  const Minimum minimum = minimise_from_all_starts(calibration, curves);
  curves.set(minimum.unit.data());

  Fit fit;
  fit.points = curves.size();
  fit.converged = minimum.converged;
  fit.file = calibration.file;
  fit.file.material = curves.material();
  for (std::size_t k = 0; k < calibration.parameters.size(); ++k) {
    Estimate estimate;
    estimate.value = estimate.lower_95 = estimate.upper_95 = from_unit(calibration.parameters[k], minimum.unit[k]);
    fit.estimates.push_back(estimate);
    fit.file.sources[calibration.parameters[k].key] = "calibrated: " + calibration.data;
  }
  for (std::size_t t = 0; t < calibration.tests.size(); ++t) fit.tests.push_back(curves.fit_of(t));
  estimate_uncertainty(calibration, minimum, curves, fit);
  fit.evaluations = curves.evaluations();
  add_warnings(calibration, fit);
  return fit;
}

// Input ---------------------------------------------------------------------------------------------------------------

namespace {

FitParameter read_parameter(TableReader& table, MaterialFile& file) {
  const std::size_t before = table.problem_count();
  const auto keys = read_keys<ParameterKeys>(table);
  const bool material_known = !file.path.empty();
  if (!material_known || table.problem_count() > before) return {};
  FitParameter p{keys.key, keys.lower, keys.upper, 0.0, keys.scale == Scale::logarithmic};
  Interval interval;
  const double* value = find_parameter(file.material, p.key, &interval);
  if (!value) {
    table.problem("key", "\"" + p.key +
                             "\" is no number of this material; what can be fitted are numbers of its flow_stress, "
                             "shear_modulus, melting, specific_heat and equation_of_state");
    return p;
  }
  p.start = keys.start.value_or(*value);
  if (!(p.lower < p.upper)) table.problem("upper", "must be above lower");
  if (p.start < p.lower || p.start > p.upper)
    table.problem("start", fmt::format("{:g} is not between lower and upper", p.start));
  if (p.logarithmic && p.lower <= 0.0) table.problem("lower", "must be positive on a logarithmic scale");
  if (!interval.contains(p.lower)) table.problem("lower", fmt::format("{:g} is outside the range of {}", p.lower, p.key));
  if (!interval.contains(p.upper)) table.problem("upper", fmt::format("{:g} is outside the range of {}", p.upper, p.key));
  return p;
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  InputFile input = InputFile::load(file);
  for (const std::string& assignment : overrides) input.set(assignment);
  TableReader top = input.top();
  auto keys = read_keys<CalibrationKeys>(top);
  Calibration calibration;
  calibration.title = keys.title;
  calibration.file = std::move(keys.material);
  const Experiments experiments = read_experiments(top, keys.experiments);
  calibration.tests = experiments.tests, calibration.data = experiments.files;
  calibration.protocol = protocol_of(keys.protocol);
  calibration.residual = keys.residual;
  calibration.starts = keys.starts;
  calibration.seed = keys.seed;
  for (TableReader& parameter : keys.parameters) calibration.parameters.push_back(read_parameter(parameter, calibration.file));
  if (!top.has("parameter")) top.problem("there is no [[parameter]] to find");
  input.finish();
  return calibration;
}

// Report --------------------------------------------------------------------------------------------------------------

namespace {

void print_report(const Calibration& calibration, const Fit& fit) {
  const Protocol& protocol = calibration.protocol;
  fmt::print("{}\n", calibration.title);
  fmt::print("{}; {} residuals, plastic strains from {:g} on\n\n", description(protocol),
             calibration.residual == Residual::absolute ? "absolute" : "relative", protocol.smallest_plastic_strain);
  fmt::print("{:14} {:>6} {:>9} {:>9} {:>7} {:>8} {:>6} {:>6}\n", "author", "T, K", "rate, 1/s", "p, MPa", "points", "RMS, MPa",
             "RMS, %", "mean, %");
  for (std::size_t t = 0; t < fit.tests.size(); ++t) {
    const Test& test = calibration.tests[t];
    const FitOfTest& f = fit.tests[t];
    fmt::print("{:14} {:6g} {:9g} {:9g} {:7} {:8.2f} {:6.1f} {:+6.1f}\n", test.author, test.temperature, test.strain_rate,
               test.pressure * 1e-6, f.points, f.rms * 1e-6, 100.0 * f.relative_rms, 100.0 * f.mean_relative);
  }
  if (calibration.residual == Residual::absolute)
    fmt::print("\nstandard deviation of a point: {:.3f} MPa", fit.residual_deviation * 1e-6);
  else
    fmt::print("\nstandard deviation of a point: {:.2f} %", 100.0 * fit.residual_deviation);
  fmt::print(" ({} points, {} degrees of freedom; {} evaluations)\n\n", fit.points, fit.degrees_of_freedom, fit.evaluations);

  fmt::print("{:36} {:>13} {:>11}   {}\n", "parameter (SI)", "value", "std. error", "95 % confidence interval");
  for (std::size_t k = 0; k < fit.estimates.size(); ++k) {
    const Estimate& e = fit.estimates[k];
    fmt::print("{:36} {:13.6g} ", calibration.parameters[k].key, e.value);
    if (e.at_bound)
      fmt::print("{:>11}   at its bound\n", "");
    else if (!e.identifiable)
      fmt::print("{:>11}   not determined\n", "");
    else
      fmt::print("{:11.3g}   {:.6g} to {:.6g}\n", e.standard_error, e.lower_95, e.upper_95);
  }
  fmt::print(
      "The intervals hold for independent errors of the points and a model that is right. Points of one curve share errors\n"
      "and tests differ between authors, so the truth may lie farther off.\n\ncorrelation\n");
  for (std::size_t i = 0; i < fit.correlation.size(); ++i) {
    fmt::print("{:36}", calibration.parameters[i].key);
    for (std::size_t j = 0; j <= i; ++j) fmt::print(" {:+6.3f}", fit.correlation[i][j]);
    fmt::print("\n");
  }
  for (const std::string& warning : fit.warnings) fmt::print("warning: {}\n", warning);
}

/// At most `most` tests of a kind, spread over the temperatures and rates that there are.
std::vector<std::size_t> some_tests(const Calibration& calibration, const Fit& fit, bool adiabatic, std::size_t most) {
  std::vector<std::size_t> all;
  for (std::size_t t = 0; t < calibration.tests.size(); ++t)
    if (fit.tests[t].points > 2 && (calibration.tests[t].strain_rate >= calibration.protocol.adiabatic_from) == adiabatic)
      all.push_back(t);
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    const Test &x = calibration.tests[a], &y = calibration.tests[b];
    return std::pair(x.temperature, x.strain_rate) < std::pair(y.temperature, y.strain_rate);
  });
  if (all.size() <= most) return all;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(all[i * (all.size() - 1) / (most - 1)]);
  return chosen;
}

Figure figure_of(const Calibration& calibration, const Fit& fit) {
  Figure figure{.title = calibration.title, .panels = {}, .columns = 2, .panel_width = 620, .panel_height = 460};
  for (const bool adiabatic : {false, true}) {
    Panel panel{.title = adiabatic ? "adiabatic" : "isothermal", .x_label = "plastic strain", .y_label = "true stress (MPa)"};
    panel.legend = "below horizontal";
    double largest_strain = 0.0, largest_stress = 0.0;
    int colour = 0;
    for (const std::size_t t : some_tests(calibration, fit, adiabatic, 7)) {
      const Test& test = calibration.tests[t];
      Curve measured{conditions(test), {}, {}, Mark::points, colour},
          computed{"", fit.tests[t].plastic_strain, {}, Mark::line, colour};
      for (const std::size_t i : points_of(test, calibration.protocol)) {
        measured.x.push_back(test.plastic_strain[i]);
        measured.y.push_back(test.stress[i] * 1e-6);
      }
      for (const double stress : fit.tests[t].stress) computed.y.push_back(stress * 1e-6);
      largest_strain = std::max(largest_strain, measured.x.back());
      largest_stress = std::max({largest_stress, std::ranges::max(measured.y), std::ranges::max(computed.y)});
      panel.curves.push_back(std::move(measured));
      panel.curves.push_back(std::move(computed));
      ++colour;
    }
    if (panel.curves.empty()) continue;
    panel.curves.push_back({"fitted", {0.0, 0.0}, {-1.0, -1.0}, Mark::line, 6});  // of the legend
    panel.x_range = {0.0, 1.03 * largest_strain};
    panel.y_range = {0.0, 1.05 * largest_stress};
    figure.panels.push_back(std::move(panel));
  }
  Panel scatter{.title = "all points", .x_label = "measured (MPa)", .y_label = "fitted (MPa)"};
  Curve points{"", {}, {}, Mark::points, 0};
  double largest = 0.0;
  for (std::size_t t = 0; t < fit.tests.size(); ++t) {
    const auto measured = points_of(calibration.tests[t], calibration.protocol);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      points.x.push_back(calibration.tests[t].stress[measured[i]] * 1e-6);
      points.y.push_back(fit.tests[t].stress[i] * 1e-6);
      largest = std::max({largest, points.x.back(), points.y.back()});
    }
  }
  scatter.curves.push_back(std::move(points));
  scatter.curves.push_back({"equal", {0.0, 1.05 * largest}, {0.0, 1.05 * largest}, Mark::line, 6});
  scatter.legend = "inside left top";
  scatter.x_range = scatter.y_range = {0.0, 1.05 * largest};
  figure.panels.push_back(std::move(scatter));
  return figure;
}

}  // namespace

int run_calibration(const CalibrateOptions& options) {
  require_place_for(options.output, {".toml"});
  for (const std::filesystem::path& figure : options.figures) require_place_for(figure, {".png", ".svg"});
  const Calibration calibration = read_calibration(options.file, options.overrides);
  const Fit fit = calibrate(calibration);
  print_report(calibration, fit);
  if (!options.output.empty()) {
    replace_file_by_text(options.output, write_material(fit.file));
    fmt::print("material: {}\n", options.output.string());
  }
  std::string figures;
  for (const std::filesystem::path& path : options.figures) {
    draw(figure_of(calibration, fit), path);
    figures += (figures.empty() ? "" : ", ") + path.string();
  }
  if (!figures.empty()) fmt::print("figure: {}\n", figures);
  return done;
}

}  // namespace brisance::driver
