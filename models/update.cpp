#include "models/update.hpp"

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/phases.hpp"

namespace brisance {

template <>
void update(const Material& material, Batch<double>& points, double dt) {
  phases::advance(material, points, dt);
}

template <class Real>
Real longitudinal_sound_speed(const Point<Real>& p) {
  return sqrt((p.bulk_modulus + (4.0 / 3.0) * p.state.shear_modulus) / p.state.density);
}
template double longitudinal_sound_speed<double>(const Point<double>&);
template Lanes longitudinal_sound_speed<Lanes>(const Point<Lanes>&);

State<double> initial_state(const Material& material, double temperature) {
  return initial_state(material, temperature, material.density);
}

State<double> initial_state(const Material& material, double temperature, double density) {
  State<double> s;
  s.temperature = temperature;
  s.density = density;
  double pressure = 0.0;
  visit_law(material.equation_of_state, [&](const auto& law) {
    s.energy = law.energy(density, temperature);
    pressure = law.pressure(density, s.energy);
  });
  s.stress = add_to_diagonal(s.stress, -pressure);
  double melting = phases::never_melts;
  const double compression = density / material.density;
  visit_law(material.melting, [&](const auto& law) { melting = law(melting::Arguments<double>{pressure, compression}); });
  visit_law(material.shear_modulus, [&](const auto& law) {
    const double mu = law(shear_modulus::Arguments<double>{temperature, melting, pressure, density, compression});
    s.shear_modulus = temperature >= melting ? 0.0 : max(mu, 0.0);
  });
  visit_law(material.viscoelastic, [&](const auto& law) {
    law.initial_history().to_columns(s.history);
    s.shear_modulus = law.shear_modulus();
  });
  return s;
}

State<double> stress_free_state(const Material& material, double temperature, double pressure) {
  const EquationOfState& law = material.equation_of_state;
  const bool stays = pressure == 0.0 && equation_of_state::caloric(law) == equation_of_state::Caloric::complete;
  return initial_state(material, temperature,
                       stays ? material.density : equation_of_state::density_at(law, pressure, temperature));
}

std::string_view describe(Trouble trouble) {
  switch (trouble) {
    case Trouble::none:
      return "none";
    case Trouble::increment_too_large:
      return "the deformation of the step exceeds 15 % strain or half a radian; take smaller steps";
    case Trouble::not_finite:
      return "stress or temperature is not finite; take smaller steps, or look for parameters outside their range";
    case Trouble::yield_not_converged:
      return "the return to the yield surface did not converge; take smaller steps";
    case Trouble::compression_out_of_range:
      return "the density is outside the range of the equation of state";
  }
  return "unknown";
}

}  // namespace brisance
