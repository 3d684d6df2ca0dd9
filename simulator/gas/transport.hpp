#pragma once
// Viscosity and conduction: what neighbouring cells hand each other without any gas passing. Constant coefficients for each
// fluid, in a cell those of its fluids by volume; explicit, at the start of the step.
//
//   stress    tau_ab = mu (d_a u_b + d_b u_a) + (zeta - 2/3 mu) div u delta_ab
//   heat      q_a = -k d_a T, T the mean of the fluids by heat capacity
//
// Both act through faces, so momentum and total energy are kept; about an axis or a centre the hoop stress pushes as well.
// (Landau & Lifshitz, Fluid Mechanics, 2nd ed. 1987, sections 15, 49.)

#include <algorithm>
#include <vector>

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Whether any of these fluids, or of their configurations, has a viscosity or conducts.
template <class AnyFluid>
bool has_transport(const std::vector<AnyFluid>& fluids) {
  return std::any_of(fluids.begin(), fluids.end(),
                     [](const AnyFluid& f) { return f.viscosity > 0.0 || f.bulk_viscosity > 0.0 || f.conductivity > 0.0; });
}
inline bool has_transport(const Gas& gas) {
  return has_transport(gas.fluids);
}
/// Coefficients, temperatures and velocity gradients from the state at the start of a step, and the largest rate of diffusion.
/// Nothing without transport.
void prepare_transport(Gas& gas, Domain& domain);
/// J/K, of some cells' share of a fluid.
Lanes heat_capacity(const Fluid& fluid, const Lanes& mass, const Lanes& volume);
/// Adds heat (J) to the fluids of some cells of a block, by their heat capacities: all become warmer by the same.
void warm_alike(const Gas& gas, CellSet& set, std::size_t block, int k, const Lanes& heat);
/// What viscous stress, conduction and the exchange of heat between fluids do in dt (s) to the cells that have moved.
void apply_transport(Gas& gas, double dt);

}  // namespace brisance::simulator::gas
