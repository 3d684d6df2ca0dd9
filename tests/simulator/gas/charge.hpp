#pragma once
// An explosive, PBX 9501, and a charge of it in a rigid case.

#include "simulator/gas/reaction.hpp"
#include "tests/simulator/gas/bodies_set_up.hpp"
#include "tests/simulator/gas/chapman_jouguet.hpp"

namespace brisance::simulator::gas {

inline const equation_of_state::JonesWilkinsLee products{1838.0, 1668.9e9, 59.69e9, 5.9,
                                                         2.1,    0.45,     594.96,  9.499985e9};  // PBX 9501
inline const equation_of_state::Murnaghan reactant{1838.0, 1.0 / 2.78e-11, 7.4, 1e5, 1000.0, 300.0};
inline const double heat = products.detonation_energy / products.reference_density;  // J/kg
inline const ChapmanJouguet cj = tangent(products);

inline reaction::JwlPlusPlus jwl_plus_plus(double reaction_time) {
  return {1.0 / reaction_time, 1.3, cj.pressure, 0.01 * cj.pressure, heat};
}

/// A charge in a case of a body, with air around: lit in its middle, or by a program. `half_width` of the box in cells.
inline Gas charge_in_case(int half_width, const Reaction& law, Domain& domain) {
  constexpr double cell = 0.5e-3;
  const double inner = half_width - 7.0;
  Gas gas =
      set_up::box(Geometry::plane, cell, {-half_width, -half_width, 0}, {half_width, half_width, 0},
                  {{"explosive", reactant}, {"products", products}, {"air", equation_of_state::IdealGas{1.4, 718.0}}}, domain);
  gas.burns.push_back({"detonation", 0, 1, law, {}});
  gas.bodies.all = {
      set_up::ball(Geometry::plane, cell, {0.1 * cell, 0.2 * cell, 0.0}, (inner + 4.6) * cell, 0.3, inner * cell)};
  const double hot = products.pressure(products.reference_density, heat);
  fill(
      gas,
      [&](const Vector& x, double) {
        const double r = magnitude(x) / cell;
        if (r < 3.0) return Filling{1, products.reference_density, hot, {}};
        return r < inner + 2.3 ? Filling{0, products.reference_density, 1e5, {}} : Filling{2, 1.2, 1e5, {}};
      },
      domain);
  return gas;
}

}  // namespace brisance::simulator::gas
