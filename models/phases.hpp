#pragma once
// The phases of the constitutive update, in the order of `advance` at the end. Each visits its law once for the whole batch
// and then loops over the points. They are templated on the material so that a material whose laws are fixed at compile time
// runs the same code.

#include "models/batch.hpp"
#include "models/equation_of_state/thermodynamics.hpp"
#include "models/kinematics.hpp"
#include "models/material.hpp"
#include "models/return_mapping.hpp"
#include "models/visit.hpp"

namespace brisance::phases {

/// Melting temperature of a material that has no melting law.
inline constexpr double never_melts = 1e30;  // K

template <class Real>
void report(Point<Real>& p, const mask_of<Real>& where, Trouble trouble) {
  p.trouble = select(where & (p.trouble == 0.0), Real(static_cast<double>(trouble)), p.trouble);
}

/// The density of the metal itself (kg/m^3): dilatant plastic flow opens voids, it does not stretch what is between them.
template <class Real>
Real metal_density(const State<Real>& s) {
  if (none(s.plastic_volume_strain != 0.0)) return s.density;
  return s.density * exp(s.plastic_volume_strain);
}

/// Moves the deformation gradient, density and stress to the end of the step; the stress only rotates here.
template <class M, class Real>
[[gnu::flatten]] void kinematics(const M& material, Batch<Real>& batch, double dt) {
  for (Point<Real>& p : batch) {
    State<Real>& s = p.state;
    const Tensor<Real> A = Real(dt) * p.velocity_gradient;
    const Tensor<Real> B = exponential_minus_identity(A), dF = Tensor<Real>::identity() + B;
    p.trouble = Real(0.0);
    report(p, double_dot(A, A) > 0.25, Trouble::increment_too_large);
    if (material.objective_rate == ObjectiveRate::incremental_rotation) {
      const PolarIncrement<Real> polar = polar_increment(B);
      report(p, polar.size > 0.3, Trouble::increment_too_large);
      p.rotation = polar.rotation, p.strain_increment = polar.strain;
    } else {
      const Tensor<Real> before = polar_rotation(s.deformation_gradient);
      const Tensor<Real> middle = polar_rotation(exponential(Real(0.5) * A) * s.deformation_gradient);
      const Tensor<Real> after = polar_rotation(dF * s.deformation_gradient);
      p.rotation = after * transpose(before);
      p.strain_increment = rotate(after * transpose(middle), symmetric_part(A));
    }
    s.deformation_gradient = dF * s.deformation_gradient;
    s.stress = rotate(p.rotation, s.stress);
    p.density_before = s.density;
    p.metal_density_before = metal_density(s);
    s.density = s.density * exp(-trace(A));
    p.metal_density = metal_density(s);
    p.pressure_before = (-1.0 / 3.0) * trace(s.stress);
    p.deviator_before = p.deviator = deviator(s.stress);
  }
}

template <class M, class Real>
void melting_temperature(const M& material, Batch<Real>& batch) {
  for (Point<Real>& p : batch) p.melting_temperature = Real(never_melts);
  visit_law(material.melting, [&](const auto& law) {
    for (Point<Real>& p : batch)
      p.melting_temperature = law(melting::Arguments<Real>{p.pressure_before, p.metal_density * (1.0 / material.density)});
  });
}

/// The shear modulus of the step. The elastic deviatoric strain is kept when the modulus changes, so the deviator scales. A
/// melt has none: on melting the energy of the deviator becomes heat, and what freezes starts without a deviator.
template <class M, class Real>
void shear_modulus(const M& material, Batch<Real>& batch) {
  visit_law(material.shear_modulus, [&](const auto& law) {
    for (Point<Real>& p : batch) {
      State<Real>& s = p.state;
      const Real mu = law(shear_modulus::Arguments<Real>{s.temperature, p.melting_temperature, p.pressure_before,
                                                         p.metal_density, p.metal_density * (1.0 / material.density)});
      const mask_of<Real> melted = s.temperature >= p.melting_temperature;
      const Real now = select(melted, Real(0.0), max(mu, Real(0.0)));
      const mask_of<Real> carries = s.shear_modulus > 0.0;
      const Real before = select(carries, s.shear_modulus, Real(1.0));
      p.released_heat = select(melted & carries, double_dot(p.deviator, p.deviator) / (4.0 * before * s.density), Real(0.0));
      p.deviator = select(carries, now / before, Real(0.0)) * p.deviator;
      s.shear_modulus = now;
    }
  });
}

/// The pressure (Pa) of a law at a density, with the energy argument that its Caloric asks for.
template <class Law, class Real>
Real pressure_at(const Law& law, const Real& rho, const Real& energy, const Real& temperature) {
  if constexpr (Law::caloric == equation_of_state::Caloric::thermal)
    return law.pressure(rho, law.energy(rho, temperature));
  else
    return law.pressure(rho, energy);
}

namespace detail {

template <class Law, class Real>
void trial_pressure(const Law& law, Point<Real>& p) {
  using equation_of_state::Caloric;
  const State<Real>& s = p.state;
  const Real rho = p.metal_density;
  const Real e = Law::caloric == Caloric::thermal ? law.energy(rho, s.temperature) : s.energy;
  p.bulk_modulus = rho * equation_of_state::sound_speed_squared(law, rho, e);
  const Real trial = law.pressure(rho, e);
  if constexpr (Law::caloric == Caloric::incremental)
    p.trial_pressure = p.pressure_before + trial - law.pressure(p.metal_density_before, e);
  else
    p.trial_pressure = trial;
}
template <class Law, class Real>
[[gnu::flatten]] void trial_pressure(const Law& law, Batch<Real>& batch) {
  for (Point<Real>& p : batch) trial_pressure(law, p);
}

}  // namespace detail

/// Trial stress, tangent bulk modulus and trial pressure.
template <class M, class Real>
void elastic_trial(const M& material, Batch<Real>& batch) {
  for (Point<Real>& p : batch) p.deviator = p.deviator + 2.0 * p.state.shear_modulus * deviator(p.strain_increment);
  visit_law(material.equation_of_state, [&](const auto& law) { detail::trial_pressure(law, batch); });
}

/// A melt bears no tension: it opens voids instead, and closes them before it bears pressure again. However far it is
/// dispersed, the density of the metal in it stays where its pressure vanishes.
template <class M, class Real>
void cavitation(const M& material, Batch<Real>& batch) {
  for (Point<Real>& p : batch) p.plastic_volume_increment = Real(0.0);
  if (!is_present(material.shear_modulus)) return;
  constexpr int most_iterations = 8;
  constexpr double negligible = 1e-12;  // of the bulk modulus
  visit_law(material.equation_of_state, [&](const auto& law) {
    for (Point<Real>& p : batch) {
      State<Real>& s = p.state;
      const Real before = s.plastic_volume_strain;
      const mask_of<Real> melted = s.temperature >= p.melting_temperature;
      if (none(melted)) continue;
      mask_of<Real> active = melted & ((p.trial_pressure < 0.0) | ((before > 0.0) & (p.trial_pressure > 0.0)));
      // Newton's method in the density of the metal, in which tension is nearly linear; in its logarithm a metal torn to a
      // third of its density would be compressed to twice of it by the first iteration. rho dp/drho is the bulk modulus where p
      // = 0.
      constexpr double least_ratio = 0.5;  // of two densities
      for (int i = 0; i < most_iterations && any(active); ++i) {
        const Real ratio = max(1.0 - p.trial_pressure / p.bulk_modulus, Real(least_ratio));
        const Real v = max(s.plastic_volume_strain + log(ratio), Real(0.0));
        const mask_of<Real> moved = abs(v - s.plastic_volume_strain) > negligible;
        s.plastic_volume_strain = select(active, v, s.plastic_volume_strain);
        p.metal_density = metal_density(s);
        detail::trial_pressure(law, p);
        active = active & moved;
      }
      p.plastic_volume_increment = s.plastic_volume_strain - before;
      // Sound travels in the metal between the voids.
      const mask_of<Real> dispersed = melted & (s.plastic_volume_strain > 0.0);
      p.bulk_modulus = select(dispersed, p.bulk_modulus * s.density / p.metal_density, p.bulk_modulus);
    }
  });
}

template <class M, class Real>
void artificial_viscosity(const M& material, Batch<Real>& batch) {
  for (Point<Real>& p : batch) {
    p.artificial_viscosity_before = p.artificial_viscosity;
    p.artificial_viscosity = material.artificial_viscosity(p.state.density, p.cell_size, sqrt(p.bulk_modulus / p.state.density),
                                                           trace(p.velocity_gradient));
  }
}

namespace detail {

template <class Real>
Trial<Real> trial_of(const Point<Real>& p, double dt) {
  const State<Real>& s = p.state;
  Trial<Real> trial;
  trial.equivalent_stress = equivalent_stress(p.deviator);
  trial.mean_stress = -p.trial_pressure;
  trial.shear_modulus = s.shear_modulus, trial.bulk_modulus = p.bulk_modulus;
  trial.at = {s.plastic_strain, Real(0.0),         s.temperature,  p.melting_temperature,
              s.shear_modulus,  p.pressure_before, p.metal_density};
  trial.flow_history = s.flow_history, trial.porosity = s.porosity;
  trial.inverse_time_step = Real(1.0 / dt), trial.last_rate = s.plastic_strain_rate;
  trial.strength = s.strength;
  return trial;
}

/// A porous return in 1, 2, 4, ... 64 equal parts of the strain increment until it converges and no part changes the porosity
/// by more than 0.02; each lane takes the parts it needs. The deviator ends on the surface along its own trial direction.
template <class Surface, class Law, class Real>
Returned<Real> return_in_parts(const Surface& surface, const Law& law, const porosity::ChuNeedleman& nucleation, Point<Real>& p,
                               double dt, const SymmetricTensor<Real>& start) {
  constexpr double most_porosity_change = 0.02;
  const Trial<Real> whole = trial_of(p, dt);
  const Real start_mean = -p.pressure_before;
  Returned<Real> result = return_to_surface(surface, law, nucleation, whole);
  const auto fine = [&](const Returned<Real>& r, const Real& porosity_before) -> mask_of<Real> {
    return r.converged & (abs(r.porosity - porosity_before) <= most_porosity_change);
  };
  const SymmetricTensor<Real> trial_deviator = p.deviator;
  const auto end_on = [](const SymmetricTensor<Real>& s, const Real& q, const Real& q_trial) {
    return select(q_trial > 0.0, q / max(q_trial, Real(1e-300)), Real(1.0)) * s;
  };
  p.deviator = end_on(trial_deviator, result.equivalent_stress, whole.equivalent_stress);
  mask_of<Real> active = !fine(result, whole.porosity);
  for (int parts = 2; parts <= 64 && any(active); parts *= 2) {
    Trial<Real> part = whole;
    SymmetricTensor<Real> s = start;
    Real mean = start_mean, work(0.0), volume(0.0), strain(0.0);
    Returned<Real> r = result;
    mask_of<Real> good = active;
    const double share = 1.0 / parts;
    const SymmetricTensor<Real> increment = Real(share) * (trial_deviator - start);
    part.inverse_time_step = Real(parts / dt);
    for (int i = 0; i < parts; ++i) {
      s = s + increment;
      part.equivalent_stress = equivalent_stress(s);
      part.mean_stress = mean + share * (whole.mean_stress - start_mean);
      r = return_to_surface(surface, law, nucleation, part);
      // The last attempt may change the porosity by more: a material that loses all strength within a step has failed.
      good = good & (parts == 64 ? r.converged : fine(r, part.porosity));
      s = end_on(s, r.equivalent_stress, part.equivalent_stress);
      mean = r.mean_stress;
      strain = strain + r.plastic_strain_increment, volume = volume + r.plastic_volume_increment, work = work + r.plastic_work;
      part.at.plastic_strain = part.at.plastic_strain + r.plastic_strain_increment;
      part.flow_history = r.flow_history, part.porosity = r.porosity;
      part.last_rate = r.plastic_strain_increment * part.inverse_time_step;
    }
    r.plastic_strain_increment = strain, r.plastic_volume_increment = volume, r.plastic_work = work;
    r.converged = good;
    brisance::detail::replace(good, result, r);
    p.deviator = select(good, s, p.deviator);
    active = active & (!good);
  }
  result.converged = !active;
  return result;
}

}  // namespace detail

/// Brings the trial stress back to the yield surface.
template <class M, class Real>
void return_mapping(const M& material, Batch<Real>& batch, double dt) {
  for (Point<Real>& p : batch) {
    p.plastic_strain_increment = p.plastic_work = Real(0.0);
    if (!is_present(material.flow_stress)) continue;
    p.state.plastic_strain_rate = select(p.state.plastic_strain_rate > 0.0, p.state.plastic_strain_rate, Real(0.0));
  }
  const porosity::ChuNeedleman nucleation = nucleation_of(material.porosity);
  visit_law(material.yield, [&](const auto& surface) {
    visit_law(material.flow_stress, [&](const auto& law) {
      constexpr bool porous = std::is_same_v<std::decay_t<decltype(surface)>, yield::GursonTvergaardNeedleman>;
      for (Point<Real>& p : batch) {
        State<Real>& s = p.state;
        Returned<Real> end;
        if constexpr (porous) {
          const SymmetricTensor<Real> start = p.deviator - 2.0 * s.shear_modulus * deviator(p.strain_increment);
          end = detail::return_in_parts(surface, law, nucleation, p, dt, start);
        } else {
          const Trial<Real> trial = detail::trial_of(p, dt);
          end = return_to_surface(surface, law, nucleation, trial);
          p.deviator = select(end.plastic_strain_increment > 0.0,
                              end.equivalent_stress / max(trial.equivalent_stress, Real(1e-300)), Real(1.0)) *
                       p.deviator;
        }
        report(p, !end.converged, Trouble::yield_not_converged);
        p.flow_stress = end.flow_stress;
        p.plastic_strain_increment = end.plastic_strain_increment;
        p.plastic_volume_increment = p.plastic_volume_increment + end.plastic_volume_increment;
        p.plastic_work = end.plastic_work;
        s.flow_history = end.flow_history;
        s.plastic_volume_strain = s.plastic_volume_strain + end.plastic_volume_increment;
        if constexpr (porous) p.metal_density = metal_density(s);
        s.plastic_strain = s.plastic_strain + end.plastic_strain_increment;
        s.plastic_strain_rate = end.plastic_strain_increment * (1.0 / dt);
        if constexpr (porous) s.porosity = end.porosity;
      }
    });
  });
}

/// The deviator of a viscoelastic material; what its springs and cracks do not store counts as plastic work.
template <class M, class Real>
void viscoelastic_stress(const M& material, Batch<Real>& batch, double dt) {
  visit_law(material.viscoelastic, [&](const auto& law) {
    using History = decltype(law.template initial_history<Real>());
    for (Point<Real>& p : batch) {
      State<Real>& s = p.state;
      const History before = rotate(p.rotation, History::from_columns(s.history));
      const SymmetricTensor<Real> increment = deviator(p.strain_increment);
      const History after = law.advance(before, Real(1.0 / dt) * increment, Real(-p.pressure_before), dt);
      after.to_columns(s.history);
      p.deviator = total(after);
      const Real work = 0.5 * double_dot(p.deviator_before + p.deviator, increment);
      p.plastic_work = max(work - law.stored_energy(after) + law.stored_energy(before), Real(0.0));
      s.shear_modulus = Real(law.shear_modulus());
    }
  });
}

/// Temperature from plastic work, artificial viscosity, heat from outside, elastic energy set free by melting, and reversible
/// compression.
template <class M, class Real>
void heating(const M& material, Batch<Real>& batch) {
  visit_law(material.heating, [&](const Heating& heating) {
    visit_law(material.specific_heat, [&](const auto& law) {
      for (Point<Real>& p : batch) {
        State<Real>& s = p.state;
        const Real per_heat = 1.0 / law(s.temperature);
        const Real volume_change = 1.0 / s.density - 1.0 / p.density_before;
        p.warming = heating.taylor_quinney(s.plastic_strain) * per_heat;
        Real other_heat = p.released_heat + p.heat;
        if (heating.viscous)
          other_heat = other_heat - 0.5 * (p.artificial_viscosity_before + p.artificial_viscosity) * volume_change;
        s.temperature = s.temperature + p.warming * p.plastic_work / s.density + per_heat * other_heat;
      }
    });
    if (!heating.thermoelastic) return;
    visit_law(material.equation_of_state, [&](const auto& law) {
      for (Point<Real>& p : batch) {
        const Real gruneisen = equation_of_state::gruneisen_coefficient(law, p.metal_density, p.state.energy);
        const Real elastic_volume_strain = trace(p.strain_increment) - p.plastic_volume_increment;
        p.state.temperature = p.state.temperature * exp(-gruneisen * elastic_volume_strain);
      }
    });
  });
}

/// Pressure, energy and total stress at the end of the step. The energy takes all work and the heat from outside; where the
/// pressure depends on it the two are solved together. Temperature follows from the energy only for a thermodynamically
/// complete law.
template <class M, class Real>
void pressure(const M& material, Batch<Real>& batch) {
  using equation_of_state::Caloric;
  visit_law(material.equation_of_state, [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    constexpr bool coupled = Law::caloric == Caloric::energy || Law::caloric == Caloric::complete;
    for (Point<Real>& p : batch) {
      State<Real>& s = p.state;
      const Real rho = p.metal_density;
      const Real volume_change = 1.0 / s.density - 1.0 / p.density_before;
      const Real deviatoric_work =
          double_dot(p.deviator_before + p.deviator, p.strain_increment) / (s.density + p.density_before);
      const Real energy_but_p =
          s.energy + p.heat + deviatoric_work -
          0.5 * (p.pressure_before + p.artificial_viscosity_before + p.artificial_viscosity) * volume_change;
      if constexpr (Law::caloric == Caloric::incremental)
        p.pressure = p.pressure_before + law.pressure(rho, s.energy) - law.pressure(p.metal_density_before, s.energy);
      else
        p.pressure = pressure_at(law, rho, s.energy, s.temperature);
      if constexpr (coupled) {
        // p = p(rho, e - p dV/2): one Newton step is exact for the laws linear in e.
        mask_of<Real> active(true);
        for (int i = 0; i < 12 && any(active); ++i) {
          const auto value =
              law.pressure(Dual<Real>(rho), Dual<Real>::variable(energy_but_p - 0.5 * p.pressure * volume_change));
          const Real step = (value.value - p.pressure) / (1.0 + 0.5 * volume_change * value.derivative[0]);
          p.pressure = select(active, p.pressure + step, p.pressure);
          active = active & (abs(step) > 1e-13 * (abs(p.pressure) + 1e-9 * p.bulk_modulus));
        }
      }
      if (is_present(material.shear_modulus)) {  // a melt bears no tension, and no pressure while it has voids
        const Real of_melt = select(s.plastic_volume_strain > 0.0, Real(0.0), max(p.pressure, Real(0.0)));
        p.pressure = select(s.temperature >= p.melting_temperature, of_melt, p.pressure);
      }
      s.energy = energy_but_p - 0.5 * p.pressure * volume_change;
      if constexpr (Law::caloric == Caloric::complete) s.temperature = equation_of_state::temperature(law, rho, s.energy);
      s.stress = add_to_diagonal(p.deviator, -p.pressure);
      const equation_of_state::DensityRange range = law.range();
      report(p, (rho < range.lowest) | (rho > range.highest), Trouble::compression_out_of_range);
      report(p, !is_finite(p.pressure + double_dot(p.deviator, p.deviator) + s.temperature), Trouble::not_finite);
    }
  });
}

/// Porosity where the return mapping does not carry it: nucleation in a dense metal; and for the reference option that
/// returns to the matrix stress, growth with the total volume strain in tension.
template <class M, class Real>
void porosity(const M& material, Batch<Real>& batch) {
  if (!is_present(material.porosity)) return;
  const porosity::ChuNeedleman law = nucleation_of(material.porosity);
  visit_law(material.yield, [&](const auto& surface) {
    bool grows = false;
    if constexpr (std::is_same_v<std::decay_t<decltype(surface)>, yield::GursonTvergaardNeedleman>) {
      if (surface.return_to == yield::ReturnTo::porous_surface) return;
      grows = true;
    }
    for (Point<Real>& p : batch) {
      State<Real>& s = p.state;
      const Real growth = grows ? max(trace(p.strain_increment), Real(0.0)) : Real(0.0);
      s.porosity = porosity_after(law, s.porosity, growth, s.plastic_strain - p.plastic_strain_increment, s.plastic_strain,
                                  nucleates(law, -p.trial_pressure));
    }
  });
}

template <class M, class Real>
void damage(const M& material, Batch<Real>& batch) {
  visit_law(material.damage, [&](const auto& law) {
    for (Point<Real>& p : batch) {
      if (none(p.plastic_strain_increment > 0.0)) continue;
      State<Real>& s = p.state;
      const Real q = equivalent_stress(p.deviator);
      const Real triaxiality = -p.pressure / max(q, 1e-6 * abs(p.pressure) + 1e-30);
      const Real fracture_strain =
          law(damage::Arguments<Real>{triaxiality, s.plastic_strain_rate, s.temperature, p.melting_temperature});
      s.damage = min(s.damage + p.plastic_strain_increment / fracture_strain, Real(1.0));
    }
  });
}

namespace detail {

/// dY/d(plastic strain) with hardening history, and dY/dT, both at a frozen rate.
template <class Law, class Real>
std::array<Real, 2> flow_stress_slopes(const Law& law, const Point<Real>& p) {
  using Number = Dual<Real, 2>;
  const State<Real>& s = p.state;
  flow_stress::Arguments<Number> at;
  at.plastic_strain = Number::variable(s.plastic_strain, 0);
  at.plastic_strain_rate = s.plastic_strain_rate;
  at.temperature = Number::variable(s.temperature, 1);
  at.melting_temperature = p.melting_temperature;
  at.shear_modulus = s.shear_modulus;
  at.pressure = p.pressure_before;
  at.density = p.metal_density;
  if constexpr (flow_stress::WithHistory<Law>) {
    const Real hardening = law.hardening(at, Number(s.flow_history)).value;
    return (Number(s.strength) * law(at, Number(s.flow_history, {hardening, Real(0.0)}))).derivative;
  } else {
    return (Number(s.strength) * law(at)).derivative;
  }
}

/// The tangent of a plastically loading point on its yield surface, from the slopes of the flow stress.
template <class Real>
stability::Arguments<Real> tangent(const yield::VonMises&, const porosity::ChuNeedleman&, const Point<Real>& p,
                                   const std::array<Real, 2>& slopes) {
  stability::Arguments<Real> at;
  at.normal_deviatoric = 1.5 / max(equivalent_stress(p.deviator), Real(1e-30));
  at.plastic_modulus = slopes[0] + slopes[1] * p.warming * p.flow_stress / p.state.density;
  return at;
}
template <class Real>
stability::Arguments<Real> tangent(const yield::GursonTvergaardNeedleman& surface, const porosity::ChuNeedleman& nucleation,
                                   const Point<Real>& p, const std::array<Real, 2>& slopes) {
  if (surface.return_to == yield::ReturnTo::matrix_stress) return tangent(yield::VonMises{}, nucleation, p, slopes);
  using Number = Dual<Real, 3>;  // derivatives with respect to Y, f and the mean stress
  const State<Real>& s = p.state;
  const Real q2 = 1.5 * double_dot(p.deviator, p.deviator);
  const Number Y = Number::variable(max(p.flow_stress, Real(1e-30)), 0), f = Number::variable(s.porosity, 1),
               mean = Number::variable(-p.pressure, 2);
  const Number phi = surface(Number(sqrt(q2)) / Y, mean / Y, surface.effective_porosity(f));
  stability::Arguments<Real> at;
  at.normal_deviatoric = 3.0 / (Y.value * Y.value);
  at.normal_volumetric = phi.derivative[2] * (1.0 / 3.0);
  const Real work = 2.0 * q2 / (Y.value * Y.value) + mean.value * phi.derivative[2];  // sig:N
  const Real matrix_strain = work / ((1.0 - s.porosity) * Y.value);
  Real void_growth = (1.0 - s.porosity) * phi.derivative[2];
  if (nucleation.volume_fraction > 0.0) {
    const Real A = nucleation.nucleated(Dual<Real>::variable(s.plastic_strain)).derivative[0];
    void_growth = void_growth + select(nucleates(nucleation, mean.value), A * matrix_strain, Real(0.0));
  }
  at.plastic_modulus = -(phi.derivative[0] * (slopes[0] * matrix_strain + slopes[1] * p.warming * work / s.density) +
                         phi.derivative[1] * void_growth);
  return at;
}

/// f*/fu of a porous surface: 1 when no strength is left.
template <class Real>
Real capacity_used(const yield::VonMises&, const Real&) {
  return Real(0.0);
}
template <class Real>
Real capacity_used(const yield::GursonTvergaardNeedleman& surface, const Real& porosity) {
  return surface.effective_porosity(porosity) * (1.0 / surface.ultimate_porosity());
}

}  // namespace detail

/// The least margin of the material's stability laws; 1 where the step was elastic.
template <class M, class Real>
void stability(const M& material, Batch<Real>& batch) {
  if (material.stability.empty()) return;
  const porosity::ChuNeedleman nucleation = nucleation_of(material.porosity);
  visit_law(material.yield, [&](const auto& surface) {
    visit_law(material.flow_stress, [&](const auto& flow) {
      for (Point<Real>& p : batch) {
        stability::Arguments<Real> at = detail::tangent(surface, nucleation, p, detail::flow_stress_slopes(flow, p));
        at.shear_modulus = p.state.shear_modulus, at.bulk_modulus = p.bulk_modulus;
        at.deviatoric_stress = p.deviator, at.mean_stress = -p.pressure, at.yield_stress = p.flow_stress;
        Real least(1.0);
        for (const Stability& any_law : material.stability)
          visit_law(any_law, [&](const auto& law) { least = min(least, law(at)); });
        p.stability_margin = select(p.plastic_strain_increment > 0.0, least, Real(1.0));
      }
    });
  });
}

/// Marks points that meet a failure criterion, with its cause and the time; the first criterion of the list wins, and a mark
/// is never taken back.
template <class M, class Real>
void failure(const M& material, Batch<Real>& batch) {
  for (const Failure& any_law : material.failure) {
    visit_law(any_law, [&](const auto& law) {
      using Law = std::decay_t<decltype(law)>;
      for (Point<Real>& p : batch) {
        State<Real>& s = p.state;
        failure::Arguments<Real> at{s.temperature, p.melting_temperature, s.plastic_strain, s.damage, s.porosity,
                                    Real(0.0),     p.stability_margin,    -p.pressure};
        visit_law(material.yield, [&](const auto& surface) { at.capacity_used = detail::capacity_used(surface, s.porosity); });
        const mask_of<Real> fails = (law(at) >= 0.0) & (s.failure_cause == 0.0);
        s.failure_cause = select(fails, Real(static_cast<double>(Law::cause)), s.failure_cause);
        s.failure_time = select(fails, Real(batch.time), s.failure_time);
      }
    });
  }
}

/// The constitutive update.
template <class M, class Real>
void advance(const M& material, Batch<Real>& points, double dt) {
  kinematics(material, points, dt);
  melting_temperature(material, points);
  shear_modulus(material, points);
  elastic_trial(material, points);
  cavitation(material, points);
  artificial_viscosity(material, points);
  return_mapping(material, points, dt);
  viscoelastic_stress(material, points, dt);
  heating(material, points);
  pressure(material, points);
  porosity(material, points);
  damage(material, points);
  stability(material, points);
  failure(material, points);
}

}  // namespace brisance::phases
