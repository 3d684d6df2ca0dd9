#pragma once
// The gallery: figures that show what the library computes beside what it must be, each with the numbers that decide.

#include <optional>
#include <string>
#include <vector>

#include "driver/plot.hpp"

namespace brisance::plots {

/// A number that a figure stands for.
struct Check {
  std::string quantity;             // what it is
  std::string reference;            // what it was measured against
  double measured = 0.0;            // in `unit`
  std::optional<double> tolerance;  // it passes when |measured| is at most this; none: reported, not judged
  std::string unit = "1";

  bool passes() const { return !tolerance || (measured <= *tolerance && measured >= -*tolerance); }
};

struct Picture {
  Figure figure;
  std::vector<Check> checks;
};

Picture stress_strain();          // flow stress laws of copper against strain, rate and temperature
Picture radial_return();          // the return to von Mises' circle
Picture adiabatic_temperature();  // heat of plastic work
Picture porosity();               // growth, nucleation, and the porous yield surface
Picture stability();              // onset of instability by Drucker and by the acoustic tensor
Picture hugoniot();               // shock states of aluminium, expansion of detonation products
Picture aluminium();              // isotherm, melting, moduli and specific heat of aluminium
Picture flow_stress_6061();       // 95 measured curves of 6061-T6

}  // namespace brisance::plots
