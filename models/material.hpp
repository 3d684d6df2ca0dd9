#pragma once
// A material is a value: components, each chosen from the closed list of laws of its folder. What is absent is off.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "models/artificial_viscosity.hpp"
#include "models/damage/damage.hpp"
#include "models/equation_of_state/equation_of_state.hpp"
#include "models/failure/failure.hpp"
#include "models/flow_stress/flow_stress.hpp"
#include "models/heating.hpp"
#include "models/melting/melting.hpp"
#include "models/porosity/initial_distribution.hpp"
#include "models/porosity/porosity.hpp"
#include "models/reaction/reaction.hpp"
#include "models/shear_modulus/shear_modulus.hpp"
#include "models/specific_heat/specific_heat.hpp"
#include "models/stability/stability.hpp"
#include "models/viscoelastic/viscoelastic.hpp"
#include "models/yield/yield.hpp"

namespace brisance {

/// How the stress follows the rotation of the material.
enum class ObjectiveRate {
  incremental_rotation,  // the polar rotation of each step's increment of deformation: Jaumann's rate in the limit
  green_naghdi           // the polar rotation of the whole deformation gradient
};
template <>
inline constexpr std::array choices<ObjectiveRate> = {std::string_view{"incremental_rotation"},
                                                      std::string_view{"green_naghdi"}};

struct Material {
  std::string name;
  double density = 0.0;                        // kg/m^3, of the undeformed material
  std::optional<double> bulk_modulus;          // Pa, measured beside the shear modulus; only `check` reads it
  std::optional<double> thermal_conductivity;  // W/(m K)
  ObjectiveRate objective_rate = ObjectiveRate::incremental_rotation;

  EquationOfState equation_of_state;
  std::optional<ShearModulus> shear_modulus;
  std::optional<Melting> melting;
  std::optional<SpecificHeat> specific_heat;
  std::optional<FlowStress> flow_stress;
  std::optional<Yield> yield;
  std::optional<Viscoelastic> viscoelastic;
  std::optional<Porosity> porosity;
  std::optional<InitialPorosity> initial_porosity;
  std::optional<Damage> damage;
  std::optional<InitialDamage> initial_damage;
  std::vector<Stability> stability;
  std::vector<Failure> failure;
  std::optional<Heating> heating;
  std::optional<Reaction> reaction;
  ArtificialViscosity artificial_viscosity;
};

/// Reasons why these components cannot work together, one sentence each; empty when they can.
/// A material that passes here is computed as written: nothing it names is ignored.
std::vector<std::string> incompatibilities(const Material& material);

}  // namespace brisance
