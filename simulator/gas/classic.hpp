#pragma once
// The classic scheme, kept to compare with: explicit ICE as it has been since 1993 (Kashiwa et al., LA-UR-93-3922; Kashiwa &
// Rauenzahn, LA-UR-94-771; VanderHeyden & Kashiwa, J. Comput. Phys. 146 (1998) 1). Each fluid has its own velocity and internal
// energy; a drag that knows no bounds makes the velocities one. Energy is not conserved, and strong shocks do not converge:
// that is what it is here to show.
//
// Limits: straight geometries, walls and periodic sides, no gravity, viscosity or conduction. What sweeps out of a cell is
// taken along the axis of the face, without the offset across it.

#include <string>
#include <vector>

#include "simulator/gas/gas.hpp"
#include "simulator/gas/transport.hpp"

namespace brisance::simulator::gas {

/// What is asked for that the classic scheme does not have.
struct ClassicDemands {
  bool round = false, open_sides = false, gravity = false, face_dissipation = false, implicit = false, transport = false,
       reactions = false;
  void edge(EdgeKind kind) { open_sides = open_sides || (kind != EdgeKind::wall && kind != EdgeKind::periodic); }
};
/// Of a gas, or of the configuration of one.
template <class AnyGas>
ClassicDemands demands_of(const AnyGas& gas, Geometry geometry, const Vector& gravity, bool reactions) {
  ClassicDemands demands{.round = is_round(geometry),
                         .gravity = gravity != Vector{},
                         .face_dissipation = gas.least_mach != AnyGas{}.least_mach,
                         .implicit = gas.implicit,
                         .transport = has_transport(gas.fluids),
                         .reactions = reactions};
  for (const auto& edge : gas.edges) demands.edge(edge.kind);
  return demands;
}
/// Why the classic scheme cannot do it, each with what to do; empty if it can.
std::vector<std::string> classic_limits(const ClassicDemands& demands);
/// Takes the state of the classic scheme from what the gas is filled with. Throws std::runtime_error with classic_limits.
void open_classic(Gas& gas);
/// Contents and primitives as the classic state has them: for output and books.
void show_classic(Gas& gas, Domain& domain);
Outcome advance_classic(Gas& gas, double dt, Domain& domain);

}  // namespace brisance::simulator::gas
