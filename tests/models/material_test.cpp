// Which components can work together: materials in use have no complaints, and each complaint is raised by a material that
// differs from a good one in that respect alone.

#include "models/material.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/models/sample_materials.hpp"

namespace brisance {
namespace {

using namespace samples;

TEST(Incompatibilities, GoodMaterialsHaveNone) {
  for (const Material& m : materials()) EXPECT_EQ(incompatibilities(m), std::vector<std::string>{}) << m.name;
}

TEST(Incompatibilities, AreNoneForAFluid) {
  for (const EquationOfState& law : equations_of_state()) {
    Material m;
    m.name = "fluid";
    m.density = 1000.0;
    m.equation_of_state = law;
    EXPECT_EQ(incompatibilities(m), std::vector<std::string>{});
  }
}

/// What is done to a good material, and how the sentence begins and what it speaks of.
struct Fault {
  const char* what;
  Material material;
  std::function<void(Material&)> spoil;
  std::string component;
  std::string says;
};

Material with_stability() {
  Material m = steel_4340();
  m.stability = {stability::Drucker{0.0}};
  m.failure = {failure::Instability{0.0, false}};
  return m;
}
Material only(Failure criterion) {
  Material m = steel_hy100();
  m.failure = {criterion, failure::Instability{0.0, true}};
  return m;
}

std::vector<Fault> faults() {
  const Material steel = steel_4340(), porous = steel_hy100();
  Material warm_solid = copper_preston_tonks_wallace();
  return {
      {"Johnson-Cook without melting", steel, [](Material& m) { m.melting.reset(), m.damage.reset(), m.failure.clear(); },
       "flow_stress", "johnson_cook needs a melting"},
      {"shear modulus without melting", elastic(),
       [](Material& m) {
         m.shear_modulus = shear_modulus::PrestonTonksWallace{51.8e9, 28e-12, 0.2};
       },
       "shear_modulus", "preston_tonks_wallace needs a melting"},
      {"damage without melting", steel,
       [](Material& m) {
         m.melting.reset(), m.failure.clear();
         m.flow_stress = flow_stress::LinearHardening{400e6, 1e8};
       },
       "damage", "johnson_cook needs a melting"},
      {"flow stress without yield", steel, [](Material& m) { m.yield.reset(); }, "flow_stress", "without a yield surface"},
      {"yield without flow stress", steel, [](Material& m) { m.flow_stress.reset(), m.damage.reset(), m.failure.clear(); },
       "yield", "no size without a flow stress"},
      {"flow stress without shear modulus", steel,
       [](Material& m) {
         m.shear_modulus.reset(), m.melting.reset(), m.damage.reset(), m.failure.clear();
         m.flow_stress = flow_stress::LinearHardening{400e6, 1e8};
       },
       "flow_stress", "resists shear first"},
      {"viscoelastic with shear modulus", pbx_9501(), [](Material& m) { m.shear_modulus = shear_modulus::Constant{1e9}; },
       "viscoelastic", "carries the deviatoric stress alone"},
      {"viscoelastic with flow stress", elastic(),
       [](Material& m) {
         m.viscoelastic = viscoelastics().front();
         m.flow_stress = flow_stress::LinearHardening{400e6, 1e8}, m.yield = yield::VonMises{};
       },
       "viscoelastic", "carries the deviatoric stress alone"},
      {"melting of nothing", air(), [](Material& m) { m.melting = melting::Constant{300.0}; }, "melting",
       "nothing here depends"},
      {"porous yield without porosity", porous,
       [](Material& m) {
         m.porosity.reset(), m.initial_porosity.reset(), m.failure = {failure::Instability{0.0, true}};
       },
       "yield", "needs the evolution of porosity"},
      {"porosity without yield", elastic(), [](Material& m) { m.porosity = porosity::Growth{}; }, "porosity",
       "follows from plastic flow"},
      {"void growth with von Mises", steel, [](Material& m) { m.porosity = porosity::Growth{}; }, "porosity",
       "do not grow under the isochoric flow"},
      {"initial porosity without porosity", steel, [](Material& m) { m.initial_porosity = porosity::initial::Constant{0.01}; },
       "initial_porosity", "would be ignored"},
      {"initial damage without damage", elastic(), [](Material& m) { m.initial_damage = porosity::initial::Constant{0.01}; },
       "initial_damage", "would be ignored"},
      {"damage without flow", elastic(), [](Material& m) { m.damage = damage::HancockMackenzie{false}; }, "damage",
       "grows with plastic strain"},
      {"heating without specific heat", steel, [](Material& m) { m.specific_heat.reset(); }, "heating",
       "needs a specific heat"},
      {"specific heat without heating", steel, [](Material& m) { m.heating.reset(); }, "specific_heat", "would be ignored"},
      {"heating of a complete law", air(),
       [](Material& m) {
         m.specific_heat = specific_heat::Constant{716.0};
         m.heating = Heating{constant_table(0.9), true, false};
       },
       "heating", "follows from its energy"},
      {"Tillotson's energies in the wrong order", warm_solid,
       [](Material& m) {
         auto law = std::get<equation_of_state::Tillotson>(equations_of_state()[11]);
         std::swap(law.complete_vaporization_energy, law.incipient_vaporization_energy);
         m.equation_of_state = law;
       },
       "equation_of_state", "complete_vaporization_energy must exceed"},
      {"thermoelastic heat of a barotropic law", porous, [](Material& m) { m.heating->thermoelastic = true; }, "heating",
       "no thermal expansion"},
      {"thermoelastic heat of an incremental law", porous,
       [](Material& m) {
         m.equation_of_state = equation_of_state::Hypoelastic{7860.0, 150e9, 477.0, 298.0};
         m.heating->thermoelastic = true;
       },
       "heating", "no thermal expansion"},
      {"stability without flow", elastic(),
       [](Material& m) {
         m.stability = {stability::Drucker{0.0}};
         m.failure = {failure::Instability{0.0, false}};
       },
       "stability", "tangent is that of plastic flow"},
      {"stability that nobody looks at", with_stability(), [](Material& m) { m.failure.clear(); }, "stability",
       "only looked at by the failure criterion"},
      {"stability beside criteria that do not look at it", with_stability(),
       [](Material& m) { m.failure = {failure::CriticalDamage{1.0}}; }, "stability", "only looked at by the failure criterion"},
      {"melting criterion without melting", elastic(), [](Material& m) { m.failure = {failure::Melting{}}; }, "failure",
       "melting needs a [melting]"},
      {"TEPLA-F without damage", only(failure::TeplaF{0.3}), [](Material& m) { m.damage.reset(); }, "failure",
       "tepla_f needs a [damage]"},
      {"TEPLA-F without porosity", steel, [](Material& m) { m.failure = {failure::TeplaF{0.3}}; }, "failure",
       "tepla_f needs a [porosity]"},
      {"critical damage without damage", only(failure::CriticalDamage{1.0}), [](Material& m) { m.damage.reset(); }, "failure",
       "critical_damage needs a [damage]"},
      {"critical porosity without porosity", steel, [](Material& m) { m.failure = {failure::CriticalPorosity{0.3}}; },
       "failure", "critical_porosity needs a [porosity]"},
      {"instability without stability", with_stability(), [](Material& m) { m.stability.clear(); }, "failure",
       "instability needs a [[stability]]"}};
}

TEST(Incompatibilities, EachIsRaisedByTheOneFaultThatItSpeaksOf) {
  for (const Fault& fault : faults()) {
    SCOPED_TRACE(fault.what);
    ASSERT_EQ(incompatibilities(fault.material), std::vector<std::string>{}) << "not a good material to begin with";
    Material spoiled = fault.material;
    fault.spoil(spoiled);
    const std::vector<std::string> sentences = incompatibilities(spoiled);
    const auto about = std::find_if(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
      return sentence.starts_with(fault.component + ": ") && sentence.find(fault.says) != std::string::npos;
    });
    EXPECT_NE(about, sentences.end()) << "said instead: " << (sentences.empty() ? "nothing" : sentences.front());
    EXPECT_EQ(sentences.size(), 1u) << "one fault, one sentence; the last: " << (sentences.empty() ? "" : sentences.back());
  }
}

TEST(Incompatibilities, AreAllListedAtOnce) {
  Material m = steel_4340();
  m.yield.reset();
  m.specific_heat.reset();
  EXPECT_GE(incompatibilities(m).size(), 2u);
}

}  // namespace
}  // namespace brisance
