#include "driver/rate_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <stdexcept>

#include "models/kinematics.hpp"

namespace brisance::driver {
namespace {

// What is integrated. The elastic strain is that of the deviator, s = 2 mu (elastic strain), in the frame that the objective
// rate prescribes: the current one for Jaumann's rate, that of R^T (...) R with F = R U for Green and Naghdi's.
enum Variable {
  elastic_strain = 0,
  deformation_gradient = 6,
  energy = 15,
  temperature,
  plastic_strain,
  plastic_volume_strain,
  porosity,
  damage,
  flow_history,
  history,
  count = history + history_capacity
};
template <class Real>
using Variables = std::array<Real, count>;

template <class Real>
SymmetricTensor<Real> symmetric_at(const Variables<Real>& y, int i) {
  return {y[i], y[i + 1], y[i + 2], y[i + 3], y[i + 4], y[i + 5]};
}
template <class Real>
Tensor<Real> tensor_at(const Variables<Real>& y, int i) {
  return {y[i], y[i + 1], y[i + 2], y[i + 3], y[i + 4], y[i + 5], y[i + 6], y[i + 7], y[i + 8]};
}
void put(Variables<double>& y, int i, const SymmetricTensor<double>& a) {
  for_each_component([&](double c) { y[i++] = c; }, a);
}
void put(Variables<double>& y, int i, const Tensor<double>& a) {
  for (const double c : {a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz}) y[i++] = c;
}
SymmetricTensor<double> unrotated(const Tensor<double>& R, const SymmetricTensor<double>& a) {
  return rotate(transpose(R), a);
}

/// Partial stresses and crack radius of a viscoelastic law, kept in the same frame as the elastic strain.
template <class Real>
viscoelastic::ScramHistory<Real> memory_at(const Variables<Real>& y) {
  std::array<Real, history_capacity> columns;
  std::copy(y.begin() + history, y.end(), columns.begin());
  return viscoelastic::ScramHistory<Real>::from_columns(columns);
}
using Memory = viscoelastic::ScramHistory<double>;
void put(Variables<double>& y, const Memory& memory) {
  std::array<double, history_capacity> columns{};
  memory.to_columns(columns);
  std::copy(columns.begin(), columns.end(), y.begin() + history);
}
/// W a - a W with the spin W of L: how a turns with the material.
SymmetricTensor<double> turning(const Tensor<double>& L, const SymmetricTensor<double>& a) {
  const Tensor<double> Wa = skew_part(L) * to_tensor(a);
  return symmetric_part(Wa + transpose(Wa));
}

/// All that follows from the variables at an instant.
template <class Real>
struct Instant {
  Real density, elastic_density, pressure, melting_temperature, shear_modulus;
  SymmetricTensor<Real> deviator;
  Real q, mean_stress, porosity;
};

/// Local error in units of what is tolerated: the tolerance times the variable, or times its scale where that is larger.
struct ScaledError {
  double tolerance;
  Variables<double> scale;

  template <class Algebra, class State, class Rate, class Error, class Time>
  double error(Algebra&, const State& y, const Rate&, Error& y_error, Time) const {
    double largest = 0.0;
    for (int i = 0; i < count; ++i) {
      const double error = std::fabs(y_error[i]) / (tolerance * std::max(scale[i], std::fabs(y[i])));
      if (!std::isfinite(error)) return 1e30;
      largest = std::max(largest, error);
    }
    return largest;
  }
};

class RateForm {
 public:
  RateForm(const Material& material, const State<double>& start) : material_(material) {
    mass_per_reference_volume_ = start.density * determinant(start.deformation_gradient);
    const double elastic_density = start.density * std::exp(start.plastic_volume_strain);
    const double start_pressure = -trace(start.stress) / 3.0;
    pressure_offset_ = 0.0;
    if (std::visit([](const auto& law) { return law.caloric == equation_of_state::Caloric::incremental; },
                   material_.equation_of_state))
      pressure_offset_ = start_pressure - pressure(elastic_density, start.energy, start.temperature);
  }

  Variables<double> variables(const State<double>& state) const {
    Variables<double> y{};
    put(y, deformation_gradient, state.deformation_gradient);
    y[energy] = state.energy;
    y[temperature] = state.temperature;
    y[plastic_strain] = state.plastic_strain;
    y[plastic_volume_strain] = state.plastic_volume_strain;
    y[porosity] = state.porosity;
    y[damage] = state.damage;
    y[flow_history] = state.flow_history;
    std::copy(state.history.begin(), state.history.end(), y.begin() + history);
    const double mu = state.shear_modulus > 0.0 ? state.shear_modulus : instant(y).shear_modulus;
    if (material_.viscoelastic)
      put(y, rotate(transpose(frame(y)), memory_at(y)));
    else if (mu > 0.0)
      put(y, elastic_strain, 0.5 / mu * unrotated(frame(y), deviator(state.stress)));
    return y;
  }

  State<double> state(const Variables<double>& y, const State<double>& start, const Tensor<double>& L) const {
    const Instant<double> now = instant(y);
    State<double> end = start;
    end.stress = add_to_diagonal(rotate(frame(y), now.deviator), -now.pressure);
    end.deformation_gradient = tensor_at(y, deformation_gradient);
    end.density = now.density;
    end.energy = y[energy];
    end.temperature = y[temperature];
    end.plastic_strain = y[plastic_strain];
    end.plastic_strain_rate = plastic_rate(y, now, L);
    end.plastic_volume_strain = y[plastic_volume_strain];
    end.porosity = now.porosity;
    end.damage = std::min(y[damage], 1.0);
    end.shear_modulus = now.shear_modulus;
    end.flow_history = y[flow_history];
    if (material_.viscoelastic) rotate(frame(y), memory_at(y)).to_columns(end.history);
    return end;
  }

  /// Sizes below which a variable's error is not relative to itself: a strain far below yield, the heat of a few kelvin, ...
  Variables<double> scales() const {
    Variables<double> scale;
    scale.fill(1.0);
    std::fill_n(scale.begin() + elastic_strain, 6, 1e-4);
    scale[energy] = 1e3;
    scale[temperature] = 100.0;
    scale[plastic_strain] = scale[plastic_volume_strain] = scale[porosity] = scale[damage] = 1e-3;
    scale[flow_history] = scale_of_history;
    for (int i = history; i < count; ++i) scale[i] = material_.viscoelastic && i == history ? 1e-6 : 1e4;
    return scale;
  }

  /// dy/dt along the velocity gradient L.
  Variables<double> rate(const Variables<double>& y, const Tensor<double>& L) const {
    const Instant<double> now = instant(y);
    return rate(y, now, L, plastic_rate(y, now, L));
  }

  /// To be called with the variables at the start of each step.
  void begin_step(const Variables<double>& y, const Tensor<double>& L) {
    const Instant<double> now = instant(y);
    if (!material_.flow_stress || now.shear_modulus <= 0.0) return;
    const bool on_surface = equivalent_matrix_stress(now) >= flow_stress(y, now, 0.0) * (1.0 - surface_thickness);
    flowing_ = on_surface || (flowing_ && plastic_rate(y, now, L) > 0.0);
  }

 private:
  const Material& material_;
  double mass_per_reference_volume_;
  double pressure_offset_;

  static constexpr double scale_of_history = 1e6;  // Pa: threshold stresses are of 1e8
  // A law without rate dependence keeps the stress on a surface, which in numbers has a thickness. What lies farther inside is
  // elastic; but within a step that began on the surface, stages of the integrator that cut a corner still count as on it.
  static constexpr double surface_thickness = 1e-9, stage_thickness = 1e-3;  // of the flow stress
  bool flowing_ = false;
  mutable double last_rate_ = 1.0;  // 1/s: where the next search starts

  Tensor<double> frame(const Variables<double>& y) const {
    return material_.objective_rate == ObjectiveRate::green_naghdi ? polar_rotation(tensor_at(y, deformation_gradient))
                                                                   : Tensor<double>::identity();
  }

  template <class Real>
  Real pressure(const Real& elastic_density, const Real& e, const Real& T) const {
    return pressure_offset_ + std::visit(
                                  [&](const auto& law) {
                                    const bool thermal = law.caloric == equation_of_state::Caloric::thermal;
                                    return law.pressure(elastic_density, thermal ? law.energy(elastic_density, T) : e);
                                  },
                                  material_.equation_of_state);
  }

  template <class Real>
  Instant<Real> instant(const Variables<Real>& y) const {
    Instant<Real> now;
    now.porosity = clamp(y[porosity], 0.0, 1.0 - 1e-6);
    now.density = mass_per_reference_volume_ / determinant(tensor_at(y, deformation_gradient));
    now.elastic_density = now.density * exp(y[plastic_volume_strain]);
    now.pressure = pressure(now.elastic_density, y[energy], y[temperature]);
    now.mean_stress = -now.pressure;
    const Real compression = now.elastic_density * (1.0 / material_.density);
    now.melting_temperature = Real(1e30);  // never
    if (material_.melting)
      now.melting_temperature = std::visit(
          [&](const auto& law) {
            return law(melting::Arguments<Real>{now.pressure, compression});
          },
          *material_.melting);
    now.shear_modulus = Real(0.0);
    if (material_.shear_modulus && y[temperature] < now.melting_temperature)
      now.shear_modulus = std::visit(
          [&](const auto& law) {
            return law(shear_modulus::Arguments<Real>{y[temperature], now.melting_temperature, now.pressure,
                                                      now.elastic_density, compression});
          },
          *material_.shear_modulus);
    now.deviator = 2.0 * now.shear_modulus * symmetric_at(y, elastic_strain);
    if (material_.viscoelastic) now.deviator = total(memory_at(y));
    now.q = sqrt(max(1.5 * double_dot(now.deviator, now.deviator), Real(1e-300)));  // with a derivative at zero
    return now;
  }

  template <class Real>
  Real flow_stress(const Variables<Real>& y, const Instant<Real>& now, double r) const {
    return std::visit([&](const auto& law) { return value(law, arguments(y, now, r), y[flow_history]); },
                      *material_.flow_stress);
  }
  template <class Law, class Real>
  static Real value(const Law& law, const flow_stress::Arguments<Real>& at, const Real& memory) {
    if constexpr (flow_stress::WithHistory<Law>)
      return law(at, memory);
    else
      return law(at);
  }
  template <class Real>
  static flow_stress::Arguments<Real> arguments(const Variables<Real>& y, const Instant<Real>& now, double r) {
    return {y[plastic_strain], Real(r),      y[temperature],     now.melting_temperature,
            now.shear_modulus, now.pressure, now.elastic_density};
  }

  /// The porous surface, if the flow is normal to one.
  const yield::GursonTvergaardNeedleman* porous() const {
    const auto* surface = material_.yield ? std::get_if<yield::GursonTvergaardNeedleman>(&*material_.yield) : nullptr;
    return surface && surface->return_to == yield::ReturnTo::porous_surface ? surface : nullptr;
  }

  /// The reference option of the porous surface: flow as in a dense metal, voids that grow with all of the volume strain.
  bool grows_with_total_strain() const {
    return material_.yield && std::holds_alternative<yield::GursonTvergaardNeedleman>(*material_.yield) && !porous();
  }

  /// The flow stress at which the present stress would be on the yield surface. For the porous surface it is the reciprocal
  /// of the root t of Phi(q t, sm t) = 0; Phi rises and is convex, so Newton's method started above the root comes down to it.
  double equivalent_matrix_stress(const Instant<double>& now) const {
    const auto* surface = porous();
    if (!surface) return now.q;
    const double f = surface->effective_porosity(now.porosity);
    const double capacity = 1.0 + surface->q3 * f * f;
    const double q = now.q, z = 1.5 * surface->q2 * std::fabs(now.mean_stress);
    double t = std::numeric_limits<double>::infinity();
    if (q > 0.0) t = std::sqrt(capacity - 2.0 * surface->q1 * f) / q;
    if (z > 0.0 && f > 0.0) t = std::min(t, std::acosh(capacity / (2.0 * surface->q1 * f)) / z);
    if (!std::isfinite(t)) return 0.0;
    for (int i = 0; i < 100; ++i) {
      const double phi = (*surface)(q * t, now.mean_stress * t, f);
      const double slope = 2.0 * q * q * t + 2.0 * surface->q1 * f * z * std::sinh(z * t);
      const double step = phi / slope;
      t -= step;
      if (std::fabs(step) <= 1e-15 * t) break;
    }
    return 1.0 / t;
  }

  /// Direction of plastic flow per unit of matrix plastic strain: Dp = r (direction). sig : direction = (1 - f) Y.
  struct Flow {
    SymmetricTensor<double> deviatoric;
    double volume;
  };
  Flow flow_direction(const Instant<double>& now, double Y) const {
    const auto* surface = porous();
    if (!surface) return {1.5 / now.q * now.deviator, 0.0};
    const double f = surface->effective_porosity(now.porosity);
    const auto deviatoric = 3.0 / (Y * Y) * now.deviator;
    const double volume =
        3.0 * surface->q1 * surface->q2 * f / Y * std::sinh(1.5 * surface->q2 * now.mean_stress / Y);  // tr dPhi/dsig
    const double h = (double_dot(now.deviator, deviatoric) + now.mean_stress * volume) / ((1.0 - now.porosity) * Y);
    return {1.0 / h * deviatoric, volume / h};
  }

  /// How far the stress is outside the yield surface at plastic rate r, as a fraction of the flow stress or of its square.
  template <class Real>
  Real overstress(const Variables<Real>& y, double r) const {
    const Instant<Real> now = instant(y);
    const Real Y = flow_stress(y, now, r);
    if (const auto* surface = porous())
      return (*surface)(now.q / Y, now.mean_stress / Y, surface->effective_porosity(now.porosity));
    return now.q / Y - 1.0;
  }

  /// The plastic strain rate of the matrix. The flow stress at the present state is a rising function of the rate; the rate
  /// is where it meets the stress. Where the function is flat (laws without rate dependence, or limits of those that have
  /// one) any rate on the flat will do, and that which keeps the stress on the surface is taken.
  double plastic_rate(const Variables<double>& y, const Instant<double>& now, const Tensor<double>& L) const {
    if (!material_.flow_stress || now.shear_modulus <= 0.0) return 0.0;
    const double stress = equivalent_matrix_stress(now);
    if (!std::isfinite(stress)) return stress;  // a stage too far out: the error control rejects the step
    const auto Y = [&](double r) { return flow_stress(y, now, r); };
    const double at_rest = Y(0.0);
    if (stress <= 0.0 || stress < at_rest * (1.0 - (flowing_ ? stage_thickness : surface_thickness))) return 0.0;

    constexpr double slowest = 1e-12, fastest = 1e20, infinity = std::numeric_limits<double>::infinity();  // 1/s
    const auto rate_of = [&](double wanted) {
      const auto excess = [&](double log_r) { return Y(std::exp(log_r)) / wanted - 1.0; };
      // The rate seldom changes much from one stage of the integrator to the next.
      double low = std::log(last_rate_) - 0.1, high = low + 0.2, at_low = excess(low), at_high = excess(high);
      if (at_low > 0.0) high = low, at_high = at_low, low = std::log(slowest), at_low = excess(low);
      if (at_high < 0.0) low = high, at_low = at_high, high = std::log(fastest), at_high = excess(high);
      if (at_low >= 0.0) return 0.0;
      if (at_high <= 0.0) return infinity;
      std::uintmax_t most = 200;
      const auto root = boost::math::tools::toms748_solve(excess, low, high, at_low, at_high,
                                                          boost::math::tools::eps_tolerance<double>(46), most);
      return last_rate_ = std::exp(0.5 * (root.first + root.second));
    };
    if (stress < at_rest * (1.0 + stage_thickness)) {  // on the quasi-static surface, if the law is flat there
      const double flat = rate_of(at_rest * (1.0 + surface_thickness));
      const double r = flat > 0.0 ? consistent_rate(y, now, L, 0.0) : 0.0;
      if (r < flat || stress < at_rest) return std::min(r, flat);
    }
    constexpr double close = 1.0 + 1e-5;
    const double root = rate_of(stress);
    if (root > 0.0 && root < infinity && Y(root * close) - Y(root / close) > 2.0 * surface_thickness * stress) return root;
    const double lowest = rate_of(stress * (1.0 - surface_thickness)), highest = rate_of(stress * (1.0 + surface_thickness));
    const double r = consistent_rate(y, now, L, std::min(lowest, fastest));
    return lowest == infinity ? r : std::clamp(r, lowest, highest);
  }

  /// The rate at which the stress follows the surface, with what drift there is taken back over a small strain.
  double consistent_rate(const Variables<double>& y, const Instant<double>& now, const Tensor<double>& L, double flat) const {
    constexpr double correction_strain = 1e-3;
    const double correction = overstress(y, flat) * norm(symmetric_part(L)) / correction_strain;
    const auto residual = [&](double r) {
      const Variables<double> slope = rate(y, now, L, r);
      Variables<Dual<double>> moving;
      for (int i = 0; i < count; ++i) moving[i] = Dual<double>(y[i], {slope[i]});
      return overstress(moving, flat).derivative[0] + correction;
    };
    // Linear in r but for the rate that the hardening of a threshold stress depends on.
    double r0 = 0.0, g0 = residual(r0);
    if (g0 <= 0.0) return 0.0;
    double r1 = norm(symmetric_part(L)), g1 = residual(r1);
    for (int i = 0; i < 20 && g1 != g0; ++i) {
      const double r = r1 - g1 * (r1 - r0) / (g1 - g0);
      const bool done = std::fabs(r - r1) <= 1e-14 * std::fabs(r);
      r0 = r1, g0 = g1, r1 = r;
      if (done) break;
      g1 = residual(r1);
    }
    return r1;
  }

  Variables<double> rate(const Variables<double>& y, const Instant<double>& now, const Tensor<double>& L, double r) const {
    Variables<double> slope{};
    const Tensor<double> R = frame(y);
    const bool rotates_with_spin = material_.objective_rate == ObjectiveRate::incremental_rotation;
    const SymmetricTensor<double> D = unrotated(R, symmetric_part(L));
    const double volume_rate = trace(D);
    SymmetricTensor<double> elastic_rate = deviator(D);
    double plastic_volume_rate = 0.0, plastic_power = 0.0;  // 1/s, W/m^3
    if (r > 0.0) {
      const double Y = equivalent_matrix_stress(now);
      const Flow flow = flow_direction(now, Y);
      elastic_rate = elastic_rate - r * flow.deviatoric;
      plastic_volume_rate = r * flow.volume;
      plastic_power = (1.0 - now.porosity) * Y * r;
    }
    if (material_.viscoelastic) {
      const Memory before = memory_at(y);
      Memory memory_rate =
          std::visit([&](const auto& law) { return law.rate(deviator(D), now.mean_stress, before); }, *material_.viscoelastic);
      plastic_power = double_dot(now.deviator, D) - stored_power(before, memory_rate);
      if (rotates_with_spin)
        for (int i = 0; i < 5; ++i)
          memory_rate.partial_stress[i] = memory_rate.partial_stress[i] + turning(L, before.partial_stress[i]);
      put(slope, memory_rate);
    }
    if (rotates_with_spin) elastic_rate = elastic_rate + turning(L, symmetric_at(y, elastic_strain));
    put(slope, elastic_strain, elastic_rate);
    put(slope, deformation_gradient, L * tensor_at(y, deformation_gradient));
    slope[energy] = (double_dot(now.deviator, D) - now.pressure * volume_rate) / now.density;
    slope[temperature] = heating(y, now, volume_rate - plastic_volume_rate, plastic_power, slope[energy]);
    slope[plastic_strain] = r;
    slope[plastic_volume_strain] = plastic_volume_rate;
    slope[porosity] = porosity_rate(y, now, r, plastic_volume_rate, volume_rate);
    if (r > 0.0) {
      slope[damage] = damage_rate(y, now, r);
      slope[flow_history] = std::visit(
          [&](const auto& law) {
            if constexpr (flow_stress::WithHistory<std::remove_cvref_t<decltype(law)>>)
              return r * law.hardening(arguments(y, now, r), y[flow_history]);
            else
              return 0.0;
          },
          *material_.flow_stress);
    }
    return slope;
  }

  /// Rate of the energy (W/m^3) that the springs and cracks of a viscoelastic law would give back.
  double stored_power(const Memory& at, const Memory& rate) const {
    using Number = Dual<double>;
    viscoelastic::ScramHistory<Number> moving;
    moving.crack_radius = Number(at.crack_radius, {rate.crack_radius});
    for (int i = 0; i < 5; ++i)
      for_each_component([](Number& m, double x, double x_rate) { m = Number(x, {x_rate}); }, moving.partial_stress[i],
                         at.partial_stress[i], rate.partial_stress[i]);
    return std::visit([&](const auto& law) { return law.stored_energy(moving).derivative[0]; }, *material_.viscoelastic);
  }

  /// dT/dt. Reversible compression heats by the strain of the metal itself: opening voids does not cool it.
  double heating(const Variables<double>& y, const Instant<double>& now, double elastic_volume_rate, double plastic_power,
                 double energy_rate) const {
    using Number = Dual<double, 2>;
    return std::visit(
        [&](const auto& law) {
          const double rho = now.elastic_density;
          if (law.caloric == equation_of_state::Caloric::complete) {
            const auto e = law.energy(Number::variable(rho, 0), Number::variable(y[temperature], 1));
            return (energy_rate + e.derivative[0] * rho * elastic_volume_rate) / e.derivative[1];
          }
          if (!material_.heating || !material_.specific_heat) return 0.0;
          const double cp = std::visit([&](const auto& c) { return c(y[temperature]); }, *material_.specific_heat);
          double rate = material_.heating->taylor_quinney(y[plastic_strain]) * plastic_power / (now.density * cp);
          if (material_.heating->thermoelastic) {
            const bool thermal = law.caloric == equation_of_state::Caloric::thermal;
            const double e = thermal ? law.energy(rho, y[temperature]) : y[energy];
            const double gruneisen = law.pressure(Number(rho), Number::variable(e, 0)).derivative[0] / rho;
            rate -= gruneisen * y[temperature] * elastic_volume_rate;
          }
          return rate;
        },
        material_.equation_of_state);
  }

  double porosity_rate(const Variables<double>& y, const Instant<double>& now, double r, double plastic_volume_rate,
                       double volume_rate) const {
    if (!material_.porosity) return 0.0;
    double growth = plastic_volume_rate;
    if (grows_with_total_strain()) growth = std::max(volume_rate, 0.0);
    double rate = (1.0 - now.porosity) * growth;
    if (material_.porosity)
      std::visit(
          [&](const auto& law) {
            if (now.mean_stress > 0.0 || law.nucleates_in_compression)
              rate += r * law.nucleated(Dual<double>::variable(y[plastic_strain])).derivative[0];
          },
          *material_.porosity);
    return now.porosity <= 0.0 ? std::max(rate, 0.0) : rate;
  }

  double damage_rate(const Variables<double>& y, const Instant<double>& now, double r) const {
    if (!material_.damage || y[damage] >= 1.0) return 0.0;
    const damage::Arguments<double> at{now.mean_stress / now.q, r, y[temperature], now.melting_temperature};
    return std::visit([&](const auto& law) { return r / law(at); }, *material_.damage);
  }
};

}  // namespace

State<double> integrate_rate_form(const Material& material, const State<double>& start,
                                  const VelocityGradient& velocity_gradient, double t0, double t1,
                                  const RateFormOptions& options) {
  namespace odeint = boost::numeric::odeint;
  using Stepper = odeint::runge_kutta_dopri5<Variables<double>>;
  RateForm form(material, start);
  Variables<double> y = form.variables(start);
  const auto rate = [&](const Variables<double>& at, Variables<double>& slope, double t) {
    slope = form.rate(at, velocity_gradient(t));
  };
  odeint::controlled_runge_kutta<Stepper, ScaledError> stepper(ScaledError{options.tolerance, form.scales()});

  double t = t0, dt = 0.1 * (t1 - t0);
  const double smallest = 1e-15 * (t1 - t0);
  for (long step = 0; t1 - t > smallest; ++step) {
    if (step == options.most_steps)
      throw std::runtime_error(
          fmt::format("rate form: {} steps reached t = {} s of {} s; the laws are too stiff here, loosen the "
                      "tolerance ({})",
                      step, t, t1, options.tolerance));
    dt = std::clamp(dt, smallest, t1 - t);
    form.begin_step(y, velocity_gradient(t));
    if (stepper.try_step(rate, y, t, dt) == odeint::fail && dt < smallest)
      throw std::runtime_error(fmt::format("rate form: the error control found no step that satisfies it at t = {} s", t));
  }
  return form.state(y, start, velocity_gradient(t1));
}

State<double> integrate_rate_form(const Material& material, const State<double>& start, std::span<const Segment> path,
                                  const RateFormOptions& options) {
  State<double> state = start;
  for (const Segment& segment : path)
    state = integrate_rate_form(
        material, state, [&](double) { return segment.velocity_gradient; }, 0.0, segment.duration, options);
  return state;
}

std::vector<Difference> differences(const State<double>& a, const State<double>& b) {
  std::vector<Difference> result;
  const auto add = [&](std::string_view quantity, double difference, double size) {
    if (size > 0.0) result.push_back({quantity, difference / size});
  };
  const auto add_scalar = [&](std::string_view quantity, double x, double y) {
    add(quantity, std::fabs(x - y), std::max(std::fabs(x), std::fabs(y)));
  };
  add("stress", norm(a.stress - b.stress), std::max(norm(a.stress), norm(b.stress)));
  add_scalar("density", a.density, b.density);
  add_scalar("energy", a.energy, b.energy);
  add_scalar("temperature", a.temperature, b.temperature);
  add_scalar("plastic_strain", a.plastic_strain, b.plastic_strain);
  add_scalar("porosity", a.porosity, b.porosity);
  add_scalar("damage", a.damage, b.damage);
  add_scalar("flow_history", a.flow_history, b.flow_history);
  return result;
}

}  // namespace brisance::driver
