#pragma once
// Return mapping: brings a trial stress outside the yield surface back onto it, by backward Euler.
//
// The unknown is the plastic strain increment of the matrix, x; its rate is x/dt. Solutions are bracketed and cannot fail
// silently: `converged` tells. Every loop freezes a lane once it has converged, so no lane depends on its neighbours.

#include "models/flow_stress/flow_stress.hpp"
#include "models/porosity/porosity.hpp"
#include "models/yield/yield.hpp"

#include <optional>

namespace brisance {

/// A trial stress and all that its return depends on.
template <class Real>
struct Trial {
  Real equivalent_stress;            // q, Pa
  Real mean_stress;                  // sm, Pa, positive in tension
  Real shear_modulus, bulk_modulus;  // Pa
  flow_stress::Arguments<Real> at;   // of the flow stress, at the start of the step; its rate is not used
  Real flow_history;
  Real porosity;
  Real inverse_time_step;  // 1/s
  Real last_rate;          // 1/s, plastic strain rate of the previous step: where the search starts
  Real strength{1.0};      // factor on the flow stress
};

/// Where it ends.
template <class Real>
struct Returned {
  Real equivalent_stress, mean_stress;  // Pa
  Real plastic_strain_increment;        // of the matrix
  Real plastic_volume_increment;        // logarithmic
  Real plastic_work;                    // J/m^3
  Real flow_stress;                     // Pa, of the matrix
  Real flow_history;
  Real porosity;
  mask_of<Real> converged;
};

namespace detail {

/// The flow stress at the end of a step in which the plastic strain grows by x.
template <class Law, class Number, class Real>
auto flow_stress_after(const Law& law, const Trial<Real>& trial, const Number& x) {
  flow_stress::Arguments<Number> at;
  at.plastic_strain = trial.at.plastic_strain + x;
  at.plastic_strain_rate = x * Number(trial.inverse_time_step);
  at.temperature = Number(trial.at.temperature);
  at.melting_temperature = Number(trial.at.melting_temperature);
  at.shear_modulus = Number(trial.at.shear_modulus);
  at.pressure = Number(trial.at.pressure);
  at.density = Number(trial.at.density);
  auto flow = flow_stress::evaluate(law, at, Number(trial.flow_history), x);
  flow.flow_stress = Number(trial.strength) * flow.flow_stress;
  return flow;
}

/// Plastic strain increments below this part of the elastic strain do not change a stress in double precision.
inline constexpr double imperceptible = 1e-18;

/// Inside the yield surface, and without shear stiffness: everything stays as it is. A melt flows without doing plastic work,
/// and its plastic strain, the measure of what the crystal has hardened, does not grow.
template <class Real>
Returned<Real> elastic(const Trial<Real>& trial, const Real& flow_stress) {
  return {trial.equivalent_stress, trial.mean_stress, Real(0.0),          Real(0.0), Real(0.0), flow_stress,
          trial.flow_history,      trial.porosity,    mask_of<Real>(true)};
}

template <class Real>
void replace(const mask_of<Real>& where, Returned<Real>& a, const Returned<Real>& b) {
  a.equivalent_stress = select(where, b.equivalent_stress, a.equivalent_stress);
  a.mean_stress = select(where, b.mean_stress, a.mean_stress);
  a.plastic_strain_increment = select(where, b.plastic_strain_increment, a.plastic_strain_increment);
  a.plastic_volume_increment = select(where, b.plastic_volume_increment, a.plastic_volume_increment);
  a.plastic_work = select(where, b.plastic_work, a.plastic_work);
  a.flow_stress = select(where, b.flow_stress, a.flow_stress);
  a.flow_history = select(where, b.flow_history, a.flow_history);
  a.porosity = select(where, b.porosity, a.porosity);
  a.converged = (where & b.converged) | ((!where) & a.converged);
}

/// Solves g(x) = q - 3 mu x - Y(x) = 0 on [0, q/(3 mu)] where g falls from positive to negative: Newton's method, replaced by
/// bisection when it leaves the bracket or does not halve the residual. A lane that is sent below
/// `least` gives up, not converged.
template <class Law, class Real>
Returned<Real> return_to_matrix_stress(const Law& law, const Trial<Real>& trial, const mask_of<Real>& plastic,
                                       const Returned<Real>& inside, const Real& least = Real(-1e300)) {
  using Number = Dual<Real>;
  constexpr int most_iterations = 120;
  constexpr double tolerance = 1e-10, round_off = 1e-15;  // of the flow stress; of the trial stress
  const Real q = trial.equivalent_stress, stiffness = 3.0 * trial.shear_modulus;
  const Real upper = q / max(stiffness, Real(1e-300));
  const Real first_guess = select(trial.last_rate > 0.0, trial.last_rate / trial.inverse_time_step,
                                  (q - inside.flow_stress) / max(stiffness, Real(1e-300)));

  Real lo(0.0), hi = upper, x = min(first_guess, 0.999 * upper), last_residual(1e300);
  Real end_x(0.0), end_Y = inside.flow_stress, end_history = inside.flow_history;
  mask_of<Real> gave_up = plastic & (x < least), active = plastic & (!gave_up);
  for (int iteration = 0; iteration < most_iterations && any(active); ++iteration) {
    const auto flow = flow_stress_after(law, trial, Number::variable(x));
    const Real Y = flow.flow_stress.value;
    const Real g = q - stiffness * x - Y, slope = -stiffness - flow.flow_stress.derivative[0];
    const Real newton = x - g / slope;
    // The error of a Newton step goes with the square of the step: this one is taken without looking at where it ends.
    const mask_of<Real> squares_away = abs(newton - x) <= 1e-6 * x;
    // An increment that no stress can feel, at a rate that only the logarithm in a law can tell from none, counts as elastic.
    const mask_of<Real> negligible = hi <= imperceptible * upper;
    const mask_of<Real> within = (abs(g) <= max(tolerance * Y, round_off * q)) | (hi - lo <= 1e-15 * hi) | negligible;
    const mask_of<Real> done = within | (squares_away & (newton > lo) & (newton < hi));
    const mask_of<Real> finished = active & done & (!negligible);
    const Real last_step = select(within, Real(0.0), newton - x);
    end_x = select(finished, x + last_step, end_x);
    end_Y = select(finished, Y + flow.flow_stress.derivative[0] * last_step, end_Y);
    end_history = select(finished, flow.history.value + flow.history.derivative[0] * last_step, end_history);
    active = active & (!done);
    if (none(active)) break;

    const mask_of<Real> too_small = g > 0.0;
    lo = select(too_small, x, lo);
    hi = select(too_small, hi, x);
    const mask_of<Real> trusted = (newton > lo) & (newton < hi) & (abs(g) <= 0.5 * last_residual);
    last_residual = abs(g);
    gave_up = gave_up | (active & (newton < least));
    active = active & (!gave_up);
    x = select(active, select(trusted, newton, 0.5 * (lo + hi)), x);
  }
  Returned<Real> result = inside;
  result.equivalent_stress = select(end_x > 0.0, q - stiffness * end_x, q);
  result.plastic_strain_increment = end_x, result.plastic_work = result.equivalent_stress * end_x;
  result.flow_stress = end_Y, result.flow_history = end_history;
  result.converged = !(active | gave_up);
  return result;
}

}  // namespace detail

/// Whether the mean stress lets voids nucleate.
template <class Real>
mask_of<Real> nucleates(const porosity::ChuNeedleman& law, const Real& mean_stress) {
  return law.nucleates_in_compression ? mask_of<Real>(true) : mask_of<Real>(mean_stress > 0.0);
}

/// Porosity after a plastic volume strain v (logarithmic: growth is integrated exactly) and nucleation between two plastic
/// strains. Voids may close but not below zero.
template <class Number, class Mask>
Number porosity_after(const porosity::ChuNeedleman& law, const Number& before, const Number& v, const Number& from,
                      const Number& to, const Mask& nucleating) {
  Number f = 1.0 - (1.0 - before) * exp(-v);
  if (law.volume_fraction > 0.0) f = f + select(nucleating, law.nucleated(to) - law.nucleated(from), Number(0.0));
  return min(max(f, Number(0.0)), Number(1.0 - 1e-6));
}

/// Every porosity law as one: pure growth nucleates nothing.
inline porosity::ChuNeedleman nucleation_of(const std::optional<Porosity>& porosity) {
  if (porosity && std::holds_alternative<porosity::ChuNeedleman>(*porosity)) return std::get<porosity::ChuNeedleman>(*porosity);
  return {.volume_fraction = 0.0, .mean_strain = 0.0, .standard_deviation = 1.0, .nucleates_in_compression = false};
}

template <class Law, class Real>
[[gnu::flatten]] Returned<Real> return_to_surface(const yield::VonMises&, const Law& any_law, const porosity::ChuNeedleman&,
                                                  const Trial<Real>& trial) {
  // What flowed in the last step most likely flows on, and a solution with an increment far above the tolerance proves that the
  // trial stress is outside the surface. Only the others need to know the surface itself.
  constexpr double evident = 1e-6;
  const Real least = evident * trial.equivalent_stress / max(3.0 * trial.shear_modulus, Real(1e-300));
  const auto& law = flow_stress::isothermal(any_law, trial.at);
  const auto unknown = detail::elastic(trial, Real(0.0));
  const mask_of<Real> stiff = trial.shear_modulus > 0.0, flowed = stiff & (trial.last_rate > 0.0);
  Returned<Real> result = detail::return_to_matrix_stress(law, trial, flowed, unknown, least);
  const mask_of<Real> others = !(result.converged & flowed);
  if (none(others)) return result;
  const Real quasi_static = detail::flow_stress_after(law, trial, Real(0.0)).flow_stress;
  const auto inside = detail::elastic(trial, quasi_static);
  const mask_of<Real> plastic = others & stiff & (trial.equivalent_stress > quasi_static);
  detail::replace(others, result, detail::return_to_matrix_stress(law, trial, plastic, inside));
  return result;
}

namespace detail {

/// The porous return in the unknowns x (matrix plastic strain) and u = |plastic volume strain|. Yield is satisfied
/// identically: q follows from Phi = 0. What remains is
///   normality  dq dPhi/dsm = v dPhi/dq     (Aravas, Int. J. Numer. Meth. Engng 24 (1987) 1395-1416)
///   work       (1 - f) Y x = q dq + sm v
/// both in units of strain.
template <class Law, class Real>
struct PorousReturn {
  const yield::GursonTvergaardNeedleman& surface;
  const Law& law;
  const porosity::ChuNeedleman& nucleation;
  const Trial<Real>& trial;
  Real sign;  // of the plastic volume strain
  mask_of<Real> nucleating;

  template <class Number>
  struct Evaluation {
    Number normality, work;            // residuals
    Number normality_size, work_size;  // of their terms, for relative tolerances
    Number surface_size;               // (q/Y)^2 on the surface; negative where the mean stress is beyond it
    Number q, mean, Y, history, porosity;
  };

  template <class Number>
  [[gnu::flatten]] Evaluation<Number> operator()(const Number& x, const Number& u) const {
    const auto flow = flow_stress_after(law, trial, x);
    const Number Y = max(flow.flow_stress, Number(1e-30));
    const Number v = Number(sign) * u;
    const Number f = porosity_after(nucleation, Number(trial.porosity), v, Number(trial.at.plastic_strain),
                                    Number(trial.at.plastic_strain) + x, nucleating);
    const Number f_star = surface.effective_porosity(f);
    const Number mean = Number(trial.mean_stress) - Number(trial.bulk_modulus) * v;
    const Number z = clamp(1.5 * surface.q2 * mean / Y, -40.0, 40.0);
    const Number e = exp(z), cosh_z = 0.5 * (e + 1.0 / e), sinh_z = 0.5 * (e - 1.0 / e);
    const Number size = 1.0 + surface.q3 * f_star * f_star - 2.0 * surface.q1 * f_star * cosh_z;
    const Number q = Y * sqrt(max(size, Number(1e-30)));
    const Number dq = (Number(trial.equivalent_stress) - q) / Number(3.0 * trial.shear_modulus);
    const Number left = 1.5 * surface.q1 * surface.q2 * f_star * (Number(sign) * sinh_z) * dq, right = u * q / Y;
    const Number spent = (1.0 - f) * x, supplied = (q * dq + mean * v) / Y;
    return {left - right, spent - supplied, abs(left) + right, abs(spent) + abs(supplied), size, q, mean, Y, flow.history, f};
  }
};

}  // namespace detail

template <class Law, class Real>
Returned<Real> return_to_surface(const yield::GursonTvergaardNeedleman& surface, const Law& law,
                                 const porosity::ChuNeedleman& nucleation, const Trial<Real>& trial) {
  const Real Y0 = detail::flow_stress_after(law, trial, Real(0.0)).flow_stress;
  const auto inside = detail::elastic(trial, Y0);
  const Real safe_Y0 = max(Y0, Real(1e-30));
  const Real f_star = surface.effective_porosity(trial.porosity);
  const Real q_trial = trial.equivalent_stress, mean = trial.mean_stress;
  const Real z0 = clamp(1.5 * surface.q2 * mean / safe_Y0, -300.0, 300.0);
  const Real size0 = 1.0 + surface.q3 * f_star * f_star - 2.0 * surface.q1 * f_star * cosh(z0);
  const mask_of<Real> yields = (Y0 > 0.0) & (trial.shear_modulus > 0.0) & (q_trial * q_trial > Y0 * Y0 * size0);

  // Without voids, and where the reference option asks for it, the return ends on q = Y.
  using Mask = mask_of<Real>;
  Mask porous_return = trial.porosity > 1e-14;
  if (nucleation.volume_fraction > 0.0) porous_return = Mask(true);
  if (surface.return_to == yield::ReturnTo::matrix_stress) porous_return = Mask(false);
  const Mask to_matrix = yields & (!porous_return) & (q_trial > Y0), to_surface = yields & porous_return;
  Returned<Real> result = inside;
  if (any(to_matrix)) result = detail::return_to_matrix_stress(law, trial, to_matrix, inside);
  if (none(to_surface)) return result;

  const Real sign = select(mean < 0.0, Real(-1.0), Real(1.0));
  // At its tips on the axis of mean stress the surface has no normal to follow. A trial without shear is given a little, which
  // moves the mean stress by the square of this part of the flow stress, and is taken away again at the end.
  constexpr double least_shear = 1e-5;
  Trial<Real> sheared = trial;
  sheared.equivalent_stress = max(trial.equivalent_stress, least_shear * Y0);
  const Real q = sheared.equivalent_stress, taken_away = trial.equivalent_stress / q;
  const detail::PorousReturn<Law, Real> porous{surface, law, nucleation, sheared, sign, nucleates(nucleation, mean)};
  const Real stiffness = 3.0 * max(trial.shear_modulus, Real(1e-300)), bulk = max(trial.bulk_modulus, Real(1e-300));
  const Real u_most = abs(mean) / bulk;
  const Real strain_scale = q / stiffness + u_most;
  constexpr double tolerance = 1e-12, round_off = 4e-15, uncertain = 2e-15;

  const auto accept = [&](const auto& where, const Real& x, const Real& u) {
    const auto at = porous(x, u);
    Returned<Real> end;
    end.equivalent_stress = at.q * taken_away, end.mean_stress = at.mean;
    end.plastic_strain_increment = x, end.plastic_volume_increment = sign * u;
    end.plastic_work = (1.0 - at.porosity) * at.Y * x;
    end.flow_stress = at.Y, end.flow_history = at.history, end.porosity = at.porosity;
    end.converged = where;
    detail::replace(where, result, end);
  };

  // Newton's method in both unknowns; a step that leaves the surface or does not reduce the residual is halved. It starts
  // from the strain of the previous step, where there was one, and from a mean stress of at most 0.8 of the hydrostatic
  // limit of the surface at that strain, or that of the previous step where it was beyond.
  using Number = Dual<Real, 2>;
  const Real x_before = trial.last_rate / trial.inverse_time_step;
  const Real Y = max(detail::flow_stress_after(law, trial, min(x_before, strain_scale)).flow_stress, Real(1e-30));
  const Real ratio = max((1.0 + surface.q3 * f_star * f_star) / max(2.0 * surface.q1 * f_star, Real(1e-12)), Real(1.0));
  const Real limit = 0.8 * Y * (2.0 / (3.0 * surface.q2)) * log(ratio + sqrt(ratio * ratio - 1.0));
  const Real mean_before = select(trial.last_rate > 0.0, -sign * trial.at.pressure, Real(0.0));
  const Real mean_start = min(abs(mean), max(limit, mean_before));
  Real u = (abs(mean) - mean_start) / bulk;
  const Real size_start =
      1.0 + surface.q3 * f_star * f_star - 2.0 * surface.q1 * f_star * cosh(1.5 * surface.q2 * mean_start / Y);
  const Real q_start = min(Y * sqrt(max(size_start, Real(0.0))), q);
  // The work done on that surface bounds x from above, but for softening.
  const Real x_most =
      (q_start * (q - q_start) / stiffness + mean_start * u) / (Y * (1.0 - trial.porosity)) + 1e-12 * strain_scale;
  Real x = select((x_before > 1e-3 * x_most) & (x_before < 1e3 * x_most), min(x_before, strain_scale), 0.5 * x_most);
  Real base_x = x, base_u = u, step_x(0.0), step_u(0.0), part(1.0), merit(1e300);
  mask_of<Real> active = to_surface;
  for (int iteration = 0; iteration < 60 && any(active); ++iteration) {
    const auto at = porous(Number::variable(x, 0), Number::variable(u, 1));
    const Real r1 = at.normality.value, r2 = at.work.value;
    const Real new_merit = abs(r1) + abs(r2);
    const mask_of<Real> valid = (at.surface_size.value > 1e-13) & (q - at.q.value >= -1e-9 * q);
    const mask_of<Real> better = valid & (new_merit < merit);
    // Near the tips of the surface q is the root of a small difference, so round-off leaves it uncertain.
    const Real Y_now = at.Y.value, q_now = at.q.value;
    const Real noise = uncertain * Y_now * (Y_now + 1.5 * surface.q2 * abs(at.mean.value)) / q_now;
    const Real noise1 = (1.5 * surface.q2 / stiffness + u / Y_now) * noise, noise2 = q / (stiffness * Y_now) * noise;
    const mask_of<Real> done = valid & (abs(r1) <= tolerance * at.normality_size.value + round_off * strain_scale + noise1) &
                               (abs(r2) <= tolerance * at.work_size.value + round_off * strain_scale + noise2);
    const mask_of<Real> finished = active & done;
    if (any(finished)) accept(finished, x, u);
    active = active & (!done);

    const Real a = at.normality.derivative[0], b = at.normality.derivative[1], c = at.work.derivative[0],
               d = at.work.derivative[1];
    const Real det = a * d - b * c;
    const Real safe_det = select(abs(det) > 1e-300, det, Real(1e-300));
    base_x = select(better, x, base_x), base_u = select(better, u, base_u);
    step_x = select(better, (b * r2 - d * r1) / safe_det, step_x),
    step_u = select(better, (c * r1 - a * r2) / safe_det, step_u);
    merit = select(better, new_merit, merit);
    part = select(better, Real(1.0), 0.5 * part);
    // Before the first valid point: less strain hardens less, more volume strain relieves the mean stress.
    const mask_of<Real> started = merit < 1e300, beyond = at.surface_size.value <= 1e-13;
    const Real next_x = select(started, max(base_x + part * step_x, 0.1 * base_x), select(beyond, x, 0.1 * x));
    const Real next_u = select(started, max(base_u + part * step_u, Real(0.0)), select(beyond, 0.5 * (u + u_most), 0.8 * u));
    x = select(active, next_x, x);
    u = select(active, min(next_u, u_most), u);
  }
  if (none(active)) return result;

  // Nested bisection for what is left. For a given u the work residual rises with x from negative to positive; along the x
  // that it gives, the normality residual goes continuously from positive at u = 0 to negative where no mean stress is left,
  // so it has a root. On logarithmic scales, since increments range over many decades.
  constexpr double smallest = 1e-2 * detail::imperceptible;
  constexpr int halvings = 62;
  const Real x_least = smallest * strain_scale + 1e-300;
  const auto bisect = [](Real lo, Real hi, const auto& is_low) {
    for (int i = 0; i < halvings; ++i) {
      const Real middle = sqrt(lo) * sqrt(hi);
      const mask_of<Real> low = is_low(middle);
      lo = select(low, middle, lo), hi = select(low, hi, middle);
    }
    return hi;
  };
  const auto x_of = [&](const Real& at_u) {
    Real hi = strain_scale, lo = x_least;
    for (int i = 0; i < 8; ++i) hi = select(porous(hi, at_u).work < 0.0, 30.0 * hi, hi);
    Real at_x = sqrt(lo) * sqrt(hi), last(1e300);
    mask_of<Real> searching(true);
    for (int i = 0; i < 90 && any(searching); ++i) {
      const auto at = porous(Dual<Real>::variable(at_x), Dual<Real>(at_u));
      const Real work = at.work.value;
      lo = select(work < 0.0, at_x, lo), hi = select(work < 0.0, hi, at_x);
      const Real newton = at_x - work / at.work.derivative[0];
      const mask_of<Real> trusted = (newton > lo) & (newton < hi) & (abs(work) <= 0.5 * last);
      last = abs(work);
      searching = searching & (abs(work) > 1e-14 * at.work_size.value) & (hi > lo * (1.0 + 4e-16));
      at_x = select(searching, select(trusted, newton, sqrt(lo) * sqrt(hi)), at_x);
    }
    return at_x;
  };
  const Real u_least = smallest * u_most + 1e-300;
  const Real u_root =
      bisect(u_least, u_most, [&](const Real& at_u) -> mask_of<Real> { return porous(x_of(at_u), at_u).normality > 0.0; });
  const Real u_end = select(u_root > detail::imperceptible * u_most, u_root, Real(0.0)), x_end = x_of(u_end);
  const auto end = porous(x_end, u_end);
  // The root of the normality residual is bracketed to the last bits of u; where the surface has nearly shrunk to a point
  // those bits move the residual, so only the work is checked; and once it is a point there is no work to speak of.
  const mask_of<Real> point = surface.effective_porosity(end.porosity) >= 0.9999 * surface.ultimate_porosity();
  const mask_of<Real> solved = active & (point | (abs(end.work) <= 1e-9 * end.work_size + round_off * strain_scale));
  const mask_of<Real> negligible = x_end <= detail::imperceptible * strain_scale;
  accept(solved & (!negligible), x_end, u_end);
  result.converged = result.converged & ((!active) | solved | negligible);
  return result;
}

}  // namespace brisance
