#pragma once
// The constitutive update: one step of a batch of points of one material.

#include "models/batch.hpp"
#include "models/material.hpp"

namespace brisance {

/// Advances every point of the batch by dt (s) along its velocity gradient: stress, deformation gradient, density, energy,
/// temperature, plastic strain, porosity, damage, history and failure flag. batch.time is the time at the end of the step.
/// Never throws; a point that could not be advanced carries its Trouble. Defined for Real = double and Lanes.
template <class Real>
void update(const Material& material, Batch<Real>& batch, double dt);
template <>
void update(const Material& material, Batch<double>& batch, double dt);
template <>
void update(const Material& material, Batch<Lanes>& batch, double dt);

/// The undeformed, hydrostatic state at a temperature (K) and the density of the material, or another one (kg/m^3). Under the
/// pressure of its equation of state: a metal kept at its density and heated is under thermal pressure.
State<double> initial_state(const Material& material, double temperature);
State<double> initial_state(const Material& material, double temperature, double density);

/// The same at the density that the body takes up at a temperature (K) and a pressure (Pa): heated without pressure, it has
/// expanded. A gas has no density without pressure, so under a complete equation of state zero pressure stands for the density
/// of the material. Where the pressure is out of the reach of the equation of state, the density ends at its limit.
State<double> stress_free_state(const Material& material, double temperature, double pressure = 0.0);

/// Isentropic longitudinal sound speed (m/s) of a point after an update: sqrt((K + 4 mu/3)/rho).
template <class Real>
Real longitudinal_sound_speed(const Point<Real>& point);

/// The words of a Trouble code and what to try, for error messages.
std::string_view describe(Trouble trouble);

}  // namespace brisance
