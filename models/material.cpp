#include "models/material.hpp"

#include "models/visit.hpp"

namespace brisance {

namespace {

/// Sentences of the form `component: reason; what to do`.
struct Reasons {
  std::vector<std::string> sentences;
  void unless(bool fine, const std::string& sentence) {
    if (!fine) sentences.push_back(sentence);
  }
};

template <class Component>
void require_melting(const Material& m, const char* folder, const Component& component, Reasons& reasons) {
  visit_law(component, [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (requires { Law::needs_melting_temperature; })
      reasons.unless(m.melting.has_value(), std::string(folder) + ": " + std::string(Law::name) +
                                                " needs a melting temperature; add a [melting] table");
  });
}

}  // namespace

std::vector<std::string> incompatibilities(const Material& m) {
  Reasons reasons;
  const bool porous = m.yield && std::holds_alternative<yield::GursonTvergaardNeedleman>(*m.yield);
  const bool plastic = m.flow_stress.has_value();

  require_melting(m, "flow_stress", m.flow_stress, reasons);
  require_melting(m, "shear_modulus", m.shear_modulus, reasons);
  require_melting(m, "damage", m.damage, reasons);

  reasons.unless(!plastic || m.yield, "flow_stress: without a yield surface it would be ignored; add a [yield] table");
  reasons.unless(!m.yield || plastic, "yield: the surface has no size without a flow stress; add a [flow_stress] table");
  reasons.unless(!plastic || m.shear_modulus,
                 "flow_stress: a metal that flows resists shear first; add a [shear_modulus] table");
  reasons.unless(
      !(m.viscoelastic && (plastic || m.shear_modulus)),
      "viscoelastic: the law carries the deviatoric stress alone; remove [flow_stress], [yield] and [shear_modulus]");
  reasons.unless(!m.melting || m.shear_modulus || m.viscoelastic,
                 "melting: nothing here depends on melting; add a [shear_modulus] table or remove [melting]");

  reasons.unless(!porous || m.porosity,
                 "yield: gurson_tvergaard_needleman needs the evolution of porosity; add a [porosity] table");
  reasons.unless(!m.porosity || m.yield, "porosity: it follows from plastic flow; add [yield] and [flow_stress] tables");
  if (m.porosity && m.yield && !porous)
    reasons.unless(!std::holds_alternative<porosity::Growth>(*m.porosity),
                   "porosity: voids do not grow under the isochoric flow of von_mises; use gurson_tvergaard_needleman");
  reasons.unless(!m.initial_porosity || m.porosity, "initial_porosity: it would be ignored without a [porosity] table");
  reasons.unless(!m.initial_damage || m.damage, "initial_damage: it would be ignored without a [damage] table");
  reasons.unless(!m.damage || plastic, "damage: it grows with plastic strain; add [flow_stress] and [yield] tables");

  reasons.unless(!m.heating || m.specific_heat,
                 "heating: heat needs a specific heat to become temperature; add a [specific_heat] table");
  reasons.unless(!m.specific_heat || m.heating, "specific_heat: it would be ignored without a [heating] table");
  visit_law(m.equation_of_state, [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    using equation_of_state::Caloric;
    const std::string name(Law::name);
    if constexpr (Law::caloric == Caloric::complete)
      reasons.unless(!m.heating, "heating: the temperature of " + name +
                                     " follows from its energy, which takes all heat; remove [heating]");
    if constexpr (std::is_same_v<Law, equation_of_state::Tillotson>)
      reasons.unless(law.complete_vaporization_energy > law.incipient_vaporization_energy,
                     "equation_of_state: complete_vaporization_energy must exceed incipient_vaporization_energy");
    if constexpr (Law::caloric == Caloric::barotropic || Law::caloric == Caloric::incremental)
      reasons.unless(!m.heating || !m.heating->thermoelastic,
                     "heating: " + name + " has no thermal expansion, so thermoelastic = true would have no effect");
  });

  reasons.unless(m.stability.empty() || plastic,
                 "stability: the tangent is that of plastic flow; add [flow_stress] and [yield] tables");
  bool looked_at = false;
  for (const Failure& law : m.failure) looked_at = looked_at || std::holds_alternative<failure::Instability>(law);
  reasons.unless(
      m.stability.empty() || looked_at,
      "stability: its margin is only looked at by the failure criterion instability; add [[failure]] law = \"instability\"");
  for (const Failure& any_law : m.failure)
    visit_law(any_law, [&](const auto& law) {
      using Law = std::decay_t<decltype(law)>;
      const std::string name = "failure: " + std::string(Law::name);
      if constexpr (requires { Law::needs_melting_temperature; })
        reasons.unless(!Law::needs_melting_temperature || m.melting, name + " needs a [melting] table");
      if constexpr (requires { Law::needs_damage; })
        reasons.unless(!Law::needs_damage || m.damage, name + " needs a [damage] table");
      if constexpr (requires { Law::needs_porosity; })
        reasons.unless(!Law::needs_porosity || m.porosity, name + " needs a [porosity] table");
      if constexpr (requires { Law::needs_stability; })
        reasons.unless(!Law::needs_stability || !m.stability.empty(), name + " needs a [[stability]] table");
    });
  return reasons.sentences;
}

}  // namespace brisance
