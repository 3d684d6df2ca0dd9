#pragma once
// The implicit option: the pressures of a step come from one linear system instead of from the waves between neighbours, so
// that the step may be longer than sound takes from cell to cell. The pressure pi of a cell, at the part `centring` of the
// step, answers to the flow through its faces, and their velocities answer to it:
//
//   V (pi - p)/(rho c^2) + centring dt sum_f A_f u_f = 0,   u_f = u~_f - centring dt (grad pi/rho - g)_f,
//
// the matrix of semi-implicit ICE (Kashiwa et al., LA-UR-93-3922, 1993), symmetric and positive definite. The Lagrangian phase
// and the remap then are those of every step: what a face takes from one cell it gives to the next, whatever the solver's
// tolerance. A centring of one half is the implicit midpoint rule; long steps take a little more, so that sound fades.

#include "simulator/gas/gas.hpp"

namespace brisance::simulator::gas {

/// Room for the solve, after the cells have been filled.
void open_implicit(Gas& gas, Domain& domain);

/// Puts pi - p (Pa) of a step of dt (s) into the half step's pressure; false if the iteration does not converge.
bool solve_pressure(Gas& gas, double dt, Domain& domain);

/// Velocity and pressure of the faces of a pencil that go with the solution.
template <int D>
void solved_faces(Gas& gas, std::size_t block, int axis, int n, double dt, FacePencil& velocity, FacePencil& pressure);

}  // namespace brisance::simulator::gas
