#pragma once
// Equation of state of solids and gases. A law gives
//   law.pressure(rho, e)      Pa, positive in compression; does not fall with e, and rises with rho save where a law says so
//   law.energy(rho, T)        J/kg, the e that belongs to a density and temperature; linear in T, its slope is cv
//   law.range()               densities between which it holds
//   law.lowest_sound_speed()  m/s, floor of the derived sound speed where tension has taken the stiffness away
//   Law::caloric              what e means
// and, where it has a closed form, law.density(p, T). Everything else (T(rho, e), rho(p, T), e(rho, p), sound speed,
// expansion coefficient) is derived once, in thermodynamics.hpp.
// To add a law: write its file, add its name to the list below, add its test.

#include <variant>

#include "models/equation_of_state/abel.hpp"
#include "models/equation_of_state/birch_murnaghan.hpp"
#include "models/equation_of_state/hyperelastic.hpp"
#include "models/equation_of_state/hypoelastic.hpp"
#include "models/equation_of_state/ideal_gas.hpp"
#include "models/equation_of_state/jones_wilkins_lee.hpp"
#include "models/equation_of_state/logarithmic.hpp"
#include "models/equation_of_state/mie_gruneisen_energy.hpp"
#include "models/equation_of_state/mie_gruneisen_temperature.hpp"
#include "models/equation_of_state/murnaghan.hpp"
#include "models/equation_of_state/stiffened_gas.hpp"
#include "models/equation_of_state/tillotson.hpp"
#include "models/equation_of_state/twu_sim_tassone.hpp"

namespace brisance {

using EquationOfState =
    std::variant<equation_of_state::Hypoelastic, equation_of_state::Logarithmic, equation_of_state::Hyperelastic,
                 equation_of_state::MieGruneisenTemperature, equation_of_state::MieGruneisenEnergy,
                 equation_of_state::JonesWilkinsLee, equation_of_state::IdealGas, equation_of_state::Abel,
                 equation_of_state::StiffenedGas, equation_of_state::Murnaghan, equation_of_state::BirchMurnaghan,
                 equation_of_state::Tillotson, equation_of_state::TwuSimTassone>;

}  // namespace brisance
