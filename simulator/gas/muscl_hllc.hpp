#pragma once
// A second gas solver, kept for comparison: one ideal gas on a line, MUSCL-Hancock with the MC limiter and the HLLC flux, in
// the plainest code that does it (Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. 2009, ch. 10 and 14).
// It shares nothing with the multi-material solver but GasState, so that the two can be held against each other where no
// exact solution exists.

#include <functional>
#include <vector>

#include "simulator/gas/gas_state.hpp"

namespace brisance::simulator::gas {

enum class EndKind { reflecting, transmissive, prescribed };

/// What lies beyond an end of the line.
struct End {
  EndKind kind = EndKind::reflecting;
  std::function<GasState(double position, double time)> state{};  // of the gas beyond it: kind prescribed
};

/// An ideal gas p = (gamma - 1) rho e on `lower` < x < `upper`, in cells of one width. In two and three dimensions x is the
/// distance from the axis or the centre, and everything is per radian or per steradian.
struct Euler1D {
  double gamma = 1.4;
  int dimension = 1;  // 1 planar, 2 cylindrical, 3 spherical
  double lower = 0.0, upper = 1.0;
  End at_lower{}, at_upper{};
  std::vector<GasState> cells{};  // mean density, velocity of the mean momentum, pressure of the mean energy
  double time = 0.0;

  double width() const { return (upper - lower) / static_cast<double>(cells.size()); }
  double face(int i) const { return lower + i * width(); }
  double centre(int i) const { return lower + (i + 0.5) * width(); }
  /// Of the face at x, and of what lies between two faces.
  double area(double x) const;
  double volume(double from, double to) const;
};

struct Conserved {
  double mass = 0.0, momentum = 0.0, energy = 0.0;
};

/// Over the whole line.
Conserved totals(const Euler1D& gas);

/// Numerical flux between two states, per area and time.
Conserved hllc_flux(const GasState& left, const GasState& right, double gamma);

/// The longest stable step times the Courant number, which is at most 1.
double stable_step(const Euler1D& gas, double courant);

/// One step. std::runtime_error when it leaves a cell without density or pressure; the state is lost then.
void advance(Euler1D& gas, double dt);

/// Steps up to a time.
void advance_to(Euler1D& gas, double time, double courant = 0.5);

}  // namespace brisance::simulator::gas
