#pragma once
// Lanes used as one number per channel: how they are put together, and the inner operation of the transfers.

#include "models/real.hpp"

namespace brisance::simulator {

/// a b + c in lanes, rounded once.
inline Lanes multiply_add(double a, const Lanes& b, const Lanes& c) {
  return multiply_add(Lanes(a), b, c);
}

/// Eight numbers side by side, put together in registers: written to memory one by one, they could not be loaded at once
/// without waiting for the last.
inline Lanes pack(double a, double b, double c, double d, double e = 0.0, double f = 0.0, double g = 0.0, double h = 0.0) {
  Lanes r;
  if constexpr (simd::register_width == 8) {
    r.part[0] = simd::Register{a, b, c, d, e, f, g, h};
  } else {
    const double all[8] = {a, b, c, d, e, f, g, h};
    for (int i = 0; i < 8; ++i) r.set(i, all[i]);
  }
  return r;
}

}  // namespace brisance::simulator
