#pragma once

#include <array>

#include "models/real.hpp"

namespace brisance::equation_of_state {

/// Integral of a smooth function from a to b by the 16-point Gauss-Legendre rule, exact for polynomials to degree 31.
template <class Real, class Function>
Real integral(const Function& f, const Real& a, const Real& b) {
  constexpr std::array node = {0.095012509837637440, 0.281603550779258913, 0.458016777657227386, 0.617876244402643748,
                               0.755404408355003033, 0.865631202387831743, 0.944575023073232576, 0.989400934991649932};
  constexpr std::array weight = {0.189450610455068496, 0.182603415044923588, 0.169156519395002538, 0.149595988816576732,
                                 0.124628971255533872, 0.095158511682492784, 0.062253523938647892, 0.027152459411754094};
  const Real centre = 0.5 * (a + b), half = 0.5 * (b - a);
  Real sum(0.0);
  for (int i = 0; i < 8; ++i) sum = sum + weight[i] * (f(Real(centre - node[i] * half)) + f(Real(centre + node[i] * half)));
  return sum * half;
}

}  // namespace brisance::equation_of_state
