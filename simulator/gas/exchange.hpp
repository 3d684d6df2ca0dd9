#pragma once
// What several things in one place hand each other until they are alike.

#include <span>

namespace brisance::simulator::gas {

/// One implicit step of C_r dx_r = g theta_r sum_s theta_s (x_s' - x_r'): velocities and masses, temperatures and heat
/// capacities. One coefficient g for all pairs leaves one unknown, S = sum_s theta_s x_s'. Sum_r C_r x_r stays, however large g
/// is.
template <class Real>
void exchange(std::span<Real> x, std::span<const Real> capacity, std::span<const Real> part, const Real& g) {
  Real all(0.0), above(0.0), below(0.0);
  for (const Real& theta : part) all += theta;
  const auto stiffness = [&](std::size_t r) -> Real { return g * part[r] * all; };
  constexpr double least = 1e-300;
  for (std::size_t r = 0; r < x.size(); ++r) {
    const Real weight = part[r] * capacity[r] / (capacity[r] + stiffness(r) + least);
    above += weight * x[r], below += weight;
  }
  const Real mean = above / (below + least);  // S over all
  for (std::size_t r = 0; r < x.size(); ++r)
    x[r] = (capacity[r] * x[r] + stiffness(r) * mean) / (capacity[r] + stiffness(r) + least);
}

}  // namespace brisance::simulator::gas
